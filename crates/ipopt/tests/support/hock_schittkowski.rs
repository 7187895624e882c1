//! Problems of Hock & Schittkowski, *Test Examples for Nonlinear Programming Codes* (1981), with
//! derivatives by dual numbers, all entries of them.

use num_dual::{Dual64, DualNum, HyperDual64};
use righting_ipopt::*;

const INF: f64 = f64::INFINITY;

/// The functions of a problem, once for all kinds of numbers.
pub trait Functions {
    const NAME: &'static str;
    const X_BOUNDS: &'static [(f64, f64)];
    const G_BOUNDS: &'static [(f64, f64)];
    const START: &'static [f64];
    const OBJECTIVE: f64;
    const SOLUTION: &'static [f64];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D;
    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D>;
}

/// A [`Functions`] as a [`Problem`].
pub struct Dense<F>(pub F);

impl<F: Functions> Dense<F> {
    fn n() -> usize {
        F::X_BOUNDS.len()
    }

    fn m() -> usize {
        F::G_BOUNDS.len()
    }

    fn lower_triangle() -> impl Iterator<Item = (usize, usize)> {
        (0..Self::n()).flat_map(|i| (0..=i).map(move |j| (i, j)))
    }

    /// The point with a derivative in direction j.
    fn dual(x: &[f64], j: usize) -> Vec<Dual64> {
        let part = |i| f64::from(u8::from(i == j));
        x.iter().enumerate().map(|(i, &x)| Dual64::new(x, part(i))).collect()
    }
}

fn indices(of: impl Iterator<Item = (usize, usize)>) -> TripletStructure {
    let (rows, columns) = of.map(|(i, j)| (i as i32, j as i32)).unzip();
    TripletStructure { rows, columns }
}

impl<F: Functions> Problem for Dense<F> {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: Self::n(), constraints: Self::m() }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        for (i, (lower, upper)) in F::X_BOUNDS.iter().enumerate() {
            (bounds.x_lower[i], bounds.x_upper[i]) = (*lower, *upper);
        }
        for (i, (lower, upper)) in F::G_BOUNDS.iter().enumerate() {
            (bounds.g_lower[i], bounds.g_upper[i]) = (*lower, *upper);
        }
    }

    fn jacobian_structure(&self) -> TripletStructure {
        indices((0..Self::n()).flat_map(|j| (0..Self::m()).map(move |i| (i, j))))
    }

    fn hessian_structure(&self) -> TripletStructure {
        indices(Self::lower_triangle())
    }

    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(F::objective(x))
    }

    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        for (j, out) in out.iter_mut().enumerate() {
            *out = F::objective(&Self::dual(x, j)).eps;
        }
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g.copy_from_slice(&F::constraints(x));
        Ok(())
    }

    fn jacobian(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        for (j, column) in out.chunks_exact_mut(Self::m().max(1)).enumerate() {
            for (out, g) in column.iter_mut().zip(F::constraints(&Self::dual(x, j))) {
                *out = g.eps;
            }
        }
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        _: bool,
        objective_factor: f64,
        multipliers: &[f64],
        _: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        for (value, (i, j)) in values.iter_mut().zip(Self::lower_triangle()) {
            let mut x: Vec<HyperDual64> = x.iter().map(|&x| HyperDual64::from_re(x)).collect();
            x[i].eps1 = 1.0;
            x[j].eps2 = 1.0;
            let constraints = F::constraints(&x);
            let curvature: f64 =
                constraints.iter().zip(multipliers).map(|(g, l)| g.eps1eps2 * l).sum();
            *value = objective_factor * F::objective(&x).eps1eps2 + curvature;
        }
        Ok(())
    }
}

pub struct Hs006;
impl Functions for Hs006 {
    const NAME: &'static str = "HS006";
    const X_BOUNDS: &'static [(f64, f64)] = &[(-INF, INF); 2];
    const G_BOUNDS: &'static [(f64, f64)] = &[(0.0, 0.0)];
    const START: &'static [f64] = &[-1.2, 1.0];
    const OBJECTIVE: f64 = 0.0;
    const SOLUTION: &'static [f64] = &[1.0, 1.0];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        (x[0] - 1.0).powi(2)
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
        vec![(x[1] - x[0] * x[0]) * 10.0]
    }
}

pub struct Hs035;
impl Functions for Hs035 {
    const NAME: &'static str = "HS035";
    const X_BOUNDS: &'static [(f64, f64)] = &[(0.0, INF); 3];
    const G_BOUNDS: &'static [(f64, f64)] = &[(-INF, 3.0)];
    const START: &'static [f64] = &[0.5; 3];
    const OBJECTIVE: f64 = 1.0 / 9.0;
    const SOLUTION: &'static [f64] = &[4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        let linear = x[0] * 8.0 + x[1] * 6.0 + x[2] * 4.0;
        let squares = x[0] * x[0] * 2.0 + x[1] * x[1] * 2.0 + x[2] * x[2];
        squares + x[0] * x[1] * 2.0 + x[0] * x[2] * 2.0 - linear + 9.0
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
        vec![x[0] + x[1] + x[2] * 2.0]
    }
}

