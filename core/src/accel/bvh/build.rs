//! Building the hierarchy in the very bytes that it keeps.
//!
//! Nodes are made in the order in which they are stored, level by level, and until a node's turn
//! comes its place holds what it will be made of: so there is no queue and no recursion. The list of
//! ids is partitioned in place. Boxes are kept where nodes are still to be made while there is room
//! for those of a group, and otherwise computed from the shapes whenever they are needed.
//!
//! The number of nodes is given. A node cuts its shapes into eight groups, always the one with the
//! largest surface (I. Wald, C. Benthin, S. Boulos, "Getting rid of packets", RT 2008), and deals
//! its nodes out to them in proportion to their shapes; a group that gets none is a leaf. So a
//! budget decides how large leaves are, and every byte of it is used.

use super::node::{Node, WIDTH, pack};
use super::size::{footprint, least_below, levels_below, most_below, possible_nodes};
use super::split::{Bins, Cut, best_cut};
use super::units::{Bounds, Sides, Units};
use super::{Bvh, LEVELS};
use crate::accel::{BuildError, Id};
use crate::memory::Arena;
use crate::num::Real;
use crate::scene::{Scene, Shapes};
use core::ops::Range;
use heapless::Vec;

impl<'m, R: Real, I: Id> Bvh<'m, R, I> {
    /// Builds a hierarchy over the bounded shapes of a scene, with `nodes` nodes or the nearest
    /// possible number. Time in proportion to the number of shapes and levels.
    ///
    /// # Errors
    /// [`BuildError::Memory`] with the exact number of bytes; [`BuildError::TooMany`] when ids do
    /// not fit their type.
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        nodes: usize,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        BuildError::unless_fits::<I>("shapes", shapes)?;
        arena.require(footprint::<I>(shapes, nodes))?;
        let count = possible_nodes(shapes, nodes);
        let nodes: &mut [Node] = arena.keep("bvh nodes", count)?;
        let links: &mut [[I; 2]] = arena.keep("bvh links", count)?;
        let ids: &mut [I] = arena.keep("bvh ids", shapes)?;
        for (id, place) in ids.iter_mut().enumerate() {
            *place = I::new(id);
        }
        let units = Units::of(scene);
        let levels = Builder { scene, units, ids: &mut *ids }.grow(nodes, links);
        Ok(Self { units, levels, incoherent: false, nodes, links, ids })
    }
}

/// A node or a leaf to be.
#[derive(Clone, Copy)]
struct Group {
    /// Its range of ids.
    first: usize,
    count: usize,
    /// How many nodes it gets; a leaf gets none.
    nodes: usize,
}

impl Group {
    /// As it waits in a node's place, with its box.
    fn wait(self, bounds: Bounds) -> Node {
        let bytes = |n: usize| (n as u64).to_le_bytes();
        let corner = |[x, y, z]: [u16; 3]| bytemuck::cast([x, y, z, 0]);
        let Self { first, count, nodes } = self;
        let ([lo, hi], none) = (bounds.corners().map(corner), [0; WIDTH]);
        [bytes(first), bytes(count), bytes(nodes), lo, hi, none, none, none]
    }

    fn waiting(node: &Node) -> (Self, Bounds) {
        let [first, count, nodes, lo, hi, ..] = *node;
        let [first, count, nodes] =
            [first, count, nodes].map(|row| u64::from_le_bytes(row) as usize);
        let corners = [lo, hi].map(|row| {
            let [x, y, z, _]: [u16; 4] = bytemuck::cast(row);
            [x, y, z]
        });
        (Self { first, count, nodes }, Bounds::between(corners))
    }

    fn range(&self) -> Range<usize> {
        self.first..self.first + self.count
    }

    fn can_use_more(&self) -> bool {
        self.nodes < most_below(self.count)
    }
}

/// Groups with their boxes, in the order of their ranges.
type Groups = Vec<(Group, Bounds), WIDTH>;

/// Boxes of shapes in the order of the list from a place on, or none.
struct Boxes<'f> {
    first: usize,
    kept: &'f mut [Sides],
}

struct Builder<'b, 's, R: Real, S, I> {
    scene: &'b Scene<'s, R, S>,
    units: Units<R>,
    ids: &'b mut [I],
}

impl<R: Real, S: Shapes<R>, I: Id> Builder<'_, '_, R, S, I> {
    /// Makes all nodes; gives the number of levels.
    #[inline(never)]
    fn grow(&mut self, nodes: &mut [Node], links: &mut [[I; 2]]) -> usize {
        let all = Group { first: 0, count: self.ids.len(), nodes: nodes.len() };
        if let Some(root) = nodes.first_mut() {
            *root = all.wait(self.bounds_of(0, all.count));
        }
        let (mut level, mut level_end, mut next) = (0, 0, 1);
        let mut groups = Groups::new();
        for (number, link) in links.iter_mut().enumerate() {
            if number == level_end {
                level += 1;
                level_end = next;
            }
            let Some((group, bounds)) = nodes.get(number).map(Group::waiting) else { break };
            self.divide(
                (group, bounds),
                level,
                nodes.get_mut(next..).unwrap_or_default(),
                &mut groups,
            );
            self.leaves_first(&mut groups);
            let leaves = groups.iter().filter(|(child, _)| child.nodes == 0).count();
            *link = [I::new(group.first), I::new(next + WIDTH - leaves)];
            next = lay(&groups, nodes, number, next);
        }
        level
    }

