//! Numbered sets of shapes: what a scene holds and a structure indexes.
//!
//! A slice of one kind of shape is a set; two sets in a tuple are a set, the second following the
//! first. So a program names the kinds it uses in a type, and code for others is never generated:
//! `&[Sphere<f32>]`, `(&[Sphere<f32>], &[Triangle<f32>])`, or [`Solids`](super::Solids) for all of
//! them. A set of one's own makes any object traceable.

use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3};
use crate::shape::{Shape, ShapeError};
use core::ops::Range;

/// A numbered set of shapes.
pub trait Shapes<R: Real> {
    /// What the shapes want to know of a ray, computed once a ray.
    type PerRay: Copy + Default;

    /// Whether some of them may have no bounds; where that is ruled out, no code handles it.
    const UNBOUNDED: bool = true;

    /// Whether some of them may be [flat](Shapes::is_flat); where that is ruled out, no code handles it.
    const FLAT: bool = false;

    /// How many there are.
    fn count(&self) -> usize;

    /// How many of them have bounds; their ids come first.
    fn bounded(&self) -> usize;

    /// Whether the ids of bounded shapes do come first.
    fn unbounded_last(&self) -> bool {
        true
    }

    /// See [`Shape::check`].
    ///
    /// # Errors
    /// What is wrong with the shape.
    fn check(&self, id: usize) -> Result<(), ShapeError>;

    /// See [`Shape::bounds`].
    fn bounds(&self, id: usize) -> Aabb<R>;

    /// See [`Shape::region`].
    fn region(&self, id: usize) -> Region<R> {
        Region::Box(self.bounds(id))
    }

    /// See [`Shape::overlaps`].
    fn overlaps(&self, _id: usize, _cell: &Aabb<R>) -> bool {
        true
    }

    /// Prepares a ray.
    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay;

    /// See [`Shape::hit`].
    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R>;

    /// See [`Shape::occludes`].
    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool;

    /// The nearest hit of the shapes in a range of ids: which, and where. Of several at the same `t`
    /// the one with the least id.
    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        mut max: R,
    ) -> Option<(usize, R)> {
        let mut nearest = None;
        for id in ids {
            if let Some(t) = self.hit(id, ray, per_ray, min, max)
                && (t < max || nearest.is_none())
            {
                nearest = Some((id, t));
                max = t;
            }
        }
        nearest
    }

    /// The first shape in a range of ids that is hit at all.
    fn any_of(
        &self,
        mut ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        ids.find(|id| self.occludes(*id, ray, per_ray, min, max))
    }

    /// See [`Shape::normal`].
    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R>;

    /// See [`Shape::shading_normal`].
    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>>;

    /// The greatest coordinate that hits of a shape are computed from, where that may be greater
    /// than those of the hit.
    fn reach(&self, _id: usize) -> R {
        R::ZERO
    }

    /// See [`Shape::FLAT`].
    fn is_flat(&self, _id: usize) -> bool {
        false
    }
}

/// The shapes of one kind. An id beyond the end is never hit.
impl<R: Real, T: Shape<R>> Shapes<R> for &[T] {
    type PerRay = T::PerRay;

    const UNBOUNDED: bool = !T::BOUNDED;
    const FLAT: bool = T::FLAT;

    fn count(&self) -> usize {
        self.len()
    }

    fn bounded(&self) -> usize {
        if T::BOUNDED { self.len() } else { 0 }
    }

    fn check(&self, id: usize) -> Result<(), ShapeError> {
        self.get(id).map_or(Ok(()), T::check)
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        self.get(id).map_or_else(Aabb::empty, T::bounds)
    }

    fn region(&self, id: usize) -> Region<R> {
        self.get(id).map_or_else(|| Region::Box(Aabb::empty()), T::region)
    }

    fn overlaps(&self, id: usize, cell: &Aabb<R>) -> bool {
        self.get(id).is_none_or(|shape| shape.overlaps(cell))
    }

