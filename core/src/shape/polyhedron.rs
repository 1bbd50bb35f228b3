//! The convex polyhedron.
//!
//! E. Haines, "Fast ray-convex polyhedron intersection", Graphics Gems II (1991): a ray is inside
//! after the last plane that it passes inwards and before the first that it passes outwards. That is
//! the test of slabs by T. L. Kay and J. T. Kajiya ("Ray tracing complex scenes", SIGGRAPH 1986) for
//! planes of any direction. No ray gets in between faces.

use super::{Convex, Plane, Shape, ShapeError, settle};
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// What is behind all of some planes; 32 bytes in `f32` where pointers have 32 bits, and the planes,
/// which it borrows and which may lie in flash. A test takes a dot product or two and a division a
/// face.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Polyhedron<'a, R: Real> {
    faces: &'a [Plane<R>],
    bounds: Aabb<R>,
}

/// A face of a polyhedron and where a ray passes its plane.
type Wall<'a, R> = (R, Option<&'a Plane<R>>);

impl<'a, R: Real> Polyhedron<'a, R> {
    /// A polyhedron of planes whose normals point out of it; planes that only touch it or lie
    /// outside change nothing. Measures its bounds: time in proportion to the third power of the
    /// number of faces. [`Shape::check`] tells whether there is a solid behind all of them.
    pub fn new(faces: &'a [Plane<R>]) -> Self {
        Self { faces, bounds: measure(faces) }
    }

    /// A polyhedron with the bounds that [`Polyhedron::new`] would measure, for constants. What sticks
    /// out of them is not hit.
    pub const fn of_parts(faces: &'a [Plane<R>], bounds: Aabb<R>) -> Self {
        Self { faces, bounds }
    }

    /// The planes of its faces.
    pub fn faces(&self) -> &'a [Plane<R>] {
        self.faces
    }

    /// Where the line of a ray enters and leaves, and by which faces.
    fn walls(&self, ray: &Ray<R>) -> Option<[Wall<'a, R>; 2]> {
        let zero = R::Wide::default();
        let (mut enter, mut leave): (Wall<'a, R>, Wall<'a, R>) =
            ((-R::INFINITY, None), (R::INFINITY, None));
        for face in self.faces {
            let towards = face.normal.dot(ray.direction());
            let height = face.normal.dot(face.point - ray.origin());
            let t = R::ratio(height, towards);
            if towards == zero || !t.is_finite() {
                // Along the plane: behind it or not.
                if !(height >= zero) {
                    return None;
                }
            } else if towards < zero {
                if t > enter.0 {
                    enter = (t, Some(face));
                }
            } else if t < leave.0 {
                leave = (t, Some(face));
            }
        }
        (enter.0 <= leave.0).then_some([enter, leave])
    }
}

impl<R: Real> Shape<R> for Polyhedron<'_, R> {
    type PerRay = ();

    fn per_ray(_ray: &Ray<R>) {}

    fn check(&self) -> Result<(), ShapeError> {
        self.faces.iter().try_for_each(Plane::check)?;
        let few = self.faces.len() < 4;
        if few || !(self.bounds.is_empty() || self.bounds.max_abs() < R::MAX) {
            Err(ShapeError::Unbounded)
        } else if self.bounds.is_empty() {
            Err(ShapeError::Degenerate)
        } else if R::is_workable(self.bounds.max_abs()) {
            Ok(())
        } else {
            Err(ShapeError::NotFinite)
        }
    }

    fn bounds(&self) -> Aabb<R> {
        self.bounds
    }

    fn hit(&self, ray: &Ray<R>, _per_ray: &(), min: R, max: R) -> Option<R> {
        let [enter, leave] = self.walls(ray)?;
        let counts = |t| settle(ray, self.bounds, t).filter(|t| *t > min && *t <= max);
        counts(enter.0).or_else(|| counts(leave.0))
    }

    /// Of the face by which the ray enters or leaves; of several the first.
    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        let Some([enter, leave]) = self.walls(ray) else { return Vec3::<R>::default() };
        let (enters, leaves) = ((t - enter.0).abs(), (t - leave.0).abs());
        let face = if enters <= leaves { enter.1 } else { leave.1 };
        face.map_or_else(Vec3::<R>::default, |face| face.normal)
    }
}

impl<R: Real> Convex<R> for Polyhedron<'_, R> {
    fn span(&self, ray: &Ray<R>, _per_ray: &()) -> Option<(R, R)> {
        let [enter, leave] = self.walls(ray)?;
        Some((enter.0, leave.0))
    }

    fn reach(&self) -> R {
        let points = self.faces.iter().map(|face| face.point.max_abs());
        points.fold(self.bounds.max_abs(), R::max)
    }
}

