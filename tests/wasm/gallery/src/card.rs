//! Four balls over a checkered floor, as on a business card.

use super::{Store, V};

pub(super) fn build(store: &mut Store) {
    store.background(0.52, 0.68, 0.86);
    store.light(V::new(-4.0, 6.0, 5.0), V::new(0.85, 0.8, 0.7));
    store.light(V::new(5.0, 4.0, 3.0), V::new(0.3, 0.32, 0.36));
    store.surface(V::new(0.9, 0.9, 0.92), 0.08, 0.8, 200.0);
    store.sphere(V::new(-0.875, 1.0, -0.75), 1.0);
    store.surface(V::new(0.83, 0.2, 0.16), 0.85, 0.14, 50.0);
    store.sphere(V::new(1.25, 0.75, -0.5), 0.75);
    store.glass();
    store.sphere(V::new(0.25, 0.5, 1.0), 0.5);
    store.surface(V::new(0.9, 0.68, 0.25), 0.75, 0.3, 60.0);
    store.sphere(V::new(-1.25, 0.375, 1.125), 0.375);
    store.tiles(4, [V::new(0.92, 0.9, 0.84), V::new(0.2, 0.26, 0.34)]);
}
