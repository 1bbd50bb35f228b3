//! The bounding volume hierarchy: boxes in boxes, eight to a node, made for little memory.
//!
//! T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986; cut by surface area (see
//! `split`), wide and compressed (see `node`). A shape is in one leaf only, so there is nothing for
//! a mailbox to do.
//!
//! | part | bytes |
//! |---|---|
//! | nodes | 64 each |
//! | links | 4 a node with up to 65,535 shapes, 8 beyond |
//! | ids | 2 a shape, 4 beyond |
//!
//! With a node for every 10 shapes that is 8.8 bytes a shape (11.2), while building too; with one
//! for every 30, 4.3 (6.4).
//!
//! A subtree is passed over only if the ray enters its box beyond the limit, and never for a tie.
//! Boxes are those of the shapes grown by [`Scene::pad`](crate::scene::Scene::pad) and rounded
//! outwards in whole numbers. Half of the pad is what a shape may claim outside its box. The
//! parameters of sides carry the rounding errors of two products and three sums of coordinates up
//! to six times the scene's greatest: 21 units in its last place, and 3 more when boxes are brought
//! to whole numbers; the other half of the pad is 32.

mod build;
mod narrow;
mod node;
mod size;
mod split;
mod stack;
mod units;
mod wide;

pub use size::{footprint, nodes_within};

use super::{Accel, Id, Visitor};
use crate::geom::Ray;
use crate::num::{FOURS, Real};
use crate::probe::Probe;
use core::ops::Range;
use node::{Node, ids_of, leaves_of};
use units::Units;

/// Nodes from the root to any leaf at most: three more than the greatest number of shapes takes
/// when they are dealt out equally.
const LEVELS: usize = 14;

/// A hierarchy. `I` stores ids of shapes and numbers of nodes.
#[derive(Debug)]
pub struct Bvh<'m, R: Real, I> {
    units: Units<R>,
    levels: usize,
    /// Whether rays are expected to differ from one another.
    incoherent: bool,
    nodes: &'m [Node],
    /// For each node where its ids begin, and the number of its first child that is a node plus
    /// [`WIDTH`](node::WIDTH) less the number of its leaves.
    links: &'m [[I; 2]],
    /// Those of a leaf lie together.
    ids: &'m [I],
}

/// How the children of a node are looked at.
#[derive(Clone, Copy)]
enum Way {
    /// One after the other.
    Narrow,
    /// Side by side; those that are met are found by looking at all places.
    Wide,
    /// Side by side; those that are met are jumped to.
    WideJumping,
}

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
    /// The same hierarchy for rays that differ from one another, as those between random points do:
    /// the hits are the same. On x86-64 to the nearest hit takes such rays some 10 % less time, and
    /// rays like those before them, as through neighbouring pixels, some 15 % more.
    #[must_use]
    pub fn for_incoherent_rays(&self) -> Self {
        Self { incoherent: true, ..*self }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Nodes on the longest way from the root to a leaf.
    pub fn levels(&self) -> usize {
        self.levels
    }

    /// The lists of all leaves; none is empty.
    pub fn leaves(&self) -> impl Iterator<Item = &'m [I]> {
        self.nodes.iter().zip(self.links).flat_map(|(node, [first, _])| {
            (0..leaves_of(node)).map(|place| self.list(*first, ids_of(node, place)))
        })
    }

    /// Ids, counted from where those of their node begin.
    #[inline(always)]
    fn list(&self, first: I, ids: Range<usize>) -> &'m [I] {
        let first = first.get();
        self.ids.get(first + ids.start..first + ids.end).unwrap_or_default()
    }

    #[inline(always)]
    fn walk_as<V: Visitor<R>>(&self, way: Way, ray: &Ray<R>, visitor: &mut V) {
        match (way, V::STOPS) {
            (Way::Narrow, false) => self.to_nearest_narrow(ray, visitor),
            (Way::Narrow, true) => self.to_any_narrow(ray, visitor),
            (Way::Wide, false) => self.to_nearest_wide::<false, V>(ray, visitor),
            (Way::WideJumping, false) => self.to_nearest_wide::<true, V>(ray, visitor),
            (Way::Wide | Way::WideJumping, true) => self.to_any_wide(ray, visitor),
        }
    }
}

impl<R: Real, I: Id> Accel<R> for Bvh<'_, R, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let way = match (FOURS, self.incoherent) {
            (false, _) => Way::Narrow,
            (true, false) => Way::Wide,
            (true, true) => Way::WideJumping,
        };
        self.walk_as(way, ray, visitor);
    }
}

/// Hands over the shapes of a leaf.
#[inline(always)]
fn visit<R: Real, I: Id>(list: &[I], visitor: &mut impl Visitor<R>) {
    visitor.probe().leaf(list.is_empty());
    visitor.visit(list.iter().map(|id| id.get()));
}

#[cfg(test)]
mod tests;
