//! The query trait: nearest hit and any hit, by one walk through a structure.

use super::Mailbox;
use crate::geom::{Interval, Ray};
use crate::num::{FOURS, Real};
use crate::probe::Probe;
use crate::scene::{Framing, Scene, Shapes};
use core::ops::Range;

/// A place where a ray meets a shape. What shading needs besides is computed when it is asked for:
/// [`Scene::surface`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<R> {
    /// Parameter along the ray, in lengths of its direction.
    pub t: R,
    /// Which shape.
    pub id: usize,
    /// Parameter along the ray as it was traced.
    pub(crate) local: R,
    /// Whether it was traced as it was asked for; otherwise see [`Framing`].
    pub(crate) as_asked: bool,
}

/// Takes the shapes that a structure finds on the way of a ray.
pub trait Visitor<R: Real> {
    /// What counts the work.
    type Probe: Probe;

    /// Whether the first hit ends the walk, whichever it is.
    const STOPS: bool = false;

    /// Where the walk begins.
    fn start(&self) -> R;

    /// What lies beyond this parameter is of no interest any more.
    fn limit(&self) -> R;

    /// Whether the shapes of a list that has this number still have to be visited. A list that has
    /// been answered for counts as visited.
    fn admit_list(&mut self, _list: usize) -> bool {
        true
    }

    /// Shapes that the ray may meet.
    fn visit(&mut self, ids: impl Iterator<Item = usize>);

    /// Shapes that no other list names.
    fn visit_range(&mut self, ids: Range<usize>);

    /// The counters.
    fn probe(&mut self) -> &mut Self::Probe;
}

/// A structure over the shapes of a scene.
pub trait Accel<R: Real> {
    /// Whether [`Accel::walk`] hands over shapes without bounds, too; no division of space can.
    const HANDS_OVER_ALL: bool = false;

    /// Walks along a ray from [`Visitor::start`] and hands over the lists of the cells that it
    /// passes, in order, until [`Visitor::limit`] is reached. Steps are bounded by the number of
    /// cells.
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V);

    /// The first hit of a ray within an open interval; of several at the same `t` the one with the
    /// least id.
    fn nearest<S: Shapes<R>>(
        &self,
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        interval: Interval<R>,
        mailbox: &mut impl Mailbox,
        probe: &mut impl Probe,
    ) -> Option<Hit<R>> {
        let as_asked = Framing::is_needless(scene, ray);
        let goal = Nearest { id: Nearest::NONE };
        let (Nearest { id }, local) = search(self, scene, ray, interval, mailbox, probe, goal);
        if id == Nearest::NONE {
            return None;
        }
        let t = if as_asked { local } else { Framing::restored(scene, ray, interval, local) };
        Some(Hit { t, id, local, as_asked })
    }

    /// Whether anything is hit within an open interval. Stops at the first hit it finds.
    fn occluded<S: Shapes<R>>(
        &self,
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        interval: Interval<R>,
        mailbox: &mut impl Mailbox,
        probe: &mut impl Probe,
    ) -> bool {
        self.blocker(scene, ray, interval, None, mailbox, probe).is_some()
    }

    /// Some shape that is hit within an open interval, if any is. The one that is guessed is tried
    /// first: what blocked a light's last ray often blocks the next (E. Haines, D. Greenberg, "The
    /// light buffer", IEEE CG&A 6(9), 1986).
    fn blocker<S: Shapes<R>>(
        &self,
        scene: &Scene<'_, R, S>,
        ray: &Ray<R>,
        interval: Interval<R>,
        guess: Option<usize>,
        mailbox: &mut impl Mailbox,
        probe: &mut impl Probe,
    ) -> Option<usize> {
        let goal = Blocked { id: None, guess };
        search(self, scene, ray, interval, mailbox, probe, goal).0.id
    }
}

