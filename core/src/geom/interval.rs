//! Where along a ray a hit counts.

use crate::num::Real;

/// The open interval `min < t < max` of a ray's parameter.
///
/// Empty or reversed intervals, and such with a bound that is not a number, contain nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<R> {
    /// Hits lie beyond this.
    pub min: R,
    /// Hits lie before this; may be [`Real::INFINITY`].
    pub max: R,
}

impl<R: Real> Interval<R> {
    /// The whole ray, its origin excluded.
    pub const RAY: Self = Self { min: R::ZERO, max: R::INFINITY };

    /// The open interval between two parameters.
    pub const fn new(min: R, max: R) -> Self {
        Self { min, max }
    }

    /// Whether `t` lies inside.
    pub fn contains(&self, t: R) -> bool {
        t > self.min && t < self.max
    }
}
