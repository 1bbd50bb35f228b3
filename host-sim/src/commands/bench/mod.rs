//! `bench`: time against error, over number formats, structures, memory and ways to sample.

mod boards;
mod picture;
mod query;
mod table;

use std::path::Path;

use anyhow::Context as _;
use clap::{Parser, ValueEnum};
use kibiray::num::Fixed;
use serde::Serialize;

use super::stage::{self, Loaded};
use crate::options::{Antialiasing, Bench, Common, Number};
use crate::plot;

/// All of it.
#[derive(Debug, Serialize)]
struct Report {
    scenes: Vec<SceneReport>,
    boards: Vec<boards::Row>,
}

/// What is measured of a scene. Times are processor time, in parts of that of another row.
#[derive(Debug, Serialize)]
struct SceneReport {
    name: String,
    primitives: usize,
    queries: Vec<query::Row>,
    pictures: Vec<picture::Row>,
    findings: Vec<picture::Findings>,
}

/// The options that all commands share, at their defaults.
#[derive(Parser)]
struct Defaults {
    #[command(flatten)]
    common: Common,
}

pub(super) fn run(options: &Bench) -> anyhow::Result<()> {
    super::check_folder(&options.output)?;
    let mut options = options.clone();
    if options.num.is_empty() {
        options.num = Number::value_variants().to_vec();
    }
    let common = Defaults::try_parse_from(["bench"])?.common;
    let combinations = options.num.len()
        * (options.accel.len() * options.ram.len() + options.aa.len() * options.cutoff.len() + 1);
    let bar = super::progress((options.scenes.len() * (combinations + 1)) as u64, "measurements");
    let boards = match &options.boards {
        Some(file) => boards::rows(
            &std::fs::read_to_string(file).with_context(|| file.display().to_string())?,
        ),
        None => Vec::new(),
    };
    let mut report = Report { scenes: Vec::new(), boards };
    for name in &options.scenes {
        let loaded = stage::open(name, &common)?;
        let mut queries = Vec::new();
        for num in &options.num {
            for accel in &options.accel {
                for ram in &options.ram {
                    let common = Common { num: *num, accel: *accel, ..common.clone() };
                    queries.push(query_row(&options, &loaded, &common, *ram)?);
                    bar.inc(1);
                }
            }
        }
        query::relate(&mut queries);
        let reference = picture::reference(&options, &loaded, &common)?;
        bar.inc(1);
        let (mut pictures, mut by_depth) = (Vec::new(), Vec::new());
        for num in &options.num {
            let shoot = |aa, cutoff, adaptive_recursion| {
                let way = picture::Way { num: *num, aa, cutoff, adaptive_recursion };
                picture::row(&options, &loaded, &common, way, &reference)
            };
            for aa in &options.aa {
                for cutoff in &options.cutoff {
                    pictures.push(shoot(*aa, *cutoff, true)?);
                    bar.inc(1);
                }
            }
            by_depth.push(shoot(Antialiasing::Off, 0.0, false)?);
            bar.inc(1);
        }
        picture::relate(&mut pictures);
        let findings = picture::findings(&pictures, &by_depth);
        let primitives = loaded.description.items.len();
        report.scenes.push(SceneReport {
            name: name.clone(),
            primitives,
            queries,
            pictures,
            findings,
        });
    }
    bar.finish_and_clear();
    write(&options, &report)
}

fn query_row(
    options: &Bench,
    loaded: &Loaded,
    common: &Common,
    ram: usize,
) -> anyhow::Result<query::Row> {
    match common.num {
        Number::F32 => query::row::<f32>(options, loaded, common, ram),
        Number::F64 => query::row::<f64>(options, loaded, common, ram),
        Number::Fixed => query::row::<Fixed>(options, loaded, common, ram),
    }
}

/// The table, JSON and plots.
fn write(options: &Bench, report: &Report) -> anyhow::Result<()> {
    let named = |end: &str| {
        let mut name = options.output.as_os_str().to_owned();
        name.push(end);
        std::path::PathBuf::from(name)
    };
    let mut json = serde_json::to_vec_pretty(report)?;
    json.push(b'\n');
    super::write_to(&named(".json"), &json)?;
    let text = table::markdown(options, report)?;
    super::write_to(&named(".md"), text.as_bytes())?;
    for scene in &report.scenes {
        let svg = picture::plot(scene)?;
        let short = super::named_after(&scene.name);
        let short = short.to_string_lossy();
        super::write_to(&named(&format!("-{short}.svg")), svg.as_bytes())?;
        super::write_to(&named(&format!("-{short}.png")), &plot::png(&svg)?)?;
    }
    super::write_to(Path::new("-"), text.as_bytes())
}

/// What a number format is called on the command line.
fn name_of(value: &impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}
