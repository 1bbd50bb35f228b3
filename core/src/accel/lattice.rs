//! A box divided into equal cells with whole-number coordinates: what grid and octree stand on.
//!
//! Walls are computed from their number by one multiplication and never accumulated, and a cell is
//! known by its numbers, not by where a point happens to lie: so neither steps nor shapes can drift.

use crate::geom::{Aabb, Ray, Slopes};
use crate::num::{Axis, Cells, Halves, Progress, Real, Vec3, Vector};

/// Cells per axis at most: coordinates of cells stay exact in every number type.
pub(crate) const MOST_CELLS: i32 = 1 << 20;

/// A box and its division.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice<R: Real> {
    bounds: Aabb<R>,
    cells: [R::Cells; 3],
    /// How far shapes reach beyond their boxes.
    pad: R,
    count: [i32; 3],
}

impl<R: Real> Lattice<R> {
    /// Divides a box. Counts are brought into 1 to [`MOST_CELLS`].
    pub(crate) fn new(bounds: Aabb<R>, count: [u32; 3], pad: R) -> Self {
        let count = count.map(|n| n.clamp(1, MOST_CELLS as u32) as i32);
        let ([x, y, z], [nx, ny, nz]) = (bounds.size().to_array(), count);
        Self {
            bounds,
            cells: [Cells::new(x, nx), Cells::new(y, ny), Cells::new(z, nz)],
            pad,
            count,
        }
    }

    pub(crate) fn count(&self) -> [i32; 3] {
        self.count
    }

    /// The parameters between which a ray is inside.
    pub(crate) fn clip(&self, slopes: &Slopes<R>, min: R, max: R) -> Option<(R, R)> {
        slopes.clip(self.bounds.lo, self.bounds.hi, min, max)
    }

    /// The cells of a point, the nearest ones when it lies outside.
    pub(crate) fn cell_of(&self, p: Vec3<R>) -> [i32; 3] {
        let [nx, ny, nz] = self.count;
        let [x, y, z] = (p - self.bounds.lo).to_array();
        // (`clamp` would bring a panic for a lower end above the upper one.)
        let cell = |cells: &R::Cells, x: R, n: i32| cells.index(x).min(n - 1).max(0);
        let [cx, cy, cz] = &self.cells;
        [cell(cx, x, nx), cell(cy, y, ny), cell(cz, z, nz)]
    }

    /// The first and the last cells that a shape's box touches, once it is padded.
    pub(crate) fn cells_of(&self, bounds: Aabb<R>) -> ([i32; 3], [i32; 3]) {
        let bounds = bounds.grown(self.pad);
        (self.cell_of(bounds.lo), self.cell_of(bounds.hi))
    }

    /// The box of some cells, padded as shapes' boxes are.
    pub(crate) fn room(&self, first: [i32; 3], count: [i32; 3]) -> Aabb<R> {
        let [cx, cy, cz] = &self.cells;
        let corner = |[x, y, z]: [i32; 3]| {
            self.bounds.lo + Vec3::<R>::new(cx.wall(x), cy.wall(y), cz.wall(z))
        };
        let ([x, y, z], [nx, ny, nz]) = (first, count);
        let room = Aabb { lo: corner(first), hi: corner([x + nx, y + ny, z + nz]) };
        room.grown(self.pad)
    }

