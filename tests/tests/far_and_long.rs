//! Guards promises 4 and 5 far from the origin, from far away, and with directions of any length:
//! answers stay those of testing all, right to what the number type can tell, and inside the
//! interval that was asked for.

use kibiray::accel::{Accel, Hit, Naive, mailbox};
use kibiray::geom::{Interval, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Shapes};
use kibiray_tests::{Compared, Memory, Shot, UNLIMITED, World, compare, naive_answers};

const SIZES: [f64; 3] = [1.0e-6, 1.0, 1.0e6];
const FAR: [f64; 3] = [148_376.0, 1234.0, -223_423.0];

/// A scene with planes through and beside it.
fn world(rng: &mut fastrand::Rng, middle: [f64; 3], size: f64) -> World {
    let mut world = World::random(rng, 6, middle, size);
    let beside = [middle[0], middle[1] - size, middle[2]];
    world.planes = vec![(beside, [0.0, 1.0, 0.0]), (middle, [1.0, 0.4, -0.8])];
    world
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn direction(rng: &mut fastrand::Rng) -> [f64; 3] {
    loop {
        let v = [0; 3].map(|_: i32| rng.f64() * 2.0 - 1.0);
        let l = length(v);
        if l > 0.1 && l < 1.0 {
            return v.map(|x| x / l);
        }
    }
}

/// From 10^`from` to 10^`to` sizes away into the scene.
fn far_shots<R: Real>(
    rng: &mut fastrand::Rng,
    (middle, size): ([f64; 3], f64),
    (from, to): (f64, f64),
    count: usize,
    length: impl Fn(&mut fastrand::Rng) -> f64,
) -> Vec<Shot<R>> {
    let mut shots = Vec::new();
    while shots.len() < count {
        let away = size * 10.0_f64.powf(from + (to - from) * rng.f64());
        let way = direction(rng);
        let target = [0, 1, 2].map(|a| middle[a] + size * (rng.f64() - 0.5));
        let origin = [0, 1, 2].map(|a| target[a] - way[a] * away);
        let l = length(rng);
        let ray = Ray::new(Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(way.map(|x| x * l)));
        if let Ok(ray) = ray {
            let interval = if rng.u8(0..4) == 0 {
                let t = away / l;
                // Not so narrow that no number of the type lies between the bounds.
                let half = size / l * rng.f64();
                Interval::new(R::from_f64(t - half), R::from_f64(t + half))
            } else {
                Interval::RAY
            };
            shots.push((ray, interval));
        }
    }
    shots
}

fn any_length(rng: &mut fastrand::Rng) -> f64 {
    10.0_f64.powf(rng.f64() * 24.0 - 12.0)
}

fn conform<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    let mut rng = fastrand::Rng::with_seed(21);
    let mut all = Compared::default();
    for middle in [[0.0; 3], FAR] {
        for size in SIZES {
            // Where the number type cannot tell a shape's corners apart there is no such shape.
            let tables = world(&mut rng, middle, size).tables::<R>();
            let polygons = tables.polygons();
            let scene = tables.scene(&polygons);
            let shots = far_shots(&mut rng, (middle, size), (1.0, 9.0), 2000, any_length);
            let what = format!("{number} size {size:e} around {middle:?}");
            let compared = compare(&what, &scene, &shots, &mut memory);
            println!("{what}, {} shapes: {compared:?}", scene.shapes().count());
            all += compared;
        }
    }
    assert!(all.hits > all.rays / 10);
}

#[test]
fn far_rays_of_any_length_get_the_hits_of_testing_all_in_f32() {
    conform::<f32>("f32");
}

#[test]
fn far_rays_of_any_length_get_the_hits_of_testing_all_in_f64() {
    conform::<f64>("f64");
}

/// Multiplying with a power of two is exact and goes through every operation of a test, so a
/// direction 2^k times as long gives the same hit at t / 2^k, bit for bit.
fn scales<R: Real>(number: &str) {
    let mut rng = fastrand::Rng::with_seed(22);
    let (mut hits, mut rays) = (0, 0);
    for middle in [[0.0; 3], FAR] {
        for size in SIZES {
            let tables = world(&mut rng, middle, size).tables::<R>();
            let polygons = tables.polygons();
            let scene = tables.scene(&polygons);
            let shots: Vec<Shot<R>> =
                far_shots(&mut rng, (middle, size), (-1.0, 4.0), 2000, |rng| 0.5 + rng.f64());
            let expected = naive_answers(&scene, &shots);
            for k in [-40, -21, -20, -19, -5, -4, -3, -1, 1, 3, 4, 5, 19, 20, 21, 40] {
                let (by, back) = (2.0_f64.powi(k), 2.0_f64.powi(-k));
                let scaled = shots.iter().map(|(ray, interval)| {
                    let ray = Ray::new(ray.origin(), ray.direction() * R::from_f64(by)).unwrap();
                    let bound = |t: R| t * R::from_f64(back);
                    (ray, Interval::new(bound(interval.min), bound(interval.max)))
                });
                let scaled: Vec<Shot<R>> = scaled.collect();
                let found = naive_answers(&scene, &scaled);
                for (i, ((found, expected), shot)) in
                    found.iter().zip(&expected).zip(&shots).enumerate()
                {
                    // Numbers, not bits: a 0 may lose its sign.
                    let value = |(t, id): (u64, usize)| (f64::from_bits(t), id);
                    let (found, (hit, any)) = ((found.0.map(value), found.1), *expected);
                    let hit = hit.map(value).map(|(t, id)| (t * back, id));
                    let what = "a direction 2^k times as long";
                    assert_eq!(
                        found,
                        (hit, any),
                        "{number} size {size:e} around {middle:?}: {what}, k = {k}, ray {i} {shot:?}"
                    );
                    rays += 1;
                    hits += usize::from(any);
                }
            }
        }
    }
    println!("{number}: {rays} rays, {hits} hit");
    assert!(hits > rays / 10);
}

