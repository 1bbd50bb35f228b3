//! The scenes of `kibiray_scenes` as a WebAssembly module without imports.
//!
//! `render(n)` and `hits(n)` give the checksums of scene number `n`, in the order of
//! `kibiray_scenes::all`. What cannot be done traps.
#![no_std]

use core::arch::wasm32::unreachable;
use core::cell::UnsafeCell;
use kibiray::accel::{Accel, mailbox};
use kibiray::geom::Interval;
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Camera, Shapes};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Crc32, Each, Row, Structure, Subject, answer};

/// Bytes for the structure.
const ARENA: usize = 52 * 1024;

/// The widest picture.
const COLUMNS: usize = 320;

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
    sum(scene, true)
}

/// Shoots the rays of a scene. Gives the CRC-32 of the answers.
#[unsafe(no_mangle)]
pub extern "C" fn hits(scene: u32) -> u32 {
    sum(scene, false)
}

fn sum(scene: u32, picture: bool) -> u32 {
    let mut wanted = Wanted { left: scene, picture, sum: None };
    kibiray_scenes::all(&mut wanted);
    wanted.sum.unwrap_or_else(|| unreachable())
}

/// The checksum of a picture or of answers, of one subject out of all.
struct Wanted {
    left: u32,
    picture: bool,
    sum: Option<u32>,
}

impl Each for Wanted {
    fn subject<S: Subject>(&mut self) {
        if self.left == 0 {
            self.sum = with_arena(if self.picture { picture::<S> } else { answers::<S> });
        }
        self.left = self.left.wrapping_sub(1);
    }
}

fn picture<S: Subject>(arena: &mut Arena<'_>) -> Option<u32> {
    let scene = S::scene().ok()?;
    let accel = S::Structure::build(&scene, arena).ok()?;
    let (width, height) = S::SIZE;
    if height == 0 {
        return Some(0);
    }
    let camera = Camera::new(&S::view(), S::Number::fraction(width.into(), height.into())).ok()?;
    let settings = Settings { max_depth: S::DEPTH, ..Settings::default() };
    let tracer = Tracer::new(&scene, &accel, mailbox::Off, settings);
    let mut renderer = Renderer::new(tracer, camera, width, height);
    let mut bytes = [0; 3 * COLUMNS];
    let mut row = Row::new(bytes.get_mut(..3 * usize::from(width))?, height);
    let mut sum = Crc32::new();
    for _ in 0..height {
        renderer.draw_row(&mut row, &mut ()).ok()?;
        sum.update(row.bytes());
    }
    Some(sum.finish())
}

fn answers<S: Subject>(arena: &mut Arena<'_>) -> Option<u32> {
    let scene = S::scene().ok()?;
    let accel = S::Structure::build(&scene, arena).ok()?;
    let mut mailbox = S::Structure::mailbox(scene.shapes().count(), arena).ok()?;
    let mut sum = Crc32::new();
    for shot in S::rays() {
        let hit = accel.nearest(&scene, &shot.ray, Interval::RAY, &mut mailbox, &mut ());
        let blocked = accel.occluded(&scene, &shot.ray, shot.between, &mut mailbox, &mut ());
        sum.update(&answer(hit, blocked));
    }
    Some(sum.finish())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unreachable()
}
