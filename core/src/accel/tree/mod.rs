//! A tree of bounds of any kind: spheres, boxes, oriented boxes, k-dops.
//!
//! Every shape has a leaf with a bound of its own, and every other node bounds its children, of
//! which there may be any number from two on. Builders differ, the tree and its walks are the same:
//! * [`Builder::GoldsmithSalmon`] and [`Builder::RTree`] insert one shape after the other, also into
//!   a tree that has been walked already ([`Tree::insert`]);
//! * [`Builder::Sah`] divides the whole from the root down.
//!
//! With n shapes there are n leaves, and up to n - 1 nodes above them:
//!
//! | part | bytes |
//! |---|---|
//! | volumes | a bound each: 24 for a box in `f32` |
//! | links | 4 each with up to 16,384 shapes, 8 beyond |
//!
//! That is several times what [`Bvh`](super::Bvh) takes; what it is good for is insertion, shapes
//! that move ([`Tree::refit`]), and bounds that fit better than boxes do.
//!
//! Hits are those of testing every shape: a bound says no only where its shapes cannot be hit (see
//! [`bound`](crate::bound)), and what waits is passed over only if the ray enters it beyond the
//! limit, never for a tie.

mod any;
mod cost;
mod insert;
mod links;
mod list;
mod order;
mod refit;
mod rtree;
mod sah;
mod size;
mod walk;

pub use any::{AnyTree, Kind, Summary, Widths};
pub use cost::Cost;
pub use insert::InsertError;
pub use order::Insertion;
pub use size::footprint;

use super::{BuildError, Id};
use crate::bound::Stored;
use crate::memory::Arena;
use crate::num::Real;
use crate::scene::{Scene, Shapes};
use links::Links;

/// How a tree comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builder {
    /// Shape by shape, each where it adds least to the cost of the tree: J. Goldsmith, J. Salmon,
    /// "Automatic creation of object hierarchies for ray tracing", IEEE CG&A 7(5) (1987).
    GoldsmithSalmon(Insertion),
    /// Shape by shape, all leaves on one level: A. Guttman, "R-trees: a dynamic index structure for
    /// spatial searching", SIGMOD 1984.
    RTree(Insertion),
    /// No hierarchy: all leaves below the root. The ordered walk is then that of sorted bounds: all
    /// are tested, those that the ray hits are sorted by where it enters them, and the search ends
    /// when the nearest hit lies before the next. For scenes too small for more.
    List,
    /// All at once, cut in two where the surfaces tell to. Takes scratch for a list of the shapes.
    Sah,
}

impl Default for Builder {
    fn default() -> Self {
        Self::GoldsmithSalmon(Insertion::default())
    }
}

/// In which order nodes are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Walk {
    /// Depth first, the nearest child first.
    #[default]
    Ordered,
    /// The nearest of all that wait: T. L. Kay, J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH
    /// 1986.
    Heap,
    /// All that the ray hits, as the links tell: without memory, and without the saving that near
    /// hits bring.
    Stored,
}

/// How a tree is built and walked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// How it comes about.
    pub builder: Builder,
    /// How rays go through it.
    pub walk: Walk,
}

/// A tree of bounds `B`. `I` stores numbers of nodes.
#[derive(Debug)]
pub struct Tree<'m, R: Real, B: Stored<R>, I> {
    links: Links<'m, I>,
    /// Of all nodes, as they are numbered.
    volumes: &'m mut [B::Plain],
    pad: R,
    walk: Walk,
}

impl<'m, R: Real, B: Stored<R>, I: Id> Tree<'m, R, B, I> {
    /// A tree over the bounded shapes of a scene.
    ///
    /// # Errors
    /// [`BuildError::Memory`] with the exact number of bytes; [`BuildError::TooMany`] when nodes do
    /// not fit their type.
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        settings: Settings,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        BuildError::unless_above("shapes", shapes, Links::<I>::MOST_SHAPES)?;
        arena.require(footprint::<R, B, I>(shapes, settings.builder))?;
        let mut tree = Self::with_builder(shapes, settings, arena)?;
        match settings.builder {
            // Inserting cannot fail: there is a leaf for every shape, and each comes once.
            Builder::GoldsmithSalmon(insertion) => {
                order::each::<R, S, I>(scene, insertion, arena, |id| {
                    let _ = tree.insert(scene, id);
                })?;
            }
            Builder::RTree(insertion) => {
                order::each::<R, S, I>(scene, insertion, arena, |id| {
                    let _ = tree.insert_in_r_tree(scene, id);
                })?;
            }
            Builder::List => tree.list_all(scene),
            Builder::Sah => tree.divide_all(scene, arena)?,
        }
        tree.refine(scene);
        Ok(tree)
    }

    /// A tree without a shape yet, and room for those with ids up to `capacity`.
    ///
    /// # Errors
    /// As [`Tree::build`].
    pub fn empty(capacity: usize, walk: Walk, arena: &mut Arena<'m>) -> Result<Self, BuildError> {
        BuildError::unless_above("shapes", capacity, Links::<I>::MOST_SHAPES)?;
        let builder = Builder::GoldsmithSalmon(Insertion::File);
        arena.require(footprint::<R, B, I>(capacity, builder))?;
        Self::with_builder(capacity, Settings { builder, walk }, arena)
    }

    /// An empty tree with the nodes that a builder needs.
    fn with_builder(
        capacity: usize,
        Settings { builder, walk }: Settings,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let nodes = size::most_nodes(capacity, builder);
        let volumes = arena.keep("tree volumes", nodes)?;
        let links = Links::new(arena.keep("tree links", nodes)?, capacity);
        Ok(Self { links, volumes, pad: R::ZERO, walk })
    }

    /// Shapes in the tree.
    pub fn shapes(&self) -> usize {
        self.links.shapes()
    }

    /// Nodes that are not leaves.
    pub fn interior_nodes(&self) -> usize {
        self.links.interiors()
    }

    /// Levels of nodes; a single leaf is one. Time in proportion to the number of nodes.
    pub fn levels(&self) -> usize {
        self.links.levels()
    }

    /// What it has come to. Time in proportion to the number of nodes.
    pub fn summary(&self) -> Summary<R> {
        let (shapes, interior_nodes) = (self.shapes(), self.interior_nodes());
        Summary { shapes, interior_nodes, levels: self.levels(), cost: self.cost() }
    }

    fn volume(&self, node: usize) -> Option<B> {
        self.volumes.get(node).map(B::of)
    }

    fn set_volume(&mut self, node: usize, volume: B) {
        if let Some(place) = self.volumes.get_mut(node) {
            *place = volume.plain();
        }
    }

    /// Half the area of a node's bound.
    fn area(&self, node: usize) -> R {
        self.volume(node).map_or(R::ZERO, |volume| volume.half_area())
    }
}
