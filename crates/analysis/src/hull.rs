//! Convex hulls of points in space.
//!
//! Quickhull (Barber, Dobkin, Huhdanpaa, *ACM TOMS* 22, 1996) on triangles: a point belongs to one
//! facet that sees it, the farthest point of a facet replaces all facets that see it. Points within
//! a billionth of the cloud's size of a facet count as on it.
//!
//! Which facets a point sees is decided by Shewchuk's exact predicate (*Discrete & Computational
//! Geometry* 18, 1997): decided by rounded heights, the facets around a nearly flat corner may
//! contradict each other, and the surface then has holes.

use std::collections::HashMap;

use nalgebra::Vector3;
use robust::{Coord3D, orient3d};

const FLATNESS: f64 = 1e-9;

/// A closed surface of triangles, counter-clockwise from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub vertices: Vec<Vector3<f64>>,
    /// Three indices of corners each.
    pub triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// The volume inside, in the cube of the corners' unit.
    pub fn volume(&self) -> f64 {
        let corner = |i: usize| self.vertices[i];
        let sixfold = |&[a, b, c]: &[usize; 3]| corner(a).dot(&corner(b).cross(&corner(c)));
        self.triangles.iter().map(sixfold).sum::<f64>() / 6.0
    }

    /// The surface in the Wavefront OBJ format.
    pub fn to_obj(&self) -> String {
        let corners = self.vertices.iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z));
        let faces = self.triangles.iter();
        let faces = faces.map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
        corners.chain(faces).collect()
    }
}

/// A triangle of the hull so far, with the points that it sees.
struct Facet {
    corners: [usize; 3],
    normal: Vector3<f64>,
    offset: f64,
    outside: Vec<usize>,
    alive: bool,
}

impl Facet {
    /// How far a point is above the facet's plane, up to rounding.
    fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// Whether a point is above the facet's plane, exactly.
    fn is_seen_from(&self, points: &[Vector3<f64>], point: usize) -> bool {
        let [a, b, c] = self.corners.map(|i| coordinates(&points[i]));
        orient3d(a, b, c, coordinates(&points[point])) < 0.0
    }

    fn edges(&self) -> [(usize, usize); 3] {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)]
    }
}

fn coordinates(point: &Vector3<f64>) -> Coord3D<f64> {
    Coord3D { x: point.x, y: point.y, z: point.z }
}

struct Builder<'a> {
    points: &'a [Vector3<f64>],
    facets: Vec<Facet>,
    /// The facet that has a directed edge.
    owner: HashMap<(usize, usize), usize>,
    tolerance: f64,
}

/// The convex hull of `points`; an empty mesh, of no volume, where they lie in a plane.
pub fn convex_hull(points: &[Vector3<f64>]) -> Mesh {
    let Some(corners) = first_tetrahedron(points) else { return Mesh::default() };
    let tolerance = FLATNESS * size(points);
    let mut hull = Builder { points, facets: Vec::new(), owner: HashMap::new(), tolerance };
    let [a, b, c, d] = corners;
    for face in [[a, b, c], [a, c, d], [a, d, b], [b, d, c]] {
        hull.add(face);
    }
    hull.hand_out(0..points.len(), 0);
    let mut next = 0;
    while next < hull.facets.len() {
        if hull.facets[next].alive && !hull.facets[next].outside.is_empty() {
            hull.grow(next);
        }
        next += 1;
    }
    hull.finish()
}

impl Builder<'_> {
    fn add(&mut self, corners: [usize; 3]) {
        let [a, b, c] = corners.map(|i| self.points[i]);
        let normal = (b - a).cross(&(c - a));
        let normal = normal.try_normalize(f64::MIN_POSITIVE).unwrap_or_default();
        let facet =
            Facet { corners, normal, offset: normal.dot(&a), outside: Vec::new(), alive: true };
        for edge in facet.edges() {
            self.owner.insert(edge, self.facets.len());
        }
        self.facets.push(facet);
    }

    /// Gives each point to one of the facets from `first` that see it.
    fn hand_out(&mut self, points: impl IntoIterator<Item = usize>, first: usize) {
        for point in points {
            let sees = |facet: &&mut Facet| {
                facet.height(&self.points[point]) > self.tolerance
                    && facet.is_seen_from(self.points, point)
            };
            if let Some(facet) = self.facets[first..].iter_mut().find(sees) {
                facet.outside.push(point);
            }
        }
    }

    /// Replaces what the farthest point outside facet `start` sees.
    fn grow(&mut self, start: usize) {
        let facet = &self.facets[start];
        let height = |&i: &usize| facet.height(&self.points[i]);
        let farthest = facet.outside.iter().copied().max_by(|a, b| height(a).total_cmp(&height(b)));
        let Some(apex) = farthest else { return };
        let mut visible = vec![start];
        let mut horizon = Vec::new();
        self.facets[start].alive = false;
        let mut k = 0;
        while k < visible.len() {
            for (from, to) in self.facets[visible[k]].edges() {
                let neighbour = self.owner[&(to, from)];
                let facet = &mut self.facets[neighbour];
                if !facet.alive {
                    continue;
                }
                if facet.is_seen_from(self.points, apex) {
                    facet.alive = false;
                    visible.push(neighbour);
                } else {
                    horizon.push((from, to));
                }
            }
            k += 1;
        }
        let orphans: Vec<usize> =
            visible.iter().flat_map(|&i| std::mem::take(&mut self.facets[i].outside)).collect();
        let first = self.facets.len();
        for (from, to) in horizon {
            // An edge between two facets that died after it was met is no horizon.
            if self.facets[self.owner[&(to, from)]].alive {
                self.add([from, to, apex]);
            }
        }
        self.hand_out(orphans.into_iter().filter(|&i| i != apex), first);
    }

    fn finish(self) -> Mesh {
        let mut mesh = Mesh::default();
        let mut renamed = HashMap::new();
        for facet in self.facets.iter().filter(|facet| facet.alive) {
            let triangle = facet.corners.map(|corner| {
                *renamed.entry(corner).or_insert_with(|| {
                    mesh.vertices.push(self.points[corner]);
                    mesh.vertices.len() - 1
                })
            });
            mesh.triangles.push(triangle);
        }
        mesh
    }
}

