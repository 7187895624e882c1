//! The model traced as expressions: the same values, and no more operations than were measured.

mod support;

use nalgebra::Vector3;
use righting_multibody::{Core, Cuboid, Quaternion, System};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, Function, hessian_lower, jacobian, trace};
use support::{assert_near, table_one};

/// A model function of one vector.
type Model = (&'static str, fn(&System) -> usize, Traced);

struct Traced {
    numbers: fn(&System, &[f64]) -> Vec<f64>,
    expressions: fn(&System, &[Expr]) -> Vec<Expr>,
}

macro_rules! traced {
    ($f:ident) => {
        Traced { numbers: $f::<f64>, expressions: $f::<Expr> }
    };
}

/// y = (q, q̇): ω at zero momentum.
fn reduced_rate<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let (q, qdot) = y.split_at(system.joint_count());
    let at_rest = Vector3::from_element(T::from(0.0));
    system.reduced_angular_rate(q, qdot, &at_rest).as_slice().to_vec()
}

/// y = (q_BN, q, q̇): rate of q_BN at some momentum.
fn attitude_rate<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let attitude = Quaternion::new(y[0], y[1], y[2], y[3]);
    let (q, qdot) = y[4..].split_at(system.joint_count());
    let h0 = Vector3::new(T::from(3.0), T::from(-2.0), T::from(5.0));
    let omega = system.reduced_angular_rate(q, qdot, &attitude.to_body(&h0));
    attitude.rate(&omega).to_array().to_vec()
}

/// y = (x, u): ẋ of the full form.
fn state_derivative<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let (x, u) = y.split_at(13 + 2 * system.joint_count());
    system.state_derivative(x, u, None)
}

/// y = (ω, q, q̇, q̈): ω̇.
fn base_acceleration<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let j = system.joint_count();
    let (q, rest) = y[3..].split_at(j);
    let omega = Vector3::new(y[0], y[1], y[2]);
    system.base_acceleration(&omega, q, &rest[..j], &rest[j..], None).angular.as_slice().to_vec()
}

/// y = (ω, q, q̇, q̈): torques.
fn torques<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let j = system.joint_count();
    let (q, rest) = y[3..].split_at(j);
    system.joint_torques(&Vector3::new(y[0], y[1], y[2]), q, &rest[..j], &rest[j..], None)
}

/// y = q: every squared distance that a planner may ask for.
fn distances<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let links = 0..system.joint_count();
    let long: Vec<usize> =
        links.filter(|&i| system.rows().unwrap().links[i].length_m() > 0.0).collect();
    let to_base = long
        .iter()
        .map(|&a| system.squared_distance_to_point(y, &Core::Link(a), &Vector3::zeros()));
    let pairs = long.iter().flat_map(|&a| long.iter().map(move |&b| (a, b)));
    let apart = pairs.filter(|&(a, b)| a < b && system.length_between_m(a, b) > 0.0);
    to_base
        .chain(
            apart.map(|(a, b)| system.squared_distance_between(y, &Core::Link(a), &Core::Link(b))),
        )
        .collect()
}

/// y = q: the distance of every link with length from a box.
fn box_distances<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let cuboid =
        Cuboid { center_m: Vector3::new(0.1, -0.4, 0.3), half_m: Vector3::new(0.02, 0.5, 0.3) };
    let posture = system.kinematics(y);
    let links = 0..system.joint_count();
    links
        .filter(|&i| system.rows().unwrap().links[i].length_m() > 0.0)
        .map(|link| cuboid.signed_distance(&posture.core(&Core::Link(link))))
        .collect()
}

const MODELS: [Model; 7] = [
    ("reduced rate", |s| 2 * s.joint_count(), traced!(reduced_rate)),
    ("attitude rate", |s| 4 + 2 * s.joint_count(), traced!(attitude_rate)),
    ("base acceleration", |s| 3 + 3 * s.joint_count(), traced!(base_acceleration)),
    ("state derivative", |s| 13 + 3 * s.joint_count(), traced!(state_derivative)),
    ("torques", |s| 3 + 3 * s.joint_count(), traced!(torques)),
    ("distances", |s| s.joint_count(), traced!(distances)),
    ("box distances", |s| s.joint_count(), traced!(box_distances)),
];

