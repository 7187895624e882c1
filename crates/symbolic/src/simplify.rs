//! Construction with algebraic simplification.
//!
//! Each rule either leaves the value of every finite evaluation unchanged to the last bit or gathers
//! constant factors. Signs move outward: a negation ends up on the outside of products, quotients
//! and sums, where the next sum absorbs it. Products with a zero constant vanish even though
//! 0·∞ is not zero, and zeros carry no sign: the usual conventions of computer algebra.

use crate::graph::{Arena, Node, NodeId};
use crate::op::{self, Binary, Unary};

impl Arena {
    pub(crate) fn constant(&mut self, value: f64) -> NodeId {
        // −0.0 + 0.0 is 0.0, and every NaN is one NaN.
        let canonical = if value.is_nan() { f64::NAN } else { value + 0.0 };
        self.intern(Node::Constant(canonical.to_bits()))
    }

    /// `x` where the node is −x.
    fn negated(&self, id: NodeId) -> Option<NodeId> {
        match self.node(id) {
            Node::Unary(Unary::Neg, x) => Some(x),
            _ => None,
        }
    }

    pub(crate) fn unary(&mut self, op: Unary, x: NodeId) -> NodeId {
        if op == Unary::Neg {
            return self.neg(x);
        }
        if let Some(value) = self.constant_value(x) {
            return self.constant(op.apply(value));
        }
        if let Some(positive) = self.negated(x) {
            match op {
                Unary::Abs | Unary::Cos | Unary::Cosh => return self.unary(op, positive),
                Unary::Sin
                | Unary::Tan
                | Unary::Asin
                | Unary::Atan
                | Unary::Sinh
                | Unary::Tanh
                | Unary::Asinh
                | Unary::Atanh
                | Unary::Cbrt => {
                    let value = self.unary(op, positive);
                    return self.neg(value);
                }
                _ => {}
            }
        }
        match (op, self.node(x)) {
            (Unary::Abs, Node::Unary(Unary::Abs | Unary::Sqrt | Unary::Exp, _)) => x,
            _ => self.intern(Node::Unary(op, x)),
        }
    }

    pub(crate) fn neg(&mut self, x: NodeId) -> NodeId {
        match self.node(x) {
            Node::Constant(bits) => self.constant(-f64::from_bits(bits)),
            Node::Unary(Unary::Neg, inner) => inner,
            Node::Binary(Binary::Sub, a, b) => self.sub(b, a),
            Node::Binary(Binary::Mul, a, b) => match self.constant_value(b) {
                Some(c) => self.scaled(-c, a),
                None => self.intern(Node::Unary(Unary::Neg, x)),
            },
            _ => self.intern(Node::Unary(Unary::Neg, x)),
        }
    }

