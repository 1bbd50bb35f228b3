//! The uniform grid, walked by a 3D DDA.
//!
//! A. Fujimoto, T. Tanaka, K. Iwata, "ARTS: accelerated ray-tracing system", IEEE CG&A 6(4) (1986);
//! J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987.
//! Lists as one array of references and one of offsets, built by counting: A. Lagae, P. Dutré,
//! "Compact, fast and robust grids for ray tracing", EGSR 2008.
//!
//! Cells with equal lists may share one: a cell then knows where its list begins, and a list how long
//! it is.
//!
//! Instead of adding a cell's width to the parameter of the next wall, the parameter is computed
//! from the wall's number: one multiplication more, and wrong cells become 15 to 50 times rarer.

mod build;
mod distance;
mod share;
mod walk;

pub use build::{resolution_for, size, suits};

use super::lattice::Lattice;
use super::listing::Aside;
use super::{ByBox, Huge, Id, Listing};
use crate::memory::Footprint;
use crate::num::Real;
use distance::Slot;

/// A grid. `I` stores ids of shapes, `O` offsets into the lists; `SHARED` says whether cells with equal
/// lists share one: a type, so that a program that does without has no code for it.
#[derive(Debug)]
pub struct Grid<'m, R: Real, I, O, const SHARED: bool = false> {
    lattice: Lattice<R>,
    /// Where the list of each cell begins, and where the last one ends, or how far it is to the
    /// next list: [`Slot`].
    slots: &'m [O],
    references: &'m [I],
    aside: Aside<I>,
}

/// All that is chosen about a grid. A resolution alone means: everything is listed, by its box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings<L = ByBox> {
    /// Cells along each axis.
    pub resolution: [u32; 3],
    /// What is done with shapes much larger than the others.
    pub huge: Huge,
    /// When a shape is listed in a cell: [`ByBox`], or an [`Overlap`](super::Overlap) where that is
    /// not known when the program is compiled.
    pub overlap: L,
    /// Whether empty cells know how far it is to the next that is not: takes no memory, but time
    /// while building.
    pub macro_cells: bool,
    /// Whether [`Any`](super::Any) shares equal lists, which it can with the feature `switches`. How much that saves is not known beforehand: a
    /// size is then what a build cannot exceed. See [`mailbox::Lists`](super::mailbox::Lists).
    pub shared: bool,
}

impl<L: Listing> Settings<L> {
    /// Everything is listed, in the default way; no distances.
    pub fn new(resolution: [u32; 3]) -> Self {
        let (huge, overlap) = (Huge::Inside, L::default());
        Self { resolution, huge, overlap, macro_cells: false, shared: false }
    }
}

impl From<[u32; 3]> for Settings {
    fn from(resolution: [u32; 3]) -> Self {
        Self::new(resolution)
    }
}

/// How large a grid of a resolution is: made by counting, before building.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Cells, or the greatest number there is if they do not fit the address space.
    pub cells: usize,
    /// Entries of all lists; where they are shared, their lengths included, as many as there can be.
    pub references: usize,
}

impl Size {
    /// Whether offsets of this type reach all entries.
    pub fn fits<O: Id>(&self) -> bool {
        self.references <= distance::most_offset::<O>()
    }

    /// Bytes of a grid of this size; building needs no more.
    pub fn footprint<I: Id, O: Id>(&self) -> Footprint {
        let offsets = Footprint::of::<O>(self.cells.saturating_add(1));
        offsets.then(Footprint::of::<I>(self.references))
    }

    /// The size with shared lists, which begin with their length, before any is found equal.
    #[must_use]
    pub fn shared(self) -> Self {
        let full = self.cells.min(self.references);
        Self { references: self.references.saturating_add(full), ..self }
    }
}

impl<'m, R: Real, I: Id, O: Id, const SHARED: bool> Grid<'m, R, I, O, SHARED> {
    /// Cells along each axis.
    pub fn resolution(&self) -> [u32; 3] {
        self.lattice.count().map(|n| n as u32)
    }

    /// Number of shapes kept beside it.
    pub fn aside(&self) -> usize {
        self.aside.count()
    }

    /// The lists of all cells, x running fastest.
    pub fn lists(&self) -> impl Iterator<Item = &'m [I]> {
        let Self { slots, references, .. } = *self;
        (0..slots.len().saturating_sub(1)).map(move |cell| {
            match slot_of::<I, O, SHARED>(slots, references, cell) {
                Slot::List(from, to) => references.get(from..to).unwrap_or_default(),
                Slot::Empty(_) => &[],
            }
        })
    }

    /// Bytes that lists would take more if every cell had its own; below 0 where nearly all differ, as
    /// shared ones begin with their length.
    pub fn shared_bytes(&self) -> isize {
        let all: usize = self.lists().map(<[I]>::len).sum();
        (all as isize - self.references.len() as isize) * size_of::<I>() as isize
    }
}

/// What is known of a cell.
#[inline(always)]
fn slot_of<I: Id, O: Id, const SHARED: bool>(slots: &[O], references: &[I], cell: usize) -> Slot {
    if SHARED { share::slot(slots, references, cell) } else { distance::slot(slots, cell) }
}

/// The number of a cell.
fn index([nx, ny, _]: [i32; 3], x: i32, y: i32, z: i32) -> usize {
    (z as usize * ny as usize + y as usize) * nx as usize + x as usize
}
