//! From tape instructions to machine code, with the vector registers as a cache of the register
//! file in memory.
//!
//! A result stays in a vector register until another value needs the place; the one whose next use
//! lies furthest ahead goes first (Belady's rule, optimal for straight-line code but for stores). It is written
//! to its place in memory only then, and not at all if it is dead. Operands that are in memory are
//! used from there.

use super::assembler::{Arithmetic, Assembler, Encoding, Source, Vector};
use super::cache::Cache;
use super::uses::NextUses;
use crate::function::LANES;
use crate::function::tape::{Instruction, Opcode, Register, Tape};
use crate::op::{Binary, Unary};

/// Whether machine code does this; the rest goes to the interpreter.
pub(in crate::function) fn is_native(opcode: Opcode) -> bool {
    match opcode {
        Opcode::Copy | Opcode::Select => true,
        Opcode::SinCos => false,
        Opcode::Unary(op) => matches!(op, Unary::Neg | Unary::Abs | Unary::Sqrt),
        Opcode::Binary(op) => {
            matches!(op, Binary::Add | Binary::Sub | Binary::Mul | Binary::Div)
        }
    }
}

pub(super) struct Translator<'a> {
    tape: &'a Tape,
    uses: &'a NextUses,
    vectors: u8,
    assembler: Assembler,
    cache: Cache,
}

impl<'a> Translator<'a> {
    /// For about `count` instructions.
    pub(super) fn new(
        tape: &'a Tape,
        uses: &'a NextUses,
        encoding: Encoding,
        count: usize,
    ) -> Self {
        let registers = tape.layout.registers();
        let reach = registers * size_of::<f64>() * LANES;
        Translator {
            tape,
            uses,
            vectors: encoding.registers(),
            assembler: Assembler::new(encoding, reach, TYPICAL_BYTES * count),
            cache: Cache::new(encoding.registers(), registers),
        }
    }

    /// Translates the instructions `range` of the tape into one function.
    pub(super) fn translate(mut self, range: std::ops::Range<usize>) -> Vec<u8> {
        for time in range {
            self.cache.unpin_all();
            self.instruction(time, &self.tape.instructions[time]);
        }
        for vector in 0..self.vectors {
            self.write_back(vector);
        }
        self.assembler.finish()
    }

    fn instruction(&mut self, time: usize, instruction: &Instruction) {
        let next = self.uses.operands(time);
        let [a, b, c] = instruction.registers;
        match instruction.opcode {
            Opcode::SinCos => unreachable!("not native"),
            Opcode::Copy => {
                let value = self.in_vector(a);
                self.assembler.store(offset(instruction.result), value);
                self.used(a, next[0]);
            }
            Opcode::Unary(Unary::Neg) => {
                let mask = self.tape.layout.sign_mask();
                self.two_operands(time, instruction.result, Arithmetic::Xor, [a, mask]);
            }
            Opcode::Unary(Unary::Abs) => {
                let mask = self.tape.layout.magnitude_mask();
                self.two_operands(time, instruction.result, Arithmetic::And, [a, mask]);
            }
            Opcode::Unary(_) => {
                let source = self.source(a);
                self.used(a, next[0]);
                let result = self.claim(instruction.result);
                self.assembler.square_root(result, source);
                self.finish_result(time, result);
            }
            Opcode::Binary(op) => {
                let op = match op {
                    Binary::Add => Arithmetic::Add,
                    Binary::Sub => Arithmetic::Sub,
                    Binary::Mul => Arithmetic::Mul,
                    _ => Arithmetic::Div,
                };
                self.two_operands(time, instruction.result, op, [a, b]);
            }
            Opcode::Select => {
                let condition = self.in_vector(a);
                let otherwise = self.in_vector(c);
                let if_positive = self.source(b);
                let scratch = self.free_vector();
                self.cache.pin(scratch);
                for (operand, next) in [a, b, c].into_iter().zip(next) {
                    self.used(operand, next);
                }
                let result = self.claim(instruction.result);
                let zero = self.source(self.tape.layout.zero());
                self.assembler.select(result, (condition, zero), if_positive, otherwise, scratch);
                self.finish_result(time, result);
            }
        }
    }

    fn two_operands(
        &mut self,
        time: usize,
        result: Register,
        op: Arithmetic,
        operands: [Register; 2],
    ) {
        let next = self.uses.operands(time);
        let commutes = !matches!(op, Arithmetic::Sub | Arithmetic::Div);
        let swap = commutes
            && match operands.map(|operand| self.cache.find(operand)) {
                [None, Some(_)] => true,
                // Whichever is needed sooner again is worth a vector register.
                [None, None] => next[1] < next[0],
                _ => false,
            };
        let (first, second) = if swap { (1, 0) } else { (0, 1) };
        let a = self.in_vector(operands[first]);
        let b = self.source(operands[second]);
        for (operand, next) in operands.into_iter().zip(next) {
            self.used(operand, next);
        }
        let result = self.claim(result);
        self.assembler.binary(op, result, a, b);
        self.finish_result(time, result);
    }

    /// The operand in a vector register, loaded if need be.
    fn in_vector(&mut self, operand: Register) -> Vector {
        let vector = self.cache.find(operand).unwrap_or_else(|| {
            let vector = self.free_vector();
            self.assembler.load(vector, Source::Memory(offset(operand)));
            self.cache.fill(vector, operand, false);
            vector
        });
        self.cache.pin(vector);
        vector
    }

    /// The operand wherever it is.
    fn source(&mut self, operand: Register) -> Source {
        match self.cache.find(operand) {
            Some(vector) => {
                self.cache.pin(vector);
                Source::Vector(vector)
            }
            None => Source::Memory(offset(operand)),
        }
    }

    /// Notes that the current instruction has read the operand.
    fn used(&mut self, operand: Register, next_use: u32) {
        if let Some(vector) = self.cache.find(operand) {
            self.cache.set_next_use(vector, next_use);
            if self.cache.is_finished(vector) {
                self.cache.drop(vector);
            }
        }
    }

    /// A vector register for the result. The register's former value, if any, is dead.
    fn claim(&mut self, result: Register) -> Vector {
        if let Some(stale) = self.cache.find(result) {
            self.cache.drop(stale);
        }
        let vector = self.free_vector();
        self.cache.fill(vector, result, true);
        vector
    }

    /// Notes the result's next use, once its instruction is out; outputs go to memory at once.
    fn finish_result(&mut self, time: usize, vector: Vector) {
        self.cache.set_next_use(vector, self.uses.result(time));
        if self.tape.layout.is_output(self.cache.register(vector)) {
            self.write_back(vector);
        }
        if self.cache.is_finished(vector) {
            self.cache.drop(vector);
        }
    }

    /// A vector register that holds nothing, after evicting the value needed last.
    fn free_vector(&mut self) -> Vector {
        self.cache.empty().unwrap_or_else(|| {
            let vector = self.cache.furthest();
            self.write_back(vector);
            self.cache.drop(vector);
            vector
        })
    }

    /// Brings memory up to date with a vector register.
    fn write_back(&mut self, vector: Vector) {
        if self.cache.must_be_stored(vector) {
            self.cache.set_clean(vector);
            self.assembler.store(offset(self.cache.register(vector)), vector);
        }
    }
}

/// Machine code for one instruction, loads and stores included.
const TYPICAL_BYTES: usize = 10;

/// Byte offset of a tape register in memory.
fn offset(register: Register) -> i32 {
    (register as usize * LANES * size_of::<f64>()) as i32
}
