//! The triangle, watertight.
//!
//! S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2(1) (2013): the ray
//! is sheared onto an axis, so that the test becomes one of the origin against three edges in the
//! plane. A shared edge gives both its triangles the same number with opposite sign, and 0 counts
//! as inside: a ray cannot pass between them. (Rounding is monotonic: no edge function has the wrong
//! sign, though it may be 0 beside the edge.) The original computes again in double precision where
//! an edge function is 0; that serves to give an edge to one triangle only. Here both may claim it,
//! and the order of shapes decides.

use super::overlap::{across_plane, flat, settle_between};
use super::{Shape, ShapeError, settle};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Axis, FOURS, Real, Vec3, Vector};

/// A triangle; 36 bytes in `f32`. Its front is the side from which the corners run anticlockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Triangle<R: Real> {
    /// The corners.
    pub corners: [Vec3<R>; 3],
}

impl<R: Real> Triangle<R> {
    /// A triangle between three points.
    pub const fn new(a: Vec3<R>, b: Vec3<R>, c: Vec3<R>) -> Self {
        Self { corners: [a, b, c] }
    }

    /// Twice its area, as a vector towards the front.
    fn area_vector(&self) -> Vec3<R> {
        let [a, b, c] = self.corners;
        (b - a).across(c - a)
    }

    /// Whether products over parts of it, as a ray inside forms them, may vanish.
    fn is_degenerate(&self) -> bool {
        // Where products are exact they vanish together.
        let part = if R::EXACT { R::ONE } else { R::fraction(1, 16) };
        let [a, b, c] = self.corners;
        ((b - a) * part).across((c - a) * part).is_zero()
    }

    /// The corners' coordinates along an axis.
    #[inline(always)]
    fn along(&self, axis: Axis) -> [R; 3] {
        // Counted through: one address, and three loads at constant distances from it.
        let all: &[R; 9] = bytemuck::must_cast_ref(&self.corners);
        let corner = |n: usize| all.get(axis.index() + 3 * n).copied().unwrap_or_default();
        [corner(0), corner(1), corner(2)]
    }

    /// How far the corners lie along a ray, not yet scaled.
    #[inline(always)]
    fn depths(&self, shear: &Shear<R>) -> [R; 3] {
        self.along(shear.axes[2]).map(|z| z.way(shear.origin[2]))
    }

    /// The first of their coordinates across it.
    #[inline(always)]
    fn first(&self, shear: &Shear<R>, [a, b, c]: [R; 3]) -> [R; 3] {
        let sheared = |x: R, z: R| R::sheared(x.way(shear.origin[0]), shear.slope[0], z);
        let [ax, bx, cx] = self.along(shear.axes[0]);
        [sheared(ax, a), sheared(bx, b), sheared(cx, c)]
    }

    /// The second of them.
    #[inline(always)]
    fn second(&self, shear: &Shear<R>, [a, b, c]: [R; 3]) -> [R; 3] {
        let sheared = |y: R, z: R| R::sheared(y.way(shear.origin[1]), shear.slope[1], z);
        let [ay, by, cy] = self.along(shear.axes[1]);
        [sheared(ay, a), sheared(by, b), sheared(cy, c)]
    }

    /// Where a ray that passes inside meets it. Apart from the test, which then stays small enough to
    /// be part of a loop.
    ///
    /// The mean of the corners lies on the triangle, whatever the weights. Where it lies on the ray
    /// as well, that is where they meet; it does not when the ray sees the triangle so nearly edge-on
    /// that the weights are mostly rounding.
    #[inline(never)]
    fn depth(
        &self,
        ray: &Ray<R>,
        shear: &Shear<R>,
        u: R::Wide,
        v: R::Wide,
        w: R::Wide,
    ) -> Option<R> {
        let weights = [u, v, w];
        let scaled = |z| if R::EXACT { z } else { shear.scale * z };
        let t = R::mean(weights, self.depths(shear).map(scaled));
        let [a, b, c] = self.corners;
        if R::EXACT {
            // So are the weights: the mean lies on the ray, unless `t` is out of range.
            return settle(ray, self.bounds(), t * shear.scale);
        }
        let on_triangle = Vec3::<R>::new(
            R::mean(weights, [a.x(), b.x(), c.x()]),
            R::mean(weights, [a.y(), b.y(), c.y()]),
            R::mean(weights, [a.z(), b.z(), c.z()]),
        );
        if (ray.at(t) - on_triangle).max_abs() <= ray.slack() {
            return Some(t);
        }
        self.settle_thin(ray, t)
    }

