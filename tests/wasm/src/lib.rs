//! The scenes of `kibiray_scenes` as a WebAssembly module without imports.
//!
//! `render(n)` and `hits(n)` give the checksums of scene number `n`. What cannot be done traps.
#![no_std]

use core::arch::wasm32::unreachable;
use core::cell::UnsafeCell;
use kibiray::accel::{Octree, mailbox};
use kibiray::memory::Arena;
use kibiray::scene::Camera;
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Answers, Checksum, Crc32, Marbles, Subject};

/// Bytes for the structure.
const ARENA: usize = 40 * 1024;

#[repr(C, align(8))]
struct Block(UnsafeCell<[u8; ARENA]>);

// SAFETY: the module has one thread.
unsafe impl Sync for Block {}

static BLOCK: Block = Block(UnsafeCell::new([0; ARENA]));

/// Lends the bytes of the arena.
fn with_arena<T>(work: impl FnOnce(&mut Arena<'_>) -> T) -> T {
    // SAFETY: nothing that runs here calls back into an exported function, so the bytes are lent
    // once at a time.
    let bytes = unsafe { &mut *BLOCK.0.get() };
    work(&mut Arena::new(bytes))
}

/// Renders the picture of a scene. Gives the CRC-32 of its rows of 8-bit RGB.
#[unsafe(no_mangle)]
pub extern "C" fn render(scene: u32) -> u32 {
    let sum = match scene {
        0 => with_arena(picture::<Marbles>),
        _ => None,
    };
    sum.unwrap_or_else(|| unreachable())
}

/// Shoots the rays of a scene. Gives the CRC-32 of the answers.
#[unsafe(no_mangle)]
pub extern "C" fn hits(scene: u32) -> u32 {
    let sum = match scene {
        0 => with_arena(answers::<Marbles>),
        _ => None,
    };
    sum.unwrap_or_else(|| unreachable())
}

fn picture<S: Subject>(arena: &mut Arena<'_>) -> Option<u32> {
    let scene = S::scene().ok()?;
    let octree = Octree::<f32, u16>::build(&scene, S::LIMITS, arena).ok()?;
    let (width, height) = S::SIZE;
    let camera = Camera::new(&S::view(), f32::from(width) / f32::from(height)).ok()?;
    let tracer = Tracer::new(&scene, &octree, mailbox::Off, Settings::default());
    let mut sum = Checksum::new(S::SIZE);
    Renderer::new(tracer, camera, width, height).draw(&mut sum, &mut ()).ok()?;
    sum.finish()
}

fn answers<S: Subject>(arena: &mut Arena<'_>) -> Option<u32> {
    let scene = S::scene().ok()?;
    let octree = Octree::<f32, u16>::build(&scene, S::LIMITS, arena).ok()?;
    let mut sum = Crc32::new();
    Answers::<S, _, _>::new(&scene, &octree, mailbox::Off).for_each(|answer| sum.update(&answer));
    Some(sum.finish())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unreachable()
}
