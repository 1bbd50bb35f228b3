extern crate std;
use super::*;
use crate::accel::Naive;
use crate::accel::mailbox::Off;
use crate::geom::Interval;
use crate::memory::Arena;
use crate::scene::Scene;
use crate::shape::Sphere;
use glam::{Vec3, vec3};

#[test]
fn a_hierarchy_finds_what_testing_all_finds() {
    let spheres: std::vec::Vec<Sphere<f32>> = (0..500)
        .map(|i| {
            let f = i as f32;
            Sphere::new(vec3((f * 0.37).sin() * 9.0, (f * 0.73).cos() * 5.0, f * 0.01), 0.2)
        })
        .collect();
    let scene = Scene::new(&spheres[..]).unwrap();
    let naive = Naive::new(&scene);
    for nodes in [0, 30, 60, 100, 1000] {
        let mut bytes = std::vec![0u64; 4096];
        let mut arena = Arena::new(bytemuck::cast_slice_mut(&mut bytes));
        let bvh = Bvh::<f32, u16>::build(&scene, nodes, &mut arena).unwrap();
        std::println!("{} {:?}", bvh.nodes(), bvh.leaves().map(|l| l.len()).max());
        assert_eq!(bvh.leaves().map(|l| l.len()).sum::<usize>(), 500);
        let mut hits = 0;
        for i in 0..3000 {
            let f = i as f32;
            let from = vec3((f * 0.11).sin() * 20.0, (f * 0.07).cos() * 20.0, 30.0);
            let to = vec3((f * 0.37).sin() * 9.0, (f * 0.73).cos() * 5.0, (i % 500) as f32 * 0.01);
            let ray = Ray::new(from, to + Vec3::splat(0.1) - from).unwrap();
            let a = naive.nearest(&scene, &ray, Interval::RAY, &mut Off, &mut ());
            let b = bvh.nearest(&scene, &ray, Interval::RAY, &mut Off, &mut ());
            assert_eq!(a, b, "{i}");
            hits += usize::from(a.is_some());
        }
        assert!(hits > 1000);
    }
}
