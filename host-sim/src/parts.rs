//! Combined solids on their way to the core: one table a kind of part, all trees in one.

use kibiray::memory::Arena;
use kibiray::num::{Real, Vec3, Vector};
use kibiray::shape::csg::{self, Csg, CsgError, Trees};
use kibiray::shape::{
    Affine, AxisBox, Cone, Cylinder, Plane, Polyhedron, ShapeError, Sphere, Transformed,
};

use crate::description::Triple;
use crate::description::solids::{Body, Map, Part, Step};

/// How often a ray may cross an object: twice for each of at most 256 parts.
pub const MOST_CROSSINGS: usize = 512;

/// Every kind of part, one table a kind.
pub type Parts<'a, R> = (Plain<'a, R>, Images<'a, R>);

/// Parts in their place.
pub type Plain<'a, R> = (
    &'a [Sphere<R>],
    (
        &'a [AxisBox<R>],
        (&'a [Cylinder<R>], (&'a [Cone<R>], (&'a [Polyhedron<'a, R>], &'a [Plane<R>]))),
    ),
);

/// Images of parts under maps.
pub type Images<'a, R> = (
    &'a [Transformed<R, Sphere<R>>],
    (
        &'a [Transformed<R, AxisBox<R>>],
        (&'a [Transformed<R, Cylinder<R>>], &'a [Transformed<R, Cone<R>>]),
    ),
);

/// All combined solids of a scene.
pub type Combined<'a, R> = Csg<'a, R, Parts<'a, R>, MOST_CROSSINGS>;

/// Why an object is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartError {
    /// A part of it is unusable.
    Shape(ShapeError),
    /// The core refuses it.
    Csg(CsgError),
}

impl std::fmt::Display for PartError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Shape(why) => write!(f, "a part: {why}"),
            Self::Csg(CsgError::Empty { .. }) => {
                f.write_str("nothing is left of it: what it intersects does not meet")
            }
            Self::Csg(CsgError::Unbounded { .. }) => {
                f.write_str("it has no end: a halfspace is not cut on all sides")
            }
            Self::Csg(CsgError::Crossings { needed, available, .. }) => {
                write!(f, "{} parts, at most {} can be combined", needed / 2, available / 2)
            }
            Self::Csg(error) => error.fmt(f),
        }
    }
}

/// Kinds of tables, in the order in which [`Parts`] numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Sphere,
    Box,
    Cylinder,
    Cone,
    Polyhedron,
    HalfSpace,
    SphereImage,
    BoxImage,
    CylinderImage,
    ConeImage,
}

/// A step whose part is not numbered yet: it is the so-and-so-many-th of its kind.
#[derive(Clone, Copy, Debug)]
enum Draft {
    Part(Kind, usize),
    Join(csg::Operator),
}

/// What would lie in a device's flash.
#[derive(Debug)]
pub(crate) struct PartTables<R: Real> {
    spheres: Vec<Sphere<R>>,
    boxes: Vec<AxisBox<R>>,
    cylinders: Vec<Cylinder<R>>,
    cones: Vec<Cone<R>>,
    /// A polyhedron's faces begin where its predecessor's end, and end here.
    ends: Vec<usize>,
    faces: Vec<Plane<R>>,
    spaces: Vec<Plane<R>>,
    sphere_images: Vec<Transformed<R, Sphere<R>>>,
    box_images: Vec<Transformed<R, AxisBox<R>>>,
    cylinder_images: Vec<Transformed<R, Cylinder<R>>>,
    cone_images: Vec<Transformed<R, Cone<R>>>,
    drafts: Vec<Draft>,
    /// Where objects end in `drafts`.
    objects: Vec<usize>,
    steps: Vec<csg::Step>,
    links: Vec<u16>,
    bounds: Vec<[Vec3<R>; 2]>,
    roots: Vec<u16>,
}

