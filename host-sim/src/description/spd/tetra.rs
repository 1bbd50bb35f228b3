//! `tetra`, the tetrahedral pyramid: recursion into four corners of a cube.
//!
//! Source: A. Glassner, "Space Subdivision for Fast Ray Tracing", IEEE CG&A 4(10), 1984; view and
//! light after T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH '86; as in E. Haines'
//! Standard Procedural Databases.

use std::io;

use super::{SKY, Surface, looking};
use crate::description::nff_write::NffWriter;
use crate::description::{Triple, View};

/// The corners of a cube with x*y*z = 1: a tetrahedron's.
const CORNERS: [Triple; 4] =
    [[-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
/// Its faces, counter-clockwise seen from outside.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [3, 2, 1], [2, 3, 0], [1, 0, 3]];

pub(super) fn primitives(size: u32) -> Option<u64> {
    4_u64.checked_pow(size)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    let view = looking([1.022846, -3.177154, -2.174512], [-0.004103, -0.004103, 0.216539], 1.0);
    out.view(&View { up: [-0.816497, -0.816497, 0.816497], ..view })?;
    out.light([2.0, -18.0, -5.0])?;
    out.fill(&Surface { color: [1.0, 0.2, 0.2], ..Surface::MATT }.material())?;
    split(size, [0.0; 3], 1.0, out)
}

/// The part within the cube of half width `half` about `center`.
fn split(depth: u32, center: Triple, half: f64, out: &mut NffWriter<'_>) -> io::Result<()> {
    let towards = |corner: Triple, by: f64| std::array::from_fn(|i| center[i] + corner[i] * by);
    if depth > 1 {
        for corner in CORNERS {
            split(depth - 1, towards(corner, half / 2.0), half / 2.0, out)?;
        }
        return Ok(());
    }
    let points = CORNERS.map(|corner| towards(corner, half));
    FACES.iter().try_for_each(|face| out.polygon(&face.map(|i| points[i])))
}
