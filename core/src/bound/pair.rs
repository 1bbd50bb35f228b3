//! Two bounds as one: their union and their intersection.
//!
//! H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", ACM TOG
//! 3(1) (1984). Whatever is inside either is in their union, whatever is inside both in their
//! intersection; so what each does alone is all that is needed, and nothing is rounded here.

use super::{Bound, Fitted, Region};
use crate::geom::Ray;
use crate::num::{Real, Vec3};

/// What is inside one of two bounds: of shapes of which each is inside one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Union<A, B>(pub A, pub B);

/// What is inside both of two bounds: of shapes that are inside either. The second is only tested
/// where the ray hits the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection<A, B>(pub A, pub B);

impl<R: Real, A: Bound<R>, B: Bound<R>> Bound<R> for Union<A, B> {
    type PerRay = (A::PerRay, B::PerRay);

    /// At most: as if they did not overlap. Areas of different kinds are not in the same unit.
    fn half_area(&self) -> R {
        self.0.half_area() + self.1.half_area()
    }

    fn middle(&self) -> Vec3<R> {
        self.0.middle() * R::HALF + self.1.middle() * R::HALF
    }

    fn per_ray(ray: &Ray<R>) -> Self::PerRay {
        (A::per_ray(ray), B::per_ray(ray))
    }

    fn enter(&self, ray: &Self::PerRay, start: R, limit: R) -> Option<R> {
        let (first, second) =
            (self.0.enter(&ray.0, start, limit), self.1.enter(&ray.1, start, limit));
        match (first, second) {
            (Some(first), Some(second)) => Some(first.min(second)),
            (first, second) => first.or(second),
        }
    }
}

impl<R: Real, A: Bound<R>, B: Bound<R>> Bound<R> for Intersection<A, B> {
    type PerRay = (A::PerRay, B::PerRay);

    /// At most.
    fn half_area(&self) -> R {
        self.0.half_area().min(self.1.half_area())
    }

    fn middle(&self) -> Vec3<R> {
        self.0.middle() * R::HALF + self.1.middle() * R::HALF
    }

    fn per_ray(ray: &Ray<R>) -> Self::PerRay {
        (A::per_ray(ray), B::per_ray(ray))
    }

    fn enter(&self, ray: &Self::PerRay, start: R, limit: R) -> Option<R> {
        let first = self.0.enter(&ray.0, start, limit)?;
        self.1.enter(&ray.1, first, limit)
    }
}

impl<R: Real, A: Fitted<R>, B: Fitted<R>> Fitted<R> for Intersection<A, B> {
    fn around(region: &Region<R>, pad: R) -> Self {
        Self(A::around(region, pad), B::around(region, pad))
    }

    fn union(self, other: Self) -> Self {
        Self(self.0.union(other.0), self.1.union(other.1))
    }
}
