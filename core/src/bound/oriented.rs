//! The oriented box: a box whose edges may run anywhere.
//!
//! S. Gottschalk, M. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference
//! detection", SIGGRAPH 1996. So that boxes can be built one shape at a time, axes are first taken
//! over from the parts: those of one, of the other, or of the world, whichever give the least surface.
//! [`Fitted::refined`] then tries the axes of the covariance of what is inside,
//! as the original does, those that a single shape has itself, and again the former, for a box around
//! the shapes themselves and not around boxes of boxes.
//!
//! In units in the last place of the scene's greatest coordinate: a shape may be hit √3 times 32
//! outside; the products of an axis with origin and direction and the parameter of a side are off by
//! 45, and the side itself by 20. It is moved by 256.

use super::covariance::principal_axes;
use super::slab::cut;
use super::{Bound, Fitted, Region, Stored, shrunk};
use crate::geom::Ray;
use crate::num::{Real, Reciprocal, Vec3, Vector};

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

    /// Another one, if that has less surface.
    fn or_smaller(self, other: Self) -> Self {
        if other.half_area() < self.half_area() { other } else { self }
    }

    fn along(axes: [Vec3<R>; 3], region: &Region<R>, pad: R) -> Self {
        let margin = pad.times_int(4);
        let sides = axes.map(|axis| {
            let (lo, hi) = region.places(axis, pad);
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
        let Region::Discs { .. } = region else { return upright };
        let Some(axes) = region.axes() else { return upright };
        upright.or_smaller(Self::along(axes, region, pad))
    }

    fn union(self, other: Self) -> Self {
        let mut best = self.joined(other.turned(self.axes));
        if other.axes == self.axes && self.axes == world::<R>() {
            return best;
        }
        for axes in [other.axes, world::<R>()] {
            best = best.or_smaller(self.turned(axes).joined(other.turned(axes)));
        }
        best
    }

    const REFINES: bool = true;

    fn refined(self, inside: impl Iterator<Item = Region<R>> + Clone, pad: R) -> Self {
        let along = |axes| {
            let boxes = inside.clone().map(|region| Self::along(axes, &region, pad));
            boxes.reduce(Self::joined)
        };
        let first = inside.clone().next().and_then(|region| region.axes());
        [Some(principal_axes(inside.clone())), first, Some(self.axes), Some(world::<R>())]
            .into_iter()
            .flatten()
            .filter_map(along)
            .fold(self, Self::or_smaller)
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
