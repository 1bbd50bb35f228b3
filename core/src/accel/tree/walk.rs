//! Rays through the tree, the nearest nodes first, in bounded memory.
//!
//! What waits lies in a list of constant length, as a stack whose newest entries are sorted, or as a
//! heap. A node whose children find no room there is walked along its links instead: no hit is lost, only some tests are not saved.

use super::{Tree, Walk};
use crate::accel::{Accel, Id, Visitor};
use crate::bound::Stored;
use crate::geom::Ray;
use crate::num::Real;
use crate::probe::Probe;

/// Nodes that wait, at most; 512 bytes of the stack in `f32`.
const MOST: usize = 64;

/// A node, and where the ray enters its bound.
type Pending<R> = (R, u32);

/// Nodes that wait.
struct Waiting<R> {
    nodes: [Pending<R>; MOST],
    len: usize,
}

impl<R: Real> Waiting<R> {
    fn new() -> Self {
        Self { nodes: [(R::ZERO, 0); MOST], len: 0 }
    }

    /// Adds a node at the end, unless there is no room.
    fn push(&mut self, entry: Pending<R>) -> bool {
        match self.nodes.get_mut(self.len) {
            Some(place) => {
                *place = entry;
                self.len += 1;
                true
            }
            None => false,
        }
    }

    fn t(&self, at: usize) -> R {
        self.nodes.get(at).map_or(R::INFINITY, |(t, _)| *t)
    }

    fn swap(&mut self, a: usize, b: usize) {
        if a < MOST && b < MOST {
            self.nodes.swap(a, b);
        }
    }

    /// Sorts the entries from `from` on, the nearest last.
    fn sort(&mut self, from: usize) {
        for newest in from + 1..self.len {
            let mut at = newest;
            while at > from && self.t(at - 1) < self.t(at) {
                self.swap(at - 1, at);
                at -= 1;
            }
        }
    }

    /// Takes the last one off.
    fn pop(&mut self) -> Option<Pending<R>> {
        self.len = self.len.checked_sub(1)?;
        self.nodes.get(self.len).copied()
    }

    /// Makes the entries from `from` on part of the heap before them.
    fn sift_up(&mut self, from: usize) {
        for newest in from..self.len {
            let mut at = newest;
            while at > 0 && self.t(at) < self.t((at - 1) / 2) {
                self.swap(at, (at - 1) / 2);
                at = (at - 1) / 2;
            }
        }
    }

    /// Takes the nearest one off the heap.
    fn pop_nearest(&mut self) -> Option<Pending<R>> {
        let last = self.len.checked_sub(1)?;
        self.swap(0, last);
        self.len = last;
        let mut at = 0;
        loop {
            let (left, right) = (2 * at + 1, 2 * at + 2);
            if left >= last {
                break;
            }
            let nearer = if right < last && self.t(right) < self.t(left) { right } else { left };
            if !(self.t(nearer) < self.t(at)) {
                break;
            }
            self.swap(at, nearer);
            at = nearer;
        }
        self.nodes.get(last).copied()
    }
}

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Tests the bound of a node.
    #[inline]
    fn enter<V: Visitor<R>>(&self, node: usize, line: &B::PerRay, visitor: &mut V) -> Option<R> {
        visitor.probe().step();
        let (start, limit) = (visitor.start(), visitor.limit());
        self.volumes.get(node).and_then(|plain| B::of(plain).enter(line, start, limit))
    }

    /// Hands over the shape of a leaf.
    #[inline]
    fn meet<V: Visitor<R>>(leaf: usize, visitor: &mut V) {
        visitor.probe().leaf(false);
        visitor.visit(core::iter::once(leaf));
    }

    /// Lets the children of a node wait that the ray hits; false when there is no room. A child
    /// without a bound is entered where the node is.
    #[inline]
    fn wait<V: Visitor<R>>(
        &self,
        (t, node): (R, usize),
        line: &B::PerRay,
        waiting: &mut Waiting<R>,
        visitor: &mut V,
    ) -> bool {
        let before = waiting.len;
        for child in self.links.children(node) {
            let bare = self.links.is_bare(child);
            let entered = if bare { Some(t) } else { self.enter(child, line, visitor) };
            if let Some(t) = entered
                && !waiting.push((t, child as u32))
            {
                waiting.len = before;
                return false;
            }
        }
        true
    }

    /// Walks a node and all below it in the order in which it is stored, without any memory.
    #[inline(never)]
    fn walk_stored<V: Visitor<R>>(&self, top: usize, line: &B::PerRay, visitor: &mut V) {
        let mut next = Some(top);
        for _ in 0..self.links.end() {
            let Some(node) = next else { return };
            let hit = self.links.is_bare(node) || self.enter(node, line, visitor).is_some();
            if hit && self.links.is_leaf(node) {
                Self::meet(node, visitor);
            }
            next = self.links.after(node, top, !hit);
        }
    }

    /// The walk with a stack.
    fn walk_ordered<V: Visitor<R>>(&self, root: usize, line: &B::PerRay, visitor: &mut V) {
        let mut waiting = Waiting::new();
        let mut found = self.enter(root, line, visitor).map(|t| (t, root as u32));
        // Every node waits once at most.
        while let Some((t, node)) = found {
            let node = node as usize;
            // The limit may have come nearer since.
            if t <= visitor.limit() {
                let before = waiting.len;
                if self.links.is_leaf(node) {
                    Self::meet(node, visitor);
                } else if self.wait((t, node), line, &mut waiting, visitor) {
                    waiting.sort(before);
                } else {
                    self.walk_stored(node, line, visitor);
                }
            }
            found = waiting.pop();
        }
    }

    /// The walk with a heap.
    fn walk_nearest<V: Visitor<R>>(&self, root: usize, line: &B::PerRay, visitor: &mut V) {
        let mut waiting = Waiting::new();
        let mut found = self.enter(root, line, visitor).map(|t| (t, root as u32));
        while let Some((t, node)) = found {
            let node = node as usize;
            if !(t <= visitor.limit()) {
                // Neither is any other near enough.
                return;
            }
            let before = waiting.len;
            if self.links.is_leaf(node) {
                Self::meet(node, visitor);
            } else if self.wait((t, node), line, &mut waiting, visitor) {
                waiting.sift_up(before);
            } else {
                self.walk_stored(node, line, visitor);
            }
            found = waiting.pop_nearest();
        }
    }
}

impl<R: Real, B: Stored<R>, I: Id> Accel<R> for Tree<'_, R, B, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let Some(root) = self.links.root() else { return };
        let line = B::per_ray(ray);
        match self.walk {
            Walk::Ordered => self.walk_ordered(root, &line, visitor),
            Walk::Heap => self.walk_nearest(root, &line, visitor),
            Walk::Stored => self.walk_stored(root, &line, visitor),
        }
    }
}
