//! A node of 64 bytes: the boxes of eight children, a byte a side.
//!
//! T. Ylitie, T. Karras, S. Laine, "Efficient incoherent ray traversal on GPUs through compressed
//! wide BVHs", HPG 2017: sides are whole steps from the least corner of the node's own box, a step
//! being a power of two, another one along each axis. Before: J. Mahovsky and B. Wyvill,
//! "Memory-conserving bounding volume hierarchies with coherent raytracing", CGF 25(2) (2006).

use super::units::{Bounds, Course};
use crate::num::{FOURS, Progress, Real};

/// Children of a node.
pub(super) const WIDTH: usize = 8;

const ROWS: usize = 8;

/// A node as it is stored.
///
/// | row | a byte a child |
/// |---|---|
/// | 0 to 2 | least x, y, z of its box, in steps |
/// | 3 to 5 | greatest x, y, z |
/// | 6 | (of all children) the least corner in units, 2 bytes a coordinate; logarithms of the steps, 4 bits each |
/// | 7 | where its ids end, counted from where the node's ids begin |
///
/// Leaves come first. A child whose ids end where they begin is a node, or nothing when its box is
/// empty.
pub(super) type Node = [[u8; WIDTH]; ROWS];

/// Packs a node: boxes of the children, rounded outwards to steps, and the ends of their ids.
pub(super) fn pack(children: [Bounds; WIDTH], ends: [u8; WIDTH]) -> Node {
    let whole = children.iter().fold(Bounds::EMPTY, |all, child| all.union(*child));
    let ([x, y, z], [hx, hy, hz]) = (whole.lo, whole.hi);
    let [cx, cy, cz] = [(x, hx), (y, hy), (z, hz)].map(|(lo, hi)| Scale::of(lo, hi));
    let ([x0, x1], [y0, y1], [z0, z1]) = (x.to_le_bytes(), y.to_le_bytes(), z.to_le_bytes());
    let [lo, hi] = [children.map(|child| child.lo), children.map(|child| child.hi)];
    [
        lo.map(|[x, _, _]| cx.down(x)),
        lo.map(|[_, y, _]| cy.down(y)),
        lo.map(|[_, _, z]| cz.down(z)),
        hi.map(|[x, _, _]| cx.up(x)),
        hi.map(|[_, y, _]| cy.up(y)),
        hi.map(|[_, _, z]| cz.up(z)),
        [x0, x1, y0, y1, z0, z1, cx.shift | cy.shift << 4, cz.shift],
        ends,
    ]
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

/// A number a child.
pub(super) type Wide<R> = [R; WIDTH];

/// Where a ray enters and leaves the boxes of the eight children, between two parameters. A box
/// that it passes by is left before it is entered.
///
/// T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986. Not inlined, and in
/// fours: numbers that go to memory side by side are what makes compilers compute them side by
/// side.
#[inline(never)]
pub(super) fn clip<R: Real>(
    node: &Node,
    [x, y, z]: &[Course<R>; 3],
    start: R,
    limit: R,
    near: &mut Wide<R>,
    far: &mut Wide<R>,
) {
    let [.., [x0, x1, y0, y1, z0, z1, xy, shift_z], _] = node;
    let slabs = [
        Slabs::of(node, x, [*x0, *x1], xy & 15),
        Slabs::of(node, y, [*y0, *y1], xy >> 4),
        Slabs::of(node, z, [*z0, *z1], shift_z & 15),
    ];
    if !FOURS {
        // It pays to stop at the first axis along which a ray passes a box by; the answer is the same.
        for (child, (near, far)) in near.iter_mut().zip(far.iter_mut()).enumerate() {
            (*near, *far) = clip_one(&slabs, child, start, limit);
        }
        return;
    }
    let (near_0, far_0) = clip_four::<0, R>(&slabs, start, limit);
    let (near_4, far_4) = clip_four::<4, R>(&slabs, start, limit);
    let join = |[a, b, c, d]: [R; 4], [e, f, g, h]: [R; 4]| [a, b, c, d, e, f, g, h];
    *near = join(near_0, near_4);
    *far = join(far_0, far_4);
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

    /// Four sides from `AT` on as parameters.
    #[inline(always)]
    fn four<const AT: usize>(&self, sides: &[u8; WIDTH]) -> [R; 4] {
        let four = sides.get(AT..).and_then(|sides| sides.first_chunk()).unwrap_or(&[0; 4]);
        four.map(|side| self.at(side))
    }
}

/// [`clip`] for one child.
#[inline(always)]
fn clip_one<R: Real>(slabs: &[Slabs<'_, R>; 3], child: usize, start: R, limit: R) -> (R, R) {
    let (mut enter, mut leave) = (start, limit);
    for slab in slabs {
        let side = |sides: &[u8; WIDTH]| sides.get(child % WIDTH).copied().unwrap_or(0);
        let (near, far) = (slab.at(side(slab.near)), slab.at(side(slab.far)));
        if near > enter {
            enter = near;
        }
        if far < leave {
            leave = far;
        }
        if !(enter <= leave) {
            break;
        }
    }
    (enter, leave)
}

/// [`clip`] for four children from `AT` on.
#[inline(always)]
fn clip_four<const AT: usize, R: Real>(
    [x, y, z]: &[Slabs<'_, R>; 3],
    start: R,
    limit: R,
) -> ([R; 4], [R; 4]) {
    // As a processor's instruction does; `Real::max` and `min` decide more than is needed here.
    let greater = |a: R, b: R| if a > b { a } else { b };
    let smaller = |a: R, b: R| if a < b { a } else { b };
    let near = zip(x.four::<AT>(x.near), y.four::<AT>(y.near), greater);
    let near = zip(near, z.four::<AT>(z.near).map(|z| greater(z, start)), greater);
    let far = zip(x.four::<AT>(x.far), y.four::<AT>(y.far), smaller);
    let far = zip(far, z.four::<AT>(z.far).map(|z| smaller(z, limit)), smaller);
    (near, far)
}

#[inline(always)]
fn zip<R: Copy>([a, b, c, d]: [R; 4], [e, f, g, h]: [R; 4], op: impl Fn(R, R) -> R) -> [R; 4] {
    [op(a, e), op(b, f), op(c, g), op(d, h)]
}
