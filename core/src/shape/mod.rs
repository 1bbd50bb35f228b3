//! Elementary solids, one a file, for any number type.
//!
//! # The contract of a shape
//! * [`Shape::hit`] gives the smallest parameter `t` with `min < t <= max` at which the ray meets
//!   the surface, from either side. `t` depends on the ray and the shape only; the interval selects
//!   among the crossings and never moves one.
//! * The point at `t` lies in [`Shape::bounds`], or outside it by no more than [`Ray::slack`]. Space
//!   is divided by padded boxes, so a structure that follows the ray from cell to cell cannot lose
//!   what testing every shape would find. Where a kernel cannot promise this by itself (a triangle
//!   seen edge-on has no well-defined `t`), it is held to it (`overlap`).
//! * It lies in a box for which [`Shape::overlaps`] says yes, once that is padded by twice the slack.
//! * A shape that passed [`Shape::check`] is never hit at a `t` that is not a number.

mod axial;
mod r#box;
mod cone;
mod convex;
pub mod csg;
mod cylinder;
mod overlap;
mod plane;
mod polygon;
mod polyhedron;
mod sphere;
mod transformed;
mod triangle;

pub use r#box::AxisBox;
pub use cone::Cone;
pub use convex::Convex;
pub use csg::Csg;
pub use cylinder::Cylinder;
pub use plane::Plane;
pub use polygon::Polygon;
pub use polyhedron::Polyhedron;
pub use sphere::{Length, Sphere};
pub use transformed::{Affine, Transformed};
pub use triangle::{Shear, Triangle};

use crate::bound::Region;
use crate::geom::{Aabb, Ray, Slopes};
use crate::num::{Real, Vec3};

#[cfg(test)]
pub(crate) mod testing;

/// Why a shape cannot be part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShapeError {
    /// A coordinate or a radius is infinite or not a number, or so great that products of it are.
    NotFinite,
    /// It has no surface, or one too small to compute with: a length is zero or the product of two
    /// is, corners coincide or lie in a line. In `f32` that befalls radii below 3e-23, and the sides
    /// of triangles and polygons below 5e-22.
    Degenerate,
    /// A radius or an extent is negative.
    Negative,
    /// A polygon has fewer than three corners.
    TooFewCorners,
    /// A polyhedron does not end on every side.
    Unbounded,
    /// The axis of a cylinder or a cone is not of length 1, or the normal of a plane or a polygon is
    /// zero or so short that its square is.
    NotUnit,
}

impl core::fmt::Display for ShapeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a coordinate or radius is not finite, or too great to compute with",
            Self::Degenerate => {
                "it has no surface: a radius, length or area is zero or vanishes in products"
            }
            Self::Negative => "a radius or an extent is negative",
            Self::TooFewCorners => "a polygon needs at least three corners",
            Self::Unbounded => "a polyhedron needs faces on every side",
            Self::NotUnit => "its axis or its normal has no usable length: scale it to length 1",
        })
    }
}

impl core::error::Error for ShapeError {}

/// An elementary solid or surface.
pub trait Shape<R: Real> {
    /// What every shape of this kind wants to know of a ray, computed once a ray.
    type PerRay: Copy + Default;

    /// Whether the shape has an extent that a box can hold. The same for all shapes of a kind.
    const BOUNDED: bool = true;

    /// Whether it is a piece of a plane, so that a ray that starts from it never meets it again, and
    /// rays remember that: it may be so thin that no distance tells its sides apart. The same for all
    /// shapes of a kind.
    const FLAT: bool = false;

    /// Prepares a ray.
    fn per_ray(ray: &Ray<R>) -> Self::PerRay;

    /// Refuses shapes that have no surface or whose numbers would not stay finite.
    ///
    /// # Errors
    /// What is wrong with it.
    fn check(&self) -> Result<(), ShapeError>;

    /// The smallest axis-aligned box around it, rounded outwards.
    fn bounds(&self) -> Aabb<R>;

    /// What bounds are built around: its box, or something tighter in which all its hits lie.
    fn region(&self) -> Region<R> {
        Region::Box(self.bounds())
    }

    /// Whether its surface may pass through a cell that its box touches: no only where no hit can be
    /// claimed. The cell is padded by twice the slack.
    fn overlaps(&self, _cell: &Aabb<R>) -> bool {
        true
    }

    /// The nearest crossing with `min < t <= max`.
    fn hit(&self, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R>;

    /// Whether there is any crossing with `min < t <= max`: what [`Shape::hit`] finds, or sooner.
    fn occludes(&self, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        self.hit(ray, per_ray, min, max).is_some()
    }

    /// The geometric normal at a hit, pointing out of the solid (for a surface: to its front), not
    /// necessarily of length 1.
    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R>;

    /// The normal that shading uses, of any length, where it is not the geometric one.
    fn shading_normal(&self, _ray: &Ray<R>, _t: R) -> Option<Vec3<R>> {
        None
    }

    /// The greatest coordinate that its hits are computed from, where that may be greater than those
    /// of the hit and of the ray's origin: a hit on a huge sphere is as exact as the sphere.
    fn computed_from(&self) -> R {
        R::ZERO
    }
}

/// Holds a hit to the promise that it lies in the shape's box.
///
/// Gives `t` back when it does; otherwise the nearest parameter at which the ray is inside the box
/// grown by the ray's slack; nothing when it never is, or when `t` is infinite or not a number.
pub(crate) fn settle<R: Real>(ray: &Ray<R>, bounds: Aabb<R>, t: R) -> Option<R> {
    let bounds = bounds.grown(ray.slack());
    if bounds.contains(ray.at(t)) { Some(t) } else { move_into(ray, bounds, t) }
}

#[cold]
#[inline(never)]
fn move_into<R: Real>(ray: &Ray<R>, bounds: Aabb<R>, t: R) -> Option<R> {
    if !t.is_finite() {
        return None;
    }
    let (enter, leave) = Slopes::of(ray).clip(bounds.lo, bounds.hi, -R::MAX, R::MAX)?;
    Some(t.clamp(enter, leave))
}
