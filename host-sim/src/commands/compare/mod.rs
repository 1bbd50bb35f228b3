//! `compare`: choices against each other on the same pictures, in turn, so that what else the
//! machine does hits all of them alike.

mod budget;
mod pairs;
mod plan;
mod size;

use clap::Parser;
use indicatif::ProgressBar;
use kibiray::scene::Camera;
use kibiray::trace::Settings;

use super::stage::{self, Loaded, Stage, TooLittle};
use crate::engine::Picture;
use crate::options::{AccelKind, Cli, Command, Common, Compare, Table};
use crate::picture::{self, Rendered};
use crate::report::{RaysReport, Report};

const SCENES: [&str; 11] = [
    "balls", "gears", "mount", "rings", "teapot", "tetra", "tree", "lattice", "shells", "sombrero",
    "jacks",
];

/// More than any structure takes.
const UNLIMITED: usize = 1 << 30;

/// One of the choices.
#[derive(Clone)]
struct Choice {
    name: String,
    common: Common,
    settings: Settings<f32>,
    ram: usize,
}

impl Choice {
    fn new(name: impl Into<String>, ram: usize, change: impl FnOnce(&mut Common)) -> Self {
        let Ok(Cli { command: Some(Command::Sweep(sweep)) }) =
            Cli::try_parse_from(["host-sim", "sweep", "none"])
        else {
            unreachable!("these are valid arguments")
        };
        let mut common = sweep.common;
        change(&mut common);
        Self { name: name.into(), common, settings: Settings::default(), ram }
    }

    fn of(accel: AccelKind, ram: usize) -> Self {
        let name = match accel {
            AccelKind::Auto => "auto",
            AccelKind::Naive => "naive",
            AccelKind::Grid => "grid",
            AccelKind::Octree => "octree",
            _ => "bvh",
        };
        Self::new(name, ram, |common| common.accel = accel)
    }
}

/// What a choice came to; none where its structure has no room.
type Outcome = Option<Report>;

fn seconds(outcome: &Outcome) -> f64 {
    outcome.as_ref().map_or(f64::INFINITY, |report| report.time.trace_cpu_s)
}

fn geometric_mean(values: &[f64]) -> f64 {
    (values.iter().map(|value| value.ln()).sum::<f64>() / values.len().max(1) as f64).exp()
}

pub(super) fn run(options: &Compare) -> anyhow::Result<()> {
    let names: Vec<String> = match &options.scenes[..] {
        [] => SCENES.iter().map(|name| format!("spd:{name}")).collect(),
        names => names.to_vec(),
    };
    match options.table {
        Table::Plan => plan::plan(options, &names),
        Table::Budget => budget::budget(options, &names),
        Table::Growth => pairs::growth(options, &names),
        Table::Overlap => pairs::overlap(options, &names),
        Table::Lists => pairs::lists(options, &names),
        Table::Skips => pairs::skips(options, &names),
        Table::Stores => pairs::stores(options, &names),
        Table::Size => size::size(options),
    }
}

/// Measures all choices, in turn, round by round.
fn measure(options: &Compare, loaded: &Loaded, choices: &[Choice]) -> anyhow::Result<Vec<Outcome>> {
    let bar = super::progress(u64::from(options.rounds) * choices.len() as u64, "measurements");
    let mut outcomes: Vec<Outcome> = vec![None; choices.len()];
    for _ in 0..options.rounds {
        for (choice, best) in choices.iter().zip(&mut outcomes) {
            let outcome = once(options, loaded, choice)?;
            if best.is_none() || seconds(&outcome) < seconds(best) {
                *best = outcome;
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(outcomes)
}

fn once(options: &Compare, loaded: &Loaded, choice: &Choice) -> anyhow::Result<Outcome> {
    let (width, height) = options.size;
    let picture = Picture { width, ..Picture::NONE };
    let mut outcome = None;
    let set = stage::set::<f32>(loaded, &choice.common, choice.ram, picture, |stage| {
        let Stage { tables, scene, built, mut report, .. } = stage;
        let camera = Camera::new(tables.view(), f32::from(width) / f32::from(height))?;
        let bar = ProgressBar::hidden();
        // One pass to count, two for the time.
        let Rendered { counters, pass, .. } =
            picture::render(scene, built, camera, choice.settings, options.size, 3, &bar);
        report.traced(RaysReport::of(&counters), &counters, pass);
        outcome = Some(report);
        Ok(())
    });
    match set {
        Err(error) if error.is::<TooLittle>() => Ok(None),
        set => set.map(|()| outcome),
    }
}

fn open(name: &str) -> anyhow::Result<Loaded> {
    stage::open(name, &Choice::of(AccelKind::Auto, 0).common)
}
