//! Directions spread over the sphere.

use std::collections::HashMap;

use nalgebra::Vector3;

/// The corners of an octahedron refined `level` times: 4ˡ⁺¹ + 2 unit vectors, the six axes first,
/// each with its opposite. The first 4ᵐ⁺¹ + 2 are those of level m.
pub(super) fn octahedral(level: usize) -> Vec<Vector3<f64>> {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let mut points = vec![x, y, z, -x, -y, -z];
    let mut triangles = Vec::new();
    for (a, b, c) in [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2)] {
        triangles.push([a, b, c]);
        triangles.push([b, a, 5]);
    }
    for _ in 0..level {
        let mut middles = HashMap::new();
        let mut middle = |a: usize, b: usize| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a] + points[b]).normalize());
                points.len() - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    points
}

/// `count` unit vectors on a spherical Fibonacci lattice, each standing for the same area.
pub fn fibonacci(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let radius = (1.0 - z * z).sqrt();
        let (sin, cos) = (golden * i as f64).sin_cos();
        Vector3::new(radius * cos, radius * sin, z)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refinements_nest_and_are_symmetric() {
        for level in 0..4 {
            let points = octahedral(level);
            assert_eq!(points.len(), 4usize.pow(level as u32 + 1) + 2);
            assert_eq!(octahedral(level + 1)[..points.len()], points[..]);
            for p in &points {
                assert!((p.norm() - 1.0).abs() < 1e-15);
                assert!(points.iter().any(|q| (p + q).norm() < 1e-12));
            }
        }
    }

    #[test]
    fn the_lattice_is_even() {
        let spread: nalgebra::Matrix3<f64> = fibonacci(5000).map(|n| n * n.transpose()).sum();
        assert!((spread / 5000.0 - nalgebra::Matrix3::identity() / 3.0).amax() < 1e-4);
    }
}
