//! What the host renders and plans for the same scenes.

use anyhow::{Context, Result};
use embedded_graphics_core::pixelcolor::RgbColor;
use kibiray::accel::octree::Limits;
use kibiray::accel::{Accel, BuildError, Naive, Octree, mailbox};
use kibiray::display::rgb888;
use kibiray::memory::Arena;
use kibiray::num::Vec3;
use kibiray::plan::{Structure, Wishes, plan};
use kibiray::scene::{Camera, Scene, Shapes, View};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_gallery::{EXHIBITS, Store};

/// CRC-32 of a picture as rows of 8-bit RGB, in hexadecimal.
fn picture<S: Shapes<f32>>(
    scene: &Scene<'_, f32, S>,
    accel: &impl Accel<f32>,
    view: &View<f32>,
    (width, height): (u16, u16),
) -> Result<String> {
    let camera = Camera::new(view, f32::from(width) / f32::from(height))?;
    let tracer = Tracer::new(scene, accel, mailbox::Off, Settings::default());
    let mut renderer = Renderer::new(tracer, camera, width, height);
    let mut sum = crc32fast::Hasher::new();
    for y in 0..height {
        for x in 0..width {
            let color = rgb888::<f32>(renderer.pixel(x, y, &mut ()));
            sum.update(&[color.r(), color.g(), color.b()]);
        }
    }
    Ok(format!("{:08x}", sum.finalize()))
}

/// The picture of the smallest module, by testing every shape.
pub(crate) fn least(width: u16, height: u16) -> Result<String> {
    let scene = kibiray_gallery::least::scene()?;
    picture(&scene, &Naive::new(&scene), &kibiray_gallery::least::VIEW, (width, height))
}

/// Does something with a scene of the gallery.
fn with_scene<T>(
    number: usize,
    work: impl FnOnce(&Scene<'_, f32, kibiray::scene::Solids<'_, f32>>, View<f32>) -> Result<T>,
) -> Result<T> {
    let exhibit = EXHIBITS.get(number).context("a scene")?;
    let mut store = Box::new(Store::EMPTY);
    exhibit.fill(&mut store);
    work(&store.scene()?, exhibit.view())
}

/// The picture of a scene, from its first view or from elsewhere. The octree is not the page's.
pub(crate) fn render(number: usize, eye: Option<[f32; 3]>, size: (u16, u16)) -> Result<String> {
    with_scene(number, |scene, view| {
        let from = eye.map_or(view.from, Vec3::<f32>::from);
        let mut memory = kibiray_tests::Memory::new(4 << 20);
        let mut arena = Arena::new(memory.bytes(4 << 20));
        let limits = Limits { max_objects: 2, max_level: 7 };
        let octree = Octree::<f32, u16>::build(scene, limits, &mut arena)?;
        picture(scene, &octree, &View { from, ..view }, size)
    })
}

/// Bytes that the smallest octree of a scene takes, when there are too few.
pub(crate) fn octree_needs(number: usize, budget: usize) -> Result<usize> {
    with_scene(number, |scene, _| {
        let wishes = Wishes { structure: Some(Structure::Octree), ..Wishes::default() };
        match plan(scene, budget, &wishes) {
            Err(BuildError::Memory(memory)) => Ok(memory.needed),
            other => anyhow::bail!("{other:?} in {budget} bytes"),
        }
    })
}
