//! Rays brought into the range in which the core computes.

use super::{Scene, Shapes};
use crate::geom::{Aabb, Interval, Ray, Slopes};
use crate::num::{Real, Vector};

/// Directions this many times longer or shorter than 1 are left as they are.
const LONG: i32 = 16;

/// How the ray that is traced relates to the ray that was asked for.
///
/// Brings a ray into the range in which the core computes: directions neither so long nor so short
/// that squares overflow or vanish, by a power of two and therefore exactly; and an origin far away
/// from the scene moved to where the ray comes near it, so that rounding errors are of the scene's
/// size. Ordinary rays are left as they are.
pub(crate) struct Framing<R> {
    asked: Interval<R>,
    /// Factor of the direction, a power of two.
    scale: R,
    /// Parameter of the new origin, before scaling back.
    shift: R,
    /// Whether the ray comes near the bounded shapes at all.
    pub(crate) near: bool,
}

impl<R: Real> Framing<R> {
    #[inline]
    pub(crate) fn of<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        asked: Interval<R>,
    ) -> (Ray<R>, Interval<R>, Self) {
        let ray = ray.with_slack(scene.slack());
        let (o, d) = (ray.origin(), ray.direction());
        // Squares, because they cost least; what overflows is not ordinary.
        let (distance, length) = (R::narrow(o.dot(o)), R::narrow(d.dot(d)));
        let (far, long) = (scene.far(), R::from_i32(LONG * LONG));
        if distance <= far * far && length <= long && length * long >= R::ONE {
            return (ray, asked, Self { asked, scale: R::ONE, shift: R::ZERO, near: true });
        }
        Self::of_extraordinary(ray, asked, scene.bounds(), far)
    }

    #[cold]
    #[inline(never)]
    fn of_extraordinary(
        mut ray: Ray<R>,
        asked: Interval<R>,
        bounds: Aabb<R>,
        far: R,
    ) -> (Ray<R>, Interval<R>, Self) {
        let mut framing = Self { asked, scale: R::ONE, shift: R::ZERO, near: true };
        // Where no number lies between the bounds, moving must not make room for some.
        if !(asked.min.next_up() < asked.max) {
            framing.near = false;
            return (ray, Interval::new(R::ZERO, R::ZERO), framing);
        }
        let mut interval = asked;
        let length = ray.direction().max_abs();
        let long = R::from_i32(LONG);
        if length > long || length * long < R::ONE {
            let (down, up) = length.scale_to_one();
            ray = ray.rebased(ray.origin(), ray.direction() * down);
            interval = Interval::new(interval.min * up, interval.max * up);
            framing.scale = down;
        }
        if ray.origin().max_abs() > far {
            let around = bounds.grown(far);
            match Slopes::of(&ray).clip(around.lo, around.hi, -R::MAX, R::MAX) {
                Some((enter, _)) => {
                    ray = ray.rebased(ray.at(enter), ray.direction());
                    interval = Interval::new(interval.min - enter, interval.max - enter);
                    framing.shift = enter;
                }
                None => framing.near = false,
            }
        }
        (ray, interval, framing)
    }

    /// A parameter of the traced ray as one of the ray that was asked for.
    pub(crate) fn restore(&self, t: R) -> R {
        if self.scale == R::ONE && self.shift == R::ZERO {
            return t;
        }
        let t = (t + self.shift) * self.scale;
        t.clamp(self.asked.min.next_up(), self.asked.max.next_down())
    }
}
