//! What the host computes from the same scenes.

use anyhow::{Context, Result, anyhow, ensure};
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use kibiray::accel::octree::StoppedBy;
use kibiray::accel::{Accel, Naive, mailbox};
use kibiray::geom::Interval;
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Camera, Scene, Shapes};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Card, Plain, Structure, Subject, answer};
use serde::Deserialize;
use std::convert::Infallible;

/// Checksums of a picture and of answers to ray queries, in hexadecimal.
#[derive(Debug, PartialEq)]
pub(crate) struct Sums {
    /// Of the rows of 8-bit RGB.
    pub(crate) image: String,
    /// Of the answers.
    pub(crate) hits: String,
}

/// A picture by places, so that the order in which pixels come does not matter.
struct Picture {
    size: (u16, u16),
    rows: Vec<u8>,
}

impl OriginDimensions for Picture {
    fn size(&self) -> Size {
        Size::new(self.size.0.into(), self.size.1.into())
    }
}

impl DrawTarget for Picture {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(place, color) in pixels {
            let at = (place.y as usize * usize::from(self.size.0) + place.x as usize) * 3;
            self.rows[at..at + 3].copy_from_slice(&[color.r(), color.g(), color.b()]);
        }
        Ok(())
    }
}

/// A subject's picture as rows of 8-bit RGB.
fn picture<S: Subject>(
    scene: &Scene<'static, S::Number, S::Shapes>,
    accel: &impl Accel<S::Number>,
) -> Result<Vec<u8>> {
    let (width, height) = S::SIZE;
    if height == 0 {
        return Ok(Vec::new());
    }
    let camera = Camera::new(&S::view(), S::Number::fraction(width.into(), height.into()))?;
    let settings = Settings { max_depth: S::DEPTH, ..Settings::default() };
    let tracer = Tracer::new(scene, accel, mailbox::Off, settings);
    let bytes = usize::from(width) * usize::from(height) * 3;
    let mut picture = Picture { size: S::SIZE, rows: vec![0; bytes] };
    Renderer::new(tracer, camera, width, height).draw(&mut picture, &mut ())?;
    Ok(picture.rows)
}

fn hex(bytes: &[u8]) -> String {
    format!("{:08x}", crc32fast::hash(bytes))
}

impl Sums {
    fn of<S: Subject>(
        scene: &Scene<'static, S::Number, S::Shapes>,
        accel: &impl Accel<S::Number>,
    ) -> Result<Self> {
        let off = &mut mailbox::Off;
        let answers: Vec<_> = S::rays()
            .map(|shot| {
                let hit = accel.nearest(scene, &shot.ray, Interval::RAY, off, &mut ());
                let blocked = accel.occluded(scene, &shot.ray, shot.between, off, &mut ());
                answer(hit, blocked)
            })
            .collect();
        ensure!(!answers.is_empty(), "no rays");
        Ok(Self { image: hex(&picture::<S>(scene, accel)?), hits: hex(answers.as_flattened()) })
    }

    /// By testing every shape.
    pub(crate) fn of_naive<S: Subject>() -> Result<Self> {
        let scene = S::scene()?;
        Self::of::<S>(&scene, &Naive::new(&scene))
    }
}

/// The picture of the plain program.
fn plain() -> Vec<u8> {
    let (width, height) = Plain::SIZE;
    let picture = Plain::new();
    let mut rows = vec![0; usize::from(width) * usize::from(height) * 3];
    for (y, row) in (0..).zip(rows.chunks_mut(usize::from(width) * 3)) {
        picture.row(y, row);
    }
    rows
}

/// The checksum of the plain program's picture.
pub(crate) fn plain_sum() -> String {
    hex(&plain())
}

/// So many pixels of 10,000 may differ between the library's card and the plain one's: rounding
/// decides on which side of an edge a pixel falls.
const DIFFERING: usize = 50;

/// The plain program renders what the library renders.
pub(crate) fn plain_is_the_card() -> Result<()> {
    let scene = Card::scene()?;
    let card = picture::<Card>(&scene, &Naive::new(&scene))?;
    let plain = plain();
    let pixels = card.as_chunks::<3>().0.iter().zip(plain.as_chunks::<3>().0);
    let differs = |(a, b): &(&[u8; 3], &[u8; 3])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 1);
    let differing = pixels.filter(differs).count();
    let all = card.len() / 3;
    println!("{differing} of {all} pixels of the two cards differ by more than one step");
    ensure!(differing * 10_000 <= DIFFERING * all, "{differing} of {all} pixels differ");
    Ok(())
}

/// Bytes of an arena that go by a name.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct Part {
    pub(crate) name: String,
    pub(crate) bytes: usize,
}

/// How an arena is used.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct Memory {
    /// Its bytes.
    pub(crate) capacity: usize,
    /// Bytes that are taken.
    pub(crate) used: usize,
    /// Most bytes that were taken.
    pub(crate) high_water: usize,
    /// What for.
    pub(crate) parts: Vec<Part>,
}

/// Builds a subject's structure in an arena and does something with it.
fn with_structure<S: Subject, T>(
    capacity: usize,
    work: impl FnOnce(
        &Scene<'static, S::Number, S::Shapes>,
        &<S::Structure as Structure<S::Number>>::Built<'_>,
        &Arena<'_>,
    ) -> Result<T>,
) -> Result<T> {
    let mut memory = kibiray_tests::Memory::new(capacity);
    let mut arena = Arena::new(memory.bytes(capacity));
    let scene = S::scene()?;
    let built = S::Structure::build(&scene, &mut arena)?;
    S::Structure::mailbox(scene.shapes().count(), &mut arena)?;
    work(&scene, &built, &arena)
}

/// How a subject's structure uses an arena of that capacity, and why it is not finer.
pub(crate) fn arena<S: Subject>(capacity: usize) -> Result<(Memory, &'static str)> {
    with_structure::<S, _>(capacity, |_, built, arena| {
        let part =
            |part: &kibiray::memory::Part| Part { name: part.name.into(), bytes: part.bytes };
        let memory = Memory {
            capacity: arena.capacity(),
            used: arena.used(),
            high_water: arena.high_water(),
            parts: arena.parts().iter().map(part).collect(),
        };
        let stopped_by = match S::Structure::stopped_by(built) {
            StoppedBy::Done => "done",
            StoppedBy::Level => "level",
            StoppedBy::Memory => "memory",
        };
        Ok((memory, stopped_by))
    })
}

/// From the smallest arena that holds a cell to one with room to spare, pictures and hits are those
/// of testing every shape.
pub(crate) fn structures_agree<S: Subject>() -> Result<()> {
    let expected = Sums::of_naive::<S>()?;
    let least = with_structure::<S, _>(0, |_, _, _| Ok(())).err();
    let least = least.context("a structure of no bytes")?;
    let least = match least.downcast_ref() {
        Some(kibiray::accel::BuildError::Memory(out)) => out.needed,
        _ => return Err(anyhow!("no bytes are refused for another reason: {least:#}")),
    };
    for capacity in [least, 2 << 10, 8 << 10, 64 << 10] {
        let sums = with_structure::<S, _>(capacity, |scene, built, _| Sums::of::<S>(scene, built))?;
        ensure!(sums == expected, "{capacity} bytes: {sums:?} instead of {expected:?}");
    }
    Ok(())
}
