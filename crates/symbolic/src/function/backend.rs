//! What evaluates a function.

use super::interpreter;
use super::isa::InstructionSet;
use super::native::Native;
use super::tape::Tape;
use super::workspace::Lanes;

/// A way to evaluate functions; results do not depend on it. NaNs stay NaNs, but not their bits.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Backend {
    /// A loop over the instructions.
    Interpreter(InstructionSet),
    /// Machine code made when the function is built; sines, cosines and other transcendental
    /// functions stay with the interpreter.
    Native(InstructionSet),
}

impl Backend {
    /// All that work on this machine, the fastest last.
    pub fn available() -> Vec<Backend> {
        let sets = InstructionSet::ALL.into_iter().filter(|set| set.is_available());
        let interpreters = sets.clone().map(Backend::Interpreter);
        let native = sets.filter(|&set| Native::new(&Tape::empty(), set).is_some());
        interpreters.chain(native.map(Backend::Native)).collect()
    }
}

/// A backend, ready to run one tape.
#[derive(Debug)]
pub(super) enum Evaluator {
    Interpreter(InstructionSet),
    Native(Native),
}

impl Evaluator {
    /// The fastest one.
    pub(super) fn best(tape: &Tape) -> Self {
        let set = InstructionSet::detect();
        Native::new(tape, set).map_or(Evaluator::Interpreter(set), Evaluator::Native)
    }

    /// `None` if this machine cannot run it.
    pub(super) fn new(tape: &Tape, backend: Backend) -> Option<Self> {
        match backend {
            Backend::Interpreter(set) => set.is_available().then_some(Evaluator::Interpreter(set)),
            Backend::Native(set) => Native::new(tape, set).map(Evaluator::Native),
        }
    }

    pub(super) fn backend(&self) -> Backend {
        match self {
            Evaluator::Interpreter(set) => Backend::Interpreter(*set),
            Evaluator::Native(native) => Backend::Native(native.instruction_set()),
        }
    }

    pub(super) fn run(&self, tape: &Tape, registers: &mut [Lanes]) {
        match self {
            Evaluator::Interpreter(set) => {
                interpreter::run(tape, 0..tape.instructions.len(), *set, registers);
            }
            Evaluator::Native(native) => native.run(tape, registers),
        }
    }
}