    // What follows are functions of their own, for the stack: it is deepest where the best cut is
    // looked for, and then holds only what that is for.

    /// The children of a node on a level; the root's is 1.
    fn divide(
        &mut self,
        (node, bounds): (Group, Bounds),
        level: usize,
        free: &mut [Node],
        groups: &mut Groups,
    ) {
        let below = node.nodes.saturating_sub(1);
        // What is left below must not become too deep, however unequal the groups are.
        if level + levels_below(node.count) <= LEVELS {
            let mut boxes = self.keep(node, free);
            self.cut((node, bounds), &mut boxes, groups);
            if deal(groups, below) {
                return;
            }
        }
        self.cut_equally(node, groups);
        deal(groups, below);
    }

    /// Eight groups of as many shapes; fewer when there are not so many.
    #[inline(never)]
    fn cut_equally(&mut self, node: Group, groups: &mut Groups) {
        groups.clear();
        let part = node.count.div_ceil(WIDTH);
        let end = node.first + node.count;
        let mut first = node.first;
        while first < end {
            let count = part.min(end - first);
            let _ = groups.push((Group { first, count, nodes: 0 }, self.bounds_of(first, count)));
            first += count;
        }
    }

    /// The boxes of a node's shapes, if there is room for them in nodes still to be made.
    #[inline(never)]
    fn keep<'f>(&self, node: Group, free: &'f mut [Node]) -> Boxes<'f> {
        let room = bytemuck::pod_align_to_mut(free.as_flattened_mut().as_flattened_mut()).1;
        let kept = room.get_mut(..node.count).unwrap_or_default();
        for (kept, id) in kept.iter_mut().zip(self.ids.get(node.range()).unwrap_or_default()) {
            *kept = self.bounds(*id).sides;
        }
        Boxes { first: node.first, kept }
    }

    /// Eight groups with small surfaces; fewer when there are not so many shapes.
    fn cut(&mut self, (node, bounds): (Group, Bounds), boxes: &mut Boxes<'_>, groups: &mut Groups) {
        groups.clear();
        let _ = groups.push((Group { nodes: 0, ..node }, bounds));
        while groups.len() < WIDTH {
            let Some(place) = largest(groups) else { break };
            let Some((group, bounds)) = groups.get(place).copied() else { break };
            let bounds_at = |at| self.bounds_at(at, boxes);
            let (count, below, above) = if group.count == 2 {
                // They are parted in one way only.
                (1, bounds_at(group.first), bounds_at(group.first + 1))
            } else {
                let bins = self.bins(group, boxes);
                match best_cut::<I>(&bins, group.range().map(bounds_at)) {
                    Some(cut) => self.partition(group, cut, boxes),
                    // All in one place: in the middle of the list.
                    None => (group.count / 2, bounds, bounds),
                }
            };
            halve(groups, place, count, (below, above));
        }
    }

    /// Bins across the middles of a group's boxes.
    #[inline(never)]
    fn bins(&self, group: Group, boxes: &Boxes<'_>) -> [Bins; 3] {
        let mut all = [(u32::MAX, 0); 3];
        for at in group.range() {
            for (all, middle) in all.iter_mut().zip(self.bounds_at(at, boxes).middle()) {
                *all = (middle.min(all.0), middle.max(all.1));
            }
        }
        all.map(|(from, to)| Bins::between(from, to))
    }

    /// Brings those ids first of which the box is below; gives their number, and the boxes of both
    /// parts.
    #[inline(never)]
    fn partition(
        &mut self,
        group: Group,
        cut: Cut,
        boxes: &mut Boxes<'_>,
    ) -> (usize, Bounds, Bounds) {
        let (mut below, mut above) = (Bounds::EMPTY, Bounds::EMPTY);
        let (mut from, mut to) = (group.first, group.first + group.count);
        while from < to {
            let bounds = self.bounds_at(from, boxes);
            if cut.is_below(bounds) {
                below = below.union(bounds);
                from += 1;
                continue;
            }
            above = above.union(bounds);
            to -= 1;
            swap_ends(self.ids.get_mut(from..=to));
            swap_ends(boxes.kept.get_mut(from - boxes.first..=to - boxes.first));
        }
        (from - group.first, below, above)
    }

    /// Brings leaves and their ranges before nodes.
    #[inline(never)]
    fn leaves_first(&mut self, groups: &mut [(Group, Bounds)]) {
        for _ in 0..groups.len() {
            for place in 1..groups.len() {
                let Some([a, b]) = groups.get_mut(place - 1..=place) else { return };
                if a.0.nodes == 0 || b.0.nodes > 0 {
                    continue;
                }
                let (first, count) = (a.0.first, a.0.count + b.0.count);
                if let Some(ids) = self.ids.get_mut(first..first + count) {
                    exchange(ids, a.0.count);
                }
                (a.0.first, b.0.first) = (first + b.0.count, first);
                core::mem::swap(a, b);
            }
        }
    }

    fn bounds(&self, id: I) -> Bounds {
        self.units.bounds(self.scene.shapes().bounds(id.get()))
    }

    /// The box of the shape at a place of the list.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    #[cfg_attr(not(target_pointer_width = "32"), inline)]
    fn bounds_at(&self, at: usize, boxes: &Boxes<'_>) -> Bounds {
        match boxes.kept.get(at - boxes.first) {
            Some(sides) => Bounds { sides: *sides },
            None => self.ids.get(at).map_or(Bounds::EMPTY, |id| self.bounds(*id)),
        }
    }

    #[inline(never)]
    fn bounds_of(&self, first: usize, count: usize) -> Bounds {
        let ids = self.ids.get(first..first + count).unwrap_or_default();
        ids.iter().fold(Bounds::EMPTY, |all, id| all.union(self.bounds(*id)))
    }
}

