//! Helpers shared by the test programs of kibiray.

mod combined;
pub mod oracle;

pub use combined::{SHOWPIECES, combined_scenes};

use kibiray::accel::{
    Accel, Any, BuildError, Hit, Huge, Kind, Overlap, bvh, grid, mailbox, octree,
};
use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes, Solids, Triangles, View};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Shape, Sphere, Triangle};

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
    let mut setups = vec![(Kind::Naive, Stamps, UNLIMITED), (cubic(1), Off, UNLIMITED)];
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

/// Shapes of all kinds before a number type is chosen.
#[derive(Clone, Debug, Default)]
pub struct World {
    /// Centre and radius.
    pub spheres: Vec<([f64; 3], f64)>,
    /// Corners.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// Outlines.
    pub polygons: Vec<Vec<[f64; 3]>>,
    /// Least and greatest corner.
    pub boxes: Vec<[[f64; 3]; 2]>,
    /// Ends, radius, whether closed.
    pub cylinders: Vec<([[f64; 3]; 2], f64, bool)>,
    /// Ends, radii, whether closed.
    pub cones: Vec<([[f64; 3]; 2], [f64; 2], bool)>,
    /// Point and normal.
    pub planes: Vec<([f64; 3], [f64; 3])>,
}

impl World {
    /// So many solids of every kind, up to two fifths as large as the cube of edge `size` around
    /// `middle` that they lie in. No planes.
    pub fn random(rng: &mut fastrand::Rng, each: usize, middle: [f64; 3], size: f64) -> Self {
        let mut world = Self::default();
        for _ in 0..each {
            let center = [0, 1, 2].map(|a| middle[a] + size * (rng.f64() - 0.5));
            let mut near = || [0, 1, 2].map(|a| center[a] + size * 0.4 * (rng.f64() - 0.5));
            let [a, b, c, d] = [near(), near(), near(), near()];
            let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let sub = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
            let r = length(sub(c, d)) * 0.3;
            world.spheres.push((a, r));
            world.triangles.push([a, b, c]);
            // A quadrilateral in the plane of three corners.
            let far = [0, 1, 2].map(|i| b[i] + 0.7 * (c[i] - a[i]));
            world.polygons.push(vec![a, b, far, c]);
            world
                .boxes
                .push([[0, 1, 2].map(|i| a[i].min(b[i])), [0, 1, 2].map(|i| a[i].max(b[i]))]);
            world.cylinders.push(([a, b], r, rng.bool()));
            let apex = if rng.bool() { 0.0 } else { r * 0.5 };
            world.cones.push(([c, d], [r, apex], rng.bool()));
        }
        world
    }

    /// Every shape `times` times, in another order: what ties are made of.
    #[must_use]
    pub fn repeated(&self, times: usize, rng: &mut fastrand::Rng) -> Self {
        fn shuffled<T: Clone>(table: &[T], times: usize, rng: &mut fastrand::Rng) -> Vec<T> {
            let mut all: Vec<T> = (0..times).flat_map(|_| table.iter().cloned()).collect();
            rng.shuffle(&mut all);
            all
        }
        Self {
            spheres: shuffled(&self.spheres, times, rng),
            triangles: shuffled(&self.triangles, times, rng),
            polygons: shuffled(&self.polygons, times, rng),
            boxes: shuffled(&self.boxes, times, rng),
            cylinders: shuffled(&self.cylinders, times, rng),
            cones: shuffled(&self.cones, times, rng),
            planes: shuffled(&self.planes, times, rng),
        }
    }

