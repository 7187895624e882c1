//! Which values the vector registers hold.

use super::assembler::Vector;
use super::uses::AFTER_THE_END;
use crate::function::tape::Register;

/// No more vector registers than bits in a mask.
const MOST_VECTORS: usize = 32;
const NOWHERE: Vector = Vector::MAX;

/// The vector registers as a cache of the register file in memory. It decides; the translator emits
/// the loads and stores.
pub(super) struct Cache {
    /// Bit by vector register, as all masks here: those that exist.
    existing: u32,
    full: u32,
    /// Memory does not have the value yet.
    dirty: u32,
    /// The current instruction reads or writes it: not to be evicted.
    pinned: u32,
    /// By vector register.
    register: [Register; MOST_VECTORS],
    /// By vector register: when the value is needed again.
    next_use: [u32; MOST_VECTORS],
    /// By tape register.
    vector: Vec<Vector>,
}

impl Cache {
    pub(super) fn new(vectors: u8, registers: usize) -> Self {
        Cache {
            existing: u32::MAX >> (MOST_VECTORS - usize::from(vectors)),
            full: 0,
            dirty: 0,
            pinned: 0,
            register: [0; MOST_VECTORS],
            next_use: [0; MOST_VECTORS],
            vector: vec![NOWHERE; registers],
        }
    }

    pub(super) fn unpin_all(&mut self) {
        self.pinned = 0;
    }

    pub(super) fn pin(&mut self, vector: Vector) {
        self.pinned |= 1 << vector;
    }

    /// Where a tape register's value is.
    pub(super) fn find(&self, register: Register) -> Option<Vector> {
        let vector = self.vector[register as usize];
        (vector != NOWHERE).then_some(vector)
    }

    pub(super) fn register(&self, vector: Vector) -> Register {
        self.register[usize::from(vector)]
    }

    /// An empty vector register, if there is one.
    pub(super) fn empty(&self) -> Option<Vector> {
        let empty = self.existing & !self.full & !self.pinned;
        (empty != 0).then(|| empty.trailing_zeros() as Vector)
    }

    /// The one whose value is needed last; among equals one that memory has already.
    pub(super) fn furthest(&self) -> Vector {
        let mut candidates = self.full & !self.pinned;
        let mut best = (0, 0);
        while candidates != 0 {
            let vector = candidates.trailing_zeros();
            candidates &= candidates - 1;
            let clean = !self.dirty >> vector & 1;
            let key = u64::from(self.next_use[vector as usize]) << 1 | u64::from(clean);
            if key >= best.0 {
                best = (key, vector as Vector);
            }
        }
        best.1
    }

    /// Whether dropping the value would lose it while it is still needed.
    pub(super) fn must_be_stored(&self, vector: Vector) -> bool {
        let needed = self.next_use[usize::from(vector)] <= AFTER_THE_END;
        (self.full & self.dirty) >> vector & 1 == 1 && needed
    }

    pub(super) fn set_clean(&mut self, vector: Vector) {
        self.dirty &= !(1 << vector);
    }

    pub(super) fn set_next_use(&mut self, vector: Vector, next_use: u32) {
        self.next_use[usize::from(vector)] = next_use;
    }

    /// Whether no later instruction of the tape reads the value.
    pub(super) fn is_finished(&self, vector: Vector) -> bool {
        self.next_use[usize::from(vector)] >= AFTER_THE_END && !self.must_be_stored(vector)
    }

    /// Puts a tape register's value into an empty vector register.
    pub(super) fn fill(&mut self, vector: Vector, register: Register, dirty: bool) {
        self.full |= 1 << vector;
        self.dirty = self.dirty & !(1 << vector) | u32::from(dirty) << vector;
        self.pin(vector);
        self.register[usize::from(vector)] = register;
        self.vector[register as usize] = vector;
    }

    /// Forgets the value. The instruction that drops an operand has read it before it writes.
    pub(super) fn drop(&mut self, vector: Vector) {
        self.full &= !(1 << vector);
        self.pinned &= !(1 << vector);
        let register = self.register(vector);
        self.vector[register as usize] = NOWHERE;
    }
}
