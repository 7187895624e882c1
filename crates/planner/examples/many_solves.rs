//! Many solves in one process, to see that none leaves memory behind: `many_solves 1000`.
//!
//! Solves alternate between the optimizers and the linear solvers. The resident memory after a tenth of them is compared
//! with that after all; more than a tenth of growth ends with an error. valgrind runs it too: `make leaks`.

use std::error::Error;
use std::num::NonZeroUsize;
use std::path::Path;

use righting_ocp::Control;
use righting_planner::Planner;
use righting_scenario::Scenario;
use righting_scenario::file::{LinearSolverChoice, Optimizer};

/// Growth that the allocator's own bookkeeping may cause, as a share.
const GROWTH: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    let solves: usize = std::env::args().nth(1).ok_or("usage: many_solves COUNT")?.parse()?;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let small =
        Scenario::read(&folder.join("slew_2dof.json"))?.varied(|file| file.horizon.steps = 12.0)?;
    let ways = [
        (Optimizer::Ipopt, LinearSolverChoice::Stage),
        (Optimizer::Ipopt, LinearSolverChoice::Mumps),
        (Optimizer::Interior, LinearSolverChoice::Auto),
    ];
    let mut first_kib = None;
    for solve in 0..solves {
        let (optimizer, linear_solver) = ways[solve % ways.len()];
        let scenario = small.varied(|file| {
            file.solver.optimizer = Some(optimizer);
            file.solver.linear_solver = Some(linear_solver);
            file.maneuver.angle_deg = Some(5.0 + (solve % 20) as f64);
        })?;
        let mut planner = Planner::new().threads(NonZeroUsize::MIN).without_remedies();
        planner.plan(&scenario, &mut |_| Control::Continue)?;
        if solve == solves / 10 {
            first_kib = resident_kib();
        }
    }
    let (Some(first), Some(last)) = (first_kib, resident_kib()) else {
        println!("{solves} solves");
        return Ok(());
    };
    println!("{solves} solves: {first} KiB resident after a tenth of them, {last} KiB after all");
    match last as f64 > (1.0 + GROWTH) * first as f64 {
        true => Err("the memory grows".into()),
        false => Ok(()),
    }
}

/// The memory that the process has, where the system says it.
fn resident_kib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches(" kB").parse().ok()
}
