//! `righting power`: what a plan's motion costs, beside reaction wheels.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use righting_analysis::motors::{Braking, Losses};
use righting_analysis::power::{Accounting, Consumption, PAPER_EFFICIENCY};
use righting_analysis::{Motors, PowerProfile, WheelMotors};
use righting_report::{PowerComparison, power_svg, power_table};
use righting_scenario::wheels::Wheel;
use righting_scenario::{Error, WheelArray};
use righting_verifier::Verified;
use serde::Serialize;

use crate::failure::Failure;
use crate::figures::Formats;
use crate::output_folder::{OutputFolder, POWER_FIGURE_FILE, POWER_FILE};
use crate::wheels::Wheels;
use crate::{output, plan_folder};

/// Work out the joint torques of a plan and the power they take, beside reaction wheels.
#[derive(Args)]
pub struct Arguments {
    /// A folder with trajectory.csv and solution.json.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Overall efficiency of the joints' actuators.
    #[arg(long, value_name = "ETA", default_value_t = PAPER_EFFICIENCY, value_parser = efficiency)]
    efficiency: f64,
    #[command(flatten)]
    wheels: Wheels,
    /// The folder for power.json and power.svg; the plan's if not given.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What power.json holds and `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    schema: &'static str,
    scenario: &'a str,
    duration_s: f64,
    efficiency: f64,
    variants: BTreeMap<&'static str, Consumption>,
    peak_joint_torques_n_m: Vec<f64>,
    peak_joint_powers_w: Vec<f64>,
    work_j: Option<f64>,
    kinetic_energy_change_j: Option<f64>,
    /// Only where every joint's motor is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    motors: Option<PrintedMotors>,
    wheels: PrintedWheels<'a>,
}

#[derive(Serialize)]
struct PrintedMotors {
    without_regeneration: Consumption,
    with_regeneration: Consumption,
    losses: Losses,
    peak_currents_a: Vec<f64>,
    peak_voltages_v: Vec<f64>,
}

impl PrintedMotors {
    fn new(motors: &Motors<'_>) -> Self {
        Self {
            without_regeneration: motors.consumption(Braking::Burnt),
            with_regeneration: motors.consumption(Braking::FedBack),
            losses: motors.losses(),
            peak_currents_a: motors.peak_currents_a(),
            peak_voltages_v: motors.peak_voltages_v(),
        }
    }
}

#[derive(Serialize)]
struct PrintedWheels<'a> {
    array: &'a [Wheel],
    steady_power_w: f64,
    energy_j: f64,
    /// Only for the wheels of the scenario, where the inertia of every one that works is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    motors: Option<PrintedWheelMotors>,
}

#[derive(Serialize)]
struct PrintedWheelMotors {
    without_regeneration: Consumption,
    with_regeneration: Consumption,
    friction_j: f64,
    kinetic_energy_change_j: f64,
    /// One a wheel that works.
    peak_speeds_rad_s: Vec<f64>,
}

impl PrintedWheelMotors {
    fn new(motors: &WheelMotors<'_>) -> Self {
        Self {
            without_regeneration: motors.consumption(Braking::Burnt),
            with_regeneration: motors.consumption(Braking::FedBack),
            friction_j: motors.friction_j(),
            kinetic_energy_change_j: motors.kinetic_energy_change_j(),
            peak_speeds_rad_s: motors.peak_speeds_rad_s().to_vec(),
        }
    }
}

/// Reads, checks, computes, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writer = arguments.formats.writer()?;
    let given = arguments.wheels.read()?;
    let Verified { solution, scenario, trajectory } = plan_folder::read(&arguments.folder)?;
    let of_scenario = WheelArray::of(scenario.wheels());
    let is_of_scenario = given.is_none();
    let wheels = given.or(of_scenario).unwrap_or_else(WheelArray::pyramid);
    let profile = PowerProfile::new(&scenario, &trajectory).map_err(Error::from)?;
    let motors = Motors::new(&scenario.system().drives, &profile);
    let wheel_motors = WheelMotors::new(scenario.wheels(), &trajectory, &profile);
    let wheel_motors = wheel_motors.filter(|_| is_of_scenario);
    let folder = OutputFolder::open(arguments.out.as_ref().unwrap_or(&arguments.folder))?;
    let efficiency = arguments.efficiency;
    let consumption =
        |accounting: Accounting| (accounting.name(), profile.consumption(accounting, efficiency));
    let finite = |value: f64| value.is_finite().then_some(value);
    let printed = Printed {
        schema: "righting.power/1",
        scenario: scenario.name(),
        duration_s: profile.duration_s(),
        efficiency,
        variants: Accounting::ALL.into_iter().map(consumption).collect(),
        peak_joint_torques_n_m: profile.peak_torques_n_m(),
        peak_joint_powers_w: profile.peak_joint_powers_w(),
        work_j: finite(profile.work_j()),
        kinetic_energy_change_j: finite(profile.kinetic_energy_change_j()),
        motors: motors.as_ref().map(PrintedMotors::new),
        wheels: PrintedWheels {
            array: wheels.wheels(),
            steady_power_w: wheels.steady_power_w(),
            energy_j: wheels.steady_power_w() * profile.duration_s(),
            motors: wheel_motors.as_ref().map(PrintedWheelMotors::new),
        },
    };
    let comparison = PowerComparison {
        profile: &profile,
        motors: motors.as_ref(),
        efficiency,
        wheels: &wheels,
        wheel_motors: wheel_motors.as_ref(),
    };
    let json = output::to_json(&printed)?;
    folder.write(POWER_FILE, json.as_bytes())?;
    writer.write(folder.path(), POWER_FIGURE_FILE, &power_svg(&solution, comparison))?;
    if arguments.json {
        output::print(&json)?;
    } else {
        output::print(&power_table(&solution, comparison))?;
    }
    Failure::of_verification(&solution).map_or(Ok(()), Err)
}

fn efficiency(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1.0 => Ok(value),
        _ => Err("expected more than 0, at most 1".to_owned()),
    }
}