    /// Where the weights are mostly rounding. Apart, for the room it takes on the stack.
    #[cold]
    #[inline(never)]
    fn settle_thin(&self, ray: &Ray<R>, t: R) -> Option<R> {
        settle_between(ray, &self.bounds(), flat::<R>(self.corners), t)
    }

    /// The weights of the corners at a hit, each from 0 to 1 and of sum 1: barycentric coordinates.
    ///
    /// For a ray that passes outside, of a place on the outline; the same for all corners when the
    /// ray sees the triangle edge-on or from too far away to tell.
    pub fn barycentric(&self, ray: &Ray<R>) -> [R; 3] {
        let shear = &Shear::of(ray);
        let depths = self.depths(shear);
        let weights = weights(self.first(shear, depths), self.second(shear, depths));
        let zero = R::Wide::default();
        let sum = |[u, v, w]: [R::Wide; 3]| u + v + w;
        // What is not a number is neither and counts as 0.
        let positive = weights.map(|w| if w >= zero { w } else { zero });
        let negative = weights.map(|w| if w <= zero { w } else { zero });
        let weights = if sum(positive) >= -sum(negative) { positive } else { negative };
        if sum(weights) == zero || !R::is_finite_wide(sum(weights)) {
            return [R::fraction(1, 3); 3];
        }
        [
            R::mean(weights, [R::ONE, R::ZERO, R::ZERO]),
            R::mean(weights, [R::ZERO, R::ONE, R::ZERO]),
            R::mean(weights, [R::ZERO, R::ZERO, R::ONE]),
        ]
    }
}

/// The shear that turns a ray into the third axis: what flat shapes want to know of a ray.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shear<R: Real> {
    axes: [Axis; 3],
    /// The ray's origin along these axes.
    origin: [R; 3],
    slope: [R::Slope; 2],
    scale: R,
}

impl<R: Real> Shear<R> {
    /// Three divisions; one, where they are dear.
    pub(crate) fn of(ray: &Ray<R>) -> Self {
        let major = ray.direction().major_axis();
        let (u, v) = major.others();
        let axes = [u, v, major];
        let [(x, du), (y, dv), (z, along)] = axes.map(|axis| ray.along(axis));
        let (slope, scale) = R::slopes([du, dv], along);
        Self { axes, origin: [x, y, z], slope, scale }
    }

    /// Where a point lies across the ray.
    #[inline]
    pub(crate) fn apply(&self, point: &Vec3<R>) -> (R, R) {
        (self.first(point), self.second(point))
    }

    /// The first of these coordinates alone.
    #[inline]
    fn first(&self, point: &Vec3<R>) -> R {
        let ([u, _, w], [x, _, z]) = (self.axes, self.origin);
        R::sheared(point.pick(u).way(x), self.slope[0], point.pick(w).way(z))
    }

    /// The second of these coordinates alone.
    #[inline]
    pub(crate) fn second(&self, point: &Vec3<R>) -> R {
        let ([_, v, w], [_, y, z]) = (self.axes, self.origin);
        R::sheared(point.pick(v).way(y), self.slope[1], point.pick(w).way(z))
    }
}

/// Twice the signed area of the triangle from the origin to two sheared points.
pub(crate) fn edge<R: Real>(p: (R, R), q: (R, R)) -> R::Wide {
    p.0.times(q.1) - p.1.times(q.0)
}

/// The weights of the corners, sheared, where the line of the ray meets the plane; of one sign if
/// that is inside.
#[inline(always)]
fn weights<R: Real>([ax, bx, cx]: [R; 3], [ay, by, cy]: [R; 3]) -> [R::Wide; 3] {
    let (a, b, c) = ((ax, ay), (bx, by), (cx, cy));
    [edge::<R>(c, b), edge::<R>(a, c), edge::<R>(b, a)]
}

/// Whether weights have one sign: the line of the ray passes inside, and does not see the triangle
/// edge-on.
#[inline(always)]
fn are_inside<R: Real>([u, v, w]: [R::Wide; 3]) -> bool {
    let zero = R::Wide::default();
    // Signs differ: outside. Two of them often tell.
    if !FOURS && ((u < zero && v > zero) || (u > zero && v < zero)) {
        return false;
    }
    let least = |a: R::Wide, b: R::Wide| if a < b { a } else { b };
    let greatest = |a: R::Wide, b: R::Wide| if a > b { a } else { b };
    // A number that is none passes here, and is refused as `t`.
    let some_negative = least(least(u, v), w) < zero;
    let some_positive = greatest(greatest(u, v), w) > zero;
    // Both: outside. Neither: edge-on.
    some_negative != some_positive
}

