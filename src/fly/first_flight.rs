//! The first of many flights, shown whole.

use std::path::PathBuf;

use righting_analysis::{Histories, PowerProfile};
use righting_flight::{Campaign, Recording, RecordingError};
use righting_report::{ComparedPlan, FigureWriter, compare_html, momentum_svg};
use righting_results::{Solution, Terminal, Trajectory, objective};
use righting_scenario::{Error, Scenario};
use righting_verifier::verify;

use crate::failure::Failure;
use crate::output_folder::OutputFolder;

const PAGE_FILE: &str = "fly.html";
const MOTION_FILE: &str = "flight.csv";
const MOMENTUM_FILE: &str = "flight_momentum.svg";

/// A plan and what is known of it.
pub struct Plan {
    /// Its maneuver.
    pub scenario: Scenario,
    /// The plan.
    pub trajectory: Trajectory,
    /// Its outcome.
    pub solution: Solution,
}

/// Writes the plan, the plan flown as it is and the flight on one page, the flight's motion as a table, and its momentum
/// as a figure. Nothing where its plant could not be followed.
pub fn write(
    plan: &Plan,
    campaign: &Campaign<'_>,
    folder: &OutputFolder,
    writer: &FigureWriter,
) -> Result<Vec<PathBuf>, Failure> {
    let Recording { scenario, open_loop, flown, .. } = match campaign.recorded(0) {
        Ok(recording) => recording,
        Err(RecordingError::Lost) => return Ok(Vec::new()),
        Err(RecordingError::Plant(error)) => return Err(error.into()),
        Err(RecordingError::Shape(error)) => return Err(Error::from(error).into()),
    };
    let of_motion = |motion: &Trajectory| {
        let verification = verify(&scenario, motion);
        Solution {
            scenario: scenario.resolved().clone(),
            scenario_sha256: scenario.resolved().sha256(),
            objective: objective(&scenario, motion),
            terminal: Terminal::reached(&scenario, motion),
            limits: verification.limits(),
            verification,
            notes: Vec::new(),
            attempts: Vec::new(),
            history: Vec::new(),
            ..plan.solution.clone()
        }
    };
    let solutions = [of_motion(&open_loop), of_motion(&flown)];
    let motions = [
        ("planned", &plan.scenario, &plan.solution, &plan.trajectory),
        ("open loop", &scenario, &solutions[0], &open_loop),
        ("flown", &scenario, &solutions[1], &flown),
    ];
    let profiles = motions
        .iter()
        .map(|(_, scenario, _, motion)| PowerProfile::new(scenario, motion))
        .collect::<Result<Vec<_>, _>>()
        .map_err(Error::from)?;
    let compared: Vec<ComparedPlan<'_>> = motions
        .iter()
        .zip(&profiles)
        .map(|(&(name, scenario, solution, trajectory), profile)| ComparedPlan {
            name,
            scenario,
            solution,
            trajectory,
            profile,
        })
        .collect();
    let mut files = vec![folder.write(PAGE_FILE, compare_html(&compared).as_bytes())?];
    let table = folder.path().join(MOTION_FILE);
    flown.write_csv(&scenario.system().model.joint_kinds(), &table)?;
    files.push(table);
    let histories = Histories::new(&scenario, &flown).map_err(Error::from)?;
    let figure = momentum_svg(&solutions[1], &flown, &histories);
    files.extend(writer.write(folder.path(), MOMENTUM_FILE, &figure)?);
    Ok(files)
}
