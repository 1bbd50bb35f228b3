//! Guards promises 1 and 2: every byte comes out of the arena; too little gives an error with the
//! right number of bytes; how much a build takes is known beforehand.

use kibiray::accel::octree::AnyOctree;
use kibiray::accel::{Accel, Any, BuildError, Hit, Huge, Kind, Overlap, grid, mailbox, octree};
use kibiray::memory::{Arena, OutOfArena};
use kibiray::num::Real;
use kibiray::plan::{Plan, Structure, Wishes, plan};
use kibiray::scene::{Scene, Shapes};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Memory, Shot, World, shots};

/// Plans, builds and answers in an arena of so many bytes.
fn answer<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    wishes: &Wishes,
    bytes: &mut [u8],
    shots: &[Shot<R>],
) -> Result<Vec<Option<Hit<R>>>, BuildError> {
    let size = bytes.len();
    let plan = plan(scene, size, wishes)?;
    let mut arena = Arena::new(bytes);
    let shapes = scene.shapes().bounded();
    let mut mailbox = mailbox::AnyMailbox::new(plan.mailbox, shapes, &mut arena)?;
    let accel = Any::build(plan.accel, scene, &mut arena)?;
    assert!(arena.used() <= arena.high_water() && arena.high_water() <= size);
    assert_eq!(arena.parts().iter().map(|part| part.bytes).sum::<usize>(), arena.used());
    let hit =
        |(ray, interval): &Shot<R>| accel.nearest(scene, ray, *interval, &mut mailbox, &mut ());
    Ok(shots.iter().map(hit).collect())
}

fn wishes() -> Vec<Wishes> {
    let structures = [
        None,
        Some(Structure::Naive),
        Some(Structure::Grid),
        Some(Structure::Octree),
        Some(Structure::Bvh),
    ];
    let mailboxes =
        [None, Some(mailbox::Kind::Off), Some(mailbox::Kind::Stamps), Some(mailbox::Kind::Cache)];
    structures
        .into_iter()
        .flat_map(|structure| {
            mailboxes.map(|mailbox| Wishes { structure, mailbox, ..Wishes::default() })
        })
        .chain([Wishes { resolution: Some([9, 8, 7]), ..Wishes::default() }])
        .collect()
}

#[test]
fn any_arena_gives_the_right_answer_or_the_right_number_of_bytes() {
    let mut memory = Memory::new(1 << 20);
    for name in ["spd:tetra:4", "spd:rings:2", "spd:jacks:1"] {
        let tables = Tables::<f32>::new(&load(name).unwrap()).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), 300, 7);
        let naive = Wishes { structure: Some(Structure::Naive), ..Wishes::default() };
        let expected = answer(&scene, &naive, &mut [], &shots).unwrap();
        let (mut right, mut refused) = (0, 0);
        for wishes in wishes() {
            // 0, odd sizes, then ever greater ones.
            for step in 0..200_usize {
                let bytes = step * step * 3 / 2 + step % 7;
                let what = format!("{name} {wishes:?} {bytes} bytes");
                match answer(&scene, &wishes, memory.bytes(bytes), &shots) {
                    Ok(hits) => {
                        right += 1;
                        assert!(hits == expected, "{what}");
                    }
                    Err(BuildError::Memory(OutOfArena { needed, available })) => {
                        refused += 1;
                        assert!(needed > bytes && available == bytes, "{what}: {needed}");
                        let hits = answer(&scene, &wishes, memory.bytes(needed), &shots);
                        assert!(hits.unwrap() == expected, "{what}, then {needed}");
                        let less = answer(&scene, &wishes, memory.bytes(needed - 1), &shots);
                        assert!(less.is_err(), "{what}: less than {needed} is enough");
                    }
                    Err(error) => panic!("{what}: {error}"),
                }
            }
        }
        println!("{name}: {right} right answers, {refused} errors with the right number of bytes");
        assert!(right > 0 && refused > 0);
    }
}

#[test]
fn without_wishes_no_budget_is_too_small() {
    let tables = Tables::<f32>::new(&load("spd:tetra:4").unwrap()).unwrap();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons).unwrap();
    let shots = shots(scene.bounds(), tables.view(), 100, 7);
    let mut memory = Memory::new(4096);
    for bytes in 0..600 {
        assert!(answer(&scene, &Wishes::default(), memory.bytes(bytes), &shots).is_ok(), "{bytes}");
    }
}

