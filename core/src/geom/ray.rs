//! Rays, and what a box test wants to know of them.

use crate::num::{Axis, FOURS, Real, Reciprocal, Vec3, Vector};

/// A half-line: the points `origin + t * direction`, `t >= 0`.
///
/// The direction keeps the length it is given; `t` counts in its lengths. A ray is always a ray:
/// [`Ray::new`] refuses everything else, so no query has to ask again.
// Both vectors begin where a register of four numbers does: what is copied by fours is waited for if
// read across two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Ray<R: Real> {
    origin: Vec3<R>,
    /// The squared length of the direction.
    squared: R,
    direction: Vec3<R>,
    /// At least the greatest coordinate of the origin; beyond everything for directions whose
    /// squares are nothing to compute with.
    reach: R,
    slack: R,
    /// The flat shape it starts from, which it cannot meet; [`Ray::FREE`] for none.
    left: u32,
}

/// A component is infinite or not a number, or the direction is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotARay;

impl core::fmt::Display for NotARay {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("not a ray: a component is infinite or not a number, or the direction is zero")
    }
}

impl core::error::Error for NotARay {}

impl<R: Real> Ray<R> {
    /// Starts from no flat shape; an id that no shape has.
    pub(crate) const FREE: u32 = u32::MAX;

    /// A ray from a point into a direction of any length.
    ///
    /// # Errors
    /// [`NotARay`] when a component is infinite or not a number or the direction is zero.
    #[inline]
    pub fn new(origin: Vec3<R>, direction: Vec3<R>) -> Result<Self, NotARay> {
        let reach = origin.max_abs();
        let ray = if origin.is_finite() { Self::from(origin, direction, reach) } else { None };
        match ray {
            Some(ray) => Ok(ray.with_slack(R::ulps_at(R::SLACK, reach))),
            None => Err(NotARay),
        }
    }

    /// A ray from a point whose coordinates are at most `reach`; if one is infinite or not a number,
    /// then `reach` is, too. The scene that it is shot into gives it its slack.
    #[inline(always)]
    pub(crate) fn from(origin: Vec3<R>, direction: Vec3<R>, reach: R) -> Option<Self> {
        let squared = R::narrow(direction.dot(direction));
        let is_ordinary = R::is_ordinary(squared) && reach < R::INFINITY;
        let reach = checked(origin, direction, is_ordinary, reach)?;
        Some(Self { origin, direction, squared, reach, slack: R::ZERO, left: Self::FREE })
    }

    /// The same with a direction of length 1, give or take its rounding.
    #[inline]
    pub(crate) fn of_unit(origin: Vec3<R>, unit: Vec3<R>, reach: R) -> Option<Self> {
        let reach = checked(origin, unit, reach < R::INFINITY, reach)?;
        let (squared, slack, left) = (R::ONE, R::ZERO, Self::FREE);
        Some(Self { origin, direction: unit, squared, reach, slack, left })
    }

    /// Another ray of the same scene: from a point as in [`Ray::from`], its direction of the squared
    /// length given, give or take its rounding, from the flat shape `left` or none.
    #[inline]
    pub(crate) fn turned(
        &self,
        origin: Vec3<R>,
        direction: Vec3<R>,
        squared: R,
        reach: R,
        left: u32,
    ) -> Option<Self> {
        let is_ordinary = self.reach.max(reach) < R::INFINITY;
        let reach = checked(origin, direction, is_ordinary, reach)?;
        Some(Self { origin, direction, squared, reach, slack: self.slack, left })
    }

    /// Where it starts.
    pub fn origin(&self) -> Vec3<R> {
        self.origin
    }

    /// Where it goes.
    pub fn direction(&self) -> Vec3<R> {
        self.direction
    }

