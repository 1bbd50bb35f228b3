//! The way of a ray through an object, from step to step.

use super::lists::Lists;
use super::{Crossing, Csg, Operator, Parts, Step};
use crate::geom::{Aabb, Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;
use crate::scene::Shapes;

impl<R: Real, S: Parts<R>, const N: usize> Csg<'_, R, S, N> {
    /// Every place where the line of a ray crosses the surface of an object, in order: it enters,
    /// leaves, enters and so on. `min` and `max` say of which part of the line all crossings are
    /// wanted; others may be left out. The probe is told of every part that is tested; without
    /// `skipping` these are all, and the crossings the same.
    pub fn crossings<P: Probe>(
        &self,
        object: usize,
        ray: &Ray<R>,
        (min, max): (R, R),
        skipping: bool,
        probe: &mut P,
        mut each: impl FnMut(Crossing<R>),
    ) {
        let per_ray = self.per_ray(ray);
        let lists = if skipping {
            self.evaluate::<true>(object, ray, &per_ray, (min, max), probe)
        } else {
            self.evaluate::<false>(object, ray, &per_ray, (min, max), probe)
        };
        if let Some(lists) = lists {
            lists.top().iter().for_each(|crossing| each(*crossing));
        }
    }

    /// The crossing that a hit came from, and whether the ray enters there.
    pub(super) fn crossing_at(&self, id: usize, ray: &Ray<R>, t: R) -> Option<(Crossing<R>, bool)> {
        let mut nearest: Option<(R, Crossing<R>, bool)> = None;
        let mut enters = false;
        self.crossings(id, ray, (t, t), true, &mut (), |crossing| {
            enters = !enters;
            let off = (crossing.t - t).abs();
            if nearest.is_none_or(|(least, ..)| off < least) {
                nearest = Some((off, crossing, enters));
            }
        });
        nearest.map(|(_, crossing, enters)| (crossing, enters))
    }

    /// The list of an object's crossings, of which those between `window.0` and `window.1` count;
    /// nothing when the ray passes by.
    #[inline(never)]
    pub(super) fn evaluate<const SKIPPING: bool>(
        &self,
        object: usize,
        ray: &Ray<R>,
        per_ray: &<Self as Shapes<R>>::PerRay,
        window: (R, R),
        probe: &mut impl Probe,
    ) -> Option<Lists<R, N>> {
        let trees = &self.trees;
        let root = trees.root(object)?;
        let slopes = &per_ray.0;
        if SKIPPING {
            passage(slopes, trees.bounds(root), ray, window)?;
        }
        let mut lists = Lists::default();
        let mut step = trees.begin(object);
        while step <= root {
            match *trees.steps.get(step)? {
                Step::Join(operator) => lists.join(operator),
                Step::Part(part) => {
                    if SKIPPING
                        && let Some((operator, join)) = trees.gate(step)
                        && !matters(
                            operator,
                            lists.top(),
                            passage(slopes, trees.bounds(join - 1), ray, window),
                        )
                    {
                        if operator == Operator::Intersection {
                            lists.clear_top();
                        }
                        step = join + 1;
                        continue;
                    }
                    let bounds = trees.bounds(step);
                    lists.push(
                        part,
                        self.span::<SKIPPING>(part, bounds, ray, per_ray, window, probe),
                    );
                }
            }
            step += 1;
        }
        Some(lists)
    }

    /// Where a ray is inside a part, held to the box in which that matters.
    fn span<const SKIPPING: bool>(
        &self,
        part: u16,
        bounds: Aabb<R>,
        ray: &Ray<R>,
        (slopes, per_ray): &<Self as Shapes<R>>::PerRay,
        window: (R, R),
        probe: &mut impl Probe,
    ) -> Option<(R, R)> {
        let all = (-R::INFINITY, R::INFINITY);
        let passage = passage(slopes, bounds, ray, if SKIPPING { window } else { all });
        if SKIPPING && passage.is_none() {
            return None;
        }
        probe.primitive_tests(1);
        let span = self.parts.span(usize::from(part), ray, per_ray);
        let ((enter, leave), (first, last)) = (passage?, span?);
        if !(first <= last) {
            return None;
        }
        let (first, last) = (first.max(enter), last.min(leave));
        (first <= last).then_some((first, last))
    }
}

/// Between which parameters a ray is in a box grown by its slack, if any of them is in the window.
fn passage<R: Real>(
    slopes: &Slopes<R>,
    bounds: Aabb<R>,
    ray: &Ray<R>,
    (min, max): (R, R),
) -> Option<(R, R)> {
    let bounds = bounds.grown(ray.slack());
    let (enter, leave) = slopes.clip(bounds.lo, bounds.hi, -R::INFINITY, R::INFINITY)?;
    (!(enter > max) && !(leave < min)).then_some((enter, leave))
}

/// Whether a second operand that is met on a passage only can change the list of the first.
fn matters<R: Real>(operator: Operator, first: &[Crossing<R>], passage: Option<(R, R)>) -> bool {
    let Some((enter, leave)) = passage else { return false };
    operator == Operator::Union
        || matches!((first.first(), first.last()), (Some(a), Some(b)) if a.t <= leave && b.t >= enter)
}
