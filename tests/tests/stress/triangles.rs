//! Triangles: ordinary ones, slivers, coordinates from 10^-8 to 10^8, far from the origin; rays that
//! leave a hit and must not meet it again.

use super::Report;
use super::tools::{
    Court, Random, V, add, cross, dot, floating, length, plain, ray, sub, times, v, v_in, wide,
};
use kibiray::geom::Interval;
use kibiray::scene::{Scene, Solids, Triangles};
use kibiray::shape::{Shape, Triangle};
use kibiray_tests::oracle::{Tally, Tested, exact};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    let far = [148_376.0, 1234.0, -223_423.0];
    let all = percent * 1000;
    let half = percent * 500;
    vec![
        ("about the origin", Some(judged::<R>(all, 21, |r| near(r, [0.0; 3])))),
        ("moved by 1000", floating::<R>(|| judged::<R>(half, 22, |r| near(r, [1e3, -1e3, 1e3])))),
        (
            "moved by 148376, 1234, -223423",
            floating::<R>(|| judged::<R>(half, 23, |r| near(r, far))),
        ),
        ("slivers", Some(judged::<R>(all, 24, sliver))),
        ("coordinates of 10^+-8", floating::<R>(|| judged::<R>(all, 25, |r| spread(r, 8.0)))),
        ("coordinates of 1e-7 to the greatest", Some(judged::<R>(all, 28, |r| spread(r, 0.9)))),
        ("without rounding", Some(whole::<R>(percent * 300))),
        ("left and not met again", Some(leaving::<R>(all, Way::Known, |r| near(r, [0.0; 3])))),
        (
            "left, far from the origin",
            floating::<R>(|| leaving::<R>(half, Way::Known, |r| near(r, far))),
        ),
        ("left, slivers", Some(leaving::<R>(half, Way::Known, sliver))),
        (
            "left, coordinates of 10^+-8",
            floating::<R>(|| leaving::<R>(all, Way::Known, |r| spread(r, 8.0))),
        ),
        (
            "left, coordinates of 1e-7 and up",
            Some(leaving::<R>(half, Way::Known, |r| spread(r, 0.9))),
        ),
        ("left by a distance only", Some(leaving::<R>(all, Way::Strict, |r| near(r, [0.0; 3])))),
        (
            "the same, far from the origin",
            floating::<R>(|| leaving::<R>(half, Way::Strict, |r| near(r, far))),
        ),
        ("the same, slivers", Some(leaving::<R>(half, Way::Judged, sliver))),
        (
            "the same, coordinates of 10^+-8",
            floating::<R>(|| leaving::<R>(half, Way::Judged, |r| spread(r, 8.0))),
        ),
    ]
}

fn near(random: &mut Random, middle: V) -> [V; 3] {
    let c = add(middle, times(random.vector(), 2.0));
    [0; 3].map(|_: i32| add(c, random.vector()))
}

/// A long edge, and a third corner next to it.
fn sliver(random: &mut Random) -> [V; 3] {
    let [a, b, _] = near(random, [0.0; 3]);
    let on = add(a, times(sub(b, a), random.within(-0.1, 1.1)));
    let thin = random.decade(-7.0, -2.0);
    [a, b, add(on, times(random.direction(), thin))]
}

/// Coordinates up to 10 to a power; mmp/pbrt-v4, shapes_test.cpp, `GetRandomTriangle`.
fn spread(random: &mut Random, most: f64) -> [V; 3] {
    let least = if most < 1.0 { -7.0 } else { -most };
    [0; 3].map(|_: i32| [0; 3].map(|_: i32| random.sign() * random.decade(least, most)))
}

fn point(random: &mut Random, [a, b, c]: [V; 3]) -> V {
    let (mut s, mut t) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    add(a, add(times(sub(b, a), s), times(sub(c, a), t)))
}

