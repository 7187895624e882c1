//! Encodes the few vector instructions that straight-line arithmetic needs, for x86-64 with
//! AVX-512 (EVEX encoding) or AVX2 (VEX encoding): Intel SDM volume 2, chapter 2.

/// The vector width and encoding of a stretch of code.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// 512-bit vectors, 32 registers.
    Evex,
    /// 256-bit vectors, 16 registers.
    Vex,
}

impl Encoding {
    /// Doubles in a vector.
    pub(super) fn lanes(self) -> usize {
        match self {
            Encoding::Evex => 8,
            Encoding::Vex => 4,
        }
    }

    pub(super) fn registers(self) -> u8 {
        match self {
            Encoding::Evex => 32,
            Encoding::Vex => 16,
        }
    }
}

/// Element-wise operations of two vectors.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Arithmetic {
    And = 0x54,
    Xor = 0x57,
    Add = 0x58,
    Mul = 0x59,
    Sub = 0x5C,
    Div = 0x5E,
}

/// A vector register by number.
pub(super) type Vector = u8;

/// The last source of an instruction.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Source {
    Vector(Vector),
    /// Byte offset from the address the code is called with.
    Memory(i32),
}

/// Opcode maps: the escape bytes 0F, 0F 38 and 0F 3A.
#[derive(Copy, Clone)]
enum Map {
    M0f = 1,
    M0f38 = 2,
    M0f3a = 3,
}

const SQUARE_ROOT: u8 = 0x51;
const LOAD: u8 = 0x10;
const STORE: u8 = 0x11;
const COMPARE: u8 = 0xC2;
/// Greater than, ordered, quiet: false for NaN.
const GREATER: u8 = 0x1E;
const BLEND_BY_MASK: u8 = 0x65;
const BLEND_BY_VECTOR: u8 = 0x4B;

/// General registers that hold addresses: those a callee may change, and none that would need a
/// longer encoding. The first carries the argument.
const BASES: [u8; 9] = [7, 6, 0, 1, 2, 8, 9, 10, 11];

/// Bytes that one base register reaches with a one-byte displacement of whole 64-byte vectors.
const WINDOW: i32 = 256 * 64;

pub(super) struct Assembler {
    encoding: Encoding,
    code: Vec<u8>,
    bases: usize,
}

impl Assembler {
    /// Starts a function that is called with an address; `reach` is the largest offset used.
    pub(super) fn new(encoding: Encoding, reach: usize, capacity: usize) -> Self {
        let bases = match encoding {
            Encoding::Evex => (reach / WINDOW as usize + 1).min(BASES.len()),
            // One-byte displacements are not scaled: they reach nothing.
            Encoding::Vex => 1,
        };
        let mut assembler = Assembler { encoding, code: Vec::with_capacity(capacity), bases };
        for (index, &base) in BASES[..bases].iter().enumerate().rev() {
            assembler.load_address(base, base_offset(encoding, index));
        }
        assembler
    }

    /// base = argument + offset, without flags.
    fn load_address(&mut self, base: u8, offset: i32) {
        if offset == 0 && base == BASES[0] {
            return;
        }
        let rex = 0x48 | ((base >> 3) << 2);
        self.code.extend([rex, 0x8D, 0x80 | ((base & 7) << 3) | BASES[0]]);
        self.code.extend(offset.to_le_bytes());
    }

    pub(super) fn finish(mut self) -> Vec<u8> {
        // vzeroupper; ret
        self.code.extend([0xC5, 0xF8, 0x77, 0xC3]);
        self.code
    }

    pub(super) fn binary(&mut self, op: Arithmetic, result: Vector, a: Vector, b: Source) {
        self.instruction(Map::M0f, op as u8, true, result, a, b, 0);
    }

    pub(super) fn square_root(&mut self, result: Vector, x: Source) {
        self.instruction(Map::M0f, SQUARE_ROOT, true, result, 0, x, 0);
    }