/// Whether corners, sheared, lie on one side of a ray: it passes outside. Where weights are rounded
/// to 0 on either side of an edge, this tells one from the other.
#[inline(always)]
fn are_beside<R: Real>([x, y, z]: [R; 3]) -> bool {
    let zero = R::ZERO;
    if x > zero { y > zero && z > zero } else { x < zero && y < zero && z < zero }
}

impl<R: Real> Shape<R> for Triangle<R> {
    type PerRay = Shear<R>;

    const FLAT: bool = true;

    fn per_ray(ray: &Ray<R>) -> Shear<R> {
        Shear::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        let bounds = self.bounds();
        let reach = bounds.max_abs();
        if !(self.corners.iter().all(|c| c.is_finite()) && R::is_workable(reach)) {
            Err(ShapeError::NotFinite)
        } else if self.is_degenerate() {
            Err(ShapeError::Degenerate)
        } else {
            Ok(())
        }
    }

    fn bounds(&self) -> Aabb<R> {
        Aabb::around(self.corners)
    }

    fn overlaps(&self, cell: &Aabb<R>) -> bool {
        flat::<R>(self.corners).all(|slab| slab.meets(cell))
    }

    fn region(&self) -> Region<R> {
        Region::triangle(self.corners, across_plane::<R>(self.corners))
    }

    #[inline(always)]
    fn hit(&self, ray: &Ray<R>, shear: &Shear<R>, min: R, max: R) -> Option<R> {
        let depths = self.depths(shear);
        // Where it pays to leave early: three of four are told outside by less than the weights take.
        let second = self.second(shear, depths);
        if !FOURS && are_beside(second) {
            return None;
        }
        let first = self.first(shear, depths);
        if !FOURS && are_beside(first) {
            return None;
        }
        let [u, v, w] = weights(first, second);
        if !are_inside::<R>([u, v, w]) {
            return None;
        }
        if FOURS && !R::EXACT && (are_beside(second) || are_beside(first)) {
            return None;
        }
        // Copies: the others stay in registers, as no pointer leads to them.
        let (ray, shear) = (*ray, *shear);
        let t = self.depth(&ray, &shear, u, v, w)?;
        (t > min && t <= max).then_some(t)
    }

