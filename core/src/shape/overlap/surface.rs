//! Cells that a closed surface surrounds without passing through them.
//!
//! The least and the greatest distance of a box from a point: J. Arvo, "A simple method for
//! box-sphere intersection testing", Graphics Gems (1990), case of the hollow sphere.

use crate::geom::Aabb;
use crate::num::{Real, Vec3, Vector};

/// Whether a sphere's surface passes through a cell.
pub(in crate::shape) fn sphere_surface<R: Real>(
    center: Vec3<R>,
    radius: R,
    cell: &Aabb<R>,
) -> bool {
    let (below, above) = (center - cell.lo, cell.hi - center);
    // How far the cell begins from the centre along an axis, and how far it ends.
    let nearest = below.zip(above, |b, a| (-b).max(-a).max(R::ZERO));
    let farthest = below.zip(above, |b, a| b.abs().max(a.abs()));
    // Scaled by a power of two, so that no square vanishes.
    let size = farthest.max_abs();
    let exponent = if size > R::ZERO { size.exponent_to_one() } else { 0 };
    let scaled = |v: Vec3<R>| v.map(|x| x.ldexp(exponent));
    let (nearest, farthest, radius) = (scaled(nearest), scaled(farthest), radius.ldexp(exponent));
    let squared = radius.times(radius);
    !(nearest.dot(nearest) > squared || farthest.dot(farthest) < squared)
}

/// Whether the surface of a box passes through a cell that touches it.
pub(in crate::shape) fn box_surface<R: Real>(solid: &Aabb<R>, cell: &Aabb<R>) -> bool {
    let inside = |lo: R, hi: R, from: R, to: R| from > lo && to < hi;
    let [x0, y0, z0] = solid.lo.to_array();
    let [x1, y1, z1] = solid.hi.to_array();
    let ([ax, ay, az], [bx, by, bz]) = (cell.lo.to_array(), cell.hi.to_array());
    !(inside(x0, x1, ax, bx) && inside(y0, y1, ay, by) && inside(z0, z1, az, bz))
}
