//! Scenes and rays that are traced on every target, and how the results are summed up.
//!
//! The same bits are promised everywhere, so a test needs no picture: a checksum from the device is
//! compared with what the host computes from the same constants. Everything here is `no_std` and
//! lies in flash. A further scene is a further file with a type that implements [`Subject`], and a
//! line in [`all`].
#![no_std]

mod card;
pub mod clouds;
mod crc;
pub mod fixed;
mod knot;
pub mod knot_rays;
mod lamps;
mod lcg;
mod marbles;
mod picture;
mod plain;
mod queries;
mod solids;
mod sponge;
pub mod structure;
mod tetra;
mod xorshift;

pub use card::Card;
pub use crc::Crc32;
pub use knot::Knot;
pub use lamps::Lamps;
pub use marbles::Marbles;
pub use picture::{OutOfOrder, Row};
pub use plain::Plain;
pub use queries::{Answer, Around, Shot, answer};
pub use solids::AllSolids;
pub use sponge::Sponge;
pub use structure::Structure;
pub use tetra::Tetra;

use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, SceneError, Shapes, View};

/// A scene with the work that is done on it.
pub trait Subject {
    /// What reports call it.
    const NAME: &'static str;
    /// Width and height of the picture; 0 where only rays are shot.
    const SIZE: (u16, u16) = (0, 0);
    /// Depth to which rays are followed.
    const DEPTH: u8 = 5;
    /// In which numbers it is traced.
    type Number: Real;
    /// What the device builds over the shapes.
    type Structure: Structure<Self::Number>;
    /// The kinds of shapes.
    type Shapes: Shapes<Self::Number>;

    /// The scene, checked.
    ///
    /// # Errors
    /// Those of the core; none is expected.
    fn scene() -> Result<Scene<'static, Self::Number, Self::Shapes>, SceneError>;

    /// Where the picture is taken from.
    fn view() -> View<Self::Number> {
        let vector = |v| Vec3::<Self::Number>::from_f64(v);
        View {
            from: vector([0.0, 0.0, 1.0]),
            at: vector([0.0; 3]),
            up: vector([0.0, 1.0, 0.0]),
            angle: Self::Number::ONE,
        }
    }

    /// The rays that queries are about.
    fn rays() -> impl Iterator<Item = Shot<Self::Number>>;
}

/// Does something with every subject.
pub trait Each {
    /// Does it with this one.
    fn subject<S: Subject>(&mut self);
}

/// All subjects, always in the same order.
pub fn all(each: &mut impl Each) {
    each.subject::<Marbles>();
    each.subject::<Card>();
    each.subject::<Knot>();
    each.subject::<Lamps>();
    each.subject::<AllSolids>();
    each.subject::<Tetra>();
    each.subject::<Sponge>();
    each.subject::<clouds::SpheresNaive>();
    each.subject::<clouds::SpheresGrid>();
    each.subject::<clouds::SpheresOctree>();
    each.subject::<clouds::SpheresBvh>();
    each.subject::<clouds::SpheresTree>();
    each.subject::<clouds::TrianglesNaive>();
    each.subject::<clouds::TrianglesGrid>();
    each.subject::<clouds::TrianglesStampedGrid>();
    each.subject::<clouds::TrianglesOctree>();
    each.subject::<clouds::TrianglesBvh>();
    each.subject::<knot_rays::Knot1024Bvh>();
    each.subject::<knot_rays::Knot1024Grid>();
    each.subject::<knot_rays::Knot4096Grid>();
    each.subject::<knot_rays::Knot4096Bvh>();
    each.subject::<fixed::FixedCard>();
    each.subject::<fixed::FixedSpheresNaive>();
    each.subject::<fixed::FixedSpheresGrid>();
    each.subject::<fixed::FixedSpheresOctree>();
    each.subject::<fixed::FixedSpheresBvh>();
    each.subject::<fixed::FixedTrianglesNaive>();
    each.subject::<fixed::FixedTrianglesGrid>();
    each.subject::<fixed::FixedTrianglesOctree>();
    each.subject::<fixed::FixedTrianglesBvh>();
}
