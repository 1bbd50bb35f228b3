//! Growing an octree breadth-first into a memory budget.
//!
//! Candidates for division are taken first in, first out. Cells are stored in the order in which
//! they come to be, so the queue needs no memory: it is a mark that moves over them. A division
//! happens whole or not at all; once one does not fit, all further candidates stay leaves. The list
//! of a divided cell is given up: at the end of every level, and whenever memory runs out, the
//! remaining lists close up.

use super::code::{Code, DEEPEST};
use super::{DIVIDED, Family, Octree, Word, home, slots_for};
use crate::accel::lattice::{self, Lattice};
use crate::accel::{BuildError, Id};
use crate::memory::{Arena, Ends, Footprint, ends_bytes};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// When a cell is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// A cell with more shapes than this is divided.
    pub max_objects: usize,
    /// No cell is deeper than this; the root is level 0. At most [`DEEPEST`].
    pub max_level: u32,
}

/// Why the division of cells ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoppedBy {
    /// No leaf has more shapes than the limit.
    Done,
    /// Leaves with more shapes are at the limit of depth.
    Level,
    /// The next division did not fit the memory.
    Memory,
}

/// The octree's numbers, counted without memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Level {
    /// Cells that are divided.
    divided: usize,
    /// Entries of the lists of divided cells, lengths included.
    passing: usize,
    /// Entries of the lists of leaves, lengths included.
    staying: usize,
}

impl<R: Real, I: Id> Octree<'_, R, I> {
    /// Bytes that building without shortage takes: with a free arena of so many the octree is
    /// divided up to its limits, and the high-water mark is exactly that.
    ///
    /// Needs no memory, therefore looks at every shape for every cell: time in proportion to the
    /// number of cells times the number of shapes.
    ///
    /// # Errors
    /// [`BuildError::TooMany`], [`BuildError::TooDeep`].
    pub fn footprint<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        limits: Limits,
    ) -> Result<Footprint, BuildError> {
        let deepest = check::<R, S, I>(scene, limits)?;
        let lattice = lattice_of(scene, deepest);
        let mut levels = [Level::default(); DEEPEST as usize + 1];
        let mut next = Some(Code::ROOT);
        while let Some(code) = next {
            let (base, edge) = code.place(deepest);
            let shapes = 0..scene.shapes().bounded();
            let inside = |id: &usize| touches(&lattice, scene, *id, base, edge) != 0;
            let count = shapes.filter(inside).count();
            let entries = count + usize::from(count > 0);
            let divide = count > limits.max_objects && code.level() < deepest;
            if let Some(level) = levels.get_mut(code.level() as usize) {
                level.divided += usize::from(divide);
                *(if divide { &mut level.passing } else { &mut level.staying }) += entries;
            }
            next = if divide { Some(code.child(0)) } else { code.next() };
        }
        // While a level is divided, the lists of all leaves above, its own lists and those of the
        // next level are there.
        let (mut families, mut above, mut peak) = (0, 0, 0);
        for (level, below) in levels.iter().zip(levels.iter().skip(1).chain([&Level::default()])) {
            families += level.divided;
            let lists = above + level.passing + level.staying + below.passing + below.staying;
            peak = peak.max(bytes::<I>(families, lists));
            above += level.staying;
        }
        Ok(Footprint { kept: bytes::<I>(families, above), peak })
    }
}

/// Bytes of so many families with their table, and so many list entries.
fn bytes<I>(families: usize, entries: usize) -> usize {
    ends_bytes::<Family, I>(families, entries, slots_for(families) * size_of::<u32>())
}

fn check<R: Real, S: Shapes<R>, I: Id>(
    scene: &Scene<'_, R, S>,
    limits: Limits,
) -> Result<u32, BuildError> {
    if limits.max_level > DEEPEST {
        return Err(BuildError::TooDeep { level: limits.max_level, limit: DEEPEST });
    }
    // A list begins with its length, so that has to fit as well as the ids.
    BuildError::unless_fits::<I>("shapes", scene.shapes().bounded())?;
    Ok(limits.max_level)
}

fn lattice_of<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, deepest: u32) -> Lattice<R> {
    Lattice::new(lattice::root(scene, 32, 32), [1 << deepest; 3], scene.pad())
}