#[test]
fn the_footprint_is_the_high_water_mark() {
    let mut memory = Memory::new(1 << 26);
    for name in ["spd:tetra:4", "spd:balls:2", "spd:tree:5", "spd:gears:1", "spd:shells:1"] {
        let tables = Tables::<f32>::new(&load(name).unwrap()).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let stored = |max_objects, max_level, store| {
            let limits = octree::Limits { max_objects, max_level };
            let growth = octree::Growth { huge: Huge::Aside, ..octree::Growth::new(limits) };
            Kind::Octree(octree::Settings { growth, store, ..limits.into() })
        };
        let octree = |objects, level| stored(objects, level, octree::Store::Links);
        let implicit = |objects, level| stored(objects, level, octree::Store::Implicit);
        let hashed = |objects, level| stored(objects, level, octree::Store::Hashed);
        let kinds = [
            Kind::Naive,
            Kind::Grid(grid::Settings::new([1, 1, 1])),
            Kind::Grid(grid::Settings::new([20, 3, 7])),
            Kind::Grid(grid::Settings {
                huge: Huge::Aside,
                macro_cells: true,
                ..grid::Settings::new([40; 3])
            }),
            octree(1, 0),
            octree(1, 1),
            octree(1, 4),
            octree(8, 5),
            octree(100_000, 10),
            Kind::Grid(grid::Settings { overlap: Overlap::Exact, ..grid::Settings::new([15; 3]) }),
            {
                let limits = octree::Limits { max_objects: 3, max_level: 5 };
                let lists = octree::Lists { overlap: Overlap::Exact, shared: false };
                let growth = octree::Growth { lists, ..octree::Growth::new(limits) };
                Kind::Octree(octree::Settings { growth, ..limits.into() })
            },
            Kind::Bvh(0),
            Kind::Bvh(70),
            Kind::Bvh(usize::MAX),
            // More list entries than words of 16 bits number.
            octree(1, 6),
            implicit(1, 1),
            implicit(1, 3),
            implicit(8, 4),
            hashed(1, 4),
            hashed(8, 5),
        ];
        for kind in kinds {
            let footprint = Any::footprint(kind, &scene).unwrap();
            let mut arena = Arena::new(memory.bytes(1 << 26));
            Any::build(kind, &scene, &mut arena).unwrap();
            assert_eq!(arena.high_water(), footprint.peak, "{name} {kind:?}: peak");
            assert_eq!(arena.used(), footprint.kept, "{name} {kind:?}: kept");
            // With exactly that it is divided as far as without limit.
            let mut arena = Arena::new(memory.bytes(footprint.peak));
            let built = Any::build(kind, &scene, &mut arena).unwrap();
            assert_eq!(arena.used(), footprint.kept, "{name} {kind:?}: exact arena");
            let Any::Octree(octree) = built else { continue };
            let stopped_by = octree.stopped_by();
            assert_ne!(stopped_by, octree::StoppedBy::Memory, "{name} {kind:?}");
        }
    }
}

#[test]
fn mailboxes_take_what_they_say() {
    let mut memory = Memory::new(1 << 16);
    for kind in [mailbox::Kind::Off, mailbox::Kind::Stamps, mailbox::Kind::Cache] {
        for shapes in [0, 1, 3, 4, 1000] {
            let mut arena = Arena::new(memory.bytes(1 << 16));
            mailbox::AnyMailbox::new(kind, shapes, &mut arena).unwrap();
            assert_eq!(arena.used(), kind.footprint(shapes).kept);
        }
    }
}

#[test]
fn an_arena_at_any_address_says_exactly_what_it_needs() {
    let mut memory = Memory::new(64);
    for address in 0..8 {
        for capacity in 0..=16 {
            for length in 0..=24 {
                let mut take = |bytes: usize| {
                    let block = &mut memory.bytes(64)[address..address + bytes];
                    let mut arena = Arena::new(block);
                    assert_eq!(arena.capacity(), bytes);
                    let taken = arena.keep::<u8>("part", length).map(|part| part.len());
                    assert!(arena.used() <= bytes && arena.used() + arena.available() == bytes);
                    taken
                };
                let what = format!("{length} bytes in {capacity} from {address}");
                match take(capacity) {
                    Ok(taken) => assert_eq!(taken, length, "{what}"),
                    Err(OutOfArena { needed, available }) => {
                        assert!(needed > capacity && available == capacity, "{what}: {needed}");
                        assert_eq!(take(needed), Ok(length), "{what}, then {needed}");
                        let less = OutOfArena { needed, available: needed - 1 };
                        assert_eq!(take(needed - 1), Err(less), "{what}: less is enough");
                    }
                }
            }
        }
    }
}

