//! The arena: typed slices out of the caller's bytes.

use super::footprint::{ALIGN, part_bytes};
use super::{Ends, Footprint};
use bytemuck::Pod;
use core::fmt;
use heapless::Vec;

/// Most differently named parts an arena reports; further ones are added to the last. Three of a
/// hierarchy, three of combined objects, a mailbox, samples of a picture, and bytes lost to alignment.
const PARTS: usize = 9;

/// How many bytes go by one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// What they are for.
    pub name: &'static str,
    /// How many.
    pub bytes: usize,
}

/// An arena is too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfArena {
    /// Bytes the arena would have to have in all: with exactly so many, starting at the same
    /// alignment, the same calls succeed.
    pub needed: usize,
    /// Bytes it has in all.
    pub available: usize,
}

impl fmt::Display for OutOfArena {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "needs an arena of {} bytes, has {}", self.needed, self.available)
    }
}

impl core::error::Error for OutOfArena {}

/// Hands out slices of the bytes that it was given, and never takes them back: they live as long
/// as the bytes do, side by side. What a build needs only for a while comes from
/// [`Arena::scratch`] and is free again afterwards.
///
/// Contents are whatever the bytes held. Nothing is cleared, so what a build leaves at the front
/// of its scratch is there in the parts that are kept next.
#[derive(Debug)]
pub struct Arena<'m> {
    free: &'m mut [u8],
    capacity: usize,
    /// Bytes of the loss to alignment that there are not even.
    missing: usize,
    high_water: usize,
    parts: Vec<Part, PARTS>,
}

impl<'m> Arena<'m> {
    /// An arena over some bytes. When they do not start at a multiple of 8, up to 7 are lost; they
    /// are reported as a part.
    pub fn new(bytes: &'m mut [u8]) -> Self {
        let capacity = bytes.len();
        let offset = bytes.as_ptr().align_offset(ALIGN);
        let lost = offset.min(capacity);
        let missing = offset - lost;
        let mut arena = Self { free: bytes, capacity, missing, high_water: 0, parts: Vec::new() };
        if lost > 0 {
            // Cannot fail: there are as many.
            let _ = arena.take(lost);
            arena.record("alignment", lost);
        }
        arena
    }

    /// Bytes it was given.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Bytes handed out.
    pub fn used(&self) -> usize {
        self.capacity - self.free.len()
    }

    /// Bytes not handed out.
    pub fn available(&self) -> usize {
        self.free.len()
    }

    /// Most bytes ever in use at once, scratch included.
    pub fn high_water(&self) -> usize {
        self.high_water
    }

    /// What the used bytes are for, in the order in which they were handed out.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Hands out `len` elements for good, reported under `name`. Takes the bytes of the elements,
    /// rounded up to a multiple of 8.
    ///
    /// # Errors
    /// [`OutOfArena`] when so many are not there; nothing is taken then.
    pub fn keep<T: Pod>(
        &mut self,
        name: &'static str,
        len: usize,
    ) -> Result<&'m mut [T], OutOfArena> {
        let bytes = part_bytes::<T>(len);
        let part = self.take(bytes)?;
        self.record(name, bytes);
        // The part starts at a multiple of 8 and holds `len` elements, so neither step can fail.
        let part = part.get_mut(..len.saturating_mul(size_of::<T>())).unwrap_or_default();
        Ok(bytemuck::try_cast_slice_mut(part).unwrap_or_default())
    }

    /// Asks for a footprint without taking anything.
    ///
    /// # Errors
    /// [`OutOfArena`] when a build of that footprint would not fit.
    pub fn require(&self, footprint: Footprint) -> Result<(), OutOfArena> {
        if footprint.peak <= self.free.len() {
            return Ok(());
        }
        let used = self.used().saturating_add(self.missing);
        let needed = used.saturating_add(footprint.peak);
        Err(OutOfArena { needed, available: self.capacity })
    }

    /// Lends all free bytes as two stacks of `F` and `B`.
    pub fn scratch<F: Pod, B: Pod>(&mut self) -> Ends<'_, F, B> {
        let used = self.used();
        Ends::new(self.free, used, &mut self.high_water)
    }

    fn take(&mut self, bytes: usize) -> Result<&'m mut [u8], OutOfArena> {
        self.require(Footprint { kept: bytes, peak: bytes })?;
        let (part, rest) =
            core::mem::take(&mut self.free).split_at_mut_checked(bytes).unwrap_or_default();
        self.free = rest;
        self.high_water = self.high_water.max(self.used());
        Ok(part)
    }

    fn record(&mut self, name: &'static str, bytes: usize) {
        if bytes == 0 {
            return;
        }
        if let Some(part) = self.parts.iter_mut().find(|part| part.name == name) {
            part.bytes += bytes;
        } else if let Err(part) = self.parts.push(Part { name, bytes })
            && let Some(last) = self.parts.last_mut()
        {
            last.bytes += part.bytes;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(align(8))]
    struct Block([u8; 128]);

    #[test]
    fn parts_live_side_by_side_and_are_counted() {
        let mut block = Block([0; 128]);
        let mut arena = Arena::new(&mut block.0);
        let a = arena.keep::<u16>("small", 3).unwrap();
        let b = arena.keep::<u32>("great", 4).unwrap();
        a.fill(7);
        b.fill(9);
        assert_eq!((a.len(), b.len(), a[2], b[0]), (3, 4, 7, 9));
        arena.keep::<u8>("small", 1).unwrap();
        assert_eq!((arena.used(), arena.high_water(), arena.capacity()), (32, 32, 128));
        let expected = [Part { name: "small", bytes: 16 }, Part { name: "great", bytes: 16 }];
        assert_eq!(arena.parts(), expected);
    }

    #[test]
    fn too_little_says_how_much_and_takes_nothing() {
        let mut block = Block([0; 128]);
        let mut arena = Arena::new(&mut block.0[..64]);
        arena.keep::<u8>("first", 40).unwrap();
        let error = arena.keep::<u64>("second", 4).unwrap_err();
        assert_eq!(error, OutOfArena { needed: 72, available: 64 });
        assert_eq!(arena.available(), 24);
        let mut arena = Arena::new(&mut block.0[..72]);
        arena.keep::<u8>("first", 40).unwrap();
        assert!(arena.keep::<u64>("second", 4).is_ok());
        assert_eq!(arena.keep::<u64>("third", usize::MAX).unwrap_err().available, 72);
    }

    #[test]
    fn bytes_lost_to_alignment_are_reported() {
        let mut block = Block([0; 128]);
        let mut arena = Arena::new(&mut block.0[3..]);
        assert_eq!(arena.parts(), [Part { name: "alignment", bytes: 5 }]);
        assert!(arena.keep::<u64>("whole", 15).is_ok());
        let error = arena.keep::<u8>("none", 1).unwrap_err();
        assert_eq!(error, OutOfArena { needed: 133, available: 125 });
    }

    #[test]
    fn names_beyond_the_table_are_added_to_the_last() {
        const NAMES: [&str; 14] =
            ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n"];
        let mut block = Block([0; 128]);
        let mut arena = Arena::new(&mut block.0);
        for name in NAMES {
            arena.keep::<u64>(name, 1).unwrap();
        }
        assert_eq!(arena.parts().iter().map(|p| p.bytes).sum::<usize>(), arena.used());
        assert_eq!(arena.parts().last(), Some(&Part { name: "i", bytes: 48 }));
    }
}