/// At points inside, on edges, of corners, and beside; also along the plane.
fn judged<R: Tested>(rays: usize, seed: u64, make: impl Fn(&mut Random) -> [V; 3]) -> Tally {
    let mut random = Random::new(seed);
    let mut tally = Tally::default();
    for _ in 0..rays / 25 {
        let corners = make(&mut random).map(v::<R>);
        let triangle = Triangle { corners };
        if triangle.check().is_err() {
            continue;
        }
        let table = [triangle];
        let triangles = Triangles { triangles: &table, normals: &[] };
        let scene = Scene::new(Solids { triangles, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        let corners = corners.map(wide::<R>);
        let size = length(sub(corners[1], corners[0])).max(length(sub(corners[2], corners[0])));
        for i in 0..25 {
            let inside = point(&mut random, corners);
            let at = match i % 5 {
                0 | 1 => inside,
                2 => corners[random.below(3)],
                3 => {
                    let s = random.within(0.0, 1.0);
                    add(times(corners[0], 1.0 - s), times(corners[1], s))
                }
                _ => add(inside, times(random.vector(), size)),
            };
            let away = size * random.decade(-1.0, 2.0);
            let way = if i == 7 {
                times(sub(corners[2], corners[0]), 1.0 / size)
            } else {
                random.direction()
            };
            if let Some(ray) = ray::<R>(sub(at, times(way, away)), way) {
                court.shoot(&ray, &mut tally);
            }
        }
    }
    tally
}

/// Small whole numbers along powers of two, where nothing is rounded: exactly the closed triangle. Of
/// fixed point, whose shears are cut off below the last digit, the bound of that is asked.
fn whole<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(26);
    let mut tally = Tally::default();
    for i in 0..rays {
        let small = |random: &mut Random| f64::from(random.rng().i32(-6..=6));
        let corners = [0; 3].map(|_: i32| [0; 3].map(|_: i32| small(&mut random)));
        let table = [Triangle { corners: corners.map(v::<R>) }];
        if table[0].check().is_err() {
            continue;
        }
        let triangles = Triangles { triangles: &table, normals: &[] };
        let scene = Scene::new(Solids { triangles, ..Solids::default() }).unwrap();
        // The longest component a power of two: the slopes are exact.
        let mut way = [0; 3].map(|_: i32| random.sign() * [0.0, 0.25, 0.5, 1.0][random.below(4)]);
        way[i % 3] = 2.0 * random.sign();
        let at = match i % 4 {
            0 => corners[random.below(3)],
            1 => times(add(corners[0], corners[1]), 0.5),
            _ => [0; 3].map(|_: i32| small(&mut random)),
        };
        let Some(ray) = ray::<R>(sub(at, times(way, 4.0)), way) else { continue };
        let all = Interval::new(-R::from_i32(64), R::from_i32(64));
        if R::EXACT {
            Court::new(&scene).shoot_within(&ray, all, &mut tally);
            continue;
        }
        let hit = super::tools::nearest(&scene, &ray, all);
        // In its plane: decided as no hit.
        let met = exact::meets_triangle(wide::<R>(ray.origin()), way, corners).unwrap_or(false);
        tally.hits += u64::from(hit.is_some());
        tally.expect(hit.is_some() == met, || format!("{corners:?} {ray:?}: {hit:?}, exact {met}"));
    }
    tally
}

/// How a ray leaves.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// As [`kibiray::scene::Surface::leave`] has it, to either side: never met again.
    Known,
    /// From as far off as the core says the point may be wrong: not met again.
    Strict,
    /// The same, and judged: met again only where the bound does not tell on which side of the triangle
    /// the ray starts, or through what. One thinner than the bound has no sides.
    Judged,
}

/// From a hit. mmp/pbrt-v4, shapes_test.cpp, `TEST(Triangle, Reintersect)`.
fn leaving<R: Tested>(rays: usize, leave: Way, make: impl Fn(&mut Random) -> [V; 3]) -> Tally {
    let mut random = Random::new(27);
    let mut tally = Tally::default();
    let mut shots = 0;
    while shots < rays {
        shots += 1;
        let corners = make(&mut random).map(v::<R>);
        let table = [Triangle { corners }];
        if table[0].check().is_err() {
            continue;
        }
        let triangles = Triangles { triangles: &table, normals: &[] };
        let scene = Scene::new(Solids { triangles, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        let wide_corners = corners.map(wide::<R>);
        let n = cross(sub(wide_corners[1], wide_corners[0]), sub(wide_corners[2], wide_corners[0]));
        let at = point(&mut random, wide_corners);
        let size = length(sub(wide_corners[1], wide_corners[0]));
        let way = random.direction();
        let Some(ray0) = ray::<R>(sub(at, times(way, size * random.decade(-1.0, 1.0))), way) else {
            continue;
        };
        let Some(hit) = super::tools::nearest(&scene, &ray0, Interval::RAY) else { continue };
        let Some(surface) = scene.surface(&ray0, &hit) else { continue };
        let origin = surface.point + surface.normal * surface.error;
        for _ in 0..20 {
            let way = random.direction();
            shots += 1;
            if leave == Way::Known {
                let next = surface.leave(v_in::<R>(1.0, way)).unwrap();
                let again = super::tools::nearest(&scene, &next, Interval::RAY);
                let any = super::tools::blocked(&scene, &next);
                tally.hits += u64::from(again.is_some() || any);
                tally.expect(again.is_none() && !any, || {
                    format!("{corners:?} {ray0:?} {hit:?} {next:?}: again {again:?}")
                });
                continue;
            }
            let up = dot(way, n).signum() * dot(plain::<R>(surface.normal), n).signum();
            let Some(next) = ray::<R>(wide::<R>(origin), times(way, up)) else { continue };
            let (again, _) = court.shoot(&next, &mut tally);
            if leave == Way::Strict && again.is_some() {
                tally.fail(|| format!("{corners:?} {ray0:?} {hit:?} {next:?}: again {again:?}"));
            }
        }
    }
    tally
}
