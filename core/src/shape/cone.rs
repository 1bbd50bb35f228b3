//! The cone and the truncated cone, open or closed.
//!
//! The wall is where q² = radius(height)²: a quadratic equation whose roots are formed without
//! cancellation (q = b ± √Δ, the roots q/a and c/q, Δ as a difference of full products; Press et
//! al., Numerical Recipes §5.6; W. Kahan). Before that the ray is taken from its point nearest to
//! the middle, and then from the place between the ends where the equation has its vertex: rays
//! through the tip, where b² and a c agree, are as exact there as any. A ray parallel to the wall
//! has a = 0 and one root at infinity. The ends are planes as for the cylinder.

use super::axial::{Frame, Hull, Part, Passage, axis_between};
use super::{Length, Shape, ShapeError};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// A cone, or what two planes across its axis leave of one; 40 bytes in `f32`.
///
/// Its wall counts from outside and from inside. Both ends belong to it, and so does the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Cone<R: Real> {
    /// The middle of its lower end.
    pub base: Vec3<R>,
    /// The direction to the other end, of length 1.
    pub axis: Vec3<R>,
    /// The distance between the ends, greater than 0.
    pub height: R,
    /// Radius at height 0, not negative.
    pub base_radius: R,
    /// Radius at the other end, not negative; 0 makes it a tip. Not both radii are 0.
    pub apex_radius: R,
    /// Whether discs close the ends.
    pub capped: bool,
}

impl<R: Real> Cone<R> {
    /// An open cone between the middles of its ends. Where they coincide the axis is 0, and
    /// [`Shape::check`] refuses it.
    pub fn new(base: Vec3<R>, apex: Vec3<R>, base_radius: R, apex_radius: R) -> Self {
        let (axis, height) = axis_between::<R>(base, apex);
        Self { base, axis, height, base_radius, apex_radius, capped: false }
    }

    /// From what it consists of; for constants. `axis` has length 1.
    pub const fn from_parts(
        base: Vec3<R>,
        axis: Vec3<R>,
        height: R,
        base_radius: R,
        apex_radius: R,
        capped: bool,
    ) -> Self {
        Self { base, axis, height, base_radius, apex_radius, capped }
    }

    /// The same with discs on its ends.
    pub fn capped(self) -> Self {
        Self { capped: true, ..self }
    }

    /// How much the radius grows in a unit of height.
    fn growth(&self) -> R {
        (self.apex_radius - self.base_radius) / self.height
    }

    fn hull(&self) -> Hull<R> {
        let Self { base, axis, height, base_radius, apex_radius, .. } = *self;
        Hull { base, axis, height, base_radius, growth: self.growth(), apex_radius }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn crossings(&self, ray: &Ray<R>, length: &Length<R>) -> Option<Passage<R>> {
        let half = self.height * R::HALF;
        let mut frame = Frame::of(ray, length, self.hull().middle(), self.axis);
        let slab = frame.slab(half)?;
        let (slab, wall) = self.wall(&mut frame, slab)?;
        // A tip is a disc without extent; taken for one, it leaves no hole to slip through.
        let closed = |radius| self.capped || radius == R::ZERO;
        let closed = (closed(self.base_radius), closed(self.apex_radius));
        Some((frame, frame.ends(wall, slab, closed)))
    }

    /// Between which steps the ray is inside the slab, and between which inside the wall. The frame is
    /// moved to where they count from: two of them would lie on the stack.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn wall(&self, frame: &mut Frame<R>, slab: (R, R)) -> Option<((R, R), (R, R))> {
        let zero = R::Wide::default();
        let growth = self.growth();
        let middle = (self.base_radius + self.apex_radius) * R::HALF;
        let step = growth * frame.dz;
        // Inside is where a s² - 2 b s + c <= 0.
        let a = frame.d.dot(frame.d) - step.times(step);
        let equation = |frame: &Frame<R>| {
            let r = middle + growth * frame.z;
            (step.times(r) - frame.q.dot(frame.d), frame.q.dot(frame.q) - r.times(r))
        };
        let vertex = R::ratio(equation(frame).0, a).clamp(slab.0, slab.1);
        let vertex = if vertex.is_finite() { vertex } else { R::ZERO };
        *frame = frame.moved(vertex);
        let slab = (slab.0 - vertex, slab.1 - vertex);

        let (b, c) = equation(frame);
        let root = match R::root(a, b, c) {
            Some(root) => root,
            // Steeper than the wall, a ray crosses it whatever the rounding says.
            None if a < zero => zero,
            None => return None,
        };
        let q = if b >= zero { b + root } else { b - root };
        let (lo, hi) = if q == zero {
            if a == zero {
                // Along the wall: inside or on it for ever, or never.
                (c <= zero).then_some((-R::INFINITY, R::INFINITY))?
            } else {
                (R::ZERO, R::ZERO)
            }
        } else {
            // A ray almost parallel to the wall, at the far side of the cone, has its crossing far
            // from the vertex, and b is small: another step of Newton's from there.
            let refined = |s: R| {
                if !(s >= slab.0 && s <= slab.1) {
                    return s;
                }
                let (b, c) = equation(&frame.moved(s));
                let more = R::ratio(c, b + b);
                let bend = (more * R::narrow(a)).abs();
                // Not where the ray grazes the wall.
                if bend <= R::narrow(b).abs() * R::HALF * R::HALF { s + more } else { s }
            };
            let (s, t) = (refined(R::ratio(q, a)), refined(R::ratio(c, q)));
            if s <= t { (s, t) } else { (t, s) }
        };
        let wall = if a >= zero {
            (lo, hi)
        } else if step > R::ZERO {
            // Between the roots it is outside, and before them inside the mirrored cone.
            (hi, R::INFINITY)
        } else {
            (-R::INFINITY, lo)
        };
        (wall.0 <= wall.1).then_some((slab, wall))
    }
}

