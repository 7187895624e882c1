//! A plant at the other end of a pipe: anybody's simulator, or hardware.
//!
//! Both sides write JSON, one object a line. First what is flown ([`Opening`]); then for every step a command
//! ([`Command`]), which the plant follows for the step's duration and answers with what is measured then
//! ([`Answer`]). The answer to the last command is the end of the flight.

use std::io::{self, BufRead, Write};

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_planner::Measured;
use righting_results::Trajectory;
use righting_scenario::{Scenario, file};
use righting_verifier::model::State;
use serde::{Deserialize, Serialize};

use crate::end::End;
use crate::flight::Flight;
use crate::guidance::Guidance;

/// Longest line of an answer, bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// What is said first.
#[derive(Serialize)]
struct Opening<'a> {
    /// "righting.plant/1".
    schema: &'static str,
    /// Name of the scenario.
    scenario: &'a str,
    /// The system that was planned with, as in a system file.
    system: &'a file::System,
    /// What acts from outside, as in a scenario; null if nothing does.
    environment: Option<&'a file::Environment>,
    /// Number of steps.
    steps: usize,
    /// Duration of the flight, s.
    duration_s: f64,
    /// Where it starts; the system's center of mass is at rest.
    start: Start<'a>,
}

#[derive(Serialize)]
struct Start<'a> {
    /// Body → inertial, w, x, y, z.
    attitude: [f64; 4],
    /// Of the base, body axes.
    angular_rate_rad_s: [f64; 3],
    joint_angles_rad: &'a [f64],
    joint_rates_rad_s: &'a [f64],
}

/// What the joints shall do for a step.
#[derive(Serialize)]
struct Command<'a> {
    /// Which step, counted from zero.
    step: usize,
    /// When it begins, s.
    time_s: f64,
    /// How long it lasts, s.
    duration_s: f64,
    /// Accelerations of the joints, held over the step, rad/s²; m/s² of joints that slide.
    joint_accelerations_rad_s2: &'a [f64],
}

/// What is measured when a step has ended. A null is what could not be measured.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    /// Body → inertial, w, x, y, z; either sign.
    attitude: [Option<f64>; 4],
    /// Rad; m of joints that slide.
    joint_angles_rad: Vec<Option<f64>>,
    /// Rad/s; m/s of joints that slide.
    joint_rates_rad_s: Vec<Option<f64>>,
    /// Of the base, body axes; only that of the last answer is used. Zero if not given.
    #[serde(default)]
    angular_rate_rad_s: [f64; 3],
}

/// Why a flight with a plant at the other end of a pipe ended early.
#[derive(Debug, thiserror::Error)]
pub enum ConversationError {
    /// The pipe does not work.
    #[error("the plant cannot be talked to: {0}")]
    Pipe(#[from] io::Error),
    /// It said nothing more.
    #[error("the plant said nothing more after step {step} of {steps}; expected one line a step")]
    Silent {
        /// The step that it was told last, counted from one.
        step: usize,
        /// Number of steps.
        steps: usize,
    },
    /// It said something else than what is expected.
    #[error("the plant's answer to step {step}: {problem}")]
    Answer {
        /// The step, counted from one.
        step: usize,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

/// Flies one plan with a plant that is told commands on `commands` and answers on `answers`.
///
/// # Errors
/// [`ConversationError`].
pub fn fly_with(
    scenario: &Scenario,
    plan: &Trajectory,
    mut guidance: Guidance,
    (answers, commands): (&mut impl BufRead, &mut impl Write),
) -> Result<Flight, ConversationError> {
    let steps = guidance.steps();
    let start = plan.start();
    say(
        commands,
        &Opening {
            schema: "righting.plant/1",
            scenario: scenario.name(),
            system: scenario.resolved_system(),
            environment: scenario.resolved().environment.as_ref(),
            steps,
            duration_s: plan.end().time_s,
            start: Start {
                attitude: start.attitude,
                angular_rate_rad_s: start.angular_rate_rad_s,
                joint_angles_rad: &start.joint_angles_rad,
                joint_rates_rad_s: &start.joint_rates_rad_s,
            },
        },
    )?;
    let mut here = Answer {
        attitude: start.attitude.map(Some),
        joint_angles_rad: start.joint_angles_rad.iter().copied().map(Some).collect(),
        joint_rates_rad_s: start.joint_rates_rad_s.iter().copied().map(Some).collect(),
        angular_rate_rad_s: start.angular_rate_rad_s,
    };
    for step in 0..steps {
        let (attitude, angles, rates) = here.values();
        let measured = Measured {
            attitude: Quaternion::from_array(attitude),
            joint_angles_rad: &angles,
            joint_rates_rad_s: &rates,
        };
        let accelerations = guidance.command(step, Some(measured), false);
        let command = Command {
            step,
            time_s: guidance.time_s(step),
            duration_s: guidance.step_s(step),
            joint_accelerations_rad_s2: &accelerations,
        };
        say(commands, &command)?;
        here = heard(answers, (step + 1, steps), plan.joints())?;
    }
    let (attitude, angles, rates) = here.values();
    let end = State {
        attitude: nalgebra::Quaternion::new(attitude[0], attitude[1], attitude[2], attitude[3]),
        angular_rate: Vector3::from(here.angular_rate_rad_s),
        position: Vector3::zeros(),
        velocity: Vector3::zeros(),
        joint_angles: &angles,
        joint_rates: &rates,
    };
    let flown = End::of(scenario, &end);
    Ok(Flight { number: 0, open_loop: None, flown, log: guidance.log().clone() })
}

impl Answer {
    /// What is not measured is no number.
    fn values(&self) -> ([f64; 4], Vec<f64>, Vec<f64>) {
        let or_nan = |value: &Option<f64>| value.unwrap_or(f64::NAN);
        (
            self.attitude.map(|value| or_nan(&value)),
            self.joint_angles_rad.iter().map(or_nan).collect(),
            self.joint_rates_rad_s.iter().map(or_nan).collect(),
        )
    }
}

fn say(commands: &mut impl Write, what: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *commands, what)?;
    commands.write_all(b"\n")?;
    commands.flush()
}

fn heard(
    answers: &mut impl BufRead,
    (step, steps): (usize, usize),
    joints: usize,
) -> Result<Answer, ConversationError> {
    let mut line = String::new();
    let wrong = |problem: String| ConversationError::Answer { step, problem };
    io::Read::take(&mut *answers, LONGEST_LINE).read_line(&mut line)?;
    if line.is_empty() {
        return Err(ConversationError::Silent { step, steps });
    }
    let answer: Answer = serde_json::from_str(&line).map_err(|error| {
        wrong(format!(
            "{error}; expected one line {{\"attitude\": [w, x, y, z], \"joint_angles_rad\": […], \
             \"joint_rates_rad_s\": […], \"angular_rate_rad_s\": [x, y, z]}}"
        ))
    })?;
    let counts = [
        ("joint_angles_rad", answer.joint_angles_rad.len()),
        ("joint_rates_rad_s", answer.joint_rates_rad_s.len()),
    ];
    match counts.into_iter().find(|(_, found)| *found != joints) {
        Some((field, found)) => {
            Err(wrong(format!("{field}: found {found} values, expected {joints}")))
        }
        None => Ok(answer),
    }
}
