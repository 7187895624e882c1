//! What is encoded, as an independent disassembler reads it.

use super::*;
use iced_x86::{
    Decoder, DecoderOptions, Instruction, MemorySize, Mnemonic, OpKind, Register as Name,
};

/// An offset in every window, aligned and not, and beyond the last window.
const OFFSETS: [i32; 8] = [0, 64, 8128, 8192, 16384 + 72, 100_032, 147_456 + 64, 2_000_064];

fn decode(code: &[u8]) -> Vec<Instruction> {
    Decoder::with_ip(64, code, 0, DecoderOptions::NONE).into_iter().collect()
}

/// What the prologue leaves in each base register, from the argument on.
fn base_values(prologue: &[Instruction]) -> Vec<(Name, i64)> {
    let mut values = vec![(Name::RDI, 0)];
    for instruction in prologue {
        assert_eq!(instruction.mnemonic(), Mnemonic::Lea);
        let of = |name: Name| values.iter().find(|(known, _)| *known == name).unwrap().1;
        let value = of(instruction.memory_base()) + instruction.memory_displacement64() as i64;
        let target = instruction.op0_register();
        values.retain(|(known, _)| *known != target);
        values.push((target, value));
    }
    values
}

fn vector(encoding: Encoding, vector: Vector) -> Name {
    let first = match encoding {
        Encoding::Evex => Name::ZMM0,
        Encoding::Vex => Name::YMM0,
    };
    first + u32::from(vector)
}

/// Assembles one thing and returns its instructions with a way to resolve their addresses.
fn assemble(
    encoding: Encoding,
    emit: impl FnOnce(&mut Assembler),
) -> (Vec<Instruction>, impl Fn(&Instruction) -> i64) {
    let mut assembler = Assembler::new(encoding, 4_000_000, 0);
    let prologue = assembler.code.len();
    emit(&mut assembler);
    let code = assembler.finish();
    let bases = base_values(&decode(&code[..prologue]));
    let mut body = decode(&code[prologue..]);
    let ending: Vec<_> = body.split_off(body.len() - 2);
    assert_eq!(ending[0].mnemonic(), Mnemonic::Vzeroupper);
    assert_eq!(ending[1].mnemonic(), Mnemonic::Ret);
    let address = move |instruction: &Instruction| {
        let base = bases.iter().find(|(name, _)| *name == instruction.memory_base()).unwrap();
        base.1 + instruction.memory_displacement64() as i64
    };
    (body, address)
}

fn assert_source(
    encoding: Encoding,
    (instruction, operand): (&Instruction, u32),
    source: Source,
    address: impl Fn(&Instruction) -> i64,
) {
    match source {
        Source::Vector(number) => {
            assert_eq!(instruction.op_register(operand), vector(encoding, number));
        }
        Source::Memory(offset) => {
            assert_eq!(instruction.op_kind(operand), OpKind::Memory);
            let size = match encoding {
                Encoding::Evex => MemorySize::Packed512_Float64,
                Encoding::Vex => MemorySize::Packed256_Float64,
            };
            assert_eq!(instruction.memory_size(), size);
            assert_eq!(address(instruction), i64::from(offset));
        }
    }
}

fn sources(encoding: Encoding) -> impl Iterator<Item = Source> {
    let vectors = (0..encoding.registers()).map(Source::Vector);
    vectors.chain(OFFSETS.map(Source::Memory))
}

#[test]
fn arithmetic_decodes_to_itself() {
    let operations = [
        (Arithmetic::And, Mnemonic::Vandpd),
        (Arithmetic::Xor, Mnemonic::Vxorpd),
        (Arithmetic::Add, Mnemonic::Vaddpd),
        (Arithmetic::Mul, Mnemonic::Vmulpd),
        (Arithmetic::Sub, Mnemonic::Vsubpd),
        (Arithmetic::Div, Mnemonic::Vdivpd),
    ];
    for encoding in [Encoding::Evex, Encoding::Vex] {
        let last = encoding.registers() - 1;
        for ((op, mnemonic), b) in
            operations.into_iter().flat_map(|op| sources(encoding).map(move |b| (op, b)))
        {
            for (result, a) in [(0, last), (last, 7), (8, 0), (5, 5)] {
                let (body, address) = assemble(encoding, |code| code.binary(op, result, a, b));
                assert_eq!((body.len(), body[0].mnemonic()), (1, mnemonic));
                assert_eq!(body[0].op0_register(), vector(encoding, result));
                assert_eq!(body[0].op1_register(), vector(encoding, a));
                assert_source(encoding, (&body[0], 2), b, address);
            }
        }
    }
}

#[test]
fn moves_and_roots_decode_to_themselves() {
    for encoding in [Encoding::Evex, Encoding::Vex] {
        for (source, result) in
            sources(encoding).flat_map(|x| (0..encoding.registers()).map(move |r| (x, r)))
        {
            let (body, address) = assemble(encoding, |code| code.square_root(result, source));
            assert_eq!((body.len(), body[0].mnemonic()), (1, Mnemonic::Vsqrtpd));
            assert_eq!(body[0].op0_register(), vector(encoding, result));
            assert_source(encoding, (&body[0], 1), source, address);
            let (body, address) = assemble(encoding, |code| code.load(result, source));
            assert_eq!((body.len(), body[0].mnemonic()), (1, Mnemonic::Vmovupd));
            assert_source(encoding, (&body[0], 1), source, address);
            if let Source::Memory(offset) = source {
                let (body, address) = assemble(encoding, |code| code.store(offset, result));
                assert_eq!((body.len(), body[0].mnemonic()), (1, Mnemonic::Vmovupd));
                assert_eq!(body[0].op1_register(), vector(encoding, result));
                assert_source(encoding, (&body[0], 0), source, address);
            }
        }
    }
}

#[test]
fn selections_decode_to_themselves() {
    for encoding in [Encoding::Evex, Encoding::Vex] {
        for x in sources(encoding) {
            let zero = Source::Memory(64);
            let (body, address) = assemble(encoding, |code| code.select(9, (12, zero), x, 3, 15));
            assert_eq!((body.len(), body[0].mnemonic()), (2, Mnemonic::Vcmppd));
            assert_eq!(body[0].op1_register(), vector(encoding, 12));
            assert_source(encoding, (&body[0], 2), zero, &address);
            assert_eq!(body[0].immediate8(), GREATER);
            assert_eq!(body[1].op0_register(), vector(encoding, 9));
            assert_eq!(body[1].op1_register(), vector(encoding, 3));
            assert_source(encoding, (&body[1], 2), x, &address);
            match encoding {
                Encoding::Evex => {
                    assert_eq!(body[0].op0_register(), Name::K1);
                    assert_eq!(body[1].mnemonic(), Mnemonic::Vblendmpd);
                    assert_eq!(body[1].op_mask(), Name::K1);
                }
                Encoding::Vex => {
                    assert_eq!(body[0].op0_register(), Name::YMM15);
                    assert_eq!(body[1].mnemonic(), Mnemonic::Vblendvpd);
                    assert_eq!(body[1].op3_register(), Name::YMM15);
                }
            }
        }
    }
}
