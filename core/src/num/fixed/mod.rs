//! Fixed point: numbers of 32 bits, sums of products of 64.
//!
//! J. Hanika, A. Keller, "Towards hardware ray tracing using fixed point arithmetic", IEEE
//! Symposium on Interactive Ray Tracing (2007): where coordinates are fractions of the scene's box,
//! fixed point is exact where floats of as many bits waste theirs on the exponent. Every operation
//! is one of whole numbers, so its bits are the same everywhere, and a processor without a floating
//! point unit does it in a few instructions.
//!
//! # Formats
//! | quantity | format | range | step |
//! |---|---|---|---|
//! | coordinate, length, ray parameter, direction, colour | I4F28 | ±8 | 2^-28 |
//! | sum of products ([`Real::Wide`]) | I8F56 | ±128 | 2^-56, exact |
//! | reciprocal of a direction | 31 bits and an exponent | 2^-1 to 2^28 | 2^-31 of its value |
//! | slope of a ray | 31 bits after the point | ±1 | 2^-31 |
//! | wall of a lattice, as a ray parameter | 64 bits and an exponent | all of them | 2^-30 of a step of the coordinates |
//! | wall of a cell that is halved | 32 bits and an exponent | those near a ray | 2^-28 or 2^-27 along the axis |
//! | cosine power ([`Exponent`]) | U22F10 | 0 to 4 million | 2^-10 |
//! | place of a light ([`FarPoint`]) | three I4F28 and an exponent | 2^30 | 2^-28 of its distance |
//!
//! One step of a coordinate is 2^-28: 8 times finer than that of an `f32` between 1/4 and 1/2.
//!
//! # Why nothing overflows
//! A scene is **normalised** when it is made: its coordinates are at most 1/2
//! ([`Real::is_workable`]; shapes beyond are refused with
//! [`ShapeError::NotFinite`](crate::shape::ShapeError::NotFinite)). Rays start at most 2 away from
//! the middle along every axis (those from farther are moved: [`Real::far`]) and have directions
//! with squares from 3/4 to 3 ([`Real::is_ordinary`]; others are scaled by a power of two). From
//! there to any point of the scene it is 2.5 along an axis and 4.4 in all; a ray parameter is at
//! most 5.1, a product of a way and a direction at most 7.5, a sum of three products of ways at most
//! 19. All of this is in range. What may still leave it (a plane that a ray meets far outside, a
//! division by next to nothing) **saturates**: sums, products, quotients and conversions give
//! [`Real::INFINITY`] or its opposite, which are no numbers ([`Real::is_finite`]) and so no hits.
//! A division by zero does, too. Sums of products cannot saturate and need not. Where the range is
//! known no end of it is looked for: points of rays that start within 2 and go on for less than 2, with
//! directions below 2 along an axis, are within 6; what is [beside](Real::beside) a point keeps to the
//! range that its `reach` tells.
//!
//! # Short products
//! ARMv6-M multiplies 32 by 32 bits into 32 only, and neither it nor RV32IMC counts leading zeros. What
//! is computed otherwise there (`whole.rs`) gives the same bits; where a sphere is told to be
//! [passed by](Real::passes) in fewer digits, what is not sure is computed in full.

mod chord;
mod linear;
mod vector;
mod whole;

pub use chord::Course;
pub use linear::{Cells, Halves, Progress, Reciprocal, Slope};
pub use vector::{FarPoint, Vec3};

use crate::num::{self, Real, Vector};
use crate::scene::Material;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
use fixed::types::{I4F28, I8F56, U22F10};
use whole::{nearest_root, product, quotient, shifted, whole_power};

/// Bits after the point.
const DIGITS: u32 = 28;

/// A number from -8 to 8 in steps of 2^-28; 4 bytes.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Fixed(I4F28);

// A transparent wrapper around what is plain old data is plain old data; the compiler cannot see it.
#[allow(unsafe_code)]
mod plain {
    unsafe impl bytemuck::Zeroable for super::Fixed {}
    unsafe impl bytemuck::Pod for super::Fixed {}
}

/// A cosine power; see [`Real::Exponent`].
pub type Exponent = U22F10;

impl Fixed {
    /// From the number of steps of 2^-28.
    pub const fn from_bits(bits: i32) -> Self {
        Self(I4F28::from_bits(bits))
    }

    /// The number of steps of 2^-28.
    pub const fn to_bits(self) -> i32 {
        self.0.to_bits()
    }

