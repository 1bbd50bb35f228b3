//! What the host computes from the same scenes.

use anyhow::{Context, Result, anyhow, ensure};
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use kibiray::accel::octree::StoppedBy;
use kibiray::accel::{Accel, Naive, Octree, mailbox};
use kibiray::memory::Arena;
use kibiray::scene::{Camera, Scene};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Answers, Subject};
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

impl Sums {
    fn of<S: Subject>(
        scene: &Scene<'static, f32, S::Shapes>,
        accel: &impl Accel<f32>,
    ) -> Result<Self> {
        let (width, height) = S::SIZE;
        let camera = Camera::new(&S::view(), f32::from(width) / f32::from(height))?;
        let tracer = Tracer::new(scene, accel, mailbox::Off, Settings::default());
        let bytes = usize::from(width) * usize::from(height) * 3;
        let mut picture = Picture { size: S::SIZE, rows: vec![0; bytes] };
        Renderer::new(tracer, camera, width, height).draw(&mut picture, &mut ())?;
        let answers: Vec<_> = Answers::<S, _, _>::new(scene, accel, mailbox::Off).collect();
        let hex = |bytes: &[u8]| format!("{:08x}", crc32fast::hash(bytes));
        Ok(Self { image: hex(&picture.rows), hits: hex(answers.as_flattened()) })
    }

    /// By testing every shape.
    pub(crate) fn of_naive<S: Subject>() -> Result<Self> {
        let scene = S::scene()?;
        Self::of::<S>(&scene, &Naive::new(&scene))
    }
}

/// Bytes of an arena that go by a name.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct Part {
    name: String,
    bytes: usize,
}

/// How an arena is used.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct Memory {
    /// Its bytes.
    pub(crate) capacity: usize,
    used: usize,
    high_water: usize,
    parts: Vec<Part>,
}

/// Builds a subject's octree in an arena and does something with it.
fn with_octree<S: Subject, T>(
    capacity: usize,
    work: impl FnOnce(&Scene<'static, f32, S::Shapes>, &Octree<'_, f32, u16>, &Arena<'_>) -> Result<T>,
) -> Result<T> {
    let mut memory = kibiray_tests::Memory::new(capacity);
    let mut arena = Arena::new(memory.bytes(capacity));
    let scene = S::scene()?;
    let octree = Octree::build(&scene, S::LIMITS, &mut arena)?;
    work(&scene, &octree, &arena)
}

/// How a subject's octree uses an arena of that capacity, and why it is not finer.
pub(crate) fn arena<S: Subject>(capacity: usize) -> Result<(Memory, &'static str)> {
    with_octree::<S, _>(capacity, |_, octree, arena| {
        let part =
            |part: &kibiray::memory::Part| Part { name: part.name.into(), bytes: part.bytes };
        let memory = Memory {
            capacity: arena.capacity(),
            used: arena.used(),
            high_water: arena.high_water(),
            parts: arena.parts().iter().map(part).collect(),
        };
        let stopped_by = match octree.stopped_by() {
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
    let least = with_octree::<S, _>(0, |_, _, _| Ok(())).err();
    let least = least.context("an octree of no bytes")?;
    let least = match least.downcast_ref() {
        Some(kibiray::accel::BuildError::Memory(out)) => out.needed,
        _ => return Err(anyhow!("no bytes are refused for another reason: {least:#}")),
    };
    for capacity in [least, 2 << 10, 8 << 10, 64 << 10] {
        let sums = with_octree::<S, _>(capacity, |scene, octree, _| Sums::of::<S>(scene, octree))?;
        ensure!(sums == expected, "{capacity} bytes: {sums:?} instead of {expected:?}");
    }
    Ok(())
}
