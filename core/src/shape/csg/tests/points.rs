//! Random objects, point by point.

use super::*;
use crate::shape::Cone;
use glam::DVec3;
use std::boxed::Box;

type Kinds<'a> = (
    &'a [Sphere<f32>],
    (&'a [AxisBox<f32>], (&'a [Cylinder<f32>], (&'a [Cone<f32>], &'a [Plane<f32>]))),
);

/// Random solids of every kind, and in which of them a point is.
#[derive(Default)]
struct Crowd {
    spheres: Vec<Sphere<f32>>,
    boxes: Vec<AxisBox<f32>>,
    cylinders: Vec<Cylinder<f32>>,
    cones: Vec<Cone<f32>>,
    planes: Vec<Plane<f32>>,
}

impl Crowd {
    fn new(random: &mut Random) -> Self {
        let mut all = Self::default();
        for _ in 0..4 {
            let at = |random: &mut Random| random.vector() * 0.8;
            all.spheres.push(Sphere::new(at(random), random.within(0.3, 1.0)));
            let (a, b) = (random.vector(), random.vector());
            all.boxes.push(AxisBox::new(a.min(b) - 0.1, a.max(b) + 0.1));
            let (a, b, r) = (random.vector(), random.vector(), random.within(0.2, 0.7));
            all.cylinders.push(Cylinder::new(a, b, r).capped());
            let (a, b) = (random.vector(), random.vector());
            let radii = (random.within(0.0, 0.8), random.within(0.2, 0.8));
            all.cones.push(Cone::new(a, b, radii.0, radii.1).capped());
            let way = if random.signed() > 0.0 { random.direction() } else { Vec3::NEG_Y };
            all.planes.push(Plane::new(at(random), way));
        }
        all
    }

    fn parts(self) -> (&'static Self, Kinds<'static>) {
        let all: &'static Self = Box::leak(Box::new(self));
        let rest = (&all.cylinders[..], (&all.cones[..], &all.planes[..]));
        (all, (&all.spheres[..], (&all.boxes[..], rest)))
    }

    /// How far inside a part a point is, about; negative outside.
    fn depth(&self, part: u16, p: DVec3) -> f64 {
        let (kind, i) = (part / 4, usize::from(part % 4));
        let round = |base: Vec3, axis: Vec3, height: f32, a: f32, b: f32| {
            let axis = axis.as_dvec3().normalize();
            let (q, height) = (p - base.as_dvec3(), f64::from(height));
            let up = q.dot(axis);
            let out = (q - axis * up).length();
            let radius = f64::from(a) + f64::from(b - a) * up / height;
            up.min(height - up).min(radius - out)
        };
        match kind {
            0 => {
                let s = self.spheres[i];
                f64::from(s.radius) - (p - s.center.as_dvec3()).length()
            }
            1 => {
                let b = self.boxes[i];
                let (lo, hi) = (p - b.lo.as_dvec3(), b.hi.as_dvec3() - p);
                lo.min_element().min(hi.min_element())
            }
            2 => {
                let c = self.cylinders[i];
                round(c.base, c.axis, c.height, c.radius, c.radius)
            }
            3 => {
                let c = self.cones[i];
                round(c.base, c.axis, c.height, c.base_radius, c.apex_radius)
            }
            _ => {
                let h = self.planes[i];
                (h.point.as_dvec3() - p).dot(h.normal.as_dvec3().normalize())
            }
        }
    }
}