impl<R: Real> Default for PartTables<R> {
    fn default() -> Self {
        Self {
            spheres: Vec::new(),
            boxes: Vec::new(),
            cylinders: Vec::new(),
            cones: Vec::new(),
            ends: Vec::new(),
            faces: Vec::new(),
            spaces: Vec::new(),
            sphere_images: Vec::new(),
            box_images: Vec::new(),
            cylinder_images: Vec::new(),
            cone_images: Vec::new(),
            drafts: Vec::new(),
            objects: Vec::new(),
            steps: Vec::new(),
            links: Vec::new(),
            bounds: Vec::new(),
            roots: Vec::new(),
        }
    }
}

/// Puts a shape into its table; its place there.
fn push<T>(table: &mut Vec<T>, shape: T) -> usize {
    table.push(shape);
    table.len() - 1
}

impl<R: Real> PartTables<R> {
    /// Takes an object, to be numbered by [`PartTables::finish`].
    ///
    /// # Errors
    /// A map that flattens a part in this number type.
    pub(crate) fn add(&mut self, steps: &[Step]) -> Result<(), ShapeError> {
        for step in steps {
            let draft = match step {
                Step::Part(part) => self.part(part)?,
                Step::Join(operator) => Draft::Join(*operator),
            };
            self.drafts.push(draft);
        }
        self.objects.push(self.drafts.len());
        Ok(())
    }

    fn part(&mut self, Part { body, map }: &Part) -> Result<Draft, ShapeError> {
        let v = |p: &Triple| Vec3::<R>::from_f64(*p);
        let r = |x: &f64| R::from_f64(*x);
        let plane = |[point, normal]: &[Triple; 2]| Plane::new(v(point), unit::<R>(normal));
        let map = map.as_ref().map(affine::<R>);
        let (kind, place) = match body {
            Body::Sphere { center, radius } => {
                let sphere = Sphere::new(v(center), r(radius));
                match map {
                    None => (Kind::Sphere, push(&mut self.spheres, sphere)),
                    Some(map) => {
                        let image = Transformed::new(sphere, &map)?;
                        (Kind::SphereImage, push(&mut self.sphere_images, image))
                    }
                }
            }
            Body::Box { lo, hi } => {
                let solid = AxisBox::new(v(lo), v(hi));
                match map {
                    None => (Kind::Box, push(&mut self.boxes, solid)),
                    Some(map) => {
                        let image = Transformed::new(solid, &map)?;
                        (Kind::BoxImage, push(&mut self.box_images, image))
                    }
                }
            }
            Body::Cone { base, base_radius, apex, apex_radius } if base_radius == apex_radius => {
                let solid = Cylinder::new(v(base), v(apex), r(base_radius)).capped();
                match map {
                    None => (Kind::Cylinder, push(&mut self.cylinders, solid)),
                    Some(map) => {
                        let image = Transformed::new(solid, &map)?;
                        (Kind::CylinderImage, push(&mut self.cylinder_images, image))
                    }
                }
            }
            Body::Cone { base, base_radius, apex, apex_radius } => {
                let solid = Cone::new(v(base), v(apex), r(base_radius), r(apex_radius)).capped();
                match map {
                    None => (Kind::Cone, push(&mut self.cones, solid)),
                    Some(map) => {
                        let image = Transformed::new(solid, &map)?;
                        (Kind::ConeImage, push(&mut self.cone_images, image))
                    }
                }
            }
            Body::Polyhedron { faces } => {
                self.faces.extend(faces.iter().map(plane));
                (Kind::Polyhedron, push(&mut self.ends, self.faces.len()))
            }
            Body::HalfSpace { face } => (Kind::HalfSpace, push(&mut self.spaces, plane(face))),
        };
        Ok(Draft::Part(kind, place))
    }