/// Runs a query and gives back its goal, reached or not, and the last limit.
fn search<R: Real, S: Shapes<R>, A: Accel<R> + ?Sized, G: Goal<R>>(
    accel: &A,
    scene: &Scene<'_, R, S>,
    ray: &Ray<R>,
    interval: Interval<R>,
    mailbox: &mut impl Mailbox,
    probe: &mut impl Probe,
    goal: G,
) -> (G, R) {
    let shapes = scene.shapes();
    let unbounded = if S::UNBOUNDED { shapes.bounded()..shapes.count() } else { 0..0 };
    if FOURS && !A::HANDS_OVER_ALL && unbounded.is_empty() && Framing::passes_by(scene, ray) {
        return (goal, interval.max);
    }
    let (ray, min, limit, near) = framed(scene, ray, interval, !A::HANDS_OVER_ALL);
    let ray = &ray;
    let per_ray = shapes.per_ray(ray);
    let mut search =
        Search { line: Line { shapes, ray, per_ray: &per_ray }, min, limit, mailbox, probe, goal };
    if !A::HANDS_OVER_ALL
        && let Some(id) = search.goal.guess()
        && near
        && id < shapes.count()
        && !search.is_over()
    {
        search.test(id);
    }
    if S::UNBOUNDED && !A::HANDS_OVER_ALL && !unbounded.is_empty() && !search.is_over() {
        search.visit_unbounded(unbounded);
    }
    if (near || A::HANDS_OVER_ALL) && !search.is_over() {
        search.mailbox.next_ray();
        accel.walk(ray, &mut search);
    }
    (search.goal, search.limit)
}

/// The ray as it is traced, its interval with the greatest number that belongs to it, and whether it
/// comes near the bounded shapes, if that is asked. A copy: that stays in registers, what a pointer
/// leads to would not.
#[inline(always)]
fn framed<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    ray: &Ray<R>,
    interval: Interval<R>,
    is_near: bool,
) -> (Ray<R>, R, R, bool) {
    let (ray, min, limit, near) = if Framing::is_needless(scene, ray) {
        (*ray, interval.min, interval.max.next_down(), true)
    } else {
        let Framing { ray, interval, near, .. } = Framing::of(scene, ray, interval, is_near);
        (ray, interval.min, interval.max.next_down(), near)
    };
    (ray.with_slack(scene.slack()), min, limit, near)
}

/// What a query looks for.
trait Goal<R: Real> {
    /// Whether a hit ends it.
    const STOPS: bool;

    /// A shape to be tested first.
    fn guess(&self) -> Option<usize> {
        None
    }

    /// Tests one shape between `min` and `limit`; gives the new limit if it is hit.
    fn test<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        id: usize,
        min: R,
        limit: R,
    ) -> Option<R>;

    /// Tests some that follow each other; gives the new limit and the number of tests.
    fn test_range<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        ids: Range<usize>,
        min: R,
        limit: R,
    ) -> (R, usize);
}

/// A set of shapes and a ray prepared for it.
struct Line<'q, R: Real, S: Shapes<R>> {
    shapes: &'q S,
    ray: &'q Ray<R>,
    per_ray: &'q S::PerRay,
}

impl<R: Real, S: Shapes<R>> Line<'_, R, S> {
    /// Whether the ray starts from that shape and cannot meet it.
    fn left(&self, id: usize) -> bool {
        S::FLAT && self.ray.left(id)
    }

    /// The nearest hit of those that follow each other, but for the shape that the ray left: if that is
    /// what is found, those before it and those behind it are asked again.
    fn nearest_of(&self, mut ids: Range<usize>, min: R, mut max: R) -> Option<(usize, R)> {
        let (mut nearest, mut behind) = (None, None);
        loop {
            match self.shapes.nearest_of(ids.clone(), self.ray, self.per_ray, min, max) {
                Some((id, _)) if self.left(id) => {
                    behind = Some(id + 1..ids.end);
                    ids.end = id;
                    continue;
                }
                Some((id, t)) if t < max || nearest.is_none() => {
                    nearest = Some((id, t));
                    max = t;
                }
                _ => {}
            }
            let Some(next) = behind.take() else { return nearest };
            ids = next;
        }
    }

    /// Some that is hit of those that follow each other, but for the one that the ray left.
    fn any_of(&self, mut ids: Range<usize>, min: R, max: R) -> Option<usize> {
        loop {
            match self.shapes.any_of(ids.clone(), self.ray, self.per_ray, min, max) {
                Some(id) if self.left(id) => ids.start = id + 1,
                found => return found,
            }
        }
    }
}

struct Nearest {
    id: usize,
}

impl Nearest {
    /// No shape; later than all of them.
    const NONE: usize = usize::MAX;

    /// Takes a hit at `t <= limit`, unless it is a tie with an earlier shape.
    fn take<R: Real>(&mut self, id: usize, t: R, limit: R) -> R {
        if !(t == limit && self.id < id) {
            self.id = id;
        }
        t
    }
}

