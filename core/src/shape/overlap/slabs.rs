//! Convex regions as boxes cut by slabs: separating axes.
//!
//! A cell does not meet a convex solid if there is a direction along which both lie apart. For a
//! triangle and a box it is enough to look along the axes, the normal, and the products of edges
//! and axes: T. Akenine-Möller, "Fast 3D triangle-box overlap testing", Journal of Graphics Tools
//! 6(1) (2001); as projections onto the coordinate planes: M. Schwarz, H.-P. Seidel, "Fast parallel
//! surface and solid voxelization on GPUs", SIGGRAPH Asia 2010. A cell is tested against the slabs
//! that a hit is held to, so both agree whatever rounding did to them.

use crate::geom::{Aabb, Ray, Slopes};
use crate::num::{Real, Vec3, Vector};

/// The points between two parallel planes.
#[derive(Clone, Copy, Debug)]
pub(in crate::shape) struct Slab<R: Real> {
    /// What heights are counted from.
    from: Vec3<R>,
    /// Across the planes, of a length around 1.
    across: Vec3<R>,
    lo: R::Wide,
    hi: R::Wide,
}

impl<R: Real> Slab<R> {
    /// Between two heights over a point, in lengths of `across`.
    pub(in crate::shape) fn new(from: Vec3<R>, across: Vec3<R>, lo: R, hi: R) -> Self {
        Self { from, across, lo: lo.times(R::ONE), hi: hi.times(R::ONE) }
    }

    /// The thinnest one around some points.
    fn around(from: Vec3<R>, across: Vec3<R>, points: &[Vec3<R>]) -> Self {
        let (mut lo, mut hi) = (R::Wide::default(), R::Wide::default());
        for point in points {
            let height = across.dot(*point - from);
            lo = if height < lo { height } else { lo };
            hi = if height > hi { height } else { hi };
        }
        Self { from, across, lo, hi }
    }

    /// What moving a plane by `margin` along every axis adds to heights.
    fn margin(&self, margin: R) -> R::Wide {
        let [x, y, z] = self.across.to_array().map(R::abs);
        x.times(margin) + y.times(margin) + z.times(margin)
    }

    /// Whether it has points in common with a box; yes when that cannot be told.
    pub(in crate::shape) fn meets(&self, cell: &Aabb<R>) -> bool {
        let lower = self.across.map(|a| if a > R::ZERO { R::ZERO } else { R::ONE });
        let corner = |lower: Vec3<R>| {
            let upper = lower.map(|l| R::ONE - l);
            cell.lo.scale(upper) + cell.hi.scale(lower) - self.from
        };
        let least = self.across.dot(corner(lower));
        let greatest = self.across.dot(corner(lower.map(|l| R::ONE - l)));
        !(least > self.hi || greatest < self.lo)
    }

    /// Whether a point lies in it or no farther outside than `margin`.
    fn contains(&self, p: Vec3<R>, margin: R) -> bool {
        let (height, margin) = (self.across.dot(p - self.from), self.margin(margin));
        height >= self.lo - margin && height <= self.hi + margin
    }

    /// The parameters between which a ray is in it, once it is grown by `margin`.
    fn clip(&self, ray: &Ray<R>, margin: R) -> Option<(R, R)> {
        let height = self.across.dot(ray.origin() - self.from);
        let rise = self.across.dot(ray.direction());
        let (lo, hi) = (self.lo - self.margin(margin), self.hi + self.margin(margin));
        let zero = R::Wide::default();
        if rise == zero {
            return (height >= lo && height <= hi).then_some((-R::MAX, R::MAX));
        }
        let (a, b) = (R::ratio(lo - height, rise), R::ratio(hi - height, rise));
        Some(if rise > zero { (a, b) } else { (b, a) })
    }
}

