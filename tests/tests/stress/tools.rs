//! What the classes share.

use kibiray::accel::{self, Accel, Any, Hit, Naive, grid, mailbox, octree};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes, Solids};
use kibiray_tests::oracle::{Judge, Outcome, Tally, Tested};
use kibiray_tests::{Memory, Shot};

pub(super) type V = [f64; 3];

pub(super) fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn times(a: V, s: f64) -> V {
    a.map(|x| x * s)
}

pub(super) fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length(a: V) -> f64 {
    dot(a, a).sqrt()
}

/// Seeded chance.
pub(super) struct Random(fastrand::Rng);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }
    pub(super) fn rng(&mut self) -> &mut fastrand::Rng {
        &mut self.0
    }
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0.usize(0..n)
    }
    pub(super) fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.0.f64()
    }
    pub(super) fn signed(&mut self) -> f64 {
        self.within(-1.0, 1.0)
    }
    /// 10 to a power between these.
    pub(super) fn decade(&mut self, from: f64, to: f64) -> f64 {
        10.0_f64.powf(self.within(from, to))
    }
    pub(super) fn sign(&mut self) -> f64 {
        if self.0.bool() { 1.0 } else { -1.0 }
    }
    pub(super) fn vector(&mut self) -> V {
        [self.signed(), self.signed(), self.signed()]
    }
    /// Of length 1.
    pub(super) fn direction(&mut self) -> V {
        loop {
            let v = self.vector();
            let l = length(v);
            if l > 0.1 && l < 1.0 {
                return times(v, 1.0 / l);
            }
        }
    }
    /// Of length 1, across another.
    pub(super) fn across(&mut self, v: V) -> V {
        loop {
            let c = cross(v, self.direction());
            let l = length(c);
            if l > 0.3 * length(v) {
                return times(c, 1.0 / l);
            }
        }
    }
}

/// A length of the test's scene in a number type: see [`Tested::UNIT`].
pub(super) fn len<R: Tested>(x: f64) -> R {
    R::from_f64(x * R::UNIT)
}

/// A point or a direction of the test's scene.
pub(super) fn v<R: Tested>(p: V) -> Vec3<R> {
    v_in::<R>(R::UNIT, p)
}

/// The same where a length of 1 is `unit`.
pub(super) fn v_in<R: Real>(unit: f64, p: V) -> Vec3<R> {
    Vec3::<R>::from_f64(p.map(|x| x * unit))
}

/// What a length of 1 is in a scene with coordinates up to `size`.
pub(super) fn unit_for<R: Real>(size: f64) -> f64 {
    if R::EXACT { 2.0_f64.powf(-size.log2().ceil() - 1.0) } else { 1.0 }
}

/// Only where a number type is not a fixed-point one.
pub(super) fn floating<R: Real>(run: impl FnOnce() -> Tally) -> Option<Tally> {
    (!R::EXACT).then(run)
}

/// As it came to be, in lengths of the test's scene again.
pub(super) fn wide<R: Tested>(p: Vec3<R>) -> V {
    plain::<R>(p).map(|x| x / R::UNIT)
}

/// As the number type has it.
pub(super) fn plain<R: Real>(p: Vec3<R>) -> V {
    p.to_array().map(R::to_f64)
}

/// How far a length of the test's scene may be from what it was rounded from.
pub(super) fn rounding<R: Tested>(size: f64) -> f64 {
    R::rounding(size * R::UNIT) / R::UNIT
}

/// A ray, where the numbers make one.
pub(super) fn ray<R: Tested>(o: V, d: V) -> Option<Ray<R>> {
    ray_in::<R>(R::UNIT, o, d)
}

/// The same where a length of 1 is `unit`. In fixed point the direction is given a length that is
/// ordinary, and there is no ray that starts beyond 2.
pub(super) fn ray_in<R: Tested>(unit: f64, o: V, d: V) -> Option<Ray<R>> {
    let [o, mut d] = [o, d].map(|p| p.map(|x| x * unit));
    if R::EXACT {
        if !o.iter().all(|x: &f64| x.abs() <= 2.0) || !(length(d) > 0.0) {
            return None;
        }
        // Into 3/4 to 3, squared.
        d = times(d, 2.0_f64.powf(-(length(d).log2() + 0.2075).floor()));
    }
    Ray::new(Vec3::<R>::from_f64(o), Vec3::<R>::from_f64(d)).ok()
}