impl<R: Real> Shape<R> for Cone<R> {
    type PerRay = Length<R>;

    fn per_ray(ray: &Ray<R>) -> Length<R> {
        Length::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        self.hull().check(self.base_radius.abs() + self.apex_radius.abs())?;
        if R::is_workable_normal(self.growth().abs()) { Ok(()) } else { Err(ShapeError::NotFinite) }
    }

    fn bounds(&self) -> Aabb<R> {
        self.hull().bounds()
    }

    fn overlaps(&self, cell: &Aabb<R>) -> bool {
        self.hull().overlaps(cell)
    }

    fn region(&self) -> Region<R> {
        self.hull().region()
    }

    fn hit(&self, ray: &Ray<R>, length: &Length<R>, min: R, max: R) -> Option<R> {
        let (frame, crossings) = self.crossings(ray, length)?;
        frame.select(crossings, ray, &self.hull(), (min, max))
    }

    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        match self.hull().place(self.crossings(ray, &Length::of(ray)), ray, t) {
            (Part::Base, _) => -self.axis,
            (Part::Apex, _) => self.axis,
            // At the tip no direction across the axis is left; then along it.
            (Part::Wall, across) => across.unit().unwrap_or_default() - self.axis * self.growth(),
        }
    }

    fn computed_from(&self) -> R {
        self.base.max_abs() + self.height + self.base_radius.max(self.apex_radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{
        Random, agrees_with_double_precision, all_hits, hit_or_refused, normalized,
        only_numbers_are_hits, ray, reference,
    };
    use glam::{Vec3, vec3};

    extern crate std;
    use std::vec::Vec;

    /// x² + z² = y² up to a height, upwards and downwards from the tip at 0.
    fn double(height: f32) -> [Cone<f32>; 2] {
        [height, -height].map(|y| Cone::new(vec3(0.0, y, 0.0), Vec3::ZERO, height, 0.0))
    }

    fn both(cones: &[Cone<f32>; 2], r: &Ray<f32>) -> Vec<f32> {
        let mut hits: Vec<f32> = cones.iter().flat_map(|c| all_hits(c, r)).collect();
        hits.sort_by(f32::total_cmp);
        hits
    }

    fn close(hits: &[f32], expected: &[f32]) {
        assert_eq!(hits.len(), expected.len(), "{hits:?}");
        for (t, e) in hits.iter().zip(expected) {
            // As many digits as are printed, and the rounding of the numbers themselves.
            assert!((t - e).abs() < 1.0e-5 + e * 4.0e-7, "{hits:?}");
        }
    }

    #[test]
    fn published_crossings() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 13; endless there, long enough here.
        let cones = double(40.0);
        // Through the tip, which is the end of both halves: each is touched once.
        close(&both(&cones, &ray([0.0, 0.0, -5.0], [0.0, 0.0, 1.0])), &[5.0, 5.0]);
        // A tangent, a double root: one touch. Printed as 8.66025 for a direction of length 1, which
        // rounding takes off the surface.
        close(&both(&cones, &ray([0.0, 0.0, -5.0], [1.0, 1.0, 1.0])), &[5.0]);
        close(
            &both(&cones, &normalized([1.0, 1.0, -5.0], [-0.5, -1.0, 1.0])),
            &[4.550_06, 49.449_94],
        );
        // Parallel to a half: -c/b. The 0.35355 printed is -c/2b, which is not on the cone.
        let parallel = normalized([0.0, 0.0, -1.0], [0.0, 1.0, 1.0]);
        close(&both(&cones, &parallel), &[core::f32::consts::FRAC_1_SQRT_2]);
        assert!((parallel.at(0.707_106_77) - vec3(0.0, 0.5, -0.5)).length() < 1.0e-6);
    }

    #[test]
    fn published_counts_with_ends() {
        let cones = double(0.5).map(Cone::capped);
        for (o, d, count) in [
            ([0.0, 0.0, -5.0], [0.0, 1.0, 0.0], 0),
            ([0.0, 0.0, -0.25], [0.0, 1.0, 1.0], 2),
            ([0.0, 0.0, -0.25], [0.0, 1.0, 0.0], 4),
        ] {
            assert_eq!(both(&cones, &ray(o, d)).len(), count, "{o:?}");
            assert_eq!(both(&cones, &normalized(o, d)).len(), count, "{o:?}");
        }
    }

    #[test]
    fn no_ray_slips_through_the_tip() {
        // Steep rays through the tip of open cones: from inside they must not leave without a hit,
        // whichever end it is.
        let mut random = Random(8);
        for i in 0..20_000_u16 {
            let base = random.vector() * 3.0;
            let tip = base + random.direction() * random.within(0.5, 4.0);
            let cone = match i % 2 {
                0 => Cone::<f32>::new(base, tip, 1.0, 0.0),
                _ => Cone::<f32>::new(tip, base, 0.0, 1.0),
            };
            let inside = base + (tip - base) * random.within(0.1, 0.5);
            let from = inside + random.vector() * 0.05;
            let r = Ray::new(from, (tip - from) * random.within(0.1, 2.0)).unwrap();
            let out: Vec<f32> = all_hits(&cone, &r).into_iter().filter(|t| *t > 0.0).collect();
            assert_eq!(out.len(), 1, "{cone:?} {r:?}");
            let off = (r.at(out[0]) - tip).length();
            assert!(off < 2.0e-5, "{off}");
        }
    }

    #[test]
    fn closed_cones_have_two_crossings_or_none_and_their_rims_no_gap() {
        let mut random = Random(10);
        for i in 0..20_000_u16 {
            let base = random.vector() * 3.0;
            let (a, b) = if i % 3 == 0 { (0.5, 0.5) } else { (0.4, 0.8 * f32::from(i % 3 - 1)) };
            let cone = Cone::<f32>::new(base, base + random.direction(), a, b).capped();
            let side = cone.axis.cross(random.direction()).normalize();
            let rim = base + if i % 2 == 0 { side * a } else { cone.axis * cone.height + side * b };
            let inside = base + cone.axis * 0.5 + random.vector() * 0.05;
            let away = random.within(0.1, 20.0);
            let r = Ray::new(rim + (rim - inside) * away, inside - rim).unwrap();
            assert_eq!(all_hits(&cone, &r).len(), 2, "{cone:?} {r:?}");
        }
    }

    #[test]
    fn along_the_axis_and_along_the_wall() {
        let [up, _] = double(1.0);
        // Through the tip along the axis: open, only the tip; closed, the tip and the disc.
        let r = ray([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]);
        assert_eq!(all_hits(&up, &r), [3.0]);
        assert_eq!(all_hits(&up.capped(), &r), [2.0, 3.0]);
        // Inside the wall itself an open cone has no crossing, a closed one enters and leaves.
        let r = ray([2.0, 2.0, 0.0], [-1.0, -1.0, 0.0]);
        assert_eq!(all_hits(&up.capped(), &r), [1.0, 2.0]);
        // A cone that does not narrow is a cylinder.
        let tube = Cone::<f32>::new(Vec3::ZERO, Vec3::Y, 1.0, 1.0);
        assert_eq!(all_hits(&tube, &ray([0.0, 0.5, -5.0], [0.0, 0.0, 1.0])), [4.0, 6.0]);
        let r = ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]);
        assert!(all_hits(&tube, &r).is_empty());
        assert_eq!(all_hits(&tube.capped(), &r), [2.0, 3.0]);
        assert!(all_hits(&tube.capped(), &ray([1.5, 3.0, 0.0], [0.0, -1.0, 0.0])).is_empty());
    }

    #[test]
    fn published_normals() {
        // At (1, 1, 1) and (-1, -1, 0) of the double cone.
        let [up, down] = double(2.0);
        for (cone, p, n) in [
            (up, vec3(1.0, 2.0_f32.sqrt(), 1.0), vec3(1.0, -(2.0_f32.sqrt()), 1.0)),
            (down, vec3(-1.0, -1.0, 0.0), vec3(-1.0, 1.0, 0.0)),
        ] {
            let r = Ray::new(p + n, -n).unwrap();
            let t = cone.hit(&r, &Length::of(&r), 0.0, 2.0).unwrap();
            assert!((t - 1.0).abs() < 1.0e-6);
            assert!((cone.normal(&r, t).normalize() - n.normalize()).length() < 1.0e-6);
        }
        let r = ray([0.1, 5.0, 0.0], [0.0, -1.0, 0.0]);
        assert_eq!(up.capped().normal(&r, 3.0), Vec3::Y);
        let r = ray([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]);
        assert_eq!(up.normal(&r, 1.0).normalize(), Vec3::NEG_Y);
    }

    #[test]
    fn agrees_with_the_textbook() {
        agrees_with_double_precision(Random(12), 0.1, |random, i, base, apex| {
            let (a, b) = (random.within(0.05, 3.0), random.within(0.0, 3.0));
            let (a, b) = match i % 5 {
                0 => (a, 0.0),
                1 => (0.0, a),
                _ => (a, b),
            };
            let c = Cone::<f32>::new(base, apex, a, b);
            let c = if i % 2 == 0 { c } else { c.capped() };
            (c, c.hull(), c.capped)
        });
    }

    #[test]
    fn cones_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let way = random.direction() * random.within(0.01, 1.0) * size;
            let (a, b) = (random.within(0.01, 1.0) * size, (random.signed() * size).max(0.0));
            let c = Cone::<f32>::new(place, place + way, a, b);
            let c = if random.signed() > 0.0 { c } else { c.capped() };
            let side = c.axis.cross(random.direction()).normalize_or_zero() * (0.5 * (a + b));
            (c, [place + way * 0.5 + side])
        });
    }

    #[test]
    fn almost_parallel_to_the_wall_and_far_from_it() {
        // Inside, a ray that leans by little against the opposite wall has one well-defined crossing
        // near the tip, and another far off or none.
        let mut random = Random(14);
        let mut worst = 0.0_f64;
        for _ in 0..20_000 {
            let base = random.vector() * 3.0;
            let cone = Cone::<f32>::new(base, base + random.direction() * 2.0, 1.0, 0.0);
            let side = cone.axis.cross(random.direction()).normalize();
            let wall = cone.axis * 2.0 - side + random.vector() * 1.0e-3;
            let from = base + side * random.within(0.5, 0.9);
            let r = Ray::new(from, wall).unwrap();
            let expected = reference(&cone.hull(), false, &r, 1.0);
            let hits = all_hits(&cone, &r);
            for (e, cosine) in expected.iter().filter(|(t, _)| *t > 0.1 && *t < 0.9) {
                let off = hits.iter().map(|t| (f64::from(*t) - e).abs()).fold(f64::MAX, f64::min);
                worst = worst.max(off * cosine * f64::from(wall.length()) / 6.0);
            }
        }
        std::println!("worst {worst:e}");
        assert!(worst < 4.0e-7, "{worst:e}");
    }

    #[test]
    fn only_numbers_are_hits_of_cones() {
        let [up, down] = double(1.0);
        let oblique = Cone::<f32>::new(Vec3::ZERO, vec3(0.2, 0.5, -1.0), 0.25, 0.75);
        for c in [up, down, oblique] {
            only_numbers_are_hits(&c);
            only_numbers_are_hits(&c.capped());
        }
    }

    #[test]
    fn degenerate_cones_are_refused() {
        let check = |to: f32, a, b| Cone::<f32>::new(Vec3::ZERO, Vec3::X * to, a, b).check();
        assert_eq!(check(1.0, 1.0, 0.0), Ok(()));
        assert_eq!(check(1.0, 0.0, 1.0), Ok(()));
        assert_eq!(check(1.0, 0.0, 0.0), Err(ShapeError::Degenerate));
        assert_eq!(check(0.0, 1.0, 0.5), Err(ShapeError::Degenerate));
        assert_eq!(check(1.0, -1.0, 2.0), Err(ShapeError::Negative));
        assert_eq!(check(1.0, 1.0, -2.0), Err(ShapeError::Negative));
        assert_eq!(check(1.0, f32::NAN, 0.0), Err(ShapeError::NotFinite));
        assert_eq!(check(1.0, 0.0, 1.0e13), Err(ShapeError::NotFinite));
        assert_eq!(check(1.0e-15, 0.0, 1.0), Err(ShapeError::NotFinite));
        assert_eq!(check(f32::NAN, 0.0, 1.0), Err(ShapeError::NotFinite));
        let parts = Cone::<f32>::from_parts(Vec3::ZERO, Vec3::X * 2.0, 1.0, 1.0, 0.0, false);
        assert_eq!(parts.check(), Err(ShapeError::NotUnit));
    }
}
