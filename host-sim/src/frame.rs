//! The frame of coordinates in which a scene is traced. Floats take the file's own; in fixed point
//! a scene is normalised: moved to the middle and shrunk to coordinates of at most 1/2.

use std::borrow::Cow;

use kibiray::geom::{Interval, NotARay, Ray};
use kibiray::num::{Real, Vec3, Vector};

use crate::description::{Description, Solid, Triple};
use crate::view;

/// Where a scene is moved: `(p - center) / 2^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    center: Triple,
    exponent: i32,
    normalised: bool,
}

/// The greatest coordinate of a normalised scene; a little less than what the core takes, as boxes
/// are rounded outwards.
const GREATEST: f64 = 0.499;

/// The greatest coordinate of an eye.
const FARTHEST: f64 = 7.5;

/// Rays that start farther from the middle are moved nearer beforehand.
const FAR: f64 = 3.5;

/// How a parameter of a ray as it is traced becomes one of the ray that was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    shift: f64,
    factor: f64,
}

impl Way {
    /// None at all.
    pub const STRAIGHT: Self = Self { shift: 0.0, factor: 1.0 };

    /// The parameter of the ray that was asked for.
    pub fn restore(self, t: f64) -> f64 {
        (t + self.shift) * self.factor
    }
}

impl Frame {
    /// That of the file.
    pub const FILE: Self = Self { center: [0.0; 3], exponent: 0, normalised: false };

    /// The frame for a number type.
    pub fn of<R: Real>(description: &Description) -> Self {
        if !R::EXACT {
            return Self::FILE;
        }
        let (lo, hi) = view::bounds(description);
        let extent = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max);
        // Round numbers stay round: whole multiples of 1/256 of the extent's power of two.
        let grain = 2_f64.powi(exponent_of(extent.max(f64::MIN_POSITIVE)) - 8);
        let center = [0, 1, 2].map(|a| ((lo[a] + hi[a]) / 2.0 / grain).round() * grain);
        let off = |p: Triple| (0..3).map(|a| (p[a] - center[a]).abs()).fold(0.0, f64::max);
        let planes = description.items.iter().filter_map(|item| match &item.solid {
            Solid::Plane { point, normal } => Some(off(foot(center, *point, *normal))),
            _ => None,
        });
        let size = planes.fold(off(lo).max(off(hi)), f64::max) / GREATEST;
        let eye = off(view::of(description).from) / FARTHEST;
        Self { center, exponent: exponent_of(size.max(eye)), normalised: true }
    }

    /// The length in the file that is 1 in this frame.
    pub fn unit(&self) -> f64 {
        2_f64.powi(self.exponent)
    }

    fn scale(&self) -> f64 {
        2_f64.powi(-self.exponent)
    }

    fn point(&self, p: Triple) -> Triple {
        [0, 1, 2].map(|a| (p[a] - self.center[a]) * self.scale())
    }

    /// The description in this frame, its view and lights made explicit.
    pub fn apply<'d>(&self, description: &'d Description) -> Cow<'d, Description> {
        if !self.normalised {
            return Cow::Borrowed(description);
        }
        let seen = view::of(description);
        let mut moved = Description {
            lights: view::lights_of(description, &seen),
            background: view::background_of(description),
            ..description.clone()
        };
        for light in &mut moved.lights {
            light.position = self.point(light.position);
        }
        let from = self.point(seen.from);
        let sight = [0, 1, 2].map(|a| seen.at[a] - seen.from[a]);
        let length = length(sight);
        // Only its direction counts; the point itself may be anywhere.
        let at = [0, 1, 2].map(|a| from[a] + sight[a] / length);
        moved.view = Some(crate::description::View { from, at, up: unit(seen.up), ..seen });
        for item in &mut moved.items {
            if let Solid::Plane { point, normal } = &mut item.solid {
                *point = foot(self.center, *point, *normal);
                *normal = unit(*normal);
            }
            item.solid.moved(&|p| self.point(p), self.scale());
        }
        Cow::Owned(moved)
    }

    /// A ray query in this frame: the ray, where hits count, and the way back.
    ///
    /// # Errors
    /// [`NotARay`].
    pub fn query<R: Real>(
        &self,
        origin: Triple,
        direction: Triple,
        (min, max): (f64, f64),
    ) -> Result<(Ray<R>, Interval<R>, Way), NotARay> {
        if !self.normalised {
            let (o, d) = (Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(direction));
            let interval = Interval::new(R::from_f64(min), R::from_f64(max));
            return Ok((Ray::new(o, d)?, interval, Way::STRAIGHT));
        }
        // The greatest component first, so that no square overflows.
        let greatest = direction.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let all = origin.iter().chain(&direction);
        if !(greatest > 0.0 && all.clone().all(|x| x.is_finite())) {
            return Err(NotARay);
        }
        let scaled = direction.map(|d| d / greatest);
        let long = length(scaled);
        let unit = scaled.map(|d| d / long);
        let factor = 2_f64.powi(self.exponent) / greatest / long;
        let mut from = self.point(origin);
        let mut shift = 0.0;
        if from.iter().any(|x| x.abs() > FAR) {
            // To 2 before the point that is nearest to the middle; where that is far outside the
            // scene the ray meets nothing, nor does one that passes nearer by outside.
            let along: f64 = (0..3).map(|a| from[a] * unit[a]).sum();
            shift = -along - 2.0;
            let foot = [0, 1, 2].map(|a| from[a] - unit[a] * along);
            let nearer = (5.0 / length(foot)).min(1.0);
            from = [0, 1, 2].map(|a| foot[a] * nearer - unit[a] * 2.0);
        }
        let ray = Ray::new(Vec3::<R>::from_f64(from), Vec3::<R>::from_f64(unit))?;
        let interval = if min < max {
            // Rounded outwards: of the numbers between, these are the next ones beyond.
            let step = R::EPSILON.to_f64();
            let steps = |t: f64| (t / factor - shift) / step;
            let (min, max) = (steps(min).floor() * step, steps(max).ceil() * step);
            Interval::new(R::from_f64(min), R::from_f64(max))
        } else {
            Interval::new(R::ZERO, R::ZERO)
        };
        Ok((ray, interval, Way { shift, factor }))
    }
}

/// The least power of two that is not less.
fn exponent_of(x: f64) -> i32 {
    x.log2().ceil() as i32
}

fn length(v: Triple) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn unit(v: Triple) -> Triple {
    let greatest = v.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
    let scaled = v.map(|x| x / greatest);
    scaled.map(|x| x / length(scaled).max(f64::MIN_POSITIVE))
}

/// The point of a plane that is nearest to another.
fn foot(from: Triple, point: Triple, normal: Triple) -> Triple {
    let n = unit(normal);
    let off: f64 = (0..3).map(|a| (point[a] - from[a]) * n[a]).sum();
    [0, 1, 2].map(|a| from[a] + n[a] * off)
}
