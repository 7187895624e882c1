//! The expression handle and its constructors.

use std::fmt;

use crate::graph::{Arena, Node, NodeId};
use crate::op::{Binary, Unary};

/// An expression: a copyable handle into the graph of the scope it was made in.
///
/// Building the same expression twice gives the same handle. Arithmetic, [`num_dual::DualNum`] and
/// [`righting_scalar::Scalar`] are how expressions are built; there is nothing to evaluate here, see
/// [`Function`](crate::Function).
///
/// # Panics
/// Every operation panics when the handle is used outside the [`Graph::scope`](crate::Graph::scope)
/// it was made in. Comparing expressions panics unless both are constants or one and the same
/// expression, since they have no values yet; branch with
/// [`Scalar::select_positive`](righting_scalar::Scalar::select_positive) and its companions.
#[derive(Copy, Clone)]
pub struct Expr {
    arena: u32,
    id: NodeId,
}

impl Expr {
    /// The number `value`.
    pub fn constant(value: f64) -> Expr {
        Self::build(|arena| arena.constant(value))
    }

    /// A new free variable. Two symbols of one name are still two symbols.
    pub fn symbol(name: &str) -> Expr {
        Self::build(|arena| arena.new_symbol(name.to_owned()))
    }

    /// `count` new free variables called `name[0]`, `name[1]`, …
    pub fn symbols(name: &str, count: usize) -> Vec<Expr> {
        (0..count).map(|i| Self::symbol(&format!("{name}[{i}]"))).collect()
    }

    /// The value, if the expression is a number.
    pub fn as_constant(self) -> Option<f64> {
        Arena::with(|arena| arena.constant_value(self.id_in(arena)))
    }

    /// The symbol's name, if the expression is one.
    pub fn symbol_name(self) -> Option<String> {
        Arena::with(|arena| match arena.node(self.id_in(arena)) {
            Node::Symbol(symbol) => Some(arena.symbol_name(symbol).to_owned()),
            _ => None,
        })
    }

    /// Whether both handles are the same node: equal by construction. Never panics on expressions
    /// of one scope, unlike `==`.
    pub fn is_same(self, other: Expr) -> bool {
        self.arena == other.arena && self.id == other.id
    }

    pub(crate) fn from_id(arena: &Arena, id: NodeId) -> Expr {
        Expr { arena: arena.id(), id }
    }

    /// The node's position, after checking that the handle belongs to this arena.
    pub(crate) fn id_in(self, arena: &Arena) -> NodeId {
        assert!(
            self.arena == arena.id(),
            "an expression was used outside the graph scope it was made in: compile it to a \
             Function inside that scope, or build it again in this one"
        );
        self.id
    }

    fn build(make: impl FnOnce(&mut Arena) -> NodeId) -> Expr {
        Arena::with(|arena| {
            let id = make(arena);
            Expr::from_id(arena, id)
        })
    }

    pub(crate) fn unary(self, op: Unary) -> Expr {
        Self::build(|arena| {
            let x = self.id_in(arena);
            arena.unary(op, x)
        })
    }

    pub(crate) fn binary(self, op: Binary, other: Expr) -> Expr {
        Self::build(|arena| {
            let (a, b) = (self.id_in(arena), other.id_in(arena));
            arena.binary(op, a, b)
        })
    }

    pub(crate) fn binary_constant(self, op: Binary, value: f64) -> Expr {
        Self::build(|arena| {
            let a = self.id_in(arena);
            let b = arena.constant(value);
            arena.binary(op, a, b)
        })
    }

    pub(crate) fn integer_power(self, exponent: i32) -> Expr {
        Self::build(|arena| {
            let x = self.id_in(arena);
            arena.powi(x, exponent)
        })
    }

    pub(crate) fn reciprocal(self) -> Expr {
        Self::build(|arena| {
            let x = self.id_in(arena);
            arena.recip(x)
        })
    }

    pub(crate) fn select(condition: Expr, if_positive: Expr, otherwise: Expr) -> Expr {
        Self::build(|arena| {
            let [c, x, y] = [condition, if_positive, otherwise].map(|e| e.id_in(arena));
            arena.select(c, x, y)
        })
    }
}

/// Longest text that `Display` gives before it abbreviates.
const DISPLAY_DEPTH: usize = 12;

impl fmt::Display for Expr {
    /// The formula in infix notation; deep subexpressions are shown as `…`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = Arena::with(|arena| {
            let mut text = String::new();
            write_formula(arena, self.id_in(arena), DISPLAY_DEPTH, &mut text);
            text
        });
        f.write_str(&text)
    }
}

fn write_formula(arena: &Arena, id: NodeId, depth: usize, text: &mut String) {
    if depth == 0 {
        text.push('…');
        return;
    }
    let mut call = |name: &str, operands: &[NodeId]| {
        text.push_str(name);
        text.push('(');
        for (i, &operand) in operands.iter().enumerate() {
            if i > 0 {
                text.push_str(", ");
            }
            write_formula(arena, operand, depth - 1, text);
        }
        text.push(')');
    };
    match arena.node(id) {
        Node::Constant(bits) => text.push_str(&f64::from_bits(bits).to_string()),
        Node::Symbol(symbol) => text.push_str(arena.symbol_name(symbol)),
        Node::Unary(Unary::Neg, x) => call("-", &[x]),
        Node::Unary(op, x) => call(op.name(), &[x]),
        Node::Binary(op, a, b) => {
            let infix = match op {
                Binary::Add => " + ",
                Binary::Sub => " - ",
                Binary::Mul => " * ",
                Binary::Div => " / ",
                Binary::Rem | Binary::Atan2 | Binary::Pow => return call(op.name(), &[a, b]),
            };
            text.push('(');
            write_formula(arena, a, depth - 1, text);
            text.push_str(infix);
            write_formula(arena, b, depth - 1, text);
            text.push(')');
        }
        Node::Select(c, x, y) => call("select_positive", &[c, x, y]),
    }
}

impl fmt::Debug for Expr {
    /// The handle alone, so that it can be printed outside its scope.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Expr({}:{})", self.arena, self.id)
    }
}
