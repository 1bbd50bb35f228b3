//! `helix`: two strands of balls, joined by rungs, over a mirror.

use super::canvas::{Canvas, hue, turn};
use crate::description::{Description, Solid, View};

/// Rungs of a full turn, and of all.
const TURN: u32 = 13;
const RUNGS: u32 = 26;

pub(super) fn build() -> Description {
    let view = View {
        from: [1.5, -7.2, 3.3],
        at: [0.0, 0.0, 1.85],
        up: [0.0, 0.0, 1.0],
        angle: 38.0,
        hither: 0.1,
        resolution: [480, 640],
    };
    let mut canvas = Canvas::new([0.10, 0.14, 0.24], view);
    canvas.light([-5.0, -6.0, 9.0], [1.0, 0.95, 0.85]);
    canvas.light([6.0, -5.0, 4.0], [0.45, 0.5, 0.65]);
    canvas.surface([0.10, 0.13, 0.20], 0.6, 0.5, 100.0);
    canvas.add(Solid::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    for rung in 0..RUNGS {
        let (s, c) = turn(rung, TURN);
        let z = 0.3 + 0.145 * f64::from(rung);
        let color = hue(0.55 + 0.5 * f64::from(rung) / f64::from(RUNGS));
        let ends = [[c, s, z], [-c, -s, z]];
        canvas.surface(color, 0.75, 0.2, 60.0);
        ends.iter().for_each(|end| canvas.sphere(*end, 0.19));
        canvas.surface([0.85, 0.85, 0.85], 0.8, 0.1, 40.0);
        let middle = [0.0, 0.0, z];
        canvas.cone((ends[0], 0.05), (middle, 0.05));
        canvas.surface([0.5, 0.5, 0.55], 0.8, 0.1, 40.0);
        canvas.cone((ends[1], 0.05), (middle, 0.05));
    }
    canvas.scene
}