/// Which children of a cell a shape touches, as bits 0 to 7; 0 when it does not touch the cell.
fn touches<R: Real, S: Shapes<R>>(
    lattice: &Lattice<R>,
    scene: &Scene<'_, R, S>,
    id: usize,
    base: [i32; 3],
    edge: i32,
) -> u32 {
    let (first, last) = lattice.cells_of(scene.shapes().bounds(id));
    let half = edge / 2;
    // Bit 0: the lower half along an axis, bit 1: the upper one.
    let halves = |first: i32, last: i32, base: i32| {
        let lower = first < base + half && last >= base;
        let upper = first < base + edge && last >= base + half;
        u32::from(lower) | u32::from(upper) << 1
    };
    let [x, y, z] =
        [0, 1, 2].map(|axis: usize| match (first.get(axis), last.get(axis), base.get(axis)) {
            (Some(first), Some(last), Some(base)) => halves(*first, *last, *base),
            _ => 0,
        });
    let spread = |halves: u32, lower: u32, upper: u32| {
        (if halves & 1 != 0 { lower } else { 0 }) | (if halves & 2 != 0 { upper } else { 0 })
    };
    spread(x, 0b0101_0101, 0b1010_1010)
        & spread(y, 0b0011_0011, 0b1100_1100)
        & spread(z, 0b0000_1111, 0b1111_0000)
}

impl<'m, R: Real, I: Id> Octree<'m, R, I> {
    /// Builds an octree over the bounded shapes of a scene, as fine as the limits and the free
    /// bytes of the arena allow.
    ///
    /// # Errors
    /// [`BuildError::Memory`] when not even a single cell that lists every shape fits;
    /// [`BuildError::TooMany`], [`BuildError::TooDeep`].
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        limits: Limits,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let deepest = check::<R, S, I>(scene, limits)?;
        let lattice = lattice_of(scene, deepest);
        let shapes = scene.shapes().bounded();
        let entries = shapes + usize::from(shapes > 0);
        let least = bytes::<I>(0, entries);
        arena.require(Footprint { kept: least, peak: least })?;

        let ends = arena.scratch::<Family, I>();
        let mut growing = Growing { lattice, scene, limits, deepest, root: 0, ends };
        growing.plant(shapes);
        let stopped_by = growing.grow();
        let (root, families, entries) = growing.close_up();

        let families: &mut [Family] = arena.keep("octree cells", families)?;
        let table: &mut [u32] = arena.keep("octree table", slots_for(families.len()))?;
        let lists: &mut [I] = arena.keep("octree lists", entries)?;
        fill(table, families);
        Ok(Self { lattice, deepest, stopped_by, root, families, table, lists })
    }
}

/// Enters all families into the table.
fn fill(table: &mut [u32], families: &[Family]) {
    table.fill(0);
    let slots = table.len();
    for (number, family) in families.iter().enumerate() {
        let mut slot = home(Code(family[0]), slots);
        for _ in 0..slots {
            match table.get_mut(slot) {
                Some(free) if *free == 0 => {
                    *free = number as u32 + 1;
                    break;
                }
                _ => slot = if slot + 1 == slots { 0 } else { slot + 1 },
            }
        }
    }
}

/// A cell while the tree grows.
#[derive(Clone, Copy)]
struct Place {
    /// Number of the family plus 1; 0 for the root, which is in none.
    family: usize,
    octant: u32,
}

impl Place {
    const ROOT: Self = Self { family: 0, octant: 0 };

    /// The cell that came to be after this one.
    fn next(self) -> Self {
        if self.family > 0 && self.octant < 7 {
            Self { octant: self.octant + 1, ..self }
        } else {
            Self { family: self.family + 1, octant: 0 }
        }
    }
}

struct Growing<'g, 's, R: Real, S, I> {
    lattice: Lattice<R>,
    scene: &'g Scene<'s, R, S>,
    limits: Limits,
    deepest: u32,
    root: Word,
    /// Families at the front, lists at the back, newest nearest to the middle.
    ends: Ends<'g, Family, I>,
}

impl<R: Real, S: Shapes<R>, I: Id> Growing<'_, '_, R, S, I> {
    /// The root: one cell that lists every shape.
    fn plant(&mut self, shapes: usize) {
        if shapes > 0 && self.ends.grow(0, shapes + 1, 0) {
            let (_, lists) = self.ends.both();
            if let Some((length, ids)) = lists.split_first_mut() {
                *length = I::new(shapes);
                for (id, place) in ids.iter_mut().enumerate() {
                    *place = I::new(id);
                }
            }
            self.root = shapes as Word + 1;
        }
    }

    /// Divides candidates, first in first out, until done or out of memory.
    fn grow(&mut self) -> StoppedBy {
        let mut stopped_by = StoppedBy::Done;
        let mut place = Place::ROOT;
        let mut level = 0;
        while let Some((code, _)) = self.cell(place) {
            if code.level() > level {
                level = code.level();
                self.close_gaps();
            }
            if self.count(place) > self.limits.max_objects {
                if code.level() >= self.deepest {
                    stopped_by = StoppedBy::Level;
                } else if !self.divide(place, code) {
                    self.close_gaps();
                    if !self.divide(place, code) {
                        return StoppedBy::Memory;
                    }
                }
            }
            place = place.next();
        }
        stopped_by
    }

