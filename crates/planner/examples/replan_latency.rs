//! How long replans of a slew take, and what they come to:
//!
//! ```sh
//! replan_latency SCENARIO.json [STEPS [REPLANS [ITERATIONS [NODE]]]]
//! ```
//!
//! The slew is planned once, on STEPS steps. Each replan starts warm from that plan, at NODE or anywhere in the plan's
//! first twentieth, where the attitude is off by half a degree about some axis. It is prepared before the clock starts. With ITERATIONS above zero it makes no
//! more than so many, in real time. One JSON object comes on standard output; how much the objective is above its
//! optimum is found by replans without that limit. `RAYON_NUM_THREADS=1` keeps the first plan on one core too.

use std::error::Error;
use std::num::NonZeroU32;
use std::path::Path;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_multibody::Quaternion;
use righting_ocp::Control;
use righting_planner::{Measurement, Planner, Replanner};
use righting_results::Node;
use righting_scenario::{Maneuver, Scenario};

/// By how much the attitude is off.
const OFF_DEG: f64 = 0.5;
/// Replans before the clock counts.
const UNCOUNTED: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("a scenario is needed")?;
    let mut number = |default: usize| arguments.next().map_or(Ok(default), |text| text.parse());
    let given = Scenario::read(Path::new(&file))?;
    let steps = number(given.horizon().steps)?;
    let replans = number(1000)?;
    let iterations = u32::try_from(number(0)?)?;
    let node = number(steps)?;
    let scenario = given.varied(|file| file.horizon.steps = steps as f64)?;
    let Maneuver::Slew(slew) = scenario.maneuver() else { return Err("a slew is needed".into()) };

    let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue)?.trajectory;
    let mut converging = Replanner::new(&scenario, &plan)?;
    // The first replan makes the workspace that the others share.
    converging.replan(0, &off_by(&plan.nodes()[0], [0.0, 0.0, 1.0], 0.0).as_measured(), None)?;
    let replanner = match NonZeroU32::new(iterations) {
        Some(iterations) => converging.clone().in_real_time(iterations),
        None => converging.clone(),
    };
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut missed = 0;
    let (mut times_ms, mut processor, mut preparation) = (Vec::new(), Vec::new(), Vec::new());
    let (mut counts, mut misses_deg, mut above) = (Vec::new(), Vec::new(), Vec::new());
    for replan in 0..UNCOUNTED + replans {
        let from = if node < steps { node } else { random.random_range(0..steps.div_ceil(20)) };
        let axis = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let here = off_by(&plan.nodes()[from], axis, OFF_DEG);
        let mut replanning = replanner.clone();
        let before_ms = processor_ms();
        replanning.prepare(from)?;
        let prepared_ms = processor_ms() - before_ms;
        let before_ms = processor_ms();
        let found = replanning.replan(from, &here.as_measured(), None)?;
        let spent_ms = processor_ms() - before_ms;
        if replan < UNCOUNTED {
            continue;
        }
        let Some(found) = found else {
            missed += 1;
            continue;
        };
        times_ms.push(1e3 * found.time.as_secs_f64());
        processor.push(spent_ms);
        preparation.push(prepared_ms);
        counts.push(found.iterations as f64);
        let ahead = replanner.ahead(from, &here.as_measured(), &found.accelerations_rad_s2);
        let end = ahead.last().expect("the start at least").attitude;
        misses_deg.push(end.angle_to(&slew.target).to_degrees());
        if iterations > 0
            && let Some(optimum) = converging.clone().replan(from, &here.as_measured(), None)?
        {
            above.push(100.0 * (found.objective / optimum.objective - 1.0));
        }
    }
    let result = serde_json::json!({
        "scenario": scenario.name(),
        "joints": scenario.system().joint_count(),
        "steps": steps,
        "replans": replans,
        "missed": missed,
        "ms": summary(times_ms),
        "processor_ms": summary(processor),
        "preparation_processor_ms": summary(preparation),
        "iterations": summary(counts),
        "end_error_deg": summary(misses_deg),
        "above_optimum_percent": summary(above),
    });
    println!("{result}");
    Ok(())
}

/// A node of the plan with the attitude turned.
fn off_by(node: &Node, axis: [f64; 3], angle_deg: f64) -> Measurement {
    let norm = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
    let (sine, cosine) = (0.5 * angle_deg.to_radians()).sin_cos();
    let [x, y, z] = axis.map(|a| sine * a / norm);
    let turn = Quaternion::from_array([cosine, x, y, z]);
    Measurement {
        attitude: Quaternion::from_array(node.attitude).product(&turn).normalized(),
        joint_angles_rad: node.joint_angles_rad.clone(),
        joint_rates_rad_s: node.joint_rates_rad_s.clone(),
    }
}

/// The time that this thread has been on a processor: on a machine that others use too, that of a replan.
#[cfg(unix)]
fn processor_ms() -> f64 {
    let spent = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    1e3 * spent.tv_sec as f64 + 1e-6 * spent.tv_nsec as f64
}

#[cfg(not(unix))]
fn processor_ms() -> f64 {
    f64::NAN
}

/// Median, 99.9 % and the largest.
fn summary(mut values: Vec<f64>) -> serde_json::Value {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let last = values.len().checked_sub(1)?;
        values.get((share * last as f64).ceil() as usize).copied()
    };
    serde_json::json!({ "median": at(0.5), "p999": at(0.999), "max": at(1.0) })
}
