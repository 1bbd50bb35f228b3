//! What a number type costs in accuracy: primary rays of every SPD scene at its default size, in
//! `f32` and in fixed point, against `f64`.
//!
//! A wrong id is *explained* where it cannot be told within the bound: when in `f64`, too, the
//! shape that was found lies that near, or when a ray moved aside by no more than the bound finds it.
//! The bound is 64 steps of a format at the scene's size: 64 times 2^-24 of its greatest coordinate,
//! the eye's included, for `f32`, and 64 times 2^-28 of the normalised scene for fixed point.

use kibiray::accel::{Accel, Bvh, mailbox::Off};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::{Fixed, Real, Vector};
use kibiray::scene::{Scene, Shapes};
use kibiray_host_sim::description::Description;
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::{HostShapes, Tables};
use kibiray_tests::{Memory, UNLIMITED};

const SCENES: [&str; 11] = [
    "balls", "gears", "mount", "rings", "teapot", "tetra", "tree", "lattice", "shells", "sombrero",
    "jacks",
];

/// Rays along each axis of the picture.
const ACROSS: i32 = 513;

type Asked = ([f64; 3], [f64; 3]);

/// The rays of a picture of 512 by 512, through the corners of pixels.
fn rays(description: &Description) -> Vec<Asked> {
    let view = kibiray_host_sim::view::of(description);
    let v = glam::DVec3::from_array;
    let (from, forward) = (v(view.from), (v(view.at) - v(view.from)).normalize());
    let half = (view.angle.to_radians() / 2.0).tan();
    let right = forward.cross(v(view.up)).normalize();
    let up = right.cross(forward);
    let place = |i: i32| f64::from(2 * i - ACROSS + 1) / f64::from(ACROSS - 1) * half;
    let ray = |x: i32, y: i32| {
        let d = forward + right * place(x) - up * place(y);
        (from.to_array(), d.normalize().to_array())
    };
    (0..ACROSS).flat_map(|y| (0..ACROSS).map(move |x| ray(x, y))).collect()
}

/// The nearest hit in the file's terms.
type Found = Option<(f64, usize)>;

fn with_scene<R: Real, T>(
    description: &Description,
    act: impl FnOnce(&Frame, &Tables<R>, &Scene<'_, R, HostShapes<'_, R>>, &Bvh<'_, R, u32>) -> T,
) -> T {
    let frame = Frame::of::<R>(description);
    let moved = frame.apply(description);
    let tables = Tables::<R>::new(&moved).unwrap();
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons).unwrap();
    let mut memory = Memory::new(UNLIMITED);
    let mut arena = Arena::new(memory.bytes(UNLIMITED));
    let accel = Bvh::build(&scene, scene.shapes().count(), &mut arena).unwrap();
    act(&frame, &tables, &scene, &accel)
}

fn trace<R: Real>(description: &Description, rays: &[Asked]) -> Vec<Found> {
    with_scene::<R, _>(description, |frame, tables, scene, accel| {
        let find = |(o, d): &Asked| {
            let (ray, between, way) = frame.query::<R>(*o, *d, (0.0, f64::INFINITY)).unwrap();
            let hit = accel.nearest(scene, &ray, between, &mut Off, &mut ())?;
            Some((way.restore(hit.t.to_f64()), tables.file_id(hit.id)))
        };
        rays.iter().map(find).collect()
    })
}

/// What a number type got wrong.
#[derive(Debug, Default)]
struct Wrong {
    ids: usize,
    unexplained: usize,
    /// Errors of t where the id is right, in parts of the scene's size, in ascending order.
    errors: Vec<f64>,
}

impl Wrong {
    fn at(&self, share: f64) -> f64 {
        self.errors.get((self.errors.len() as f64 * share) as usize).copied().unwrap_or(0.0)
    }
}

/// Whether `f64` may find what was found, within the bound.
fn explained(
    description: &Description,
    rays: &[Asked],
    found: &[(usize, Found)],
    bound: f64,
) -> usize {
    with_scene::<f64, _>(description, |_, tables, scene, accel| {
        let shapes = scene.shapes();
        let ids: Vec<usize> = (0..shapes.count()).map(|id| tables.file_id(id)).collect();
        let ray_of = |o: glam::DVec3, d: glam::DVec3| Ray::<f64>::new(o, d).unwrap();
        let is_explained = |(place, found): &(usize, Found)| {
            let (o, d) = rays[*place];
            let (o, d) = (glam::DVec3::from_array(o), glam::DVec3::from_array(d));
            let ray = ray_of(o, d);
            let nearest = accel.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
            let far = nearest.map_or(f64::INFINITY, |hit| hit.t);
            // At the same distance within the bound: touching, or coincident, shapes.
            if let Some((t, id)) = found
                && (t - far).abs() <= bound
            {
                let per_ray = shapes.per_ray(&ray);
                let near = |shape: usize| {
                    let hit = shapes.hit(shape, &ray, &per_ray, 0.0, f64::INFINITY);
                    hit.is_some_and(|t| (t - far).abs() <= bound)
                };
                if (0..ids.len()).any(|shape| ids[shape] == *id && near(shape)) {
                    return true;
                }
            }
            // Moved aside.
            let aside = d.any_orthonormal_pair();
            (0..256).any(|i| {
                let (turn, reach) = (f64::from(i) * 2.399_963, f64::from(i % 16 + 1) / 16.0);
                let off = (aside.0 * turn.cos() + aside.1 * turn.sin()) * bound * reach;
                let ray = ray_of(o + off, d);
                let hit = accel.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
                hit.map(|hit| ids[hit.id]) == found.map(|(_, id)| id)
            })
        };
        found.iter().filter(|wrong| is_explained(wrong)).count()
    })
}

