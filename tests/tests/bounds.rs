//! Guards the promise of bounding solids: nothing is hit outside a bound, whatever the shape, the
//! bound and the ray. Rays start anywhere, run along axes, in the planes of flat shapes, through
//! corners and along edges.

use kibiray::accel::mailbox::Off;
use kibiray::accel::{Accel, Naive};
use kibiray::bound::{Bound, Fitted, Intersection, KDop, OrientedBox, Union};
use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::num::{Fixed, Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes};
use kibiray::shape::{Affine, AxisBox, Shape, Sphere, Transformed};
use kibiray_tests::World;
use std::ops::RangeInclusive;

/// Rays in all: as many as there is time for, or what `KIBIRAY_RAYS` says.
fn rays() -> usize {
    std::env::var("KIBIRAY_RAYS").ok().and_then(|n| n.parse().ok()).unwrap_or(1_000_000)
}

/// Bounds of one kind around every shape of a scene, around each and its neighbour, around all; as
/// they are put together, and refined.
struct Around<B> {
    each: Vec<B>,
    pairs: Vec<B>,
    all: B,
    refined: Option<Box<Self>>,
}

impl<B> Around<B> {
    fn of<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Self
    where
        B: Fitted<R>,
    {
        let shapes = scene.shapes();
        let around = |id| B::around(&shapes.region(id), scene.pad());
        let each: Vec<B> = (0..shapes.bounded()).map(around).collect();
        let next = each.iter().cycle().skip(1);
        let pairs = each.iter().zip(next).map(|(a, b)| a.union(*b)).collect();
        let all = each[1..].iter().fold(each[0], |all, one| all.union(*one));
        let coarse = Self { each, pairs, all, refined: None };
        let refined = B::REFINES.then(|| Box::new(coarse.refined(scene)));
        Self { refined, ..coarse }
    }

    /// The same bounds, refined.
    fn refined<R: Real, S: Shapes<R>>(&self, scene: &Scene<'_, R, S>) -> Self
    where
        B: Fitted<R>,
    {
        let (count, region) = (self.each.len(), |id| scene.shapes().region(id));
        let each = self.each.iter().enumerate();
        let pairs = self.pairs.iter().enumerate();
        let pair = |id| [id, (id + 1) % count].into_iter().map(region);
        Self {
            each: each.map(|(id, b)| b.refined([region(id)].into_iter(), scene.pad())).collect(),
            pairs: pairs.map(|(id, b)| b.refined(pair(id), scene.pad())).collect(),
            all: self.all.refined((0..count).map(region), scene.pad()),
            refined: None,
        }
    }

    fn check<R: Real>(&self, ray: &Ray<R>, id: usize, t: R, what: &str)
    where
        B: Bound<R>,
    {
        let line = B::per_ray(ray);
        let before = (id + self.each.len() - 1) % self.each.len();
        for bound in [self.each[id], self.pairs[id], self.pairs[before], self.all] {
            let enter = bound.enter(&line, R::ZERO, t);
            assert!(
                enter.is_some(),
                "{what}: shape {id} is hit at {t:?} by {ray:?}, not {bound:?}"
            );
        }
        if let Some(refined) = &self.refined {
            refined.check(ray, id, t, what);
        }
        // The union of two bounds as they are.
        let both = Union(self.each[before], self.each[id]);
        assert!(both.enter(&(line, line), R::ZERO, t).is_some(), "{what}: union of {both:?}");
    }
}

/// A point of a flat shape's plane, inside it or not.
fn in_plane(rng: &mut fastrand::Rng, corners: &[[f64; 3]]) -> [f64; 3] {
    let mut weight = || match rng.u8(0..4) {
        0 => 0.0,
        1 => 1.0,
        _ => rng.f64() * 3.0 - 1.0,
    };
    let (u, v) = (weight(), weight());
    [0, 1, 2].map(|a| {
        let [p, q, r] = [corners[0][a], corners[1][a], corners[2][a]];
        p + u * (q - p) + v * (r - p)
    })
}

fn shot<R: Real>(
    rng: &mut fastrand::Rng,
    world: &World,
    middle: [f64; 3],
    size: f64,
) -> Option<Ray<R>> {
    let mut near = |scale: f64| [0, 1, 2].map(|a| middle[a] + size * scale * (rng.f64() - 0.5));
    let (mut from, mut to) = (near(3.0), near(1.2));
    match rng.u8(0..8) {
        0 | 1 => {
            let corners = &world.polygons[rng.usize(..world.polygons.len())];
            (from, to) = (in_plane(rng, corners), in_plane(rng, corners));
        }
        2 => {
            let corners = &world.triangles[rng.usize(..world.triangles.len())];
            (from, to) = (in_plane(rng, corners), in_plane(rng, corners));
        }
        3 => {
            let axis = rng.usize(0..3);
            from = to;
            from[axis] -= size * 2.0;
        }
        4 => {
            // Along or beside the axis of a round solid.
            let (ends, radius, _) = world.cylinders[rng.usize(..world.cylinders.len())];
            let off = [0, 1, 2].map(|_| radius * 1.2 * (rng.f64() - 0.5));
            from = [0, 1, 2].map(|a| ends[0][a] * 3.0 - ends[1][a] * 2.0 + off[a]);
            to = [0, 1, 2].map(|a| ends[1][a] + off[a]);
        }
        _ => {}
    }
    let direction = [0, 1, 2].map(|a| (to[a] - from[a]) / size);
    // Of length 1: others are scaled before they reach a structure.
    Ray::new(Vec3::<R>::from_f64(from), Vec3::<R>::from_f64(direction).unit()?).ok()
}

/// Shoots so many rays at a scene; gives how many hit.
fn shoot<R: Real, S: Shapes<R>>(
    what: &str,
    scene: &Scene<'_, R, S>,
    count: usize,
    mut shot: impl FnMut() -> Option<Ray<R>>,
) -> usize {
    let naive = Naive::new(scene);
    let spheres = Around::<Sphere<R>>::of(scene);
    let boxes = Around::<Aabb<R>>::of(scene);
    let oriented = Around::<OrientedBox<R>>::of(scene);
    let kdop6 = Around::<KDop<R, 3>>::of(scene);
    let kdop14 = Around::<KDop<R, 7>>::of(scene);
    let kdop18 = Around::<KDop<R, 9>>::of(scene);
    let kdop26 = Around::<KDop<R, 13>>::of(scene);
    let both = Around::<Intersection<Sphere<R>, OrientedBox<R>>>::of(scene);
    let mut hits = 0;
    // Those that start farther away are moved nearer before they reach a structure.
    let far = R::far(scene.bounds().max_abs());
    for ray in (0..count).filter_map(|_| shot()).filter(|ray| ray.origin().max_abs() <= far) {
        let Some(hit) = naive.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ()) else {
            continue;
        };
        hits += 1;
        spheres.check(&ray, hit.id, hit.t, what);
        boxes.check(&ray, hit.id, hit.t, what);
        oriented.check(&ray, hit.id, hit.t, what);
        kdop6.check(&ray, hit.id, hit.t, what);
        kdop14.check(&ray, hit.id, hit.t, what);
        kdop18.check(&ray, hit.id, hit.t, what);
        kdop26.check(&ray, hit.id, hit.t, what);
        both.check(&ray, hit.id, hit.t, what);
    }
    hits
}

