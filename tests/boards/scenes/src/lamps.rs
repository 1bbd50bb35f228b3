//! Balls of glass and mirrors under three lamps.

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, View};
use kibiray::shape::{Sphere, Triangle};

type V = Vec3<f32>;

/// 27 balls on a lattice, every third of glass, every third a mirror, between two walls that mirror
/// as well, lit from three sides: most rays go on to the last level.
#[derive(Clone, Copy, Debug)]
pub struct Lamps;

const COUNT: usize = 27;

static SPHERES: [Sphere<f32>; COUNT] = {
    let mut spheres = [Sphere::new(V::ZERO, 1.0); COUNT];
    let mut i = 0;
    while i < COUNT {
        // Matt ones first, then mirrors, then glass: each kind is every third along a diagonal.
        let (kind, n) = (i / 9, i % 9);
        let (x, y) = (n % 3, n / 3);
        let z = (2 * x + 2 * y + kind) % 3;
        let center = V::new(x as f32 - 1.0, y as f32 - 1.0, z as f32 - 1.0);
        spheres[i] = Sphere::new(center, 0.375);
        i += 1;
    }
    spheres
};

/// A wall behind and a floor.
static WALLS: [Triangle<f32>; 4] = {
    const A: V = V::new(-3.0, -1.5, -2.0);
    const B: V = V::new(3.0, -1.5, -2.0);
    const C: V = V::new(3.0, 2.0, -2.0);
    const D: V = V::new(-3.0, 2.0, -2.0);
    const E: V = V::new(3.0, -1.5, 2.5);
    const F: V = V::new(-3.0, -1.5, 2.5);
    [Triangle::new(A, B, C), Triangle::new(A, C, D), Triangle::new(A, F, E), Triangle::new(A, E, B)]
};

const MATT: Material<f32> = Material { diffuse: 0.9, ..Material::matt(V::new(0.8, 0.3, 0.25)) };

static MATERIALS: [Material<f32>; 4] = [
    MATT,
    Material { color: V::ONE, diffuse: 0.15, specular: 0.8, shine: 60.0, ..MATT },
    Material { diffuse: 0.05, specular: 0.1, shine: 80.0, transmission: 0.85, index: 1.5, ..MATT },
    Material { color: V::new(0.4, 0.5, 0.6), diffuse: 0.6, specular: 0.35, shine: 8.5, ..MATT },
];

static PAINT: [Paint; 4] = [
    Paint { first: 0, material: 0 },
    Paint { first: 9, material: 1 },
    Paint { first: 18, material: 2 },
    Paint { first: COUNT, material: 3 },
];

static LIGHTS: [Light<f32>; 3] = [
    Light { position: V::new(-4.0, 5.0, 4.0), color: V::new(0.6, 0.5, 0.4) },
    Light { position: V::new(4.0, 4.0, 5.0), color: V::new(0.3, 0.4, 0.5) },
    Light { position: V::new(0.0, 1.75, 0.0), color: V::new(0.2, 0.2, 0.2) },
];

impl Subject for Lamps {
    const NAME: &'static str = "lamps";
    const SIZE: (u16, u16) = (32, 24);
    type Number = f32;
    type Structure = structure::Grid<6, 4, 5>;
    type Shapes = (&'static [Sphere<f32>], &'static [Triangle<f32>]);

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new((&SPHERES[..], &WALLS[..]))?
            .painted(&MATERIALS, &PAINT)?
            .lit(&LIGHTS, V::new(0.05, 0.07, 0.1))
    }

    fn view() -> View<f32> {
        View { from: V::new(1.5, 1.0, 5.0), at: V::new(0.0, -0.125, 0.0), up: V::Y, angle: 0.7 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 1.5)
    }
}
