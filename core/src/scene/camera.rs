//! The pinhole camera.

use crate::geom::Ray;
use crate::num::{Real, Vec3, Vector};

/// Where a picture is taken from, after NFF's `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<R: Real> {
    /// The eye.
    pub from: Vec3<R>,
    /// What is seen in the middle.
    pub at: Vec3<R>,
    /// Which way is up.
    pub up: Vec3<R>,
    /// Full vertical angle of view, in radians, more than 0 and less than π.
    pub angle: R,
}

/// A view that shows nothing: eye and middle coincide, up is along the line of sight, the angle is
/// out of range, or a number is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewError;

impl core::fmt::Display for ViewError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(
            "no view: from and at coincide, up is along the line of sight, or the angle is not \
             between 0 and 180 degrees",
        )
    }
}

impl core::error::Error for ViewError {}

/// A camera: the eye and a picture plane one unit in front of it. Coordinates are right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera<R: Real> {
    eye: Vec3<R>,
    /// The eye's greatest coordinate.
    reach: R,
    /// From the eye to the middle of the picture.
    forward: Vec3<R>,
    /// From the middle of the picture to its right edge.
    right: Vec3<R>,
    /// From the middle of the picture to its upper edge.
    up: Vec3<R>,
}

impl<R: Real> Camera<R> {
    /// A camera for a picture that is `aspect` times as wide as high.
    ///
    /// # Errors
    /// [`ViewError`].
    pub fn new(view: &View<R>, aspect: R) -> Result<Self, ViewError> {
        let forward = (view.at - view.from).unit().ok_or(ViewError)?;
        let up = view.up.unit().ok_or(ViewError)?;
        let right = forward.cross(up);
        // What is smaller than this is only the rounding of parallel vectors.
        if !(right.max_abs() > R::ulps(16)) {
            return Err(ViewError);
        }
        let right = right.unit().ok_or(ViewError)?;
        let up = right.cross(forward);
        let in_range = view.angle > R::ZERO && view.angle < R::PI;
        if !(in_range && aspect > R::ZERO && aspect.is_finite()) {
            return Err(ViewError);
        }
        let half = (view.angle * R::HALF).tan();
        let (right, up) = (right * (half * aspect), up * half);
        Ok(Self { eye: view.from, reach: view.from.max_abs(), forward, right, up })
    }

    /// The ray through a point of the picture: `x` from -1 at the left edge to 1 at the right,
    /// `y` from -1 at the lower edge to 1 at the upper. `None` only if numbers overflow.
    pub fn ray(&self, x: R, y: R) -> Option<Ray<R>> {
        self.ray_in(&self.line(y), x)
    }

    /// A line of the picture, `y` as in [`Camera::ray`].
    pub(crate) fn line(&self, y: R) -> Line<R> {
        let middle = if R::EXACT { R::at(self.forward, self.up, y) } else { self.forward };
        Line { middle, y }
    }

    /// The ray through a point of a line.
    pub(crate) fn ray_in(&self, line: &Line<R>, x: R) -> Option<Ray<R>> {
        let direction = R::at(line.middle, self.right, x);
        if R::EXACT {
            // Where spheres are the quicker for a direction of length 1.
            return Ray::of_unit(self.eye, direction.unit()?, self.reach);
        }
        Ray::from(self.eye, R::at(direction, self.up, line.y), self.reach)
    }
}

/// What all points of a line of the picture have in common.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Line<R: Real> {
    /// From the eye to its middle, where it makes no difference which way is gone first.
    middle: Vec3<R>,
    y: R,
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn view() -> View<f32> {
        View { from: Vec3::Z, at: Vec3::ZERO, up: Vec3::Y, angle: core::f32::consts::FRAC_PI_2 }
    }

    #[test]
    fn right_is_right_and_up_is_up() {
        let camera = Camera::new(&view(), 2.0).unwrap();
        let d = camera.ray(1.0, 1.0).unwrap().direction();
        assert!((d - glam::vec3(2.0, 1.0, -1.0)).length() < 1e-6, "{d}");
    }

    #[test]
    fn views_of_nothing_are_refused() {
        let bad = [
            View { at: Vec3::Z, ..view() },
            View { up: Vec3::Z, ..view() },
            View { up: Vec3::ZERO, ..view() },
            View { angle: 0.0, ..view() },
            View { angle: -1.0, ..view() },
            View { angle: f32::NAN, ..view() },
            View { from: Vec3::NAN, ..view() },
        ];
        for view in bad {
            assert_eq!(Camera::new(&view, 1.0), Err(ViewError), "{view:?}");
        }
        assert!(Camera::new(&view(), 0.0).is_err());
    }
}
