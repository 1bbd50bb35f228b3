//! Every kind of shape.

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::geom::Aabb;
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Pattern, Scene, SceneError, Solids, Triangles, View};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Sphere, Triangle};

type V = Vec3<f32>;

/// Spheres, a pyramid, a concave polygon, boxes, cylinders and cones with and without caps, leaning
/// and upright, on a checkered plane.
#[derive(Clone, Copy, Debug)]
pub struct AllSolids;

static SPHERES: [Sphere<f32>; 2] =
    [Sphere::new(V::new(0.0, 0.5, 1.0), 0.5), Sphere::new(V::new(0.0, 1.25, -0.5), 0.25)];

static PYRAMID: [Triangle<f32>; 4] = {
    const TOP: V = V::new(-1.5, 1.0, 0.75);
    const A: V = V::new(-2.0, 0.0, 1.25);
    const B: V = V::new(-1.0, 0.0, 1.25);
    const C: V = V::new(-1.0, 0.0, 0.25);
    const D: V = V::new(-2.0, 0.0, 0.25);
    [
        Triangle::new(TOP, A, B),
        Triangle::new(TOP, B, C),
        Triangle::new(TOP, C, D),
        Triangle::new(TOP, D, A),
    ]
};

/// An arrow that points upwards.
static ARROW: [V; 7] = [
    V::new(-0.25, 1.75, -1.0),
    V::new(0.25, 1.75, -1.0),
    V::new(0.25, 2.25, -1.0),
    V::new(0.75, 2.25, -1.0),
    V::new(0.0, 3.0, -1.0),
    V::new(-0.75, 2.25, -1.0),
    V::new(-0.25, 2.25, -1.0),
];
static POLYGONS: [Polygon<'static, f32>; 1] = {
    let bounds = Aabb { lo: V::new(-0.75, 1.75, -1.0), hi: V::new(0.75, 3.0, -1.0) };
    [Polygon::of_parts(&ARROW, V::Z, bounds)]
};

static BOXES: [AxisBox<f32>; 2] = [
    AxisBox::new(V::new(-0.5, 0.0, -1.0), V::new(0.5, 1.0, 0.0)),
    AxisBox::new(V::new(1.25, 0.0, 0.5), V::new(2.0, 0.25, 1.5)),
];

static CYLINDERS: [Cylinder<f32>; 2] = [
    Cylinder::from_parts(V::new(-1.5, 0.0, -1.0), V::Y, 1.5, 0.375, true),
    // Leaning, open at both ends.
    Cylinder::from_parts(V::new(1.0, 0.25, -1.0), V::new(0.6, 0.8, 0.0), 1.25, 0.25, false),
];

static CONES: [Cone<f32>; 2] = [
    Cone::from_parts(V::new(1.625, 0.25, 1.0), V::Y, 0.75, 0.375, 0.0, true),
    Cone::from_parts(V::new(-1.5, 1.5, -1.0), V::Y, 0.5, 0.25, 0.5, false),
];

static PLANES: [Plane<f32>; 1] = [Plane::new(V::ZERO, V::Y)];

const MATT: Material<f32> = Material { diffuse: 0.85, ..Material::matt(V::new(0.9, 0.75, 0.3)) };

static MATERIALS: [Material<f32>; 5] = [
    MATT,
    Material { color: V::new(0.8, 0.25, 0.2), specular: 0.2, shine: 20.0, ..MATT },
    Material { color: V::new(0.25, 0.5, 0.8), specular: 0.15, shine: 33.3, ..MATT },
    Material { diffuse: 0.1, specular: 0.1, shine: 50.0, transmission: 0.8, index: 1.5, ..MATT },
    Material {
        color: V::new(0.9, 0.9, 0.85),
        pattern: Pattern::Checker(0.5, V::new(0.2, 0.3, 0.35)),
        ..MATT
    },
];

static PAINT: [Paint; 7] = [
    Paint { first: 0, material: 3 },
    Paint { first: 1, material: 1 },
    Paint { first: 2, material: 0 },
    Paint { first: 7, material: 2 },
    Paint { first: 9, material: 1 },
    Paint { first: 11, material: 2 },
    Paint { first: 13, material: 4 },
];

static LIGHTS: [Light<f32>; 2] = [
    Light { position: V::new(-4.0, 6.0, 5.0), color: V::new(0.7, 0.7, 0.65) },
    Light { position: V::new(5.0, 3.0, 4.0), color: V::new(0.3, 0.3, 0.35) },
];

impl Subject for AllSolids {
    const NAME: &'static str = "solids";
    const SIZE: (u16, u16) = (32, 24);
    const DEPTH: u8 = 4;
    type Number = f32;
    type Structure = structure::Grid<5, 4, 4>;
    type Shapes = Solids<'static, f32>;

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        let triangles = Triangles { triangles: &PYRAMID, normals: &[] };
        Scene::new(Solids {
            spheres: &SPHERES,
            triangles,
            polygons: &POLYGONS,
            boxes: &BOXES,
            cylinders: &CYLINDERS,
            cones: &CONES,
            planes: &PLANES,
        })?
        .painted(&MATERIALS, &PAINT)?
        .lit(&LIGHTS, V::new(0.5, 0.6, 0.7))
    }

    fn view() -> View<f32> {
        View { from: V::new(1.0, 2.5, 5.5), at: V::new(0.0, 1.0, 0.0), up: V::Y, angle: 0.75 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 2.0)
    }
}
