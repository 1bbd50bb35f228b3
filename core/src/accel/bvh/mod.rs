//! A compact four-wide hierarchy of boxes.

mod build;
mod node;
mod split;
mod units;

pub use build::{footprint, nodes_within};

use super::{Accel, Id, Visitor};
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;
use heapless::Vec;
use node::{Node, WIDTH, clip};
use units::Units;

/// Nodes from the root to any leaf at most. The builder sees to it.
const LEVELS: usize = 20;

/// A child still to be looked at: where the ray enters its box; its node times [`WIDTH`] plus its
/// place there.
type Pending<R> = (R, u32);

/// What waits while a ray goes down: every level leaves all but one of a node's children behind.
type Stack<R> = Vec<Pending<R>, { LEVELS * (WIDTH - 1) + 1 }>;

/// A hierarchy. `I` stores ids of shapes and numbers of nodes.
#[derive(Debug)]
pub struct Bvh<'m, R: Real, I> {
    units: Units<R>,
    nodes: &'m [Node],
    /// A node each: where its range of ids begins; the number of its first child that is a node,
    /// plus [`WIDTH`], less the number of its leaves.
    links: &'m [[I; 2]],
    ids: &'m [I],
}

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// The lists of all leaves.
    pub fn leaves(&self) -> impl Iterator<Item = &'m [I]> {
        (0..self.nodes.len() * WIDTH).filter_map(|slot| self.child(slot as u32).ok())
    }

    /// A child: the ids of a leaf, or the number of a node.
    #[inline(always)]
    fn child(&self, slot: u32) -> Result<&'m [I], usize> {
        let (node, place) = ((slot / WIDTH as u32) as usize, slot % WIDTH as u32);
        let ends = self.nodes.get(node).map_or(0, |node| node[8]);
        let [first, below] = self.links.get(node).copied().unwrap_or([I::new(0); 2]);
        let from = (u64::from(ends) << 8 >> (8 * place)) as usize & 0xff;
        let to = (ends >> (8 * place)) as usize & 0xff;
        if to > from {
            let first = first.get();
            Ok(self.ids.get(first + from..first + to).unwrap_or_default())
        } else {
            Err((below.get() + place as usize).wrapping_sub(WIDTH))
        }
    }
}

impl<R: Real, I: Id> Accel<R> for Bvh<'_, R, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let courses = self.units.courses(ray);
        let mut stack = Stack::<R>::new();
        let mut node = 0;
        while let Some(words) = self.nodes.get(node) {
            visitor.probe().step();
            let (near, far) = clip(words, &courses, visitor.start(), visitor.limit());
            let waiting = stack.len();
            for (place, (near, far)) in near.into_iter().zip(far).enumerate() {
                if near <= far {
                    let _ = stack.push((near, (node * WIDTH + place) as u32));
                    sort(stack.get_mut(waiting..).unwrap_or_default());
                }
            }
            node = loop {
                let Some((t, slot)) = stack.pop() else { return };
                if !(t <= visitor.limit()) {
                    continue;
                }
                match self.child(slot) {
                    Err(node) => break node,
                    Ok(list) => {
                        visitor.probe().leaf(false);
                        visitor.visit(list.iter().map(|id| id.get()));
                    }
                }
            };
        }
    }
}

/// Brings the last entry to its place: the nearest one last.
#[inline(always)]
fn sort<R: Real>(pending: &mut [Pending<R>]) {
    for last in (1..pending.len()).rev() {
        match pending.get_mut(last - 1..=last) {
            Some([a, b]) if a.0 < b.0 => core::mem::swap(a, b),
            _ => return,
        }
    }
}

#[cfg(test)]
mod tests;