    pub(super) fn load(&mut self, result: Vector, x: Source) {
        self.instruction(Map::M0f, LOAD, true, result, 0, x, 0);
    }

    pub(super) fn store(&mut self, offset: i32, x: Vector) {
        self.instruction(Map::M0f, STORE, true, x, 0, Source::Memory(offset), 0);
    }

    /// result = condition > zero ? x : y. `scratch` is overwritten with 256-bit vectors.
    pub(super) fn select(
        &mut self,
        result: Vector,
        (condition, zero): (Vector, Source),
        x: Source,
        y: Vector,
        scratch: Vector,
    ) {
        match self.encoding {
            Encoding::Evex => {
                self.instruction(Map::M0f, COMPARE, true, 1, condition, zero, 0);
                self.code.push(GREATER);
                self.instruction(Map::M0f38, BLEND_BY_MASK, true, result, y, x, 1);
            }
            Encoding::Vex => {
                self.instruction(Map::M0f, COMPARE, false, scratch, condition, zero, 0);
                self.code.push(GREATER);
                self.instruction(Map::M0f3a, BLEND_BY_VECTOR, false, result, y, x, 0);
                self.code.push(scratch << 4);
            }
        }
    }

    fn instruction(
        &mut self,
        map: Map,
        opcode: u8,
        wide: bool,
        register: u8,
        second: u8,
        source: Source,
        mask: u8,
    ) {
        let (low, extended, extended_twice, memory) = match source {
            Source::Vector(vector) => (vector & 7, vector >> 3 & 1, vector >> 4 & 1, None),
            Source::Memory(offset) => {
                let (base, displacement) = self.address(offset);
                (base & 7, base >> 3 & 1, 0, Some(displacement))
            }
        };
        match self.encoding {
            Encoding::Evex => {
                let p0 = (register >> 3 & 1) << 7
                    | extended_twice << 6
                    | extended << 5
                    | (register >> 4 & 1) << 4;
                let p0 = (p0 ^ 0xF0) | map as u8;
                let p1 = u8::from(wide) << 7 | (!second & 0xF) << 3 | 0b101;
                let p2 = 0b10 << 5 | (!(second >> 4) & 1) << 3 | mask;
                self.code.extend([0x62, p0, p1, p2, opcode]);
            }
            Encoding::Vex => {
                let short = extended == 0 && matches!(map, Map::M0f);
                let tail = (!second & 0xF) << 3 | 0b101;
                let not_r = (!(register >> 3) & 1) << 7;
                if short {
                    self.code.extend([0xC5, not_r | tail, opcode]);
                } else {
                    let not_b = (!extended & 1) << 5;
                    self.code.extend([0xC4, not_r | 0x40 | not_b | map as u8, tail, opcode]);
                }
            }
        }
        let register = (register & 7) << 3;
        match memory {
            None => self.code.push(0xC0 | register | low),
            Some(displacement) => self.displaced(register | low, displacement),
        }
    }

    fn displaced(&mut self, fields: u8, displacement: i32) {
        let scale = match self.encoding {
            Encoding::Evex => 64,
            Encoding::Vex => 1,
        };
        match i8::try_from(displacement / scale) {
            Ok(short) if displacement % scale == 0 => {
                self.code.extend([0x40 | fields, short as u8])
            }
            _ => {
                self.code.push(0x80 | fields);
                self.code.extend(displacement.to_le_bytes());
            }
        }
    }

    /// The base register and displacement of an offset.
    fn address(&self, offset: i32) -> (u8, i32) {
        let index = ((offset / WINDOW) as usize).min(self.bases - 1);
        (BASES[index], offset - base_offset(self.encoding, index))
    }
}

/// Where a base register points, from the argument: the middle of its window.
fn base_offset(encoding: Encoding, index: usize) -> i32 {
    match encoding {
        Encoding::Evex => index as i32 * WINDOW + WINDOW / 2,
        Encoding::Vex => 0,
    }
}

#[cfg(test)]
mod tests;
