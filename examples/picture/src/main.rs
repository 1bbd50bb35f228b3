//! A picture from firmware: the smallest complete program.
//!
//! `scene.rs` holds the scene, in flash. `terminal.rs` stands in for a display: put the driver of
//! yours in its place, anything that implements `DrawTarget` of embedded-graphics.
#![no_std]
#![no_main]

mod scene;
mod terminal;

use core::fmt::Write;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hio;
use kibiray::accel::{Octree, mailbox, octree::Limits};
use kibiray::memory::Arena;
use kibiray::scene::{Camera, Scene};
use kibiray::trace::{Renderer, Settings, Tracer};
use terminal::{HEIGHT, Terminal, WIDTH};

/// All the memory that grows with the scene. With less the octree is coarser and the picture the same.
const ARENA: usize = 8 * 1024;

#[entry]
fn main() -> ! {
    // `entry` makes this a `&'static mut`: nobody else can have it.
    static mut BYTES: [u8; ARENA] = [0; ARENA];
    let status = match show(BYTES) {
        Ok(()) => EXIT_SUCCESS,
        Err(what) => {
            let _ = hio::hstdout().map(|mut out| out.write_str(what));
            EXIT_FAILURE
        }
    };
    loop {
        debug::exit(status);
    }
}

/// Everything that can go wrong comes back as an error: nothing here can panic.
fn show(bytes: &'static mut [u8]) -> Result<(), &'static str> {
    let mut arena = Arena::new(bytes);

    let scene = Scene::new((&scene::BALLS[..], &scene::FLOOR[..]))
        .and_then(|scene| scene.painted(&scene::MATERIALS, &scene::PAINT))
        .and_then(|scene| scene.lit(&scene::LIGHTS, scene::SKY))
        .map_err(|_| "the scene is refused")?;

    // Cells with more than 4 shapes are divided, at most 6 times, while there is memory.
    let limits = Limits { max_objects: 4, max_level: 6 };
    let octree = Octree::<f32, u16>::build(&scene, limits, &mut arena)
        .map_err(|_| "the arena is too small for a single cell")?;

    let aspect = f32::from(WIDTH) / f32::from(HEIGHT);
    let camera = Camera::new(&scene::VIEW, aspect).map_err(|_| "the camera sees nothing")?;
    let tracer = Tracer::new(&scene, &octree, mailbox::Off, Settings::default());
    let mut renderer = Renderer::new(tracer, camera, WIDTH, HEIGHT);

    let mut display = Terminal::open().ok_or("no terminal")?;
    // A row a call: between them a main loop can do other things.
    while let Ok(true) = renderer.draw_row(&mut display, &mut ()) {}

    let (used, capacity) = (arena.used(), arena.capacity());
    writeln!(display.out, "the octree takes {used} of {capacity} bytes").map_err(|_| "no output")
}

/// Never linked, as nothing panics; the compiler asks for one all the same.
#[panic_handler]
fn panicked(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        debug::exit(EXIT_FAILURE);
    }
}
