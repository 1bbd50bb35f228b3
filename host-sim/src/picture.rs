//! A picture, rendered by all threads, counted and timed.

use embedded_graphics_core::pixelcolor::RgbColor;
use indicatif::ProgressBar;
use kibiray::display::rgb888;
use kibiray::num::Real;
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Scene};
use kibiray::trace::{Renderer, Settings, Tracer};

use crate::engine::{AnySampling, Built, HostMailbox, Pass, fastest, share, timed};
use crate::image::Image;
use crate::structure::Structure;
use crate::tables::HostShapes;

/// A picture and what it took.
#[derive(Debug)]
pub struct Rendered {
    /// The picture.
    pub image: Image,
    /// Tests and traversal steps of every pixel.
    pub work: Vec<u32>,
    /// All work of one pass.
    pub counters: Counters,
    /// The fastest pass.
    pub pass: Pass,
}

/// A thread's renderer and its counters.
struct Worker<'a, R: Real> {
    renderer:
        Renderer<'a, R, HostShapes<'a, R>, Structure<'a, R>, HostMailbox<'a>, AnySampling<'a, R>>,
    counters: Counters,
}

/// Renders a picture so many times, with a thread for every mailbox.
pub fn render<R: Real>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    built: Built<'_, R>,
    camera: Camera<R>,
    settings: Settings<R>,
    (width, height): (u16, u16),
    repeat: u32,
    bar: &ProgressBar,
) -> Rendered {
    let Built { accel, mailboxes, samplings, .. } = built;
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
    let mut pass = timed(|| draw(&mut workers, &mut image, &mut work, bar));
    // The first pass counts, which slows it a little; the others do not.
    if repeat > 1 {
        let uncounted = fastest(repeat - 1, || again(&mut workers, &image));
        if uncounted.wall_s < pass.wall_s {
            pass = uncounted;
        }
    }
    let mut counters = Counters::default();
    workers.iter().for_each(|worker| counters += worker.counters);
    Rendered { image, work, counters, pass }
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
        let rows = work.len() / width;
        for ((i, rgb), work) in (0..).zip(rgb.chunks_exact_mut(3)).zip(work) {
            let (x, y) = ((i % width) as u16, y + (i / width) as u16);
            let mut counters = Counters::default();
            let color = rgb888::<R>(worker.renderer.pixel(x, y, &mut counters));
            rgb.copy_from_slice(&[color.r(), color.g(), color.b()]);
            *work = u32::try_from(counters.primitive_tests + counters.steps).unwrap_or(u32::MAX);
            worker.counters += counters;
        }
        // Once a band: the bar asks the clock every time.
        bar.inc(rows as u64);
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
