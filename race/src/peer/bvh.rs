//! bvh 0.13.0. Its iterators hand out candidates and leave the triangle test to the caller, so
//! the test here is the usual Möller-Trumbore. `traverse_iterator` gets a query of our own, a box
//! test that knows the nearest hit so far: faster than the documented
//! `nearest_child_traverse_iterator`, which goes on behind a hit. Boxes come in no particular order.

use super::{ANY, Built, MISS, Peer, fastest};
use crate::heap::Mark;
use crate::mesh::{Mesh, V};
use crate::rays::{Query, Ray};
use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use nalgebra::Point3;
use std::cell::Cell;

#[derive(Clone)]
struct Tri {
    p: [V; 3],
    id: u32,
    node: u32,
}

impl Bounded<f32, 3> for Tri {
    fn aabb(&self) -> Aabb<f32, 3> {
        let mut b = Aabb::empty();
        for p in self.p {
            b.grow_mut(&Point3::from(p));
        }
        b
    }
}

impl BHShape<f32, 3> for Tri {
    fn set_bh_node_index(&mut self, i: usize) {
        self.node = i as u32;
    }
    fn bh_node_index(&self) -> usize {
        self.node as usize
    }
}

fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn dot(a: V, b: V) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn hit(r: &Ray, t: &[V; 3], tmax: f32) -> Option<f32> {
    let (e1, e2) = (sub(t[1], t[0]), sub(t[2], t[0]));
    let p = cross(r.d, e2);
    let det = dot(e1, p);
    if det == 0.0 {
        return None;
    }
    let inv = 1.0 / det;
    let s = sub(r.o, t[0]);
    let u = dot(s, p) * inv;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let q = cross(s, e1);
    let v = dot(r.d, q) * inv;
    if !(v >= 0.0 && u + v <= 1.0) {
        return None;
    }
    let t = dot(e2, q) * inv;
    (t > r.tmin && t < tmax).then_some(t)
}

/// A ray that ends at the nearest hit so far.
struct Shrinking<'a> {
    r: &'a Ray,
    inv: V,
    tmax: Cell<f32>,
}

impl IntersectsAabb<f32, 3> for Shrinking<'_> {
    #[inline(always)]
    fn intersects_aabb(&self, b: &Aabb<f32, 3>) -> bool {
        let (mut near, mut far) = (self.r.tmin, self.tmax.get());
        for c in 0..3 {
            let t0 = (b.min[c] - self.r.o[c]) * self.inv[c];
            let t1 = (b.max[c] - self.r.o[c]) * self.inv[c];
            near = near.max(t0.min(t1));
            far = far.min(t0.max(t1));
        }
        near <= far * 1.000_000_5
    }
}

struct Tree {
    b: Bvh<f32, 3>,
    tris: Vec<Tri>,
}

impl Tree {
    fn query<'a>(r: &'a Ray) -> Shrinking<'a> {
        Shrinking { r, inv: r.d.map(|x| 1.0 / x), tmax: Cell::new(r.tmax) }
    }
}

impl Peer for Tree {
    fn closest(&mut self, r: &Ray) -> (f32, u32) {
        let q = Self::query(r);
        let mut best = MISS;
        for t in self.b.traverse_iterator(&q, &self.tris) {
            if let Some(x) = hit(r, &t.p, q.tmax.get()) {
                q.tmax.set(x);
                best = (x, t.id);
            }
        }
        best
    }

    fn any(&mut self, r: &Ray) -> (f32, u32) {
        let q = Self::query(r);
        let found =
            self.b.traverse_iterator(&q, &self.tris).any(|t| hit(r, &t.p, r.tmax).is_some());
        if found { ANY } else { MISS }
    }

    fn work(&mut self, r: &Ray, query: Query) -> Option<(u64, Option<u64>)> {
        let q = Self::query(r);
        let mut tests = 0;
        for t in self.b.traverse_iterator(&q, &self.tris) {
            tests += 1;
            if let Some(x) = hit(r, &t.p, q.tmax.get()) {
                q.tmax.set(x);
                if query == Query::Any {
                    break;
                }
            }
        }
        Some((tests, None))
    }
}

pub fn build(mesh: &Mesh) -> Result<Built, String> {
    let one = |i| Tri { p: mesh.triangle(i), id: i as u32, node: 0 };
    let mut tris: Vec<Tri> = (0..mesh.len()).map(one).collect();
    let (_, build) = fastest(|| Bvh::build(&mut tris));
    let mark = Mark::set();
    let mut b = Bvh::build(&mut tris);
    let bytes_peak = mark.peak();
    b.nodes.shrink_to_fit();
    let bytes_kept = mark.kept();
    let bytes_geometry = size_of_val(&tris[..]);
    let batch = Box::new(Tree { b, tris });
    Ok(Built { batch, build, bytes_kept, bytes_peak, bytes_geometry })
}
