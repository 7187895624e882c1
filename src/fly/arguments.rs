//! The arguments of `righting fly`.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};
use righting_flight::{Control, Faults, JointDrives, Sensors, Settings, Spreads, Stuck};
use righting_scenario::Scenario;
use schemars::JsonSchema;
use serde::Serialize;

use crate::failure::Failure;
use crate::figures::Formats;

/// Fly a plan many times with spacecraft that are not as planned: open loop, and with the rest of the maneuver
/// planned anew on the way.
///
/// Each flight draws its own masses, inertias and centers of mass. The joints follow the accelerations that they
/// are told, the base turns as the spacecraft's own momentum has it. The spacecraft is the verifier's model, not
/// the planner's. A replan starts from the attitude and the joints that are measured then.
#[derive(Args)]
pub struct Arguments {
    /// The scenario, a JSON file (- for standard input), or the folder of its plan.
    #[arg(value_name = "SCENARIO_OR_DIR")]
    pub(super) input: PathBuf,
    /// The folder for fly.json, flights.csv, flights.svg, and the first flight: fly.html, flight.csv and flight_momentum.svg.
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// How many flights, 100 if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(super) flights: Option<u32>,
    /// Seed of all random draws: the same seed, the same flights.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) guidance: GuidanceArguments,
    #[command(flatten)]
    pub(super) spacecraft: SpacecraftArguments,
    #[command(flatten)]
    pub(super) sensors: SensorArguments,
    #[command(flatten)]
    pub(super) faults: FaultArguments,
    /// The spacecraft: `model` flies the verifier's model with drawn masses, `stdio` one flight of whatever answers on
    /// standard input to what is said on standard output, one JSON object a line (docs/flights.md).
    #[arg(long, value_enum, default_value_t = Spacecraft::Model)]
    pub(super) plant: Spacecraft,
    #[command(flatten)]
    pub(super) formats: Formats,
    /// Print the contents of fly.json.
    #[arg(long, conflicts_with = "plant")]
    pub json: bool,
}

/// What flies the spacecraft.
#[derive(Args)]
pub struct GuidanceArguments {
    /// What is done about a spacecraft that is not as planned.
    #[arg(long, value_enum, default_value_t = Mode::Replan)]
    pub(super) mode: Mode,
    /// Time from one replan to the next, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = period)]
    pub(super) period: f64,
    /// Replan with the plan's masses; otherwise with those that the flight has shown.
    #[arg(long)]
    keep_masses: bool,
    /// Time from a measurement to the first step of its replan, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = not_negative)]
    delay_s: f64,
    /// A replan that takes longer is missed: the flight goes on with the last plan, ms.
    #[arg(long, value_name = "MS", value_parser = deadline)]
    deadline_ms: Option<Duration>,
}

/// How the spacecraft differs from the model.
#[derive(Args)]
pub struct SpacecraftArguments {
    /// Every mass is off by up to so much either way, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = share)]
    mass_percent: f64,
    /// Every inertia that is given is off by up to so much either way, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = share)]
    inertia_percent: f64,
    /// Every center of mass that is given is off by up to so much along each axis, m.
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = not_negative)]
    center_m: f64,
    /// The mount is off by up to so much along each axis, m.
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = not_negative)]
    mount_m: f64,
    /// The joints' accelerations come within 1/e of what they are told in this time, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = not_negative)]
    joint_lag_s: f64,
    /// Standard deviation of every joint's acceleration in every step, as a share of what it is told, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, value_parser = share)]
    joint_noise_percent: f64,
}

/// What is measured.
#[derive(Args)]
pub struct SensorArguments {
    /// Standard deviation of the measured attitude about each axis, deg.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = not_negative)]
    attitude_noise_deg: f64,
    /// Standard deviation of every measured joint angle, deg.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = not_negative)]
    joint_noise_deg: f64,
    /// Standard deviation of every measured joint rate, deg/s.
    #[arg(long, value_name = "DEG_S", default_value_t = 0.0, value_parser = not_negative)]
    joint_rate_noise_deg_s: f64,
}

