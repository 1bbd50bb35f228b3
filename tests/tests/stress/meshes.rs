//! Closed meshes: no ray from inside leaves one through an edge or a vertex, wherever the mesh is,
//! whatever the structure.

use super::Report;
use super::tools::{
    BYTES, Random, V, add, conform, cross, floating, length, ray, rounding, structures, sub, times,
    v, wide,
};
use kibiray::geom::{Interval, Ray};
use kibiray::scene::{Scene, Triangles};
use kibiray::shape::Triangle;
use kibiray_tests::Memory;
use kibiray_tests::oracle::{Tally, Tested};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    let far = [148_376.0, 1234.0, -223_423.0];
    vec![
        ("ball about the origin", Some(ball::<R>(percent, [0.0; 3]))),
        ("ball moved by 1e3", floating::<R>(|| ball::<R>(percent, [1e3, -1e3, 1e3]))),
        ("ball moved by 1e5", floating::<R>(|| ball::<R>(percent, [-1e5, 1e5, 1e5]))),
        ("ball moved by 148376, 1234, -223423", floating::<R>(|| ball::<R>(percent, far))),
        ("edges of a knot, from anywhere", Some(knot::<R>(percent, [0.0; 3], 1))),
        ("edges of a knot of 6400 triangles", Some(knot::<R>(percent.div_ceil(4), [0.0; 3], 2))),
        ("edges of a knot moved by 1e3", floating::<R>(|| knot::<R>(percent, [1e3, -1e3, 1e3], 1))),
    ]
}