impl<R: Real> Goal<R> for Nearest {
    const STOPS: bool = false;

    fn test<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        id: usize,
        min: R,
        limit: R,
    ) -> Option<R> {
        let t = line.shapes.hit(id, line.ray, line.per_ray, min, limit)?;
        (!line.left(id)).then(|| self.take(id, t, limit))
    }

    fn test_range<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        ids: Range<usize>,
        min: R,
        limit: R,
    ) -> (R, usize) {
        let tests = ids.len();
        match line.nearest_of(ids, min, limit) {
            Some((id, t)) => (self.take(id, t, limit), tests),
            None => (limit, tests),
        }
    }
}

struct Blocked {
    id: Option<usize>,
    guess: Option<usize>,
}

impl Blocked {
    /// Once something is found, nothing is left to look for.
    fn limit<R: Real>(&self, limit: R) -> R {
        if self.id.is_some() { -R::INFINITY } else { limit }
    }
}

impl<R: Real> Goal<R> for Blocked {
    const STOPS: bool = true;

    fn guess(&self) -> Option<usize> {
        self.guess
    }

    // A frame less where the stack is small.
    #[cfg_attr(all(target_arch = "arm", not(target_abi = "eabihf")), inline(always))]
    fn test<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        id: usize,
        min: R,
        limit: R,
    ) -> Option<R> {
        let blocks = line.shapes.occludes(id, line.ray, line.per_ray, min, limit);
        (blocks && !line.left(id)).then(|| {
            self.id = Some(id);
            -R::INFINITY
        })
    }

    fn test_range<S: Shapes<R>>(
        &mut self,
        line: &Line<'_, R, S>,
        ids: Range<usize>,
        min: R,
        limit: R,
    ) -> (R, usize) {
        let (first, tests) = (ids.start, ids.len());
        self.id = line.any_of(ids, min, limit);
        (self.limit(limit), self.id.map_or(tests, |id| id - first + 1))
    }
}

/// A query under way: tests the shapes that a structure hands over.
struct Search<'q, R: Real, S: Shapes<R>, M, P, G> {
    line: Line<'q, R, S>,
    min: R,
    /// Greatest parameter of interest, itself included: ties are decided by id.
    limit: R,
    mailbox: &'q mut M,
    probe: &'q mut P,
    goal: G,
}

impl<R: Real, S: Shapes<R>, M, P: Probe, G: Goal<R>> Search<'_, R, S, M, P, G> {
    /// Whether nothing is left to look for; also for intervals that contain nothing.
    fn is_over(&self) -> bool {
        !(self.limit > self.min)
    }

    /// Tests those that no structure knows of. Apart, for the room on the stack that tests of many
    /// kinds take together.
    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn visit_unbounded(&mut self, ids: Range<usize>)
    where
        M: Mailbox,
    {
        self.visit_range(ids);
    }

    /// Tests a shape; whether nothing is left to look for.
    #[inline(always)]
    fn test(&mut self, id: usize) -> bool {
        self.probe.primitive_tests(1);
        let Some(limit) = self.goal.test(&self.line, id, self.min, self.limit) else {
            return false;
        };
        self.limit = limit;
        G::STOPS
    }
}

impl<R: Real, S: Shapes<R>, M: Mailbox, P: Probe, G: Goal<R>> Visitor<R>
    for Search<'_, R, S, M, P, G>
{
    type Probe = P;

    const STOPS: bool = G::STOPS;

    fn start(&self) -> R {
        self.min
    }

    fn limit(&self) -> R {
        self.limit
    }

    fn admit_list(&mut self, list: usize) -> bool {
        let admitted = self.mailbox.admit_list(list);
        if !admitted {
            self.probe.list_skip();
        }
        admitted
    }

    fn visit(&mut self, ids: impl Iterator<Item = usize>) {
        for id in ids {
            if !self.mailbox.admit(id) {
                self.probe.mailbox_skip();
                continue;
            }
            if self.test(id) {
                return;
            }
        }
    }

    fn visit_range(&mut self, ids: Range<usize>) {
        let (limit, tests) = self.goal.test_range(&self.line, ids, self.min, self.limit);
        self.probe.primitive_tests(tests);
        self.limit = limit;
    }

    fn probe(&mut self) -> &mut P {
        self.probe
    }
}
