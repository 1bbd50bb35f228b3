//! The cylinder, open or closed.
//!
//! The crossings of the wall are found as for the sphere (Haines, Günther, Akenine-Möller, Ray
//! Tracing Gems, 2019, chapter 7), in the plane across the axis. Before that the ray is taken from
//! its point nearest to the middle, so that no error grows with the distance along the axis. A
//! closed cylinder is the part of the wall's inside between two planes (T. L. Kay, J. T. Kajiya,
//! "Ray tracing complex scenes", 1986), not wall plus discs: no ray gets in between at the rims.

use super::axial::{Frame, Hull, Part, Passage, axis_between};
use super::{Length, Shape, ShapeError};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// A cylinder; 36 bytes in `f32`.
///
/// Its wall counts from outside and from inside. Both ends belong to it, at heights 0 and `height`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Cylinder<R: Real> {
    /// The middle of its lower end.
    pub base: Vec3<R>,
    /// The direction to the other end, of length 1.
    pub axis: Vec3<R>,
    /// The distance between the ends, greater than 0.
    pub height: R,
    /// Radius, greater than 0.
    pub radius: R,
    /// Whether discs close the ends.
    pub capped: bool,
}

impl<R: Real> Cylinder<R> {
    /// An open cylinder between the middles of its ends. Where they coincide the axis is 0, and
    /// [`Shape::check`] refuses it.
    pub fn new(base: Vec3<R>, apex: Vec3<R>, radius: R) -> Self {
        let (axis, height) = axis_between::<R>(base, apex);
        Self { base, axis, height, radius, capped: false }
    }

    /// From what it consists of; for constants. `axis` has length 1.
    pub const fn from_parts(
        base: Vec3<R>,
        axis: Vec3<R>,
        height: R,
        radius: R,
        capped: bool,
    ) -> Self {
        Self { base, axis, height, radius, capped }
    }

    /// The same with discs on its ends.
    pub fn capped(self) -> Self {
        Self { capped: true, ..self }
    }

    fn hull(&self) -> Hull<R> {
        let Self { base, axis, height, radius, .. } = *self;
        Hull { base, axis, height, base_radius: radius, growth: R::ZERO, apex_radius: radius }
    }

    pub(super) fn crossings(&self, ray: &Ray<R>, length: &Length<R>) -> Option<Passage<R>> {
        let half = self.height * R::HALF;
        let frame = Frame::of(ray, length, self.hull().middle(), self.axis);
        let wall = self.wall(&frame)?;
        let slab = frame.slab(half)?;
        Some((frame, frame.ends(wall, slab, (self.capped, self.capped))))
    }

    /// Between which steps the ray is inside the wall.
    fn wall(&self, frame: &Frame<R>) -> Option<(R, R)> {
        let rr = self.radius.times(self.radius);
        let dd = frame.d.dot(frame.d);
        if !R::is_divisor(dd) {
            // Along the axis: inside for ever or never.
            return (frame.q.dot(frame.q) <= rr).then_some((-R::INFINITY, R::INFINITY));
        }
        if R::EXACT {
            // Nothing is lost in the textbook's form, and no part of it leaves the range.
            let b = -frame.q.dot(frame.d);
            let root = R::root(dd, b, frame.q.dot(frame.q) - rr)?;
            return Some((R::ratio(b - root, dd), R::ratio(b + root, dd)));
        }
        let middle = -R::ratio(frame.q.dot(frame.d), dd);
        let across = frame.q + frame.d * middle;
        let discriminant = rr - across.dot(across);
        if !(discriminant >= R::Wide::default()) {
            return None;
        }
        let half = R::sqrt_wide(discriminant) / R::sqrt_wide(dd);
        Some((middle - half, middle + half))
    }
}

impl<R: Real> Shape<R> for Cylinder<R> {
    type PerRay = Length<R>;