    /// The coordinate of the origin and the component of the direction along an axis that is found
    /// out: loads where a branch may be costly, else a branch that leaves the ray in registers.
    #[inline(always)]
    pub(crate) fn along(&self, axis: Axis) -> (R, R) {
        if FOURS {
            (self.origin.pick(axis), self.direction.pick(axis))
        } else {
            (self.origin.along(axis), self.direction.along(axis))
        }
    }

    /// The distance within which a point of this ray cannot be told from its neighbours; a shape
    /// may claim a hit this far outside its box, and no further.
    pub fn slack(&self) -> R {
        self.slack
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: R) -> Vec3<R> {
        R::along(self.origin, self.direction, t, self.reach)
    }

    /// The squared length of the direction.
    pub(crate) fn squared(&self) -> R {
        self.squared
    }

    /// Whether its direction is of length 1, which may be rounded where numbers are exact.
    pub(crate) fn is_unit(&self) -> bool {
        let slack = if R::EXACT { R::ulps(4) } else { R::ZERO };
        let off = self.squared.way(R::ONE);
        off >= -slack && off <= slack
    }

    /// How far from the middle of all coordinates it starts, at most; [`Real::INFINITY`] when the
    /// direction has to be scaled before anything is computed with it.
    pub(crate) fn reach(&self) -> R {
        self.reach
    }

    /// Whether it starts from that shape and cannot meet it: two points of a plane are all of a line
    /// that lies in it, so a ray that leaves a flat shape never comes back. Known, not computed: a
    /// triangle that is thinner than rounding has no sides to tell apart.
    #[inline]
    pub(crate) fn left(&self, id: usize) -> bool {
        self.left as usize == id
    }

    /// The same ray, from a flat shape or none.
    pub(crate) fn leaving(self, left: u32) -> Self {
        Self { left, ..self }
    }

    /// The flat shape it starts from.
    pub(crate) fn source(&self) -> u32 {
        self.left
    }

    /// The same ray with the slack of the scene it is shot into.
    #[inline(always)]
    pub(crate) fn with_slack(mut self, slack: R) -> Self {
        if cfg!(target_arch = "riscv32") {
            // One by one: as a whole it would be copied by a call, of 72 instructions.
            let Self { origin, squared, direction, reach, left, .. } = self;
            return Self { origin, squared, direction, reach, slack, left };
        }
        self.slack = slack;
        self
    }
}

/// How far away a ray starts that may not be ordinary: beyond everything if it is not, and nowhere if
/// it is no ray. A number, not a ray: that would go through memory.
#[inline(always)]
fn checked<R: Real>(origin: Vec3<R>, direction: Vec3<R>, is_ordinary: bool, reach: R) -> Option<R> {
    if is_ordinary {
        Some(reach)
    } else {
        is_extraordinary(origin.to_array(), direction.to_array()).then_some(R::INFINITY)
    }
}

/// Whether it is a ray, though one to be scaled before anything is computed with it. Of copies: what
/// is handed over has to be in memory.
#[cold]
#[inline(never)]
fn is_extraordinary<R: Real>(origin: [R; 3], direction: [R; 3]) -> bool {
    let [origin, direction] = [origin, direction].map(Vec3::<R>::from_array);
    origin.is_finite() && direction.is_finite() && !direction.is_zero()
}

/// The reciprocals of a ray's direction, for tests against planes across the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slopes<R: Real> {
    origin: Vec3<R>,
    /// 1 / direction; 0 along an axis the ray does not move along.
    inverse: [R::Reciprocal; 3],
}

impl<R: Real> Slopes<R> {
    /// Three divisions.
    pub fn of(ray: &Ray<R>) -> Self {
        let inverse = ray.direction.to_array().map(Reciprocal::of);
        Self { origin: ray.origin, inverse }
    }

    /// Those of a parallel ray.
    pub(crate) fn from(self, origin: Vec3<R>) -> Self {
        Self { origin, ..self }
    }

    /// Whether the coordinate along `axis` grows (1), shrinks (-1) or stays (0).
    pub fn sign(&self, axis: Axis) -> i32 {
        self.along(axis).sign()
    }

