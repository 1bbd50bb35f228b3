//! `lattice`: shiny spheres on a cubic lattice, joined by matt cylinders.
//!
//! Source: A. Costa, in E. Haines' Standard Procedural Databases, 1993.

use std::io;

use super::{SKY, Surface, looking};
use crate::description::View;
use crate::description::nff_write::NffWriter;

/// Radii of spheres and cylinders on a lattice of unit cells.
const SPHERE: f64 = 1.0 / 4.0;
const CYLINDER: f64 = 1.0 / 16.0;

pub(super) fn primitives(size: u32) -> Option<u64> {
    let n = u64::from(size);
    let points = (n + 1).checked_pow(3)?;
    n.checked_mul(3)?.checked_mul((n + 1).checked_pow(2)?)?.checked_add(points)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let n = f64::from(size);
    let cell = 1.0 / n;
    let middle = (f64::from(size / 2) + 0.5) * cell;
    let half = 1.0 / (2.0 * n);
    let view = looking([middle, 1.0, 1.0 - half], [middle, -1.0, -1.0 - half], 0.0);
    out.background(SKY)?;
    out.view(&View { up: [0.2, 1.0, 0.0], angle: 60.0, ..view })?;
    for axis in 0..3 {
        for place in [2.0, -1.0] {
            let mut light = [0.5; 3];
            light[axis] = place;
            out.light(light)?;
        }
    }

    let shiny = Surface { color: [0.9; 3], kd: 0.5, ks: 0.5, highlight: 37.0, ..Surface::MATT };
    let matt: [Surface; 3] = std::array::from_fn(|axis| {
        let mut color = [0.1; 3];
        color[axis] = 0.9;
        Surface { color, kd: 0.99, ..Surface::MATT }
    });
    let radius = SPHERE / n;
    let thin = CYLINDER / n;
    // The cylinders end within the spheres.
    let shorter = (radius * (1.0 - (CYLINDER / SPHERE).sqrt())) * 0.99;
    for x in 0..=size {
        for y in 0..=size {
            for z in 0..=size {
                let center = [x, y, z].map(|i| f64::from(i) / n);
                out.fill(&shiny.material())?;
                out.sphere(center, radius)?;
                for (axis, _) in [x, y, z].iter().enumerate().filter(|(_, i)| **i != size) {
                    let (mut base, mut apex) = (center, center);
                    base[axis] = center[axis] + shorter;
                    apex[axis] = center[axis] + cell - shorter;
                    out.fill(&matt[axis].material())?;
                    out.cone((base, thin), (apex, thin))?;
                }
            }
        }
    }
    Ok(())
}