/// A box around what is behind all planes: everything where that has no end, nothing where there is
/// no corner. Every edge lies in two planes; what all the others leave of the line in which these
/// meet ends in corners. Rounding is allowed for: an edge reaches as far as it might.
fn measure<R: Real>(faces: &[Plane<R>]) -> Aabb<R> {
    let mut bounds = Aabb::empty();
    for (i, first) in faces.iter().enumerate() {
        for (j, second) in faces.iter().enumerate().skip(i + 1) {
            let Some((at, along)) = meet(first, second) else { continue };
            let others = faces.iter().enumerate().filter(|(k, _)| *k != i && *k != j);
            let Some((from, to)) = edge(at, along, others.map(|(_, face)| face)) else { continue };
            if !(from > -R::MAX && to < R::MAX) {
                return Aabb { lo: Vec3::<R>::splat(-R::MAX), hi: Vec3::<R>::splat(R::MAX) };
            }
            bounds = bounds.union(Aabb::around([at + along * from, at + along * to]));
        }
    }
    if bounds.is_empty() {
        return bounds;
    }
    bounds.grown(R::ulps_at(8, bounds.max_abs()))
}

/// Below this sine of an angle two directions are taken for one, in units of the last place of 1.
const PARALLEL: i32 = 64;

/// A point and the direction, of length 1, of the line in which two planes meet.
fn meet<R: Real>(first: &Plane<R>, second: &Plane<R>) -> Option<(Vec3<R>, Vec3<R>)> {
    let (m, n) = (first.normal.unit()?, second.normal.unit()?);
    let cross = m.cross(n);
    if !(cross.length() > R::ulps(PARALLEL)) {
        return None;
    }
    let along = cross.unit()?;
    // From the point of the first plane, in that plane, square to the line.
    let way = along.cross(m);
    let step = R::ratio(n.dot(second.point - first.point), n.dot(way));
    Some((first.point + way * step, along))
}

