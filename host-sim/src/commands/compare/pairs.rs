//! One choice in parts of another.

use kibiray::trace::Settings;

use super::{Choice, UNLIMITED, geometric_mean, measure, open};
use crate::options::{AccelKind, Common, Compare, Growth, ListKind, Overlap, Skip, Store};
use crate::report::Report;

/// Prints for every scene what a choice takes in parts of what the other one does.
fn pairs(
    options: &Compare,
    names: &[String],
    title: &str,
    variants: &[(String, [Choice; 2])],
) -> anyhow::Result<()> {
    println!("{title}\n");
    println!(
        "| scene | | tests | steps | empty cells | tests + steps | references | bytes | time |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
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
            let ratio = |f: &dyn Fn(&Report) -> f64| f(b) / f(a);
            let shown = |x: f64| if x.is_finite() { format!("{x:.3}") } else { "–".into() };
            let columns: [&dyn Fn(&Report) -> f64; 7] = [
                &|it| it.work.primitive_tests as f64,
                &|it| it.work.traversal_steps as f64,
                &|it| it.work.empty_leaves_visited as f64,
                &|it| (it.work.primitive_tests + it.work.traversal_steps) as f64,
                &|it| it.accel.references.unwrap_or(0) as f64,
                &|it| it.memory.used_bytes as f64,
                &|it| it.time.trace_cpu_s,
            ];
            let cells: Vec<_> = columns.iter().map(|column| shown(ratio(column))).collect();
            let stopped = if a.accel.stopped_by == Some("memory") { ", memory ends" } else { "" };
            println!("| {name} | {what}{stopped} | {} |", cells.join(" | "));
            all.push(columns.map(|column| ratio(column)));
        }
        let mean = |column: usize| {
            let ratios: Vec<_> = all.iter().map(|row| row[column]).collect();
            let mean = geometric_mean(&ratios);
            if ratios.is_empty() || !mean.is_normal() { "–".into() } else { format!("{mean:.3}") }
        };
        let means: Vec<_> = (0..7).map(mean).collect();
        println!("| **mean** | {what} | {} |", means.join(" | "));
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
    let structures = [(AccelKind::Grid, "grid"), (AccelKind::Octree, "octree")];
    let budgets = [(12, "12 bytes a shape"), (24, "24 bytes a shape"), (UNLIMITED, "unlimited")];
    let variants: Vec<_> = structures
        .into_iter()
        .flat_map(|structure| budgets.map(|budget| (structure, budget)))
        .map(|((accel, structure), (ram, budget))| {
            let of = |lists| {
                Choice::new("", ram, |common| {
                    common.accel = accel;
                    common.lists = Some(lists);
                })
            };
            (format!("{structure}, {budget}"), [ListKind::Own, ListKind::Shared].map(of))
        })
        .collect();
    pairs(options, names, "Shared lists, in parts of every cell its own:", &variants)
}

pub(super) fn skips(options: &Compare, names: &[String]) -> anyhow::Result<()> {
    let auto = |common: &mut Common| common.accel = AccelKind::Auto;
    let grid = |common: &mut Common| common.accel = AccelKind::Grid;
    let shared = |accel| {
        move |common: &mut Common| {
            common.accel = accel;
            common.lists = Some(ListKind::Shared);
        }
    };
    let pair = |ram, on: &dyn Fn(&mut Common), skip| {
        [vec![], vec![skip]].map(|no_skip| {
            let mut choice = Choice::new("", ram, |common| {
                on(common);
                common.no_skip = no_skip;
            });
            choice.settings = choice.common.settings();
            choice
        })
    };
    let mut faint = [Choice::new("", 256 << 10, auto), Choice::new("", 256 << 10, auto)];
    faint[0].settings = Settings { cutoff: 1.0 / 512.0, ..Settings::default() };
    let variants = [
        ("contribution", pair(256 << 10, &auto, Skip::Contribution)),
        ("share below 1/512", faint),
        ("occluder", pair(256 << 10, &auto, Skip::Occluder)),
        ("shadows", pair(256 << 10, &auto, Skip::Shadows)),
        ("facing", pair(256 << 10, &auto, Skip::Facing)),
        ("mirrors", pair(256 << 10, &auto, Skip::Mirrors)),
        ("kinds", pair(256 << 10, &auto, Skip::Kinds)),
        ("box, no memory", pair(0, &auto, Skip::Box)),
        ("empty, grid", pair(1 << 20, &grid, Skip::Empty)),
        ("huge, grid", pair(1 << 20, &grid, Skip::Huge)),
        ("cells, grid", pair(1 << 20, &grid, Skip::Cells)),
        ("tested, grid", pair(1 << 20, &grid, Skip::Tested)),
        ("lists, octree", pair(1 << 20, &shared(AccelKind::Octree), Skip::Lists)),
        ("lists, grid", pair(1 << 20, &shared(AccelKind::Grid), Skip::Lists)),
    ]
    .map(|(name, choices)| (name.to_owned(), choices));
    pairs(options, names, "Without each way to skip work, in parts of with it:", &variants)
}
