//! What an array of reaction wheels can give.
//!
//! A wheel along the unit vector w_i gives h_i w_i with |h_i| ≤ H_i, so an array gives the zonotope
//! Σ [−H_i, H_i] w_i: it reaches Σ H_i |n·w_i| along n, and each of its facets is parallel to two or
//! more wheels (Markley, Reynolds, Liu, Lebsock, *JGCD* 33, 2010). Torques likewise with T_i.

use nalgebra::Vector3;
use righting_scenario::wheels::Wheel;
use serde::Serialize;

use crate::envelope::fibonacci;
use crate::hull::{Mesh, convex_hull};

/// Directions that mean squares are taken over.
const MEAN_DIRECTIONS: usize = 20_000;
/// Two unit vectors whose cross product is shorter than this are parallel.
const PARALLEL: f64 = 1e-9;
/// Rounds over all wheels in the search for the point nearest to another.
const SWEEPS: usize = 500;

/// What an array reaches, in one unit: that of the wheels that work.
#[derive(Clone, Debug, PartialEq)]
pub struct Zonotope {
    /// H_i w_i.
    generators: Vec<Vector3<f64>>,
}

/// How far a body reaches from its center, over all directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Radii {
    /// The largest.
    pub max: f64,
    /// The smallest: what is reached whatever the direction.
    pub min: f64,
    /// Root mean square over the sphere.
    pub rms: f64,
}

impl Zonotope {
    /// All momenta that the wheels can store, N m s.
    pub fn momenta(wheels: &[Wheel]) -> Self {
        Self::within(wheels, |wheel| wheel.momentum_max_n_m_s)
    }

    /// All torques that the wheels can give, N m.
    pub fn torques(wheels: &[Wheel]) -> Self {
        Self::within(wheels, |wheel| wheel.torque_max_n_m)
    }

    fn within(wheels: &[Wheel], limit: impl Fn(&Wheel) -> f64) -> Self {
        let generator = |wheel: &Wheel| Vector3::from(wheel.axis) * limit(wheel);
        let working = wheels.iter().filter(|wheel| !wheel.failed);
        Self { generators: working.map(generator).collect() }
    }

    /// The support function Σ |n·g_i|: the largest component along the unit vector `direction`.
    pub fn extent(&self, direction: &Vector3<f64>) -> f64 {
        self.generators.iter().map(|generator| direction.dot(generator).abs()).sum()
    }

    /// How far a point is from all that the wheels reach together; zero within. It is never more than the truth.
    pub fn distance_to(&self, point: &Vector3<f64>) -> f64 {
        // The nearest point, wheel by wheel: the squared distance is convex in what each gives.
        let mut shares = vec![0.0; self.generators.len()];
        let mut left = *point;
        for _ in 0..SWEEPS {
            for (share, generator) in shares.iter_mut().zip(&self.generators) {
                let before = *share;
                *share =
                    (before + generator.dot(&left) / generator.norm_squared()).clamp(-1.0, 1.0);
                left -= generator * (*share - before);
            }
        }
        // The plane through it across the way there has all that is reached on its one side.
        match left.try_normalize(0.0) {
            Some(way) => (way.dot(point) - self.extent(&way)).max(0.0),
            None => 0.0,
        }
    }

    /// Unit normals of the facets, one of each opposite pair; none if all wheels lie in a plane.
    pub fn facet_normals(&self) -> Vec<Vector3<f64>> {
        let axes: Vec<_> = self.generators.iter().map(Vector3::normalize).collect();
        let mut normals: Vec<Vector3<f64>> = Vec::new();
        for (i, a) in axes.iter().enumerate() {
            for b in &axes[i + 1..] {
                let Some(normal) = a.cross(b).try_normalize(PARALLEL) else { continue };
                let is_new = normals.iter().all(|known| known.cross(&normal).norm() > PARALLEL);
                if is_new && self.extent(&normal) > 0.0 {
                    normals.push(normal);
                }
            }
        }
        let flat =
            |normal: &Vector3<f64>| axes.iter().all(|axis| axis.dot(normal).abs() <= PARALLEL);
        if normals.iter().any(flat) { Vec::new() } else { normals }
    }

    /// The corners: on each facet, those of the wheels parallel to it, the others at the limit that
    /// the facet's side asks for.
    pub fn vertices(&self) -> Vec<Vector3<f64>> {
        let mut corners: Vec<Vector3<f64>> = Vec::new();
        for normal in self.facet_normals() {
            let is_parallel =
                |g: &&Vector3<f64>| g.dot(&normal).abs() <= 10.0 * PARALLEL * g.norm();
            let (within, beyond): (Vec<&Vector3<f64>>, Vec<&Vector3<f64>>) =
                self.generators.iter().partition(is_parallel);
            let center: Vector3<f64> = beyond.iter().map(|&g| g * g.dot(&normal).signum()).sum();
            for edge in &within {
                // A corner of the facet: all wheels at the sign of a direction just off an edge.
                let along = normal.cross(edge);
                let side = edge.normalize() * 1e-6 * along.norm();
                for tilt in [along + side, along - side] {
                    let flat: Vector3<f64> =
                        within.iter().map(|&g| g * g.dot(&tilt).signum()).sum();
                    for corner in [center + flat, center - flat] {
                        corners.extend([corner, -corner]);
                    }
                }
            }
        }
        let size = corners.iter().map(Vector3::norm).fold(0.0, f64::max);
        let mut distinct: Vec<Vector3<f64>> = Vec::new();
        for corner in corners {
            if distinct.iter().all(|known| (known - corner).norm() > 1e-9 * size) {
                distinct.push(corner);
            }
        }
        distinct
    }

