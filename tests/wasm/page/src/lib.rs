//! What the page runs: every structure, mailbox and shape, in memory whose size is fixed.
//!
//! A few functions of numbers; what they leave behind is read from memory, where [`report`],
//! [`row`] and [`work`] say it lies. The order of calls is [`select`], [`look`], then [`row`] for
//! every row. Unknown numbers count as the first choice.
#![no_std]

mod accel;
mod report;

use accel::Small;
use core::arch::wasm32::unreachable;
use core::cell::UnsafeCell;
use embedded_graphics_core::pixelcolor::RgbColor;
use kibiray::accel::mailbox::{self, AnyMailbox};
use kibiray::accel::{BuildError, Mailbox};
use kibiray::display::rgb888;
use kibiray::memory::Arena;
use kibiray::num::Vec3;
use kibiray::plan::{Structure, Wishes, plan};
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Scene, Solids, View};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_gallery::{EXHIBITS, Exhibit, Store};
use report::Report;

/// The largest arena.
const ARENA: usize = 1 << 20;

/// The widest picture.
const WIDTH: usize = 1024;

/// Memory of the module's one thread.
#[repr(C, align(8))]
struct Static<T>(UnsafeCell<T>);

// SAFETY: the module has one thread.
unsafe impl<T> Sync for Static<T> {}

impl<T> Static<T> {
    /// Lends the content.
    ///
    /// # Safety
    /// Nothing lent earlier may be used any more.
    #[allow(clippy::mut_from_ref)]
    unsafe fn lend(&self) -> &mut T {
        // SAFETY: as the caller promises.
        unsafe { &mut *self.0.get() }
    }
}

static STORE: Static<Store> = Static(UnsafeCell::new(Store::EMPTY));
static BYTES: Static<[u8; ARENA]> = Static(UnsafeCell::new([0; ARENA]));
/// Of the last row: pixels, and what each of them took.
static PIXELS: Static<[[u8; 4]; WIDTH]> = Static(UnsafeCell::new([[0; 4]; WIDTH]));
static WORK: Static<[u32; WIDTH]> = Static(UnsafeCell::new([0; WIDTH]));
static MODULE: Static<Module> = Static(UnsafeCell::new(Module::EMPTY));

/// A scene with its structure; borrows the store and the bytes.
struct Stage {
    scene: Scene<'static, f32, Solids<'static, f32>>,
    accel: Small<'static>,
    mailbox: AnyMailbox<'static>,
}

/// Everything that calls leave behind.
struct Module {
    exhibit: &'static Exhibit,
    stage: Option<Stage>,
    camera: Option<Camera<f32>>,
    size: (u16, u16),
    counters: Counters,
    report: Report,
    view: [f32; 7],
}

impl Module {
    const EMPTY: Self = Self {
        exhibit: &EXHIBITS[0],
        stage: None,
        camera: None,
        size: (0, 0),
        counters: Counters {
            primitive_tests: 0,
            mailbox_skips: 0,
            list_skips: 0,
            steps: 0,
            leaves: 0,
            empty_leaves: 0,
            primary: kibiray::probe::Rays { shot: 0, hit: 0 },
            shadow: kibiray::probe::Rays { shot: 0, hit: 0 },
            secondary: kibiray::probe::Rays { shot: 0, hit: 0 },
        },
        report: Report::EMPTY,
        view: [0.0; 7],
    };
}

/// The module's memory, for one call from outside.
fn module() -> &'static mut Module {
    // SAFETY: every exported function borrows once, and none calls another.
    unsafe { MODULE.lend() }
}

fn exhibit(scene: u32) -> &'static Exhibit {
    EXHIBITS.get(scene as usize).unwrap_or(&EXHIBITS[0])
}

/// Number of scenes.
#[unsafe(no_mangle)]
pub extern "C" fn scenes() -> u32 {
    EXHIBITS.len() as u32
}

/// Where the name of a scene lies: UTF-8 with a zero at the end.
#[unsafe(no_mangle)]
pub extern "C" fn name(scene: u32) -> *const core::ffi::c_char {
    exhibit(scene).name.as_ptr()
}

/// Where seven `f32` lie: the eye and the middle that a scene is first seen with, and the angle.
#[unsafe(no_mangle)]
pub extern "C" fn view(scene: u32) -> *const f32 {
    let View { from, at, angle, .. } = exhibit(scene).view();
    let numbers = &mut module().view;
    *numbers = [from.x, from.y, from.z, at.x, at.y, at.z, angle];
    numbers.as_ptr()
}

