//! Cells whose places follow from their order: a succinct tree.
//!
//! G. Jacobson, "Space-efficient static trees and graphs", FOCS 1989: the cells of a tree in
//! breadth-first order need no links, a bit each says whether it is divided, and the children of the
//! n-th divided cell are the n-th family. A second bit says whether a leaf lists anything; only of
//! those that do is a place stored.

use super::storage::{Content, Storage};
use crate::memory::{Arena, OutOfArena};

/// Families whose places and children are counted from an entry of the directory.
const GROUP: usize = 8;

/// A family while the octree grows: a word to spare, so that packing never writes beyond what it has
/// read, and the words of the children.
type Loose = [u16; 9];

/// 2 bytes a divided cell and half a byte in the directory, and 2 a leaf that lists something. Going
/// down reads the bits of up to seven other cells.
#[derive(Debug)]
pub struct Implicit<'m> {
    root: u16,
    families: usize,
    /// Of every family: bits of the divided children, those of the full leaves above them, then the
    /// places of the lists of these.
    records: &'m [u16],
    /// Of every eighth family: where its record begins, and how many cells before it are divided.
    directory: &'m [[u16; 2]],
}

/// A family's record and what is behind it, and how many cells before it are divided.
#[derive(Clone, Copy, Debug)]
pub struct Family<'m> {
    record: &'m [u16],
    divided: usize,
}

impl Family<'_> {
    /// The bits of divided children, and those of full leaves.
    fn bits(&self) -> (u32, u32) {
        let bits = self.record.first().copied().unwrap_or_default();
        (u32::from(bits & 0xff), u32::from(bits >> 8))
    }

    /// The next family.
    fn next(self) -> Self {
        let (divided, full) = self.bits();
        let words = 1 + full.count_ones() as usize;
        Self {
            record: self.record.get(words..).unwrap_or_default(),
            divided: self.divided + divided.count_ones() as usize,
        }
    }
}

impl<'m> Storage<'m> for Implicit<'m> {
    type Cell = Content;
    type Family = Family<'m>;
    type Word = u16;
    type Block = Loose;

    const ANY_ORDER: bool = false;

    fn root(&self) -> Content {
        Content::of(self.root)
    }

    fn open(&self, cell: Content) -> Option<Family<'m>> {
        match cell {
            Content::Family(number) => self.family(number),
            Content::List(_) => None,
        }
    }

    fn child(family: Family<'m>, octant: u32) -> Content {
        let (divided, full) = family.bits();
        let bit = 1 << (octant & 7);
        let before = |bits: u32| (bits & (bit - 1)).count_ones() as usize;
        if divided & bit != 0 {
            // The root's family is the first.
            Content::Family(1 + family.divided + before(divided))
        } else if full & bit != 0 {
            let place = family.record.get(1 + before(full)).copied().unwrap_or_default();
            Content::List(place.into())
        } else {
            Content::List(0)
        }
    }

    fn content(cell: Content) -> Content {
        cell
    }

    fn count(&self) -> usize {
        self.families
    }

    fn family(&self, number: usize) -> Option<Family<'m>> {
        let [start, divided] = *self.directory.get(number / GROUP)?;
        let record = self.records.get(usize::from(start)..)?;
        let first = Family { record, divided: divided.into() };
        Some((0..number % GROUP).fold(first, |family, _| family.next()))
    }

    fn words(block: &Loose) -> &[u16; 8] {
        let [_, words @ ..] = block;
        words
    }

    fn words_mut(block: &mut Loose) -> &mut [u16; 8] {
        let [_, words @ ..] = block;
        words
    }

    fn index_bytes(families: usize) -> usize {
        families.div_ceil(GROUP) * size_of::<[u16; 2]>()
    }

    fn pack(families: &mut [Loose]) -> usize {
        let mut end = 0;
        for number in 0..families.len() {
            let words = families.get(number).map(Self::words).copied().unwrap_or_default();
            let records: &mut [u16] = bytemuck::cast_slice_mut(families);
            let first = end;
            let mut bits = 0;
            for (octant, word) in words.into_iter().enumerate() {
                match Content::of(word) {
                    Content::Family(_) => bits |= 1 << octant,
                    Content::List(0) => {}
                    Content::List(_) => {
                        bits |= 0x100 << octant;
                        end += 1;
                        if let Some(place) = records.get_mut(end) {
                            *place = word;
                        }
                    }
                }
            }
            if let Some(first) = records.get_mut(first) {
                *first = bits;
            }
            end += 1;
        }
        end.div_ceil(size_of::<Loose>() / size_of::<u16>())
    }

    fn packed(families: usize, full_leaves: usize) -> usize {
        (families + full_leaves).div_ceil(size_of::<Loose>() / size_of::<u16>())
    }

    fn keep(
        root: u16,
        families: usize,
        blocks: usize,
        arena: &mut Arena<'m>,
    ) -> Result<Self, OutOfArena> {
        let blocks: &[Loose] = arena.keep("octree cells", blocks)?;
        let records: &[u16] = bytemuck::cast_slice(blocks);
        let directory: &mut [[u16; 2]] = arena.keep("octree table", families.div_ceil(GROUP))?;
        let mut family = Family { record: records, divided: 0 };
        for entry in directory.iter_mut() {
            *entry = [(records.len() - family.record.len()) as u16, family.divided as u16];
            family = (0..GROUP).fold(family, |family, _| family.next());
        }
        Ok(Self { root, families, records, directory })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::octree::{Growth, Limits, Links, Octree};
    use crate::scene::Scene;
    use crate::shape::Sphere;
    use glam::{Vec3, vec3};

    #[repr(align(8))]
    struct Block([u8; 1 << 16]);

    #[test]
    fn cells_are_those_of_links() {
        // A ball in every corner: the root's family is full. Then fewer and fewer.
        let corner = |i: usize| vec3((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32);
        let spheres: [Sphere<f32>; 40] = core::array::from_fn(|i| match i {
            0..8 => Sphere::new(corner(i) * 8.0 - Vec3::splat(4.0), 0.5),
            _ => Sphere::new(vec3((i % 7) as f32, (i % 5) as f32, (i % 3) as f32) - 3.5, 0.6),
        });
        for count in [0, 1, 8, 20, 40] {
            let scene = Scene::new(&spheres[..count]).unwrap();
            for max_level in 0..6 {
                let growth = Growth::from(Limits { max_objects: 1, max_level });
                let (mut one, mut other) = (Block([0; 1 << 16]), Block([0xa5; 1 << 16]));
                let (mut one, mut other) = (Arena::new(&mut one.0), Arena::new(&mut other.0));
                type Linked<'m> = Octree<'m, f32, u16, Links<'m, u16>>;
                type Implied<'m> = Octree<'m, f32, u16, Implicit<'m>>;
                let links = Linked::build(&scene, growth, &mut one).unwrap();
                let implicit = Implied::build(&scene, growth, &mut other).unwrap();
                assert_eq!(links.interior_nodes(), implicit.interior_nodes());
                assert!(links.leaves().eq(implicit.leaves()), "{count} {max_level}");
                let footprint = Implied::footprint(&scene, growth).unwrap();
                assert_eq!(other.used(), footprint.kept, "{count} {max_level}");
                assert_eq!(other.high_water(), footprint.peak, "{count} {max_level}");
                if max_level == 5 && count == 40 {
                    assert!(other.used() < one.used());
                }
            }
        }
    }
}
