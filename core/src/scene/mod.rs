//! What is rendered: borrowed tables of shapes, surfaces and lights. A scene may lie in flash; its
//! geometry is never copied.

mod camera;
mod either;
mod framing;
mod material;
mod shapes;
mod solids;

pub(crate) use camera::Line;
pub use camera::{Camera, View, ViewError};
pub use either::Either;
pub(crate) use framing::Framing;
pub use material::{Light, Material, Paint, Pattern};
pub use shapes::Shapes;
pub use solids::{Solids, Triangles};

use crate::accel::Hit;
use crate::geom::{Aabb, NotARay, Ray};
use crate::num::{Real, Vec3, Vector};
use crate::shape::ShapeError;

/// Why a scene is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// A shape is unusable.
    Shape {
        /// Its id in the scene.
        id: usize,
        /// What is wrong with it.
        why: ShapeError,
    },
    /// Shapes without bounds come before shapes with bounds.
    UnboundedFirst,
    /// A surface's number is not finite, or negative where that has no meaning.
    Material {
        /// Its place in the table of materials.
        index: usize,
    },
    /// A light's number is not finite, or too great to compute with.
    Light {
        /// Its place in the table of lights.
        index: usize,
    },
    /// Paint names a material that is not there, or its shapes are not in ascending order.
    Paint {
        /// Its place in the table of paint.
        index: usize,
    },
}

impl core::fmt::Display for SceneError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Shape { id, why } => write!(f, "shape {id}: {why}"),
            Self::UnboundedFirst => f.write_str("shapes without bounds must come last"),
            Self::Material { index } => write!(f, "material {index}: a number is out of range"),
            Self::Light { index } => {
                write!(f, "light {index}: a number is not finite or too great")
            }
            Self::Paint { index } => {
                write!(f, "paint {index}: no such material, or its shapes are out of order")
            }
        }
    }
}

impl core::error::Error for SceneError {}

/// Shapes that have been checked, with what rays meet on them.
///
/// The order of the shapes decides ties. Only the shapes are needed for ray queries; without
/// materials everything is a matt white, without lights everything is black.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, R: Real, S> {
    shapes: S,
    bounds: Aabb<R>,
    scale: R,
    materials: &'a [Material<R>],
    paint: &'a [Paint],
    lights: &'a [Light<R>],
    background: Vec3<R>,
}

impl<'a, R: Real, S: Shapes<R>> Scene<'a, R, S> {
    /// Checks the shapes and measures the room they take. Time in proportion to their number.
    ///
    /// # Errors
    /// [`SceneError::Shape`] with the first shape that is degenerate or not finite;
    /// [`SceneError::UnboundedFirst`].
    pub fn new(shapes: S) -> Result<Self, SceneError> {
        let mut bounds = Aabb::empty();
        for id in 0..shapes.count() {
            shapes.check(id).map_err(|why| SceneError::Shape { id, why })?;
            if id < shapes.bounded() {
                bounds = bounds.union(shapes.bounds(id));
            }
        }
        if !shapes.unbounded_last() {
            return Err(SceneError::UnboundedFirst);
        }
        if shapes.bounded() == 0 {
            bounds = Aabb { lo: Vec3::<R>::default(), hi: Vec3::<R>::default() };
        }
        let scale = bounds.max_abs();
        Ok(Self {
            shapes,
            bounds,
            scale,
            materials: &[],
            paint: &[],
            lights: &[],
            background: Vec3::<R>::default(),
        })
    }

    /// Gives the shapes surfaces: every run of shapes its material.
    ///
    /// # Errors
    /// [`SceneError::Material`], [`SceneError::Paint`].
    pub fn painted(
        self,
        materials: &'a [Material<R>],
        paint: &'a [Paint],
    ) -> Result<Self, SceneError> {
        if let Some(index) = materials.iter().position(|m| !m.is_usable()) {
            return Err(SceneError::Material { index });
        }
        let mut next = 0;
        for (index, run) in paint.iter().enumerate() {
            if run.first < next || usize::from(run.material) >= materials.len() {
                return Err(SceneError::Paint { index });
            }
            next = run.first.saturating_add(1);
        }
        Ok(Self { materials, paint, ..self })
    }

    /// Puts up lights, and a colour where nothing is hit.
    ///
    /// # Errors
    /// [`SceneError::Light`]. A background that is not a number is drawn black.
    pub fn lit(self, lights: &'a [Light<R>], background: Vec3<R>) -> Result<Self, SceneError> {
        let usable = |l: &Light<R>| R::is_usable_far(l.position) && l.color.is_finite();
        if let Some(index) = lights.iter().position(|l| !usable(l)) {
            return Err(SceneError::Light { index });
        }
        Ok(Self { lights, background, ..self })
    }

    /// The shapes; an id is a place in this set.
    pub fn shapes(&self) -> &S {
        &self.shapes
    }

