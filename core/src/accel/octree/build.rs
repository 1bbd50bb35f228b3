//! Growing an octree breadth-first into a memory budget.
//!
//! Cells are divided level by level, within a level in the order of their names: first in, first
//! out. A division happens whole or not at all; once one does not fit, all further candidates stay
//! leaves. The list of a divided cell is given up: at the end of every level, and whenever memory
//! runs out, the remaining lists close up.

use super::code::DEEPEST;
use super::cursor::{Cursor, Slot};
use super::footprint::bytes;
use super::growth::{Growth, Limits, Order, StoppedBy};
use super::storage::{Content, Storage, most};
use super::{Octree, list_at};
use crate::accel::lattice::{self, Lattice};
use crate::accel::listing::{Aside, ByBox, Listing, Overlap};
use crate::accel::{BuildError, Id};
use crate::memory::{Arena, Ends, Footprint};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// The room an octree divides, and what is left out of it.
///
/// # Errors
/// [`BuildError::TooMany`], [`BuildError::TooDeep`].
pub(super) fn room<R: Real, S: Shapes<R>, I: Id, L>(
    scene: &Scene<'_, R, S>,
    Growth { limits, huge, .. }: Growth<L>,
) -> Result<(Lattice<R>, Aside), BuildError> {
    let deepest = limits.max_level;
    if deepest > DEEPEST {
        return Err(BuildError::TooDeep { level: deepest, limit: DEEPEST });
    }
    // A list begins with its length, so that has to fit as well as the ids.
    BuildError::unless_fits::<I>("shapes", scene.shapes().bounded())?;
    let (aside, bounds) = Aside::of(scene, huge);
    let root = lattice::root(bounds, scene.pad(), 32, 32);
    Ok((Lattice::new(root, [1 << deepest; 3], scene.pad()), aside))
}

/// Which children of a cell list a shape, as bits 0 to 7; 0 when the cell itself does not.
pub(super) fn touches<R: Real, S: Shapes<R>>(
    lattice: &Lattice<R>,
    scene: &Scene<'_, R, S>,
    making: impl Listing,
    id: usize,
    base: [i32; 3],
    edge: i32,
) -> u32 {
    let (first, last) = lattice.cells_of(scene.shapes().bounds(id));
    let half = edge / 2;
    // The octants that are upper halves along each axis.
    const UPPER: [u32; 3] = [0b1010_1010, 0b1100_1100, 0b1111_0000];
    let mut touched = 0b1111_1111;
    for (((first, last), base), upper) in first.iter().zip(last).zip(base).zip(UPPER) {
        let middle = base + half;
        let below = if *first < middle && last >= base { !upper } else { 0 };
        let above = if *first < base + edge && last >= middle { upper } else { 0 };
        touched &= below | above;
    }
    if making.overlap() == Overlap::Box {
        return touched;
    }
    let [x, y, z] = base;
    let lists = |octant: u32| {
        let corner = |base: i32, bit: u32| base + (octant >> bit & 1) as i32 * half;
        let room = lattice.room([corner(x, 0), corner(y, 1), corner(z, 2)], [half.max(1); 3]);
        touched >> octant & 1 != 0 && scene.shapes().overlaps(id, &room)
    };
    (0..8).filter(|octant| lists(*octant)).fold(0, |lists, octant| lists | 1 << octant)
}

