//! `trace`: ray queries from a file.

use std::io::{self, Write};

use anyhow::Context;
use kibiray::accel::Accel;
use kibiray::num::{Fixed, Real, Vector};
use kibiray::probe::{Counters, Probe};
use kibiray::scene::Scene;

use super::stage::{self, DEFAULT_RAM, Stage};
use super::{Usage, shown};
use crate::engine::{Built, HostMailbox, Picture, fastest, share};
use crate::frame::{Frame, Way};
use crate::options::{Number, Trace};
use crate::rays;
use crate::rays::{Answer, Query};
use crate::report::RaysReport;
use crate::structure::Structure;
use crate::tables::{HostShapes, Tables};
use crate::values::is_dash;

pub(super) fn run(options: &Trace) -> anyhow::Result<()> {
    if is_dash(&options.hits) && options.common.json_to_stdout() {
        return Err(Usage("--hits - and --json - both want standard output".into()).into());
    }
    super::check_folder(&options.hits)?;
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

/// Queries that a thread takes at a time.
const BATCH: usize = 1024;

/// A thread's mailbox and its counters.
struct Worker<'a> {
    mailbox: HostMailbox<'a>,
    counters: Counters,
    rays: RaysReport,
}

fn trace<R: Real>(options: &Trace, stage: Stage<'_, R>) -> anyhow::Result<()> {
    let Stage { tables, scene, frame, built, mut report, .. } = stage;
    let Built { accel, mailboxes, .. } = built;
    let queries = read::<R>(options, &frame)?;
    let mut answers = vec![Answer::Invalid; queries.len()];
    let worker =
        |mailbox| Worker { mailbox, counters: Counters::default(), rays: RaysReport::default() };
    let mut workers: Vec<_> = mailboxes.into_iter().map(worker).collect();

    let asker = Asker { scene, accel: &accel, any: options.any };
    let jobs = queries.chunks(BATCH).zip(answers.chunks_mut(BATCH));
    // The first pass answers and counts, the others are timed: counting is not free.
    share(&mut workers, jobs, |worker, (queries, answers)| {
        for (query, answer) in queries.iter().zip(answers) {
            *answer = asker.ask(query, &mut worker.mailbox, &mut worker.counters);
            worker.rays.total += u64::from(!matches!(answer, Answer::Invalid));
            worker.rays.hits += u64::from(answer.is_hit());
        }
    });
    write(options, tables, scene, &queries, &answers)?;

    let Some(file) = &options.common.json else { return Ok(()) };
    let pass = fastest(options.common.repeat, || {
        share(&mut workers, queries.chunks(BATCH), |worker, queries| {
            for query in queries {
                std::hint::black_box(asker.ask(query, &mut worker.mailbox, &mut ()));
            }
        });
    });
    let (mut counters, mut rays) = (Counters::default(), RaysReport::default());
    for worker in &workers {
        counters += worker.counters;
        rays.total += worker.rays.total;
        rays.hits += worker.rays.hits;
    }
    report.traced(rays, &counters, pass);
    super::write_to(file, &stage::json(&report)?)
}

/// What queries are put to.
struct Asker<'a, R: Real> {
    scene: &'a Scene<'a, R, HostShapes<'a, R>>,
    accel: &'a Structure<'a, R>,
    any: bool,
}

impl<R: Real> Asker<'_, R> {
    fn ask(
        &self,
        query: &Query<R>,
        mailbox: &mut HostMailbox<'_>,
        probe: &mut impl Probe,
    ) -> Answer<R> {
        let Ok(ray) = &query.ray else { return Answer::Invalid };
        if self.any {
            let accel = self.accel;
            return match accel.occluded(self.scene, ray, query.interval, mailbox, probe) {
                true => Answer::Blocked,
                false => Answer::Miss,
            };
        }
        let hit = self.accel.nearest(self.scene, ray, query.interval, mailbox, probe);
        hit.map_or(Answer::Miss, Answer::Hit)
    }
}

fn read<R: Real>(options: &Trace, frame: &Frame) -> anyhow::Result<Vec<Query<R>>> {
    let name = shown(&options.rays);
    let bytes = if is_dash(&options.rays) {
        let mut bytes = Vec::new();
        io::Read::read_to_end(&mut io::stdin().lock(), &mut bytes).map(|_| bytes)
    } else {
        std::fs::read(&options.rays)
    };
    let bytes = bytes.with_context(|| name.clone())?;
    rays::parse(&bytes, frame)
        .map_err(|error| anyhow::anyhow!("{name}:{}: {}", error.line, error.what))
}

fn write<R: Real>(
    options: &Trace,
    tables: &Tables<R>,
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    queries: &[Query<R>],
    answers: &[Answer<R>],
) -> anyhow::Result<()> {
    let mut text = Vec::new();
    writeln!(text, "{}", if options.any { "occluded" } else { rays::ANSWERS })?;
    for (query, answer) in queries.iter().zip(answers) {
        match (answer, &query.ray) {
            (_, _) if options.any => writeln!(text, "{}", u8::from(answer.is_hit()))?,
            (Answer::Hit(hit), Ok(ray)) => {
                let surface = scene.surface(ray, hit);
                let [x, y, z] = surface.map_or([R::ZERO; 3], |surface| surface.normal.to_array());
                let (t, id) = (hit.t, tables.file_id(hit.id));
                // Debug gives the shortest digits that read back as the same number.
                if query.way == Way::STRAIGHT {
                    write!(text, "{t:?}")?;
                } else {
                    write!(text, "{:?}", query.way.restore(t.to_f64()))?;
                }
                writeln!(text, ",{id},{x:?},{y:?},{z:?}")?;
            }
            (Answer::Invalid, _) => writeln!(text, "nan,-1,0,0,0")?,
            _ => writeln!(text, "inf,-1,0,0,0")?,
        }
    }
    super::write_to(&options.hits, &text)
}
