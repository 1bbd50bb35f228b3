//! How an octree's cells are stored: by links, by names in a hash table, or implied by their order
//! ([`Implicit`](super::Implicit)).
//!
//! Either way a cell is a *word*, and the words of the eight children of a divided cell lie together
//! as a *family*. A word's highest bit says whether its cell is divided. The rest is the number of
//! the family, or for a leaf the place of its list, counted from the end of all lists; 0 when the
//! leaf lists nothing. A list is its length, then its ids in ascending order.

use super::code::Code;
use crate::accel::Id;
use crate::memory::{Arena, OutOfArena};
use bytemuck::Pod;
use core::fmt::Debug;

/// What a word says of its cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// A leaf and the place of its list.
    List(usize),
    /// Divided; the number of its family.
    Family(usize),
}

impl Content {
    /// Reads a word.
    pub(super) fn of<W: Id>(word: W) -> Self {
        let (word, divided) = (word.get(), most::<W>() + 1);
        if word & divided == 0 { Self::List(word) } else { Self::Family(word & !divided) }
    }

    /// Writes it as a word; numbers are at most [`most`].
    pub(super) fn word<W: Id>(self) -> W {
        match self {
            Self::List(place) => W::new(place),
            Self::Family(number) => W::new(number | (most::<W>() + 1)),
        }
    }
}

/// The greatest number that fits a word beside the highest bit.
pub(super) const fn most<W: Id>() -> usize {
    W::MAX / 2
}

/// Where an octree's cells lie.
pub trait Storage<'m>: Debug + Sized {
    /// A cell as a walk holds it.
    type Cell: Copy + Debug;
    /// The children of a divided cell.
    type Family: Copy + Debug;
    /// The numbers that cells are stored in.
    type Word: Id;
    /// A family as it lies in memory; its last eight words are those of the children.
    type Block: Pod;

    /// The cell that contains all others.
    fn root(&self) -> Self::Cell;
    /// The children of a cell, if it is divided.
    fn open(&self, cell: Self::Cell) -> Option<Self::Family>;
    /// The child in octant 0 to 7.
    fn child(family: Self::Family, octant: u32) -> Self::Cell;
    /// What a cell's word says.
    fn content(cell: Self::Cell) -> Content;
    /// Number of families.
    fn count(&self) -> usize;
    /// The family of a number: the oldest has 0.
    fn family(&self, number: usize) -> Option<Self::Family>;
    /// The words of a family's children.
    fn words(block: &Self::Block) -> &[Self::Word; 8];
    /// The words of a family's children.
    fn words_mut(block: &mut Self::Block) -> &mut [Self::Word; 8];
    /// Notes the name of the cell whose children these are.
    fn name(_block: &mut Self::Block, _name: u32) {}
    /// Bytes that finding so many families takes besides the families.
    fn index_bytes(_families: usize) -> usize {
        0
    }
    /// Whether families may be numbered in another order than that of the cells whose children they
    /// are. Where not, octrees grow breadth-first.
    const ANY_ORDER: bool = true;
    /// Brings families into the form in which they stay; the number of blocks that they take then.
    fn pack(families: &mut [Self::Block]) -> usize {
        families.len()
    }
    /// What [`Storage::pack`] gives for so many families with so many leaves that list something.
    fn packed(families: usize, _full_leaves: usize) -> usize {
        families
    }
    /// Keeps so many families, packed into so many blocks, that a build left at the front of an arena.
    ///
    /// # Errors
    /// [`OutOfArena`].
    fn keep(
        root: Self::Word,
        families: usize,
        blocks: usize,
        arena: &mut Arena<'m>,
    ) -> Result<Self, OutOfArena>;
}

/// Words name their families by number: going down takes one access. 8 words a divided cell.
#[derive(Debug)]
pub struct Links<'m, W> {
    root: W,
    families: &'m [[W; 8]],
}

