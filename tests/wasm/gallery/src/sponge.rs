//! W. Sierpinski's gasket in space, as in the Standard Procedural Databases.

use super::{Store, V};
use core::f32::consts::SQRT_2;

/// How often it is divided: four times as many tetrahedra at every level.
const LEVELS: u32 = 4;

/// Corners of a regular tetrahedron on its face, with edges of twice the square root of 2.
const CORNERS: [V; 4] = [
    V::new(0.0, 1.732_050_8, 0.0),
    V::new(0.0, -0.577_350_26, 1.632_993_2),
    V::new(SQRT_2, -0.577_350_26, -0.816_496_6),
    V::new(-SQRT_2, -0.577_350_26, -0.816_496_6),
];

/// Faces, anticlockwise from outside.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

pub(super) fn build(store: &mut Store) {
    store.background(0.06, 0.07, 0.09);
    store.light(V::new(-3.0, 6.0, 5.0), V::new(0.8, 0.77, 0.7));
    store.light(V::new(5.0, 3.0, 6.0), V::new(0.5, 0.52, 0.56));
    store.surface(V::new(0.16, 0.68, 0.64), 0.95, 0.08, 30.0);
    for piece in 0..1_u32 << (2 * LEVELS) {
        let mut size = 1.0;
        let mut middle = V::ZERO;
        for level in 0..LEVELS {
            size *= 0.5;
            let corner = (piece >> (2 * level)) as usize & 3;
            middle += CORNERS[corner] * size;
        }
        for face in FACES {
            store.triangle(face.map(|corner| middle + CORNERS[corner] * size));
        }
    }
    store.surface(V::new(0.82, 0.8, 0.76), 0.85, 0.06, 20.0);
    store.floor(-0.578_125);
}
