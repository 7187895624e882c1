//! When each value of a tape is used next.

use crate::function::tape::Tape;

/// The time of a use by whoever reads the outputs.
pub(super) const AFTER_THE_END: u32 = u32::MAX - 1;
const NEVER: u32 = u32::MAX;

/// For each instruction, when its operands and its result are needed next.
pub(super) struct NextUses {
    operands: Vec<[u32; 3]>,
    results: Vec<u32>,
}

impl NextUses {
    pub(super) fn of(tape: &Tape) -> Self {
        let count = tape.instructions.len();
        let mut next = vec![NEVER; tape.layout.registers()];
        next[tape.layout.first_output()..][..tape.layout.outputs].fill(AFTER_THE_END);
        let mut uses = NextUses { operands: vec![[NEVER; 3]; count], results: vec![NEVER; count] };
        for (time, instruction) in tape.instructions.iter().enumerate().rev() {
            let result = &mut next[instruction.result as usize];
            uses.results[time] = std::mem::replace(result, NEVER);
            if let Some(second) = instruction.second_result() {
                next[second as usize] = NEVER;
            }
            let operands = instruction.operands();
            for (slot, &operand) in uses.operands[time].iter_mut().zip(operands) {
                *slot = next[operand as usize];
            }
            for &operand in operands {
                next[operand as usize] = time as u32;
            }
        }
        uses
    }

    pub(super) fn operands(&self, time: usize) -> [u32; 3] {
        self.operands[time]
    }

    pub(super) fn result(&self, time: usize) -> u32 {
        self.results[time]
    }
}
