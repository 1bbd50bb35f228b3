//! What the sensor stands in, as constants: it lies in flash. In metres; y points up.

use kibiray::num::Vec3;
use kibiray::shape::{AxisBox, Sphere};

type V = Vec3<f32>;

/// A hall of 12 by 8 metres: four walls, then 24 posts in rows.
pub static BOXES: [AxisBox<f32>; 28] = {
    let mut boxes = [AxisBox::new(V::new(-6.25, 0.0, -8.25), V::new(6.25, 3.0, -8.0)); 28];
    boxes[1] = AxisBox::new(V::new(-6.25, 0.0, 0.0), V::new(6.25, 3.0, 0.25));
    boxes[2] = AxisBox::new(V::new(-6.25, 0.0, -8.0), V::new(-6.0, 3.0, 0.0));
    boxes[3] = AxisBox::new(V::new(6.0, 0.0, -8.0), V::new(6.25, 3.0, 0.0));
    let mut post = 0;
    while post < 24 {
        let (x, z) = ((post % 6) as f32 * 2.0 - 5.0, (post / 6) as f32 * -1.75 - 1.75);
        let (from, to) = (V::new(x - 0.125, 0.0, z - 0.125), V::new(x + 0.125, 3.0, z + 0.125));
        boxes[4 + post] = AxisBox::new(from, to);
        post += 1;
    }
    boxes
};

/// Three balls that somebody left there.
pub static BALLS: [Sphere<f32>; 3] = [
    Sphere::new(V::new(-0.75, 0.5, -2.5), 0.5),
    Sphere::new(V::new(2.0, 0.75, -4.5), 0.75),
    Sphere::new(V::new(-3.5, 0.5, -4.0), 0.5),
];

/// Where the sensor sits.
pub const SENSOR: V = V::new(0.0, 0.5, -0.25);

/// Farther than this it sees nothing.
pub const REACH: f32 = 7.5;

/// The beams: from the left to the right, a step of 5 degrees each.
pub const BEAMS: i32 = 25;
pub const DEGREES: i32 = 5;

/// Where the first beam points: 60 degrees to the left of straight ahead.
pub const FIRST: V = V::new(-0.866_025_4, 0.0, -0.5);

/// The next beam: turned by a step. Two products a number, and no sine is needed on the device.
pub fn turned(beam: V) -> V {
    const COS: f32 = 0.996_194_7;
    const SIN: f32 = 0.087_155_74;
    V::new(beam.x * COS - beam.z * SIN, 0.0, beam.x * SIN + beam.z * COS)
}
