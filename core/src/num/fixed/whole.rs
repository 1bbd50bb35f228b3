//! Whole-number arithmetic for processors of 32 bits: quotients, square roots and shifts of 64.

use core::num::NonZeroU32;

/// Whether the processor multiplies 32 by 32 bits into 32 only: ARMv6-M, of all ARMs that Rust
/// compiles for the one that has no atomic exchange either. Results are the same.
pub(super) const NARROW: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// The product, in full.
#[inline(always)]
pub(super) fn product(a: i32, b: i32) -> i64 {
    if NARROW { of_halves(a, b) } else { i64::from(a) * i64::from(b) }
}

/// The same from products of halves: 24 instructions where the compiler's routine for 64 bits by 64
/// takes 43.
///
/// H. S. Warren, Hacker's Delight, 2nd ed. (2012), 8-2.
pub(super) fn of_halves(a: i32, b: i32) -> i64 {
    let (upper, lower) = (|x: i32| x >> 16, |x: i32| x & 0xffff);
    // Neither leaves 32 bits: a half times a half that has no sign is at most 2^31 - 2^15.
    let low = lower(a).wrapping_mul(lower(b)) as u32 >> 16;
    let first = upper(a) * lower(b) + low as i32;
    let second = lower(a) * upper(b) + lower(first);
    let high = upper(a) * upper(b) + upper(first) + upper(second);
    i64::from(high) << 32 | i64::from(a.wrapping_mul(b) as u32)
}

/// The upper half of a product, rounded.
#[inline(always)]
pub(super) fn upper(product: i64) -> i32 {
    (product >> 32) as i32 + (product as u32 >> 31) as i32
}

/// Whether the processor counts leading zeros in one instruction.
const COUNTS: bool = !(NARROW || cfg!(target_arch = "riscv32"));

/// The zeros before the first digit of a number other than 0; by halves where counting is a routine,
/// of twice as many instructions.
#[inline(always)]
pub(super) fn leading_zeros(x: u64) -> u32 {
    if COUNTS { x.leading_zeros() } else { zeros_by_halves(x) }
}

#[inline(always)]
pub(super) fn zeros_by_halves(x: u64) -> u32 {
    let high = (x >> 32) as u32;
    let (mut rest, mut zeros) = if high == 0 { (x as u32, 32) } else { (high, 0) };
    for half in [16, 8, 4, 2, 1] {
        if rest >> (32 - half) == 0 {
            rest <<= half;
            zeros += half;
        }
    }
    zeros
}

/// `x` shifted right by `digits`, 1 to 31; beyond 32 bits the nearer of ±`i32::MAX`.
#[inline]
pub(super) const fn shifted(x: i64, digits: u32) -> i32 {
    let (high, low) = ((x >> 32) as i32, x as u32);
    let over = high >> (digits - 1);
    if over == 0 || over == -1 {
        ((high as u32) << (32 - digits) | low >> digits) as i32
    } else if high < 0 {
        -i32::MAX
    } else {
        i32::MAX
    }
}

/// `n / d` rounded down; the greatest number where that has more than 32 bits or `d` is 0.
///
/// Two digits of 16 bits, each estimated from the divisor's upper half and corrected twice at most:
/// D. E. Knuth, The Art of Computer Programming, vol. 2, 4.3.1, algorithm D. A quarter of the
/// instructions of a division of 64 by 64 bits.
pub(super) fn quotient(n: u64, d: u32) -> u32 {
    if (n >> 32) as u32 >= d {
        return u32::MAX;
    }
    let up = leading_zeros(d.into()) - 32;
    normal_quotient(n << up, d << up)
}

/// The same for a divisor of 32 bits and a quotient of no more.
pub(super) fn normal_quotient(n: u64, d: u32) -> u32 {
    // Its uppermost bit is there; told once more, the compiler knows that it is not 0.
    let Some(upper) = NonZeroU32::new(d >> 16 | 1 << 15) else { return u32::MAX };
    let lower = d & 0xffff;
    let digit = |rest: u32, next: u32| {
        let (mut digit, mut left) = (rest / upper, rest % upper);
        for _ in 0..2 {
            if digit >> 16 == 0 && digit.wrapping_mul(lower) <= (left << 16 | next) {
                break;
            }
            digit -= 1;
            left = left.wrapping_add(upper.get());
            if left >> 16 != 0 {
                break;
            }
        }
        (digit, (rest << 16 | next).wrapping_sub(digit.wrapping_mul(d)))
    };
    let (high, low) = ((n >> 32) as u32, n as u32);
    let (first, rest) = digit(high, low >> 16);
    let (second, _) = digit(rest, low & 0xffff);
    first << 16 | second
}

