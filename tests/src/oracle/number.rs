//! Numbers that oracles compute in: twice as many digits as what they judge.

use kibiray::num::{Fixed, Real};
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};
use twofloat::TwoFloat;

/// A number with more digits than the number type under test.
pub trait Number:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Exact.
    fn of(x: f64) -> Self;
    /// Rounded.
    fn to_f64(self) -> f64;
    /// The square root; 0 of what is negative.
    fn root(self) -> Self;
}

impl Number for f64 {
    fn of(x: f64) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn root(self) -> Self {
        self.max(0.0).sqrt()
    }
}

/// 106 bits in two doubles.
impl Number for TwoFloat {
    fn of(x: f64) -> Self {
        x.into()
    }
    fn to_f64(self) -> f64 {
        self.into()
    }
    fn root(self) -> Self {
        if self.to_f64() > 0.0 { self.sqrt() } else { Self::of(0.0) }
    }
}

/// A number type under test.
pub trait Tested: Real {
    /// What its answers are compared with.
    type Oracle: Number;
    /// Its name on the command line.
    const NAME: &'static str;
    /// What a length of 1 of a test's scene is in this type: fixed point has room for coordinates up to
    /// 1/2, and for origins of rays up to 2.
    const UNIT: f64 = 1.0;
    /// Numbers that are less are rounded by as much as this one.
    const LEAST: f64 = 0.0;
    /// How far a number of this size may be from the one that it was rounded from: what the
    /// literature calls u times the number.
    fn rounding(size: f64) -> f64;
}

impl Tested for f32 {
    type Oracle = f64;
    const NAME: &'static str = "f32";
    fn rounding(size: f64) -> f64 {
        size * 2.0_f64.powi(-24)
    }
}

impl Tested for f64 {
    type Oracle = TwoFloat;
    const NAME: &'static str = "f64";
    fn rounding(size: f64) -> f64 {
        size * 2.0_f64.powi(-53)
    }
}

/// Half a step, whatever the number's size.
impl Tested for Fixed {
    type Oracle = f64;
    const NAME: &'static str = "fixed";
    const UNIT: f64 = 1.0 / 16.0;
    const LEAST: f64 = 1.0;
    fn rounding(size: f64) -> f64 {
        size.max(Self::LEAST) * 2.0_f64.powi(-29)
    }
}

/// Three numbers.
pub type Triple<F> = [F; 3];

/// Three numbers of the type under test, exactly.
pub fn widen<R: Real, F: Number>(v: kibiray::num::Vec3<R>) -> Triple<F> {
    use kibiray::num::Vector;
    v.to_array().map(|x| F::of(x.to_f64()))
}

pub(super) fn sub<F: Number>(a: Triple<F>, b: Triple<F>) -> Triple<F> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn add<F: Number>(a: Triple<F>, b: Triple<F>) -> Triple<F> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn times<F: Number>(a: Triple<F>, s: F) -> Triple<F> {
    a.map(|x| x * s)
}

pub(super) fn dot<F: Number>(a: Triple<F>, b: Triple<F>) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross<F: Number>(a: Triple<F>, b: Triple<F>) -> Triple<F> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length<F: Number>(a: Triple<F>) -> F {
    dot(a, a).root()
}

pub(super) fn least<F: Number>(a: F, b: F) -> F {
    if a < b { a } else { b }
}

pub(super) fn greatest<F: Number>(a: F, b: F) -> F {
    if a > b { a } else { b }
}
