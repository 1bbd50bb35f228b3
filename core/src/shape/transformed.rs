//! Solids that are moved, turned, stretched and sheared.
//!
//! The ray is taken to where the solid is as it was made, and not made a unit again, so `t` is the
//! same in both places; normals come back by the transposed inverse (J. T. Kajiya, S. M. Rubin and
//! T. Whitted used instances so, "A 3-dimensional representation for fast rendering of complex
//! scenes", SIGGRAPH 1980; for normals K. Turkowski, "Properties of surface-normal
//! transformations", Graphics Gems, 1990).

use super::{Convex, Shape, ShapeError, settle};
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};

/// An affine map: where the axes and the origin of a solid's own space go.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Affine<R: Real> {
    /// Images of the directions x, y and z.
    pub axes: [R::Vec3; 3],
    /// Image of the origin.
    pub origin: R::Vec3,
}

impl<R: Real> Affine<R> {
    /// The image of a direction.
    pub fn direction(&self, v: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.axes;
        // Component by component as a sum of full products.
        let component =
            |of: fn(Vec3<R>) -> R| R::narrow(Vec3::<R>::new(of(x), of(y), of(z)).dot(v));
        Vec3::<R>::new(component(Vector::x), component(Vector::y), component(Vector::z))
    }

    /// The image of a point.
    pub fn point(&self, p: Vec3<R>) -> Vec3<R> {
        self.direction(p) + self.origin
    }

    /// The transposed linear part: takes normals back to where the map comes from.
    fn transposed(&self, n: Vec3<R>) -> Vec3<R> {
        Vec3::<R>::from_array(self.axes.map(|axis| R::narrow(axis.dot(n))))
    }

    /// The linear part of the inverse, if there is one.
    fn inverse(&self) -> Option<[Vec3<R>; 3]> {
        let [x, y, z] = self.axes;
        let rows = [y.cross(z), z.cross(x), x.cross(y)];
        let determinant = R::narrow(x.dot(y.cross(z)));
        let rows = rows.map(|row| row.map(|component| component / determinant));
        let [a, b, c] = rows;
        let column = |of: fn(Vec3<R>) -> R| Vec3::<R>::new(of(a), of(b), of(c));
        let columns = [column(Vector::x), column(Vector::y), column(Vector::z)];
        let usable = |v: &Vec3<R>| v.is_finite() && !v.is_zero();
        (determinant.abs() > R::ZERO && columns.iter().all(usable)).then_some(columns)
    }
}

/// An image of a convex solid under an affine map; 72 bytes in `f32` and the solid.
///
/// Errors grow with the ratio of the greatest to the least stretching. In fixed point a solid should
/// be made in about the size in which it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Transformed<R: Real, T> {
    solid: T,
    /// Images of the axes of the world in the solid's space.
    inverse: [R::Vec3; 3],
    /// Where the origin of the solid's space lies in the world.
    origin: R::Vec3,
    bounds: Aabb<R>,
}

impl<R: Real, T: Convex<R>> Transformed<R, T> {
    /// The image of a solid, with a box around the image of its box.
    ///
    /// # Errors
    /// [`ShapeError::Degenerate`] when the map flattens everything, or almost.
    pub fn new(solid: T, map: &Affine<R>) -> Result<Self, ShapeError> {
        let inverse = map.inverse().ok_or(ShapeError::Degenerate)?;
        let around = solid.bounds();
        let half = (around.hi - around.lo) * R::HALF;
        let middle = map.point(around.lo + half);
        let [x, y, z] = map.axes.map(|axis| axis.map(R::abs));
        let reach = x * half.x() + y * half.y() + z * half.z();
        let far = around.max_abs();
        let size = map.origin.max_abs() + (x + y + z).max_abs() * far;
        let bounds = Aabb { lo: middle - reach, hi: middle + reach }.grown(R::ulps_at(8, size));
        Ok(Self { solid, inverse, origin: map.origin, bounds })
    }

    /// From what it consists of; for constants.
    pub const fn of_parts(
        solid: T,
        inverse: [R::Vec3; 3],
        origin: R::Vec3,
        bounds: Aabb<R>,
    ) -> Self {
        Self { solid, inverse, origin, bounds }
    }

    /// The solid as it was made.
    pub fn solid(&self) -> &T {
        &self.solid
    }

    /// The map that takes the world to the solid's space.
    fn back(&self) -> Affine<R> {
        Affine { axes: self.inverse, origin: Vec3::<R>::default() }
    }

