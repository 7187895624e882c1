//! Expressions as num-dual's scalars, so that generic model code traces itself.

use num_dual::{DualNum, DualStruct, Mappable};
use num_traits::{One, Signed};
use righting_scalar::Scalar;

use crate::expr::Expr;
use crate::op::{Binary, Unary};

impl DualStruct for Expr {
    type Real = f64;
    type Inner = Expr;

    /// # Panics
    /// If the expression is not a constant.
    fn re(&self) -> f64 {
        self.value_to_compare()
    }

    fn from_inner(inner: &Expr) -> Expr {
        *inner
    }
}

impl Mappable<Expr> for Expr {
    type Output<O> = O;

    fn map_dual<M: Fn(Expr) -> O, O>(self, f: M) -> O {
        f(self)
    }
}

macro_rules! unary_methods {
    ($($method:ident => $op:ident),* $(,)?) => {
        $(fn $method(&self) -> Expr {
            self.unary(Unary::$op)
        })*
    };
}

impl DualNum for Expr {
    type Primitive = f64;
    type InnerDual = Expr;
    const NDERIV: usize = 0;

    unary_methods! {
        sqrt => Sqrt, cbrt => Cbrt, exp => Exp, exp2 => Exp2, exp_m1 => ExpM1,
        ln => Ln, log2 => Log2, log10 => Log10, ln_1p => Ln1p,
        sin => Sin, cos => Cos, tan => Tan, asin => Asin, acos => Acos, atan => Atan,
        sinh => Sinh, cosh => Cosh, tanh => Tanh, asinh => Asinh, acosh => Acosh, atanh => Atanh,
    }

    fn from_re(re: Expr) -> Expr {
        re
    }

    fn scale(self, factor: &Expr) -> Expr {
        self * factor
    }

    fn recip(&self) -> Expr {
        self.reciprocal()
    }

    fn powi(&self, n: i32) -> Expr {
        self.integer_power(n)
    }

    fn powf(&self, n: f64) -> Expr {
        self.binary_constant(Binary::Pow, n)
    }

    fn powd(&self, exponent: Expr) -> Expr {
        self.binary(Binary::Pow, exponent)
    }

    fn log(&self, base: f64) -> Expr {
        self.ln() / base.ln()
    }

    fn sin_cos(&self) -> (Expr, Expr) {
        (self.sin(), self.cos())
    }

    fn atan2(&self, other: Expr) -> Expr {
        self.binary(Binary::Atan2, other)
    }

    fn sph_j0(&self) -> Expr {
        near_zero_or(*self, |x| Expr::one() - x * x / 6.0, |x| x.sin() / x)
    }

    fn sph_j1(&self) -> Expr {
        near_zero_or(*self, |x| x / 3.0, |x| (x.sin() / x - x.cos()) / x)
    }

    fn sph_j2(&self) -> Expr {
        near_zero_or(
            *self,
            |x| x * x / 15.0,
            |x| ((3.0 - x * x) * x.sin() - 3.0 * x * x.cos()) / (x * x * x),
        )
    }
}

/// num-dual's two branches of a spherical Bessel function: a series within machine precision of
/// zero, the closed form elsewhere.
fn near_zero_or(x: Expr, series: fn(Expr) -> Expr, closed_form: fn(Expr) -> Expr) -> Expr {
    Expr::select_positive(f64::EPSILON - x.abs(), series(x), closed_form(x))
}
