//! Where a shape may be hit, as bounds are built around it.
//!
//! # Triangles
//! Their test holds hits to the box and to what the plane and the outline, seen along each axis, lie
//! between, all moved outwards by the slack along every axis
//! (`shape/overlap`). So, seen along an axis and in slacks, a hit is at most √2 off an
//! edge; at a corner of 45° or more √2 / sin 22.5° = 3.7; at a sharper one, where the box ends too, as
//! both edges leave to the same side along some axis, 3.3. Along the axis that the plane is steepest
//! to, it is off by 3 as the plane is and by √2 · 3.7 as what is seen is: 8.3. All in all 9.1, and
//! with what is rounded less than 10, which are 5 pads; and as much as the plane, rounded, is off
//! the corners.
//!
//! # Other flat shapes
//! Seen edge-on they may be hit anywhere in their box but near the plane: 2 slacks, rounded. The
//! greatest product with an axis in the part of the box between both planes adds up to 7.7 slacks of
//! the box and 3.5 times those of the plane: 7 pads.

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
    /// A triangle.
    Triangle {
        /// Its corners.
        corners: [Vec3<R>; 3],
        /// A vector across its plane, of length 1.
        normal: Vec3<R>,
        /// How far the plane, as its test computes it, is off the corners at most.
        blur: R,
    },
}

impl<R: Real> Region<R> {
    /// Of a triangle, with a vector across its plane as its test computes it.
    pub fn triangle(corners: [Vec3<R>; 3], across: Vec3<R>) -> Self {
        let bounds = Aabb::<R>::around(corners);
        let Some(normal) = across.unit() else { return Self::Box(bounds) };
        let [a, b, c] = corners;
        let off = [b - a, c - a].map(|edge| R::narrow(normal.dot(edge)).abs());
        // Along the axis that the plane is steepest to, up to √3 times that, for both.
        let blur = (off[0] + off[1]).times_int(2) + R::ulps_at(16, bounds.max_abs());
        Self::Triangle { corners, normal, blur }
    }

    /// Of a flat shape with twice its area as a vector across its plane.
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
            Self::Triangle { corners, .. } => Aabb::around(corners),
            Self::Ball { center, radius } => {
                let r = Vec3::<R>::splat(radius);
                Aabb { lo: (center - r).map(R::next_down), hi: (center + r).map(R::next_up) }
            }
        }
    }

    /// Between which products with a vector of at most length 1 all places lie where it may be hit,
    /// give or take the slack along every axis; rounded by a few units in the last place of the
    /// greatest coordinate. `pad` is that of the scene.
    pub fn places(&self, along: Vec3<R>, pad: R) -> (R, R) {
        match *self {
            Self::Box(bounds) => of_box(bounds, along),
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
            Self::Flat { bounds, normal, offset: [from, to] } => {
                let margin = pad.times_int(7);
                let above = most_in_plane(bounds, normal, (from, to), along) + margin;
                let below = most_in_plane(bounds, normal, (from, to), -along) + margin;
                let (lo, hi) = of_box(bounds, along);
                (lo.max(-below), hi.min(above))
            }
            Self::Triangle { corners, blur, .. } => {
                let margin = pad.times_int(5) + blur;
                let [a, b, c] = corners.map(|corner| R::narrow(corner.dot(along)));
                let (least, greatest) = (a.min(b).min(c) - margin, a.max(b).max(c) + margin);
                let (lo, hi) = of_box::<R>(Aabb::around(corners), along);
                (lo.max(least), hi.min(greatest))
            }
        }
    }

    /// Axes of length 1 at right angles that lie as it does, where it has some.
    pub fn axes(&self) -> Option<[Vec3<R>; 3]> {
        match *self {
            Self::Box(_) | Self::Ball { .. } => None,
            Self::Discs { axis, .. } => axes_with::<R>(axis),
            Self::Flat { normal, .. } => axes_with::<R>(normal),
            Self::Triangle { corners: [a, b, c], normal, .. } => {
                let longer = |e: Vec3<R>, f: Vec3<R>| if f.length() > e.length() { f } else { e };
                let edge = longer(b - a, longer(c - b, a - c)).unit()?;
                let across = edge.cross(normal);
                // The normal of a needle may be anything.
                let across = (across.max_abs() >= R::HALF).then(|| across.unit())??;
                Some([edge, across, edge.cross(across).unit()?])
            }
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
            Self::Box(_) | Self::Flat { .. } | Self::Triangle { .. } => (middle, of_box),
        }
    }
}

/// Axes of which one is given.
fn axes_with<R: Real>(axis: Vec3<R>) -> Option<[Vec3<R>; 3]> {
    let (zero, one) = (R::ZERO, R::ONE);
    // Not one that may run the same way.
    let other = match axis.major_axis() {
        Axis::X => [zero, one, zero],
        Axis::Y => [zero, zero, one],
        Axis::Z => [one, zero, zero],
    };
    let across = axis.cross(Vec3::<R>::from_array(other)).unit()?;
    Some([axis, across, axis.cross(across).unit()?])
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
