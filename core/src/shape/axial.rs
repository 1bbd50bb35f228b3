//! What the solids around an axis share: their hull, and a ray as the axis sees it.

use super::overlap::{Slab, round, settle_between};
use super::{Length, ShapeError};
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Axis, Real, Vec3, Vector};

/// Two discs across an axis and all between them: the solid itself, or what an open one surrounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull<R: Real> {
    pub(super) base: Vec3<R>,
    /// Of length 1, as far as [`is_unit`] can tell.
    pub(super) axis: Vec3<R>,
    pub(super) height: R,
    /// At height 0.
    pub(super) base_radius: R,
    /// How much the radius grows in a unit of height.
    pub(super) growth: R,
    /// At the other end; with `growth` it is told twice, so that nothing is rounded.
    pub(super) apex_radius: R,
}

impl<R: Real> Hull<R> {
    /// The middle of the axis.
    pub(super) fn middle(&self) -> Vec3<R> {
        self.base + self.axis * (self.height * R::HALF)
    }

    /// The box around the discs, rounded outwards.
    pub(super) fn bounds(&self) -> Aabb<R> {
        let Self { base, axis, height, base_radius, apex_radius, .. } = *self;
        // A disc reaches as far along an axis as its normal is tilted away from it. Not by
        // √(1 - a²), which is noise for an upright one.
        let tilt = |along: Axis| {
            let (u, v) = along.others();
            let (u, v) = (axis.along(u), axis.along(v));
            R::sqrt_wide(u.times(u) + v.times(v)) * (R::ONE + R::ulps(4))
        };
        let tilt = Vec3::<R>::from_array(Axis::ALL.map(tilt));
        let apex = base + axis * height;
        let (b, a) = (tilt * base_radius, tilt * apex_radius);
        let all = Aabb::around([base - b, base + b, apex - a, apex + a]);
        let all = all.grown(R::ulps_at(2, height + base_radius.max(apex_radius)));
        Aabb { lo: all.lo.map(R::next_down), hi: all.hi.map(R::next_up) }
    }

    /// Where it may be hit.
    pub(super) fn region(&self) -> Region<R> {
        let Self { base, axis, height, base_radius, apex_radius, .. } = *self;
        let radii = [base_radius, apex_radius];
        Region::Discs { bounds: self.bounds(), base, axis, height, radii }
    }

    /// What is wrong with it; `radii` together decide whether there is a surface.
    pub(super) fn check(&self, radii: R) -> Result<(), ShapeError> {
        // A normalised scene has no room for less than the box.
        let reach = match R::EXACT {
            true => self.bounds().max_abs(),
            false => self.base.max_abs() + self.height.abs() + radii,
        };
        let negative = |x| x < R::ZERO;
        if !(self.base.is_finite() && self.axis.is_finite() && R::is_workable(reach)) {
            Err(ShapeError::NotFinite)
        } else if [self.height, self.base_radius, self.apex_radius].into_iter().any(negative) {
            Err(ShapeError::Negative)
        } else if !(self.height > R::ZERO && radii.times(radii) > R::Wide::default()) {
            Err(ShapeError::Degenerate)
        } else if !is_unit::<R>(self.axis) {
            Err(ShapeError::NotUnit)
        } else {
            Ok(())
        }
    }

    /// On which part of the surface a hit lies, and the way there from the axis, across it.
    pub(super) fn place(&self, found: Option<Passage<R>>, ray: &Ray<R>, t: R) -> (Part, Vec3<R>) {
        match found.and_then(|(frame, all)| Some((frame, frame.origin_of(all, t)?))) {
            Some((frame, (step, part))) => (part, frame.moved(step).q),
            None => {
                let p = ray.at(t) - self.base;
                (Part::Wall, p - self.axis * R::narrow(p.dot(self.axis)))
            }
        }
    }

    /// What it lies between, besides its box.
    fn slabs(&self) -> [Slab<R>; 5] {
        round::<R>(self.base, self.axis, self.height, self.base_radius.max(self.apex_radius))
    }

