//! Speed in few bytes a shape, as a share of that in ample memory.

use super::plan::fixed;
use super::{Choice, Outcome, UNLIMITED, geometric_mean, measure, open, seconds};
use crate::commands::stage::Loaded;
use crate::options::{AccelKind, Compare};

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

pub(super) fn budget(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let structures = |ram: usize| {
        let mut choices = fixed(usize::MAX, ram);
        choices.insert(0, Choice::of(AccelKind::Auto, ram));
        choices
    };
    println!("Speed as a share of that with unlimited memory, and the most that was taken while");
    println!("building over what stays.\n");
    println!("| scene | structure | 12 bytes a shape | 24 bytes a shape | most / stays |");
    println!("|---|---|---:|---:|---:|");
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
                "| {name} | {} | {:.0} % | {:.0} % | {:.2} |",
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
        println!("| **mean** | {} | {few:.0} % | {more:.0} % | |", choice.name);
    }
    println!("\n64 KiB for everything, scenes of some 1,000 shapes, speed as such a share.\n");
    let titles: Vec<_> = structures(0).into_iter().map(|choice| choice.name).collect();
    println!("| scene | shapes | {} |\n|---|---:|{}", titles.join(" | "), "---:|".repeat(5));
    for name in names {
        let loaded = of_thousand(name)?;
        let choices: Vec<_> = [64 << 10, UNLIMITED].into_iter().flat_map(structures).collect();
        let outcomes = measure(options, &loaded, &choices)?;
        let shares: Vec<_> = (0..5)
            .map(|i| {
                let share = seconds(&outcomes[5 + i]) / seconds(&outcomes[i]);
                format!("{:.0} %", 100.0 * share)
            })
            .collect();
        println!("| {name} | {} | {} |", loaded.description.items.len(), shares.join(" | "));
    }
    Ok(())
}
