//! One run: the arena, the plan, mailboxes and structure, and threads that trace.

use std::sync::Mutex;
use std::time::Instant;

use cpu_time::ProcessTime;
use kibiray::accel::mailbox::{self, AnyMailbox};
use kibiray::accel::{self, BuildError, octree};
use kibiray::memory::{Arena, OutOfArena};
use kibiray::num::{Real, Vec3};
use kibiray::plan::{Plan, Structure, Wishes, plan};
use kibiray::scene::{Scene, Shapes};
use kibiray::trace::{Adaptive, MOST_LEVELS, Middle, Sampling, Tracer, Uniform};

use crate::costs::Costs;
use crate::options::{
    AccelKind, Antialiasing, Common, Growth, Huge, ListKind, MailboxKind, Overlap, Skip, Store,
    Switch, Walk,
};
use crate::structure;
use crate::tables::HostShapes;

/// What traces on this host.
pub type HostTracer<'a, R> =
    Tracer<'a, R, HostShapes<'a, R>, structure::Structure<'a, R>, HostMailbox<'a>>;

/// What remembers, on this host, which shapes a ray has been tested against.
pub type HostMailbox<'a> = mailbox::Lists<AnyMailbox<'a>>;

/// Bytes that an arena lies in.
#[derive(Debug)]
pub struct Memory {
    words: Vec<u64>,
    bytes: usize,
}

impl Memory {
    /// So many bytes, starting at a multiple of 8.
    ///
    /// # Errors
    /// This host has not got them.
    pub fn new(bytes: usize) -> anyhow::Result<Self> {
        let words = bytes.div_ceil(8);
        // Asks politely first: an allocation that fails ends the program.
        Vec::<u64>::new()
            .try_reserve_exact(words)
            .map_err(|_| anyhow::anyhow!("this host has no {bytes} bytes for --ram"))?;
        Ok(Self { words: vec![0; words], bytes })
    }

    /// The arena over them.
    pub fn arena(&mut self) -> Arena<'_> {
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut self.words);
        Arena::new(&mut bytes[..self.bytes])
    }
}

/// What the options wish for.
pub fn wishes(options: &Common) -> Wishes {
    Wishes {
        structure: match options.accel {
            AccelKind::Auto => None,
            // Trees are not the plan's; it only sees to the mailbox.
            AccelKind::Naive | AccelKind::Tree | AccelKind::Sorted | AccelKind::Bounded => {
                Some(Structure::Naive)
            }
            AccelKind::Grid => Some(Structure::Grid),
            AccelKind::Octree => Some(Structure::Octree),
            AccelKind::Bvh => Some(Structure::Bvh),
        },
        mailbox: match options.mailbox {
            MailboxKind::Auto => None,
            MailboxKind::Off => Some(mailbox::Kind::Off),
            MailboxKind::Stamp => Some(mailbox::Kind::Stamps),
            MailboxKind::Cache => Some(mailbox::Kind::Cache),
        },
        clipped: options.does(Skip::Box).then_some(false),
        resolution: options.grid,
        max_objects: options.max_objects,
        max_level: options.max_level,
        macro_cells: options.macro_cells.map(|switch| switch == Switch::On),
        huge: options.huge.map(|huge| match huge {
            Huge::Inside => accel::Huge::Inside,
            Huge::Aside => accel::Huge::Aside,
        }),
        overlap: options.overlap.map(|overlap| match overlap {
            Overlap::Box => accel::Overlap::Box,
            Overlap::Exact => accel::Overlap::Exact,
        }),
        order: options.growth.map(|growth| match growth {
            Growth::Fifo => octree::Order::Breadth,
            Growth::Benefit => octree::Order::Benefit,
        }),
        shared: options.lists.map(|lists| lists == ListKind::Shared),
        store: options.store.map(|store| match store {
            Store::Links => octree::Store::Links,
            Store::Hash => octree::Store::Hashed,
            Store::Implicit => octree::Store::Implicit,
        }),
        walk: options.walk.and_then(|walk| match walk {
            Walk::Restart => Some(octree::Walk::Restart),
            Walk::Neighbours => Some(octree::Walk::Neighbours),
            Walk::Descent => Some(octree::Walk::Descent),
            Walk::Segments => Some(octree::Walk::Segments),
            Walk::Ordered | Walk::Heap | Walk::Stored => None,
        }),
    }
}

