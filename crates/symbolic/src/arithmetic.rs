//! Operators and the num-traits interfaces of expressions.

use std::cmp::Ordering;
use std::iter::{Product, Sum};
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_traits::{FromPrimitive, Inv, Num, One, Signed, Zero};
use righting_scalar::Scalar;

use crate::expr::Expr;
use crate::op::{Binary, Unary};

macro_rules! impl_operator {
    ($operator:ident, $method:ident, $assign_operator:ident, $assign_method:ident) => {
        impl $operator for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                self.binary(Binary::$operator, other)
            }
        }
        impl $operator<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                self.binary(Binary::$operator, *other)
            }
        }
        impl $operator<Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                self.binary(Binary::$operator, other)
            }
        }
        impl $operator<&Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                self.binary(Binary::$operator, *other)
            }
        }
        impl $operator<f64> for Expr {
            type Output = Expr;
            fn $method(self, other: f64) -> Expr {
                self.binary_constant(Binary::$operator, other)
            }
        }
        impl $operator<Expr> for f64 {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                Expr::constant(self).binary(Binary::$operator, other)
            }
        }
        impl $assign_operator for Expr {
            fn $assign_method(&mut self, other: Expr) {
                *self = self.binary(Binary::$operator, other);
            }
        }
        impl $assign_operator<f64> for Expr {
            fn $assign_method(&mut self, other: f64) {
                *self = self.binary_constant(Binary::$operator, other);
            }
        }
    };
}

impl_operator!(Add, add, AddAssign, add_assign);
impl_operator!(Sub, sub, SubAssign, sub_assign);
impl_operator!(Mul, mul, MulAssign, mul_assign);
impl_operator!(Div, div, DivAssign, div_assign);
impl_operator!(Rem, rem, RemAssign, rem_assign);

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        self.unary(Unary::Neg)
    }
}

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        self.unary(Unary::Neg)
    }
}

impl Inv for Expr {
    type Output = Expr;
    fn inv(self) -> Expr {
        self.reciprocal()
    }
}

impl From<f64> for Expr {
    fn from(value: f64) -> Expr {
        Expr::constant(value)
    }
}

impl Zero for Expr {
    fn zero() -> Expr {
        Expr::constant(0.0)
    }

    /// Whether the expression is the number zero; false for any other, whatever it evaluates to.
    fn is_zero(&self) -> bool {
        self.as_constant() == Some(0.0)
    }
}

impl One for Expr {
    fn one() -> Expr {
        Expr::constant(1.0)
    }

    /// Whether the expression is the number one; false for any other, whatever it evaluates to.
    fn is_one(&self) -> bool {
        self.as_constant() == Some(1.0)
    }
}

impl Sum for Expr {
    fn sum<I: Iterator<Item = Expr>>(terms: I) -> Expr {
        terms.fold(Expr::zero(), |sum, term| sum + term)
    }
}

impl<'a> Sum<&'a Expr> for Expr {
    fn sum<I: Iterator<Item = &'a Expr>>(terms: I) -> Expr {
        terms.copied().sum()
    }
}

impl Product for Expr {
    fn product<I: Iterator<Item = Expr>>(factors: I) -> Expr {
        factors.fold(Expr::one(), |product, factor| product * factor)
    }
}

impl<'a> Product<&'a Expr> for Expr {
    fn product<I: Iterator<Item = &'a Expr>>(factors: I) -> Expr {
        factors.copied().product()
    }
}

impl FromPrimitive for Expr {
    fn from_i64(n: i64) -> Option<Expr> {
        f64::from_i64(n).map(Expr::constant)
    }

    fn from_u64(n: u64) -> Option<Expr> {
        f64::from_u64(n).map(Expr::constant)
    }

    fn from_f64(n: f64) -> Option<Expr> {
        Some(Expr::constant(n))
    }
}

impl Num for Expr {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;

    fn from_str_radix(text: &str, radix: u32) -> Result<Expr, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Expr::constant)
    }
}

impl Signed for Expr {
    fn abs(&self) -> Expr {
        self.unary(Unary::Abs)
    }

    fn abs_sub(&self, other: &Expr) -> Expr {
        (*self - *other).maximum(Expr::zero())
    }

    /// −1, 0 or 1. Like num-dual's, and unlike `f64::signum`, zero has sign zero.
    fn signum(&self) -> Expr {
        let negative = Expr::select_positive(-*self, -Expr::one(), Expr::zero());
        Expr::select_positive(*self, Expr::one(), negative)
    }

    fn is_positive(&self) -> bool {
        self.value_to_compare() > 0.0
    }

    fn is_negative(&self) -> bool {
        self.value_to_compare() < 0.0
    }
}

impl Scalar for Expr {
    fn select_positive(condition: Expr, if_positive: Expr, otherwise: Expr) -> Expr {
        Expr::select(condition, if_positive, otherwise)
    }
}

impl Expr {
    /// The value of a constant.
    ///
    /// # Panics
    /// If the expression is not a constant.
    pub(crate) fn value_to_compare(self) -> f64 {
        match self.as_constant() {
            Some(value) => value,
            None => panic!(
                "cannot compare the expression {self} or take its value: it has none until it is \
                 compiled and evaluated. Write the branch as an operation: \
                 Scalar::select_positive, minimum, maximum, clamped or abs"
            ),
        }
    }
}

impl PartialEq for Expr {
    /// # Panics
    /// If the expressions differ and are not both constants; see [`Expr::is_same`].
    fn eq(&self, other: &Expr) -> bool {
        self.is_same(*other) || self.value_to_compare() == other.value_to_compare()
    }
}

impl PartialEq<f64> for Expr {
    /// # Panics
    /// If the expression is not a constant.
    fn eq(&self, other: &f64) -> bool {
        self.value_to_compare() == *other
    }
}

impl PartialOrd for Expr {
    /// # Panics
    /// If the expressions differ and are not both constants.
    fn partial_cmp(&self, other: &Expr) -> Option<Ordering> {
        if self.is_same(*other) && self.as_constant().is_none() {
            return Some(Ordering::Equal);
        }
        self.value_to_compare().partial_cmp(&other.value_to_compare())
    }
}

impl PartialOrd<f64> for Expr {
    /// # Panics
    /// If the expression is not a constant.
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.value_to_compare().partial_cmp(other)
    }
}