    /// Whether it may reach into a cell.
    pub(super) fn overlaps(&self, cell: &Aabb<R>) -> bool {
        self.slabs().iter().all(|slab| slab.meets(cell))
    }

    /// What [`settle_between`] makes of a crossing, without its square roots where the crossing is
    /// plainly close to the solid, as almost all are.
    fn settle(&self, ray: &Ray<R>, t: R) -> Option<R> {
        if self.is_close(ray.at(t), ray.slack()) {
            return Some(t);
        }
        self.settle_far(ray, t)
    }

    /// Apart, for the room it takes on the stack.
    #[cold]
    #[inline(never)]
    fn settle_far(&self, ray: &Ray<R>, t: R) -> Option<R> {
        settle_between(ray, &self.bounds(), self.slabs(), t)
    }

    /// Whether a point certainly lies within `slack` of the hull, and so in its box grown by that.
    ///
    /// It does when it is half of that away at most both along the axis and across: together √½ of
    /// it. What rounding adds is in proportion to the solid, in units of ε (height + radius): along
    /// the axis 32 for an axis that is a unit within 16 ε, and 4 for the products; across 8. Taking
    /// 20 off both halves makes up for all of it: (s/2 + 16)² + (s/2 - 12)² <= s² from s = 33, and
    /// there is nothing left of them below 40.
    fn is_close(&self, p: Vec3<R>, slack: R) -> bool {
        let size = self.height + self.base_radius.max(self.apex_radius);
        let margin = slack * R::HALF - R::ulps_at(20, size);
        // Squares of less have no digits left to compare.
        if !(margin > R::EPSILON * R::EPSILON) {
            return false;
        }
        let p = p - self.base;
        let height = R::narrow(p.dot(self.axis));
        let nearest = height.clamp(R::ZERO, self.height);
        let off = p - self.axis * nearest;
        let reach = self.base_radius + self.growth * nearest + margin;
        // Less, not equal: both may be infinite.
        (height - nearest).abs() <= margin && off.dot(off) < reach.times(reach)
    }
}

/// A ray as an axis sees it: split into the parts across and along, and taken from near the middle.
#[derive(Clone, Copy)]
pub(super) struct Frame<R: Real> {
    /// The ray's parameter at which it is taken; everything else is in steps from there.
    pub(super) start: R,
    /// From the axis to the ray's point.
    pub(super) q: Vec3<R>,
    /// The direction across the axis.
    pub(super) d: Vec3<R>,
    /// The height of the ray's point above the middle.
    pub(super) z: R,
    /// The direction along the axis.
    pub(super) dz: R,
}

/// Which part of the surface a crossing lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    Wall,
    Base,
    Apex,
}

/// A crossing: the step from [`Frame::start`], and where.
type Crossing<R> = (R, Part);

/// Where the ray enters and where it leaves.
pub(super) type Crossings<R> = [Option<Crossing<R>>; 2];

/// How a ray passes: as the axis sees it, and where it crosses the surface.
pub(super) type Passage<R> = (Frame<R>, Crossings<R>);

impl<R: Real> Frame<R> {
    pub(super) fn of(ray: &Ray<R>, length: &Length<R>, middle: Vec3<R>, axis: Vec3<R>) -> Self {
        let f = middle - ray.origin();
        let d = ray.direction();
        let start = R::narrow(f.dot(d)) * length.inverse_squared;
        let q = d * start - f;
        let (z, dz) = (R::narrow(q.dot(axis)), R::narrow(d.dot(axis)));
        Self { start, q: q - axis * z, d: d - axis * dz, z, dz }
    }

    /// The same taken from another of the ray's points.
    pub(super) fn moved(self, step: R) -> Self {
        Self {
            start: self.start + step,
            q: self.q + self.d * step,
            z: self.z + self.dz * step,
            ..self
        }
    }

