//! Helpers shared by the test programs of kibiray.

use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::View;

/// Every SPD generator, small enough to test each ray against every primitive.
pub const SMALL_SCENES: [&str; 11] = [
    "spd:balls:2",
    "spd:gears:1",
    "spd:mount:4",
    "spd:rings:2",
    "spd:teapot:2",
    "spd:tetra:4",
    "spd:tree:5",
    "spd:lattice:3",
    "spd:shells:1",
    "spd:sombrero:1",
    "spd:jacks:2",
];

/// A block of memory that starts where every number type may.
#[derive(Debug)]
pub struct Memory(Vec<u64>);

impl Memory {
    /// At least so many bytes.
    pub fn new(bytes: usize) -> Self {
        Self(vec![0xa5a5_a5a5_a5a5_a5a5; bytes.div_ceil(8)])
    }

    /// The first `len` of them.
    pub fn bytes(&mut self, len: usize) -> &mut [u8] {
        &mut bytemuck::cast_slice_mut(&mut self.0)[..len]
    }
}

/// A ray and where its hits count.
pub type Shot<R> = (Ray<R>, Interval<R>);

/// Seeded rays of all sorts around a scene, `count` in all: through the picture, from anywhere to
/// anywhere, along the axes (on grids of round coordinates, where walls and faces lie), from far
/// away, with long and short directions, with bounded intervals.
pub fn shots<R: Real>(bounds: Aabb<R>, view: &View<R>, count: usize, seed: u64) -> Vec<Shot<R>> {
    let mut rng = fastrand::Rng::with_seed(seed);
    let lo = bounds.lo.to_array().map(R::to_f64);
    let size = bounds.size().to_array().map(R::to_f64);
    let diagonal = size.iter().map(|s| s * s).sum::<f64>().sqrt();
    let eye = view.from.to_array().map(R::to_f64);

    let mut shots = Vec::with_capacity(count);
    while shots.len() < count {
        let inside = |rng: &mut fastrand::Rng| [0, 1, 2].map(|a| lo[a] + size[a] * rng.f64());
        // Sixteenths of the box: where walls of grids and octrees may be.
        let lattice = |rng: &mut fastrand::Rng| {
            [0, 1, 2].map(|a| lo[a] + size[a] * f64::from(rng.u8(0..=16)) / 16.0)
        };
        let target = inside(&mut rng);
        let mut interval = Interval::RAY;
        let (origin, to) = match rng.u8(0..8) {
            0 | 1 => (eye, target),
            2 => (inside(&mut rng), target),
            3 => {
                let (from, axis) = (lattice(&mut rng), rng.usize(0..3));
                let mut origin = from;
                let sign = if rng.bool() { 1.0 } else { -1.0 };
                origin[axis] -= sign * diagonal * f64::from(rng.u8(0..3));
                let mut to = origin;
                to[axis] += sign;
                (origin, to)
            }
            4 => (lattice(&mut rng), lattice(&mut rng)),
            5 => {
                let far = 10_f64.powi(rng.i32(1..6)) * diagonal;
                let away = [0, 1, 2].map(|a| target[a] + far * (rng.f64() - 0.5));
                (away, inside(&mut rng))
            }
            6 => {
                let (min, length) = (rng.f64() - 0.3, rng.f64());
                interval = Interval::new(R::from_f64(min), R::from_f64(min + length));
                (inside(&mut rng), target)
            }
            _ => {
                // From a lattice point into a lattice direction: through edges and corners.
                let from = lattice(&mut rng);
                let step = |rng: &mut fastrand::Rng| f64::from(rng.i8(-1..=1));
                (from, [0, 1, 2].map(|a| from[a] + size[a] * step(&mut rng)))
            }
        };
        let length = if rng.u8(0..8) == 0 { 10_f64.powi(rng.i32(-12..=12)) } else { 1.0 };
        let direction = [0, 1, 2].map(|a| (to[a] - origin[a]) * length);
        let (o, d) = (Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(direction));
        if let Ok(ray) = Ray::new(o, d) {
            shots.push((ray, interval));
        }
    }
    shots
}
