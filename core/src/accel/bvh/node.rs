//! A node of 36 bytes: boxes of four children in a byte a side.
//!
//! Boxes are stored as steps from the least corner of the node's own box; a step is a power of two
//! of units, another one along each axis, rounded outwards. T. Ylitie, T. Karras, S. Laine,
//! "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", HPG 2017. J. Mahovsky
//! and B. Wyvill, "Memory-conserving bounding volume hierarchies with coherent raytracing", CGF
//! 25(2) (2006), for boxes in whole numbers relative to their parent's.

use super::units::{Bounds, Course};
use crate::num::Real;

/// Children of a node.
pub(super) const WIDTH: usize = 4;

/// A node as it is stored:
///
/// | word | bytes from the least significant |
/// |---|---|
/// | 0 to 2 | least x, y, z of the four children's boxes, in steps |
/// | 3 to 5 | greatest x, y, z |
/// | 6 | x and y of the node's least corner, 2 bytes each, in units |
/// | 7 | z of it; 4 bits each: logarithms of the step along x, y, z |
/// | 8 | where the leaves among the children end in the node's range of the list of ids |
///
/// Leaves come first; a child of which the range is empty is another node, or nothing when its box
/// is empty.
pub(super) type Node = [u32; 9];

/// Packs a node. `children` are their boxes; `ends` the ends of leaves.
pub(super) fn pack(whole: Bounds, children: [Bounds; WIDTH], ends: [u8; WIDTH]) -> Node {
    let ([x, y, z], [hx, hy, hz]) = (whole.lo, whole.hi);
    // The least power of two of which 255 cover the extent.
    let shift = |lo: u16, hi: u16| {
        let steps = u32::from(hi.saturating_sub(lo)).div_ceil(255);
        steps.next_power_of_two().trailing_zeros()
    };
    let (sx, sy, sz) = (shift(x, hx), shift(y, hy), shift(z, hz));
    let down = |at: u16, from: u16, shift: u32| (at.saturating_sub(from) >> shift) as u8;
    let up = |at: u16, from: u16, shift: u32| {
        let at = u32::from(at.saturating_sub(from));
        (at.div_ceil(1 << shift)) as u8
    };
    let lo = children.map(|child| {
        let [cx, cy, cz] = child.lo;
        (down(cx, x, sx), down(cy, y, sy), down(cz, z, sz))
    });
    let hi = children.map(|child| {
        let [cx, cy, cz] = child.hi;
        (up(cx, x, sx), up(cy, y, sy), up(cz, z, sz))
    });
    let word = u32::from_le_bytes;
    [
        word(lo.map(|c| c.0)),
        word(lo.map(|c| c.1)),
        word(lo.map(|c| c.2)),
        word(hi.map(|c| c.0)),
        word(hi.map(|c| c.1)),
        word(hi.map(|c| c.2)),
        u32::from(x) | u32::from(y) << 16,
        u32::from(z) | sx << 16 | sy << 20 | sz << 24,
        word(ends),
    ]
}

/// Four numbers, one a child.
type Four<R> = [R; WIDTH];

fn zip<R: Copy>([a, b, c, d]: Four<R>, [e, f, g, h]: Four<R>, op: impl Fn(R, R) -> R) -> Four<R> {
    [op(a, e), op(b, f), op(c, g), op(d, h)]
}

/// What a processor's instruction computes; [`Real::max`] decides more than is needed here.
fn greater<R: Real>(a: R, b: R) -> R {
    if a > b { a } else { b }
}

fn smaller<R: Real>(a: R, b: R) -> R {
    if a < b { a } else { b }
}

/// Where a ray enters and leaves the planes of four children along one axis.
#[inline(always)]
fn planes<R: Real>(
    course: &Course<R>,
    lo: u32,
    hi: u32,
    origin: u32,
    shift: u32,
) -> (Four<R>, Four<R>) {
    let step = course.slope * R::from_i32(1 << shift);
    let offset = course.offset + course.slope * R::from_i32(origin as i32);
    let swapped = (lo ^ hi) & course.swap;
    let at = |sides: u32| sides.to_le_bytes().map(|side| R::from_i32(side.into()) * step + offset);
    (at(lo ^ swapped), at(hi ^ swapped))
}

/// Where a ray enters and leaves the boxes of the four children, between two parameters. A box that
/// it passes by is left before it is entered.
#[inline(always)]
pub(super) fn clip<R: Real>(
    node: &Node,
    [x, y, z]: &[Course<R>; 3],
    start: R,
    limit: R,
) -> (Four<R>, Four<R>) {
    let [lx, ly, lz, hx, hy, hz, xy, zs, _] = *node;
    let (nx, fx) = planes(x, lx, hx, xy & 0xffff, zs >> 16 & 15);
    let (ny, fy) = planes(y, ly, hy, xy >> 16, zs >> 20 & 15);
    let (nz, fz) = planes(z, lz, hz, zs & 0xffff, zs >> 24 & 15);
    let near = zip(zip(nx, ny, greater), zip(nz, [start; 4], greater), greater);
    let far = zip(zip(fx, fy, smaller), zip(fz, [limit; 4], smaller), smaller);
    (near, far)
}