    /// The nearest number; ±[`Real::INFINITY`] out of range and for what is not a number. For
    /// constants, too.
    pub const fn new(x: f64) -> Self {
        if x.is_nan() {
            return Self::from_bits(i32::MAX);
        }
        let steps = x * (1_u64 << DIGITS) as f64;
        // Casts cut off and saturate.
        let nearest = if steps < 0.0 { steps - 0.5 } else { steps + 0.5 } as i64;
        Self::saturated(nearest)
    }

    /// From steps of 2^-28; beyond the range the nearer infinity.
    const fn saturated(steps: i64) -> Self {
        if steps > i32::MAX as i64 {
            Self::from_bits(i32::MAX)
        } else if steps < -(i32::MAX as i64) {
            Self::from_bits(-i32::MAX)
        } else {
            Self::from_bits(steps as i32)
        }
    }

    /// Rounds away `digits` binary digits, 1 to 31, of a number of steps.
    #[inline]
    const fn rounded(steps: i64, digits: u32) -> Self {
        Self::from_bits(shifted(steps + (1 << (digits - 1)), digits))
    }

    #[inline]
    fn signed(negative: bool, steps: u32) -> Self {
        let steps = steps.min(i32::MAX as u32) as i32;
        Self::from_bits(if negative { -steps } else { steps })
    }
}

impl fmt::Debug for Fixed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.to_f64(), f)
    }
}

impl Add for Fixed {
    type Output = Self;
    #[inline]
    fn add(self, rhs: Self) -> Self {
        Self(self.0.saturating_add(rhs.0))
    }
}

impl Sub for Fixed {
    type Output = Self;
    #[inline]
    fn sub(self, rhs: Self) -> Self {
        Self(self.0.saturating_sub(rhs.0))
    }
}

impl Neg for Fixed {
    type Output = Self;
    /// The bits that are neither a number nor an infinity stay as they are.
    #[inline]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl Mul for Fixed {
    type Output = Self;
    /// Rounded to the nearest.
    #[inline]
    fn mul(self, rhs: Self) -> Self {
        Self::narrow(self.times(rhs))
    }
}

impl Div for Fixed {
    type Output = Self;
    /// Rounded to the nearest, halves away from 0, whatever the signs.
    fn div(self, rhs: Self) -> Self {
        let (n, d) = (u64::from(self.0.to_bits().unsigned_abs()), rhs.0.to_bits().unsigned_abs());
        let negative = (self.to_bits() < 0) != (rhs.to_bits() < 0);
        Self::signed(negative, quotient((n << DIGITS) + u64::from(d / 2), d))
    }
}

impl Real for Fixed {
    type Wide = I8F56;
    type Vec3 = Vec3;
    type Exponent = Exponent;
    type FarPoint = FarPoint;
    type Reciprocal = Reciprocal;
    type Cells = Cells;
    type Progress = Progress;
    type Slope = Slope;
    type Course = Course;

    const ZERO: Self = Self::from_bits(0);
    const ONE: Self = Self::from_bits(1 << DIGITS);
    const HALF: Self = Self::from_bits(1 << (DIGITS - 1));
    const PI: Self = Self::new(core::f64::consts::PI);
    const EPSILON: Self = Self::from_bits(1);
    const MAX: Self = Self::from_bits(i32::MAX - 1);
    const INFINITY: Self = Self::from_bits(i32::MAX);
    const NO_POWER: Exponent = Exponent::ONE;
    const UNPAINTED: &'static Material<Self> =
        &Material::matt(Vec3::new(Self::ONE, Self::ONE, Self::ONE));
    const EXACT: bool = true;
    /// Twice that of floats: an error in a round shape is one of steps, however small the shape.
    const SLACK: i32 = 64;
    const POINT_ERROR: i32 = 16;

