//! Every figure and table of the paper that has numbers in it, from the scenarios in one folder.

use std::path::Path;
use std::time::Instant;

use righting_analysis::envelope::sampled_maxima;
use righting_analysis::power::{Accounting, Consumption, PAPER_EFFICIENCY};
use righting_analysis::{PowerProfile, envelopes};
use righting_planner::Planner;
use righting_report::{
    FigureWriter, PowerComparison, PowerTrade, maneuvers_svg, power_svg, power_trade_svg,
};
use righting_results::{Solution, Status, Trajectory};
use righting_scenario::{Error, Scenario, WheelArray};

use super::FigureSet;
use super::tables::{self, Comparison};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output_folder::OutputFolder;
use crate::solve::Shown;
use crate::{build, envelope, output, solve};

/// A file that marks a folder as one of the paper's scenarios.
pub const FIRST_SCENARIO: &str = "slew_2dof.json";

/// The systems of the paper's Table I, (c) in both readings, with the solve times of its Table II.
pub const SYSTEMS: [PaperSystem; 4] = [
    PaperSystem { file: "2dof", name: "(a) 2-DOF", slew_s: 249.0, detumble_s: 279.0 },
    PaperSystem { file: "4dof", name: "(b) 4-DOF", slew_s: 361.0, detumble_s: 835.0 },
    PaperSystem {
        file: "canadarm2_table",
        name: "(c) 7-DOF distal",
        slew_s: 1318.0,
        detumble_s: 2059.0,
    },
    PaperSystem { file: "canadarm2", name: "(c) 7-DOF Craig", slew_s: 1318.0, detumble_s: 2059.0 },
];
/// Durations over which the 4-DOF slew's power is looked at, s; at the first the arm cannot do it.
const DURATIONS_S: [f64; 9] = [8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0];
const DURATION_STEPS: f64 = 200.0;
/// Samples of an envelope, and seeds that their maxima are averaged over.
const SAMPLES: u32 = 2000;
const SEEDS: u64 = 10;

/// A system of the paper.
pub struct PaperSystem {
    /// What its scenarios' names end in.
    pub file: &'static str,
    /// What a reader calls it.
    pub name: &'static str,
    /// The paper's solve time of the slew.
    pub slew_s: f64,
    /// The paper's solve time of the detumble.
    pub detumble_s: f64,
}

/// A maneuver, planned.
pub struct Planned {
    /// What was asked.
    pub scenario: Scenario,
    /// What came out.
    pub solution: Solution,
    /// How it moves.
    pub trajectory: Trajectory,
}

