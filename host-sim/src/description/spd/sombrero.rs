//! `sombrero`: the height field of a damped cosine, as triangles.
//!
//! Source: A. Enzmann, in E. Haines' Standard Procedural Databases, 1995.

use std::io;

use super::{SKY, Surface, looking};
use crate::description::nff_write::NffWriter;
use crate::description::{Triple, View};

/// Two pi, with the digits that the original uses.
#[allow(clippy::approx_constant)] // the last digits of heights depend on them
const TURN: f64 = 2.0 * 3.14159265358;

/// Samples a side.
fn side(size: u32) -> Option<u64> {
    32_u64.checked_mul(2_u64.checked_pow(size.checked_sub(1)?)?)
}

pub(super) fn primitives(size: u32) -> Option<u64> {
    (side(size)? - 1).checked_pow(2)?.checked_mul(2)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let side = side(size).ok_or(io::ErrorKind::InvalidInput)? as usize;
    out.background(SKY)?;
    out.view(&View { angle: 40.0, ..looking([0.0, 5.0, -8.0], [0.0; 3], 0.01) })?;
    out.light([10.0, 10.0, -10.0])?;
    let red =
        Surface { color: [1.0, 0.1, 0.1], kd: 0.8, highlight: 40.0, ior: 1.0, ..Surface::MATT };
    out.fill(&red.material())?;

    let mut rows = Rows::new(side);
    let mut near = rows.next_row();
    for i in 1..side {
        let far = rows.next_row();
        let vertex = |row: &[f32], i: usize, j: usize| -> Triple {
            let place = |k: usize| -4.0 + 8.0 * k as f64 / (side - 1) as f64;
            [place(j), -3.0 + f64::from(row[j]), place(i)]
        };
        for j in 1..side {
            let here = vertex(&near, i - 1, j - 1);
            let across = vertex(&far, i, j);
            out.polygon(&[here, across, vertex(&near, i - 1, j)])?;
            out.polygon(&[here, vertex(&far, i, j - 1), across])?;
        }
        near = far;
    }
    Ok(())
}

/// Heights row by row. Samples are spaced for `side` cells while the triangles spread them over
/// one cell less: the original does so.
struct Rows {
    side: usize,
    y: f64,
}

impl Rows {
    fn new(side: usize) -> Self {
        Self { side, y: -4.0 }
    }

    fn next_row(&mut self) -> Vec<f32> {
        let step = 8.0 / self.side as f64;
        let y = self.y;
        self.y += step;
        let mut x = -4.0;
        (0..self.side)
            .map(|_| {
                let r = (x * x + y * y).sqrt();
                x += step;
                (3.0 * (TURN * r).cos() * (-r).exp() / 3.0) as f32
            })
            .collect()
    }
}
