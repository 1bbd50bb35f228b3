//! A scene of one kind of shape, as constants, for the smallest module there is.

use crate::V;
use kibiray::scene::{Light, Scene, SceneError, View};
use kibiray::shape::Sphere;

/// A large ball to stand on, and some on it.
static SPHERES: [Sphere<f32>; 16] = {
    let mut spheres = [Sphere::new(V::new(0.0, -64.0, 0.0), 64.0); 16];
    let mut i = 1;
    while i < spheres.len() {
        let (x, z) = ((i % 4) as f32 - 1.5, (i / 4) as f32 - 1.5);
        let radius = 0.25 + (i * 7 % 5) as f32 * 0.0625;
        spheres[i] = Sphere::new(V::new(x, radius, z), radius);
        i += 1;
    }
    spheres
};

static LIGHTS: [Light<f32>; 1] =
    [Light { position: V::new(-4.0, 6.0, 5.0), color: V::new(1.0, 1.0, 1.0) }];

/// The scene.
///
/// # Errors
/// Those of the core; none is expected.
pub fn scene() -> Result<Scene<'static, f32, &'static [Sphere<f32>]>, SceneError> {
    Scene::new(&SPHERES[..])?.lit(&LIGHTS, V::new(0.5, 0.7, 0.9))
}

/// Where its picture is taken from.
pub const VIEW: View<f32> = View {
    from: V::new(1.0, 2.5, 6.0),
    at: V::new(0.0, 0.25, 0.0),
    up: V::new(0.0, 1.0, 0.0),
    angle: 0.75,
};
