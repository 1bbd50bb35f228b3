//! Helpers shared by the test programs of kibiray.

mod combined;
pub mod oracle;
mod world;

pub use combined::{SHOWPIECES, combined_scenes};
pub use world::{World, WorldTables};

use kibiray::accel::{
    Accel, Any, BuildError, Hit, Huge, Kind, Overlap, bvh, grid, mailbox, octree,
};
use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes, View};

/// Every SPD generator, small enough to test each ray against every primitive.
pub const SMALL_SCENES: [&str; 11] = [
    "spd:balls:2",
    "spd:gears:1",
    "spd:mount:4",
    "spd:rings:2",
    "spd:teapot:2",
    "spd:tetra:4",
    "spd:tree:5",
    "spd:lattice:3",
    "spd:shells:1",
    "spd:sombrero:1",
    "spd:jacks:2",
];

/// A block of memory that starts where every number type may.
#[derive(Debug)]
pub struct Memory(Vec<u64>);

impl Memory {
    /// At least so many bytes.
    pub fn new(bytes: usize) -> Self {
        Self(vec![0xa5a5_a5a5_a5a5_a5a5; bytes.div_ceil(8)])
    }

    /// The first `len` of them.
    pub fn bytes(&mut self, len: usize) -> &mut [u8] {
        &mut bytemuck::cast_slice_mut(&mut self.0)[..len]
    }
}

/// A ray and where its hits count.
pub type Shot<R> = (Ray<R>, Interval<R>);

/// Seeded rays of all sorts around a scene, `count` in all: through the picture, from anywhere to
/// anywhere, along the axes (on grids of round coordinates, where walls and faces lie), from far
/// away, with long and short directions, with bounded intervals.
pub fn shots<R: Real>(bounds: Aabb<R>, view: &View<R>, count: usize, seed: u64) -> Vec<Shot<R>> {
    let mut rng = fastrand::Rng::with_seed(seed);
    let lo = bounds.lo.to_array().map(R::to_f64);
    let size = bounds.size().to_array().map(R::to_f64);
    let diagonal = size.iter().map(|s| s * s).sum::<f64>().sqrt();
    let eye = view.from.to_array().map(R::to_f64);

    let mut shots = Vec::with_capacity(count);
    while shots.len() < count {
        let inside = |rng: &mut fastrand::Rng| [0, 1, 2].map(|a| lo[a] + size[a] * rng.f64());
        // Sixteenths of the box: where walls of grids and octrees may be.
        let lattice = |rng: &mut fastrand::Rng| {
            [0, 1, 2].map(|a| lo[a] + size[a] * f64::from(rng.u8(0..=16)) / 16.0)
        };
        let target = inside(&mut rng);
        let mut interval = Interval::RAY;
        let (origin, to) = match rng.u8(0..8) {
            0 | 1 => (eye, target),
            2 => (inside(&mut rng), target),
            3 => {
                let (from, axis) = (lattice(&mut rng), rng.usize(0..3));
                let mut origin = from;
                let sign = if rng.bool() { 1.0 } else { -1.0 };
                origin[axis] -= sign * diagonal * f64::from(rng.u8(0..3));
                let mut to = origin;
                to[axis] += sign;
                (origin, to)
            }
            4 => (lattice(&mut rng), lattice(&mut rng)),
            5 => {
                let far = 10_f64.powi(rng.i32(1..6)) * diagonal;
                let away = [0, 1, 2].map(|a| target[a] + far * (rng.f64() - 0.5));
                (away, inside(&mut rng))
            }
            6 => {
                let (min, length) = (rng.f64() - 0.3, rng.f64());
                interval = Interval::new(R::from_f64(min), R::from_f64(min + length));
                (inside(&mut rng), target)
            }
            _ => {
                // From a lattice point into a lattice direction: through edges and corners.
                let from = lattice(&mut rng);
                let step = |rng: &mut fastrand::Rng| f64::from(rng.i8(-1..=1));
                (from, [0, 1, 2].map(|a| from[a] + size[a] * step(&mut rng)))
            }
        };
        let length = if rng.u8(0..8) == 0 { 10_f64.powi(rng.i32(-12..=12)) } else { 1.0 };
        let direction = [0, 1, 2].map(|a| (to[a] - origin[a]) * length);
        let (o, d) = (Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(direction));
        if let Ok(ray) = Ray::new(o, d) {
            shots.push((ray, interval));
        }
    }
    shots
}

/// More bytes than any structure of a test takes.
pub const UNLIMITED: usize = 1 << 28;