impl<'m, W: Id> Storage<'m> for Links<'m, W> {
    type Cell = W;
    type Family = &'m [W; 8];
    type Word = W;
    type Block = [W; 8];

    fn root(&self) -> W {
        self.root
    }

    fn open(&self, cell: W) -> Option<&'m [W; 8]> {
        match Content::of(cell) {
            Content::Family(number) => self.families.get(number),
            Content::List(_) => None,
        }
    }

    fn child(family: &'m [W; 8], octant: u32) -> W {
        family.get((octant & 7) as usize).copied().unwrap_or(W::new(0))
    }

    fn content(cell: W) -> Content {
        Content::of(cell)
    }

    fn count(&self) -> usize {
        self.families.len()
    }

    fn family(&self, number: usize) -> Option<&'m [W; 8]> {
        self.families.get(number)
    }

    fn words(block: &[W; 8]) -> &[W; 8] {
        block
    }

    fn words_mut(block: &mut [W; 8]) -> &mut [W; 8] {
        block
    }

    fn keep(root: W, families: usize, _: usize, arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        Ok(Self { root, families: arena.keep("octree cells", families)? })
    }
}

/// A family under its parent's name, which comes first.
type Named = [u32; 9];

/// Families are found by the names of their cells in a hash table, as in A. Glassner, "Space
/// subdivision for fast ray tracing", IEEE CG&A 4(10) (1984): what a word says of a divided cell is
/// not used. 36 bytes a divided cell, and 6 in the table.
#[derive(Debug)]
pub struct Hashed<'m> {
    root: u32,
    families: &'m [Named],
    /// Open addressing: number of a family plus 1, or 0.
    table: &'m [u32],
}

/// Slots of the table for so many families: a third of them stays free, which keeps the chains of
/// probes short.
fn slots_for(families: usize) -> usize {
    families + families / 2 + usize::from(families > 0)
}

/// Where a name's search in a table begins: multiplication by the golden ratio spreads names that
/// differ in few digits (D. Knuth, The Art of Computer Programming 3, 6.4).
fn home(name: u32, slots: usize) -> usize {
    let hash = name.wrapping_mul(0x9e37_79b9);
    ((u64::from(hash) * slots as u64) >> 32) as usize
}

impl<'m> Storage<'m> for Hashed<'m> {
    /// Name and word.
    type Cell = (u32, u32);
    type Family = &'m Named;
    type Word = u32;
    type Block = Named;

    fn root(&self) -> (u32, u32) {
        (Code::ROOT.0, self.root)
    }

    fn open(&self, (name, word): (u32, u32)) -> Option<&'m Named> {
        if let Content::List(_) = Content::of(word) {
            return None;
        }
        let slots = self.table.len();
        let mut slot = home(name, slots);
        for _ in 0..slots {
            let number = *self.table.get(slot)?;
            let family = self.families.get((number as usize).checked_sub(1)?)?;
            if family[0] == name {
                return Some(family);
            }
            slot = if slot + 1 == slots { 0 } else { slot + 1 };
        }
        None
    }

    fn child(family: &'m Named, octant: u32) -> (u32, u32) {
        let word = family.get(1 + (octant & 7) as usize).copied().unwrap_or_default();
        (Code(family[0]).child(octant).0, word)
    }

    fn content((_, word): (u32, u32)) -> Content {
        Content::of(word)
    }

    fn count(&self) -> usize {
        self.families.len()
    }

    fn family(&self, number: usize) -> Option<&'m Named> {
        self.families.get(number)
    }

    fn words(block: &Named) -> &[u32; 8] {
        let [_, words @ ..] = block;
        words
    }

    fn words_mut(block: &mut Named) -> &mut [u32; 8] {
        let [_, words @ ..] = block;
        words
    }

    fn name(block: &mut Named, name: u32) {
        block[0] = name;
    }

    fn index_bytes(families: usize) -> usize {
        slots_for(families) * size_of::<u32>()
    }

    fn keep(
        root: u32,
        families: usize,
        _: usize,
        arena: &mut Arena<'m>,
    ) -> Result<Self, OutOfArena> {
        let families: &[Named] = arena.keep("octree cells", families)?;
        let table: &mut [u32] = arena.keep("octree table", slots_for(families.len()))?;
        table.fill(0);
        let slots = table.len();
        for (number, family) in (1..).zip(families) {
            let mut slot = home(family[0], slots);
            for _ in 0..slots {
                match table.get_mut(slot) {
                    Some(free) if *free == 0 => {
                        *free = number;
                        break;
                    }
                    _ => slot = if slot + 1 == slots { 0 } else { slot + 1 },
                }
            }
        }
        Ok(Self { root, families, table })
    }
}
