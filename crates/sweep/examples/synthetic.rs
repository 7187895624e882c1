//! Records for every case of a planned sweep without planning any: to see what merging millions costs.
//!
//! ```sh
//! righting sweep plan FILE --out DIR
//! cargo run --release -p righting-sweep --example synthetic -- DIR 8
//! /usr/bin/time -v righting sweep merge DIR
//! ```

use std::error::Error;
use std::path::Path;

use righting_sweep::{CaseStatus, Flown, Outcome, Record, RunFacts, Shard, SweepFolder};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, shards] = arguments.as_slice() else {
        return Err("usage: synthetic DIR SHARDS".into());
    };
    let folder = SweepFolder::at(Path::new(folder));
    let sweep = folder.sweep()?;
    for i in 1..=shards.parse::<usize>()? {
        let shard: Shard = format!("{i}/{shards}").parse()?;
        let mut journal = folder.journal(shard)?;
        for index in shard.indices(sweep.len()) {
            let wave = (index as f64).sin();
            let fails = index % 50 == 0;
            journal.append(&Record {
                case_id: sweep.case(index).id,
                outcome: Outcome {
                    status: CaseStatus::Flown(Flown::Flown),
                    verified: !fails,
                    attitude_error: 1e-3 * wave.abs(),
                    final_rate_deg_s: 1e-5 * wave * wave,
                    joint_rate_deg_s: 1e-4 * wave.cos().abs(),
                    objective: 1e-6 * (wave + 2.0),
                    iterations: index % 30,
                    reason: fails.then(|| format!("attitude error at the end: {wave:e}")),
                },
                run: RunFacts { solve_s: 0.1 + 0.01 * wave, attempts: 1 },
            })?;
        }
        journal.sync()?;
    }
    Ok(())
}