    /// The surface; empty if all wheels lie in a plane.
    pub fn mesh(&self) -> Mesh {
        convex_hull(&self.vertices())
    }

    /// 8 Σ |det(g_i, g_j, g_k)| over all triples (McMullen).
    pub fn volume(&self) -> f64 {
        let g = &self.generators;
        let mut volume = 0.0;
        for i in 0..g.len() {
            for j in i + 1..g.len() {
                let normal = g[i].cross(&g[j]);
                volume += g[j + 1..].iter().map(|third| 8.0 * normal.dot(third).abs()).sum::<f64>();
            }
        }
        volume
    }

    /// How far the surface is from the center: at its corners, at its nearest facet, and in the
    /// mean. Wheels in a plane reach nothing across it.
    pub fn radii(&self) -> Radii {
        let normals = self.facet_normals();
        let facets: Vec<(Vector3<f64>, f64)> =
            normals.into_iter().map(|normal| (normal, self.extent(&normal))).collect();
        if facets.is_empty() {
            return Radii { max: self.planar_max(), min: 0.0, rms: 0.0 };
        }
        let radius = |direction: Vector3<f64>| {
            let to_facet =
                facets.iter().map(|(normal, extent)| extent / normal.dot(&direction).abs());
            to_facet.fold(f64::INFINITY, f64::min)
        };
        let squares = fibonacci(MEAN_DIRECTIONS).map(|direction| radius(direction).powi(2));
        Radii {
            max: self.vertices().iter().map(Vector3::norm).fold(0.0, f64::max),
            min: facets.iter().map(|(_, extent)| *extent).fold(f64::INFINITY, f64::min),
            rms: (squares.sum::<f64>() / MEAN_DIRECTIONS as f64).sqrt(),
        }
    }