    fn per_ray(ray: &Ray<R>) -> Length<R> {
        Length::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        self.hull().check(self.radius.abs())
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
            (Part::Wall, across) => across,
        }
    }

    fn computed_from(&self) -> R {
        self.base.max_abs() + self.height + self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{
        Random, agrees_with_double_precision, all_hits, hit_or_refused, normalized,
        only_numbers_are_hits, ray,
    };
    use glam::{Vec3, vec3};

    fn upright(from: f32, to: f32) -> Cylinder<f32> {
        Cylinder::new(vec3(0.0, from, 0.0), vec3(0.0, to, 0.0), 1.0)
    }

    #[test]
    fn published_crossings() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 13; endless there, long enough here.
        let c = upright(-100.0, 100.0);
        for (o, d) in [
            ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, -5.0], [1.0, 1.0, 1.0]),
        ] {
            assert!(all_hits(&c, &normalized(o, d)).is_empty());
        }
        assert_eq!(all_hits(&c, &ray([1.0, 0.0, -5.0], [0.0, 0.0, 1.0])), [5.0]);
        assert_eq!(all_hits(&c, &ray([0.0, 0.0, -5.0], [0.0, 0.0, 1.0])), [4.0, 6.0]);
        let hits = all_hits(&c, &normalized([0.5, 0.0, -5.0], [0.1, 1.0, 1.0]));
        for (t, expected) in hits.iter().zip([6.807_98, 7.088_72]) {
            assert!((t - expected).abs() < 1.0e-5, "{hits:?}"); // as many digits as are printed
        }
        assert_eq!(hits.len(), 2);
    }

    #[test]
    fn published_counts_with_ends() {
        let open = upright(1.0, 2.0);
        for (o, d, count) in [
            ([0.0, 1.5, 0.0], [0.1, 1.0, 0.0], 0),
            ([0.0, 3.0, -5.0], [0.0, 0.0, 1.0], 0),
            ([0.0, 0.0, -5.0], [0.0, 0.0, 1.0], 0),
            // The book leaves the ends themselves out and counts 0 here; ours belong to it.
            ([0.0, 2.0, -5.0], [0.0, 0.0, 1.0], 2),
            ([0.0, 1.0, -5.0], [0.0, 0.0, 1.0], 2),
            ([0.0, 1.5, -2.0], [0.0, 0.0, 1.0], 2),
        ] {
            let hits = all_hits(&open, &ray(o, d)).into_iter().filter(|t| *t > 0.0).count();
            assert_eq!(hits, count, "{o:?}");
        }
        let closed = open.capped();
        for (o, d) in [
            ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
            ([0.0, 3.0, -2.0], [0.0, -1.0, 2.0]),
            ([0.0, 4.0, -2.0], [0.0, -1.0, 1.0]),
            ([0.0, 0.0, -2.0], [0.0, 1.0, 2.0]),
            ([0.0, -1.0, -2.0], [0.0, 1.0, 1.0]),
        ] {
            assert_eq!(all_hits(&closed, &ray(o, d)).len(), 2, "{o:?}");
            assert_eq!(all_hits(&closed, &normalized(o, d)).len(), 2, "{o:?}");
        }
    }

    #[test]
    fn published_normals() {
        let c = upright(1.0, 2.0).capped();
        for (o, to, n) in [
            ([5.0, 1.5, 0.0], [1.0, 1.5, 0.0], Vec3::X),
            ([0.0, 1.2, -5.0], [0.0, 1.2, -1.0], Vec3::NEG_Z),
            ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], Vec3::NEG_Y),
            ([0.5, -1.0, 0.0], [0.5, 1.0, 0.0], Vec3::NEG_Y),
            ([0.0, 5.0, 0.5], [0.0, 2.0, 0.5], Vec3::Y),
        ] {
            let r = Ray::new(Vec3::from(o), Vec3::from(to) - Vec3::from(o)).unwrap();
            let t = c.hit(&r, &Length::of(&r), 0.0, 2.0).unwrap();
            assert!((t - 1.0).abs() < 1.0e-6);
            assert!((c.normal(&r, t).normalize() - n).length() < 1.0e-6, "{o:?}");
        }
    }

    #[test]
    fn no_ray_slips_in_at_the_rim() {
        // Aimed at the rim from outside towards the middle: always two crossings.
        let mut random = Random(5);
        for _ in 0..20_000 {
            let base = random.vector() * 3.0;
            let c = Cylinder::<f32>::new(base, base + random.direction(), 0.5).capped();
            let side = c.axis.cross(random.direction()).normalize() * 0.5;
            let rim = c.base + side + if random.signed() > 0.0 { c.axis } else { Vec3::ZERO };
            let middle = c.base + c.axis * 0.5;
            let inside = middle + random.vector() * 0.1;
            let r =
                Ray::new(rim + (rim - inside) * random.within(0.1, 20.0), inside - rim).unwrap();
            let hits = all_hits(&c, &r);
            assert_eq!(hits.len(), 2, "{c:?} {r:?}");
        }
    }

    #[test]
    fn agrees_with_the_textbook() {
        agrees_with_double_precision(Random(2), 0.0, |random, i, base, apex| {
            let c = Cylinder::<f32>::new(base, apex, random.within(0.05, 3.0));
            let c = if i % 2 == 0 { c } else { c.capped() };
            (c, c.hull(), c.capped)
        });
    }

    #[test]
    fn cylinders_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let way = random.direction() * random.within(0.01, 1.0) * size;
            let c = Cylinder::<f32>::new(place, place + way, random.within(0.01, 1.0) * size);
            let c = if random.signed() > 0.0 { c } else { c.capped() };
            let side = c.axis.cross(random.direction()).normalize_or_zero() * c.radius;
            (c, [place + way * 0.5 + side])
        });
    }

    #[test]
    fn bounds_are_tight() {
        let near = |a: Vec3, b: Vec3| (a - b).abs().max_element() < 4.0e-6;
        let b = upright(1.0, 2.0).bounds();
        assert!(near(b.lo, vec3(-1.0, 1.0, -1.0)) && near(b.hi, vec3(1.0, 2.0, 1.0)), "{b:?}");
        let c = Cylinder::<f32>::new(Vec3::ZERO, vec3(3.0, 4.0, 0.0), 1.0);
        let b = c.bounds();
        assert!(near(b.lo, vec3(-0.8, -0.6, -1.0)) && near(b.hi, vec3(3.8, 4.6, 1.0)), "{b:?}");
        // And hold the true surface, whatever the direction.
        let mut random = Random(9);
        for _ in 0..2000 {
            let base = random.vector() * 5.0;
            let c = Cylinder::<f32>::new(base, base + random.direction() * 5.0, 0.7);
            let (b, axis) = (c.bounds(), c.axis.as_dvec3().normalize());
            let (u, v) = axis.any_orthonormal_pair();
            for step in 0..64_u8 {
                let (sin, cos) = (f64::from(step) * core::f64::consts::PI / 32.0).sin_cos();
                let rim = c.base.as_dvec3() + (u * sin + v * cos) * f64::from(c.radius);
                for p in [rim, rim + axis * f64::from(c.height)] {
                    assert!(p.cmpge(b.lo.as_dvec3()).all() && p.cmple(b.hi.as_dvec3()).all());
                }
            }
        }
    }

    #[test]
    fn only_numbers_are_hits_of_cylinders() {
        for c in [upright(-0.5, 1.0), Cylinder::new(Vec3::ZERO, vec3(0.2, 0.5, -1.0), 0.5)] {
            only_numbers_are_hits(&c);
            only_numbers_are_hits(&c.capped());
        }
    }

    #[test]
    fn degenerate_cylinders_are_refused() {
        let check = |to: f32, r| Cylinder::<f32>::new(Vec3::ZERO, Vec3::X * to, r).check();
        assert_eq!(check(1.0, 0.0), Err(ShapeError::Degenerate));
        assert_eq!(check(0.0, 1.0), Err(ShapeError::Degenerate));
        assert_eq!(check(1.0, -1.0), Err(ShapeError::Negative));
        assert_eq!(check(1.0, f32::NAN), Err(ShapeError::NotFinite));
        assert_eq!(check(f32::INFINITY, 1.0), Err(ShapeError::NotFinite));
        assert_eq!(check(1.0e13, 1.0), Err(ShapeError::NotFinite));
        assert_eq!(check(-1.0, 1.0), Ok(()));
        let parts = |axis, height| Cylinder::<f32>::from_parts(Vec3::ZERO, axis, height, 1.0, true);
        assert_eq!(parts(Vec3::X * 1.01, 1.0).check(), Err(ShapeError::NotUnit));
        assert_eq!(parts(Vec3::X, -1.0).check(), Err(ShapeError::Negative));
        assert_eq!(parts(Vec3::NAN, 1.0).check(), Err(ShapeError::NotFinite));
        assert_eq!(parts(Vec3::X, 1.0).check(), Ok(()));
    }
}
