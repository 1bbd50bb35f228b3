//! `compare`: choices against each other on the same pictures, in turn, so that what else the
//! machine does hits all of them alike.

use clap::Parser;
use indicatif::ProgressBar;
use kibiray::scene::Camera;
use kibiray::trace::{Secondary, Settings};

use super::stage::{self, Loaded, Stage, TooLittle};
use crate::engine::Picture;
use crate::options::{
    AccelKind, Cli, Command, Common, Compare, Growth, Huge, MailboxKind, Overlap, Store, Switch,
    Table,
};
use crate::picture::{self, Rendered};
use crate::report::{RaysReport, Report};
use crate::values::readable;

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

/// Tests and steps.
fn work(outcome: &Outcome) -> f64 {
    outcome
        .as_ref()
        .map_or(f64::INFINITY, |it| (it.work.primitive_tests + it.work.traversal_steps) as f64)
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
        Table::Plan => plan(options, &names),
        Table::Budget => budget(options, &names),
        Table::Growth => growth(options, &names),
        Table::Overlap => overlap(options, &names),
        Table::Skips => skips(options, &names),
        Table::Stores => stores(options, &names),
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

/// Testing every shape is a choice up to so many.
const MOST_NAIVE: usize = 200;

/// The structures that the plan could have chosen.
fn fixed(shapes: usize, ram: usize) -> Vec<Choice> {
    let benefit = Choice::new("octree, benefit", ram, |common| {
        common.accel = AccelKind::Octree;
        common.growth = Some(Growth::Benefit);
    });
    let mut choices: Vec<_> = [AccelKind::Grid, AccelKind::Octree, AccelKind::Bvh]
        .map(|accel| Choice::of(accel, ram))
        .into();
    choices.push(benefit);
    if shapes <= MOST_NAIVE {
        choices.push(Choice::of(AccelKind::Naive, ram));
    }
    choices
}

fn plan(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    println!("How much longer a picture takes than with the best structure, in time:");
    println!("{:14} {:>9}  {:7} {:>6}   the others", "scene", "memory", "chosen", "longer");
    let mut worst = 0.0_f64;
    for name in names {
        let loaded = open(name)?;
        for ram in [16 << 10, 64 << 10, 256 << 10, UNLIMITED] {
            let mut choices = fixed(loaded.description.items.len(), ram);
            if ram < UNLIMITED && !any_fits(options, &loaded, &choices)? {
                println!("{name:14} {:>9}  only testing every shape needs no more", readable(ram));
                continue;
            }
            choices.insert(0, Choice::of(AccelKind::Auto, ram));
            let outcomes = measure(options, &loaded, &choices)?;
            let best = outcomes.iter().map(seconds).fold(f64::INFINITY, f64::min);
            let longer = |outcome: &Outcome| 100.0 * (seconds(outcome) / best - 1.0);
            worst = worst.max(longer(&outcomes[0]));
            let others: Vec<_> = choices
                .iter()
                .zip(&outcomes)
                .skip(1)
                .map(|(choice, outcome)| match outcome {
                    Some(_) => format!("{} {:.0} %", choice.name, longer(outcome)),
                    None => format!("{} too little", choice.name),
                })
                .collect();
            println!(
                "{name:14} {:>9}  {:7} {:4.0} %   {}",
                if ram == UNLIMITED { "unlimited".into() } else { readable(ram) },
                outcomes[0].as_ref().map_or("none", |report| report.accel.kind),
                longer(&outcomes[0]),
                others.join(", ")
            );
        }
    }
    println!("At worst the plan's choice takes {worst:.0} % longer.");
    Ok(())
}

/// Whether any of the choices has room.
fn any_fits(options: &Compare, loaded: &Loaded, choices: &[Choice]) -> anyhow::Result<bool> {
    let point = Compare { size: (1, 1), ..options.clone() };
    for choice in choices {
        if once(&point, loaded, choice)?.is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The least size of a generated scene with some 1,000 shapes, of those there are the nearest.
fn of_thousand(name: &str) -> anyhow::Result<Loaded> {
    let mut best: Option<Loaded> = None;
    let off = |it: &Loaded| (it.description.items.len() as f64 / 1000.0).ln().abs();
    for size in 1..=20 {
        let Ok(loaded) = open(&format!("{name}:{size}")) else { continue };
        let shapes = loaded.description.items.len();
        if best.as_ref().is_none_or(|best| off(&loaded) < off(best)) {
            best = Some(loaded);
        }
        if shapes > 1000 {
            break;
        }
    }
    best.map_or_else(|| open(name), Ok)
}

fn budget(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let structures = |ram: usize| {
        let mut choices = fixed(usize::MAX, ram);
        choices.insert(0, Choice::of(AccelKind::Auto, ram));
        choices
    };
    println!("Speed as a share of that with unlimited memory, and the most that was taken while");
    println!("building over what stays:");
    println!(
        "{:14} {:16} {:>12} {:>12} {:>12}",
        "scene", "structure", "12 a shape", "24 a shape", "most/stays"
    );
    let mut shares = vec![(vec![], vec![]); 5];
    for name in names {
        let loaded = open(name)?;
        let shapes = loaded.description.items.len();
        let budgets = [12 * shapes, 24 * shapes, UNLIMITED];
        let choices: Vec<_> = budgets.into_iter().flat_map(structures).collect();
        let outcomes = measure(options, &loaded, &choices)?;
        for (i, share) in shares.iter_mut().enumerate() {
            let [few, more, all] = [0, 1, 2].map(|budget| &outcomes[5 * budget + i]);
            let of_all = |outcome: &Outcome| seconds(all) / seconds(outcome);
            let most = [few, more, all]
                .into_iter()
                .flatten()
                .map(|it| it.memory.high_water_bytes as f64 / it.memory.used_bytes.max(1) as f64);
            println!(
                "{name:14} {:16} {:10.0} % {:10.0} % {:12.2}",
                choices[i].name,
                100.0 * of_all(few),
                100.0 * of_all(more),
                most.fold(0.0, f64::max),
            );
            if few.is_some() {
                share.0.push(of_all(few));
            }
            if more.is_some() {
                share.1.push(of_all(more));
            }
        }
    }
    for (choice, (few, more)) in structures(0).iter().zip(&shares) {
        let (few, more) = (100.0 * geometric_mean(few), 100.0 * geometric_mean(more));
        println!("{:14} {:16} {few:10.0} % {more:10.0} %", "mean", choice.name);
    }
    println!();
    println!("64 KiB for everything, scenes of some 1,000 shapes, speed as such a share:");
    for name in names {
        let loaded = of_thousand(name)?;
        let choices: Vec<_> = [64 << 10, UNLIMITED].into_iter().flat_map(structures).collect();
        let outcomes = measure(options, &loaded, &choices)?;
        let shares: Vec<_> = (0..5)
            .map(|i| {
                let share = seconds(&outcomes[5 + i]) / seconds(&outcomes[i]);
                format!("{} {:.0} %", choices[i].name, 100.0 * share)
            })
            .collect();
        println!("{name:14} {:5} shapes: {}", loaded.description.items.len(), shares.join(", "));
    }
    Ok(())
}

/// Prints for every scene what a choice takes in parts of what the other one does.
fn pairs(
    options: &Compare,
    names: &[String],
    title: &str,
    variants: &[(String, [Choice; 2])],
) -> anyhow::Result<()> {
    println!("{title}");
    println!(
        "{:14} {:24} {:>8} {:>8} {:>8} {:>10} {:>8} {:>8}",
        "scene", "", "tests", "steps", "both", "references", "bytes", "time"
    );
    for (what, choices) in variants {
        let mut all = vec![];
        for name in names {
            let loaded = open(name)?;
            let choices = choices.clone().map(|choice| {
                let per_shape = choice.ram < 1 << 10;
                let shapes = loaded.description.items.len();
                Choice { ram: if per_shape { choice.ram * shapes } else { choice.ram }, ..choice }
            });
            let outcomes = measure(options, &loaded, &choices)?;
            let [Some(a), Some(b)] = &outcomes[..] else { continue };
            let ratio = |f: &dyn Fn(&Report) -> f64| f(b) / f(a).max(1.0);
            let both = work(&outcomes[1]) / work(&outcomes[0]).max(1.0);
            let stopped = a.accel.stopped_by == Some("memory");
            println!(
                "{name:14} {what:24} {:8.3} {:8.3} {both:8.3} {:10.3} {:8.3} {:8.3}{}",
                ratio(&|it| it.work.primitive_tests as f64),
                ratio(&|it| it.work.traversal_steps as f64),
                ratio(&|it| it.accel.references.unwrap_or(0) as f64),
                ratio(&|it| it.memory.used_bytes as f64),
                b.time.trace_cpu_s / a.time.trace_cpu_s,
                if stopped { "  (stopped by memory)" } else { "" }
            );
            all.push((both, b.time.trace_cpu_s / a.time.trace_cpu_s));
        }
        let mean =
            |f: &dyn Fn(&(f64, f64)) -> f64| geometric_mean(&all.iter().map(f).collect::<Vec<_>>());
        println!("{:14} {what:24} {:>26.3} {:>28.3}", "mean", mean(&|it| it.0), mean(&|it| it.1));
    }
    Ok(())
}

fn octree(ram: usize, change: impl FnOnce(&mut Common)) -> Choice {
    Choice::new("octree", ram, |common| {
        common.accel = AccelKind::Octree;
        change(common);
    })
}

fn growth(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let of = |ram, growth| octree(ram, |common| common.growth = Some(growth));
    let variants = [12, 24].map(|ram| {
        (format!("{ram} bytes a shape"), [Growth::Fifo, Growth::Benefit].map(|it| of(ram, it)))
    });
    pairs(
        options,
        names,
        "Octrees divided by benefit, in parts of those first in, first out:",
        &variants,
    )
}

fn overlap(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let of = |accel, overlap| {
        Choice::new("", 1 << 20, |common| {
            common.accel = accel;
            common.overlap = Some(overlap);
        })
    };
    let variants = [(AccelKind::Grid, "grid, 1 MiB"), (AccelKind::Octree, "octree, 1 MiB")].map(
        |(accel, name)| (name.to_owned(), [Overlap::Box, Overlap::Exact].map(|it| of(accel, it))),
    );
    pairs(options, names, "Exact lists, in parts of those by boxes:", &variants)
}

fn stores(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let of = |store| octree(UNLIMITED, |common| common.store = Some(store));
    let variants = [("hash table".to_owned(), [Store::Links, Store::Hash].map(of))];
    pairs(options, names, "Ways to store an octree, in parts of linked cells:", &variants)
}

fn skips(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let grid = |common: &mut Common| common.accel = AccelKind::Grid;
    let auto = || Choice::of(AccelKind::Auto, 256 << 10);
    let on_grid = |change: &dyn Fn(&mut Common)| {
        Choice::new("", 1 << 20, |common| {
            grid(common);
            change(common);
        })
    };
    let without = |change: &dyn Fn(&mut Settings<f32>)| {
        let mut choice = auto();
        change(&mut choice.settings);
        choice
    };
    let variants = [
        (
            "rays that add nothing",
            [auto(), without(&|settings| settings.secondary = Secondary::All)],
        ),
        ("last occluder first", [auto(), without(&|settings| settings.shadow_cache = false)]),
        ("below 1/512, not skipped", [without(&|settings| settings.cutoff = 1.0 / 512.0), auto()]),
        (
            "grid: empty space",
            [on_grid(&|_| {}), on_grid(&|common| common.macro_cells = Some(Switch::Off))],
        ),
        (
            "grid: huge ones aside",
            [on_grid(&|_| {}), on_grid(&|common| common.huge = Some(Huge::Inside))],
        ),
        (
            "grid: already tested",
            [on_grid(&|_| {}), on_grid(&|common| common.mailbox = MailboxKind::Off)],
        ),
        (
            "grid: not in the cell",
            [on_grid(&|_| {}), on_grid(&|common| common.overlap = Some(Overlap::Box))],
        ),
    ]
    .map(|(name, choices)| (name.to_owned(), choices));
    pairs(options, names, "Without each way to skip work, in parts of with it:", &variants)
}
