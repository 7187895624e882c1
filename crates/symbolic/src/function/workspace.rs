//! The memory of one evaluation.

use std::sync::Arc;

use aligned_vec::{AVec, ConstAlign, avec};

use super::{Compiled, Function, LANES, Port};

/// One register: a value for each lane.
pub(super) type Lanes = [f64; LANES];

/// Bytes of a register and of the widest vector: none straddles two lines of the cache.
const ALIGNMENT: usize = 64;

/// Inputs, outputs and intermediate values of one block; made by [`Function::workspace`].
#[derive(Clone)]
pub struct Workspace {
    function: Arc<Compiled>,
    registers: AVec<Lanes, ConstAlign<ALIGNMENT>>,
}

impl Workspace {
    pub(super) fn new(function: &Function) -> Self {
        let layout = &function.0.tape.layout;
        let mut registers = avec![[ALIGNMENT]| [0.0; LANES]; layout.registers()];
        let constants = &mut registers[layout.first_constant()..][..layout.constants];
        for (register, &constant) in constants.iter_mut().zip(&function.0.tape.constants) {
            register.fill(constant);
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
        self.registers[first..first + len].as_flattened_mut()
    }

    /// The block of output number `port`, as the last evaluation left it; value i of lane l is
    /// element `i * LANES + l`.
    ///
    /// # Panics
    /// If there is no such port.
    pub fn output(&self, port: usize) -> &[f64] {
        let (first, len) = place(&self.function.outputs, port);
        let first = first + self.function.tape.layout.first_output();
        self.registers[first..first + len].as_flattened()
    }
}

fn place(ports: &[Port], port: usize) -> (usize, usize) {
    let first = ports[..port].iter().map(Port::len).sum();
    (first, ports[port].len())
}
