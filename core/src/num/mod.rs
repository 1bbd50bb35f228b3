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
//! Besides these, what would not fit a fixed-point `R` has a type of its own: reciprocals
//! ([`Reciprocal`]), walls of a lattice along a ray ([`Progress`]), cosine powers
//! ([`Real::Exponent`]) and places of lights ([`Real::FarPoint`]).
//!
//! # What keeps the bits equal on every target
//! Only `+ - * /`, comparisons, conversions and the correctly rounded square root touch a number on
//! the way of a ray. Rust neither fuses nor reorders them. Minimum and maximum are written as
//! comparisons, because the IEEE operations leave the sign of a zero open. Tangents and
//! powers are made of these, too.

pub mod fixed;
mod float;
mod linear;
mod sqrt;
mod vector;

pub use fixed::Fixed;
pub use float::FloatProgress;
pub use linear::{Cells, Halves, Progress, Reciprocal};
pub use vector::{Axis, Vector};

use crate::scene::Material;
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
    /// A cosine power, usually 1 to some hundreds.
    type Exponent: Copy + Debug + PartialEq + Send + Sync;
    /// A point that may be far outside the scene.
    type FarPoint: Copy + Debug + PartialEq + Send + Sync;
    /// 1 / d for a component of a direction.
    type Reciprocal: Reciprocal<Self>;
    /// How far a ray moves across an axis while it moves along it by 1; at most 1.
    type Slope: Copy + Debug + Default + Send + Sync;
    /// What tells quickly whether a ray passes by a sphere, if anything does.
    type Course: Copy + Debug + Default + Send + Sync;
    /// An extent divided into equal cells.
    type Cells: Cells<Self>;
    /// Walls at equal distances along a ray.
    type Progress: Progress<Self, Reciprocal = Self::Reciprocal, Cells = Self::Cells>;

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
    /// The power that changes nothing, 1.
    const NO_POWER: Self::Exponent;
    /// The surface of what has none, a matt white. Here, because a constant of a generic type cannot be
    /// borrowed for ever, and in each scene it would take 48 bytes.
    const UNPAINTED: &'static Material<Self>;
    /// Whether sums of products are exact, so that differences of them lose nothing.
    const EXACT: bool = false;
    /// Slack of a ray ([`Ray::slack`](crate::geom::Ray::slack)) in units of the last place of its
    /// scene's size: half of what boxes are padded by.
    const SLACK: i32 = 32;
    /// Bound of a hit point's error, in units of the last place of the coordinates involved: t, its
    /// product with the direction and the sum each add up to half a unit, a shape's own test up to
    /// two; doubled.
    const POINT_ERROR: i32 = 8;

    /// The nearest number of this type.
    fn from_f64(x: f64) -> Self;
    /// The value as `f64`, exact for all types up to 64 bits of float and 32 of fixed point.
    fn to_f64(self) -> f64;
    /// A whole number from -7 to 7; floats take more, exact up to 2^24.
    fn from_i32(i: i32) -> Self;
    /// The nearest number to `a / b`, for `b > 0`.
    fn fraction(a: i32, b: i32) -> Self;
    /// `self` times a whole number.
    fn times_int(self, n: i32) -> Self;
    /// The whole number below `self / divisor`; out of range the nearest end, not-a-number gives 0.
    fn floor_ratio(self, divisor: Self) -> i32;
    /// `self / whole` in parts of `n`, rounded towards 0.
    fn proportion(self, whole: Self, n: i32) -> i32;
    /// 0 to 1 as 0 to 255, rounded; beyond it the nearest end, not-a-number gives 0.
    fn to_byte(self) -> u8;
    /// Neither infinite nor not-a-number.
    fn is_finite(self) -> bool;
    /// The square root, correctly rounded; of a negative number: not-a-number, or 0 where the
    /// type has none.
    fn sqrt(self) -> Self;
    /// The next greater number.
    fn next_up(self) -> Self;
    /// The next smaller number.
    fn next_down(self) -> Self;
    /// The exponent of the power of two that brings `self > 0` into [1, 2) when multiplied with it,
    /// or as near as factors go at the ends of the range.
    fn exponent_to_one(self) -> i32;
    /// `self` times 2 to the power `exponent`, which is one of [`Real::exponent_to_one`] or its
    /// opposite.
    fn ldexp(self, exponent: i32) -> Self;

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
    /// The nearest cosine power.
    fn exponent(x: f64) -> Self::Exponent;
    /// Whether it is one: finite and not negative.
    fn is_power(exponent: Self::Exponent) -> bool;
    /// `self` to a power, for `self` in 0 to 1: what highlights need. Off by less than 1/2700.
    fn powf(self, exponent: Self::Exponent) -> Self;

    /// What [`Real::passes`] wants to know of a ray: from its direction, of length 1, and the greatest
    /// coordinate of its origin.
    fn course(unit: Self::Vec3, reach: Self) -> Self::Course;
    /// Whether a line surely passes by a sphere: what is quicker to tell than where it meets it.
    /// `towards` is the way from the ray's origin to the centre.
    #[inline(always)]
    fn passes(_towards: Self::Vec3, _course: &Self::Course, _radius: Self) -> bool {
        false
    }
    /// For a sphere of that radius, the parameter of a ray's point nearest to its centre, and from
    /// there to where the ray meets the sphere; `None` where it passes by. `towards` is the way from
    /// the ray's origin to the centre; `inverse` and `inverse_squared` are those of the direction's
    /// length. It may be `None` as well where the ray meets the sphere at no parameter beyond `min`.
    #[inline(always)]
    fn chord(
        towards: Self::Vec3,
        direction: Self::Vec3,
        [inverse, inverse_squared]: [Self; 2],
        radius: Self,
        _min: Self,
    ) -> Option<(Self, Self)> {
        let middle = Self::narrow(towards.dot(direction)) * inverse_squared;
        let across = towards - direction * middle;
        let left = radius.times(radius) - across.dot(across);
        (left >= Self::Wide::default()).then(|| (middle, Self::sqrt_wide(left) * inverse))
    }

    /// Rays that start farther from the middle are moved nearer to a scene with coordinates up to
    /// `scale` first.
    fn far(scale: Self) -> Self {
        scale.times_int(4)
    }
    /// `origin + direction * t`.
    fn at(origin: Self::Vec3, direction: Self::Vec3, t: Self) -> Self::Vec3 {
        origin + direction * t
    }
    /// The same for an origin up to `reach` and the direction of a ray; of any direction where `reach` is
    /// [`Real::INFINITY`].
    #[inline(always)]
    fn along(origin: Self::Vec3, direction: Self::Vec3, t: Self, _reach: Self) -> Self::Vec3 {
        Self::at(origin, direction, t)
    }
    /// A place `error` beside a point with coordinates up to `reach - error`, along a vector of length 1.
    #[inline(always)]
    fn beside(point: Self::Vec3, unit: Self::Vec3, error: Self, _reach: Self) -> Self::Vec3 {
        Self::at(point, unit, error)
    }
    /// `across / along` of two components of a direction, of which `along` is the greatest, and
    /// `1 / along`.
    fn slopes(across: [Self; 2], along: Self) -> ([Self::Slope; 2], Self);
    /// `x - slope * z`, for places in the scene as a ray sees them.
    fn sheared(x: Self, slope: Self::Slope, z: Self) -> Self;
    /// The difference of two places in the scene or of rays that are not far from it.
    #[inline(always)]
    fn way(self, from: Self) -> Self {
        self - from
    }

    /// Whether coordinates up to `reach` can be computed with: tests of shapes form products of
    /// three lengths, each up to the distance from which rays are shot.
    fn is_workable(reach: Self) -> bool;
    /// The same for components of a vector of which only the direction counts.
    fn is_workable_normal(reach: Self) -> bool {
        Self::is_workable(reach)
    }
    /// Whether directions with that squared length need no scaling.
    fn is_ordinary(squared: Self) -> bool;
    /// The exponent of the power of two that makes a direction ordinary.
    fn direction_exponent(direction: Self::Vec3) -> i32;
    /// Whether a sum of products is finite.
    fn is_finite_wide(_w: Self::Wide) -> bool {
        true
    }
    /// Whether 1 / `squared` can be computed with, for a sum of squares.
    fn is_divisor(squared: Self::Wide) -> bool {
        squared > Self::Wide::default()
    }

    /// The nearest far point.
    fn far_point(position: [f64; 3]) -> Self::FarPoint;
    /// Whether it can be computed with.
    fn is_usable_far(far: Self::FarPoint) -> bool;
    /// The way to a far point, or a power of two of it.
    fn towards(from: Self::Vec3, far: Self::FarPoint) -> Self::Vec3;
    /// The distance for the length of what [`Real::towards`] gives.
    fn distance_to(far: Self::FarPoint, towards: Self) -> Self;
    /// `n` units in the last place of 1.
    fn ulps(n: i32) -> Self {
        Self::EPSILON.times_int(n)
    }
    /// `n` units in the last place of numbers of that magnitude; of a fixed-point type all numbers
    /// have the same.
    fn ulps_at(n: i32, magnitude: Self) -> Self;
}

/// `base`, 0 to 1, to the power `whole + rest / 1024`. Whole powers by squaring, the rest by square
/// roots: only operations that give the same bits everywhere.
fn power<R: Real>(base: R, whole: u32, rest: u32) -> R {
    let mut power = R::ONE;
    let (mut square, mut digits) = (base, whole);
    while digits > 0 {
        if digits & 1 == 1 {
            power = power * square;
        }
        square = square * square;
        digits >>= 1;
    }
    let (mut root, mut rest) = (base, rest & 1023);
    while rest > 0 {
        root = root.sqrt();
        rest <<= 1;
        if rest & 1024 != 0 {
            power = power * root;
        }
        rest &= 1023;
    }
    power
}
