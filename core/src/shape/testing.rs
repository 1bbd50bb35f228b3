//! What the tests of all shapes use.

use super::Shape;
use crate::geom::Ray;
use glam::{Vec3, vec3};

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

/// G. Marsaglia, "Xorshift RNGs" (2003), 64 bits.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Between -1 and 1.
    pub(crate) fn signed(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    /// Between `lo` and `hi`.
    pub(crate) fn within(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * (self.signed() * 0.5 + 0.5)
    }

    /// In the cube from -1 to 1.
    pub(crate) fn vector(&mut self) -> Vec3 {
        vec3(self.signed(), self.signed(), self.signed())
    }

    /// Of length 1.
    pub(crate) fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if v.length() > 0.1 && v.length() <= 1.0 {
                return v.normalize();
            }
        }
    }

    /// From 0.5 to 50 sizes away to somewhere around a place.
    pub(crate) fn ray_at(&mut self, place: Vec3, size: f32) -> Ray<f32> {
        let away = 0.5 * 100.0_f32.powf(self.within(0.0, 1.0));
        let from = place + self.direction() * (size * away);
        let to = place + self.vector() * size * 0.6;
        Ray::new(from, (to - from) * self.within(0.1, 2.0)).unwrap()
    }
}

/// Rays of all magnitudes, aligned and not, meet a shape at numbers inside its box or not at all.
pub(crate) fn only_numbers_are_hits<S: Shape<f32>>(shape: &S) {
    let values = [0.0, -0.0, 1.0e-45, -1.0e-30, 1.0e-8, 0.5, 1.0, -1.0, 3.0e4, -1.0e15, 1.0e30];
    let mut random = Random(77);
    let mut pick = || {
        let i = random.within(0.0, 10.99) as usize;
        let v = values[i];
        if random.signed() > 0.5 { v * random.within(0.1, 1.0) } else { v }
    };
    for _ in 0..100_000 {
        let (o, d) = (vec3(pick(), pick(), pick()), vec3(pick(), pick(), pick()));
        let Ok(r) = Ray::new(o, d) else { continue };
        let per_ray = S::per_ray(&r);
        for (min, max) in [(0.0, f32::INFINITY), (-f32::INFINITY, f32::INFINITY), (1.0, 0.0)] {
            if let Some(t) = shape.hit(&r, &per_ray, min, max) {
                assert!(t.is_finite() && t > min && t <= max, "{r:?} {t}");
                // A scene gives its rays the slack of its own size, here about 1.
                let bounds = shape.bounds().grown(r.slack() * 2.0 + 4.0e-6);
                assert!(!S::BOUNDED || bounds.contains(r.at(t)), "{r:?} {t}");
                let _ = shape.normal(&r, t);
            }
            for nan in [(f32::NAN, max), (min, f32::NAN)] {
                assert_eq!(shape.hit(&r, &per_ray, nan.0, nan.1), None);
            }
        }
    }
}