    fn from_f64(x: f64) -> Self {
        Self::new(x)
    }
    fn to_f64(self) -> f64 {
        f64::from(self.to_bits()) / (1_u64 << DIGITS) as f64
    }
    fn from_i32(i: i32) -> Self {
        Self::saturated(i64::from(i) << DIGITS)
    }
    fn fraction(a: i32, b: i32) -> Self {
        let (n, d) = (a.unsigned_abs(), b.unsigned_abs());
        let negative = (a < 0) != (b < 0);
        // Half of the digits at a time: two divisions of 32 bits.
        const HALF: u32 = DIGITS / 2;
        if n <= d
            && d >> 16 == 0
            && let (Some(upper), Some(rest)) =
                ((n << HALF).checked_div(d), (n << HALF).checked_rem(d))
            && let Some(lower) = ((rest << HALF) + d / 2).checked_div(d)
        {
            // At most 1.
            let steps = ((upper << HALF) + lower) as i32;
            return Self::from_bits(if negative { -steps } else { steps });
        }
        Self::signed(negative, quotient((u64::from(n) << DIGITS) + u64::from(d / 2), d))
    }
    fn times_int(self, n: i32) -> Self {
        Self::saturated(i64::from(self.to_bits()) * i64::from(n))
    }
    fn floor_ratio(self, divisor: Self) -> i32 {
        let (n, d) = (self.to_bits(), divisor.to_bits());
        if d > 0 {
            return n.div_euclid(d);
        }
        let (Some(cut), Some(rest)) = (n.checked_div(d), n.checked_rem(d)) else { return i32::MAX };
        cut - i32::from(rest != 0 && (rest < 0) != (d < 0))
    }
    fn proportion(self, whole: Self, n: i32) -> i32 {
        let product = i64::from(self.to_bits()) * i64::from(n);
        product.checked_div(i64::from(whole.to_bits())).unwrap_or(0) as i32
    }
    fn to_byte(self) -> u8 {
        // 255/256 of it: of 32 bits, other than times 255. Halves of a step of 8 bits are told to 2^-28.
        let steps = self.to_bits().clamp(0, 1 << DIGITS);
        ((steps - (steps >> 8) + (1 << (DIGITS - 9))) >> (DIGITS - 8)) as u8
    }
    fn is_finite(self) -> bool {
        self.to_bits().unsigned_abs() < i32::MAX as u32
    }
    fn abs(self) -> Self {
        Self(self.0.saturating_abs())
    }
    fn sqrt(self) -> Self {
        Self::signed(false, nearest_root((self.to_bits().max(0) as u64) << DIGITS))
    }
    fn next_up(self) -> Self {
        Self::from_bits(self.to_bits().saturating_add(1))
    }
    fn next_down(self) -> Self {
        Self::from_bits(self.to_bits().saturating_sub(1).max(-i32::MAX))
    }
    fn exponent_to_one(self) -> i32 {
        self.to_bits().unsigned_abs().leading_zeros() as i32 - 3
    }
    fn ldexp(self, exponent: i32) -> Self {
        let steps = i64::from(self.to_bits());
        if exponent >= 0 {
            Self::saturated(steps << exponent.min(31))
        } else {
            Self::rounded(steps, exponent.unsigned_abs().min(31))
        }
    }

    fn times(self, rhs: Self) -> I8F56 {
        I8F56::from_bits(product(self.to_bits(), rhs.to_bits()))
    }
    #[inline]
    fn narrow(w: I8F56) -> Self {
        Self::rounded(w.to_bits(), DIGITS)
    }
    fn sqrt_wide(w: I8F56) -> Self {
        Self::signed(false, nearest_root(w.to_bits().max(0) as u64))
    }
    /// Within 2^-30 of the value of the nearest.
    #[inline(never)]
    fn ratio(numerator: I8F56, denominator: I8F56) -> Self {
        let negative = (numerator.to_bits() ^ denominator.to_bits()) < 0;
        let (n, d) = (numerator.to_bits().unsigned_abs(), denominator.to_bits().unsigned_abs());
        Self::signed(negative, whole::ratio(n, d))
    }
    /// Within 2^-28 of the greatest `z` of the exact one.
    fn mean(weights: [I8F56; 3], z: [Self; 3]) -> Self {
        let steps = weights.map(|w| w.to_bits().unsigned_abs());
        let [a, b, c] = steps;
        // To 30 bits, so that three of them are 32 and sums of products are 63.
        let digits = 34_u32.saturating_sub((a | b | c).leading_zeros());
        let [a, b, c] = steps.map(|w| (w >> digits) as u32);
        let [x, y, w] = z.map(|z| i64::from(z.to_bits()));
        let sum = x * i64::from(a) + y * i64::from(b) + w * i64::from(c);
        let all = a.wrapping_add(b).wrapping_add(c);
        Self::signed(sum < 0, quotient(sum.unsigned_abs() + u64::from(all / 2), all))
    }
    /// The discriminant is exact.
    fn root(a: I8F56, b: I8F56, c: I8F56) -> Option<I8F56> {
        let [a, b, c] = [a, b, c].map(|x| i128::from(x.to_bits()));
        let discriminant = b * b - a * c;
        let root = u128::try_from(discriminant).ok()?.isqrt();
        Some(I8F56::from_bits(i64::try_from(root).unwrap_or(i64::MAX)))
    }

