//! What a tree should cost a ray, by surfaces.

use super::Tree;
use crate::accel::Id;
use crate::bound::Stored;
use crate::num::Real;

/// Tests that a ray should take that hits the root's bound, if rays came from everywhere, went on
/// through what they hit, and bounds were convex: a bound is hit with the probability of its surface
/// by the root's (Goldsmith and Salmon 1987).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost<R> {
    /// Tests of bounds: one, and for every node as many as it has children, times the probability
    /// that it is hit.
    pub bounds: R,
    /// Tests of shapes: the probabilities of all leaves.
    pub shapes: R,
}

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// The expected cost. Time in proportion to the number of nodes. Useless where one shape fills
    /// the whole scene, as every ray then hits the root.
    pub fn cost(&self) -> Cost<R> {
        let mut cost = Cost::default();
        let Some(root) = self.links.root() else { return cost };
        cost.bounds = R::ONE;
        let all = self.area(root);
        if !(all > R::ZERO) {
            return cost;
        }
        let mut next = self.links.first_up();
        for _ in 0..self.links.end() {
            let Some(node) = next else { break };
            let probability = self.area(node) / all;
            if self.links.is_leaf(node) {
                cost.shapes = cost.shapes + probability;
            } else {
                let children = self.links.children(node).count();
                cost.bounds = cost.bounds + probability.times_int(children as i32);
            }
            next = self.links.after_up(node);
        }
        cost
    }
}
