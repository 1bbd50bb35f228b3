//! The scene, as constants: it lies in flash, and rays are tested against it there.

use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Pattern, View};
use kibiray::shape::{Plane, Sphere};

type V = Vec3<f32>;

/// A pyramid of cannonballs: layers of 25, 16, 9, 4 and 1.
pub static BALLS: [Sphere<f32>; 55] = {
    /// How much higher each layer lies, its balls in the hollows of the one below: half the square
    /// root of 2, in diameters of a ball.
    const RISE: f32 = core::f32::consts::FRAC_1_SQRT_2;
    let mut balls = [Sphere::new(V::ZERO, 0.5); 55];
    let (mut ball, mut layer) = (0, 0);
    while layer < 5 {
        let across = 5 - layer;
        let mut place = 0;
        while place < across * across {
            let (column, row) = (place % across, place / across);
            let middle = (across - 1) as f32 / 2.0;
            let (x, z) = (column as f32 - middle, row as f32 - middle);
            balls[ball] = Sphere::new(V::new(x, 0.5 + layer as f32 * RISE, z), 0.5);
            ball += 1;
            place += 1;
        }
        layer += 1;
    }
    balls
};

/// The floor, everywhere.
pub static FLOOR: [Plane<f32>; 1] = [Plane::new(V::ZERO, V::Y)];

pub static MATERIALS: [Material<f32>; 3] = [
    // Polished brass.
    Material { diffuse: 0.8, specular: 0.2, shine: 40.0, ..Material::matt(V::new(1.0, 0.6, 0.1)) },
    // The ball at the top.
    Material { diffuse: 0.9, specular: 0.1, shine: 20.0, ..Material::matt(V::new(0.9, 0.1, 0.1)) },
    Material {
        pattern: Pattern::Checker(2.0, V::new(0.1, 0.4, 0.3)),
        ..Material::matt(V::new(0.8, 0.9, 0.8))
    },
];

/// Which shapes have which material: ids go through one table after the other.
pub static PAINT: [Paint; 3] = [
    Paint { first: 0, material: 0 },
    Paint { first: 54, material: 1 },
    Paint { first: 55, material: 2 },
];

pub static LIGHTS: [Light<f32>; 2] = [
    Light { position: V::new(-10.0, 20.0, 15.0), color: V::new(0.8, 0.8, 0.8) },
    Light { position: V::new(20.0, 30.0, 10.0), color: V::new(0.4, 0.4, 0.4) },
];

pub const SKY: V = V::new(0.4, 0.6, 0.9);

pub const VIEW: View<f32> =
    View { from: V::new(3.0, 6.5, 8.5), at: V::new(0.0, 1.25, 0.0), up: V::Y, angle: 0.58 };