    /// The reciprocal along an axis; 0 where the ray stays.
    pub(crate) fn along(&self, axis: Axis) -> R::Reciprocal {
        let [x, y, z] = self.inverse;
        match axis {
            Axis::X => x,
            Axis::Y => y,
            Axis::Z => z,
        }
    }

    /// The parameter at which the coordinate along `axis` is `wall`; of no meaning where the ray
    /// stays ([`Slopes::sign`] 0).
    pub fn crossing(&self, axis: Axis, wall: R) -> R {
        self.along(axis).times(wall - self.origin.along(axis))
    }

    /// The parameters between which the ray is inside the closed box `lo..=hi`, cut to
    /// `min..=max`; `None` when it passes by. A ray that runs along a face is inside.
    ///
    /// T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986. Products of 0 and
    /// infinity, where the classic form breaks, cannot arise: an axis the ray does not move along
    /// is decided by its coordinate.
    pub fn clip(&self, lo: Vec3<R>, hi: Vec3<R>, min: R, max: R) -> Option<(R, R)> {
        let (lo, hi) = (lo - self.origin, hi - self.origin);
        let ([x, y, z], [ax, ay, az], [bx, by, bz]) = (self.inverse, lo.to_array(), hi.to_array());
        let part = between(x, ax, bx, (min, max))?;
        let part = between(y, ay, by, part)?;
        let (enter, leave) = between(z, az, bz, part)?;
        (enter <= leave).then_some((enter, leave))
    }
}

/// The part of a ray between two walls across an axis, `lo` and `hi` away from its origin.
// A call where memory for code is dear.
#[cfg_attr(target_pointer_width = "32", inline(never))]
#[cfg_attr(target_pointer_width = "64", inline(always))]
fn between<R: Real>(inverse: R::Reciprocal, lo: R, hi: R, part: (R, R)) -> Option<(R, R)> {
    let (near, far) = match inverse.sign() {
        // Where it stays, it is inside or it is not.
        0 => return (lo <= R::ZERO && hi >= R::ZERO).then_some(part),
        1 => (lo, hi),
        _ => (hi, lo),
    };
    Some((part.0.max(inverse.times(near)), part.1.min(inverse.times(far))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn ray(o: [f32; 3], d: [f32; 3]) -> Ray<f32> {
        Ray::new(o.into(), d.into()).unwrap()
    }

    #[test]
    fn only_rays_are_rays() {
        let o = Vec3::ZERO;
        for bad in [Vec3::ZERO, -Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(Ray::<f32>::new(o, bad), Err(NotARay));
        }
        assert!(Ray::<f32>::new(Vec3::new(0.0, f32::NAN, 0.0), Vec3::X).is_err());
        assert!(Ray::<f32>::new(o, Vec3::new(0.0, 0.0, -1.0e-40)).is_ok());
    }

    #[test]
    fn a_ray_in_a_face_is_inside_and_zeros_have_no_sign() {
        for zero in [0.0, -0.0] {
            let slopes = Slopes::of(&ray([1.0, 0.0, -5.0], [zero, zero, 1.0]));
            let hit = slopes.clip(Vec3::NEG_ONE, Vec3::ONE, 0.0, f32::MAX);
            assert_eq!(hit, Some((4.0, 6.0)));
            let hit = slopes.clip(Vec3::NEG_ONE, Vec3::new(0.99, 1.0, 1.0), 0.0, f32::MAX);
            assert_eq!(hit, None);
        }
    }

    #[test]
    fn clipping_keeps_to_the_interval() {
        let slopes = Slopes::of(&ray([0.0, 0.0, 0.0], [0.0, 2.0, 0.0]));
        assert_eq!(slopes.clip(Vec3::NEG_ONE, Vec3::ONE, 0.0, 9.0), Some((0.0, 0.5)));
        assert_eq!(slopes.clip(Vec3::NEG_ONE, Vec3::ONE, 0.6, 9.0), None);
    }
}
