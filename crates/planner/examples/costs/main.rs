//! What a maneuver costs as it grows, as JSON: a record a line, every solve in a process of its own.
//!
//! ```text
//! costs joints           arms of 2 … 20 joints, N = 600
//! costs steps            4, 7 and 14 joints, N = 600 … 9600
//! costs linear-solvers   factor and solve in Ipopt by the stage solver and by MUMPS
//! ```

mod chain;
mod cold;
mod ipopt_timing;
mod planned;

use std::process::{Command, ExitCode, Stdio};

use righting_ocp::LinearSolverChoice;
use righting_scenario::Scenario;
use serde::Serialize;
use serde_json::{Value, json};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

const STEPS: [usize; 5] = [600, 1200, 2400, 4800, 9600];
/// The arms whose grid grows: the last does not fit in the caches even on the first grid.
const STEPS_JOINTS: [usize; 3] = [4, 7, 14];
/// The grid of the arms that grow.
const JOINTS_STEPS: usize = 600;
/// Maneuvers in which the linear solvers are compared.
const SHIPPED: [&str; 4] = ["slew_2dof", "slew_4dof", "slew_canadarm2_table", "slew_canadarm2"];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(words: &[&str]) -> Outcome<()> {
    match words {
        ["joints"] => chain::JOINTS.iter().try_for_each(|&joints| grown(joints, JOINTS_STEPS)),
        ["steps"] => STEPS_JOINTS
            .iter()
            .flat_map(|&joints| STEPS.map(|steps| (joints, steps)))
            .try_for_each(|(joints, steps)| grown(joints, steps)),
        ["linear-solvers"] => SHIPPED.iter().try_for_each(|name| compared(name)),
        ["chain", joints, steps, how] => {
            let scenario = chain::on_grid(&chain::chain(joints.parse()?)?, steps.parse()?)?;
            print(measured(&scenario, how)?)
        }
        ["shipped", name, how] => print(measured(&Scenario::read(&chain::shipped(name))?, how)?),
        _ => Err("usage: costs joints|steps|linear-solvers".into()),
    }
}

fn measured(scenario: &Scenario, how: &str) -> Outcome<Value> {
    match how {
        "plan" => planned::measured(scenario),
        "cold" => cold::by_iteration(scenario),
        "stage" => cold::in_ipopt(scenario, LinearSolverChoice::Stage),
        "mumps" => cold::in_ipopt(scenario, LinearSolverChoice::Mumps),
        _ => Err(format!("{how}: neither plan, cold, stage nor mumps").into()),
    }
}

/// As a user plans it, and from the constant guess for the cost of an iteration.
fn grown(joints: usize, steps: usize) -> Outcome<()> {
    let (joints_word, steps_word) = (joints.to_string(), steps.to_string());
    let [plan, cold] =
        ["plan", "cold"].map(|how| in_own_process(&["chain", &joints_word, &steps_word, how]));
    print(json!({ "joints": joints, "steps": steps, "plan": plan?, "cold": cold? }))
}

fn compared(name: &str) -> Outcome<()> {
    let [stage, mumps] = ["stage", "mumps"].map(|how| in_own_process(&["shipped", name, how]));
    let (stage, mumps) = (stage?, mumps?);
    print(json!({
        "scenario": name,
        "ratio": Ratio::of(&stage, &mumps),
        "stage": stage,
        "mumps": mumps,
    }))
}

/// How many times longer than the stage solver MUMPS takes, by iteration.
#[derive(Serialize)]
struct Ratio {
    /// Assembling by Ipopt, the same for both, included.
    augmented_system: f64,
    /// Factorising and solving alone.
    factor_and_solve: f64,
}

impl Ratio {
    /// What assembling takes is known from the solver around which Ipopt times the rest.
    fn of(stage: &Value, mumps: &Value) -> Option<Self> {
        let each =
            |run: &Value, field: &str| Some(run[field].as_f64()? / run["iterations"].as_f64()?);
        let stage_kkt = each(stage, "factor_and_solve_cpu_s")?;
        let stage_system = each(stage, "augmented_system_cpu_s")?;
        let mumps_system = each(mumps, "augmented_system_cpu_s")?;
        let assembling = stage_system - stage_kkt;
        Some(Self {
            augmented_system: mumps_system / stage_system,
            factor_and_solve: (mumps_system - assembling) / stage_kkt,
        })
    }
}

/// Runs this program again: peak memory is a whole process's.
fn in_own_process(words: &[&str]) -> Outcome<Value> {
    let program = std::env::current_exe()?;
    let output = Command::new(program).args(words).stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(format!("{}: {}", words.join(" "), output.status).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn print(record: Value) -> Outcome<()> {
    println!("{record}");
    Ok(())
}

/// The largest resident set of this process so far, MiB; none where there is no /proc.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}
