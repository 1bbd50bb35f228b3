//! Grids whose cells share equal lists.
//!
//! Lists are laid out as in other grids, each behind its length, and then moved together from the
//! first cell to the last, without those that are there already: a hash table in what memory is left
//! finds them, not all in a small one.

use super::build::{for_cells, listed, room, size_of_room};
use super::distance::{self, Slot};
use super::{Grid, Settings};
use crate::accel::lattice::Lattice;
use crate::accel::{BuildError, Id, Listing, listing};
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// What is known of a cell.
#[inline]
pub(super) fn slot<I: Id, O: Id>(slots: &[O], references: &[I], cell: usize) -> Slot {
    match distance::alone(slots, cell) {
        Some(distance) => Slot::Empty(distance),
        None => {
            let place = slots.get(cell).map_or(0, |slot| slot.get());
            let length = references.get(place).map_or(0, |length| length.get());
            Slot::List(place + 1, place + 1 + length)
        }
    }
}

impl<'m, R: Real, I: Id, O: Id> Grid<'m, R, I, O, true> {
    /// As [`Grid::build`], with equal lists stored once: takes the bytes of [`Size`](super::Size) with
    /// [shared](super::Size::shared) lists at most, and for a while a word more for each full cell if
    /// there is room for that; keeps what is left of the lists.
    ///
    /// # Errors
    /// As [`Grid::build`]; the number of bytes is exact where there is room for the cells at least.
    pub fn build_shared<S: Shapes<R>, L: Listing>(
        scene: &Scene<'_, R, S>,
        settings: impl Into<Settings<L>>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let Settings { resolution, huge, overlap, macro_cells, .. } = settings.into();
        let (root, aside) = room(scene, huge);
        let lattice = Lattice::new(root, resolution, scene.pad());
        // The length of a list has to fit as well as the ids.
        BuildError::unless_fits::<I>("shapes", scene.shapes().bounded())?;
        let size = size_of_room(scene, &lattice, &aside, overlap);
        let offsets = Footprint::of::<O>(size.cells.saturating_add(1));
        if arena.require(offsets).is_err() {
            arena.require(size.shared().footprint::<I, O>())?;
        }
        BuildError::unless_above(
            "references",
            size.shared().references,
            distance::most_offset::<O>(),
        )?;
        // Counted in memory that is not taken yet: nothing is when the lists do not fit.
        let mut ends = arena.scratch::<O, I>();
        let _ = ends.grow(size.cells.saturating_add(1), 0, 0);
        let (slots, _) = ends.both();
        slots.fill(O::new(0));
        for id in listed(scene, &aside) {
            for_cells(&lattice, scene, overlap, id, |cell| {
                if let Some(count) = slots.get_mut(cell) {
                    *count = O::new(count.get() + 1);
                }
            });
        }
        let full = slots.iter().filter(|count| count.get() > 0).count();
        let entries = size.references + full;
        arena.require(offsets.then(Footprint::of::<I>(entries)))?;

        let slots: &mut [O] = arena.keep("grid cells", size.cells.saturating_add(1))?;
        let mut ends = arena.scratch::<I, O>();
        let _ = ends.grow(entries, 0, 0);
        let (references, _) = ends.both();
        let mut end = 0;
        for slot in slots.iter_mut() {
            let count = slot.get();
            if let (true, Some(length)) = (count > 0, references.get_mut(end)) {
                *length = I::new(count);
                end += 1 + count;
            }
            *slot = O::new(end);
        }
        for id in listed(scene, &aside).rev() {
            for_cells(&lattice, scene, overlap, id, |cell| {
                if let Some(slot) = slots.get_mut(cell) {
                    let place = slot.get().saturating_sub(1);
                    *slot = O::new(place);
                    if let Some(reference) = references.get_mut(place) {
                        *reference = I::new(id);
                    }
                }
            });
        }
        let mut words = full;
        while !ends.grow(0, words, 0) {
            words /= 2;
        }
        let (references, table) = ends.both();
        table.fill(O::new(O::MAX));
        let kept = move_together(slots, references, table);
        if macro_cells {
            distance::mark::<O, true>(slots, lattice.count());
        }
        let references: &mut [I] = arena.keep("grid references", kept)?;
        Ok(Self { lattice, slots, references, aside: aside.stored() })
    }
}

