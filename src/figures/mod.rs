//! `righting figures`: draw a plan's figures again, or everything in the paper.

mod formats;
mod paper;
mod tables;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use righting_analysis::power::PAPER_EFFICIENCY;
use righting_analysis::{Histories, Motors, PowerProfile, WheelMotors};
use righting_planner::PlanError;
use righting_planner::sparsity::kkt_sparsity;
use righting_report::{
    FigureWriter, PowerComparison, attitude_svg, clearances_svg, convergence_svg, joints_svg,
    loads_svg, momentum_svg, pointing_svg, power_svg, sparsity_svg, wheels_svg,
};
use righting_results::{SOLUTION_FILE, Solution, Trajectory};
use righting_scenario::{Error, Scenario, WheelArray};
use righting_verifier::Verified;

pub use self::formats::Formats;
use crate::failure::Failure;
use crate::output_folder::{
    ATTITUDE_FILE, CLEARANCES_FILE, CONVERGENCE_FILE, JOINTS_FILE, LOADS_FILE, MOMENTUM_FILE,
    OutputFolder, POINTING_FILE, POWER_FIGURE_FILE, SPARSITY_FILE, WHEELS_FILE,
};
use crate::{output, plan_folder};

/// Intervals whose part of the KKT matrix is drawn.
const SPARSITY_STEPS: usize = 4;

/// Draw the figures of a plan again, or, from the paper's scenarios, all of the paper's figures and
/// tables.
#[derive(Args)]
pub struct Arguments {
    /// The folder of a plan, or one with the paper's scenarios.
    #[arg(value_name = "DIR", default_value = "scenarios/paper")]
    folder: PathBuf,
    /// The folder for the figures; the plan's own, or out/paper, if not given.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
}

/// Which figures a solve draws.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FigureSet {
    /// None.
    None,
    /// Those of the motion and of the solver.
    Usual,
    /// The sparsity of the nonlinear program too.
    All,
}

/// Draws what the folder is of.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { folder, out, formats } = arguments;
    let writer = formats.writer()?;
    if !folder.join(SOLUTION_FILE).exists() && folder.join(paper::FIRST_SCENARIO).exists() {
        return paper::run(folder, out.as_deref().unwrap_or(Path::new("out/paper")), &writer);
    }
    let Verified { solution, scenario, trajectory } = plan_folder::read(folder)?;
    let folder = OutputFolder::open(out.as_ref().unwrap_or(folder))?;
    folder.remove_earlier_figures()?;
    let files = draw(folder.path(), FigureSet::All, &writer, &scenario, &solution, &trajectory)?;
    let listed: String = files.iter().map(|file| format!("{}\n", file.display())).collect();
    output::print(&listed)?;
    Failure::of_verification(&solution).map_or(Ok(()), Err)
}

/// Draws the figures of a plan into a folder; the files, in the order a reader wants them.
pub fn draw(
    folder: &Path,
    set: FigureSet,
    writer: &FigureWriter,
    scenario: &Scenario,
    solution: &Solution,
    trajectory: &Trajectory,
) -> Result<Vec<PathBuf>, Failure> {
    if set == FigureSet::None {
        return Ok(Vec::new());
    }
    let histories = Histories::new(scenario, trajectory).map_err(Error::from)?;
    let profile = PowerProfile::new(scenario, trajectory).map_err(Error::from)?;
    let motors = Motors::new(&scenario.system().drives, &profile);
    let wheels = WheelArray::pyramid();
    let wheel_motors = WheelMotors::new(scenario.wheels(), trajectory, &profile);
    let power = PowerComparison {
        profile: &profile,
        motors: motors.as_ref(),
        efficiency: PAPER_EFFICIENCY,
        wheels: &wheels,
        wheel_motors: wheel_motors.as_ref(),
    };
    let mut figures = vec![
        (ATTITUDE_FILE, attitude_svg(solution, trajectory)),
        (JOINTS_FILE, joints_svg(solution, trajectory)),
        (MOMENTUM_FILE, momentum_svg(solution, trajectory, &histories)),
        (POWER_FIGURE_FILE, power_svg(solution, power)),
    ];
    let loads = loads_svg(solution, scenario.system(), &profile);
    figures.extend(loads.map(|figure| (LOADS_FILE, figure)));
    let wheels = wheels_svg(solution, scenario.wheels(), trajectory);
    figures.extend(wheels.map(|figure| (WHEELS_FILE, figure)));
    let clearances = clearances_svg(solution, trajectory, &histories);
    figures.extend(clearances.map(|figure| (CLEARANCES_FILE, figure)));
    let pointing = pointing_svg(solution, trajectory, &histories);
    figures.extend(pointing.map(|figure| (POINTING_FILE, figure)));
    figures.extend(convergence_svg(solution).map(|figure| (CONVERGENCE_FILE, figure)));
    if set == FigureSet::All {
        let steps = SPARSITY_STEPS.min(trajectory.steps());
        let sparsity = kkt_sparsity(scenario, steps).map_err(PlanError::from)?;
        figures.push((SPARSITY_FILE, sparsity_svg(solution, &sparsity, steps)));
    }
    let mut files = Vec::new();
    for (name, figure) in figures {
        files.extend(writer.write(folder, name, &figure)?);
    }
    Ok(files)
}
