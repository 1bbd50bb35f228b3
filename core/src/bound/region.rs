//! Where a shape may be hit, as bounds are built around it.

use crate::geom::Aabb;
use crate::num::{Axis, Real, Vec3, Vector};

/// A body that contains every place where a shape may be hit, give or take
/// [`Ray::slack`](crate::geom::Ray::slack): its box, or something tighter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region<R: Real> {
    /// No more is known than a box.
    Box(Aabb<R>),
    /// A ball.
    Ball {
        /// Its middle.
        center: Vec3<R>,
        /// Its radius.
        radius: R,
    },
    /// Two discs across an axis and all between them.
    Discs {
        /// The box around it.
        bounds: Aabb<R>,
        /// The middle of the first disc.
        base: Vec3<R>,
        /// The direction to the other, of length 1.
        axis: Vec3<R>,
        /// The distance between them.
        height: R,
        /// Their radii.
        radii: [R; 2],
    },
    /// What is inside a box and close to a plane: see [`Region::flat`].
    Flat {
        /// The box.
        bounds: Aabb<R>,
        /// A vector across the plane, of length 1.
        normal: Vec3<R>,
        /// Least and greatest product of the normal with points of the shape.
        offset: [R; 2],
    },
}

impl<R: Real> Region<R> {
    /// Of a flat shape with twice its area as a vector across its plane.
    ///
    /// A ray that sees it edge-on has no well-defined place where it meets it, and may claim one
    /// anywhere in its box; but such a ray lies in the plane. So what bounds a *line* may use both,
    /// what bounds a *place* only the box.
    pub fn flat(area: Vec3<R>, points: impl IntoIterator<Item = Vec3<R>> + Clone) -> Self {
        let bounds = Aabb::<R>::around(points.clone());
        let size = bounds.size().max_abs();
        // The plane of a needle is not known well enough.
        let wide = area.max_abs().times_int(8) >= size * size;
        let Some(normal) = area.unit().filter(|_| wide) else { return Self::Box(bounds) };
        let mut offset = [R::INFINITY, -R::INFINITY];
        for point in points {
            let at = R::narrow(normal.dot(point));
            offset = [offset[0].min(at), offset[1].max(at)];
        }
        // The normal's own rounding shows at the far end of the box.
        let margin = R::ulps_at(32, bounds.max_abs());
        Self::Flat { bounds, normal, offset: [offset[0] - margin, offset[1] + margin] }
    }

    /// The box around it.
    pub fn bounds(&self) -> Aabb<R> {
        match *self {
            Self::Box(bounds) | Self::Discs { bounds, .. } | Self::Flat { bounds, .. } => bounds,
            Self::Ball { center, radius } => {
                let r = Vec3::<R>::splat(radius);
                Aabb { lo: (center - r).map(R::next_down), hi: (center + r).map(R::next_up) }
            }
        }
    }

    /// Between which products with a vector all places lie where it may be hit; rounded by a few
    /// units in the last place of the greatest coordinate, times the sum of the vector's components.
    pub fn places(&self, along: Vec3<R>) -> (R, R) {
        match *self {
            Self::Box(bounds) | Self::Flat { bounds, .. } => of_box(bounds, along),
            Self::Ball { center, radius } => {
                around(R::narrow(center.dot(along)), radius * along.length())
            }
            Self::Discs { bounds, base, axis, height, radii: [a, b] } => {
                // As far as the vector is tilted away from the axis, and not by √(1 - a²).
                let tilt = along.cross(axis).length();
                let base = R::narrow(base.dot(along));
                let apex = base + R::narrow(axis.dot(along)) * height;
                let ((a_lo, a_hi), (b_lo, b_hi)) = (around(base, a * tilt), around(apex, b * tilt));
                let (lo, hi) = of_box(bounds, along);
                (lo.max(a_lo.min(b_lo)), hi.min(a_hi.max(b_hi)))
            }
        }
    }

    /// Between which products with a vector every ray passes that may hit it: as
    /// [`Region::places`], or tighter for what is flat.
    pub fn passages(&self, along: Vec3<R>) -> (R, R) {
        let (lo, hi) = self.places(along);
        match *self {
            Self::Flat { bounds, normal, offset: [from, to] } => {
                let above = most_in_plane(bounds, normal, (from, to), along);
                let below = most_in_plane(bounds, normal, (from, to), -along);
                (lo.max(-below), hi.min(above))
            }
            _ => (lo, hi),
        }
    }

    /// Middle and radius of a ball around it.
    pub fn ball(&self) -> (Vec3<R>, R) {
        let bounds = self.bounds();
        let middle = bounds.lo * R::HALF + bounds.hi * R::HALF;
        let rounded = R::ONE + R::ulps(4);
        let of_box = (bounds.hi - middle).max(middle - bounds.lo).length() * rounded;
        match *self {
            Self::Ball { center, radius } => (center, radius),
            Self::Discs { base, axis, height, radii: [a, b], .. } => {
                let half = height * R::HALF;
                let rim = a.max(b);
                let radius = R::sqrt_wide(half.times(half) + rim.times(rim)) * rounded;
                if radius < of_box { (base + axis * half, radius) } else { (middle, of_box) }
            }
            Self::Box(_) | Self::Flat { .. } => (middle, of_box),
        }
    }
}

fn around<R: Real>(middle: R, by: R) -> (R, R) {
    (middle - by, middle + by)
}

fn of_box<R: Real>(bounds: Aabb<R>, along: Vec3<R>) -> (R, R) {
    let (a, b) = (bounds.lo.scale(along), bounds.hi.scale(along));
    let (lo, hi) = (a.min(b), a.max(b));
    (lo.x() + lo.y() + lo.z(), hi.x() + hi.y() + hi.z())
}

/// The greatest product with a vector in the part of a box between two planes across `normal`.
///
/// A linear program with one constraint besides the box: by duality the least, over all factors of
/// the constraint, of what the box alone gives for the rest of the vector; and that is reached where
/// a component of the rest is 0. Any factor gives an upper bound, so those that would magnify
/// rounding are left out.
fn most_in_plane<R: Real>(
    bounds: Aabb<R>,
    normal: Vec3<R>,
    (from, to): (R, R),
    along: Vec3<R>,
) -> R {
    let steep = normal.max_abs() * R::HALF;
    let mut most = R::INFINITY;
    for axis in Axis::ALL {
        let across = normal.along(axis);
        if !(across.abs() >= steep) {
            continue;
        }
        let factor = along.along(axis) / across;
        let rest = along - normal * factor;
        let (_, hi) = of_box(bounds, rest);
        let plane = if factor >= R::ZERO { to } else { from };
        most = most.min(hi + factor * plane);
    }
    most
}