    /// The ray as the solid sees it.
    fn local(&self, ray: &Ray<R>) -> Option<Ray<R>> {
        let back = self.back();
        let origin = back.direction(ray.origin() - self.origin);
        let local = Ray::from(origin, back.direction(ray.direction()), origin.max_abs())?;
        Some(local.with_slack(ray.slack()))
    }
}

impl<R: Real, T: Convex<R>> Shape<R> for Transformed<R, T> {
    type PerRay = ();

    fn per_ray(_ray: &Ray<R>) {}

    fn check(&self) -> Result<(), ShapeError> {
        self.solid.check()?;
        let workable = |axis: &Vec3<R>| axis.is_finite() && R::is_workable_normal(axis.max_abs());
        let inverse = self.inverse.iter().all(workable);
        if inverse && self.origin.is_finite() && R::is_workable(self.bounds.max_abs()) {
            Ok(())
        } else {
            Err(ShapeError::NotFinite)
        }
    }

    fn bounds(&self) -> Aabb<R> {
        self.bounds
    }

    fn hit(&self, ray: &Ray<R>, _per_ray: &(), min: R, max: R) -> Option<R> {
        let (enter, leave) = self.span(ray, &())?;
        let counts = |t| settle(ray, self.bounds, t).filter(|t| *t > min && *t <= max);
        counts(enter).or_else(|| counts(leave))
    }

    fn normal(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        let normal = self.local(ray).map(|local| self.solid.normal(&local, t));
        self.back().transposed(normal.unwrap_or_default())
    }
}

impl<R: Real, T: Convex<R>> Convex<R> for Transformed<R, T> {
    fn span(&self, ray: &Ray<R>, _per_ray: &()) -> Option<(R, R)> {
        let local = self.local(ray)?;
        self.solid.span(&local, &T::per_ray(&local)).filter(|(enter, leave)| enter <= leave)
    }

