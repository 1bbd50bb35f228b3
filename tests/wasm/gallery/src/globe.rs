//! Marbles spread evenly over a sphere, around a mirror.
//!
//! The spread is the spiral of A. Gonzalez, "Measurement of areas on a sphere using Fibonacci and
//! latitude-longitude lattices", Mathematical Geosciences 42 (2010).

use super::{Store, Turn, V, root};

const MARBLES: u16 = 240;

/// Colours from pole to pole.
const BANDS: [V; 6] = [
    V::new(0.89, 0.38, 0.22),
    V::new(0.94, 0.62, 0.26),
    V::new(0.95, 0.86, 0.62),
    V::new(0.55, 0.75, 0.67),
    V::new(0.25, 0.54, 0.62),
    V::new(0.18, 0.32, 0.48),
];

pub(super) fn build(store: &mut Store) {
    store.background(0.07, 0.09, 0.13);
    store.light(V::new(4.0, 6.0, 5.0), V::new(0.9, 0.86, 0.78));
    store.light(V::new(-5.0, 2.0, 4.0), V::new(0.28, 0.32, 0.4));
    let mut turn = Turn::NONE;
    let mut band = usize::MAX;
    for i in 0..MARBLES {
        let place = (f32::from(i) + 0.5) / f32::from(MARBLES);
        let y = 1.0 - 2.0 * place;
        let across = root(1.0 - y * y);
        let of = usize::from(i) * BANDS.len() / usize::from(MARBLES);
        if let Some(color) = BANDS.get(of).filter(|_| of != band) {
            store.surface(*color, 0.85, 0.14, 40.0);
            band = of;
        }
        let center = V::new(across * turn.cos, y, across * turn.sin) * 1.375;
        store.sphere(center, 0.125);
        turn = turn.by(Turn::GOLDEN);
    }
    store.surface(V::new(0.85, 0.87, 0.9), 0.06, 0.86, 200.0);
    store.sphere(V::ZERO, 1.125);
    store.surface(V::new(0.34, 0.37, 0.42), 0.8, 0.16, 30.0);
    store.floor(-1.5625);
}
