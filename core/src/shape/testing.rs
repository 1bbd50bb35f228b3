//! What the tests of all shapes use.

use super::axial::Hull;
use super::{Shape, ShapeError};
use crate::geom::Ray;
use glam::{Vec3, vec3};

extern crate std;
use std::vec::Vec;

/// A ray, or a failed test.
pub(super) fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray<f32> {
    Ray::new(origin.into(), direction.into()).unwrap()
}

/// A ray with a direction of length 1, or a failed test.
pub(super) fn normalized(origin: [f32; 3], direction: [f32; 3]) -> Ray<f32> {
    Ray::new(origin.into(), Vec3::from(direction).normalize()).unwrap()
}

/// Every crossing of a ray with a shape, behind its origin too, found one after the other.
pub(super) fn all_hits<S: Shape<f32>>(shape: &S, ray: &Ray<f32>) -> Vec<f32> {
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
    pub(super) fn ray_at(&mut self, place: Vec3, size: f32) -> Ray<f32> {
        let away = 0.5 * 100.0_f32.powf(self.within(0.0, 1.0));
        let from = place + self.direction() * (size * away);
        let to = place + self.vector() * size * 0.6;
        Ray::new(from, (to - from) * self.within(0.1, 2.0)).unwrap()
    }
}

/// Rays of all magnitudes, aligned and not, meet a shape at numbers inside its box or not at all.
pub(super) fn only_numbers_are_hits<S: Shape<f32>>(shape: &S) {
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

/// Shapes of every magnitude are either refused or hit by some ray, and from 1e-12 to 1e10 they are
/// not refused. `make` gives a shape of about a size and the points to aim at.
pub(super) fn hit_or_refused<S: Shape<f32>, const N: usize>(
    mut make: impl FnMut(&mut Random, Vec3, f32) -> (S, [Vec3; N]),
) {
    let mut random = Random(21);
    for exponent in -30..10 {
        for i in 0..400_u16 {
            let size = 10.0_f32.powf(exponent as f32 + random.within(0.0, 1.0));
            let place = random.vector() * size * f32::from(i % 4);
            let (shape, aims) = make(&mut random, place, size);
            if let Err(why) = shape.check() {
                assert!(size < 1.0e-12 && why == ShapeError::Degenerate, "{size:e} {why:?}");
                continue;
            }
            // Along the axes, through the very numbers; then any.
            let ways = [Vec3::X, Vec3::Y, Vec3::Z].map(|way| way * size * 2.0);
            let any: Vec<Vec3> = (0..16).map(|_| random.direction() * size * 2.0).collect();
            let hit = ways.into_iter().chain(any).any(|way| {
                aims.iter().any(|aim| {
                    // The direction of a ray may be of any length, but not all of them reach.
                    let r = Ray::new(*aim - way, way * (1.0 / size)).unwrap();
                    shape.hit(&r, &S::per_ray(&r), 0.0, f32::INFINITY).is_some()
                })
            });
            assert!(hit, "{size:e}: {aims:?}");
        }
    }
}

/// Where a ray meets the surface of a hull after it has grown by about a factor: wall and discs,
/// each by the textbook, in double precision, with the cosine at each crossing.
pub(super) fn reference(h: &Hull<f32>, capped: bool, r: &Ray<f32>, grow: f64) -> Vec<(f64, f64)> {
    let axis = h.axis.as_dvec3().normalize();
    let height = f64::from(h.height);
    let growth = (f64::from(h.apex_radius) - f64::from(h.base_radius)) / height;
    let mean = (f64::from(h.apex_radius) + f64::from(h.base_radius)) / 2.0;
    // Outwards by the same distance everywhere, about.
    let moved = (grow - 1.0) * (height + mean);
    let half = height / 2.0 + moved;
    let mean = mean + moved * (1.0 + growth * growth).sqrt();
    let middle = h.base.as_dvec3() + axis * (height / 2.0);
    let (o, d) = (r.origin().as_dvec3() - middle, r.direction().as_dvec3());
    let (oz, dz) = (o.dot(axis), d.dot(axis));
    let (op, dp) = (o - axis * oz, d - axis * dz);
    let at = mean + growth * oz;
    let qa = dp.dot(dp) - growth * growth * dz * dz;
    let qb = 2.0 * (op.dot(dp) - at * growth * dz);
    let qc = op.dot(op) - at * at;
    let mut hits = Vec::new();
    let delta = qb * qb - 4.0 * qa * qc;
    for sign in [-1.0, 1.0] {
        let t = (-qb + sign * delta.sqrt()) / (2.0 * qa);
        let z = oz + dz * t;
        if z.abs() <= half && mean + growth * z >= 0.0 {
            let n = (op + dp * t).normalize() - axis * growth;
            hits.push((t, n.normalize().dot(d.normalize()).abs()));
        }
    }
    for z in [-half, half] {
        let t = (z - oz) / dz;
        if capped && (op + dp * t).length() <= mean + growth * z {
            hits.push((t, dz.abs() / d.length()));
        }
    }
    hits.sort_by(|a, b| a.0.total_cmp(&b.0));
    hits
}

/// Random rays meet random solids around an axis where [`reference`] says, and see the normals it
/// says where the cosine is above `seen_from`.
pub(super) fn agrees_with_double_precision<S: Shape<f32> + core::fmt::Debug>(
    mut random: Random,
    seen_from: f64,
    mut make: impl FnMut(&mut Random, u16, Vec3, Vec3) -> (S, Hull<f32>, bool),
) {
    let (mut compared, mut off_surface, mut worst) = (0, 0.0_f64, 0.0_f64);
    for i in 0..20_000_u16 {
        let base = random.vector() * 5.0;
        let apex = base + random.direction() * random.within(0.1, 8.0);
        let (shape, hull, capped) = make(&mut random, i, base, apex);
        assert_eq!(shape.check(), Ok(()));
        let size = hull.height + hull.base_radius.max(hull.apex_radius);
        let r = random.ray_at((base + apex) * 0.5, size);
        let hits = all_hits(&shape, &r);
        let bounds = shape.bounds().grown(r.slack() * 1.01);
        assert!(hits.iter().all(|t| bounds.contains(r.at(*t))), "{shape:?} {r:?}");
        let expected = reference(&hull, capped, &r, 1.0);
        let count = |grow| reference(&hull, capped, &r, grow).len();
        if count(0.9999) != expected.len() || count(1.0001) != expected.len() {
            continue;
        }
        assert_eq!(hits.len(), expected.len(), "{i} {shape:?} {r:?} {hits:?} {expected:?}");
        for (t, (expected, cosine)) in hits.iter().zip(expected) {
            compared += 1;
            let reach = f64::from((base - r.origin()).length() + size + base.length());
            let error = (f64::from(*t) - expected).abs() * f64::from(r.direction().length());
            off_surface = off_surface.max(error * cosine / reach);
            if cosine > 0.1 {
                worst = worst.max(error / reach);
            }
            if cosine > seen_from {
                let n = shape.normal(&r, *t).normalize();
                let seen = f64::from(n.dot(r.direction().normalize()).abs());
                assert!((seen - cosine).abs() < 3.0e-3, "{seen} {cosine} {shape:?} {r:?}");
            }
        }
    }
    std::println!("{compared} crossings, off {off_surface:e}, in t {worst:e}");
    assert!(compared > 8000);
    assert!(off_surface < 4.0e-7, "{off_surface:e}");
    assert!(worst < 1.0e-6, "{worst:e}");
}
