//! From a description to the tables that the core traces: one number type, one table a kind.

use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{
    Either, Light, Material, Paint, Pattern, Scene, SceneError, Shapes, Solids, Triangles, View,
};
use kibiray::shape::{
    AxisBox, Cone, Cylinder, Plane, Polygon, Polyhedron, Shape, ShapeError, Sphere, Triangle,
};

use crate::description::{self, Description, Solid, Triple};
use crate::parts::{Combined, PartError, PartTables};

/// Why a description does not become tables. Displays as one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableError {
    /// A primitive cannot be computed with.
    Primitive {
        /// Its id: its place in the file.
        id: usize,
        /// What is wrong with it.
        why: ShapeError,
    },
    /// Solids that cannot be put together.
    Combined {
        /// The id of the primitive, where it is known.
        id: Option<usize>,
        /// What is wrong with it.
        why: PartError,
    },
    /// More different surfaces than the core numbers.
    Surfaces(usize),
    /// What the core itself refuses.
    Scene(SceneError),
}

impl std::fmt::Display for TableError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Primitive { id, why } => write!(f, "primitive {id}: {why}"),
            Self::Combined { id: Some(id), why } => write!(f, "primitive {id}: {why}"),
            Self::Combined { id: None, why } => write!(f, "combined solids: {why}"),
            Self::Surfaces(count) => {
                write!(f, "{count} different surfaces, at most {} can be numbered", MOST_SURFACES)
            }
            Self::Scene(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for TableError {}

/// Surfaces are numbered with 16 bits.
const MOST_SURFACES: usize = 1 << 16;

/// Where a shape comes from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    id: u32,
    material: u16,
}

/// Shapes of one kind and where they come from.
#[derive(Debug)]
struct Table<T> {
    shapes: Vec<T>,
    origins: Vec<Origin>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self { shapes: Vec::new(), origins: Vec::new() }
    }
}

impl<T> Table<T> {
    fn push(&mut self, shape: T, origin: Origin) {
        self.shapes.push(shape);
        self.origins.push(origin);
    }
}

/// A scene in the number type that it is traced in: what would lie in a device's flash.
///
/// Shapes are sorted by kind, combined solids first and then in the order of [`Solids`], within a
/// kind in the order of the file; triangles with vertex normals come before those without.
#[derive(Debug)]
pub struct Tables<R: Real> {
    parts: PartTables<R>,
    combined: Vec<Origin>,
    spheres: Table<Sphere<R>>,
    smooth: Table<Triangle<R>>,
    normals: Vec<[Vec3<R>; 3]>,
    flat: Table<Triangle<R>>,
    triangles: Vec<Triangle<R>>,
    /// A polygon's corners lie in `vertices`, from where its predecessor's end up to here.
    ends: Table<usize>,
    vertices: Vec<Vec3<R>>,
    boxes: Table<AxisBox<R>>,
    cylinders: Table<Cylinder<R>>,
    cones: Table<Cone<R>>,
    planes: Table<Plane<R>>,
    materials: Vec<Material<R>>,
    paint: Vec<Paint>,
    lights: Vec<Light<R>>,
    background: Vec3<R>,
    view: View<R>,
    ids: Vec<u32>,
    skipped: usize,
}

/// The shapes that are traced: those of one kind, where there are no others; otherwise combined
/// solids, and one table a kind.
pub type HostShapes<'a, R> =
    Either<Mixed<'a, R>, Either<Triangles<'a, R>, Either<&'a [Sphere<R>], &'a [Polygon<'a, R>]>>>;

/// Several kinds of shapes.
type Mixed<'a, R> = (Combined<'a, R>, Solids<'a, R>);

/// What borrows from [`Tables`] and is borrowed by a scene.
#[derive(Debug)]
pub struct Borrowing<'a, R: Real> {
    polygons: Vec<Polygon<'a, R>>,
    polyhedra: Vec<Polyhedron<'a, R>>,
}

