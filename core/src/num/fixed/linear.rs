//! Reciprocals, and walls at equal distances along a ray.

use super::whole::{normal_quotient, quotient, shifted};
use super::{DIGITS, Fixed};
use crate::num;

/// The reciprocal of a direction's component: `mantissa * 2^-(shift)`, the mantissa of 31 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reciprocal {
    /// 0 for that of 0.
    mantissa: i32,
    /// 2 to 31.
    shift: u32,
}

impl Reciprocal {
    pub(super) fn of(d: Fixed) -> Self {
        let size = d.to_bits().unsigned_abs();
        if size == 0 {
            return Self::default();
        }
        let up = size.leading_zeros();
        let length = u32::BITS - up;
        // 2^28 / size is 2^(28 - length) times a number from 1 to 2, of which 31 bits are kept.
        let normal = size << up;
        // What is 2 becomes the next smaller number.
        let mantissa = normal_quotient((1_u64 << 62) + u64::from(normal / 2), normal);
        let mantissa = mantissa.min(i32::MAX as u32) as i32;
        let mantissa = if d.to_bits() < 0 { -mantissa } else { mantissa };
        Self { mantissa, shift: (2 + length).min(31) }
    }

    /// The quotient of a component that is not greater.
    pub(super) fn slope(self, across: Fixed) -> Slope {
        // The divisor's size is 1/2 at least: 28 bits or more.
        let product = i64::from(across.to_bits()) * i64::from(self.mantissa);
        let steps = (product >> self.shift.saturating_sub(4)) + 1;
        Slope((steps >> 1).clamp(-i64::from(i32::MAX), i64::from(i32::MAX)) as i32)
    }

    /// Half of what is shifted out.
    fn half(self) -> i64 {
        (1_u32 << self.shift >> 1).into()
    }
}

/// A number from -1 to 1 in steps of 2^-31; ±1 is the nearest below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slope(i32);

impl Slope {
    /// Its product with a number from -4 to 4, in steps of 2^-28, rounded down. The upper half of a
    /// product is all that this takes.
    #[inline(always)]
    pub(super) fn times(self, z: Fixed) -> i32 {
        ((i64::from(z.to_bits() << 1) * i64::from(self.0)) >> 32) as i32
    }
}

impl num::Reciprocal<Fixed> for Reciprocal {
    fn of(d: Fixed) -> Self {
        Self::of(d)
    }

    fn sign(self) -> i32 {
        self.mantissa.signum()
    }

    fn times(self, x: Fixed) -> Fixed {
        if self.mantissa == 0 {
            return Fixed::default();
        }
        let product = i64::from(x.to_bits()) * i64::from(self.mantissa);
        Fixed::from_bits(shifted(product + self.half(), self.shift))
    }
}

/// An extent divided into equal cells.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cells {
    /// The width of a cell in steps of 2^-56.
    width: i64,
    /// Cells in a step: a number of 30 or 31 bits times 2^-shift.
    density: i32,
    shift: u32,
}

impl num::Cells<Fixed> for Cells {
    fn new(extent: Fixed, count: i32) -> Self {
        let (extent, count) = (extent.to_bits().max(1), count.max(1));
        let width = (i64::from(extent) << DIGITS).checked_div(count.into());
        let shift = 30 + extent.ilog2() - count.ilog2();
        let density = quotient((count as u64) << shift, extent.unsigned_abs());
        Self { width: width.unwrap_or(0), density: density as i32, shift }
    }

    fn index(&self, x: Fixed) -> i32 {
        let product = i64::from(x.to_bits()) * i64::from(self.density);
        match self.shift.checked_sub(32) {
            // The upper half is enough.
            Some(more) => (product >> 32) as i32 >> (more & 31),
            // Several cells in a step.
            None => shifted(product, self.shift),
        }
    }

    fn wall(&self, i: i32) -> Fixed {
        // Cells of an extent that has a number end where it ends.
        Fixed::from_bits((self.width.wrapping_mul(i.into()) >> DIGITS) as i32)
    }
}

/// Parameters at which a ray meets walls at equal distances: those of the first and between two,
/// times a mantissa and not yet divided by a power of two, so that none is rounded before it is
/// asked for. The first has half of what will be cut off.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    start: i64,
    width: i64,
    shift: u32,
}

impl Progress {
    fn with(reciprocal: Reciprocal, from: Fixed, cells: &Cells) -> Self {
        let mantissa = i64::from(reciprocal.mantissa);
        // A product of 64 and 32 bits without its last 28.
        let (high, low) = (cells.width >> DIGITS, cells.width & ((1 << DIGITS) - 1));
        Self {
            start: i64::from(from.to_bits()) * mantissa + reciprocal.half(),
            width: high * mantissa + ((low * mantissa) >> DIGITS),
            shift: reciprocal.shift,
        }
    }
}

impl num::Progress<Fixed> for Progress {
    type Reciprocal = Reciprocal;
    type Cells = Cells;
    type Count = i32;
    type Halves = Halves;