/// Colville's fourth problem: bounds only, and not convex at the start.
pub struct Hs038;
impl Functions for Hs038 {
    const NAME: &'static str = "HS038";
    const X_BOUNDS: &'static [(f64, f64)] = &[(-10.0, 10.0); 4];
    const G_BOUNDS: &'static [(f64, f64)] = &[];
    const START: &'static [f64] = &[-3.0, -1.0, -3.0, -1.0];
    const OBJECTIVE: f64 = 0.0;
    const SOLUTION: &'static [f64] = &[1.0; 4];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        let (b, d) = (x[1] - 1.0, x[3] - 1.0);
        (x[1] - x[0] * x[0]).powi(2) * 100.0
            + (x[0] - 1.0).powi(2)
            + (x[3] - x[2] * x[2]).powi(2) * 90.0
            + (x[2] - 1.0).powi(2)
            + (b * b + d * d) * 10.1
            + b * d * 19.8
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(_: &[D]) -> Vec<D> {
        Vec::new()
    }
}

pub struct Hs040;
impl Functions for Hs040 {
    const NAME: &'static str = "HS040";
    const X_BOUNDS: &'static [(f64, f64)] = &[(-INF, INF); 4];
    const G_BOUNDS: &'static [(f64, f64)] = &[(1.0, 1.0), (0.0, 0.0), (0.0, 0.0)];
    const START: &'static [f64] = &[0.8; 4];
    const OBJECTIVE: f64 = -0.25;
    // 2^(−1/3), 2^(−1/2), 2^(−11/12), 2^(−1/4)
    const SOLUTION: &'static [f64] = &[
        0.793_700_525_984_1,
        std::f64::consts::FRAC_1_SQRT_2,
        0.529_731_547_179_6,
        0.840_896_415_253_7,
    ];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        -(x[0] * x[1] * x[2] * x[3])
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
        vec![x[0].powi(3) + x[1] * x[1], x[0] * x[0] * x[3] - x[2], x[3] * x[3] - x[1]]
    }
}

pub struct Hs071;
impl Functions for Hs071 {
    const NAME: &'static str = "HS071";
    const X_BOUNDS: &'static [(f64, f64)] = &[(1.0, 5.0); 4];
    const G_BOUNDS: &'static [(f64, f64)] = &[(25.0, INF), (40.0, 40.0)];
    const START: &'static [f64] = &[1.0, 5.0, 5.0, 1.0];
    const OBJECTIVE: f64 = 17.014_017_3;
    const SOLUTION: &'static [f64] = &[1.0, 4.742_999_4, 3.821_150_3, 1.379_408_2];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
        let squares = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
        vec![x[0] * x[1] * x[2] * x[3], squares]
    }
}

pub struct Hs100;
impl Functions for Hs100 {
    const NAME: &'static str = "HS100";
    const X_BOUNDS: &'static [(f64, f64)] = &[(-INF, INF); 7];
    const G_BOUNDS: &'static [(f64, f64)] = &[(0.0, INF); 4];
    const START: &'static [f64] = &[1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0];
    const OBJECTIVE: f64 = 680.630_057_3;
    const SOLUTION: &'static [f64] =
        &[2.330_499, 1.951_372, -0.477_541_4, 4.365_726, -0.624_487_0, 1.038_131, 1.594_227];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        (x[0] - 10.0).powi(2)
            + (x[1] - 12.0).powi(2) * 5.0
            + x[2].powi(4)
            + (x[3] - 11.0).powi(2) * 3.0
            + x[4].powi(6) * 10.0
            + x[5].powi(2) * 7.0
            + x[6].powi(4)
            - x[5] * x[6] * 4.0
            - x[5] * 10.0
            - x[6] * 8.0
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
        let s = |i: usize| x[i] * x[i];
        vec![
            -(s(0) * 2.0 + x[1].powi(4) * 3.0 + x[2] + s(3) * 4.0 + x[4] * 5.0) + 127.0,
            -(x[0] * 7.0 + x[1] * 3.0 + s(2) * 10.0 + x[3] - x[4]) + 282.0,
            -(x[0] * 23.0 + s(1) + s(5) * 6.0 - x[6] * 8.0) + 196.0,
            x[0] * x[1] * 3.0 + x[6] * 11.0 - s(0) * 4.0 - s(1) - s(2) * 2.0 - x[5] * 5.0,
        ]
    }
}
