//! Macro-cells: every empty cell knows how far it is to the nearest that is not.
//!
//! M. Šrámek, A. Kaufman, "Fast ray-tracing of rectilinear volume data using distance transforms",
//! IEEE TVCG 6(3) (2000): with n the chessboard distance to the nearest full cell, the cube of
//! cells up to n - 1 away along every axis is empty, and a ray may leave it at once.
//!
//! The distances take no memory. A slot is the offset of its cell's list, which ends where the next
//! one begins. An empty cell's slot is needed as that end only when the cell before it, in the
//! order of slots, is full; then, in the same row, its distance is 1 anyway. All other empty cells
//! hold their distance, as a number at the far end of the range.

use super::index;
use crate::accel::Id;

/// Greater distances are taken for this one.
const FARTHEST: usize = 255;

/// The greatest offset that is no distance.
pub(super) const fn most_offset<O: Id>() -> usize {
    O::MAX - FARTHEST - 1
}

/// What is known of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    /// From where to where its list goes; not empty.
    List(usize, usize),
    /// Empty, and every cell less far away along all axes is, too. At least 1.
    Empty(usize),
}

/// What a slot and the next one say.
pub(super) fn slot<O: Id>(slots: &[O], cell: usize) -> Slot {
    slots.split_first().map_or(Slot::Empty(1), |(_, ends)| between(slots, ends, cell))
}

/// The same, for the slots and those but the first.
#[inline(always)]
pub(super) fn between<O: Id>(slots: &[O], ends: &[O], cell: usize) -> Slot {
    let (Some(to), Some(from)) = (ends.get(cell), slots.get(cell)) else { return Slot::Empty(1) };
    let (from, to) = (from.get(), to.get());
    // Most often, so asked first.
    if from < to && to <= most_offset::<O>() {
        Slot::List(from, to)
    } else if from > most_offset::<O>() {
        Slot::Empty(O::MAX - from)
    } else {
        Slot::Empty(1)
    }
}

/// What the slot of a cell says where it is no end of another's list: its distance, if it is empty.
pub(super) fn alone<O: Id>(slots: &[O], cell: usize) -> Option<usize> {
    let from = slots.get(cell).map_or(O::MAX, |slot| slot.get());
    (from > most_offset::<O>()).then(|| O::MAX - from)
}

/// The distance of a cell, 0 if it is full.
fn distance<O: Id, const SHARED: bool>(slots: &[O], cell: usize) -> usize {
    if SHARED {
        return alone(slots, cell).unwrap_or(0);
    }
    match slot(slots, cell) {
        Slot::List(..) => 0,
        Slot::Empty(distance) => distance,
    }
}

/// Writes distances into the slots of empty cells, as far as they are free.
///
/// Two passes over all cells, each taking the least distance of the 13 neighbours on one side, plus
/// 1: A. Rosenfeld, J. L. Pfaltz, "Distance functions on digital pictures", Pattern Recognition 1
/// (1968). Exact for the chessboard distance.
pub(super) fn mark<O: Id, const SHARED: bool>(slots: &mut [O], count: [i32; 3]) {
    let mut is_end = false;
    for cell in 0..slots.len().saturating_sub(1) {
        let full = distance::<O, SHARED>(slots, cell) == 0;
        if !full && (SHARED || !is_end) {
            set(slots, cell, FARTHEST);
        }
        is_end = full;
    }
    let [nx, ny, nz] = count;
    let cells = |n: i32| 0..n;
    for z in cells(nz) {
        for y in cells(ny) {
            for x in cells(nx) {
                relax::<O, SHARED>(slots, count, [x, y, z], -1);
            }
        }
    }
    for z in cells(nz).rev() {
        for y in cells(ny).rev() {
            for x in cells(nx).rev() {
                relax::<O, SHARED>(slots, count, [x, y, z], 1);
            }
        }
    }
}

pub(super) fn set<O: Id>(slots: &mut [O], cell: usize, distance: usize) {
    if let Some(slot) = slots.get_mut(cell) {
        *slot = O::new(O::MAX - distance);
    }
}

/// Takes over what the neighbours before (-1) or after (1) a cell know. Beyond the grid all is
/// empty.
fn relax<O: Id, const SHARED: bool>(
    slots: &mut [O],
    count: [i32; 3],
    [x, y, z]: [i32; 3],
    side: i32,
) {
    let [nx, ny, nz] = count;
    let here = index(count, x, y, z);
    let known = distance::<O, SHARED>(slots, here);
    if known <= 1 {
        return;
    }
    let mut least = known;
    // The neighbours on that side: all nine in the next layer, three in the next row of this one,
    // and the next cell of this row.
    for (dz, dy, from) in [(1, -1, -1), (1, 0, -1), (1, 1, -1), (0, 1, -1), (0, 0, 1)] {
        let (y, z) = (y + side * dy, z + side * dz);
        if y < 0 || y >= ny || z < 0 || z >= nz {
            continue;
        }
        for dx in from..=1 {
            let x = x + side * dx;
            if x >= 0 && x < nx {
                least = least.min(distance::<O, SHARED>(slots, index(count, x, y, z)) + 1);
            }
        }
    }
    if least < known {
        set(slots, here, least);
    }
}
