//! `room`: a room with two coloured walls, a mirror ball, a glass ball and a block. So few shapes
//! that no structure pays.

use super::canvas::Canvas;
use crate::description::{Description, Material, View};

pub(super) fn build() -> Description {
    let view = View {
        from: [0.0, -5.2, 1.0],
        at: [0.0, 0.0, 0.95],
        up: [0.0, 0.0, 1.0],
        angle: 30.0,
        hither: 0.1,
        resolution: [512, 512],
    };
    let mut canvas = Canvas::new([0.02, 0.02, 0.03], view);
    // Three lamps close together soften the shadows.
    for [x, y] in [[-0.22, 0.0], [0.22, 0.0], [0.0, 0.3]] {
        canvas.light([x, y, 1.6], [0.32, 0.30, 0.27]);
    }
    canvas.light([0.0, -5.0, 1.4], [0.20, 0.20, 0.22]);
    canvas.matt([0.85, 0.84, 0.80]);
    canvas.block([-1.1, -1.0, -0.1], [1.1, 1.1, 0.0]);
    canvas.block([-1.1, -1.0, 2.0], [1.1, 1.1, 2.1]);
    canvas.block([-1.1, 1.0, 0.0], [1.1, 1.1, 2.0]);
    canvas.matt([0.75, 0.22, 0.18]);
    canvas.block([-1.1, -1.0, 0.0], [-1.0, 1.0, 2.0]);
    canvas.matt([0.22, 0.55, 0.25]);
    canvas.block([1.0, -1.0, 0.0], [1.1, 1.0, 2.0]);
    canvas.matt([0.55, 0.60, 0.72]);
    canvas.block([0.25, 0.2, 0.0], [0.8, 0.75, 0.55]);
    canvas.surface([0.9, 0.9, 0.9], 0.05, 0.88, 300.0);
    canvas.sphere([-0.42, 0.35, 0.45], 0.45);
    canvas.material(Material {
        color: [0.9, 0.95, 0.95],
        diffuse: 0.03,
        specular: 0.1,
        shine: 300.0,
        transmission: 0.87,
        index: 1.5,
    });
    canvas.sphere([0.3, -0.4, 0.3], 0.3);
    canvas.surface([0.85, 0.65, 0.25], 0.7, 0.25, 60.0);
    canvas.cone(([0.52, 0.48, 0.55], 0.22), ([0.52, 0.48, 1.05], 0.0));
    canvas.scene
}
