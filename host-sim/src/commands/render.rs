//! `render`: a picture, and what it took.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use embedded_graphics_core::pixelcolor::RgbColor;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use kibiray::accel::Any;
use kibiray::accel::mailbox::AnyMailbox;
use kibiray::display::rgb888;
use kibiray::num::Real;
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Solids};
use kibiray::trace::{Renderer, Secondary, Settings, Tracer};

use super::stage::{self, DEFAULT_RAM, Stage};
use crate::description::demo;
use crate::engine::{self, Built, Picture, share, timed};
use crate::image::{HeatMap, Image};
use crate::options::{Cli, Command, Number, Render};
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
    let ram = options.common.ram.unwrap_or(ram);
    let loaded = stage::open(name, &options.common)?;
    let file_size = loaded.description.view.map(|view| view.resolution);
    let size = options.size.unwrap_or_else(|| usable_size(file_size));
    let picture = Picture { width: size.0, aa: options.aa };
    let common = &options.common;
    match common.num {
        Number::F64 => stage::set::<f64>(&loaded, common, ram, picture, |it| {
            render(&options, &output, size, it)
        }),
        _ => stage::set::<f32>(&loaded, common, ram, picture, |it| {
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
    let Some(scene) = &options.scene else { return "kibiray.png".into() };
    let name = match scene.strip_prefix("spd:") {
        Some(spec) => spec.split(':').next().unwrap_or(spec).into(),
        None => Path::new(scene).file_stem().unwrap_or(scene.as_ref()).to_os_string(),
    };
    PathBuf::from(name).with_extension("png")
}

/// A thread's renderer and its counters.
struct Worker<'a, R: Real> {
    renderer: Renderer<'a, R, Solids<'a, R>, Any<'a, R>, AnyMailbox<'a>>,
    counters: Counters,
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
    let Built { plan, accel, mailboxes, samplings, .. } = built;
    let aspect = R::from_i32(width.into()) / R::from_i32(height.into());
    let camera = Camera::new(tables.view(), aspect)?;
    let settings = Settings {
        max_depth: options.max_depth,
        secondary: Secondary::Contributing,
        cutoff: R::from_f64(options.cutoff),
    };
    let mut workers: Vec<_> = mailboxes
        .into_iter()
        .zip(samplings)
        .map(|(mailbox, sampling)| {
            let tracer = Tracer::new(scene, &accel, mailbox, settings);
            let renderer = Renderer::new(tracer, camera, width, height).sampled(sampling);
            Worker { renderer, counters: Counters::default() }
        })
        .collect();

    let mut image = Image::new(width, height);
    let mut work = vec![0; usize::from(width) * usize::from(height)];
    let bar = progress(height);
    let mut best = timed(|| draw(&mut workers, &mut image, &mut work, &bar));
    bar.finish_and_clear();
    // The first pass counts, which slows it a little; the others do not.
    if options.common.repeat > 1 {
        let pass = engine::fastest(options.common.repeat - 1, || again(&mut workers, &image));
        if pass.wall_s < best.wall_s {
            best = pass;
        }
    }

    let mut counters = Counters::default();
    workers.iter().for_each(|worker| counters += worker.counters);
    report.traced(RaysReport::of(&counters), &counters, best);
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

fn progress(height: u16) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let target = ProgressDrawTarget::stderr_with_hz(10);
    let bar = ProgressBar::with_draw_target(Some(height.into()), target);
    match ProgressStyle::with_template("rows {bar:40} {pos}/{len}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Rows that a thread renders together: those that share corners.
const BAND: usize = 16;

/// Renders all rows, with the work of every pixel.
fn draw<R: Real>(
    workers: &mut [Worker<'_, R>],
    image: &mut Image,
    work: &mut [u32],
    bar: &ProgressBar,
) {
    let width = usize::from(image.width);
    let bands = image.rgb.chunks_mut(3 * width * BAND).zip(work.chunks_mut(width * BAND));
    share(workers, (0..=u16::MAX).step_by(BAND).zip(bands), |worker, (y, (rgb, work))| {
        for ((i, rgb), work) in (0..).zip(rgb.chunks_exact_mut(3)).zip(work) {
            let (x, y) = ((i % width) as u16, y + (i / width) as u16);
            let mut counters = Counters::default();
            let color = rgb888::<R>(worker.renderer.pixel(x, y, &mut counters));
            rgb.copy_from_slice(&[color.r(), color.g(), color.b()]);
            *work = u32::try_from(counters.primitive_tests + counters.steps).unwrap_or(u32::MAX);
            worker.counters += counters;
            bar.inc(u64::from(i % width == width - 1));
        }
    });
}

/// Renders all rows once more, uncounted, for the time only.
fn again<R: Real>(workers: &mut [Worker<'_, R>], image: &Image) {
    let (width, height) = (image.width, image.height);
    share(workers, (0..height).step_by(BAND), |worker, first| {
        for y in first..height.min(first.saturating_add(BAND as u16)) {
            for x in 0..width {
                std::hint::black_box(rgb888::<R>(worker.renderer.pixel(x, y, &mut ())));
            }
        }
    });
}
