//! Where a shape may be hit, as bounds are built around it.

use crate::geom::Aabb;
use crate::num::{Real, Vec3, Vector};

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
    /// What is inside a box and close to a plane. A flat shape that is seen edge-on has no
    /// well-defined place where it is hit: a ray in its plane may meet it anywhere in its box.
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
}
