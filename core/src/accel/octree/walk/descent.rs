//! Down the tree, front to back, with a small stack.
//!
//! The parameters at which a ray meets the three middle walls of a cell say through which children
//! it passes, and in which order: in whichever child it is at parameter `t`, it has passed exactly
//! the walls with parameters up to `t`. So a cell on the stack needs no more than these three
//! parameters and the one at which the ray leaves it, and `t` alone says where to go on.

use super::Leaves;
use crate::accel::Id;
use crate::accel::lattice::Track;
use crate::accel::octree::code::DEEPEST;
use crate::accel::octree::{Octree, Storage};
use crate::geom::{Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;

/// A divided cell that the ray is in.
#[derive(Clone, Copy)]
struct Open<F, R> {
    children: F,
    /// Parameters of its middle walls.
    middle: [R; 3],
    /// The parameter at which the ray leaves it.
    exit: R,
}

impl<F, R: Real> Open<F, R> {
    /// The child that the ray is in behind parameter `t`, and where it leaves that.
    fn at(&self, t: R, mirrored: u32) -> (u32, R) {
        let [x, y, z] = self.middle;
        let passed = u32::from(x <= t) | u32::from(y <= t) << 1 | u32::from(z <= t) << 2;
        let first = |exit: R, wall: R| if wall > t && wall < exit { wall } else { exit };
        (passed ^ mirrored, first(first(first(self.exit, x), y), z))
    }
}

/// A descent under way.
pub(super) struct Descent<'o, 'm, R: Real, I, C: Storage<'m>> {
    octree: &'o Octree<'m, R, I, C>,
    tracks: [Track<R>; 3],
    /// The axes, as bits of an octant, along which the ray meets the upper halves first.
    mirrored: u32,
    /// The cells above the present one, from the root.
    stack: [Option<Open<C::Family, R>>; DEEPEST as usize],
    depth: usize,
    /// The present cell, its least corner, and the parameters at which it is entered and left.
    cell: C::Cell,
    corner: [i32; 3],
    enter: R,
    exit: R,
    /// Whether it is a leaf that is done with.
    done: bool,
}

impl<'o, 'm, R: Real, I: Id, C: Storage<'m>> Descent<'o, 'm, R, I, C> {
    pub(super) fn new(
        octree: &'o Octree<'m, R, I, C>,
        ray: &Ray<R>,
        slopes: &Slopes<R>,
        enter: R,
        leave: R,
    ) -> Self {
        let [x, y, z] = octree.lattice.tracks(ray, slopes);
        let [cx, cy, cz] = octree.lattice.cell_of(ray.at(enter));
        let backward = |track: Track<R>| u32::from(track.sign < 0);
        Self {
            octree,
            tracks: [x.standing(cx), y.standing(cy), z.standing(cz)],
            mirrored: backward(x) | backward(y) << 1 | backward(z) << 2,
            stack: [None; DEEPEST as usize],
            depth: 0,
            cell: octree.cells.root(),
            corner: [0; 3],
            enter,
            exit: leave,
            done: false,
        }
    }

    /// Logarithm of the edges of the children of the last cell on the stack.
    fn shift(&self) -> u32 {
        self.octree.deepest.saturating_sub(self.depth as u32)
    }

    /// The last cell on the stack that the ray has not left yet.
    fn last(&mut self) -> Option<Open<C::Family, R>> {
        loop {
            let open = self.stack.get(self.depth.checked_sub(1)?).copied().flatten()?;
            if self.enter < open.exit {
                return Some(open);
            }
            self.depth -= 1;
        }
    }

    /// Goes to the child that the ray is in now.
    fn go(&mut self, open: &Open<C::Family, R>) {
        let (octant, exit) = open.at(self.enter, self.mirrored);
        let (shift, [x, y, z]) = (self.shift(), self.corner);
        let child = |c: i32, bit: u32| (c >> shift >> 1 << 1 | (octant >> bit & 1) as i32) << shift;
        self.corner = [child(x, 0), child(y, 1), child(z, 2)];
        self.cell = C::child(open.children, octant);
        self.exit = exit;
    }
}

/// Every step ends at a wall beyond the one before, or at the end of the ray: there are no more
/// steps than walls.
impl<'m, R: Real, I: Id, C: Storage<'m>> Leaves<R, C::Cell> for Descent<'_, 'm, R, I, C> {
    fn next(&mut self, probe: &mut impl Probe) -> Option<(C::Cell, R)> {
        if self.done {
            self.enter = self.exit;
            let open = self.last()?;
            self.go(&open);
        }
        loop {
            probe.step();
            let Some(children) = self.octree.cells.open(self.cell) else {
                self.done = true;
                return Some((self.cell, self.exit));
            };
            self.depth += 1;
            let half = 1 << self.shift();
            let ([x, y, z], [cx, cy, cz]) = (self.tracks, self.corner);
            let middle = [x.crossing(cx + half), y.crossing(cy + half), z.crossing(cz + half)];
            let open = Open { children, middle, exit: self.exit };
            *self.stack.get_mut(self.depth - 1)? = Some(open);
            self.go(&open);
        }
    }
}
