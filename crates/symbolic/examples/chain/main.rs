//! Size and speed of the derivatives of a 7-joint chain: `cargo run --release --example chain`.

mod model;

use std::time::Instant;

use righting_symbolic::{Backend, Graph, LANES};

/// Points evaluated in a timed pass: four stages of 600 intervals.
const POINTS: usize = 4 * 600;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let joints = std::env::args().nth(1).map_or(Ok(7), |text| text.parse())?;
    let function = {
        let _scope = Graph::scope();
        let start = Instant::now();
        let derivatives = model::differentiate(joints);
        println!("traced     {:9.3?}, {} nodes", start.elapsed(), Graph::node_count());
        let start = Instant::now();
        let function = model::compile(&derivatives)?;
        println!("compiled   {:9.3?}", start.elapsed());
        function
    };
    println!(
        "{} instructions, {} registers: {:?}",
        function.instruction_count(),
        function.register_count(),
        function.instruction_kinds()
    );
    for backend in Backend::available() {
        let Some(function) = function.with_backend(backend) else { continue };
        let mut workspace = function.workspace();
        for port in 0..function.input_ports().len() {
            for (i, value) in workspace.input_mut(port).iter_mut().enumerate() {
                *value = 0.3 + 0.01 * ((i * 7919) % 101) as f64;
            }
        }
        // The fastest single block: a busy machine interrupts longer measurements.
        let fastest = (0..2000)
            .map(|_| {
                let start = Instant::now();
                function.evaluate_block(&mut workspace);
                start.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        let blocks = POINTS.div_ceil(LANES) as f64;
        println!("{:8.3} ms for {POINTS} points, {backend:?}", fastest * blocks * 1e3);
    }
    Ok(())
}