/// Puts two groups in the place of one: its first `count` shapes, and the rest.
#[inline(never)]
fn halve(groups: &mut Groups, place: usize, count: usize, (below, above): (Bounds, Bounds)) {
    let Some((group, bounds)) = groups.get_mut(place) else { return };
    let rest = Group { first: group.first + count, count: group.count - count, ..*group };
    (group.count, *bounds) = (count, below);
    // Never refused: there is room for another. `insert` could panic, for all the compiler knows.
    let _ = groups.push((rest, above));
    for at in (place + 2..groups.len()).rev() {
        if let Some([a, b]) = groups.get_mut(at - 1..=at) {
            core::mem::swap(a, b);
        }
    }
}

/// Exchanges the first and the last of some elements.
fn swap_ends<T>(elements: Option<&mut [T]>) {
    if let Some([first, .., last]) = elements {
        core::mem::swap(first, last);
    }
}

/// The place of the group with the largest surface of those that can be cut.
#[inline(never)]
fn largest(groups: &[(Group, Bounds)]) -> Option<usize> {
    let divisible = groups.iter().enumerate().filter(|(_, (group, _))| group.count > 1);
    Some(divisible.max_by_key(|(_, (_, bounds))| bounds.half_area())?.0)
}

/// Makes a node of its groups; those that get nodes wait from `next` on. Gives the one after them.
#[inline(never)]
fn lay(groups: &Groups, nodes: &mut [Node], number: usize, mut next: usize) -> usize {
    let (mut boxes, mut ends, mut end) = ([Bounds::EMPTY; WIDTH], [0; WIDTH], 0);
    let mut leaves = 0;
    let mut children = groups.iter();
    for (place, place_end) in boxes.iter_mut().zip(&mut ends) {
        if let Some((child, bounds)) = children.next() {
            *place = *bounds;
            if child.nodes == 0 {
                end += child.count;
                leaves += 1;
            } else if let Some(waiting) = nodes.get_mut(next) {
                *waiting = child.wait(*bounds);
                next += 1;
            }
        }
        *place_end = end as u8;
    }
    if let Some(node) = nodes.get_mut(number) {
        *node = pack(boxes, leaves, ends);
    }
    next
}

/// Deals nodes out; false when some group would be a leaf with too many shapes.
#[inline(never)]
fn deal(groups: &mut [(Group, Bounds)], nodes: usize) -> bool {
    let mut left = nodes;
    for (group, _) in groups.iter_mut() {
        group.nodes = least_below(group.count);
        let Some(rest) = left.checked_sub(group.nodes) else { return false };
        left = rest;
    }
    // In proportion; what a group cannot use goes to the others.
    for _ in 0..groups.len() {
        let open = |(group, _): &&mut (Group, Bounds)| group.can_use_more();
        let all: usize = groups.iter_mut().filter(open).map(|(group, _)| group.count).sum();
        let share = left as u64;
        for (group, _) in groups.iter_mut().filter(open) {
            let part = (share * group.count as u64).checked_div(all as u64).unwrap_or(0) as usize;
            let part = part.min(most_below(group.count) - group.nodes).min(left);
            group.nodes += part;
            left -= part;
        }
    }
    // What rounding left over: to the one with most shapes a node.
    while left > 0 {
        let shapes = |(group, _): &&mut (Group, Bounds)| {
            let shapes = (group.count as u64) << 16;
            shapes.checked_div(group.nodes as u64 + 1).unwrap_or(0)
        };
        let open = groups.iter_mut().filter(|(group, _)| group.can_use_more());
        let Some((group, _)) = open.max_by_key(shapes) else { break };
        group.nodes += 1;
        left -= 1;
    }
    true
}

/// Exchanges the first `count` elements with the rest.
fn exchange<T>(elements: &mut [T], count: usize) {
    if let Some((first, rest)) = elements.split_at_mut_checked(count) {
        first.reverse();
        rest.reverse();
    }
    elements.reverse();
}
