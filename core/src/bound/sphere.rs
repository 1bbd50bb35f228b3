//! The sphere as a bound.
//!
//! J. Goldsmith, J. Salmon (1987) and H. Weghorst, G. Hooper, D. Greenberg (1984) compare it with
//! boxes; I. Palmer, R. Grimsdale, "Collision detection for animation using sphere-trees", CGF 14(2)
//! (1995) build trees of it.
//!
//! The test is that of the [shape](crate::shape::Sphere) but for the near crossing, which is the
//! middle less half the chord: it need not be exact, and must not go wild where a ray starts on the
//! surface. In units in the last place of the scene's greatest coordinate: a shape may be hit √3
//! times 32 outside; the nearest point of a ray that starts 10 away is off by 11, across, and the
//! parameters by 31. A chord through a point that lies m inside the sphere reaches m/2 beyond it at
//! least. The radius is four pads greater, 256: (256 - 55 - 11) / 2 = 95 are more than 31.

use super::{Bound, Fitted, Region, Stored, shrunk};
use crate::geom::Ray;
use crate::num::{Real, Vec3, Vector};
use crate::shape::{Length, Shape, Sphere};

impl<R: Real> Bound<R> for Sphere<R> {
    type PerRay = (Ray<R>, Length<R>);

    /// The square of the radius: in proportion to its surface.
    fn half_area(&self) -> R {
        let radius = shrunk(self.radius);
        R::narrow(radius.times(radius))
    }

    fn middle(&self) -> Vec3<R> {
        self.center
    }

    fn per_ray(ray: &Ray<R>) -> Self::PerRay {
        (*ray, <Self as Shape<R>>::per_ray(ray))
    }

    #[inline]
    fn enter(&self, (ray, length): &Self::PerRay, start: R, limit: R) -> Option<R> {
        let (enter, leave) = self.chord(ray, length)?;
        let (enter, leave) = (enter.max(start), leave.min(limit));
        (enter <= leave).then_some(enter)
    }
}

impl<R: Real> Fitted<R> for Sphere<R> {
    fn around(region: &Region<R>, pad: R) -> Self {
        let (center, radius) = region.ball();
        Self { center, radius: radius + pad.times_int(4) }
    }

    /// The smallest sphere around both, or one of them where it contains the other.
    fn union(self, other: Self) -> Self {
        let way = other.center - self.center;
        let rounded = R::ONE + R::ulps(4);
        let distance = way.length() * rounded;
        if distance + other.radius <= self.radius {
            return self;
        }
        if distance + self.radius <= other.radius {
            return other;
        }
        // Neither contains the other, so they are apart and this is not 0.
        let radius = (self.radius * R::HALF + other.radius * R::HALF) + distance * R::HALF;
        let center = self.center + way * ((radius - self.radius) / distance);
        let reach = |s: Self| (s.center - center).length() * rounded + s.radius;
        Self { center, radius: reach(self).max(reach(other)) * rounded }
    }
}

impl<R: Real> Stored<R> for Sphere<R> {
    type Plain = [R; 4];

    fn plain(self) -> Self::Plain {
        let [x, y, z] = self.center.to_array();
        [x, y, z, self.radius]
    }

    fn of([x, y, z, radius]: &Self::Plain) -> Self {
        Self { center: Vec3::<R>::new(*x, *y, *z), radius: *radius }
    }
}
