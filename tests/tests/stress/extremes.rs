//! The huge next to the tiny, thousands of shapes that coincide, none, one, and all in one cell.

use super::Report;
use super::tools::{
    BYTES, Court, Random, add, conform, len, nearest, ray, ray_in, structures, sub, times,
    unit_for, v,
};
use kibiray::geom::{Interval, Ray};
use kibiray::num::Vector;
use kibiray::scene::{Scene, Solids, Triangles};
use kibiray::shape::{Sphere, Triangle};
use kibiray_tests::oracle::{Tally, Tested};
use kibiray_tests::{Memory, World};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    vec![
        ("a teapot in a stadium", Some(stadium::<R>(percent * 30, 1e3))),
        ("a floor 30 times the model", Some(stadium::<R>(percent * 30, 30.0))),
        ("thousands that coincide", Some(coincident::<R>(percent))),
        ("no shape, one shape", Some(few::<R>(percent * 10))),
        ("all in one cell", Some(crowded::<R>(percent * 10))),
    ]
}

/// Solids of all kinds within 1 of a place, on a floor and under a dome so many times larger.
fn stadium<R: Tested>(rays: usize, larger: f64) -> Tally {
    let mut random = Random::new(71);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let place = [larger * 0.3, 0.5, larger * -0.2];
    let mut world = World::random(random.rng(), 40, place, 1.0);
    let l = larger;
    world.polygons.push(vec![[-l, 0.0, -l], [l, 0.0, -l], [l, 0.0, l], [-l, 0.0, l]]);
    world.spheres.push(([0.0; 3], 1.5 * larger));
    let unit = unit_for::<R>(1.5 * larger);
    let tables = world.scaled(unit).tables::<R>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let mut court = Court::new(&scene);
    let mut shots = Vec::new();
    for i in 0..rays {
        let at = add(place, times(random.vector(), if i % 4 == 0 { larger * 0.5 } else { 0.6 }));
        let away =
            if i % 2 == 0 { random.within(0.5, 4.0) } else { random.within(0.1, 0.6) * larger };
        let way = random.direction();
        if let Some(ray) = ray_in::<R>(unit, sub(at, times(way, away)), way) {
            court.shoot(&ray, &mut tally);
            shots.push((ray, Interval::RAY));
        }
    }
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}

/// The first of them wins, everywhere.
fn coincident<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(72);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let triangle =
        Triangle { corners: [[0.0, 0.0, 0.0], [1.0, 0.1, 0.2], [0.2, 1.0, -0.1]].map(v::<R>) };
    let table = vec![triangle; 2000];
    let spheres = vec![Sphere::new(v::<R>([0.4, 0.4, -2.0]), len::<R>(0.5)); 2000];
    let triangles = Triangles { triangles: &table, normals: &[] };
    let scene = Scene::new(Solids { spheres: &spheres, triangles, ..Solids::default() }).unwrap();
    let shots: Vec<_> = (0..rays / 2)
        .filter_map(|_| {
            let at = [random.within(-0.1, 0.9), random.within(-0.1, 0.9), 0.0];
            let way = add([0.0, 0.0, -1.0], times(random.vector(), 0.2));
            Some((ray::<R>(sub(at, times(way, 3.0)), way)?, Interval::RAY))
        })
        .collect();
    for (ray, interval) in &shots {
        let hit = nearest(&scene, ray, *interval);
        tally.expect(hit.is_none_or(|hit| hit.id == 0 || hit.id == 2000), || {
            format!("not the first: {hit:?}")
        });
    }
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}

fn any_ray<R: Tested>(random: &mut Random, unit: f64, size: f64) -> Option<(Ray<R>, Interval<R>)> {
    let way = random.direction();
    let at = times(random.vector(), size);
    let away = size * random.decade(-1.0, 3.0);
    Some((ray_in::<R>(unit, sub(at, times(way, away)), way)?, Interval::RAY))
}

fn few<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(73);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    for kind in 0..8 {
        let mut all = World::random(random.rng(), 1, [0.0; 3], 1.0);
        let mut world = World::default();
        match kind {
            0 => {}
            1 => world.spheres.append(&mut all.spheres),
            2 => world.triangles.append(&mut all.triangles),
            3 => world.polygons.append(&mut all.polygons),
            4 => world.boxes.append(&mut all.boxes),
            5 => world.cylinders.append(&mut all.cylinders),
            6 => world.cones.append(&mut all.cones),
            _ => world.planes.push(([0.0, 0.1, 0.0], [0.3, 1.0, 0.2])),
        }
        let tables = world.scaled(R::UNIT).tables::<R>();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons);
        let shots: Vec<_> =
            (0..rays / 8).filter_map(|_| any_ray::<R>(&mut random, R::UNIT, 1.0)).collect();
        let mut court = Court::new(&scene);
        for (ray, interval) in &shots {
            // Without bounds there is no size that errors are in proportion to.
            if kind == 7 && ray.origin().max_abs().to_f64() > 1.0 {
                continue;
            }
            let (hit, _) = court.shoot_within(ray, *interval, &mut tally);
            if kind == 0 && hit.is_some() {
                tally.fail(|| format!("nothing was hit: {ray:?}"));
            }
        }
        conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    }
    tally
}

/// A thousand shapes in a corner, and one far away that makes all cells large.
fn crowded<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(74);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let mut world = World::random(random.rng(), 160, [0.0; 3], 0.01);
    world.spheres.push(([900.0, 900.0, 900.0], 1.0));
    let unit = unit_for::<R>(901.0);
    let tables = world.scaled(unit).tables::<R>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let mut court = Court::new(&scene);
    let shots: Vec<_> = (0..rays).filter_map(|_| any_ray::<R>(&mut random, unit, 0.01)).collect();
    for (ray, interval) in &shots {
        court.shoot_within(ray, *interval, &mut tally);
    }
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}
