//! A trefoil knot: a tube along a curve that winds twice around a ring and three times through it.

use super::{Store, Turn, V, root};

/// Rings of the tube and corners of a ring.
const RINGS: u16 = 96;
const CORNERS: u16 = 8;

/// From ring to ring, and from corner to corner.
const STEP: Turn = Turn { cos: 0.997_858_94, sin: 0.065_403_13 };
const EIGHTH: Turn = Turn { cos: 0.707_106_77, sin: 0.707_106_77 };

/// The ring that is wound around, the winding, and the tube.
const RADII: [f32; 3] = [1.25, 0.5625, 0.3125];

pub(super) fn build(store: &mut Store) {
    store.background(0.12, 0.13, 0.17);
    store.light(V::new(-4.0, 7.0, 4.0), V::new(0.9, 0.84, 0.72));
    store.light(V::new(5.0, 3.0, 5.0), V::new(0.3, 0.34, 0.42));
    store.surface(V::new(0.88, 0.63, 0.24), 0.72, 0.26, 45.0);
    let mut place = Turn::NONE;
    for ring in 1..=RINGS {
        // The last ring is the first, to the bit: no gap between them.
        let next = if ring == RINGS { Turn::NONE } else { place.by(STEP) };
        let mut around = Turn::NONE;
        for corner in 1..=CORNERS {
            let further = if corner == CORNERS { Turn::NONE } else { around.by(EIGHTH) };
            let [a, b] = [around, further].map(|around| point(place, around));
            let [c, d] = [around, further].map(|around| point(next, around));
            store.smooth([a, c, b]);
            store.smooth([b, c, d]);
            around = further;
        }
        place = next;
    }
    store.surface(V::new(0.3, 0.33, 0.4), 0.75, 0.25, 60.0);
    store.floor(-1.0);
}

/// A point of the tube's surface and its normal.
fn point(place: Turn, around: Turn) -> (V, V) {
    let [ring, winding, tube] = RADII;
    let twice = place.by(place);
    let thrice = twice.by(place);
    let outwards = V::new(twice.cos, 0.0, twice.sin);
    let along = V::new(-twice.sin, 0.0, twice.cos);
    // From the ring to the curve, which is across the curve as it lies on a torus.
    let across = outwards * thrice.cos + V::Y * thrice.sin;
    let onwards = along * (2.0 * (ring + winding * thrice.cos))
        + (V::Y * thrice.cos - outwards * thrice.sin) * (3.0 * winding);
    let sideways = onwards.cross(across);
    let sideways = sideways * (1.0 / root(sideways.dot(sideways)));
    let normal = across * around.cos + sideways * around.sin;
    (outwards * ring + across * winding + normal * tube, normal)
}
