//! `still-life`: every kind of shape, on a terrace by the sea.

use super::canvas::{Canvas, hue, turn};
use crate::description::{Description, Material, Solid, Triple, View};

pub(super) fn build() -> Description {
    let view = View {
        from: [-1.2, -8.9, 3.1],
        at: [0.05, 0.1, 0.86],
        up: [0.0, 0.0, 1.0],
        angle: 34.0,
        hither: 0.1,
        resolution: [640, 480],
    };
    let mut canvas = Canvas::new([0.56, 0.70, 0.86], view);
    canvas.light([-7.0, -7.0, 10.0], [0.95, 0.88, 0.76]);
    canvas.light([8.0, -7.0, 7.0], [0.36, 0.38, 0.44]);
    canvas.light([1.0, 9.0, 8.0], [0.26, 0.24, 0.24]);
    terrace(&mut canvas);
    balls(&mut canvas);
    ring_and_cone(&mut canvas);
    column(&mut canvas);
    star(&mut canvas, [-3.1, 2.6, 0.9 + 0.78], 0.78);

    canvas.surface([0.14, 0.66, 0.62], 0.9, 0.06, 30.0);
    let (x, y, size) = (-2.2, -1.45, 0.85);
    let foot = |part| {
        let (s, c) = turn(part, 3);
        [x + size * s, y + size * c, 0.0]
    };
    canvas.sponge([foot(0), foot(1), foot(2), [x, y, size * 2.0_f64.sqrt()]], 3);

    canvas.matt([0.80, 0.52, 0.40]);
    for step in 0..3_u8 {
        let (back, top) = (1.5 + 0.5 * f64::from(step), 0.3 * f64::from(step + 1));
        canvas.block([-3.9, back, top - 0.3], [-2.3, 3.0, top]);
    }
    canvas.scene
}

/// Tiles on a plinth, and the sea around.
fn terrace(canvas: &mut Canvas) {
    for x in -6..6_i32 {
        for y in -5..5_i32 {
            if (x + y).rem_euclid(2) == 0 {
                canvas.surface([0.93, 0.89, 0.80], 0.82, 0.07, 40.0);
            } else {
                canvas.surface([0.32, 0.36, 0.42], 0.82, 0.07, 40.0);
            }
            let (x, y) = (f64::from(x), f64::from(y));
            canvas.block([x, y, -0.12], [x + 1.0, y + 1.0, 0.0]);
        }
    }
    canvas.matt([0.55, 0.50, 0.45]);
    canvas.block([-5.9, -4.9, -0.6], [5.9, 4.9, -0.12]);
    canvas.surface([0.06, 0.26, 0.34], 0.75, 0.35, 60.0);
    canvas.add(Solid::Plane { point: [0.0, 0.0, -0.5], normal: [0.0, 0.0, 1.0] });
}

/// A mirror, a glass ball, and marbles around them on a spiral as in a sunflower.
fn balls(canvas: &mut Canvas) {
    canvas.surface([0.85, 0.85, 0.88], 0.12, 0.78, 200.0);
    canvas.sphere([-0.75, 0.95, 1.15], 1.15);
    canvas.material(Material {
        color: [0.85, 0.95, 0.95],
        diffuse: 0.04,
        specular: 0.12,
        shine: 300.0,
        transmission: 0.84,
        index: 1.5,
    });
    canvas.sphere([0.15, -1.55, 0.55], 0.55);
    let taken: [([f64; 2], f64); 6] = [
        ([-0.75, 0.95], 0.8),
        ([0.15, -1.55], 0.45),
        ([1.85, -0.35], 1.35),
        ([-2.2, -1.45], 1.05),
        ([0.95, 2.1], 0.75),
        ([-3.1, 2.2], 1.3),
    ];
    let radius = 0.11;
    for i in 3..120_u8 {
        let angle = 2.399_963 * f64::from(i);
        let far = 0.42 * f64::from(i).sqrt();
        let (x, y) = (far * angle.cos() - 0.3, far * angle.sin() - 0.4);
        let free = |([tx, ty], room): &([f64; 2], f64)| (x - tx).hypot(y - ty) > room + radius;
        if taken.iter().all(free) && y < 3.0 {
            canvas.surface(hue(f64::from(i) * 0.0927), 0.85, 0.12, 60.0);
            canvas.sphere([x, y, radius], radius);
        }
    }
}

/// A ring of triangles with normals, thrown over a cone.
fn ring_and_cone(canvas: &mut Canvas) {
    let (x, y) = (1.85, -0.35);
    canvas.surface([0.86, 0.64, 0.22], 0.75, 0.25, 40.0);
    canvas.torus([x, y, 0.26], (0.95, 0.26), (28, 12));
    canvas.surface([0.85, 0.20, 0.16], 0.9, 0.08, 30.0);
    canvas.cone(([x, y, 0.0], 0.55), ([x, y, 1.75], 0.0));
}

/// A column: a cylinder between two cone frustums, and a ball on top.
fn column(canvas: &mut Canvas) {
    let [x, y] = [0.95, 2.1];
    canvas.matt([0.88, 0.86, 0.82]);
    canvas.cone(([x, y, 0.0], 0.6), ([x, y, 0.3], 0.4));
    canvas.cone(([x, y, 0.3], 0.36), ([x, y, 1.7], 0.36));
    canvas.cone(([x, y, 1.7], 0.4), ([x, y, 1.95], 0.58));
    canvas.surface([0.30, 0.42, 0.70], 0.75, 0.2, 80.0);
    canvas.sphere([x, y, 2.33], 0.38);
}

/// A star that stands on two of its points: two concave polygons and the sides between them.
fn star(canvas: &mut Canvas, center: Triple, size: f64) {
    let corner = |i: u32, depth: f64| {
        let (s, c) = turn(i, 10);
        let far = if i.is_multiple_of(2) { size } else { 0.45 * size };
        // Turned a little towards the eye.
        let (x, y) = (far * s, depth);
        let (s, turned) = 0.2_f64.sin_cos();
        let z = center[2] - 0.19 * size + far * c;
        [center[0] + x * turned - y * s, center[1] + x * s + y * turned, z]
    };
    let (front, back) = (-0.16, 0.16);
    canvas.surface([0.95, 0.75, 0.15], 0.9, 0.08, 30.0);
    canvas.polygon((0..10).map(|i| corner(i, front)).collect());
    canvas.polygon((0..10).rev().map(|i| corner(i, back)).collect());
    for i in 0..10 {
        let side = [(i, front), (i, back), (i + 1, back), (i + 1, front)];
        canvas.polygon(side.map(|(i, depth)| corner(i, depth)).to_vec());
    }
}
