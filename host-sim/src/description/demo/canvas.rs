//! What built-in scenes are put together from.

use crate::description::{Description, Item, Light, Material, Solid, Triple, View};

/// A scene in the making: shapes take the surface that was chosen last.
pub(super) struct Canvas {
    pub(super) scene: Description,
    material: usize,
}

impl Canvas {
    pub(super) fn new(background: Triple, view: View) -> Self {
        let scene = Description { background, view: Some(view), ..Description::default() };
        Self { scene, material: 0 }
    }

    pub(super) fn light(&mut self, position: Triple, color: Triple) {
        self.scene.lights.push(Light { position, color: Some(color) });
    }

    /// A surface without shine.
    pub(super) fn matt(&mut self, color: Triple) {
        self.surface(color, 0.95, 0.0, 1.0);
    }

    /// A surface that mirrors a part of the light.
    pub(super) fn surface(&mut self, color: Triple, diffuse: f64, specular: f64, shine: f64) {
        let (transmission, index) = (0.0, 1.0);
        self.material(Material { color, diffuse, specular, shine, transmission, index });
    }

    pub(super) fn material(&mut self, material: Material) {
        let known = self.scene.materials.iter().position(|other| *other == material);
        self.material = known.unwrap_or(self.scene.materials.len());
        if known.is_none() {
            self.scene.materials.push(material);
        }
    }

    pub(super) fn add(&mut self, solid: Solid) {
        self.scene.items.push(Item { material: self.material, solid });
    }

    pub(super) fn sphere(&mut self, center: Triple, radius: f64) {
        self.add(Solid::Sphere { center, radius });
    }

    pub(super) fn block(&mut self, lo: Triple, hi: Triple) {
        self.add(Solid::Box { lo, hi });
    }

    /// A cylinder or a cone frustum between two discs.
    pub(super) fn cone(&mut self, base: (Triple, f64), apex: (Triple, f64)) {
        self.add(Solid::Cone {
            base: base.0,
            base_radius: base.1,
            apex: apex.0,
            apex_radius: apex.1,
            capped: true,
        });
    }

    pub(super) fn polygon(&mut self, vertices: Vec<Triple>) {
        self.add(Solid::Polygon { vertices, normals: Vec::new() });
    }

    /// A ring around the vertical through `center`, of triangles with normals.
    pub(super) fn torus(&mut self, center: Triple, radii: (f64, f64), parts: (u32, u32)) {
        let corner = |i: u32, j: u32| {
            let (s, c) = turn(i, parts.0);
            let (up, out) = turn(j, parts.1);
            let normal = [c * out, s * out, up];
            let far = radii.0 + radii.1 * out;
            let place = [center[0] + c * far, center[1] + s * far, center[2] + radii.1 * up];
            (place, normal)
        };
        for i in 0..parts.0 {
            for j in 0..parts.1 {
                let quad = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    self.add(Solid::Polygon {
                        vertices: [a, b, c].map(|k: usize| quad[k].0).to_vec(),
                        normals: [a, b, c].map(|k: usize| quad[k].1).to_vec(),
                    });
                }
            }
        }
    }

    /// A tetrahedron, each of whose corners is one of half the size, and so on.
    pub(super) fn sponge(&mut self, corners: [Triple; 4], depth: u32) {
        if depth == 0 {
            let [a, b, c, d] = corners;
            for face in [[a, c, b], [a, b, d], [b, c, d], [c, a, d]] {
                self.polygon(face.to_vec());
            }
            return;
        }
        for corner in corners {
            let half = |other: Triple| std::array::from_fn(|i| (corner[i] + other[i]) / 2.0);
            self.sponge(corners.map(half), depth - 1);
        }
    }
}

/// Sine and cosine of a part of a full turn.
pub(super) fn turn(part: u32, of: u32) -> (f64, f64) {
    (std::f64::consts::TAU * f64::from(part % of) / f64::from(of)).sin_cos()
}

/// A colour by its hue, 0 to 1, of the same lightness around the circle; softened.
pub(super) fn hue(hue: f64) -> Triple {
    std::array::from_fn(|channel| {
        let phase = std::f64::consts::TAU * (hue - channel as f64 / 3.0);
        0.52 + 0.38 * phase.cos()
    })
}