/// A plan counts from a multiple of 8. Anywhere else up to 7 bytes are lost, and a build in exactly
/// what the plan asked for either comes to the same answers or says how much is needed there.
#[test]
fn a_plan_holds_in_memory_at_any_address() {
    let tables = Tables::<f32>::new(&load("spd:tetra:4").unwrap()).unwrap();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons).unwrap();
    let shots = shots(scene.bounds(), tables.view(), 100, 7);
    let mut memory = Memory::new(1 << 20);
    let naive = Wishes { structure: Some(Structure::Naive), ..Wishes::default() };
    let expected = answer(&scene, &naive, &mut [], &shots).unwrap();
    let build = |plan: Plan, bytes: &mut [u8]| {
        let mut arena = Arena::new(bytes);
        let shapes = scene.shapes().bounded();
        let mut mailbox = mailbox::AnyMailbox::new(plan.mailbox, shapes, &mut arena)?;
        let accel = Any::build(plan.accel, &scene, &mut arena)?;
        let hit = |(ray, interval): &Shot<f32>| {
            accel.nearest(&scene, ray, *interval, &mut mailbox, &mut ())
        };
        Ok::<_, BuildError>(shots.iter().map(hit).collect::<Vec<_>>())
    };
    let (mut right, mut refused) = (0, 0);
    for wishes in wishes() {
        for budget in (0..=4000).step_by(333).chain([100_000]) {
            let asked = match plan(&scene, budget, &wishes) {
                Ok(_) => budget,
                Err(BuildError::Memory(OutOfArena { needed, .. })) => needed,
                Err(error) => panic!("{wishes:?}: {error}"),
            };
            let plan = plan(&scene, asked, &wishes).unwrap();
            for address in 0..8 {
                let what = format!("{plan:?} in {asked} bytes from {address}");
                let mut at = |bytes| build(plan, &mut memory.bytes(address + bytes)[address..]);
                match at(asked) {
                    Ok(hits) => {
                        right += 1;
                        assert!(hits == expected, "{what}");
                    }
                    Err(BuildError::Memory(OutOfArena { needed, available })) => {
                        refused += 1;
                        assert!(address > 0, "{what}: not even where it should");
                        assert!(available == asked && needed <= asked + 7, "{what}: {needed}");
                        assert!(at(needed).unwrap() == expected, "{what}, then {needed}");
                        assert!(at(needed - 1).is_err(), "{what}: less than {needed} is enough");
                    }
                    Err(error) => panic!("{what}: {error}"),
                }
            }
        }
    }
    println!("{right} right answers, {refused} errors with the right number of bytes");
    assert!(right > 0 && refused > 0);
}

/// In a mesh six triangles meet at most corners, and a cell around a corner lists all six however
/// small it is: an octree that divided such cells would go on to its greatest depth everywhere.
#[test]
fn an_octree_of_a_mesh_stays_in_proportion_to_it() {
    let height = |x: u32, z: u32| {
        let (x, z) = (f64::from(x), f64::from(z));
        [x, (x * 0.7).sin() + (z * 0.9 + x * 0.2).cos(), z]
    };
    let mut world = World::default();
    for x in 0..10 {
        for z in 0..10 {
            let [a, b] = [height(x, z), height(x + 1, z)];
            let [c, d] = [height(x + 1, z + 1), height(x, z + 1)];
            world.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let tables = world.tables::<f32>();
    let scene = tables.scene(&[]);
    assert_eq!(scene.shapes().count(), 200);
    let mut memory = Memory::new(1 << 24);
    for budget in [8 << 10, 64 << 10, 1 << 24] {
        let octree = Wishes { structure: Some(Structure::Octree), ..Wishes::default() };
        let plan = plan(&scene, budget, &octree).unwrap();
        let mut arena = Arena::new(memory.bytes(budget));
        let Any::Octree(AnyOctree::Small(octree, _)) =
            Any::build(plan.accel, &scene, &mut arena).unwrap()
        else {
            panic!("{plan:?}")
        };
        let (leaves, cells) = (octree.leaves().count(), octree.interior_nodes());
        let (kept, level) = (arena.used(), octree.max_level());
        let (peak, stopped) = (arena.high_water(), octree.stopped_by());
        println!(
            "{budget}: {kept} bytes ({peak}), {cells} cells, {leaves} leaves, level {level}, {stopped:?}"
        );
        assert!(leaves <= 16 * scene.shapes().count(), "{leaves} leaves in {budget} bytes");
    }
}
