//! Building the hierarchy in place.

use super::node::{Node, WIDTH, pack};
use super::split::best_cut;
use super::units::{Bounds, Units};
use super::{Bvh, LEVELS};
use crate::accel::{BuildError, Id};
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::scene::{Scene, Shapes};
use heapless::Vec;

/// Shapes in a leaf at most: the ends of four leaves fit a byte.
const FULL: usize = 63;

/// How many nodes a hierarchy over so many shapes can use: every leaf is a single shape.
pub(super) fn most_nodes(shapes: usize) -> usize {
    if shapes == 0 { 0 } else { below_most(shapes).max(1) }
}

/// How many nodes it takes at least.
pub(super) fn least_nodes(shapes: usize) -> usize {
    if shapes == 0 { 0 } else { below_least(shapes).max(1) }
}

/// Bytes of a hierarchy over so many shapes with so many nodes; building takes no more.
pub fn footprint<I: Id>(shapes: usize, nodes: usize) -> Footprint {
    let nodes = clamp(shapes, nodes);
    Footprint::of::<Node>(nodes)
        .then(Footprint::of::<[I; 2]>(nodes))
        .then(Footprint::of::<I>(shapes))
}

/// The number of nodes that makes the best of so many bytes.
pub fn nodes_within(shapes: usize, bytes: usize) -> usize {
    let fits = |nodes| {
        let footprint = if shapes <= u16::MAX.into() {
            footprint::<u16>(shapes, nodes)
        } else {
            footprint::<u32>(shapes, nodes)
        };
        footprint.peak <= bytes
    };
    let (mut low, mut high) = (least_nodes(shapes), clamp(shapes, shapes.div_ceil(SHARE)));
    while low < high {
        let middle = low + (high - low).div_ceil(2);
        if fits(middle) { low = middle } else { high = middle - 1 }
    }
    low
}

/// Shapes a node.
const SHARE: usize = 6;

fn clamp(shapes: usize, nodes: usize) -> usize {
    nodes.min(most_nodes(shapes)).max(least_nodes(shapes))
}

/// How many nodes a child of so many shapes can use.
fn below_most(shapes: usize) -> usize {
    shapes.saturating_sub(1).div_ceil(WIDTH - 1)
}

/// How many nodes a child of so many shapes takes, when they are shared out equally.
fn below_least(mut shapes: usize) -> usize {
    let (mut nodes, mut level) = (0, 1);
    while shapes > FULL {
        nodes += level;
        level *= WIDTH;
        shapes = shapes.div_ceil(WIDTH);
    }
    nodes
}

/// Levels of nodes that a child of so many shapes takes, when they are shared out equally.
fn levels(mut shapes: usize) -> usize {
    let mut levels = 0;
    while shapes > 1 {
        levels += 1;
        shapes = shapes.div_ceil(WIDTH);
    }
    levels
}

/// A child to be.
#[derive(Clone, Copy)]
struct Group {
    /// Its range of ids.
    first: usize,
    count: usize,
    bounds: Bounds,
    /// How many nodes it gets; a leaf gets none.
    nodes: usize,
}

impl Group {
    fn cost(&self) -> u64 {
        if self.count > 1 { self.bounds.half_area().max(1) * self.count as u64 } else { 0 }
    }
}

struct Builder<'b, 's, R: Real, S, I> {
    scene: &'b Scene<'s, R, S>,
    units: Units<R>,
    ids: &'b mut [I],
}

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
    /// Builds.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        nodes: usize,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        BuildError::unless_fits::<I>("shapes", shapes.saturating_sub(1))?;
        let count = clamp(shapes, nodes);
        arena.require(footprint::<I>(shapes, nodes))?;
        let nodes: &mut [Node] = arena.keep("bvh nodes", count)?;
        let links: &mut [[I; 2]] = arena.keep("bvh links", count)?;
        let ids: &mut [I] = arena.keep("bvh ids", shapes)?;
        for (id, place) in ids.iter_mut().enumerate() {
            *place = I::new(id);
        }
        let units = Units::of(scene);
        Builder { scene, units, ids: &mut *ids }.grow(nodes, links);
        Ok(Self { units, nodes, links, ids })
    }
}