    fn is_closed(&self) -> bool {
        self.solid.is_closed()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::{Random, all_hits, only_numbers_are_hits};
    use crate::shape::{AxisBox, Cone, Cylinder, Sphere};
    use glam::{DMat3, DVec3, Mat3, Quat, Vec3, vec3};

    extern crate std;

    const BALL: Sphere<f32> = Sphere::new(Vec3::ZERO, 1.0);
    const CUBE: AxisBox<f32> = AxisBox::new(Vec3::NEG_ONE, Vec3::ONE);

    fn map(linear: Mat3, origin: Vec3) -> Affine<f32> {
        Affine { axes: [linear.x_axis, linear.y_axis, linear.z_axis], origin }
    }

    /// Turned, stretched by up to three times as much one way as another, and moved.
    fn any_map(random: &mut Random) -> (Mat3, Vec3) {
        let mut turn =
            || Mat3::from_quat(Quat::from_axis_angle(random.direction(), random.within(0.0, 6.3)));
        let (a, b) = (turn(), turn());
        let stretch = vec3(random.within(0.5, 1.5), random.within(0.5, 1.5), -1.0);
        (a * Mat3::from_diagonal(stretch) * b, random.vector() * 4.0)
    }

    #[test]
    fn a_map_and_its_inverse_are_nothing() {
        let mut random = Random(3);
        for _ in 0..1000 {
            let (linear, origin) = any_map(&mut random);
            let there = map(linear, origin);
            let back = Affine::<f32> { axes: there.inverse().unwrap(), origin: Vec3::ZERO };
            let p = random.vector();
            let again: Vec3 = back.direction(there.point(p) - origin);
            assert!((again - p).length() < 3.0e-6);
        }
        for flat in [Mat3::ZERO, Mat3::from_diagonal(vec3(1.0, 0.0, 1.0))] {
            let flat = Transformed::new(BALL, &map(flat, Vec3::ZERO));
            assert_eq!(flat.err(), Some(ShapeError::Degenerate));
        }
        let huge = Transformed::new(BALL, &map(Mat3::IDENTITY, Vec3::X * 1.0e13)).unwrap();
        assert_eq!(huge.check(), Err(ShapeError::NotFinite));
        let thin = Mat3::from_diagonal(vec3(1.0, 1.0, 1.0e-20));
        let thin = Transformed::new(BALL, &map(thin, Vec3::ZERO)).unwrap();
        assert_eq!(thin.check(), Err(ShapeError::NotFinite));
        let wrong = Transformed::new(Sphere::new(Vec3::ZERO, -1.0), &map(Mat3::IDENTITY, Vec3::X));
        assert_eq!(wrong.unwrap().check(), Err(ShapeError::Negative));
    }

    #[test]
    fn in_its_own_place_a_solid_is_hit_bit_for_bit() {
        let same = map(Mat3::IDENTITY, Vec3::ZERO);
        let mut random = Random(4);
        for _ in 0..10_000 {
            let r = random.ray_at(Vec3::ZERO, 2.0);
            let solid = Transformed::new(BALL, &same).unwrap();
            assert_eq!(all_hits(&solid, &r), all_hits(&BALL, &r));
            let solid = Transformed::new(CUBE, &same).unwrap();
            assert_eq!(all_hits(&solid, &r), all_hits(&CUBE, &r));
        }
    }

    /// How a solid's image is hit, against a function that is negative inside of the solid.
    fn agrees<T: Convex<f32>>(
        seed: u64,
        make: impl Fn(&mut Random) -> T,
        f: impl Fn(&T, DVec3) -> f64,
    ) {
        let mut random = Random(seed);
        let (mut hits, mut worst, mut again) = (0, 0.0_f64, 0);
        for _ in 0..10_000 {
            let (linear, origin) = any_map(&mut random);
            let solid = make(&mut random);
            let shape = Transformed::new(solid, &map(linear, origin)).unwrap();
            assert_eq!(shape.check(), Ok(()));
            let inverse = DMat3::from_cols(
                linear.x_axis.as_dvec3(),
                linear.y_axis.as_dvec3(),
                linear.z_axis.as_dvec3(),
            )
            .inverse();
            let value = |p: DVec3| f(shape.solid(), inverse * (p - origin.as_dvec3()));
            let r = random.ray_at(origin, 2.0);
            let (o, d) = (r.origin().as_dvec3(), r.direction().as_dvec3());
            let found = all_hits(&shape, &r);
            let bounds = shape.bounds().grown(r.slack() * 1.01);
            assert!(found.iter().all(|t| bounds.contains(r.at(*t))), "{r:?}");
            let reach = o.length() + 5.0;
            if let [enter, leave] = found[..] {
                let at = |t: f64| value(o + d * t);
                let (enter, leave) = (f64::from(enter), f64::from(leave));
                worst = worst.max(at(enter).abs().max(at(leave).abs()) / reach);
                if (leave - enter) * d.length() > 1.0e-2 {
                    assert!(at((enter + leave) / 2.0) < 0.0);
                    let n = shape.normal(&r, found[0]).normalize();
                    assert!(n.dot(r.direction()) <= 0.0);
                    // From just outside, along the normal, the solid is not met again.
                    let p = r.at(found[0]);
                    let error = f32::ulps(8) * r.origin().max_abs().max(p.max_abs());
                    let off = Ray::new(p + n * error * 2.0, n).unwrap();
                    again += usize::from(shape.hit(&off, &(), 0.0, f32::INFINITY).is_some());
                }
                hits += 2;
            }
            // No point of the solid that the ray passes is missed.
            for i in 0..50 {
                let t = (f64::from(i) + 0.5) / 50.0 * 4.0 / d.length() * reach / 4.0;
                let inside = found.len() == 2 && t > f64::from(found[0]) && t < f64::from(found[1]);
                let v = value(o + d * t);
                assert!(inside == (v < 0.0) || v.abs() < 1.0e-4, "{v} {found:?} {t}");
            }
        }
        std::println!("{hits} crossings, off the surface {worst:e}, met again {again}");
        assert!(hits > 4000 && worst < 2.0e-6, "{hits} {worst:e}");
        assert!(again * 1000 <= hits, "{again}");
    }

    #[test]
    fn images_agree_with_double_precision() {
        agrees(1, |_| BALL, |_, p| p.length() - 1.0);
        agrees(2, |_| CUBE, |_, p| p.abs().max_element() - 1.0);
        let round = |p: DVec3, r: f64| (p.with_y(0.0).length() - r).max(p.y.abs() - 1.0);
        agrees(
            3,
            |_| Cylinder::<f32>::new(Vec3::NEG_Y, Vec3::Y, 0.75).capped(),
            |_, p| round(p, 0.75),
        );
        agrees(
            4,
            |_| Cone::<f32>::new(Vec3::NEG_Y, Vec3::Y, 1.0, 0.5).capped(),
            |_, p| round(p, 0.75 - 0.25 * p.y),
        );
    }

    #[test]
    fn only_numbers_are_hits_of_images() {
        let (linear, _) = any_map(&mut Random(9));
        only_numbers_are_hits(&Transformed::new(BALL, &map(linear * 0.5, Vec3::ZERO)).unwrap());
        only_numbers_are_hits(&Transformed::new(CUBE, &map(linear * 0.5, Vec3::ZERO)).unwrap());
    }
}
