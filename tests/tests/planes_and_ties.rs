//! Guards promise 4 where it is hardest: planes, which are in no structure; shapes that coincide, of
//! which the first has to win; shapes whose faces lie in the walls of cells.

use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes};
use kibiray_tests::{
    Compared, Memory, Shot, UNLIMITED, World, compare, naive_answers, shots, view_of,
};

const MIDDLE: [f64; 3] = [0.25, -0.5, 0.125];

/// A ground, a wall behind everything, and two planes aslant through the middle of the unit cube.
fn planes() -> Vec<([f64; 3], [f64; 3])> {
    vec![
        ([0.0, -0.75, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, -3.0], [0.0, 0.0, -2.0]),
        (MIDDLE, [1.0, 2.0, -0.5]),
        (MIDDLE, [-3.0, 0.3, 0.7]),
    ]
}

/// The first hit by the least parameter, then the least id: a loop over the set itself.
fn first<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    (ray, interval): &Shot<R>,
) -> Option<(u64, usize)> {
    let shapes = scene.shapes();
    let per_ray = shapes.per_ray(ray);
    let mut best = None;
    for id in 0..shapes.count() {
        // A shape's interval is closed above, a query's is open.
        let hit = shapes.hit(id, ray, &per_ray, interval.min, interval.max.next_down());
        if let Some(t) = hit
            && best.is_none_or(|(least, _)| t < least)
        {
            best = Some((t, id));
        }
    }
    best.map(|(t, id)| (t.to_f64().to_bits(), id))
}

/// Rays that every query leaves as they are: they start on the cube around 0 through the scene's
/// greatest coordinate, so that they have the slack of the scene, and directions are of ordinary
/// length. What the set says of them is what a query has to say, bit for bit.
fn plain_shots<R: Real>(bounds: Aabb<R>, count: usize, rng: &mut fastrand::Rng) -> Vec<Shot<R>> {
    let scale = bounds.max_abs().to_f64();
    let (lo, size) = (bounds.lo.to_array(), bounds.size().to_array());
    let mut shots = Vec::new();
    while shots.len() < count {
        let mut from = [0; 3].map(|_: i32| scale * (rng.f64() * 2.0 - 1.0));
        from[rng.usize(0..3)] = if rng.bool() { scale } else { -scale };
        let sixteenths = rng.bool();
        let to = [0, 1, 2].map(|a| {
            let at = if sixteenths { f64::from(rng.u8(0..=16)) / 16.0 } else { rng.f64() };
            lo[a].to_f64() + size[a].to_f64() * at
        });
        let mut way = [0, 1, 2].map(|a| (to[a] - from[a]) / scale);
        if rng.u8(0..4) == 0 {
            // Along an axis, back from the face.
            way = from.map(|x| if x.abs() == scale { -x / scale } else { 0.0 });
        }
        let interval = if rng.u8(0..4) == 0 {
            let (min, length) = (scale * rng.f64(), scale * rng.f64());
            Interval::new(R::from_f64(min), R::from_f64(min + length))
        } else {
            Interval::RAY
        };
        if let Ok(ray) = Ray::new(Vec3::<R>::from_f64(from), Vec3::<R>::from_f64(way)) {
            shots.push((ray, interval));
        }
    }
    shots
}

/// Every structure against testing all, and testing all against the loop over the set.
fn check<R: Real>(what: &str, world: &World, extra: &[Shot<R>], memory: &mut Memory) -> Compared {
    let tables = world.tables::<R>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let mut rng = fastrand::Rng::with_seed(11);
    // Without solids there are no bounds; then around the planes.
    let bounds = if scene.shapes().bounded() > 0 {
        scene.bounds()
    } else {
        Aabb::around([Vec3::<R>::splat(-R::ONE), Vec3::<R>::splat(R::ONE)])
    };
    let plain = plain_shots(bounds, 1000, &mut rng);
    for (shot, (found, _)) in plain.iter().zip(naive_answers(&scene, &plain)) {
        assert_eq!(found, first(&scene, shot), "{what}: against a loop over the set, {shot:?}");
    }
    let mut all = shots(bounds, &view_of(bounds), 1000, 12);
    all.extend(plain);
    all.extend_from_slice(extra);
    compare(what, &scene, &all, memory)
}

fn both(what: &str, world: &World, memory: &mut Memory) -> Compared {
    let mut all = check::<f32>(&format!("f32 {what}"), world, &[], memory);
    all += check::<f64>(&format!("f64 {what}"), world, &[], memory);
    println!("{what}: {all:?}");
    all
}

#[test]
fn planes_belong_to_every_answer() {
    let mut memory = Memory::new(UNLIMITED);
    let mut rng = fastrand::Rng::with_seed(1);
    for count in 0..=4 {
        for each in [0, 1, 8] {
            let mut world = World::random(&mut rng, each, MIDDLE, 1.0);
            world.planes = planes().into_iter().take(count).collect();
            let compared = both(&format!("{count} planes, {each} of each"), &world, &mut memory);
            assert_eq!(compared.hits > 0, count + each > 0);
        }
    }
}

/// All orders in which a query may come upon its first blocker.
#[test]
fn any_one_of_several_planes_blocks() {
    let plane = |z: f64| ([0.0, 0.0, z], [0.0, 0.0, 1.0]);
    for zs in [[1.0, 9.0], [9.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, 2.0]] {
        let world = World { planes: zs.map(plane).to_vec(), ..World::default() };
        let tables = world.tables::<f32>();
        let scene = tables.scene(&[]);
        let along = |z| Vec3::<f32>::from_array([0.0, 0.0, z]);
        let ray = Ray::new(along(0.0), along(1.0)).unwrap();
        let (hit, any) = naive_answers(&scene, &[(ray, Interval::new(0.0, 5.0))])[0];
        let least = zs.iter().position(|z| *z == 1.0);
        assert_eq!(hit, least.map(|id| (1.0_f64.to_bits(), id)), "{zs:?}");
        assert!(any, "{zs:?}");
    }
}