impl<R: Real, S: Shapes<R>, I: Id> Builder<'_, '_, R, S, I> {
    fn bounds(&self, id: I) -> Bounds {
        self.units.bounds(self.scene.shapes().bounds(id.get()))
    }

    fn ids_of(&self, first: usize, count: usize) -> &[I] {
        self.ids.get(first..first + count).unwrap_or_default()
    }

    fn bounds_of(&self, first: usize, count: usize) -> Bounds {
        let ids = self.ids_of(first, count);
        ids.iter().fold(Bounds::EMPTY, |all, id| all.union(self.bounds(*id)))
    }

    /// Nodes in order; a node to come holds its range of ids and how many nodes it and what is
    /// below it get.
    fn grow(&mut self, nodes: &mut [Node], links: &mut [[I; 2]]) {
        let budget = nodes.len() as u32;
        if let Some(root) = nodes.first_mut() {
            *root = [0, self.ids.len() as u32, budget, 0, 0, 0, 0, 0, 0];
        }
        let (mut level, mut level_end, mut next) = (0, 1, 1);
        for number in 0..nodes.len() {
            if number == level_end {
                level += 1;
                level_end = next;
            }
            let Some([first, count, budget, ..]) = nodes.get(number).copied() else { return };
            let (first, count) = (first as usize, count as usize);
            let mut groups = self.groups(first, count, level, budget as usize);
            self.leaves_first(&mut groups);

            let leaves = groups.iter().filter(|group| group.nodes == 0).count();
            if let Some(link) = links.get_mut(number) {
                *link = [I::new(first), I::new(next + WIDTH - leaves)];
            }
            let (mut boxes, mut ends) = ([Bounds::EMPTY; WIDTH], [0; WIDTH]);
            let (mut whole, mut end) = (Bounds::EMPTY, 0);
            for (group, (bounds, slot_end)) in groups.iter().zip(boxes.iter_mut().zip(&mut ends)) {
                whole = whole.union(group.bounds);
                *bounds = group.bounds;
                if group.nodes == 0 {
                    end += group.count;
                } else if let Some(child) = nodes.get_mut(next) {
                    let (first, count) = (group.first as u32, group.count as u32);
                    *child = [first, count, group.nodes as u32, 0, 0, 0, 0, 0, 0];
                    next += 1;
                }
                *slot_end = end as u8;
            }
            for end_slot in ends.iter_mut().skip(groups.len()) {
                *end_slot = end as u8;
            }
            if let Some(node) = nodes.get_mut(number) {
                *node = pack(whole, boxes, ends);
            }
        }
    }

    /// Up to four groups.
    fn groups(
        &mut self,
        first: usize,
        count: usize,
        level: usize,
        budget: usize,
    ) -> Vec<Group, WIDTH> {
        let mut groups = Vec::new();
        if level + 1 + levels(count) <= LEVELS {
            let bounds = self.bounds_of(first, count);
            let _ = groups.push(Group { first, count, bounds, nodes: 0 });
            while groups.len() < WIDTH {
                let costs = groups.iter().map(Group::cost).enumerate();
                let Some((dearest, cost)) = costs.max_by_key(|(_, cost)| *cost) else { break };
                if cost == 0 {
                    break;
                }
                let Some(group) = groups.get_mut(dearest) else { break };
                let other = self.split(group);
                let _ = groups.push(other);
                // Back to the order of their ranges.
                for place in (dearest + 2..groups.len()).rev() {
                    if let Some([a, b]) = groups.get_mut(place - 1..=place) {
                        core::mem::swap(a, b);
                    }
                }
            }
            if self.share(&mut groups, budget.saturating_sub(1)) {
                return groups;
            }
            groups.clear();
        }
        let part = count.div_ceil(WIDTH);
        let mut rest = (first, count);
        while rest.1 > 0 {
            let (first, count) = (rest.0, part.min(rest.1));
            let bounds = self.bounds_of(first, count);
            let _ = groups.push(Group { first, count, bounds, nodes: 0 });
            rest = (first + count, rest.1 - count);
        }
        self.share(&mut groups, budget.saturating_sub(1));
        groups
    }

