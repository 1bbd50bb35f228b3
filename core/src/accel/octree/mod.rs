//! The octree.
//!
//! A. Glassner, "Space subdivision for fast ray tracing", IEEE CG&A 4(10) (1984): cells are halved
//! along all three axes until they list few shapes, and a ray is tested against the lists of the
//! leaves that it passes, in order.
//!
//! How cells are stored and how a ray gets from leaf to leaf are chosen independently:
//! * [`Storage`]: [`Links`], where a divided cell's word says where its children are, [`Hashed`], where
//!   they are found by name, as Glassner's, or [`Implicit`], where their order tells;
//! * [`Walk`]: from the root every time, as Glassner's, or by one of the later ways. The octree's
//!   own [`Accel::walk`](super::Accel::walk) is [`Walk::Descent`]; [`Octree::by`] takes another.

mod any;
mod benefit;
mod build;
mod code;
mod cursor;
mod footprint;
mod gaps;
mod growth;
mod implicit;
mod storage;
mod walk;

pub use any::{AnyOctree, Settings, Store};
pub use code::DEEPEST;
pub use growth::{Growth, Limits, Lists, Order, StoppedBy};
pub use implicit::Implicit;
pub use storage::{Content, Hashed, Links, Storage};
pub use walk::{By, Walk};

use super::Id;
use super::lattice::Lattice;
use super::listing::Aside;
use crate::num::Real;

/// An octree. `I` stores ids of shapes, `C` the cells: the words of 2 bytes that are meant when
/// nothing is said number 32,767 list entries.
#[derive(Debug)]
pub struct Octree<'m, R: Real, I, C = Links<'m, u16>> {
    lattice: Lattice<R>,
    deepest: u32,
    max_level: u32,
    stopped_by: StoppedBy,
    cells: C,
    lists: &'m [I],
    aside: Aside<I>,
}

/// The list at a place, counted from the end of all lists.
fn list_at<I: Id>(lists: &[I], place: usize) -> &[I] {
    let start = lists.len().checked_sub(place).and_then(|start| lists.get(start..));
    match start.and_then(<[I]>::split_first) {
        Some((count, ids)) => ids.get(..count.get()).unwrap_or_default(),
        None => &[],
    }
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Octree<'m, R, I, C> {
    /// Why the division ended.
    pub fn stopped_by(&self) -> StoppedBy {
        self.stopped_by
    }

    /// Number of divided cells.
    pub fn interior_nodes(&self) -> usize {
        self.cells.count()
    }

    /// Number of shapes kept beside it.
    pub fn aside(&self) -> usize {
        self.aside.count()
    }

    /// The level of the deepest leaf.
    pub fn max_level(&self) -> u32 {
        self.max_level
    }

    /// The lists of all leaves, empty ones included, in the order in which they came to be.
    pub fn leaves(&self) -> impl Iterator<Item = &'m [I]> + use<'_, 'm, R, I, C> {
        let families = (0..self.cells.count()).filter_map(|number| self.cells.family(number));
        let children =
            families.flat_map(|family| (0..8).map(move |octant| C::child(family, octant)));
        core::iter::once(self.cells.root()).chain(children).filter_map(|cell| {
            match C::content(cell) {
                Content::List(place) => Some(list_at(self.lists, place)),
                Content::Family(_) => None,
            }
        })
    }

    /// Bytes that leaves would take more if each had a list of its own.
    pub fn shared_bytes(&self) -> usize {
        let entries = |list: &[I]| list.len() + usize::from(!list.is_empty());
        let all: usize = self.leaves().map(entries).sum();
        (all - self.lists.len()) * size_of::<I>()
    }

    /// The place of a leaf's list, and the list; nothing for a divided cell.
    fn list(&self, cell: C::Cell) -> (usize, &'m [I]) {
        match C::content(cell) {
            Content::List(place) => (place, list_at(self.lists, place)),
            Content::Family(_) => (0, &[]),
        }
    }
}
