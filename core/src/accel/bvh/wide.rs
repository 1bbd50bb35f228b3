//! The way of a ray through a hierarchy, the children of a node side by side: for processors that
//! compute four numbers at a time and pay dearly for branches they did not foresee.
//!
//! Leaves are handed over as soon as their node is looked at, before its other children: a few more
//! shapes are tested than from near to far, but nothing has to be kept of them, and what is kept is
//! a node, always. As compressed wide trees are walked by T. Ylitie, T. Karras, S. Laine, HPG 2017.

use super::node::{WIDTH, hits, ids_of, leaves_of};
use super::stack::{Groups, Pending, Stack};
use super::units::Course;
use super::{Bvh, visit};
use crate::accel::{Id, Visitor};
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;

/// Children of a node that are nodes, and met by a ray.
pub(super) struct Met {
    /// Number of the child in place 0, if that were a node.
    base: usize,
    /// A bit for each place.
    places: u32,
}

impl<R: Real, I: Id> Bvh<'_, R, I> {
    /// Looks at a node: hands over the leaves that a ray meets, and gives the nodes.
    #[inline(always)]
    fn look<V: Visitor<R>>(
        &self,
        number: usize,
        courses: &[Course<R>; 3],
        near: &mut [R; WIDTH],
        visitor: &mut V,
    ) -> Option<Met> {
        let (node, [first, next]) = (self.nodes.get(number)?, self.links.get(number)?);
        visitor.probe().step();
        let hits = hits(node, courses, (visitor.start(), visitor.limit()), near);
        let leaves = leaves_of(node);
        for place in ones(hits & !(u32::MAX << leaves)) {
            // The limit may have come nearer since.
            if near.get(place).is_some_and(|t| *t <= visitor.limit()) {
                visit(self.list(*first, ids_of(node, place)), visitor);
            }
        }
        let base = next.get().wrapping_sub(WIDTH);
        Some(Met { base, places: hits & u32::MAX << leaves })
    }

    /// From near to far.
    #[inline(always)]
    pub(super) fn to_nearest_wide<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let (mut stack, mut near) = (Stack::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        // Every node is met once at most.
        for _ in 0..self.nodes.len() {
            let Some(Met { base, places }) = self.look(number, &courses, &mut near, visitor) else {
                return;
            };
            let child = |place: usize| -> Pending<R> {
                let t = near.get(place).copied().unwrap_or(R::ZERO);
                (t, base.wrapping_add(place) as u32)
            };
            // The nearest one does not go through memory: most often it is the only one.
            let mut nearest = None;
            let without_first = places & places.wrapping_sub(1);
            if without_first & without_first.wrapping_sub(1) == 0 {
                // One or two: no branches but for their number.
                let mut children = ones(places).map(child);
                nearest = children.next();
                if let (Some(a), Some(b)) = (nearest, children.next()) {
                    let (near, far) = in_order(a, b);
                    nearest = Some(near);
                    stack.push(far);
                }
            } else {
                // Place after place: processors foresee what comes, and go on with the nearest.
                let below = stack.len();
                let (mut place, mut rest) = (0, places);
                while rest != 0 {
                    if rest & 1 != 0 {
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
                    place += 1;
                    rest >>= 1;
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

    /// In any order: of a node's children the last one first.
    #[inline(always)]
    pub(super) fn to_any_wide<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let (mut groups, mut near) = (Groups::new(), [R::ZERO; WIDTH]);
        let mut number = 0;
        for _ in 0..self.nodes.len() {
            let Some(met) = self.look(number, &courses, &mut near, visitor) else { return };
            // Otherwise something has been found.
            if !(visitor.start() <= visitor.limit()) {
                return;
            }
            let group = if met.places != 0 { Some(met) } else { groups.pop() };
            let Some(Met { base, places }) = group else { return };
            let place = places.ilog2();
            number = base.wrapping_add(place as usize);
            let places = places ^ 1 << place;
            if places != 0 {
                let _ = groups.push(Met { base, places });
            }
        }
    }
}

/// The nearer one of two first.
#[inline(always)]
fn in_order<R: Real>(a: Pending<R>, b: Pending<R>) -> (Pending<R>, Pending<R>) {
    if a.0 <= b.0 { (a, b) } else { (b, a) }
}

/// The places of ones, from the lowest.
#[inline(always)]
fn ones(mut bits: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let place = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            place
        })
    })
}
