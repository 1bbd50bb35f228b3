//! obvhs 0.4.0, its BVH2 and its compressed eight-wide CWBVH, preset `medium_build`.
//! Triangles are put in the order of the leaves, as the crate's examples do, so no query looks up
//! an index; ids are looked up once a hit.

use super::{ANY, Built, MISS, Peer, fastest};
use crate::heap::Mark;
use crate::mesh::Mesh;
use crate::rays::{Query, Ray};
use glam_simd::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::RayHit;
use obvhs::triangle::Triangle;

fn ray(r: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(Vec3A::from_array(r.o), Vec3A::from_array(r.d), r.tmin, r.tmax)
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let one = |i| mesh.triangle(i).map(Vec3A::from_array);
    (0..mesh.len()).map(one).map(|[v0, v1, v2]| Triangle { v0, v1, v2 }).collect()
}

struct Tree<B> {
    b: B,
    tris: Vec<Triangle>,
}

/// The crate's trees have the same methods, but no trait in common.
macro_rules! peer {
    ($tree:ty, $build:ident, $f:ident) => {
        impl Peer for Tree<$tree> {
            fn closest(&mut self, r: &Ray) -> (f32, u32) {
                let mut h = RayHit::none();
                if self.b.ray_traverse(ray(r), &mut h, |r, id| self.tris[id].intersect(r)) {
                    (h.t, self.b.primitive_indices[h.primitive_id as usize])
                } else {
                    MISS
                }
            }

            fn any(&mut self, r: &Ray) -> (f32, u32) {
                if self.b.ray_traverse_miss(ray(r), |r, id| self.tris[id].intersect(r)) {
                    MISS
                } else {
                    ANY
                }
            }

            fn work(&mut self, r: &Ray, query: Query) -> Option<(u64, Option<u64>)> {
                let tests = std::cell::Cell::new(0);
                let test = |r: &obvhs::ray::Ray, id: usize| {
                    tests.set(tests.get() + 1);
                    self.tris[id].intersect(r)
                };
                match query {
                    Query::Nearest => self.b.ray_traverse(ray(r), &mut RayHit::none(), test),
                    Query::Any => self.b.ray_traverse_miss(ray(r), test),
                };
                Some((tests.get(), None))
            }
        }

        pub fn $f(mesh: &Mesh) -> Result<Built, String> {
            let tris = triangles(mesh);
            let make = || $build(&tris, BvhBuildParams::medium_build(), &mut Default::default());
            let (_, build) = fastest(make);
            let mark = Mark::set();
            let mut b = make();
            let bytes_peak = mark.peak();
            b.nodes.shrink_to_fit();
            b.primitive_indices.shrink_to_fit();
            let bytes_kept = mark.kept();
            let tris: Vec<_> = b.primitive_indices.iter().map(|&i| tris[i as usize]).collect();
            let bytes_geometry = size_of_val(&tris[..]);
            let batch = Box::new(Tree { b, tris });
            Ok(Built { batch, build, bytes_kept, bytes_peak, bytes_geometry })
        }
    };
}

peer!(Bvh2, build_bvh2_from_tris, build_bvh2);
peer!(CwBvh, build_cwbvh_from_tris, build_cwbvh);
