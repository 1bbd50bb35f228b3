//! The axis-aligned box as a solid.
//!
//! T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986; see [`Slopes::clip`].

use super::overlap::box_surface;
use super::{Shape, ShapeError};
use crate::geom::{Aabb, Ray, Slopes};
use crate::num::{Axis, Real, Vec3, Vector};

/// A closed box with edges along the axes; 24 bytes in `f32`. Its faces, edges and corners belong to
/// it: a ray that runs inside a face enters and leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AxisBox<R: Real> {
    /// Least corner.
    pub lo: Vec3<R>,
    /// Greatest corner. In one axis it may equal `lo`: a rectangle.
    pub hi: Vec3<R>,
}

impl<R: Real> AxisBox<R> {
    /// A box between two corners.
    pub const fn new(lo: Vec3<R>, hi: Vec3<R>) -> Self {
        Self { lo, hi }
    }
}

impl<R: Real> Shape<R> for AxisBox<R> {
    type PerRay = Slopes<R>;

    fn per_ray(ray: &Ray<R>) -> Slopes<R> {
        Slopes::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        if !(self.lo.is_finite() && self.hi.is_finite() && R::is_workable(self.bounds().max_abs()))
        {
            return Err(ShapeError::NotFinite);
        }
        let size = self.bounds().size().to_array();
        if size.iter().any(|s| *s < R::ZERO) {
            Err(ShapeError::Negative)
        } else if size.iter().filter(|s| **s == R::ZERO).count() > 1 {
            Err(ShapeError::Degenerate)
        } else {
            Ok(())
        }
    }

    fn bounds(&self) -> Aabb<R> {
        Aabb { lo: self.lo, hi: self.hi }
    }

    fn overlaps(&self, cell: &Aabb<R>) -> bool {
        box_surface(&self.bounds(), cell)
    }

    fn hit(&self, _ray: &Ray<R>, slopes: &Slopes<R>, min: R, max: R) -> Option<R> {
        let (enter, leave) = slopes.clip(self.lo, self.hi, -R::MAX, R::MAX)?;
        let t = if enter > min { enter } else { leave };
        // A direction too short for its reciprocals crosses nothing: the ends are those of numbers.
        (t > min && t <= max && t.abs() < R::MAX).then_some(t)
    }

