//! No hierarchy: a list of bounds, and what becomes of bounds that do not pay.

use super::Tree;
use crate::accel::Id;
use crate::bound::Stored;
use crate::num::Real;
use crate::scene::{Scene, Shapes};

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Makes an empty tree one of all shapes below the root.
    pub(super) fn list_all<S: Shapes<R>>(&mut self, scene: &Scene<'_, R, S>) {
        let shapes = scene.shapes().bounded();
        for id in 0..shapes {
            // Cannot fail: there is a leaf for every shape, and each comes once.
            let _ = self.add_leaf(scene, id);
            self.links.count_leaf();
        }
        if shapes < 2 {
            return;
        }
        let root = self.links.add_interior();
        self.links.set_root(root);
        self.join(root, 0..shapes);
        self.fit(root);
    }

    /// Asks for every shape whether its own bound pays, given its id and the probability that a ray
    /// hits its bound that hits the one above, by surfaces; see [`pays`](crate::bound::pays). Those
    /// that do not are tested no more: the shape is met as soon as its parent is. Gives how many
    /// pay. Time in proportion to the number of nodes.
    pub fn keep_paying(&mut self, mut pays: impl FnMut(usize, R) -> bool) -> usize {
        let mut paying = 0;
        let mut next = self.links.first_up();
        for _ in 0..self.links.end() {
            let Some(node) = next else { break };
            if !self.links.is_leaf(node) {
                let whole = self.area(node);
                let mut child = Some(self.links.first(node));
                for _ in 0..self.links.end() {
                    let Some(leaf) = child else { break };
                    child = self.links.sibling(leaf);
                    if !self.links.is_leaf(leaf) {
                        continue;
                    }
                    let own = self.area(leaf);
                    let probability = if own < whole { own / whole } else { R::ONE };
                    let keep = pays(leaf, probability);
                    self.links.mark_leaf(leaf, !keep);
                    paying += usize::from(keep);
                }
            }
            next = self.links.after_up(node);
        }
        paying
    }
}
