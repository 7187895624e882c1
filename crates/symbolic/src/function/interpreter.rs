//! Runs instructions of a tape over one block of lanes: the path for machines without machine code
//! of our own, and the reference for those that have it.
#![expect(unsafe_code, reason = "calls functions compiled for what the machine has")]

use std::ops::Range;

use super::LANES;
use super::isa::InstructionSet;
use super::tape::{Instruction, Opcode, Tape};
use super::workspace::Lanes;
use crate::op::{self, Binary, Unary};
use crate::trigonometry::{self, REDUCTION_LIMIT, sin_cos_reduced};

/// Evaluates a stretch of the tape in the register file laid out by it.
pub(super) fn run(
    tape: &Tape,
    range: Range<usize>,
    instruction_set: InstructionSet,
    registers: &mut [Lanes],
) {
    assert_eq!(registers.len(), tape.layout.registers());
    let instructions = &tape.instructions[range];
    match instruction_set {
        InstructionSet::Portable => interpret(instructions, registers),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a function only gets an instruction set that this machine has.
        InstructionSet::Avx2 => unsafe { interpret_avx2(instructions, registers) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        InstructionSet::Avx512 => unsafe { interpret_avx512(instructions, registers) },
        #[cfg(not(target_arch = "x86_64"))]
        InstructionSet::Avx2 | InstructionSet::Avx512 => interpret(instructions, registers),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn interpret_avx2(instructions: &[Instruction], registers: &mut [Lanes]) {
    interpret(instructions, registers);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn interpret_avx512(instructions: &[Instruction], registers: &mut [Lanes]) {
    interpret(instructions, registers);
}

/// Evaluates an expression for each lane `l`. A macro, since a closure's code would not be compiled
/// for the instruction set of the function around it.
macro_rules! lanes {
    ($l:ident => $value:expr) => {{
        let mut result = [0.0; LANES];
        for ($l, result) in result.iter_mut().enumerate() {
            *result = $value;
        }
        result
    }};
}

/// The sines and the cosines of the lanes.
macro_rules! sin_cos {
    ($x:expr) => {{
        let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
        if all_reducible($x) {
            for (l, (sine, cosine)) in sines.iter_mut().zip(&mut cosines).enumerate() {
                (*sine, *cosine) = sin_cos_reduced($x[l]);
            }
        } else {
            sines = lanes!(l => trigonometry::sin($x[l]));
            cosines = lanes!(l => trigonometry::cos($x[l]));
        }
        (sines, cosines)
    }};
}

#[inline(always)]
fn interpret(instructions: &[Instruction], registers: &mut [Lanes]) {
    for instruction in instructions {
        let [a, b, c] = instruction.registers;
        let result = instruction.result;
        macro_rules! at {
            ($register:expr) => {
                registers[$register as usize]
            };
        }
        // Each operation loads and stores by itself: what is shared by branches goes through the stack.
        macro_rules! unary {
            ($x:ident => $value:expr) => {{
                let operand = &at!(a);
                at!(result) = lanes!(l => { let $x = operand[l]; $value });
            }};
        }
        macro_rules! binary {
            ($x:ident, $y:ident => $value:expr) => {{
                let (first, second) = (&at!(a), &at!(b));
                at!(result) = lanes!(l => { let ($x, $y) = (first[l], second[l]); $value });
            }};
        }
        match instruction.opcode {
            Opcode::Binary(Binary::Add) => binary!(x, y => x + y),
            Opcode::Binary(Binary::Sub) => binary!(x, y => x - y),
            Opcode::Binary(Binary::Mul) => binary!(x, y => x * y),
            Opcode::Binary(Binary::Div) => binary!(x, y => x / y),
            Opcode::Binary(op) => at!(result) = binary(op, &at!(a), &at!(b)),
            Opcode::Unary(Unary::Neg) => unary!(x => -x),
            Opcode::Unary(Unary::Abs) => unary!(x => x.abs()),
            Opcode::Unary(Unary::Sqrt) => unary!(x => x.sqrt()),
            Opcode::Unary(Unary::Sin) => at!(result) = sin_cos!(&at!(a)).0,
            Opcode::Unary(Unary::Cos) => at!(result) = sin_cos!(&at!(a)).1,
            Opcode::Unary(op) => at!(result) = unary(op, &at!(a)),
            Opcode::SinCos => {
                let (sines, cosines) = sin_cos!(&at!(a));
                at!(result) = sines;
                at!(b) = cosines;
            }
            Opcode::Select => {
                let (x, y, z) = (&at!(a), &at!(b), &at!(c));
                at!(result) = lanes!(l => op::select(x[l], y[l], z[l]));
            }
            Opcode::Copy => at!(result) = at!(a),
        }
    }
}

#[inline(always)]
fn all_reducible(x: &[f64; LANES]) -> bool {
    x.iter().fold(true, |all, x| all & (x.abs() <= REDUCTION_LIMIT))
}

#[inline(never)]
fn unary(op: Unary, x: &[f64; LANES]) -> [f64; LANES] {
    lanes!(l => op.apply(x[l]))
}

#[inline(never)]
fn binary(op: Binary, x: &[f64; LANES], y: &[f64; LANES]) -> [f64; LANES] {
    lanes!(l => op.apply(x[l], y[l]))
}
