//! Declaring a function's ports.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::backend::Evaluator;
use super::compile::{Program, compile};
use super::{Compiled, Function, FunctionError, Port};
use crate::expr::Expr;
use crate::graph::{Arena, Node, NodeId};
use crate::sparsity::SparseMatrix;
use crate::subgraph::Subgraph;

/// Collects the ports of a [`Function`]; made by [`Function::builder`].
#[derive(Clone, Debug)]
pub struct FunctionBuilder {
    name: String,
    inputs: Vec<(Port, Vec<Expr>)>,
    outputs: Vec<(Port, Vec<Expr>)>,
}

impl FunctionBuilder {
    pub(super) fn new(name: &str) -> Self {
        FunctionBuilder { name: name.to_owned(), inputs: Vec::new(), outputs: Vec::new() }
    }

    /// Adds an input vector of symbols.
    #[must_use]
    pub fn input(mut self, name: &str, symbols: &[Expr]) -> Self {
        let port = Port { name: name.to_owned(), len: symbols.len(), sparsity: None };
        self.inputs.push((port, symbols.to_vec()));
        self
    }

    /// Adds an output vector.
    #[must_use]
    pub fn output(mut self, name: &str, values: &[Expr]) -> Self {
        let port = Port { name: name.to_owned(), len: values.len(), sparsity: None };
        self.outputs.push((port, values.to_vec()));
        self
    }

    /// Adds the nonzeros of a matrix as an output, in the order of its pattern.
    #[must_use]
    pub fn output_sparse(mut self, name: &str, matrix: &SparseMatrix) -> Self {
        let sparsity = Some(matrix.sparsity().clone());
        let port = Port { name: name.to_owned(), len: matrix.values.len(), sparsity };
        self.outputs.push((port, matrix.values.clone()));
        self
    }

    /// Compiles the outputs.
    ///
    /// # Errors
    /// See [`FunctionError`].
    ///
    /// # Panics
    /// If an expression is used outside its graph scope.
    pub fn build(self) -> Result<Function, FunctionError> {
        for ports in [&self.inputs, &self.outputs] {
            let mut seen = BTreeSet::new();
            for (port, _) in ports {
                if !seen.insert(&port.name) {
                    return Err(FunctionError::DuplicatePort {
                        function: self.name.clone(),
                        port: port.name.clone(),
                    });
                }
            }
        }
        let tape = Arena::with(|arena| {
            let inputs = self.input_symbols(arena)?;
            let outputs: Vec<NodeId> = self
                .outputs
                .iter()
                .flat_map(|(_, values)| values)
                .map(|e| e.id_in(arena))
                .collect();
            let graph = Subgraph::below(arena, &outputs);
            self.check_free_symbols(arena, &graph, &inputs)?;
            Ok(compile(&Program::new(&graph, &inputs, &outputs)))
        })?;
        Ok(Function(Arc::new(Compiled {
            name: self.name,
            inputs: self.inputs.into_iter().map(|(port, _)| port).collect(),
            outputs: self.outputs.into_iter().map(|(port, _)| port).collect(),
            evaluator: Evaluator::best(&tape),
            tape,
        })))
    }

    /// The position of each input symbol among the concatenated inputs.
    fn input_symbols(&self, arena: &Arena) -> Result<BTreeMap<NodeId, usize>, FunctionError> {
        let mut positions = BTreeMap::new();
        for (port, symbols) in &self.inputs {
            for (index, symbol) in symbols.iter().enumerate() {
                let id = symbol.id_in(arena);
                let Node::Symbol(number) = arena.node(id) else {
                    return Err(FunctionError::InputNotSymbol {
                        function: self.name.clone(),
                        port: port.name.clone(),
                        index,
                    });
                };
                let position = positions.len();
                if positions.insert(id, position).is_some() {
                    return Err(FunctionError::DuplicateInput {
                        function: self.name.clone(),
                        port: port.name.clone(),
                        index,
                        symbol: arena.symbol_name(number).to_owned(),
                    });
                }
            }
        }
        Ok(positions)
    }

    fn check_free_symbols(
        &self,
        arena: &Arena,
        graph: &Subgraph,
        inputs: &BTreeMap<NodeId, usize>,
    ) -> Result<(), FunctionError> {
        let free = |position| match graph.node(position) {
            Node::Symbol(number) if !inputs.contains_key(&graph.id(position)) => {
                Some(arena.symbol_name(number).to_owned())
            }
            _ => None,
        };
        let symbols: Vec<String> = graph.positions().filter_map(free).collect();
        if symbols.is_empty() {
            return Ok(());
        }
        Err(FunctionError::FreeSymbols { function: self.name.clone(), symbols })
    }
}
