//! Two hundred marbles above a floor.

use crate::lcg::Lcg;
use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, View};
use kibiray::shape::{Sphere, Triangle};

type V = Vec3<f32>;

/// 200 spheres of random sizes and places, some matt, some mirrors, some glass, over a floor of two
/// triangles, with two lights: 3,272 bytes of geometry.
#[derive(Clone, Copy, Debug)]
pub struct Marbles;

const COUNT: usize = 200;

static SPHERES: [Sphere<f32>; COUNT] = {
    let mut random = Lcg(2026);
    let mut spheres = [Sphere::new(V::ZERO, 1.0); COUNT];
    let mut i = 0;
    while i < COUNT {
        let center = V::new(random.signed(), random.signed(), random.signed());
        spheres[i] = Sphere::new(center, 0.03 + random.unit() / 16.0);
        i += 1;
    }
    spheres
};

static FLOOR: [Triangle<f32>; 2] = {
    const A: V = V::new(-2.0, -1.125, -2.0);
    const B: V = V::new(2.0, -1.125, -2.0);
    const C: V = V::new(2.0, -1.125, 2.0);
    const D: V = V::new(-2.0, -1.125, 2.0);
    [Triangle::new(A, C, B), Triangle::new(A, D, C)]
};

const MATT: Material<f32> = Material { diffuse: 0.8, ..Material::matt(V::new(0.9, 0.4, 0.2)) };

static MATERIALS: [Material<f32>; 4] = [
    MATT,
    Material { color: V::new(0.3, 0.5, 0.9), specular: 0.3, shine: 20.0, ..MATT },
    Material { diffuse: 0.1, specular: 0.1, shine: 50.0, transmission: 0.8, index: 1.5, ..MATT },
    Material { color: V::new(0.6, 0.7, 0.6), ..MATT },
];

static PAINT: [Paint; 4] = [
    Paint { first: 0, material: 0 },
    Paint { first: 100, material: 1 },
    Paint { first: 170, material: 2 },
    Paint { first: COUNT, material: 3 },
];

static LIGHTS: [Light<f32>; 2] = [
    Light { position: V::new(3.0, 5.0, 4.0), color: V::new(0.7, 0.7, 0.6) },
    Light { position: V::new(-4.0, 3.0, 1.0), color: V::new(0.3, 0.3, 0.4) },
];

impl Subject for Marbles {
    const NAME: &'static str = "marbles";
    const SIZE: (u16, u16) = (32, 24);
    type Number = f32;
    type Structure = structure::Octree<2, 8>;
    type Shapes = (&'static [Sphere<f32>], &'static [Triangle<f32>]);

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new((&SPHERES[..], &FLOOR[..]))?
            .painted(&MATERIALS, &PAINT)?
            .lit(&LIGHTS, V::new(0.1, 0.2, 0.3))
    }

    fn view() -> View<f32> {
        View { from: V::new(1.0, 1.0, 3.5), at: V::new(0.0, -0.125, 0.0), up: V::Y, angle: 0.9 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 1.0)
    }
}
