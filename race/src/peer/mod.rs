//! The contestants, each behind the same two queries.

use crate::mesh::Mesh;
use crate::rays::{Query, Ray};
use cpu_time::ProcessTime;

mod bvh;
mod embree;
mod obvhs;
pub mod ours;
mod parry;

/// One ray at a time, as a user's shading loop would ask.
pub trait Peer {
    /// Nearest hit as (t, triangle).
    fn closest(&mut self, r: &Ray) -> (f32, u32);
    /// Is there any? [`ANY`] or [`MISS`].
    fn any(&mut self, r: &Ray) -> (f32, u32);
    /// Triangle tests and nodes or cells looked at for a ray, where that can be counted.
    fn work(&mut self, _r: &Ray, _query: Query) -> Option<(u64, Option<u64>)> {
        None
    }
}

/// Nothing is hit.
pub const MISS: (f32, u32) = (f32::INFINITY, u32::MAX);
/// Something is hit, no matter where.
pub const ANY: (f32, u32) = (0.0, 0);

/// A whole ray set: the loop is compiled into each contestant, so none pays for an indirect call.
pub trait Batch {
    /// Answers all and gives seconds of processor time.
    fn answer(&mut self, query: Query, rays: &[Ray], out: &mut [(f32, u32)]) -> f64;
    /// Triangle tests and steps of all rays.
    fn work(&mut self, query: Query, rays: &[Ray]) -> Option<(u64, Option<u64>)>;
}

impl<P: Peer> Batch for P {
    fn answer(&mut self, query: Query, rays: &[Ray], out: &mut [(f32, u32)]) -> f64 {
        let start = ProcessTime::now();
        match query {
            Query::Nearest => {
                rays.iter().zip(out).for_each(|(ray, out)| *out = self.closest(ray));
            }
            Query::Any => rays.iter().zip(out).for_each(|(ray, out)| *out = self.any(ray)),
        }
        start.elapsed().as_secs_f64()
    }

    fn work(&mut self, query: Query, rays: &[Ray]) -> Option<(u64, Option<u64>)> {
        rays.iter().try_fold((0, Some(0)), |sum, ray| {
            let (tests, steps) = Peer::work(self, ray, query)?;
            Some((sum.0 + tests, sum.1.zip(steps).map(|(a, b)| a + b)))
        })
    }
}

/// A contestant, ready, and what that took.
pub struct Built {
    pub batch: Box<dyn Batch>,
    /// Seconds of processor time, fastest of a few.
    pub build: f64,
    /// The structure alone, vectors shrunk to fit where the peer lets its user do so.
    pub bytes_kept: usize,
    /// Most bytes taken at any moment of the build, geometry not counted.
    pub bytes_peak: usize,
    /// Vertices, indices or triangles that are read while tracing.
    pub bytes_geometry: usize,
}

type Builder = fn(&Mesh) -> Result<Built, String>;

/// The others.
pub const OTHERS: [(&str, Builder); 6] = [
    ("Embree 3.13", embree::build_default),
    ("Embree 3.13 compact, robust", embree::build_compact_robust),
    ("obvhs 0.4 BVH2", obvhs::build_bvh2),
    ("obvhs 0.4 CWBVH", obvhs::build_cwbvh),
    ("parry3d 0.31", parry::build),
    ("bvh 0.13", bvh::build),
];

/// Fastest of three builds, of fewer when they take long. Returns the last.
fn fastest<T>(mut build: impl FnMut() -> T) -> (T, f64) {
    let (mut best, mut total) = (f64::INFINITY, 0.0);
    for left in (0..3).rev() {
        let start = ProcessTime::now();
        let built = build();
        let time = start.elapsed().as_secs_f64();
        best = best.min(time);
        total += time;
        if left == 0 || total > 0.5 {
            return (built, best);
        }
    }
    unreachable!()
}
