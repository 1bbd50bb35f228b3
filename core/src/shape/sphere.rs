//! The sphere.
//!
//! E. Haines, J. Günther, T. Akenine-Möller, "Precision improvements for ray/sphere intersection",
//! Ray Tracing Gems (2019), chapter 7: the discriminant is formed from the vector between centre and
//! ray instead of from b² - ac, so that distant small spheres do not drown in cancellation; of the
//! two solutions the one without cancellation is computed first and gives the other.

use super::overlap::sphere_surface;
use super::{Shape, ShapeError};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// A sphere; 16 bytes in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Sphere<R: Real> {
    /// Centre.
    pub center: Vec3<R>,
    /// Radius, greater than 0.
    pub radius: R,
}

impl<R: Real> Sphere<R> {
    /// A sphere around a point.
    pub const fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
    }
}

/// What round shapes want to know of a ray: its direction's length.
#[derive(Clone, Copy, Debug, Default)]
pub struct Length<R: Real> {
    /// 1 / |d|²
    pub(super) inverse_squared: R,
    /// 1 / |d|; of no use where numbers are exact.
    inverse: R,
    /// Where numbers are exact.
    course: R::Course,
}

impl<R: Real> Length<R> {
    /// A division and a square root, unless it is 1.
    pub(crate) fn of(ray: &Ray<R>) -> Self {
        if !R::EXACT {
            let inverse_squared = R::ONE / ray.squared();
            return Self {
                inverse_squared,
                inverse: inverse_squared.sqrt(),
                course: R::Course::default(),
            };
        }
        // A length of 1 may be rounded; what that makes of a hit is less than a step.
        let (inverse, unit) = if ray.is_unit() {
            (R::ONE, Some(ray.direction()))
        } else {
            (R::ONE / ray.squared(), ray.direction().unit())
        };
        let course = R::course(unit.unwrap_or_default(), ray.reach());
        Self { inverse_squared: inverse, inverse: R::ZERO, course }
    }
}

impl<R: Real> Sphere<R> {
    /// Middle less and plus half the chord: not quite the crossings, and never wild.
    #[inline]
    pub(crate) fn chord(&self, ray: &Ray<R>, length: &Length<R>) -> Option<(R, R)> {
        let (middle, half) = self.middle(ray, length, -R::INFINITY)?;
        Some((middle - half, middle + half))
    }

    /// The middle of the chord and half its length; `min` as for [`Real::chord`].
    #[inline(always)]
    fn middle(&self, ray: &Ray<R>, length: &Length<R>, min: R) -> Option<(R, R)> {
        let f = self.center - ray.origin();
        if R::passes(f, &length.course, self.radius) {
            return None;
        }
        let inverse = [length.inverse, length.inverse_squared];
        R::chord(f, ray.direction(), inverse, self.radius, min)
    }

    /// Both crossings, the smaller first.
    #[inline(always)]
    pub(super) fn crossings(&self, ray: &Ray<R>, length: &Length<R>) -> Option<(R, R)> {
        self.crossings_beyond(ray, length, -R::INFINITY)
    }

    /// The same, which may be none where both are at no parameter beyond `min`.
    #[inline(always)]
    fn crossings_beyond(&self, ray: &Ray<R>, length: &Length<R>, min: R) -> Option<(R, R)> {
        let (middle, half) = self.middle(ray, length, min)?;
        if R::EXACT {
            return Some((middle - half, middle + half));
        }
        let f = self.center - ray.origin();
        // The product of both solutions is (|f|² - r²) / |d|².
        let power = R::narrow(f.dot(f) - self.radius.times(self.radius));
        Some(ends(middle, half, power * length.inverse_squared))
    }
}

/// The ends of a chord from its middle, half its length and the product of both. Apart from it, as
/// most rays pass by most spheres.
#[inline(never)]
fn ends<R: Real>(middle: R, half: R, product: R) -> (R, R) {
    let outer = if middle >= R::ZERO { middle + half } else { middle - half };
    let inner = product / outer;
    // It is the smaller one, whatever rounding says of a ray that touches where it starts.
    let inner = inner.clamp(-outer.abs(), outer.abs());
    if inner <= outer { (inner, outer) } else { (outer, inner) }
}

impl<R: Real> Shape<R> for Sphere<R> {
    type PerRay = Length<R>;

    fn per_ray(ray: &Ray<R>) -> Length<R> {
        Length::of(ray)
    }

    fn check(&self) -> Result<(), ShapeError> {
        let reach = self.center.max_abs() + self.radius;
        if !(self.center.is_finite() && R::is_workable(reach)) {
            Err(ShapeError::NotFinite)
        } else if self.radius < R::ZERO {
            Err(ShapeError::Negative)
        } else if self.radius.times(self.radius) > R::Wide::default() {
            Ok(())
        } else {
            Err(ShapeError::Degenerate)
        }
    }

