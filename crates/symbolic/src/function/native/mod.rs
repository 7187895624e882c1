//! A tape as machine code.
//!
//! Straight-line code for one vector of points, a tape register a memory slot. For the chain of
//! `examples/chain` it completes 1.4 arithmetic operations a cycle of the two that the machine could
//! start, and is over twenty times as fast as the interpreter. Making it takes 27 ns an instruction;
//! with the encoder of iced-x86, whose decoder checks ours, 67 ns.
#![expect(unsafe_code, reason = "calls generated code")]

mod assembler;
mod cache;
mod memory;
mod translate;
mod uses;

use std::ops::Range;

use super::interpreter;
use super::isa::InstructionSet;
use super::tape::Tape;
use super::workspace::Lanes;
use assembler::Encoding;
use memory::Code;
use translate::Translator;
pub(super) use translate::is_native;
use uses::NextUses;

/// Machine code for the arithmetic of a tape; the operations it does not know stay interpreted.
#[derive(Debug)]
pub(super) struct Native {
    instruction_set: InstructionSet,
    encoding: Encoding,
    code: Code,
    parts: Vec<Part>,
}

/// A stretch of the tape.
#[derive(Debug)]
enum Part {
    /// Where its code starts.
    Compiled(usize),
    Interpreted(Range<usize>),
}

impl Native {
    /// `None` if the machine lacks the instructions or forbids executable memory, or if the register
    /// file is beyond the reach of 32-bit offsets.
    pub(super) fn new(tape: &Tape, instruction_set: InstructionSet) -> Option<Self> {
        let encoding = match instruction_set {
            InstructionSet::Avx512 => Encoding::Evex,
            InstructionSet::Avx2 => Encoding::Vex,
            InstructionSet::Portable => return None,
        };
        let bytes = tape.layout.registers() * size_of::<Lanes>();
        if !instruction_set.is_available() || i32::try_from(bytes).is_err() {
            return None;
        }
        let uses = NextUses::of(tape);
        let mut parts = Vec::new();
        let mut code: Vec<u8> = Vec::new();
        let mut start = 0;
        for run in tape.instructions.chunk_by(|a, b| is_native(a.opcode) == is_native(b.opcode)) {
            let range = start..start + run.len();
            start = range.end;
            if is_native(run[0].opcode) {
                code.resize(code.len().next_multiple_of(64), 0xCC);
                parts.push(Part::Compiled(code.len()));
                let translator = Translator::new(tape, &uses, encoding, run.len());
                code.extend(translator.translate(range));
            } else {
                parts.push(Part::Interpreted(range));
            }
        }
        Some(Native { instruction_set, encoding, code: Code::new(&code)?, parts })
    }

    pub(super) fn instruction_set(&self) -> InstructionSet {
        self.instruction_set
    }

    /// Evaluates the tape this was made from.
    pub(super) fn run(&self, tape: &Tape, registers: &mut [Lanes]) {
        assert_eq!(registers.len(), tape.layout.registers());
        for part in &self.parts {
            match part {
                Part::Interpreted(range) => {
                    interpreter::run(tape, range.clone(), self.instruction_set, registers);
                }
                Part::Compiled(start) => {
                    for lane in (0..super::LANES).step_by(self.encoding.lanes()) {
                        let block = registers.as_mut_ptr().cast::<f64>();
                        // SAFETY: the code was translated from this tape, whose registers `Tape::new`
                        // checked against the layout and the assertion above against the block; it
                        // reads and writes the lanes from `lane` on only, and it was made only if
                        // this machine has the instructions.
                        unsafe { self.code.call(*start, block.add(lane)) };
                    }
                }
            }
        }
    }
}
