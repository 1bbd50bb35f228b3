//! The words that options take.

use clap::ValueEnum;

/// `--rays` of `stats`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum RaySet {
    Spd,
}

/// `--aa`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Antialiasing {
    /// One ray through the middle of a pixel.
    Off,
    /// A square of so many by so many rays.
    Uniform(u8),
    /// Where a channel differs by more than this.
    Adaptive(f64),
}

/// `--accel`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum AccelKind {
    Auto,
    Naive,
    Grid,
    Octree,
    Bvh,
    #[value(help = "a tree of bounds, see --bound")]
    Tree,
    #[value(help = "a list of bounds, those that a ray hits sorted; see --bound")]
    Sorted,
    #[value(help = "none but spheres around those shapes for which they pay")]
    Bounded,
}

/// `--bound`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum BoundKind {
    Sphere,
    #[value(help = "axis-aligned")]
    Box,
    #[value(help = "oriented")]
    Obox,
    #[value(help = "the box under its other name")]
    Kdop6,
    Kdop14,
    Kdop18,
    Kdop26,
}

/// `--builder`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum BuilderKind {
    #[value(help = "shape by shape, as Goldsmith and Salmon (1987)")]
    Gs,
    #[value(help = "shape by shape, as Guttman (1984)")]
    Rtree,
    #[value(help = "from the root down, where the surfaces tell to")]
    Sah,
}

/// `--insertion`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum InsertionKind {
    File,
    Shuffled,
    #[value(help = "along Hilbert's curve")]
    Curve,
}

/// `--num`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Number {
    F32,
    F64,
    #[value(help = "32-bit fixed point, the scene normalised; fast without a floating-point unit")]
    Fixed,
}

/// `--mailbox`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum MailboxKind {
    Auto,
    Off,
    Stamp,
    Cache,
}

/// `--growth`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Growth {
    #[value(help = "first in, first out")]
    Fifo,
    #[value(help = "what saves most tests for its bytes")]
    Benefit,
}

/// `--macro-cells`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Switch {
    Off,
    On,
}

/// `--huge`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Huge {
    Inside,
    Aside,
}

/// `--lists`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum ListKind {
    Own,
    Shared,
}

/// What `--no-skip` does in spite of everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Skip {
    /// Mirrored and refracted rays that add nothing
    Contribution,
    /// Shadow rays: try the last occluder first
    Occluder,
    /// Shadow rays from surfaces that send nothing of the light back
    Shadows,
    /// Shadow rays from surfaces that face away from the light
    Facing,
    /// What rays that go on need, in scenes where nothing mirrors or transmits
    Mirrors,
    /// A loop for each kind of shape, in scenes that have only one
    Kinds,
    /// Tests of all shapes, without a structure, for rays that pass the box around them
    Box,
    /// Cells of a grid where nothing is, several at a time
    Empty,
    /// Shapes in cells that their boxes touch and their surfaces do not
    Cells,
    /// Huge shapes in every cell
    Huge,
    /// Shapes that the ray has been tested against
    Tested,
    /// Lists that the ray has been tested against
    Lists,
}

/// `--store`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Store {
    #[value(help = "a divided cell names its children's place")]
    Links,
    #[value(help = "children are found by name, as Glassner's (1984)")]
    Hash,
    #[value(help = "in breadth-first order, with two bits a cell in place of links")]
    Implicit,
}

/// `--walk`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Walk {
    #[value(help = "from the root every time, as Glassner's (1984)")]
    Restart,
    #[value(help = "from the smallest cell that contains both leaves")]
    Neighbours,
    #[value(help = "down the tree with a stack")]
    Descent,
    #[value(help = "cut into pieces first")]
    Segments,
    #[value(help = "tree: depth first, the nearest child first")]
    Ordered,
    #[value(help = "tree: the nearest of all that wait, as Kay and Kajiya (1986)")]
    Heap,
    #[value(help = "tree: as it is stored, without memory")]
    Stored,
}

impl Walk {
    /// Whether it is one of a tree of bounds.
    pub(super) fn is_of_tree(self) -> bool {
        matches!(self, Self::Ordered | Self::Heap | Self::Stored)
    }
}

/// `--overlap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Overlap {
    #[value(help = "its box touches the cell")]
    Box,
    #[value(help = "its surface may pass through the cell")]
    Exact,
}
