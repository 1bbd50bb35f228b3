//! Lines that pass or meet a sphere.

use super::whole::{NARROW, nearest_root, product};
use super::{DIGITS, Fixed, Vec3};
use crate::num::{Real, Vector};

// Everything is in range here: see the proof in the module above.

fn cut(steps: i64) -> i32 {
    ((steps + (1 << (DIGITS - 1))) >> DIGITS) as i32
}

/// What tells quickly whether a ray passes by a sphere; see [`Real::passes`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Course {
    /// Its direction, of length 1: in steps of 2^-15 where products are short, of 2^-28 elsewhere.
    unit: [i32; 3],
    /// Where products are short, digits that are cut off ways.
    digits: u32,
}

impl Course {
    /// Of a ray that starts at most `reach` from the middle.
    #[inline(always)]
    pub(super) fn new(unit: Vec3, reach: Fixed) -> Self {
        let unit = unit.to_array().map(Fixed::to_bits);
        if !NARROW {
            return Self { unit, digits: 0 };
        }
        Self::short(unit, reach)
    }

    /// Centres are up to 1/2 from the middle: 0.8 * 2^(digits - 13) is more than reach and that.
    fn short(unit: [i32; 3], reach: Fixed) -> Self {
        const FARTHEST: [Fixed; 3] = [Fixed::new(0.3), Fixed::new(1.1), Fixed::new(2.7)];
        let [near, far, farther] = FARTHEST;
        let digits = match reach {
            _ if reach <= near => 13,
            _ if reach <= far => 14,
            _ if reach <= farther => 15,
            _ => 17,
        };
        Self { unit: unit.map(|x| (x + (1 << 12)) >> 13), digits }
    }

    /// Both ways of telling are on the safe side: what they cannot tell is not passed by.
    #[inline(always)]
    pub(super) fn passes(&self, towards: Vec3, radius: Fixed) -> bool {
        let towards = towards.to_array().map(Fixed::to_bits);
        if NARROW {
            self.passes_short(towards, radius.to_bits())
        } else {
            passes(towards, self.unit, radius.to_bits())
        }
    }

    /// |f|² > (|f·u| + 2)² + (r + 3)² in products of 32 bits.
    ///
    /// Of `towards` up to 26,215 steps are left along an axis, so that all sums are below 2^31. One
    /// cut off along each axis brings it at most √3 nearer to the line, and the radius is less than
    /// one cut short: 3. The direction is off by 0.87 of its steps, f·u by 1.21 for this and a half
    /// for its own rounding: 2.
    #[inline(always)]
    fn passes_short(&self, towards: [i32; 3], radius: i32) -> bool {
        let [x, y, z] = towards.map(|f| f >> (self.digits & 31));
        let [ux, uy, uz] = self.unit;
        let middle = (x * ux + y * uy + z * uz + (1 << 14)) >> 15;
        let (middle, radius) = (middle.abs() + 2, (radius >> (self.digits & 31)) + 3);
        x * x + y * y + z * z - middle * middle > radius * radius
    }
}

/// |f|² - (f·u)² > r² by the upper halves of the products alone, which are in steps of 2^-24. Three
/// are cut off f·u, of at most 4.4, and so 27 its square; one that, one r², three |f|²; and a unit
/// vector's square is within 2^-26 of 1.
#[inline(always)]
fn passes([x, y, z]: [i32; 3], [ux, uy, uz]: [i32; 3], radius: i32) -> bool {
    const CUT_OFF: i32 = 40;
    let upper = |a: i32, b: i32| (product(a, b) >> 32) as i32;
    let middle = (upper(x, ux) + upper(y, uy) + upper(z, uz)) << (32 - DIGITS);
    let squared = upper(x, x) + upper(y, y) + upper(z, z);
    squared - upper(middle, middle) - upper(radius, radius) > CUT_OFF
}

/// What both ways of telling say.
#[cfg(test)]
pub(super) fn both(unit: Vec3, reach: Fixed, towards: Vec3, radius: Fixed) -> (bool, bool) {
    let [unit, towards] = [unit, towards].map(|v| v.to_array().map(Fixed::to_bits));
    let short = Course::short(unit, reach).passes_short(towards, radius.to_bits());
    (passes(towards, unit, radius.to_bits()), short)
}

/// See [`Real::chord`]. Apart from what decides first, as most rays pass by most spheres; the way
/// towards the centre by value, as it is in registers.
#[inline(never)]
pub(super) fn chord(
    x: i32,
    y: i32,
    z: i32,
    direction: Vec3,
    inverse_squared: Fixed,
    radius: Fixed,
    min: Fixed,
) -> Option<(Fixed, Fixed)> {
    let [dx, dy, dz] = direction.to_array().map(Fixed::to_bits);
    let is_unit = inverse_squared == Fixed::ONE;
    let middle = cut(product(x, dx) + product(y, dy) + product(z, dz));
    let middle = if is_unit { middle } else { cut(product(middle, inverse_squared.to_bits())) };
    let across = |f: i32, d: i32| f.wrapping_sub(cut(product(d, middle)));
    let (x, y, z) = (across(x, dx), across(y, dy), across(z, dz));
    let radius = radius.to_bits();
    let left = product(radius, radius) - (product(x, x) + product(y, y) + product(z, z));
    if left < 0 {
        return None;
    }
    // What rounding left along the ray is taken back.
    let rest = Fixed::from_bits(cut(product(x, dx) + product(y, dy) + product(z, dz)));
    if !is_unit {
        let half = Fixed::signed(false, nearest_root(left as u64));
        let middle = Fixed::from_bits(middle) + rest * inverse_squared;
        return Some((middle, half * inverse_squared.sqrt()));
    }
    let middle = Fixed::from_bits(middle) + rest;
    // The root nearest to `left` is at most m where that is at most m² + m: both crossings are behind.
    let behind = middle.to_bits();
    if behind < 0 && min >= Fixed::ZERO && left <= product(behind, behind) - i64::from(behind) {
        return None;
    }
    Some((middle, Fixed::signed(false, nearest_root(left as u64))))
}
