//! `sweep`: the same picture in less and more memory.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use kibiray::num::{Fixed, Real};
use kibiray::scene::Camera;
use kibiray::trace::Settings;
use serde::Serialize;

use super::stage::{self, Stage, TooLittle};
use crate::engine::Picture;
use crate::options::{Number, Sweep};
use crate::picture::{self, Rendered};
use crate::plot::{self, Curve};
use crate::report::{RaysReport, Report};
use crate::values::readable;

/// Memory is worth having up to where the picture takes this much longer than in the fastest.
const NEAR_ENOUGH: f64 = 1.1;

/// What one size of memory gives.
#[derive(Clone, Debug, Serialize)]
struct Row {
    ram: usize,
    /// None when the structure that was asked for has no room.
    #[serde(flatten)]
    report: Option<Report>,
}

impl Row {
    fn seconds(&self) -> Option<f64> {
        self.report.as_ref().map(|report| report.time.trace_cpu_s)
    }

    /// Work a ray: tests, steps.
    fn per_ray(&self) -> Option<(f64, f64)> {
        let report = self.report.as_ref()?;
        let rays = report.rays.total.max(1) as f64;
        Some((report.work.primitive_tests as f64 / rays, report.work.traversal_steps as f64 / rays))
    }
}

/// All of it.
#[derive(Debug, Serialize)]
struct Swept {
    rows: Vec<Row>,
    /// The least memory in which the picture takes at most a tenth longer than in the fastest.
    knee_ram: Option<usize>,
}

pub(super) fn run(options: &Sweep) -> anyhow::Result<()> {
    let output = options.output.clone().unwrap_or_else(|| default_output(&options.scene));
    super::check_folder(&output)?;
    let loaded = stage::open(&options.scene, &options.common)?;
    let (least, most) = options.ram;
    let sizes: Vec<_> = std::iter::successors(Some(least), |ram| ram.checked_mul(2))
        .take_while(|ram| *ram <= most)
        .collect();
    let bar = super::progress(sizes.len() as u64, "sizes");
    let mut rows = Vec::with_capacity(sizes.len());
    for ram in sizes {
        let mut report = None;
        let picture = Picture { width: options.size.0, ..Picture::NONE };
        let set = match options.common.num {
            Number::F64 => stage::set::<f64>(&loaded, &options.common, ram, picture, |it| {
                report = Some(trace(options, it)?);
                Ok(())
            }),
            Number::Fixed => stage::set::<Fixed>(&loaded, &options.common, ram, picture, |it| {
                report = Some(trace(options, it)?);
                Ok(())
            }),
            Number::F32 => stage::set::<f32>(&loaded, &options.common, ram, picture, |it| {
                report = Some(trace(options, it)?);
                Ok(())
            }),
        };
        match set {
            Err(error) if error.is::<TooLittle>() => {}
            set => set?,
        }
        rows.push(Row { ram, report });
        bar.inc(1);
    }
    bar.finish_and_clear();
    let swept = Swept { knee_ram: knee(&rows), rows };
    plot(&swept, &options.scene, &output)?;
    if let Some(json) = &options.common.json {
        let mut text = serde_json::to_vec_pretty(&swept)?;
        text.push(b'\n');
        super::write_to(json, &text)?;
    }
    let text = table(&swept, &output)?;
    if options.common.json_to_stdout() || super::is_dash(&output) {
        eprint!("{text}");
        return Ok(());
    }
    super::write_to("-".as_ref(), text.as_bytes())
}

/// `tetra.svg` for `spd:tetra:3` and for `scenes/tetra.nff`.
fn default_output(scene: &str) -> PathBuf {
    super::named_after(scene).with_extension("svg")
}

fn trace<R: Real>(options: &Sweep, stage: Stage<'_, R>) -> anyhow::Result<Report> {
    let Stage { tables, scene, built, mut report, .. } = stage;
    let (width, height) = options.size;
    let camera = Camera::new(tables.view(), R::fraction(width.into(), height.into()))?;
    // One pass to count, at least one for the time.
    let repeat = options.common.repeat + 1;
    let bar = ProgressBar::hidden();
    let Rendered { counters, pass, .. } =
        picture::render(scene, built, camera, Settings::default(), options.size, repeat, &bar);
    report.traced(RaysReport::of(&counters), &counters, pass);
    Ok(report)
}

fn knee(rows: &[Row]) -> Option<usize> {
    let fastest = rows.iter().filter_map(Row::seconds).fold(f64::INFINITY, f64::min);
    let near = |row: &&Row| row.seconds().is_some_and(|s| s <= fastest * NEAR_ENOUGH);
    rows.iter().find(near).map(|row| row.ram)
}

fn table(swept: &Swept, output: &Path) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    writeln!(
        text,
        "{:>9}  {:7} {:>10} {:>10} {:>12} {:>9} {:>9} {:>9}",
        "memory", "by", "used", "most", "level/cells", "tests", "steps", "time"
    )?;
    for row in &swept.rows {
        write!(text, "{:>9}  ", readable(row.ram))?;
        let (Some(report), Some((tests, steps))) = (&row.report, row.per_ray()) else {
            writeln!(text, "too little")?;
            continue;
        };
        let accel = &report.accel;
        let fineness = match (accel.max_level, accel.resolution) {
            (Some(level), _) => level.to_string(),
            (_, Some([x, y, z])) => format!("{x}x{y}x{z}"),
            _ => "-".into(),
        };
        let knee = if Some(row.ram) == swept.knee_ram { "  <- knee" } else { "" };
        writeln!(
            text,
            "{:7} {:>10} {:>10} {fineness:>12} {tests:>9.2} {steps:>9.2} {:>6.1} ms{knee}",
            accel.kind,
            report.memory.used_bytes,
            report.memory.high_water_bytes,
            1e3 * report.time.trace_cpu_s,
        )?;
    }
    if let Some(knee) = swept.knee_ram {
        let knee = readable(knee);
        writeln!(text, "More memory than {knee} makes the picture at most a tenth faster.")?;
    }
    writeln!(text, "plot: {}", output.display())?;
    Ok(text)
}

fn plot(swept: &Swept, scene: &str, output: &Path) -> anyhow::Result<()> {
    let curve = |name: &str, value: &dyn Fn(&Row) -> Option<f64>| Curve {
        name: name.into(),
        points: swept
            .rows
            .iter()
            .filter_map(|row| Some((row.ram as f64 / 1024.0, value(row)?)))
            .filter(|(_, y)| *y > 0.0)
            .collect(),
    };
    let curves = [
        curve("time, ms", &|row| row.seconds().map(|s| 1e3 * s)),
        curve("tests a ray", &|row| row.per_ray().map(|(tests, _)| tests)),
        curve("steps a ray", &|row| row.per_ray().map(|(_, steps)| steps)),
        curve("used, KiB", &|row| Some(row.report.as_ref()?.memory.used_bytes as f64 / 1024.0)),
    ];
    let svg = plot::log_log(
        scene,
        "KiB of memory",
        &curves,
        swept.knee_ram.map(|ram| ram as f64 / 1024.0),
    )?;
    super::write_to(output, svg.as_bytes())
}
