//! `gears`: a cube of meshing gears, whose faces are concave polygons of 144 corners.
//!
//! Source: E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987.

use std::f64::consts::PI;
use std::io;

use super::matrix::{add, rotation_z, vector};
use super::{SKY, Surface, looking};
use crate::description::Triple;
use crate::description::nff_write::NffWriter;

/// Teeth of a gear, each of four corners.
const TEETH: usize = 36;
/// Corners of a gear's face.
const CORNERS: usize = 4 * TEETH;
/// Depth of the teeth as a part of the radius.
const TOOTH: f64 = 1.0 - 0.9;
/// The outer radius is cut to this part, so that meshing gears do not touch.
const CLEARANCE: f64 = 0.995;

pub(super) fn primitives(size: u32) -> Option<u64> {
    u64::from(size).checked_pow(3)?.checked_mul(2 + CORNERS as u64)?.checked_add(1)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    out.view(&looking([-1.1, -2.1, 2.6], [0.0; 3], 1.0))?;
    let lights = [
        [2.0, 4.0, 4.0],
        [-2.0, 4.0, 3.0],
        [2.0, -2.5, 2.5],
        [-1.0, -4.0, 2.0],
        [-1.111, -2.121, 2.626],
    ];
    for light in lights {
        out.light(light)?;
    }
    let ground =
        Surface { color: [1.0, 0.85, 0.7], kd: 0.3, ks: 0.6, highlight: 37.0, ..Surface::MATT };
    out.fill(&ground.material())?;
    let corners = [(2.0, 2.0), (-2.0, 2.0), (-2.0, -2.0), (2.0, -2.0)];
    out.polygon(&corners.map(|(x, y)| [x, y, 0.0]))?;

    let across = f64::from(size);
    let radius = 1.0 / (across - f64::from(size - 1) * TOOTH / 2.0);
    let start = -1.0 + radius;
    let pitch = radius * (2.0 - TOOTH);
    let thickness = (1.0 / (2.0 * across)).min(0.1);
    for iz in 0..size {
        for iy in 0..size {
            for ix in 0..size {
                out.fill(&surface(ix, iy, iz).material())?;
                let center = [
                    start + f64::from(ix) * pitch,
                    start + f64::from(iy) * pitch,
                    1.0 + f64::from(iz) * (-1.0 / across),
                ];
                let phase = PI * f64::from((ix + iy + iz) % 2) / TEETH as f64;
                let gear = Gear {
                    center,
                    phase,
                    outer: CLEARANCE * radius,
                    inner: (1.0 - TOOTH) * radius,
                };
                gear.write(thickness, out)?;
            }
        }
    }
    Ok(())
}

/// A pseudo-random colour of full brightness; every fifth gear is glass.
fn surface(ix: u32, iy: u32, iz: u32) -> Surface {
    let channel = |a: u32, b: u32, c: u32, step: f64| {
        0.01 + (f64::from(a * 3 + b * 2 + c + 1) * step / 7.0).fract()
    };
    let color = [channel(ix, iy, iz, 5.0), channel(iy, iz, ix, 3.0), channel(iz, ix, iy, 2.0)];
    let brightest = color[0].max(color[1]).max(color[2]);
    let color = color.map(|c| c / brightest);
    if (ix * 4 + iy * 2 + iz).is_multiple_of(5) {
        Surface { color, kd: 0.2, transmission: 0.8, ior: 1.1, ..Surface::MATT }
    } else {
        Surface { color, ..Surface::MATT }
    }
}

/// One gear.
struct Gear {
    center: Triple,
    /// Angle of the first tooth.
    phase: f64,
    outer: f64,
    inner: f64,
}

impl Gear {
    /// The face at `z` above the centre, going round by `sense` (1 or -1).
    fn face(&self, sense: f64, z: f64) -> [Triple; CORNERS] {
        let tooth = sense * (2.0 * PI / TEETH as f64);
        std::array::from_fn(|corner| {
            let at = 2.0 * PI * (corner / 4) as f64 / TEETH as f64;
            let middle = if sense > 0.0 { self.phase + at } else { self.phase - at };
            let (radius, angle) = match corner % 4 {
                0 => (self.outer, middle - 0.19 * tooth),
                1 => (self.outer, middle + 0.19 * tooth),
                2 => (self.inner, middle + 0.3 * tooth),
                _ => (self.inner, middle + 0.7 * tooth),
            };
            add(vector([radius, 0.0, z], &rotation_z(angle)), self.center)
        })
    }

    fn write(&self, thickness: f64, out: &mut NffWriter<'_>) -> io::Result<()> {
        let top = self.face(1.0, 0.0);
        out.polygon(&top)?;
        for (i, &[x, y, z]) in top.iter().enumerate() {
            let next = top[(i + 1) % CORNERS];
            let below = [next[0], next[1], next[2] - thickness];
            out.polygon(&[[x, y, z], [x, y, z - thickness], below, next])?;
        }
        out.polygon(&self.face(-1.0, -thickness))
    }
}
