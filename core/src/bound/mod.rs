//! Bounding solids: simple bodies around shapes, so that a ray that misses one need not be tested
//! against what is inside.
//!
//! H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", ACM TOG
//! 3(1) (1984). A bound pays where its test costs less than what it saves: [`pays`].
//!
//! # What a bound may do
//! A hit that testing every shape would find must not be lost, whatever is rounded. So a bound says
//! no only if the ray passes by all that it was built around by more than rounding can explain:
//! * it is built around an [`Region`], which contains every place where its shape may be hit, up to
//!   [`Ray::slack`] outside it, and moved outwards by a multiple of
//!   [`Scene::pad`](crate::scene::Scene::pad), twice the slack. What the multiple is made of is
//!   derived in the file of each bound, for rays that start at most four times the scene's greatest
//!   coordinate away from the middle, as all do that reach a structure;
//! * the union of two contains both as they are, with what it rounds itself;
//! * comparisons decide for `-0`, infinite parameters and ties: what touches is hit. A bound with a
//!   side that is not a number, which no checked shape gives, is hit by nothing.

mod aabb;
mod covariance;
mod kdop;
mod oriented;
mod pair;
mod region;
mod slab;
mod sphere;

pub use aabb::Courses;
pub use kdop::{KDop, Lines};
pub use oriented::OrientedBox;
pub use pair::{Intersection, Union};
pub use region::Region;

use crate::geom::Ray;
use crate::num::{Real, Vec3};
use bytemuck::Pod;

/// A body around shapes.
pub trait Bound<R: Real>: Copy + core::fmt::Debug {
    /// What bounds of this kind want to know of a ray, computed once a ray.
    type PerRay: Copy;

    /// Half the area of its surface, in units of its own kind: what the probability of a hit is in
    /// proportion to (Cauchy). For decisions only, never for the answer.
    fn half_area(&self) -> R;

    /// Its middle.
    fn middle(&self) -> Vec3<R>;

    /// Prepares a ray.
    fn per_ray(ray: &Ray<R>) -> Self::PerRay;

    /// Where the ray enters it, or `start` where it is inside already; nothing when it passes by
    /// or is inside only before `start` or beyond `limit`.
    fn enter(&self, ray: &Self::PerRay, start: R, limit: R) -> Option<R>;
}

/// A bound that can be built around any shape and around others of its kind.
pub trait Fitted<R: Real>: Bound<R> {
    /// Around a shape; `pad` is that of its scene.
    fn around(region: &Region<R>, pad: R) -> Self;

    /// Around two of its kind.
    #[must_use]
    fn union(self, other: Self) -> Self;

    /// Whether [`Fitted::refined`] does anything.
    const REFINES: bool = false;

    /// This bound of some shapes, or a smaller one of them where all of them together tell more than
    /// two bounds at a time; `pad` is that of their scene. Time in proportion to their number.
    #[must_use]
    fn refined(self, _inside: impl Iterator<Item = Region<R>> + Clone, _pad: R) -> Self {
        self
    }
}

/// A bound as it is laid into memory.
pub trait Stored<R: Real>: Fitted<R> {
    /// Its numbers.
    type Plain: Pod + core::fmt::Debug;

    /// To be stored.
    fn plain(self) -> Self::Plain;

    /// As it was stored.
    fn of(plain: &Self::Plain) -> Self;
}

/// Whether a bound is worth its test: B + p I < I, where the test of the bound costs B, that of what
/// is inside I, and the bound is hit with probability p. All in the same unit.
pub fn pays<R: Real>(bound: R, probability: R, inside: R) -> bool {
    bound + probability * inside < inside
}

/// Lengths are brought down by this before they are squared, so that areas stay in the range of
/// every number type.
fn shrunk<R: Real>(length: R) -> R {
    length * R::fraction(1, 16)
}