/// Whether a cell lists a shape: the root lists all.
pub(super) fn is_listed<R: Real, S: Shapes<R>>(
    lattice: &Lattice<R>,
    scene: &Scene<'_, R, S>,
    making: impl Listing,
    id: usize,
    base: [i32; 3],
    edge: i32,
) -> bool {
    let [all, _, _] = lattice.count();
    touches(lattice, scene, ByBox, id, base, edge) != 0
        && (making.overlap() == Overlap::Box
            || edge == all
            || scene.shapes().overlaps(id, &lattice.room(base, [edge; 3])))
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Octree<'m, R, I, C> {
    /// Builds an octree over the bounded shapes of a scene, as fine as the limits, the free bytes
    /// of the arena and the numbers that fit its words allow.
    ///
    /// # Errors
    /// [`BuildError::Memory`] when not even a single cell that lists every shape fits;
    /// [`BuildError::TooMany`], [`BuildError::TooDeep`].
    pub fn build<S: Shapes<R>, L: Listing>(
        scene: &Scene<'_, R, S>,
        growth: impl Into<Growth<L>>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        Self::build_in_words(scene, growth.into(), arena, true)
    }

    /// As [`Octree::build`]. Unless that is allowed, the words may not be what stops the division:
    /// then nothing is taken.
    ///
    /// # Errors
    /// As [`Octree::build`], and [`BuildError::TooMany`] when the words are too narrow.
    pub(crate) fn build_in_words<S: Shapes<R>, L: Listing>(
        scene: &Scene<'_, R, S>,
        growth: Growth<L>,
        arena: &mut Arena<'m>,
        may_stop: bool,
    ) -> Result<Self, BuildError> {
        let (lattice, aside) = room::<R, S, I, L>(scene, growth)?;
        let limits = growth.limits;
        let shapes = scene.shapes().bounded() - aside.count();
        let entries = shapes + usize::from(shapes > 0);
        let fits =
            |count| BuildError::unless_above("octree list entries", count, most::<C::Word>());
        fits(entries)?;
        let least = bytes::<C, I>(0, entries);
        arena.require(Footprint { kept: least, peak: least })?;

        let ends = arena.scratch::<C::Block, I>();
        let (root, max_level) = (Content::List(0), 0);
        let making = growth.lists;
        let mut growing =
            Growing::<R, S, I, C, L> { lattice, scene, making, limits, root, max_level, ends };
        growing.plant(shapes, &aside);
        let grown = match growth.order {
            Order::Benefit if C::ANY_ORDER => growing.grow_by_benefit(),
            _ => growing.grow(),
        };
        let stopped_by = match grown {
            Ok(stopped_by) => stopped_by,
            Err(Refusal::Words(count)) if !may_stop => fits(count).map(|()| StoppedBy::Memory)?,
            Err(_) => StoppedBy::Memory,
        };
        let max_level = growing.max_level;
        let (root, families, blocks, entries) = growing.close_up();
        let cells = C::keep(root.word::<C::Word>(), families, blocks, arena)?;
        let lists: &mut [I] = arena.keep("octree lists", entries)?;
        let deepest = limits.max_level;
        Ok(Self { lattice, deepest, max_level, stopped_by, cells, lists, aside: aside.stored() })
    }
}

/// Why a cell is not divided.
pub(super) enum Refusal {
    Memory,
    /// The words would have to hold so much.
    Words(usize),
}

pub(super) struct Growing<'g, 's, 'm, R: Real, S, I, C: Storage<'m>, L> {
    lattice: Lattice<R>,
    scene: &'g Scene<'s, R, S>,
    pub(super) making: L,
    pub(super) limits: Limits,
    root: Content,
    /// Level of the deepest leaf.
    max_level: u32,
    /// Families at the front, lists at the back, newest nearest to the middle.
    pub(super) ends: Ends<'g, C::Block, I>,
}

