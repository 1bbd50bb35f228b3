//! No structure, but bounds around those shapes for which they pay.
//!
//! H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", ACM TOG
//! 3(1) (1984).

use super::{Accel, BuildError, Id, Visitor};
use crate::bound::{Region, Stored};
use crate::geom::Ray;
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::probe::Probe;
use crate::scene::{Scene, Shapes};

/// Tests all shapes of a scene, some of them only where the ray hits the bound around them. `I`
/// stores ids of shapes.
#[derive(Debug)]
pub struct Bounded<'m, R: Real, B: Stored<R>, I> {
    shapes: usize,
    /// Those with a bound, in order.
    ids: &'m [I],
    volumes: &'m [B::Plain],
}

/// The bytes of so many bounds.
pub fn footprint<R: Real, B: Stored<R>, I: Id>(bounds: usize) -> Footprint {
    Footprint::of::<B::Plain>(bounds).then(Footprint::of::<I>(bounds))
}

impl<'m, R: Real, B: Stored<R>, I: Id> Bounded<'m, R, B, I> {
    /// Asks for every shape with an extent whether a bound around it pays, given its id and the
    /// probability that a ray that meets the scene meets that bound, by surfaces; see
    /// [`pays`](crate::bound::pays). It is asked twice, and has to answer the same.
    ///
    /// # Errors
    /// [`BuildError::Memory`] with the exact number of bytes; [`BuildError::TooMany`] when ids do
    /// not fit their type.
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        pays: impl Fn(usize, R) -> bool,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        BuildError::unless_fits::<I>("shapes", shapes)?;
        let around = |region: Region<R>| B::around(&region, scene.pad());
        let whole = around(Region::Box(scene.bounds())).half_area();
        let bounds = || {
            (0..shapes).filter_map(|id| {
                let bound = around(scene.shapes().region(id));
                let area = bound.half_area();
                let probability = if area < whole { area / whole } else { R::ONE };
                pays(id, probability).then_some((id, bound))
            })
        };
        let count = bounds().count();
        arena.require(footprint::<R, B, I>(count))?;
        let volumes = arena.keep::<B::Plain>("bounds", count)?;
        let ids = arena.keep::<I>("bounded shapes", count)?;
        for ((volume, place), (id, bound)) in volumes.iter_mut().zip(ids.iter_mut()).zip(bounds()) {
            (*volume, *place) = (bound.plain(), I::new(id));
        }
        Ok(Self { shapes, ids, volumes })
    }

    /// Those with a bound, in order.
    pub fn ids(&self) -> &'m [I] {
        self.ids
    }
}

impl<R: Real, B: Stored<R>, I: Id> Accel<R> for Bounded<'_, R, B, I> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let line = B::per_ray(ray);
        let mut next = 0;
        for (id, volume) in self.ids.iter().zip(self.volumes) {
            if !(visitor.start() < visitor.limit()) {
                return;
            }
            let id = id.get();
            if next < id {
                visitor.visit_range(next..id);
            }
            next = id + 1;
            visitor.probe().step();
            if B::of(volume).enter(&line, visitor.start(), visitor.limit()).is_some() {
                visitor.visit_range(id..next);
            }
        }
        if next < self.shapes && visitor.start() < visitor.limit() {
            visitor.visit_range(next..self.shapes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Naive, mailbox::Off};
    use crate::bound::KDop;
    use crate::geom::{Aabb, Interval};
    use crate::probe::Counters;
    use crate::shape::testing::Random;
    use crate::shape::{Cone, Plane, Sphere};

    type Kinds = (&'static [Sphere<f32>], (&'static [Cone<f32>], &'static [Plane<f32>]));

    extern crate std;
    use std::vec::Vec;
    use std::{println, vec};

    fn agrees<B: Stored<f32>>(scene: &Scene<'_, f32, Kinds>, random: &mut Random) {
        let shapes = scene.shapes().bounded();
        let rules: [fn(usize, f32) -> bool; 5] =
            [|_, _| true, |_, _| false, |id, _| id >= 12, |id, _| id % 3 == 1, |_, p| p < 0.1];
        for rule in rules {
            let mut words = vec![0_u64; 1000];
            let all: &mut [u8] = bytemuck::cast_slice_mut(&mut words);
            let bounded = Bounded::<f32, B, u16>::build(scene, rule, &mut Arena::new(all)).unwrap();
            let (count, naive) = (bounded.ids().len(), Naive::new(scene));
            let mut counters = Counters::default();
            for _ in 0..3000 {
                let (from, to) = (random.vector() * 4.0, random.vector() * 1.5);
                let Ok(ray) = Ray::new(from, to - from) else { continue };
                let hit = bounded.nearest(scene, &ray, Interval::RAY, &mut Off, &mut counters);
                let expected = naive.nearest(scene, &ray, Interval::RAY, &mut Off, &mut ());
                let bits = |hit: Option<crate::accel::Hit<f32>>| hit.map(|h| (h.id, h.t.to_bits()));
                assert_eq!(bits(hit), bits(expected));
                let any = bounded.occluded(scene, &ray, Interval::RAY, &mut Off, &mut ());
                assert_eq!(any, expected.is_some());
            }
            println!("{count} bounds of {shapes}, {} tests", counters.primitive_tests);
            // Exactly the bytes that are named will do.
            let exact = footprint::<f32, B, u16>(count).peak;
            let mut words = vec![0_u64; exact / 8];
            let all: &mut [u8] = bytemuck::cast_slice_mut(&mut words);
            assert!(
                Bounded::<f32, B, u16>::build(scene, rule, &mut Arena::new(&mut all[..])).is_ok()
            );
            if let Some(less) = exact.checked_sub(1) {
                let built =
                    Bounded::<f32, B, u16>::build(scene, rule, &mut Arena::new(&mut all[..less]));
                let error = crate::memory::OutOfArena { needed: exact, available: less };
                assert_eq!(built.err(), Some(BuildError::Memory(error)));
            }
        }
    }

    #[test]
    fn hits_are_those_of_testing_every_shape() {
        let mut random = Random(3);
        let spheres: Vec<_> =
            (0..12).map(|_| Sphere::new(random.vector(), random.within(0.05, 0.4))).collect();
        let cones: Vec<_> = (0..12)
            .map(|_| {
                let base = random.vector();
                Cone::new(base, base + random.vector() * 0.4, random.within(0.1, 0.3), 0.05)
            })
            .collect();
        let planes = vec![Plane::new(glam::vec3(0.0, 0.0, -1.2), glam::Vec3::Z)];
        let kinds: Kinds = (spheres.leak(), (cones.leak(), planes.leak()));
        let scene = Scene::new(kinds).unwrap();
        agrees::<Sphere<f32>>(&scene, &mut random);
        agrees::<Aabb<f32>>(&scene, &mut random);
        agrees::<KDop<f32, 7>>(&scene, &mut random);
    }
}