    /// Everything so many times as large.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let p = |p: &[f64; 3]| p.map(|x| x * by);
        Self {
            spheres: self.spheres.iter().map(|(c, r)| (p(c), r * by)).collect(),
            triangles: self.triangles.iter().map(|t| t.each_ref().map(p)).collect(),
            polygons: self.polygons.iter().map(|o| o.iter().map(p).collect()).collect(),
            boxes: self.boxes.iter().map(|b| b.each_ref().map(p)).collect(),
            cylinders: self
                .cylinders
                .iter()
                .map(|(ends, r, capped)| (ends.each_ref().map(p), r * by, *capped))
                .collect(),
            cones: self
                .cones
                .iter()
                .map(|(ends, radii, capped)| {
                    (ends.each_ref().map(p), radii.map(|r| r * by), *capped)
                })
                .collect(),
            planes: self.planes.iter().map(|(at, normal)| (p(at), *normal)).collect(),
        }
    }

    /// Rounds every number to one that `f32` holds, so that the shapes are the same in all types.
    pub fn round_to_f32(&mut self) {
        let round = |x: &mut f64| *x = f64::from(*x as f32);
        let spheres = self.spheres.iter_mut().flat_map(|(c, r)| c.iter_mut().chain([r]));
        let triangles = self.triangles.iter_mut().flatten().flatten();
        let polygons = self.polygons.iter_mut().flatten().flatten();
        let boxes = self.boxes.iter_mut().flatten().flatten();
        let cylinders = self.cylinders.iter_mut();
        let cylinders = cylinders.flat_map(|(ends, r, _)| ends.iter_mut().flatten().chain([r]));
        let cones = self.cones.iter_mut();
        let cones = cones.flat_map(|(ends, r, _)| ends.iter_mut().flatten().chain(r));
        let planes = self.planes.iter_mut().flat_map(|(p, n)| p.iter_mut().chain(n));
        spheres.for_each(round);
        triangles.chain(polygons).chain(boxes).for_each(round);
        cylinders.for_each(round);
        cones.chain(planes).for_each(round);
    }

    /// The shapes in a number type; what is no shape in it is left out.
    pub fn tables<R: Real>(&self) -> WorldTables<R> {
        fn all<R: Real, T, S: Shape<R>>(table: &[T], f: impl Fn(&T) -> S) -> Vec<S> {
            table.iter().map(f).filter(|shape| shape.check().is_ok()).collect()
        }
        let v = |p: [f64; 3]| Vec3::<R>::from_f64(p);
        let r = R::from_f64;
        WorldTables {
            spheres: all(&self.spheres, |(c, radius)| Sphere::new(v(*c), r(*radius))),
            triangles: all(&self.triangles, |[a, b, c]| Triangle::new(v(*a), v(*b), v(*c))),
            outlines: self.polygons.iter().map(|p| p.iter().map(|c| v(*c)).collect()).collect(),
            boxes: all(&self.boxes, |[lo, hi]| AxisBox::new(v(*lo), v(*hi))),
            cylinders: all(&self.cylinders, |([a, b], radius, capped)| {
                let cylinder = Cylinder::new(v(*a), v(*b), r(*radius));
                if *capped { cylinder.capped() } else { cylinder }
            }),
            cones: all(&self.cones, |([a, b], [base, apex], capped)| {
                let cone = Cone::new(v(*a), v(*b), r(*base), r(*apex));
                if *capped { cone.capped() } else { cone }
            }),
            planes: all(&self.planes, |(p, n)| Plane::new(v(*p), v(*n))),
        }
    }
}

/// The tables of a [`World`].
#[derive(Clone, Debug)]
pub struct WorldTables<R: Real> {
    spheres: Vec<Sphere<R>>,
    triangles: Vec<Triangle<R>>,
    outlines: Vec<Vec<Vec3<R>>>,
    boxes: Vec<AxisBox<R>>,
    cylinders: Vec<Cylinder<R>>,
    cones: Vec<Cone<R>>,
    planes: Vec<Plane<R>>,
}

impl<R: Real> WorldTables<R> {
    /// The polygons, which borrow their corners.
    pub fn polygons(&self) -> Vec<Polygon<'_, R>> {
        let polygons = self.outlines.iter().map(|corners| Polygon::new(corners));
        polygons.filter(|polygon| polygon.check().is_ok()).collect()
    }

    /// The scene of all of them.
    pub fn scene<'a>(&'a self, polygons: &'a [Polygon<'a, R>]) -> Scene<'a, R, Solids<'a, R>> {
        let shapes = Solids {
            spheres: &self.spheres,
            triangles: Triangles { triangles: &self.triangles, normals: &[] },
            polygons,
            boxes: &self.boxes,
            cylinders: &self.cylinders,
            cones: &self.cones,
            planes: &self.planes,
        };
        Scene::new(shapes).unwrap()
    }
}
