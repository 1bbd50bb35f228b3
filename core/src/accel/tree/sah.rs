//! Dividing all shapes from the root down, where the surfaces tell to.
//!
//! J. Goldsmith, J. Salmon (1987) for the cost; J. MacDonald, K. Booth, "Heuristics for ray tracing
//! using space subdivision", The Visual Computer 6(3) (1990) for choosing cuts by it; I. Wald, "On
//! fast construction of SAH-based bounding volume hierarchies", RT 2007, for the bins.
//!
//! The scratch is a list of the shapes, which is partitioned in place. What is still to be divided
//! waits on a stack, the smaller part on top, so that it never holds more than one part for every
//! halving.

use super::Tree;
use super::links::Next;
use crate::accel::{BuildError, Id};
use crate::bound::Stored;
use crate::memory::{Arena, Footprint};
use crate::num::{Axis, Real, Vec3, Vector};
use crate::scene::{Scene, Shapes};
use heapless::Vec;

/// Bins along an axis.
const BINS: usize = 16;

/// Children of a node at most, unless it pays to test more.
const MOST_CHILDREN: usize = 8;

/// Levels at most: beyond half of them parts are cut in the middle of the list.
const LEVELS: usize = 64;

/// A part of the list that will be the children of a node.
#[derive(Clone, Copy)]
struct Part {
    first: usize,
    count: usize,
    node: usize,
    level: usize,
}

/// A cut across an axis.
#[derive(Clone, Copy)]
struct Cut<R> {
    cost: R,
    axis: Axis,
    /// Middles in bins up to this one lie below.
    last: i32,
    from: R,
    size: R,
}

impl<R: Real> Cut<R> {
    fn is_below(&self, middle: Vec3<R>) -> bool {
        bin(middle.along(self.axis) - self.from, self.size) <= self.last
    }
}

