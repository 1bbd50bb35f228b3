//! The ray sets, seeded: every run and every contestant gets the same.

use crate::mesh::{Mesh, V, cross, dot, sub, unit, wide};
use fastrand::Rng;

/// What is asked for.
#[derive(Clone, Copy, PartialEq)]
pub enum Query {
    Nearest,
    Any,
}

/// A hit at t is at `o + t d`, strictly between `tmin` and `tmax`.
#[derive(Clone, Copy)]
pub struct Ray {
    pub o: V,
    pub d: V,
    pub tmin: f32,
    pub tmax: f32,
}

/// Rays of one kind.
pub struct Set {
    pub name: &'static str,
    pub query: Query,
    pub rays: Vec<Ray>,
}

/// Rays of the seeded sets, except `edges`.
const MANY: usize = 200_000;
/// Rays at edges: for right answers, not for speed.
const EDGES: usize = 20_000;
/// Pixels of `primary` along a side.
const SIDE: usize = 512;

impl Set {
    /// All sets of a scene.
    pub fn all(mesh: &Mesh) -> [Self; 4] {
        use Query::{Any, Nearest};
        let mut rng = Rng::with_seed(mesh.len() as u64);
        [
            Self { name: "primary", query: Nearest, rays: primary(mesh) },
            Self { name: "incoherent", query: Nearest, rays: incoherent(mesh, &mut rng) },
            Self { name: "shadow", query: Any, rays: shadow(mesh, &mut rng) },
            Self { name: "edges", query: Nearest, rays: edges(mesh, &mut rng) },
        ]
    }
}

fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
    let narrow = |a: [f64; 3]| a.map(|x| x as f32);
    Ray { o: narrow(o), d: narrow(d), tmin: 0.0, tmax: f32::INFINITY }
}

/// A pinhole camera 62 degrees wide, row by row.
fn primary(mesh: &Mesh) -> Vec<Ray> {
    let [lo, hi] = mesh.bounds().map(wide);
    let (middle, size) = ([0, 1, 2].map(|k| (lo[k] + hi[k]) / 2.0), sub(hi, lo));
    let eye = [0, 1, 2].map(|k| middle[k] + [0.3, -0.9, 1.2][k] * size[k]);
    let forward = unit(sub(middle, eye));
    let right = unit(cross(forward, [0.0, 1.0, 0.0]));
    let up = cross(right, forward);
    let across = |i: usize| ((i as f64 + 0.5) / SIDE as f64 - 0.5) * 1.2;
    let pixel = |i: usize| {
        let (a, b) = (across(i % SIDE), -across(i / SIDE));
        ray(eye, unit([0, 1, 2].map(|k| forward[k] + a * right[k] + b * up[k])))
    };
    (0..SIDE * SIDE).map(pixel).collect()
}

fn within(mesh: &Mesh, rng: &mut Rng) -> [f64; 3] {
    let [lo, hi] = mesh.bounds().map(wide);
    [0, 1, 2].map(|k| lo[k] + rng.f64() * (hi[k] - lo[k]))
}

/// From anywhere in the box in any direction.
fn incoherent(mesh: &Mesh, rng: &mut Rng) -> Vec<Ray> {
    let direction = |rng: &mut Rng| loop {
        let d = [0; 3].map(|_| 2.0 * rng.f64() - 1.0);
        if (1e-4..1.0).contains(&dot(d, d)) {
            break unit(d);
        }
    };
    (0..MANY).map(|_| ray(within(mesh, rng), direction(rng))).collect()
}

/// From points of the surface to one of eight lights above, in random order.
fn shadow(mesh: &Mesh, rng: &mut Rng) -> Vec<Ray> {
    let mut total = 0.0;
    let areas: Vec<f64> = (0..mesh.len())
        .map(|i| {
            let [a, b, c] = mesh.triangle(i).map(wide);
            let n = cross(sub(b, a), sub(c, a));
            total += dot(n, n).sqrt();
            total
        })
        .collect();
    let [lo, hi] = mesh.bounds().map(wide);
    let light = |rng: &mut Rng| {
        let far = [2.0 * rng.f64() - 1.0, rng.f64(), 2.0 * rng.f64() - 1.0];
        [0, 1, 2].map(|k| (lo[k] + hi[k]) / 2.0 + far[k] * 0.75 * (hi[k] - lo[k]))
    };
    let lights = [0; 8].map(|_| light(rng));
    let one = |rng: &mut Rng| {
        let at = rng.f64() * total;
        let i = areas.partition_point(|&area| area < at).min(mesh.len() - 1);
        let [a, b, c] = mesh.triangle(i).map(wide);
        let (p, q) = (rng.f64(), rng.f64());
        let (p, q) = if p + q > 1.0 { (1.0 - p, 1.0 - q) } else { (p, q) };
        let o = [0, 1, 2].map(|k| a[k] + p * (b[k] - a[k]) + q * (c[k] - a[k]));
        Ray { tmin: 0.001, tmax: 0.999, ..ray(o, sub(lights[rng.usize(0..8)], o)) }
    };
    (0..MANY).map(|_| one(rng)).collect()
}

/// From anywhere in the box to points of edges, a quarter of them corners: cracks show there.
fn edges(mesh: &Mesh, rng: &mut Rng) -> Vec<Ray> {
    let one = |i: usize| {
        let corners = mesh.triangle(rng.usize(0..mesh.len())).map(wide);
        let first = rng.usize(0..3);
        let (a, b) = (corners[first], corners[(first + 1) % 3]);
        let f = if i.is_multiple_of(4) { 0.0 } else { rng.f64() };
        let o = within(mesh, rng);
        ray(o, sub([0, 1, 2].map(|k| a[k] + f * (b[k] - a[k])), o))
    };
    (0..EDGES).map(one).collect()
}
