//! Guards promise 4: the same answer with every structure. A hit from a grid or an octree, of any
//! resolution, with any mailbox, grown into any budget, is bit for bit the one of testing all.

use kibiray::num::{Fixed, Real};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Compared, Memory, SMALL_SCENES, UNLIMITED, combined_scenes, compare, shots};

const RAYS_PER_SCENE: usize = 50_000;
/// A ray takes ten times as long where solids are combined.
const COMBINED_RAYS: usize = 1000;

fn conform<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    let mut all = Compared::default();
    let small = SMALL_SCENES.map(|name| (name, load(name).unwrap(), RAYS_PER_SCENE));
    let combined = combined_scenes().into_iter().map(|(name, scene)| (name, scene, COMBINED_RAYS));
    for (name, description, rays) in small.into_iter().chain(combined) {
        let moved = Frame::of::<R>(&description).apply(&description).into_owned();
        let tables = Tables::<R>::new(&moved).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), rays, 1987);
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
