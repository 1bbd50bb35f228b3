//! How many bytes a build takes, known before it is done.

/// Every part of an arena starts at a multiple of this many bytes: what the widest number needs.
pub(crate) const ALIGN: usize = 8;

/// Bytes of one part with `len` elements of `T`, up to where the next part can start; the greatest
/// number there is when that does not fit the address space.
pub(crate) fn part_bytes<T>(len: usize) -> usize {
    len.saturating_mul(size_of::<T>()).saturating_add(ALIGN - 1) / ALIGN * ALIGN
}

/// The bytes of an arena that a build takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    /// Bytes that stay taken.
    pub kept: usize,
    /// Most bytes taken at any moment, `kept` and scratch together.
    pub peak: usize,
}

impl Footprint {
    /// Of `len` elements of `T` that stay.
    pub fn of<T>(len: usize) -> Self {
        let bytes = part_bytes::<T>(len);
        Self { kept: bytes, peak: bytes }
    }

    /// Of two builds, one after the other in the same arena.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self {
            kept: self.kept.saturating_add(next.kept),
            peak: self.peak.max(self.kept.saturating_add(next.peak)),
        }
    }
}
