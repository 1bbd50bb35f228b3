//! `balls`, the sphereflake: every sphere carries nine of a third its radius; a floor below.
//!
//! Source: E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987.

use std::f64::consts::PI;
use std::io;

use super::matrix::{IDENTITY, cross, normalized, rotation_about, rotation_y, rotation_z, vector};
use super::{SKY, Surface, looking};
use crate::description::Triple;
use crate::description::nff_write::NffWriter;

/// Radius of a child as a part of its parent's.
const RATIO: f64 = 1.0 / 3.0;
/// From this cosine on a direction counts as the z axis.
const ALONG_Z: f64 = 0.9999;

pub(super) fn primitives(size: u32) -> Option<u64> {
    // 1 + 9 + ... + 9^size spheres and the floor.
    Some((9_u64.checked_pow(size.checked_add(1)?)? - 1) / 8 + 1)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    out.view(&looking([2.1, 1.3, 1.7], [0.0; 3], 0.01))?;
    for light in [[4.0, 3.0, 2.0], [1.0, -4.0, 4.0], [-3.0, 1.0, 5.0]] {
        out.light(light)?;
    }
    let floor = Surface { color: [1.0, 0.75, 0.33], kd: 0.8, ior: 1.0, ..Surface::MATT };
    out.fill(&floor.material())?;
    let corners = [(12.0, 12.0), (-12.0, 12.0), (-12.0, -12.0), (12.0, -12.0)];
    out.polygon(&corners.map(|(x, y)| [x, y, -0.5]))?;
    let ball = Surface { color: [1.0, 0.9, 0.7], kd: 0.5, ks: 0.5, highlight: 37.0, ..floor };
    out.fill(&ball.material())?;
    grow(size, [0.0; 3], 0.5, [0.0, 0.0, 1.0], &directions(), out)
}

/// The nine directions of children of a sphere that points along +z.
fn directions() -> [Triple; 9] {
    let h = 1.0 / 2.0_f64.sqrt();
    let tilt = rotation_about(normalized([1.0, -1.0, 0.0]), (2.0 / 6.0_f64.sqrt()).asin());
    let trio = [[h, h, 0.0], [h, 0.0, -h], [0.0, h, -h]].map(|v| vector(v, &tilt));
    std::array::from_fn(|i| vector(trio[i % 3], &rotation_z((i / 3) as f64 * 2.0 * PI / 3.0)))
}

/// The sphere and, `depth` levels down, all it carries.
fn grow(
    depth: u32,
    center: Triple,
    radius: f64,
    direction: Triple,
    set: &[Triple; 9],
    out: &mut NffWriter<'_>,
) -> io::Result<()> {
    out.sphere(center, radius)?;
    if depth == 0 {
        return Ok(());
    }
    let turn = if direction[2] >= ALONG_Z {
        IDENTITY
    } else if direction[2] <= -ALONG_Z {
        rotation_y(PI)
    } else {
        let axis = normalized(cross([0.0, 0.0, 1.0], direction));
        rotation_about(axis, direction[2].acos())
    };
    let reach = radius * (1.0 + RATIO);
    for way in set {
        let way = vector(*way, &turn);
        let child: Triple = std::array::from_fn(|i| way[i] * reach + center[i]);
        let outward = std::array::from_fn(|i| (child[i] - center[i]) / reach);
        grow(depth - 1, child, radius * RATIO, outward, set, out)?;
    }
    Ok(())
}
