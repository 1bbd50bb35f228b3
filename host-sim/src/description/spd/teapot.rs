//! `teapot`: M. Newell's teapot of 32 Bézier patches, with the bottom that F. Crow added, cut
//! into triangles with normals, on a checkerboard.
//!
//! Source of the control points: F. Crow, "The Origins of the Teapot", IEEE CG&A 7(1), 1987.
//! They are kept here as the profiles and cross-sections they were made from.

use std::io;

use super::matrix::{Matrix, coord, cross, multiply, normalized};
use super::{SKY, Surface, looking};
use crate::description::Triple;
use crate::description::nff_write::NffWriter;

/// Control points, a row a profile point.
type Patch = [[Triple; 4]; 4];
/// Of a circle: radius, how far its tangent handles reach, height.
type Circle = (f64, f64, f64);
/// Of a tube: inner point (x, z), outer point (x, z), half width in y.
type Section = ((f64, f64), (f64, f64), f64);

const RIM: [Circle; 4] =
    [(1.4, 0.784, 2.4), (1.3375, 0.749, 2.53125), (1.4375, 0.805, 2.53125), (1.5, 0.84, 2.4)];
const UPPER_BODY: [Circle; 4] =
    [(1.5, 0.84, 2.4), (1.75, 0.98, 1.875), (2.0, 1.12, 1.35), (2.0, 1.12, 0.9)];
const LOWER_BODY: [Circle; 4] =
    [(2.0, 1.12, 0.9), (2.0, 1.12, 0.45), (1.5, 0.84, 0.225), (1.5, 0.84, 0.15)];
const KNOB: [Circle; 4] =
    [(0.0, 0.0, 3.15), (0.8, 0.45, 3.15), (0.0, 0.0, 2.85), (0.2, 0.112, 2.7)];
const LID: [Circle; 4] =
    [(0.2, 0.112, 2.7), (0.4, 0.224, 2.55), (1.3, 0.728, 2.55), (1.3, 0.728, 2.4)];
const BOTTOM: [Circle; 4] =
    [(0.0, 0.0, 0.0), (1.425, 0.798, 0.0), (1.5, 0.84, 0.075), (1.5, 0.84, 0.15)];

const HANDLE: [Section; 7] = [
    ((-1.6, 2.025), (-1.5, 2.25), 0.3),
    ((-2.3, 2.025), (-2.5, 2.25), 0.3),
    ((-2.7, 2.025), (-3.0, 2.25), 0.3),
    ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ((-2.7, 1.575), (-3.0, 1.35), 0.3),
    ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
    ((-2.0, 0.9), (-1.9, 0.6), 0.3),
];
const SPOUT: [Section; 7] = [
    ((1.7, 1.425), (1.7, 0.6), 0.66),
    ((2.6, 1.425), (3.1, 0.825), 0.66),
    ((2.3, 2.1), (2.4, 2.025), 0.25),
    ((2.7, 2.4), (3.3, 2.4), 0.25),
    ((2.8, 2.475), (3.525, 2.49375), 0.25),
    ((2.9, 2.475), (3.45, 2.5125), 0.15),
    ((2.8, 2.4), (3.2, 2.4), 0.15),
];

/// Bernstein to power basis, highest power first; its own transpose.
const BEZIER: Matrix =
    [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 3.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]];

pub(super) fn primitives(size: u32) -> Option<u64> {
    // Two triangles a cell, without those that the knob's and the bottom's points squeeze to none.
    let n = u64::from(size);
    n.checked_mul(n)?.checked_mul(65)?.checked_sub(8 * n)
}

pub(super) fn generate(size: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    out.background(SKY)?;
    out.view(&looking([4.86, 7.2, 5.4], [0.0; 3], 1.0))?;
    out.light([-3.1, 9.8, 12.1])?;
    out.light([11.3, 5.1, 8.8])?;
    let board = Surface { color: [1.0; 3], kd: 0.5, ks: 0.5, highlight: 30.0, ..Surface::MATT };
    out.fill(&board.material())?;
    squares(size, 1, out)?;
    out.fill(&Surface { color: [0.5; 3], ..board }.material())?;
    squares(size, 0, out)?;
    let color = [1.0, 0.5, 0.1];
    let pot = Surface { color, kd: 0.75, ks: 0.25, highlight: 37.0, ..Surface::MATT };
    out.fill(&pot.material())?;
    for patch in patches() {
        tessellate(&patch, size, out)?;
    }
    Ok(())
}

