//! The scenes: closed meshes, made here.

use anyhow::{Context, Result};
use std::path::Path;

/// A point or a direction.
pub type V = [f32; 3];
type D = [f64; 3];

/// Triangles with shared corners.
pub struct Mesh {
    pub name: &'static str,
    pub vertices: Vec<V>,
    pub indices: Vec<[u32; 3]>,
}

/// Name, segments along the knot, segments around its tube.
pub const KNOTS: [(&str, usize, usize); 3] =
    [("knot-1k", 64, 8), ("knot-6k", 160, 20), ("knot-100k", 500, 100)];

impl Mesh {
    /// A torus knot (2, 3), its tube 0.4 thick.
    pub fn knot((name, along, around): (&'static str, usize, usize)) -> Self {
        let curve = |a: f64| {
            let r = 2.0 + (3.0 * a).cos();
            [r * (2.0 * a).cos(), r * (2.0 * a).sin(), -(3.0 * a).sin()]
        };
        let turn = |i: usize, n: usize| i as f64 / n as f64 * std::f64::consts::TAU;
        let mut mesh = Self { name, vertices: vec![], indices: vec![] };
        for i in 0..along {
            let a = turn(i, along);
            let (p, tangent) = (curve(a), unit(sub(curve(a + 1e-3), curve(a - 1e-3))));
            let n = unit(cross(tangent, [0.0, 0.0, 1.0]));
            let b = cross(tangent, n);
            for j in 0..around {
                let (s, c) = turn(j, around).sin_cos();
                mesh.vertices.push([0, 1, 2].map(|k| (p[k] + 0.4 * (c * n[k] + s * b[k])) as f32));
            }
        }
        for i in 0..along {
            for j in 0..around {
                let at = |i: usize, j: usize| ((i % along) * around + j % around) as u32;
                let (a, b) = (at(i, j), at(i + 1, j));
                let (c, d) = (at(i + 1, j + 1), at(i, j + 1));
                mesh.indices.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    /// M. Dabrovic's model of Sponza's palace, a Wavefront file: 66,450 triangles once faces of four
    /// corners are cut as fans. Faces without a surface stay out, for everyone.
    pub fn sponza(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
        let mut mesh = Self { name: "sponza", vertices: vec![], indices: vec![] };
        for line in text.lines() {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => {
                    let numbers: Vec<f32> = words.map(str::parse).collect::<Result<_, _>>()?;
                    mesh.vertices.push(numbers.try_into().ok().context("three coordinates")?);
                }
                Some("f") => {
                    let index = |word: &str| word.split('/').next().unwrap_or(word).parse::<u32>();
                    let corners: Vec<u32> = words.map(index).collect::<Result<_, _>>()?;
                    let fan = corners.windows(2).skip(1);
                    mesh.indices.extend(fan.map(|pair| [corners[0] - 1, pair[0] - 1, pair[1] - 1]));
                }
                _ => {}
            }
        }
        let has_surface = |i: &usize| {
            let [a, b, c] = mesh.triangle(*i).map(wide);
            let n = cross(sub(b, a), sub(c, a));
            dot(n, n) > 0.0
        };
        mesh.indices = (0..mesh.len()).filter(has_surface).map(|i| mesh.indices[i]).collect();
        Ok(mesh)
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Corners of a triangle.
    pub fn triangle(&self, i: usize) -> [V; 3] {
        self.indices[i].map(|k| self.vertices[k as usize])
    }

    /// Least and greatest coordinates.
    pub fn bounds(&self) -> [V; 2] {
        let mut bounds = [[f32::MAX; 3], [f32::MIN; 3]];
        for v in &self.vertices {
            for (k, x) in v.iter().enumerate() {
                bounds[0][k] = bounds[0][k].min(*x);
                bounds[1][k] = bounds[1][k].max(*x);
            }
        }
        bounds
    }

    /// Length of the diagonal of the bounds.
    pub fn diagonal(&self) -> f64 {
        let [lo, hi] = self.bounds().map(wide);
        let d = sub(hi, lo);
        dot(d, d).sqrt()
    }
}

pub fn wide(a: V) -> D {
    a.map(f64::from)
}
pub fn sub(a: D, b: D) -> D {
    [0, 1, 2].map(|k| a[k] - b[k])
}
pub fn cross(a: D, b: D) -> D {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
pub fn dot(a: D, b: D) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub fn unit(a: D) -> D {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}
