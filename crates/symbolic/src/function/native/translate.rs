//! From tape instructions to machine code, with the vector registers as a cache of the register
//! file in memory.
//!
//! A result stays in a vector register until another value needs the place; the one whose next use
//! lies furthest ahead goes first (Belady's rule, optimal for straight-line code but for stores). It is written
//! to its place in memory only then, and not at all if it is dead. Operands that are in memory are
//! used from there.

use super::assembler::{Arithmetic, Assembler, Encoding, Source, Vector};
use super::uses::{AFTER_THE_END, NextUses};
use crate::function::LANES;
use crate::function::tape::{Instruction, Opcode, Register, Tape};
use crate::op::{Binary, Unary};

/// Whether machine code does this; the rest goes to the interpreter.
pub(super) fn is_native(opcode: Opcode) -> bool {
    match opcode {
        Opcode::Copy | Opcode::Select => true,
        Opcode::Unary(op) => matches!(op, Unary::Neg | Unary::Abs | Unary::Sqrt),
        Opcode::Binary(op) => {
            matches!(op, Binary::Add | Binary::Sub | Binary::Mul | Binary::Div)
        }
    }
}

/// What a vector register holds.
#[derive(Copy, Clone)]
struct Cached {
    register: Register,
    next_use: u32,
    /// Memory does not have the value yet.
    dirty: bool,
}

pub(super) struct Translator<'a> {
    tape: &'a Tape,
    uses: &'a NextUses,
    assembler: Assembler,
    /// By vector register.
    cache: Vec<Option<Cached>>,
    /// By tape register.
    vector_of: Vec<Option<Vector>>,
    /// Vector registers that the current instruction reads or writes.
    pinned: u32,
}

impl<'a> Translator<'a> {
    pub(super) fn new(tape: &'a Tape, uses: &'a NextUses, encoding: Encoding) -> Self {
        let registers = tape.layout.registers();
        let reach = registers * size_of::<f64>() * LANES;
        Translator {
            tape,
            uses,
            assembler: Assembler::new(encoding, reach, 10 * tape.instructions.len()),
            cache: vec![None; usize::from(encoding.registers())],
            vector_of: vec![None; registers],
            pinned: 0,
        }
    }

    /// Translates the instructions `range` of the tape into one function.
    pub(super) fn translate(mut self, range: std::ops::Range<usize>) -> Vec<u8> {
        for time in range {
            self.instruction(time, &self.tape.instructions[time]);
        }
        for vector in 0..self.cache.len() as Vector {
            self.write_back(vector);
        }
        self.assembler.finish()
    }

    fn instruction(&mut self, time: usize, instruction: &Instruction) {
        let next = self.uses.operands(time);
        let [a, b, c] = instruction.operands;
        self.pinned = 0;
        match instruction.opcode {
            Opcode::Copy => {
                let value = self.in_vector(a, next[0]);
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
                let condition = self.in_vector(a, next[0]);
                let otherwise = self.in_vector(c, next[2]);
                let if_positive = self.source(b);
                let scratch = self.free_vector();
                self.pinned |= 1 << scratch;
                for (operand, next) in instruction.operands.into_iter().zip(next) {
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
            && match operands.map(|operand| self.vector_of[operand as usize]) {
                [None, Some(_)] => true,
                // Whichever is needed sooner again is worth a vector register.
                [None, None] => next[1] < next[0],
                _ => false,
            };
        let (first, second) = if swap { (1, 0) } else { (0, 1) };
        let a = self.in_vector(operands[first], next[first]);
        let b = self.source(operands[second]);
        for (operand, next) in operands.into_iter().zip(next) {
            self.used(operand, next);
        }
        let result = self.claim(result);
        self.assembler.binary(op, result, a, b);
        self.finish_result(time, result);
    }

    /// The operand in a vector register, loaded if need be.
    fn in_vector(&mut self, operand: Register, next_use: u32) -> Vector {
        let vector = self.vector_of[operand as usize].unwrap_or_else(|| {
            let vector = self.free_vector();
            self.assembler.load(vector, Source::Memory(offset(operand)));
            self.cache[usize::from(vector)] =
                Some(Cached { register: operand, next_use, dirty: false });
            self.vector_of[operand as usize] = Some(vector);
            vector
        });
        self.pinned |= 1 << vector;
        vector
    }

    /// The operand wherever it is.
    fn source(&mut self, operand: Register) -> Source {
        match self.vector_of[operand as usize] {
            Some(vector) => {
                self.pinned |= 1 << vector;
                Source::Vector(vector)
            }
            None => Source::Memory(offset(operand)),
        }
    }

    /// Notes that the current instruction has read the operand.
    fn used(&mut self, operand: Register, next_use: u32) {
        let Some(vector) = self.vector_of[operand as usize] else { return };
        let cached = self.cache[usize::from(vector)].as_mut().expect("the two maps agree");
        cached.next_use = next_use;
        if next_use > AFTER_THE_END || (next_use == AFTER_THE_END && !cached.dirty) {
            self.cache[usize::from(vector)] = None;
            self.vector_of[operand as usize] = None;
            // The operand has been read by the time the result is written.
            self.pinned &= !(1 << vector);
        }
    }

    /// A vector register for the result. The register's former value, if any, is dead.
    fn claim(&mut self, result: Register) -> Vector {
        if let Some(stale) = self.vector_of[result as usize].take() {
            self.cache[usize::from(stale)] = None;
        }
        let vector = self.free_vector();
        self.cache[usize::from(vector)] =
            Some(Cached { register: result, next_use: 0, dirty: true });
        self.vector_of[result as usize] = Some(vector);
        vector
    }

    /// Notes the result's next use, once its instruction is out; outputs go to memory at once.
    fn finish_result(&mut self, time: usize, vector: Vector) {
        let cached = self.cache[usize::from(vector)].as_mut().expect("just claimed");
        cached.next_use = self.uses.result(time);
        if self.tape.layout.is_output(cached.register) {
            self.write_back(vector);
        }
        let cached = self.cache[usize::from(vector)].expect("just claimed");
        if cached.next_use >= AFTER_THE_END && !cached.dirty {
            self.cache[usize::from(vector)] = None;
            self.vector_of[cached.register as usize] = None;
        }
    }

    /// A vector register that holds nothing, after evicting the value needed last.
    fn free_vector(&mut self) -> Vector {
        let mut best: Option<(Vector, u32, bool)> = None;
        for (vector, cached) in self.cache.iter().enumerate() {
            if self.pinned >> vector & 1 == 1 {
                continue;
            }
            let Some(cached) = cached else { return vector as Vector };
            let key = (cached.next_use, !cached.dirty);
            if best.is_none_or(|(_, next_use, clean)| key > (next_use, clean)) {
                best = Some((vector as Vector, key.0, key.1));
            }
        }
        let (vector, ..) = best.expect("more vector registers than operands");
        self.write_back(vector);
        let evicted = self.cache[usize::from(vector)].take().expect("chosen because it is full");
        self.vector_of[evicted.register as usize] = None;
        vector
    }

    /// Brings memory up to date with a vector register.
    fn write_back(&mut self, vector: Vector) {
        if let Some(cached) = &mut self.cache[usize::from(vector)]
            && cached.dirty
            && cached.next_use <= AFTER_THE_END
        {
            cached.dirty = false;
            self.assembler.store(offset(cached.register), vector);
        }
    }
}

/// Byte offset of a tape register in memory.
fn offset(register: Register) -> i32 {
    (register as usize * LANES * size_of::<f64>()) as i32
}
