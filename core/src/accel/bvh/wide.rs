//! The way of a ray through a hierarchy, the children of a node side by side: for processors that
//! compute four numbers at a time and pay dearly for branches they did not foresee.
//!
//! Leaves are handed over as soon as their node is looked at, before its other children: a few more
//! shapes are tested than from near to far, but nothing has to be kept of them, and what is kept is
//! a node, always. As compressed wide trees are walked by T. Ylitie, T. Karras, S. Laine, HPG 2017.
//! On the stack: 800 bytes in `f32` for the nearest hit, a group a level for any.

use super::node::{Node, WIDTH, hits, ids_of, leaves_of};
use super::stack::{Groups, Pending, Stack};
use super::units::Course;
use super::{Bvh, visit};
use crate::accel::{Id, Visitor};
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;

/// Children of a node that are met by a ray.
struct Met<'b, I> {
    node: &'b Node,
    /// Where its ids begin.
    first: I,
    /// A bit for each place.
    leaves: u32,
    group: Group,
}

/// Nodes with the same parent.
pub(super) struct Group {
    /// Number of the child in place 0, if that were a node.
    base: usize,
    /// A bit for each place.
    places: u32,
}

impl<R: Real, I: Id> Bvh<'_, R, I> {
    /// Looks at a node.
    #[inline(always)]
    fn look<V: Visitor<R>>(
        &self,
        number: usize,
        courses: &[Course<R>; 3],
        near: &mut [R; WIDTH],
        visitor: &mut V,
    ) -> Option<Met<'_, I>> {
        let (node, [first, next]) = (self.nodes.get(number)?, self.links.get(number)?);
        visitor.probe().step();
        let hits = hits(node, courses, (visitor.start(), visitor.limit()), near);
        let nodes = u32::MAX << leaves_of(node);
        let group = Group { base: next.get().wrapping_sub(WIDTH), places: hits & nodes };
        Some(Met { node, first: *first, leaves: hits & !nodes, group })
    }

    /// Hands over a leaf, unless the limit has come nearer since.
    #[inline(always)]
    fn hand_over<V: Visitor<R>>(
        &self,
        met: &Met<'_, I>,
        place: usize,
        near: &[R; WIDTH],
        visitor: &mut V,
    ) {
        if near.get(place).is_some_and(|t| *t <= visitor.limit()) {
            visit(self.list(met.first, ids_of(met.node, place)), visitor);
        }
    }

    /// From near to far.
    #[inline(always)]
    pub(super) fn to_nearest_wide<const JUMPS: bool, V: Visitor<R>>(
        &self,
        ray: &Ray<R>,
        visitor: &mut V,
    ) {
        let courses = self.units.courses(ray);
        let (mut stack, mut near) = (Stack::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        // Every node is met once at most.
        for _ in 0..self.nodes.len() {
            let Some(met) = self.look(number, &courses, &mut near, visitor) else { return };
            let mut leaves = Places::<JUMPS>::of(met.leaves);
            while let Some(place) = leaves.next() {
                self.hand_over(&met, place, &near, visitor);
            }
            let Group { base, places } = met.group;
            let child = |place: usize| -> Pending<R> {
                (near.get(place).copied().unwrap_or(R::ZERO), base.wrapping_add(place) as u32)
            };
            // The nearest one does not go through memory: most often it is the only one.
            let mut nearest = None;
            let mut places = Places::<JUMPS>::of(places);
            if let Some([a, b]) = places.two() {
                let (a, b) = (child(a), child(b));
                let in_order = a.0 <= b.0;
                nearest = Some(if in_order { a } else { b });
                stack.push(if in_order { b } else { a });
            } else {
                let below = stack.len();
                while let Some(place) = places.next() {
                    let child = child(place);
                    nearest = Some(match nearest {
                        Some(other) if other.0 > child.0 => {
                            stack.insert(below, other);
                            child
                        }
                        Some(other) => {
                            stack.insert(below, child);
                            other
                        }
                        None => child,
                    });
                }
            }
            number = loop {
                let Some((t, next)) = nearest.or_else(|| stack.pop()) else { return };
                nearest = None;
                // The limit may have come nearer since.
                if t <= visitor.limit() {
                    break next as usize;
                }
            };
        }
    }

    /// In any order: of a node's children the last one first. Rays to lights differ more than those
    /// to the nearest: places are jumped to.
    #[inline(always)]
    pub(super) fn to_any_wide<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let (mut groups, mut near) = (Groups::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        for _ in 0..self.nodes.len() {
            let Some(met) = self.look(number, &courses, &mut near, visitor) else { return };
            let mut leaves = Places::<true>::of(met.leaves);
            while let Some(place) = leaves.next() {
                self.hand_over(&met, place, &near, visitor);
            }
            // Otherwise something has been found.
            if !(visitor.start() <= visitor.limit()) {
                return;
            }
            let group = if met.group.places != 0 { Some(met.group) } else { groups.pop() };
            let Some(Group { base, places }) = group else { return };
            let place = places.ilog2();
            number = base.wrapping_add(place as usize);
            let places = places ^ 1 << place;
            if places != 0 {
                let _ = groups.push(Group { base, places });
            }
        }
    }
}

/// The places of ones, from the lowest. They are looked at one after the other: for a ray like the
/// last ones processors foresee what comes, and go on with a child before they know that it is met.
/// Or they are jumped to, with fewer branches that could not be foreseen.
struct Places<const JUMPS: bool> {
    place: usize,
    rest: u32,
}

impl<const JUMPS: bool> Places<JUMPS> {
    #[inline(always)]
    fn of(bits: u32) -> Self {
        Self { place: 0, rest: bits }
    }

    /// Both, if there are two and places are jumped to.
    #[inline(always)]
    fn two(&self) -> Option<[usize; 2]> {
        let ends = || [self.rest.trailing_zeros() as usize, self.rest.ilog2() as usize];
        (JUMPS && self.rest.count_ones() == 2).then(ends)
    }

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if JUMPS {
            let place = self.rest.trailing_zeros() as usize;
            self.rest &= self.rest.wrapping_sub(1);
            return (place < WIDTH).then_some(place);
        }
        while self.rest != 0 {
            let (place, met) = (self.place, self.rest & 1 != 0);
            self.place += 1;
            self.rest >>= 1;
            if met {
                return Some(place);
            }
        }
        None
    }
}
