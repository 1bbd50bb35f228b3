//! Every triangle against every sampled ray in f64: what the right answers are.

use crate::mesh::{Mesh, V, cross, dot, sub, unit, wide};
use crate::rays::{Query, Ray};

type D = [f64; 3];

/// `t` of the hit of a triangle grown by `grow` (in barycentric coordinates, and relative to
/// the ends of the ray); a negative `grow` shrinks it.
#[inline(always)]
fn hit(r: &Ray, tri: [V; 3], grow: f64) -> Option<f64> {
    hit_wide(r, wide(r.d), tri, grow)
}

/// The same for another direction.
#[inline(always)]
fn hit_wide(r: &Ray, d: D, tri: [V; 3], grow: f64) -> Option<f64> {
    let (o, t) = (wide(r.o), tri.map(wide));
    let (e1, e2) = (sub(t[1], t[0]), sub(t[2], t[0]));
    let p = cross(d, e2);
    let det = dot(e1, p);
    if det == 0.0 {
        return None;
    }
    let inv = 1.0 / det;
    let s = sub(o, t[0]);
    let u = dot(s, p) * inv;
    if !(u >= -grow && u <= 1.0 + grow) {
        return None;
    }
    let q = cross(s, e1);
    let v = dot(d, q) * inv;
    if !(v >= -grow && u + v <= 1.0 + grow) {
        return None;
    }
    let t = dot(e2, q) * inv;
    (t > f64::from(r.tmin) * (1.0 - grow) && t < f64::from(r.tmax) * (1.0 + grow)).then_some(t)
}

pub struct Oracle {
    /// Index of the ray, its first hit (infinite: none).
    pub answers: Vec<(usize, f64)>,
    diagonal: f64,
    tris: Vec<[V; 3]>,
}

/// How many of the sampled answers are what.
#[derive(Default)]
pub struct Verdict {
    pub wrong: usize,
    /// Those of `wrong` that f64 arithmetic gives too once triangles are 1e-5 larger or smaller:
    /// rays through an edge, a corner or an end of the ray.
    pub at_edges: usize,
    /// Those of `wrong` that went through a surface: eight rays close around it are all stopped there.
    pub leaks: usize,
    pub wrong_ids: usize,
    pub max_rel_t: f64,
}

const EDGE: f64 = 1e-5;
/// How far the eight rays around a leak are from it, relative to the distance.
const AROUND: f64 = 1e-5;
const TOLERANCE: f64 = 1e-3;

impl Oracle {
    /// Evenly spread over the rays, as many as so many triangle tests allow, 200 to 5000.
    pub fn new(mesh: &Mesh, rays: &[Ray], tests: f64) -> Oracle {
        let n = ((tests / mesh.len() as f64) as usize).clamp(200, 5000).min(rays.len());
        let tris: Vec<[V; 3]> = (0..mesh.len()).map(|i| mesh.triangle(i)).collect();
        let mut answers = vec![];
        for k in 0..n {
            let i = (k as u128 * rays.len() as u128 / n as u128) as usize;
            let mut best = f64::INFINITY;
            for t in &tris {
                if let Some(t) = hit(&rays[i], *t, 0.0) {
                    best = best.min(t);
                }
            }
            answers.push((i, best));
        }
        Oracle { answers, diagonal: mesh.diagonal(), tris }
    }

    /// Error of `t`, relative to the distance or, very near the origin, to a thousandth of the scene.
    fn error(&self, r: &Ray, t: f64, right: f64) -> f64 {
        let len = dot(wide(r.d), wide(r.d)).sqrt();
        (t - right).abs() * len / (right.abs() * len).max(1e-3 * self.diagonal)
    }

    /// Is a surface at `right` on all sides of the ray?
    fn inside(&self, r: &Ray, right: f64) -> bool {
        let d = wide(r.d);
        let axis = if d[0].abs() < d[1].abs() { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let len = dot(d, d).sqrt() * AROUND;
        let u = unit(cross(d, axis)).map(|x| x * len);
        let v = unit(cross(d, u)).map(|x| x * len);
        (0..8).all(|k| {
            let (s, c) = (k as f64 * std::f64::consts::FRAC_PI_4 + 0.1).sin_cos();
            let d = [0, 1, 2].map(|i| d[i] + c * u[i] + s * v[i]);
            let near = |t: &[V; 3]| {
                hit_wide(r, d, *t, 0.0).is_some_and(|x| self.error(r, x, right) <= 10.0 * TOLERANCE)
            };
            self.tris.iter().any(near)
        })
    }

    /// Would a slightly larger or smaller triangle excuse this answer?
    fn at_edge(&self, r: &Ray, t: f64) -> bool {
        let mut seen = t == f64::INFINITY;
        for &tri in &self.tris {
            if let Some(x) = hit(r, tri, EDGE) {
                seen |= self.error(r, t, x) <= TOLERANCE;
            }
            if let Some(x) = hit(r, tri, -EDGE)
                && x < t
                && (t == f64::INFINITY || self.error(r, t, x) > TOLERANCE)
            {
                return false;
            }
        }
        seen
    }

    /// Judges the answers to a query.
    pub fn judge(&self, query: Query, rays: &[Ray], got: &[(f32, u32)]) -> Verdict {
        let mut v = Verdict::default();
        for &(i, right) in &self.answers {
            let (r, t, id) = (&rays[i], f64::from(got[i].0), got[i].1);
            let same = match (t.is_finite(), right.is_finite()) {
                (false, false) => t == f64::INFINITY,
                (true, true) => query == Query::Any || self.error(r, t, right) <= TOLERANCE,
                _ => false,
            };
            if !same {
                v.wrong += 1;
                v.at_edges += usize::from(self.at_edge(r, t));
                v.leaks += usize::from(t > right && self.inside(r, right));
            } else if right.is_finite() && query == Query::Nearest {
                v.max_rel_t = v.max_rel_t.max(self.error(r, t, right));
                let near = |tri: &[V; 3]| {
                    hit(r, *tri, EDGE).is_some_and(|x| self.error(r, t, x) <= TOLERANCE)
                };
                v.wrong_ids += usize::from(!self.tris.get(id as usize).is_some_and(near));
            }
        }
        v
    }
}
