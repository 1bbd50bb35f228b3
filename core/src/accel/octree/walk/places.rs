//! From place to place: the leaf of a place is located, its exit computed, and the place beyond it
//! located again, from the root or from the smallest cell that contains both.

use super::Leaves;
use crate::accel::Id;
use crate::accel::lattice::Track;
use crate::accel::octree::code::DEEPEST;
use crate::accel::octree::{Octree, Storage};
use crate::geom::{Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;

/// A ray's place. With `NEAR` the cells on the way down to it are remembered.
pub(super) struct Places<'o, 'm, R: Real, I, C: Storage<'m>, const NEAR: bool> {
    octree: &'o Octree<'m, R, I, C>,
    ray: &'o Ray<R>,
    tracks: [Track<R>; 3],
    /// A cell of the deepest level.
    cell: [i32; 3],
    /// Where the ray enters it.
    t: R,
    /// The divided cell whose children have edges of 2 to the power of the index.
    path: [Option<C::Family>; DEEPEST as usize],
    /// Logarithm of the edge of the smallest cell that contains the place and the one before.
    common: u32,
    /// The leaf that was found last: its least cell, its edge, and the axis along which it is left.
    leaf: Option<([i32; 3], i32, usize)>,
    /// Leaves left: what bounds the walk.
    left: i32,
}

impl<'o, 'm, R: Real, I: Id, C: Storage<'m>, const NEAR: bool> Places<'o, 'm, R, I, C, NEAR> {
    pub(super) fn new(
        octree: &'o Octree<'m, R, I, C>,
        ray: &'o Ray<R>,
        slopes: &Slopes<R>,
        enter: R,
    ) -> Self {
        Self {
            octree,
            ray,
            tracks: octree.lattice.tracks(ray, slopes),
            cell: octree.lattice.cell_of(ray.at(enter)),
            t: enter,
            path: [None; DEEPEST as usize],
            common: octree.deepest,
            leaf: None,
            left: 3 << octree.deepest,
        }
    }

    /// The leaf that contains the place, and the logarithm of its edge.
    fn locate(&mut self, probe: &mut impl Probe) -> (C::Cell, u32) {
        let cells = &self.octree.cells;
        let (mut cell, mut shift) = (cells.root(), self.octree.deepest);
        let mut family = None;
        probe.step();
        if NEAR && self.common < shift {
            shift = self.common;
            family =
                shift.checked_sub(1).and_then(|s| self.path.get(s as usize)).copied().flatten();
        }
        while shift > 0 {
            let Some(children) = family.or_else(|| cells.open(cell)) else { break };
            family = None;
            shift -= 1;
            if NEAR && let Some(place) = self.path.get_mut(shift as usize) {
                *place = Some(children);
            }
            let [x, y, z] = self.cell.map(|c| (c >> shift) as u32 & 1);
            cell = C::child(children, x | y << 1 | z << 2);
            probe.step();
        }
        (cell, shift)
    }

    /// Exactly one cell beyond the wall through which the ray leaves a cell, and within the cell in
    /// the other directions; `None` when that is outside the root.
    fn beyond(&self, base: [i32; 3], size: i32, axis: usize) -> Option<[i32; 3]> {
        let mut next = self.octree.lattice.cell_of(self.ray.at(self.t));
        for (c, base) in next.iter_mut().zip(base) {
            *c = (*c).max(base).min(base + size - 1);
        }
        let (base, track) = (base.get(axis)?, self.tracks.get(axis)?);
        let c = if track.sign > 0 { base + size } else { base - 1 };
        *next.get_mut(axis)? = c;
        (track.sign != 0 && c >= 0 && c < 1 << self.octree.deepest).then_some(next)
    }
}

impl<'m, R: Real, I: Id, C: Storage<'m>, const NEAR: bool> Leaves<R, C::Cell>
    for Places<'_, 'm, R, I, C, NEAR>
{
    fn next(&mut self, probe: &mut impl Probe) -> Option<C::Cell> {
        if let Some((base, size, axis)) = self.leaf {
            let next = self.beyond(base, size, axis)?;
            let [x, y, z] = next;
            let [old_x, old_y, old_z] = self.cell;
            let differing = (x ^ old_x) | (y ^ old_y) | (z ^ old_z);
            self.common = i32::BITS - differing.leading_zeros();
            self.cell = next;
        }
        self.left = self.left.checked_sub(1).filter(|left| *left >= 0)?;
        let (cell, shift) = self.locate(probe);

        // The first of the leaf's walls that the ray meets.
        let size = 1 << shift;
        let base = self.cell.map(|c| c >> shift << shift);
        let ([x, y, z], [bx, by, bz]) = (self.tracks, base);
        let (tx, ty, tz) = (x.exit(bx, size), y.exit(by, size), z.exit(bz, size));
        let (exit, axis) = if tx <= ty && tx <= tz {
            (tx, 0)
        } else if ty <= tz {
            (ty, 1)
        } else {
            (tz, 2)
        };
        // Rounding may put a wall a little before the one just passed; never go back.
        self.t = self.t.max(exit);
        self.leaf = Some((base, size, axis));
        Some(cell)
    }

    fn exit(&self) -> R {
        self.t
    }
}
