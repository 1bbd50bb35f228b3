//! What bounds cost and save, measured: B + p I < I, by kind of bound and kind of shape.
//!
//! H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", ACM TOG
//! 3(1) (1984).

use std::hint::black_box;
use std::time::Instant;

use kibiray::accel::mailbox::Off;
use kibiray::accel::tree::{AnyTree, Builder, Insertion, Kind, Settings, Walk};
use kibiray::accel::{Accel, BuildError};
use kibiray::bound::{KDop, OrientedBox, Stored, pays};
use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Scene, Shapes};
use kibiray::shape::Sphere;
use serde::Serialize;

use crate::engine::Memory;
use crate::tables::HostShapes;

/// All that was measured in a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Efficiency {
    /// Rays that every sampled shape and bound was tested against: half of them through the picture,
    /// half across the scene.
    pub rays: usize,
    /// Kinds of shapes that there are.
    pub shapes: Vec<KindReport>,
    /// Trees with all bounds and with those alone that pay.
    pub trees: Vec<TreeReport>,
}

/// A kind of shape.
#[derive(Clone, Debug, Serialize)]
pub struct KindReport {
    /// Its name.
    pub kind: &'static str,
    /// How many there are.
    pub count: usize,
    /// What a test takes, in nanoseconds: I.
    pub test_ns: f64,
    /// The bounds around them.
    pub bounds: Vec<BoundReport>,
}

/// A kind of bound around a kind of shape.
#[derive(Clone, Debug, Serialize)]
pub struct BoundReport {
    /// Its name.
    pub bound: &'static str,
    /// What a test takes, in nanoseconds: B.
    pub test_ns: f64,
    /// How many of the rays hit it: p where every shape is tested.
    pub hit_ratio: f64,
    /// Of the rays that hit the bound above it in a tree, as many should hit it, by surfaces: p there.
    pub hit_ratio_in_tree: f64,
    /// Whether it pays where every shape is tested.
    pub pays: bool,
    /// Whether it pays in a tree.
    pub pays_in_tree: bool,
}

/// A tree of one kind of bounds, traced with all of them and with those alone that pay.
#[derive(Clone, Debug, Serialize)]
pub struct TreeReport {
    /// The bound.
    pub bound: &'static str,
    /// Leaves whose bound pays, of all.
    pub paying: usize,
    /// With all bounds.
    pub all: Traced,
    /// With those that pay.
    pub chosen: Traced,
}

/// What the rays took.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Traced {
    /// Tests of bounds a ray.
    pub bound_tests: f64,
    /// Tests of shapes a ray.
    pub shape_tests: f64,
    /// Nanoseconds a ray.
    pub ns: f64,
    /// Rays that hit.
    pub hits: usize,
}

/// Shapes of a kind that are measured, at most.
const SAMPLE: usize = 64;

/// Rays along an edge of the picture.
const ACROSS: i32 = 64;

/// Measurements of which the fastest counts.
const REPEAT: usize = 5;

/// The name of a bound on the command line.
pub fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Box => "box",
        Kind::Sphere => "sphere",
        Kind::Oriented => "obox",
        Kind::KDop14 => "kdop14",
        Kind::KDop18 => "kdop18",
        Kind::KDop26 => "kdop26",
    }
}

/// Measures a scene, whose shapes are sorted by kind: the name of each and how many there are.
///
/// # Errors
/// A tree that is too large.
pub fn measure<R: Real>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    kinds: &[(&'static str, usize)],
    camera: &Camera<R>,
) -> anyhow::Result<Efficiency> {
    let rays = rays(scene, camera);
    let mut first = 0;
    let mut shapes = Vec::new();
    for &(kind, count) in kinds {
        let ids: Vec<usize> =
            (0..count.min(SAMPLE)).map(|i| first + i * count / count.min(SAMPLE)).collect();
        first += count;
        if count > 0 {
            let test_ns = shape_ns(scene, &ids, &rays);
            shapes.push((ids, KindReport { kind, count, test_ns, bounds: Vec::new() }, first));
        }
    }
    let mut trees = Vec::new();
    for bound in Kind::ALL {
        trees.push(with_bound(scene, bound, &rays, &mut shapes)?);
    }
    let shapes = shapes.into_iter().map(|(_, report, _)| report).collect();
    Ok(Efficiency { rays: rays.len(), shapes, trees })
}

/// Through the picture, and as many from all around to anywhere inside.
fn rays<R: Real>(scene: &Scene<'_, R, HostShapes<'_, R>>, camera: &Camera<R>) -> Vec<Ray<R>> {
    let at = |i: i32| R::fraction(2 * i + 1 - ACROSS, ACROSS);
    let pixels = (0..ACROSS).flat_map(|y| (0..ACROSS).map(move |x| (x, y)));
    let mut rays: Vec<_> = pixels.filter_map(|(x, y)| camera.ray(at(x), at(y))).collect();
    let bounds = scene.bounds();
    let (lo, size) = (bounds.lo, bounds.size());
    let mut random = 1_u64;
    let mut unit = || {
        // G. Marsaglia, "Xorshift RNGs" (2003).
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 40) as f64 / (1 << 24) as f64
    };
    while rays.len() < 2 * (ACROSS * ACROSS) as usize {
        let mut point = |scale: f64| {
            let at = [0, 1, 2].map(|_| R::from_f64(0.5 + scale * (unit() - 0.5)));
            lo + size.scale(Vec3::<R>::from_array(at))
        };
        let (from, to) = (point(1.5), point(1.0));
        rays.extend(Ray::new(from, to - from).ok());
    }
    rays
}