/// What planes leave of a line; nothing where it runs outside of one.
fn edge<'f, R: Real>(
    at: Vec3<R>,
    along: Vec3<R>,
    faces: impl Iterator<Item = &'f Plane<R>>,
) -> Option<(R, R)> {
    let (mut from, mut to) = (-R::MAX, R::MAX);
    for face in faces {
        let normal = face.normal.unit()?;
        let towards = R::narrow(normal.dot(along));
        let height = R::narrow(normal.dot(face.point - at));
        // How far rounding may have moved the line from the plane.
        let error = R::ulps_at(16, at.max_abs() + face.point.max_abs());
        if !(towards.abs() > R::ulps(PARALLEL)) {
            if height < -error {
                return None;
            }
        } else if towards > R::ZERO {
            to = to.min((height + error) / towards);
        } else {
            from = from.max((height + error) / towards);
        }
    }
    (from <= to).then_some((from, to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::AxisBox;
    use crate::shape::testing::{Random, all_hits, hit_or_refused, only_numbers_are_hits, ray};
    use glam::{DVec3, Vec3, vec3};

    extern crate std;
    use std::vec::Vec;

    /// The six planes of a box.
    fn cuboid(lo: Vec3, hi: Vec3) -> Vec<Plane<f32>> {
        let low = [Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z].map(|n| Plane::new(lo, n));
        let high = [Vec3::X, Vec3::Y, Vec3::Z].map(|n| Plane::new(hi, n));
        low.into_iter().chain(high).collect()
    }

    /// Planes across some directions, each at its end.
    fn around(ways: &[Vec3]) -> Vec<Plane<f32>> {
        ways.iter().map(|way| Plane::new(*way, *way)).collect()
    }

    /// The twelve directions to the faces of a dodecahedron.
    fn dodecahedron() -> Vec<Vec3> {
        let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
        let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let ways = signs.iter().flat_map(|(a, b)| {
            let (a, b) = (*a, b * golden);
            [vec3(0.0, a, b), vec3(a, b, 0.0), vec3(b, 0.0, a)]
        });
        ways.map(Vec3::normalize).collect()
    }

    #[test]
    fn six_planes_are_the_published_box() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 12.
        let faces = cuboid(Vec3::NEG_ONE, Vec3::ONE);
        let cube = Polyhedron::<f32>::new(&faces);
        assert_eq!(cube.check(), Ok(()));
        for (o, d, n) in [
            ([5.0, 0.5, 0.0], [-1.0, 0.0, 0.0], Vec3::X),
            ([-5.0, 0.5, 0.0], [1.0, 0.0, 0.0], Vec3::NEG_X),
            ([0.5, 5.0, 0.0], [0.0, -1.0, 0.0], Vec3::Y),
            ([0.5, -5.0, 0.0], [0.0, 1.0, 0.0], Vec3::NEG_Y),
            ([0.5, 0.0, 5.0], [0.0, 0.0, -1.0], Vec3::Z),
            ([0.5, 0.0, -5.0], [0.0, 0.0, 1.0], Vec3::NEG_Z),
        ] {
            let r = ray(o, d);
            assert_eq!(all_hits(&cube, &r), [4.0, 6.0]);
            assert_eq!(cube.normal(&r, 4.0), n);
            assert_eq!(cube.normal(&r, 6.0), -n);
        }
        assert_eq!(all_hits(&cube, &ray([0.0, 0.5, 0.0], [0.0, 0.0, 1.0])), [-1.0, 1.0]);
        for (o, d) in [
            ([-2.0, 0.0, 0.0], [0.2673, 0.5345, 0.8018]),
            ([0.0, -2.0, 0.0], [0.8018, 0.2673, 0.5345]),
            ([2.0, 0.0, 2.0], [0.0, 0.0, -1.0]),
            ([2.0, 2.0, 0.0], [-1.0, 0.0, 0.0]),
        ] {
            assert!(all_hits(&cube, &ray(o, d)).is_empty());
        }
    }

    #[test]
    fn six_planes_are_hit_as_the_box_is() {
        let mut random = Random(8);
        let mut hits = 0;
        for _ in 0..5000 {
            let (a, b) = (random.vector(), random.vector());
            let solid = AxisBox::<f32>::new(a.min(b), a.max(b));
            let faces = cuboid(solid.lo, solid.hi);
            let same = Polyhedron::<f32>::new(&faces);
            let loose = same.bounds().size() - solid.bounds().size();
            assert!(loose.min_element() >= 0.0 && loose.max_element() < 1.0e-5);
            let r = random.ray_at((a + b) * 0.5, 1.0);
            let (found, expected) = (all_hits(&same, &r), all_hits(&solid, &r));
            if found.len() == expected.len() {
                hits += found.len();
                let near = |(a, b): (&f32, &f32)| (a - b).abs() <= 4.0e-6 * b.abs().max(1.0);
                assert!(found.iter().zip(&expected).all(near), "{found:?} {expected:?}");
            } else {
                // Along an edge.
                let all = [found, expected].concat();
                assert!(all.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 1.0e-4), "{all:?}");
            }
        }
        assert!(hits > 1500, "{hits}");
    }

    #[test]
    fn bounds_are_those_of_the_corners() {
        // Five faces meet in a corner of the icosahedron, four in one of the octahedron.
        let twelve = dodecahedron();
        let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
        let corner: Vec<Vec3> = (0..8)
            .map(|i| {
                vec3(
                    f32::from(i & 1_u8) * 2.0 - 1.0,
                    f32::from(i >> 1 & 1) * 2.0 - 1.0,
                    f32::from(i >> 2) * 2.0 - 1.0,
                )
            })
            .collect();
        let twenty: Vec<Vec3> = corner
            .iter()
            .copied()
            .chain(
                [1.0, -1.0]
                    .into_iter()
                    .flat_map(|a| [1.0, -1.0].map(|b| (a / golden, b * golden)))
                    .flat_map(|(a, b)| [vec3(0.0, a, b), vec3(a, b, 0.0), vec3(b, 0.0, a)]),
            )
            .collect();
        let tetra = [vec3(1., 1., 1.), vec3(1., -1., -1.), vec3(-1., 1., -1.), vec3(-1., -1., 1.)];
        for ways in [tetra.to_vec(), corner, twelve, twenty] {
            let faces = around(&ways);
            let solid = Polyhedron::<f32>::new(&faces);
            assert_eq!(solid.check(), Ok(()));
            let size = solid.bounds();
            // All corners are points behind all planes, on three of them; no other point is farther.
            let mut corners = Aabb::<f32>::empty();
            for (i, a) in ways.iter().enumerate() {
                for (j, b) in ways[..i].iter().enumerate() {
                    for c in &ways[..j] {
                        let m = glam::DMat3::from_cols(a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
                        let d = DVec3::from([a, b, c].map(|w| w.as_dvec3().length_squared()));
                        if m.determinant().abs() < 1.0e-6 {
                            continue;
                        }
                        let p = m.transpose().inverse() * d;
                        let far = |w: &Vec3| p.dot(w.as_dvec3()) - w.as_dvec3().length_squared();
                        if ways.iter().all(|w| far(w) < 1.0e-6) {
                            corners = corners.union(Aabb::around([p.as_vec3()]));
                        }
                    }
                }
            }
            let loose = size.size() - corners.size();
            assert!(
                loose.min_element() >= 0.0 && loose.max_element() < 1.0e-4,
                "{size:?} {corners:?}"
            );
        }
    }

    #[test]
    fn agrees_with_double_precision() {
        let mut random = Random(14);
        let (mut hits, mut solids, mut worst) = (0, 0, 0.0_f64);
        while solids < 2000 {
            let place = random.vector() * 4.0;
            let count = 4 + random.within(0.0, 30.0) as usize;
            let faces: Vec<Plane<f32>> = (0..count)
                .map(|_| {
                    let way = random.direction();
                    Plane::new(place + way * random.within(0.5, 1.0), way * random.within(0.1, 9.0))
                })
                .collect();
            let solid = Polyhedron::<f32>::new(&faces);
            if solid.check() == Err(ShapeError::Unbounded) {
                continue;
            }
            assert_eq!(solid.check(), Ok(()));
            solids += 1;
            for _ in 0..10 {
                let r = random.ray_at(place, 1.5);
                let (o, d) = (r.origin().as_dvec3(), r.direction().as_dvec3());
                let (mut enter, mut leave) = ((f64::MIN, 0.0), (f64::MAX, 0.0));
                for face in &faces {
                    let n = face.normal.as_dvec3().normalize();
                    let t = n.dot(face.point.as_dvec3() - o) / n.dot(d);
                    let slant = n.dot(d.normalize());
                    if slant < 0.0 && t > enter.0 {
                        enter = (t, slant);
                    } else if slant > 0.0 && t < leave.0 {
                        leave = (t, slant);
                    }
                }
                let inside = (leave.0 - enter.0) * d.length();
                let found = all_hits(&solid, &r);
                let bounds = solid.bounds().grown(r.slack() * 1.01);
                assert!(found.iter().all(|t| bounds.contains(r.at(*t))));
                if inside.abs() < 1.0e-4 {
                    continue;
                }
                assert_eq!(found.len(), if inside > 0.0 { 2 } else { 0 });
                for (t, (expected, slant)) in found.iter().zip([enter, leave]) {
                    hits += 1;
                    let reach = (place.as_dvec3() - o).length() + 5.0;
                    let error = (f64::from(*t) - expected).abs() * d.length();
                    worst = worst.max(error * slant.abs() / reach);
                    let n = solid.normal(&r, *t).normalize().as_dvec3();
                    assert!((n.dot(d.normalize()) - slant).abs() < 1.0e-5);
                }
            }
        }
        std::println!("{hits} crossings, worst {worst:e}");
        assert!(hits > 10_000 && worst < 1.0e-6, "{hits} {worst:e}");
    }

    #[test]
    fn only_numbers_are_hits_of_polyhedra() {
        only_numbers_are_hits(&Polyhedron::<f32>::new(&around(&dodecahedron())));
        only_numbers_are_hits(&Polyhedron::<f32>::new(&cuboid(Vec3::ZERO, vec3(1.0, 0.5, 0.2))));
    }

    #[test]
    fn polyhedra_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let count = 30;
            let faces = (0..count).map(|_| {
                let way = random.direction();
                Plane::new(place + way * (size * random.within(0.5, 1.0)), way)
            });
            (Polyhedron::<f32>::new(Vec::leak(faces.collect())), [place])
        });
    }

    #[test]
    fn what_has_no_end_or_no_inside_is_refused() {
        let check = |faces: &[Plane<f32>]| Polyhedron::<f32>::new(faces).check();
        let cube = cuboid(Vec3::NEG_ONE, Vec3::ONE);
        assert_eq!(check(&[]), Err(ShapeError::Unbounded));
        for gone in 0..6 {
            let mut five = cube.clone();
            five.remove(gone);
            assert_eq!(check(&five), Err(ShapeError::Unbounded));
        }
        let with = |plane| check(&[&cube[..], &[plane]].concat());
        // A face more: away, touching, twice, cutting, cutting everything off.
        assert_eq!(with(Plane::new(Vec3::X * 3.0, Vec3::X)), Ok(()));
        assert_eq!(with(Plane::new(Vec3::ONE, Vec3::ONE)), Ok(()));
        assert_eq!(with(Plane::new(Vec3::ONE, Vec3::X * 7.0)), Ok(()));
        assert_eq!(with(Plane::new(Vec3::ZERO, Vec3::ONE)), Ok(()));
        assert_eq!(with(Plane::new(Vec3::X * 3.0, Vec3::NEG_X)), Err(ShapeError::Degenerate));
        assert_eq!(with(Plane::new(Vec3::X, Vec3::ZERO)), Err(ShapeError::NotUnit));
        assert_eq!(with(Plane::new(Vec3::NAN, Vec3::X)), Err(ShapeError::NotFinite));
    }
}
