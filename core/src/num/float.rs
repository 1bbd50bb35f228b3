//! `f32` and `f64` as [`Real`]. `f64` is the reference on the host.

use super::{Cells, Halves, Progress, Real, Reciprocal, Vector, power, sqrt};
use crate::scene::Material;

macro_rules! float {
    ($f:ident, $vec3:ty, $bits:ident, $mantissa:expr, $sqrt:path) => {
        impl Real for $f {
            type Wide = Self;
            type Vec3 = $vec3;
            type Exponent = Self;
            type FarPoint = $vec3;
            type Reciprocal = Self;
            type Cells = FloatCells<Self>;
            type Progress = FloatProgress<Self>;
            type Slope = Self;
            type Course = ();

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const PI: Self = core::$f::consts::PI;
            const EPSILON: Self = $f::EPSILON;
            const MAX: Self = $f::MAX;
            const INFINITY: Self = $f::INFINITY;
            const NO_POWER: Self = 1.0;
            const UNPAINTED: &'static Material<Self> = &Material::matt(<$vec3>::ONE);

            fn from_f64(x: f64) -> Self {
                x as Self
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn from_i32(i: i32) -> Self {
                i as Self
            }
            fn fraction(a: i32, b: i32) -> Self {
                a as Self / b as Self
            }
            fn times_int(self, n: i32) -> Self {
                self * n as Self
            }
            fn floor_ratio(self, divisor: Self) -> i32 {
                let ratio = self / divisor;
                let towards_zero = ratio as i32;
                if towards_zero as Self > ratio {
                    towards_zero.wrapping_sub(1)
                } else {
                    towards_zero
                }
            }
            fn proportion(self, whole: Self, n: i32) -> i32 {
                (self / whole * n as Self) as i32
            }
            fn course(_unit: Self::Vec3, _reach: Self) {}
            fn slopes([u, v]: [Self; 2], along: Self) -> ([Self; 2], Self) {
                ([u / along, v / along], 1.0 / along)
            }
            #[inline(always)]
            fn sheared(x: Self, slope: Self, z: Self) -> Self {
                x - slope * z
            }
            fn to_byte(self) -> u8 {
                ((self * 255.0 + 0.5) as i32).clamp(0, 255) as u8
            }
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            fn abs(self) -> Self {
                self.abs()
            }
            fn next_up(self) -> Self {
                self.next_up()
            }
            fn next_down(self) -> Self {
                self.next_down()
            }
            fn exponent_to_one(self) -> i32 {
                // Clamped so that the factor and its inverse stay normal numbers.
                const BIAS: i32 = $f::MAX_EXP - 1;
                BIAS - ((self.to_bits() >> $mantissa) as i32).clamp(1, 2 * BIAS - 1)
            }
            fn ldexp(self, exponent: i32) -> Self {
                let e = ($f::MAX_EXP - 1 + exponent) as $bits;
                self * Self::from_bits(e << $mantissa)
            }

            fn times(self, rhs: Self) -> Self {
                self * rhs
            }
            fn narrow(w: Self) -> Self {
                w
            }
            fn sqrt_wide(w: Self) -> Self {
                $sqrt(w)
            }
            fn ratio(numerator: Self, denominator: Self) -> Self {
                numerator / denominator
            }
            fn mean(w: [Self; 3], z: [Self; 3]) -> Self {
                let ([u, v, w], [a, b, c]) = (w, z);
                (u * a + v * b + w * c) / (u + v + w)
            }
            fn root(a: Self, b: Self, c: Self) -> Option<Self> {
                let (bb, bb_low) = two_product::$f(b, b);
                let (ac, ac_low) = two_product::$f(a, c);
                let d = (bb - ac) + (bb_low - ac_low);
                (d >= 0.0).then(|| $sqrt(d))
            }
            fn exponent(x: f64) -> Self {
                x as Self
            }
            fn is_power(exponent: Self) -> bool {
                exponent.is_finite() && exponent >= 0.0
            }
            /// Of the exponent's rest, ten binary digits count.
            fn powf(self, exponent: Self) -> Self {
                let whole = exponent as u32;
                power(self, whole, ((exponent - whole as Self) * 1024.0) as u32)
            }

            fn is_workable(reach: Self) -> bool {
                let reach = reach * 16.0;
                (reach * reach * reach).is_finite()
            }
            fn is_ordinary(squared: Self) -> bool {
                // Directions 16 times longer or shorter than 1 have to be scaled first.
                squared <= 256.0 && squared * 256.0 >= 1.0
            }
            fn direction_exponent(direction: $vec3) -> i32 {
                direction.max_abs().exponent_to_one()
            }
            fn is_finite_wide(w: Self) -> bool {
                w.is_finite()
            }
            fn is_divisor(squared: Self) -> bool {
                (1.0 / squared).is_finite()
            }

            fn far_point(position: [f64; 3]) -> $vec3 {
                Vector::from_f64(position)
            }
            fn is_usable_far(far: $vec3) -> bool {
                Vector::is_finite(far * 4.0)
            }
            fn towards(from: $vec3, far: $vec3) -> $vec3 {
                far - from
            }
            fn distance_to(_far: $vec3, towards: Self) -> Self {
                towards
            }
            fn ulps_at(n: i32, magnitude: Self) -> Self {
                Self::ulps(n) * magnitude
            }
        }

        impl Reciprocal<$f> for $f {
            fn of(d: Self) -> Self {
                let inverse = 1.0 / d;
                // Where the reciprocal overflows, the way along this axis is nothing.
                if inverse.is_finite() { inverse } else { 0.0 }
            }
            fn sign(self) -> i32 {
                i32::from(self > 0.0) - i32::from(self < 0.0)
            }
            fn times(self, x: Self) -> Self {
                x * self
            }
        }

        impl Cells<$f> for FloatCells<$f> {
            fn new(extent: $f, count: i32) -> Self {
                let n = count as $f;
                Self { width: extent / n, per_unit: if extent > 0.0 { n / extent } else { 0.0 } }
            }
            fn index(&self, x: $f) -> i32 {
                (x * self.per_unit) as i32
            }
            fn wall(&self, i: i32) -> $f {
                self.width * i as $f
            }
        }

        impl Progress<$f> for FloatProgress<$f> {
            type Reciprocal = $f;
            type Cells = FloatCells<$f>;
            /// To convert a whole number takes longer than to add 1.
            type Count = $f;
            type Halves = Self;

            fn new(inverse: $f, from: $f, cells: &FloatCells<$f>, count: i32) -> Option<Self> {
                let walls = Self { start: from * inverse, width: cells.width * inverse };
                (inverse.sign() != 0 && walls.at(count).is_finite()).then_some(walls)
            }
            #[inline(always)]
            fn of(direction: $f, from: $f, cells: &FloatCells<$f>, count: i32) -> Option<Self> {
                let inverse = 1.0 / direction;
                let walls = Self { start: from * inverse, width: cells.width * inverse };
                // Where the last overflows, the way along the axis is nothing: an infinite reciprocal
                // makes it so.
                walls.at(count).is_finite().then_some(walls)
            }
            fn steep(direction: $f, from: $f, cells: &FloatCells<$f>) -> Self {
                // A ray less inclined than that does not move along the axis: across the scene it
                // would come by less than a rounding error. So nothing is infinite, and where a ray
                // stays between two sides it enters and leaves them far beyond both ends of the scene.
                const STEEPEST: $f = 1.0 / ($f::EPSILON * $f::EPSILON);
                let inverse = 1.0 / direction;
                let inverse = if inverse < STEEPEST { inverse } else { STEEPEST };
                let inverse = if inverse > -STEEPEST { inverse } else { -STEEPEST };
                Self { start: from * inverse, width: cells.width * inverse }
            }
            fn falls(&self) -> bool {
                self.width < 0.0
            }
            fn never() -> Self {
                Self { start: $f::INFINITY, width: 0.0 }
            }
            #[inline(always)]
            fn at(&self, i: i32) -> $f {
                self.start + self.width * i as $f
            }
            #[inline(always)]
            fn along(&self, sign: i32) -> Self {
                Self { start: self.start, width: self.width * sign as $f }
            }
            #[inline(always)]
            fn count(i: i32) -> $f {
                i as $f
            }
            #[inline(always)]
            fn number(count: $f) -> i32 {
                count as i32
            }
            #[inline(always)]
            fn next(count: $f) -> $f {
                count + 1.0
            }
            #[inline(always)]
            fn at_count(&self, count: $f) -> $f {
                self.start + self.width * count
            }
            #[inline(always)]
            fn rebased(&self, origin: i32, shift: u8) -> Self {
                Self {
                    start: self.start + self.width * origin as $f,
                    width: self.width * power_of_two(shift) as $f,
                }
            }
            #[inline(always)]
            fn halves(&self, _falls: bool, _deepest: u32) -> (Self, $f) {
                (*self, 0.0)
            }
        }

        /// Every wall is computed from its number.
        impl Halves<$f> for FloatProgress<$f> {
            type Middle = $f;
            type Corner = i32;

            fn standing(cell: i32, _deepest: u32) -> (Self, $f) {
                const WIDTH: $f = $f::MAX / (1 << 21) as $f;
                (Self { start: -(WIDTH * (cell as $f + 0.5)), width: WIDTH }, 0.0)
            }
            #[inline(always)]
            fn corner(corner: i32, upper: bool, shift: u32) -> i32 {
                (corner >> shift >> 1 << 1 | i32::from(upper)) << shift
            }
            #[inline(always)]
            fn middle(
                &self,
                _above: $f,
                _passed: bool,
                corner: i32,
                level: u32,
                deepest: u32,
            ) -> $f {
                self.at(corner + (1 << deepest.saturating_sub(level + 1)))
            }
            #[inline(always)]
            fn between(
                &self,
                _first: $f,
                (enter, leave): ($f, $f),
                falls: bool,
                deepest: u32,
            ) -> Option<($f, $f)> {
                let last = self.at(1 << deepest);
                let (near, far) = if falls { (last, self.start) } else { (self.start, last) };
                Some((Real::max(enter, near), Real::min(leave, far)))
            }
            #[inline(always)]
            fn pass(&self, middle: $f, t: $f, exit: $f) -> (bool, $f) {
                (middle <= t, if middle > t && middle < exit { middle } else { exit })
            }
        }

        impl Vector<$f> for $vec3 {
            fn new(x: $f, y: $f, z: $f) -> Self {
                Self::new(x, y, z)
            }
            fn x(self) -> $f {
                self.x
            }
            fn y(self) -> $f {
                self.y
            }
            fn z(self) -> $f {
                self.z
            }
        }
    };
}

/// 2 to the power of 0 to 15, looked up: to shift and to convert takes longer.
#[inline(always)]
fn power_of_two(exponent: u8) -> f32 {
    static POWERS: [f32; 16] = [
        1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0, 4096.0, 8192.0,
        16384.0, 32768.0,
    ];
    POWERS.get(usize::from(exponent % 16)).copied().unwrap_or(1.0)
}

/// An extent divided into equal cells.
#[derive(Clone, Copy, Debug, Default)]
pub struct FloatCells<R> {
    width: R,
    /// Its reciprocal; 0 where there is no extent.
    per_unit: R,
}

/// Parameters at which a ray meets walls at equal distances.
#[derive(Clone, Copy, Debug, Default)]
pub struct FloatProgress<R> {
    /// The first, and what lies between two.
    start: R,
    width: R,
}

/// A product as rounded value and exact rest, without a fused multiply-add.
///
/// T. J. Dekker, "A floating-point technique for extending the available precision", Numerische
/// Mathematik 18 (1971). Where the splitting overflows the rest is not a number, so is the
/// discriminant, and there is no hit.
mod two_product {
    pub(super) fn f32(a: f32, b: f32) -> (f32, f32) {
        let product = a * b;
        // 24 + 24 bits fit the 53 of a double, so the rest is exact.
        let exact = f64::from(a) * f64::from(b);
        (product, (exact - f64::from(product)) as f32)
    }

    pub(super) fn f64(a: f64, b: f64) -> (f64, f64) {
        let split = |x: f64| {
            let c = 134_217_729.0 * x; // 2^27 + 1
            let high = c - (c - x);
            (high, x - high)
        };
        let product = a * b;
        let ((a1, a2), (b1, b2)) = (split(a), split(b));
        (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
    }
}

float!(f32, glam::Vec3, u32, 23, sqrt::sqrtf);
float!(f64, glam::DVec3, u64, 52, sqrt::sqrt);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_and_maximum_decide_zeros_and_nan() {
        assert!(Real::min(0.0_f32, -0.0).is_sign_positive());
        assert!(Real::min(-0.0_f32, 0.0).is_sign_negative());
        assert!(Real::max(-0.0_f32, 0.0).is_sign_negative());
        assert_eq!(Real::min(f32::NAN, 1.0), 1.0);
        assert_eq!(Real::max(f32::NAN, 1.0), 1.0);
        assert_eq!(Real::clamp(f32::NAN, 2.0, 3.0), 2.0);
        assert_eq!(Real::clamp(9.0_f32, 2.0, 3.0), 3.0);
    }

    #[test]
    fn scaling_to_one_is_exact() {
        for x in [1.0e-30_f32, 0.3, 1.0, 1.5, 7.9, 1.0e38] {
            let e = x.exponent_to_one();
            assert_eq!(x.ldexp(e).ldexp(-e), x);
            assert!((1.0..2.0).contains(&x.ldexp(e)), "{x}");
        }
        for x in [1.0e-300_f64, 0.3, 1.0, 7.9, 1.0e300] {
            let e = x.exponent_to_one();
            assert_eq!(x.ldexp(e).ldexp(-e), x);
            assert!((1.0..2.0).contains(&x.ldexp(e)), "{x}");
        }
        // The ends of the range come as near as a normal factor can bring them.
        for x in [f32::from_bits(1), f32::MAX] {
            let e = x.exponent_to_one();
            assert!(1.0_f32.ldexp(e).is_normal() && 1.0_f32.ldexp(-e).is_normal());
        }
    }

    #[test]
    fn discriminant_survives_cancellation() {
        // b² and a c agree in their first 24 bits; the difference is 2^-24 exactly.
        let b = 1.0_f32 + f32::EPSILON;
        let c = 1.0_f32 + 2.0 * f32::EPSILON;
        let root = f32::root(1.0, b, c).unwrap();
        assert_eq!(root, f32::EPSILON);
        let b = 1.0_f64 + f64::EPSILON;
        let c = 1.0_f64 + 2.0 * f64::EPSILON;
        assert_eq!(f64::root(1.0, b, c).unwrap(), f64::EPSILON);
        assert_eq!(f32::root(1.0, 1.0, 1.1), None);
    }

    #[test]
    fn tangents_are_right_to_the_last_places() {
        // The steeper, the more the rounding of π shows: by tan x times its relative error.
        for i in 0..1570 {
            let x = f64::from(i) / 1000.0;
            let exact = libm::tan(x);
            let bound = 4.0 * f64::EPSILON * (1.0 + exact) * exact;
            assert!((Real::tan(x) - exact).abs() <= bound, "{x}");
            let x = x as f32;
            let exact = libm::tan(x.into());
            let bound = 4.0 * f64::from(f32::EPSILON) * (1.0 + exact) * exact;
            assert!((f64::from(Real::tan(x)) - exact).abs() <= bound, "{x}");
        }
    }

    #[test]
    fn powers_are_right_to_what_is_seen() {
        for i in 0..=1000 {
            let x = f64::from(i) / 1000.0;
            for exponent in [0.0, 0.3, 1.0, 3.0827, 27.8, 100.0, 1.0e4, 3.0e38] {
                let exact = libm::pow(x, exponent);
                assert!((Real::powf(x, exponent) - exact).abs() < 1.0 / 2700.0, "{x} {exponent}");
                let single = Real::powf(x as f32, exponent as f32);
                assert!((f64::from(single) - exact).abs() < 0.001, "{x} {exponent}");
            }
        }
    }

    #[test]
    fn conversion_to_whole_numbers_saturates() {
        assert_eq!(f32::NAN.floor_ratio(1.0), 0);
        assert_eq!(1.0e20_f32.floor_ratio(1.0), i32::MAX);
        assert_eq!((-0.7_f64).floor_ratio(1.0), -1);
        assert_eq!(f32::NAN.to_byte(), 0);
        assert_eq!(1.0e20_f32.to_byte(), 255);
    }
}
