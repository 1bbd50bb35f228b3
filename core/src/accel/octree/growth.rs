//! What is chosen about how an octree grows.

#[cfg(doc)]
use super::code::DEEPEST;
use crate::accel::listing::{ByBox, Huge, Listing, Overlap};

/// When a cell is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// A cell with more shapes than this is divided.
    pub max_objects: usize,
    /// No cell is deeper than this; the root is level 0. At most [`DEEPEST`].
    pub max_level: u32,
}

/// How an octree grows. [`Limits`] alone mean: everything is listed, by its box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth<L = ByBox> {
    /// When a cell is divided.
    pub limits: Limits,
    /// What is done with shapes much larger than the others.
    pub huge: Huge,
    /// How lists are made: [`ByBox`], or [`Lists`] where that is not known when the program is
    /// compiled.
    pub lists: L,
    /// Which cells are divided first.
    pub order: Order,
}

/// How an octree's lists are made, chosen while the program runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lists {
    /// When a shape is listed in a cell.
    pub overlap: Overlap,
    /// Whether leaves with equal lists share one. How much that saves is not known beforehand: a
    /// footprint is then what a build cannot exceed. See
    /// [`mailbox::Lists`](crate::accel::mailbox::Lists).
    pub shared: bool,
}

impl Listing for Lists {
    fn overlap(self) -> Overlap {
        self.overlap
    }

    fn shares(self) -> bool {
        self.shared
    }
}

/// Which cells are divided first: what matters when memory does not suffice for all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// First in, first out.
    #[default]
    Breadth,
    /// Those first that save most tests for the bytes they take, with rays that come from all
    /// around; those that save none are not divided at all. How a build goes is not known
    /// beforehand: a footprint is then what it cannot exceed.
    Benefit,
}

impl<L: Listing> Growth<L> {
    /// Everything is listed, in the default way; first in, first out.
    pub fn new(limits: Limits) -> Self {
        Self { limits, huge: Huge::Inside, lists: L::default(), order: Order::Breadth }
    }
}

impl From<Limits> for Growth {
    fn from(limits: Limits) -> Self {
        Self::new(limits)
    }
}

/// Why the division of cells ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoppedBy {
    /// No leaf has more shapes than the limit.
    Done,
    /// Leaves with more shapes are at the limit of depth.
    Level,
    /// The next division did not fit the memory, or its numbers not the words.
    Memory,
}