/// What fails.
#[derive(Args)]
pub struct FaultArguments {
    /// So many of the measurements are lost, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, value_parser = share)]
    lost_percent: f64,
    /// So many of the replans are not made in time, %.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, value_parser = share)]
    missed_percent: f64,
    /// A joint, counted from one, that stops at a time, s, and does not move any more.
    #[arg(long, value_name = "JOINT@SECONDS", value_parser = stuck)]
    stick: Option<Stuck>,
}

/// What is done about a spacecraft that is not as planned.
#[derive(Clone, Copy, Serialize, JsonSchema, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Nothing: the plan is flown as it is.
    OpenLoop,
    /// The plan's own gains correct every step, for slews.
    Feedback,
    /// The rest of the maneuver is planned anew, time and again.
    Replan,
    /// Replans, and between them the plan's own gains, for slews.
    Both,
}

/// Which spacecraft is flown.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Spacecraft {
    /// The verifier's model, with masses of its own.
    Model,
    /// Whatever talks to this program.
    Stdio,
}

impl Arguments {
    /// How the plan is flown.
    ///
    /// # Errors
    /// A joint that the arm has not, and options that do nothing for a spacecraft that is not ours.
    pub(super) fn settings(&self, scenario: &Scenario) -> Result<Settings, Failure> {
        let Self { guidance, spacecraft, sensors, faults, .. } = self;
        let joints = scenario.system().joint_count();
        if let Some(Stuck { joint, .. }) = faults.stick
            && joint >= joints
        {
            return Err(Failure::NoSuchJoint { found: joint + 1, joints });
        }
        Ok(Settings {
            spreads: Spreads {
                masses: spacecraft.mass_percent / 100.0,
                inertias: spacecraft.inertia_percent / 100.0,
                centers_m: spacecraft.center_m,
                mount_m: spacecraft.mount_m,
            },
            drives: JointDrives {
                lag_s: spacecraft.joint_lag_s,
                noise: spacecraft.joint_noise_percent / 100.0,
            },
            sensors: Sensors {
                attitude_rad: sensors.attitude_noise_deg.to_radians(),
                joint_angle_rad: sensors.joint_noise_deg.to_radians(),
                joint_rate_rad_s: sensors.joint_rate_noise_deg_s.to_radians(),
            },
            faults: Faults {
                lost_measurements: faults.lost_percent / 100.0,
                missed_replans: faults.missed_percent / 100.0,
                stuck: faults.stick,
            },
            control: match guidance.mode {
                Mode::OpenLoop => Control::OpenLoop,
                Mode::Feedback => Control::Feedback,
                Mode::Replan => Control::Replan,
                Mode::Both => Control::Both,
            },
            period_s: guidance.period,
            delay_s: guidance.delay_s,
            estimates_masses: !guidance.keep_masses,
            deadline: guidance.deadline_ms,
            seed: self.seed,
        })
    }
}

fn period(text: &str) -> Result<f64, String> {
    number(text, |value| value > 0.0)
        .ok_or_else(|| "expected a number of seconds above 0".to_owned())
}

fn deadline(text: &str) -> Result<Duration, String> {
    let ms = number(text, |value| value > 0.0);
    let duration = ms.and_then(|ms| Duration::try_from_secs_f64(ms / 1e3).ok());
    duration.ok_or_else(|| "expected a number of milliseconds above 0".to_owned())
}

fn share(text: &str) -> Result<f64, String> {
    number(text, |value| (0.0..100.0).contains(&value))
        .ok_or_else(|| "expected a number from 0, below 100".to_owned())
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text, |value| value >= 0.0).ok_or_else(|| "expected a number from 0".to_owned())
}

fn number(text: &str, is_allowed: impl Fn(f64) -> bool) -> Option<f64> {
    text.parse().ok().filter(|&value: &f64| value.is_finite() && is_allowed(value))
}

fn stuck(text: &str) -> Result<Stuck, String> {
    let parts = text.split_once('@').and_then(|(joint, time)| {
        let joint: usize = joint.parse().ok()?;
        Some(Stuck { joint: joint.checked_sub(1)?, time_s: number(time, |time| time >= 0.0)? })
    });
    parts.ok_or_else(|| "expected a joint, counted from 1, and a time, such as 2@10".to_owned())
}
