//! `jacks`: three crossed cylinders with balls on their ends, smaller ones in all octants.
//!
//! Source: A. Enzmann, in E. Haines' Standard Procedural Databases, 1995.

use std::io;

use super::matrix::{
    IDENTITY, Matrix, multiply, point, rotation_x, rotation_y, scaling, translation,
};
use super::{Surface, looking, radians};
use crate::description::View;
use crate::description::nff_write::NffWriter;

pub(super) fn primitives(size: u32) -> Option<u64> {
    // 1 + 8 + ... + 8^(size-1) jacks of nine primitives.
    ((8_u64.checked_pow(size)? - 1) / 7).checked_mul(9)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background([0.2, 0.05, 0.2])?;
    let view = looking([0.0, 0.0, -8.0], [0.0; 3], 0.001);
    out.view(&View { up: [0.0, 1.0, 0.0], angle: 25.0, resolution: [256, 256], ..view })?;
    out.light([-10.0, 3.0, -20.0])?;
    let color = [0.737, 0.561, 0.561];
    let pink = Surface { color, kd: 0.7, ks: 0.7, highlight: 20.0, ior: 1.0, ..Surface::MATT };
    out.fill(&pink.material())?;
    let place = multiply(&rotation_x(radians(-30.0)), &IDENTITY);
    let place = multiply(&rotation_y(radians(-20.0)), &place);
    grow(size, &place, 1.0, out)
}

/// The jack that `place` puts into the world and, down to `depth` 1, those between its arms.
fn grow(depth: u32, place: &Matrix, scale: f64, out: &mut NffWriter<'_>) -> io::Result<()> {
    // Smaller than its octant, so that neighbours keep apart.
    let body = multiply(&scaling(0.75), place);
    let arm = |axis: usize, at: f64| {
        let mut end = [0.0; 3];
        end[axis] = at;
        point(end, &body)
    };
    let (thin, thick) = (0.75 * scale * 0.1, 0.75 * scale * 0.2);
    for axis in 0..3 {
        out.cone((arm(axis, -1.0), thin), (arm(axis, 1.0), thin))?;
    }
    for at in [1.0, -1.0] {
        for axis in 0..3 {
            out.sphere(arm(axis, at), thick)?;
        }
    }
    if depth > 1 {
        for octant in 0..8_u32 {
            let center = [4, 2, 1].map(|bit| if octant & bit == 0 { -0.5 } else { 0.5 });
            let child = multiply(&translation(center), place);
            grow(depth - 1, &multiply(&scaling(0.5), &child), 0.5 * scale, out)?;
        }
    }
    Ok(())
}
