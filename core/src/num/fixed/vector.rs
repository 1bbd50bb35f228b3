//! Three fixed-point numbers, and points far away.

use super::Fixed;
use super::whole::reciprocal_root;
use crate::num::{Real, Vector};
use core::ops::{Add, Mul, Neg, Sub};

/// A point, a direction or a colour; 12 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub struct Vec3 {
    /// The first component.
    pub x: Fixed,
    /// The second component.
    pub y: Fixed,
    /// The third component.
    pub z: Fixed,
}

// Three numbers of 32 bits without anything between them.
#[allow(unsafe_code)]
mod plain {
    unsafe impl bytemuck::Zeroable for super::Vec3 {}
    unsafe impl bytemuck::Pod for super::Vec3 {}
}

impl Vec3 {
    /// From its three components.
    pub const fn new(x: Fixed, y: Fixed, z: Fixed) -> Self {
        Self { x, y, z }
    }
}

impl Add for Vec3 {
    type Output = Self;
    #[inline]
    fn add(self, rhs: Self) -> Self {
        Self::new(self.x + rhs.x, self.y + rhs.y, self.z + rhs.z)
    }
}

impl Sub for Vec3 {
    type Output = Self;
    /// Does not saturate: places of the scene and directions are not so far apart.
    #[inline]
    fn sub(self, rhs: Self) -> Self {
        Self::new(self.x.way(rhs.x), self.y.way(rhs.y), self.z.way(rhs.z))
    }
}

impl Neg for Vec3 {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl Mul<Fixed> for Vec3 {
    type Output = Self;
    #[inline]
    fn mul(self, rhs: Fixed) -> Self {
        Self::new(self.x * rhs, self.y * rhs, self.z * rhs)
    }
}

impl Vector<Fixed> for Vec3 {
    #[inline]
    fn new(x: Fixed, y: Fixed, z: Fixed) -> Self {
        Self { x, y, z }
    }
    #[inline]
    fn x(self) -> Fixed {
        self.x
    }
    #[inline]
    fn y(self) -> Fixed {
        self.y
    }
    #[inline]
    fn z(self) -> Fixed {
        self.z
    }

    fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// Moved up as far as it goes before it is squared, so that short vectors keep their digits.
    fn unit(self) -> Option<Self> {
        let steps = self.to_array().map(Fixed::to_bits);
        const FAR: i32 = i32::MAX - 1;
        // As long as the longest of them; a negative number may be taken for one less.
        let [a, b, c] = steps.map(|x| x ^ (x >> 31));
        let digits = a | b | c;
        if (digits == 0 && steps == [0; 3]) || (digits >= FAR && !self.is_finite()) {
            return None;
        }
        let up = digits.leading_zeros() - 1;
        // The longest has 31 digits now, the square 61 to 64; of those the upper 32, moved evenly.
        let [x, y, z] = steps.map(|x| x << up);
        let square = |x: i32| (i64::from(x) * i64::from(x)) as u64;
        let squared = square(x) + square(y) + square(z);
        let short = squared >> 62 == 0;
        let upper = ((if short { squared << 2 } else { squared }) >> 32) as u32;
        // 1 / length, at most 1, in 30 digits.
        let inverse = i64::from(reciprocal_root(upper) >> 2);
        let part = |x: i32| {
            let x = i64::from(if short { x } else { x >> 1 });
            Fixed::from_bits(((x * inverse + (1 << 31)) >> 32) as i32)
        };
        Some(Self::from_array([part(x), part(y), part(z)]))
    }

    fn across(self, other: Self) -> Self {
        let product = |a: Fixed, b: Fixed, c: Fixed, d: Fixed| (a.times(b) - c.times(d)).to_bits();
        let all = [
            product(self.y, other.z, self.z, other.y),
            product(self.z, other.x, self.x, other.z),
            product(self.x, other.y, self.y, other.x),
        ];
        let [x, y, z] = all.map(i64::unsigned_abs);
        // From 1 to 2 again: 29 bits of what may be 63.
        let spare = (x | y | z).leading_zeros();
        let scaled = |v: i64| match 35_u32.checked_sub(spare) {
            Some(digits) => Fixed::saturated(v >> digits),
            None => Fixed::saturated(v << (spare - 35).min(28)),
        };
        Self::from_array(all.map(scaled))
    }
}

/// A point that may be far outside the scene: a light. What is stored is 2^-exponent of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FarPoint {
    position: Vec3,
    exponent: u8,
}

/// Lights farther away than 2 to this power are refused.
const FARTHEST: u8 = 30;

impl FarPoint {
    /// The nearest one to a point.
    pub const fn new(position: [f64; 3]) -> Self {
        let [mut x, mut y, mut z] = position;
        let mut exponent = 0;
        // At most 2, so that differences are in range.
        while exponent <= FARTHEST
            && !(x <= 2.0 && x >= -2.0 && y <= 2.0 && y >= -2.0 && z <= 2.0 && z >= -2.0)
        {
            (x, y, z) = (x / 2.0, y / 2.0, z / 2.0);
            exponent += 1;
        }
        Self { position: Vec3::new(Fixed::new(x), Fixed::new(y), Fixed::new(z)), exponent }
    }

    pub(super) fn is_usable(self) -> bool {
        self.exponent <= FARTHEST && self.position.max_abs() <= Fixed::from_i32(2)
    }

    pub(super) fn exponent(self) -> i32 {
        self.exponent.into()
    }

    /// The way to it, 2^-exponent of it.
    pub(super) fn seen_from(self, point: Vec3) -> Vec3 {
        let point = match self.exponent {
            0 => point,
            exponent => point.map(|x| x.ldexp(-i32::from(exponent))),
        };
        self.position.zip(point, |to, from| to - from)
    }
}
