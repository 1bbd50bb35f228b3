//! Lines that pass or meet a sphere.

use super::whole::nearest_root;
use super::{DIGITS, Fixed, Vec3};
use crate::num::{Real, Vector};

// Everything is in range here: see the proof in the module above.

fn product(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}

fn cut(steps: i64) -> i32 {
    ((steps + (1 << (DIGITS - 1))) >> DIGITS) as i32
}

/// |f|² - (f·u)² > r² by the upper halves of the products alone, which are in steps of 2^-24. Three
/// are cut off f·u, of at most 4.4, and so 27 its square; one that, one r², three |f|²; and a unit
/// vector's square is within 2^-26 of 1.
#[inline(always)]
pub(super) fn passes(towards: Vec3, unit: Vec3, radius: Fixed) -> bool {
    const CUT_OFF: i32 = 40;
    let upper = |a: i32, b: i32| (product(a, b) >> 32) as i32;
    let [x, y, z] = towards.to_array().map(Fixed::to_bits);
    let [ux, uy, uz] = unit.to_array().map(Fixed::to_bits);
    let radius = radius.to_bits();
    let middle = (upper(x, ux) + upper(y, uy) + upper(z, uz)) << (32 - DIGITS);
    let squared = upper(x, x) + upper(y, y) + upper(z, z);
    squared - upper(middle, middle) - upper(radius, radius) > CUT_OFF
}

/// See [`Real::chord`]. Apart from what decides first, as most rays pass by most spheres.
#[inline(never)]
pub(super) fn chord(
    towards: Vec3,
    direction: Vec3,
    inverse_squared: Fixed,
    radius: Fixed,
) -> Option<(Fixed, Fixed)> {
    let [x, y, z] = towards.to_array().map(Fixed::to_bits);
    let [dx, dy, dz] = direction.to_array().map(Fixed::to_bits);
    let inverse = inverse_squared.to_bits();
    let middle = cut(product(x, dx) + product(y, dy) + product(z, dz));
    let middle = cut(product(middle, inverse));
    let across = |f: i32, d: i32| f.wrapping_sub(cut(product(d, middle)));
    let (x, y, z) = (across(x, dx), across(y, dy), across(z, dz));
    let radius = radius.to_bits();
    let left = product(radius, radius) - (product(x, x) + product(y, y) + product(z, z));
    if left < 0 {
        return None;
    }
    let half = Fixed::signed(false, nearest_root(left as u64));
    // What rounding left along the ray is taken back.
    let rest = Fixed::from_bits(cut(product(x, dx) + product(y, dy) + product(z, dz)));
    if inverse_squared == Fixed::ONE {
        return Some((Fixed::from_bits(middle) + rest, half));
    }
    Some((Fixed::from_bits(middle) + rest * inverse_squared, half * inverse_squared.sqrt()))
}
