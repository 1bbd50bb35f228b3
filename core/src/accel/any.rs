//! A structure whose kind is chosen while the program runs.

use super::octree::{self, AnyOctree};
use super::{Accel, BuildError, Bvh, Clipped, Grid, Id, Naive, Overlap, Visitor, bvh, grid};
use crate::geom::Ray;
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// Which structure, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Naive`].
    Naive,
    /// [`Clipped`].
    Clipped,
    /// [`Grid`].
    Grid(grid::Settings<Overlap>),
    /// An [`Octree`](super::Octree), within the memory that is free.
    Octree(octree::Settings),
    /// [`Bvh`] of so many nodes.
    Bvh(usize),
}

/// One of the structures, with the smallest numbers that suffice. Programs that know which one they
/// want name it, and the others are not linked.
#[derive(Debug)]
pub enum Any<'m, R: Real> {
    /// No structure.
    Naive(Naive),
    /// No structure but a box.
    Clipped(Clipped<R>),
    /// A grid with up to 65,535 shapes and references.
    SmallGrid(Grid<'m, R, u16, u16>),
    /// A grid with up to 65,535 shapes and more references.
    Grid(Grid<'m, R, u16, u32>),
    /// A grid with more shapes.
    LargeGrid(Grid<'m, R, u32, u32>),
    /// A grid with shared lists, up to 65,535 shapes and references.
    #[cfg(feature = "switches")]
    SmallShared(Grid<'m, R, u16, u16, true>),
    /// The same with more references.
    #[cfg(feature = "switches")]
    Shared(Grid<'m, R, u16, u32, true>),
    /// The same with more shapes.
    #[cfg(feature = "switches")]
    LargeShared(Grid<'m, R, u32, u32, true>),
    /// An octree.
    Octree(AnyOctree<'m, R>),
    /// A hierarchy of up to 65,535 shapes.
    Bvh(Bvh<'m, R, u16>),
    /// A hierarchy of more shapes.
    LargeBvh(Bvh<'m, R, u32>),
}

/// Which numbers a grid is stored in.
enum Width {
    Small,
    Medium,
    Large,
}

fn width(shapes: usize, size: grid::Size) -> Width {
    if shapes > <u16 as Id>::MAX {
        Width::Large
    } else if !size.fits::<u16>() {
        Width::Medium
    } else {
        Width::Small
    }
}

impl<'m, R: Real> Any<'m, R> {
    /// Builds a structure.
    ///
    /// # Errors
    /// Those of the structure.
    pub fn build<S: Shapes<R>>(
        kind: Kind,
        scene: &Scene<'_, R, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        Ok(match kind {
            Kind::Naive => Self::Naive(Naive::new(scene)),
            Kind::Clipped => Self::Clipped(Clipped::new(scene)),
            #[cfg(feature = "switches")]
            Kind::Grid(n) if n.shared => match width(shapes, grid::size(scene, n)) {
                Width::Small => Self::SmallShared(Grid::build_shared(scene, n, arena)?),
                Width::Medium => Self::Shared(Grid::build_shared(scene, n, arena)?),
                Width::Large => Self::LargeShared(Grid::build_shared(scene, n, arena)?),
            },
            Kind::Grid(n) => match width(shapes, grid::size(scene, n)) {
                Width::Small => Self::SmallGrid(Grid::build(scene, n, arena)?),
                Width::Medium => Self::Grid(Grid::build(scene, n, arena)?),
                Width::Large => Self::LargeGrid(Grid::build(scene, n, arena)?),
            },
            Kind::Octree(settings) => Self::Octree(AnyOctree::build(scene, settings, arena)?),
            Kind::Bvh(nodes) if shapes <= <u16 as Id>::MAX => {
                Self::Bvh(Bvh::build(scene, nodes, arena)?)
            }
            Kind::Bvh(nodes) => Self::LargeBvh(Bvh::build(scene, nodes, arena)?),
        })
    }

    /// The same structure for rays that differ from one another: see [`Bvh::for_incoherent_rays`].
    #[must_use]
    pub fn for_incoherent_rays(self) -> Self {
        match self {
            Self::Bvh(bvh) => Self::Bvh(bvh.for_incoherent_rays()),
            Self::LargeBvh(bvh) => Self::LargeBvh(bvh.for_incoherent_rays()),
            other => other,
        }
    }

    /// The bytes that [`Any::build`] takes; for an octree those without shortage, as it can do with
    /// less.
    ///
    /// # Errors
    /// Those of the structure, [`BuildError::Memory`] excepted.
    pub fn footprint<S: Shapes<R>>(
        kind: Kind,
        scene: &Scene<'_, R, S>,
    ) -> Result<Footprint, BuildError> {
        match kind {
            Kind::Octree(settings) => AnyOctree::footprint(scene, settings),
            kind => Ok(Self::least(kind, scene)),
        }
    }

    /// The fewest bytes that [`Any::build`] takes: as [`Any::footprint`], but for an octree those of
    /// a single cell. Links no code that divides cells.
    pub fn least<S: Shapes<R>>(kind: Kind, scene: &Scene<'_, R, S>) -> Footprint {
        let shapes = scene.shapes().bounded();
        let narrow = shapes <= <u16 as Id>::MAX;
        match kind {
            Kind::Naive | Kind::Clipped => Footprint::default(),
            Kind::Grid(n) => {
                let size = grid::size(scene, n);
                match width(shapes, size) {
                    Width::Small => size.footprint::<u16, u16>(),
                    Width::Medium => size.footprint::<u16, u32>(),
                    Width::Large => size.footprint::<u32, u32>(),
                }
            }
            Kind::Octree(settings) => AnyOctree::least(scene, settings),
            Kind::Bvh(nodes) if narrow => bvh::footprint::<u16>(shapes, nodes),
            Kind::Bvh(nodes) => bvh::footprint::<u32>(shapes, nodes),
        }
    }
}

impl<R: Real> Accel<R> for Any<'_, R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        match self {
            Self::Naive(naive) => naive.walk(ray, visitor),
            Self::Clipped(clipped) => clipped.walk(ray, visitor),
            Self::SmallGrid(grid) => grid.walk(ray, visitor),
            Self::Grid(grid) => grid.walk(ray, visitor),
            Self::LargeGrid(grid) => grid.walk(ray, visitor),
            #[cfg(feature = "switches")]
            Self::SmallShared(grid) => grid.walk(ray, visitor),
            #[cfg(feature = "switches")]
            Self::Shared(grid) => grid.walk(ray, visitor),
            #[cfg(feature = "switches")]
            Self::LargeShared(grid) => grid.walk(ray, visitor),
            Self::Octree(octree) => octree.walk(ray, visitor),
            Self::Bvh(bvh) => bvh.walk(ray, visitor),
            Self::LargeBvh(bvh) => bvh.walk(ray, visitor),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::octree::Limits;
    use crate::shape::Sphere;
    use glam::Vec3;

    #[test]
    fn the_least_octree_is_its_root() {
        static SPHERES: [Sphere<f32>; 65_536] = [Sphere::new(Vec3::ONE, 1.0); 65_536];
        for shapes in [0, 1, 2, 1000, 65_535, 65_536] {
            let scene = Scene::new(&SPHERES[..shapes]).unwrap();
            let root = Kind::Octree(Limits { max_objects: 0, max_level: 0 }.into());
            let footprint = Any::footprint(root, &scene).unwrap();
            let deep = Kind::Octree(Limits { max_objects: 0, max_level: 9 }.into());
            assert_eq!(Any::least(deep, &scene), footprint, "{shapes}");
        }
    }
}