    /// Between which steps the height is at most `half` from the middle.
    pub(super) fn slab(&self, half: R) -> Option<(R, R)> {
        let (base, apex) = ((-half - self.z) / self.dz, (half - self.z) / self.dz);
        if self.dz > R::ZERO {
            Some((base, apex))
        } else if self.dz < R::ZERO {
            Some((apex, base))
        } else {
            (self.z.abs() <= half).then_some((-R::INFINITY, R::INFINITY))
        }
    }

    /// The crossings of a convex wall between two planes of which some are `closed` (base, apex).
    pub(super) fn ends(&self, wall: (R, R), slab: (R, R), closed: (bool, bool)) -> Crossings<R> {
        let ((enter, leave), (lo, hi)) = (wall, slab);
        let upwards = self.dz > R::ZERO;
        let (first, last) =
            if upwards { (Part::Base, Part::Apex) } else { (Part::Apex, Part::Base) };
        let closed = if upwards { closed } else { (closed.1, closed.0) };
        let near = if enter >= lo {
            (enter <= hi).then_some((enter, Part::Wall))
        } else {
            (closed.0 && lo <= leave).then_some((lo, first))
        };
        let far = if leave <= hi {
            (leave >= lo).then_some((leave, Part::Wall))
        } else {
            (closed.1 && hi >= enter).then_some((hi, last))
        };
        [near, far]
    }

    /// The crossing a hit came from: that with this `t`, or the nearer one if it was moved.
    fn origin_of(&self, crossings: Crossings<R>, t: R) -> Option<Crossing<R>> {
        let off = |c: &Crossing<R>| (self.start + c.0 - t).abs();
        match crossings {
            [Some(a), Some(b)] => Some(if off(&a) <= off(&b) { a } else { b }),
            [a, b] => a.or(b),
        }
    }

    /// The first crossing that counts.
    pub(super) fn select(
        &self,
        crossings: Crossings<R>,
        ray: &Ray<R>,
        hull: &Hull<R>,
        (min, max): (R, R),
    ) -> Option<R> {
        let counts = |crossing: Option<Crossing<R>>| {
            let t = hull.settle(ray, self.start + crossing?.0)?;
            (t > min && t <= max).then_some(t)
        };
        let [near, far] = crossings;
        counts(near).or_else(|| counts(far))
    }
}

/// Direction and distance from one point to another; a direction of 0 where there is none.
pub(super) fn axis_between<R: Real>(base: Vec3<R>, apex: Vec3<R>) -> (Vec3<R>, R) {
    let way = apex - base;
    (way.unit().unwrap_or_default(), way.length())
}

/// Whether an axis has length 1 as far as rounding goes.
fn is_unit<R: Real>(axis: Vec3<R>) -> bool {
    (axis.length() - R::ONE).abs() <= R::ulps(16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::Random;

    extern crate std;

    #[test]
    fn what_is_close_is_in_the_grown_box() {
        let mut random = Random(41);
        let mut close = 0;
        for i in 0..400_000_u32 {
            // As far from a unit as passes.
            let axis = random.direction() * (1.0 + f32::ulps(14) * random.signed());
            assert!(is_unit::<f32>(axis));
            let (height, a, b) =
                (random.within(0.01, 1.0), random.within(0.0, 1.0), random.within(0.1, 1.0));
            let (a, b) = if i % 2 == 0 { (a, b) } else { (b, a) };
            let base = random.vector() * 3.0;
            let growth = (b - a) / height;
            let hull = Hull::<f32> { base, axis, height, base_radius: a, growth, apex_radius: b };
            let slack = f32::ulps(32) * random.within(0.5, 20.0);
            // Around the rims and the wall, by up to twice the slack.
            let up = [0.0, height, random.within(0.0, height)][i as usize % 3];
            let out = axis.cross(random.direction()).normalize() * (a + growth * up);
            let p = base + axis * up + out + random.vector() * slack * 2.0;
            if hull.is_close(p, slack) {
                close += 1;
                assert!(hull.bounds().grown(slack).contains(p), "{hull:?} {p} {slack}");
            }
        }
        std::println!("{close}");
        assert!(close > 40_000, "{close}");
    }
}