/// Random objects over random solids, as many as wanted.
fn objects(
    random: &mut Random,
    count: usize,
    mut check: impl FnMut(&mut Random, &Crowd, &Csg<'_, f32, Kinds<'_>>, &[Step]),
) {
    let mut made = 0;
    while made < count {
        let (all, kinds) = Crowd::new(random).parts();
        let parts = 1 + random.within(0.0, 11.99) as u16;
        let mut steps = tree(random, parts);
        for step in &mut steps {
            if let Step::Part(part) = step {
                *part = random.within(0.0, 19.99) as u16;
            }
        }
        match csg(kinds, &steps) {
            Ok(csg) => {
                check(random, all, &csg, &steps);
                made += 1;
            }
            Err(CsgError::Empty { .. } | CsgError::Unbounded { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn cutting_bounds_moves_no_point_in_or_out() {
    let mut random = Random(31);
    let (mut points, mut inside, mut cut) = (0, 0, 0);
    objects(&mut random, 1000, |random, all, csg, steps| {
        let trees = csg.trees();
        for _ in 0..200 {
            let p = random.vector() * 1.5;
            let depth = |part| all.depth(part, p.as_dvec3());
            let before = holds(steps, |_, part| depth(part) >= 0.0);
            let counts = |step| trees.bounds(step).contains(p);
            let after = holds(steps, |step, part| counts(step) && depth(part) >= 0.0);
            let without = |(step, kind): (usize, &Step)| match kind {
                Step::Part(part) => !counts(step) && depth(*part) >= 0.0,
                Step::Join(_) => false,
            };
            cut += steps.iter().enumerate().filter(|step| without(*step)).count();
            let near = |part: u16| depth(part).abs() < 1.0e-6;
            let on_wall = steps.iter().any(|s| matches!(s, Step::Part(part) if near(*part)));
            assert!(before == after || on_wall, "{steps:?} {p}");
            assert!(!before || csg.bounds(0).grown(1.0e-6).contains(p), "{steps:?} {p}");
            points += 1;
            inside += u32::from(before);
        }
    });
    println!("{points} points, {inside} inside, {cut} times outside of a part's cut box");
    assert!(points >= 100_000 && inside > 5000 && cut > 100_000);
}

#[test]
fn skipping_changes_no_bit_and_crossings_are_where_points_change() {
    let mut random = Random(9);
    let (mut rays, mut hits, mut all_tests, mut tests, mut lazy_tests) = (0, 0, 0, 0, 0);
    objects(&mut random, 3000, |random, all, csg, steps| {
        for _ in 0..20 {
            let r = ray_through(csg.bounds(0), random);
            let (full, most) = crossings(csg, 0, &r, LINE, false);
            let (skipped, fewer) = crossings(csg, 0, &r, LINE, true);
            assert_eq!(full, skipped, "{steps:?} {r:?}");
            assert!(fewer <= most);
            (all_tests, tests) = (all_tests + most, tests + fewer);
            let per_ray = csg.per_ray(&r);
            // In every window the same are found.
            for _ in 0..4 {
                let (min, max) = (random.within(-1.0, 6.0), random.within(0.0, 12.0));
                let counts = |(t, _): &&(f32, u16)| *t > min && *t <= max;
                let expected = full.iter().find(counts).copied();
                let mut probe = Counters::default();
                let first = csg.first_crossing(0, &r, &per_ray, (min, max), &mut probe);
                assert_eq!(first.map(|c| (c.t, c.part)), expected, "{steps:?} {r:?} {min} {max}");
                assert!(probe.primitive_tests <= most);
                lazy_tests += probe.primitive_tests;
                let t = expected.map(|(t, _)| t);
                assert_eq!(csg.hit(0, &r, &per_ray, min, max), t);
                assert_eq!(csg.occludes(0, &r, &per_ray, min, max), t.is_some());
            }
            rays += 1;
            hits += full.len();
            assert!(full.len() % 2 == 0 && full.is_sorted_by(|a, b| a.0 <= b.0));
            let bounds = csg.bounds(0).grown(r.slack() * 1.5 + 1.0e-6);
            for (t, part) in &full {
                assert!(bounds.contains(r.at(*t)), "{t} {bounds:?}");
                let at = r.origin().as_dvec3() + r.direction().as_dvec3() * f64::from(*t);
                let off = all.depth(*part, at).abs();
                let reach = f64::from(r.origin().length()) + 2.0;
                assert!(off < 2.0e-6 * reach, "{off:e} {part} {steps:?} {r:?}");
            }
            // Between crossings points are in or out as they have to be.
            let mut ends: Vec<f64> = full.iter().map(|(t, _)| f64::from(*t)).collect();
            let (first, last) = (ends.first().copied(), ends.last().copied());
            ends.insert(0, first.unwrap_or(0.0) - 3.0);
            ends.push(last.unwrap_or(0.0) + 3.0);
            for (i, pair) in ends.windows(2).enumerate() {
                let t = pair[0] + (pair[1] - pair[0]) * f64::from(random.within(0.1, 0.9));
                let p = r.origin().as_dvec3() + r.direction().as_dvec3() * t;
                let unsure = steps.iter().any(|step| match step {
                    Step::Part(part) => all.depth(*part, p).abs() < 1.0e-4,
                    Step::Join(_) => false,
                });
                let inside = holds(steps, |_, part| all.depth(part, p) >= 0.0);
                assert!(unsure || inside == (i % 2 == 1), "{steps:?} {r:?} {t}");
            }
        }
    });
    println!("{rays} rays, {hits} crossings, {all_tests} tests, {tests} with skipping");
    println!("{lazy_tests} for the first in four windows a ray");
    assert!(rays >= 60_000 && hits > 40_000 && tests * 4 < all_tests);
}

fn ray_through(bounds: Aabb<f32>, random: &mut Random) -> Ray<f32> {
    let place = bounds.lo + bounds.size() * (random.vector() * 0.5 + 0.5);
    random.ray_at(place, 1.0)
}

#[test]
fn normals_point_out_of_the_object() {
    let mut random = Random(2);
    let mut seen = 0;
    objects(&mut random, 1000, |random, all, csg, steps| {
        for _ in 0..20 {
            let r = ray_through(csg.bounds(0), random);
            let per_ray = csg.per_ray(&r);
            let Some(t) = csg.hit(0, &r, &per_ray, 0.0, f32::INFINITY) else { continue };
            let n = csg.normal(0, &r, t).normalize();
            assert!(n.is_finite(), "{steps:?} {r:?}");
            let p = r.at(t).as_dvec3();
            let step = n.as_dvec3() * 1.0e-3;
            let near_edge = steps.iter().filter(|step| match step {
                Step::Part(part) => all.depth(*part, p).abs() < 3.0e-3,
                Step::Join(_) => false,
            });
            if near_edge.count() > 1 || n.dot(r.direction().normalize()).abs() < 0.1 {
                continue;
            }
            let inside = |p: DVec3| holds(steps, |_, part| all.depth(part, p) >= 0.0);
            // Where a solid's own edge is near, its normal may be of the other face.
            if inside(p - step) != inside(p + step) {
                assert!(inside(p - step), "{steps:?} {r:?}");
                seen += 1;
            }
        }
    });
    println!("{seen} normals");
    assert!(seen > 4000);
}