/// Generates a scene and builds a structure (0 by the plan, 1 none, 2 grid, 3 octree, 4 hierarchy) and a mailbox
/// (0 by the plan, 1 off, 2 stamps, 3 cache) into an arena of so many bytes.
///
/// Gives 0; 1 when the memory is too small, and the report says how many bytes it takes; 2 for
/// everything else.
#[unsafe(no_mangle)]
pub extern "C" fn select(scene: u32, structure: u32, mailbox: u32, ram: u32) -> u32 {
    let module = module();
    // From here on nothing borrows the store and the bytes.
    module.stage = None;
    module.exhibit = exhibit(scene);
    module.report = Report::EMPTY;
    // SAFETY: see above.
    let (store, bytes) = unsafe { (STORE.lend(), BYTES.lend()) };
    module.exhibit.fill(store);
    let store: &'static Store = store;
    let wishes = Wishes {
        structure: match structure {
            1 => Some(Structure::Naive),
            2 => Some(Structure::Grid),
            3 => Some(Structure::Octree),
            4 => Some(Structure::Bvh),
            _ => None,
        },
        mailbox: match mailbox {
            1 => Some(mailbox::Kind::Off),
            2 => Some(mailbox::Kind::Stamps),
            3 => Some(mailbox::Kind::Cache),
            _ => None,
        },
        ..Wishes::default()
    };
    let ram = (ram as usize).min(ARENA);
    let Some(bytes) = bytes.get_mut(..ram) else { return 2 };
    let Ok(scene) = store.scene() else { return 2 };
    module.report.scene_bytes = store.bytes() as f64;
    match build(scene, &wishes, bytes, &mut module.report) {
        Ok(stage) => module.stage = Some(stage),
        Err(error) => {
            module.report.refused(&error);
            return if matches!(error, BuildError::Memory(_)) { 1 } else { 2 };
        }
    }
    0
}

fn build(
    scene: Scene<'static, f32, Solids<'static, f32>>,
    wishes: &Wishes,
    bytes: &'static mut [u8],
    report: &mut Report,
) -> Result<Stage, BuildError> {
    let shapes = kibiray::scene::Shapes::bounded(scene.shapes());
    report.shapes = kibiray::scene::Shapes::count(scene.shapes()) as f64;
    let mut arena = Arena::new(bytes);
    let plan = plan(&scene, arena.capacity(), wishes)?;
    report.planned(&plan);
    let mailbox = AnyMailbox::new(plan.mailbox, shapes, &mut arena)?;
    let accel = Small::build(plan.accel, &scene, &mut arena)?;
    report.built(&accel);
    report.memory(&arena);
    Ok(Stage { scene, accel, mailbox })
}

/// Begins a picture of so many pixels, seen from a place. Gives 0, or 1 when nothing can be seen.
#[unsafe(no_mangle)]
pub extern "C" fn look(x: f32, y: f32, z: f32, width: u32, height: u32) -> u32 {
    let module = module();
    let view = View { from: Vec3::<f32>::new(x, y, z), ..module.exhibit.view() };
    module.size = (width.clamp(1, WIDTH as u32) as u16, height.clamp(1, 65_535) as u16);
    module.counters = Counters::default();
    module.camera = Camera::new(&view, f32::from(module.size.0) / f32::from(module.size.1)).ok();
    module.camera.is_none().into()
}

/// A mailbox that stays when the renderer of a row is gone.
struct Lent<'a>(&'a mut AnyMailbox<'static>);

impl Mailbox for Lent<'_> {
    fn next_ray(&mut self) {
        self.0.next_ray();
    }
    fn admit(&mut self, id: usize) -> bool {
        self.0.admit(id)
    }
}

/// Renders a row of the picture. Gives where its pixels lie, four bytes each: red, green, blue, 255.
/// Without a scene or a camera they stay as they are.
#[unsafe(no_mangle)]
pub extern "C" fn row(y: u32) -> *const u8 {
    let Module { stage, camera, size, counters, report, .. } = module();
    // SAFETY: lent nowhere else.
    let (pixels, work) = unsafe { (PIXELS.lend(), WORK.lend()) };
    if let (Some(Stage { scene, accel, mailbox }), Some(camera)) = (stage, camera) {
        let tracer = Tracer::new(scene, accel, Lent(mailbox), Settings::default());
        let mut renderer = Renderer::new(tracer, *camera, size.0, size.1);
        let done = |counters: &Counters| counters.primitive_tests + counters.steps;
        for (x, (pixel, work)) in (0..size.0).zip(pixels.iter_mut().zip(work.iter_mut())) {
            let before = done(counters);
            let color = rgb888::<f32>(renderer.pixel(x, y as u16, counters));
            *pixel = [color.r(), color.g(), color.b(), 255];
            *work = (done(counters) - before) as u32;
        }
        report.counted(counters);
    }
    pixels.as_ptr().cast()
}

/// Where the work of every pixel of the last row lies, a `u32` each: tests and steps of its rays.
#[unsafe(no_mangle)]
pub extern "C" fn work() -> *const u32 {
    WORK.0.get().cast()
}

/// Where the report lies.
#[unsafe(no_mangle)]
pub extern "C" fn report() -> *const u8 {
    (&raw const module().report).cast()
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unreachable()
}