    fn new(reciprocal: Reciprocal, from: Fixed, cells: &Cells, _count: i32) -> Option<Self> {
        (reciprocal.mantissa != 0).then(|| Self::with(reciprocal, from, cells))
    }

    fn of(direction: Fixed, from: Fixed, cells: &Cells, count: i32) -> Option<Self> {
        Self::new(Reciprocal::of(direction), from, cells, count)
    }

    fn steep(direction: Fixed, from: Fixed, cells: &Cells) -> Self {
        let moving = if direction == Fixed::default() { Fixed::from_bits(1) } else { direction };
        Self::with(Reciprocal::of(moving), from, cells)
    }

    fn falls(&self) -> bool {
        self.width < 0
    }

    fn never() -> Self {
        Self { start: i64::MAX / 4, width: 0, shift: 2 }
    }

    #[inline]
    fn at(&self, i: i32) -> Fixed {
        Fixed::from_bits(shifted(self.start + self.width * i64::from(i), self.shift))
    }

    fn along(&self, sign: i32) -> Self {
        Self { width: self.width * i64::from(sign), ..*self }
    }

    #[inline(always)]
    fn count(i: i32) -> i32 {
        i
    }

    #[inline(always)]
    fn number(count: i32) -> i32 {
        count
    }

    #[inline(always)]
    fn next(count: i32) -> i32 {
        count + 1
    }

    #[inline(always)]
    fn at_count(&self, count: i32) -> Fixed {
        self.at(count)
    }

    fn rebased(&self, origin: i32, shift: u8) -> Self {
        Self {
            start: self.start + self.width * i64::from(origin),
            width: self.width << shift,
            shift: self.shift,
        }
    }

    fn halves(&self, falls: bool, deepest: u32) -> (Halves, i32) {
        let digits = self.shift.max(30);
        let all = self.width << deepest;
        let (first, step) =
            if falls { (self.start + all, -(all >> 1)) } else { (self.start, all >> 1) };
        let middle = shifted(first, digits).clamp(-Halves::FARTHEST, Halves::FARTHEST);
        (Halves { step: shifted(step, digits), coarse: digits - self.shift }, middle)
    }
}

/// Walls of cells that are halved, in steps of 2^(`coarse` - 28), each from the one above: 32 bits
/// are enough, however slowly the ray moves along the axis.
///
/// While it moves on by such a step it moves by less than one of 2^-28 along the axis, or two if the
/// direction's component is 1 or more. Each level cuts off less than a step: at the tenth a wall is off
/// by 24 along the axis, of the 64 that boxes of shapes are padded by beyond what hits may be off.
#[derive(Clone, Copy, Debug, Default)]
pub struct Halves {
    /// From the first wall to the middle of all.
    step: i32,
    coarse: u32,
}

impl Halves {
    /// Rays of a scene start at most 2.6 from its walls, in these steps twice that; others might leave
    /// the range. Half of a scene, 0.51, is left beyond it twice.
    const FARTHEST: i32 = 11 << (DIGITS - 1);
}

impl num::Halves<Fixed> for Halves {
    type Middle = i32;
    type Corner = ();

    /// In steps of 8, of which all parameters are 0 or -1.
    fn standing(cell: i32, deepest: u32) -> (Self, i32) {
        const ALL: i32 = 1 << DIGITS;
        let width = ALL >> deepest;
        (Self { step: ALL / 2, coarse: 31 }, -(width * cell + width / 2))
    }

    #[inline(always)]
    fn corner(_corner: (), _upper: bool, _shift: u32) {}

    #[inline(always)]
    fn middle(&self, above: i32, passed: bool, _corner: (), level: u32, _deepest: u32) -> i32 {
        let step = self.step >> (level & 31);
        if passed { above + step } else { above - step }
    }

    #[inline(always)]
    fn between(
        &self,
        first: i32,
        (enter, leave): (Fixed, Fixed),
        _falls: bool,
        _deepest: u32,
    ) -> Option<(Fixed, Fixed)> {
        let (coarse, last) = (self.coarse & 31, first + 2 * self.step);
        // What is beyond either end may be out of range.
        let from = enter.to_bits() >> coarse;
        if first > leave.to_bits() >> coarse || last < from {
            return None;
        }
        let enter = if first > from { Fixed::from_bits(first << coarse) } else { enter };
        let (_, leave) = self.pass(last, enter, leave);
        Some((enter, leave))
    }

    #[inline(always)]
    fn pass(&self, middle: i32, t: Fixed, exit: Fixed) -> (bool, Fixed) {
        let coarse = self.coarse & 31;
        if middle <= t.to_bits() >> coarse {
            (true, exit)
        } else if middle <= exit.to_bits().wrapping_sub(1) >> coarse {
            (false, Fixed::from_bits(middle << coarse))
        } else {
            (false, exit)
        }
    }
}
