//! Polygons: through vertices, concave ones too, and along edges, alone and where several meet.

use super::Report;
use super::tools::{Court, Random, V, add, ray, rounding, sub, times, v};
use kibiray::geom::Interval;
use kibiray::scene::{Scene, Solids};
use kibiray::shape::{Polygon, Shape};
use kibiray_tests::oracle::{Tally, Tested};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    vec![
        ("at stars and combs", Some(judged::<R>(percent * 1000))),
        ("shared vertices and edges, level", Some(shared::<R>(percent * 300, false))),
        ("shared vertices and edges, tilted", Some(shared::<R>(percent * 300, true))),
    ]
}

/// A star, with every other corner concave.
fn star(points: usize, inner: f64) -> Vec<[f64; 2]> {
    (0..2 * points)
        .map(|i| {
            let (s, c) = (i as f64 * std::f64::consts::PI / points as f64).sin_cos();
            let r = if i % 2 == 0 { 1.0 } else { inner };
            [r * c, r * s]
        })
        .collect()
}

/// A comb of so many teeth; every corner a multiple of 1/8.
fn comb(teeth: usize) -> Vec<[f64; 2]> {
    let mut corners = vec![[-1.0, -1.0], [-1.0 + teeth as f64 / 4.0, -1.0]];
    for i in (0..teeth).rev() {
        let x = -1.0 + i as f64 / 4.0;
        corners.extend([[x + 0.25, 0.5], [x + 0.125, 0.5], [x + 0.125, -0.5], [x, -0.5]]);
    }
    corners
}

fn judged<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(51);
    let mut tally = Tally::default();
    for i in 0..rays / 50 {
        let outline = if i % 2 == 0 { star(3 + i % 9, 0.4) } else { comb(1 + i % 7) };
        let origin = times(random.vector(), 3.0);
        let x = random.direction();
        let y = random.across(x);
        let size = random.decade(-2.0, 1.0);
        let place = |[a, b]: [f64; 2]| add(origin, add(times(x, a * size), times(y, b * size)));
        let corners: Vec<_> = outline.iter().map(|p| v::<R>(place(*p))).collect();
        let polygons = [Polygon::new(&corners)];
        if polygons[0].check().is_err() {
            continue;
        }
        let scene = Scene::new(Solids { polygons: &polygons, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        for k in 0..50 {
            let a = outline[random.below(outline.len())];
            let b = outline[random.below(outline.len())];
            let s = random.within(0.0, 1.0);
            let at = match k % 4 {
                0 => a,
                1 => [a[0] * s + b[0] * (1.0 - s), a[1] * s + b[1] * (1.0 - s)],
                _ => [random.signed() * 1.1, random.signed() * 1.1],
            };
            let d = if k == 9 { x } else { random.direction() };
            let away = size * random.decade(-1.0, 2.0);
            if let Some(ray) = ray::<R>(sub(place(at), times(d, away)), d) {
                court.shoot(&ray, &mut tally);
            }
        }
    }
    tally
}

/// Polygons that fill a square together, corners on a lattice of whole numbers: any ray through the
/// square, a vertex or an edge inside it meets exactly one, and beside the square none.
fn shared<R: Tested>(rays: usize, tilted: bool) -> Tally {
    const PIECES: [&[[i8; 2]]; 5] = [
        // An L, a T upside down in its notch, and the rest around them.
        &[[0, 0], [8, 0], [8, 2], [2, 2], [2, 4], [2, 6], [2, 8], [0, 8]],
        &[[2, 2], [8, 2], [8, 4], [6, 4], [6, 6], [4, 6], [4, 4], [2, 4]],
        &[[2, 4], [4, 4], [4, 6], [2, 6]],
        &[[6, 4], [8, 4], [8, 8], [6, 8], [6, 6]],
        &[[2, 6], [4, 6], [6, 6], [6, 8], [2, 8]],
    ];
    let mut random = Random::new(52);
    let mut tally = Tally::default();
    // The plane stays one of whole numbers.
    let place = |x: f64, y: f64| -> V {
        let place = if tilted { [x, y, 2.0 * x - y] } else { [x, y, 1.0] };
        times(place, 0.25)
    };
    let tables: Vec<Vec<_>> = PIECES
        .iter()
        .map(|p| p.iter().map(|[x, y]| v::<R>(place(f64::from(*x), f64::from(*y)))).collect())
        .collect();
    let polygons: Vec<Polygon<'_, R>> = tables.iter().map(|t| Polygon::new(t)).collect();
    for i in 0..rays {
        let whole = |random: &mut Random| f64::from(random.rng().i8(-1..=9));
        let (x, y) = match i % 3 {
            // A vertex, a point of an edge, anything.
            0 => (whole(&mut random), whole(&mut random)),
            1 => (whole(&mut random), random.within(-1.0, 9.0)),
            _ => (random.within(-1.0, 9.0), whole(&mut random)),
        };
        // On the outer border anything goes, as nothing lies beyond.
        if [x, y].iter().any(|c| *c == 0.0 || *c == 8.0) {
            continue;
        }
        let inside = [x, y].iter().all(|c| *c > 0.0 && *c < 8.0);
        let d = if i % 2 == 0 { [0.0, 0.0, random.sign()] } else { random.direction() };
        let from = sub(place(x, y), times(d, 4.0));
        let Some(ray) = ray::<R>(from, d) else { continue };
        let met = |polygon: &Polygon<'_, R>| {
            let polygons = [*polygon];
            let scene = Scene::new(Solids { polygons: &polygons, ..Solids::default() }).unwrap();
            super::tools::nearest(&scene, &ray, Interval::RAY)
        };
        let hits: Vec<_> = polygons.iter().filter_map(met).collect();
        let parallel = {
            let n = if tilted { [-2.0, 1.0, 1.0] } else { [0.0, 0.0, 1.0] };
            super::tools::dot(n, d).abs() < 0.05
        };
        // Closer to the border than the bound, or along the plane: counted apart.
        let margin = [x, y].iter().map(|c: &f64| c.abs().min((c - 8.0).abs())).fold(9.0, f64::min);
        if parallel || margin < 1e4 * rounding::<R>(16.0) {
            tally.rays += 1;
            tally.ambiguous += 1;
            continue;
        }
        tally.hits += hits.len() as u64;
        tally.expect(hits.len() == usize::from(inside), || {
            format!("{x} {y} {ray:?}: {} hits {:?}", hits.len(), hits.first().map(|h| h.t.to_f64()))
        });
    }
    tally
}