    /// A ray's way along an axis, from where it enters the box to where it leaves it.
    // Modules of WebAssembly are to be small.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(crate) fn way(&self, ray: &Ray<R>, axis: Axis) -> Way<R> {
        let ([nx, ny, nz], [cx, cy, cz]) = (self.count, &self.cells);
        let (count, cells) = match axis {
            Axis::X => (nx, cx),
            Axis::Y => (ny, cy),
            Axis::Z => (nz, cz),
        };
        let (o, d) = (ray.origin().along(axis), ray.direction().along(axis));
        let lo = self.bounds.lo.along(axis);
        match R::Progress::of(d, lo - o, cells, count) {
            Some(walls) if d > R::ZERO => {
                Way { sign: 1, enter: walls.at(0), leave: walls.at(count), walls }
            }
            Some(walls) => {
                let (enter, leave) = (walls.at(count), walls.at(0));
                Way { sign: -1, walls: walls.along(-1), enter, leave }
            }
            None => {
                let inside = o >= lo && o <= self.bounds.hi.along(axis);
                let leave = if inside { R::INFINITY } else { -R::INFINITY };
                Way { sign: 0, walls: R::Progress::never(), enter: -R::INFINITY, leave }
            }
        }
    }

    /// A ray seen along each of the three axes.
    pub(crate) fn tracks(&self, ray: &Ray<R>, slopes: &Slopes<R>) -> [Track<R>; 3] {
        let ([nx, ny, nz], [cx, cy, cz]) = (self.count, &self.cells);
        [(Axis::X, nx, cx), (Axis::Y, ny, cy), (Axis::Z, nz, cz)].map(|(axis, count, cells)| {
            let from = self.bounds.lo.along(axis) - ray.origin().along(axis);
            match Progress::new(slopes.along(axis), from, cells, count) {
                Some(walls) => Track { sign: slopes.sign(axis), walls },
                None => Track { sign: 0, walls: R::Progress::never() },
            }
        })
    }

    /// The part of a ray within an interval that is inside a lattice of 2^`deepest` cells along each
    /// axis, and its way along each of the three.
    pub(crate) fn halved(
        &self,
        ray: &Ray<R>,
        interval: Part<R>,
        deepest: u32,
    ) -> Option<([Halved<R>; 3], Part<R>)> {
        let [cx, cy, cz] = &self.cells;
        let (x, part) = self.halved_along(Axis::X, cx, ray, interval, deepest)?;
        let (y, part) = self.halved_along(Axis::Y, cy, ray, part, deepest)?;
        let (z, part) = self.halved_along(Axis::Z, cz, ray, part, deepest)?;
        (part.0 <= part.1).then_some(([x, y, z], part))
    }

    #[inline(always)]
    fn halved_along(
        &self,
        axis: Axis,
        cells: &R::Cells,
        ray: &Ray<R>,
        part: Part<R>,
        deepest: u32,
    ) -> Option<(Halved<R>, Part<R>)> {
        let (o, d) = (ray.origin().along(axis), ray.direction().along(axis));
        let lo = self.bounds.lo.along(axis);
        let (count, backward) = (1 << deepest, d < R::ZERO);
        let Some(walls) = R::Progress::of(d, lo - o, cells, count) else {
            // Where it stays, it is inside or it is not.
            let is_inside = o >= lo && o <= self.bounds.hi.along(axis);
            let cell = cells.index(o - lo).min(count - 1).max(0);
            let (halves, first) = Halves::standing(cell, deepest);
            return is_inside.then_some((Halved { backward: false, halves, first }, part));
        };
        let (halves, first) = walls.halves(backward, deepest);
        let part = halves.between(first, part, backward, deepest)?;
        Some((Halved { backward, halves, first }, part))
    }
}

/// A ray's way along one axis of a lattice, seen as it goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way<R: Real> {
    /// Whether cell numbers grow (1), shrink (-1) or stay (0).
    pub(crate) sign: i32,
    /// Where it is inside along this axis, all else left aside.
    pub(crate) enter: R,
    pub(crate) leave: R,
    /// The parameters at which the ray meets walls, by their numbers times the sign: those grow.
    pub(crate) walls: R::Progress,
}

/// A ray's way along one axis of a lattice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track<R: Real> {
    /// Whether cell numbers grow (1), shrink (-1) or stay (0).
    pub(crate) sign: i32,
    /// The parameters at which the ray meets walls.
    walls: R::Progress,
}

impl<R: Real> Track<R> {
    /// The parameter at which the ray meets wall number `i`; cell `i` lies behind it. Beyond every
    /// distance when the ray does not move along this axis.
    ///
    /// Rounding moves the point there by less than half of what shapes' boxes are padded by: 1.5
    /// units in the last place of the distances from the origin to the first wall and from that to
    /// the last, and half a unit of the result, are at most 13 units of the scene's greatest
    /// coordinate, as rays start no farther away than four times that.
    pub(crate) fn crossing(&self, i: i32) -> R {
        self.walls.at(i)
    }

    /// The parameter at which the ray leaves the cells `first..first + count`.
    pub(crate) fn exit(&self, first: i32, count: i32) -> R {
        self.crossing(if self.sign > 0 { first + count } else { first })
    }
}

/// A part of a ray, by the parameters at its ends.
pub(crate) type Part<R> = (R, R);

/// A ray's way along one axis of a lattice whose cells are halved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halved<R: Real> {
    /// Whether cell numbers shrink: it comes to upper halves first.
    pub(crate) backward: bool,
    pub(crate) halves: HalvesOf<R>,
    /// Where it meets the first wall.
    pub(crate) first: Middle<R>,
}

/// See [`Progress::Halves`].
pub(crate) type HalvesOf<R> = <<R as Real>::Progress as Progress<R>>::Halves;

/// See [`Halves::Middle`].
pub(crate) type Middle<R> = <HalvesOf<R> as Halves<R>>::Middle;

/// See [`Halves::Corner`].
pub(crate) type Corner<R> = <HalvesOf<R> as Halves<R>>::Corner;

/// The box of a structure's root: that of its shapes, a little larger, so that no face of a shape
/// lies in an outer wall and scenes without thickness get some.
///
/// `lower` and `upper` say how much is added at either end, in 2^-15 of the extent.
pub(crate) fn root<R: Real>(bounds: Aabb<R>, pad: R, lower: i32, upper: i32) -> Aabb<R> {
    // Without any shape, any box will do.
    let least = if pad > R::ZERO { pad + pad } else { R::ONE };
    let unit = R::fraction(1, 1 << 15);
    let grow = |n: i32| bounds.size().map(|s| (s * unit).times_int(n).max(least));
    Aabb { lo: bounds.lo - grow(lower), hi: bounds.hi + grow(upper) }
}
