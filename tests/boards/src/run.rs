//! One subject on one machine.

use crate::block::Block;
use crate::report::{ArenaUse, Report};
use crate::{clock, report, stack};
use kibiray::accel::{Octree, mailbox};
use kibiray::memory::Arena;
use kibiray::scene::Camera;
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Answers, Checksum, Crc32, Subject};
use semihosting::process;

/// Builds a subject's octree, renders its picture, shoots its rays, prints the report and ends the
/// program.
pub fn run<S: Subject>(memory: &'static Block<{ crate::machine::ARENA }>) -> ! {
    clock::start();
    let Some(memory) = memory.take() else { report::fail("the arena is taken", 1) };
    match work::<S>(memory) {
        Ok(()) => process::exit(0),
        Err(what) => report::fail(what, 1),
    }
}

#[inline(never)]
fn work<S: Subject>(memory: &mut [u8]) -> Result<(), &'static str> {
    let mut arena = Arena::new(memory);
    stack::paint();

    let scene = S::scene().map_err(|_| "the scene is refused")?;
    let (build, octree) = clock::count(|| Octree::<f32, u16>::build(&scene, S::LIMITS, &mut arena));
    let octree = octree.map_err(|_| "no octree")?;

    let (width, height) = S::SIZE;
    let camera = Camera::new(&S::view(), f32::from(width) / f32::from(height));
    let camera = camera.map_err(|_| "no camera")?;
    let tracer = Tracer::new(&scene, &octree, mailbox::Off, Settings::default());
    let mut renderer = Renderer::new(tracer, camera, width, height);
    let mut picture = Checksum::new(S::SIZE);
    let (render, drawn) = clock::count(|| renderer.draw(&mut picture, &mut ()));
    drawn.map_err(|_| "pixels out of order")?;

    let mut hits = Crc32::new();
    let answers = Answers::<S, _, _>::new(&scene, &octree, mailbox::Off);
    let (shoot, ()) = clock::count(|| answers.for_each(|answer| hits.update(&answer)));

    let stack = stack::high_water();
    if stack + 4 > stack::capacity() {
        return Err("the stack ran into the statics");
    }
    let pixels = u64::from(width) * u64::from(height);
    report::print(&Report {
        scene: S::NAME,
        image_crc32: picture.finish().ok_or("pixels are missing")?,
        hits_crc32: hits.finish(),
        stopped_by: octree.stopped_by(),
        arena: ArenaUse {
            capacity: arena.capacity(),
            used: arena.used(),
            high_water: arena.high_water(),
            parts: arena.parts(),
        },
        stack,
        build,
        per_pixel: render.checked_div(pixels).unwrap_or(0),
        per_ray: shoot.checked_div(S::RAYS.into()).unwrap_or(0),
    });
    Ok(())
}
