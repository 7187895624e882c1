//! From a graph to a tape: order, operations, registers.

use std::collections::BTreeMap;

use super::native::is_native;
use super::schedule::schedule;
use super::tape::{Instruction, MASKS, Opcode, Register, RegisterFile, Tape};
use crate::graph::{Node, NodeId};
use crate::op::Unary;
use crate::subgraph::{Position, Subgraph};

/// What to compile: output values over input symbols.
pub(super) struct Program<'a> {
    graph: &'a Subgraph,
    input_count: usize,
    /// The inputs that matter, with their place among all.
    inputs: Vec<(Position, usize)>,
    outputs: Vec<Position>,
}

impl<'a> Program<'a> {
    pub(super) fn new(
        graph: &'a Subgraph,
        inputs: &BTreeMap<NodeId, usize>,
        outputs: &[NodeId],
    ) -> Self {
        let input = |(&id, &place): (&NodeId, &usize)| Some((graph.position(id)?, place));
        let output = |&id: &NodeId| graph.position(id).expect("an output of its own subgraph");
        Program {
            graph,
            input_count: inputs.len(),
            inputs: inputs.iter().filter_map(input).collect(),
            outputs: outputs.iter().map(output).collect(),
        }
    }
}

const UNASSIGNED: Register = Register::MAX;

pub(super) fn compile(program: &Program) -> Tape {
    let graph = program.graph;
    let order = schedule(graph, &program.outputs, |node| {
        opcode(node).is_some_and(|opcode| !is_native(opcode))
    });
    let mut registers = Registers::new(program, &order);
    let partners = circular_partners(graph, &order);

    let mut instructions = Vec::with_capacity(order.len());
    for (time, &id) in order.iter().enumerate() {
        let node = graph.node(id);
        let mut sources = [0; 3];
        for (slot, operand) in sources.iter_mut().zip(node.operands()) {
            *slot = registers.read(operand, time);
        }
        if registers.is_written(id) {
            continue;
        }
        let partners = match node {
            Node::Unary(Unary::Sin | Unary::Cos, _) => partners.get(&id),
            _ => None,
        };
        let instruction = match partners {
            Some(&(sine, cosine)) => {
                let (result, second) = (registers.write(sine), registers.write(cosine));
                let registers = [sources[0], second, 0];
                Instruction { opcode: Opcode::SinCos, result, registers }
            }
            None => {
                let opcode = opcode(node).expect("only operations are scheduled");
                Instruction { opcode, result: registers.write(id), registers: sources }
            }
        };
        instructions.push(instruction);
    }
    for (position, &id) in program.outputs.iter().enumerate() {
        let result = (program.input_count + position) as Register;
        let source = registers.place[id as usize];
        if source != result {
            let registers = [source, 0, 0];
            instructions.push(Instruction { opcode: Opcode::Copy, result, registers });
        }
    }
    let layout = RegisterFile {
        inputs: program.input_count,
        outputs: program.outputs.len(),
        constants: registers.constants.len(),
        temporaries: registers.temporaries,
    };
    Tape::new(layout, registers.constants, instructions)
}

/// The operation of a node; `None` for a constant or a symbol.
fn opcode(node: Node) -> Option<Opcode> {
    match node {
        Node::Constant(_) | Node::Symbol(_) => None,
        Node::Unary(op, _) => Some(Opcode::Unary(op)),
        Node::Binary(op, ..) => Some(Opcode::Binary(op)),
        Node::Select(..) => Some(Opcode::Select),
    }
}

/// For each sine or cosine of an angle that has both: the two.
fn circular_partners(
    graph: &Subgraph,
    order: &[Position],
) -> BTreeMap<Position, (Position, Position)> {
    let of = |wanted: Unary| {
        let argument = move |&position: &Position| match graph.node(position) {
            Node::Unary(op, x) if op == wanted => Some((x, position)),
            _ => None,
        };
        order.iter().filter_map(argument).collect::<BTreeMap<_, _>>()
    };
    let cosines = of(Unary::Cos);
    let pair = |(x, sine)| cosines.get(&x).map(|&cosine| (sine, cosine));
    let pairs = of(Unary::Sin).into_iter().filter_map(pair);
    pairs.flat_map(|(sine, cosine)| [sine, cosine].map(|one| (one, (sine, cosine)))).collect()
}

/// Linear-scan allocation: a register is free again after the last use of its value.
struct Registers {
    /// By position.
    place: Vec<Register>,
    /// By position: the last instruction that reads it, if its register may then be reused.
    last_use: Vec<usize>,
    /// By position.
    written: Vec<bool>,
    constants: Vec<f64>,
    free: Vec<Register>,
    first_temporary: usize,
    temporaries: usize,
}

/// A value in a register of its own, or an unused one, is never freed.
const KEPT: usize = usize::MAX;

impl Registers {
    fn new(program: &Program, order: &[Position]) -> Self {
        let graph = program.graph;
        let mut place = vec![UNASSIGNED; graph.len()];
        for &(id, position) in &program.inputs {
            place[id as usize] = position as Register;
        }
        let first_output = program.input_count;
        let first_constant = first_output + program.outputs.len();
        let mut constants = MASKS.to_vec();
        for id in graph.positions() {
            if let Node::Constant(bits) = graph.node(id) {
                place[id as usize] = (first_constant + constants.len()) as Register;
                constants.push(f64::from_bits(bits));
            }
        }
        for (position, &id) in program.outputs.iter().enumerate() {
            if place[id as usize] == UNASSIGNED {
                place[id as usize] = (first_output + position) as Register;
            }
        }
        let mut last_use = vec![KEPT; graph.len()];
        for (time, &id) in order.iter().enumerate() {
            for operand in graph.node(id).operands() {
                if place[operand as usize] == UNASSIGNED {
                    last_use[operand as usize] = time;
                }
            }
        }
        let written = vec![false; graph.len()];
        let first_temporary = first_constant + constants.len();
        let free = Vec::new();
        Registers { place, last_use, written, constants, free, first_temporary, temporaries: 0 }
    }

    fn read(&mut self, id: Position, time: usize) -> Register {
        let place = self.place[id as usize];
        if self.last_use[id as usize] == time {
            self.last_use[id as usize] = KEPT;
            self.free.push(place);
        }
        place
    }

    fn is_written(&self, id: Position) -> bool {
        self.written[id as usize]
    }

    fn write(&mut self, id: Position) -> Register {
        self.written[id as usize] = true;
        let place = &mut self.place[id as usize];
        if *place == UNASSIGNED {
            *place = self.free.pop().unwrap_or_else(|| {
                self.temporaries += 1;
                (self.first_temporary + self.temporaries - 1) as Register
            });
        }
        *place
    }
}
