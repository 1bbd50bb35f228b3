//! The planar polygon, convex or not, as one object.
//!
//! Even-odd rule with half-open crossings (Shimrat, CACM Algorithm 112, 1962; E. Haines, "Point in
//! polygon strategies", Graphics Gems IV, 1994), on corners sheared along the ray as for triangles
//! (Woop, Benthin, Wald 2013). The decision about an edge is made from its lower to its upper end,
//! so that all polygons that share it decide alike: a ray through a shared edge or corner belongs to
//! exactly one of the polygons around it, and none passes between them. The normal is Newell's
//! (I. Sutherland, R. Sproull, R. Schumacker, ACM Computing Surveys 6(1), 1974, appendix).

use super::overlap::{Slab, settle_between};
use super::triangle::edge;
use super::{Shape, ShapeError, Shear};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// A planar polygon of at least three corners; 44 bytes in `f32` where pointers have 32 bits, and
/// the corners, which it borrows and which may lie in flash.
///
/// Its front is the side from which the corners run anticlockwise. The outline may be concave; where
/// it crosses itself, the even-odd rule says what is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Polygon<'a, R: Real> {
    vertices: &'a [R::Vec3],
    normal: R::Vec3,
    /// Kept, because the outline may be long.
    bounds: Aabb<R>,
}

impl<'a, R: Real> Polygon<'a, R> {
    /// A polygon around corners. Its normal is 0 where they span no area ([`Shape::check`] refuses
    /// that), and else has a greatest component of 1 to 2.
    pub fn new(vertices: &'a [R::Vec3]) -> Self {
        let bounds = Aabb::around(vertices.iter().copied());
        let size = match vertices.first() {
            Some(first) => vertices.iter().fold(R::ZERO, |m, v| m.max((*v - *first).max_abs())),
            None => R::ZERO,
        };
        if !(size > R::ZERO) {
            return Self { vertices, normal: Vec3::<R>::default(), bounds };
        }
        // Scaled to less than 1 before the products, so that tiny polygons keep theirs.
        let area = newell::<R>(vertices, size.exponent_to_one() - 1);
        let size = area.max_abs();
        let normal =
            if size > R::ZERO { area.map(|a| a.ldexp(size.exponent_to_one())) } else { area };
        Self { vertices, normal, bounds }
    }

    /// A polygon with what [`Polygon::new`] would compute, for constants: a vector across its plane, of
    /// any length but 0, towards the front, and the smallest box around its corners. Where that is
    /// another one, [`Shape::check`] refuses the polygon.
    pub const fn of_parts(vertices: &'a [R::Vec3], normal: R::Vec3, bounds: Aabb<R>) -> Self {
        Self { vertices, normal, bounds }
    }

    /// The corners in order; the last is joined to the first.
    pub fn vertices(&self) -> &'a [R::Vec3] {
        self.vertices
    }

    /// Its plane.
    fn plane(&self) -> Option<Slab<R>> {
        Some(Slab::new(*self.vertices.first()?, self.normal, R::ZERO, R::ZERO))
    }

    /// Where a ray meets its plane: in its box or, as an error, elsewhere. Apart from the outline where
    /// calls cost little, for the stack.
    #[cfg_attr(
        not(any(target_pointer_width = "64", target_arch = "wasm32", target_abi = "eabihf")),
        inline(never)
    )]
    fn parameter(&self, ray: &Ray<R>) -> Result<R, R> {
        let first = *self.vertices.first().ok_or(R::INFINITY)?;
        let n = self.normal;
        let t = R::ratio(n.dot(first - ray.origin()), n.dot(ray.direction()));
        if self.bounds.grown(ray.slack()).contains(ray.at(t)) { Ok(t) } else { Err(t) }
    }

    /// What [`settle_between`] makes of a parameter. Seen edge-on, it says little.
    #[cold]
    #[inline(never)]
    fn settled(&self, ray: &Ray<R>, t: R) -> Option<R> {
        settle_between(ray, &self.bounds, self.plane(), t)
    }

    /// Whether the line of the ray passes through it.
    #[cfg_attr(
        not(any(target_pointer_width = "64", target_arch = "wasm32", target_abi = "eabihf")),
        inline(never)
    )]
    fn surrounds(&self, shear: &Shear<R>) -> bool {
        let Some(mut a) = self.vertices.last() else { return false };
        let mut was_above = shear.second(a) > R::ZERO;
        let mut inside = false;
        for b in self.vertices {
            // One end above, the other not: does the edge cross to the right of the ray? On the ray
            // is not to the right, so an edge belongs to what lies to its right.
            let above = shear.second(b) > R::ZERO;
            if above != was_above {
                let (lower, upper) = if above { (a, b) } else { (b, a) };
                let side = edge::<R>(shear.apply(lower), shear.apply(upper));
                inside ^= side > R::Wide::default();
            }
            (a, was_above) = (b, above);
        }
        inside
    }
}