impl<'m, R: Real, S: Shapes<R>, I: Id, C: Storage<'m>, L: Listing>
    Growing<'_, '_, 'm, R, S, I, C, L>
{
    /// The root: one cell that lists every shape.
    fn plant(&mut self, shapes: usize, aside: &Aside) {
        if shapes > 0 && self.ends.grow(0, shapes + 1, 0) {
            let (_, lists) = self.ends.both();
            if let Some((length, ids)) = lists.split_first_mut() {
                *length = I::new(shapes);
                let listed = (0..).filter(|id| !aside.contains(*id));
                for (id, place) in listed.zip(ids) {
                    *place = I::new(id);
                }
            }
            self.root = Content::List(shapes + 1);
        }
    }

    /// Divides candidates, first in first out, until done or something refuses.
    fn grow(&mut self) -> Result<StoppedBy, Refusal> {
        let mut stopped_by = StoppedBy::Done;
        for level in 0..=self.limits.max_level {
            self.close_gaps();
            let mut cursor = Cursor::ROOT;
            loop {
                match self.content(cursor.slot()) {
                    Some(Content::Family(family)) if cursor.level() < level => {
                        cursor.down(family);
                        continue;
                    }
                    Some(Content::List(place)) if cursor.level() == level => {
                        if self.count(place) <= self.limits.max_objects {
                            // Few enough.
                        } else if level == self.limits.max_level {
                            stopped_by = StoppedBy::Level;
                        } else {
                            self.divide_somehow(&cursor)?;
                        }
                    }
                    _ => {}
                }
                if !cursor.next() {
                    break;
                }
            }
            if self.max_level < level {
                break;
            }
        }
        Ok(stopped_by)
    }

    /// What a cell is; `None` beyond the last.
    pub(super) fn content(&mut self, slot: Slot) -> Option<Content> {
        let Slot::Child(family, octant) = slot else { return Some(self.root) };
        let (families, _) = self.ends.both();
        C::words(families.get(family)?).get(octant).copied().map(Content::of)
    }

    pub(super) fn set(&mut self, slot: Slot, content: Content) {
        let Slot::Child(family, octant) = slot else {
            self.root = content;
            return;
        };
        let (families, _) = self.ends.both();
        let words = families.get_mut(family).map(C::words_mut);
        if let Some(word) = words.and_then(|words| words.get_mut(octant)) {
            *word = content.word();
        }
    }

    /// How many shapes a list has.
    pub(super) fn count(&mut self, place: usize) -> usize {
        let (_, lists) = self.ends.both();
        list_at(lists, place).len()
    }

    /// Divides a leaf, if need be after what is given up has been taken back.
    pub(super) fn divide_somehow(&mut self, cursor: &Cursor) -> Result<(), Refusal> {
        match self.divide(cursor) {
            Err(Refusal::Memory) => {
                self.close_gaps();
                self.divide(cursor)
            }
            result => result,
        }
    }

    /// How many shapes of a list each child of a cell would list, and which of the children before it
    /// would list the same, as bits.
    pub(super) fn counts(&mut self, cursor: &Cursor, place: usize) -> ([usize; 8], [u32; 8]) {
        let (base, edge) = cursor.code().place(self.limits.max_level);
        let (lattice, scene, making) = (self.lattice, self.scene, self.making);
        let mut counts = [0_usize; 8];
        // Bit b of number a: whether a shape is in one of the lists of a and b only.
        let mut differ = [0_u32; 8];
        let (_, lists) = self.ends.both();
        for id in list_at(lists, place) {
            let octants = touches(&lattice, scene, making, id.get(), base, edge);
            for (octant, (count, differ)) in counts.iter_mut().zip(&mut differ).enumerate() {
                *count += (octants >> octant & 1) as usize;
                if making.shares() {
                    *differ |= if octants >> octant & 1 != 0 { !octants } else { octants };
                }
            }
        }
        let mut equal = [0; 8];
        if making.shares() {
            for (octant, (equal, differ)) in equal.iter_mut().zip(differ).enumerate() {
                *equal = !differ & ((1 << octant) - 1);
            }
        }
        (counts, equal)
    }

    /// Divides a leaf; changes nothing when that does not fit.
    fn divide(&mut self, cursor: &Cursor) -> Result<(), Refusal> {
        let slot = cursor.slot();
        let Some(Content::List(place)) = self.content(slot) else { return Ok(()) };
        let (base, edge) = cursor.code().place(self.limits.max_level);
        let (lattice, scene, making) = (self.lattice, self.scene, self.making);
        let octants = |id: &I| touches(&lattice, scene, making, id.get(), base, edge);

        let (counts, equal) = self.counts(cursor, place);
        let is_own = |equal: u32| !making.shares() || equal == 0;
        let own = |(count, equal): (&usize, &u32)| if is_own(*equal) { *count } else { 0 };
        let entries_of = |count: usize| count + usize::from(count > 0);
        let entries: usize = counts.iter().zip(&equal).map(own).map(entries_of).sum();
        let (number, old) = (self.ends.front_len(), self.ends.back_len());
        let greatest = number.max(old + entries);
        if greatest > most::<C::Word>() {
            return Err(Refusal::Words(greatest));
        }
        if !self.ends.grow(1, entries, C::index_bytes(number + 1)) {
            return Err(Refusal::Memory);
        }

        let (families, lists) = self.ends.both();
        let (new, old_lists) = lists.split_at_mut_checked(entries).unwrap_or_default();
        let Some(family) = families.last_mut() else { return Ok(()) };
        C::name(family, cursor.code().0);
        // The first child's list is the oldest of the new ones: it lies last.
        let mut end = old;
        let mut next = [0; 8];
        let mut places = [0; 8];
        let children = C::words_mut(family).iter_mut().zip(&mut next);
        for (octant, ((count, equal), (child, next))) in
            counts.iter().zip(&equal).zip(children).enumerate()
        {
            *child = Content::List(0).word();
            if *count == 0 {
                continue;
            }
            if !is_own(*equal) {
                let first = equal.trailing_zeros() as usize;
                *child = Content::List(places.get(first).copied().unwrap_or_default()).word();
                continue;
            }
            end += count + 1;
            *child = Content::List(end).word();
            if making.shares()
                && let Some(place) = places.get_mut(octant)
            {
                *place = end;
            }
            let start = new.len().saturating_sub(end - old);
            if let Some(length) = new.get_mut(start) {
                *length = I::new(*count);
            }
            *next = start + 1;
        }
        for id in list_at(old_lists, place) {
            let octants = octants(id);
            for (octant, (next, equal)) in next.iter_mut().zip(&equal).enumerate() {
                if octants >> octant & 1 != 0 && is_own(*equal) {
                    if let Some(place) = new.get_mut(*next) {
                        *place = *id;
                    }
                    *next += 1;
                }
            }
        }
        self.max_level = self.max_level.max(cursor.level() + 1);
        self.set(slot, Content::Family(number));
        Ok(())
    }

    /// Brings everything to where it stays. Gives the root, the number of families, that of the blocks
    /// that they take, and that of list entries.
    fn close_up(mut self) -> (Content, usize, usize, usize) {
        self.close_gaps();
        if self.making.shares() {
            self.share();
        }
        let (families, entries) = (self.ends.front_len(), self.ends.back_len());
        let blocks = C::pack(self.ends.both().0);
        self.ends.shrink_front(families - blocks);
        self.ends.close_up(C::index_bytes(families));
        (self.root, families, blocks, entries)
    }
}
