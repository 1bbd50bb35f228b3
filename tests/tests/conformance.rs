//! Guards promise 4: the same answer with every structure. A hit from a grid or an octree, of any
//! resolution, with any mailbox, grown into any budget, is bit for bit the one of testing all.

use kibiray::num::{Fixed, Real};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Compared, Memory, SMALL_SCENES, UNLIMITED, compare, shots};

const RAYS_PER_SCENE: usize = 50_000;

fn conform<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    let mut all = Compared::default();
    for name in SMALL_SCENES {
        let description = load(name).unwrap();
        let moved = Frame::of::<R>(&description).apply(&description).into_owned();
        let tables = Tables::<R>::new(&moved).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), RAYS_PER_SCENE, 1987);
        all += compare(&format!("{number} {name}"), &scene, &shots, &mut memory);
    }
    println!("{number}: {all:?}");
    assert!(all.rays >= 500_000 && all.hits > all.rays / 10);
}

#[test]
fn structures_give_the_hits_of_testing_all_in_f32() {
    conform::<f32>("f32");
}

#[test]
fn structures_give_the_hits_of_testing_all_in_f64() {
    conform::<f64>("f64");
}

#[test]
fn structures_give_the_hits_of_testing_all_in_fixed_point() {
    conform::<Fixed>("fixed");
}
