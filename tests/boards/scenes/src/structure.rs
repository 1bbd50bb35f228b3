//! Structures with their parameters, as types: what a subject names, and nothing else, is linked.

use kibiray::accel::octree::{self, StoppedBy};
use kibiray::accel::{self, Accel, BuildError};
use kibiray::memory::Arena;
use kibiray::scene::{Scene, Shapes};

/// A structure and its parameters.
pub trait Structure {
    /// What reports call it.
    const NAME: &'static str;
    /// What is built.
    type Built<'m>: Accel<f32>;

    /// Builds it over a scene.
    ///
    /// # Errors
    /// Those of the core.
    fn build<'m, S: Shapes<f32>>(
        scene: &Scene<'_, f32, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError>;

    /// Why it is not finer.
    fn stopped_by(_built: &Self::Built<'_>) -> StoppedBy {
        StoppedBy::Done
    }
}

/// Every ray against every shape.
#[derive(Clone, Copy, Debug)]
pub struct Naive;

impl Structure for Naive {
    const NAME: &'static str = "naive";
    type Built<'m> = accel::Naive;

    fn build<'m, S: Shapes<f32>>(
        scene: &Scene<'_, f32, S>,
        _arena: &mut Arena<'m>,
    ) -> Result<accel::Naive, BuildError> {
        Ok(accel::Naive::new(scene))
    }
}

/// A grid with so many cells along each axis.
#[derive(Clone, Copy, Debug)]
pub struct Grid<const X: u32, const Y: u32, const Z: u32>;

impl<const X: u32, const Y: u32, const Z: u32> Structure for Grid<X, Y, Z> {
    const NAME: &'static str = "grid";
    type Built<'m> = accel::Grid<'m, f32, u16, u16>;

    fn build<'m, S: Shapes<f32>>(
        scene: &Scene<'_, f32, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        accel::Grid::build(scene, [X, Y, Z], arena)
    }
}

/// An octree whose cells are divided while they list more than so many shapes, down to a level.
#[derive(Clone, Copy, Debug)]
pub struct Octree<const OBJECTS: usize, const LEVEL: u32>;

impl<const OBJECTS: usize, const LEVEL: u32> Structure for Octree<OBJECTS, LEVEL> {
    const NAME: &'static str = "octree";
    type Built<'m> = accel::Octree<'m, f32, u16>;

    fn build<'m, S: Shapes<f32>>(
        scene: &Scene<'_, f32, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self::Built<'m>, BuildError> {
        let limits = octree::Limits { max_objects: OBJECTS, max_level: LEVEL };
        accel::Octree::build(scene, limits, arena)
    }

    fn stopped_by(built: &Self::Built<'_>) -> StoppedBy {
        built.stopped_by()
    }
}
