//! The first of many flights, shown whole.

use std::path::PathBuf;

use righting_analysis::{Histories, PowerProfile};
use righting_flight::{Campaign, Recording, RecordingError};
use righting_report::{ComparedPlan, FigureWriter, compare_html, momentum_svg};
use righting_results::{Solution, Terminal, Trajectory, objective};
use righting_scenario::Error;
use righting_verifier::{Verified, verify};

use crate::failure::Failure;
use crate::output_folder::OutputFolder;

const PAGE_FILE: &str = "fly.html";
const MOTION_FILE: &str = "flight.csv";
const MOMENTUM_FILE: &str = "flight_momentum.svg";

/// Writes the plan, the plan flown as it is and the flight on one page, the flight's motion as a table, and its momentum
/// as a figure. Nothing where its plant could not be followed.
pub fn write(
    plan: &Verified,
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
    let of_motion = |trajectory: Trajectory| {
        let verification = verify(&scenario, &trajectory);
        let solution = Solution {
            scenario: scenario.resolved().clone(),
            scenario_sha256: scenario.resolved().sha256(),
            objective: objective(&scenario, &trajectory),
            terminal: Terminal::reached(&scenario, &trajectory),
            limits: verification.limits(),
            verification,
            notes: Vec::new(),
            attempts: Vec::new(),
            history: Vec::new(),
            ..plan.solution.clone()
        };
        Verified { solution, scenario: scenario.clone(), trajectory }
    };
    let (open_loop, flown) = (of_motion(open_loop), of_motion(flown));
    let motions = [("planned", plan), ("open loop", &open_loop), ("flown", &flown)];
    let profiles = motions
        .iter()
        .map(|(_, motion)| PowerProfile::new(&motion.scenario, &motion.trajectory))
        .collect::<Result<Vec<_>, _>>()
        .map_err(Error::from)?;
    let compared: Vec<ComparedPlan<'_>> = motions
        .iter()
        .zip(&profiles)
        .map(|((name, motion), profile)| ComparedPlan::new(name, motion, profile))
        .collect();
    let mut files = vec![folder.write(PAGE_FILE, compare_html(&compared).as_bytes())?];
    let Verified { solution, scenario, trajectory } = &flown;
    let table = folder.path().join(MOTION_FILE);
    trajectory.write_csv(&scenario.system().model.joint_kinds(), &table)?;
    files.push(table);
    let histories = Histories::new(scenario, trajectory).map_err(Error::from)?;
    let figure = momentum_svg(solution, trajectory, &histories);
    files.extend(writer.write(folder.path(), MOMENTUM_FILE, &figure)?);
    Ok(files)
}
