//! What waits while a ray goes down a hierarchy.

use super::LEVELS;
use super::node::WIDTH;
use super::wide::Group;
use crate::num::Real;
use heapless::Vec;

/// A node still to be looked at: where the ray enters its box, and its number.
pub(super) type Pending<R> = (R, u32);

/// At most one of a level waits.
pub(super) type Groups = Vec<Group, LEVELS>;

/// Every level leaves all but one of a node's children behind.
const MOST: usize = LEVELS * (WIDTH - 1);

/// A stack that cannot overflow, as no hierarchy has more levels: 800 bytes in `f32`.
pub(super) struct Stack<R> {
    pending: Vec<Pending<R>, MOST>,
}

impl<R: Real> Stack<R> {
    pub(super) fn new() -> Self {
        Self { pending: Vec::new() }
    }

    /// How many wait.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.pending.len()
    }

    /// Puts a child onto the stack.
    #[inline(always)]
    pub(super) fn push(&mut self, child: Pending<R>) {
        let _ = self.pending.push(child);
    }

    /// Puts a child onto the stack, above those that are nearer, but for the first `below`.
    #[inline(always)]
    pub(super) fn insert(&mut self, below: usize, child: Pending<R>) {
        let mut at = self.pending.len();
        self.push(child);
        while at > below {
            match self.pending.get_mut(at - 1..=at) {
                Some([a, b]) if a.0 < child.0 => (*a, *b) = (*b, *a),
                _ => break,
            }
            at -= 1;
        }
    }

    /// Takes the last one off.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<Pending<R>> {
        self.pending.pop()
    }
}
