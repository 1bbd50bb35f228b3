//! The octree in Glassner's storage.
//!
//! A. Glassner, "Space subdivision for fast ray tracing", IEEE CG&A 4(10) (1984). Cells have names,
//! and names are found in a hash table; there are no pointers. To go on from a cell, the ray's exit
//! is computed and the cell behind it is located again from the root.
//!
//! Only divided cells stand in the table: the eight children of a cell lie together as a `Family`
//! under their parent's name. The ray's place is held in whole numbers, counted in cells of the
//! deepest level: leaving through a face sets one of them to exactly the neighbour's side and keeps
//! the others within the cell just left. No point is nudged, so no cell is skipped or met twice,
//! and the walk ends after at most three times as many steps as there are cells along an axis.

mod build;
mod code;

pub use build::{Limits, StoppedBy};
pub use code::DEEPEST;

use super::lattice::Lattice;
use super::{Accel, Id, Visitor};
use crate::geom::{Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;
use code::Code;

/// The children of a divided cell: its name, and a word for each child.
type Family = [u32; 9];

/// What a cell is: [`DIVIDED`], or the place of its list, counted from the end of all lists; 0 when
/// it lists nothing. A list is its length, then its ids in ascending order.
type Word = u32;

/// Divided further; its children are found in the table.
const DIVIDED: Word = 1 << 31;

/// Slots of the table for so many families: a third of them stays free, which keeps the chains of
/// probes short.
fn slots_for(families: usize) -> usize {
    families + families / 2 + usize::from(families > 0)
}

/// Where a name's search in a table begins: multiplication by the golden ratio spreads names that
/// differ in few digits (D. Knuth, The Art of Computer Programming 3, 6.4).
fn home(code: Code, slots: usize) -> usize {
    let hash = code.0.wrapping_mul(0x9e37_79b9);
    ((u64::from(hash) * slots as u64) >> 32) as usize
}

/// An octree. `I` stores ids of shapes.
#[derive(Debug)]
pub struct Octree<'m, R: Real, I> {
    lattice: Lattice<R>,
    deepest: u32,
    stopped_by: StoppedBy,
    root: Word,
    families: &'m [Family],
    /// Open addressing: number of a family plus 1, or 0.
    table: &'m [u32],
    lists: &'m [I],
}

impl<'m, R: Real, I: Id> Octree<'m, R, I> {
    /// Why the division ended.
    pub fn stopped_by(&self) -> StoppedBy {
        self.stopped_by
    }

    /// Number of divided cells.
    pub fn interior_nodes(&self) -> usize {
        self.families.len()
    }

    /// The lists of all leaves, empty ones included, in the order in which they came to be.
    pub fn leaves(&self) -> impl Iterator<Item = &'m [I]> {
        let words = self.families.iter().flat_map(|family| family.iter().skip(1).copied());
        core::iter::once(self.root)
            .chain(words)
            .filter(|word| *word != DIVIDED)
            .map(|word| self.list(word))
    }

    /// The level of the deepest leaf.
    pub fn max_level(&self) -> u32 {
        self.families.last().map_or(0, |family| Code(family[0]).level() + 1)
    }

    fn list(&self, word: Word) -> &'m [I] {
        let from_end = |places: usize| self.lists.len().checked_sub(places);
        let start = from_end(word as usize).and_then(|start| self.lists.get(start..));
        match start.and_then(<[I]>::split_first) {
            Some((count, ids)) => ids.get(..count.get()).unwrap_or_default(),
            None => &[],
        }
    }

    /// The children of a divided cell.
    fn family(&self, code: Code) -> Option<&'m Family> {
        let slots = self.table.len();
        let mut slot = home(code, slots);
        for _ in 0..slots {
            let number = *self.table.get(slot)?;
            let family = self.families.get((number as usize).checked_sub(1)?)?;
            if family[0] == code.0 {
                return Some(family);
            }
            slot = if slot + 1 == slots { 0 } else { slot + 1 };
        }
        None
    }

    /// The leaf that contains a cell of the deepest level: its word and the logarithm of its edge.
    fn locate(&self, [x, y, z]: [i32; 3], probe: &mut impl Probe) -> (Word, u32) {
        probe.step();
        let (mut code, mut word, mut shift) = (Code::ROOT, self.root, self.deepest);
        while word == DIVIDED && shift > 0 {
            let Some(family) = self.family(code) else { break };
            shift -= 1;
            let bit = |c: i32| (c >> shift) as u32 & 1;
            let octant = bit(x) | bit(y) << 1 | bit(z) << 2;
            code = code.child(octant);
            word = family.get(1 + octant as usize).copied().unwrap_or(0);
            probe.step();
        }
        (word, shift)
    }
}

impl<R: Real, I: Id> Accel<R> for Octree<'_, R, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let slopes = Slopes::of(ray);
        let Some((enter, _)) = self.lattice.clip(&slopes, visitor.start(), visitor.limit()) else {
            return;
        };
        let [x, y, z] = self.lattice.tracks(ray, &slopes);
        let mut cell = self.lattice.cell_of(ray.at(enter));
        let mut t = enter;
        let edge = 1 << self.deepest;
        for _ in 0..3 * edge {
            let (word, shift) = self.locate(cell, visitor.probe());
            let list = self.list(word);
            visitor.probe().leaf(list.is_empty());
            if !list.is_empty() {
                visitor.visit(list.iter().map(|id| id.get()));
            }

            // The leaf, and the first of its walls that the ray meets.
            let size = 1 << shift;
            let [bx, by, bz] = cell.map(|c| c >> shift << shift);
            let (tx, ty, tz) = (x.exit(bx, size), y.exit(by, size), z.exit(bz, size));
            let exit = if tx <= ty && tx <= tz {
                tx
            } else if ty <= tz {
                ty
            } else {
                tz
            };
            // Rounding may put a wall a little before the one just passed; never go back.
            t = t.max(exit);
            if visitor.limit() <= t {
                return;
            }

            // Exactly one cell beyond that wall, and within the leaf in the other directions.
            let [px, py, pz] = self.lattice.cell_of(ray.at(t));
            let within = |p: i32, base: i32| p.max(base).min(base + size - 1);
            let beyond = |sign: i32, base: i32| if sign > 0 { base + size } else { base - 1 };
            cell = [within(px, bx), within(py, by), within(pz, bz)];
            let [cx, cy, cz] = &mut cell;
            let (c, sign, base) = if tx <= ty && tx <= tz {
                (cx, x.sign, bx)
            } else if ty <= tz {
                (cy, y.sign, by)
            } else {
                (cz, z.sign, bz)
            };
            *c = beyond(sign, base);
            if sign == 0 || *c < 0 || *c >= edge {
                return;
            }
        }
    }
}
