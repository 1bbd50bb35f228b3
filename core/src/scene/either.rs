//! One set of shapes or another, which is known only when the program runs.

use super::Shapes;
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3};
use crate::shape::ShapeError;
use core::ops::Range;

/// One of two sets: a scene that turns out to have only one kind of shape goes through the loop of
/// that kind alone, in a program that can do with several.
#[derive(Clone, Copy, Debug)]
pub enum Either<A, B> {
    /// The one.
    One(A),
    /// The other.
    Other(B),
}

impl<A: Default, B> Default for Either<A, B> {
    fn default() -> Self {
        Self::One(A::default())
    }
}

use Either::{One, Other};

impl<R: Real, A: Shapes<R>, B: Shapes<R>> Shapes<R> for Either<A, B> {
    type PerRay = Either<A::PerRay, B::PerRay>;

    const UNBOUNDED: bool = A::UNBOUNDED || B::UNBOUNDED;
    const FLAT: bool = A::FLAT || B::FLAT;

    fn count(&self) -> usize {
        match self {
            One(it) => it.count(),
            Other(it) => it.count(),
        }
    }

    fn bounded(&self) -> usize {
        match self {
            One(it) => it.bounded(),
            Other(it) => it.bounded(),
        }
    }

    fn unbounded_last(&self) -> bool {
        match self {
            One(it) => it.unbounded_last(),
            Other(it) => it.unbounded_last(),
        }
    }

    fn check(&self, id: usize) -> Result<(), ShapeError> {
        match self {
            One(it) => it.check(id),
            Other(it) => it.check(id),
        }
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        match self {
            One(it) => it.bounds(id),
            Other(it) => it.bounds(id),
        }
    }

    fn region(&self, id: usize) -> Region<R> {
        match self {
            One(it) => it.region(id),
            Other(it) => it.region(id),
        }
    }

    fn overlaps(&self, id: usize, cell: &Aabb<R>) -> bool {
        match self {
            One(it) => it.overlaps(id, cell),
            Other(it) => it.overlaps(id, cell),
        }
    }

    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay {
        match self {
            One(it) => One(it.per_ray(ray)),
            Other(it) => Other(it.per_ray(ray)),
        }
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R> {
        match (self, per_ray) {
            (One(it), One(per_ray)) => it.hit(id, ray, per_ray, min, max),
            (Other(it), Other(per_ray)) => it.hit(id, ray, per_ray, min, max),
            _ => None,
        }
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        match (self, per_ray) {
            (One(it), One(per_ray)) => it.occludes(id, ray, per_ray, min, max),
            (Other(it), Other(per_ray)) => it.occludes(id, ray, per_ray, min, max),
            _ => false,
        }
    }

    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<(usize, R)> {
        match (self, per_ray) {
            (One(it), One(per_ray)) => it.nearest_of(ids, ray, per_ray, min, max),
            (Other(it), Other(per_ray)) => it.nearest_of(ids, ray, per_ray, min, max),
            _ => None,
        }
    }

    fn any_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        match (self, per_ray) {
            (One(it), One(per_ray)) => it.any_of(ids, ray, per_ray, min, max),
            (Other(it), Other(per_ray)) => it.any_of(ids, ray, per_ray, min, max),
            _ => None,
        }
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        match self {
            One(it) => it.normal(id, ray, t),
            Other(it) => it.normal(id, ray, t),
        }
    }

    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>> {
        match self {
            One(it) => it.shading_normal(id, ray, t),
            Other(it) => it.shading_normal(id, ray, t),
        }
    }

    fn reach(&self, id: usize) -> R {
        match self {
            One(it) => it.reach(id),
            Other(it) => it.reach(id),
        }
    }

    fn is_flat(&self, id: usize) -> bool {
        match self {
            One(it) => it.is_flat(id),
            Other(it) => it.is_flat(id),
        }
    }
}
