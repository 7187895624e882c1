//! A workload for measurements: the attitude of a free-floating base that carries a chain of
//! revolute joints. A stand-in for a real model, with its shape and size but no claim to physics.

use nalgebra::{Matrix3, SMatrix, Vector3};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, Function, FunctionError, SparseMatrix, hessian_lower, jacobian};

/// One row of Denavit–Hartenberg parameters with a mass on its segment.
struct Link {
    mass: f64,
    a: f64,
    /// cos α and sin α, exact at right angles.
    twist: (f64, f64),
    d: f64,
    offset: f64,
}

const RIGHT: (f64, f64) = (0.0, 1.0);
const LEFT: (f64, f64) = (0.0, -1.0);
const STRAIGHT: (f64, f64) = (1.0, 0.0);

fn links(joints: usize) -> Vec<Link> {
    let table = [
        (105.0, 0.0, RIGHT, 0.38, 0.3),
        (105.0, 0.0, LEFT, 0.38, -0.2),
        (314.0, 6.85, STRAIGHT, 0.48, 0.0),
        (279.0, 6.85, STRAIGHT, 0.43, 0.1),
        (105.0, 0.0, RIGHT, 0.38, 0.0),
        (105.0, 0.0, LEFT, 0.38, 0.4),
        (243.0, 0.0, STRAIGHT, 0.46, 0.0),
    ];
    let row = |i: usize| {
        let (mass, a, twist, d, offset) = table[i % table.len()];
        Link { mass, a, twist, d, offset }
    };
    (0..joints).map(row).collect()
}

const BASE_MASS: f64 = 2000.0;
const BASE_INERTIA: f64 = 750.0;
const MOUNT: [f64; 3] = [0.0, 0.0, 0.75];

/// Everything outboard of a joint, about the joint's origin in its frame.
struct Outboard<T> {
    mass: f64,
    first_moment: Vector3<T>,
    /// xx, xy, xz, yy, yz, zz of Σ m r rᵀ.
    second_moment: [T; 6],
    momentum: Vector3<T>,
    angular_momentum: Vector3<T>,
}

impl<T: Scalar> Outboard<T> {
    fn empty() -> Self {
        let zero = T::from(0.0);
        Outboard {
            mass: 0.0,
            first_moment: Vector3::repeat(zero),
            second_moment: [zero; 6],
            momentum: Vector3::repeat(zero),
            angular_momentum: Vector3::repeat(zero),
        }
    }

    fn shift(&mut self, t: [f64; 3]) {
        let g = self.first_moment;
        let mixed = |i: usize, j: usize| {
            g[i] * T::from(t[j]) + g[j] * T::from(t[i]) + T::from(self.mass * t[i] * t[j])
        };
        for (entry, (i, j)) in
            self.second_moment.iter_mut().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)])
        {
            *entry += mixed(i, j);
        }
        let t = Vector3::from(t).map(T::from);
        self.angular_momentum += t.cross(&self.momentum);
        self.first_moment += t * T::from(self.mass);
    }

    fn add_rod(&mut self, mass: f64, t: [f64; 3]) {
        let pairs = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
        for (entry, (i, j)) in self.second_moment.iter_mut().zip(pairs) {
            *entry += T::from(mass / 3.0 * t[i] * t[j]);
        }
        self.first_moment += Vector3::from(t).map(|x| T::from(0.5 * mass * x));
        self.mass += mass;
    }

    /// Turns everything at `rate` about z.
    fn spin(&mut self, rate: T) {
        let g = self.first_moment;
        let [xx, _, xz, yy, yz, _] = self.second_moment;
        self.momentum += Vector3::new(-g.y, g.x, T::from(0.0)) * rate;
        self.angular_momentum += Vector3::new(-xz, -yz, xx + yy) * rate;
    }

    fn turn_about_z(&mut self, s: T, c: T) {
        let turn = |v: Vector3<T>| Vector3::new(v.x * c - v.y * s, v.x * s + v.y * c, v.z);
        self.first_moment = turn(self.first_moment);
        self.momentum = turn(self.momentum);
        self.angular_momentum = turn(self.angular_momentum);
        let [xx, xy, xz, yy, yz, zz] = self.second_moment;
        let w = (xx - yy) * s + xy * T::from(2.0) * c;
        let moved = w * s;
        self.second_moment =
            [xx - moved, w * c - xy, xz * c - yz * s, yy + moved, xz * s + yz * c, zz];
    }

    fn turn_about_x(&mut self, (c, s): (f64, f64)) {
        let [c, s] = [c, s].map(T::from);
        let turn = |v: Vector3<T>| Vector3::new(v.x, v.y * c - v.z * s, v.y * s + v.z * c);
        self.first_moment = turn(self.first_moment);
        self.momentum = turn(self.momentum);
        self.angular_momentum = turn(self.angular_momentum);
        let [xx, xy, xz, yy, yz, zz] = self.second_moment;
        let two = T::from(2.0);
        self.second_moment = [
            xx,
            xy * c - xz * s,
            xy * s + xz * c,
            yy * c * c - yz * s * c * two + zz * s * s,
            (yy - zz) * s * c + yz * (c * c - s * s),
            yy * s * s + yz * s * c * two + zz * c * c,
        ];
    }
}

