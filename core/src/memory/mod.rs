//! The one block of RAM that everything which grows with a scene comes out of.
//!
//! [`Arena`] hands out what stays; [`Ends`] lends the rest for the time of a build, two stacks
//! growing towards each other; [`Footprint`] says beforehand how much of either there will be.

mod arena;
mod ends;
mod footprint;

pub use arena::{Arena, OutOfArena, Part};
pub use ends::Ends;
pub(crate) use ends::bytes_of as ends_bytes;
pub use footprint::Footprint;
