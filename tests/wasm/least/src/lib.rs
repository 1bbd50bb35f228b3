//! The smallest module: spheres in an octree, rendered. What cannot be done traps.
#![no_std]

use core::arch::wasm32::unreachable;
use embedded_graphics_core::pixelcolor::RgbColor;
use kibiray::accel::{Octree, mailbox, octree::Limits};
use kibiray::display::rgb888;
use kibiray::memory::Arena;
use kibiray::scene::Camera;
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_gallery::least;
use kibiray_scenes::Crc32;

/// Renders the scene. Gives the CRC-32 of its rows of 8-bit RGB.
#[unsafe(no_mangle)]
pub extern "C" fn render(width: u16, height: u16) -> u32 {
    picture(width, height).unwrap_or_else(|| unreachable())
}

fn picture(width: u16, height: u16) -> Option<u32> {
    let mut bytes = [0; 2048];
    let scene = least::scene().ok()?;
    let limits = Limits { max_objects: 2, max_level: 6 };
    let octree = Octree::<f32, u16>::build(&scene, limits, &mut Arena::new(&mut bytes)).ok()?;
    let camera = Camera::new(&least::VIEW, f32::from(width) / f32::from(height)).ok()?;
    let tracer = Tracer::new(&scene, &octree, mailbox::Off, Settings::default());
    let mut renderer = Renderer::new(tracer, camera, width, height);
    let mut sum = Crc32::new();
    for y in 0..height {
        for x in 0..width {
            let color = rgb888::<f32>(renderer.pixel(x, y, &mut ()));
            sum.update(&[color.r(), color.g(), color.b()]);
        }
    }
    Some(sum.finish())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unreachable()
}
