//! What every command that traces sets up first.

use std::time::Instant;

use anyhow::Context;
use kibiray::accel::BuildError;
use kibiray::memory::OutOfArena;
use kibiray::num::Real;
use kibiray::probe::Counters;
use kibiray::scene::Scene;

use super::Usage;
use crate::costs::Costs;
use crate::description::Description;
use crate::description::load::load;
use crate::engine::{Built, Memory, Pass, Picture};
use crate::frame::Frame;
use crate::options::{Common, Number, Skip};
use crate::report::{
    AccelReport, MemoryReport, RaysReport, Report, SceneReport, TimeReport, WorkReport,
};
use crate::tables::{HostShapes, Tables};

/// Memory that is taken when `--ram` is not given.
pub(super) const DEFAULT_RAM: usize = 256 << 10;

/// Everything is ready to trace.
pub(super) struct Stage<'a, R: Real> {
    pub(super) tables: &'a Tables<R>,
    pub(super) scene: &'a Scene<'a, R, HostShapes<'a, R>>,
    pub(super) frame: Frame,
    pub(super) built: Built<'a, R>,
    /// The report as far as it is known before a ray is shot.
    pub(super) report: Report,
}

/// A scene, loaded.
pub(super) struct Loaded {
    pub(super) description: Description,
    seconds: f64,
}

/// Loads a scene once the options are known to make sense.
pub(super) fn open(name: &str, options: &Common) -> anyhow::Result<Loaded> {
    options.check().map_err(Usage)?;
    if let Some(json) = &options.json {
        super::check_folder(json)?;
    }
    let start = Instant::now();
    let description = load(name)?;
    Ok(Loaded { description, seconds: start.elapsed().as_secs_f64() })
}

/// Builds tables, scene, arena and structure, and hands them to `act`.
pub(super) fn set<R: Real>(
    loaded: &Loaded,
    options: &Common,
    ram: usize,
    picture: Picture,
    act: impl FnOnce(Stage<'_, R>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let Loaded { description, seconds } = loaded;
    let start = Instant::now();
    let named = || description.name.escape_debug().to_string();
    let frame = Frame::of::<R>(description);
    let moved = frame.apply(description);
    let tables = Tables::<R>::new(&moved).with_context(named)?;
    let polygons = tables.polygons();
    let scene = tables.scene_of(&polygons, !options.does(Skip::Kinds)).with_context(named)?;
    let load_s = seconds + start.elapsed().as_secs_f64();

    let mut memory = Memory::new(ram)?;
    let mut arena = memory.arena();
    let costs = Costs::of(options.num, &tables.kinds());
    let built = Built::new(&scene, options, picture, &costs, &mut arena)
        .map_err(|error| build_error(&error))?;
    let report = Report {
        scene: SceneReport {
            name: description.name.clone(),
            primitives: description.items.len(),
            skipped: tables.skipped(),
            bytes: tables.bytes(),
            lights: tables.lights(),
        },
        num: number_name(options.num),
        accel: AccelReport::of(&built.accel, built.mailbox_name(), &costs),
        memory: MemoryReport::of(&arena),
        rays: RaysReport::default(),
        work: WorkReport::default(),
        time: TimeReport {
            load_s,
            build_s: built.pass.wall_s,
            build_cpu_s: built.pass.cpu_s,
            ..TimeReport::default()
        },
        image: None,
    };
    act(Stage { tables: &tables, scene: &scene, frame, built, report })
}

impl Report {
    /// Adds what a pass counted and how long the fastest one took.
    pub(super) fn traced(&mut self, rays: RaysReport, counters: &Counters, pass: Pass) {
        self.rays = rays;
        self.work = WorkReport::of(counters);
        self.time.trace_s = pass.wall_s;
        self.time.trace_cpu_s = pass.cpu_s;
        self.time.rays_per_s = rays.total as f64 / pass.wall_s.max(1e-9);
    }
}

/// The report as JSON, a line feed at the end.
pub(super) fn json(report: &Report) -> anyhow::Result<Vec<u8>> {
    let mut text = serde_json::to_vec_pretty(report)?;
    text.push(b'\n');
    Ok(text)
}

fn number_name(num: Number) -> &'static str {
    match num {
        Number::F32 => "f32",
        Number::F64 => "f64",
        Number::Fixed => "fixed",
    }
}

/// The arena has no room for what was asked for.
#[derive(Debug)]
pub(super) struct TooLittle(OutOfArena);

impl std::fmt::Display for TooLittle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let OutOfArena { needed, available } = self.0;
        write!(
            f,
            "too little memory: {needed} bytes needed, {available} bytes there; give --ram {needed}"
        )
    }
}

impl std::error::Error for TooLittle {}

fn build_error(error: &BuildError) -> anyhow::Error {
    match error {
        BuildError::Memory(memory) => TooLittle(*memory).into(),
        error => anyhow::anyhow!("{error}"),
    }
}
