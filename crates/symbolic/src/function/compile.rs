//! From a graph to a tape: order, operations, registers.

use std::collections::BTreeMap;

use super::tape::{Instruction, Layout, MASKS, Opcode, Register, Tape};
use crate::graph::{Arena, Node, NodeId};

/// What to compile: output values over input symbols, both by position in the workspace.
pub(super) struct Program<'a> {
    pub arena: &'a Arena,
    pub inputs: BTreeMap<NodeId, usize>,
    pub outputs: Vec<NodeId>,
}

const UNASSIGNED: Register = Register::MAX;

pub(super) fn compile(program: &Program) -> Tape {
    let order = depth_first(program);
    let arena = program.arena;
    let size = program.outputs.iter().map(|&id| id as usize + 1).max().unwrap_or(0);

    let mut constants = MASKS.to_vec();
    let mut place = vec![UNASSIGNED; size];
    let outputs_start = program.inputs.len();
    let constants_start = outputs_start + program.outputs.len();
    for (&id, &position) in &program.inputs {
        if let Some(place) = place.get_mut(id as usize) {
            *place = position as Register;
        }
    }
    for &id in &order {
        if let Some(value) = arena.constant_value(id) {
            place[id as usize] = (constants_start + constants.len()) as Register;
            constants.push(value);
        }
    }
    for (position, &id) in program.outputs.iter().enumerate() {
        if place[id as usize] == UNASSIGNED {
            place[id as usize] = (outputs_start + position) as Register;
        }
    }

    let mut last_use = vec![0; size];
    for (time, &id) in order.iter().enumerate() {
        for operand in arena.node(id).operands() {
            last_use[operand as usize] = time;
        }
    }

    let temporaries_start = constants_start + constants.len();
    let mut temporaries = 0;
    let mut free: Vec<Register> = Vec::new();
    let mut is_temporary = vec![false; size];
    let mut instructions = Vec::with_capacity(order.len());
    for (time, &id) in order.iter().enumerate() {
        let node = arena.node(id);
        let opcode = match node {
            Node::Constant(_) | Node::Symbol(_) => continue,
            Node::Unary(op, _) => Opcode::Unary(op),
            Node::Binary(op, ..) => Opcode::Binary(op),
            Node::Select(..) => Opcode::Select,
        };
        let mut operands = [0; 3];
        for (slot, operand) in operands.iter_mut().zip(node.operands()) {
            *slot = place[operand as usize];
            if is_temporary[operand as usize] && last_use[operand as usize] == time {
                is_temporary[operand as usize] = false;
                free.push(place[operand as usize]);
            }
        }
        if place[id as usize] == UNASSIGNED {
            is_temporary[id as usize] = true;
            place[id as usize] = free.pop().unwrap_or_else(|| {
                temporaries += 1;
                (temporaries_start + temporaries - 1) as Register
            });
        }
        instructions.push(Instruction { opcode, result: place[id as usize], operands });
    }
    for (position, &id) in program.outputs.iter().enumerate() {
        let result = (outputs_start + position) as Register;
        if place[id as usize] != result {
            let operands = [place[id as usize], 0, 0];
            instructions.push(Instruction { opcode: Opcode::Copy, result, operands });
        }
    }
    let layout = Layout {
        inputs: program.inputs.len(),
        outputs: program.outputs.len(),
        constants: constants.len(),
        temporaries,
    };
    Tape::new(layout, constants, instructions)
}

/// Every node the outputs need, each just before its first use.
fn depth_first(program: &Program) -> Vec<NodeId> {
    let arena = program.arena;
    let size = program.outputs.iter().map(|&id| id as usize + 1).max().unwrap_or(0);
    let mut order = Vec::new();
    let mut entered = vec![false; size];
    let mut placed = vec![false; size];
    let mut stack = Vec::new();
    for &output in &program.outputs {
        stack.push(output);
        while let Some(&id) = stack.last() {
            if placed[id as usize] {
                stack.pop();
            } else if entered[id as usize] {
                placed[id as usize] = true;
                order.push(id);
                stack.pop();
            } else {
                entered[id as usize] = true;
                stack.extend(arena.node(id).operands().filter(|&id| !placed[id as usize]));
            }
        }
    }
    order
}