    /// The farthest corner of wheels in a plane: signs asked for by some wheel's perpendicular.
    fn planar_max(&self) -> f64 {
        let signed = |direction: Vector3<f64>| {
            let sum: Vector3<f64> =
                self.generators.iter().map(|g| if g.dot(&direction) < 0.0 { -g } else { *g }).sum();
            sum.norm()
        };
        let own = self.generators.iter().map(|g| signed(*g));
        let pairs = self
            .generators
            .iter()
            .flat_map(|a| self.generators.iter().flat_map(move |b| [a + b, a - b]));
        own.chain(pairs.map(signed)).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use righting_scenario::WheelArray;
    use righting_scenario::halton::Halton;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found}, {expected}");
    }

    fn random_array(count: usize, seed: u64) -> Vec<Wheel> {
        let wheel = |u: Vec<f64>| Wheel {
            axis: Vector3::new(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5).normalize().into(),
            momentum_max_n_m_s: 0.2 + u[3],
            torque_max_n_m: 0.1 + u[4],
            steady_power_w: 0.0,
            initial_momentum_n_m_s: 0.0,
            inertia_kg_m2: None,
            viscous_friction_n_m_s: 0.0,
            failed: false,
        };
        let points = Halton::starting_after(5, 10 + 100 * seed);
        points.take(count).map(wheel).collect()
    }

    /// Every combination of limits.
    fn corners_by_force(zonotope: &Zonotope) -> Vec<Vector3<f64>> {
        let count = zonotope.generators.len();
        let sign = |mask: usize, i: usize| if mask >> i & 1 == 1 { 1.0 } else { -1.0 };
        let corner =
            |mask| zonotope.generators.iter().enumerate().map(|(i, g)| g * sign(mask, i)).sum();
        (0..1 << count).map(corner).collect()
    }

    #[test]
    fn the_pyramid_is_a_rhombic_dodecahedron() {
        let pyramid = WheelArray::pyramid();
        let momentum = Zonotope::momenta(pyramid.wheels());
        let (max, min) = (4.0 / 3.0_f64.sqrt(), 4.0 / 6.0_f64.sqrt());
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            close(momentum.extent(&axis), max);
        }
        let radii = momentum.radii();
        close(radii.max, max);
        close(radii.min, min);
        assert!(radii.min < radii.rms && radii.rms < radii.max);
        assert_eq!((momentum.facet_normals().len(), momentum.vertices().len()), (6, 14));
        // Of inradius r: 8 √2 r³ / 2.
        close(momentum.volume(), 4.0 * 2.0_f64.sqrt() * min.powi(3));
        close(momentum.mesh().volume(), momentum.volume());
        close(Zonotope::torques(pyramid.wheels()).radii().max, 0.1 * max);
        close(Zonotope::torques(pyramid.wheels()).radii().min, 0.1 * min);
    }

    #[test]
    fn three_wheels_along_the_axes_are_a_box() {
        let wheel = |axis, momentum_max_n_m_s| Wheel {
            axis,
            momentum_max_n_m_s,
            torque_max_n_m: 1.0,
            steady_power_w: 5.0,
            initial_momentum_n_m_s: 0.0,
            inertia_kg_m2: None,
            viscous_friction_n_m_s: 0.0,
            failed: false,
        };
        let wheels = vec![
            wheel([1.0, 0.0, 0.0], 1.0),
            wheel([0.0, 1.0, 0.0], 2.0),
            wheel([0.0, 0.0, 1.0], 3.0),
        ];
        let radii = Zonotope::momenta(&wheels).radii();
        close(radii.max, 14.0_f64.sqrt());
        close(radii.min, 1.0);
        close(Zonotope::momenta(&wheels).volume(), 48.0);
        // A cube of half side 1: the mean square of 1/max|n_i| is 3 (1/(2π)) ∫∫ over a face's
        // solid angle of dx dy (1 + x² + y²)^(−1/2), squared radius 1 + x² + y².
        let (steps, mut integral) = (400, 0.0);
        for i in 0..steps {
            for k in 0..steps {
                let [x, y] = [i, k].map(|i| 2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0);
                integral += (1.0 + x * x + y * y).powf(-0.5) * (2.0 / f64::from(steps)).powi(2);
            }
        }
        let expected = (6.0 * integral / (4.0 * std::f64::consts::PI)).sqrt();
        let found = Zonotope::torques(&wheels).radii().rms;
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }

    #[test]
    fn zonotopes_are_the_hulls_of_all_combinations() {
        for seed in 0..12 {
            let zonotope = Zonotope::momenta(&random_array(3 + seed as usize % 5, seed));
            let all = corners_by_force(&zonotope);
            let hull = convex_hull(&all);
            assert!((hull.volume() / zonotope.volume() - 1.0).abs() < 1e-9);
            assert!((zonotope.mesh().volume() / zonotope.volume() - 1.0).abs() < 1e-9);
            for direction in fibonacci(200) {
                let by_force = all.iter().map(|c| c.dot(&direction)).fold(0.0, f64::max);
                close(zonotope.extent(&direction), by_force);
            }
            let radii = zonotope.radii();
            close(radii.max, all.iter().map(Vector3::norm).fold(0.0, f64::max));
            let to_facet = hull.triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.map(|i| hull.vertices[i]);
                (b - a).cross(&(c - a)).normalize().dot(&a)
            });
            close(radii.min, to_facet.fold(f64::INFINITY, f64::min));
        }
    }

    #[test]
    fn distances_from_zonotopes_are_those_from_their_facets() {
        for seed in 0..12 {
            let zonotope = Zonotope::momenta(&random_array(3 + seed as usize % 5, seed));
            let hull = convex_hull(&corners_by_force(&zonotope));
            for direction in fibonacci(50) {
                let facets =
                    hull.triangles.iter().map(|triangle| triangle.map(|i| hull.vertices[i]));
                for [a, b, c] in facets {
                    // Above the middle of a facet that facet is the nearest.
                    let middle = (a + b + c) / 3.0;
                    let up = (b - a).cross(&(c - a)).normalize();
                    let up = up * up.dot(&middle).signum();
                    close(zonotope.distance_to(&(middle + up * 0.3)), 0.3);
                }
                let reach = zonotope.extent(&direction);
                assert!(zonotope.distance_to(&(direction * 1.01 * reach)) >= 0.01 * reach - 1e-9);
                close(zonotope.distance_to(&(direction * 0.9 * zonotope.radii().min)), 0.0);
            }
        }
    }

    #[test]
    fn wheels_in_a_plane_reach_nothing_across_it() {
        let wheel = |x: f64, y: f64| Wheel {
            axis: [x, y, 0.0],
            momentum_max_n_m_s: 1.0,
            torque_max_n_m: 1.0,
            steady_power_w: 5.0,
            initial_momentum_n_m_s: 0.0,
            inertia_kg_m2: None,
            viscous_friction_n_m_s: 0.0,
            failed: false,
        };
        for wheels in [vec![wheel(1.0, 0.0)], vec![wheel(1.0, 0.0), wheel(0.0, 1.0)]] {
            let zonotope = Zonotope::momenta(&wheels);
            let radii = zonotope.radii();
            assert_eq!((radii.min, zonotope.volume()), (0.0, 0.0));
            close(radii.max, (wheels.len() as f64).sqrt());
            assert_eq!(zonotope.mesh(), Mesh::default());
        }
    }
}
