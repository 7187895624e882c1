//! Plans a slew of the 4-DOF arm and writes its trajectory.

use std::error::Error;
use std::path::Path;

use righting_ocp::Control;
use righting_planner::Planner;
use righting_scenario::Scenario;

fn main() -> Result<(), Box<dyn Error>> {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let scenario = Scenario::read(&scenarios.join("slew_4dof.json"))?;
    let planned = Planner::new().plan(&scenario, &mut |iteration| {
        eprintln!("iteration {:>3}: objective {:.6e}", iteration.iteration, iteration.objective);
        Control::Continue
    })?;
    let solution = &planned.solution;
    println!("{:?} by {:?}", solution.status, solution.versions.optimizer);
    println!("misses the target by {:.1e} deg", solution.terminal.attitude_error_deg);
    println!("checked by an independent model: {}", solution.verification.passed);
    let file = std::env::temp_dir().join("righting_slew_4dof.csv");
    planned.trajectory.write_csv(&scenario.system().model.joint_kinds(), &file)?;
    println!("{}", file.display());
    Ok(())
}
