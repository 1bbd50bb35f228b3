//! Rays that leave a surface: every SPD scene at the scales 10^-6, 1 and 10^6. No acne: what leaves
//! a surface starts on the side that it leaves to, and does not meet the surface again where the
//! surface is not curved towards it. No leak: what goes through starts behind it.

use super::Report;
use super::tools::{Court, Random, add, dot, length, plain, sub, times, v_in};
use kibiray::accel::{Accel, Any, Kind, mailbox};
use kibiray::geom::Interval;
use kibiray::memory::Arena;
use kibiray::num::Vector;
use kibiray::scene::{Camera, Scene, Shapes};
use kibiray::trace::{Settings, Tracer};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::description::{Description, Solid};
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::oracle::{Outcome, Tally, Tested};
use kibiray_tests::{Memory, SMALL_SCENES};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    vec![
        ("scenes at 1e-6", Some(scenes::<R>(percent, 1e-6))),
        ("scenes at 1", Some(scenes::<R>(percent, 1.0))),
        ("scenes at 1e6", Some(scenes::<R>(percent, 1e6))),
        ("pictures at 2^-20, 1 and 2^20", Some(pictures::<R>())),
    ]
}

/// A scene `by` times as large.
pub(super) fn scaled(mut description: Description, by: f64) -> Description {
    let scale = |p: &mut [f64; 3]| *p = p.map(|x| x * by);
    for item in &mut description.items {
        match &mut item.solid {
            Solid::Sphere { center, radius } => {
                scale(center);
                *radius *= by;
            }
            Solid::Cone { base, base_radius, apex, apex_radius, .. } => {
                scale(base);
                scale(apex);
                *base_radius *= by;
                *apex_radius *= by;
            }
            Solid::Polygon { vertices, .. } | Solid::Fan { vertices, .. } => {
                vertices.iter_mut().for_each(scale);
            }
            Solid::Box { lo, hi } => {
                scale(lo);
                scale(hi);
            }
            Solid::Plane { point, .. } => scale(point),
            Solid::Csg { .. } => panic!("no combined solids in these scenes"),
        }
    }
    description.lights.iter_mut().for_each(|light| scale(&mut light.position));
    if let Some(view) = &mut description.view {
        scale(&mut view.from);
        scale(&mut view.at);
    }
    description
}

const BYTES: usize = 1 << 20;

fn scenes<R: Tested>(percent: usize, scale: f64) -> Tally {
    let mut tally = Tally::default();
    for name in SMALL_SCENES {
        tally += scene::<R>(name, percent * 8, scale);
    }
    tally
}