    pub(crate) fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        match op {
            Binary::Add => self.add(a, b),
            Binary::Sub => self.sub(a, b),
            Binary::Mul => self.mul(a, b),
            Binary::Div => self.div(a, b),
            Binary::Pow => self.pow(a, b),
            Binary::Rem | Binary::Atan2 => match self.both_constant(a, b) {
                Some((x, y)) => self.constant(op.apply(x, y)),
                None => self.intern(Node::Binary(op, a, b)),
            },
        }
    }

    fn both_constant(&self, a: NodeId, b: NodeId) -> Option<(f64, f64)> {
        Some((self.constant_value(a)?, self.constant_value(b)?))
    }

    /// Operands of a commutative operation: by age, but a constant comes last.
    fn canonical(&self, a: NodeId, b: NodeId) -> (NodeId, NodeId) {
        let key = |id| (self.constant_value(id).is_some(), id);
        if key(a) <= key(b) { (a, b) } else { (b, a) }
    }

    fn commutative(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        debug_assert!(op.commutes());
        let (a, b) = self.canonical(a, b);
        self.intern(Node::Binary(op, a, b))
    }

    pub(crate) fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some((x, y)) = self.both_constant(a, b) {
            return self.constant(x + y);
        }
        if self.constant_value(a) == Some(0.0) {
            return b;
        }
        if self.constant_value(b) == Some(0.0) {
            return a;
        }
        if a == b {
            return self.scaled(2.0, a);
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => {
                let sum = self.add(x, y);
                self.neg(sum)
            }
            (None, Some(y)) => self.sub(a, y),
            (Some(x), None) => self.sub(b, x),
            (None, None) => self.commutative(Binary::Add, a, b),
        }
    }

    pub(crate) fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if a == b {
            return self.constant(0.0);
        }
        if let Some((x, y)) = self.both_constant(a, b) {
            return self.constant(x - y);
        }
        if let Some(c) = self.constant_value(b) {
            let negative = self.constant(-c);
            return self.add(a, negative);
        }
        if self.constant_value(a) == Some(0.0) {
            return self.neg(b);
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => self.sub(y, x),
            (None, Some(y)) => self.add(a, y),
            (Some(x), None) => {
                let sum = self.add(x, b);
                self.neg(sum)
            }
            // Of a − b and b − a only one is computed; the other is its negation.
            (None, None) => match self.find(Node::Binary(Binary::Sub, b, a)) {
                Some(reverse) => self.intern(Node::Unary(Unary::Neg, reverse)),
                None => self.intern(Node::Binary(Binary::Sub, a, b)),
            },
        }
    }

    /// c·x for a constant c.
    pub(crate) fn scaled(&mut self, c: f64, x: NodeId) -> NodeId {
        if c == 0.0 {
            return self.constant(0.0);
        }
        if c == 1.0 {
            return x;
        }
        if c == -1.0 {
            return self.neg(x);
        }
        match self.node(x) {
            Node::Constant(bits) => self.constant(c * f64::from_bits(bits)),
            Node::Unary(Unary::Neg, inner) => self.scaled(-c, inner),
            Node::Binary(Binary::Mul, inner, factor) => match self.constant_value(factor) {
                Some(factor) => self.scaled(c * factor, inner),
                None => self.scaled_node(c, x),
            },
            _ => self.scaled_node(c, x),
        }
    }

    fn scaled_node(&mut self, c: f64, x: NodeId) -> NodeId {
        let factor = self.constant(c);
        self.intern(Node::Binary(Binary::Mul, x, factor))
    }

    pub(crate) fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(c) = self.constant_value(a) {
            return self.scaled(c, b);
        }
        if let Some(c) = self.constant_value(b) {
            return self.scaled(c, a);
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => self.mul(x, y),
            (Some(x), None) => {
                let product = self.mul(x, b);
                self.neg(product)
            }
            (None, Some(y)) => {
                let product = self.mul(a, y);
                self.neg(product)
            }
            (None, None) => self.commutative(Binary::Mul, a, b),
        }
    }

    pub(crate) fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some((x, y)) = self.both_constant(a, b) {
            return self.constant(x / y);
        }
        if a == b {
            return self.constant(1.0);
        }
        if let Some(c) = self.constant_value(b)
            && (c == 1.0 || is_power_of_two(c))
        {
            return self.scaled(1.0 / c, a);
        }
        if self.constant_value(a) == Some(0.0) {
            return a;
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => self.div(x, y),
            (Some(x), None) => {
                let quotient = self.div(x, b);
                self.neg(quotient)
            }
            (None, Some(y)) => {
                let quotient = self.div(a, y);
                self.neg(quotient)
            }
            (None, None) => self.intern(Node::Binary(Binary::Div, a, b)),
        }
    }

    pub(crate) fn recip(&mut self, x: NodeId) -> NodeId {
        let one = self.constant(1.0);
        self.div(one, x)
    }

    /// x to an integer power by repeated squaring.
    pub(crate) fn powi(&mut self, x: NodeId, exponent: i32) -> NodeId {
        let mut result = self.constant(1.0);
        let mut square = x;
        let mut remaining = exponent.unsigned_abs();
        while remaining > 0 {
            if remaining & 1 == 1 {
                result = self.mul(result, square);
            }
            remaining >>= 1;
            if remaining > 0 {
                square = self.mul(square, square);
            }
        }
        if exponent < 0 { self.recip(result) } else { result }
    }

    fn pow(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(x), Some(y)) => self.constant(Binary::Pow.apply(x, y)),
            (_, Some(0.5)) => self.unary(Unary::Sqrt, a),
            (_, Some(y)) if y.fract() == 0.0 && y.abs() <= 64.0 => self.powi(a, y as i32),
            _ => self.intern(Node::Binary(Binary::Pow, a, b)),
        }
    }

    pub(crate) fn select(&mut self, condition: NodeId, x: NodeId, y: NodeId) -> NodeId {
        match self.constant_value(condition) {
            Some(c) if op::select(c, 1.0, 0.0) == 1.0 => x,
            Some(_) => y,
            None if x == y => x,
            None => self.intern(Node::Select(condition, x, y)),
        }
    }
}

/// Whether dividing by `c` and multiplying by 1/c round alike.
fn is_power_of_two(c: f64) -> bool {
    c.is_normal() && c.recip().is_normal() && c.to_bits() & ((1 << 52) - 1) == 0
}