    /// Numbers the parts and prepares the trees.
    ///
    /// # Errors
    /// The object, where it is known, and why it is refused.
    pub(crate) fn finish(&mut self) -> Result<(), (Option<usize>, PartError)> {
        let counts = [
            self.spheres.len(),
            self.boxes.len(),
            self.cylinders.len(),
            self.cones.len(),
            self.ends.len(),
            self.spaces.len(),
            self.sphere_images.len(),
            self.box_images.len(),
            self.cylinder_images.len(),
            self.cone_images.len(),
        ];
        let total: usize = counts.iter().sum();
        if total > csg::trees::MOST_STEPS {
            let error = CsgError::Steps { needed: total, available: csg::trees::MOST_STEPS };
            return Err((None, PartError::Csg(error)));
        }
        let number = |kind: Kind, place: usize| {
            (counts[..kind as usize].iter().sum::<usize>() + place) as u16
        };
        let step = |draft: &Draft| match *draft {
            Draft::Part(kind, place) => csg::Step::Part(number(kind, place)),
            Draft::Join(operator) => csg::Step::Join(operator),
        };
        let steps: Vec<csg::Step> = self.drafts.iter().map(step).collect();
        self.drafts = Vec::new();
        let mut words = vec![0_u64; Trees::<R>::footprint(&steps).peak.div_ceil(8)];
        let polyhedra = self.polyhedra();
        let parts = self.parts(&polyhedra);
        let made = Csg::<R, _, MOST_CROSSINGS>::build(
            parts,
            &steps,
            &mut Arena::new(bytemuck::cast_slice_mut(&mut words)),
        );
        let holder = |part| {
            let step = steps.iter().position(|step| *step == csg::Step::Part(part))?;
            Some(self.objects.partition_point(|end| *end <= step))
        };
        let refused = |error| match error {
            CsgError::Shape { part, why } => (holder(part), PartError::Shape(why)),
            CsgError::Empty { object }
            | CsgError::Unbounded { object }
            | CsgError::Crossings { object, .. } => (Some(object), PartError::Csg(error)),
            error => (None, PartError::Csg(error)),
        };
        let trees = *made.map_err(refused)?.trees();
        let (links, bounds, roots) = (trees.links(), trees.boxes(), trees.roots());
        (self.links, self.bounds, self.roots) = (links.into(), bounds.into(), roots.into());
        self.steps = steps;
        Ok(())
    }

    /// The polyhedra, borrowing their faces.
    pub(crate) fn polyhedra(&self) -> Vec<Polyhedron<'_, R>> {
        let mut first = 0;
        let polyhedron = |end: &usize| {
            let faces = &self.faces[first..*end];
            first = *end;
            Polyhedron::new(faces)
        };
        self.ends.iter().map(polyhedron).collect()
    }

    fn parts<'a>(&'a self, polyhedra: &'a [Polyhedron<'a, R>]) -> Parts<'a, R> {
        let plain = (
            &self.spheres[..],
            (
                &self.boxes[..],
                (&self.cylinders[..], (&self.cones[..], (polyhedra, &self.spaces[..]))),
            ),
        );
        let images = (
            &self.sphere_images[..],
            (&self.box_images[..], (&self.cylinder_images[..], &self.cone_images[..])),
        );
        (plain, images)
    }

    /// What the core traces.
    ///
    /// # Errors
    /// None that [`PartTables::finish`] had not.
    pub(crate) fn combined<'a>(
        &'a self,
        polyhedra: &'a [Polyhedron<'a, R>],
    ) -> Result<Combined<'a, R>, CsgError> {
        let trees = Trees::of_parts(&self.steps, &self.links, &self.bounds, &self.roots);
        Csg::new(self.parts(polyhedra), trees)
    }

    /// Bytes of all tables.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.spheres)
            + size_of_val(&*self.boxes)
            + size_of_val(&*self.cylinders)
            + size_of_val(&*self.cones)
            + self.ends.len() * size_of::<Polyhedron<'_, R>>()
            + size_of_val(&*self.faces)
            + size_of_val(&*self.spaces)
            + size_of_val(&*self.sphere_images)
            + size_of_val(&*self.box_images)
            + size_of_val(&*self.cylinder_images)
            + size_of_val(&*self.cone_images)
            + size_of_val(&*self.steps)
            + size_of_val(&*self.links)
            + size_of_val(&*self.bounds)
            + size_of_val(&*self.roots)
    }
}

fn affine<R: Real>(map: &Map) -> Affine<R> {
    let v = |p: Triple| Vec3::<R>::from_f64(p);
    Affine { axes: map.axes.map(v), origin: v(map.origin) }
}

/// A normal of length 1, which fits every number type.
fn unit<R: Real>(normal: &Triple) -> Vec3<R> {
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    Vec3::<R>::from_f64(normal.map(|x| x / length))
}
