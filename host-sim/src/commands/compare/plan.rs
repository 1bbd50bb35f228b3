//! Choices of the plan against every fixed one.

use super::{Choice, Outcome, UNLIMITED, measure, once, open, seconds};
use crate::commands::stage::Loaded;
use crate::options::{AccelKind, Compare, Growth};
use crate::values::readable;

/// Testing every shape is a choice up to so many.
const MOST_NAIVE: usize = 200;

/// The structures that the plan could have chosen.
pub(super) fn fixed(shapes: usize, ram: usize) -> Vec<Choice> {
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

/// Choices that take so many times as long as the best on a small picture are not measured on a larger one.
const HOPELESS: f64 = 4.0;

pub(super) fn plan(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    println!("How much longer a picture takes than with the best structure, in time.\n");
    println!("| scene | memory | chosen | longer | the others |\n|---|---|---|---:|---|");
    let mut worst = 0.0_f64;
    for name in names {
        let loaded = open(name)?;
        for ram in [16 << 10, 64 << 10, 256 << 10, UNLIMITED] {
            let memory = if ram == UNLIMITED { "unlimited".into() } else { readable(ram) };
            let auto = Choice::of(AccelKind::Auto, ram);
            let mut choices = vec![];
            let mut others = vec![];
            let fixed = fixed(loaded.description.items.len(), ram);
            let quick = quick(options, &loaded, &fixed)?;
            let best = quick.iter().map(seconds).fold(f64::INFINITY, f64::min);
            for (choice, outcome) in fixed.into_iter().zip(&quick) {
                let times = seconds(outcome) / best;
                if times < HOPELESS {
                    choices.push(choice);
                } else if outcome.is_some() {
                    others.push(format!("{} {times:.0} times as long", choice.name));
                } else {
                    others.push(format!("{} too little", choice.name));
                }
            }
            if choices.is_empty() {
                println!("| {name} | {memory} | naive | | nothing else fits |");
                continue;
            }
            choices.insert(0, auto);
            let outcomes = measure(options, &loaded, &choices)?;
            let best = outcomes.iter().map(seconds).fold(f64::INFINITY, f64::min);
            let longer = |outcome: &Outcome| 100.0 * (seconds(outcome) / best - 1.0);
            // What is chosen is measured twice when it is one of the others, too.
            let same = |outcome: &&Outcome| structure(outcome) == structure(&outcomes[0]);
            let chosen = outcomes.iter().filter(same).map(longer).fold(f64::INFINITY, f64::min);
            worst = worst.max(chosen);
            let measured = choices.iter().zip(&outcomes).skip(1);
            let measured: Vec<_> = measured
                .map(|(choice, outcome)| format!("{} {:.0} %", choice.name, longer(outcome)))
                .collect();
            println!(
                "| {name} | {memory} | {} | {chosen:.0} % | {} |",
                outcomes[0].as_ref().map_or("none", |report| report.accel.kind),
                [measured, others].concat().join(", ")
            );
        }
    }
    println!("\nAt worst the plan's choice takes {worst:.0} % longer.");
    Ok(())
}

/// What tells structures of a scene apart.
fn structure(outcome: &Outcome) -> Option<(&'static str, &'static str, usize)> {
    let report = outcome.as_ref()?;
    Some((report.accel.kind, report.accel.mailbox, report.memory.used_bytes))
}

/// A quarter of the picture's width and height.
fn quick(options: &Compare, loaded: &Loaded, choices: &[Choice]) -> anyhow::Result<Vec<Outcome>> {
    let (width, height) = options.size;
    let small = Compare { size: (width.div_ceil(4), height.div_ceil(4)), ..options.clone() };
    choices.iter().map(|choice| once(&small, loaded, choice)).collect()
}
