//! `tree`: every branch, a cone with a sphere on its end, carries two; a field below.
//!
//! Source: M. Aono and T. Kunii, "Botanical Tree Image Generation", IEEE CG&A 4(5), 1984; as in
//! E. Haines' Standard Procedural Databases.

use std::io;

use super::matrix::{IDENTITY, Matrix, multiply, point, rotation_x, rotation_z, scaling};
use super::{SKY, Surface, looking, radians};
use crate::description::nff_write::NffWriter;

/// A branch's end radius as a part of its base radius, and a child's size as a part of its parent's.
const TAPER: f64 = 0.67;
/// Base radius of a branch of size 1.
const THICKNESS: f64 = 0.15;
/// Of the two children: branching angle, turn about the parent (degrees) and contraction.
const BRANCHES: [(f64, f64, f64); 2] = [(40.0, 90.0, 0.65), (25.0, 230.0, 0.70)];

pub(super) fn primitives(size: u32) -> Option<u64> {
    // 2^(size+1) - 1 cones, as many spheres, and the field.
    2_u64.checked_pow(size.checked_add(2)?)?.checked_sub(1)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    out.view(&looking([4.5, 0.4, 2.0], [0.0, 0.0, 1.5], 1.0))?;
    let lights = [
        [-5.0, 5.0, 50.0],
        [30.0, -30.0, 30.0],
        [-40.0, -30.0, 20.0],
        [10.0, 30.0, 40.0],
        [-30.0, 40.0, 10.0],
        [50.0, 25.0, 20.0],
        [-10.0, -60.0, 30.0],
    ];
    for light in lights {
        out.light(light)?;
    }
    out.fill(&Surface { color: [0.2, 0.7, 0.2], ..Surface::MATT }.material())?;
    let corners = [(50.0, 50.0), (-50.0, 50.0), (-50.0, -50.0), (50.0, -50.0)];
    out.polygon(&corners.map(|(x, y)| [x, y, 0.0]))?;
    out.fill(&Surface { color: [0.55, 0.4, 0.2], ..Surface::MATT }.material())?;

    let steps = BRANCHES.map(|(angle, turn, contraction)| {
        let turned = multiply(&rotation_x(radians(angle)), &rotation_z(radians(turn)));
        let mut shrink = scaling(contraction);
        shrink[3][2] = 1.0;
        multiply(&turned, &shrink)
    });
    grow(size, &IDENTITY, 1.0, &steps, out)
}

/// The branch that `place` puts into the world and, `depth` levels up, all it carries.
fn grow(
    depth: u32,
    place: &Matrix,
    scale: f64,
    steps: &[Matrix; 2],
    out: &mut NffWriter<'_>,
) -> io::Result<()> {
    let radius = scale * THICKNESS;
    let base = (point([0.0; 3], place), radius);
    let apex = (point([0.0, 0.0, 1.0], place), radius * TAPER);
    out.cone(base, apex)?;
    out.sphere(apex.0, apex.1)?;
    if depth > 0 {
        for step in steps {
            grow(depth - 1, &multiply(step, place), scale * TAPER, steps, out)?;
        }
    }
    Ok(())
}
