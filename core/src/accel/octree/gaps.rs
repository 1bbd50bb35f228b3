//! Taking back the memory of lists that are not needed any more, and of those that are there twice.
//!
//! Children of one cell that list the same share a list from the beginning; where cells of different
//! parents do, one list remains when the octree is done. (What slides of the nineties call abstract
//! space division; a ray skips a list as a whole that it has been tested against, see
//! [`mailbox::Lists`](crate::accel::mailbox::Lists).)

use super::build::Growing;
use super::cursor::Slot;
use super::list_at;
use super::storage::{Content, Storage};
use crate::accel::{Id, Listing, listing};
use crate::num::Real;
use crate::scene::Shapes;
use core::cell::Cell;

impl<'m, R: Real, S: Shapes<R>, I: Id, C: Storage<'m>, L: Listing>
    Growing<'_, '_, 'm, R, S, I, C, L>
{
    /// Moves the lists that are still needed together, oldest first, and gives up the rest.
    pub(super) fn close_gaps(&mut self) {
        self.move_lists(self.ends.front_len(), |_, _, _| None);
    }

    /// Makes one list of equal ones. They are found by a hash table as large as the cells, or as there
    /// is memory; in a small one not all are.
    pub(super) fn share(&mut self) {
        let families = self.ends.front_len();
        // A word for every leaf is enough.
        let mut blocks = families;
        while !self.ends.grow(blocks, 0, 0) {
            blocks /= 2;
        }
        let (table, _) = self.ends.both();
        for block in table.get_mut(families..).unwrap_or_default() {
            *C::words_mut(block) = [Content::List(0).word(); 8];
        }
        self.move_lists(families, Self::find_or_enter);
        self.ends.shrink_front(blocks);
    }

    /// Moves the lists of so many families together, oldest first. `find` is told where a list is and
    /// where it will be, and may name an equal one that takes its place.
    fn move_lists(
        &mut self,
        families: usize,
        find: impl Fn(&mut Self, usize, [usize; 2]) -> Option<usize>,
    ) {
        let mut end = 0;
        // The list that was last looked at: where it was, and where it is now.
        let (mut last, mut moved) = (0, 0);
        let mut slot = Slot::Root;
        while slot.is_within(families) {
            let oldest = if self.making.shares() { self.by_age(slot) } else { slot };
            if let Some(Content::List(place)) = self.content(oldest)
                && place > 0
            {
                // Siblings that share a list follow each other.
                if !self.making.shares() || place != last {
                    let entries = self.count(place) + 1;
                    last = place;
                    moved = match find(self, families, [place, end + entries]) {
                        Some(equal) => equal,
                        None => {
                            self.move_list(place, end, entries);
                            end += entries;
                            end
                        }
                    };
                }
                self.set(oldest, Content::List(moved));
            }
            slot = slot.next();
        }
        let unused = self.ends.back_len().saturating_sub(end);
        self.ends.shrink_back(unused);
    }

    /// Moves a list to before the last `end` entries. Lists only ever move towards the end.
    fn move_list(&mut self, place: usize, end: usize, entries: usize) {
        let (_, lists) = self.ends.both();
        let from = lists.len().saturating_sub(place);
        let until = lists.len().saturating_sub(end);
        if let Some(span) = lists.get_mut(from..until)
            && let Some(to) = span.len().checked_sub(entries)
        {
            // One by one: `memmove` alone is 0.8 KB on a Cortex-M0.
            let places = Cell::from_mut(span).as_slice_of_cells();
            for i in (0..entries).rev() {
                let (Some(from), Some(to)) = (places.get(i), places.get(to + i)) else { break };
                to.set(from.get());
            }
        }
    }

    /// The slots of a family in the order in which their lists came to be: of siblings that shared
    /// one, the first may have been divided.
    fn by_age(&mut self, slot: Slot) -> Slot {
        let Slot::Child(family, turn) = slot else { return slot };
        let (families, _) = self.ends.both();
        let Some(family_words) = families.get(family).map(C::words) else { return slot };
        let age = |(octant, word): (usize, &C::Word)| match Content::of(*word) {
            Content::List(place) => (place, octant),
            Content::Family(_) => (0, octant),
        };
        let ages = || family_words.iter().enumerate().map(age);
        let older = |than: (usize, usize)| ages().filter(|age| *age < than).count();
        let found = ages().find(|age| older(*age) == turn);
        found.map_or(slot, |(_, octant)| Slot::Child(family, octant))
    }

    /// Where a list lies that is equal to the one at a place; without any that one is entered, as
    /// lying where it will be.
    fn find_or_enter(&mut self, families: usize, [place, later]: [usize; 2]) -> Option<usize> {
        let (blocks, lists) = self.ends.both();
        let table = blocks.get_mut(families..)?;
        let list = list_at(lists, place);
        for slot in listing::probes(list, table.len() * 8) {
            let word = table.get_mut(slot / 8).map(C::words_mut)?.get_mut(slot % 8)?;
            match Content::of(*word) {
                Content::List(0) => {
                    *word = Content::List(later).word();
                    return None;
                }
                Content::List(other) if listing::is_equal(list_at(lists, other), list) => {
                    return Some(other);
                }
                _ => {}
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use crate::accel::mailbox::{self, Mailbox, Stamps};
    use crate::accel::octree::{Growth, Limits, Links, Lists, Order};
    use crate::accel::{Accel, Octree, Overlap};
    use crate::geom::{Interval, Ray};
    use crate::memory::Arena;
    use crate::probe::Counters;
    use crate::scene::Scene;
    use crate::shape::Sphere;
    use glam::{Vec3, vec3};

    #[repr(align(8))]
    struct Block([u8; 1 << 17]);

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

    type Wide<'m> = Octree<'m, f32, u16, Links<'m, u32>>;

    fn growth(shared: bool, order: Order, max_level: u32) -> Growth<Lists> {
        let lists = Lists { overlap: Overlap::Box, shared };
        let limits = Limits { max_objects: 2, max_level };
        Growth { lists, order, ..Growth::new(limits) }
    }

    #[test]
    fn shared_lists_are_the_same_in_fewer_bytes() {
        let spheres = spheres();
        let scene = Scene::new(&spheres[..]).unwrap();
        for (order, level) in
            [Order::Breadth, Order::Benefit].into_iter().flat_map(|o| (0..6).map(move |l| (o, l)))
        {
            let (mut one, mut other) = (Block([0; 1 << 17]), Block([0xa5; 1 << 17]));
            let (mut one, mut other) = (Arena::new(&mut one.0), Arena::new(&mut other.0));
            let own = Wide::build(&scene, growth(false, order, level), &mut one).unwrap();
            let shared = Wide::build(&scene, growth(true, order, level), &mut other).unwrap();
            if order == Order::Breadth {
                assert!(own.leaves().eq(shared.leaves()), "level {level}");
            }
            // What is saved is exactly what the lists of all leaves would take more.
            assert_eq!(own.shared_bytes(), 0);
            let entries: usize =
                shared.leaves().map(|l| l.len() + usize::from(!l.is_empty())).sum();
            assert_eq!(shared.shared_bytes(), (entries - shared.lists.len()) * 2);
            if order == Order::Breadth && level > 2 {
                assert!(shared.shared_bytes() > entries / 2, "{order:?} level {level}");
            }
            let footprint = Wide::footprint(&scene, growth(true, order, level)).unwrap();
            assert!(other.high_water() <= footprint.peak && other.used() <= footprint.kept);
            // With so much memory, nothing is there twice.
            let is_first =
                |(i, list): &(usize, &[u16])| !shared.leaves().take(*i).any(|l| l == *list);
            let full = shared.leaves().enumerate().filter(|(_, list)| !list.is_empty());
            let distinct: usize = full.filter(is_first).map(|(_, list)| list.len() + 1).sum();
            assert_eq!(shared.lists.len(), distinct, "{order:?} level {level}");
        }
    }

    #[test]
    fn a_list_is_tested_once_a_ray() {
        let spheres = spheres();
        let scene = Scene::new(&spheres[..]).unwrap();
        let mut block = Block([0; 1 << 17]);
        let mut arena = Arena::new(&mut block.0);
        let octree = Wide::build(&scene, growth(true, Order::Breadth, 5), &mut arena).unwrap();
        let (mut one, mut other) = ([0_u64; 32], [0_u64; 32]);
        let (mut one, mut other) = (
            Arena::new(bytemuck::cast_slice_mut(&mut one)),
            Arena::new(bytemuck::cast_slice_mut(&mut other)),
        );
        let mut plain = Stamps::new(68, &mut one).unwrap();
        let mut lists = mailbox::Lists::new(Stamps::new(68, &mut other).unwrap(), true);
        let (mut without, mut with) = (Counters::default(), Counters::default());
        for i in 0..200 {
            let (from, to) =
                (vec3(-5.0, (i % 20) as f32 * 0.5, 3.0), vec3(8.0, 4.0, i as f32 * 0.05));
            let ray = Ray::new(from, to - from).unwrap();
            let a = octree.nearest(&scene, &ray, Interval::RAY, &mut plain, &mut without);
            let b = octree.nearest(&scene, &ray, Interval::RAY, &mut lists, &mut with);
            assert_eq!(a, b);
        }
        assert_eq!(without.primitive_tests, with.primitive_tests);
        assert!(with.list_skips > 0 && with.mailbox_skips < without.mailbox_skips);
        lists.next_ray();
        assert!(lists.admit_list(3) && !lists.admit_list(3) && lists.admit_list(11));
        assert!(lists.admit_list(3), "another list took its place");
    }
}
