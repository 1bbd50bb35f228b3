//! The oriented box: a box whose edges may run anywhere.
//!
//! S. Gottschalk, M. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference
//! detection", SIGGRAPH 1996. There the axes are those of the covariance of what is inside; here
//! they are taken over from the parts, so that boxes can be built one shape at a time: the axes of
//! one part, of the other, or those of the world, whichever give the least surface.
//!
//! In units in the last place of the scene's greatest coordinate: a shape may be hit √3 times 32
//! outside; the products of an axis with origin and direction and the parameter of a side are off by
//! 45, and the side itself by 20. It is moved by 256.

use super::slab::cut;
use super::{Bound, Fitted, Region, Stored, shrunk};
use crate::geom::Ray;
use crate::num::{Axis, Real, Reciprocal, Vec3, Vector};

/// A box along three axes of length 1 at right angles to each other, as far as rounding goes; 60
/// bytes in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox<R: Real> {
    axes: [Vec3<R>; 3],
    /// Least and greatest product with each axis.
    sides: [[R; 2]; 3],
}

/// Those of the world.
fn world<R: Real>() -> [Vec3<R>; 3] {
    let (zero, one) = (R::ZERO, R::ONE);
    [[one, zero, zero], [zero, one, zero], [zero, zero, one]].map(Vec3::<R>::from_array)
}

/// Axes of which one is given.
fn axes_with<R: Real>(axis: Vec3<R>) -> Option<[Vec3<R>; 3]> {
    let [x, y, z] = world::<R>();
    // Not one that may run the same way.
    let other = match axis.major_axis() {
        Axis::X => y,
        Axis::Y => z,
        Axis::Z => x,
    };
    let across = axis.cross(other).unit()?;
    Some([axis, across, axis.cross(across).unit()?])
}

impl<R: Real> OrientedBox<R> {
    /// Around another one, along given axes.
    fn turned(&self, axes: [Vec3<R>; 3]) -> Self {
        if axes == self.axes {
            return *self;
        }
        let reach = self.sides.iter().flatten().fold(R::ZERO, |m, side| m.max(side.abs()));
        // The axes' lengths and angles are off by a few units each, and so are the products.
        let margin = R::ulps_at(128, reach);
        let sides = axes.map(|axis| {
            let (mut lo, mut hi) = (-margin, margin);
            for (own, [from, to]) in self.axes.iter().zip(self.sides) {
                let part = R::narrow(axis.dot(*own));
                let (a, b) = (part * from, part * to);
                (lo, hi) = (lo + a.min(b), hi + a.max(b));
            }
            [lo, hi]
        });
        Self { axes, sides }
    }

    /// The smallest along the same axes.
    fn joined(self, other: Self) -> Self {
        let mut sides = self.sides;
        for (side, other) in sides.iter_mut().zip(other.sides) {
            *side = [side[0].min(other[0]), side[1].max(other[1])];
        }
        Self { sides, ..self }
    }

    fn along(axes: [Vec3<R>; 3], region: &Region<R>, pad: R) -> Self {
        let margin = pad.times_int(4);
        let sides = axes.map(|axis| {
            let (lo, hi) = region.places(axis);
            [lo - margin, hi + margin]
        });
        Self { axes, sides }
    }
}

impl<R: Real> Bound<R> for OrientedBox<R> {
    type PerRay = Ray<R>;

    fn half_area(&self) -> R {
        let [x, y, z] = self.sides.map(|[lo, hi]| shrunk(hi - lo));
        R::narrow(x.times(y) + y.times(z) + z.times(x))
    }

    fn middle(&self) -> Vec3<R> {
        let parts = self.axes.iter().zip(self.sides);
        parts.fold(Vec3::<R>::default(), |sum, (axis, [lo, hi])| {
            sum + *axis * (lo * R::HALF + hi * R::HALF)
        })
    }

    fn per_ray(ray: &Ray<R>) -> Ray<R> {
        *ray
    }

    #[inline]
    fn enter(&self, ray: &Ray<R>, start: R, limit: R) -> Option<R> {
        if !(start <= limit) {
            return None;
        }
        let mut part = (start, limit);
        for (axis, slab) in self.axes.iter().zip(self.sides) {
            let step = R::Reciprocal::of(R::narrow(axis.dot(ray.direction())));
            part = cut::<R>(part, (R::narrow(axis.dot(ray.origin())), step), slab)?;
        }
        Some(part.0)
    }
}

impl<R: Real> Fitted<R> for OrientedBox<R> {
    /// Along the axis of what has one, otherwise along those of the world.
    fn around(region: &Region<R>, pad: R) -> Self {
        let upright = Self::along(world::<R>(), region, pad);
        let Region::Discs { axis, .. } = *region else { return upright };
        let Some(axes) = axes_with::<R>(axis) else { return upright };
        let tilted = Self::along(axes, region, pad);
        if tilted.half_area() < upright.half_area() { tilted } else { upright }
    }

    fn union(self, other: Self) -> Self {
        let mut best = self.joined(other.turned(self.axes));
        if other.axes == self.axes && self.axes == world::<R>() {
            return best;
        }
        for axes in [other.axes, world::<R>()] {
            let tried = self.turned(axes).joined(other.turned(axes));
            if tried.half_area() < best.half_area() {
                best = tried;
            }
        }
        best
    }
}

impl<R: Real> Stored<R> for OrientedBox<R> {
    type Plain = [[R; 5]; 3];

    fn plain(self) -> Self::Plain {
        let mut plain = [[R::ZERO; 5]; 3];
        for ((row, axis), side) in plain.iter_mut().zip(self.axes).zip(self.sides) {
            let ([x, y, z], [lo, hi]) = (axis.to_array(), side);
            *row = [x, y, z, lo, hi];
        }
        plain
    }

    fn of(plain: &Self::Plain) -> Self {
        Self {
            axes: plain.map(|[x, y, z, ..]| Vec3::<R>::new(x, y, z)),
            sides: plain.map(|[.., lo, hi]| [lo, hi]),
        }
    }
}