fn bin<R: Real>(from: R, size: R) -> i32 {
    from.proportion(size, BINS as i32).clamp(0, BINS as i32 - 1)
}

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Makes an empty tree one of all shapes.
    pub(super) fn divide_all<S: Shapes<R>>(
        &mut self,
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'_>,
    ) -> Result<(), BuildError> {
        let shapes = scene.shapes().bounded();
        arena.require(Footprint::of::<I>(shapes))?;
        let mut ends = arena.scratch::<I, u8>();
        // Cannot fail: it has just been asked for.
        let _ = ends.grow(shapes, 0, 0);
        let (ids, _) = ends.both();
        for (id, place) in ids.iter_mut().enumerate() {
            *place = I::new(id);
            // Cannot fail: there is a leaf for every shape, and each comes once.
            let _ = self.add_leaf(scene, id);
            self.links.count_leaf();
        }
        if shapes < 2 {
            return Ok(());
        }
        let root = self.links.add_interior();
        self.links.set_root(root);
        let mut parts: Vec<Part, { usize::BITS as usize }> = Vec::new();
        let mut part = Some(Part { first: 0, count: shapes, node: root, level: 1 });
        // Every part makes a node.
        while let Some(now) = part.take() {
            let list = ids.get_mut(now.first..now.first + now.count).unwrap_or_default();
            match self.divide(list, now.level) {
                None => self.join(now.node, list.iter().map(|id| id.get())),
                Some(below) => {
                    let counts = [below, now.count - below];
                    let firsts = [now.first, now.first + below];
                    let mut children = [0; 2];
                    let mut larger = None;
                    for ((child, count), first) in children.iter_mut().zip(counts).zip(firsts) {
                        if count == 1 {
                            *child = ids.get(first).map_or(0, |id| id.get());
                            continue;
                        }
                        *child = self.links.add_interior();
                        let own = Part { first, count, node: *child, level: now.level + 1 };
                        (part, larger) = match part {
                            Some(other) if other.count < count => (Some(other), Some(own)),
                            other => (Some(own), other),
                        };
                    }
                    if let Some(larger) = larger {
                        // Never refused: each waiting part is at least twice as large as what is
                        // divided meanwhile.
                        let _ = parts.push(larger);
                    }
                    self.join(now.node, children.into_iter());
                }
            }
            part = part.or_else(|| parts.pop());
        }
        self.fit_all();
        Ok(())
    }

    /// Makes nodes the children of another.
    pub(super) fn join(&mut self, parent: usize, children: impl Iterator<Item = usize>) {
        let mut before = None;
        for child in children {
            match before {
                None => self.links.set_first(parent, child),
                Some(before) => self.links.set_next(before, Next::Sibling(child)),
            }
            self.links.set_next(child, Next::Parent(parent));
            before = Some(child);
        }
    }

    /// Partitions a list in two; gives the length of the first part, or nothing when it is as good
    /// to test all of them.
    fn divide(&self, list: &mut [I], level: usize) -> Option<usize> {
        if list.len() <= 2 {
            return None;
        }
        let whole = self.union_of(list)?.half_area();
        let best = if level < LEVELS / 2 { self.best_cut(list) } else { None };
        let Some(cut) = best else {
            // All in one place, or too deep.
            return (list.len() > MOST_CHILDREN).then_some(list.len() / 2);
        };
        let together = whole.times_int(list.len() as i32);
        if list.len() <= MOST_CHILDREN && together <= whole + whole + cut.cost {
            return None;
        }
        let (mut from, mut to) = (0, list.len());
        while from < to {
            if cut.is_below(self.middle(list.get(from)?.get())) {
                from += 1;
                continue;
            }
            to -= 1;
            swap(list, from, to);
        }
        // Rounding cannot have put all on one side, but a list is never left whole.
        Some(from.min(list.len() - 1).max(1))
    }

    /// The cut with the least sum of surface times number on both sides, over all axes.
    fn best_cut(&self, list: &[I]) -> Option<Cut<R>> {
        let (mut lo, mut hi) = (self.middle(list.first()?.get()), self.middle(list.first()?.get()));
        for id in list {
            let middle = self.middle(id.get());
            (lo, hi) = (lo.min(middle), hi.max(middle));
        }
        let mut best: Option<Cut<R>> = None;
        for axis in Axis::ALL {
            let (from, size) = (lo.along(axis), hi.along(axis) - lo.along(axis));
            if !(size > R::ZERO) {
                continue;
            }
            let mut bins: [(Option<B>, i32); BINS] = [(None, 0); BINS];
            for id in list {
                let place = bin(self.middle(id.get()).along(axis) - from, size);
                if let (Some((bounds, count)), Some(new)) =
                    (bins.get_mut(place as usize), self.volume(id.get()))
                {
                    *bounds = join(*bounds, Some(new));
                    *count += 1;
                }
            }
            // Costs of everything above each bin.
            let mut above = [None; BINS];
            let (mut sum, mut number) = (None, 0);
            for (above, (bounds, count)) in above.iter_mut().zip(&bins).rev() {
                *above = cost(&sum, number);
                (sum, number) = (join(sum, *bounds), number + count);
            }
            let (mut sum, mut number) = (None, 0);
            for ((last, (bounds, count)), above) in (0..).zip(&bins).zip(above) {
                (sum, number) = (join(sum, *bounds), number + count);
                let (Some(below), Some(above)) = (cost(&sum, number), above) else { continue };
                let cost = below + above;
                if best.is_none_or(|best| cost < best.cost) {
                    best = Some(Cut { cost, axis, last, from, size });
                }
            }
        }
        best
    }

    fn middle(&self, node: usize) -> Vec3<R> {
        self.volume(node).map_or_else(Vec3::<R>::default, |volume| volume.middle())
    }

    fn union_of(&self, list: &[I]) -> Option<B> {
        list.iter().fold(None, |all, id| join(all, self.volume(id.get())))
    }
}

/// Exchanges two places of a list, the first of which comes first.
pub(super) fn swap<T>(list: &mut [T], first: usize, second: usize) {
    if let Some([a, .., b]) = list.get_mut(first..=second) {
        core::mem::swap(a, b);
    }
}

fn join<R: Real, B: Stored<R>>(a: Option<B>, b: Option<B>) -> Option<B> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        (a, b) => a.or(b),
    }
}

/// Of a node with so many children; nothing where there are none.
fn cost<R: Real, B: Stored<R>>(bounds: &Option<B>, count: i32) -> Option<R> {
    bounds.map(|bounds| bounds.half_area().times_int(count))
}