    /// [`Real::tan`]'s continued fraction with 32 digits after the point.
    fn tan(self) -> Self {
        const ONE: u64 = 1 << 32;
        let right_angle = Self::PI * Self::HALF;
        let steep = self > right_angle * Self::HALF;
        let x = if steep { right_angle - self } else { self };
        let x = (x.to_bits().max(0) as u64) << (32 - DIGITS);
        let squared = ((x * x) >> 32) << 32; // times 2^64, less than 0.62 of it
        let (mut divisor, mut odd) = (17 * ONE, 17);
        while odd > 1 {
            odd -= 2;
            divisor = odd * ONE - squared.checked_div(divisor).unwrap_or(0);
        }
        let (n, d) = if steep { (divisor, x) } else { (x, divisor) };
        let nearest = ((n << DIGITS) + d / 2).checked_div(d).unwrap_or(u64::MAX);
        Self::signed(false, nearest.min(u32::MAX.into()) as u32)
    }
    fn exponent(x: f64) -> Exponent {
        Exponent::from_bits((x * 1024.0) as u32)
    }
    fn is_power(_exponent: Exponent) -> bool {
        true
    }
    fn powf(self, exponent: Exponent) -> Self {
        let (whole, rest) = (exponent.to_bits() >> 10, exponent.to_bits() & 1023);
        let power = whole_power(self.to_bits().clamp(0, 1 << DIGITS) as u32, whole);
        let power = Self::from_bits(power as i32);
        if rest == 0 { power } else { power * super::power(self, 0, rest) }
    }

    fn ulps_at(n: i32, _magnitude: Self) -> Self {
        Self::ulps(n)
    }
    #[inline(always)]
    fn course(unit: Vec3, reach: Self) -> Course {
        Course::new(unit, reach)
    }
    #[inline(always)]
    fn passes(towards: Vec3, course: &Course, radius: Self) -> bool {
        course.passes(towards, radius)
    }
    #[inline(always)]
    fn chord(
        towards: Vec3,
        direction: Vec3,
        [_, inverse_squared]: [Self; 2],
        radius: Self,
        min: Self,
    ) -> Option<(Self, Self)> {
        let [x, y, z] = towards.to_array().map(Self::to_bits);
        chord::chord(x, y, z, direction, inverse_squared, radius, min)
    }
    /// Errors do not grow with the distance: as far as the range goes.
    fn far(_scale: Self) -> Self {
        Self::from_i32(2)
    }
    #[inline]
    fn at(origin: Vec3, direction: Vec3, t: Self) -> Vec3 {
        origin.at(direction, t)
    }
    #[inline(always)]
    fn along(origin: Vec3, direction: Vec3, t: Self, reach: Self) -> Vec3 {
        origin.along_ray(direction, t, reach)
    }
    #[inline(always)]
    fn beside(point: Vec3, unit: Vec3, error: Self, reach: Self) -> Vec3 {
        point.beside(unit, error, reach)
    }
    fn slopes(across: [Self; 2], along: Self) -> ([Slope; 2], Self) {
        let reciprocal = Reciprocal::of(along);
        let scale = num::Reciprocal::times(reciprocal, Self::ONE);
        (across.map(|x| reciprocal.slope(x)), scale)
    }
    /// Less than a step above the exact one.
    #[inline(always)]
    fn sheared(x: Self, slope: Slope, z: Self) -> Self {
        Self::from_bits(x.to_bits().wrapping_sub(slope.times(z)))
    }
    #[inline(always)]
    fn way(self, from: Self) -> Self {
        Self(self.0 - from.0)
    }
    fn is_workable(reach: Self) -> bool {
        reach <= Self::HALF
    }
    fn is_workable_normal(reach: Self) -> bool {
        reach <= Self::from_i32(4)
    }
    /// Directions across an axis of less than 8 steps are none: over the whole way they come by 40.
    fn is_divisor(squared: I8F56) -> bool {
        squared.to_bits() > 64
    }
    fn is_ordinary(squared: Self) -> bool {
        let quarters = |n| Self::fraction(n, 4);
        squared >= quarters(3) && squared < quarters(12)
    }
    /// Brings the square into 3/4 to 3.
    fn direction_exponent(direction: Vec3) -> i32 {
        let exponent = direction.max_abs().exponent_to_one() - 1;
        let scaled = direction.map(|x| x.ldexp(exponent));
        let short = Self::narrow(scaled.dot(scaled)) < Self::fraction(3, 4);
        exponent + i32::from(short)
    }
    fn far_point(position: [f64; 3]) -> FarPoint {
        FarPoint::new(position)
    }
    fn is_usable_far(far: FarPoint) -> bool {
        far.is_usable()
    }
    fn towards(from: Vec3, far: FarPoint) -> Vec3 {
        far.seen_from(from)
    }
    fn distance_to(far: FarPoint, towards: Self) -> Self {
        match far.exponent() {
            0 => towards,
            exponent => towards.ldexp(exponent),
        }
    }
}

#[cfg(test)]
mod tests;
