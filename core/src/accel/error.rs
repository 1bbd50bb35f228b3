//! Why a structure cannot be built.

use super::Id;
use crate::memory::OutOfArena;

/// Why a structure cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BuildError {
    /// The arena is too small.
    Memory(OutOfArena),
    /// A number does not fit the type that was chosen for it; take a wider one.
    TooMany {
        /// Of what there are too many.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// The octree's limit of depth is beyond what location codes hold.
    TooDeep {
        /// The level that was asked for.
        level: u32,
        /// The deepest possible one.
        limit: u32,
    },
}

impl BuildError {
    pub(crate) fn unless_fits<I: Id>(what: &'static str, count: usize) -> Result<(), Self> {
        Self::unless_above(what, count, I::MAX)
    }

    pub(crate) fn unless_above(what: &'static str, count: usize, limit: usize) -> Result<(), Self> {
        if count <= limit { Ok(()) } else { Err(Self::TooMany { what, count, limit }) }
    }
}

impl From<OutOfArena> for BuildError {
    fn from(error: OutOfArena) -> Self {
        Self::Memory(error)
    }
}

impl core::fmt::Display for BuildError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Memory(error) => error.fmt(f),
            Self::TooMany { what, count, limit } => {
                write!(f, "{count} {what} where at most {limit} can be numbered")
            }
            Self::TooDeep { level, limit } => {
                write!(f, "level {level} asked for, the deepest possible is {limit}")
            }
        }
    }
}

impl core::error::Error for BuildError {}
