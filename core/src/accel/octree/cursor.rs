//! Going through the cells of an octree that is being built, depth first.

use super::code::{Code, DEEPEST};

/// Where a cell's word lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    Root,
    /// Number of the family, and octant.
    Child(usize, usize),
}

impl Slot {
    /// Whether it is the root's, or in one of the first so many families.
    pub(super) fn is_within(self, families: usize) -> bool {
        match self {
            Self::Root => true,
            Self::Child(family, _) => family < families,
        }
    }

    /// The slot that came to be after this one.
    pub(super) fn next(self) -> Self {
        match self {
            Self::Root => Self::Child(0, 0),
            Self::Child(family, 7) => Self::Child(family + 1, 0),
            Self::Child(family, octant) => Self::Child(family, octant + 1),
        }
    }
}

/// A cell and the way down to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    code: Code,
    /// The family that the cell's ancestor on each level is in, the cell itself included; the root
    /// is in none.
    path: [usize; DEEPEST as usize + 1],
}

impl Cursor {
    pub(super) const ROOT: Self = Self { code: Code::ROOT, path: [0; DEEPEST as usize + 1] };

    pub(super) fn code(&self) -> Code {
        self.code
    }

    pub(super) fn level(&self) -> u32 {
        self.code.level()
    }

    pub(super) fn slot(&self) -> Slot {
        match self.level() as usize {
            0 => Slot::Root,
            level => {
                let family = self.path.get(level).copied().unwrap_or_default();
                Slot::Child(family, (self.code.0 & 7) as usize)
            }
        }
    }

    /// Goes to the first child, in the family of that number.
    pub(super) fn down(&mut self, family: usize) {
        self.code = self.code.child(0);
        let level = self.level() as usize;
        if let Some(place) = self.path.get_mut(level) {
            *place = family;
        }
    }

    /// Goes to the next cell that is not below this one; false after the last.
    pub(super) fn next(&mut self) -> bool {
        let next = self.code.next();
        self.code = next.unwrap_or(Code::ROOT);
        next.is_some()
    }
}
