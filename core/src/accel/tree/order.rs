//! In which order shapes are inserted.

use super::sah::swap;
use crate::accel::{BuildError, Id};
use crate::memory::{Arena, Footprint};
use crate::num::{Real, Vector};
use crate::scene::{Scene, Shapes};

/// In which order shapes are inserted. What is best depends on the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// As their ids are.
    File,
    /// All mixed up, as Goldsmith and Salmon advise; another number gives another order.
    Shuffled(u32),
    /// Along a curve that fills space: D. Hilbert, "Über die stetige Abbildung einer Linie auf ein
    /// Flächenstück", Math. Annalen 38 (1891). Takes scratch for a list of the shapes.
    Curve,
}

impl Default for Insertion {
    fn default() -> Self {
        Self::Shuffled(0)
    }
}

/// Calls `act` for every bounded shape once.
pub(super) fn each<R: Real, S: Shapes<R>, I: Id>(
    scene: &Scene<'_, R, S>,
    insertion: Insertion,
    arena: &mut Arena<'_>,
    mut act: impl FnMut(usize),
) -> Result<(), BuildError> {
    let shapes = scene.shapes().bounded();
    match insertion {
        Insertion::File => (0..shapes).for_each(act),
        Insertion::Shuffled(seed) => {
            // A permutation of the next power of two, of which what is too large is left out.
            let all = shapes.next_power_of_two() as u32;
            let mixed = (0..all).map(|i| mix(i, all - 1, seed) as usize);
            mixed.filter(|id| *id < shapes).for_each(act);
        }
        Insertion::Curve => {
            arena.require(Footprint::of::<I>(shapes))?;
            let mut ends = arena.scratch::<I, u8>();
            // Cannot fail: it has just been asked for.
            let _ = ends.grow(shapes, 0, 0);
            let (ids, _) = ends.both();
            for (id, place) in ids.iter_mut().enumerate() {
                *place = I::new(id);
            }
            sort(ids, |id| (curve_place(scene, id.get()), id.get()));
            ids.iter().for_each(|id| act(id.get()));
        }
    }
    Ok(())
}

/// Sorts a list in place: J. W. J. Williams, "Algorithm 232: Heapsort", CACM 7(6), 1964. The one that
/// comes with the language may panic.
fn sort<T: Copy, K: PartialOrd>(list: &mut [T], key: impl Fn(T) -> K) {
    let greater = |list: &[T], a: usize, b: usize| match (list.get(a), list.get(b)) {
        (Some(a), Some(b)) => key(*a) > key(*b),
        _ => false,
    };
    let sink = |list: &mut [T], from: usize| {
        let mut at = from;
        for _ in 0..usize::BITS {
            let (left, right) = (2 * at + 1, 2 * at + 2);
            let largest = if greater(list, right, left) { right } else { left };
            if !greater(list, largest, at) {
                break;
            }
            swap(list, at, largest);
            at = largest;
        }
    };
    (0..list.len() / 2).rev().for_each(|from| sink(list, from));
    for last in (1..list.len()).rev() {
        swap(list, 0, last);
        sink(list.get_mut(..last).unwrap_or_default(), 0);
    }
}

/// Mixes the numbers up to `mask`, all bits of which are 1; each step can be undone.
fn mix(i: u32, mask: u32, seed: u32) -> u32 {
    let half = mask.count_ones().div_ceil(2);
    let mut x = i;
    for round in 0..4_u32 {
        x = x.wrapping_add(seed.wrapping_add(round).wrapping_mul(0x9e37_79b9)) & mask;
        x = x.wrapping_mul(0x85eb_ca6b) & mask;
        x ^= x >> half;
    }
    x
}

/// Digits of a place on the curve along each axis.
const DIGITS: u32 = 10;

/// How far along the curve the middle of a shape's box lies.
fn curve_place<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, id: usize) -> u32 {
    let (all, own) = (scene.bounds(), scene.shapes().bounds(id));
    let from = (own.lo - all.lo) * R::HALF + (own.hi - all.lo) * R::HALF;
    let size = all.size().max_abs();
    let most = (1 << DIGITS) - 1;
    hilbert(from.to_array().map(|x| x.proportion(size, most).max(0).min(most) as u32))
}

/// The place of a cell on Hilbert's curve: J. Skilling, "Programming the Hilbert curve", AIP
/// Conference Proceedings 707 (2004).
fn hilbert(cell: [u32; 3]) -> u32 {
    let [mut x, mut y, mut z] = cell;
    for digit in (1..DIGITS).rev() {
        let (bit, low) = (1 << digit, (1 << digit) - 1);
        if x & bit != 0 {
            x ^= low;
        }
        for other in [&mut y, &mut z] {
            if *other & bit != 0 {
                x ^= low;
            } else {
                let change = (x ^ *other) & low;
                x ^= change;
                *other ^= change;
            }
        }
    }
    y ^= x;
    z ^= y;
    let turns = (1..DIGITS).filter(|digit| z & 1 << digit != 0);
    let turn = turns.fold(0, |turn, digit| turn ^ ((1 << digit) - 1));
    let (x, y, z) = (x ^ turn, y ^ turn, z ^ turn);
    let place = |place: u32, digit: u32| {
        let bit = |v: u32| v >> digit & 1;
        place << 3 | bit(x) << 2 | bit(y) << 1 | bit(z)
    };
    (0..DIGITS).rev().fold(0, place)
}

#[cfg(test)]
mod tests {
    use super::*;

    extern crate std;
    use std::vec::Vec;

    #[test]
    fn mixing_is_a_permutation() {
        for bits in 0..12 {
            for seed in [0, 1, 77] {
                let mask = (1 << bits) - 1;
                let mut seen: Vec<u32> = (0..=mask).map(|i| mix(i, mask, seed)).collect();
                seen.sort_unstable();
                assert!(seen.into_iter().eq(0..=mask), "{bits} bits, seed {seed}");
            }
        }
    }

    #[test]
    fn sorting_sorts() {
        for count in 0..70_u32 {
            let mut list: Vec<u32> =
                (0..count).map(|i| i.wrapping_mul(0x9e37_79b9) >> 27).collect();
            let mut expected = list.clone();
            expected.sort_unstable();
            sort(&mut list, |n| n);
            assert_eq!(list, expected);
        }
    }

    #[test]
    fn the_curve_goes_from_cell_to_neighbour() {
        // The first cells of the curve fill a cube of edge 16, each next to the one before.
        let mut cells = Vec::new();
        for x in 0..16 {
            for y in 0..16 {
                for z in 0..16 {
                    cells.push((hilbert([x, y, z]), [x, y, z]));
                }
            }
        }
        cells.sort_unstable();
        assert_eq!(cells.last().unwrap().0, 16 * 16 * 16 - 1);
        for pair in cells.windows(2) {
            let off = |a: u32| pair[0].1[a as usize].abs_diff(pair[1].1[a as usize]);
            assert_eq!(off(0) + off(1) + off(2), 1, "{pair:?}");
        }
    }
}
