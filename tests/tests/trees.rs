//! Guards promise 4 for trees of bounds: whatever the bound, the builder and the walk, a hit is bit
//! for bit the one of testing all shapes.

use kibiray::accel::Accel;
use kibiray::accel::mailbox::Off;
use kibiray::accel::tree::{AnyTree, Builder, Insertion, Kind, Settings, Walk};
use kibiray::memory::Arena;
use kibiray::num::{Fixed, Real};
use kibiray::scene::{Scene, Shapes};
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

/// Every tree is asked for one ray in so many: with 36 trees every ray is put to three.
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
