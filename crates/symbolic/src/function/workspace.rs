//! The memory of one evaluation.
#![expect(unsafe_code, reason = "registers are read as plain numbers")]

use std::sync::Arc;

use super::{Compiled, Function, LANES, Port};

/// One register: a value for each lane.
#[derive(Copy, Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

/// Inputs, outputs and intermediate values of one block; made by [`Function::workspace`].
#[derive(Clone)]
pub struct Workspace {
    function: Arc<Compiled>,
    registers: Vec<Lanes>,
}

impl Workspace {
    pub(super) fn new(function: &Function) -> Self {
        let layout = &function.0.tape.layout;
        let mut registers = vec![Lanes([0.0; LANES]); layout.registers()];
        let constants = &mut registers[layout.first_constant()..][..layout.constants];
        for (register, &constant) in constants.iter_mut().zip(&function.0.tape.constants) {
            register.0.fill(constant);
        }
        Workspace { function: Arc::clone(&function.0), registers }
    }

    pub(super) fn assert_fits(&self, function: &Function) {
        assert!(
            Arc::ptr_eq(&self.function, &function.0),
            "the workspace was made for function {}, not for {}",
            self.function.name,
            function.0.name
        );
    }

    pub(super) fn registers_mut(&mut self) -> &mut [Lanes] {
        &mut self.registers
    }

    /// The block of input number `port`; value i of lane l is element `i * LANES + l`.
    ///
    /// # Panics
    /// If there is no such port.
    pub fn input_mut(&mut self, port: usize) -> &mut [f64] {
        let (first, len) = place(&self.function.inputs, port);
        flatten_mut(&mut self.registers[first..first + len])
    }

    /// The block of output number `port`, as the last evaluation left it; value i of lane l is
    /// element `i * LANES + l`.
    ///
    /// # Panics
    /// If there is no such port.
    pub fn output(&self, port: usize) -> &[f64] {
        let (first, len) = place(&self.function.outputs, port);
        let first = first + self.function.tape.layout.first_output();
        flatten(&self.registers[first..first + len])
    }
}

fn place(ports: &[Port], port: usize) -> (usize, usize) {
    let first = ports[..port].iter().map(Port::len).sum();
    (first, ports[port].len())
}

fn flatten(registers: &[Lanes]) -> &[f64] {
    let len = registers.len() * LANES;
    // SAFETY: `Lanes` is `repr(C)` around `[f64; LANES]`, whose size is a multiple of the alignment
    // asked for, so there is no padding between or within registers.
    unsafe { std::slice::from_raw_parts(registers.as_ptr().cast(), len) }
}

fn flatten_mut(registers: &mut [Lanes]) -> &mut [f64] {
    let len = registers.len() * LANES;
    // SAFETY: as in `flatten`; the borrow is exclusive.
    unsafe { std::slice::from_raw_parts_mut(registers.as_mut_ptr().cast(), len) }
}

const _: () = assert!(size_of::<Lanes>() == LANES * size_of::<f64>());
