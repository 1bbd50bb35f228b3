//! The way of a ray through a hierarchy, one child after the other: for processors that gain by
//! every computation that is left out.

use super::node::{WIDTH, each_hit, ids_of};
use super::stack::{Pending, Stack};
use super::{Bvh, visit};
use crate::accel::{Id, Visitor};
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;

/// A child of a node.
enum Child<'m, I> {
    Leaf(&'m [I]),
    Node(usize),
}

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
    /// The child with a number: that of its node times [`WIDTH`] plus its place there.
    #[inline(always)]
    fn child(&self, number: u32) -> Child<'m, I> {
        let (node, place) = (number as usize / WIDTH, number as usize % WIDTH);
        let (Some(node), Some([first, next])) = (self.nodes.get(node), self.links.get(node)) else {
            return Child::Leaf(&[]);
        };
        let list = ids_of(node, place);
        if list.start < list.end {
            Child::Leaf(self.list(*first, list))
        } else {
            Child::Node((next.get() + place).wrapping_sub(WIDTH))
        }
    }

    /// From near to far.
    #[inline(always)]
    pub(super) fn to_nearest_narrow<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let mut stack = Stack::new();
        let mut number = 0;
        // Every node is met once at most.
        for _ in 0..self.nodes.len() {
            let Some(node) = self.nodes.get(number) else { return };
            visitor.probe().step();
            // The nearest one does not go through memory: most often it is the only one.
            let mut nearest: Option<Pending<R>> = None;
            let below = stack.len();
            let interval = (visitor.start(), visitor.limit());
            each_hit(node, &courses, interval, |place, t| {
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
    pub(super) fn to_any_narrow<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let mut stack = Stack::new();
        let mut number = 0;
        for _ in 0..self.nodes.len() {
            let Some(node) = self.nodes.get(number) else { return };
            visitor.probe().step();
            let interval = (visitor.start(), visitor.limit());
            each_hit(node, &courses, interval, |place, t| {
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
