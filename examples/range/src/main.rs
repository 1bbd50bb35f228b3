//! A range sensor: ray queries without a picture, on a chip with 16 KiB of RAM and no floats.
//!
//! `scene.rs` holds what stands around the sensor, in flash. Nothing here renders, so nothing that
//! renders is in the image.
#![no_std]
#![no_main]

mod scene;

use core::fmt::Write;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hio::{self, HostStream};
use kibiray::accel::{Accel, Octree, mailbox, octree::Limits};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::scene::Scene;

/// All the memory that grows with the scene. With less the octree is coarser and the distances are
/// the same.
const ARENA: usize = 2 * 1024;

#[entry]
fn main() -> ! {
    // `entry` makes this a `&'static mut`: nobody else can have it.
    static mut BYTES: [u8; ARENA] = [0; ARENA];
    let status = match hio::hstdout() {
        Err(()) => EXIT_FAILURE,
        Ok(mut out) => match sweep(BYTES, &mut out) {
            Ok(()) => EXIT_SUCCESS,
            Err(what) => {
                let _ = out.write_str(what);
                EXIT_FAILURE
            }
        },
    };
    loop {
        debug::exit(status);
    }
}

/// Everything that can go wrong comes back as an error: nothing here can panic.
fn sweep(bytes: &'static mut [u8], out: &mut HostStream) -> Result<(), &'static str> {
    let mut arena = Arena::new(bytes);
    let scene =
        Scene::new((&scene::BALLS[..], &scene::BOXES[..])).map_err(|_| "a shape is refused")?;

    // Cells with more than 2 shapes are divided, at most 6 times, while there is memory.
    let limits = Limits { max_objects: 2, max_level: 6 };
    let octree = Octree::<f32, u16>::build(&scene, limits, &mut arena)
        .map_err(|_| "the arena is too small for a single cell")?;

    let mut beam = scene::FIRST;
    for step in 0..scene::BEAMS {
        // A direction of length 1: the parameter of a hit is a distance.
        let ray = Ray::new(scene::SENSOR, beam).map_err(|_| "not a ray")?;
        let within = Interval::new(0.0, scene::REACH);
        let hit = octree.nearest(&scene, &ray, within, &mut mailbox::Off, &mut ());
        let degrees = (step - scene::BEAMS / 2) * scene::DEGREES;
        report(out, degrees, hit.map(|hit| hit.t)).map_err(|_| "no output")?;
        beam = scene::turned(beam);
    }
    let (used, capacity) = (arena.used(), arena.capacity());
    writeln!(out, "the octree takes {used} of {capacity} bytes").map_err(|_| "no output")
}

/// A line for a beam: whole millimetres, the very bits of the distance, and a bar.
fn report(out: &mut HostStream, degrees: i32, distance: Option<f32>) -> core::fmt::Result {
    let Some(distance) = distance else { return writeln!(out, "{degrees:4} deg  nothing") };
    let millimetres = (distance * 1000.0) as u32;
    write!(out, "{degrees:4} deg {millimetres:5} mm {:08x} ", distance.to_bits())?;
    for _ in 0..millimetres / 150 {
        out.write_char('=')?;
    }
    out.write_str("\n")
}

/// Never linked, as nothing panics; the compiler asks for one all the same.
#[panic_handler]
fn panicked(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        debug::exit(EXIT_FAILURE);
    }
}
