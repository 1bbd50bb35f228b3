//! Acceleration structures: which shapes a ray has to be tested against.
//!
//! A structure only *culls*: it hands lists of shapes to a [`Visitor`] in the order in which the
//! ray meets their cells, until the visitor has what it wants. Tests, mailboxes, ties and counters
//! are the visitor's, the same for all, so a hit is bit for bit the one of [`Naive`]:
//! * a shape claims hits only inside its box (see [`shape`](crate::shape)), and a structure lists
//!   it in every cell that its box, padded by [`Scene::pad`](crate::scene::Scene::pad), touches;
//! * the cells of a ray follow each other without gap, each within that pad of the piece of the ray
//!   that is assigned to it; so the cell that a hit falls to lists the shape;
//! * of several shapes hit at the same `t` the one with the least id wins.
//!
//! Structures are borrowed slices with a small header, immutable while tracing; what changes per
//! ray is a [`Mailbox`] that the caller lends.

mod any;
pub mod bounded;
pub mod bvh;
mod error;
pub mod grid;
mod id;
mod lattice;
mod listing;
pub mod mailbox;
mod naive;
pub mod octree;
mod query;
pub mod tree;

pub use any::{Any, Kind};
pub use bounded::Bounded;
pub use bvh::Bvh;
pub use error::BuildError;
pub use grid::Grid;
pub use id::Id;
pub use listing::{ByBox, Huge, Listing, MOST_ASIDE, Overlap};
pub use mailbox::Mailbox;
pub use naive::{Clipped, Naive};
pub use octree::Octree;
pub use query::{Accel, Hit, Visitor};
pub use tree::Tree;
