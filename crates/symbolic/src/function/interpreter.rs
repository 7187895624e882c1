//! Runs instructions of a tape over one block of lanes: the path for machines without machine code
//! of our own, and the reference for those that have it.
#![expect(unsafe_code, reason = "registers are checked once, when the tape is made")]

use std::ops::Range;

use super::LANES;
use super::isa::InstructionSet;
use super::tape::{Instruction, Opcode, Register, Tape};
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
    let count = registers.len();
    let registers = registers.as_mut_ptr();
    let at = |register: Register| {
        debug_assert!((register as usize) < count);
        // SAFETY: `Tape::new` checked every register against the layout, whose size `run` compared
        // with the slice's length.
        unsafe { registers.add(register as usize) }
    };
    // Each operation stores its own result: one store after the branches would go through the stack.
    macro_rules! store {
        ($register:expr, $lanes:expr) => {{
            let lanes = $lanes;
            // SAFETY: `at` points into the slice, and no reference to it is alive.
            unsafe { *at($register) = Lanes(lanes) }
        }};
    }
    for instruction in instructions {
        let [a, b, c] = instruction.registers;
        let result = instruction.result;
        // SAFETY: as in `store`.
        let load = |register| unsafe { (*at(register)).0 };
        match instruction.opcode {
            Opcode::Binary(op) => {
                let (x, y) = (load(a), load(b));
                match op {
                    Binary::Add => store!(result, lanes!(l => x[l] + y[l])),
                    Binary::Sub => store!(result, lanes!(l => x[l] - y[l])),
                    Binary::Mul => store!(result, lanes!(l => x[l] * y[l])),
                    Binary::Div => store!(result, lanes!(l => x[l] / y[l])),
                    op => store!(result, binary(op, &x, &y)),
                }
            }
            Opcode::Unary(op) => {
                let x = load(a);
                match op {
                    Unary::Neg => store!(result, lanes!(l => -x[l])),
                    Unary::Abs => store!(result, lanes!(l => x[l].abs())),
                    Unary::Sqrt => store!(result, lanes!(l => x[l].sqrt())),
                    Unary::Sin => store!(result, sin_cos!(&x).0),
                    Unary::Cos => store!(result, sin_cos!(&x).1),
                    op => store!(result, unary(op, &x)),
                }
            }
            Opcode::SinCos => {
                let x = load(a);
                let (sines, cosines) = sin_cos!(&x);
                store!(result, sines);
                store!(b, cosines);
            }
            Opcode::Select => {
                let (x, y, z) = (load(a), load(b), load(c));
                store!(result, lanes!(l => op::select(x[l], y[l], z[l])));
            }
            Opcode::Copy => store!(result, load(a)),
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