fn scene<R: Tested>(name: &str, paths: usize, scale: f64) -> Tally {
    let mut tally = Tally::default();
    let mut random = Random::new(91);
    let description = scaled(load(name).unwrap(), scale);
    // In fixed point the scene is normalised, whatever its scale.
    let description = Frame::of::<R>(&description).apply(&description).into_owned();
    let tables = Tables::<R>::new(&description).unwrap();
    let polygons = tables.polygons();
    let solids = tables.solids(&polygons);
    let scene = Scene::new(solids).unwrap();
    let mut court = Court::new(&scene);
    let mut memory = Memory::new(BYTES);
    let mut arena = Arena::new(memory.bytes(BYTES));
    let accel = Any::build(Kind::Bvh(scene.shapes().bounded()), &scene, &mut arena).unwrap();
    let off = &mut mailbox::Off;
    let camera = Camera::new(tables.view(), R::ONE).unwrap();
    let shapes = scene.shapes();
    let flat_from = shapes.spheres.len();
    let flat_to = flat_from + shapes.triangles.triangles.len() + shapes.polygons.len();
    for _ in 0..paths {
        let [x, y] = [0, 1].map(|_: i32| R::from_f64(random.signed()));
        let Some(mut ray) = camera.ray(x, y) else { continue };
        // A path of up to three mirrored rays.
        for _ in 0..3 {
            let Some(hit) = accel.nearest(&scene, &ray, Interval::RAY, off, &mut ()) else { break };
            let outcome = court.judge.judge(&ray, Interval::RAY, Some((hit.t, hit.id)), &mut tally);
            if matches!(outcome, Outcome::Wrong(_)) {
                break;
            }
            let Some(surface) = scene.surface(&ray, &hit) else { break };
            let normal = plain::<R>(surface.normal);
            let near = surface.point + surface.normal * surface.error;
            let behind = surface.point - surface.normal * surface.error;
            let is_flat = (flat_from..flat_to).contains(&hit.id);
            // Heights are above the surface as its normal is.
            let side = if is_flat {
                court.judge.height::<R>(hit.id, ray.origin()).unwrap_or(0.0).signum()
            } else if surface.front {
                1.0
            } else {
                -1.0
            };
            let [above, below] =
                [near, behind].map(|p| court.judge.height::<R>(hit.id, p).unwrap_or(0.0) * side);
            // Hardly any normal at all where a surface is seen along itself or at a tip.
            tally.expect(above > 0.0, || {
                format!("{name} acne: {ray:?} {hit:?} {surface:?} starts {above:e} above")
            });
            tally.expect(below < 0.0, || {
                format!("{name} leak: {ray:?} {hit:?} {surface:?} starts {below:e} below")
            });
            // To the lights, mirrored, and anywhere.
            let d = plain::<R>(ray.direction());
            let mirrored = sub(d, times(normal, 2.0 * dot(d, normal)));
            let mut ways = vec![mirrored];
            for light in &description.lights {
                ways.push(sub(light.position, plain::<R>(near)));
            }
            for _ in 0..2 {
                ways.push(add(random.direction(), times(normal, 1.0)));
            }
            for way in ways {
                let cosine = dot(way, normal) / length(way);
                if !(cosine > 1e-3) {
                    continue;
                }
                let way = v_in::<R>(1.0, times(way, 1.0 / length(way)));
                let Ok(next) = surface.leave(way) else { continue };
                let again = accel.nearest(&scene, &next, Interval::RAY, off, &mut ());
                let answer = again.map(|hit| (hit.t, hit.id));
                court.judge.judge(&next, Interval::RAY, answer, &mut tally);
                let Some(again) = again.filter(|again| again.id == hit.id) else { continue };
                // A hollow surface may be met again, at a distance.
                let away = again.t.to_f64() * length(plain::<R>(next.direction()));
                let hollow = !is_flat && !surface.front;
                if !hollow || (cosine > 0.1 && away < 64.0 * surface.error.to_f64()) {
                    tally.fail(|| format!("{name} acne: {ray:?} {hit:?} {next:?} {again:?}"));
                }
            }
            let Ok(next) = surface.leave(v_in::<R>(1.0, mirrored)) else { break };
            ray = next;
        }
    }
    tally
}

/// Multiplying everything by a power of two changes no digit, so it must not change a picture.
fn pictures<R: Tested>() -> Tally {
    let mut tally = Tally::default();
    for name in SMALL_SCENES {
        let colors = |scale: f64| {
            let description = scaled(load(name).unwrap(), scale);
            let description = Frame::of::<R>(&description).apply(&description).into_owned();
            let tables = Tables::<R>::new(&description).unwrap();
            let polygons = tables.polygons();
            let scene = tables.scene(&polygons).unwrap();
            let mut memory = Memory::new(BYTES);
            let mut arena = Arena::new(memory.bytes(BYTES));
            let kind = Kind::Bvh(scene.shapes().bounded());
            let accel = Any::build(kind, &scene, &mut arena).unwrap();
            let camera = Camera::new(tables.view(), R::ONE).unwrap();
            let mut tracer = Tracer::new(&scene, &accel, mailbox::Off, Settings::default());
            let across = |i: i32| R::from_i32(2 * i - 31) / R::from_i32(32);
            let mut see = |i: i32| {
                let ray = camera.ray(across(i % 32), across(i / 32));
                ray.map(|ray| tracer.color(ray, &mut ()).to_array())
            };
            (0..32 * 32).map(&mut see).collect::<Vec<_>>()
        };
        let [small, middle, large] = [-20, 0, 20].map(|e| colors(2.0_f64.powi(e)));
        for ((small, middle), large) in small.iter().zip(&middle).zip(&large) {
            tally.expect(small == middle && middle == large, || {
                format!("{name}: {small:?} {middle:?} {large:?}")
            });
        }
    }
    tally
}
