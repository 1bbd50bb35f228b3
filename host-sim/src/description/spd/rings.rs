//! `rings`: a pyramid of dodecahedra, each six pentagonal rings of cylinders and spheres.
//!
//! Source: E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987.

use std::f64::consts::PI;
use std::io;

use super::matrix::{add, point, rotation_x, rotation_z};
use super::{SKY, Surface, looking};
use crate::description::Triple;
use crate::description::nff_write::NffWriter;

/// Radius of cylinders and spheres.
const RADIUS: f64 = 0.07412;
/// Red, green, blue and their complements.
const COLORS: [Triple; 6] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
];

pub(super) fn primitives(size: u32) -> Option<u64> {
    let n = u64::from(size);
    let objects = n.checked_mul(n + 1)?.checked_mul(2 * n + 1)? / 6;
    objects.checked_mul(60)?.checked_add(1)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let spread = 1.0 / (PI / 8.0).sin();
    let from = [-1.0, -spread, 0.5];
    out.background(SKY)?;
    out.view(&looking(from, [from[0], from[1] + 1.0, from[2]], 1.0))?;
    for (x, z) in [(3.0, 3.0), (-4.0, 1.0), (2.0, -4.0)] {
        out.light([x, -spread, z])?;
    }
    out.fill(&Surface { color: [1.0; 3], ..Surface::MATT }.material())?;
    // The wall spans the view of 45 degrees and 1 % more.
    let y = spread * f64::from(size + 1);
    let half = 1.01 * (y - from[1]) * (PI / 8.0).tan();
    let corners = [(half, half), (-half, half), (-half, -half), (half, -half)];
    out.polygon(&corners.map(|(x, z)| [x + from[0], y, z + from[2]]))?;

    let rings = rings();
    for depth in 0..size {
        let y = spread * f64::from(depth + 1);
        let place = |i: u32| f64::from(2 * i) - f64::from(depth);
        for z in 0..=depth {
            for x in 0..=depth {
                object(&rings, [place(x), y, place(z)], out)?;
            }
        }
    }
    Ok(())
}

/// Six pentagons on the middles of a dodecahedron's edges, the whole in the unit sphere.
fn rings() -> [[Triple; 5]; 6] {
    let scale = 1.0 / (1.0 + RADIUS);
    let flat: [Triple; 5] = std::array::from_fn(|i| {
        let angle = i as f64 * 2.0 * PI / 5.0;
        [scale * angle.cos(), scale * angle.sin(), 0.0]
    });
    // Angle between neighbouring faces of a dodecahedron.
    let tilt = rotation_x(2.0 * ((PI / 3.0).cos() / (PI / 5.0).sin()).acos());
    std::array::from_fn(|ring| {
        if ring == 0 {
            return flat;
        }
        let turn = rotation_z(PI * (2.0 * (ring - 1) as f64 + 1.0) / 5.0);
        flat.map(|p| point(point(p, &tilt), &turn))
    })
}

fn object(rings: &[[Triple; 5]; 6], offset: Triple, out: &mut NffWriter<'_>) -> io::Result<()> {
    for (ring, color) in rings.iter().zip(COLORS) {
        let surface = Surface { color, kd: 0.5, ks: 0.2, highlight: 37.0, ..Surface::MATT };
        out.fill(&surface.material())?;
        for i in 0..5 {
            let base = add(ring[i], offset);
            out.cone((base, RADIUS), (add(ring[(i + 4) % 5], offset), RADIUS))?;
            out.sphere(base, RADIUS)?;
        }
    }
    Ok(())
}
