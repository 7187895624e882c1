//! Runs a tape over one block of lanes.

use super::isa::InstructionSet;
use super::tape::{Opcode, Tape};
use super::workspace::Lanes;
use crate::op::{self, Binary, Unary};
use crate::trigonometry::{self, REDUCTION_LIMIT, sin_reduced};

/// Evaluates the tape in the register file laid out by it.
pub(super) fn run(tape: &Tape, instruction_set: InstructionSet, registers: &mut [Lanes]) {
    assert_eq!(registers.len(), tape.layout.registers());
    match instruction_set {
        InstructionSet::Portable => interpret(tape, registers),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a function only gets an instruction set that this machine has.
        InstructionSet::Avx2 => unsafe { interpret_avx2(tape, registers) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        InstructionSet::Avx512 => unsafe { interpret_avx512(tape, registers) },
        #[cfg(not(target_arch = "x86_64"))]
        InstructionSet::Avx2 | InstructionSet::Avx512 => interpret(tape, registers),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn interpret_avx2(tape: &Tape, registers: &mut [Lanes]) {
    interpret(tape, registers);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn interpret_avx512(tape: &Tape, registers: &mut [Lanes]) {
    interpret(tape, registers);
}

#[inline(always)]
fn interpret(tape: &Tape, registers: &mut [Lanes]) {
    for instruction in &tape.instructions {
        let [a, b, c] = instruction.operands.map(|register| {
            debug_assert!((register as usize) < registers.len());
            // SAFETY: `Tape::new` checked every register against the layout, whose size `run`
            // compared with the slice's length.
            unsafe { *registers.get_unchecked(register as usize) }
        });
        let result = match instruction.opcode {
            Opcode::Copy => a,
            Opcode::Unary(op) => unary(op, a),
            Opcode::Binary(op) => binary(op, a, b),
            Opcode::Select => lanes(|l| op::select(a.0[l], b.0[l], c.0[l])),
        };
        // SAFETY: as above.
        unsafe { *registers.get_unchecked_mut(instruction.result as usize) = result };
    }
}

#[inline(always)]
fn lanes(value: impl Fn(usize) -> f64) -> Lanes {
    Lanes(std::array::from_fn(value))
}

#[inline(always)]
fn unary(op: Unary, x: Lanes) -> Lanes {
    match op {
        Unary::Neg => lanes(|l| -x.0[l]),
        Unary::Abs => lanes(|l| x.0[l].abs()),
        Unary::Sqrt => lanes(|l| x.0[l].sqrt()),
        Unary::Sin => circular(x, 0, trigonometry::sin),
        Unary::Cos => circular(x, 1, trigonometry::cos),
        _ => by_lane(op, x),
    }
}

#[inline(always)]
fn circular(x: Lanes, quarter_turns: u64, scalar: fn(f64) -> f64) -> Lanes {
    let in_range = x.0.iter().fold(true, |all, x| all & (x.abs() <= REDUCTION_LIMIT));
    if in_range { lanes(|l| sin_reduced(x.0[l], quarter_turns)) } else { lanes(|l| scalar(x.0[l])) }
}

#[inline(never)]
fn by_lane(op: Unary, x: Lanes) -> Lanes {
    lanes(|l| op.apply(x.0[l]))
}

#[inline(always)]
fn binary(op: Binary, x: Lanes, y: Lanes) -> Lanes {
    match op {
        Binary::Add => lanes(|l| x.0[l] + y.0[l]),
        Binary::Sub => lanes(|l| x.0[l] - y.0[l]),
        Binary::Mul => lanes(|l| x.0[l] * y.0[l]),
        Binary::Div => lanes(|l| x.0[l] / y.0[l]),
        Binary::Rem | Binary::Atan2 | Binary::Pow => by_lane_pair(op, x, y),
    }
}

#[inline(never)]
fn by_lane_pair(op: Binary, x: Lanes, y: Lanes) -> Lanes {
    lanes(|l| op.apply(x.0[l], y.0[l]))
}
