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
mod node;
mod size;
mod split;
mod stack;
mod units;

pub use size::{footprint, nodes_within};

use super::{Accel, Id, Visitor};
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;
use node::{Node, WIDTH, hits, ids_of};
use stack::{Pending, Stack};
use units::Units;

/// Nodes from the root to any leaf at most: three more than the greatest number of shapes takes
/// when they are dealt out equally.
const LEVELS: usize = 14;

/// A hierarchy. `I` stores ids of shapes and numbers of nodes.
#[derive(Debug)]
pub struct Bvh<'m, R: Real, I> {
    units: Units<R>,
    levels: usize,
    nodes: &'m [Node],
    /// For each node where its ids begin, and the number of its first child that is a node plus
    /// [`WIDTH`] less the number of its leaves.
    links: &'m [[I; 2]],
    /// Those of a leaf lie together.
    ids: &'m [I],
}

/// A child of a node.
enum Child<'m, I> {
    Leaf(&'m [I]),
    Node(usize),
}

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
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
        (0..self.nodes.len() * WIDTH).filter_map(|child| match self.child(child as u32) {
            Child::Leaf(list) => Some(list),
            Child::Node(_) => None,
        })
    }

    /// The child with a number: that of its node times [`WIDTH`] plus its place there.
    #[inline(always)]
    fn child(&self, number: u32) -> Child<'m, I> {
        let (node, place) = (number as usize / WIDTH, number as usize % WIDTH);
        let (Some(node), Some([first, next])) = (self.nodes.get(node), self.links.get(node)) else {
            return Child::Leaf(&[]);
        };
        let (begin, end) = ids_of(node, place);
        if begin < end {
            let first = first.get();
            Child::Leaf(self.ids.get(first + begin..first + end).unwrap_or_default())
        } else {
            Child::Node((next.get() + place).wrapping_sub(WIDTH))
        }
    }
}

impl<R: Real, I: Id> Accel<R> for Bvh<'_, R, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        if V::STOPS { self.to_any(ray, visitor) } else { self.to_nearest(ray, visitor) }
    }
}

impl<R: Real, I: Id> Bvh<'_, R, I> {
    /// From near to far.
    #[inline(always)]
    fn to_nearest<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let (mut stack, mut near) = (Stack::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        // Every node is met once at most.
        for _ in 0..self.nodes.len() {
            let Some(node) = self.nodes.get(number) else { return };
            visitor.probe().step();
            // The nearest one does not go through memory: most often it is the only one.
            let mut nearest: Option<Pending<R>> = None;
            let below = stack.len();
            let interval = (visitor.start(), visitor.limit());
            hits(node, &courses, interval, &mut near, |place, t| {
                let child = (t, (number * WIDTH + place) as u32);
                nearest = match nearest {
                    Some(other) if other.0 <= t => {
                        stack.insert(below, child);
                        Some(other)
                    }
                    Some(other) => {
                        stack.insert(below, other);
                        Some(child)
                    }
                    None => Some(child),
                };
            });
            number = loop {
                let Some((t, child)) = nearest.or_else(|| stack.pop()) else { return };
                nearest = None;
                // The limit may have come nearer since.
                if !(t <= visitor.limit()) {
                    continue;
                }
                match self.child(child) {
                    Child::Node(number) => break number,
                    Child::Leaf(list) => visit(list, visitor),
                }
            };
        }
    }

    /// In any order: leaves at once, which are not worth remembering.
    #[inline(always)]
    fn to_any<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let (mut stack, mut near) = (Stack::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        for _ in 0..self.nodes.len() {
            let Some(node) = self.nodes.get(number) else { return };
            visitor.probe().step();
            let interval = (visitor.start(), visitor.limit());
            hits(node, &courses, interval, &mut near, |place, t| {
                match self.child((number * WIDTH + place) as u32) {
                    Child::Node(number) => stack.push((t, number as u32)),
                    Child::Leaf(list) if t <= visitor.limit() => visit(list, visitor),
                    Child::Leaf(_) => {}
                }
            });
            match stack.pop() {
                // Otherwise something has been found.
                Some((t, next)) if t <= visitor.limit() => number = next as usize,
                _ => return,
            }
        }
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
