//! Guards promise 4 where lists are exact (`Overlap::Exact`): a shape is missing from cells that its
//! box touches, so a hit that a kernel claims a little off its surface could be lost. Rays are such
//! that crossings are as ill-defined as can be: in the planes of triangles and polygons, along edges,
//! tangential to everything round, starting on surfaces.

use kibiray::accel::{Any, Kind, Overlap, grid, mailbox::AnyMailbox, octree};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::{Real, Vec3};
use kibiray_tests::{Memory, Shot, UNLIMITED, World, answers, naive_answers};

type Point = [f64; 3];

fn add(a: Point, b: Point, times: f64) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i] * times)
}

fn sub(a: Point, b: Point) -> Point {
    add(a, b, -1.0)
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length.max(1.0e-300))
}

/// Any direction.
fn any(rng: &mut fastrand::Rng) -> Point {
    unit([0; 3].map(|_: i32| rng.f64() - 0.5))
}

/// Triangles from fat to as thin as rounding lets them be, some of them along the axes.
fn thin(rng: &mut fastrand::Rng, count: usize) -> Vec<[Point; 3]> {
    let triangle = |_| {
        let a = [0; 3].map(|_: i32| rng.f64() - 0.5);
        let long = any(rng).map(|x| x * 10_f64.powf(-3.0 * rng.f64()));
        let across = unit(cross(long, any(rng)));
        let height = 10_f64.powf(-7.5 * rng.f64()) * long.iter().fold(0.0, |m, x| x.abs().max(m));
        let b = add(a, long, 1.0);
        let mut corners = [a, b, add(add(a, long, rng.f64()), across, height)];
        if rng.u8(0..4) == 0 {
            let axis = rng.usize(0..3);
            corners.iter_mut().for_each(|corner| corner[axis] = a[axis]);
        }
        corners
    };
    (0..count).map(triangle).collect()
}

/// A point and a direction in which something only just meets the point.
fn grazing(world: &World, rng: &mut fastrand::Rng) -> (Point, Point) {
    let flat = |rng: &mut fastrand::Rng, a: Point, b: Point, c: Point| {
        let (u, v) = (sub(b, a), sub(c, a));
        // Inside, on an edge, or on a corner.
        let (mut s, mut t) = (rng.f64(), rng.f64());
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        match rng.u8(0..6) {
            0 => s = 0.0,
            1 => (s, t) = (0.0, 0.0),
            _ => {}
        }
        let way = match rng.u8(0..4) {
            0 => u,
            1 => v,
            _ => add(u.map(|x| x * (rng.f64() - 0.5)), v, rng.f64() - 0.5),
        };
        (add(add(a, u, s), v, t), way)
    };
    let around = |rng: &mut fastrand::Rng, [base, apex]: [Point; 2], [r, q]: [f64; 2]| {
        let (axis, h) = (unit(sub(apex, base)), rng.f64());
        let out = unit(cross(axis, any(rng)));
        let at = |h: f64| add(add(base, sub(apex, base), h), out, r + (q - r) * h);
        let along = sub(at(1.0), at(0.0));
        let tangent = cross(axis, out);
        let way = match rng.u8(0..3) {
            0 => along,
            1 => tangent,
            _ => add(unit(along), tangent, 2.0 * rng.f64() - 1.0),
        };
        (at(h), way)
    };
    match rng.u8(0..8) {
        0..3 => {
            let [a, b, c] = world.triangles[rng.usize(0..world.triangles.len())];
            flat(rng, a, b, c)
        }
        3 => {
            let polygon = &world.polygons[rng.usize(0..world.polygons.len())];
            flat(rng, polygon[0], polygon[1], polygon[2])
        }
        4 => {
            let (center, r) = world.spheres[rng.usize(0..world.spheres.len())];
            let out = any(rng);
            (add(center, out, r), cross(out, any(rng)))
        }
        5 => {
            let (ends, r, _) = world.cylinders[rng.usize(0..world.cylinders.len())];
            around(rng, ends, [r, r])
        }
        6 => {
            let (ends, radii, _) = world.cones[rng.usize(0..world.cones.len())];
            around(rng, ends, radii)
        }
        _ => {
            let [lo, hi] = world.boxes[rng.usize(0..world.boxes.len())];
            let mut point = [0, 1, 2].map(|a| lo[a] + (hi[a] - lo[a]) * rng.f64());
            let axis = rng.usize(0..3);
            point[axis] = if rng.bool() { lo[axis] } else { hi[axis] };
            let mut way = any(rng);
            way[axis] = 0.0;
            (point, way)
        }
    }
}

