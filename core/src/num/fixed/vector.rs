//! Three fixed-point numbers, and points far away.

use super::whole::{leading_zeros, product, reciprocal_root, shifted, upper};
use super::{DIGITS, Fixed};
use crate::num::{Axis, Real, Vector};
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

    /// `self + direction * t`, each rounded once.
    #[inline]
    pub(super) fn at(self, direction: Self, t: Fixed) -> Self {
        if self.is_within(4) && direction.is_within(2) && is_within(t, 2) {
            return self
                .zip(direction, |o, d| Fixed::from_bits(o.to_bits().wrapping_add(short(d, t))));
        }
        plus(self, direction, Self::new(t, t, t))
    }

    /// Whether each is from `-n` to less than `n`, a power of two: one question for all.
    #[inline(always)]
    fn is_within(self, n: u32) -> bool {
        let limit = n << DIGITS;
        let [x, y, z] = self.to_array().map(|x| (x.to_bits() as u32).wrapping_add(limit));
        (x | y | z) < 2 * limit
    }

    /// The same for the direction of a ray, less than 2 along an axis unless `reach` is infinite:
    /// while both numbers can be moved up, the upper half of a product is all that this takes.
    #[inline(always)]
    pub(super) fn along_ray(self, direction: Self, t: Fixed, reach: Fixed) -> Self {
        let two = Fixed::from_bits(2 << DIGITS);
        if reach > two || t < -two || t >= two {
            return self.at(direction, t);
        }
        // At most 2 and a product of less than 4: in range.
        let along = |o: Fixed, d: Fixed| {
            let way = upper(product(d.to_bits() << 2, t.to_bits() << 2));
            Fixed::from_bits(o.to_bits().wrapping_add(way))
        };
        self.zip(direction, along)
    }

    /// The same for a vector of length 1 and a few steps of `error`, within which `reach` keeps to the
    /// range: its upper 16 digits tell.
    #[inline(always)]
    pub(super) fn beside(self, unit: Self, error: Fixed, reach: Fixed) -> Self {
        if reach == Fixed::INFINITY || error.to_bits() >> 12 != 0 {
            return self.at(unit, error);
        }
        let beside = |p: Fixed, u: Fixed| {
            let way = ((u.to_bits() >> 12) * error.to_bits() + (1 << 15)) >> 16;
            Fixed::from_bits(p.to_bits().wrapping_add(way))
        };
        self.zip(unit, beside)
    }
}

/// Whether it is from `-n` to less than `n`.
#[inline(always)]
fn is_within(x: Fixed, n: u32) -> bool {
    (x.to_bits() as u32).wrapping_add(n << DIGITS) < (2 * n) << DIGITS
}

/// The product of numbers from -2 to less than 2, in steps of 2^-28, rounded: its upper half.
#[inline(always)]
fn short(a: Fixed, b: Fixed) -> i32 {
    upper(product(a.to_bits() << 2, b.to_bits() << 2))
}

/// `p + v * by` of each component, rounded once.
#[cold]
#[inline(never)]
fn plus(p: Vec3, v: Vec3, by: Vec3) -> Vec3 {
    let along = |o: Fixed, d: Fixed, t: Fixed| {
        // Half a step is rounded up; it fits below what the origin is moved up by.
        let (high, low) = (o.to_bits() >> 4, (o.to_bits() as u32) << DIGITS | 1 << (DIGITS - 1));
        (i64::from(high) << 32 | i64::from(low)) + product(d.to_bits(), t.to_bits())
    };
    let cut = |steps: i64| Fixed::from_bits(shifted(steps, DIGITS));
    Vec3::new(cut(along(p.x, v.x, by.x)), cut(along(p.y, v.y, by.y)), cut(along(p.z, v.z, by.z)))
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
        if self.is_within(2) && is_within(rhs, 2) {
            return self.map(|x| Fixed::from_bits(short(x, rhs)));
        }
        plus(Self::default(), self, Self::new(rhs, rhs, rhs))
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

    /// Moved up as far as it goes before it is divided, so that short vectors keep their digits. What
    /// is of length 1 to 2^-28 stays as it is.
    fn unit(self) -> Option<Self> {
        let steps = self.to_array().map(Fixed::to_bits);
        // Each square is at most 2^62.
        let [x, y, z] = steps.map(|x| product(x, x) as u64);
        let squared = x + y + z;
        const ONE: u64 = 1 << (2 * DIGITS);
        const NEAR: u64 = 1 << (DIGITS + 1);
        if squared.wrapping_sub(ONE - NEAR) <= 2 * NEAR {
            return Some(self);
        }
        // That of the greatest number has 62 digits.
        if squared == 0 || (squared >> 60 != 0 && !self.is_finite()) {
            return None;
        }
        // As long as the length of 32 digits that the root's reciprocal of 30 is made for.
        let up = leading_zeros(squared) / 2;
        let inverse = (reciprocal_root(((squared << (2 * up)) >> 32) as u32) >> 2) as i32;
        let moved = match up.checked_sub(1) {
            Some(up) => steps.map(|x| x << up),
            None => steps.map(|x| x >> 1),
        };
        let part = |x: i32| Fixed::from_bits(upper(product(x, inverse)));
        Some(Self::from_array(moved.map(part)))
    }

    /// Of finite numbers and infinities; what else bits may say is neither.
    fn max_abs(self) -> Fixed {
        let [x, y, z] = self.to_array().map(|x| x.to_bits().wrapping_abs());
        Fixed::from_bits(x.max(y).max(z))
    }

    fn major_axis(self) -> Axis {
        let [x, y, z] = self.to_array().map(|x| x.to_bits().wrapping_abs());
        match () {
            () if x >= y && x >= z => Axis::X,
            () if y >= z => Axis::Y,
            () => Axis::Z,
        }
    }

    fn scale(self, other: Self) -> Self {
        // White light is common.
        if other == Self::new(Fixed::ONE, Fixed::ONE, Fixed::ONE) {
            return self;
        }
        if self.is_within(2) && other.is_within(2) {
            return self.zip(other, |a, b| Fixed::from_bits(short(a, b)));
        }
        plus(Self::default(), self, other)
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