    /// Of the face whose plane is crossed at `t`; on an edge or a corner x goes before y and z, and
    /// on a rectangle it looks against the ray.
    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        let slopes = Slopes::of(ray);
        let mut best = (R::INFINITY, Vec3::<R>::default());
        for axis in Axis::ALL {
            let sign = R::from_i32(slopes.sign(axis));
            let (near, far) = match slopes.sign(axis) {
                0 => continue,
                1 => (self.lo, self.hi),
                _ => (self.hi, self.lo),
            };
            for (wall, out) in [(near, -sign), (far, sign)] {
                let off = (slopes.crossing(axis, wall.along(axis)) - t).abs();
                if off < best.0 {
                    let unit = Axis::ALL.map(|a| if a == axis { out } else { R::ZERO });
                    best = (off, Vec3::<R>::from_array(unit));
                }
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{Random, all_hits, hit_or_refused, only_numbers_are_hits, ray};
    use glam::{Vec3, vec3};

    extern crate std;
    use std::vec::Vec;

    const CUBE: AxisBox<f32> = AxisBox::new(Vec3::NEG_ONE, Vec3::ONE);

    #[test]
    fn published_crossings() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 12.
        for (o, d, expected) in [
            ([5.0, 0.5, 0.0], [-1.0, 0.0, 0.0], [4.0, 6.0]),
            ([-5.0, 0.5, 0.0], [1.0, 0.0, 0.0], [4.0, 6.0]),
            ([0.5, 5.0, 0.0], [0.0, -1.0, 0.0], [4.0, 6.0]),
            ([0.5, -5.0, 0.0], [0.0, 1.0, 0.0], [4.0, 6.0]),
            ([0.5, 0.0, 5.0], [0.0, 0.0, -1.0], [4.0, 6.0]),
            ([0.5, 0.0, -5.0], [0.0, 0.0, 1.0], [4.0, 6.0]),
            ([0.0, 0.5, 0.0], [0.0, 0.0, 1.0], [-1.0, 1.0]),
        ] {
            assert_eq!(all_hits(&CUBE, &ray(o, d)), expected);
        }
        for (o, d) in [
            ([-2.0, 0.0, 0.0], [0.2673, 0.5345, 0.8018]),
            ([0.0, -2.0, 0.0], [0.8018, 0.2673, 0.5345]),
            ([0.0, 0.0, -2.0], [0.5345, 0.8018, 0.2673]),
            ([2.0, 0.0, 2.0], [0.0, 0.0, -1.0]),
            ([0.0, 2.0, 2.0], [0.0, -1.0, 0.0]),
            ([2.0, 2.0, 0.0], [-1.0, 0.0, 0.0]),
        ] {
            assert!(all_hits(&CUBE, &ray(o, d)).is_empty());
        }
    }

    #[test]
    fn published_normals() {
        for (p, n) in [
            ([1.0, 0.5, -0.8], Vec3::X),
            ([-1.0, -0.2, 0.9], Vec3::NEG_X),
            ([-0.4, 1.0, -0.1], Vec3::Y),
            ([0.3, -1.0, -0.7], Vec3::NEG_Y),
            ([-0.6, 0.3, 1.0], Vec3::Z),
            ([0.4, 0.4, -1.0], Vec3::NEG_Z),
            ([1.0, 1.0, 1.0], Vec3::X),
            ([-1.0, -1.0, -1.0], Vec3::NEG_X),
        ] {
            // Out of the middle, and into the box from twice as far.
            let outwards = ray([0.0; 3], p);
            let [_, t] = all_hits(&CUBE, &outwards)[..] else { panic!("not two hits") };
            assert_eq!(CUBE.normal(&outwards, t), n);
            let inwards = Ray::new(Vec3::from(p) * 2.0, -Vec3::from(p)).unwrap();
            let [t, _] = all_hits(&CUBE, &inwards)[..] else { panic!("not two hits") };
            assert_eq!(CUBE.normal(&inwards, t), n);
        }
    }

    #[test]
    fn rays_in_faces_edges_and_corners_are_inside() {
        for zero in [0.0, -0.0] {
            for axis in 0..3 {
                // Along the axis in faces and edges, and just beside.
                for (u, v) in [(1.0, 0.0), (-1.0, 0.3), (0.0, 1.0), (1.0, 1.0), (-1.0, 1.0)] {
                    let place = |u: f32, v: f32| {
                        let (mut o, mut d) = ([u, v, -5.0], [zero, zero, 1.0]);
                        o.rotate_right(axis);
                        d.rotate_right(axis);
                        ray(o, d)
                    };
                    assert_eq!(all_hits(&CUBE, &place(u, v)), [4.0, 6.0]);
                    let beside = place(u * 1.000_001, v * 1.000_001);
                    assert!(all_hits(&CUBE, &beside).is_empty());
                }
            }
        }
        // Across an edge and through a corner, touching only there.
        assert_eq!(all_hits(&CUBE, &ray([2.0, 0.0, 0.5], [-1.0, 1.0, 0.0])), [1.0]);
        assert_eq!(all_hits(&CUBE, &ray([2.0, 0.0, 0.0], [-1.0, 1.0, 1.0])), [1.0]);
        assert_eq!(all_hits(&CUBE, &ray([3.0, 3.0, 3.0], [-1.0, -1.0, -1.0])), [2.0, 4.0]);
    }

    #[test]
    fn a_rectangle_is_hit_once_and_looks_against_the_ray() {
        let flat = AxisBox::<f32>::new(vec3(-1.0, 2.0, -1.0), vec3(1.0, 2.0, 1.0));
        assert_eq!(flat.check(), Ok(()));
        for (from, n) in [(5.0, Vec3::Y), (-1.0, Vec3::NEG_Y)] {
            let r = ray([0.5, from, 0.5], [0.0, 2.0 - from, 0.0]);
            assert_eq!(all_hits(&flat, &r), [1.0]);
            assert_eq!(flat.normal(&r, 1.0), n);
        }
        // Inside its plane it has an extent.
        assert_eq!(all_hits(&flat, &ray([-3.0, 2.0, 0.0], [1.0, 0.0, 0.0])), [2.0, 4.0]);
    }

    #[test]
    fn a_direction_too_short_for_its_reciprocal_hits_nothing() {
        assert!(all_hits(&CUBE, &ray([0.0; 3], [0.0, 1.0e-40, 0.0])).is_empty());
    }

    #[test]
    fn agrees_with_double_precision() {
        let mut random = Random(4);
        let (mut hits, mut worst) = (0, 0.0_f64);
        for _ in 0..20_000 {
            let (a, b) = (random.vector() * 3.0, random.vector() * 3.0);
            let solid = AxisBox::<f32>::new(a.min(b), a.max(b));
            let r = random.ray_at((a + b) * 0.5, (b - a).length());
            let (o, d) = (r.origin().as_dvec3(), r.direction().as_dvec3());
            // Each face by itself; how far inside it the crossing lies decides whether it is clear.
            let (mut expected, mut clear) = (Vec::new(), true);
            for axis in 0..3 {
                for wall in [solid.lo, solid.hi] {
                    let t = (f64::from(wall[axis]) - o[axis]) / d[axis];
                    let p = o + d * t;
                    let margin = (0..3).filter(|i| *i != axis).map(|i| {
                        (p[i] - f64::from(solid.lo[i])).min(f64::from(solid.hi[i]) - p[i])
                    });
                    let margin = margin.fold(f64::MAX, f64::min);
                    clear &= margin.abs() > 1.0e-4;
                    if margin > 0.0 {
                        expected.push((t, axis));
                    }
                }
            }
            let found = all_hits(&solid, &r);
            let bounds = solid.bounds().grown(r.slack() * 1.01);
            assert!(found.iter().all(|t| bounds.contains(r.at(*t))));
            if !clear {
                continue;
            }
            expected.sort_by(|a, b| a.0.total_cmp(&b.0));
            assert_eq!(found.len(), expected.len());
            for (t, (expected, axis)) in found.iter().zip(expected) {
                hits += 1;
                worst = worst.max((f64::from(*t) - expected).abs() / expected.abs());
                let n = solid.normal(&r, *t);
                assert!(n[axis].abs() == 1.0);
                let outwards = n.dot(r.at(*t) - (solid.lo + solid.hi) * 0.5);
                assert!(outwards > 0.0);
            }
        }
        std::println!("{hits} crossings, worst {worst:e}");
        assert!(hits > 8000);
        assert!(worst < 1.0e-6, "{worst:e}");
    }

    #[test]
    fn only_numbers_are_hits_of_boxes() {
        only_numbers_are_hits(&CUBE);
        only_numbers_are_hits(&AxisBox::<f32>::new(vec3(-0.3, 0.5, 0.0), vec3(0.7, 0.5, 1.0)));
    }

    #[test]
    fn boxes_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let (a, b) = (place + random.vector() * size, place + random.vector() * size);
            (AxisBox::<f32>::new(a.min(b), a.max(b)), [(a + b) * 0.5])
        });
    }

    #[test]
    fn degenerate_boxes_are_refused() {
        let check = |hi| AxisBox::<f32>::new(Vec3::ZERO, hi).check();
        assert_eq!(check(Vec3::ONE), Ok(()));
        assert_eq!(check(vec3(1.0, 0.0, 1.0)), Ok(()));
        assert_eq!(check(Vec3::X), Err(ShapeError::Degenerate));
        assert_eq!(check(Vec3::ZERO), Err(ShapeError::Degenerate));
        assert_eq!(check(vec3(1.0, -1.0, 1.0)), Err(ShapeError::Negative));
        assert_eq!(check(Vec3::NAN), Err(ShapeError::NotFinite));
        assert_eq!(check(Vec3::X * 1.0e13), Err(ShapeError::NotFinite));
    }
}
