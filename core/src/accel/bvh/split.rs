//! Where a set of boxes is best cut in two.
//!
//! J. Goldsmith and J. Salmon, "Automatic creation of object hierarchies for ray tracing", IEEE
//! CG&A 7(5) (1987), for the probability of a hit as the ratio of surfaces; I. Wald, "On fast
//! construction of SAH-based bounding volume hierarchies", RT 2007, for the bins.

use super::units::Bounds;
use crate::accel::Id;

/// Bins along an axis, of which at least half are used: their width is a power of two. Those of all
/// axes take 672 bytes of the stack, 768 with large ids.
const BINS: usize = 16;

/// A cut across an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    axis: usize,
    bins: Bins,
    bin: usize,
}

impl Cut {
    /// Whether a box lies below.
    pub(super) fn is_below(&self, bounds: Bounds) -> bool {
        let middle = bounds.middle().get(self.axis).copied().unwrap_or(0);
        self.bins.of(middle) < self.bin
    }
}

/// Equal bins along an axis, for twice the middles of boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bins {
    from: u32,
    /// The logarithm of their width.
    shift: u32,
}

impl Bins {
    /// For twice the middles from one number to another.
    pub(super) fn between(from: u32, to: u32) -> Self {
        let bits = u32::BITS - to.saturating_sub(from).leading_zeros();
        Self { from, shift: bits.saturating_sub(BINS.trailing_zeros()) }
    }

    fn of(self, middle: u32) -> usize {
        (middle.saturating_sub(self.from) >> self.shift) as usize
    }
}

/// Shapes are counted in the type of their ids.
#[derive(Clone, Copy)]
struct Bin<I> {
    bounds: Bounds,
    count: I,
}

impl<I: Id> Bin<I> {
    fn empty() -> Self {
        Self { bounds: Bounds::EMPTY, count: I::new(0) }
    }

    fn add(self, bounds: Bounds, count: usize) -> Self {
        Self { bounds: self.bounds.union(bounds), count: I::new(self.count.get() + count) }
    }
}

/// The cut with the least sum of surface times number on both sides; `None` when all boxes have the
/// same middle.
#[inline(never)]
pub(super) fn best_cut<I: Id>(
    along: &[Bins; 3],
    boxes: impl Iterator<Item = Bounds>,
) -> Option<Cut> {
    // Not an array of arrays, of which one more would be made to be copied.
    let mut bins = [Bin::<I>::empty(); 3 * BINS];
    let (bins, _) = bins.as_chunks_mut::<BINS>();
    for bounds in boxes {
        let places = bounds.middle().into_iter().zip(along);
        for (bins, (middle, along)) in bins.iter_mut().zip(places) {
            if let Some(bin) = bins.get_mut(along.of(middle)) {
                *bin = bin.add(bounds, 1);
            }
        }
    }
    let mut best: Option<(u64, usize, usize)> = None;
    for (axis, bins) in bins.iter().enumerate() {
        if let Some((cost, bin)) = best_bin(bins)
            && best.is_none_or(|(least, ..)| cost < least)
        {
            best = Some((cost, axis, bin));
        }
    }
    let (_, axis, bin) = best?;
    Some(Cut { axis, bins: *along.get(axis)?, bin })
}

/// The least sum along an axis, and the first bin above that cut. Apart, as what it needs is not
/// needed while the boxes of shapes are computed: the stack is deepest there.
#[inline(never)]
fn best_bin<I: Id>(bins: &[Bin<I>; BINS]) -> Option<(u64, usize)> {
    // Areas of all that is above, in four units: so they fit 32 bits. Where nothing is added nothing
    // changes: few shapes are in few bins.
    let (mut above, mut area, mut areas) = (Bin::<I>::empty(), 0, [0; BINS]);
    for (place, bin) in areas.iter_mut().zip(bins).rev() {
        if bin.count.get() > 0 {
            above = above.add(bin.bounds, bin.count.get());
            area = (above.bounds.half_area() >> 2) as u32;
        }
        *place = area;
    }
    let (all, mut below) = (above.count.get(), Bin::<I>::empty());
    let mut best: Option<(u64, usize)> = None;
    for ((number, bin), area) in (1..).zip(bins).zip(areas.iter().skip(1)) {
        if bin.count.get() == 0 {
            continue;
        }
        below = below.add(bin.bounds, bin.count.get());
        let above = all - below.count.get();
        if above == 0 {
            break;
        }
        let sides = below.bounds.half_area() >> 2;
        let cost = sides * below.count.get() as u64 + u64::from(*area) * above as u64;
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, number));
        }
    }
    best
}