    /// The name and the word of a cell.
    fn cell(&mut self, place: Place) -> Option<(Code, Word)> {
        let Some(family) = place.family.checked_sub(1) else {
            return Some((Code::ROOT, self.root));
        };
        let (families, _) = self.ends.both();
        let family = families.get(family)?;
        let word = family.get(1 + place.octant as usize)?;
        Some((Code(family[0]).child(place.octant), *word))
    }

    fn set(&mut self, place: Place, word: Word) {
        match place.family.checked_sub(1) {
            None => self.root = word,
            Some(family) => {
                let (families, _) = self.ends.both();
                let words = families.get_mut(family);
                if let Some(old) = words.and_then(|w| w.get_mut(1 + place.octant as usize)) {
                    *old = word;
                }
            }
        }
    }

    /// How many shapes a leaf lists.
    fn count(&mut self, place: Place) -> usize {
        let word = self.cell(place).map_or(0, |(_, word)| word);
        let (_, lists) = self.ends.both();
        list_of(lists, word).map_or(0, |list| list.len())
    }

    /// Divides a leaf; false, and nothing changed, when that does not fit.
    fn divide(&mut self, place: Place, code: Code) -> bool {
        let Some((_, word)) = self.cell(place) else { return false };
        let (base, edge) = code.place(self.deepest);
        let (lattice, scene) = (self.lattice, self.scene);
        let octants = |id: &I| touches(&lattice, scene, id.get(), base, edge);

        let mut counts = [0_usize; 8];
        let (_, lists) = self.ends.both();
        for id in list_of(lists, word).unwrap_or_default().iter() {
            let octants = octants(id);
            for (octant, count) in counts.iter_mut().enumerate() {
                *count += (octants >> octant & 1) as usize;
            }
        }
        let entries: usize = counts.iter().map(|count| count + usize::from(*count > 0)).sum();
        let families = self.ends.front_len() + 1;
        let table = slots_for(families) * size_of::<u32>();
        let old = self.ends.back_len();
        if old + entries >= DIVIDED as usize || !self.ends.grow(1, entries, table) {
            return false;
        }

        let (families, lists) = self.ends.both();
        let (new, old_lists) = lists.split_at_mut_checked(entries).unwrap_or_default();
        let list = list_of(old_lists, word).unwrap_or_default();
        let mut family = [0; 9];
        family[0] = code.0;
        // The first child's list is the oldest of the new ones: it lies last.
        let mut end = old;
        let mut next = [0; 8];
        for ((count, child), next) in counts.iter().zip(family.iter_mut().skip(1)).zip(&mut next) {
            if *count == 0 {
                continue;
            }
            end += count + 1;
            *child = end as Word;
            let start = new.len().saturating_sub(end - old);
            if let Some(length) = new.get_mut(start) {
                *length = I::new(*count);
            }
            *next = start + 1;
        }
        for id in list {
            let octants = octants(id);
            for (octant, next) in next.iter_mut().enumerate() {
                if octants >> octant & 1 != 0 {
                    if let Some(place) = new.get_mut(*next) {
                        *place = *id;
                    }
                    *next += 1;
                }
            }
        }
        if let Some(last) = families.last_mut() {
            *last = family;
        }
        self.set(place, DIVIDED);
        true
    }

    /// Moves the lists that are still needed together, oldest first, and gives up the rest.
    fn close_gaps(&mut self) {
        let mut end = 0;
        let mut place = Place::ROOT;
        while let Some((_, word)) = self.cell(place) {
            if word != DIVIDED && word > 0 {
                let entries = self.count(place) + 1;
                let (_, lists) = self.ends.both();
                let from = lists.len().saturating_sub(word as usize);
                end += entries;
                // Lists only ever move towards the end.
                let behind = end.saturating_sub(entries);
                let until = lists.len().saturating_sub(behind);
                if let Some(span) = lists.get_mut(from..until)
                    && let Some(to) = span.len().checked_sub(entries)
                {
                    span.copy_within(..entries, to);
                }
                self.set(place, end as Word);
            }
            place = place.next();
        }
        let unused = self.ends.back_len().saturating_sub(end);
        self.ends.shrink_back(unused);
    }

    /// Brings everything to where it stays. Gives the root, the number of families and that of list
    /// entries.
    fn close_up(mut self) -> (Word, usize, usize) {
        self.close_gaps();
        let (families, entries) = (self.ends.front_len(), self.ends.back_len());
        self.ends.close_up(slots_for(families) * size_of::<u32>());
        (self.root, families, entries)
    }
}

/// The list of a word.
fn list_of<I: Id>(lists: &[I], word: Word) -> Option<&[I]> {
    let start = lists.len().checked_sub(word as usize)?;
    let (length, ids) = lists.get(start..)?.split_first()?;
    ids.get(..length.get())
}
