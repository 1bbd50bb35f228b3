extern crate std;

use super::*;
use crate::accel::Naive;
use crate::accel::mailbox::Off;
use crate::geom::Interval;
use crate::memory::Arena;
use crate::num::{Real, Vec3, Vector};
use crate::scene::{Scene, Shapes};
use crate::shape::Sphere;
use node::WIDTH;
use std::vec::Vec;

fn spheres<R: Real>(count: usize, place: impl Fn(f64) -> [f64; 3]) -> Vec<Sphere<R>> {
    let sphere = |i| Sphere::new(Vec3::<R>::from_f64(place(i as f64)), R::from_f64(0.2));
    (0..count).map(sphere).collect()
}

fn scattered(i: f64) -> [f64; 3] {
    [(i * 0.37).sin() * 9.0, (i * 0.73).cos() * 5.0, i * 0.01]
}

/// A walk, whatever the processor.
struct By<'b, 'm, R: Real>(&'b Bvh<'m, R, u16>, Way);

impl<R: Real> Accel<R> for By<'_, '_, R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        self.0.walk_as(self.1, ray, visitor);
    }
}

/// Least and greatest corner, in units.
type UnitBox = ([u32; 3], [u32; 3]);

/// The boxes of a node's children.
fn unpacked(node: &Node) -> [UnitBox; WIDTH] {
    let [x0, x1, y0, y1, z0, z1, xy, z] = node[6];
    let origin = [[x0, x1], [y0, y1], [z0, z1]].map(u16::from_le_bytes).map(u32::from);
    let shift = [xy & 15, xy >> 4, z & 15];
    core::array::from_fn(|child| {
        let side = |row: usize, axis: usize| {
            origin[axis] + (u32::from(node[row + axis][child]) << shift[axis])
        };
        ([0, 1, 2].map(|axis| side(0, axis)), [0, 1, 2].map(|axis| side(3, axis)))
    })
}

/// Every shape in one leaf, every box around what is below it, no way longer than allowed, the hits
/// of testing all; gives their number.
fn check<R: Real>(scene: &Scene<'_, R, &[Sphere<R>]>, nodes: usize) -> usize {
    let shapes = scene.shapes().count();
    let mut words = std::vec![0_u64; 24 * shapes + 100];
    let mut arena = Arena::new(bytemuck::cast_slice_mut(&mut words));
    let bvh = Bvh::<R, u16>::build(scene, nodes, &mut arena).unwrap();
    assert_eq!(arena.used(), footprint::<u16>(shapes, nodes).kept);
    assert_eq!(arena.high_water(), footprint::<u16>(shapes, nodes).peak);

    let boxes = |id: &u16| bvh.units.bounds(scene.shapes().bounds((*id).into()));
    let mut met = std::vec![0; shapes];
    // A node, and what must contain all below it.
    let mut pending: Vec<(usize, usize, Vec<UnitBox>)> = Vec::new();
    if bvh.nodes() > 0 {
        pending.push((0, 1, Vec::new()));
    }
    let (mut nodes, mut levels) = (0, 0);
    while let Some((number, level, around)) = pending.pop() {
        nodes += 1;
        levels = levels.max(level);
        let (node, [first, next]) = (&bvh.nodes[number], bvh.links[number]);
        for (place, bounds) in unpacked(node).into_iter().enumerate() {
            if bounds.0[0] > bounds.1[0] {
                continue;
            }
            let mut around = around.clone();
            around.push(bounds);
            if place >= leaves_of(node) {
                pending.push((usize::from(next) + place - WIDTH, level + 1, around));
                continue;
            }
            let list = bvh.list(first, ids_of(node, place));
            assert!(!list.is_empty());
            for id in list {
                met[usize::from(*id)] += 1;
                let [lo, hi] = boxes(id).corners();
                for (from, to) in &around {
                    for axis in 0..3 {
                        assert!(from[axis] <= u32::from(lo[axis]));
                        assert!(to[axis] >= u32::from(hi[axis]));
                    }
                }
            }
        }
    }
    assert!(met.iter().all(|times| *times == 1));
    assert_eq!((nodes, levels), (bvh.nodes(), bvh.levels()));
    assert!(levels <= LEVELS);
    assert_eq!(bvh.leaves().map(<[u16]>::len).sum::<usize>(), shapes);

    let mut hits = 0;
    for i in 0..2000 {
        let i = f64::from(i);
        let from = [(i * 0.11).sin() * 20.0, (i * 0.07).cos() * 20.0, 30.0];
        let to = scattered(i % 500.0);
        let mut way = [0, 1, 2].map(|axis| to[axis] + 0.1 - from[axis]);
        if i % 3.0 == 0.0 {
            way[i as usize % 2] = if i % 2.0 == 0.0 { 0.0 } else { -0.0 };
        }
        let ray = Ray::new(Vec3::<R>::from_f64(from), Vec3::<R>::from_f64(way)).unwrap();
        let naive = Naive::new(scene);
        let expected = naive.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
        for way in [Way::Narrow, Way::Wide, Way::WideJumping] {
            let bvh = By(&bvh, way);
            let found = bvh.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
            assert_eq!(found, expected, "{ray:?}");
            let any = bvh.occluded(scene, &ray, Interval::RAY, &mut Off, &mut ());
            assert_eq!(any, expected.is_some(), "{ray:?}");
        }
        let incoherent = bvh.for_incoherent_rays();
        let found = incoherent.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
        assert_eq!(found, expected, "{ray:?}");
        hits += usize::from(found.is_some());
    }
    hits
}