/// A ray's answers: nearest hit in bits, and whether there is any.
pub type Answer = (Option<(u64, usize)>, bool);

/// What a structure answers to some rays.
pub fn answers<R: Real, S: Shapes<R>>(
    accel: &Any<'_, R>,
    scene: &Scene<'_, R, S>,
    mailbox: mailbox::AnyMailbox<'_>,
    shots: &[Shot<R>],
) -> Vec<Answer> {
    let mut mailbox = mailbox::Lists::new(mailbox, true);
    let mut answer = |(ray, interval): &Shot<R>| {
        let hit = accel.nearest(scene, ray, *interval, &mut mailbox, &mut ());
        let any = accel.occluded(scene, ray, *interval, &mut mailbox, &mut ());
        (hit.map(|Hit { t, id, .. }| (t.to_f64().to_bits(), id)), any)
    };
    shots.iter().map(&mut answer).collect()
}

/// What testing every shape answers to some rays.
pub fn naive_answers<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    shots: &[Shot<R>],
) -> Vec<Answer> {
    let naive = Any::build(Kind::Naive, scene, &mut Arena::new(&mut [])).unwrap();
    answers(&naive, scene, mailbox::AnyMailbox::Off, shots)
}

/// Structure, mailbox, budget in bytes.
pub type Setup = (Kind, mailbox::Kind, usize);

/// Structures of all sorts with all mailboxes, in ample and in scarce memory.
pub fn setups<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Vec<Setup> {
    use mailbox::Kind::{Cache, Off, Stamps};
    let settings = |max_objects, max_level, huge| {
        let limits = octree::Limits { max_objects, max_level };
        octree::Settings {
            growth: octree::Growth { huge, ..octree::Growth::new(limits) },
            ..limits.into()
        }
    };
    let octree = |objects, level| Kind::Octree(settings(objects, level, Huge::Aside));
    let inside = |objects, level| Kind::Octree(settings(objects, level, Huge::Inside));
    let cells = |n, huge| {
        let cells = scene.shapes().count() * n;
        let resolution = grid::resolution_for(scene, huge, cells);
        let macro_cells = huge == Huge::Aside;
        Kind::Grid(grid::Settings { huge, macro_cells, ..grid::Settings::new(resolution) })
    };
    let cubic = |n: u32| Kind::Grid(grid::Settings::new([n; 3]));
    let mut setups = vec![
        (Kind::Naive, Stamps, UNLIMITED),
        (Kind::Clipped, Off, UNLIMITED),
        (cubic(1), Off, UNLIMITED),
    ];
    // From the fewest nodes to one shape a leaf, and as a budget comes out.
    let shapes = scene.shapes().bounded();
    for nodes in [0, shapes / 24, shapes / 10, shapes] {
        setups.push((Kind::Bvh(nodes), Off, UNLIMITED));
    }
    setups.push((Kind::Bvh(bvh::nodes_within::<u32>(shapes, 16 << 10)), Cache, 16 << 10));
    use octree::{Store::Hashed, Store::Implicit, Store::Links, Walk};
    for (store, walk) in [
        (Hashed, Walk::Restart),
        (Hashed, Walk::Descent),
        (Implicit, Walk::Neighbours),
        (Implicit, Walk::Descent),
        (Links, Walk::Restart),
        (Links, Walk::Neighbours),
        (Links, Walk::Segments),
    ] {
        let octree = octree::Settings { store, walk, ..settings(3, 7, Huge::Aside) };
        setups.push((Kind::Octree(octree), Off, UNLIMITED));
    }
    for (budget, mailbox) in [(4 << 10, Off), (16 << 10, Stamps), (UNLIMITED, Cache)] {
        let mut benefit = settings(1, 9, Huge::Aside);
        benefit.growth.order = octree::Order::Benefit;
        setups.push((Kind::Octree(benefit), mailbox, budget));
    }
    for (cells, budget, mailbox) in
        [(1, UNLIMITED, Off), (20, UNLIMITED, Off), (2, 16 << 10, Cache)]
    {
        let overlap = Overlap::Exact;
        let resolution = grid::resolution_for(scene, Huge::Aside, cells * scene.shapes().count());
        let exact =
            grid::Settings { huge: Huge::Aside, overlap, ..grid::Settings::new(resolution) };
        setups.push((Kind::Grid(exact), mailbox, UNLIMITED));
        let mut exact = settings(1, 6, Huge::Aside);
        exact.growth.lists.overlap = overlap;
        setups.push((Kind::Octree(exact), mailbox, budget));
    }
    for (overlap, order, budget, mailbox) in [
        (Overlap::Box, octree::Order::Breadth, 8 << 10, Off),
        (Overlap::Exact, octree::Order::Benefit, 24 << 10, Cache),
        (Overlap::Box, octree::Order::Breadth, UNLIMITED, Stamps),
    ] {
        let mut shared = settings(1, 6, Huge::Aside);
        shared.growth.lists = octree::Lists { overlap, shared: true };
        shared.growth.order = order;
        setups.push((Kind::Octree(shared), mailbox, budget));
    }
    for (macro_cells, mailbox) in [(true, Cache), (false, Off), (true, Stamps)] {
        let cells = if mailbox == Off { [9, 40, 3] } else { [30; 3] };
        let settings = grid::Settings::new(cells);
        let shared = grid::Settings { macro_cells, shared: true, huge: Huge::Aside, ..settings };
        setups.push((Kind::Grid(shared), mailbox, UNLIMITED));
    }
    // Every mailbox in turn: what it keeps does not depend on who asks.
    let mut mailboxes = [Off, Stamps, Cache].into_iter().cycle();
    let mut mailbox = || mailboxes.next().unwrap_or(Off);
    for kind in [
        cells(3, Huge::Inside),
        cells(3, Huge::Aside),
        cubic(16),
        Kind::Grid(grid::Settings { macro_cells: true, ..grid::Settings::new([24; 3]) }),
        Kind::Grid(grid::Settings::new([7, 1, 30])),
        inside(1, 6),
        octree(1, 6),
    ] {
        setups.push((kind, mailbox(), UNLIMITED));
    }
    for kib in [1, 2, 4, 8, 16, 64, 256] {
        setups.push((octree(2, 10), mailbox(), kib << 10));
    }
    setups
}