/// Twice the area vector of an outline after scaling. Taken from the first corner, so that it loses
/// nothing far from the origin.
fn newell<R: Real>(vertices: &[Vec3<R>], exponent: i32) -> Vec3<R> {
    let zero = Vec3::<R>::default();
    let Some(first) = vertices.first() else { return zero };
    let mut a = zero;
    let mut sum = zero;
    for v in vertices {
        let b = (*v - *first).map(|x| x.ldexp(exponent));
        sum = sum + a.cross(b);
        a = b;
    }
    sum
}

impl<R: Real> Shape<R> for Polygon<'_, R> {
    type PerRay = Shear<R>;

    const FLAT: bool = true;

    fn per_ray(ray: &Ray<R>) -> Shear<R> {
        Shear::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        let n = self.normal;
        let bounds = Aabb::around(self.vertices.iter().copied());
        if self.vertices.len() < 3 {
            Err(ShapeError::TooFewCorners)
        } else if !(self.vertices.iter().all(|c| c.is_finite())
            && n.is_finite()
            && R::is_workable(bounds.max_abs())
            && bounds == self.bounds
            && R::is_workable_normal(n.max_abs()))
        {
            Err(ShapeError::NotFinite)
        } else if !R::EXACT && newell::<R>(self.vertices, -4).is_zero() {
            // A ray inside forms products over parts of the outline, which must not vanish.
            Err(ShapeError::Degenerate)
        } else if n.dot(n) > R::Wide::default() {
            Ok(())
        } else {
            Err(ShapeError::NotUnit)
        }
    }

    fn bounds(&self) -> Aabb<R> {
        self.bounds
    }

    fn overlaps(&self, cell: &Aabb<R>) -> bool {
        self.plane().is_none_or(|plane| plane.meets(cell))
    }

    fn region(&self) -> Region<R> {
        Region::flat(newell::<R>(self.vertices, 0), self.vertices.iter().copied())
    }

    fn hit(&self, ray: &Ray<R>, shear: &Shear<R>, min: R, max: R) -> Option<R> {
        let t = match self.parameter(ray) {
            Ok(t) => t,
            Err(t) => self.settled(ray, t)?,
        };
        // The outline comes last, because it is the longest.
        (t > min && t <= max && self.surrounds(shear)).then_some(t)
    }

    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn normal(&self, _ray: &Ray<R>, _t: R) -> Vec3<R> {
        self.normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{Random, all_hits, hit_or_refused, only_numbers_are_hits, ray};
    use glam::{DVec3, Vec3, vec3};

    extern crate std;
    use std::vec::Vec;

    #[test]
    fn only_numbers_are_hits_of_polygons() {
        only_numbers_are_hits(&Polygon::<f32>::new(&L));
        let tilted = L.map(|v| vec3(v.x, v.y + 0.3 * v.x, v.x - v.y));
        only_numbers_are_hits(&Polygon::<f32>::new(&tilted));
    }

    #[test]
    fn polygons_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            let (u, v) = (random.direction() * size, random.direction() * size);
            let corners: Vec<Vec3> = L.iter().map(|c| place + u * c.x + v * c.y).collect();
            (
                Polygon::<f32>::new(corners.leak()),
                [(0.4, 0.6), (0.5, 1.0)].map(|(x, y)| place + u * x + v * y),
            )
        });
    }

    const L: [Vec3; 6] = [
        vec3(0.0, 0.0, 0.0),
        vec3(2.0, 0.0, 0.0),
        vec3(2.0, 1.0, 0.0),
        vec3(1.0, 1.0, 0.0),
        vec3(1.0, 2.0, 0.0),
        vec3(0.0, 2.0, 0.0),
    ];

    fn star(points: u16) -> Vec<Vec3> {
        (0..2 * points)
            .map(|i| {
                let angle = f32::from(i) * core::f32::consts::PI / f32::from(points);
                let r = if i % 2 == 0 { 1.0 } else { 0.4 };
                vec3(r * angle.cos(), r * angle.sin(), 0.0)
            })
            .collect()
    }

    fn down(x: f32, y: f32) -> Ray<f32> {
        ray([x, y, 3.0], [0.0, 0.0, -2.0])
    }

    #[test]
    fn a_polygon_of_three_corners_is_the_published_triangle() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 15.
        let corners = [vec3(0.0, 1.0, 0.0), vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)];
        let p = Polygon::<f32>::new(&corners);
        assert_eq!(all_hits(&p, &ray([0.0, 0.5, -2.0], [0.0, 0.0, 1.0])), [2.0]);
        for miss in [[1.0, 1.0, -2.0], [-1.0, 1.0, -2.0], [0.0, -1.0, -2.0]] {
            assert!(all_hits(&p, &ray(miss, [0.0, 0.0, 1.0])).is_empty());
        }
        assert!(all_hits(&p, &ray([0.0, -1.0, -2.0], [0.0, 1.0, 0.0])).is_empty());
        assert!(all_hits(&p, &ray([0.0, -1.0, 0.0], [0.0, 1.0, 0.0])).is_empty());
    }

    #[test]
    fn the_normal_points_to_the_front_at_any_scale_and_place() {
        for scale in [1.0e-30_f32, 1.0e-21, 1.0e-3, 1.0, 1.0e9] {
            let corners = L.map(|v| v * scale);
            let p = Polygon::<f32>::new(&corners);
            // Of the least one only the normal can be told.
            let tiny = Err(ShapeError::Degenerate);
            assert_eq!(p.check(), if scale < 1.0e-22 { tiny } else { Ok(()) }, "{scale}");
            assert!(p.normal.x == 0.0 && p.normal.y == 0.0 && (1.0..2.0).contains(&p.normal.z));
        }
        let far = L.map(|v| v + vec3(5000.0, -7000.0, 9000.0));
        assert_eq!(Polygon::<f32>::new(&far).normal, Polygon::<f32>::new(&L).normal);
        let mut turned = L;
        turned.reverse();
        assert_eq!(Polygon::<f32>::new(&turned).normal, -Polygon::<f32>::new(&L).normal);
    }

    #[test]
    fn a_notch_is_outside_and_its_corner_belongs_to_one_side() {
        let p = Polygon::<f32>::new(&L);
        for (x, y) in [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (0.999, 1.0), (1.0, 0.999), (0.5, 1.0)] {
            assert_eq!(all_hits(&p, &down(x, y)), [1.5], "{x} {y}");
        }
        for (x, y) in [(1.5, 1.5), (1.001, 1.001), (-0.1, 1.0), (2.1, 1.0), (1.0, 2.1), (3.0, 0.0)]
        {
            assert!(all_hits(&p, &down(x, y)).is_empty(), "{x} {y}");
        }
        // With the square that fills the notch: along the edges between them and through the
        // concave corner a ray meets exactly one of the two.
        let corners =
            [vec3(1.0, 1.0, 0.0), vec3(2.0, 1.0, 0.0), vec3(2.0, 2.0, 0.0), vec3(1.0, 2.0, 0.0)];
        let fill = Polygon::<f32>::new(&corners);
        for i in 0..64_u16 {
            let s = f32::from(i) / 64.0;
            for (x, y) in [(1.0 + s, 1.0), (1.0, 1.0 + s)] {
                let r = down(x, y);
                assert_eq!(all_hits(&p, &r).len() + all_hits(&fill, &r).len(), 1, "{x} {y}");
            }
        }
    }

    #[test]
    fn a_star_through_its_concave_corners_and_along_its_edges() {
        // Filled up to its convex hull by one triangle a notch, the star leaves no gap and no overlap.
        let corners = star(7);
        let p = Polygon::<f32>::new(&corners);
        assert_eq!(p.check(), Ok(()));
        let notches: Vec<[Vec3; 3]> = (0..7)
            .map(|i| [corners[2 * i], corners[2 * i + 1], corners[(2 * i + 2) % 14]])
            .collect();
        let mut random = Random(7);
        let mut rays = 0;
        for i in 0..14 {
            let (a, b) = (corners[i], corners[(i + 1) % 14]);
            for step in 0..400_u16 {
                let at = a + (b - a) * (f32::from(step) / 399.0);
                if at.length() > 0.99 {
                    continue; // the tips are on the hull
                }
                let from = vec3(0.0, 0.0, 2.0) + random.vector();
                let r = Ray::new(from, at - from).unwrap();
                let hits: usize = all_hits(&p, &r).len()
                    + notches.iter().map(|n| all_hits(&Polygon::new(n), &r).len()).sum::<usize>();
                assert_eq!(hits, 1, "{at}");
                rays += 1;
            }
        }
        assert!(rays > 5000);
    }

    #[test]
    fn neighbours_share_every_ray_between_them() {
        let mut random = Random(3);
        for _ in 0..20_000 {
            let (a, b) = (random.vector(), random.vector());
            if (b - a).length() < 0.1 {
                continue;
            }
            let across = (b - a).cross(random.direction());
            if across.length() < 0.1 {
                continue;
            }
            let one = [a, b, b + across, a + across * 2.0];
            let other = [b, a, a - across, b - across * 0.7];
            let at = a + (b - a) * random.within(0.05, 0.95);
            let n = (b - a).cross(across).normalize();
            let from = at + (n + random.vector() * 0.5) * random.within(1.0, 50.0);
            let r = Ray::new(from, at - from).unwrap();
            let hits =
                all_hits(&Polygon::new(&one), &r).len() + all_hits(&Polygon::new(&other), &r).len();
            assert_eq!(hits, 1, "{a} {b}");
        }
    }

    #[test]
    fn out_of_a_closed_box_no_ray_escapes() {
        let corner = |i: u8| {
            let pick = |bit: u8, lo: f32, hi: f32| if i & bit == 0 { lo } else { hi };
            vec3(pick(1, -0.3, 1.1), pick(2, 0.2, 0.9), pick(4, -1.7, 0.4))
        };
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
                .map(|q: [u8; 4]| q.map(corner));
        let mut random = Random(11);
        for _ in 0..500 {
            let from = vec3(0.4, 0.55, -0.65) + random.vector() * vec3(0.6, 0.3, 1.0);
            for i in 0..8_u8 {
                for j in [i ^ 1, i ^ 2, i ^ 4] {
                    for s in [0.0, 0.5, random.within(0.0, 1.0)] {
                        let to = corner(i) + (corner(j) - corner(i)) * s;
                        let r = Ray::new(from, to - from).unwrap();
                        let hits: usize = quads
                            .iter()
                            .map(|q| {
                                all_hits(&Polygon::new(q), &r).iter().filter(|t| **t > 0.0).count()
                            })
                            .sum();
                        assert_eq!(hits, 1, "{from} {to}");
                    }
                }
            }
        }
    }

    /// Distance along the ray and least distance to the outline, or `None` outside: crossings in
    /// the plane of the polygon, in double precision.
    fn reference(corners: &[Vec3], r: &Ray<f32>) -> (Option<f64>, f64) {
        let c: Vec<DVec3> = corners.iter().map(|v| v.as_dvec3()).collect();
        let n: DVec3 = (0..c.len()).map(|i| c[i].cross(c[(i + 1) % c.len()])).sum();
        let (o, d) = (r.origin().as_dvec3(), r.direction().as_dvec3());
        let t = n.dot(c[0] - o) / n.dot(d);
        let p = o + d * t;
        let (u, v) = n.normalize().any_orthonormal_pair();
        let (mut turns, mut margin) = (0.0, f64::MAX);
        for i in 0..c.len() {
            let (a, b) = (c[i] - p, c[(i + 1) % c.len()] - p);
            let s = (-a.dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            margin = margin.min((a + (b - a) * s).length());
            let (a, b) = ((a.dot(u), a.dot(v)), (b.dot(u), b.dot(v)));
            turns += (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1);
        }
        ((turns.abs() > core::f64::consts::PI).then_some(t), margin)
    }

    #[test]
    fn agrees_with_double_precision() {
        let mut random = Random(1);
        let (mut hits, mut worst) = (0, 0.0_f64);
        for i in 0..20_000_u16 {
            let (u, n) = (random.direction(), random.direction());
            let u = u.cross(n).normalize();
            let v = n.cross(u);
            let place = random.vector() * 5.0;
            let shape = if i % 2 == 0 { L.to_vec() } else { star(3 + i % 9) };
            let size = random.within(0.1, 10.0);
            let corners: Vec<Vec3> =
                shape.iter().map(|c| place + u * (c.x * size) + v * (c.y * size)).collect();
            let p = Polygon::<f32>::new(&corners);
            let r = random.ray_at(place, size);
            let slant = n.dot(r.direction().normalize()).abs();
            let (expected, margin) = reference(&corners, &r);
            let found = all_hits(&p, &r);
            let bounds = p.bounds().grown(r.slack() * 1.01);
            assert!(found.iter().all(|t| bounds.contains(r.at(*t))));
            if slant < 0.1 || margin < 1.0e-4 * f64::from(size) {
                continue;
            }
            assert_eq!(found.len(), usize::from(expected.is_some()), "{i}");
            if let (Some(t), Some(found)) = (expected, found.first()) {
                hits += 1;
                let place = f64::from((place - r.origin()).length() + size + place.length());
                let error = (f64::from(*found) - t).abs() * f64::from(r.direction().length());
                worst = worst.max(error / place);
            }
        }
        std::println!("{hits} hits, worst {worst:e}");
        assert!(hits > 4000);
        assert!(worst < 2.0e-6, "{worst:e}");
    }

    #[test]
    fn degenerate_polygons_are_refused() {
        let d = |v: &[Vec3]| Polygon::<f32>::new(v).check();
        assert_eq!(d(&[]), Err(ShapeError::TooFewCorners));
        assert_eq!(d(&[Vec3::X, Vec3::Y]), Err(ShapeError::TooFewCorners));
        assert_eq!(d(&[Vec3::X, Vec3::X, Vec3::X]), Err(ShapeError::Degenerate));
        assert_eq!(d(&[Vec3::ZERO, Vec3::X, Vec3::X * 3.0]), Err(ShapeError::Degenerate));
        assert_eq!(d(&[Vec3::ZERO, Vec3::X, Vec3::NAN]), Err(ShapeError::NotFinite));
        assert_eq!(d(&[Vec3::ZERO, Vec3::X * 1e13, Vec3::Y]), Err(ShapeError::NotFinite));
        let bounds = Polygon::<f32>::new(&L).bounds();
        let with = |n| Polygon::<f32>::of_parts(&L, n, bounds).check();
        assert_eq!(with(Vec3::ZERO), Err(ShapeError::NotUnit));
        assert_eq!(with(Vec3::NAN), Err(ShapeError::NotFinite));
        assert_eq!(with(Vec3::Z), Ok(()));
        let wrong = Polygon::<f32>::of_parts(&L, Vec3::Z, bounds.grown(1.0));
        assert_eq!(wrong.check(), Err(ShapeError::NotFinite));
        // Even so it is only a miss, not a panic.
        assert!(all_hits(&Polygon::<f32>::new(&[]), &down(0.0, 0.0)).is_empty());
        let flat = Polygon::<f32>::of_parts(&L, Vec3::ZERO, bounds);
        assert!(all_hits(&flat, &down(0.5, 0.5)).is_empty());
    }
}
