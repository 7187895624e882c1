//! The augmented system against one put together entry by entry.

use righting_nlp::*;

/// Three variables; an inequality, an equality, another inequality.
struct Mixed;

/// Lower triangle of W, and J.
const HESSIAN: [(usize, usize); 4] = [(0, 0), (1, 0), (1, 1), (2, 2)];
const JACOBIAN: [(usize, usize); 5] = [(0, 0), (0, 2), (1, 1), (2, 0), (2, 1)];

fn triplets(entries: &[(usize, usize)]) -> TripletStructure {
    let (rows, columns) = entries.iter().map(|&(i, j)| (i as i32, j as i32)).unzip();
    TripletStructure { rows, columns }
}

impl Problem for Mixed {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 3, constraints: 3 }
    }
    fn bounds(&self, bounds: &mut Bounds) {
        (bounds.g_lower[1], bounds.g_upper[1]) = (2.0, 2.0);
        bounds.g_upper[2] = 1.0;
    }
    fn jacobian_structure(&self) -> TripletStructure {
        triplets(&JACOBIAN)
    }
    fn hessian_structure(&self) -> TripletStructure {
        triplets(&HESSIAN)
    }
    fn objective(&mut self, _: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(0.0)
    }
    fn gradient(&mut self, _: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.fill(0.0);
        Ok(())
    }
    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        _: f64,
        _: &[f64],
        _: bool,
        out: &mut [f64],
    ) -> Result<(), EvaluationError> {
        out.fill(0.0);
        Ok(())
    }
}

fn filled() -> AugmentedSystem {
    let mut system = AugmentedSystem::new(&Declarations::of(&Mixed).unwrap());
    system.hessian_mut().copy_from_slice(&[1.0, 2.0, 3.0, 4.0]);
    system.jacobian_mut().copy_from_slice(&[11.0, 12.0, 13.0, 14.0, 15.0]);
    system.diagonal_mut().copy_from_slice(&[0.1, 0.2, 0.3, 0.4, 0.5]);
    system.constraint_diagonal_mut().copy_from_slice(&[-0.6, -0.7, -0.8]);
    system
}

#[test]
fn every_entry_is_where_the_documentation_puts_it() {
    let system = filled();
    assert_eq!((system.variables(), system.primals(), system.constraints()), (3, 5, 3));
    assert_eq!(system.order(), 8);
    // The one equality comes before the two inequalities.
    assert_eq!(system.multipliers(), [6, 5, 7]);
    let mut found = [[0.0; 8]; 8];
    for ((&i, &j), value) in system.rows().iter().zip(system.columns()).zip(system.values()) {
        assert!(i >= j, "({i}, {j}) is in the lower triangle");
        found[i as usize][j as usize] += value;
    }
    let expected = [
        [1.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [2.0, 3.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 4.3, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0],
        [0.0, 13.0, 0.0, 0.0, 0.0, -0.6, 0.0, 0.0],
        [11.0, 0.0, 12.0, -1.0, 0.0, 0.0, -0.7, 0.0],
        [14.0, 15.0, 0.0, 0.0, -1.0, 0.0, 0.0, -0.8],
    ];
    assert_eq!(found, expected);
    assert_eq!(system.jacobian(), [11.0, 12.0, 13.0, 14.0, 15.0]);
}

#[test]
fn curvature_along_a_direction_is_that_of_variables_and_slacks() {
    let d = [1.0, -2.0, 3.0, 4.0, -5.0];
    let of_hessian = 1.0 + 2.0 * 2.0 * -2.0 + 3.0 * 4.0 + 4.0 * 9.0;
    let of_diagonal = 0.1 + 0.2 * 4.0 + 0.3 * 9.0 + 0.4 * 16.0 + 0.5 * 25.0;
    assert!((filled().primal_curvature(&d) - (of_hessian + of_diagonal)).abs() < 1e-12);
}