#[test]
fn expressions_have_the_model_s_values() {
    for (name, system) in table_one::all() {
        for (model, size, traced) in &MODELS {
            let y: Vec<f64> = (0..size(&system)).map(|i| (2.3 * i as f64).sin() * 0.7).collect();
            let numbers = (traced.numbers)(&system, &y);
            let function = trace(|| {
                let symbols = Expr::symbols("y", y.len());
                let outputs = (traced.expressions)(&system, &symbols);
                Function::builder(name).input("y", &symbols).output("f", &outputs).build().unwrap()
            });
            let mut values = vec![0.0; numbers.len()];
            function.evaluate(&mut function.workspace(), &[&y], &mut [&mut values]);
            println!("{name}, {model}");
            assert_near(&values, &numbers, 1e-11, 0.0);
        }
    }
}

/// Operations of a value, and of value, Jacobian and Hessian together.
fn operations(system: &System, (_, size, traced): &Model) -> (usize, usize) {
    trace(|| {
        let y = Expr::symbols("y", size(system));
        let f = (traced.expressions)(system, &y);
        let multipliers = Expr::symbols("lambda", f.len());
        let lagrangian = f
            .iter()
            .zip(&multipliers)
            .fold(Expr::constant(0.0), |sum, (f, multiplier)| sum + *f * *multiplier);
        let value = Function::builder("f").input("y", &y).output("f", &f).build().unwrap();
        let all = Function::builder("all")
            .input("y", &y)
            .input("lambda", &multipliers)
            .output("f", &f)
            .output_sparse("jacobian", &jacobian(&f, &y))
            .output_sparse("hessian", &hessian_lower(lagrangian, &y))
            .build()
            .unwrap();
        (value.instruction_count(), all.instruction_count())
    })
}

/// The planner's speed is proportional to these. Room of a twentieth is left for changes in how
/// expressions simplify; whoever needs more has made the model slower.
#[test]
fn operations_stay_what_they_were() {
    let measured: [(&str, [(usize, usize); 7]); 4] = [
        (
            "single_link_2dof",
            [(42, 300), (105, 1730), (115, 1545), (206, 3513), (201, 2438), (10, 44), (367, 1680)],
        ),
        (
            "xlink_4dof",
            [
                (110, 1587),
                (172, 3118),
                (267, 4397),
                (367, 7818),
                (549, 9301),
                (187, 2478),
                (1145, 7369),
            ],
        ),
        (
            "canadarm2_table",
            [
                (201, 3126),
                (262, 4977),
                (445, 8395),
                (551, 13933),
                (920, 21259),
                (319, 4564),
                (1410, 9693),
            ],
        ),
        (
            "canadarm2",
            [
                (222, 3998),
                (283, 6009),
                (460, 9029),
                (568, 14666),
                (897, 21167),
                (256, 2962),
                (1798, 13149),
            ],
        ),
    ];
    for ((name, system), (known, measured)) in table_one::all().iter().zip(measured) {
        assert_eq!(*name, known);
        for (model, (value, all)) in MODELS.iter().zip(measured) {
            let now = operations(system, model);
            println!("{name}, {}: {} operations, with derivatives {}", model.0, now.0, now.1);
            assert!(now.0 <= value + value / 20, "{name}, {}: {} above {value}", model.0, now.0);
            assert!(now.1 <= all + all / 20, "{name}, {}: {} above {all}", model.0, now.1);
        }
    }
}

/// Frames of bodies stand where their author put them; the tree is no dearer for it.
#[test]
fn a_serial_arm_of_bodies_costs_what_its_rows_cost() {
    for (name, rows) in &table_one::all()[..3] {
        let bodies = table_one::as_bodies(rows);
        // Distances are between links, which bodies have none of.
        for model in &MODELS[..5] {
            let [of_rows, of_bodies] = [rows, &bodies].map(|system| operations(system, model));
            println!(
                "{name}, {}: {of_rows:?} operations in rows, {of_bodies:?} in bodies",
                model.0
            );
            assert!(of_bodies.0 <= of_rows.0 && of_bodies.1 <= of_rows.1, "{name}, {}", model.0);
        }
    }
}
