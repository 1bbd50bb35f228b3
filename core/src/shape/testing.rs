//! What the tests of all shapes use.

use super::Shape;
use crate::geom::Ray;

extern crate std;
use std::vec::Vec;

/// A ray, or a failed test.
pub(crate) fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray<f32> {
    Ray::new(origin.into(), direction.into()).unwrap()
}

/// Every crossing of a ray with a shape, behind its origin too, found one after the other.
pub(crate) fn all_hits<S: Shape<f32>>(shape: &S, ray: &Ray<f32>) -> Vec<f32> {
    let per_ray = S::per_ray(ray);
    let mut hits = Vec::new();
    let mut min = -f32::MAX;
    while let Some(t) = shape.hit(ray, &per_ray, min, f32::MAX) {
        assert!(t > min, "not beyond the last hit: {t} {min}");
        assert!(shape.occludes(ray, &per_ray, min, f32::MAX));
        hits.push(t);
        min = t;
    }
    assert!(!shape.occludes(ray, &per_ray, min, f32::MAX));
    hits
}
