//! The instruction list.

use std::collections::BTreeMap;
use std::fmt;

use crate::op::{Binary, Unary};

/// A register: [`LANES`](super::LANES) consecutive numbers of the workspace.
pub(super) type Register = u32;

/// What an instruction does with its operands a, b, c.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Opcode {
    Copy,
    /// Two results from one operand.
    SinCos,
    Unary(Unary),
    Binary(Binary),
    Select,
}

impl Opcode {
    pub(super) fn name(self) -> &'static str {
        match self {
            Opcode::Copy => "copy",
            Opcode::SinCos => "sin_cos",
            Opcode::Unary(op) => op.name(),
            Opcode::Binary(op) => op.name(),
            Opcode::Select => "select",
        }
    }

    fn operand_count(self) -> usize {
        match self {
            Opcode::Copy | Opcode::SinCos | Opcode::Unary(_) => 1,
            Opcode::Binary(_) => 2,
            Opcode::Select => 3,
        }
    }
}

#[derive(Copy, Clone, Debug)]
pub(super) struct Instruction {
    pub opcode: Opcode,
    pub result: Register,
    /// The operands; after the one of [`Opcode::SinCos`], the register of the cosine.
    pub registers: [Register; 3],
}

impl Instruction {
    pub(super) fn operands(&self) -> &[Register] {
        &self.registers[..self.opcode.operand_count()]
    }

    pub(super) fn second_result(&self) -> Option<Register> {
        (self.opcode == Opcode::SinCos).then_some(self.registers[1])
    }
}

/// The register file: inputs, then outputs, constants and temporaries.
#[derive(Copy, Clone, Debug, Default)]
pub(super) struct RegisterFile {
    pub inputs: usize,
    pub outputs: usize,
    pub constants: usize,
    pub temporaries: usize,
}

impl RegisterFile {
    pub(super) fn registers(&self) -> usize {
        self.inputs + self.outputs + self.constants + self.temporaries
    }

    pub(super) fn first_output(&self) -> usize {
        self.inputs
    }

    pub(super) fn first_constant(&self) -> usize {
        self.inputs + self.outputs
    }

    pub(super) fn first_temporary(&self) -> usize {
        self.first_constant() + self.constants
    }

    pub(super) fn is_output(&self, register: Register) -> bool {
        (self.first_output()..self.first_constant()).contains(&(register as usize))
    }

    /// Holds 0.0.
    pub(super) fn zero(&self) -> Register {
        self.first_constant() as Register
    }

    /// Holds the sign bit alone.
    pub(super) fn sign_mask(&self) -> Register {
        self.zero() + 1
    }

    /// Holds every bit but the sign.
    pub(super) fn magnitude_mask(&self) -> Register {
        self.zero() + 2
    }
}

/// The constants that every tape starts with, for machine code: see [`RegisterFile::zero`] and those after.
pub(super) const MASKS: [f64; 3] = [0.0, -0.0, f64::from_bits(u64::MAX >> 1)];

/// A straight-line program over one register file. Every register index is below
/// `layout.registers()`: [`Tape::new`] checks it, and machine code relies on it.
#[derive(Clone, Debug)]
pub(super) struct Tape {
    pub layout: RegisterFile,
    pub constants: Vec<f64>,
    pub instructions: Vec<Instruction>,
}

impl Tape {
    pub(super) fn new(
        layout: RegisterFile,
        constants: Vec<f64>,
        instructions: Vec<Instruction>,
    ) -> Self {
        let count = layout.registers();
        assert_eq!(constants.len(), layout.constants);
        for instruction in &instructions {
            let registers = instruction.registers;
            assert!((instruction.result as usize) < count);
            assert!(registers.iter().all(|&register| (register as usize) < count));
        }
        Tape { layout, constants, instructions }
    }

    /// Computes nothing.
    pub(super) fn empty() -> Self {
        let layout = RegisterFile { constants: MASKS.len(), ..RegisterFile::default() };
        Self::new(layout, MASKS.to_vec(), Vec::new())
    }

    pub(super) fn kinds(&self) -> Vec<(&'static str, usize)> {
        let mut counts = BTreeMap::new();
        for instruction in &self.instructions {
            *counts.entry(instruction.opcode.name()).or_insert(0) += 1;
        }
        let mut kinds: Vec<_> = counts.into_iter().collect();
        kinds.sort_by_key(|&(name, count)| (std::cmp::Reverse(count), name));
        kinds
    }

    fn register_name(&self, register: Register) -> String {
        let register = register as usize;
        let layout = &self.layout;
        if register < layout.first_output() {
            format!("in[{register}]")
        } else if register < layout.first_constant() {
            format!("out[{}]", register - layout.first_output())
        } else if register < layout.first_temporary() {
            format!("{:?}", self.constants[register - layout.first_constant()])
        } else {
            format!("r{}", register - layout.first_temporary())
        }
    }
}

impl fmt::Display for Tape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for instruction in &self.instructions {
            write!(f, "  {}", self.register_name(instruction.result))?;
            if let Some(second) = instruction.second_result() {
                write!(f, " {}", self.register_name(second))?;
            }
            write!(f, " = {}", instruction.opcode.name())?;
            for &operand in instruction.operands() {
                write!(f, " {}", self.register_name(operand))?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
