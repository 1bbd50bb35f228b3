//! parry3d 0.31.1, a `TriMesh`. It has no lower bound on t: the origin is moved there. Its any-hit
//! query (`intersects_local_ray`) is the closest-hit query underneath.

use super::{ANY, Built, MISS, Peer, fastest};
use crate::heap::Mark;
use crate::mesh::Mesh;
use crate::rays::Ray;
use parry3d::math::Vector;
use parry3d::query::RayCast;
use parry3d::shape::{CompositeShapeRef, TriMesh};

struct Parry(TriMesh);

#[inline(always)]
fn ray(r: &Ray) -> (parry3d::query::Ray, f32) {
    let at = |c: usize| r.o[c] + r.tmin * r.d[c];
    let d = Vector::new(r.d[0], r.d[1], r.d[2]);
    (parry3d::query::Ray::new(Vector::new(at(0), at(1), at(2)), d), (r.tmax - r.tmin).min(f32::MAX))
}

impl Peer for Parry {
    fn closest(&mut self, r: &Ray) -> (f32, u32) {
        let (q, max) = ray(r);
        match CompositeShapeRef(&self.0).cast_local_ray(&q, max, false) {
            Some((id, t)) => (t + r.tmin, id),
            None => MISS,
        }
    }
    fn any(&mut self, r: &Ray) -> (f32, u32) {
        let (q, max) = ray(r);
        if self.0.intersects_local_ray(&q, max) { ANY } else { MISS }
    }
}

pub fn build(mesh: &Mesh) -> Result<Built, String> {
    let vertices =
        || -> Vec<Vector> { mesh.vertices.iter().map(|v| Vector::new(v[0], v[1], v[2])).collect() };
    let make = |(v, i)| TriMesh::new(v, i).map_err(|e| e.to_string());
    let input = || (vertices(), mesh.indices.clone());
    let mut inputs: Vec<_> = (0..3).map(|_| input()).collect();
    let (first, build) = fastest(|| make(inputs.pop().unwrap_or_default()).map(drop));
    first?;
    let input = input();
    let mark = Mark::set();
    let m = make(input)?;
    let (bytes_kept, bytes_peak) = (mark.kept(), mark.peak());
    let bytes_geometry = m.vertices().len() * 12 + m.indices().len() * 12;
    Ok(Built { batch: Box::new(Parry(m)), build, bytes_kept, bytes_peak, bytes_geometry })
}