/// The board's squares of one colour.
fn squares(size: u32, parity: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let place = |i: u32| 4.0 * (2.0 * f64::from(i) / f64::from(size) - 1.0);
    for x in 0..size {
        for y in (0..size).filter(|y| (x + y) % 2 == parity) {
            let (l, r, b, t) = (place(x), place(x + 1), place(y), place(y + 1));
            out.polygon(&[[l, b, 0.0], [r, b, 0.0], [r, t, 0.0], [l, t, 0.0]])?;
        }
    }
    Ok(())
}

fn patches() -> Vec<Patch> {
    let mut all = Vec::with_capacity(32);
    for profile in [&RIM, &UPPER_BODY, &LOWER_BODY] {
        all.extend((0..4).map(|quarter| revolved(profile, quarter, -1.0)));
    }
    for tube in [&HANDLE, &SPOUT] {
        for sections in [&tube[..4], &tube[3..]] {
            all.extend([-1.0, 1.0].map(|side| half_tube(sections, side)));
        }
    }
    for profile in [&KNOB, &LID] {
        all.extend((0..4).map(|quarter| revolved(profile, quarter, -1.0)));
    }
    all.extend((0..4).map(|quarter| revolved(&BOTTOM, quarter, 1.0)));
    all
}

/// A quarter of a body of revolution; `sense` is the way round, 1 counter-clockwise.
fn revolved(profile: &[Circle; 4], quarter: usize, sense: f64) -> Patch {
    profile.map(|(radius, handle, z)| {
        [(radius, 0.0), (radius, handle), (handle, radius), (0.0, radius)].map(|(x, y)| {
            let (x, y) = match quarter {
                0 => (x, y),
                1 => (-y, x),
                2 => (-x, -y),
                _ => (y, -x),
            };
            [x, sense * y, z]
        })
    })
}

/// One half of a stretch of handle or spout, by the sign of y; the two halves go round.
fn half_tube(sections: &[Section], side: f64) -> Patch {
    std::array::from_fn(|i| {
        let (inner, outer, width) = sections[i];
        let (first, last) = if side < 0.0 { (inner, outer) } else { (outer, inner) };
        let at = |(x, z): (f64, f64), y: f64| [x, side * y, z];
        [at(first, 0.0), at(first, width), at(last, width), at(last, 0.0)]
    })
}

/// Two triangles for each of `n` by `n` cells.
fn tessellate(patch: &Patch, n: u32, out: &mut NffWriter<'_>) -> io::Result<()> {
    let forms: [Matrix; 3] = std::array::from_fn(|axis| {
        let values: Matrix = std::array::from_fn(|r| std::array::from_fn(|c| patch[r][c][axis]));
        multiply(&multiply(&BEZIER, &values), &BEZIER)
    });
    let at = |i: u32| f64::from(i) / f64::from(n);
    for s in 0..n {
        for t in 0..n {
            let corners = [(s, t), (s, t + 1), (s + 1, t + 1), (s + 1, t)];
            for [a, b, c] in [[0, 1, 2], [2, 3, 0]] {
                let mut triangle = [a, b, c].map(|i: usize| {
                    let (s, t) = corners[i];
                    evaluate(&forms, at(s), at(t))
                });
                if mend_cusp(&mut triangle) {
                    out.patch(&triangle)?;
                }
            }
        }
    }
    Ok(())
}

/// Point and unit normal at parameters `s` (rows) and `t` (columns).
fn evaluate(forms: &[Matrix; 3], s: f64, t: f64) -> (Triple, Triple) {
    let powers = |x: f64| [x * x * x, x * x, x, 1.0];
    let slopes = |x: f64| [x * x * 3.0, x * 2.0, 1.0, 0.0];
    let value = |rows: [f64; 4], columns: [f64; 4]| -> Triple {
        std::array::from_fn(|axis| {
            let along = coord(&rows, &forms[axis]);
            along[0] * columns[0]
                + along[1] * columns[1]
                + along[2] * columns[2]
                + along[3] * columns[3]
        })
    };
    let along_s = value(slopes(s), powers(t));
    let along_t = value(powers(s), slopes(t));
    (value(powers(s), powers(t)), normalized(cross(along_t, along_s)))
}

/// Where a profile begins on the axis the surface has no normal: sets it. `false` for triangles
/// that have no area there.
fn mend_cusp(triangle: &mut [(Triple, Triple); 3]) -> bool {
    const NEAR: f64 = 0.0001;
    let mut on_axis = triangle.iter_mut().filter(|(p, _)| p[0].abs() < NEAR && p[1].abs() < NEAR);
    let Some((point, normal)) = on_axis.next() else { return true };
    *normal = [0.0, 0.0, if point[2] > 1.5 { 1.0 } else { -1.0 }];
    on_axis.next().is_none()
}
