//! The structures with 16 bits a number: `kibiray::accel::Any` without those for scenes of more
//! than 65,535 shapes, which the page has not got, in half the code.

use kibiray::accel::octree::{Growth, Order};
use kibiray::accel::{self, Accel, BuildError, Bvh, Grid, Naive, Octree, Visitor};
use kibiray::geom::Ray;
use kibiray::memory::Arena;
use kibiray::scene::{Scene, Shapes};

pub(crate) enum Small<'m> {
    Naive(Naive),
    Grid(Grid<'m, f32, u16, u16>),
    Octree(Octree<'m, f32, u16>),
    Bvh(Bvh<'m, f32, u16>),
}

impl<'m> Small<'m> {
    pub(crate) fn build<S: Shapes<f32>>(
        kind: accel::Kind,
        scene: &Scene<'_, f32, S>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        Ok(match kind {
            accel::Kind::Naive | accel::Kind::Clipped => Self::Naive(Naive::new(scene)),
            accel::Kind::Grid(cells) => Self::Grid(Grid::build(scene, cells, arena)?),
            accel::Kind::Octree(settings) => {
                // The page has one order only, and lists of their own; the others are not linked.
                let Growth { limits, huge, lists, .. } = settings.growth;
                let growth = Growth { limits, huge, lists: lists.overlap, order: Order::Breadth };
                Self::Octree(Octree::build(scene, growth, arena)?)
            }
            accel::Kind::Bvh(nodes) => Self::Bvh(Bvh::build(scene, nodes, arena)?),
        })
    }
}

impl Accel<f32> for Small<'_> {
    fn walk<V: Visitor<f32>>(&self, ray: &Ray<f32>, visitor: &mut V) {
        match self {
            Self::Naive(naive) => naive.walk(ray, visitor),
            Self::Grid(grid) => grid.walk(ray, visitor),
            Self::Octree(octree) => octree.walk(ray, visitor),
            Self::Bvh(bvh) => bvh.walk(ray, visitor),
        }
    }
}
