//! Whole-number coordinates: boxes of shapes and the way of a ray through them.
//!
//! A cube around the scene is divided into [`ALONG`] units along each axis. The box of a shape is
//! rounded outwards to units once, when the tree is built; from there on everything about boxes is
//! exact and needs no floating point. Units of 16 bits are about as fine as what boxes are padded by
//! in `f32`, so more digits would gain nothing.

use crate::accel::lattice;
use crate::geom::{Aabb, Ray};
use crate::num::{Axis, Cells, FOURS, Progress, Real, Vec3, Vector};
use crate::scene::{Scene, Shapes};

/// Units along the longest axis of a scene: less than 255 times 256, so that 255 steps of a power of
/// two up to 2^8 are enough for every extent.
const ALONG: i32 = 65_000;

/// The sides of a box, and what fills them up to what processors compute at a time that can.
pub(super) type Sides = [u16; if FOURS { 8 } else { 6 }];

/// A closed box in units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bounds {
    /// The lower ones, then the upper ones. These with all bits turned where numbers are computed side
    /// by side: a union is the least of each, then.
    pub(super) sides: Sides,
}

impl Bounds {
    /// Contains nothing; a union with it changes nothing.
    pub(super) const EMPTY: Self = Self::between([[u16::MAX; 3], [0; 3]]);

    /// Between its least and its greatest corner.
    #[inline(always)]
    pub(super) const fn between([lo, hi]: [[u16; 3]; 2]) -> Self {
        let mut sides = [u16::MAX; size_of::<Sides>() / size_of::<u16>()];
        [sides[0], sides[1], sides[2]] = lo;
        let [x, y, z] = hi;
        [sides[3], sides[4], sides[5]] = [turned(x), turned(y), turned(z)];
        Self { sides }
    }

    /// Its least and its greatest corner.
    #[inline(always)]
    pub(super) fn corners(self) -> [[u16; 3]; 2] {
        let [x, y, z, hx, hy, hz, ..] = self.sides;
        [[x, y, z], [hx, hy, hz].map(turned)]
    }

    // Modules of WebAssembly are to be small.
    #[cfg_attr(target_family = "wasm", inline(never))]
    #[cfg_attr(not(target_family = "wasm"), inline)]
    pub(super) fn union(mut self, other: Self) -> Self {
        if FOURS {
            self.sides.iter_mut().zip(other.sides).for_each(|(side, x)| *side = x.min(*side));
            return self;
        }
        let ([[ax, ay, az], [bx, by, bz]], [[cx, cy, cz], [dx, dy, dz]]) =
            (self.corners(), other.corners());
        let lo = [ax.min(cx), ay.min(cy), az.min(cz)];
        Self::between([lo, [bx.max(dx), by.max(dy), bz.max(dz)]])
    }

    /// Half the area of its surface; 0 for the empty box.
    pub(super) fn half_area(self) -> u64 {
        let [[ax, ay, az], [bx, by, bz]] = self.corners();
        let size = |lo: u16, hi: u16| u32::from(hi.saturating_sub(lo));
        let (x, y, z) = (size(ax, bx), size(ay, by), size(az, bz));
        // A product of 16 bits by 16 bits is one instruction.
        u64::from(x * y) + u64::from(y * z) + u64::from(z * x)
    }

    /// Twice its middle.
    pub(super) fn middle(self) -> [u32; 3] {
        let [[ax, ay, az], [bx, by, bz]] = self.corners();
        let sum = |lo: u16, hi: u16| u32::from(lo) + u32::from(hi);
        [sum(ax, bx), sum(ay, by), sum(az, bz)]
    }
}

/// How an upper side is stored, and back.
const fn turned(side: u16) -> u16 {
    if FOURS { !side } else { side }
}

/// The division of the room that a scene takes into units, as long along every axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units<R: Real> {
    origin: Vec3<R>,
    /// The same along each axis.
    cells: R::Cells,
    /// How far shapes reach beyond their boxes.
    pad: R,
}

impl<R: Real> Units<R> {
    pub(super) fn of<S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Self {
        let root = lattice::root(scene.bounds(), scene.pad(), 32, 32);
        // Of a small scene far away from the origin no coordinate is known that finely; 255 units
        // are to be more than a rounding error, or rays would enter boxes that are empty.
        let least = scene.bounds().max_abs() * R::fraction(1, 256);
        let along = root.size().max_abs().max(least);
        Self { origin: root.lo, cells: Cells::new(along, ALONG), pad: scene.pad() }
    }

    /// The box of a shape, padded and rounded outwards.
    pub(super) fn bounds(&self, bounds: Aabb<R>) -> Bounds {
        let bounds = bounds.grown(self.pad);
        let units = |p: Vec3<R>| (p - self.origin).to_array().map(|x| self.cells.index(x));
        // Cutting off is rounding down for all that is not raised to 0. The unit that is added
        // above rounds up.
        let whole = |x: i32| x.clamp(0, ALONG) as u16;
        Bounds::between([units(bounds.lo).map(whole), units(bounds.hi).map(|x| whole(x) + 1)])
    }

    /// A ray seen along each of the three axes. Three divisions.
    pub(super) fn courses(&self, ray: &Ray<R>) -> [Course<R>; 3] {
        Axis::ALL.map(|axis| {
            let from = self.origin.along(axis) - ray.origin().along(axis);
            let units = R::Progress::steep(ray.direction().along(axis), from, &self.cells);
            let (lo, hi) = (axis.index(), 3 + axis.index());
            let (near, far) = if units.falls() { (hi, lo) } else { (lo, hi) };
            Course { units, near, far }
        })
    }
}

/// A ray's way along one axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<R: Real> {
    /// The parameters at which it meets whole units.
    pub(super) units: R::Progress,
    /// The row of a [`Node`](super::node::Node) with the sides by which it enters boxes.
    pub(super) near: usize,
    /// The one with the sides by which it leaves them.
    pub(super) far: usize,
}