/// Nanoseconds that one of `tests` takes; the fastest of some runs.
fn ns_each(tests: usize, mut run: impl FnMut()) -> f64 {
    let timed = (0..REPEAT).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    });
    timed.fold(f64::INFINITY, f64::min) * 1e9 / tests.max(1) as f64
}

fn shape_ns<R: Real>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    ids: &[usize],
    rays: &[Ray<R>],
) -> f64 {
    let shapes = scene.shapes();
    let prepared: Vec<_> = rays.iter().map(|ray| (ray, shapes.per_ray(ray))).collect();
    ns_each(rays.len() * ids.len(), || {
        for (ray, per_ray) in &prepared {
            for id in ids {
                black_box(shapes.hit(*id, ray, per_ray, R::ZERO, R::MAX));
            }
        }
    })
}

/// Cost and ratio of hits of bounds around shapes.
fn bound_ns<R: Real, B: Stored<R>>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    ids: &[usize],
    rays: &[Ray<R>],
) -> (f64, f64) {
    let around = |id: &usize| B::around(&scene.shapes().region(*id), scene.pad());
    let bounds: Vec<B> = ids.iter().map(around).collect();
    let lines: Vec<_> = rays.iter().map(B::per_ray).collect();
    let tests = rays.len() * ids.len();
    let mut hits = 0;
    let ns = ns_each(tests, || {
        hits = 0;
        for line in &lines {
            for bound in &bounds {
                hits += usize::from(black_box(bound.enter(line, R::ZERO, R::MAX)).is_some());
            }
        }
    });
    (ns, hits as f64 / tests.max(1) as f64)
}

/// Samples of a kind of shape, what is known of it, and where its ids end.
type Sampled = (Vec<usize>, KindReport, usize);

/// One kind of bound around all kinds of shapes, and a tree of it.
fn with_bound<R: Real>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    bound: Kind,
    rays: &[Ray<R>],
    shapes: &mut [Sampled],
) -> anyhow::Result<TreeReport> {
    let settings =
        Settings { builder: Builder::GoldsmithSalmon(Insertion::Shuffled(0)), walk: Walk::Ordered };
    let count = scene.shapes().bounded();
    let mut memory = Memory::new(AnyTree::<R>::footprint(bound, count, settings).peak)?;
    let mut arena = memory.arena();
    let mut tree = AnyTree::build(bound, scene, settings, &mut arena)
        .map_err(|error: BuildError| anyhow::anyhow!("{error}"))?;
    let mut in_tree = vec![0.0; count];
    tree.keep_paying(|id, probability| {
        in_tree[id] = probability.to_f64();
        true
    });
    let mut first = 0;
    for (ids, report, end) in shapes.iter_mut() {
        let (test_ns, hit_ratio) = match bound {
            Kind::Box => bound_ns::<R, Aabb<R>>(scene, ids, rays),
            Kind::Sphere => bound_ns::<R, Sphere<R>>(scene, ids, rays),
            Kind::Oriented => bound_ns::<R, OrientedBox<R>>(scene, ids, rays),
            Kind::KDop14 => bound_ns::<R, KDop<R, 7>>(scene, ids, rays),
            Kind::KDop18 => bound_ns::<R, KDop<R, 9>>(scene, ids, rays),
            Kind::KDop26 => bound_ns::<R, KDop<R, 13>>(scene, ids, rays),
        };
        let ratios = &in_tree[first..*end];
        let hit_ratio_in_tree = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
        first = *end;
        report.bounds.push(BoundReport {
            bound: name(bound),
            test_ns,
            hit_ratio,
            hit_ratio_in_tree,
            pays: pays(test_ns, hit_ratio, report.test_ns),
            pays_in_tree: pays(test_ns, hit_ratio_in_tree, report.test_ns),
        });
    }
    let all = trace(scene, &tree, rays);
    let paying = tree.keep_paying(|id, probability| {
        let kind = shapes.iter().find(|(_, _, end)| id < *end).map(|(_, report, _)| report);
        let kind = kind.and_then(|report| Some((report.test_ns, report.bounds.last()?.test_ns)));
        kind.is_none_or(|(inside, bound)| pays(bound, probability.to_f64(), inside))
    });
    Ok(TreeReport { bound: name(bound), paying, all, chosen: trace(scene, &tree, rays) })
}

/// Traces all rays through a tree.
fn trace<R: Real>(
    scene: &Scene<'_, R, HostShapes<'_, R>>,
    tree: &AnyTree<'_, R>,
    rays: &[Ray<R>],
) -> Traced {
    let mut counters = Counters::default();
    let nearest = |ray: &&Ray<R>, counters: &mut Counters| {
        tree.nearest(scene, ray, Interval::RAY, &mut Off, counters).is_some()
    };
    let hits = rays.iter().filter(|ray| nearest(ray, &mut counters)).count();
    let ns = ns_each(rays.len(), || {
        for ray in rays {
            black_box(tree.nearest(scene, ray, Interval::RAY, &mut Off, &mut ()));
        }
    });
    let each = |tests: u64| tests as f64 / rays.len().max(1) as f64;
    let (bound_tests, shape_tests) = (each(counters.steps), each(counters.primitive_tests));
    Traced { bound_tests, shape_tests, ns, hits }
}
