//! The infinite plane.

use super::{Shape, ShapeError};
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// An infinite plane; 24 bytes in `f32`. No box can hold it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Plane<R: Real> {
    /// One of its points. Near to what is seen of it, it makes the crossings more exact.
    pub point: Vec3<R>,
    /// A vector across it, of any length but 0, towards the front.
    pub normal: Vec3<R>,
}

impl<R: Real> Plane<R> {
    /// A plane through a point, across a vector.
    pub const fn new(point: Vec3<R>, normal: Vec3<R>) -> Self {
        Self { point, normal }
    }
}

impl<R: Real> Shape<R> for Plane<R> {
    type PerRay = ();

    const BOUNDED: bool = false;

    fn per_ray(_ray: &Ray<R>) {}

    fn check(&self) -> Result<(), ShapeError> {
        let n = self.normal;
        if !(self.point.is_finite()
            && n.is_finite()
            && R::is_workable(self.point.max_abs())
            && R::is_workable_normal(n.max_abs()))
        {
            Err(ShapeError::NotFinite)
        } else if n.dot(n) > R::Wide::default() {
            Ok(())
        } else {
            Err(ShapeError::NotUnit)
        }
    }

    /// Everything there is.
    fn bounds(&self) -> Aabb<R> {
        Aabb { lo: Vec3::<R>::splat(-R::MAX), hi: Vec3::<R>::splat(R::MAX) }
    }

    /// A ray parallel to the plane misses it, inside of it too.
    fn hit(&self, ray: &Ray<R>, _per_ray: &(), min: R, max: R) -> Option<R> {
        let towards = self.normal.dot(ray.direction());
        if towards == R::Wide::default() {
            return None;
        }
        let way = self.normal.dot(self.point - ray.origin());
        // Behind the ray; to be told without a division where that is dear.
        if R::EXACT
            && min >= R::ZERO
            && (way < R::Wide::default()) != (towards < R::Wide::default())
        {
            return None;
        }
        let t = R::ratio(way, towards);
        (t.is_finite() && t > min && t <= max).then_some(t)
    }

    fn normal(&self, _ray: &Ray<R>, _t: R) -> Vec3<R> {
        self.normal
    }

    fn computed_from(&self) -> R {
        self.point.max_abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{Random, all_hits, only_numbers_are_hits, ray};
    use glam::{Vec3, vec3};

    extern crate std;

    const GROUND: Plane<f32> = Plane::new(Vec3::ZERO, Vec3::Y);

    #[test]
    fn published_crossings() {
        // J. Buck, The Ray Tracer Challenge (2019), chapter 9.
        assert!(all_hits(&GROUND, &ray([0.0, 10.0, 0.0], [0.0, 0.0, 1.0])).is_empty());
        assert!(all_hits(&GROUND, &ray([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])).is_empty());
        assert_eq!(all_hits(&GROUND, &ray([0.0, 1.0, 0.0], [0.0, -1.0, 0.0])), [1.0]);
        assert_eq!(all_hits(&GROUND, &ray([0.0, -1.0, 0.0], [0.0, 1.0, 0.0])), [1.0]);
    }

    #[test]
    fn almost_parallel_rays_never_hit_at_infinity() {
        for y in [1.0e-44, -1.0e-44, 1.0e-38, 0.0, -0.0] {
            let r = ray([0.0, 1.0, 0.0], [1.0, y, 0.0]);
            assert_eq!(GROUND.hit(&r, &(), 0.0, f32::INFINITY), None, "{y}");
        }
        let r = ray([0.0, 1.0, 0.0], [1.0, -1.0e-30, 0.0]);
        assert_eq!(GROUND.hit(&r, &(), 0.0, f32::INFINITY), Some(1.0e30));
    }

    #[test]
    fn agrees_with_double_precision() {
        let mut random = Random(6);
        let mut worst = 0.0_f64;
        for _ in 0..20_000 {
            let p = Plane::<f32>::new(random.vector() * 5.0, random.direction() * 3.0);
            let r = random.ray_at(p.point, 2.0);
            let (o, d) = (r.origin().as_dvec3(), r.direction().as_dvec3());
            let n = p.normal.as_dvec3().normalize();
            let t = n.dot(p.point.as_dvec3() - o) / n.dot(d);
            if n.dot(d.normalize()).abs() > 0.1 {
                let [found] = all_hits(&p, &r)[..] else { panic!("not one hit") };
                let reach = o.length() + 5.0;
                worst = worst.max((f64::from(found) - t).abs() * d.length() / reach);
            }
        }
        std::println!("worst {worst:e}");
        assert!(worst < 2.0e-6, "{worst:e}");
    }

    #[test]
    fn only_numbers_are_hits_of_planes() {
        only_numbers_are_hits(&GROUND);
        only_numbers_are_hits(&Plane::<f32>::new(Vec3::ONE, vec3(1.0, -2.0, 0.5)));
    }

    #[test]
    fn degenerate_planes_are_refused() {
        let check = |p, n| Plane::<f32>::new(p, n).check();
        assert_eq!(check(Vec3::ZERO, Vec3::ZERO), Err(ShapeError::NotUnit));
        assert_eq!(check(Vec3::ZERO, Vec3::X * 1.0e-30), Err(ShapeError::NotUnit));
        assert_eq!(check(Vec3::NAN, Vec3::X), Err(ShapeError::NotFinite));
        assert_eq!(check(Vec3::ZERO, vec3(0.0, f32::INFINITY, 1.0)), Err(ShapeError::NotFinite));
        assert_eq!(check(Vec3::X * 1.0e13, Vec3::X), Err(ShapeError::NotFinite));
        assert_eq!(check(Vec3::X, Vec3::NEG_X), Ok(()));
    }
}