    /// The smallest box around all bounded shapes; a point at the origin when there are none.
    pub fn bounds(&self) -> Aabb<R> {
        self.bounds
    }

    /// How far structures move the faces of every shape's box outwards: 64 units in the last place
    /// of the scene's greatest coordinate. Half of it allows for what a shape may claim outside its
    /// box, the other half for the rounding of cell walls.
    pub fn pad(&self) -> R {
        self.slack() + self.slack()
    }

    /// How far outside its box a shape may be hit.
    pub fn slack(&self) -> R {
        R::ulps_at(R::SLACK, self.scale)
    }

    /// Rays that start farther away than this are moved nearer first.
    pub(crate) fn far(&self) -> R {
        R::far(self.scale)
    }

    /// The point lights.
    pub fn lights(&self) -> &'a [Light<R>] {
        self.lights
    }

    /// The colour where nothing is hit.
    pub fn background(&self) -> Vec3<R> {
        self.background
    }

    /// The surface of a shape. Searches the runs of paint by bisection.
    pub fn material(&self, id: usize) -> &Material<R> {
        // Runs of one shape each are common.
        let guess = self.paint.get(id).filter(|run| run.first == id);
        let run = guess.or_else(|| {
            let after = self.paint.partition_point(|run| run.first <= id);
            self.paint.get(after.checked_sub(1)?)
        });
        let material = run.map_or(0, |run| usize::from(run.material));
        self.materials.get(material).unwrap_or(R::UNPAINTED)
    }

    /// Whether any of the surfaces mirrors or transmits. Time in proportion to their number.
    pub fn mirrors(&self) -> bool {
        self.materials.iter().any(Material::mirrors)
    }

    /// The surface where a ray hit a shape; `None` where a normal cannot be told. The hit is one of
    /// that ray in this scene.
    pub fn surface(&self, ray: &Ray<R>, hit: &Hit<R>) -> Option<Surface<R>> {
        // As it was when it hit.
        let traced;
        let ray = if !hit.as_asked {
            traced = Framing::traced(self, ray);
            &traced
        } else if ray.slack() != self.slack() {
            traced = ray.with_slack(self.slack());
            &traced
        } else {
            ray
        };
        let (t, id) = (hit.local, hit.id);
        let d = ray.direction();
        // First, as a normal that is made of it then is, too.
        let point = ray.at(t);
        let outside = self.shapes.normal(id, ray, t).unit()?;
        let front = outside.dot(d) <= R::Wide::default();
        let normal = if front { outside } else { -outside };
        let interpolated = self.shapes.shading_normal(id, ray, t).and_then(Vec3::<R>::unit);
        let smooth = interpolated.is_some();
        let shading = match interpolated {
            // A vertex normal may face away near a silhouette; light would come through.
            Some(n) if n.dot(normal) < R::Wide::default() => -n,
            Some(n) => n,
            None => normal,
        };
        let reach = point.max_abs();
        let computed_from = ray.reach().max(reach).max(self.shapes.reach(id));
        let error = R::ulps_at(R::POINT_ERROR, computed_from);
        let flat = S::FLAT && self.shapes.is_flat(id);
        let left = u32::try_from(id).ok().filter(|_| flat).unwrap_or(Ray::<R>::FREE);
        let reach = reach + error;
        Some(Surface { point, normal, shading, front, error, reach, left, smooth })
    }
}

/// Where and how a ray meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<R: Real> {
    /// The point.
    pub point: Vec3<R>,
    /// The geometric normal, of length 1, facing the ray's origin.
    pub normal: Vec3<R>,
    /// The normal for shading, of length 1, on the same side.
    pub shading: Vec3<R>,
    /// Whether the ray comes from outside (for flat shapes: from the front).
    pub front: bool,
    /// How far `point` may be from the surface: a new ray that starts so far off it, along the
    /// normal, does not meet it again for rounding's sake. Of a flat shape so thin that its normal is
    /// mostly rounding no distance can promise that; a ray made by [`Surface::leave`] never meets the
    /// flat shape that it starts from.
    pub error: R,
    /// At least the greatest coordinate of where rays start from here.
    pub(crate) reach: R,
    /// The flat shape that this is the surface of.
    pub(crate) left: u32,
    /// Whether `shading` is another one than `normal`.
    pub(crate) smooth: bool,
}

impl<R: Real> Surface<R> {
    /// A ray that goes on from here in the same scene: it starts [`Surface::error`] off the surface, on
    /// the side that the direction points to.
    ///
    /// # Errors
    /// [`NotARay`] when a component of the direction is infinite or not a number, or all are zero.
    pub fn leave(&self, direction: Vec3<R>) -> Result<Ray<R>, NotARay> {
        let near = direction.dot(self.normal) >= R::Wide::default();
        let off = if near { self.error } else { -self.error };
        Ok(Ray::new(R::at(self.point, self.normal, off), direction)?.leaving(self.left))
    }
}
