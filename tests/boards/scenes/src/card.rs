//! The picture that small ray tracers show themselves with.

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Pattern, Scene, SceneError, View};
use kibiray::shape::{Plane, Sphere};

type V = Vec3<f32>;

/// Four balls over a checkered floor, one light with shadows, mirrors to three levels. Five shapes
/// are tested faster than any structure is walked.
#[derive(Clone, Copy, Debug)]
pub struct Card;

pub(crate) const SPHERES: [Sphere<f32>; 4] = [
    Sphere::new(V::new(0.0, 1.0, 0.0), 1.0),
    Sphere::new(V::new(-1.9, 0.7, 0.8), 0.7),
    Sphere::new(V::new(1.8, 0.8, 0.5), 0.8),
    Sphere::new(V::new(0.6, 0.4, 1.6), 0.4),
];

/// A ball's surface: what is not mirrored is matt.
const fn ball(color: V, mirror: f32) -> Material<f32> {
    Material { diffuse: 1.0 - mirror, specular: mirror, shine: 32.0, ..Material::matt(color) }
}

/// Of the balls and the floor.
pub(crate) const MATERIALS: [Material<f32>; 5] = [
    ball(V::new(0.9, 0.2, 0.2), 0.3),
    ball(V::new(0.2, 0.9, 0.3), 0.2),
    ball(V::new(0.2, 0.3, 0.9), 0.4),
    ball(V::new(0.9, 0.9, 0.9), 0.6),
    Material { pattern: Pattern::Checker(1.0, DARK), ..ball(V::new(0.9, 0.9, 0.9), 0.1) },
];

/// The other squares of the floor.
pub(crate) const DARK: V = V::new(0.1, 0.1, 0.1);
pub(crate) const LIGHT: Light<f32> = Light { position: V::new(-4.0, 6.0, 5.0), color: V::ONE };
pub(crate) const SKY: V = V::new(0.65, 0.75, 1.0);
/// The tangent of half the vertical angle of view.
pub(crate) const HALF_HEIGHT: f32 = 0.45;

pub(crate) const VIEW: View<f32> = View {
    from: V::new(0.0, 1.6, 6.0),
    at: V::new(0.0, 0.7, 0.0),
    up: V::Y,
    // Twice the angle whose tangent is `HALF_HEIGHT`.
    angle: 0.845_707_85,
};

static BALLS: [Sphere<f32>; 4] = SPHERES;
static FLOOR: [Plane<f32>; 1] = [Plane::new(V::ZERO, V::Y)];
static SURFACES: [Material<f32>; 5] = MATERIALS;
static LIGHTS: [Light<f32>; 1] = [LIGHT];

pub(crate) static PAINT: [Paint; 5] = [
    Paint { first: 0, material: 0 },
    Paint { first: 1, material: 1 },
    Paint { first: 2, material: 2 },
    Paint { first: 3, material: 3 },
    Paint { first: 4, material: 4 },
];

impl Subject for Card {
    const NAME: &'static str = "card";
    const SIZE: (u16, u16) = (320, 240);
    const DEPTH: u8 = 3;
    type Number = f32;
    type Structure = structure::Naive;
    type Shapes = (&'static [Sphere<f32>], &'static [Plane<f32>]);

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new((&BALLS[..], &FLOOR[..]))?.painted(&SURFACES, &PAINT)?.lit(&LIGHTS, SKY)
    }

    fn view() -> View<f32> {
        VIEW
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 2.0)
    }
}
