//! The card once more, written plainly: what a program costs that knows its scene, without this
//! library. The same picture but for rounding.

use crate::Subject;
use crate::card::{Card, DARK, HALF_HEIGHT, LIGHT, MATERIALS, SKY, SPHERES, VIEW};
use glam::Vec3;
use kibiray::num::Real;
use kibiray::shape::Sphere;

/// Rays start so far off a surface.
const OFF: f32 = 1e-3;

fn root(x: f32) -> f32 {
    // The instruction where the processor has one; libm's is software on a Cortex-M4F.
    Real::sqrt(x)
}

fn unit(v: Vec3) -> Vec3 {
    v * (1.0 / root(v.dot(v)))
}

/// Parameter of a ball along a ray of unit direction, less than `OFF` for none.
fn ball(o: Vec3, d: Vec3, ball: &Sphere<f32>) -> f32 {
    let from = o - ball.center;
    let half = from.dot(d);
    let under_root = half * half - (from.dot(from) - ball.radius * ball.radius);
    if under_root < 0.0 {
        return -1.0;
    }
    let q = root(under_root);
    if -half - q > OFF { -half - q } else { -half + q }
}

fn in_shadow(o: Vec3, d: Vec3, distance: f32) -> bool {
    SPHERES.iter().any(|sphere| {
        let t = ball(o, d, sphere);
        t > OFF && t < distance
    })
}

/// What a ray sees; recursive, at most three deep.
fn trace(o: Vec3, d: Vec3, level: u32) -> Vec3 {
    let (mut near, mut what) = (f32::INFINITY, None);
    for (i, sphere) in SPHERES.iter().enumerate() {
        let t = ball(o, d, sphere);
        if t > OFF && t < near {
            (near, what) = (t, Some(i));
        }
    }
    if d.y < 0.0 {
        let t = -o.y / d.y;
        if t > OFF && t < near {
            (near, what) = (t, Some(SPHERES.len()));
        }
    }
    let Some(what) = what else { return SKY };
    let point = o + d * near;
    let material = &MATERIALS[what];
    let (normal, color) = match SPHERES.get(what) {
        Some(sphere) => (unit(point - sphere.center), material.color),
        None => {
            let odd = (libm::floorf(point.x) as i32 ^ libm::floorf(point.z) as i32) & 1;
            (Vec3::Y, if odd == 0 { material.color } else { DARK })
        }
    };
    let mirrored = d - normal * (2.0 * normal.dot(d));
    let towards = LIGHT.position - point;
    let distance = root(towards.dot(towards));
    let towards = towards * (1.0 / distance);
    let mut seen = Vec3::ZERO;
    let cosine = normal.dot(towards);
    if cosine > 0.0 && !in_shadow(point, towards, distance) {
        seen = color * (material.diffuse * cosine);
        let highlight = mirrored.dot(towards);
        if highlight > 0.0 {
            // To the 32nd power.
            let power = (0..5).fold(highlight.min(1.0), |x, _| x * x);
            seen += Vec3::splat(material.specular * power);
        }
    }
    if level < 3 {
        seen += trace(point, mirrored, level + 1) * material.specular;
    }
    seen
}

/// The camera: to the middle of the picture, from there to its right and its upper edge.
#[derive(Clone, Copy, Debug)]
pub struct Plain {
    forward: Vec3,
    right: Vec3,
    up: Vec3,
}

impl Plain {
    /// Width and height of the picture.
    pub const SIZE: (u16, u16) = Card::SIZE;

    /// Looks at the card.
    pub fn new() -> Self {
        let forward = unit(VIEW.at - VIEW.from);
        let right = unit(forward.cross(VIEW.up));
        let up = right.cross(forward) * HALF_HEIGHT;
        let (width, height) = Card::SIZE;
        let right = right * (HALF_HEIGHT * f32::from(width) / f32::from(height));
        Self { forward, right, up }
    }

    /// Renders a row of 8-bit RGB.
    #[inline(never)]
    pub fn row(&self, y: u16, row: &mut [u8]) {
        let (width, height) = (f32::from(Card::SIZE.0), f32::from(Card::SIZE.1));
        let up = 1.0 - (2.0 * f32::from(y) + 1.0) / height;
        for (x, pixel) in (0..Card::SIZE.0).zip(row.as_chunks_mut().0) {
            let right = (2.0 * f32::from(x) + 1.0) / width - 1.0;
            let d = unit(self.forward + self.right * right + self.up * up);
            let color = trace(VIEW.from, d, 1);
            // Conversion from f32 saturates.
            *pixel = color.to_array().map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        }
    }
}

impl Default for Plain {
    fn default() -> Self {
        Self::new()
    }
}
