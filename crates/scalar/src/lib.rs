//! A [`DualNum`] that branches without comparing.
//!
//! Model code that must run on numbers, on dual numbers and on symbolic expressions cannot write
//! `if a < b`: an expression has no value yet. [`Scalar`] states the branch as an operation,
//!
//! ```text
//! select_positive(c, x, y) = x  where Re c > 0,   y  elsewhere,
//! ```
//!
//! which a number decides on the spot, a dual number decides by its real part for every component,
//! and an expression records. The side that is not taken never reaches the result, so a division
//! by zero there does no harm to the value or to the derivatives.
//!
//! ```
//! use num_dual::Dual64;
//! use righting_scalar::Scalar;
//!
//! fn saturate<T: Scalar>(x: T) -> T {
//!     x.clamped(T::from(-1.0), T::from(1.0))
//! }
//! assert_eq!(saturate(3.0), 1.0);
//! assert_eq!(saturate(Dual64::new(0.5, 1.0)).eps, 1.0);
//! assert_eq!(saturate(Dual64::new(3.0, 1.0)).eps, 0.0);
//! ```
#![forbid(unsafe_code)]

use num_dual::{Dual, Dual2, DualNum, HyperDual};

/// A scalar for model code: every [`DualNum`] operation, and branches as operations.
pub trait Scalar: DualNum<Primitive = f64> + Copy {
    /// `if_positive` where the real part of `condition` is greater than zero, else `otherwise`.
    /// A NaN condition takes `otherwise`.
    fn select_positive(condition: Self, if_positive: Self, otherwise: Self) -> Self;

    /// The smaller of two values; the other one's derivatives are dropped.
    fn minimum(self, other: Self) -> Self {
        Self::select_positive(other - self, self, other)
    }

    /// The larger of two values; the other one's derivatives are dropped.
    fn maximum(self, other: Self) -> Self {
        Self::select_positive(self - other, self, other)
    }

    /// The value held within `[low, high]`.
    fn clamped(self, low: Self, high: Self) -> Self {
        self.maximum(low).minimum(high)
    }
}

impl Scalar for f64 {
    fn select_positive(condition: Self, if_positive: Self, otherwise: Self) -> Self {
        if condition > 0.0 { if_positive } else { otherwise }
    }
}

macro_rules! impl_scalar_componentwise {
    ($dual:ident { $($part:ident),* }) => {
        impl<T: Scalar> Scalar for $dual<T> {
            fn select_positive(condition: Self, if_positive: Self, otherwise: Self) -> Self {
                $dual {
                    $($part: T::select_positive(condition.re, if_positive.$part, otherwise.$part),)*
                }
            }
        }
    };
}

impl_scalar_componentwise!(Dual { re, eps });
impl_scalar_componentwise!(Dual2 { re, v1, v2 });
impl_scalar_componentwise!(HyperDual { re, eps1, eps2, eps1eps2 });

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;

    #[test]
    fn the_side_not_taken_may_be_infinite() {
        let x = Dual64::new(0.0, 1.0);
        let guarded = Dual64::select_positive(x, x.recip(), Dual64::from(7.0));
        assert_eq!((guarded.re, guarded.eps), (7.0, 0.0));
    }

    #[test]
    fn nested_duals_decide_by_the_innermost_real_part() {
        let x = Dual::new(Dual64::new(2.0, 3.0), Dual64::new(4.0, 5.0));
        let y = Dual::new(Dual64::new(1.0, 0.0), Dual64::new(0.0, 0.0));
        let larger = x.maximum(y);
        assert_eq!(
            (larger.re.re, larger.re.eps, larger.eps.re, larger.eps.eps),
            (2.0, 3.0, 4.0, 5.0)
        );
        assert_eq!(x.minimum(y).eps.re, 0.0);
    }

    #[test]
    fn an_undecidable_condition_takes_the_other_side() {
        assert_eq!(f64::select_positive(f64::NAN, 1.0, 2.0), 2.0);
        assert_eq!(f64::select_positive(0.0, 1.0, 2.0), 2.0);
    }
}
