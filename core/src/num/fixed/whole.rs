//! Whole-number arithmetic for processors of 32 bits: quotients, square roots and shifts of 64.

use core::num::NonZeroU32;

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
    let up = d.leading_zeros();
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

/// The upper half of a product.
const fn high(a: u32, b: u32) -> u32 {
    ((a as u64 * b as u64) >> 32) as u32
}

/// 2^31 / √(v / 2^32) less no more than 2^2, for `v >= 2^30`: by Newton's iteration
/// r (3 - v r²) / 2, which doubles the digits of a guess each time.
pub(super) fn reciprocal_root(v: u32) -> u32 {
    let place = (v >> 26).wrapping_sub(16) as usize;
    let mut root = u32::from(GUESSES.get(place).copied().unwrap_or(128)) << 24;
    for _ in 0..3 {
        // v r² in 2^-30, about 1.
        let one = high(high(root, root), v);
        root = high(root, (3_u32 << 30).wrapping_sub(one)).wrapping_mul(2);
    }
    root
}

/// The whole number nearest to √x.
pub(super) fn nearest_root(x: u64) -> u32 {
    if x == 0 {
        return 0;
    }
    let up = x.leading_zeros() & !1;
    let v = ((x << up) >> 32) as u32;
    // √x = v r, moved back.
    let root = high(v, reciprocal_root(v)).wrapping_mul(2);
    let mut root = root >> (up / 2);
    // A little too small; in the end root² - root < x <= root² + root.
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
