//! Closed convex solids: what combinations of solids are made of.

use super::{AxisBox, Cone, Cylinder, Plane, Shape, Sphere};
use crate::geom::{Aabb, Ray};
use crate::num::{Axis, Real, Vec3, Vector};

/// A convex solid. The line of a ray is inside of it along one piece, or not at all.
///
/// [`Shape::normal`] points out of it, and [`Shape::bounds`] are those of the surface.
pub trait Convex<R: Real>: Shape<R> {
    /// Between which parameters the line of a ray is inside, the smaller first, behind the ray's
    /// origin too; infinite where it is inside for ever. Depends on the ray and the solid only.
    fn span(&self, ray: &Ray<R>, per_ray: &Self::PerRay) -> Option<(R, R)>;

    /// Whether the surface leaves no way in; only of a closed solid can be told what is inside.
    fn is_closed(&self) -> bool {
        true
    }

    /// The greatest coordinate that its crossings are computed from: what their errors are
    /// proportional to.
    fn reach(&self) -> R {
        self.bounds().max_abs()
    }

    /// A box around the solid; for the half-space it is another one than around its plane.
    fn extent(&self) -> Aabb<R> {
        self.bounds()
    }
}

impl<R: Real> Convex<R> for Sphere<R> {
    fn span(&self, ray: &Ray<R>, length: &Self::PerRay) -> Option<(R, R)> {
        self.crossings(ray, length)
    }
}

impl<R: Real> Convex<R> for AxisBox<R> {
    fn span(&self, _ray: &Ray<R>, slopes: &Self::PerRay) -> Option<(R, R)> {
        slopes.clip(self.lo, self.hi, -R::MAX, R::MAX)
    }
}

impl<R: Real> Convex<R> for Cylinder<R> {
    fn span(&self, ray: &Ray<R>, length: &Self::PerRay) -> Option<(R, R)> {
        let (frame, [near, far]) = self.crossings(ray, length)?;
        Some((frame.start + near?.0, frame.start + far?.0))
    }

    fn is_closed(&self) -> bool {
        self.capped
    }
}

impl<R: Real> Convex<R> for Cone<R> {
    fn span(&self, ray: &Ray<R>, length: &Self::PerRay) -> Option<(R, R)> {
        let (frame, [near, far]) = self.crossings(ray, length)?;
        Some((frame.start + near?.0, frame.start + far?.0))
    }

    fn is_closed(&self) -> bool {
        self.capped
    }
}

/// The half-space behind the plane: all from which its normal points away.
impl<R: Real> Convex<R> for Plane<R> {
    fn span(&self, ray: &Ray<R>, _per_ray: &()) -> Option<(R, R)> {
        let zero = R::Wide::default();
        let towards = self.normal.dot(ray.direction());
        let height = self.normal.dot(self.point - ray.origin());
        let t = R::ratio(height, towards);
        if !t.is_finite() || towards == zero {
            // Along the plane: for ever or never behind it.
            (height >= zero).then_some((-R::INFINITY, R::INFINITY))
        } else if towards < zero {
            Some((t, R::INFINITY))
        } else {
            Some((-R::INFINITY, t))
        }
    }

    fn reach(&self) -> R {
        self.point.max_abs()
    }

    /// Where the plane is square to an axis it bounds the half-space on that side.
    fn extent(&self) -> Aabb<R> {
        let mut all = self.bounds();
        for axis in Axis::ALL {
            let (u, v) = axis.others();
            if !(self.normal.along(u) == R::ZERO && self.normal.along(v) == R::ZERO) {
                continue;
            }
            let wall = |of: Vec3<R>| {
                let component = |a: Axis| if a == axis { self.point.along(a) } else { of.along(a) };
                Vec3::<R>::from_array(Axis::ALL.map(component))
            };
            if self.normal.along(axis) > R::ZERO {
                all.hi = wall(all.hi);
            } else {
                all.lo = wall(all.lo);
            }
        }
        all
    }
}
