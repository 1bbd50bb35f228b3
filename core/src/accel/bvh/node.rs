//! A node of 64 bytes: the boxes of eight children, a byte a side.
//!
//! T. Ylitie, T. Karras, S. Laine, "Efficient incoherent ray traversal on GPUs through compressed
//! wide BVHs", HPG 2017: sides are whole steps from the least corner of the node's own box, a step
//! being a power of two, another one along each axis. Before: J. Mahovsky and B. Wyvill,
//! "Memory-conserving bounding volume hierarchies with coherent raytracing", CGF 25(2) (2006).

use super::units::{Bounds, Course};
use crate::num::{Progress, Real};
use core::ops::Range;

/// Children of a node.
pub(super) const WIDTH: usize = 8;

const ROWS: usize = 8;

/// A node as it is stored.
///
/// | row | a byte a child |
/// |---|---|
/// | 0 to 2 | least x, y, z of its box, in steps |
/// | 3 to 5 | greatest x, y, z |
/// | 6 | (of all children) the least corner in units, 2 bytes a coordinate; logarithms of the steps and the number of leaves, 4 bits each |
/// | 7 | where its ids end, counted from where the node's ids begin |
///
/// Leaves come first. Other children are nodes, or nothing when their box is empty.
pub(super) type Node = [[u8; WIDTH]; ROWS];

/// Packs a node: boxes of the children, rounded outwards to steps; how many are leaves, and where
/// their ids end.
pub(super) fn pack(children: [Bounds; WIDTH], leaves: u8, ends: [u8; WIDTH]) -> Node {
    let whole = children.iter().fold(Bounds::EMPTY, |all, child| all.union(*child));
    let [[x, y, z], [hx, hy, hz]] = whole.corners();
    let [cx, cy, cz] = [(x, hx), (y, hy), (z, hz)].map(|(lo, hi)| Scale::of(lo, hi));
    let ([x0, x1], [y0, y1], [z0, z1]) = (x.to_le_bytes(), y.to_le_bytes(), z.to_le_bytes());
    let corners = children.map(Bounds::corners);
    let [lo, hi] = [corners.map(|[lo, _]| lo), corners.map(|[_, hi]| hi)];
    [
        lo.map(|[x, _, _]| cx.down(x)),
        lo.map(|[_, y, _]| cy.down(y)),
        lo.map(|[_, _, z]| cz.down(z)),
        hi.map(|[x, _, _]| cx.up(x)),
        hi.map(|[_, y, _]| cy.up(y)),
        hi.map(|[_, _, z]| cz.up(z)),
        [x0, x1, y0, y1, z0, z1, cx.shift | cy.shift << 4, cz.shift | leaves << 4],
        ends,
    ]
}

/// How many children are leaves.
#[inline(always)]
pub(super) fn leaves_of(node: &Node) -> usize {
    let [.., [.., last], _] = node;
    usize::from(last >> 4)
}

/// Where the ids of a child begin and end, counted from where the node's begin.
#[inline(always)]
pub(super) fn ids_of(node: &Node, place: usize) -> Range<usize> {
    const ENDS: usize = (ROWS - 1) * WIDTH;
    let bytes = node.as_flattened();
    let at = |at: usize| bytes.get(at % (ROWS * WIDTH)).copied().unwrap_or(0).into();
    // They begin where those of the one before it end. What that is not is read, too: no branch.
    let before = at(ENDS + place - 1);
    (if place > 0 { before } else { 0 })..at(ENDS + place)
}

/// Steps along an axis.
#[derive(Clone, Copy)]
struct Scale {
    from: u16,
    shift: u8,
}

impl Scale {
    /// The finest one of which 255 steps are enough.
    fn of(lo: u16, hi: u16) -> Self {
        let extent = hi.saturating_sub(lo);
        let shift = (0..8).find(|shift| extent <= 255 << shift).unwrap_or(8);
        Self { from: lo, shift }
    }

    /// 255 for the empty box.
    fn down(self, at: u16) -> u8 {
        (at.saturating_sub(self.from) >> self.shift).min(255) as u8
    }

    /// 0 for the empty box.
    fn up(self, at: u16) -> u8 {
        let steps = u32::from(at.saturating_sub(self.from)) + (1 << self.shift) - 1;
        (steps >> self.shift) as u8
    }
}

