//! `f32` and `f64` as [`Real`]. `f64` is the reference on the host.

use super::{Real, Vector, sqrt};

macro_rules! float {
    ($f:ident, $vec3:ty, $bits:ident, $mantissa:expr, $sqrt:path) => {
        impl Real for $f {
            type Wide = Self;
            type Vec3 = $vec3;

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const PI: Self = core::$f::consts::PI;
            const EPSILON: Self = $f::EPSILON;
            const MAX: Self = $f::MAX;
            const INFINITY: Self = $f::INFINITY;

            fn from_f64(x: f64) -> Self {
                x as Self
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn from_i32(i: i32) -> Self {
                i as Self
            }
            fn to_i32(self) -> i32 {
                self as i32
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
            fn scale_to_one(self) -> (Self, Self) {
                // Multiplying by 2^-e is subtracting e from the exponent field. Clamped so that
                // both factors stay normal numbers.
                const BIAS: $bits = (1 << ($f::MAX_EXP.ilog2())) - 1;
                let e = (self.to_bits() >> $mantissa).clamp(1, 2 * BIAS - 1);
                let power = |e: $bits| Self::from_bits(e << $mantissa);
                (power(2 * BIAS - e), power(e))
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
    fn scale_to_one_is_an_exact_power_of_two() {
        for x in [1.0e-30_f32, 0.3, 1.0, 1.5, 7.9, 1.0e38] {
            let (down, up) = x.scale_to_one();
            assert_eq!(down * up, 1.0);
            assert!((1.0..2.0).contains(&(x * down)), "{x}");
        }
        for x in [1.0e-300_f64, 0.3, 1.0, 7.9, 1.0e300] {
            let (down, up) = x.scale_to_one();
            assert_eq!(down * up, 1.0);
            assert!((1.0..2.0).contains(&(x * down)), "{x}");
        }
        // The ends of the range come as near as a normal factor can bring them.
        for x in [f32::from_bits(1), f32::MAX] {
            let (down, up) = x.scale_to_one();
            assert!(down.is_normal() && up.is_normal());
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
        assert_eq!(Real::to_i32(f32::NAN), 0);
        assert_eq!(Real::to_i32(1.0e20_f32), i32::MAX);
        assert_eq!(Real::to_i32(-1.0e20_f64), i32::MIN);
        assert_eq!(Real::to_i32(-0.7_f64), 0);
    }
}
