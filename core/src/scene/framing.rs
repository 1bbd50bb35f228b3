//! Rays brought into the range in which the core computes.

use super::{Scene, Shapes};
use crate::geom::{Interval, Ray, Slopes};
use crate::num::{Real, Vector};

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
    pub(crate) fn of<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        asked: Interval<R>,
    ) -> (Ray<R>, Interval<R>, Self) {
        let mut framing = Self { asked, scale: R::ONE, shift: R::ZERO, near: true };
        let mut ray = ray.with_slack(scene.slack());
        let mut interval = asked;
        let length = ray.direction().max_abs();
        let limit = R::from_i32(16);
        if length > limit || length * limit < R::ONE {
            let (down, up) = length.scale_to_one();
            ray = ray.rebased(ray.origin(), ray.direction() * down);
            interval = Interval::new(interval.min * up, interval.max * up);
            framing.scale = down;
        }
        if ray.origin().max_abs() > scene.far() {
            let around = scene.bounds().grown(scene.far());
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
