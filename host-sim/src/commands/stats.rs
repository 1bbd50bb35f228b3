//! `stats`: the published ray set, counted and timed.

use kibiray::num::{Fixed, Real};
use kibiray::probe::{Counters, Probe};
use kibiray::scene::Camera;
use kibiray::trace::{Secondary, Settings, Skips, Tracer};

use super::stage::{self, DEFAULT_RAM, Stage};
use crate::engine::{Built, HostTracer, Picture, fastest, share};
use crate::options::{Number, RaySet, Stats};
use crate::report::RaysReport;

/// Corners of the pixels of a picture of 512 by 512, per axis.
const CORNERS: i32 = 513;

pub(super) fn run(options: &Stats) -> anyhow::Result<()> {
    let options = &Stats { common: options.common.clone().as_published(), ..options.clone() };
    let loaded = stage::open(&options.scene, &options.common)?;
    let ram = options.ram.unwrap_or(DEFAULT_RAM);
    match options.common.num {
        Number::F64 => {
            stage::set::<f64>(&loaded, &options.common, ram, Picture::NONE, |it| trace(options, it))
        }
        Number::Fixed => stage::set::<Fixed>(&loaded, &options.common, ram, Picture::NONE, |it| {
            trace(options, it)
        }),
        Number::F32 => {
            stage::set::<f32>(&loaded, &options.common, ram, Picture::NONE, |it| trace(options, it))
        }
    }
}

/// A thread's tracer and its counters.
struct Worker<'a, R: Real> {
    tracer: HostTracer<'a, R>,
    counters: Counters,
}

fn trace<R: Real>(options: &Stats, stage: Stage<'_, R>) -> anyhow::Result<()> {
    let Stage { tables, scene, built, mut report, .. } = stage;
    let Built { accel, mailboxes, .. } = built;
    let RaySet::Spd = options.rays;
    // Every ray that the published counts have.
    let settings = Settings {
        secondary: Secondary::All,
        shadow_cache: false,
        skips: Skips { shadows: false, ..Skips::default() },
        ..Settings::default()
    };
    let camera = Camera::new(tables.view(), R::ONE)?;
    let mut workers: Vec<_> = mailboxes
        .into_iter()
        .map(|mailbox| Worker {
            tracer: Tracer::new(scene, &accel, mailbox, settings),
            counters: Counters::default(),
        })
        .collect();

    // The first pass counts, the others are timed: counting is not free.
    share(&mut workers, 0..CORNERS, |worker, row| {
        trace_row(&mut worker.tracer, &camera, row, &mut worker.counters);
    });
    let pass = fastest(options.common.repeat, || {
        share(&mut workers, 0..CORNERS, |worker, row| {
            trace_row(&mut worker.tracer, &camera, row, &mut ());
        });
    });

    let mut counters = Counters::default();
    workers.iter().for_each(|worker| counters += worker.counters);
    report.traced(RaysReport::of(&counters), &counters, pass);
    let text = stage::json(&report)?;
    match &options.common.json {
        Some(file) if !options.common.json_to_stdout() => super::write_to(file, &text)?,
        _ => {}
    }
    super::write_to("-".as_ref(), &text)
}

/// Shoots the rays of a row of corners, the top one first.
fn trace_row<R: Real>(
    tracer: &mut HostTracer<'_, R>,
    camera: &Camera<R>,
    row: i32,
    probe: &mut impl Probe,
) {
    let across = |i: i32| R::fraction(2 * i, CORNERS - 1) - R::ONE;
    for column in 0..CORNERS {
        if let Some(ray) = camera.ray(across(column), -across(row)) {
            std::hint::black_box(tracer.color(ray, probe));
        }
    }
}
