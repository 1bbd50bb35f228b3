//! Inserting shapes as into an R-tree.
//!
//! A. Guttman, "R-trees: a dynamic index structure for spatial searching", SIGMOD 1984: down to the
//! node that has to grow least, whose children are leaves; one that has too many children is divided
//! in two, and so on up. All leaves are on the same level. Growth is that of the surface here, which
//! is what rays pay for, where databases take the volume; the division is the quadratic one.

use super::Tree;
use crate::accel::Id;
use crate::bound::Stored;
use crate::num::Real;
use heapless::Vec;

/// Children of a node at most and, but for the root, at least: with these the nodes above the leaves
/// are never as many as the leaves.
const MOST: usize = 8;
const LEAST: usize = 3;

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Gives a leaf its place.
    pub(super) fn place_in_r_tree(&mut self, leaf: usize) {
        let Some(new) = self.volume(leaf) else { return };
        let Some(root) = self.links.root() else {
            self.links.set_root(leaf);
            return;
        };
        if self.links.is_leaf(root) {
            let node = self.links.add_interior();
            self.links.set_root(node);
            self.adopt(node, &[root, leaf]);
            return;
        }
        let mut node = self.least_growth_leaf_node(root, new);
        self.links.prepend(node, leaf);
        self.enlarge(Some(node), new);
        for _ in 0..self.links.end() {
            // More than one too many has only a node that some other builder made; it stays whole.
            if self.links.children(node).count() != MOST + 1 {
                return;
            }
            let parent = self.links.parent(node);
            let other = self.split(node);
            let parent = match parent {
                Some(parent) => {
                    self.links.prepend(parent, other);
                    parent
                }
                None => {
                    let top = self.links.add_interior();
                    self.links.set_root(top);
                    self.adopt(top, &[node, other]);
                    return;
                }
            };
            node = parent;
        }
    }

    /// The node above leaves that has to grow least, of equal ones the smallest.
    fn least_growth_leaf_node(&self, root: usize, new: B) -> usize {
        let mut node = root;
        for _ in 0..self.links.end() {
            if self.links.is_leaf(self.links.first(node)) {
                break;
            }
            let mut least: Option<(R, R, usize)> = None;
            for child in self.links.children(node) {
                let Some(volume) = self.volume(child) else { continue };
                let area = volume.half_area();
                let growth = volume.union(new).half_area() - area;
                let better = |(least, smallest, _): &(R, R, usize)| {
                    growth < *least || growth == *least && area < *smallest
                };
                if least.as_ref().is_none_or(better) {
                    least = Some((growth, area, child));
                }
            }
            let Some((_, _, child)) = least else { break };
            node = child;
        }
        node
    }

    /// Makes nodes the children of one that bounds them.
    fn adopt(&mut self, parent: usize, children: &[usize]) {
        self.join(parent, children.iter().copied());
        self.fit(parent);
    }

    /// Divides a node with too many children; gives the new one, which has no place yet.
    fn split(&mut self, node: usize) -> usize {
        let mut rest: Vec<(usize, B), { MOST + 1 }> = Vec::new();
        for child in self.links.children(node) {
            if let Some(volume) = self.volume(child) {
                // Never refused: nodes are divided when they have one more than they may.
                let _ = rest.push((child, volume));
            }
        }
        let (a, b) = seeds(&rest);
        // The later one first, so that the other stays where it is.
        let Some(seeds) = take(&mut rest, b).zip(take(&mut rest, a)) else { return node };
        let mut groups = [seeds.0, seeds.1].map(|(child, volume)| {
            let mut children: Vec<usize, { MOST + 1 }> = Vec::new();
            let _ = children.push(child);
            (children, volume)
        });
        while let Some((next, to)) = choose(&rest, &groups) {
            let Some((child, volume)) = take(&mut rest, next) else { break };
            if let Some((children, bounds)) = groups.get_mut(to) {
                let _ = children.push(child);
                *bounds = bounds.union(volume);
            }
        }
        let other = self.links.add_interior();
        let [(first, _), (second, _)] = groups;
        // The node keeps its own place.
        self.adopt(node, &first);
        self.adopt(other, &second);
        other
    }
}

/// Takes one out of a list, whose last one comes in its place.
fn take<T: Copy, const N: usize>(list: &mut Vec<T, N>, at: usize) -> Option<T> {
    let last = list.pop()?;
    match list.get_mut(at) {
        Some(place) => Some(core::mem::replace(place, last)),
        None => Some(last),
    }
}

/// The two that waste most together, the first one first.
fn seeds<R: Real, B: Stored<R>>(all: &[(usize, B)]) -> (usize, usize) {
    let mut worst: Option<(R, (usize, usize))> = None;
    for (i, (_, a)) in all.iter().enumerate() {
        for (j, (_, b)) in all.iter().enumerate().skip(i + 1) {
            let waste = a.union(*b).half_area() - a.half_area() - b.half_area();
            if worst.is_none_or(|(most, _)| waste > most) {
                worst = Some((waste, (i, j)));
            }
        }
    }
    worst.map_or((0, 1), |(_, pair)| pair)
}

/// Which one comes next, the one that cares most, and to which group it goes; nothing when none is
/// left.
fn choose<R: Real, B: Stored<R>, const N: usize>(
    rest: &[(usize, B)],
    groups: &[(Vec<usize, N>, B); 2],
) -> Option<(usize, usize)> {
    let [a, b] = groups;
    for (to, (children, _)) in groups.iter().enumerate() {
        // What is left is just enough for it.
        if !rest.is_empty() && children.len() + rest.len() <= LEAST {
            return Some((0, to));
        }
    }
    let growth = |(_, bounds): &(Vec<usize, N>, B), volume: B| {
        bounds.union(volume).half_area() - bounds.half_area()
    };
    let mut best: Option<(R, (usize, usize))> = None;
    for (i, (_, volume)) in rest.iter().enumerate() {
        let (to_a, to_b) = (growth(a, *volume), growth(b, *volume));
        let to = if to_a == to_b {
            usize::from(b.0.len() < a.0.len())
        } else {
            usize::from(to_b < to_a)
        };
        let preference = (to_a - to_b).abs();
        if best.is_none_or(|(most, _)| preference > most) {
            best = Some((preference, (i, to)));
        }
    }
    best.map(|(_, choice)| choice)
}
