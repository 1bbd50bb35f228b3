//! Scenes and rays that are traced on every target, and how the results are summed up.
//!
//! The same bits are promised everywhere, so a test needs no picture: a checksum from the device is
//! compared with what the host computes from the same constants. Everything here is `no_std` and
//! lies in flash. A further scene is a further file with a type that implements [`Subject`].
#![no_std]

mod crc;
mod lcg;
mod marbles;
mod picture;
mod queries;

pub use crc::Crc32;
pub use marbles::Marbles;
pub use picture::{Checksum, OutOfOrder};
pub use queries::{Answer, Answers};

use kibiray::accel::octree::Limits;
use kibiray::scene::{Scene, SceneError, Shapes, View};

/// A scene with the work that is done on it.
pub trait Subject {
    /// What reports call it.
    const NAME: &'static str;
    /// Width and height of the picture.
    const SIZE: (u16, u16);
    /// Number of ray queries.
    const RAYS: u32;
    /// How far from the origin, along each axis, queries start.
    const REACH: f32;
    /// Parameters of the octree.
    const LIMITS: Limits;
    /// The kinds of shapes.
    type Shapes: Shapes<f32>;

    /// The scene, checked.
    ///
    /// # Errors
    /// Those of the core; none is expected.
    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError>;

    /// Where the picture is taken from.
    fn view() -> View<f32>;
}