    fn bounds(&self) -> Aabb<R> {
        let r = Vec3::<R>::splat(self.radius);
        Aabb { lo: (self.center - r).map(R::next_down), hi: (self.center + r).map(R::next_up) }
    }

    fn overlaps(&self, cell: &Aabb<R>) -> bool {
        sphere_surface::<R>(self.center, self.radius, cell)
    }

    fn region(&self) -> Region<R> {
        Region::Ball { center: self.center, radius: self.radius }
    }

    #[inline(always)]
    fn hit(&self, ray: &Ray<R>, length: &Length<R>, min: R, max: R) -> Option<R> {
        // Mostly the sphere that a ray leaves: where numbers are exact, told without a root.
        let (near, far) = self.crossings_beyond(ray, length, min)?;
        if near > min {
            (near <= max).then_some(near)
        } else {
            (far > min && far <= max).then_some(far)
        }
    }

    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        ray.at(t) - self.center
    }

    fn computed_from(&self) -> R {
        self.center.max_abs() + self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{all_hits, hit_or_refused, only_numbers_are_hits, ray};

    const UNIT: Sphere<f32> = Sphere::new(glam::Vec3::ZERO, 1.0);

    #[test]
    fn published_crossings() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 5.
        for (origin, expected) in [
            ([0.0, 0.0, -5.0], &[4.0, 6.0][..]),
            ([0.0, 1.0, -5.0], &[5.0]),
            ([0.0, 2.0, -5.0], &[]),
            ([0.0, 0.0, 0.0], &[-1.0, 1.0]),
            ([0.0, 0.0, 5.0], &[-6.0, -4.0]),
        ] {
            assert_eq!(all_hits(&UNIT, &ray(origin, [0.0, 0.0, 1.0])), expected);
        }
    }

    #[test]
    fn a_direction_of_any_length_scales_t() {
        let hits = all_hits(&UNIT, &ray([0.0, 0.0, -5.0], [0.0, 0.0, 0.25]));
        assert_eq!(hits, [16.0, 24.0]);
    }

    #[test]
    #[allow(clippy::excessive_precision, reason = "digits as published")]
    fn the_case_of_embree_issue_676() {
        let r = ray(
            [14.800_112_7, -9.017_684_94, 3.470_127_58],
            [-0.989_340_246, -0.019_010_111_7, -0.144_376_263],
        );
        let nearer = Sphere::new(glam::vec3(9.668_708_8, -16.396_570_2, 3.939_959_3), 9.0);
        let farther = Sphere::new(glam::vec3(10.044_187_5, -9.693_452_84, 3.948_930_74), 9.0);
        let first = |s: &Sphere<f32>| all_hits(s, &r).into_iter().find(|t| *t > 0.0).unwrap();
        assert!((first(&nearer) - 10.298_3).abs() < 1e-3, "{}", first(&nearer));
        assert!(first(&farther) > first(&nearer));
    }

    #[test]
    fn distant_spheres_are_told_from_misses() {
        // Ray Tracing Gems, chapter 7: b² - ac decides nothing at 10^4 radii. A hundredth of the
        // radius inside and outside the silhouette must be right.
        for z in [1.0e2, 1.0e3, 1.0e4] {
            let towards = |x: f32| ray([x, 0.0, -z], [0.0, 0.0, 1.0]);
            assert_eq!(all_hits(&UNIT, &towards(0.99)).len(), 2, "{z}");
            assert!(all_hits(&UNIT, &towards(1.01)).is_empty(), "{z}");
        }
    }

    #[test]
    fn only_numbers_are_hits_of_spheres() {
        only_numbers_are_hits(&UNIT);
        only_numbers_are_hits(&Sphere::new(glam::vec3(0.2, -0.5, 0.3), 0.4));
    }

    #[test]
    fn spheres_of_every_size_are_hit_or_refused() {
        hit_or_refused(|random, place, size| {
            (Sphere::<f32>::new(place, random.within(0.01, 1.0) * size), [place])
        });
    }

    #[test]
    fn degenerate_spheres_are_refused() {
        let check = |x, r| Sphere::new(glam::vec3(x, 0.0, 0.0), r).check();
        assert_eq!(check(0.0, 0.0), Err(ShapeError::Degenerate));
        assert_eq!(check(0.0, -0.0), Err(ShapeError::Degenerate));
        assert_eq!(check(0.0, 1.0e-30), Err(ShapeError::Degenerate));
        assert_eq!(check(0.0, -1.0), Err(ShapeError::Negative));
        assert_eq!(check(0.0, f32::NAN), Err(ShapeError::NotFinite));
        assert_eq!(check(1.0e13, 1.0), Err(ShapeError::NotFinite));
        assert_eq!(check(f32::INFINITY, 1.0), Err(ShapeError::NotFinite));
        assert_eq!(check(-1.0e10, 1.0), Ok(()));
    }
}
