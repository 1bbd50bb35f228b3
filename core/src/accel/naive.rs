//! No structure: every ray against every shape. The reference of all others, and the fastest for a
//! handful of shapes.

use super::{Accel, Visitor};
use crate::geom::{Aabb, Ray, Slopes};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// Tests all shapes of a scene; needs no memory.
#[derive(Clone, Copy, Debug)]
pub struct Naive {
    shapes: usize,
}

impl Naive {
    /// For the shapes of a scene.
    pub fn new<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Self {
        Self { shapes: scene.shapes().count() }
    }
}

impl<R: Real> Accel<R> for Naive {
    const HANDS_OVER_ALL: bool = true;

    fn walk<V: Visitor<R>>(&self, _ray: &Ray<R>, visitor: &mut V) {
        visitor.visit_range(0..self.shapes);
    }
}

/// Tests all shapes of a scene for rays that meet the box of those that have bounds; 32 bytes in
/// `f32`, none of an arena.
#[derive(Clone, Copy, Debug)]
pub struct Clipped<R: Real> {
    shapes: usize,
    bounds: Aabb<R>,
}

impl<R: Real> Clipped<R> {
    /// For the shapes of a scene.
    pub fn new<S: Shapes<R>>(scene: &Scene<'_, R, S>) -> Self {
        Self { shapes: scene.shapes().bounded(), bounds: scene.bounds().grown(scene.pad()) }
    }
}

impl<R: Real> Accel<R> for Clipped<R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let Aabb { lo, hi } = self.bounds;
        if Slopes::of(ray).clip(lo, hi, visitor.start(), visitor.limit()).is_some() {
            visitor.visit_range(0..self.shapes);
        }
    }
}