/// Which children's boxes a ray meets between two parameters, a bit for each, and where it enters
/// them.
///
/// T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986.
#[inline(always)]
pub(super) fn hits<R: Real>(
    node: &Node,
    courses: &[Course<R>; 3],
    (start, limit): (R, R),
    near: &mut [R; WIDTH],
) -> u32 {
    // Every byte's lowest bit, side by side in the highest byte.
    let bytes = clip(node, courses, start, limit, near);
    (bytes.wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32
}

/// The same, one child after the other.
#[inline(always)]
pub(super) fn each_hit<R: Real>(
    node: &Node,
    courses: &[Course<R>; 3],
    (start, limit): (R, R),
    mut hit: impl FnMut(usize, R),
) {
    let slabs = Slabs::all(node, courses);
    for place in 0..WIDTH {
        if let Some(t) = clip_one(&slabs, place, start, limit) {
            hit(place, t);
        }
    }
}

/// Where a ray enters the boxes of the eight children, and a byte for each: 1 if it does, else 0. A
/// box that it passes by is left before it is entered.
///
/// Not inlined: that makes compilers compute the eight side by side.
#[inline(never)]
fn clip<R: Real>(
    node: &Node,
    courses: &[Course<R>; 3],
    start: R,
    limit: R,
    near: &mut [R; WIDTH],
) -> u64 {
    let [x, y, z] = Slabs::all(node, courses);
    let mut hits = [0; WIDTH];
    // As a processor's instruction does; `Real::max` and `min` decide more than is needed here.
    let greater = |a: R, b: R| if a > b { a } else { b };
    let smaller = |a: R, b: R| if a < b { a } else { b };
    let nearest = x.near.iter().zip(y.near).zip(z.near);
    let farthest = x.far.iter().zip(y.far).zip(z.far);
    let children = near.iter_mut().zip(&mut hits).zip(nearest.zip(farthest));
    for ((near, hit), (((x0, y0), z0), ((x1, y1), z1))) in children {
        *near = greater(greater(x.at(*x0), y.at(*y0)), greater(z.at(*z0), start));
        let far = smaller(smaller(x.at(*x1), y.at(*y1)), smaller(z.at(*z1), limit));
        *hit = u8::from(*near <= far);
    }
    u64::from_le_bytes(hits)
}

/// The children's sides along one axis, seen by a ray.
struct Slabs<'n, R: Real> {
    /// In steps: by which the ray enters, and by which it leaves.
    near: &'n [u8; WIDTH],
    far: &'n [u8; WIDTH],
    /// The parameters at which the ray meets steps.
    steps: R::Progress,
}

impl<'n, R: Real> Slabs<'n, R> {
    /// Along all axes.
    #[inline(always)]
    fn all(node: &'n Node, [x, y, z]: &[Course<R>; 3]) -> [Self; 3] {
        let [.., [x0, x1, y0, y1, z0, z1, xy, shift_z], _] = node;
        [
            Self::of(node, x, [*x0, *x1], xy & 15),
            Self::of(node, y, [*y0, *y1], xy >> 4),
            Self::of(node, z, [*z0, *z1], shift_z & 15),
        ]
    }

    #[inline(always)]
    fn of(node: &'n Node, course: &Course<R>, origin: [u8; 2], shift: u8) -> Self {
        let row = |row: usize| node.get(row % ROWS).unwrap_or(&[0; WIDTH]);
        Self {
            near: row(course.near),
            far: row(course.far),
            steps: course.units.rebased(u16::from_le_bytes(origin).into(), shift),
        }
    }

    /// A side as a parameter.
    #[inline(always)]
    fn at(&self, side: u8) -> R {
        self.steps.at(side.into())
    }
}

/// Where a ray enters the box of one child. It pays to stop at the first axis along which it passes
/// by; the answer is the same.
#[inline(always)]
fn clip_one<R: Real>(slabs: &[Slabs<'_, R>; 3], place: usize, start: R, limit: R) -> Option<R> {
    let (mut enter, mut leave) = (start, limit);
    for slab in slabs {
        let side = |sides: &[u8; WIDTH]| sides.get(place % WIDTH).copied().unwrap_or(0);
        let (near, far) = (slab.at(side(slab.near)), slab.at(side(slab.far)));
        if near > enter {
            enter = near;
        }
        if far < leave {
            leave = far;
        }
        if !(enter <= leave) {
            return None;
        }
    }
    Some(enter)
}