/// A box that is turned somehow.
fn turned<R: Real, S: Shapes<R>>(
    rng: &mut fastrand::Rng,
    scene: &Scene<'_, R, S>,
    size: f64,
) -> Transformed<R, AxisBox<R>> {
    let mut direction = || loop {
        let v = [0, 1, 2].map(|_| 2.0 * rng.f64() - 1.0);
        if v.iter().map(|x| x * x).sum::<f64>() > 0.1 {
            break Vec3::<R>::from_f64(v).unit().unwrap();
        }
    };
    let x = direction();
    let y = x.cross(direction()).unit().unwrap();
    let map = Affine { axes: [x, y, x.cross(y)], origin: scene.bounds().middle() };
    let mut length = || R::from_f64(size * (0.02 + 0.3 * rng.f64()));
    let solid =
        AxisBox { lo: Vec3::<R>::default(), hi: Vec3::<R>::new(length(), length(), length()) };
    Transformed::new(solid, &map).unwrap()
}

/// So many rays at a time, then other shapes.
const BATCH: usize = 2000;

/// Powers of ten of the scenes' sizes.
fn contain<R: Real>(number: &str, seed: u64, sizes: RangeInclusive<i32>) {
    let mut rng = fastrand::Rng::with_seed(seed);
    let (count, mut shot_at, mut hits) = (rays() / 3, 0, 0);
    while shot_at < count {
        let size = 10_f64.powi(rng.i32(sizes.clone())) * 0.5;
        let middle = [0, 1, 2].map(|_| size * f64::from(rng.i8(-2..=2)) * 0.4);
        let mut world = World::random(&mut rng, 2, middle, size);
        // Some flat shapes lie in planes across an axis.
        let axis = rng.usize(0..3);
        world.triangles[1].iter_mut().for_each(|corner| corner[axis] = middle[axis]);
        world.polygons[1].iter_mut().for_each(|corner| corner[axis] = middle[axis]);
        // One is a needle, thinner than a slack sometimes.
        let [a, b, c] = &mut world.triangles[0];
        let thin = 10_f64.powi(rng.i32(-5..0));
        *c = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * 0.6 + (c[i] - a[i]) * thin);
        world.round_to_f32();
        let tables = world.tables::<R>();
        let polygons = tables.polygons();
        let plain = tables.scene(&polygons);
        let turned = [turned(&mut rng, &plain, size)];
        // Not every map can be computed with in every number type.
        let usable = turned.iter().take_while(|solid| solid.check().is_ok()).count();
        let scene = Scene::new((*plain.shapes(), &turned[..usable])).unwrap();
        hits += shoot(number, &scene, BATCH, || shot(&mut rng, &world, middle, size));
        shot_at += BATCH;
    }
    println!("{number}: {shot_at} rays, {hits} hits");
    assert!(hits > shot_at / 20);
}

#[test]
fn nothing_is_hit_outside_a_bound_in_f32() {
    contain::<f32>("f32", 1, -2..=2);
}

#[test]
fn nothing_is_hit_outside_a_bound_in_f64() {
    contain::<f64>("f64", 2, -2..=2);
}

#[test]
fn nothing_is_hit_outside_a_bound_in_fixed_point() {
    contain::<Fixed>("fixed", 3, 0..=0);
}
