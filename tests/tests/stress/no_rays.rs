//! Rays that are not rays, directions of any length, intervals that contain nothing: answered at
//! once, and in bounded steps.

use super::Report;
use super::tools::{BYTES, Court, Random, add, conform, ray, structures, sub, times, v, v_in};
use kibiray::accel::{Accel, Any, mailbox};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::probe::Counters;
use kibiray_tests::oracle::{Tally, Tested};
use kibiray_tests::{Memory, World};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    vec![
        ("not-a-number, infinity, zero", Some(refused::<R>(percent * 500))),
        ("directions of any length", Some(lengths::<R>(percent * 30))),
        ("empty and reversed intervals", Some(intervals::<R>(percent * 30))),
    ]
}

fn refused<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(81);
    let mut tally = Tally::default();
    for i in 0..rays {
        let (mut o, mut d) = (random.vector(), random.direction());
        let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][i % 3];
        let refused = match i % 4 {
            0 => {
                o[i / 4 % 3] = odd;
                true
            }
            1 => {
                d[i / 4 % 3] = odd;
                true
            }
            2 => {
                d = [0; 3].map(|_: i32| 0.0 * random.sign());
                true
            }
            _ => false,
        };
        let made = Ray::<R>::new(v::<R>(o), v::<R>(d)).is_err();
        tally.expect(made == refused, || format!("{o:?} {d:?}: refused {made}"));
    }
    tally
}

fn world(random: &mut Random) -> World {
    let mut world = World::random(random.rng(), 30, [0.5, -0.2, 0.3], 2.0);
    world.planes.push(([0.0, -2.0, 0.0], [0.0, 1.0, 0.0]));
    world
}

fn lengths<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(82);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let world = world(&mut random);
    let tables = world.scaled(R::UNIT).tables::<R>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let mut court = Court::new(&scene);
    let mut shots = Vec::new();
    for _ in 0..rays {
        let way = random.direction();
        let at = add([0.5, -0.2, 0.3], random.vector());
        // What fixed point has numbers for.
        let (least, most) = if R::EXACT { (-6.0, 0.8) } else { (-12.0, 12.0) };
        let d = v_in::<R>(1.0, times(way, random.decade(least, most)));
        let o = v::<R>(sub(at, times(way, random.decade(-1.0, 1.0))));
        let Ok(ray) = Ray::new(o, d) else { continue };
        court.shoot(&ray, &mut tally);
        shots.push((ray, Interval::RAY));
    }
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}

/// Nothing is tested, no cell is looked at where nothing can be found; and however long a ray, it
/// looks at no more cells than there are along all axes, and at no shape twice with a mailbox.
fn intervals<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(83);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let world = world(&mut random);
    let tables = world.scaled(R::UNIT).tables::<R>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let n = |x: f64| R::from_f64(x);
    let nan = n(f64::NAN);
    let mut kinds = structures(&scene);
    kinds.push(kibiray::accel::Kind::Naive);
    for kind in kinds {
        let mut arena = Arena::new(memory.bytes(BYTES));
        let accel = Any::build(kind, &scene, &mut arena).unwrap();
        for i in 0..rays / 6 {
            let way = random.direction();
            let at = add([0.5, -0.2, 0.3], random.vector());
            let d = times(way, if i % 7 == 0 { random.decade(-12.0, 12.0) } else { 1.0 });
            let Some(ray) = ray::<R>(sub(at, times(way, 5.0)), d) else { continue };
            let t = n(random.within(0.0, 8.0));
            let empty = [
                Interval::new(t, t),
                Interval::new(t, n(-1.0)),
                Interval::new(R::INFINITY, R::INFINITY),
                Interval::new(nan, t),
                // Fixed point has no such number: it is made the end of all distances.
                if R::EXACT { Interval::new(nan, nan) } else { Interval::new(n(0.0), nan) },
                Interval::new(t, t.next_up()),
                Interval::new(R::INFINITY, n(0.0)),
            ];
            let mut counters = Counters::default();
            let off = &mut mailbox::Off;
            let found = accel.nearest(&scene, &ray, empty[i % 7], off, &mut counters);
            let any = accel.occluded(&scene, &ray, empty[i % 7], off, &mut counters);
            let work = counters.steps + counters.primitive_tests;
            tally.expect(found.is_none() && !any && work == 0, || {
                format!("{kind:?} {ray:?} {:?}: {found:?} {any} {counters:?}", empty[i % 7])
            });
            let mut counters = Counters::default();
            accel.nearest(&scene, &ray, Interval::RAY, off, &mut counters);
            // Every level of an octree may be gone down for every cell that is passed.
            let bound = 16 * 3 * 256 + 4 * scene_size(&world) as u64;
            tally.expect(counters.steps <= bound, || format!("{kind:?} {ray:?}: {counters:?}"));
        }
    }
    tally
}

fn scene_size(world: &World) -> usize {
    6 * world.spheres.len() + world.planes.len()
}
