//! One choice in parts of another.

use kibiray::trace::{Secondary, Settings};

use super::{Choice, UNLIMITED, geometric_mean, measure, open, work};
use crate::options::{AccelKind, Common, Compare, Growth, ListKind, Overlap, Skip, Store};
use crate::report::Report;

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

pub(super) fn growth(options: &Compare, names: &[String]) -> anyhow::Result<()> {
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

pub(super) fn overlap(options: &Compare, names: &[String]) -> anyhow::Result<()> {
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

pub(super) fn stores(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let of = |store| octree(UNLIMITED, |common| common.store = Some(store));
    let variants = [("hash table", Store::Hash), ("implicit", Store::Implicit)]
        .map(|(name, store)| (name.to_owned(), [Store::Links, store].map(of)));
    pairs(options, names, "Ways to store an octree, in parts of linked cells:", &variants)
}

/// Equal lists stored once, and skipped as a whole.
pub(super) fn lists(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let of = |ram, lists: ListKind| octree(ram, |common| common.lists = Some(lists));
    let variants = [(12, "12 bytes a shape"), (24, "24 bytes a shape"), (UNLIMITED, "unlimited")]
        .map(|(ram, name)| {
            (name.to_owned(), [ListKind::Own, ListKind::Shared].map(|it| of(ram, it)))
        });
    pairs(options, names, "Shared lists, in parts of every leaf its own:", &variants)
}

pub(super) fn skips(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let auto = |common: &mut Common| common.accel = AccelKind::Auto;
    let grid = |common: &mut Common| common.accel = AccelKind::Grid;
    let shared = |common: &mut Common| {
        common.accel = AccelKind::Octree;
        common.lists = Some(ListKind::Shared);
    };
    let pair = |ram, on: &dyn Fn(&mut Common), skip| {
        [vec![], vec![skip]].map(|no_skip| {
            let mut choice = Choice::new("", ram, |common| {
                on(common);
                common.no_skip = no_skip;
            });
            let all = &choice.common.no_skip;
            if all.contains(&Skip::Contribution) {
                choice.settings.secondary = Secondary::All;
            }
            choice.settings.shadow_cache = !all.contains(&Skip::Occluder);
            choice
        })
    };
    let mut faint = [Choice::new("", 256 << 10, auto), Choice::new("", 256 << 10, auto)];
    faint[0].settings = Settings { cutoff: 1.0 / 512.0, ..Settings::default() };
    let variants = [
        ("contribution", pair(256 << 10, &auto, Skip::Contribution)),
        ("share below 1/512", faint),
        ("occluder", pair(256 << 10, &auto, Skip::Occluder)),
        ("empty, grid", pair(1 << 20, &grid, Skip::Empty)),
        ("huge, grid", pair(1 << 20, &grid, Skip::Huge)),
        ("cells, grid", pair(1 << 20, &grid, Skip::Cells)),
        ("tested, grid", pair(1 << 20, &grid, Skip::Tested)),
        ("lists, octree", pair(1 << 20, &shared, Skip::Lists)),
    ]
    .map(|(name, choices)| (name.to_owned(), choices));
    pairs(options, names, "Without each way to skip work, in parts of with it:", &variants)
}
