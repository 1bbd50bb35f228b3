//! Which shapes a structure lists, and which it keeps beside.

use super::{Id, Visitor};
use crate::geom::Aabb;
use crate::num::{Real, Vector};
use crate::scene::{Scene, Shapes};
use heapless::Vec;

/// What is done with shapes much larger than the others.
///
/// A floor under a model makes the box of the scene much larger than that of the model: a structure
/// that divides this box into equal parts spends them on nothing (the teapot in the stadium).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Huge {
    /// They are listed like the others.
    #[default]
    Inside,
    /// Up to [`MOST_ASIDE`] of them are kept beside the structure, which is built in the box of what
    /// remains, and every ray is tested against them first: as many of the largest as halve the
    /// surface of the box once each.
    Aside,
}

/// When a shape is listed in a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlap {
    /// When its box touches the cell.
    #[default]
    Box,
    /// When its surface may pass through the cell: fewer entries, for some work while building.
    /// Where that is told roughly, as around cylinders and cones, some are left that need not be.
    Exact,
}

/// How the lists of a structure are made: a type, so that a program that is content with the plain
/// way has no code for the others.
pub trait Listing: Copy + core::fmt::Debug + Default {
    /// When a shape is listed in a cell.
    fn overlap(self) -> Overlap;

    /// Whether leaves of an octree with equal lists share one.
    fn shares(self) -> bool {
        false
    }
}

/// The plain way: a shape is listed where its box touches the cell, and every cell has its own list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ByBox;

impl Listing for ByBox {
    fn overlap(self) -> Overlap {
        Overlap::Box
    }
}

impl Listing for Overlap {
    fn overlap(self) -> Overlap {
        self
    }
}

/// Shapes that are kept beside a structure, at most.
pub const MOST_ASIDE: usize = 6;

/// The shapes that are kept beside a structure. They are picked as `u32`, whatever numbers the
/// structure is stored in: so there is one code for all of them.
#[derive(Clone, Debug)]
pub(crate) struct Aside<I = u32> {
    ids: Vec<I, MOST_ASIDE>,
}

impl Aside {
    /// Picks them; and the box of all other bounded shapes. Time in proportion to the number of
    /// shapes.
    pub(crate) fn of<R: Real, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        huge: Huge,
    ) -> (Self, Aabb<R>) {
        let shapes = scene.shapes();
        if huge == Huge::Inside || shapes.bounded() <= MOST_ASIDE {
            return (Self { ids: Vec::new() }, scene.bounds());
        }
        let area = |bounds: Aabb<R>| {
            let [x, y, z] = bounds.size().to_array();
            x * y + y * z + z * x
        };
        // The largest ones, in descending order; of equal ones the first.
        let mut largest: Vec<(R, u32), MOST_ASIDE> = Vec::new();
        for id in 0..shapes.bounded() {
            let size = area(shapes.bounds(id));
            if largest.is_full() && largest.last().is_some_and(|(last, _)| size > *last) {
                largest.pop();
            }
            let place = largest.partition_point(|(other, _)| *other >= size);
            // Refused when it is not among the largest.
            let _ = largest.insert(place, (size, u32::new(id)));
        }
        let is_among = |ids: &[(R, u32)], id: usize| ids.iter().any(|(_, i)| i.get() == id);
        let others = (0..shapes.bounded()).filter(|id| !is_among(&largest, *id));
        let mut rest = others.fold(Aabb::empty(), |b: Aabb<R>, id| b.union(shapes.bounds(id)));

        // Puts the smallest of them back one by one, as long as keeping them aside does not pay.
        let all = area(scene.bounds());
        while let Some((_, last)) = largest.last() {
            let halved = (0..largest.len()).fold(area(rest), |area, _| area + area);
            if halved < all {
                break;
            }
            rest = rest.union(shapes.bounds(last.get()));
            largest.pop();
        }
        let mut ids = Vec::new();
        for (_, id) in &largest {
            // Never refused: both have the same room.
            let _ = ids.push(*id);
        }
        (Self { ids }, rest)
    }

    /// In the numbers of a structure.
    pub(crate) fn stored<I: Id>(&self) -> Aside<I> {
        let mut ids = Vec::new();
        for id in &self.ids {
            // Never refused: there is room for as many. `collect` could panic.
            let _ = ids.push(I::new(id.get()));
        }
        Aside { ids }
    }
}

impl<I: Id> Aside<I> {
    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.ids.len()
    }

    /// Whether a shape is one of them.
    pub(crate) fn contains(&self, id: usize) -> bool {
        self.ids.iter().any(|aside| aside.get() == id)
    }

    /// They.
    pub(crate) fn ids(&self) -> &[I] {
        &self.ids
    }

    /// Has a ray tested against them.
    pub(crate) fn visit<R: Real, V: Visitor<R>>(&self, visitor: &mut V) {
        visit(&self.ids, visitor);
    }
}

/// Places of a hash table that are looked at for a list.
const PROBES: usize = 8;

/// The places, of so many, at which a list is looked for among those that are there already.
pub(crate) fn probes<I: Id>(list: &[I], places: usize) -> impl Iterator<Item = usize> {
    // FNV-1a, a number at a time, and the golden ratio to spread what is left.
    let hash = list
        .iter()
        .fold(0x811c_9dc5_u32, |hash, id| (hash ^ id.get() as u32).wrapping_mul(0x0100_0193));
    let home = (u64::from(hash.wrapping_mul(0x9e37_79b9)) * places as u64) >> u32::BITS;
    (home as usize..places).chain(0..places).take(PROBES)
}

/// Whether two lists are of the same shapes.
pub(crate) fn is_equal<I: Id>(a: &[I], b: &[I]) -> bool {
    a.iter().map(|id| id.get()).eq(b.iter().map(|id| id.get()))
}

/// Has a ray tested against the shapes of a list.
pub(crate) fn visit<R: Real, I: Id, V: Visitor<R>>(list: &[I], visitor: &mut V) {
    if !list.is_empty() {
        visitor.visit(list.iter().map(|id| id.get()));
    }
}
