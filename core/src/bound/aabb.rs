//! The axis-aligned box as a bound.
//!
//! T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986. A shape may be hit up to
//! half of the pad outside its box. The other half is 32 units in the last place of the scene's
//! greatest coordinate; the parameter at which a ray meets a side is the product of a difference of
//! at most six such coordinates, rounded, with a rounded reciprocal: 5 units.

use super::slab::{Course, courses, cut_by_box};
use super::{Bound, Fitted, Region, Stored, shrunk};
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// What boxes want to know of a ray.
#[derive(Clone, Copy, Debug)]
pub struct Courses<R: Real>([Course<R>; 3]);

impl<R: Real> Bound<R> for Aabb<R> {
    type PerRay = Courses<R>;

    fn half_area(&self) -> R {
        let size = self.size();
        let (x, y, z) = (shrunk(size.x()), shrunk(size.y()), shrunk(size.z()));
        R::narrow(x.times(y) + y.times(z) + z.times(x))
    }

    fn middle(&self) -> Vec3<R> {
        self.lo * R::HALF + self.hi * R::HALF
    }

    fn per_ray(ray: &Ray<R>) -> Courses<R> {
        Courses(courses(ray))
    }

    #[inline]
    fn enter(&self, Courses(courses): &Courses<R>, start: R, limit: R) -> Option<R> {
        // Nothing is hit where there is nothing between the two.
        if !(start <= limit) {
            return None;
        }
        cut_by_box::<R>((start, limit), courses, self.lo, self.hi).map(|(enter, _)| enter)
    }
}

impl<R: Real> Fitted<R> for Aabb<R> {
    fn around(region: &Region<R>, pad: R) -> Self {
        region.bounds().grown(pad)
    }

    fn union(self, other: Self) -> Self {
        Self::union(self, other)
    }
}

impl<R: Real> Stored<R> for Aabb<R> {
    type Plain = [[R; 3]; 2];

    fn plain(self) -> Self::Plain {
        [self.lo.to_array(), self.hi.to_array()]
    }

    fn of([lo, hi]: &Self::Plain) -> Self {
        Self { lo: Vec3::<R>::from_array(*lo), hi: Vec3::<R>::from_array(*hi) }
    }
}
