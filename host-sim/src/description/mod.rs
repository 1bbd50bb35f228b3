//! Scenes as the files describe them: in `f64`, in file order, before any number type is chosen.

pub mod demo;
pub mod load;
pub mod nff;
mod nff_solids;
pub mod nff_write;
pub mod obj;
mod parse;
pub mod solids;
pub mod spd;

pub use parse::ParseError;

/// A point, a direction or a colour, as read.
pub type Triple = [f64; 3];

/// Everything a scene file says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// How the scene was asked for: `spd:tetra:6`, a path or a demo's name.
    pub name: String,
    /// Colour of rays that leave the scene.
    pub background: Triple,
    /// The camera, where the file has one.
    pub view: Option<View>,
    /// Point lights, in file order.
    pub lights: Vec<Light>,
    /// Surfaces, in file order; an [`Item`] names one by its place here.
    pub materials: Vec<Material>,
    /// The primitives: the place in this list is the primitive's id.
    pub items: Vec<Item>,
}

/// A pinhole camera, after NFF's `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye.
    pub from: Triple,
    /// The point in the middle of the picture.
    pub at: Triple,
    /// Which way is up; need not be square to the line of sight.
    pub up: Triple,
    /// Full vertical angle of view, in degrees.
    pub angle: f64,
    /// Distance of the near plane; kept for writing, not used for tracing.
    pub hither: f64,
    /// Width and height of the picture in pixels.
    pub resolution: [u32; 2],
}

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it stands.
    pub position: Triple,
    /// Its colour; without one all lights of a scene share the same white.
    pub color: Option<Triple>,
}

/// A surface, after NFF's `f`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Red, green, blue, each usually 0 to 1.
    pub color: Triple,
    /// Diffuse reflection, Kd.
    pub diffuse: f64,
    /// Specular reflection, Ks.
    pub specular: f64,
    /// Phong's cosine power of highlights.
    pub shine: f64,
    /// Transmittance, T.
    pub transmission: f64,
    /// Index of refraction.
    pub index: f64,
}

/// One primitive and its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Place of its surface in [`Description::materials`].
    pub material: usize,
    /// Its shape.
    pub solid: Solid,
}

/// A primitive's shape as the file gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// NFF `s`.
    Sphere {
        /// Centre.
        center: Triple,
        /// Radius.
        radius: f64,
    },
    /// NFF `c`: a cylinder where both radii are equal, else a cone frustum.
    Cone {
        /// Centre of the base.
        base: Triple,
        /// Radius at the base.
        base_radius: f64,
        /// Centre of the other end.
        apex: Triple,
        /// Radius at the other end.
        apex_radius: f64,
        /// Whether discs close the ends: NFF's `c` is open, `cone` of our extension is closed.
        capped: bool,
    },
    /// NFF `p` and `pp`: one planar polygon, concave allowed.
    Polygon {
        /// Three or more corners.
        vertices: Vec<Triple>,
        /// A normal at each corner (`pp`), or empty.
        normals: Vec<Triple>,
    },
    /// An OBJ face: the fan of triangles around its first corner.
    Fan {
        /// Three or more corners.
        vertices: Vec<Triple>,
        /// A normal at each corner, or empty.
        normals: Vec<Triple>,
    },
    /// An axis-aligned box; `box` of our extension of NFF.
    Box {
        /// Least corner.
        lo: Triple,
        /// Greatest corner.
        hi: Triple,
    },
    /// An infinite plane; `plane` of our extension of NFF.
    Plane {
        /// A point on it.
        point: Triple,
        /// Its normal, of any length.
        normal: Triple,
    },
    /// What is put together from closed solids, or one such solid; our extension of NFF.
    Csg {
        /// In postfix notation.
        steps: Vec<solids::Step>,
    },
}

impl Solid {
    /// Moves its points, and multiplies its lengths by `scale`.
    pub fn moved(&mut self, point: &impl Fn(Triple) -> Triple, scale: f64) {
        match self {
            Self::Sphere { center, radius } => {
                *center = point(*center);
                *radius *= scale;
            }
            Self::Cone { base, base_radius, apex, apex_radius, .. } => {
                (*base, *apex) = (point(*base), point(*apex));
                *base_radius *= scale;
                *apex_radius *= scale;
            }
            Self::Polygon { vertices, .. } | Self::Fan { vertices, .. } => {
                vertices.iter_mut().for_each(|v| *v = point(*v));
            }
            Self::Box { lo, hi } => (*lo, *hi) = (point(*lo), point(*hi)),
            Self::Plane { point: p, .. } => *p = point(*p),
            Self::Csg { steps } => {
                for step in steps {
                    if let solids::Step::Part(part) = step {
                        part.moved(point, scale);
                    }
                }
            }
        }
    }
}