pub(super) fn nearest<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    ray: &Ray<R>,
    interval: Interval<R>,
) -> Option<Hit<R>> {
    Naive::new(scene).nearest(scene, ray, interval, &mut mailbox::Off, &mut ())
}

pub(super) fn blocked<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, ray: &Ray<R>) -> bool {
    Naive::new(scene).occluded(scene, ray, Interval::RAY, &mut mailbox::Off, &mut ())
}

/// A scene and who judges its rays.
pub(super) struct Court<'s, 'a, R: Tested> {
    pub(super) scene: &'s Scene<'a, R, Solids<'a, R>>,
    pub(super) judge: Judge<R::Oracle>,
}

impl<'s, 'a, R: Tested> Court<'s, 'a, R> {
    pub(super) fn new(scene: &'s Scene<'a, R, Solids<'a, R>>) -> Self {
        Self { scene, judge: Judge::new(scene) }
    }

    /// Shoots a ray, has the answer judged, and gives it.
    pub(super) fn shoot(&mut self, ray: &Ray<R>, tally: &mut Tally) -> (Option<Hit<R>>, Outcome) {
        self.shoot_within(ray, Interval::RAY, tally)
    }

    pub(super) fn shoot_within(
        &mut self,
        ray: &Ray<R>,
        interval: Interval<R>,
        tally: &mut Tally,
    ) -> (Option<Hit<R>>, Outcome) {
        let hit = nearest(self.scene, ray, interval);
        let answer = hit.map(|hit| (hit.t, hit.id));
        let outcome = self.judge.judge(ray, interval, answer, tally);
        (hit, outcome)
    }
}

/// The structures that answers have to be the same from.
pub(super) fn structures<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Vec<accel::Kind> {
    let shapes = scene.shapes().bounded();
    let octree = |max_objects, max_level| {
        accel::Kind::Octree(octree::Limits { max_objects, max_level }.into())
    };
    let resolution = grid::resolution_for(scene, accel::Huge::Aside, 4 * shapes.max(1));
    vec![
        accel::Kind::Grid(grid::Settings {
            huge: accel::Huge::Aside,
            macro_cells: true,
            ..grid::Settings::new(resolution)
        }),
        accel::Kind::Grid(grid::Settings::new([16; 3])),
        octree(2, octree::DEEPEST.min(8)),
        accel::Kind::Bvh(shapes / 10),
        accel::Kind::Bvh(shapes),
    ]
}

/// Every structure answers as testing all does, bit for bit.
pub(super) fn conform<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    kinds: &[accel::Kind],
    shots: &[Shot<R>],
    memory: &mut Memory,
    tally: &mut Tally,
) {
    let bits = |hit: Option<Hit<R>>| hit.map(|hit| (hit.t.to_f64().to_bits(), hit.id));
    let expected: Vec<_> =
        shots.iter().map(|(ray, interval)| bits(nearest(scene, ray, *interval))).collect();
    tally.hits += expected.iter().flatten().count() as u64;
    for kind in kinds {
        let mut arena = Arena::new(memory.bytes(BYTES));
        let accel = match Any::build(*kind, scene, &mut arena) {
            Ok(accel) => accel,
            Err(error) => {
                tally.fail(|| format!("{kind:?}: {error}"));
                continue;
            }
        };
        for ((ray, interval), expected) in shots.iter().zip(&expected) {
            let nearest =
                |probe| bits(accel.nearest(scene, ray, *interval, &mut mailbox::Off, probe));
            let found = nearest(&mut ());
            let any = accel.occluded(scene, ray, *interval, &mut mailbox::Off, &mut ());
            tally.expect(found == *expected && any == expected.is_some(), || {
                format!("{kind:?} {ray:?} {interval:?}: {found:?} {any} for {expected:?}")
            });
        }
    }
}

/// Memory of [`conform`].
pub(super) const BYTES: usize = 64 << 20;
