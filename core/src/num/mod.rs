//! The number types: everything outside this folder computes in some [`Real`] and names no float.
//!
//! A number type is a **type parameter**, so that one program can run two of them side by side and
//! compare. Three kinds of quantity are told apart, because a fixed-point type holds them in
//! different formats:
//! * `R: Real`: a coordinate, a length, a ray parameter, a direction component, a colour component;
//! * [`Real::Wide`]: a sum of products of two `R` (dot products, squared lengths, edge functions,
//!   discriminants). For floats it is the float itself; a 32-bit fixed-point type makes it 64 bits,
//!   so that signs of such sums are exact;
//! * [`Real::Vec3`]: three `R` (glam's for floats).
//!
//! # What keeps the bits equal on every target
//! Only `+ - * /`, comparisons, conversions and the correctly rounded square root touch a number on
//! the way of a ray. Rust neither fuses nor reorders them. Minimum and maximum are written as
//! comparisons, because the IEEE operations leave the sign of a zero open. Tangents and
//! powers are made of these, too.

mod float;
mod sqrt;
mod vector;

pub use vector::{Axis, Vector};

use bytemuck::Pod;
use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Whether processors of this kind compute four numbers at a time and pay dearly for branches they
/// did not foresee. Where they do not, it pays to leave a test early; answers are the same.
pub(crate) const FOURS: bool = cfg!(any(
    target_arch = "x86_64",
    target_arch = "x86",
    target_arch = "aarch64",
    target_feature = "simd128"
));

/// Three numbers of type `R`: a point, a direction or a colour.
pub type Vec3<R> = <R as Real>::Vec3;

/// Sums of products of two numbers; see [`Real::Wide`].
pub trait Wide:
    Copy + Debug + Default + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self>
{
}

impl<T> Wide for T where
    T: Copy + Debug + Default + PartialOrd + Add<Output = T> + Sub<Output = T> + Neg<Output = T>
{
}

/// A number that rays are traced in.
///
/// Comparisons with a value that is not a number are false, and every test of the core is written
/// so that *false* means *no hit*.
pub trait Real:
    Pod
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Sums of products of two numbers.
    type Wide: Wide;
    /// Three numbers.
    type Vec3: Vector<Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// 1/2.
    const HALF: Self;
    /// π, rounded.
    const PI: Self;
    /// The distance from 1 to the next greater number.
    const EPSILON: Self;
    /// The greatest number that is a distance.
    const MAX: Self;
    /// Beyond every distance: the far end of a ray that has none.
    const INFINITY: Self;

    /// The nearest number of this type.
    fn from_f64(x: f64) -> Self;
    /// The value as `f64`, exact for all types up to 64 bits of float and 32 of fixed point.
    fn to_f64(self) -> f64;
    /// A small whole number, exact up to 2^24.
    fn from_i32(i: i32) -> Self;
    /// Rounds towards 0; out of range gives the nearest end, not-a-number gives 0.
    fn to_i32(self) -> i32;
    /// Rounds down; out of range and not-a-number as [`Real::to_i32`].
    fn floor_to_i32(self) -> i32 {
        let towards_zero = self.to_i32();
        if Self::from_i32(towards_zero) > self {
            towards_zero.wrapping_sub(1)
        } else {
            towards_zero
        }
    }
    /// Neither infinite nor not-a-number.
    fn is_finite(self) -> bool;
    /// The square root, correctly rounded; of a negative number: not-a-number, or 0 where the
    /// type has none.
    fn sqrt(self) -> Self;
    /// The next greater number.
    fn next_up(self) -> Self;
    /// The next smaller number.
    fn next_down(self) -> Self;
    /// The power of two that brings `self > 0` into [1, 2) when multiplied with it, or as near as
    /// factors go at the ends of the range; the factor and its inverse, both exact.
    fn scale_to_one(self) -> (Self, Self);

    /// The product of two numbers, in full.
    fn times(self, rhs: Self) -> Self::Wide;
    /// Rounds a sum of products back to a number.
    fn narrow(w: Self::Wide) -> Self;
    /// The square root of a sum of products.
    fn sqrt_wide(w: Self::Wide) -> Self;
    /// The ratio of two sums of products.
    fn ratio(numerator: Self::Wide, denominator: Self::Wide) -> Self;
    /// `(w[0] z[0] + w[1] z[1] + w[2] z[2]) / (w[0] + w[1] + w[2])`; the sum is not 0.
    fn mean(weights: [Self::Wide; 3], z: [Self; 3]) -> Self;
    /// √(b² − a c), or `None` where that is negative: the root in both solutions of
    /// a t² − 2 b t + c = 0. Without cancellation between the two products.
    fn root(a: Self::Wide, b: Self::Wide, c: Self::Wide) -> Option<Self::Wide>;

    /// The absolute value.
    fn abs(self) -> Self;
    /// The smaller one; `self` when they are equal, `other` when either is not a number.
    fn min(self, other: Self) -> Self {
        if self <= other { self } else { other }
    }
    /// The greater one; `self` when they are equal, `other` when either is not a number.
    fn max(self, other: Self) -> Self {
        if self >= other { self } else { other }
    }
    /// `self` brought into `lo..=hi`; `lo` when it is not a number.
    fn clamp(self, lo: Self, hi: Self) -> Self {
        if self > hi {
            hi
        } else if self >= lo {
            self
        } else {
            lo
        }
    }
    /// The tangent of an angle in radians, 0 to less than π/2: what cameras need. Lambert's continued
    /// fraction (1761), cut where an angle of π/4 is exact to the last place or two of a double;
    /// `libm`'s takes 2 KiB more, for angles of any size.
    fn tan(self) -> Self {
        let right_angle = Self::PI * Self::HALF;
        let steep = self > right_angle * Self::HALF;
        let x = if steep { right_angle - self } else { self };
        let squared = x * x;
        let (mut divisor, mut odd) = (Self::from_i32(17), 17);
        while odd > 1 {
            odd -= 2;
            divisor = Self::from_i32(odd) - squared / divisor;
        }
        if steep { divisor / x } else { x / divisor }
    }
    /// `self` to the power `exponent >= 0`, for `self` in 0 to 1: what highlights need. Whole powers
    /// by squaring, the rest of the exponent by square roots, down to 1/1024, so that the result is
    /// off by less than 1/2700; only operations that give the same bits everywhere.
    fn powf(self, exponent: Self) -> Self {
        let whole = exponent.floor_to_i32();
        let mut power = Self::ONE;
        let (mut square, mut digits) = (self, whole);
        while digits > 0 {
            if digits & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            digits >>= 1;
        }
        let (mut root, mut rest) = (self, exponent - Self::from_i32(whole));
        for _ in 0..10 {
            if !(rest > Self::ZERO) {
                break;
            }
            root = root.sqrt();
            rest = rest + rest;
            if rest >= Self::ONE {
                power = power * root;
                rest = rest - Self::ONE;
            }
        }
        power
    }
    /// `n` units in the last place of 1.
    fn ulps(n: i32) -> Self {
        Self::EPSILON * Self::from_i32(n)
    }
}