/// Vertices, and triangles between them.
struct Mesh {
    vertices: Vec<V>,
    triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// As wound around a tube closed upon itself: a row of vertices for each of `along` places.
    fn closed(along: usize, around: usize, at: impl Fn(usize, usize) -> V) -> Self {
        let index = |i: usize, j: usize| (i % along) * around + j % around;
        let mut mesh = Self { vertices: Vec::new(), triangles: Vec::new() };
        for i in 0..along {
            mesh.vertices.extend((0..around).map(|j| at(i, j)));
            for j in 0..around {
                let (a, b) = (index(i, j), index(i + 1, j));
                let (c, d) = (index(i + 1, j + 1), index(i, j + 1));
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    /// A bumpy ball: rows between two poles.
    fn ball(random: &mut Random, rows: usize, around: usize) -> Self {
        let mut vertices = vec![[0.0, 0.0, 2.0], [0.0, 0.0, -2.0]];
        let mut triangles = Vec::new();
        let index = |i: usize, j: usize| 2 + i * around + j % around;
        for i in 0..rows {
            let (s, c) = (std::f64::consts::PI * (i + 1) as f64 / (rows + 1) as f64).sin_cos();
            for j in 0..around {
                let (y, x) = (std::f64::consts::TAU * j as f64 / around as f64).sin_cos();
                let r = random.within(1.7, 2.2);
                vertices.push([r * s * x, r * s * y, r * c]);
                if i + 1 < rows {
                    let (a, b) = (index(i, j), index(i + 1, j));
                    let (c, d) = (index(i + 1, j + 1), index(i, j + 1));
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        for j in 0..around {
            triangles.push([0, index(0, j), index(0, j + 1)]);
            triangles.push([1, index(rows - 1, j + 1), index(rows - 1, j)]);
        }
        Self { vertices, triangles }
    }

    /// A torus knot (2, 3), as that of the race.
    fn knot(along: usize, around: usize) -> Self {
        let curve = |a: f64| {
            let r = 2.0 + (3.0 * a).cos();
            [r * (2.0 * a).cos(), r * (2.0 * a).sin(), -(3.0 * a).sin()]
        };
        let turn = |i: usize, n: usize| i as f64 / n as f64 * std::f64::consts::TAU;
        let unit = |a: V| times(a, 1.0 / length(a));
        Self::closed(along, around, |i, j| {
            let a = turn(i, along);
            let tangent = unit(sub(curve(a + 1e-3), curve(a - 1e-3)));
            let n = unit(cross(tangent, [0.0, 0.0, 1.0]));
            let (s, c) = turn(j, around).sin_cos();
            let out = add(times(n, c), times(cross(tangent, n), s));
            add(curve(a), times(out, 0.4))
        })
    }

    fn moved(mut self, by: V) -> Self {
        self.vertices.iter_mut().for_each(|p| *p = add(*p, by));
        self
    }

    fn tables<R: Tested>(&self) -> Vec<Triangle<R>> {
        let corner = |i: usize| v::<R>(self.vertices[i]);
        self.triangles.iter().map(|t| Triangle { corners: t.map(corner) }).collect()
    }
}

/// From around the middle at every vertex and at points of every edge.
fn ball<R: Tested>(percent: usize, middle: V) -> Tally {
    let mut random = Random::new(31);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    for _ in 0..percent.div_ceil(25) {
        let mesh = Mesh::ball(&mut random, 24, 32).moved(middle);
        let table = mesh.tables::<R>();
        let scene = Scene::new(Triangles { triangles: &table, normals: &[] }).unwrap();
        let mut targets = mesh.vertices.clone();
        for [a, b, c] in &mesh.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let s = random.within(0.0, 1.0);
                targets.push(add(times(mesh.vertices[*p], 1.0 - s), times(mesh.vertices[*q], s)));
            }
        }
        let shots: Vec<(Ray<R>, Interval<R>)> = targets
            .into_iter()
            .enumerate()
            .filter_map(|(i, at)| {
                // From the very middle through vertices as they are stored, and from around it.
                let off = if i % 3 == 0 { 0.0 } else { 0.3 };
                let from = add(middle, times(random.vector(), off));
                let at = wide::<R>(v::<R>(at));
                Some((ray::<R>(from, sub(at, from))?, Interval::RAY))
            })
            .collect();
        for (ray, interval) in &shots {
            let hit = super::tools::nearest(&scene, ray, *interval);
            tally.expect(hit.is_some(), || format!("leak: {ray:?}"));
        }
        conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    }
    tally
}

/// Möller and Trumbore, in doubles: only for rays that are clear of all edges.
fn first_hit(table: &[[V; 3]], o: V, d: V) -> f64 {
    use super::tools::dot;
    let mut best = f64::INFINITY;
    for [a, b, c] in table {
        let (e1, e2) = (sub(*b, *a), sub(*c, *a));
        let p = cross(d, e2);
        let inverse = 1.0 / dot(e1, p);
        let s = sub(o, *a);
        let u = dot(s, p) * inverse;
        let q = cross(s, e1);
        let w = dot(d, q) * inverse;
        let t = dot(e2, q) * inverse;
        if u >= 0.0 && w >= 0.0 && u + w <= 1.0 && t > 0.0 && t < best {
            best = t;
        }
    }
    best
}

/// From anywhere at points of edges, a quarter of them vertices: where eight rays close around are
/// all stopped at the same depth, so has the one in the middle to be.
fn knot<R: Tested>(percent: usize, middle: V, fine: usize) -> Tally {
    let mut random = Random::new(32);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    // Those of the race.
    let (along, around) = if fine > 1 { (160, 20) } else { (64, 8) };
    let mesh = Mesh::knot(along, around).moved(middle);
    let table = mesh.tables::<R>();
    let stored: Vec<[V; 3]> = table.iter().map(|t| t.corners.map(wide::<R>)).collect();
    let scene = Scene::new(Triangles { triangles: &table, normals: &[] }).unwrap();
    let mut shots = Vec::new();
    for i in 0..percent * 50 {
        let [a, b, _] = stored[random.below(stored.len())];
        let s = if i % 4 == 0 { 0.0 } else { random.within(0.0, 1.0) };
        let at = add(times(a, 1.0 - s), times(b, s));
        let from = add(middle, times(random.vector(), 4.0));
        let Some(ray) = ray::<R>(from, sub(at, from)) else { continue };
        shots.push((ray, Interval::RAY));
        // Wide of the rounding of everything, and narrow beside the triangles.
        let aside = 64.0 * rounding::<R>(length(middle) + 8.0);
        let (o, d) = (from, sub(at, from));
        let across = random.across(d);
        let other = times(cross(d, across), 1.0 / length(d));
        let around = (0..8).map(|k| {
            let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            let beside = add(times(across, c * aside), times(other, s * aside));
            first_hit(&stored, add(o, beside), d)
        });
        let (near, far) =
            around.fold((f64::INFINITY, 0.0_f64), |(lo, hi), t| (lo.min(t), hi.max(t)));
        let stopped = far < f64::INFINITY && (far - near) * length(d) < 50.0 * aside;
        if !stopped {
            tally.rays += 1;
            tally.ambiguous += 1;
            continue;
        }
        let hit = super::tools::nearest(&scene, &ray, Interval::RAY);
        let unit = length(wide::<R>(ray.direction())) / length(d);
        let t = hit.map_or(f64::INFINITY, |hit| hit.t.to_f64() * unit);
        let room = 100.0 * aside / length(d);
        tally.expect(t >= near - room && t <= far + room, || {
            format!("leak: {ray:?} {t:?} for {near} to {far}")
        });
    }
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}
