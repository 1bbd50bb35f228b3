//! Rays brought into the range in which the core computes.

use super::{Scene, Shapes};
use crate::geom::{Aabb, Interval, Ray, Slopes};
use crate::num::{Real, Vec3, Vector};

/// A ray that was not fit to compute with, as it is traced instead.
///
/// Directions so long or so short that squares overflow or vanish are scaled by a power of two and
/// therefore exactly; an origin far away from the scene is moved to where the ray comes near it, so
/// that rounding errors are of the scene's size.
pub(crate) struct Framing<R: Real> {
    pub(crate) ray: Ray<R>,
    pub(crate) interval: Interval<R>,
    /// Exponent of the factor of the direction, a power of two.
    exponent: i32,
    /// Parameter of the new origin, before scaling back.
    shift: R,
    /// Whether the ray comes near the bounded shapes at all; told only if it is asked.
    pub(crate) near: bool,
}

impl<R: Real> Framing<R> {
    /// Whether a ray needs none: nearly all.
    #[inline]
    pub(crate) fn is_needless<S: Shapes<R>>(scene: &Scene<'_, R, S>, ray: &Ray<R>) -> bool {
        ray.reach() <= scene.far()
    }

    /// Whether the line of a ray certainly passes by all bounded shapes. Told from where it starts,
    /// however far away that is: a point of it is off by three units in the last place of its
    /// distance at most. Where numbers are exact they leave no room for that, and nothing is told.
    ///
    /// S. Gottschalk, M. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference
    /// detection", SIGGRAPH 1996: a line and a box are apart if they are so across one of the
    /// products of the line's direction and the box's edges. No division, and it is right for lines
    /// along axes as it stands. Distances are doubled here: rounding adds up to less than 6 units in
    /// their last place, and the box is larger by 16, besides the pad.
    #[inline(always)]
    pub(crate) fn passes_by<S: Shapes<R>>(scene: &Scene<'_, R, S>, ray: &Ray<R>) -> bool {
        let room = scene.bounds().grown(scene.pad() + R::ulps_at(8, ray.reach()));
        if R::EXACT || room.contains(ray.origin()) {
            return false;
        }
        let [x, y, z] = ray.direction().to_array();
        let (ends, origin) = (room.lo + room.hi, ray.origin());
        let [cx, cy, cz] = (ends - (origin + origin)).to_array();
        let [ex, ey, ez] = room.size().to_array();
        let apart = |(a, b): (R, R), (c, d): (R, R), (e, f): (R, R)| {
            // Of what is smaller or greater than every number nothing is told.
            let least = R::EPSILON * R::EPSILON * R::EPSILON * R::EPSILON * R::EPSILON;
            let off = (a * d - b * c).abs();
            off > e * d.abs() + f * c.abs() + least && off < R::INFINITY
        };
        apart((cx, cy), (x, y), (ex, ey))
            || apart((cy, cz), (y, z), (ey, ez))
            || apart((cz, cx), (z, x), (ez, ex))
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn of<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        asked: Interval<R>,
        is_near: bool,
    ) -> Self {
        let (ray, far) = (ray.with_slack(scene.slack()), scene.far());
        let mut framing = Self { ray, interval: asked, exponent: 0, shift: R::ZERO, near: true };
        // Where no number lies between the bounds, moving must not make room for some.
        if !(asked.min.next_up() < asked.max) {
            framing.interval = Interval::new(R::ZERO, R::ZERO);
            framing.near = false;
            return framing;
        }
        let (mut origin, mut direction) = (ray.origin(), ray.direction());
        if ray.reach() == R::INFINITY {
            let exponent = R::direction_exponent(direction);
            direction = direction.map(|d| d.ldexp(exponent));
            framing.interval =
                Interval::new(asked.min.ldexp(-exponent), asked.max.ldexp(-exponent));
            framing.exponent = exponent;
        }
        if origin.max_abs() > far {
            let around = scene.bounds().grown(far);
            if framing.exponent != 0 {
                framing.ray = moved(&ray, origin, direction);
            }
            let slopes = Slopes::of(&framing.ray);
            match slopes.clip(around.lo, around.hi, -R::MAX, R::MAX) {
                Some((enter, _)) => {
                    origin = framing.ray.at(enter);
                    let Interval { min, max } = framing.interval;
                    let less = |t: R| if t.is_finite() { t - enter } else { t };
                    framing.interval = Interval::new(less(min), less(max));
                    framing.shift = enter;
                    if is_near {
                        // From there it can be told whether it meets the box of all shapes.
                        let room = scene.bounds().grown(scene.pad());
                        framing.near = meets(room, &slopes.from(origin));
                    }
                }
                None => framing.near = false,
            }
        }
        framing.ray = moved(&ray, origin, direction);
        framing
    }

    /// The ray as it is traced.
    #[cold]
    #[inline(never)]
    pub(crate) fn traced<S: Shapes<R>>(scene: &Scene<'_, R, S>, ray: &Ray<R>) -> Ray<R> {
        Self::of(scene, ray, Interval::RAY, false).ray
    }

    /// A parameter of the traced ray as one of the ray that was asked for.
    #[cold]
    #[inline(never)]
    pub(crate) fn restored<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        asked: Interval<R>,
        t: R,
    ) -> R {
        Self::of(scene, ray, asked, false).restore(asked, t)
    }

    fn restore(&self, asked: Interval<R>, t: R) -> R {
        let t = (t + self.shift).ldexp(self.exponent);
        t.clamp(asked.min.next_up(), asked.max.next_down())
    }
}

/// A ray like another one, from elsewhere.
#[inline(never)]
fn moved<R: Real>(ray: &Ray<R>, origin: Vec3<R>, direction: Vec3<R>) -> Ray<R> {
    let moved = Ray::from(origin, direction, origin.max_abs()).unwrap_or(*ray);
    moved.with_slack(ray.slack()).leaving(ray.source())
}

/// Whether a line meets a box.
fn meets<R: Real>(room: Aabb<R>, slopes: &Slopes<R>) -> bool {
    slopes.clip(room.lo, room.hi, -R::MAX, R::MAX).is_some()
}
