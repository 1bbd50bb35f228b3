//! Bounds made to fit again when shapes have moved, the links left as they are.

use super::Tree;
use crate::accel::Id;
use crate::bound::Stored;
use crate::num::Real;
use crate::scene::{Scene, Shapes};

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Computes all bounds anew, from the leaves up, for a scene in which the same shapes lie
    /// elsewhere. Time in proportion to the number of nodes. Hits are right wherever the shapes
    /// have gone; the farther, the slower: when [`Tree::cost`] has grown, build again.
    ///
    /// A shape that the scene has no more is hit no more, and stays in the tree.
    pub fn refit<S: Shapes<R>>(&mut self, scene: &Scene<'_, R, S>) {
        self.pad = scene.pad();
        for leaf in 0..self.links.capacity() {
            if self.links.contains(leaf) {
                self.set_volume(leaf, B::around(&scene.shapes().region(leaf), self.pad));
            }
        }
        self.fit_all();
        self.refine(scene);
    }

    /// Makes bounds smaller where their kind can around the shapes below: [`Fitted::refined`]. Time in
    /// proportion to the number of shapes and of levels; no memory.
    ///
    /// [`Fitted::refined`]: crate::bound::Fitted::refined
    pub(super) fn refine<S: Shapes<R>>(&mut self, scene: &Scene<'_, R, S>) {
        if !B::REFINES {
            return;
        }
        let mut next = self.links.first_up();
        for _ in 0..self.links.end() {
            let Some(node) = next else { return };
            if let Some(volume) = self.volume(node) {
                let inside = self.links.leaves(node).map(|leaf| scene.shapes().region(leaf));
                self.set_volume(node, volume.refined(inside, self.pad));
            }
            next = self.links.after_up(node);
        }
    }

    /// Computes the bounds of all nodes anew that are no leaves.
    pub(super) fn fit_all(&mut self) {
        let mut next = self.links.first_up();
        for _ in 0..self.links.end() {
            let Some(node) = next else { return };
            self.fit(node);
            next = self.links.after_up(node);
        }
    }

    /// Bounds a node's children.
    pub(super) fn fit(&mut self, node: usize) {
        let mut volumes = self.links.children(node).filter_map(|child| self.volume(child));
        let Some(first) = volumes.next() else { return };
        let volume = volumes.fold(first, B::union);
        self.set_volume(node, volume);
    }
}
