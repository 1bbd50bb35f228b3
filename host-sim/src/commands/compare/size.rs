//! Cost against size: the same picture of more and more shapes.

use super::{Choice, UNLIMITED, measure, open};
use crate::options::{AccelKind, Compare};

/// Scenes and their size factors: from some thousand shapes to a million.
const SCENES: [(&str, std::ops::RangeInclusive<u32>); 2] = [("balls", 3..=6), ("tetra", 5..=10)];

const STRUCTURES: [AccelKind; 4] =
    [AccelKind::Auto, AccelKind::Grid, AccelKind::Octree, AccelKind::Bvh];

pub(super) fn size(options: &Compare) -> anyhow::Result<()> {
    println!(
        "Pictures of the same view of more and more shapes, unlimited memory; processor time."
    );
    println!("Building includes planning.\n");
    println!(
        "| scene | shapes | structure | µs a ray | tests a ray | steps a ray | bytes a shape | \
         build, µs a reference |\n|---|---:|---|---:|---:|---:|---:|---:|"
    );
    let choices = STRUCTURES.map(|accel| Choice::of(accel, UNLIMITED));
    for (name, sizes) in SCENES {
        let mut points = vec![vec![]; choices.len()];
        for size in sizes {
            let loaded = open(&format!("spd:{name}:{size}"))?;
            let shapes = loaded.description.items.len() as f64;
            let outcomes = measure(options, &loaded, &choices)?;
            for ((choice, outcome), points) in choices.iter().zip(outcomes).zip(&mut points) {
                let Some(report) = outcome else { continue };
                let (rays, work) = (report.rays.total as f64, &report.work);
                let time = 1e6 * report.time.trace_cpu_s / rays;
                println!(
                    "| {name} | {shapes} | {} | {time:.2} | {:.1} | {:.1} | {:.1} | {:.2} |",
                    choice.name,
                    work.primitive_tests as f64 / rays,
                    work.traversal_steps as f64 / rays,
                    report.memory.used_bytes as f64 / shapes,
                    1e6 * report.time.build_cpu_s / report.accel.references.unwrap_or(1) as f64,
                );
                points.push((shapes, time));
            }
        }
        for (choice, points) in choices.iter().zip(&points) {
            let slope = slope(points);
            println!("| **{name}** | slope | {} | {slope:.2} | | | | |", choice.name);
        }
    }
    Ok(())
}

/// The exponent of the power law that fits points best, in least squares of logarithms.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs = || points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let n = points.len() as f64;
    let mean = logs().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let (along, square) = logs().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mean.0) * (p.1 - mean.1), s.1 + (p.0 - mean.0).powi(2))
    });
    along / square
}
