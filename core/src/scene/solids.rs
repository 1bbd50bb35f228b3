//! All kinds of shapes together: one table a kind.

use super::Shapes;
use crate::bound::Region;
use crate::geom::{Aabb, Ray};
use crate::num::{Real, Vec3, Vector};
use crate::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Shape, ShapeError, Sphere, Triangle};
use core::ops::Range;

/// Triangles, of which the first few may have a normal at each corner.
#[derive(Clone, Copy, Debug, Default)]
pub struct Triangles<'a, R: Real> {
    /// The triangles.
    pub triangles: &'a [Triangle<R>],
    /// Normals at the corners of the first `normals.len()` triangles, of any length.
    pub normals: &'a [[Vec3<R>; 3]],
}

impl<R: Real> Shapes<R> for Triangles<'_, R> {
    type PerRay = <Triangle<R> as Shape<R>>::PerRay;

    const UNBOUNDED: bool = false;
    const FLAT: bool = true;

    fn count(&self) -> usize {
        self.triangles.count()
    }

    fn bounded(&self) -> usize {
        self.triangles.bounded()
    }

    fn check(&self, id: usize) -> Result<(), ShapeError> {
        let finite = self.normals.get(id).is_none_or(|n| n.iter().all(|n| n.is_finite()));
        if finite { self.triangles.check(id) } else { Err(ShapeError::NotFinite) }
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        self.triangles.bounds(id)
    }

    fn region(&self, id: usize) -> Region<R> {
        self.triangles.region(id)
    }

    fn overlaps(&self, id: usize, cell: &Aabb<R>) -> bool {
        self.triangles.overlaps(id, cell)
    }

    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay {
        self.triangles.per_ray(ray)
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R> {
        self.triangles.hit(id, ray, per_ray, min, max)
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        self.triangles.occludes(id, ray, per_ray, min, max)
    }

    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<(usize, R)> {
        self.triangles.nearest_of(ids, ray, per_ray, min, max)
    }

    fn any_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        self.triangles.any_of(ids, ray, per_ray, min, max)
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        self.triangles.normal(id, ray, t)
    }

    fn shading_normal(&self, id: usize, ray: &Ray<R>, _t: R) -> Option<Vec3<R>> {
        let [a, b, c] = self.normals.get(id)?;
        let [u, v, w] = self.triangles.get(id)?.barycentric(ray);
        Some(*a * u + *b * v + *c * w)
    }

    fn is_flat(&self, _id: usize) -> bool {
        true
    }
}

/// Every kind of shape, one table a kind; tables not needed stay empty.
///
/// Ids run through the tables in the order of the fields, so an id tells its kind.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solids<'a, R: Real> {
    /// Spheres.
    pub spheres: &'a [Sphere<R>],
    /// Triangles.
    pub triangles: Triangles<'a, R>,
    /// Planar polygons.
    pub polygons: &'a [Polygon<'a, R>],
    /// Axis-aligned boxes.
    pub boxes: &'a [AxisBox<R>],
    /// Cylinders.
    pub cylinders: &'a [Cylinder<R>],
    /// Cone frustums.
    pub cones: &'a [Cone<R>],
    /// Infinite planes, which are in no structure: every ray is tested against every one.
    pub planes: &'a [Plane<R>],
}

/// One set after the other, in the order of the fields of [`Solids`].
type Chain<'a, R> = (
    &'a [Sphere<R>],
    (
        Triangles<'a, R>,
        (
            &'a [Polygon<'a, R>],
            (&'a [AxisBox<R>], (&'a [Cylinder<R>], (&'a [Cone<R>], &'a [Plane<R>]))),
        ),
    ),
);

impl<'a, R: Real> Solids<'a, R> {
    fn chain(&self) -> Chain<'a, R> {
        let rest = (self.cylinders, (self.cones, self.planes));
        (self.spheres, (self.triangles, (self.polygons, (self.boxes, rest))))
    }
}

impl<'a, R: Real> Shapes<R> for Solids<'a, R> {
    type PerRay = <Chain<'a, R> as Shapes<R>>::PerRay;

    const FLAT: bool = true;

    fn count(&self) -> usize {
        self.chain().count()
    }

    fn bounded(&self) -> usize {
        self.chain().bounded()
    }

    fn check(&self, id: usize) -> Result<(), ShapeError> {
        self.chain().check(id)
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        self.chain().bounds(id)
    }

    fn region(&self, id: usize) -> Region<R> {
        self.chain().region(id)
    }

    fn overlaps(&self, id: usize, cell: &Aabb<R>) -> bool {
        self.chain().overlaps(id, cell)
    }

    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay {
        self.chain().per_ray(ray)
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R> {
        self.chain().hit(id, ray, per_ray, min, max)
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        self.chain().occludes(id, ray, per_ray, min, max)
    }

    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<(usize, R)> {
        self.chain().nearest_of(ids, ray, per_ray, min, max)
    }

    fn any_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        self.chain().any_of(ids, ray, per_ray, min, max)
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        self.chain().normal(id, ray, t)
    }

    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>> {
        self.chain().shading_normal(id, ray, t)
    }

    fn reach(&self, id: usize) -> R {
        self.chain().reach(id)
    }

    fn is_flat(&self, id: usize) -> bool {
        self.chain().is_flat(id)
    }
}