/// The plan for several threads, each with a mailbox of its own: all of them fit the budget.
///
/// # Errors
/// As [`plan`]; the bytes needed are those for all threads.
pub fn plan_for_threads<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    budget: usize,
    wishes: &Wishes,
    threads: usize,
) -> Result<Plan, BuildError> {
    let first = plan(scene, budget, wishes);
    if threads <= 1 {
        return first;
    }
    let shapes = scene.shapes().bounded();
    let all = |kind: mailbox::Kind| kind.footprint(shapes).kept.saturating_mul(threads);
    let mailbox = match (wishes.mailbox, first) {
        (Some(mailbox), _) => mailbox,
        (None, first) => {
            // Without a wish they take no more of the memory than one would.
            let one = first?.mailbox;
            [one, mailbox::Kind::Cache]
                .into_iter()
                .find(|kind| one != mailbox::Kind::Off && all(*kind) <= budget / 8)
                .unwrap_or(mailbox::Kind::Off)
        }
    };
    let others = all(mailbox) - mailbox.footprint(shapes).kept;
    let wishes = Wishes { mailbox: Some(mailbox), ..*wishes };
    // Where nothing remains for the first one, that one does not fit either.
    let planned = plan(scene, budget.saturating_sub(others), &wishes);
    planned.map_err(|error| match error {
        BuildError::Memory(memory) => {
            let needed = memory.needed.saturating_add(others);
            OutOfArena { needed, available: budget }.into()
        }
        error => error,
    })
}

/// What pictures need of the arena.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u16,
    /// Rays a pixel.
    pub aa: Antialiasing,
}

impl Picture {
    /// Where there is none.
    pub const NONE: Self = Self { width: 0, aa: Antialiasing::Off };

    fn sampling<'m, R: Real>(
        self,
        arena: &mut Arena<'m>,
    ) -> Result<AnySampling<'m, R>, OutOfArena> {
        Ok(match self.aa {
            Antialiasing::Off => AnySampling::Middle(Middle),
            Antialiasing::Uniform(n) => AnySampling::Uniform(Uniform(n)),
            Antialiasing::Adaptive(threshold) => {
                let threshold = R::from_f64(threshold);
                AnySampling::Adaptive(Adaptive::new(self.width, threshold, MOST_LEVELS, arena)?)
            }
        })
    }
}

/// Any way to sample, chosen at run time.
#[derive(Debug)]
#[allow(missing_docs)]
pub enum AnySampling<'m, R: Real> {
    Middle(Middle),
    Uniform(Uniform),
    Adaptive(Adaptive<'m, R>),
}

impl<R: Real> Sampling<R> for AnySampling<'_, R> {
    fn parts(&self) -> i32 {
        match self {
            Self::Middle(it) => Sampling::<R>::parts(it),
            Self::Uniform(it) => Sampling::<R>::parts(it),
            Self::Adaptive(it) => it.parts(),
        }
    }

    fn pixel(&mut self, x: u16, y: u16, see: &mut impl FnMut(i32, i32) -> Vec3<R>) -> Vec3<R> {
        match self {
            Self::Middle(it) => Sampling::<R>::pixel(it, x, y, see),
            Self::Uniform(it) => Sampling::<R>::pixel(it, x, y, see),
            Self::Adaptive(it) => it.pixel(x, y, see),
        }
    }
}

