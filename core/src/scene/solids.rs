//! All kinds of shapes together: one table a kind.

use super::Shapes;
use crate::bound::Region;
use crate::geom::{Aabb, Ray, Slopes};
use crate::num::{Real, Vec3, Vector};
use crate::shape::{
    AxisBox, Cone, Cylinder, Length, Plane, Polygon, Shape, ShapeError, Shear, Sphere, Triangle,
};
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

/// What shapes of all kinds want to know of a ray: what several kinds do is there once.
#[derive(Clone, Copy, Debug, Default)]
pub struct PerRay<R: Real> {
    length: Length<R>,
    shear: Shear<R>,
    slopes: Slopes<R>,
}

/// A shape of one of the kinds.
enum Solid<'a, R: Real> {
    Sphere(&'a Sphere<R>),
    Triangle(&'a Triangle<R>),
    Polygon(&'a Polygon<'a, R>),
    Box(&'a AxisBox<R>),
    Cylinder(&'a Cylinder<R>),
    Cone(&'a Cone<R>),
    Plane(&'a Plane<R>),
}

impl<'a, R: Real> Solids<'a, R> {
    fn chain(&self) -> Chain<'a, R> {
        let rest = (self.cylinders, (self.cones, self.planes));
        (self.spheres, (self.triangles, (self.polygons, (self.boxes, rest))))
    }

    /// The shape with an id, if there is one.
    fn solid(&self, id: usize) -> Option<Solid<'a, R>> {
        let mut id = id;
        let id = &mut id;
        take(self.spheres, id)
            .map(Solid::Sphere)
            .or_else(|| take(self.triangles.triangles, id).map(Solid::Triangle))
            .or_else(|| take(self.polygons, id).map(Solid::Polygon))
            .or_else(|| take(self.boxes, id).map(Solid::Box))
            .or_else(|| take(self.cylinders, id).map(Solid::Cylinder))
            .or_else(|| take(self.cones, id).map(Solid::Cone))
            .or_else(|| take(self.planes, id).map(Solid::Plane))
    }
}

/// A search through one table after the other.
struct Search<R> {
    /// What is left to be tested, counted from behind the tables that were searched.
    ids: Range<usize>,
    /// How many shapes these have.
    count: usize,
    found: Option<(usize, R)>,
    max: R,
}

impl<R: Real> Search<R> {
    /// The ids that are in the next table, as it counts them, and the number of shapes before it.
    fn next(&mut self, len: usize) -> (Range<usize>, usize) {
        let Range { start, end } = self.ids;
        self.ids = start.saturating_sub(len)..end.saturating_sub(len);
        let before = self.count;
        self.count += len;
        (start.min(len)..end.min(len), before)
    }

    fn nearest<T: Shape<R>>(&mut self, table: &[T], ray: &Ray<R>, per_ray: &T::PerRay, min: R) {
        let (ids, before) = self.next(table.len());
        if let Some((id, t)) = table.nearest_of(ids, ray, per_ray, min, self.max)
            && (t < self.max || self.found.is_none())
        {
            (self.found, self.max) = (Some((before + id, t)), t);
        }
    }

    fn any<T: Shape<R>>(
        &mut self,
        table: &[T],
        ray: &Ray<R>,
        per_ray: &T::PerRay,
        min: R,
    ) -> Option<usize> {
        let (ids, before) = self.next(table.len());
        Some(before + table.any_of(ids, ray, per_ray, min, self.max)?)
    }
}

/// The shape with an id in the first of some tables; otherwise the id is made one of the rest.
fn take<'a, T>(first: &'a [T], id: &mut usize) -> Option<&'a T> {
    let shape = first.get(*id);
    if shape.is_none() {
        *id -= first.len();
    }
    shape
}

// Kinds so small that their tests would become part of what chooses between them: apart, so that what
// they take is not on the stack while another kind is tested. The others are apart by themselves.

#[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
fn hit<R: Real, T: Shape<R>>(
    shape: &T,
    ray: &Ray<R>,
    per_ray: &T::PerRay,
    min: R,
    max: R,
) -> Option<R> {
    shape.hit(ray, per_ray, min, max)
}

#[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
fn occludes<R: Real, T: Shape<R>>(
    shape: &T,
    ray: &Ray<R>,
    per_ray: &T::PerRay,
    min: R,
    max: R,
) -> bool {
    shape.occludes(ray, per_ray, min, max)
}

#[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
fn normal<R: Real, T: Shape<R>>(shape: &T, ray: &Ray<R>, t: R) -> Vec3<R> {
    shape.normal(ray, t)
}

impl<'a, R: Real> Shapes<R> for Solids<'a, R> {
    type PerRay = PerRay<R>;

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

    fn per_ray(&self, ray: &Ray<R>) -> PerRay<R> {
        let Self { spheres, triangles, polygons, boxes, cylinders, cones, .. } = self;
        let mut it = PerRay::default();
        if !(spheres.is_empty() && cylinders.is_empty() && cones.is_empty()) {
            it.length = Length::of(ray);
        }
        if !(triangles.triangles.is_empty() && polygons.is_empty()) {
            it.shear = Shear::of(ray);
        }
        if !boxes.is_empty() {
            it.slopes = Slopes::of(ray);
        }
        it
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &PerRay<R>, min: R, max: R) -> Option<R> {
        match self.solid(id)? {
            Solid::Sphere(it) => hit(it, ray, &per_ray.length, min, max),
            Solid::Triangle(it) => hit(it, ray, &per_ray.shear, min, max),
            Solid::Polygon(it) => it.hit(ray, &per_ray.shear, min, max),
            Solid::Box(it) => hit(it, ray, &per_ray.slopes, min, max),
            Solid::Cylinder(it) => it.hit(ray, &per_ray.length, min, max),
            Solid::Cone(it) => it.hit(ray, &per_ray.length, min, max),
            Solid::Plane(it) => hit(it, ray, &(), min, max),
        }
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &PerRay<R>, min: R, max: R) -> bool {
        match self.solid(id) {
            None => false,
            Some(Solid::Sphere(it)) => occludes(it, ray, &per_ray.length, min, max),
            Some(Solid::Triangle(it)) => occludes(it, ray, &per_ray.shear, min, max),
            Some(Solid::Polygon(it)) => it.occludes(ray, &per_ray.shear, min, max),
            Some(Solid::Box(it)) => occludes(it, ray, &per_ray.slopes, min, max),
            Some(Solid::Cylinder(it)) => it.occludes(ray, &per_ray.length, min, max),
            Some(Solid::Cone(it)) => it.occludes(ray, &per_ray.length, min, max),
            Some(Solid::Plane(it)) => occludes(it, ray, &(), min, max),
        }
    }

    fn nearest_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<(usize, R)> {
        let mut search = Search { ids, count: 0, found: None, max };
        search.nearest(self.spheres, ray, &per_ray.length, min);
        search.nearest(self.triangles.triangles, ray, &per_ray.shear, min);
        search.nearest(self.polygons, ray, &per_ray.shear, min);
        search.nearest(self.boxes, ray, &per_ray.slopes, min);
        search.nearest(self.cylinders, ray, &per_ray.length, min);
        search.nearest(self.cones, ray, &per_ray.length, min);
        search.nearest(self.planes, ray, &(), min);
        search.found
    }

    fn any_of(
        &self,
        ids: Range<usize>,
        ray: &Ray<R>,
        per_ray: &Self::PerRay,
        min: R,
        max: R,
    ) -> Option<usize> {
        let mut search = Search { ids, count: 0, found: None, max };
        search
            .any(self.spheres, ray, &per_ray.length, min)
            .or_else(|| search.any(self.triangles.triangles, ray, &per_ray.shear, min))
            .or_else(|| search.any(self.polygons, ray, &per_ray.shear, min))
            .or_else(|| search.any(self.boxes, ray, &per_ray.slopes, min))
            .or_else(|| search.any(self.cylinders, ray, &per_ray.length, min))
            .or_else(|| search.any(self.cones, ray, &per_ray.length, min))
            .or_else(|| search.any(self.planes, ray, &(), min))
    }

    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        match self.solid(id) {
            None => Vec3::<R>::default(),
            Some(Solid::Sphere(it)) => normal(it, ray, t),
            Some(Solid::Triangle(it)) => normal(it, ray, t),
            Some(Solid::Polygon(it)) => it.normal(ray, t),
            Some(Solid::Box(it)) => normal(it, ray, t),
            Some(Solid::Cylinder(it)) => it.normal(ray, t),
            Some(Solid::Cone(it)) => it.normal(ray, t),
            Some(Solid::Plane(it)) => normal(it, ray, t),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::testing::Random;
    use glam::vec3;

    #[test]
    fn ranges_through_all_kinds_are_searched_like_shapes_one_by_one() {
        let mut random = Random(5);
        let mut near = || random.vector() * 2.0;
        let spheres = [0.3, 0.8].map(|radius| Sphere::<f32>::new(near(), radius));
        let triangles = [(); 3].map(|()| Triangle::new(near(), near(), near()));
        let corners = [vec3(-1.0, -1.0, 0.4), vec3(1.5, -1.0, 0.4), vec3(0.0, 1.5, 0.4)];
        let solids = Solids {
            spheres: &spheres,
            triangles: Triangles { triangles: &triangles, normals: &[] },
            polygons: &[Polygon::new(&corners)],
            boxes: &[AxisBox::new(vec3(-0.5, -0.6, -0.7), vec3(0.4, 0.3, 0.2))],
            cylinders: &[Cylinder::new(vec3(1.0, 0.0, -1.0), vec3(1.0, 1.0, 1.0), 0.4)],
            cones: &[Cone::new(vec3(-1.0, 0.0, -1.0), vec3(-1.0, 0.5, 1.0), 0.7, 0.1)],
            planes: &[Plane::new(vec3(0.0, 0.0, -1.5), vec3(0.1, 0.2, 1.0))],
        };
        let (count, mut hits) = (solids.count(), 0);
        assert_eq!((count, solids.bounded()), (10, 9));
        for _ in 0..2000 {
            let (from, to) = (random.vector() * 4.0, random.vector());
            let Ok(ray) = Ray::new(from, to - from) else { continue };
            let per_ray = solids.per_ray(&ray);
            for ids in [0..count, 1..4, 2..7, 5..5, 4..count, 0..9] {
                let hit = |id| solids.hit(id, &ray, &per_ray, 0.0, 2.0);
                let mut nearest: Option<(usize, f32)> = None;
                for id in ids.clone() {
                    if let Some(t) = hit(id)
                        && nearest.is_none_or(|(_, least)| t < least)
                    {
                        nearest = Some((id, t));
                    }
                }
                assert_eq!(solids.nearest_of(ids.clone(), &ray, &per_ray, 0.0, 2.0), nearest);
                let first = ids.clone().find(|id| hit(*id).is_some());
                assert_eq!(solids.any_of(ids, &ray, &per_ray, 0.0, 2.0), first);
                hits += usize::from(nearest.is_some());
            }
        }
        assert!(hits > 2000, "{hits}");
    }
}
