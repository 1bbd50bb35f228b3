//! `render`: a picture, and what it took.

use std::path::{Path, PathBuf};

use kibiray::num::{Fixed, Real};
use kibiray::scene::Camera;
use kibiray::trace::Settings;

use super::stage::{self, DEFAULT_RAM, Stage};
use crate::description::demo;
use crate::engine::Picture;
use crate::image::HeatMap;
use crate::options::{Cli, Command, Number, Render};
use crate::picture::{self, Rendered};
use crate::report::{ImageReport, RaysReport, Report};
use crate::terminal::{self, Outcome};

/// Memory of the demo scene: that of a small microcontroller.
const DEMO_RAM: usize = 64 << 10;

/// Renders; without options what `host-sim render` does.
pub(super) fn run(options: Option<Render>) -> anyhow::Result<()> {
    let options = match options {
        Some(options) => options,
        None => defaults()?,
    };
    let output = options.output.clone().unwrap_or_else(|| default_output(&options));
    for path in options.heatmap.iter().chain([&output]) {
        super::check_folder(path)?;
    }
    let (name, ram) = match &options.scene {
        Some(name) => (name.as_str(), DEFAULT_RAM),
        None => (demo::DEFAULT, DEMO_RAM),
    };
    let ram = options.ram.unwrap_or(ram);
    let loaded = stage::open(name, &options.common)?;
    let file_size = loaded.description.view.map(|view| view.resolution);
    let size = options.size.unwrap_or_else(|| usable_size(file_size));
    let picture = Picture { width: size.0, aa: options.aa };
    let common = &options.common;
    match common.num {
        Number::F64 => stage::set::<f64>(&loaded, common, ram, picture, |it| {
            render(&options, &output, size, it)
        }),
        Number::Fixed => stage::set::<Fixed>(&loaded, common, ram, picture, |it| {
            render(&options, &output, size, it)
        }),
        Number::F32 => stage::set::<f32>(&loaded, common, ram, picture, |it| {
            render(&options, &output, size, it)
        }),
    }
}

fn defaults() -> anyhow::Result<Render> {
    let cli = <Cli as clap::Parser>::try_parse_from(["host-sim", "render"])?;
    match cli.command {
        Some(Command::Render(options)) => Ok(options),
        _ => anyhow::bail!("no command"),
    }
}

/// `tetra.png` for `spd:tetra:3` and for `scenes/tetra.nff`.
fn default_output(options: &Render) -> PathBuf {
    match &options.scene {
        Some(scene) => super::named_after(scene).with_extension("png"),
        None => "kibiray.png".into(),
    }
}

fn render<R: Real>(
    options: &Render,
    output: &Path,
    (width, height): (u16, u16),
    stage: Stage<'_, R>,
) -> anyhow::Result<()> {
    let Stage { tables, scene, built, mut report, .. } = stage;
    if report.scene.skipped > 0 {
        let skipped = report.scene.skipped;
        eprintln!("warning: left out for having no area or radius: {skipped} of the shapes");
    }
    let aspect = R::fraction(width.into(), height.into());
    let camera = Camera::new(tables.view(), aspect)?;
    let by_skips = options.common.settings::<R>();
    let settings = Settings {
        max_depth: options.max_depth,
        cutoff: R::from_f64(options.cutoff),
        shadow_cache: by_skips.shadow_cache && !options.no_shadow_cache,
        ..by_skips
    };
    let plan = built.plan;
    let bar = super::progress(height.into(), "rows");
    let repeat = options.common.repeat;
    let Rendered { image, work, counters, pass } =
        picture::render(scene, built, camera, settings, (width, height), repeat, &bar);
    bar.finish_and_clear();
    report.traced(RaysReport::of(&counters), &counters, pass);
    let crc32 = format!("{:08x}", image.crc32());
    report.image = Some(ImageReport { width, height, crc32 });
    super::write_to(output, &image.png()?)?;
    let heat = options.heatmap.as_deref().map(|path| (path, HeatMap::new(width, height, &work)));
    if let Some((path, heat)) = &heat {
        super::write_to(path, &heat.image.png()?)?;
    }
    let outcome =
        Outcome { plan: &plan, output, heat: heat.as_ref(), threads: options.common.threads };
    finish(options, &report, &outcome)
}

/// The table goes to standard output, unless the report as JSON does.
fn finish(options: &Render, report: &Report, outcome: &Outcome<'_>) -> anyhow::Result<()> {
    let text = terminal::table(report, outcome);
    if let Some(json) = &options.common.json {
        super::write_to(json, &stage::json(report)?)?;
    }
    let to_stdout = super::is_dash(outcome.output);
    if options.common.json_to_stdout() || to_stdout {
        eprint!("{text}");
        return Ok(());
    }
    super::write_to("-".as_ref(), text.as_bytes())
}

/// The size that a file asks for, where it can be done.
fn usable_size(asked: Option<[u32; 2]>) -> (u16, u16) {
    let size = asked.and_then(|[w, h]| crate::values::size(&format!("{w}x{h}")).ok());
    size.unwrap_or((512, 512))
}
