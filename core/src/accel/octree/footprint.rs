//! How many bytes an octree takes, counted without memory.

use super::Octree;
use super::build::{is_listed, room};
use super::code::{Code, DEEPEST};
use super::growth::{Growth, Order};
use super::storage::{Storage, most};
use crate::accel::{BuildError, Id, Listing};
use crate::memory::{Footprint, ends_bytes};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// The numbers of one level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Level {
    /// Cells that are divided.
    divided: usize,
    /// Entries of the lists of divided cells, lengths included.
    passing: usize,
    /// Entries of the lists of leaves, lengths included.
    staying: usize,
    /// Leaves that list something.
    full: usize,
}

/// Bytes of so many families with what finds them, and so many list entries.
pub(super) fn bytes<'m, C: Storage<'m>, I>(families: usize, entries: usize) -> usize {
    ends_bytes::<C::Block, I>(families, entries, C::index_bytes(families))
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Octree<'m, R, I, C> {
    /// Bytes that building without shortage takes: with a free arena of so many the octree is
    /// divided up to its limits, and the high-water mark is exactly that.
    ///
    /// Needs no memory, therefore looks at every shape for every cell: time in proportion to the
    /// number of cells times the number of shapes.
    ///
    /// # Errors
    /// [`BuildError::TooMany`], also when the octree's words are too narrow for all of it;
    /// [`BuildError::TooDeep`].
    pub fn footprint<S: Shapes<R>, L: Listing>(
        scene: &Scene<'_, R, S>,
        growth: impl Into<Growth<L>>,
    ) -> Result<Footprint, BuildError> {
        let growth = growth.into();
        let (lattice, aside) = room::<R, S, I, L>(scene, growth)?;
        let (limits, deepest) = (growth.limits, growth.limits.max_level);
        let mut levels = [Level::default(); DEEPEST as usize + 1];
        let mut next = Some(Code::ROOT);
        while let Some(code) = next {
            let (base, edge) = code.place(deepest);
            let shapes = (0..scene.shapes().bounded()).filter(|id| !aside.contains(*id));
            let inside = |id: &usize| is_listed(&lattice, scene, growth.lists, *id, base, edge);
            let count = shapes.filter(inside).count();
            let entries = count + usize::from(count > 0);
            let divide = count > limits.max_objects && code.level() < deepest;
            if let Some(level) = levels.get_mut(code.level() as usize) {
                level.divided += usize::from(divide);
                level.full += usize::from(!divide && count > 0);
                *(if divide { &mut level.passing } else { &mut level.staying }) += entries;
            }
            next = if divide { Some(code.child(0)) } else { code.next() };
        }
        // While a level is divided, the lists of all leaves above, its own lists and those of the
        // next level are there.
        let (mut families, mut above, mut peak, mut most_entries) = (0, 0, 0, 0);
        for (level, below) in levels.iter().zip(levels.iter().skip(1).chain([&Level::default()])) {
            families += level.divided;
            let lists = above + level.passing + level.staying + below.passing + below.staying;
            most_entries = most_entries.max(lists);
            peak = peak.max(bytes::<C, I>(families, lists));
            above += level.staying;
        }
        if growth.lists.shares() {
            // The table in which equal lists are found.
            peak = peak.max(bytes::<C, I>(2 * families, above));
        }
        if growth.order == Order::Benefit && C::ANY_ORDER {
            // Every list that there ever is, at once.
            let all = levels.iter().map(|level| level.passing + level.staying).sum();
            most_entries = all;
            peak = peak.max(bytes::<C, I>(families, all));
        }
        let greatest = most_entries.max(families.saturating_sub(1));
        BuildError::unless_above("octree list entries", greatest, most::<C::Word>())?;
        // The root is no one's child.
        let full: usize = levels.iter().skip(1).map(|level| level.full).sum();
        let blocks = C::packed(families, full);
        let kept = ends_bytes::<C::Block, I>(blocks, above, C::index_bytes(families));
        Ok(Footprint { kept, peak })
    }
}