fn vector<R: Real>(v: Triple) -> Vec3<R> {
    Vec3::<R>::from_f64(v)
}

impl<R: Real> Tables<R> {
    /// Sorts and converts a description. Shapes without a surface (a radius or an area of zero, as
    /// real files have them) can never be hit and are left out; see [`Tables::skipped`].
    ///
    /// # Errors
    /// Numbers that are too great to compute with in this number type; too many surfaces.
    pub fn new(description: &Description) -> Result<Self, TableError> {
        if description.materials.len() > MOST_SURFACES {
            return Err(TableError::Surfaces(description.materials.len()));
        }
        let mut tables = Self::empty(description);
        for (id, item) in description.items.iter().enumerate() {
            let origin = Origin { id: id as u32, material: item.material as u16 };
            tables.add(&item.solid, origin)?;
        }
        tables.finish();
        let combined = |(object, why): (Option<usize>, _)| {
            let id = object.and_then(|object| tables.combined.get(object));
            TableError::Combined { id: id.map(|origin| origin.id as usize), why }
        };
        tables.parts.finish().map_err(combined)?;
        Ok(tables)
    }

    fn empty(description: &Description) -> Self {
        let share = 1.0 / (description.lights.len().max(1) as f64).sqrt();
        let light = |l: &description::Light| Light {
            position: R::far_point(l.position),
            color: vector::<R>(l.color.unwrap_or([share; 3])),
        };
        let view = crate::view::of(description);
        Self {
            parts: PartTables::default(),
            combined: Vec::new(),
            spheres: Table::default(),
            smooth: Table::default(),
            normals: Vec::new(),
            flat: Table::default(),
            triangles: Vec::new(),
            ends: Table::default(),
            vertices: Vec::new(),
            boxes: Table::default(),
            cylinders: Table::default(),
            cones: Table::default(),
            planes: Table::default(),
            materials: description.materials.iter().map(material).collect(),
            paint: Vec::new(),
            lights: crate::view::lights_of(description, &view).iter().map(light).collect(),
            background: vector::<R>(crate::view::background_of(description)),
            view: View {
                from: vector::<R>(view.from),
                at: vector::<R>(view.at),
                up: vector::<R>(view.up),
                angle: R::from_f64(view.angle.to_radians()),
            },
            ids: Vec::new(),
            skipped: 0,
        }
    }

    fn add(&mut self, solid: &Solid, origin: Origin) -> Result<(), TableError> {
        match solid {
            Solid::Sphere { center, radius } => {
                let sphere = Sphere::new(vector::<R>(*center), R::from_f64(*radius));
                if self.usable(&sphere, origin)? {
                    self.spheres.push(sphere, origin);
                }
            }
            Solid::Cone { base, base_radius, apex, apex_radius, capped } => {
                let (base, apex) = (vector::<R>(*base), vector::<R>(*apex));
                let radii = (R::from_f64(*base_radius), R::from_f64(*apex_radius));
                if radii.0 == radii.1 {
                    let cylinder = Cylinder::new(base, apex, radii.0);
                    let cylinder = if *capped { cylinder.capped() } else { cylinder };
                    if self.usable(&cylinder, origin)? {
                        self.cylinders.push(cylinder, origin);
                    }
                } else {
                    let cone = Cone::new(base, apex, radii.0, radii.1);
                    let cone = if *capped { cone.capped() } else { cone };
                    if self.usable(&cone, origin)? {
                        self.cones.push(cone, origin);
                    }
                }
            }
            Solid::Polygon { vertices, normals } | Solid::Fan { vertices, normals }
                if vertices.len() == 3 =>
            {
                self.fan(vertices, normals, origin)?;
            }
            Solid::Fan { vertices, normals } => self.fan(vertices, normals, origin)?,
            // Normals at the corners of larger polygons are ignored: the polygon is planar.
            Solid::Polygon { vertices, .. } => {
                let corners: Vec<_> = vertices.iter().map(|v| vector::<R>(*v)).collect();
                if self.usable(&Polygon::new(&corners), origin)? {
                    self.vertices.extend(corners);
                    self.ends.push(self.vertices.len(), origin);
                }
            }
            Solid::Box { lo, hi } => {
                let shape = AxisBox { lo: vector::<R>(*lo), hi: vector::<R>(*hi) };
                if self.usable(&shape, origin)? {
                    self.boxes.push(shape, origin);
                }
            }
            Solid::Plane { point, normal } => {
                let plane = Plane { point: vector::<R>(*point), normal: vector::<R>(*normal) };
                if self.usable(&plane, origin)? {
                    self.planes.push(plane, origin);
                }
            }
            Solid::Csg { steps } => {
                let refused = |why| {
                    let id = Some(origin.id as usize);
                    TableError::Combined { id, why: PartError::Shape(why) }
                };
                self.parts.add(steps).map_err(refused)?;
                self.combined.push(origin);
            }
        }
        Ok(())
    }