    fn normal(&self, _ray: &Ray<R>, _t: R) -> Vec3<R> {
        self.area_vector()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{Random, all_hits, hit_or_refused, only_numbers_are_hits, ray};
    use glam::{Vec3, vec3};

    #[test]
    fn published_hits() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 15.
        let t = Triangle::new(vec3(0.0, 1.0, 0.0), vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0));
        assert_eq!(all_hits(&t, &ray([0.0, 0.5, -2.0], [0.0, 0.0, 1.0])), [2.0]);
        for miss in [[1.0, 1.0, -2.0], [-1.0, 1.0, -2.0], [0.0, -1.0, -2.0]] {
            assert!(all_hits(&t, &ray(miss, [0.0, 0.0, 1.0])).is_empty());
        }
        // Parallel to the plane, outside and inside of it.
        assert!(all_hits(&t, &ray([0.0, -1.0, -2.0], [0.0, 1.0, 0.0])).is_empty());
        assert!(all_hits(&t, &ray([0.0, -1.0, 0.0], [0.0, 1.0, 0.0])).is_empty());
    }

    #[test]
    fn corners_and_edges_belong_to_it() {
        let t = Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y);
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.5, 0.0), (0.0, 0.25)] {
            assert_eq!(all_hits(&t, &ray([x, y, 1.0], [0.0, 0.0, -2.0])), [0.5]);
        }
    }

    #[test]
    fn the_bad_case_of_pbrt_is_refused() {
        // mmp/pbrt-v4, shapes_test.cpp, Triangle.BadCases: corners in a line must not be hit.
        let t = Triangle::<f32>::new(
            vec3(-1_113.454_6, -79.049_614, -56.243_19),
            vec3(-1_113.454_6, -87.092_27, -56.243_19),
            vec3(-1_113.454_6, -79.209_015, -56.243_19),
        );
        assert_eq!(t.check(), Err(ShapeError::Degenerate));
    }

    #[test]
    fn a_hit_never_leaves_the_box_even_edge_on() {
        // Rays within rounding of the plane: t is ill-defined, but has to stay where the shape is.
        let t = Triangle::new(vec3(0.1, 0.2, 0.3), vec3(1.1, 0.3, 0.4), vec3(0.4, 1.3, 0.35));
        let [a, b, c] = t.corners;
        let mut hits = 0;
        for i in 0..20_000_u16 {
            let s = f32::from(i) / 20_000.0;
            let to = a * (1.0 - s) + b * s * 0.7 + c * s * 0.3;
            let from = a * 0.2 + b * 0.9 - c * (0.1 + s);
            let r = Ray::new(from, to - from).unwrap();
            for hit in all_hits(&t, &r) {
                hits += 1;
                let bounds = t.bounds().grown(2.0 * r.slack());
                assert!(bounds.contains(r.at(hit)), "{i}: {hit}");
            }
        }
        assert!(hits > 0);
    }

    #[test]
    fn only_numbers_are_hits_of_triangles() {
        only_numbers_are_hits(&Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y));
        let oblique = [vec3(0.1, 0.2, 0.3), vec3(1.0, 0.3, -0.4), vec3(-0.4, 0.9, 0.35)];
        only_numbers_are_hits(&Triangle { corners: oblique });
    }

    #[test]
    fn triangles_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let [a, b, c] = [(); 3].map(|()| place + random.vector() * size);
            (Triangle::<f32>::new(a, b, c), [(a + b + c) * (1.0 / 3.0), a, b, c])
        });
    }

    #[test]
    fn barycentric_coordinates_are_weights_whatever_the_ray() {
        let t = Triangle::<f32>::new(Vec3::ZERO, Vec3::X, Vec3::Y);
        let at = |x, y| t.barycentric(&ray([x, y, 1.0], [0.0, 0.0, -1.0]));
        assert_eq!(at(0.25, 0.5), [0.25, 0.25, 0.5]);
        // Outside: of a place on the outline.
        assert_eq!(at(0.5, -1.0e-3)[2], 0.0);
        assert_eq!(at(-1.0, -1.0), [1.0, 0.0, 0.0]);
        assert_eq!(at(3.0, -1.0), [0.0, 1.0, 0.0]);
        // Edge-on, and from where products overflow or are nothing.
        let third = [1.0 / 3.0; 3];
        assert_eq!(t.barycentric(&ray([-1.0, 0.2, 0.0], [1.0, 0.0, 0.0])), third);
        assert_eq!(t.barycentric(&ray([1.0e30, 1.0e30, 1.0], [0.0, 0.0, -1.0])), third);
        let mut random = Random(31);
        for i in 0..100_000_u32 {
            let [o, d] = [(); 2].map(|()| {
                let exponent = if i % 2 == 0 { 3.0 } else { 38.0 };
                random.vector() * 10.0_f32.powf(random.within(-exponent, exponent))
            });
            let Ok(r) = Ray::new(o, d) else { continue };
            let w = t.barycentric(&r);
            assert!(w.iter().all(|w| (0.0..=1.0).contains(w)), "{r:?} {w:?}");
            assert!((w.iter().sum::<f32>() - 1.0).abs() < 1.0e-6, "{r:?} {w:?}");
        }
    }

    #[test]
    fn degenerate_triangles_are_refused() {
        let d = |a, b, c| Triangle::<f32>::new(a, b, c).check();
        assert_eq!(d(Vec3::X, Vec3::X, Vec3::Y), Err(ShapeError::Degenerate));
        assert_eq!(d(Vec3::ZERO, Vec3::X, Vec3::X * 3.0), Err(ShapeError::Degenerate));
        assert_eq!(d(Vec3::ZERO, Vec3::NAN, Vec3::X), Err(ShapeError::NotFinite));
        assert_eq!(d(Vec3::ZERO, Vec3::X * 1e13, Vec3::X), Err(ShapeError::NotFinite));
        assert_eq!(d(Vec3::ZERO, Vec3::X * 1e-30, Vec3::Y * 1e-30), Err(ShapeError::Degenerate));
        assert_eq!(d(Vec3::ZERO, Vec3::X * 1e-24, Vec3::Y * 1e-24), Err(ShapeError::Degenerate));
        assert_eq!(d(Vec3::ZERO, Vec3::X * 1e-22, Vec3::Y * 1e-22), Err(ShapeError::Degenerate));
        assert_eq!(d(Vec3::ZERO, Vec3::X * 1e-21, Vec3::Y * 1e-21), Ok(()));
    }
}
