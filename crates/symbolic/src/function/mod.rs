//! Compiled functions.

mod backend;
mod builder;
mod compile;
mod error;
mod interpreter;
mod isa;
mod native;
mod port;
mod schedule;
mod tape;
mod workspace;

use std::fmt;
use std::sync::Arc;

pub use backend::Backend;
pub use builder::FunctionBuilder;
pub use error::FunctionError;
pub use isa::InstructionSet;
pub use port::Port;
pub use workspace::Workspace;

use backend::Evaluator;
use tape::Tape;

/// Number of points evaluated side by side in a block.
///
/// One AVX-512 vector. Machine code has no dispatch to spread over more lanes, and wider blocks only
/// push the register file out of the first-level cache: 16 and 32 lanes cost a third and two thirds
/// more for the chain of `examples/chain`.
pub const LANES: usize = 8;

/// An immutable compiled function from named inputs to named outputs. Cloning shares it.
///
/// A block holds [`LANES`] points as a structure of arrays: value i of a port at lane l is element
/// `i * LANES + l`.
#[derive(Clone)]
pub struct Function(Arc<Compiled>);

struct Compiled {
    name: String,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    tape: Tape,
    evaluator: Evaluator,
}

impl Function {
    /// Starts a function; the expressions given to the builder must stay in scope until `build`.
    pub fn builder(name: &str) -> FunctionBuilder {
        FunctionBuilder::new(name)
    }

    /// The name given to [`Self::builder`].
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// The inputs in the order they were declared.
    pub fn input_ports(&self) -> &[Port] {
        &self.0.inputs
    }

    /// The outputs in the order they were declared.
    pub fn output_ports(&self) -> &[Port] {
        &self.0.outputs
    }

    /// Number of instructions executed for a block.
    pub fn instruction_count(&self) -> usize {
        self.0.tape.instructions.len()
    }

    /// Number of registers for intermediate values, ports and constants not counted.
    pub fn register_count(&self) -> usize {
        self.0.tape.layout.temporaries
    }

    /// How many instructions of each kind there are, most frequent first.
    pub fn instruction_kinds(&self) -> Vec<(&'static str, usize)> {
        self.0.tape.kinds()
    }

    /// What evaluates this function.
    pub fn backend(&self) -> Backend {
        self.0.evaluator.backend()
    }

    /// The same function evaluated in another way; `None` if this machine cannot. It needs
    /// workspaces of its own.
    pub fn with_backend(&self, backend: Backend) -> Option<Function> {
        let evaluator = Evaluator::new(&self.0.tape, backend)?;
        Some(Function(Arc::new(Compiled {
            name: self.0.name.clone(),
            inputs: self.0.inputs.clone(),
            outputs: self.0.outputs.clone(),
            tape: self.0.tape.clone(),
            evaluator,
        })))
    }

    /// Memory for one evaluation at a time; each thread needs its own.
    pub fn workspace(&self) -> Workspace {
        Workspace::new(self)
    }

    /// Evaluates one block: reads the workspace's inputs, writes its outputs. Allocates nothing.
    ///
    /// # Panics
    /// If the workspace was made for another function.
    pub fn evaluate_block(&self, workspace: &mut Workspace) {
        workspace.assert_fits(self);
        self.0.evaluator.run(&self.0.tape, workspace.registers_mut());
    }

    /// Evaluates one point. `inputs` and `outputs` hold one slice for each port. Allocates nothing.
    ///
    /// # Panics
    /// If a slice's length is not its port's, or the workspace was made for another function.
    pub fn evaluate(
        &self,
        workspace: &mut Workspace,
        inputs: &[&[f64]],
        outputs: &mut [&mut [f64]],
    ) {
        self.evaluate_batch(workspace, 1, inputs, outputs);
    }

    /// Evaluates `points` points, point-major: value i of point p is element `p * port.len() + i` of
    /// its port's slice. Allocates nothing.
    ///
    /// # Panics
    /// If a slice's length is not `points` times its port's, or the workspace was made for another
    /// function.
    pub fn evaluate_batch(
        &self,
        workspace: &mut Workspace,
        points: usize,
        inputs: &[&[f64]],
        outputs: &mut [&mut [f64]],
    ) {
        let name = self.name();
        assert_eq!(inputs.len(), self.0.inputs.len(), "{name}: number of inputs");
        assert_eq!(outputs.len(), self.0.outputs.len(), "{name}: number of outputs");
        for (port, values) in self.0.inputs.iter().zip(inputs) {
            assert_eq!(values.len(), points * port.len, "{name}: length of input {}", port.name);
        }
        for (port, values) in self.0.outputs.iter().zip(outputs.iter()) {
            assert_eq!(values.len(), points * port.len, "{name}: length of output {}", port.name);
        }
        for first in (0..points).step_by(LANES) {
            // A partial block repeats its last point, so that no lane meets arbitrary numbers.
            let last = (first + LANES).min(points) - 1;
            for (index, (port, values)) in self.0.inputs.iter().zip(inputs).enumerate() {
                let block = workspace.input_mut(index);
                for lane in 0..LANES {
                    let point = (first + lane).min(last);
                    let values = &values[point * port.len..][..port.len];
                    for (i, &value) in values.iter().enumerate() {
                        block[i * LANES + lane] = value;
                    }
                }
            }
            self.evaluate_block(workspace);
            for (index, (port, values)) in self.0.outputs.iter().zip(outputs.iter_mut()).enumerate()
            {
                let block = workspace.output(index);
                for point in first..=last {
                    let values = &mut values[point * port.len..][..port.len];
                    for (i, value) in values.iter_mut().enumerate() {
                        *value = block[i * LANES + point - first];
                    }
                }
            }
        }
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Function")
            .field("name", &self.name())
            .field("inputs", &self.input_ports())
            .field("outputs", &self.output_ports())
            .field("instructions", &self.instruction_count())
            .field("registers", &self.register_count())
            .field("backend", &self.backend())
            .finish()
    }
}

impl fmt::Display for Function {
    /// The whole tape, one instruction a line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}:", self.name())?;
        self.0.tape.fmt(f)
    }
}