    /// Cuts a group in two; gives the second one.
    fn split(&mut self, group: &mut Group) -> Group {
        let ids = self.ids_of(group.first, group.count);
        let boxes = ids.iter().map(|id| self.bounds(*id));
        let (below, cut) = match best_cut(boxes) {
            Some(cut) => (self.partition(group.first, group.count, |b| cut.is_below(b)), Some(cut)),
            None => (group.count / 2, None),
        };
        let (first, count) = (group.first + below, group.count - below);
        let (lower, upper) = match cut {
            Some(cut) => (cut.below, cut.above),
            None => (self.bounds_of(group.first, below), self.bounds_of(first, count)),
        };
        *group = Group { count: below, bounds: lower, ..*group };
        Group { first, count, bounds: upper, nodes: 0 }
    }

    /// Brings those ids of a range first of which the box is below.
    fn partition(&mut self, first: usize, count: usize, below: impl Fn(Bounds) -> bool) -> usize {
        let (mut from, mut to) = (first, first + count);
        while from < to {
            let Some(id) = self.ids.get(from).copied() else { break };
            if below(self.bounds(id)) {
                from += 1;
            } else {
                to -= 1;
                let last = self.ids.get(to).copied().unwrap_or(id);
                if let Some(place) = self.ids.get_mut(from) {
                    *place = last;
                }
                if let Some(place) = self.ids.get_mut(to) {
                    *place = id;
                }
            }
        }
        from - first
    }

    /// Shares nodes out among groups; false when some would have to be leaves that are too large.
    fn share(&self, groups: &mut [Group], nodes: usize) -> bool {
        let mut left = nodes;
        for group in groups.iter_mut() {
            group.nodes = below_least(group.count);
            let Some(rest) = left.checked_sub(group.nodes) else { return false };
            left = rest;
        }
        let open = |group: &Group| group.nodes < below_most(group.count);
        // What a group cannot use goes to the others.
        for _ in 0..groups.len() {
            let all: usize = groups.iter().filter(|g| open(g)).map(|g| g.count).sum();
            let share = left;
            for group in groups.iter_mut().filter(|g| open(g)) {
                let part = (share as u64 * group.count as u64 / all as u64) as usize;
                let part = part.min(below_most(group.count) - group.nodes).min(left);
                group.nodes += part;
                left -= part;
            }
        }
        while left > 0 {
            // The one with most shapes a node.
            let dearest = |g: &&mut Group| g.count as u64 * 65536 / (g.nodes as u64 + 1);
            let Some(group) = groups.iter_mut().filter(|g| open(g)).max_by_key(dearest) else {
                break;
            };
            group.nodes += 1;
            left -= 1;
        }
        true
    }

    /// Brings the ranges of leaves before those of nodes.
    fn leaves_first(&mut self, groups: &mut [Group]) {
        for _ in 0..groups.len() {
            for place in 1..groups.len() {
                let Some([a, b]) = groups.get_mut(place - 1..=place) else { return };
                if a.nodes == 0 || b.nodes > 0 {
                    continue;
                }
                let first = a.first;
                if let Some(ids) = self.ids.get_mut(first..first + a.count + b.count) {
                    swap_parts(ids, a.count);
                }
                (a.first, b.first) = (first + b.count, first);
                core::mem::swap(a, b);
            }
        }
    }
}

/// Exchanges the first `count` elements with the rest.
fn swap_parts<T>(elements: &mut [T], count: usize) {
    if let Some((first, second)) = elements.split_at_mut_checked(count) {
        first.reverse();
        second.reverse();
    }
    elements.reverse();
}
