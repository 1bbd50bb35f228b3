//! Scratch memory of a build: two stacks that grow towards each other.

use super::footprint::part_bytes;
use bytemuck::Pod;
use core::cell::Cell;
use core::marker::PhantomData;

/// All free bytes of an arena, lent for a while: a stack of `F` grows up from the front, a stack of
/// `B` down from the back, until they meet.
///
/// The arena's high-water mark rises with them. When the loan ends the bytes are free again, and
/// what lies at the front is found in the parts that are kept next: a build that does not know its
/// size beforehand grows here and keeps what it came to.
#[derive(Debug)]
pub struct Ends<'s, F, B> {
    bytes: &'s mut [u8],
    front: usize,
    back: usize,
    used_before: usize,
    high_water: &'s mut usize,
    elements: PhantomData<(F, B)>,
}

impl<'s, F: Pod, B: Pod> Ends<'s, F, B> {
    pub(super) fn new(bytes: &'s mut [u8], used_before: usize, high_water: &'s mut usize) -> Self {
        // A whole number of elements from the back, so that the far end is aligned for them.
        let step = size_of::<u64>();
        let whole = bytes.len() / step * step;
        let (bytes, _) = bytes.split_at_mut_checked(whole).unwrap_or_default();
        Self { bytes, front: 0, back: 0, used_before, high_water, elements: PhantomData }
    }

    /// Grows the stacks by so many elements, provided that `reserve` bytes stay free between them.
    /// The new elements hold whatever was there. Returns whether there was room; without, nothing
    /// changes.
    #[must_use]
    pub fn grow(&mut self, front: usize, back: usize, reserve: usize) -> bool {
        let front = self.front.saturating_add(front);
        let back = self.back.saturating_add(back);
        let needed = bytes_of::<F, B>(front, back, reserve);
        if needed > self.bytes.len() {
            return false;
        }
        (self.front, self.back) = (front, back);
        *self.high_water = (*self.high_water).max(self.used_before + needed);
        true
    }

    /// Gives the last `count` elements of the back stack up.
    pub fn shrink_back(&mut self, count: usize) {
        self.back = self.back.saturating_sub(count);
    }

    /// Gives the last `count` elements of the front stack up.
    pub fn shrink_front(&mut self, count: usize) {
        self.front = self.front.saturating_sub(count);
    }

    /// Elements of the front stack.
    pub fn front_len(&self) -> usize {
        self.front
    }

    /// Elements of the back stack.
    pub fn back_len(&self) -> usize {
        self.back
    }

    /// Both stacks. The back one is seen in the order of memory: its newest elements come first.
    pub fn both(&mut self) -> (&mut [F], &mut [B]) {
        let middle = self.front * size_of::<F>();
        let (front, rest) = self.bytes.split_at_mut_checked(middle).unwrap_or_default();
        let start = rest.len().saturating_sub(self.back * size_of::<B>());
        let back = rest.get_mut(start..).unwrap_or_default();
        (
            bytemuck::try_cast_slice_mut(front).unwrap_or_default(),
            bytemuck::try_cast_slice_mut(back).unwrap_or_default(),
        )
    }

    /// Ends the loan: the back stack moves down to follow the front one and a gap of `gap` bytes,
    /// each starting where [`Arena::keep`](super::Arena::keep) will find it.
    pub fn close_up(self, gap: usize) {
        let to = part_bytes::<F>(self.front) + part_bytes::<u8>(gap);
        if let Some(rest) = self.bytes.get_mut(to..)
            && let Ok(rest) = bytemuck::try_cast_slice_mut::<u8, B>(rest)
            && let Some(from) = rest.len().checked_sub(self.back)
        {
            // One by one: `memmove` alone is 0.8 KB on a Cortex-M0.
            let places = Cell::from_mut(rest).as_slice_of_cells();
            for i in 0..self.back {
                let (Some(from), Some(to)) = (places.get(from + i), places.get(i)) else { break };
                to.set(from.get());
            }
        }
    }
}

/// Bytes that two stacks and a reserve between them take in an arena.
pub(crate) fn bytes_of<F, B>(front: usize, back: usize, reserve: usize) -> usize {
    part_bytes::<F>(front)
        .saturating_add(part_bytes::<u8>(reserve))
        .saturating_add(part_bytes::<B>(back))
}

#[cfg(test)]
mod tests {
    use crate::memory::Arena;

    #[repr(align(8))]
    struct Block([u8; 64]);

    #[test]
    fn stacks_meet_and_the_high_water_mark_stays() {
        let mut block = Block([0; 64]);
        let mut arena = Arena::new(&mut block.0);
        arena.keep::<u64>("before", 1).unwrap();
        let mut ends = arena.scratch::<u32, u16>();
        assert!(ends.grow(3, 5, 0)); // 16 + 16 bytes
        assert!(!ends.grow(8, 0, 0)); // 48 + 16 of 56
        assert!(!ends.grow(0, 0, 32));
        assert!(ends.grow(6, 0, 0));
        ends.shrink_back(4);
        assert_eq!((ends.front_len(), ends.back_len()), (9, 1));
        let (front, back) = ends.both();
        assert_eq!((front.len(), back.len()), (9, 1));
        assert_eq!((arena.used(), arena.high_water()), (8, 64));
    }

    #[test]
    fn what_was_built_is_found_in_what_is_kept() {
        let mut block = Block([0; 64]);
        let mut arena = Arena::new(&mut block.0);
        let mut ends = arena.scratch::<u32, u16>();
        assert!(ends.grow(3, 2, 8));
        let (front, back) = ends.both();
        front.copy_from_slice(&[1, 2, 3]);
        back.copy_from_slice(&[20, 10]);
        ends.close_up(8);
        assert_eq!(arena.keep::<u32>("front", 3).unwrap(), [1, 2, 3]);
        arena.keep::<u8>("gap", 8).unwrap();
        assert_eq!(arena.keep::<u16>("back", 2).unwrap(), [20, 10]);
    }
}