#[test]
fn a_direction_times_a_power_of_two_divides_t_exactly() {
    scales::<f32>("f32");
    scales::<f64>("f64");
}

fn nearest<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    origin: [f64; 3],
    way: [f64; 3],
    min: f64,
) -> Option<Hit<R>> {
    let ray = Ray::new(Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(way)).unwrap();
    let interval = Interval::new(R::from_f64(min), R::INFINITY);
    Naive::new(scene).nearest(scene, &ray, interval, &mut mailbox::Off, &mut ())
}

/// The reference is f64 on the same rays and the same shapes, whose numbers are exact in f32.
///
/// What f32 computes is the crossing of a ray that runs beside the true one, at a distance of at
/// most `aside` along each axis. Let u = 2^-24 be half a unit in the last place, D the greatest
/// coordinate of the ray's origin and S that of the scene:
/// * an origin farther away than 4 S is moved by `origin + direction * enter` to a place within
///   5 S. `enter` may be off, for the ray is only moved along itself; its product with the direction
///   is rounded once, up to u (D + 5 S), the sum once more, up to u 5 S;
/// * from there a shape may claim a hit as far aside as the slack, 32 units in the last place: 64 u S.
///
/// So aside = u (D + 74 S). Its own rounding leaves t off by no more than u t from the sum with
/// `enter`, u t from the scaling back, and by the slack along the ray: along = 2 u t + 64 u S / |d|.
///
/// A ray is *clear* when the four that run beside it at the corners of a square with that distance
/// meet the same shape at the same face. For t as a function of the way aside, convex or concave as
/// it is on a face, the four bound t: with m the true t and lo, hi the extremes of the four, every t
/// in the square lies between min(lo, 2 m - hi) and max(hi, 2 m - lo).
fn accurate(middle: [f64; 3], size: f64, (from, to): (f64, f64)) -> (usize, f64) {
    let mut rng = fastrand::Rng::with_seed(23);
    let mut world = world(&mut rng, middle, size);
    world.round_to_f32();
    let (small, large) = (world.tables::<f32>(), world.tables::<f64>());
    let (small_polygons, large_polygons) = (small.polygons(), large.polygons());
    let (small, large) = (small.scene(&small_polygons), large.scene(&large_polygons));
    assert_eq!(small.shapes().count(), large.shapes().count(), "the same shapes");
    let u = 2.0_f64.powi(-24);
    let scale = f64::from(small.bounds().max_abs());
    let (mut clear, mut worst) = (0, 0.0_f64);
    let shots: Vec<Shot<f32>> = far_shots(&mut rng, (middle, size), (from, to), 10_000, |rng| {
        10.0_f64.powf(rng.f64() * 8.0 - 4.0)
    });
    for (ray, _) in shots {
        let origin = ray.origin().to_array().map(f64::from);
        let way = ray.direction().to_array().map(f64::from);
        let Some(Hit { t: exact, id, .. }) = nearest(&large, origin, way, 0.0) else { continue };
        let aside = u * (f64::from(ray.origin().max_abs()) + 74.0 * scale);
        // Across the ray, long enough for what is `aside` along each of three axes.
        let reach = aside * 3.0_f64.sqrt();
        let (a, b) = across(way);
        let mut ts = Vec::new();
        for (i, j) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            let beside = [0, 1, 2].map(|c| origin[c] + reach * (a[c] * i + b[c] * j));
            if let Some(hit) = nearest(&large, beside, way, 0.0)
                && hit.id == id
            {
                ts.push(hit.t);
            }
        }
        let (lo, hi) = ts.iter().fold((exact, exact), |(lo, hi), t| (lo.min(*t), hi.max(*t)));
        // The same face: all within a slope of 3 to 1, and nowhere near an edge to another face.
        let same = ts.len() == 4 && (hi - lo) * length(way) < 6.0 * reach;
        let along = 2.0 * u * exact + 64.0 * u * scale / length(way);
        // And no other face right behind.
        let behind = nearest(&large, origin, way, exact);
        let alone = behind.is_none_or(|next| next.t - exact > 2.0 * (along + hi - lo));
        if !(same && alone) {
            continue;
        }
        clear += 1;
        let hit =
            nearest(&small, origin, way, 0.0).unwrap_or_else(|| panic!("lost: {ray:?}, {id}"));
        let t = f64::from(hit.t);
        assert_eq!(hit.id, id, "{ray:?}: {t} for {exact}");
        let (least, greatest) = (lo.min(2.0 * exact - hi), hi.max(2.0 * exact - lo));
        assert!(
            t >= least - along && t <= greatest + along,
            "{ray:?} shape {id}: {t} for {exact}, {least} to {greatest}, {along} along"
        );
        worst = worst.max((t - exact).abs() / (along + greatest - least));
    }
    (clear, worst)
}

