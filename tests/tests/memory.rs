//! Guards promises 1 and 2: every byte comes out of the arena; too little gives an error with the
//! right number of bytes; how much a build takes is known beforehand.

use kibiray::accel::{Accel, Any, BuildError, Hit, Kind, mailbox, octree};
use kibiray::memory::{Arena, OutOfArena};
use kibiray::num::Real;
use kibiray::plan::{Structure, Wishes, plan};
use kibiray::scene::{Scene, Shapes};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Memory, Shot, shots};

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
    let structures = [None, Some(Structure::Naive), Some(Structure::Grid), Some(Structure::Octree)];
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
                        assert_eq!(hits, expected, "{what}");
                    }
                    Err(BuildError::Memory(OutOfArena { needed, available })) => {
                        refused += 1;
                        assert!(needed > bytes && available == bytes, "{what}: {needed}");
                        let hits = answer(&scene, &wishes, memory.bytes(needed), &shots);
                        assert_eq!(hits.unwrap(), expected, "{what}, then {needed}");
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
        let octree =
            |max_objects, max_level| Kind::Octree(octree::Limits { max_objects, max_level });
        let kinds = [
            Kind::Naive,
            Kind::Grid([1, 1, 1]),
            Kind::Grid([20, 3, 7]),
            Kind::Grid([40; 3]),
            octree(1, 0),
            octree(1, 1),
            octree(1, 4),
            octree(8, 5),
            octree(100_000, 10),
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
            if let Any::Octree(octree) = built {
                assert_ne!(octree.stopped_by(), octree::StoppedBy::Memory, "{name} {kind:?}");
            }
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