    fn per_ray(&self, ray: &Ray<R>) -> T::PerRay {
        if self.is_empty() { T::PerRay::default() } else { T::per_ray(ray) }
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &T::PerRay, min: R, max: R) -> Option<R> {
        self.get(id)?.hit(ray, per_ray, min, max)
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &T::PerRay, min: R, max: R) -> bool {
        self.get(id).is_some_and(|shape| shape.occludes(ray, per_ray, min, max))
    }

    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &T::PerRay,
        min: R,
        mut max: R,
    ) -> Option<(usize, R)> {
        // Copies stay in registers.
        let (ray, per_ray, mut nearest) = (*ray, *per_ray, None);
        for (shape, id) in self.get(ids.clone())?.iter().zip(ids) {
            if let Some(t) = shape.hit(&ray, &per_ray, min, max)
                && (t < max || nearest.is_none())
            {
                nearest = Some((id, t));
                max = t;
            }
        }
        nearest
    }

    fn any_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &T::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        let (ray, per_ray, start) = (*ray, *per_ray, ids.start);
        let occludes = |shape: &T| shape.occludes(&ray, &per_ray, min, max);
        Some(start + self.get(ids)?.iter().position(occludes)?)
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        self.get(id).map_or_else(Vec3::<R>::default, |shape| shape.normal(ray, t))
    }

    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>> {
        self.get(id)?.shading_normal(ray, t)
    }

    fn reach(&self, id: usize) -> R {
        // Half: where m is a unit in the last place of the ray's and the point's coordinates and s one of
        // the shape's, a hit is off by 1.5 m + 2 s at most (`Real::POINT_ERROR`), less than 8 m or 4 s.
        self.get(id).map_or(R::ZERO, |shape| shape.computed_from() * R::HALF)
    }

    fn is_flat(&self, _id: usize) -> bool {
        T::FLAT
    }
}

/// One set after the other: the ids of the second follow those of the first.
impl<R: Real, A: Shapes<R>, B: Shapes<R>> Shapes<R> for (A, B) {
    type PerRay = (A::PerRay, B::PerRay);

    const UNBOUNDED: bool = A::UNBOUNDED || B::UNBOUNDED;
    const FLAT: bool = A::FLAT || B::FLAT;

    fn count(&self) -> usize {
        self.0.count() + self.1.count()
    }

    fn bounded(&self) -> usize {
        self.0.bounded() + self.1.bounded()
    }

    fn unbounded_last(&self) -> bool {
        let in_order = self.0.bounded() == self.0.count() || self.1.bounded() == 0;
        in_order && self.0.unbounded_last() && self.1.unbounded_last()
    }

    fn check(&self, id: usize) -> Result<(), ShapeError> {
        match id.checked_sub(self.0.count()) {
            None => self.0.check(id),
            Some(id) => self.1.check(id),
        }
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        match id.checked_sub(self.0.count()) {
            None => self.0.bounds(id),
            Some(id) => self.1.bounds(id),
        }
    }

    fn region(&self, id: usize) -> Region<R> {
        match id.checked_sub(self.0.count()) {
            None => self.0.region(id),
            Some(id) => self.1.region(id),
        }
    }

    fn overlaps(&self, id: usize, cell: &Aabb<R>) -> bool {
        match id.checked_sub(self.0.count()) {
            None => self.0.overlaps(id, cell),
            Some(id) => self.1.overlaps(id, cell),
        }
    }

    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay {
        (self.0.per_ray(ray), self.1.per_ray(ray))
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R> {
        match id.checked_sub(self.0.count()) {
            None => self.0.hit(id, ray, &per_ray.0, min, max),
            Some(id) => self.1.hit(id, ray, &per_ray.1, min, max),
        }
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        match id.checked_sub(self.0.count()) {
            None => self.0.occludes(id, ray, &per_ray.0, min, max),
            Some(id) => self.1.occludes(id, ray, &per_ray.1, min, max),
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
        let (first, second, count) = split(ids, self.0.count());
        let first = self.0.nearest_of(first, ray, &per_ray.0, min, max);
        let max = first.map_or(max, |(_, t)| t);
        match self.1.nearest_of(second, ray, &per_ray.1, min, max) {
            Some((id, t)) if t < max || first.is_none() => Some((id + count, t)),
            _ => first,
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
        let (first, second, count) = split(ids, self.0.count());
        let first = self.0.any_of(first, ray, &per_ray.0, min, max);
        first.or_else(|| Some(self.1.any_of(second, ray, &per_ray.1, min, max)? + count))
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        match id.checked_sub(self.0.count()) {
            None => self.0.normal(id, ray, t),
            Some(id) => self.1.normal(id, ray, t),
        }
    }

    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>> {
        match id.checked_sub(self.0.count()) {
            None => self.0.shading_normal(id, ray, t),
            Some(id) => self.1.shading_normal(id, ray, t),
        }
    }

    fn reach(&self, id: usize) -> R {
        match id.checked_sub(self.0.count()) {
            None => self.0.reach(id),
            Some(id) => self.1.reach(id),
        }
    }

    fn is_flat(&self, id: usize) -> bool {
        match id.checked_sub(self.0.count()) {
            None => self.0.is_flat(id),
            Some(id) => self.1.is_flat(id),
        }
    }
}

/// The parts of a range of ids that belong to the first and to the second of two sets, each counted
/// as the set does, and the number of shapes in the first.
fn split(ids: Range<usize>, count: usize) -> (Range<usize>, Range<usize>, usize) {
    let second = ids.start.saturating_sub(count)..ids.end.saturating_sub(count);
    (ids.start.min(count)..ids.end.min(count), second, count)
}
