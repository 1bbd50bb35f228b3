//! Some of the scenes in fixed point: the same shapes, rays and pictures, normalised.

use crate::clouds::{self, Inwards};
use crate::queries::{Around, Shot};
use crate::structure::{Bvh, Grid, Naive, Octree, StampedGrid};
use crate::{Structure, Subject, card};
use core::marker::PhantomData;
use kibiray::geom::{Interval, Ray};
use kibiray::num::fixed::{FarPoint, Vec3};
use kibiray::num::{Fixed, Real, Vector};
use kibiray::scene::{Light, Material, Pattern, Scene, SceneError, View};
use kibiray::shape::{Plane, Sphere, Triangle};

const fn number(x: f32) -> Fixed {
    Fixed::new(x as f64)
}

const fn vector(v: glam::Vec3) -> Vec3 {
    Vec3::new(number(v.x), number(v.y), number(v.z))
}

/// A point of a scene that is shrunk.
const fn point(p: glam::Vec3, scale: f32) -> Vec3 {
    Vec3::new(number(p.x * scale), number(p.y * scale), number(p.z * scale))
}

const fn sphere(s: &Sphere<f32>, scale: f32) -> Sphere<Fixed> {
    Sphere::new(point(s.center, scale), number(s.radius * scale))
}

/// A ray of a scene that is shrunk; its parameters shrink, too.
fn shrunk(shot: &Shot<f32>, scale: f32) -> Option<Shot<Fixed>> {
    let (o, d) = (shot.ray.origin() * scale, shot.ray.direction() * scale);
    let ray = Ray::new(point(o, 1.0), point(d, 1.0)).ok()?;
    let between = Interval::new(number(shot.between.min), number(shot.between.max));
    Some(Shot { ray, between })
}

/// The card in fixed point.
#[derive(Clone, Copy, Debug)]
pub struct FixedCard;

/// The floor has no end; so much of it that its end is less than two rows of pixels below the horizon
/// is within 8 units.
const CARD: f32 = 1.0 / 32.0;

const fn material(m: &Material<f32>) -> Material<Fixed> {
    Material {
        color: vector(m.color),
        diffuse: number(m.diffuse),
        specular: number(m.specular),
        shine: kibiray::num::fixed::Exponent::from_bits((m.shine * 1024.0) as u32),
        transmission: number(m.transmission),
        index: number(m.index),
        pattern: match m.pattern {
            Pattern::Plain => Pattern::Plain,
            Pattern::Checker(edge, color) => Pattern::Checker(number(edge * CARD), vector(color)),
        },
    }
}

static BALLS: [Sphere<Fixed>; 4] = {
    let [a, b, c, d] = &card::SPHERES;
    [sphere(a, CARD), sphere(b, CARD), sphere(c, CARD), sphere(d, CARD)]
};
static FLOOR: [Plane<Fixed>; 1] = [Plane::new(vector(glam::Vec3::ZERO), vector(glam::Vec3::Y))];
static SURFACES: [Material<Fixed>; 5] = {
    let [a, b, c, d, e] = &card::MATERIALS;
    [material(a), material(b), material(c), material(d), material(e)]
};
static LIGHTS: [Light<Fixed>; 1] = {
    let p = card::LIGHT.position;
    let position = [(p.x * CARD) as f64, (p.y * CARD) as f64, (p.z * CARD) as f64];
    [Light { position: FarPoint::new(position), color: vector(card::LIGHT.color) }]
};
impl Subject for FixedCard {
    const NAME: &'static str = "fixed_card";
    const SIZE: (u16, u16) = (320, 240);
    const DEPTH: u8 = 3;
    type Number = Fixed;
    type Structure = Naive;
    type Shapes = (&'static [Sphere<Fixed>], &'static [Plane<Fixed>]);