/// A structure, mailboxes and what is remembered of a picture, in an arena.
#[derive(Debug)]
pub struct Built<'m, R: Real> {
    /// What was decided.
    pub plan: Plan,
    /// The structure.
    pub accel: structure::Structure<'m, R>,
    /// A mailbox a thread.
    pub mailboxes: Vec<HostMailbox<'m>>,
    /// How to sample, a thread.
    pub samplings: Vec<AnySampling<'m, R>>,
    /// How long all that took.
    pub pass: Pass,
}

impl<'m, R: Real> Built<'m, R> {
    /// Plans, then takes mailboxes and structure out of the arena.
    ///
    /// # Errors
    /// Too little memory, or limits that the structure does not have.
    pub fn new<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        options: &Common,
        picture: Picture,
        costs: &Costs,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let clock = Clock::start();
        let threads = usize::from(options.threads);
        let samplings = (0..threads).map(|_| picture.sampling(arena)).collect::<Result<_, _>>()?;
        let (budget, taken) = (arena.available(), arena.used());
        let plan =
            plan_for_threads(scene, budget, &wishes(&options.clone().without_skips()), threads);
        let plan = plan.map_err(|error| match error {
            BuildError::Memory(OutOfArena { needed, available }) => {
                let needed = needed.saturating_add(taken);
                OutOfArena { needed, available: available.saturating_add(taken) }.into()
            }
            error => error,
        })?;
        let shapes = scene.shapes().bounded();
        let mailboxes = (0..threads)
            .map(|_| {
                let shapes = AnyMailbox::new(plan.mailbox, shapes, arena)?;
                Ok(mailbox::Lists::new(shapes, options.shares_lists()))
            })
            .collect::<Result<_, OutOfArena>>()?;
        let accel = structure::Structure::build(options, plan.accel, scene, costs, arena)?;
        Ok(Self { plan, accel, mailboxes, samplings, pass: clock.stop() })
    }

    /// The mailbox's name on the command line.
    pub fn mailbox_name(&self) -> &'static str {
        match self.plan.mailbox {
            mailbox::Kind::Off => "off",
            mailbox::Kind::Stamps => "stamp",
            mailbox::Kind::Cache => "cache",
        }
    }
}

/// How long a pass took.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pass {
    /// By the clock on the wall.
    pub wall_s: f64,
    /// By the processor, all threads together.
    pub cpu_s: f64,
}

/// Runs `pass` so many times; the fastest counts.
pub fn fastest(repeat: u32, mut pass: impl FnMut()) -> Pass {
    let mut best: Option<Pass> = None;
    for _ in 0..repeat {
        let measured = timed(&mut pass);
        if best.is_none_or(|best| measured.wall_s < best.wall_s) {
            best = Some(measured);
        }
    }
    best.unwrap_or_default()
}

/// Runs `pass` once.
pub fn timed(pass: impl FnOnce()) -> Pass {
    let clock = Clock::start();
    pass();
    clock.stop()
}

/// Both clocks, running.
struct Clock {
    wall: Instant,
    cpu: ProcessTime,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), cpu: ProcessTime::now() }
    }

    fn stop(self) -> Pass {
        Pass { wall_s: self.wall.elapsed().as_secs_f64(), cpu_s: self.cpu.elapsed().as_secs_f64() }
    }
}

/// Has every worker take jobs until none is left. One worker stays on this thread.
pub fn share<W: Send, J: Send>(
    workers: &mut [W],
    jobs: impl Iterator<Item = J> + Send,
    work: impl Fn(&mut W, J) + Sync,
) {
    let jobs = Mutex::new(jobs);
    let next = || match jobs.lock() {
        Ok(mut jobs) => jobs.next(),
        Err(_) => None,
    };
    let run = |worker: &mut W| {
        while let Some(job) = next() {
            work(worker, job);
        }
    };
    match workers {
        [] => {}
        [worker] => run(worker),
        [first, others @ ..] => std::thread::scope(|scope| {
            for worker in others {
                scope.spawn(|| run(worker));
            }
            run(first);
        }),
    }
}