    /// The triangles around the first corner.
    fn fan(
        &mut self,
        vertices: &[Triple],
        normals: &[Triple],
        origin: Origin,
    ) -> Result<(), TableError> {
        for last in 2..vertices.len() {
            let of = |list: &[Triple]| [0, last - 1, last].map(|i| vector::<R>(list[i]));
            let [a, b, c] = of(vertices);
            let triangle = Triangle::new(a, b, c);
            if !self.usable(&triangle, origin)? {
                continue;
            }
            if normals.len() == vertices.len() {
                self.smooth.push(triangle, origin);
                self.normals.push(of(normals));
            } else {
                self.flat.push(triangle, origin);
            }
        }
        Ok(())
    }

    fn usable(&mut self, shape: &impl Shape<R>, origin: Origin) -> Result<bool, TableError> {
        match shape.check() {
            Ok(()) => Ok(true),
            Err(ShapeError::Degenerate | ShapeError::TooFewCorners) => {
                self.skipped += 1;
                Ok(false)
            }
            Err(why) => Err(TableError::Primitive { id: origin.id as usize, why }),
        }
    }

    /// Once all shapes are sorted: one table of triangles, runs of paint, the way back to the file.
    fn finish(&mut self) {
        self.triangles = std::mem::take(&mut self.smooth.shapes);
        self.triangles.append(&mut self.flat.shapes);
        let origins = [
            &self.combined,
            &self.spheres.origins,
            &self.smooth.origins,
            &self.flat.origins,
            &self.ends.origins,
            &self.boxes.origins,
            &self.cylinders.origins,
            &self.cones.origins,
            &self.planes.origins,
        ];
        let mut before = None;
        for (first, origin) in origins.into_iter().flatten().enumerate() {
            self.ids.push(origin.id);
            if before != Some(origin.material) {
                self.paint.push(Paint { first, material: origin.material });
                before = Some(origin.material);
            }
        }
    }

