//! The firmware that a user copies: built and run by the very command of the README, its output held
//! to what the host computes from the same constants by testing every shape.

use crate::image::Image;
use crate::{cross, run, tools};
use anyhow::{Context, Result, ensure};
use embedded_graphics_core::pixelcolor::RgbColor;
use kibiray::accel::{Accel, Naive, mailbox};
use kibiray::display::rgb888;
use kibiray::geom::{Interval, Ray};
use kibiray::scene::{Camera, Scene};
use kibiray::trace::{Renderer, Settings, Tracer};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

#[allow(unreachable_pub, reason = "a file of another package")]
#[path = "../../../examples/picture/src/scene.rs"]
mod hall;
#[allow(unreachable_pub, reason = "a file of another package")]
#[path = "../../../examples/range/src/scene.rs"]
mod posts;

/// Whether what a run needs is there; the script finds it by itself.
pub(crate) fn tools() -> Result<(), String> {
    tools::find("bash")?;
    tools::find("qemu-system-arm")?;
    cross::Tools::find("ld.lld").map(drop)
}

/// Runs an example. Gives what it printed, and the file of its image.
fn ran(name: &str, target: &str) -> Result<(String, PathBuf)> {
    let folder = cross::target_dir().with_file_name("examples");
    let script = cross::source("../examples/run");
    let mut command = Command::new("bash");
    cross::without_flags(&mut command)
        .arg(script)
        .arg(name)
        .env("CARGO_TARGET_DIR", &folder)
        .env("CARGO_TERM_QUIET", "true")
        .stdin(Stdio::null());
    let (status, text) = run::within(Duration::from_secs(600), &mut command)?;
    ensure!(status.success(), "{status}: {command:?}\n{text}");
    let elf = folder.join(target).join("release").join(name);
    let image = Image::read(&elf)?;
    image.allocates_nothing()?;
    image.panics_nowhere()?;
    println!("example {name}: {} bytes of flash", image.flash());
    Ok((text, elf))
}

/// Whether there is code of the renderer, inlined or not: the image keeps names for debuggers.
fn renders(elf: &PathBuf) -> Result<bool> {
    let name = b"draw_row";
    Ok(fs::read(elf)?.windows(name.len()).any(|bytes| bytes == name))
}

/// Renders a picture on a Cortex-M4F.
pub(crate) fn picture() -> Result<()> {
    let (text, elf) = ran("picture", "thumbv7em-none-eabihf")?;
    ensure!(renders(&elf)?, "no name of the renderer in {}", elf.display());
    // "…38;2;R;G;B;48;2;R;G;Bm▀…" shows a pixel and the one below.
    let mut rows = Vec::new();
    for line in text.lines().filter(|line| line.contains('▀')) {
        let mut pair = [Vec::<u8>::new(), Vec::new()];
        for cell in line.split('▀').filter(|cell| cell.contains("38;2;")) {
            let numbers: Vec<u8> = cell.split([';', 'm']).filter_map(|n| n.parse().ok()).collect();
            // 2, three channels, 48, 2, three channels.
            pair[0].extend(numbers.get(1..4).with_context(|| format!("{cell:?}"))?);
            pair[1].extend(numbers.get(6..9).with_context(|| format!("{cell:?}"))?);
        }
        rows.extend(pair);
    }

    let scene = Scene::new((&hall::BALLS[..], &hall::FLOOR[..]))?
        .painted(&hall::MATERIALS, &hall::PAINT)?
        .lit(&hall::LIGHTS, hall::SKY)?;
    let (width, height) = (80, 50);
    let camera = Camera::new(&hall::VIEW, f32::from(width) / f32::from(height))?;
    let naive = Naive::new(&scene);
    let tracer = Tracer::new(&scene, &naive, mailbox::Off, Settings::default());
    let mut renderer = Renderer::new(tracer, camera, width, height);
    ensure!(rows.len() == usize::from(height), "{} rows", rows.len());
    for (y, row) in (0..height).zip(rows) {
        let pixels = (0..width).map(|x| rgb888::<f32>(renderer.pixel(x, y, &mut ())));
        let expected: Vec<u8> = pixels.flat_map(|c| [c.r(), c.g(), c.b()]).collect();
        ensure!(row == expected, "row {y}: {row:?} instead of {expected:?}");
    }
    Ok(())
}

/// Measures distances on a Cortex-M0.
pub(crate) fn range() -> Result<()> {
    let (text, elf) = ran("range", "thumbv6m-none-eabi")?;
    ensure!(!renders(&elf)?, "a renderer in {}", elf.display());
    let scene = Scene::new((&posts::BALLS[..], &posts::BOXES[..]))?;
    let naive = Naive::new(&scene);
    let mut beam = posts::FIRST;
    let mut lines = text.lines();
    for step in 0..posts::BEAMS {
        let ray = Ray::new(posts::SENSOR, beam)?;
        let within = Interval::new(0.0, posts::REACH);
        let hit = naive.nearest(&scene, &ray, within, &mut mailbox::Off, &mut ());
        let degrees = (step - posts::BEAMS / 2) * posts::DEGREES;
        let expected = match hit {
            None => format!("{degrees:4} deg  nothing"),
            Some(hit) => format!(" mm {:08x} =", hit.t.to_bits()),
        };
        let line = lines.next().with_context(|| format!("no line for {degrees} degrees"))?;
        let beginning = format!("{degrees:4} deg ");
        ensure!(
            line.starts_with(&beginning) && line.contains(&expected),
            "{line:?} instead of {beginning:?}, {expected:?}"
        );
        beam = posts::turned(beam);
    }
    Ok(())
}
