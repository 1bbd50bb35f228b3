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

pub(super) fn plan(options: &Compare, names: &[String]) -> anyhow::Result<()> {
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
            // What is chosen is measured twice when it is one of the others, too.
            let same = |outcome: &&Outcome| structure(outcome) == structure(&outcomes[0]);
            let chosen = outcomes.iter().filter(same).map(longer).fold(f64::INFINITY, f64::min);
            worst = worst.max(chosen);
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
                chosen,
                others.join(", ")
            );
        }
    }
    println!("At worst the plan's choice takes {worst:.0} % longer.");
    Ok(())
}

/// What tells structures of a scene apart.
fn structure(outcome: &Outcome) -> Option<(&'static str, &'static str, usize)> {
    let report = outcome.as_ref()?;
    Some((report.accel.kind, report.accel.mailbox, report.memory.used_bytes))
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
