//! `shells`: a sea shell of overlapping spheres on a spiral.
//!
//! Source: C. Pickover, "A Short Recipe for Seashell Synthesis", IEEE CG&A 9(6), 1989; as in
//! E. Haines' Standard Procedural Databases.

use std::f64::consts::PI;
use std::io;

use super::{SKY, Surface, looking};
use crate::description::nff_write::NffWriter;

/// Growth of the radius with the angle.
const GROWTH: f64 = 0.15;
/// Depth of the spiral as a multiple of its radius.
const DEPTH: f64 = -2.0;

fn steps(size: u32) -> Option<i64> {
    180_i64.checked_mul(2_i64.checked_pow(size)?)
}

pub(super) fn primitives(size: u32) -> Option<u64> {
    steps(size).map(|steps| steps as u64 + 1)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let steps = steps(size).ok_or(io::ErrorKind::InvalidInput)?;
    out.background(SKY)?;
    out.view(&looking([-6.0, -60.0, 35.0], [0.0, 8.0, -15.0], 0.5))?;
    out.light([-100.0, -100.0, 100.0])?;
    let color = [1.0, 0.8, 0.4];
    let shell = Surface { color, kd: 0.8, ks: 0.2, highlight: 10.0, ior: 1.0, ..Surface::MATT };
    out.fill(&shell.material())?;
    for i in -steps * 2 / 3..=steps / 3 {
        let angle = 18.0 * PI * i as f64 / steps as f64;
        let r = (GROWTH * angle).exp();
        out.sphere([r * angle.sin(), r * angle.cos(), DEPTH * r], r)?;
    }
    Ok(())
}
