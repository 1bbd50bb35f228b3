//! Where a set of boxes is best cut in two.
//!
//! J. Goldsmith and J. Salmon, "Automatic creation of object hierarchies for ray tracing", IEEE
//! CG&A 7(5) (1987), for the probability of a hit as the ratio of surfaces; I. Wald, "On fast
//! construction of SAH-based bounding volume hierarchies", RT 2007, for the bins.

use super::units::Bounds;
use crate::accel::Id;

/// Bins along an axis, of which at least half are used: their width is a power of two. A power of
/// two itself. All bins of all axes take 672 bytes of the stack, 768 with large ids.
const BINS: usize = 16;

/// A cut across an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    axis: usize,
    from: u32,
    shift: u32,
    bin: u32,
}

impl Cut {
    /// Whether a box lies below.
    pub(super) fn is_below(&self, bounds: Bounds) -> bool {
        let middle = bounds.middle().get(self.axis).copied().unwrap_or(0);
        middle.saturating_sub(self.from) >> self.shift < self.bin
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

    fn cost(self) -> u64 {
        self.bounds.half_area() * self.count.get() as u64
    }
}

/// The cut with the least sum of surface times number on both sides; `None` when all boxes have the
/// same middle.
#[inline(never)]
pub(super) fn best_cut<I: Id>(boxes: impl Iterator<Item = Bounds> + Clone) -> Option<Cut> {
    let (mut from, mut to) = ([u32::MAX; 3], [0; 3]);
    for bounds in boxes.clone() {
        for ((from, to), middle) in from.iter_mut().zip(&mut to).zip(bounds.middle()) {
            *from = middle.min(*from);
            *to = middle.max(*to);
        }
    }
    // Not an array of arrays, of which one more would be made to be copied.
    let mut bins = [Bin::<I>::empty(); 3 * BINS];
    let (bins, _) = bins.as_chunks_mut::<BINS>();
    let mut shifts = [0; 3];
    for ((shift, from), to) in shifts.iter_mut().zip(from).zip(to) {
        let bits = u32::BITS - to.saturating_sub(from).leading_zeros();
        *shift = bits.saturating_sub(BINS.trailing_zeros());
    }
    for bounds in boxes {
        let places = bounds.middle().into_iter().zip(from).zip(shifts);
        for (bins, ((middle, from), shift)) in bins.iter_mut().zip(places) {
            let bin = middle.saturating_sub(from) >> shift;
            if let Some(bin) = bins.get_mut(bin as usize) {
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
    Some(Cut { axis, from: *from.get(axis)?, shift: *shifts.get(axis)?, bin: bin as u32 })
}

/// The least sum along an axis, and the first bin above that cut. Apart, as what it needs is not
/// needed while the boxes of shapes are computed: the stack is deepest there.
#[inline(never)]
fn best_bin<I: Id>(bins: &[Bin<I>; BINS]) -> Option<(u64, usize)> {
    // Where nothing is added nothing changes: few shapes are in few bins.
    let (mut above, mut cost_above, mut costs) = (Bin::<I>::empty(), 0, [0; BINS]);
    for (cost, bin) in costs.iter_mut().zip(bins).rev() {
        if bin.count.get() > 0 {
            above = above.add(bin.bounds, bin.count.get());
            cost_above = above.cost();
        }
        *cost = cost_above;
    }
    let (all, mut below) = (above.count.get(), Bin::<I>::empty());
    let mut best: Option<(u64, usize)> = None;
    for ((number, bin), above) in (1..).zip(bins).zip(costs.iter().skip(1)) {
        if bin.count.get() == 0 {
            continue;
        }
        below = below.add(bin.bounds, bin.count.get());
        if below.count.get() == all {
            break;
        }
        let cost = below.cost() + above;
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, number));
        }
    }
    best
}
