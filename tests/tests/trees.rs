//! Guards promise 4 for trees of bounds: whatever the bound, the builder and the walk, a hit is bit
//! for bit the one of testing all shapes.

use kibiray::accel::Accel;
use kibiray::accel::mailbox::Off;
use kibiray::accel::tree::{
    AnyTree, Builder, InsertError, Insertion, Kind, Settings, Tree, Walk, footprint,
};
use kibiray::geom::Aabb;
use kibiray::memory::Arena;
use kibiray::num::{Fixed, Real, Vec3, Vector};
use kibiray::probe::Counters;
use kibiray::scene::{Scene, Shapes};
use kibiray::shape::{Sphere, Triangle};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{
    Answer, Memory, SMALL_SCENES, Shot, UNLIMITED, World, naive_answers, shots, view_of,
};

/// Every builder, each with another walk and another order.
fn settings() -> Vec<Settings> {
    let gs = Builder::GoldsmithSalmon;
    [
        (gs(Insertion::File), Walk::Heap),
        (gs(Insertion::Shuffled(3)), Walk::Ordered),
        (gs(Insertion::Curve), Walk::Stored),
        (Builder::RTree(Insertion::Shuffled(0)), Walk::Ordered),
        (Builder::RTree(Insertion::File), Walk::Heap),
        (Builder::Sah, Walk::Ordered),
        (Builder::List, Walk::Ordered),
    ]
    .map(|(builder, walk)| Settings { builder, walk })
    .into()
}

/// What a structure answers to some rays.
fn answers<R: Real, S: Shapes<R>>(
    accel: &impl Accel<R>,
    scene: &Scene<'_, R, S>,
    shots: &[Shot<R>],
) -> Vec<Answer> {
    let answer = |(ray, interval): &Shot<R>| {
        let hit = accel.nearest(scene, ray, *interval, &mut Off, &mut ());
        let any = accel.occluded(scene, ray, *interval, &mut Off, &mut ());
        (hit.map(|hit| (hit.t.to_f64().to_bits(), hit.id)), any)
    };
    shots.iter().map(answer).collect()
}

/// Every tree is asked for one ray in so many: with 42 trees every ray is put to three or four.
const EACH: usize = 12;

/// Compares all trees with testing all shapes; gives the number of hits.
fn compare<R: Real, S: Shapes<R>>(
    what: &str,
    scene: &Scene<'_, R, S>,
    shots: &[Shot<R>],
    memory: &mut Memory,
) -> usize {
    let expected = naive_answers(scene, shots);
    let settings = settings();
    let all = Kind::ALL.iter().flat_map(|kind| settings.iter().map(|settings| (*kind, *settings)));
    for (number, (kind, settings)) in all.enumerate() {
        let footprint = AnyTree::<R>::footprint(kind, scene.shapes().bounded(), settings);
        let mut arena = Arena::new(memory.bytes(footprint.peak));
        let tree = AnyTree::build(kind, scene, settings, &mut arena).unwrap();
        assert_eq!(arena.high_water(), footprint.peak, "{what} {kind:?} {settings:?}");
        assert_eq!(arena.used(), footprint.kept, "{what} {kind:?} {settings:?}");
        // Every tree sees another part of the rays, of all sorts.
        let part = |all: usize| (number % EACH..all).step_by(EACH);
        let own: Vec<_> = part(shots.len()).map(|i| shots[i]).collect();
        let found = answers(&tree, scene, &own);
        for (found, i) in found.iter().zip(part(shots.len())) {
            let shot = &shots[i];
            assert_eq!(*found, expected[i], "{what} {kind:?} {settings:?}, ray {i}: {shot:?}");
        }
    }
    expected.iter().filter(|(hit, _)| hit.is_some()).count()
}

fn conform<R: Real>(number: &str, rays_per_scene: usize) {
    let mut memory = Memory::new(UNLIMITED);
    let (mut rays, mut hits) = (0, 0);
    for name in SMALL_SCENES {
        let description = load(name).unwrap();
        let moved = Frame::of::<R>(&description).apply(&description).into_owned();
        let tables = Tables::<R>::new(&moved).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), rays_per_scene, 1986);
        hits += compare(&format!("{number} {name}"), &scene, &shots, &mut memory);
        rays += shots.len();
    }
    // Ties, overlapping shapes of all kinds, and scenes of 0, 1 and 2 shapes a kind.
    let mut rng = fastrand::Rng::with_seed(7);
    for each in [0, 1, 2, 30] {
        let world = World::random(&mut rng, each, [0.3, -0.2, 0.1], 0.5).repeated(2, &mut rng);
        let tables = world.tables::<R>();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons);
        let shots = shots(scene.bounds(), &view_of(scene.bounds()), rays_per_scene, 5);
        hits += compare(&format!("{number} {each} of each"), &scene, &shots, &mut memory);
        rays += shots.len();
    }
    println!("{number}: {rays} rays, {hits} hits");
    assert!(hits > rays / 10);
}