/// Moves lists to the front, each once; gives the number of their entries.
fn move_together<I: Id, O: Id>(slots: &mut [O], references: &mut [I], table: &mut [O]) -> usize {
    let (mut from, mut end) = (0, 0);
    let last = slots.len().saturating_sub(1);
    for cell in 0..last {
        // The slot of a full cell is behind the length of its list, that of an empty one before that of
        // the next.
        let is_full = slots.get(cell).is_some_and(|slot| slot.get() > from);
        if !is_full {
            distance::set(slots, cell, 1);
            continue;
        }
        let entries = 1 + references.get(from).map_or(0, |length| length.get());
        let list = references.get(from..from + entries).unwrap_or_default();
        let place = find_or_enter(references, list, end, table).unwrap_or_else(|| {
            let place = end;
            end += entries;
            place
        });
        if place + entries == end {
            references.copy_within(from..from + entries, place);
        }
        if let Some(slot) = slots.get_mut(cell) {
            *slot = O::new(place);
        }
        from += entries;
    }
    end
}

/// Where a list lies that is equal to this one, its length included; without any, this one is entered
/// as lying where it will be.
fn find_or_enter<I: Id, O: Id>(
    references: &[I],
    list: &[I],
    later: usize,
    table: &mut [O],
) -> Option<usize> {
    for word in listing::probes(list, table.len()) {
        let word = table.get_mut(word)?;
        let place = word.get();
        if place == O::MAX {
            *word = O::new(later);
            return None;
        }
        let other = references.get(place..place + list.len()).unwrap_or_default();
        if listing::is_equal(other, list) {
            return Some(place);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::mailbox::{self, Stamps};
    use crate::accel::{Accel, ByBox};
    use crate::geom::{Interval, Ray};
    use crate::probe::Counters;
    use crate::shape::Sphere;
    use glam::{Vec3, vec3};

    #[repr(align(8))]
    struct Block([u8; 1 << 17]);

    type Own<'m> = Grid<'m, f32, u16, u16>;
    type Shared<'m> = Grid<'m, f32, u16, u16, true>;

    /// Balls in rows, and a few large ones that fill many cells by themselves.
    fn spheres() -> [Sphere<f32>; 68] {
        core::array::from_fn(|i| match i {
            0..64 => {
                let place = vec3((i % 4) as f32, (i / 4 % 4) as f32, (i / 16) as f32);
                Sphere::new(place * 2.5, 0.7)
            }
            _ => Sphere::new(Vec3::splat(i as f32 - 62.0), 2.5),
        })
    }

    fn settings(resolution: [u32; 3], macro_cells: bool) -> Settings<ByBox> {
        Settings { macro_cells, ..Settings::new(resolution) }
    }

    #[test]
    fn shared_lists_are_the_same_and_each_is_there_once() {
        let spheres = spheres();
        let scene = Scene::new(&spheres[..]).unwrap();
        for (n, macro_cells) in
            [1, 2, 5, 12, 20].into_iter().flat_map(|n| [false, true].map(|on| (n, on)))
        {
            let settings = settings([n, n + 1, n], macro_cells);
            let (mut one, mut other) = (Block([0; 1 << 17]), Block([0xa5; 1 << 17]));
            let (mut one, mut other) = (Arena::new(&mut one.0), Arena::new(&mut other.0));
            let own = Own::build(&scene, settings, &mut one).unwrap();
            let shared = Shared::build_shared(&scene, settings, &mut other).unwrap();
            assert!(own.lists().eq(shared.lists()), "{n}");
            let is_first =
                |(i, list): &(usize, &[u16])| !shared.lists().take(*i).any(|l| l == *list);
            let full = || shared.lists().enumerate().filter(|(_, list)| !list.is_empty());
            let distinct: usize = full().filter(is_first).map(|(_, list)| list.len() + 1).sum();
            assert_eq!(shared.references.len(), distinct, "{n}");
            let saved = (own.references.len() as isize - distinct as isize) * 2;
            assert_eq!(shared.shared_bytes(), saved, "{n}");
            assert!(saved < 8 || other.used() < one.used(), "{n}");
            assert!(n < 12 || shared.shared_bytes() > 3000, "{n}: {}", shared.shared_bytes());
            let most = crate::accel::grid::size(&scene, settings).shared();
            let table = Footprint::of::<u16>(full().count());
            let peak = most.footprint::<u16, u16>().then(table).peak;
            assert!(other.high_water() <= peak, "{n}: {} of {peak}", other.high_water());
        }
    }

    #[test]
    fn hits_are_the_same_and_a_list_is_tested_once_a_ray() {
        let spheres = spheres();
        let scene = Scene::new(&spheres[..]).unwrap();
        let (mut one, mut other) = (Block([0; 1 << 17]), Block([0; 1 << 17]));
        let (mut one, mut other) = (Arena::new(&mut one.0), Arena::new(&mut other.0));
        let settings = settings([20; 3], true);
        let own = Own::build(&scene, settings, &mut one).unwrap();
        let shared = Shared::build_shared(&scene, settings, &mut other).unwrap();
        let mut plain = Stamps::new(68, &mut one).unwrap();
        let mut lists = mailbox::Lists::new(Stamps::new(68, &mut other).unwrap(), true);
        let (mut without, mut with) = (Counters::default(), Counters::default());
        for i in 0..400 {
            let (from, to) =
                (vec3(-5.0, (i % 20) as f32 * 0.5, 3.0), vec3(8.0, 4.0, i as f32 * 0.025));
            let ray = Ray::new(from, to - from).unwrap();
            let a = own.nearest(&scene, &ray, Interval::RAY, &mut plain, &mut without);
            let b = shared.nearest(&scene, &ray, Interval::RAY, &mut lists, &mut with);
            assert_eq!(a, b);
            let a = own.occluded(&scene, &ray, Interval::RAY, &mut plain, &mut without);
            let b = shared.occluded(&scene, &ray, Interval::RAY, &mut lists, &mut with);
            assert_eq!(a, b);
        }
        assert_eq!(without.primitive_tests, with.primitive_tests);
        // Distances of cells behind full ones are known, too.
        assert!(with.leaves - with.empty_leaves == without.leaves - without.empty_leaves);
        assert!(with.empty_leaves <= without.empty_leaves);
        assert!(with.list_skips > 0 && with.mailbox_skips < without.mailbox_skips);
    }

    #[test]
    fn too_little_memory_is_told_exactly() {
        let spheres = spheres();
        let scene = Scene::new(&spheres[..]).unwrap();
        for bytes in [0, 8, 300, 2500] {
            let mut block = Block([0; 1 << 17]);
            let mut arena = Arena::new(&mut block.0[..bytes]);
            let error = Shared::build_shared(&scene, [9; 3], &mut arena).map(|_| ()).unwrap_err();
            assert_eq!(arena.used(), 0);
            let BuildError::Memory(memory) = error else { panic!("{error}") };
            let mut arena = Arena::new(&mut block.0[..memory.needed]);
            Shared::build_shared(&scene, [9; 3], &mut arena).unwrap();
            // The number is exact once the cells can be counted.
            if bytes > 730 * 2 {
                let mut arena = Arena::new(&mut block.0[..memory.needed - 1]);
                assert!(Shared::build_shared(&scene, [9; 3], &mut arena).is_err());
            }
        }
    }
}