/// How much a comparison of structures looked at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compared {
    /// Rays.
    pub rays: usize,
    /// Of these, how many hit something.
    pub hits: usize,
    /// Queries to structures.
    pub queries: usize,
    /// Structures that did not fit their budget.
    pub refused: usize,
}

impl std::ops::AddAssign for Compared {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.hits += other.hits;
        self.queries += other.queries;
        self.refused += other.refused;
    }
}

/// Asserts that every structure of [`setups`] answers like testing every shape, bit for bit; that
/// any hit and nearest hit agree; and that hits lie in the interval that was asked for.
pub fn compare<R: Real, S: Shapes<R>>(
    what: &str,
    scene: &Scene<'_, R, S>,
    shots: &[Shot<R>],
    memory: &mut Memory,
) -> Compared {
    let expected = naive_answers(scene, shots);
    for (i, ((hit, any), shot)) in expected.iter().zip(shots).enumerate() {
        assert_eq!(hit.is_some(), *any, "{what} ray {i}: any hit against {hit:?}, {shot:?}");
        if let Some((t, _)) = hit {
            let t = R::from_f64(f64::from_bits(*t));
            assert!(shot.1.contains(t), "{what} ray {i}: {t:?} is not inside, {shot:?}");
        }
    }
    let hits = expected.iter().filter(|(hit, _)| hit.is_some()).count();
    let mut compared = Compared { rays: shots.len(), hits, ..Compared::default() };
    for (kind, mailbox_kind, bytes) in setups(scene) {
        let mut arena = Arena::new(memory.bytes(bytes));
        let built = mailbox::AnyMailbox::new(mailbox_kind, scene.shapes().bounded(), &mut arena)
            .map_err(BuildError::from)
            .and_then(|mailbox| Ok((mailbox, Any::build(kind, scene, &mut arena)?)));
        let (mailbox, accel) = match built {
            Ok(built) => built,
            Err(BuildError::Memory(_)) if bytes < UNLIMITED => {
                compared.refused += 1;
                continue;
            }
            Err(error) => panic!("{what} {kind:?}: {error}"),
        };
        let found = answers(&accel, scene, mailbox, shots);
        compared.queries += 2 * found.len();
        for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(
                found, expected,
                "{what} {kind:?} {mailbox_kind:?} {bytes} bytes, ray {i}: {:?}",
                shots[i]
            );
        }
    }
    compared
}

/// A view of a box from outside, for [`shots`].
pub fn view_of<R: Real>(bounds: Aabb<R>) -> View<R> {
    let size = bounds.size();
    View {
        from: bounds.hi + size + size,
        at: bounds.lo,
        up: Vec3::<R>::from_f64([0.0, 1.0, 0.0]),
        angle: R::HALF,
    }
}
