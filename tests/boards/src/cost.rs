//! The least programs that use a part of the library, to see what it takes in flash. They print
//! nothing: `cost_empty` is what they share.

use crate::block::Block;
use crate::machine;
use core::hint::black_box;
use kibiray::accel::octree::Limits;
use kibiray::accel::{Accel, Any, Kind, Mailbox, mailbox};
use kibiray::geom::{Aabb, Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::Vec3;
use kibiray::scene::{Camera, Light, Material, Paint, Scene, Shapes, Solids, Triangles, View};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Sphere, Triangle};
use kibiray::trace::{Renderer, Settings, Tracer};
use kibiray_scenes::{Row, Structure};
use semihosting::process;

type V = Vec3<f32>;

/// Two spheres.
pub static SPHERES: [Sphere<f32>; 2] =
    [Sphere::new(V::X, 1.0), Sphere::new(V::new(-1.0, 0.5, 0.0), 0.5)];

/// A triangle.
pub static TRIANGLES: [Triangle<f32>; 1] = [Triangle::new(V::X, V::Y, V::Z)];

static MEMORY: Block<{ machine::ARENA }> = Block::new();

/// Ends the program.
pub fn exit(done: Option<()>) -> ! {
    process::exit(if done.is_some() { 0 } else { 1 })
}

/// Nearest and any hit of a ray.
pub fn query<S: Shapes<f32>, K: Structure<f32>>(shapes: S) -> Option<()> {
    let mut arena = Arena::new(MEMORY.take()?);
    let scene = Scene::new(black_box(shapes)).ok()?;
    let accel = K::build(&scene, &mut arena).ok()?;
    ask(&scene, &accel, &mut mailbox::Off)
}

fn ask<S: Shapes<f32>>(
    scene: &Scene<'_, f32, S>,
    accel: &impl Accel<f32>,
    mailbox: &mut impl Mailbox,
) -> Option<()> {
    let ray = Ray::new(black_box(V::Z), black_box(V::NEG_Z)).ok()?;
    black_box(accel.nearest(scene, &ray, Interval::RAY, mailbox, &mut ()));
    black_box(accel.occluded(scene, &ray, Interval::RAY, mailbox, &mut ()));
    Some(())
}

static LIGHTS: [Light<f32>; 1] = [Light { position: V::Y, color: V::ONE }];

/// A picture with shadows, without mirrors.
pub fn shadows<S: Shapes<f32>, K: Structure<f32>>(shapes: S) -> Option<()> {
    let mut arena = Arena::new(MEMORY.take()?);
    let scene = Scene::new(black_box(shapes)).ok()?.lit(black_box(&LIGHTS), V::ZERO).ok()?;
    let accel = K::build(&scene, &mut arena).ok()?;
    picture(&scene, &accel, mailbox::Off, Settings { max_depth: 1, ..Settings::default() })
}

fn picture<S: Shapes<f32>>(
    scene: &Scene<'_, f32, S>,
    accel: &impl Accel<f32>,
    mailbox: impl Mailbox,
    settings: Settings<f32>,
) -> Option<()> {
    const SIZE: (u16, u16) = (8, 6);
    let view = View { from: V::Z * 3.0, at: V::ZERO, up: V::Y, angle: 0.8 };
    let camera = Camera::new(&black_box(view), 8.0 / 6.0).ok()?;
    let tracer = Tracer::new(scene, accel, mailbox, settings);
    let mut renderer = Renderer::new(tracer, camera, SIZE.0, SIZE.1);
    let mut bytes = [0; 3 * SIZE.0 as usize];
    let mut row = Row::new(&mut bytes, SIZE.1);
    for _ in 0..SIZE.1 {
        renderer.draw_row(&mut row, &mut ()).ok()?;
    }
    black_box(row.bytes());
    Some(())
}

static CORNERS: [V; 3] = [V::X, V::Y, V::Z];
static NORMALS: [[V; 3]; 1] = [CORNERS];
static POLYGONS: [Polygon<'static, f32>; 1] =
    [Polygon::of_parts(&CORNERS, V::ONE, Aabb { lo: V::ZERO, hi: V::ONE })];
static BOXES: [AxisBox<f32>; 1] = [AxisBox::new(V::ZERO, V::ONE)];
static CYLINDERS: [Cylinder<f32>; 1] = [Cylinder::from_parts(V::ZERO, V::Y, 1.0, 0.5, true)];
static CONES: [Cone<f32>; 1] = [Cone::from_parts(V::ZERO, V::Y, 1.0, 0.5, 0.0, true)];
static PLANES: [Plane<f32>; 1] = [Plane::new(V::ZERO, V::Y)];
static MATERIALS: [Material<f32>; 1] = [Material::matt(V::ONE)];
static PAINT: [Paint; 1] = [Paint { first: 0, material: 0 }];

/// Every kind of shape, every structure, every mailbox, all of the light.
pub fn everything() -> Option<()> {
    let mut arena = Arena::new(MEMORY.take()?);
    let solids = Solids {
        spheres: &SPHERES,
        triangles: Triangles { triangles: &TRIANGLES, normals: &NORMALS },
        polygons: &POLYGONS,
        boxes: &BOXES,
        cylinders: &CYLINDERS,
        cones: &CONES,
        planes: &PLANES,
    };
    let scene = Scene::new(black_box(solids)).ok()?;
    let scene = scene.painted(black_box(&MATERIALS), black_box(&PAINT)).ok()?;
    let scene = scene.lit(black_box(&LIGHTS), V::ZERO).ok()?;
    let kind = black_box(Kind::Octree(Limits { max_objects: 1, max_level: 4 }.into()));
    let accel = Any::build(kind, &scene, &mut arena).ok()?;
    let mailbox = black_box(mailbox::Kind::Stamps);
    let mut mailbox = mailbox::AnyMailbox::new(mailbox, scene.shapes().count(), &mut arena).ok()?;
    ask(&scene, &accel, &mut mailbox)?;
    picture(&scene, &accel, mailbox, black_box(Settings::default()))
}