#[test]
fn of_shapes_that_coincide_the_first_wins() {
    let mut memory = Memory::new(UNLIMITED);
    let mut rng = fastrand::Rng::with_seed(2);
    for (each, times) in [(1, 2), (2, 5), (6, 3), (1, 20)] {
        let mut world = World::random(&mut rng, each, MIDDLE, 1.0);
        world.planes = planes();
        let world = world.repeated(times, &mut rng);
        let compared = both(&format!("{each} of each, {times} times"), &world, &mut memory);
        assert!(compared.hits > compared.rays / 4);
    }
}

/// Coordinates of walls in a scene from -512 to 512 along every axis. An octree adds 2^-10 of the
/// extent at either end: its root is from -513 to 513, 1026 wide. A grid adds 33/2^15 and 31/2^15:
/// also 1026 wide, from -513.03125. All of these are numbers of both types.
fn wall(rng: &mut fastrand::Rng) -> f64 {
    if rng.bool() {
        let level = rng.u32(1..=5);
        -513.0 + 1026.0 / f64::from(1 << level) * f64::from(rng.u32(1..1 << level))
    } else {
        -513.03125 + 1026.0 / 16.0 * f64::from(rng.u32(1..16))
    }
}

fn walls(rng: &mut fastrand::Rng) -> World {
    let mut world = World::default();
    world.boxes.push([[-512.0; 3], [-510.0; 3]]);
    world.boxes.push([[510.0; 3], [512.0; 3]]);
    for i in 0..24 {
        let axis = i % 3;
        let [a, b] = [0, 1].map(|_| [0; 3].map(|_: i32| wall(rng)));
        let lo = [0, 1, 2].map(|i| a[i].min(b[i]));
        let mut hi = [0, 1, 2].map(|i| a[i].max(b[i]) + if a[i] == b[i] { 3.25 } else { 0.0 });
        world.boxes.push([lo, hi]);
        // A rectangle in the wall, as box, polygon and triangles, seen from either side.
        hi[axis] = lo[axis];
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        world.boxes.push([lo, hi]);
        let corner = |at_u: f64, at_v: f64| {
            let mut c = lo;
            (c[u], c[v]) = (at_u, at_v);
            c
        };
        let corners = [(lo[u], lo[v]), (hi[u], lo[v]), (hi[u], hi[v]), (lo[u], hi[v])]
            .map(|(a, b)| corner(a, b));
        let [p, q, r, s] = corners;
        world.polygons.push(if i % 2 == 0 { vec![p, q, r, s] } else { vec![s, r, q, p] });
        world.triangles.extend([[p, q, r], [r, s, p]]);
        // Touching the wall from either side.
        let radius = 16.0;
        let mut center = [0; 3].map(|_: i32| 400.0 * (rng.f64() - 0.5));
        center[axis] = wall(rng).clamp(-400.0, 400.0) + if rng.bool() { radius } else { -radius };
        world.spheres.push((center, radius));
        // From wall to wall.
        let (mut base, mut apex) = (center, center);
        (base[axis], apex[axis]) = (lo[axis], lo[axis] + 64.125);
        world.cylinders.push(([base, apex], radius, i % 2 == 0));
        world.cones.push(([apex, base], [radius, 0.0], i % 2 == 1));
    }
    for axis in 0..3 {
        let (mut point, mut normal) = ([0.0; 3], [0.0; 3]);
        (point[axis], normal[axis]) = (wall(rng), 1.0);
        world.planes.push((point, normal));
    }
    world
}

/// From wall to wall, within walls, along their edges and through their corners.
fn wall_shots<R: Real>(count: usize, rng: &mut fastrand::Rng) -> Vec<Shot<R>> {
    let mut shots = Vec::new();
    while shots.len() < count {
        let from = [0; 3].map(|_: i32| wall(rng));
        let way = match rng.u8(0..3) {
            0 => [0; 3].map(|_: i32| f64::from(rng.i8(-1..=1))),
            1 => {
                let to = [0; 3].map(|_: i32| wall(rng));
                [0, 1, 2].map(|a| to[a] - from[a])
            }
            _ => {
                // Within a wall.
                let mut way = [0; 3].map(|_: i32| rng.f64() - 0.5);
                way[rng.usize(0..3)] = 0.0;
                way
            }
        };
        if let Ok(ray) = Ray::new(Vec3::<R>::from_f64(from), Vec3::<R>::from_f64(way)) {
            shots.push((ray, Interval::RAY));
        }
    }
    shots
}

fn in_walls<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    for seed in 3..6 {
        let mut rng = fastrand::Rng::with_seed(seed);
        let world = walls(&mut rng);
        let tables = world.tables::<R>();
        let bounds = tables.scene(&[]).bounds();
        let cube = [-512.0, 512.0].map(|x| Vec3::<R>::splat(R::from_f64(x)));
        assert_eq!(bounds, Aabb { lo: cube[0], hi: cube[1] }, "the walls are elsewhere");
        let extra = wall_shots::<R>(1500, &mut rng);
        let what = format!("{number} walls {seed}");
        let compared = check::<R>(&what, &world, &extra, &mut memory);
        println!("{what}: {compared:?}");
        assert!(compared.hits > compared.rays / 4);
    }
}

#[test]
fn shapes_in_walls_of_cells_are_met_in_f32() {
    in_walls::<f32>("f32");
}

#[test]
fn shapes_in_walls_of_cells_are_met_in_f64() {
    in_walls::<f64>("f64");
}
