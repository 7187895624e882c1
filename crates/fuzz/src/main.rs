//! `righting-fuzz TARGET…`: so many inputs of a seed, and what became of them.
//!
//! The same seed and number make the same input on every machine. Exits with 1 at the first input that breaks a
//! property, after it printed the arguments that run that input alone.
#![forbid(unsafe_code)]

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::{Parser, ValueEnum};
use rand::rngs::ChaCha8Rng;
use rand::{Rng, RngExt, SeedableRng};
use righting_fuzz::{Outcome, Target, Workspace};

/// Longest input, bytes.
const LONGEST: usize = 4096;
/// An input that takes longer hangs.
const HANGS_AFTER: Duration = Duration::from_secs(60);

/// Hostile and random inputs for every reader and for whole solves.
#[derive(Parser)]
struct Arguments {
    /// What to make inputs for; everything if nothing is said.
    #[arg(value_enum)]
    targets: Vec<Target>,
    /// Which inputs.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The number of the first.
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// How many for each target.
    #[arg(long, default_value_t = 1000)]
    inputs: u64,
    /// Address space that the program may take, MiB: an allocation beyond it ends the run.
    #[arg(long, default_value_t = 4096)]
    memory_mib: u64,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    limit_memory(arguments.memory_mib);
    righting_ipopt::use_one_blas_thread().expect("Ipopt");
    let workspace = Workspace::new().expect("a temporary folder");
    let targets = match arguments.targets.as_slice() {
        [] => Target::value_variants(),
        some => some,
    };
    for &target in targets {
        if !run(target, &arguments, &workspace) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Runs the inputs of a target; whether all kept their properties.
fn run(target: Target, arguments: &Arguments, workspace: &Workspace) -> bool {
    let named = target.to_possible_value().expect("none is hidden");
    let Arguments { seed, first, inputs, .. } = *arguments;
    let name = named.get_name();
    let alone = move |number| format!("{name} --seed {seed} --first {number} --inputs 1");
    let watch = Watch::start(alone(first));
    let mut outcomes: BTreeMap<Outcome, u64> = BTreeMap::new();
    let (started, mut slowest) = (Instant::now(), (Duration::ZERO, first));
    for number in first..first + inputs {
        watch.next(&alone(number));
        let began = Instant::now();
        match target.check(&bytes(seed, number), workspace) {
            Ok(outcome) => *outcomes.entry(outcome).or_default() += 1,
            Err(problem) => {
                eprintln!("{problem}\nrighting-fuzz {}", alone(number));
                return false;
            }
        }
        slowest = slowest.max((began.elapsed(), number));
    }
    let counts: Vec<String> =
        outcomes.iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
    println!(
        "{name}: {inputs} inputs in {:.1} s: {}; slowest {:.2} s ({})",
        started.elapsed().as_secs_f64(),
        counts.join(", "),
        slowest.0.as_secs_f64(),
        slowest.1
    );
    true
}

/// The bytes of an input: many short ones, some long.
fn bytes(seed: u64, number: u64) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    let length = random.random_range(0..=LONGEST);
    let mut bytes = vec![0; length];
    random.fill_bytes(&mut bytes);
    bytes
}

/// Ends the process at an input that hangs.
struct Watch {
    inputs: Arc<AtomicU64>,
    running: Arc<std::sync::Mutex<String>>,
}

impl Watch {
    fn start(first: String) -> Self {
        let watch =
            Self { inputs: Arc::default(), running: Arc::new(std::sync::Mutex::new(first)) };
        let (inputs, running) = (Arc::clone(&watch.inputs), Arc::clone(&watch.running));
        std::thread::spawn(move || {
            loop {
                let before = inputs.load(Ordering::Relaxed);
                std::thread::sleep(HANGS_AFTER);
                // The target has ended, and with it what is watched.
                if Arc::strong_count(&inputs) == 1 {
                    return;
                }
                if inputs.load(Ordering::Relaxed) == before {
                    let input = running.lock().map(|input| input.clone()).unwrap_or_default();
                    eprintln!("no end after {HANGS_AFTER:?}\nrighting-fuzz {input}");
                    std::process::exit(1);
                }
            }
        });
        watch
    }

    fn next(&self, input: &str) {
        self.inputs.fetch_add(1, Ordering::Relaxed);
        if let Ok(mut running) = self.running.lock() {
            input.clone_into(&mut running);
        }
    }
}

#[cfg(unix)]
fn limit_memory(mib: u64) {
    use rustix::process::{Resource, Rlimit, setrlimit};
    let limit = Rlimit { current: Some(mib << 20), maximum: Some(mib << 20) };
    setrlimit(Resource::As, limit).expect("a lower limit is always allowed");
}

#[cfg(not(unix))]
fn limit_memory(_: u64) {}