/// Rays through such points, off by nothing or by a few units in the last place.
fn shots<R: Real>(world: &World, count: usize, rng: &mut fastrand::Rng) -> Vec<Shot<R>> {
    let mut shots = Vec::with_capacity(count);
    while shots.len() < count {
        let (point, way) = grazing(world, rng);
        let way = unit(way);
        // From the point itself, near it, or from as far away as the scene is wide.
        let before = match rng.u8(0..4) {
            0 => 0.0,
            1 => 1.0e-5 * rng.f64(),
            _ => 3.0 * rng.f64(),
        };
        let size = R::EPSILON.to_f64() * f64::from(1_u32 << rng.u8(0..10));
        let off = if rng.bool() { 0.0 } else { size };
        let moved = |p: Point, rng: &mut fastrand::Rng| p.map(|x| x + off * (rng.f64() - 0.5));
        let (origin, direction) = (moved(add(point, way, -before), rng), moved(way, rng));
        let vector = |p: Point| <Vec3<R> as kibiray::num::Vector<R>>::from_f64(p);
        if let Ok(ray) = Ray::new(vector(origin), vector(direction)) {
            shots.push((ray, Interval::RAY));
        }
    }
    shots
}

fn conform<R: Real>(number: &str, worlds: u64, rays: usize) {
    let mut memory = Memory::new(UNLIMITED);
    let (mut hits, mut all, mut saved) = (0, 0, 0);
    for seed in 0..worlds {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut world = World::random(&mut rng, 4, [0.1, -0.2, 0.3], 1.0);
        world.triangles.extend(thin(&mut rng, 12));
        let shots = shots::<R>(&world, rays, &mut rng);
        let tables = world.tables::<R>();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons);
        let expected = naive_answers(&scene, &shots);
        hits += expected.iter().filter(|(hit, _)| hit.is_some()).count();
        let grid =
            |overlap| Kind::Grid(grid::Settings { overlap, ..grid::Settings::new([23, 29, 31]) });
        let mut octree: octree::Settings = octree::Limits { max_objects: 0, max_level: 6 }.into();
        octree.growth.lists.overlap = Overlap::Exact;
        let mut references = vec![];
        for kind in [grid(Overlap::Box), grid(Overlap::Exact), Kind::Octree(octree)] {
            let mut arena = Arena::new(memory.bytes(UNLIMITED));
            let accel = Any::build(kind, &scene, &mut arena).unwrap();
            match &accel {
                Any::SmallGrid(it) => references.push(it.lists().map(<[u16]>::len).sum::<usize>()),
                Any::Grid(it) => references.push(it.lists().map(<[u16]>::len).sum::<usize>()),
                _ => {}
            }
            let found = answers(&accel, &scene, AnyMailbox::Off, &shots);
            for ((found, expected), shot) in found.iter().zip(&expected).zip(&shots) {
                assert_eq!(found, expected, "{number} {seed} {kind:?} {shot:?}");
            }
        }
        let [boxes, exact] = references[..] else { panic!("{references:?}") };
        assert!(exact < boxes, "{exact} of {boxes}");
        saved += boxes - exact;
        all += shots.len();
    }
    println!("{number}: {all} rays, {hits} hits; {saved} references of grids saved");
    assert!(hits > all / 4);
}

/// Rays a number type; more by `KIBIRAY_RAYS`.
fn rays() -> u64 {
    std::env::var("KIBIRAY_RAYS").ok().and_then(|rays| rays.parse().ok()).unwrap_or(400_000)
}

#[test]
fn grazing_rays_lose_no_hit_in_f32() {
    conform::<f32>("f32", rays() / 20_000, 20_000);
}

#[test]
fn grazing_rays_lose_no_hit_in_f64() {
    conform::<f64>("f64", rays() / 20_000, 20_000);
}

#[test]
fn grazing_rays_lose_no_hit_in_fixed_point() {
    conform::<kibiray::num::Fixed>("fixed", rays() / 20_000, 20_000);
}
