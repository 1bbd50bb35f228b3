//! What waits while a ray goes down a hierarchy.

use super::LEVELS;
use super::node::{WIDTH, Wide};
use crate::num::Real;
use heapless::Vec;

/// A child still to be looked at: where the ray enters its box; its node times [`WIDTH`] plus its
/// place there.
pub(super) type Pending<R> = (R, u32);

/// Every level leaves all but one of a node's children behind, and the last one none.
const MOST: usize = LEVELS * (WIDTH - 1) + 1;

/// A stack that cannot overflow, as no hierarchy has more levels: 800 bytes in `f32`.
pub(super) struct Stack<R> {
    pending: Vec<Pending<R>, MOST>,
}

impl<R: Real> Stack<R> {
    pub(super) fn new() -> Self {
        Self { pending: Vec::new() }
    }

    /// Puts those children of a node onto the stack that are not left before they are entered, the
    /// nearest one last.
    #[inline(always)]
    pub(super) fn push(&mut self, node: usize, near: &Wide<R>, far: &Wide<R>) {
        let waiting = self.pending.len();
        let mut hit = 0_u32;
        for (place, (near, far)) in near.iter().zip(far).enumerate() {
            hit |= u32::from(near <= far) << place;
        }
        while hit != 0 {
            let place = hit.trailing_zeros();
            hit &= hit - 1;
            let t = near.get(place as usize % WIDTH).copied().unwrap_or(R::ZERO);
            let child = (t, (node * WIDTH) as u32 + place);
            // Those that are nearer move up.
            let mut at = self.pending.len();
            let _ = self.pending.push(child);
            while at > waiting {
                match self.pending.get_mut(at - 1..=at) {
                    Some([a, b]) if a.0 < t => *b = *a,
                    _ => break,
                }
                at -= 1;
            }
            if let Some(pending) = self.pending.get_mut(at) {
                *pending = child;
            }
        }
    }

    /// Takes the last one off.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<Pending<R>> {
        self.pending.pop()
    }
}