/// Rays a scene: as many as there is time for, or what `KIBIRAY_RAYS` says.
fn rays_per_scene() -> usize {
    std::env::var("KIBIRAY_RAYS").ok().and_then(|n| n.parse().ok()).unwrap_or(35_000)
}

#[test]
fn trees_give_the_hits_of_testing_all_in_f32() {
    conform::<f32>("f32", rays_per_scene());
}

#[test]
fn trees_give_the_hits_of_testing_all_in_f64() {
    conform::<f64>("f64", rays_per_scene());
}

#[test]
fn trees_give_the_hits_of_testing_all_in_fixed_point() {
    conform::<Fixed>("fixed", rays_per_scene());
}

#[test]
fn trees_are_refitted_when_shapes_move() {
    let mut rng = fastrand::Rng::with_seed(11);
    let mut memory = Memory::new(UNLIMITED);
    let worlds: Vec<_> =
        (0..4).map(|_| World::random(&mut rng, 20, [0.1, 0.0, -0.2], 0.6)).collect();
    for kind in Kind::ALL {
        for settings in settings() {
            let mut arena = Arena::new(memory.bytes(UNLIMITED));
            let tables = worlds[0].tables::<f32>();
            let polygons = tables.polygons();
            let scene = tables.scene(&polygons);
            let mut tree = AnyTree::build(kind, &scene, settings, &mut arena).unwrap();
            let fresh = tree.summary();
            for (i, world) in worlds.iter().enumerate().rev() {
                let tables = world.tables::<f32>();
                let polygons = tables.polygons();
                let scene = tables.scene(&polygons);
                assert_eq!(scene.shapes().bounded(), 120);
                tree.refit(&scene);
                let shots = shots(scene.bounds(), &view_of(scene.bounds()), 2000, i as u64);
                let expected = naive_answers(&scene, &shots);
                assert_eq!(answers(&tree, &scene, &shots), expected, "{kind:?} {settings:?}");
                if i > 0 && kind == Kind::Box && settings.builder == Builder::Sah {
                    // The links are those of other places.
                    assert!(tree.summary().cost.bounds > fresh.cost.bounds);
                }
            }
            // Back where they were, boxes are as they were.
            if kind == Kind::Box {
                assert_eq!(tree.summary(), fresh, "{settings:?}");
            }
        }
    }
}

#[test]
fn shapes_are_inserted_while_rays_are_shot() {
    let mut rng = fastrand::Rng::with_seed(12);
    // The first one is around all others: every scene of the first few has the same bounds.
    let mut place = || Vec3::<f32>::from_array([0, 1, 2].map(|_| rng.f32() - 0.5));
    let mut spheres = vec![Sphere::<f32>::new(Vec3::<f32>::default(), 2.0)];
    spheres.extend((1..60).map(|i| Sphere::new(place(), 0.01 * (i % 9 + 1) as f32)));
    let scene = Scene::new(&spheres[..]).unwrap();
    let bytes = footprint::<f32, Aabb<f32>, u16>(40, Builder::default()).peak;
    let mut memory = Memory::new(bytes);
    let mut arena = Arena::new(memory.bytes(bytes));
    let mut tree = Tree::<f32, Aabb<f32>, u16>::empty(40, Walk::Ordered, &mut arena).unwrap();
    let shots = shots(scene.bounds(), &view_of(scene.bounds()), 2000, 3);
    for id in 0..60 {
        let inserted = tree.insert(&scene, id);
        if id >= 40 {
            assert_eq!(inserted, Err(InsertError::Full { id, capacity: 40 }));
            continue;
        }
        assert_eq!(inserted, Ok(()));
        assert_eq!(tree.insert(&scene, id), Err(InsertError::Present { id }));
        assert_eq!(tree.shapes(), id + 1);
        let so_far = Scene::new(&spheres[..=id]).unwrap();
        assert_eq!(answers(&tree, &scene, &shots), naive_answers(&so_far, &shots), "{id}");
    }
    let none = tree.insert(&scene, 60);
    assert_eq!(none, Err(InsertError::NoShape { id: 60, shapes: 60 }));
}