/// Plans, draws and compares.
pub fn run(scenarios: &Path, out: &Path, writer: &FigureWriter) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let folder = OutputFolder::open(out)?;
    let read = |name: &str| Scenario::read(&scenarios.join(format!("{name}.json")));
    let of_systems = |kind: &str| -> Result<Vec<Planned>, Failure> {
        let plan = |system: &PaperSystem| {
            kept(folder.path(), read(&format!("{kind}_{}", system.file))?, writer, &interrupt)
        };
        SYSTEMS.iter().map(plan).collect()
    };
    let slews = of_systems("slew")?;
    let detumbles = of_systems("detumble")?;
    let large = kept(folder.path(), read("slew75_4dof")?, writer, &interrupt)?;

    output::complain("envelopes");
    let arm = slews[1].scenario.system();
    let wheels = WheelArray::pyramid();
    let found = envelopes(arm, SAMPLES as usize, 1, &wheels);
    let maxima: Vec<[f64; 2]> =
        (1..=SEEDS).map(|seed| sampled_maxima(arm, SAMPLES as usize, seed)).collect();
    let sampled = [0, 1].map(|i| maxima.iter().map(|pair| pair[i]).sum::<f64>() / SEEDS as f64);

    let slew = &slews[1];
    let profile = profile(slew)?;
    let power = PowerComparison {
        profile: &profile,
        motors: None,
        efficiency: PAPER_EFFICIENCY,
        wheels: &wheels,
        wheel_motors: None,
    };
    let trades = trades(&slew.scenario, &interrupt)?;

    let pairs = |all: &[Planned]| -> Vec<(String, Solution, Trajectory)> {
        let named = SYSTEMS.iter().zip(all);
        named
            .map(|(system, planned)| {
                (system.name.to_owned(), planned.solution.clone(), planned.trajectory.clone())
            })
            .collect()
    };
    let comparison = Comparison {
        slews: &slews,
        detumbles: &detumbles,
        large: &large,
        envelopes: &found,
        sampled,
        power: &profile,
        trades: &trades,
    };
    let figures = [
        ("fig4_slews.svg", maneuvers_svg("The paper's slews of 20° in 30 s", &pairs(&slews))),
        (
            "fig5_detumbles.svg",
            maneuvers_svg("The paper's detumbles from 20 deg/s in 30 s", &pairs(&detumbles)),
        ),
        ("fig7_envelopes.svg", envelope::figure(&arm.name, &found, &wheels)),
        ("fig8_power.svg", power_svg(&slew.solution, power)),
        ("fig8_power_by_duration.svg", power_trade_svg(&trades)),
    ];
    let tables = [
        ("table1.md", tables::systems(&slews)),
        ("comparison.md", tables::comparison(&comparison)),
    ];
    let mut files = Vec::new();
    for (name, table) in &tables {
        files.push(folder.write(name, table.as_bytes())?);
    }
    for (name, figure) in &figures {
        files.extend(writer.write(folder.path(), name, figure)?);
    }
    output::print(&tables::comparison(&comparison))?;
    output::complain(&format!(
        "{} files and a folder a maneuver in {}",
        files.len(),
        out.display()
    ));
    let all = slews.iter().chain(&detumbles).chain([&large]);
    all.filter_map(|planned| Failure::of_verification(&planned.solution)).next().map_or(Ok(()), Err)
}

/// A scenario planned and verified, or why not.
fn planned(scenario: Scenario, interrupt: &Interrupt) -> Result<Planned, Failure> {
    output::complain(scenario.name());
    let mut planner = Planner::new().program(build::VERSION);
    let righting_planner::Planned { solution, trajectory } =
        planner.plan(&scenario, &mut |_| interrupt.control())?;
    match solution.status {
        Status::Interrupted => Err(Failure::Interrupted { has_plan: false }),
        status if status.is_acceptable() => Ok(Planned { scenario, solution, trajectory }),
        status => Err(Failure::NoPlan { status, has_notes: false }),
    }
}

/// The plan of a scenario, kept in a folder of its own within `out`.
fn kept(
    out: &Path,
    scenario: Scenario,
    writer: &FigureWriter,
    interrupt: &Interrupt,
) -> Result<Planned, Failure> {
    let started = Instant::now();
    let mut planned = planned(scenario, interrupt)?;
    let Planned { scenario, solution, trajectory } = &mut planned;
    let folder = OutputFolder::open(&out.join(scenario.name()))?;
    let shown = Shown { figures: FigureSet::All, writer, page: true };
    solve::write(&folder, shown, scenario, solution, trajectory, started)?;
    Ok(planned)
}

fn profile(planned: &Planned) -> Result<PowerProfile, Failure> {
    let profile = PowerProfile::new(&planned.scenario, &planned.trajectory);
    Ok(profile.map_err(Error::from)?)
}

/// Peak power and energy of the slew in other durations.
fn trades(slew: &Scenario, interrupt: &Interrupt) -> Result<Vec<PowerTrade>, Failure> {
    let trade = |duration_s: f64| {
        let mut file = slew.resolved().clone();
        file.name = format!("{} in {duration_s} s", file.name);
        file.horizon.duration_s = righting_scenario::file::Duration::Given(duration_s);
        file.horizon.steps = DURATION_STEPS;
        let scenario = Scenario::from_file(file, Path::new("durations"))?;
        let planned = planned(scenario, interrupt)?;
        let profile = profile(&planned)?;
        let reached = planned.solution.verification.passed;
        let consumptions: Vec<Consumption> = Accounting::ALL
            .into_iter()
            .map(|accounting| profile.consumption(accounting, PAPER_EFFICIENCY))
            .collect();
        Ok(PowerTrade { duration_s, reached, consumptions })
    };
    DURATIONS_S.into_iter().map(trade).collect()
}