/// The ratio of two numbers in steps of 2^-28, within 2^-30 of its value; a greater number than any
/// that can be told for 8 and more.
pub(super) fn ratio(n: u64, d: u64) -> u32 {
    const UP: u32 = 32 - super::DIGITS;
    if n >> 3 >= d {
        return u32::MAX;
    }
    // Both moved until the divisor is at the upper end, of which 32 bits are taken: a short division
    // will do. The other moves by 28 digits more, for those of the quotient, and 32 less.
    let up = leading_zeros(d);
    let d = ((d << up) >> 32) as u32;
    let n = if up >= UP { n << (up - UP) } else { n >> (UP - up) };
    normal_quotient(n + u64::from(d / 2), d)
}

/// First guesses at the roots of the reciprocals of 16/64 to 63/64, in 2^-7.
#[allow(clippy::indexing_slicing, reason = "while it is compiled")]
const GUESSES: [u8; 48] = {
    let mut guesses = [0; 48];
    let mut i = 0;
    while i < 48 {
        // The greatest one that is not above that of the interval's middle, (2 i + 33) / 128.
        let mut guess = 128_u32;
        while guess < 255 && (guess + 1) * (guess + 1) * (2 * i + 33) <= 128 * 128 * 128 {
            guess += 1;
        }
        guesses[i as usize] = guess as u8;
        i += 1;
    }
    guesses
};

/// The upper half of a product of numbers without sign.
#[inline(always)]
fn high(a: u32, b: u32) -> u32 {
    if NARROW { high_of_halves(a, b) } else { ((u64::from(a) * u64::from(b)) >> 32) as u32 }
}

/// As in [`of_halves`].
#[inline(always)]
pub(super) fn high_of_halves(a: u32, b: u32) -> u32 {
    let (upper, lower) = (|x: u32| x >> 16, |x: u32| x & 0xffff);
    let first = upper(a) * lower(b) + upper(lower(a).wrapping_mul(lower(b)));
    let second = lower(a) * upper(b) + lower(first);
    upper(a) * upper(b) + upper(first) + upper(second)
}

/// 2^31 / √(v / 2^32) give or take 3, for `v >= 2^30`: by Newton's iteration r + r (1 - v r²) / 2,
/// which doubles the digits of a guess each time. Of each factor as many digits as it has right: most
/// products are of 32 bits.
pub(super) fn reciprocal_root(v: u32) -> u32 {
    const ONE: i32 = 1 << 30;
    let place = (v >> 26).wrapping_sub(16) as usize;
    let guess = u32::from(GUESSES.get(place).copied().unwrap_or(128));
    // r (3 - v r²) / 2 the first time, with 8 digits of r and 16 of v.
    let rest = (3 << 30) - guess * guess * (v >> 16);
    let root = (guess * (rest >> 16)) >> 7;
    // 16 digits, less than 2: its square has 32. The rest is less than 2^20.
    let rest = ONE - high(root * root, v) as i32;
    let more = (root as i32 * (rest >> 5)) >> 10;
    let root = (root << 16).wrapping_add(more as u32);
    // The rest is less than 2^12.
    let rest = ONE - high(high(root, root), v) as i32;
    let more = ((root >> 16) as i32 * rest) >> 15;
    root.wrapping_add(more as u32)
}

/// A number of at most 1 in steps of 2^-28 to a whole power, by squaring: with 32 digits, so that upper
/// halves of products are all it takes. What is cut off doubles with each: for powers up to 64 that is
/// at most 4 steps.
pub(super) fn whole_power(base: u32, exponent: u32) -> u32 {
    let (mut power, mut digits) = (u32::MAX, exponent);
    let mut square = if base >> 28 != 0 { u32::MAX } else { base << 4 };
    while digits > 1 && square > 0 {
        if digits & 1 == 1 {
            power = high(power, square);
        }
        square = high(square, square);
        digits >>= 1;
    }
    let power = if digits == 0 { power } else { high(power, square) };
    // All ones stand for 1.
    (power >> 4) + (power >> 3 & 1)
}

/// The whole number nearest to √x.
pub(super) fn nearest_root(x: u64) -> u32 {
    if x == 0 {
        return 0;
    }
    let up = leading_zeros(x) & !1;
    let v = ((x << up) >> 32) as u32;
    // √x = v r, moved back; of r no more than there is, so that less than 2^32 is left of √v.
    let root = high(v, reciprocal_root(v) - 3).wrapping_mul(2);
    // Rounded, by the uppermost digit that goes; mostly right then.
    let mut root = (root >> (up / 2)) + ((root << 1 >> (up / 2)) & 1);
    // In the end root² - root < x <= root² + root.
    for _ in 0..12 {
        let rest = x.wrapping_sub(u64::from(root) * u64::from(root)) as i64;
        if rest > i64::from(root) {
            root = root.wrapping_add(1);
        } else if rest <= -i64::from(root) {
            root = root.wrapping_sub(1);
        } else {
            break;
        }
    }
    root
}
