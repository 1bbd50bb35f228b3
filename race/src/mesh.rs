//! The scenes: closed meshes, made here.

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
