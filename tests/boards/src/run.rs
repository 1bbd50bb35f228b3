//! One subject on one machine.

use crate::block::Block;
use crate::clock::{self, Stopwatch};
use crate::report::{ArenaUse, Building, Report};
use crate::{report, stack};
use kibiray::accel::octree::StoppedBy;
use kibiray::accel::{Accel, Mailbox, mailbox};
use kibiray::geom::Interval;
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Camera, Scene, SceneError, Shapes, ViewError};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Crc32, Plain, Row, Structure, Subject, answer};
use semihosting::process;

/// Does some work in the memory that is given, and ends the program.
pub fn run<const ARENA: usize, const ROW: usize>(
    arena: &'static Block<ARENA>,
    row: &'static Block<ROW>,
    work: impl FnOnce(&'static mut [u8], &mut [u8]) -> Result<(), &'static str>,
) -> ! {
    clock::start();
    let (Some(arena), Some(row)) = (arena.take(), row.take()) else {
        report::fail("the memory is taken", 1)
    };
    stack::paint();
    match work(arena, row) {
        Ok(()) => process::exit(0),
        Err(what) => report::fail(what, 1),
    }
}

/// Builds a subject's structure, renders its picture, shoots its rays, and prints the report.
///
/// # Errors
/// What went wrong.
#[inline(never)]
pub fn subject<S: Subject>(memory: &'static mut [u8], row: &mut [u8]) -> Result<(), &'static str> {
    // Borrowed where they are: what is taken out of a result is there twice.
    let scene = scene::<S>();
    let Ok(scene) = &scene else { return Err("the scene is refused") };
    let mut built = built::<S>(scene, memory);
    let Built { accel, mailbox, report } = match &mut built {
        Ok(built) => built,
        Err(what) => return Err(what),
    };
    if let Err(what) = picture::<S>(scene, accel, row, report) {
        report.fail(what);
    }
    queries::<S>(scene, accel, mailbox, report);
    report.end();
    Ok(())
}

// Every phase has a frame of its own, so that what it needs for a moment does not stay on the stack
// while rays are traced.

#[inline(never)]
fn scene<S: Subject>() -> Result<Scene<'static, S::Number, S::Shapes>, SceneError> {
    S::scene()
}

/// What is there after the building; the arena, all handed out, is not needed any more.
struct Built<A, M> {
    accel: A,
    mailbox: M,
    report: Report,
}

/// What a subject's structure and mailbox are.
type BuiltOf<S> = Built<
    <<S as Subject>::Structure as Structure<<S as Subject>::Number>>::Built<'static>,
    <<S as Subject>::Structure as Structure<<S as Subject>::Number>>::Mailbox<'static>,
>;

#[inline(never)]
fn built<S: Subject>(
    scene: &Scene<'_, S::Number, S::Shapes>,
    memory: &'static mut [u8],
) -> Result<BuiltOf<S>, &'static str> {
    let mut arena = Arena::new(memory);
    let mut build = Stopwatch::default();
    let accel =
        build.time(|| S::Structure::build(scene, &mut arena)).map_err(|_| "no structure")?;
    let mailbox = S::Structure::mailbox(scene.shapes().count(), &mut arena);
    let mailbox = mailbox.map_err(|_| "no mailbox")?;
    let report = Report::begin(&Building {
        scene: S::NAME,
        structure: S::Structure::NAME,
        stopped_by: S::Structure::stopped_by(&accel),
        arena: ArenaUse {
            capacity: arena.capacity(),
            used: arena.used(),
            high_water: arena.high_water(),
            parts: arena.parts(),
        },
        instructions: build.instructions(),
    });
    Ok(Built { accel, mailbox, report })
}

#[inline(never)]
fn renderer<'a, S: Subject, A: Accel<S::Number>>(
    scene: &'a Scene<'a, S::Number, S::Shapes>,
    accel: &'a A,
) -> Result<Renderer<'a, S::Number, S::Shapes, A, mailbox::Off>, ViewError> {
    let (width, height) = S::SIZE;
    let camera = Camera::new(&S::view(), S::Number::fraction(width.into(), height.into()))?;
    let settings = Settings { max_depth: S::DEPTH, ..Settings::default() };
    Ok(Renderer::new(Tracer::new(scene, accel, mailbox::Off, settings), camera, width, height))
}

/// Reports the checksum of a subject's picture, and instructions a pixel. The clock stands while a
/// row is summed up.
#[inline(never)]
fn picture<S: Subject>(
    scene: &Scene<'_, S::Number, S::Shapes>,
    accel: &impl Accel<S::Number>,
    row: &mut [u8],
    report: &mut Report,
) -> Result<(), &'static str> {
    let (_, height) = S::SIZE;
    if height == 0 {
        report.picture(0, 0);
        return Ok(());
    }
    let mut renderer = renderer::<S, _>(scene, accel);
    let Ok(renderer) = &mut renderer else { return Err("no camera") };
    let mut row = Row::new(row, height);
    let (mut sum, mut render) = (Crc32::new(), Stopwatch::default());
    for _ in 0..height {
        let drawn = render.time(|| renderer.draw_row(&mut row, &mut ()));
        drawn.map_err(|_| "rows out of order")?;
        sum.update(row.bytes());
    }
    report.picture(sum.finish(), per_pixel(render, S::SIZE));
    Ok(())
}

/// Reports the checksum of the answers to a subject's queries, and instructions a ray for the nearest
/// hit and for any.
#[inline(never)]
fn queries<S: Subject>(
    scene: &Scene<'_, S::Number, S::Shapes>,
    accel: &impl Accel<S::Number>,
    mailbox: &mut impl Mailbox,
    report: &mut Report,
) {
    let (mut sum, mut rays) = (Crc32::new(), 0_u64);
    let (mut nearest, mut any) = (Stopwatch::default(), Stopwatch::default());
    for shot in S::rays() {
        let hit = nearest.time(|| accel.nearest(scene, &shot.ray, Interval::RAY, mailbox, &mut ()));
        let blocked = any.time(|| accel.occluded(scene, &shot.ray, shot.between, mailbox, &mut ()));
        sum.update(&answer(hit, blocked));
        rays += 1;
    }
    let per_ray = |watch: Stopwatch| watch.instructions().checked_div(rays).unwrap_or(0);
    report.queries(sum.finish(), per_ray(nearest), per_ray(any));
}

fn per_pixel(watch: Stopwatch, (width, height): (u16, u16)) -> u64 {
    let pixels = u64::from(width) * u64::from(height);
    watch.instructions().checked_div(pixels).unwrap_or(0)
}

/// Renders the card's picture by the plain program, and prints the report.
///
/// # Errors
/// What went wrong.
#[inline(never)]
pub fn plain(_memory: &mut [u8], row: &mut [u8]) -> Result<(), &'static str> {
    let picture = Plain::new();
    let (mut sum, mut render) = (Crc32::new(), Stopwatch::default());
    for y in 0..Plain::SIZE.1 {
        render.time(|| picture.row(y, row));
        sum.update(row);
    }
    let mut report = Report::begin(&Building {
        scene: "card_plain",
        structure: "plain",
        stopped_by: StoppedBy::Done,
        arena: ArenaUse::default(),
        instructions: 0,
    });
    report.picture(sum.finish(), per_pixel(render, Plain::SIZE));
    report.queries(0, 0, 0);
    report.end();
    Ok(())
}