/// Holds a hit to a box cut by slabs: `t` itself when it is there, otherwise the nearest parameter
/// that is, or nothing.
///
/// A hit that has to be moved is moved deeper than it could stay: its new parameter is rounded.
///
/// A part of what calls it, which is a function apart: the slabs are on the stack once.
#[inline(always)]
pub(in crate::shape) fn settle_between<R: Real>(
    ray: &Ray<R>,
    bounds: &Aabb<R>,
    slabs: impl IntoIterator<Item = Slab<R>> + Clone,
    t: R,
) -> Option<R> {
    if !t.is_finite() {
        return None;
    }
    let (p, bounds) = (ray.at(t), bounds.grown(ray.slack()));
    if bounds.contains(p) && slabs.clone().into_iter().all(|slab| slab.contains(p, ray.slack())) {
        return Some(t);
    }
    let (mut enter, mut leave) = Slopes::of(ray).clip(bounds.lo, bounds.hi, -R::MAX, R::MAX)?;
    for slab in slabs {
        let (near, far) = slab.clip(ray, ray.slack() * R::HALF)?;
        enter = enter.max(near);
        leave = leave.min(far);
    }
    (enter <= leave).then(|| t.clamp(enter, leave))
}

/// The edges of a triangle, scaled by a power of two, so that no product of them vanishes.
fn edges<R: Real>([a, b, c]: [Vec3<R>; 3]) -> [Vec3<R>; 3] {
    let edges = [b - a, c - b, a - c];
    let size = edges.iter().fold(R::ZERO, |size, edge| size.max(edge.max_abs()));
    let exponent = if size > R::ZERO { size.exponent_to_one() } else { 0 };
    edges.map(|edge| edge.map(|x| x.ldexp(exponent)))
}

/// Across the plane of a triangle.
pub(in crate::shape) fn across_plane<R: Real>(corners: [Vec3<R>; 3]) -> Vec3<R> {
    let [e, f, _] = edges::<R>(corners);
    e.across(f)
}

/// What a triangle lies between: its plane, and its outline seen along each axis. Computed one by
/// one, as the first often tells.
pub(in crate::shape) fn flat<R: Real>(
    corners: [Vec3<R>; 3],
) -> impl Iterator<Item = Slab<R>> + Clone {
    let ([a, ..], edges @ [e, f, _]) = (corners, edges::<R>(corners));
    let outline = edges.into_iter().flat_map(|edge: Vec3<R>| {
        let (x, y, z) = (edge.x(), edge.y(), edge.z());
        [[R::ZERO, z, -y], [-z, R::ZERO, x], [y, -x, R::ZERO]]
    });
    core::iter::once(e.across(f).to_array())
        .chain(outline)
        .map(move |across| Slab::around(a, Vec3::<R>::from_array(across), &corners))
}

/// What a solid around an axis of length 1 lies between: its ends, and an octagon around its
/// greatest radius.
pub(in crate::shape) fn round<R: Real>(
    base: Vec3<R>,
    axis: Vec3<R>,
    height: R,
    radius: R,
) -> [Slab<R>; 5] {
    // Two directions across the axis, the first one across a coordinate axis as well that is far
    // from the axis.
    let [x, y, z] = axis.to_array().map(R::abs);
    let least = if x <= y && x <= z {
        [R::ONE, R::ZERO, R::ZERO]
    } else if y <= z {
        [R::ZERO, R::ONE, R::ZERO]
    } else {
        [R::ZERO, R::ZERO, R::ONE]
    };
    let u = axis.cross(Vec3::<R>::from_array(least)).unit().unwrap_or_default();
    let v = axis.cross(u);
    // Directions of length 1 are so but for rounding.
    let radius = radius * (R::ONE + R::ulps(8));
    let across = |direction| Slab::new(base, direction, -radius, radius);
    let diagonal = |direction: Vec3<R>| direction.unit().unwrap_or_default();
    [
        Slab::new(base, axis, R::ZERO, height),
        across(u),
        across(v),
        across(diagonal(u + v)),
        across(diagonal(u - v)),
    ]
}
