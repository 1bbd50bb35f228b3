//! Inserting a shape where it adds least to the cost of the tree.
//!
//! J. Goldsmith and J. Salmon, "Automatic creation of object hierarchies for ray tracing", IEEE CG&A
//! 7(5) (1987): a ray that hits a node tests all its children, so a node costs its surface times
//! their number, and a place for a shape costs what the whole tree gains by it. The way down goes to
//! the child that grows least. E. Haines' improvement (1988): any child can be paired with the shape
//! under a new node, not only leaves.

use super::Tree;
use super::links::Next;
use crate::accel::Id;
use crate::bound::Stored;
use crate::num::{Real, Vector};
use crate::scene::{Scene, Shapes};

/// Why a shape cannot be inserted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InsertError {
    /// The tree has no room for it: ids are below the number it was made for.
    Full {
        /// The shape's id.
        id: usize,
        /// How many shapes there is room for.
        capacity: usize,
    },
    /// It is in the tree.
    Present {
        /// The shape's id.
        id: usize,
    },
    /// The scene has no bounded shape of this id.
    NoShape {
        /// The id.
        id: usize,
        /// How many bounded shapes there are.
        shapes: usize,
    },
}

impl core::fmt::Display for InsertError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Full { id, capacity } => {
                write!(f, "shape {id} in a tree with room for {capacity} shapes")
            }
            Self::Present { id } => write!(f, "shape {id} is in the tree already"),
            Self::NoShape { id, shapes } => {
                write!(f, "shape {id} of a scene with {shapes} bounded shapes")
            }
        }
    }
}

impl core::error::Error for InsertError {}

/// Where a shape goes.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Among the children of a node.
    Child(usize),
    /// Together with a node under a new one.
    Pair(usize),
}

/// The cheapest place so far, and what it costs.
struct Best<R> {
    cost: R,
    place: Place,
}

impl<R: Real> Best<R> {
    /// Of equal places the first.
    fn offer(&mut self, cost: R, place: Place) {
        if cost < self.cost {
            *self = Self { cost, place };
        }
    }
}

impl<R: Real, B: Stored<R>, I: Id> Tree<'_, R, B, I> {
    /// Inserts a shape of a scene; rays meet it from then on. Time in proportion to the number of
    /// levels and of children on the way. The scene may not have grown since the first one: where
    /// it has, [`Tree::refit`] comes first.
    ///
    /// # Errors
    /// [`InsertError`]; the tree stays as it is.
    pub fn insert<S: Shapes<R>>(
        &mut self,
        scene: &Scene<'_, R, S>,
        id: usize,
    ) -> Result<(), InsertError> {
        let leaf = self.add_leaf(scene, id)?;
        let Some(new) = self.volume(leaf) else { return Ok(()) };
        match self.place(new) {
            None => self.links.set_root(leaf),
            Some(Place::Child(parent)) => {
                self.links.prepend(parent, leaf);
                self.enlarge(Some(parent), new);
            }
            Some(Place::Pair(sibling)) => {
                let node = self.links.add_interior();
                self.links.replace(sibling, node);
                self.links.set_first(node, sibling);
                self.links.set_next(sibling, Next::Sibling(leaf));
                self.links.set_next(leaf, Next::Parent(node));
                let volume = self.volume(sibling).map_or(new, |volume| volume.union(new));
                self.set_volume(node, volume);
                self.enlarge(self.links.parent(node), new);
            }
        }
        self.links.count_leaf();
        Ok(())
    }

    /// Inserts a shape of a scene into a tree of which all shapes were inserted so: with
    /// [`Builder::RTree`](super::Builder::RTree). Otherwise as [`Tree::insert`].
    ///
    /// # Errors
    /// [`InsertError`]; the tree stays as it is.
    pub fn insert_in_r_tree<S: Shapes<R>>(
        &mut self,
        scene: &Scene<'_, R, S>,
        id: usize,
    ) -> Result<(), InsertError> {
        let leaf = self.add_leaf(scene, id)?;
        self.place_in_r_tree(leaf);
        self.links.count_leaf();
        Ok(())
    }

    /// Makes the leaf of a shape, without a place in the tree.
    pub(super) fn add_leaf<S: Shapes<R>>(
        &mut self,
        scene: &Scene<'_, R, S>,
        id: usize,
    ) -> Result<usize, InsertError> {
        let (capacity, shapes) = (self.links.capacity(), scene.shapes().bounded());
        if id >= shapes {
            return Err(InsertError::NoShape { id, shapes });
        }
        if !self.links.is_leaf(id) {
            return Err(InsertError::Full { id, capacity });
        }
        if self.links.contains(id) {
            return Err(InsertError::Present { id });
        }
        self.pad = self.pad.max(scene.pad());
        self.set_volume(id, B::around(&scene.shapes().region(id), self.pad));
        self.links.mark_leaf(id, false);
        Ok(id)
    }

    /// The cheapest place for a bound; none while the tree is empty.
    fn place(&self, new: B) -> Option<Place> {
        let mut node = self.links.root()?;
        let mut best = Best { cost: R::INFINITY, place: Place::Pair(node) };
        // What the nodes above gain, whatever comes below.
        let mut inherited = R::ZERO;
        for _ in 0..self.links.end() {
            if self.links.is_leaf(node) {
                break;
            }
            let volume = self.volume(node)?;
            let whole = volume.union(new).half_area();
            let children = self.links.children(node).count();
            let growth = (whole - volume.half_area()).times_int(children as i32);
            inherited = inherited + growth;
            if node == self.links.root()? {
                // The new node has two children, the root and the shape.
                best.offer(whole + whole, Place::Pair(node));
            }
            best.offer(inherited + whole, Place::Child(node));
            let mut least: Option<(R, R, usize)> = None;
            for child in self.links.children(node) {
                let volume = self.volume(child)?;
                let both = volume.union(new).half_area();
                best.offer(inherited + both + both, Place::Pair(child));
                let growth = both - volume.half_area();
                let off = (volume.middle() - new.middle()).max_abs();
                let nearer = |(least, distance, _): &(R, R, usize)| {
                    growth < *least || growth == *least && off < *distance
                };
                if least.as_ref().is_none_or(nearer) {
                    least = Some((growth, off, child));
                }
            }
            let (_, _, child) = least?;
            if !(inherited < best.cost) {
                break;
            }
            node = child;
        }
        Some(best.place)
    }

    /// Makes a node and all above it contain a bound.
    pub(super) fn enlarge(&mut self, node: Option<usize>, new: B) {
        let mut node = node;
        for _ in 0..self.links.end() {
            let Some(at) = node else { return };
            if let Some(volume) = self.volume(at) {
                self.set_volume(at, volume.union(new));
            }
            node = self.links.parent(at);
        }
    }
}
