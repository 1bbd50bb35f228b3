//! Numbered sets of convex solids: the operands of combinations.

use crate::geom::{Aabb, Ray};
use crate::num::Real;
use crate::scene::Shapes;
use crate::shape::Convex;

/// A numbered set of convex solids, put together as a scene's set of shapes is: a slice of one kind,
/// or two sets in a tuple. Code for kinds that are not named is not generated.
pub trait Parts<R: Real>: Shapes<R> {
    /// See [`Convex::span`].
    fn span(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay) -> Option<(R, R)>;

    /// See [`Convex::is_closed`].
    fn is_closed(&self, id: usize) -> bool;

    /// See [`Convex::extent`].
    fn extent(&self, id: usize) -> Aabb<R>;

    /// See [`Convex::reach`].
    fn part_reach(&self, id: usize) -> R;
}

/// The solids of one kind.
impl<R: Real, T: Convex<R>> Parts<R> for &[T] {
    fn span(&self, id: usize, ray: &Ray<R>, per_ray: &T::PerRay) -> Option<(R, R)> {
        self.get(id)?.span(ray, per_ray)
    }

    fn is_closed(&self, id: usize) -> bool {
        self.get(id).is_some_and(T::is_closed)
    }

    fn extent(&self, id: usize) -> Aabb<R> {
        self.get(id).map_or_else(Aabb::empty, T::extent)
    }

    fn part_reach(&self, id: usize) -> R {
        self.get(id).map_or(R::ZERO, T::reach)
    }
}

/// One set after the other: the numbers of the second follow those of the first.
impl<R: Real, A: Parts<R>, B: Parts<R>> Parts<R> for (A, B) {
    fn span(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay) -> Option<(R, R)> {
        match id.checked_sub(self.0.count()) {
            None => self.0.span(id, ray, &per_ray.0),
            Some(id) => self.1.span(id, ray, &per_ray.1),
        }
    }

    fn is_closed(&self, id: usize) -> bool {
        match id.checked_sub(self.0.count()) {
            None => self.0.is_closed(id),
            Some(id) => self.1.is_closed(id),
        }
    }

    fn extent(&self, id: usize) -> Aabb<R> {
        match id.checked_sub(self.0.count()) {
            None => self.0.extent(id),
            Some(id) => self.1.extent(id),
        }
    }

    fn part_reach(&self, id: usize) -> R {
        match id.checked_sub(self.0.count()) {
            None => self.0.part_reach(id),
            Some(id) => self.1.part_reach(id),
        }
    }
}
