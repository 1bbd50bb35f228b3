//! `mount`: a fractal mountain of triangles and four glass spheres.
//!
//! Source: E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987;
//! midpoint displacement after L. Carpenter. The hash repeats itself; published counts need it so.

use std::f64::consts::PI;
use std::io;

use super::matrix::{add, normalized, rotation_about, rotation_z, vector};
use super::{SKY, Surface, looking};
use crate::description::Triple;
use crate::description::nff_write::NffWriter;

/// Which mountain.
const SEED: u64 = 21;
/// Between 2 and 3.
const FRACTAL_DIMENSION: f64 = 2.2;
/// Lower corner and width of the square.
const CORNER: f64 = -1.0;
const WIDTH: f64 = 2.0;

/// How much further a square's middle rises than its edges.
#[allow(clippy::approx_constant)] // these digits make the published mountain
const DIAGONAL: f64 = 1.4142136;

pub(super) fn primitives(size: u32) -> Option<u64> {
    4_u64.checked_pow(size)?.checked_mul(2)?.checked_add(4)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    out.view(&looking([-1.6, 1.6, 1.7], [0.0; 3], 0.01))?;
    out.light([-100.0, -100.0, 100.0])?;
    let glass =
        Surface { color: [1.0; 3], kd: 0.1, ks: 0.1, highlight: 6.7, transmission: 0.9, ior: 1.5 };
    out.fill(&glass.material())?;
    spheres([-0.8, 0.8, 1.0], 0.17, out)?;
    out.fill(&Surface { color: [0.5, 0.45, 0.35], ..Surface::MATT }.material())?;
    let ratio = 2.0 / (2.0_f64.ln() / (FRACTAL_DIMENSION - 1.0)).exp();
    let mountain = Mountain {
        size,
        points: f64::from(1_u32 << size),
        roughness: (ratio * ratio - 1.0).sqrt(),
    };
    mountain.grow(1 << size, 0, 0, [0.0; 4], out)
}

/// Four spheres, a pyramid about `center`.
fn spheres(center: Triple, radius: f64, out: &mut NffWriter<'_>) -> io::Result<()> {
    let up = [0.0, 0.0, radius * (3.0_f64 / 2.0).sqrt()];
    out.sphere(add(center, up), radius)?;
    let down = vector(up, &rotation_about(normalized([1.0, 1.0, 0.0]), (-1.0_f64 / 3.0).acos()));
    for i in 0..3 {
        let turn = rotation_z(f64::from(i) * 2.0 * PI / 3.0);
        out.sphere(add(vector(down, &turn), center), radius)?;
    }
    Ok(())
}

struct Mountain {
    size: u32,
    /// Grid cells a side.
    points: f64,
    roughness: f64,
}

impl Mountain {
    /// The square of `width` cells from cell (`x`, `y`) on; heights of its corners
    /// counter-clockwise from the lower left.
    fn grow(
        &self,
        width: u64,
        x: u64,
        y: u64,
        heights: [f64; 4],
        out: &mut NffWriter<'_>,
    ) -> io::Result<()> {
        let [ll, lr, ur, ul] = heights;
        if width == 1 {
            let place = |i: u64| CORNER + i as f64 * WIDTH / self.points;
            let (l, r, b, t) = (place(x), place(x + 1), place(y), place(y + 1));
            let corners = [[l, b, ll], [r, b, lr], [r, t, ur], [l, t, ul]];
            out.polygon(&[corners[0], corners[1], corners[2]])?;
            return out.polygon(&[corners[2], corners[3], corners[0]]);
        }
        let half = width / 2;
        let rise = half as f64 * WIDTH / self.points * self.roughness;
        let noise = |dx: u64, dy: u64| gauss(SEED + hash(x + dx, y + dy, self.size));
        let lower = (ll + lr) / 2.0 + rise * noise(half, 0);
        let right = (lr + ur) / 2.0 + rise * noise(width, half);
        let upper = (ur + ul) / 2.0 + rise * noise(half, width);
        let left = (ul + ll) / 2.0 + rise * noise(0, half);
        let middle = (ll + lr + ur + ul) / 4.0 + DIAGONAL * rise * noise(half, half);
        self.grow(half, x, y, [ll, lower, middle, left], out)?;
        self.grow(half, x + half, y, [lower, lr, right, middle], out)?;
        self.grow(half, x + half, y + half, [middle, right, ur, upper], out)?;
        self.grow(half, x, y + half, [left, middle, upper, ul], out)
    }
}

/// Seed for a grid point: the low 16 bits of three shifted terms. From size 8 on the third shift
/// would be negative; it then adds nothing, as on the machines that printed the known files.
fn hash(x: u64, y: u64, size: u32) -> u64 {
    let shifted = |value: u64, by: u32| by.checked_sub(size).map_or(0, |by| value << by);
    (shifted(x, 23) + shifted(y, 15) + shifted(x, 7)) & 0xffff
}

/// A normal deviate from a small linear congruential generator (Numerical Recipes, `gasdev`).
fn gauss(seed: u64) -> f64 {
    const MODULUS: u64 = 134_456;
    let next = |i: u64| (28_411 + i * 8_121) % MODULUS;
    let unit = |i: u64| i as f64 * 2.0 / MODULUS as f64 - 1.0;
    let mut state = seed;
    loop {
        let first = next(state);
        state = next(first);
        let (v1, v2) = (unit(first), unit(state));
        let r = v1 * v1 + v2 * v2;
        if r < 1.0 {
            return v1 * (-2.0 * r.ln() / r).sqrt();
        }
    }
}
