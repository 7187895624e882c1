//! Derivatives of the elementary operations.

use crate::graph::{Arena, NodeId};
use crate::op::{Binary, Unary};

impl Arena {
    /// ∂y/∂x of y = op(x), expressed by x and y.
    pub(crate) fn unary_partial(&mut self, op: Unary, x: NodeId, y: NodeId) -> NodeId {
        match op {
            Unary::Neg => self.constant(-1.0),
            Unary::Abs => {
                let (plus, minus) = (self.constant(1.0), self.constant(-1.0));
                let zero = self.constant(0.0);
                let negative = self.neg(x);
                let otherwise = self.select(negative, minus, zero);
                self.select(x, plus, otherwise)
            }
            Unary::Sqrt => self.constant_over(0.5, y),
            Unary::Cbrt => {
                let square = self.mul(y, y);
                self.constant_over(1.0 / 3.0, square)
            }
            Unary::Exp => y,
            Unary::Exp2 => self.scaled(std::f64::consts::LN_2, y),
            Unary::ExpM1 => self.unary(Unary::Exp, x),
            Unary::Ln => self.recip(x),
            Unary::Log2 => self.constant_over(std::f64::consts::LOG2_E, x),
            Unary::Log10 => self.constant_over(std::f64::consts::LOG10_E, x),
            Unary::Ln1p => {
                let shifted = self.add_constant(x, 1.0);
                self.recip(shifted)
            }
            Unary::Sin => self.unary(Unary::Cos, x),
            Unary::Cos => {
                let sine = self.unary(Unary::Sin, x);
                self.neg(sine)
            }
            Unary::Tan => {
                let square = self.mul(y, y);
                self.add_constant(square, 1.0)
            }
            Unary::Asin => {
                let root = self.root_of_one_minus_square(x);
                self.recip(root)
            }
            Unary::Acos => {
                let root = self.root_of_one_minus_square(x);
                self.constant_over(-1.0, root)
            }
            Unary::Atan => {
                let square = self.mul(x, x);
                let sum = self.add_constant(square, 1.0);
                self.recip(sum)
            }
            Unary::Sinh => self.unary(Unary::Cosh, x),
            Unary::Cosh => self.unary(Unary::Sinh, x),
            Unary::Tanh => {
                let square = self.mul(y, y);
                self.one_minus(square)
            }
            Unary::Asinh => {
                let square = self.mul(x, x);
                let sum = self.add_constant(square, 1.0);
                let root = self.unary(Unary::Sqrt, sum);
                self.recip(root)
            }
            Unary::Acosh => {
                let square = self.mul(x, x);
                let difference = self.add_constant(square, -1.0);
                let root = self.unary(Unary::Sqrt, difference);
                self.recip(root)
            }
            Unary::Atanh => {
                let square = self.mul(x, x);
                let difference = self.one_minus(square);
                self.recip(difference)
            }
        }
    }

    /// (∂z/∂a, ∂z/∂b) of z = op(a, b), expressed by a, b and z.
    pub(crate) fn binary_partials(
        &mut self,
        op: Binary,
        a: NodeId,
        b: NodeId,
        z: NodeId,
    ) -> (NodeId, NodeId) {
        let one = self.constant(1.0);
        match op {
            Binary::Add => (one, one),
            Binary::Sub => (one, self.constant(-1.0)),
            Binary::Mul => (b, a),
            Binary::Div => {
                let reciprocal = self.recip(b);
                let scaled = self.mul(z, reciprocal);
                (reciprocal, self.neg(scaled))
            }
            Binary::Rem => {
                let multiple = self.sub(a, z);
                let quotient = self.div(multiple, b);
                (one, self.neg(quotient))
            }
            Binary::Atan2 => {
                let (aa, bb) = (self.mul(a, a), self.mul(b, b));
                let square = self.add(aa, bb);
                let by_a = self.div(b, square);
                let by_b = self.div(a, square);
                (by_a, self.neg(by_b))
            }
            Binary::Pow => {
                let exponent = self.add_constant(b, -1.0);
                let lower = self.binary(Binary::Pow, a, exponent);
                let by_base = self.mul(b, lower);
                // A constant exponent has no use for ln(a), which a ≤ 0 would spoil.
                let by_exponent = if self.constant_value(b).is_some() {
                    self.constant(0.0)
                } else {
                    let log = self.unary(Unary::Ln, a);
                    self.mul(z, log)
                };
                (by_base, by_exponent)
            }
        }
    }

    fn constant_over(&mut self, c: f64, x: NodeId) -> NodeId {
        let c = self.constant(c);
        self.div(c, x)
    }

    fn add_constant(&mut self, x: NodeId, c: f64) -> NodeId {
        let c = self.constant(c);
        self.add(x, c)
    }

    fn one_minus(&mut self, x: NodeId) -> NodeId {
        let one = self.constant(1.0);
        self.sub(one, x)
    }

    fn root_of_one_minus_square(&mut self, x: NodeId) -> NodeId {
        let square = self.mul(x, x);
        let difference = self.one_minus(square);
        self.unary(Unary::Sqrt, difference)
    }
}