fn check_all<R: Real>() {
    let mut hits = 0;
    for count in [0, 1, 2, 7, 8, 9, 31, 32, 33, 500, 4000] {
        for place in [scattered, |i| [i * 0.3, 0.0, 0.0]] {
            let spheres = spheres::<R>(count, place);
            let scene = Scene::new(&spheres[..]).unwrap();
            for nodes in [0, 1, count / 24, count / 10, count] {
                hits += check(&scene, nodes);
            }
        }
    }
    assert!(hits > 10_000, "{hits}");
}

#[test]
fn hierarchies_are_sound_in_f32() {
    check_all::<f32>();
}

#[test]
fn hierarchies_are_sound_in_f64() {
    check_all::<f64>();
}

#[test]
fn shapes_that_cannot_be_told_apart_are_dealt_out() {
    // All in one place; and each as far away from the rest as all before it together.
    let same = spheres::<f32>(5000, |_| scattered(1.0));
    check(&Scene::new(&same[..]).unwrap(), 0);
    check(&Scene::new(&same[..]).unwrap(), 5000);
    let steep = spheres::<f32>(3000, |i| [(0.012 * i).exp2(), 0.0, 0.0]);
    check(&Scene::new(&steep[..]).unwrap(), 400);
}

#[test]
fn budgets_are_used() {
    for shapes in [1, 100, 1000, 60_000] {
        let least = footprint::<u16>(shapes, 0).peak;
        for bytes in [0, least, 4 * shapes, 6 * shapes, 8 * shapes, 100 * shapes] {
            let nodes = nodes_within::<u16>(shapes, bytes);
            let taken = footprint::<u16>(shapes, nodes).peak;
            assert!(taken <= bytes.max(least));
            let more = footprint::<u16>(shapes, nodes + 1).peak;
            assert!(more > bytes || nodes >= shapes.div_ceil(10), "{shapes} {bytes} {nodes}");
        }
    }
    // What the issue of memory is about.
    assert!(footprint::<u16>(1024, nodes_within::<u16>(1024, usize::MAX)).peak <= 9 * 1024);
    assert!(footprint::<u32>(100_000, nodes_within::<u32>(100_000, usize::MAX)).peak <= 1_150_000);
}
