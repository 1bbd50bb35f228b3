//! Every kind of shape on a table.

use super::{Store, V};

/// A star of five points, standing.
static STAR: [V; 10] = [
    V::new(2.0, 1.9, -1.25),
    V::new(1.823_664, 1.392_705, -1.25),
    V::new(1.286_713, 1.381_763, -1.25),
    V::new(1.714_683, 1.057_295, -1.25),
    V::new(1.559_161, 0.543_237, -1.25),
    V::new(2.0, 0.85, -1.25),
    V::new(2.440_839, 0.543_237, -1.25),
    V::new(2.285_317, 1.057_295, -1.25),
    V::new(2.713_287, 1.381_763, -1.25),
    V::new(2.176_336, 1.392_705, -1.25),
];

/// A little pyramid.
const PYRAMID: [[V; 3]; 4] = {
    const TOP: V = V::new(-2.125, 1.0, 1.0);
    const A: V = V::new(-2.625, 0.0, 1.5);
    const B: V = V::new(-1.625, 0.0, 1.5);
    const C: V = V::new(-1.625, 0.0, 0.5);
    const D: V = V::new(-2.625, 0.0, 0.5);
    [[TOP, A, B], [TOP, B, C], [TOP, C, D], [TOP, D, A]]
};

pub(super) fn build(store: &mut Store) {
    store.background(0.62, 0.74, 0.85);
    store.light(V::new(-5.0, 8.0, 6.0), V::new(0.85, 0.79, 0.68));
    store.light(V::new(6.0, 5.0, 5.0), V::new(0.32, 0.34, 0.38));
    store.tiles(4, [V::new(0.9, 0.87, 0.79), V::new(0.42, 0.5, 0.5)]);
    // The plinth that a glass ball lies on, and the sea.
    store.surface(V::new(0.36, 0.38, 0.44), 0.85, 0.1, 30.0);
    store.block(V::new(-0.625, 0.0, 0.75), V::new(0.625, 0.25, 2.0));
    store.surface(V::new(0.1, 0.27, 0.36), 0.75, 0.3, 60.0);
    store.floor(-0.5);
    store.glass();
    store.sphere(V::new(0.0, 0.8125, 1.375), 0.5625);
    store.surface(V::new(0.86, 0.88, 0.9), 0.1, 0.78, 200.0);
    store.sphere(V::new(-0.5, 1.0, -1.25), 1.0);

    store.surface(V::new(0.14, 0.55, 0.53), 0.9, 0.1, 30.0);
    PYRAMID.iter().for_each(|face| store.triangle(*face));
    store.surface(V::new(0.95, 0.74, 0.2), 0.9, 0.1, 30.0);
    store.polygon(&STAR);
    columns(store);

    store.surface(V::new(0.84, 0.24, 0.18), 0.88, 0.1, 40.0);
    store.cone((V::new(1.875, 0.0, 1.25), 0.625), (V::new(1.875, 1.375, 1.25), 0.0));
    store.surface(V::new(0.24, 0.4, 0.68), 0.85, 0.14, 60.0);
    for step in 0..4_u8 {
        let step = f32::from(step);
        let center = V::new(-2.0 + 0.5 * step, 0.1875, 2.75 + 0.125 * step);
        store.sphere(center, 0.1875);
    }
}

/// Five columns along the back, each of a cylinder between two cone frustums, with a beam on top.
fn columns(store: &mut Store) {
    store.surface(V::new(0.93, 0.9, 0.86), 0.88, 0.05, 20.0);
    for x in -2..=2_i8 {
        let at = |height| V::new(1.5 * f32::from(x), height, -3.25);
        store.cone((at(0.0), 0.375), (at(0.25), 0.25));
        store.cylinder(at(0.25), at(2.0), 0.21875);
        store.cone((at(2.0), 0.25), (at(2.25), 0.375));
    }
    store.block(V::new(-3.5, 2.25, -3.75), V::new(3.5, 2.5, -2.75));
}
