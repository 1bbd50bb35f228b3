//! Spheres from 1 to 10^5 radii away, near their silhouette, and from inside, on and next to them.

use super::Report;
use super::tools::{Court, Random, add, dot, len, plain, ray, rounding, sub, times, v, v_in, wide};
use kibiray::geom::Interval;
use kibiray::scene::{Scene, Solids};
use kibiray::shape::Sphere;
use kibiray_tests::oracle::{Tally, Tested, exact};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    vec![
        ("1 to 1e5 radii, alone", Some(far::<R>(percent * 1500, 0.0, 0))),
        ("1 to 1e5 radii, in a large scene", Some(far::<R>(percent * 1500, 1.0, 0))),
        ("tangents, alone", Some(far::<R>(percent * 1000, 0.0, 1))),
        ("tangents, in a large scene", Some(far::<R>(percent * 1000, 1.0, 1))),
        ("tangents without rounding", Some(whole_tangents::<R>(percent * 100))),
        ("from inside", Some(close::<R>(percent * 500, 0))),
        ("from on the surface", Some(close::<R>(percent * 1000, 1))),
        ("tangential from on the surface", Some(close::<R>(percent * 1000, 2))),
        ("left, of any size", Some(leaving::<R>(percent * 500))),
    ]
}

/// A sphere of any size, and where to look at it from. `large`: in a scene as wide as that is far, so
/// that the ray is taken as it is.
fn far<R: Tested>(rays: usize, large: f64, tangent: u8) -> Tally {
    let mut random = Random::new(11);
    let mut tally = Tally::default();
    for _ in 0..rays / 50 {
        let away = random.decade(0.0, 5.0);
        // In fixed point, where nothing is far away, small ones instead.
        let r = if R::EXACT { (20.0 / away).min(1.0) } else { 1.0 };
        let center = times(random.vector(), 3.0);
        let outside =
            add(center, times(random.direction(), if R::EXACT { 4.0 } else { 3.0 * away }));
        let companion = Sphere::new(v::<R>(outside), len::<R>(0.5));
        let sphere = Sphere::new(v::<R>(center), len::<R>(r));
        let spheres = [sphere, companion];
        let spheres = if large > 0.0 { &spheres[..] } else { &spheres[..1] };
        let scene = Scene::new(Solids { spheres, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        for _ in 0..50 {
            let way = random.direction();
            let across = random.across(way);
            // How far beside the middle it passes.
            let off = if tangent == 0 {
                random.within(0.0, 1.2)
            } else {
                1.0 + random.sign() * random.decade(-12.0, -1.0)
            };
            let from = sub(add(center, times(across, r * off)), times(way, r * away));
            let l = random.decade(-1.0, 1.0);
            if let Some(ray) = ray::<R>(from, times(way, l)) {
                court.shoot(&ray, &mut tally);
            }
        }
    }
    tally
}

/// Along an axis, through numbers of few digits: the exact answer is the only one.
fn whole_tangents<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(12);
    let mut tally = Tally::default();
    for i in 0..rays {
        let small = |random: &mut Random| f64::from(random.rng().i32(-8..=8)) / 4.0;
        let center = [0; 3].map(|_: i32| small(&mut random));
        let radius = f64::from(random.rng().i32(1..=8)) / 4.0;
        let axis = i % 3;
        let mut way = [0.0; 3];
        way[axis] = random.sign();
        let mut from = center;
        from[axis] -= 5.0 * way[axis];
        // Just touching, or a step of 1/64 beside that.
        let beside = f64::from(random.rng().i8(-1..=1)) / 64.0;
        from[(axis + 1) % 3] += random.sign() * (radius + beside);
        let spheres = [Sphere::new(v::<R>(center), len::<R>(radius))];
        let scene = Scene::new(Solids { spheres: &spheres, ..Solids::default() }).unwrap();
        let Some(ray) = ray::<R>(from, way) else { continue };
        let hit = super::tools::nearest(&scene, &ray, Interval::RAY);
        let met = exact::meets_ball(from, way, center, radius);
        tally.hits += u64::from(hit.is_some());
        tally.expect(hit.is_some() == met, || format!("{spheres:?} {ray:?}: {hit:?}, exact {met}"));
    }
    tally
}

/// From inside; from the surface and some units in the last place beside it, into any direction or
/// along the surface.
fn close<R: Tested>(rays: usize, from: u8) -> Tally {
    let mut random = Random::new(13 + u64::from(from));
    let mut tally = Tally::default();
    for _ in 0..rays / 50 {
        let center = times(random.vector(), 3.0);
        let r = random.decade(-2.0, 0.3);
        let spheres = [Sphere::new(v::<R>(center), len::<R>(r))];
        let scene = Scene::new(Solids { spheres: &spheres, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        let (center, r) = (wide::<R>(spheres[0].center), spheres[0].radius.to_f64() / R::UNIT);
        for _ in 0..50 {
            let normal = random.direction();
            let ulps = rounding::<R>(2.0) * 4.0 * random.signed();
            let (at, way) = match from {
                0 => (add(center, times(normal, r * 0.999 * random.within(0.0, 1.0))), {
                    random.direction()
                }),
                1 => (add(center, times(normal, r + ulps)), random.direction()),
                _ => {
                    let along = random.across(normal);
                    let tilt = random.sign() * random.decade(-9.0, -1.0);
                    (add(center, times(normal, r + ulps)), add(along, times(normal, tilt)))
                }
            };
            let Some(ray) = ray::<R>(at, way) else { continue };
            let (hit, _) = court.shoot(&ray, &mut tally);
            if from == 0 && hit.is_none() {
                tally.fail(|| format!("escaped: {spheres:?} {ray:?}"));
            }
        }
    }
    tally
}

/// From a hit outwards: not met again. Inwards: stopped by the other side. Seen from close by, spheres
/// are as large as a planet.
fn leaving<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(17);
    let mut tally = Tally::default();
    for _ in 0..rays / 40 {
        let r = random.decade(-3.0, if R::EXACT { 0.3 } else { 5.0 });
        let normal = random.direction();
        // The place that is seen is about the origin.
        let place = times(random.vector(), r.min(3.0));
        let center = sub(place, times(normal, r));
        let spheres = [Sphere::new(v::<R>(center), len::<R>(r))];
        let scene = Scene::new(Solids { spheres: &spheres, ..Solids::default() }).unwrap();
        let way = random.direction();
        let Some(first) = ray::<R>(sub(place, times(way, r.min(3.0))), way) else { continue };
        let Some(hit) = super::tools::nearest(&scene, &first, Interval::RAY) else { continue };
        let Some(surface) = scene.surface(&first, &hit) else { continue };
        for _ in 0..40 {
            let way = random.direction();
            let next = surface.leave(v_in::<R>(1.0, way)).unwrap();
            let again = super::tools::nearest(&scene, &next, Interval::RAY);
            let cosine = dot(way, plain::<R>(surface.normal));
            let outwards = (cosine >= 0.0) == surface.front;
            if !outwards && cosine.abs() < 0.01 {
                continue;
            }
            tally.hits += u64::from(again.is_some());
            tally.expect(again.is_some() != outwards, || {
                format!("{spheres:?} {first:?} {hit:?} {next:?}: {again:?}")
            });
        }
    }
    tally
}