    /// The polygons and polyhedra, borrowing their corners and faces.
    pub fn polygons(&self) -> Borrowing<'_, R> {
        let mut first = 0;
        let polygon = |end: &usize| {
            let corners = &self.vertices[first..*end];
            first = *end;
            Polygon::new(corners)
        };
        Borrowing {
            polygons: self.ends.shapes.iter().map(polygon).collect(),
            polyhedra: self.parts.polyhedra(),
        }
    }

    /// The shapes that are not combined.
    pub fn solids<'a>(&'a self, borrowing: &'a Borrowing<'a, R>) -> Solids<'a, R> {
        Solids {
            spheres: &self.spheres.shapes,
            triangles: Triangles { triangles: &self.triangles, normals: &self.normals },
            polygons: &borrowing.polygons,
            boxes: &self.boxes.shapes,
            cylinders: &self.cylinders.shapes,
            cones: &self.cones.shapes,
            planes: &self.planes.shapes,
        }
    }

    /// The scene that the core traces.
    ///
    /// # Errors
    /// What the core refuses.
    pub fn scene<'a>(
        &'a self,
        borrowing: &'a Borrowing<'a, R>,
    ) -> Result<Scene<'a, R, HostShapes<'a, R>>, TableError> {
        self.scene_of(borrowing, true)
    }

    /// The same; unless `sorted`, shapes of one kind are traced like those of several.
    ///
    /// # Errors
    /// As [`Tables::scene`].
    pub fn scene_of<'a>(
        &'a self,
        borrowing: &'a Borrowing<'a, R>,
        sorted: bool,
    ) -> Result<Scene<'a, R, HostShapes<'a, R>>, TableError> {
        let refused = |error| TableError::Combined { id: None, why: PartError::Csg(error) };
        let combined = self.parts.combined(&borrowing.polyhedra).map_err(refused)?;
        let solids = self.solids(borrowing);
        let mixed = Either::One((combined, solids));
        let only = if sorted { only_kind(&combined, &solids) } else { None };
        Scene::new(only.unwrap_or(mixed))
            .and_then(|scene| scene.painted(&self.materials, &self.paint))
            .and_then(|scene| scene.lit(&self.lights, self.background))
            .map_err(|error| match error {
                SceneError::Shape { id, why } => {
                    TableError::Primitive { id: self.file_id(id), why }
                }
                error => TableError::Scene(error),
            })
    }

    /// The kinds of bounded shapes in the order of their ids, and how many there are.
    pub fn kinds(&self) -> [(&'static str, usize); 7] {
        [
            ("combined", self.combined.len()),
            ("sphere", self.spheres.shapes.len()),
            ("triangle", self.triangles.len()),
            ("polygon", self.ends.shapes.len()),
            ("box", self.boxes.shapes.len()),
            ("cylinder", self.cylinders.shapes.len()),
            ("cone", self.cones.shapes.len()),
        ]
    }

    /// The place in the file of a shape of the scene.
    pub fn file_id(&self, id: usize) -> usize {
        self.ids[id] as usize
    }

    /// How many shapes were left out because they have no surface.
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// How many lights there are.
    pub fn lights(&self) -> usize {
        self.lights.len()
    }

    /// The view, the file's or one that was chosen.
    pub fn view(&self) -> &View<R> {
        &self.view
    }

    /// Bytes of all tables, which would lie in a device's flash; as laid out on this host, where a
    /// pointer takes twice the bytes of a microcontroller's.
    pub fn bytes(&self) -> usize {
        self.parts.bytes()
            + size_of_val(&*self.spheres.shapes)
            + size_of_val(&*self.triangles)
            + size_of_val(&*self.normals)
            + self.ends.shapes.len() * size_of::<Polygon<'_, R>>()
            + size_of_val(&*self.vertices)
            + size_of_val(&*self.boxes.shapes)
            + size_of_val(&*self.cylinders.shapes)
            + size_of_val(&*self.cones.shapes)
            + size_of_val(&*self.planes.shapes)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.paint)
            + size_of_val(&*self.lights)
    }
}

/// The set of all shapes, where these are of one kind.
fn only_kind<'a, R: Real>(
    combined: &Combined<'a, R>,
    solids: &Solids<'a, R>,
) -> Option<HostShapes<'a, R>> {
    let all = combined.count() + solids.count();
    let Solids { spheres, triangles, polygons, .. } = *solids;
    if triangles.count() == all {
        Some(Either::Other(Either::One(triangles)))
    } else if spheres.len() == all {
        Some(Either::Other(Either::Other(Either::One(spheres))))
    } else if polygons.len() == all {
        Some(Either::Other(Either::Other(Either::Other(polygons))))
    } else {
        None
    }
}

fn material<R: Real>(m: &description::Material) -> Material<R> {
    Material {
        color: vector::<R>(m.color),
        diffuse: R::from_f64(m.diffuse),
        specular: R::from_f64(m.specular),
        shine: R::exponent(m.shine),
        transmission: R::from_f64(m.transmission),
        index: R::from_f64(m.index),
        pattern: Pattern::Plain,
    }
}