fn compare(
    description: &Description,
    rays: &[Asked],
    exact: &[Found],
    found: &[Found],
    size: f64,
    bound: f64,
) -> Wrong {
    let mut wrong = Wrong::default();
    let mut differing = Vec::new();
    for (place, (exact, found)) in exact.iter().zip(found).enumerate() {
        match (exact, found) {
            (None, None) => {}
            (Some((t, id)), Some((u, other))) if id == other => {
                wrong.errors.push((t - u).abs() / size);
            }
            _ => differing.push((place, *found)),
        }
    }
    wrong.errors.sort_by(f64::total_cmp);
    wrong.ids = differing.len();
    wrong.unexplained = differing.len() - explained(description, rays, &differing, bound);
    wrong
}

#[test]
fn fixed_point_is_at_least_as_accurate_as_single_precision() {
    println!("513² primary rays; errors of t in 10^-9 of the scene's greatest extent");
    println!(
        "scene      f32: wrong ids, unexplained, median, 99 %, most   fixed: the same   (rays that hit)"
    );
    let mut failures = Vec::new();
    for name in SCENES {
        let description = load(&format!("spd:{name}")).unwrap();
        let rays = rays(&description);
        let exact = trace::<f64>(&description, &rays);
        let (lo, hi) = kibiray_host_sim::view::bounds(&description);
        let size = (0..3).map(|a| hi[a] - lo[a]).fold(0.0, f64::max);
        let eye = kibiray_host_sim::view::of(&description).from;
        let greatest = lo.iter().chain(&hi).chain(&eye).fold(0.0, |m: f64, x| m.max(x.abs()));
        let of_f32 = 64.0 * greatest / f64::from(1 << 24);
        let unit = Frame::of::<Fixed>(&description).unit();
        let of_fixed = 64.0 * unit / f64::from(1 << 28);
        let single = trace::<f32>(&description, &rays);
        let single = compare(&description, &rays, &exact, &single, size, of_f32);
        let fixed = trace::<Fixed>(&description, &rays);
        let fixed = compare(&description, &rays, &exact, &fixed, size, of_fixed);
        let show = |w: &Wrong| {
            let [half, most] = [0.5, 0.99].map(|share| w.at(share) * 1e9);
            let worst = w.errors.last().copied().unwrap_or(0.0) * 1e9;
            format!("{:4} {:3} {half:8.2} {most:9.2} {worst:11.1}", w.ids, w.unexplained)
        };
        println!(
            "{name:9}  {}   {}   {}",
            show(&single),
            show(&fixed),
            exact.iter().flatten().count()
        );
        for (number, w) in [("f32", &single), ("fixed", &fixed)] {
            if w.unexplained > 0 {
                failures.push(format!("{name} {number}: {} wrong ids unexplained", w.unexplained));
            }
        }
        if fixed.ids * 2000 > rays.len() {
            failures.push(format!("{name}: {} wrong ids of {}", fixed.ids, rays.len()));
        }
        if fixed.at(0.99) > single.at(0.99) {
            failures.push(format!("{name}: the 99th percentile is greater than that of f32"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn a_scene_is_moved_to_the_middle_and_back() {
    let description = load("spd:mount:4").unwrap();
    let frame = Frame::of::<Fixed>(&description);
    let moved = frame.apply(&description);
    let (lo, hi) = kibiray_host_sim::view::bounds(&moved);
    assert!(lo.iter().chain(&hi).all(|x| x.abs() <= 0.5), "{lo:?} {hi:?}");
    assert!((0..3).any(|a| hi[a] - lo[a] > 0.4));
    // Rays of any length, from anywhere, mean what they meant.
    for (o, length) in
        [([0.1, 0.2, 9.0], 1.0), ([30.0, -4.0, 5000.0], 1.0e-3), ([0.0, 0.0, 3.0], 1e9)]
    {
        let to = [0.05, 0.01, 0.1];
        let d = [0, 1, 2].map(|a| (to[a] - o[a]) * length);
        let (ray, _, way) = frame.query::<Fixed>(o, d, (0.0, f64::INFINITY)).unwrap();
        let (start, moved) = (ray.origin().to_array(), ray.at(Fixed::ONE).to_array());
        let [a, b] = [start, moved].map(|p| glam::DVec3::from_array(p.map(Real::to_f64)));
        let steps = way.restore(1.0) - way.restore(0.0);
        let exact = glam::DVec3::from_array(d) * steps / frame.unit();
        assert!(((b - a) - exact).length() < 1e-7, "{a} {b} {exact}");
    }
    assert!(frame.query::<Fixed>([0.0; 3], [0.0; 3], (0.0, 1.0)).is_err());
    assert!(frame.query::<Fixed>([f64::NAN; 3], [1.0; 3], (0.0, 1.0)).is_err());
}