/// Third row of a direction cosine matrix and its companions: the transposed rotation of a unit
/// quaternion (w, x, y, z), inertial to body.
fn into_body<T: Scalar>(q: &[T], v: &[T]) -> Vector3<T> {
    let [w, x, y, z] = [q[0], q[1], q[2], q[3]];
    let (one, two) = (T::from(1.0), T::from(2.0));
    let columns = Matrix3::new(
        one - two * (y * y + z * z),
        two * (x * y - w * z),
        two * (x * z + w * y),
        two * (x * y + w * z),
        one - two * (x * x + z * z),
        two * (y * z - w * x),
        two * (x * z - w * y),
        two * (y * z + w * x),
        one - two * (x * x + y * y),
    );
    columns.transpose() * Vector3::new(v[0], v[1], v[2])
}

fn solve_symmetric<T: Scalar>([xx, xy, xz, yy, yz, zz]: [T; 6], b: &Vector3<T>) -> Vector3<T> {
    let (axx, axy, axz) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
    let (ayy, ayz, azz) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
    let reciprocal = (xx * axx + xy * axy + xz * axz).recip();
    Matrix3::new(axx, axy, axz, axy, ayy, ayz, axz, ayz, azz) * b * reciprocal
}

/// Rate of the attitude quaternion, from attitude, joint angles, joint rates and the total angular
/// momentum in inertial axes.
pub fn attitude_rate<T: Scalar>(
    attitude: &[T],
    angles: &[T],
    rates: &[T],
    momentum: &[T],
) -> [T; 4] {
    let mut arm = Outboard::<T>::empty();
    for (link, (&angle, &rate)) in links(angles.len()).iter().zip(angles.iter().zip(rates)).rev() {
        let reach = [link.a, 0.0, link.d];
        arm.turn_about_x(link.twist);
        arm.shift(reach);
        arm.add_rod(link.mass, reach);
        arm.spin(rate);
        let (s, c) = (angle + T::from(link.offset)).sin_cos();
        arm.turn_about_z(s, c);
    }
    arm.shift(MOUNT);

    // About the centre of mass of the whole: second and angular moments lose the mean's.
    let (g, inverse_mass) = (arm.first_moment, T::from(1.0 / (BASE_MASS + arm.mass)));
    let mean = g * inverse_mass;
    let [xx, xy, xz, yy, yz, zz] = arm.second_moment;
    let (xx, yy, zz) = (xx - mean.x * g.x, yy - mean.y * g.y, zz - mean.z * g.z);
    let (xy, xz, yz) = (xy - mean.x * g.y, xz - mean.x * g.z, yz - mean.y * g.z);
    let base = T::from(BASE_INERTIA);
    let inertia = [yy + zz + base, -xy, -xz, xx + zz + base, -yz, xx + yy + base];
    let relative = arm.angular_momentum - mean.cross(&arm.momentum);

    let omega = solve_symmetric(inertia, &(into_body(attitude, momentum) - relative));
    let half = T::from(0.5);
    let [w, x, y, z] = [attitude[0], attitude[1], attitude[2], attitude[3]];
    [
        (-x * omega.x - y * omega.y - z * omega.z) * half,
        (w * omega.x + y * omega.z - z * omega.y) * half,
        (w * omega.y + z * omega.x - x * omega.z) * half,
        (w * omega.z + x * omega.y - y * omega.x) * half,
    ]
}

/// The expressions of f, its Jacobian and the Hessian of λᵀf.
pub struct Derivatives {
    pub state: Vec<Expr>,
    pub momentum: Vec<Expr>,
    pub multipliers: Vec<Expr>,
    pub rate: [Expr; 4],
    pub jacobian: SparseMatrix,
    pub hessian: SparseMatrix,
}

/// Traces the model and differentiates it by attitude, angles and rates.
pub fn differentiate(joints: usize) -> Derivatives {
    let state = Expr::symbols("state", 4 + 2 * joints);
    let momentum = Expr::symbols("momentum", 3);
    let multipliers = Expr::symbols("multiplier", 4);
    let (attitude, rest) = state.split_at(4);
    let (angles, rates) = rest.split_at(joints);
    let rate = attitude_rate(attitude, angles, rates, &momentum);
    let rows = SMatrix::<Expr, 4, 1>::from(rate);
    let lagrangian = rows.dot(&SMatrix::<Expr, 4, 1>::from_column_slice(&multipliers));
    let jacobian = jacobian(&rate, &state);
    let hessian = hessian_lower(lagrangian, &state);
    Derivatives { state, momentum, multipliers, rate, jacobian, hessian }
}

/// Compiles expressions of the graph in scope.
pub fn compile(d: &Derivatives) -> Result<Function, FunctionError> {
    Function::builder("chain")
        .input("state", &d.state)
        .input("momentum", &d.momentum)
        .input("multiplier", &d.multipliers)
        .output("rate", &d.rate)
        .output_sparse("jacobian", &d.jacobian)
        .output_sparse("hessian", &d.hessian)
        .build()
}
