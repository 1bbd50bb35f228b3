//! Dividing first what saves most tests for its bytes.

use super::build::{Growing, Refusal};
use super::cursor::Cursor;
use super::growth::StoppedBy;
use super::storage::{Content, Storage};
use crate::accel::{Id, Listing};
use crate::num::Real;
use crate::scene::Shapes;

/// What the way through the children of a cell costs more than that through a leaf, in tests.
const STEPS: u64 = 1;

/// Tests saved for a byte at the surface of a cell of some level, in parts of 2^-40.
fn benefit(tests: u64, bytes: u64, level: u32) -> u64 {
    (tests << 40).checked_div(bytes).unwrap_or(0) >> (2 * level)
}

impl<'m, R: Real, S: Shapes<R>, I: Id, C: Storage<'m>, L: Listing>
    Growing<'_, '_, 'm, R, S, I, C, L>
{
    /// Divides what saves most tests for its bytes first, until nothing is left that saves any or
    /// something refuses.
    ///
    /// Without memory for a queue the order is approximate: all cells are gone through for ever
    /// smaller savings, each half of the one before. What is divided in a round saves at most twice
    /// as much for its bytes as anything else that was.
    pub(super) fn grow_by_benefit(&mut self) -> Result<StoppedBy, Refusal> {
        let mut stopped_by = StoppedBy::Done;
        let bytes_of_family = size_of::<C::Block>() as u64;
        let mut least = benefit(self.ends.back_len() as u64, bytes_of_family, 0);
        while least > 0 {
            self.close_gaps();
            stopped_by = StoppedBy::Done;
            // The greatest saving that was left for later.
            let mut greatest = 0;
            let mut cursor = Cursor::ROOT;
            loop {
                match self.content(cursor.slot()) {
                    Some(Content::Family(family)) => {
                        cursor.down(family);
                        continue;
                    }
                    Some(Content::List(place)) if self.count(place) > self.limits.max_objects => {
                        if cursor.level() == self.limits.max_level {
                            stopped_by = StoppedBy::Level;
                        } else {
                            let benefit = self.benefit_of(&cursor, place, least);
                            if benefit >= least {
                                self.divide_somehow(&cursor)?;
                                continue;
                            }
                            greatest = greatest.max(benefit);
                        }
                    }
                    _ => {}
                }
                if !cursor.next() {
                    break;
                }
            }
            least = greatest.min(least / 2);
        }
        Ok(stopped_by)
    }

    /// How much dividing a leaf saves for its bytes; when that is less than `least`, no more than
    /// that it is so.
    fn benefit_of(&mut self, cursor: &Cursor, place: usize, least: u64) -> u64 {
        let count = self.count(place) as u64;
        let block = size_of::<C::Block>() as u64;
        // If every shape went to one child only.
        let best = benefit(3 * count, 4 * block, cursor.level());
        if best < least {
            return best;
        }
        let (counts, equal) = self.counts(cursor, place);
        let entries: usize = counts.iter().sum();
        let own = |(count, equal): (&usize, &u32)| if *equal == 0 { *count } else { 0 };
        let stored: usize = counts.iter().zip(&equal).map(own).sum();
        // A child has a quarter of the surface, so of the rays that come through a cell a quarter
        // comes through each of its children: two more leaves, and a cell that is no leaf.
        let saved = (4 * count).saturating_sub(entries as u64 + 4 * STEPS);
        let more = (stored as u64).saturating_sub(count) * size_of::<I>() as u64;
        benefit(saved, 4 * (block + more), cursor.level())
    }
}
