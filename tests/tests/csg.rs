//! Combined solids in scenes: number types agree, what skipping operands saves, and what is refused.
//! That structures agree is in `conformance`.

use kibiray::accel::mailbox::Off;
use kibiray::accel::{Accel, Naive};
use kibiray::geom::{Interval, Ray, Slopes};
use kibiray::num::{Fixed, Real, Vector};
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Either, Shapes};
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::description::{Description, nff};
use kibiray_host_sim::frame::Frame;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{SHOWPIECES, combined_scenes};

/// Where rays meet something, as parameters of the file's rays.
fn seen<R: Real>(description: &Description) -> Vec<Option<f64>> {
    let frame = Frame::of::<R>(description);
    let moved = frame.apply(description).into_owned();
    let tables = Tables::<R>::new(&moved).unwrap();
    let borrowing = tables.polygons();
    let scene = tables.scene(&borrowing).unwrap();
    let mut rng = fastrand::Rng::with_seed(5);
    let naive = Naive::new(&scene);
    let mut seen = Vec::new();
    for _ in 0..20_000 {
        let mut part = |size: f64| std::array::from_fn(|_| rng.f64() * 2.0 * size - size);
        let (from, to): ([f64; 3], [f64; 3]) = (part(9.0), part(3.0));
        let to = std::array::from_fn(|i| to[i] - from[i]);
        let (ray, interval, way) = frame.query::<R>(from, to, (0.0, f64::INFINITY)).unwrap();
        let hit = naive.nearest(&scene, &ray, interval, &mut Off, &mut ());
        seen.push(hit.map(|hit| way.restore(hit.t.to_f64())));
    }
    seen
}

#[test]
fn number_types_agree() {
    for (name, description) in combined_scenes() {
        let exact = seen::<f64>(&description);
        for (number, other) in
            [("f32", seen::<f32>(&description)), ("fixed", seen::<Fixed>(&description))]
        {
            assert_eq!(exact.len(), other.len());
            let (mut hits, mut differ, mut worst) = (0, 0, 0.0_f64);
            for pair in exact.iter().zip(&other) {
                match pair {
                    (Some(t), Some(other)) if (t - other).abs() <= 1e-4 => {
                        hits += 1;
                        worst = worst.max((t - other).abs());
                    }
                    // Beyond the objects, on the floor towards the horizon, where a parameter
                    // has few digits in f32 and none in fixed point.
                    (Some(t), other) if *t > 1.5 && other.is_none_or(|other| other > 1.5) => {}
                    (None, None) => {}
                    // At edges a ray may pass one face and meet another.
                    _ => differ += 1,
                }
            }
            println!("{name} {number}: {hits} hits, {differ} differ, others by {worst:e} at most");
            assert!(hits > 2000 && differ * 5000 <= hits, "{name} {number} {hits} {differ}");
        }
    }
}

/// Tests of parts that the rays of a picture and their shadow rays take: of all objects whose box is
/// met, all parts; and those that are left by skipping.
#[test]
fn skipping_saves_more_than_half_of_the_tests() {
    println!("scene   rays     tests of all parts  with skipping  saved");
    let mut total = [0, 0];
    for name in SHOWPIECES {
        let description = load(name).unwrap();
        let tables = Tables::<f32>::new(&description).unwrap();
        let borrowing = tables.polygons();
        let scene = tables.scene(&borrowing).unwrap();
        let Either::One((combined, _)) = scene.shapes() else { panic!("{name}: of one kind") };
        let camera = Camera::new(tables.view(), 4.0 / 3.0).unwrap();
        let (mut rays, mut all, mut left) = (0, Counters::default(), Counters::default());
        let mut by_object = vec![[0; 3]; combined.count()];
        let mut shoot = |ray: &Ray<f32>| {
            rays += 1;
            let (slopes, per_ray) = (Slopes::of(ray), combined.per_ray(ray));
            let mut nearest = f32::INFINITY;
            for (id, counts) in by_object.iter_mut().enumerate() {
                let bounds = combined.bounds(id).grown(ray.slack());
                if slopes.clip(bounds.lo, bounds.hi, 0.0, nearest).is_none() {
                    continue;
                }
                let window = (0.0, nearest);
                let all_parts = |probe: &mut Counters| {
                    let mut first = None;
                    combined.crossings(id, ray, window, false, probe, |crossing| {
                        if first.is_none() && crossing.t > 0.0 && crossing.t <= nearest {
                            first = Some(crossing.t);
                        }
                    });
                    first
                };
                let before = (all.primitive_tests, left.primitive_tests);
                let found = all_parts(&mut all);
                let first = combined.first_crossing(id, ray, &per_ray, window, &mut left);
                assert_eq!(found, first.map(|crossing| crossing.t));
                let [met, tests, without] = counts;
                *met += 1;
                *tests += all.primitive_tests - before.0;
                *without += left.primitive_tests - before.1;
                nearest = found.unwrap_or(nearest);
            }
            nearest
        };
        for y in 0..120_i16 {
            for x in 0..160_i16 {
                let place = |i: i16, of: f32| (f32::from(i) + 0.5) / of * 2.0 - 1.0;
                let Some(ray) = camera.ray(place(x, 160.0), place(y, 120.0)) else { continue };
                let t = shoot(&ray);
                for light in description.lights.iter().filter(|_| t.is_finite()) {
                    let from = ray.at(t * 0.9999);
                    let to = glam::Vec3::from_f64(light.position);
                    if let Ok(shadow) = Ray::new(from, to - from) {
                        shoot(&shadow);
                    }
                }
            }
        }
        for (id, [met, all, left]) in by_object.iter().enumerate() {
            let parts = all / (*met).max(1);
            println!("  object {id} of {parts} parts, box met {met} times: {all}, {left}");
        }
        let (all, left) = (all.primitive_tests, left.primitive_tests);
        println!("{name:<8}{rays:<9}{all:<20}{left:<15}{:.1} times", all as f64 / left as f64);
        assert!(rays > 20_000 && left < all, "{name} {all} {left}");
        total = [total[0] + all, total[1] + left];
    }
    let [all, left] = total;
    println!("all              {all:<20}{left:<15}{:.1} times", all as f64 / left as f64);
    assert!(left * 2 <= all, "{all} {left}");
}

