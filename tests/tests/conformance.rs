//! Guards promise 4: the same answer with every structure. A hit from a grid or an octree, of any
//! resolution, with any mailbox, grown into any budget, is bit for bit the one of testing all.

use kibiray::accel::{Accel, Any, BuildError, Hit, Kind, grid, mailbox, octree};
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Scene, Shapes};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Memory, SMALL_SCENES, Shot, shots};

const RAYS_PER_SCENE: usize = 50_000;
const UNLIMITED: usize = 1 << 28;

/// A ray's answers: nearest hit in bits, and whether there is any.
type Answer = (Option<(u64, usize)>, bool);

fn answers<R: Real, S: Shapes<R>>(
    accel: &Any<'_, R>,
    scene: &Scene<'_, R, S>,
    mut mailbox: mailbox::AnyMailbox<'_>,
    shots: &[Shot<R>],
) -> Vec<Answer> {
    let mut answer = |(ray, interval): &Shot<R>| {
        let hit = accel.nearest(scene, ray, *interval, &mut mailbox, &mut ());
        let any = accel.occluded(scene, ray, *interval, &mut mailbox, &mut ());
        (hit.map(|Hit { t, id }| (t.to_f64().to_bits(), id)), any)
    };
    shots.iter().map(&mut answer).collect()
}

/// Structure, mailbox, budget in bytes.
type Setup = (Kind, mailbox::Kind, usize);

fn setups<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Vec<Setup> {
    use mailbox::Kind::{Cache, Off, Stamps};
    let octree = |max_objects, max_level| Kind::Octree(octree::Limits { max_objects, max_level });
    let cells = |n| Kind::Grid(grid::resolution_for(scene, scene.shapes().count() * n));
    let mut setups = vec![(Kind::Naive, Stamps, UNLIMITED), (Kind::Grid([1; 3]), Off, UNLIMITED)];
    for mailbox in [Off, Stamps, Cache] {
        for kind in [cells(3), Kind::Grid([16; 3]), Kind::Grid([7, 1, 30]), octree(1, 6)] {
            setups.push((kind, mailbox, UNLIMITED));
        }
        for kib in [1, 2, 4, 8, 16, 64, 256] {
            setups.push((octree(2, 10), mailbox, kib << 10));
        }
    }
    setups
}

fn conform<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    let (mut rays, mut queries, mut hits, mut refused) = (0, 0, 0, 0);
    for name in SMALL_SCENES {
        let tables = Tables::<R>::new(&load(name).unwrap()).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), RAYS_PER_SCENE, 1987);
        let naive = Any::build(Kind::Naive, &scene, &mut Arena::new(&mut [])).unwrap();
        let expected = answers(&naive, &scene, mailbox::AnyMailbox::Off, &shots);
        rays += shots.len();
        hits += expected.iter().filter(|(hit, _)| hit.is_some()).count();
        for (i, (hit, any)) in expected.iter().enumerate() {
            assert_eq!(hit.is_some(), *any, "{number} {name} ray {i}: any hit against nearest");
        }
        for (kind, mailbox_kind, bytes) in setups(&scene) {
            let mut arena = Arena::new(memory.bytes(bytes));
            let shapes = scene.shapes().bounded();
            let built = mailbox::AnyMailbox::new(mailbox_kind, shapes, &mut arena)
                .map_err(BuildError::from)
                .and_then(|mailbox| Ok((mailbox, Any::build(kind, &scene, &mut arena)?)));
            let (mailbox, accel) = match built {
                Ok(built) => built,
                Err(BuildError::Memory(_)) if bytes < UNLIMITED => {
                    refused += 1;
                    continue;
                }
                Err(error) => panic!("{number} {name} {kind:?}: {error}"),
            };
            let found = answers(&accel, &scene, mailbox, &shots);
            queries += 2 * found.len();
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!(
                    found, expected,
                    "{number} {name} {kind:?} {mailbox_kind:?} {bytes} bytes, ray {i}: {:?}",
                    shots[i]
                );
            }
        }
    }
    println!("{number}: {rays} rays, {hits} hit, {queries} queries; {refused} budgets too small");
    assert!(rays >= 500_000 && hits > rays / 10);
}

#[test]
fn structures_give_the_hits_of_testing_all_in_f32() {
    conform::<f32>("f32");
}

#[test]
fn structures_give_the_hits_of_testing_all_in_f64() {
    conform::<f64>("f64");
}
