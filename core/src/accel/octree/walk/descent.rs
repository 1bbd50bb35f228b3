//! Down the tree, front to back, with a small stack.
//!
//! The parameters at which a ray meets the three middle walls of a cell say through which children
//! it passes, and in which order: in whichever child it is at parameter `t`, it has passed exactly
//! the walls with parameters up to `t`. So a cell on the stack needs no more than these three
//! parameters and the one at which the ray leaves it, and `t` alone says where to go on.

use super::Leaves;
use crate::accel::Id;
use crate::accel::lattice::{Corner, Halved, HalvesOf, Middle};
use crate::accel::octree::code::DEEPEST;
use crate::accel::octree::{Octree, Storage};
use crate::geom::Ray;
use crate::num::{Halves, Real};
use crate::probe::Probe;

/// A divided cell that the ray is in.
#[derive(Clone, Copy)]
struct Open<F, R: Real> {
    children: F,
    /// Where the ray meets its middle walls.
    middle: [Middle<R>; 3],
    /// The parameter at which the ray leaves it.
    exit: R,
}

/// A descent under way.
pub(super) struct Descent<'o, 'm, R: Real, I, C: Storage<'m>> {
    octree: &'o Octree<'m, R, I, C>,
    halves: [HalvesOf<R>; 3],
    /// Where the ray meets the first walls.
    first: [Middle<R>; 3],
    /// The axes, as bits of an octant, along which the ray meets the upper halves first.
    mirrored: u32,
    /// The cells above the present one, from the root.
    stack: [Option<Open<C::Family, R>>; DEEPEST as usize],
    depth: usize,
    /// The present cell, its least corner, and the parameters at which it is entered and left.
    cell: C::Cell,
    corner: [Corner<R>; 3],
    enter: R,
    exit: R,
    /// The middle walls of the cell above that the ray has passed, as bits.
    passed: u32,
    /// Whether it is a leaf that is done with.
    done: bool,
}

impl<'o, 'm, R: Real, I: Id, C: Storage<'m>> Descent<'o, 'm, R, I, C> {
    /// Of a ray that meets the octree within an interval.
    #[inline(never)]
    pub(super) fn new(
        octree: &'o Octree<'m, R, I, C>,
        ray: &Ray<R>,
        interval: (R, R),
    ) -> Option<Self> {
        let (ways, (enter, leave)) = octree.lattice.halved(ray, interval, octree.deepest)?;
        let [x, y, z] = ways;
        let backward = |along: Halved<R>| u32::from(along.backward);
        Some(Self {
            octree,
            halves: [x.halves, y.halves, z.halves],
            first: [x.first, y.first, z.first],
            mirrored: backward(x) | backward(y) << 1 | backward(z) << 2,
            stack: [None; DEEPEST as usize],
            depth: 0,
            cell: octree.cells.root(),
            corner: Default::default(),
            enter,
            exit: leave,
            passed: 7,
            done: false,
        })
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

    /// The middle walls of the present cell, from those of the cell above.
    #[inline(always)]
    fn middle(&self, above: [Middle<R>; 3]) -> [Middle<R>; 3] {
        let ([hx, hy, hz], [x, y, z], [cx, cy, cz]) = (self.halves, above, self.corner);
        let (level, deepest) = (self.depth as u32, self.octree.deepest);
        let passed = |bit: u32| self.passed >> bit & 1 != 0;
        [
            hx.middle(x, passed(0), cx, level, deepest),
            hy.middle(y, passed(1), cy, level, deepest),
            hz.middle(z, passed(2), cz, level, deepest),
        ]
    }

    /// Goes to the child that the ray is in now.
    #[inline(always)]
    fn go(&mut self, open: &Open<C::Family, R>) {
        let ([hx, hy, hz], [x, y, z], t) = (self.halves, open.middle, self.enter);
        let (by_x, exit) = hx.pass(x, t, open.exit);
        let (by_y, exit) = hy.pass(y, t, exit);
        let (by_z, exit) = hz.pass(z, t, exit);
        self.passed = u32::from(by_x) | u32::from(by_y) << 1 | u32::from(by_z) << 2;
        let octant = self.passed ^ self.mirrored;
        // Logarithm of the edges of the children.
        let shift = self.octree.deepest.saturating_sub(self.depth as u32);
        let [x, y, z] = self.corner;
        let corner = |c: Corner<R>, bit: u32| {
            <HalvesOf<R> as Halves<R>>::corner(c, octant >> bit & 1 != 0, shift)
        };
        self.corner = [corner(x, 0), corner(y, 1), corner(z, 2)];
        self.cell = C::child(open.children, octant);
        self.exit = exit;
    }
}

/// Every step ends at a wall beyond the one before, or at the end of the ray: there are no more
/// steps than walls.
impl<'m, R: Real, I: Id, C: Storage<'m>> Leaves<R, C::Cell> for Descent<'_, 'm, R, I, C> {
    fn next(&mut self, probe: &mut impl Probe) -> Option<C::Cell> {
        let mut above = self.first;
        if self.done {
            self.enter = self.exit;
            let open = self.last()?;
            self.go(&open);
            above = open.middle;
        }
        loop {
            probe.step();
            let Some(children) = self.octree.cells.open(self.cell) else {
                self.done = true;
                return Some(self.cell);
            };
            let open = Open { children, middle: self.middle(above), exit: self.exit };
            *self.stack.get_mut(self.depth)? = Some(open);
            self.depth += 1;
            self.go(&open);
            above = open.middle;
        }
    }

    fn exit(&self) -> R {
        self.exit
    }
}
