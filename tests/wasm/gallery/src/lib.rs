//! The scenes of the page, small enough to be generated when they are chosen.
//!
//! Only additions, multiplications, divisions and square roots make them, so a browser and the host
//! get the same bits, and with them the same picture. The y axis points up.
#![no_std]

mod card;
mod globe;
mod knot;
pub mod least;
mod sponge;
mod store;
mod table;

pub use store::Store;

use kibiray::num::{Real, Vec3};
use kibiray::scene::View;

type V = Vec3<f32>;

/// A scene to choose.
#[derive(Clone, Copy, Debug)]
pub struct Exhibit {
    /// What it is called, with a zero at the end for those who read memory.
    pub name: &'static core::ffi::CStr,
    /// Fills an empty store.
    build: fn(&mut Store),
    /// The eye.
    from: V,
    /// What the eye turns around.
    at: V,
}

/// All of them.
pub static EXHIBITS: [Exhibit; 5] = [
    Exhibit {
        name: c"Card: four balls, a checkered floor",
        build: card::build,
        from: V::new(1.5, 2.25, 7.0),
        at: V::new(0.0, 0.75, 0.0),
    },
    Exhibit {
        name: c"Globe: 240 marbles around a mirror",
        build: globe::build,
        from: V::new(1.75, 2.0, 4.75),
        at: V::new(0.0, 0.0, 0.0),
    },
    Exhibit {
        name: c"Sponge: 1,024 triangles of a fractal",
        build: sponge::build,
        from: V::new(2.0, 1.75, 4.25),
        at: V::new(0.0, 0.125, 0.0),
    },
    Exhibit {
        name: c"Knot: 1,536 triangles with normals",
        build: knot::build,
        from: V::new(1.0, 3.5, 5.5),
        at: V::new(0.0, 0.0, 0.0),
    },
    Exhibit {
        name: c"Table: every kind of shape",
        build: table::build,
        from: V::new(-1.5, 3.0, 7.5),
        at: V::new(0.0, 0.75, 0.0),
    },
];

impl Exhibit {
    /// Puts the scene into a store, in place of what was there.
    pub fn fill(&self, store: &mut Store) {
        store.clear();
        (self.build)(store);
        store.finish();
    }

    /// Where its picture is taken from first. Other views move the eye and nothing else.
    pub fn view(&self) -> View<f32> {
        View { from: self.from, at: self.at, up: V::new(0.0, 1.0, 0.0), angle: 0.75 }
    }
}

/// A direction in the plane, turned step by step without sine and cosine.
#[derive(Clone, Copy)]
struct Turn {
    cos: f32,
    sin: f32,
}

impl Turn {
    const NONE: Self = Self { cos: 1.0, sin: 0.0 };
    /// The golden angle: points turned by it never line up.
    const GOLDEN: Self = Self { cos: -0.737_368_9, sin: 0.675_490_3 };

    /// Further by another turn.
    fn by(self, other: Self) -> Self {
        let cos = self.cos * other.cos - self.sin * other.sin;
        let sin = self.sin * other.cos + self.cos * other.sin;
        // Many turns keep the length of 1.
        let scale = 1.0 / root(cos * cos + sin * sin);
        Self { cos: cos * scale, sin: sin * scale }
    }
}

/// The square root, rounded correctly everywhere.
fn root(x: f32) -> f32 {
    Real::sqrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kibiray::scene::Shapes;

    #[test]
    fn all_scenes_fit_their_store_and_pass_the_checks() {
        let mut store = Store::EMPTY;
        let counts = EXHIBITS.map(|exhibit| {
            exhibit.fill(&mut store);
            assert!(!store.overflowed(), "{:?}", exhibit.name);
            store.scene().unwrap().shapes().count()
        });
        assert_eq!(counts, [68, 242, 1025, 1537, 94]);
    }
}
