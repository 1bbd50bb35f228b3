//! The way of a ray through an object, from step to step.

use super::lists::{Lists, Spans};
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
        window: (R, R),
        skipping: bool,
        probe: &mut P,
        mut each: impl FnMut(Crossing<R>),
    ) {
        let per_ray = self.per_ray(ray);
        let (mut lists, mut spans) = (Lists::default(), Spans::default());
        let mut way = Way { ray, per_ray: &per_ray, lists: &mut lists, spans: &mut spans, probe };
        if !skipping {
            self.evaluate::<false>(object, &mut way, window, Front::Whole);
        } else if !self.passes_by(object, &way, window) {
            self.evaluate::<true>(object, &mut way, window, Front::Whole);
        }
        way.lists.top().iter().for_each(|crossing| each(*crossing));
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

    /// The first crossing with `min < t <= max`, from front to back: up to where the first operand is
    /// crossed, then up to where what came of that is, until that is a crossing of the object. So
    /// operands that begin farther away are not asked. The probe is told of every part that is tested,
    /// none of them twice.
    #[inline(never)]
    pub fn first_crossing<P: Probe>(
        &self,
        object: usize,
        ray: &Ray<R>,
        per_ray: &<Self as Shapes<R>>::PerRay,
        (min, max): (R, R),
        probe: &mut P,
    ) -> Option<Crossing<R>> {
        let (mut lists, mut spans) = (Lists::default(), Spans::default());
        let mut way = Way { ray, per_ray, lists: &mut lists, spans: &mut spans, probe };
        if self.passes_by(object, &way, (min, max)) {
            return None;
        }
        let (mut front, mut end) = (Front::Start, max);
        for turn in 1..=TURNS {
            if turn == TURNS {
                (front, end) = (Front::Whole, max);
            }
            let sure = self.evaluate::<true>(object, &mut way, (min, end), front)?;
            match way.lists.top().iter().find(|crossing| crossing.t > min) {
                Some(crossing) if crossing.t <= sure => return Some(*crossing),
                _ if !(sure < max) => return None,
                next => end = next.map_or(max, |crossing| crossing.t.min(max)),
            }
            front = Front::Beyond(sure);
        }
        None
    }

    /// Whether a ray does not come near an object within a window.
    fn passes_by<P>(&self, object: usize, way: &Way<'_, R, S, P, N>, window: (R, R)) -> bool {
        let bounds = self.trees.root(object).map(|root| self.trees.bounds(root));
        bounds.is_none_or(|bounds| passage(&way.per_ray.0, bounds, way.ray, window).is_none())
    }

    /// Lists an object's crossings, of which those from `min` up to the parameter that is given back
    /// count: `max`, or less.
    #[inline(never)]
    fn evaluate<const SKIPPING: bool>(
        &self,
        object: usize,
        way: &mut Way<'_, R, S, impl Probe, N>,
        (min, mut max): (R, R),
        front: Front<R>,
    ) -> Option<R> {
        let trees = &self.trees;
        let root = trees.root(object)?;
        let begin = trees.begin(object);
        way.lists.clear();
        // Of a second operand only what lies within the first counts, up to the join.
        let (mut within, mut join_within) = ((min, max), begin);
        let mut step = begin;
        while step <= root {
            match *trees.steps.get(step)? {
                Step::Join(operator) => way.lists.join(operator),
                Step::Part(part) => {
                    if step > join_within {
                        within = (min, max);
                    }
                    if SKIPPING && let Some((operator, join)) = trees.gate(step) {
                        let outermost = way.lists.depth() == 1;
                        if outermost {
                            max = front.end(operator, way.lists.top(), (min, max));
                            within = (min, max);
                        }
                        let inside = way.lists.matters(operator, within);
                        let matters = |inside| {
                            let bounds = trees.bounds(join - 1);
                            passage(&way.per_ray.0, bounds, way.ray, inside).is_some()
                        };
                        if !inside.is_some_and(matters) {
                            if operator == Operator::Intersection {
                                way.lists.clear_top();
                            }
                            step = join + 1;
                            continue;
                        }
                        if outermost {
                            (within, join_within) = (inside.unwrap_or(within), join);
                        }
                    }
                    // Every join has left one list less.
                    let place = (step - begin + way.lists.depth()) / 2;
                    let bounds = trees.bounds(step);
                    let span = self.span::<SKIPPING>(part, place, bounds, way, within);
                    way.lists.push(part, span);
                }
            }
            step += 1;
        }
        Some(max)
    }

    /// Where a ray is inside a part, held to the box in which that matters.
    fn span<const SKIPPING: bool>(
        &self,
        part: u16,
        place: usize,
        bounds: Aabb<R>,
        way: &mut Way<'_, R, S, impl Probe, N>,
        window: (R, R),
    ) -> Option<(R, R)> {
        if let Some(known) = way.spans.get(place) {
            return known;
        }
        let (slopes, per_ray) = way.per_ray;
        let all = (-R::INFINITY, R::INFINITY);
        let passage = passage(slopes, bounds, way.ray, if SKIPPING { window } else { all });
        if SKIPPING && passage.is_none() {
            return None;
        }
        way.probe.primitive_tests(1);
        let span = self.parts.span(usize::from(part), way.ray, per_ray);
        let held = passage.zip(span).and_then(|((enter, leave), (first, last))| {
            if !(first <= last) {
                return None;
            }
            let (first, last) = (first.max(enter), last.min(leave));
            (first <= last).then_some((first, last))
        });
        way.spans.set(place, held);
        held
    }
}

/// How often an object is looked at from front to back; the last time all that is left of it.
const TURNS: usize = 8;

/// How far to look along a ray before more operands are asked.
#[derive(Clone, Copy)]
enum Front<R> {
    /// To the end.
    Whole,
    /// No farther than to the start where that is inside the first operand, otherwise to where the
    /// ray meets it.
    Start,
    /// To where the first operand is crossed beyond a parameter up to which there is nothing.
    Beyond(R),
}

impl<R: Real> Front<R> {
    /// Where to stop, given the crossings of the first operand. Not before an intersection, which has
    /// none where only one operand is crossed.
    fn end(self, operator: Operator, first: &[Crossing<R>], (min, max): (R, R)) -> R {
        let known = match self {
            _ if operator == Operator::Intersection => return max,
            Self::Whole => return max,
            Self::Start => min,
            Self::Beyond(known) => known,
        };
        let Some(next) = first.iter().position(|crossing| crossing.t > known) else { return max };
        let inside = next % 2 == 1;
        match first.get(next) {
            Some(_)
                if inside && matches!((self, operator), (Self::Start, Operator::Difference)) =>
            {
                min
            }
            Some(crossing) => crossing.t.min(max),
            None => max,
        }
    }
}

/// A ray on its way through an object.
struct Way<'q, R: Real, S: Shapes<R>, P, const N: usize> {
    ray: &'q Ray<R>,
    per_ray: &'q (Slopes<R>, S::PerRay),
    /// What it crosses of pending operands.
    lists: &'q mut Lists<R, N>,
    /// Where it is inside of parts that were tested.
    spans: &'q mut Spans<R, N>,
    probe: &'q mut P,
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