fn size(points: &[Vector3<f64>]) -> f64 {
    points.iter().map(Vector3::amax).fold(0.0, f64::max)
}

/// Four points that span a volume, the fourth below the plane of the others.
fn first_tetrahedron(points: &[Vector3<f64>]) -> Option<[usize; 4]> {
    let least = FLATNESS * size(points);
    let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
        let all = points.iter().map(distance).enumerate();
        all.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, distance)| *distance > least)
    };
    let origin = *points.first()?;
    let (a, _) = farthest(&|p| (p - origin).norm())?;
    let (b, _) = farthest(&|p| (p - points[a]).norm())?;
    let along = (points[b] - points[a]).normalize();
    let (c, _) = farthest(&|p| along.cross(&(p - points[a])).norm())?;
    let normal = along.cross(&(points[c] - points[a])).normalize();
    let (d, _) = farthest(&|p| normal.dot(&(p - points[a])).abs())?;
    let above = normal.dot(&(points[d] - points[a])) > 0.0;
    Some(if above { [a, c, b, d] } else { [a, b, c, d] })
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};
    use rand_distr::UnitSphere;

    use super::*;

    fn grid(side: i32) -> Vec<Vector3<f64>> {
        let all = 0..=side;
        let point = |x, y, z| Vector3::new(f64::from(x), f64::from(y), f64::from(z));
        let rows = all.clone().flat_map(|x| (0..=side).map(move |y| (x, y)));
        rows.flat_map(|(x, y)| (0..=side).map(move |z| point(x, y, z))).collect()
    }

    /// Each edge has one triangle on either side, and no point is outside.
    fn assert_closed_around(hull: &Mesh, points: &[Vector3<f64>]) {
        let edges = |&[a, b, c]: &[usize; 3]| [(a, b), (b, c), (c, a)];
        let directed: Vec<_> = hull.triangles.iter().flat_map(edges).collect();
        let distinct: HashSet<_> = directed.iter().copied().collect();
        assert_eq!(directed.len(), distinct.len());
        assert!(distinct.iter().all(|&(from, to)| distinct.contains(&(to, from))));
        assert_eq!(hull.triangles.len(), 2 * hull.vertices.len() - 4, "Euler");
        let near = 2.0 * FLATNESS * size(points);
        for triangle in &hull.triangles {
            let [a, b, c] = triangle.map(|i| hull.vertices[i]);
            let normal = (b - a).cross(&(c - a)).normalize();
            assert!(points.iter().all(|p| normal.dot(&(p - a)) < near));
        }
    }

    #[test]
    fn a_grid_of_points_has_the_hull_of_its_corners() {
        let hull = convex_hull(&grid(4));
        assert!((hull.volume() - 64.0).abs() < 1e-12);
    }

    #[test]
    fn every_point_is_inside_a_closed_surface() {
        let angle = |i: usize| i as f64 * 2.399963;
        let points: Vec<_> = (0..3000)
            .map(|i| {
                let z = 1.0 - 2.0 * (i as f64 + 0.5) / 3000.0;
                let r = (1.0 - z * z).sqrt() * if i % 3 == 0 { 1.0 } else { 0.7 };
                Vector3::new(r * angle(i).cos(), r * angle(i).sin(), z)
            })
            .collect();
        let hull = convex_hull(&points);
        assert_closed_around(&hull, &points);
        let sphere = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((0.97..1.0).contains(&(hull.volume() / sphere)), "{}", hull.volume());
    }

    /// The polars of boxes whose extents are known to a billionth: many points almost on a few planes.
    #[test]
    fn nearly_coplanar_points_leave_no_hole() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..100 {
            let half: [f64; 3] = std::array::from_fn(|_| random.random_range(0.1..1.0));
            let corner = |n: Vector3<f64>| (0..3).map(|i| half[i] * n[i].abs()).sum::<f64>();
            let polar = |_| {
                let direction = Vector3::from(random.sample::<[f64; 3], _>(UnitSphere));
                direction / (corner(direction) * (1.0 + random.random_range(-1e-9..1e-9)))
            };
            let points: Vec<_> = (0..300).map(polar).collect();
            assert_closed_around(&convex_hull(&points), &points);
        }
    }

    #[test]
    fn flat_clouds_have_no_volume() {
        let line: Vec<_> = (0..9).map(|i| Vector3::new(f64::from(i), 0.0, 0.0)).collect();
        let plane: Vec<_> = grid(3).into_iter().filter(|p| p.z == 1.0).collect();
        for points in [&line[..], &plane[..], &line[..1], &[]] {
            assert_eq!(convex_hull(points), Mesh::default());
        }
    }
}