#[test]
fn bounds_that_do_not_pay_can_be_left_out() {
    let mut rng = fastrand::Rng::with_seed(13);
    let mut memory = Memory::new(UNLIMITED);
    let world = World::random(&mut rng, 30, [0.2, 0.0, 0.1], 0.5);
    let tables = world.tables::<f32>();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons);
    let shots = shots(scene.bounds(), &view_of(scene.bounds()), 3000, 9);
    let expected = naive_answers(&scene, &shots);
    for kind in Kind::ALL {
        for settings in settings() {
            let mut arena = Arena::new(memory.bytes(UNLIMITED));
            let mut tree = AnyTree::build(kind, &scene, settings, &mut arena).unwrap();
            let paying = tree.keep_paying(|id, p| p > 0.0 && id % 3 == 0);
            assert_eq!(paying, 60, "{kind:?} {settings:?}");
            assert_eq!(answers(&tree, &scene, &shots), expected, "{kind:?} {settings:?}");
        }
    }
}

/// Wires with three sides, each of two needles, every which way.
fn wires<R: Real>(count: usize) -> Vec<Triangle<R>> {
    let mut rng = fastrand::Rng::with_seed(14);
    let mut mesh = Vec::new();
    for _ in 0..count {
        let mut vector = |size: f64| {
            glam::DVec3::from_array(std::array::from_fn(|_| size * (2.0 * rng.f64() - 1.0)))
        };
        let (from, along, side) = (vector(0.25), vector(0.2), vector(1.0));
        let u = along.cross(side).normalize() * 0.001;
        let v = along.cross(u).normalize() * 0.001;
        let corners = [u, v, -u - v].map(|corner| from + corner);
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            for corners in [[a, b, a + along], [b, b + along, a + along]] {
                let [a, b, c] = corners.map(|corner| Vec3::<R>::from_f64(corner.to_array()));
                mesh.push(Triangle::new(a, b, c));
            }
        }
    }
    mesh
}

fn tests_of_wires<R: Real>(number: &str) {
    let mesh = wires::<R>(150);
    let scene = Scene::new(&mesh[..]).unwrap();
    let shots = shots(scene.bounds(), &view_of(scene.bounds()), 10_000, 21);
    let expected = naive_answers(&scene, &shots);
    let mut memory = Memory::new(UNLIMITED);
    for builder in [Builder::default(), Builder::RTree(Insertion::Curve), Builder::Sah] {
        let mut counts = Kind::ALL.map(|kind| {
            let settings = Settings { builder, walk: Walk::Ordered };
            let mut arena = Arena::new(memory.bytes(UNLIMITED));
            let mut tree = AnyTree::build(kind, &scene, settings, &mut arena).unwrap();
            let count = |tree: &AnyTree<'_, R>| {
                let mut counters = Counters::default();
                for (ray, interval) in &shots {
                    tree.nearest(&scene, ray, *interval, &mut Off, &mut counters);
                }
                assert_eq!(answers(tree, &scene, &shots), expected, "{number} {kind:?}");
                [counters.steps, counters.primitive_tests]
            };
            let built = count(&tree);
            tree.refit(&scene);
            let refitted = count(&tree);
            // Only spheres come out otherwise when they are put together in another order.
            assert!(
                kind == Kind::Sphere || refitted[1] <= built[1],
                "{number} {builder:?} {kind:?}"
            );
            built
        });
        let each = |tests: u64| tests as f64 / shots.len() as f64;
        for (kind, [bounds, shapes]) in Kind::ALL.into_iter().zip(&mut counts) {
            let (bounds, shapes) = (each(*bounds), each(*shapes));
            let what = format!("{number} {builder:?} {kind:?}");
            println!("{what:<50}{bounds:>6.1} tests of bounds, {shapes:>5.2} of shapes a ray");
        }
        let [boxes, _, oriented, ..] = counts;
        assert!(oriented[0] < boxes[0] && oriented[1] * 20 < boxes[1], "{number} {builder:?}");
    }
}

/// What is thin and tilted fills little of its box along the axes, and nearly all of one that lies as
/// it does.
#[test]
fn oriented_boxes_fit_wires() {
    tests_of_wires::<f32>("f32");
    tests_of_wires::<f64>("f64");
    tests_of_wires::<Fixed>("fixed");
}
