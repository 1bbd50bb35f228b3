//! What lies between two parallel planes, as a ray sees it: all flat bounds are made of that.
//!
//! T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986.

use crate::geom::Ray;
use crate::num::{Axis, Real, Reciprocal, Vector};

/// A ray along a direction: where it starts, and the reciprocal of how it goes on.
pub(super) type Course<R> = (R, <R as Real>::Reciprocal);

/// Along the three axes.
pub(super) fn courses<R: Real>(ray: &Ray<R>) -> [Course<R>; 3] {
    let along = |axis| (ray.origin().along(axis), R::Reciprocal::of(ray.direction().along(axis)));
    Axis::ALL.map(along)
}

/// What two planes leave of the part of a ray between two parameters. A ray that does not move
/// along the direction is decided by where it starts, so that no product of 0 and infinity can
/// arise.
#[inline(always)]
pub(super) fn cut<R: Real>(
    (enter, leave): (R, R),
    (origin, inverse): Course<R>,
    [lo, hi]: [R; 2],
) -> Option<(R, R)> {
    let (near, far) = match inverse.sign() {
        0 => return (origin >= lo && origin <= hi).then_some((enter, leave)),
        1 => (lo, hi),
        _ => (hi, lo),
    };
    let enter = enter.max(inverse.times(near - origin));
    let leave = leave.min(inverse.times(far - origin));
    (enter <= leave).then_some((enter, leave))
}

/// What the sides of a box leave of it.
#[inline(always)]
pub(super) fn cut_by_box<R: Real>(
    part: (R, R),
    [x, y, z]: &[Course<R>; 3],
    lo: R::Vec3,
    hi: R::Vec3,
) -> Option<(R, R)> {
    let part = cut::<R>(part, *x, [lo.x(), hi.x()])?;
    let part = cut::<R>(part, *y, [lo.y(), hi.y()])?;
    cut::<R>(part, *z, [lo.z(), hi.z()])
}
