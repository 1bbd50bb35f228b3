//! Cost against size: the same picture of more and more shapes.

use crate::contest::progress;
use crate::frames::output;
use anyhow::{Context, Result};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// Scenes and their size factors: from some hundred shapes to a million.
const SCENES: [(&str, std::ops::RangeInclusive<u32>); 2] = [("balls", 2..=6), ("tetra", 4..=10)];

/// Of two runs the faster counts.
const REPEAT: usize = 2;

/// A line a scene and size, as the plan has it with memory for everything.
pub fn run(host_sim: &Path) -> Result<Vec<Value>> {
    let folder = tempfile::tempdir()?;
    let bar = progress(SCENES.iter().map(|(_, sizes)| sizes.clone().count()).sum());
    let mut lines = vec![];
    for (name, sizes) in SCENES {
        for size in sizes {
            let scene = format!("spd:{name}:{size}");
            bar.set_message(scene.clone());
            let mut best = [f64::INFINITY; 2];
            let mut report = Value::Null;
            for _ in 0..REPEAT {
                let arguments = ["stats", &scene, "--ram", "1GiB"];
                let said = output(Command::new(host_sim).args(arguments), folder.path())?.0;
                report = serde_json::from_str(&said)?;
                for (best, key) in best.iter_mut().zip(["trace_cpu_s", "build_s"]) {
                    *best = best.min(report["time"][key].as_f64().with_context(|| key)?);
                }
            }
            let number = |a: &str, b: &str| report[a][b].as_f64().unwrap_or(f64::NAN);
            let (shapes, rays) = (number("scene", "primitives"), number("rays", "total"));
            lines.push(json!({
                "scene": name, "shapes": shapes, "structure": report["accel"]["kind"],
                "us_per_ray": best[0] / rays * 1e6,
                "tests_per_ray": number("work", "primitive_tests") / rays,
                "steps_per_ray": number("work", "traversal_steps") / rays,
                "bytes_per_shape": number("memory", "used_bytes") / shapes,
                "bytes_per_shape_peak": number("memory", "high_water_bytes") / shapes,
                "build_us_per_reference": best[1] / number("accel", "references") * 1e6,
            }));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(lines)
}

/// Exponent of the power law that fits points best, in the sense of least squares of logarithms.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let mean = logs.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let sums = logs.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mean.0) * (p.1 - mean.1), s.1 + (p.0 - mean.0).powi(2))
    });
    sums.0 / sums.1
}