    fn scene() -> Result<Scene<'static, Fixed, Self::Shapes>, SceneError> {
        let scene = Scene::new((&BALLS[..], &FLOOR[..]))?;
        scene.painted(&SURFACES, &card::PAINT)?.lit(&LIGHTS, vector(card::SKY))
    }

    fn view() -> View<Fixed> {
        let View { from, at, up, angle } = card::VIEW;
        View {
            from: point(from, CARD),
            at: point(at, CARD),
            up: vector(up),
            angle: Fixed::from_f64(angle.into()),
        }
    }

    fn rays() -> impl Iterator<Item = Shot<Fixed>> {
        Around::new(400, 2.0).filter_map(|shot| shrunk(&shot, CARD))
    }
}

/// Spheres in fixed point.
#[derive(Clone, Copy, Debug)]
pub struct FixedSpheres<K>(PhantomData<K>);

/// Triangles in fixed point.
#[derive(Clone, Copy, Debug)]
pub struct FixedTriangles<K>(PhantomData<K>);

/// Spheres, every one tested.
pub type FixedSpheresNaive = FixedSpheres<Naive>;
/// Spheres in the grid that is best in `f32`, too.
pub type FixedSpheresGrid = FixedSpheres<Grid<9, 9, 9>>;
/// Spheres in the octree.
pub type FixedSpheresOctree = FixedSpheres<Octree<16, 3>>;
/// Spheres in the hierarchy.
pub type FixedSpheresBvh = FixedSpheres<Bvh<48>>;
/// Triangles, every one tested.
pub type FixedTrianglesNaive = FixedTriangles<Naive>;
/// Triangles in the grid.
pub type FixedTrianglesGrid = FixedTriangles<StampedGrid<10, 10, 10>>;
/// Triangles in the octree.
pub type FixedTrianglesOctree = FixedTriangles<Octree<4, 3>>;
/// Triangles in the hierarchy.
pub type FixedTrianglesBvh = FixedTriangles<Bvh<128>>;

/// From the cube from -1 to 1, and what reaches out of it.
const CLOUD: f32 = 0.4;

static SPHERES: [Sphere<Fixed>; clouds::COUNT] = {
    let mut spheres = [sphere(&clouds::SPHERES[0], CLOUD); clouds::COUNT];
    let mut i = 0;
    while i < clouds::COUNT {
        spheres[i] = sphere(&clouds::SPHERES[i], CLOUD);
        i += 1;
    }
    spheres
};

const fn triangle(t: &Triangle<f32>) -> Triangle<Fixed> {
    let [a, b, c] = t.corners;
    Triangle::new(point(a, CLOUD), point(b, CLOUD), point(c, CLOUD))
}

static TRIANGLES: [Triangle<Fixed>; clouds::COUNT] = {
    let mut triangles = [triangle(&clouds::TRIANGLES[0]); clouds::COUNT];
    let mut i = 0;
    while i < clouds::COUNT {
        triangles[i] = triangle(&clouds::TRIANGLES[i]);
        i += 1;
    }
    triangles
};

/// Directions stay of length 1, as parameters have no other meaning here.
fn inwards() -> impl Iterator<Item = Shot<Fixed>> {
    Inwards::new().filter_map(|shot| {
        let origin = point(shot.ray.origin(), CLOUD);
        let direction = vector(shot.ray.direction()).unit()?;
        Some(Shot { ray: Ray::new(origin, direction).ok()?, between: Interval::RAY })
    })
}

impl<K: Structure<Fixed>> Subject for FixedSpheres<K> {
    const NAME: &'static str = "fixed_spheres";
    type Number = Fixed;
    type Structure = K;
    type Shapes = &'static [Sphere<Fixed>];

    fn scene() -> Result<Scene<'static, Fixed, Self::Shapes>, SceneError> {
        Scene::new(&SPHERES[..])
    }

    fn rays() -> impl Iterator<Item = Shot<Fixed>> {
        inwards()
    }
}

impl<K: Structure<Fixed>> Subject for FixedTriangles<K> {
    const NAME: &'static str = "fixed_triangles";
    type Number = Fixed;
    type Structure = K;
    type Shapes = &'static [Triangle<Fixed>];

    fn scene() -> Result<Scene<'static, Fixed, Self::Shapes>, SceneError> {
        Scene::new(&TRIANGLES[..])
    }

    fn rays() -> impl Iterator<Item = Shot<Fixed>> {
        inwards()
    }
}
