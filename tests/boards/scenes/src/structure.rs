//! Structures with their parameters, as types: what a subject names, and nothing else, is linked.

use kibiray::accel::octree::{self, StoppedBy};
use kibiray::accel::{self, Accel, BuildError, Mailbox, Overlap, grid, mailbox, tree};
use kibiray::geom::Aabb;
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Scene, Shapes};

/// A structure and its parameters.
pub trait Structure<R: Real> {
    /// What reports call it.
    const NAME: &'static str;
    /// What is built.
    type Built<'m>: Accel<R>;
    /// What keeps queries from testing a shape twice.
    type Mailbox<'m>: Mailbox;

    /// Builds it over a scene.
    ///
    /// # Errors
    /// Those of the core.
    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError>;

    /// Makes the mailbox.
    ///
    /// # Errors
    /// Those of the core.
    fn mailbox<'m>(shapes: usize, arena: &mut Arena<'m>) -> Result<Self::Mailbox<'m>, BuildError>;

    /// Why it is not finer.
    fn stopped_by(_built: &Self::Built<'_>) -> StoppedBy {
        StoppedBy::Done
    }
}

/// Every ray against every shape.
#[derive(Clone, Copy, Debug)]
pub struct Naive;

impl<R: Real> Structure<R> for Naive {
    const NAME: &'static str = "naive";
    type Built<'m> = accel::Naive;
    type Mailbox<'m> = mailbox::Off;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        _arena: &mut Arena<'m>,
    ) -> Result<accel::Naive, BuildError> {
        Ok(accel::Naive::new(scene))
    }

    fn mailbox<'m>(_shapes: usize, _arena: &mut Arena<'m>) -> Result<mailbox::Off, BuildError> {
        Ok(mailbox::Off)
    }
}

/// A grid with so many cells along each axis.
#[derive(Clone, Copy, Debug)]
pub struct Grid<const X: u32, const Y: u32, const Z: u32>;

impl<R: Real, const X: u32, const Y: u32, const Z: u32> Structure<R> for Grid<X, Y, Z> {
    const NAME: &'static str = "grid";
    type Built<'m> = accel::Grid<'m, R, u16, u16>;
    type Mailbox<'m> = mailbox::Off;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        accel::Grid::build(scene, [X, Y, Z], arena)
    }

    fn mailbox<'m>(_shapes: usize, _arena: &mut Arena<'m>) -> Result<mailbox::Off, BuildError> {
        Ok(mailbox::Off)
    }
}

/// The same with a stamp of a byte for every shape: none is tested twice. Cells list shapes by their boxes or,
/// for more work while it is built, exactly.
#[derive(Clone, Copy, Debug)]
pub struct StampedGrid<const X: u32, const Y: u32, const Z: u32, const EXACT: bool = false>;

impl<R: Real, const X: u32, const Y: u32, const Z: u32, const EXACT: bool> Structure<R>
    for StampedGrid<X, Y, Z, EXACT>
{
    const NAME: &'static str = "stamped-grid";
    type Built<'m> = accel::Grid<'m, R, u16, u16>;
    type Mailbox<'m> = mailbox::Stamps<'m, u8>;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        if EXACT {
            let overlap = Overlap::Exact;
            let settings = grid::Settings { overlap, ..grid::Settings::new([X, Y, Z]) };
            accel::Grid::build(scene, settings, arena)
        } else {
            accel::Grid::build(scene, [X, Y, Z], arena)
        }
    }

    fn mailbox<'m>(shapes: usize, arena: &mut Arena<'m>) -> Result<Self::Mailbox<'m>, BuildError> {
        Ok(mailbox::Stamps::short(shapes, arena)?)
    }
}

/// An octree whose cells are divided while they list more than so many shapes, down to a level.
#[derive(Clone, Copy, Debug)]
pub struct Octree<const OBJECTS: usize, const LEVEL: u32>;

impl<R: Real, const OBJECTS: usize, const LEVEL: u32> Structure<R> for Octree<OBJECTS, LEVEL> {
    const NAME: &'static str = "octree";
    type Built<'m> = accel::Octree<'m, R, u16>;
    type Mailbox<'m> = mailbox::Off;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        let limits = octree::Limits { max_objects: OBJECTS, max_level: LEVEL };
        accel::Octree::build(scene, limits, arena)
    }

    fn mailbox<'m>(_shapes: usize, _arena: &mut Arena<'m>) -> Result<mailbox::Off, BuildError> {
        Ok(mailbox::Off)
    }

    fn stopped_by(built: &Self::Built<'_>) -> StoppedBy {
        built.stopped_by()
    }
}

/// A hierarchy of boxes with so many nodes.
#[derive(Clone, Copy, Debug)]
pub struct Bvh<const NODES: usize>;

impl<R: Real, const NODES: usize> Structure<R> for Bvh<NODES> {
    const NAME: &'static str = "bvh";
    type Built<'m> = accel::Bvh<'m, R, u16>;
    type Mailbox<'m> = mailbox::Off;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        accel::Bvh::build(scene, NODES, arena)
    }

    fn mailbox<'m>(_shapes: usize, _arena: &mut Arena<'m>) -> Result<mailbox::Off, BuildError> {
        Ok(mailbox::Off)
    }
}

/// A tree of boxes, into which one shape is inserted after the other in the order of their ids.
#[derive(Clone, Copy, Debug)]
pub struct Tree;

impl<R: Real> Structure<R> for Tree {
    const NAME: &'static str = "tree";
    type Built<'m> = accel::Tree<'m, R, Aabb<R>, u16>;
    type Mailbox<'m> = mailbox::Off;

    fn build<'m, S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        let builder = tree::Builder::GoldsmithSalmon(tree::Insertion::File);
        accel::Tree::build(scene, tree::Settings { builder, ..Default::default() }, arena)
    }

    fn mailbox<'m>(_shapes: usize, _arena: &mut Arena<'m>) -> Result<mailbox::Off, BuildError> {
        Ok(mailbox::Off)
    }
}