/// Two directions of length 1 across one another and a third.
fn across(way: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let unit = |v: [f64; 3]| v.map(|x| x / length(v));
    let least = if way[0].abs() < 0.6 * length(way) { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let a = unit(cross(way, least));
    (a, unit(cross(way, a)))
}

#[test]
fn t_in_f32_is_as_good_as_its_digits() {
    for middle in [[0.0; 3], [3.0, -2.0, 1.0]] {
        for size in SIZES {
            let middle = middle.map(|x: f64| x * size);
            for from in [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0] {
                let (clear, worst) = accurate(middle, size, (from, from + 1.0));
                println!(
                    "size {size:e} around {middle:?} from 10^{from}: {clear} clear, {worst:.3}"
                );
                assert!(clear > 1000, "size {size:e}, 10^{from}: {clear} is too few");
            }
        }
    }
}

/// What an open interval must not contain: nothing between reversed or equal bounds or such that are
/// not numbers; nothing on a bound either.
fn nothing_between<R: Real>(number: &str) {
    let mut memory = Memory::new(UNLIMITED);
    let nan = R::from_f64(f64::NAN);
    let mut rng = fastrand::Rng::with_seed(24);
    for (middle, size) in [([0.0; 3], 1.0), (FAR, 1.0e6), ([0.0; 3], 1.0e-6)] {
        let tables = world(&mut rng, middle, size).tables::<R>();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons);
        let mut shots: Vec<Shot<R>> =
            far_shots(&mut rng, (middle, size), (-1.0, 1.0), 150, |_| 1.0);
        shots.extend(far_shots(&mut rng, (middle, size), (1.0, 9.0), 150, any_length));
        let mut empty = Vec::new();
        for ((ray, _), (hit, _)) in shots.iter().zip(naive_answers(&scene, &shots)) {
            let t = hit.map_or(R::ONE, |(t, _)| R::from_f64(f64::from_bits(t)));
            let many = [R::ZERO, R::ONE, t, R::MAX, R::INFINITY, -R::INFINITY, -t];
            let reversed = many.iter().flat_map(|a| many.map(|b| (*a, b))).filter(|(a, b)| a >= b);
            let not = many.iter().flat_map(|a| [(*a, nan), (nan, *a)]).chain([(nan, nan)]);
            empty.extend(reversed.chain(not).map(|(a, b)| (*ray, Interval::new(a, b))));
        }
        let what = format!("{number} size {size:e} around {middle:?}");
        for (shot, answer) in empty.iter().zip(naive_answers(&scene, &empty)) {
            assert_eq!(answer, (None, false), "{what}: {shot:?}");
        }
        let compared = compare(&what, &scene, &empty, &mut memory);
        println!("{what}: {compared:?}");
    }
}

#[test]
fn empty_intervals_contain_no_hit() {
    nothing_between::<f32>("f32");
    nothing_between::<f64>("f64");
}

/// Between neighbouring numbers there is none, wherever the ray starts.
fn between_neighbours<R: Real>(number: &str) {
    let mut rng = fastrand::Rng::with_seed(25);
    for (middle, size) in [([0.0; 3], 1.0), (FAR, 1.0e6), ([0.0; 3], 1.0e-6)] {
        let tables = world(&mut rng, middle, size).tables::<R>();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons);
        let shots: Vec<Shot<R>> =
            far_shots(&mut rng, (middle, size), (-1.0, 9.0), 1000, any_length);
        let mut empty = Vec::new();
        for ((ray, _), (hit, _)) in shots.iter().zip(naive_answers(&scene, &shots)) {
            let t = hit.map_or(R::ONE, |(t, _)| R::from_f64(f64::from_bits(t)));
            empty.push((*ray, Interval::new(t, t.next_up())));
            empty.push((*ray, Interval::new(t.next_down(), t)));
        }
        for (shot, answer) in empty.iter().zip(naive_answers(&scene, &empty)) {
            assert_eq!(answer, (None, false), "{number} size {size:e}: {shot:?}");
        }
    }
}

#[test]
fn between_neighbouring_numbers_there_is_no_hit() {
    between_neighbours::<f32>("f32");
    between_neighbours::<f64>("f64");
}