#[test]
fn what_makes_no_object_is_refused_by_its_id() {
    let refused =
        |text: &str| Tables::<f32>::new(&nff::parse(text).unwrap()).unwrap_err().to_string();
    for (text, why) in [
        (
            "s 0 0 0 1 intersection s 0 0 0 1 s 5 0 0 1 end",
            "primitive 1: nothing is left of it: what it intersects does not meet",
        ),
        (
            "union s 0 0 0 1 end union s 0 0 0 1 halfspace 0 0 0 0 0 1 end",
            "primitive 1: it has no end: a halfspace is not cut on all sides",
        ),
        (
            "s 0 0 0 1 s 1 0 0 1 polyhedron 4 0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 0 1 1 1 1 1 1",
            "primitive 2: a part: a polyhedron needs faces on every side",
        ),
        (
            "difference s 0 0 0 1 box 1 1 1 1 1 1 end",
            "primitive 0: a part: it has no surface: a radius, length or area is zero or vanishes \
             in products",
        ),
        (
            "box 0 0 0 1 1 1 scale 1 1e-30 1 s 0 0 0 1 end",
            "primitive 1: a part: a coordinate or radius is not finite, or too great to compute with",
        ),
    ] {
        assert_eq!(refused(text), why, "{text}");
    }
    let many = format!("s 0 0 0 1 union {} end", "s 0 0 0 1 ".repeat(257));
    assert_eq!(refused(&many), "primitive 1: 257 parts, at most 256 can be combined");
    let fits = format!("union {} end", "s 0 0 0 1 ".repeat(256));
    assert!(Tables::<f32>::new(&nff::parse(&fits).unwrap()).is_ok());
    let full = "scale 1 1 2 s 0 0 0 1 end ".repeat(65_537);
    assert_eq!(refused(&full), "combined solids: 65537 steps where at most 65536 can be numbered");
}

#[test]
fn a_query_anywhere_sees_the_normal_out_of_what_is_left() {
    // The classic: a cube and a ball without a bore along z.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let text = "difference intersection box -1 -1 -1 1 1 1 s 0 0 0 1.35 end
                cone 0 0 -2 0.5 0 0 2 0.5 end";
    let tables = Tables::<f32>::new(&nff::parse(text).unwrap()).unwrap();
    let borrowing = tables.polygons();
    let scene = tables.scene(&borrowing).unwrap();
    for (o, d, expected) in [
        // On the cube, on the ball, in the bore; along the bore nothing.
        ([0.7, 0.1, 5.0], [0.0, 0.0, -1.0], Some((4.0, [0.0, 0.0, 1.0]))),
        ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], Some((0.5, [-1.0, 0.0, 0.0]))),
        ([3.0, 3.0, 0.0], [-1.0, -1.0, 0.0], Some((2.045_406, [half, half, 0.0]))),
        ([0.2, 0.1, 5.0], [0.0, 0.0, -1.0], None),
    ] {
        let ray = Ray::<f32>::new(o.into(), d.into()).unwrap();
        let hit = Naive::new(&scene).nearest(&scene, &ray, Interval::RAY, &mut Off, &mut ());
        let found = hit.map(|hit| (hit.t, scene.surface(&ray, &hit).unwrap().normal));
        match (found, expected) {
            (Some((t, n)), Some((expected, normal))) => {
                assert!(
                    (t - expected).abs() < 1e-5 && (n - glam::Vec3::from(normal)).length() < 1e-5
                );
            }
            (found, expected) => assert_eq!(found.is_none(), expected.is_none()),
        }
    }
}
