//! The query trait: nearest hit and any hit, by one walk through a structure.

use super::Mailbox;
use crate::geom::{Interval, Ray};
use crate::num::Real;
use crate::probe::Probe;
use crate::scene::{Framing, Scene, Shapes};

/// A place where a ray meets a shape. What shading needs besides is computed when it is asked for:
/// [`Scene::surface`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<R> {
    /// Parameter along the ray, in lengths of its direction.
    pub t: R,
    /// Which shape.
    pub id: usize,
    /// Parameter along the ray as it was traced; see [`Framing`].
    pub(crate) local: R,
}

/// Takes the shapes that a structure finds on the way of a ray.
pub trait Visitor<R: Real> {
    /// What counts the work.
    type Probe: Probe;

    /// Where the walk begins.
    fn start(&self) -> R;

    /// What lies beyond this parameter is of no interest any more.
    fn limit(&self) -> R;

    /// Shapes that the ray may meet.
    fn visit(&mut self, ids: impl Iterator<Item = usize>);

    /// The counters.
    fn probe(&mut self) -> &mut Self::Probe;
}

/// A structure over the shapes of a scene.
pub trait Accel<R: Real> {
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
        let goal = Nearest { hit: None };
        let (goal, framing) = search(self, scene, ray, interval, mailbox, probe, goal);
        goal.hit.map(|hit| Hit { t: framing.restore(hit.local), ..hit })
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
        let goal = Blocked { found: false };
        search(self, scene, ray, interval, mailbox, probe, goal).0.found
    }
}

/// Runs a query and gives back its goal, reached or not.
fn search<R: Real, S: Shapes<R>, G: Goal<R>>(
    accel: &(impl Accel<R> + ?Sized),
    scene: &Scene<'_, R, S>,
    ray: &Ray<R>,
    interval: Interval<R>,
    mailbox: &mut impl Mailbox,
    probe: &mut impl Probe,
    goal: G,
) -> (G, Framing<R>) {
    let (ray, interval, framing) = Framing::of(scene, ray, interval);
    let shapes = scene.shapes();
    let mut search = Search {
        line: Line { shapes, ray: &ray, per_ray: shapes.per_ray(&ray) },
        min: interval.min,
        limit: interval.max.next_down(),
        mailbox,
        probe,
        goal,
    };
    // Without bounds they are in no structure. Their ids come last, so a tie is not theirs.
    for id in shapes.bounded()..shapes.count() {
        if search.is_over() {
            break;
        }
        search.test(id);
    }
    if framing.near && !search.is_over() {
        search.mailbox.next_ray();
        accel.walk(&ray, &mut search);
    }
    (search.goal, framing)
}

/// What a query looks for.
trait Goal<R: Real> {
    /// Tests one shape between `min` and `limit`; gives the new limit.
    fn test<S: Shapes<R>>(&mut self, line: &Line<'_, R, S>, id: usize, min: R, limit: R) -> R;
}

/// A set of shapes and a ray prepared for it.
struct Line<'q, R: Real, S: Shapes<R>> {
    shapes: &'q S,
    ray: &'q Ray<R>,
    per_ray: S::PerRay,
}

struct Nearest<R> {
    hit: Option<Hit<R>>,
}

impl<R: Real> Goal<R> for Nearest<R> {
    fn test<S: Shapes<R>>(&mut self, line: &Line<'_, R, S>, id: usize, min: R, limit: R) -> R {
        let Some(t) = line.shapes.hit(id, line.ray, &line.per_ray, min, limit) else {
            return limit;
        };
        match self.hit {
            // A tie with an earlier shape.
            Some(hit) if t == limit && id > hit.id => limit,
            _ => {
                self.hit = Some(Hit { t, id, local: t });
                t
            }
        }
    }
}

struct Blocked {
    found: bool,
}

impl<R: Real> Goal<R> for Blocked {
    fn test<S: Shapes<R>>(&mut self, line: &Line<'_, R, S>, id: usize, min: R, limit: R) -> R {
        self.found |= line.shapes.occludes(id, line.ray, &line.per_ray, min, limit);
        // Nothing is left to look for.
        if self.found { -R::INFINITY } else { limit }
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

    fn test(&mut self, id: usize) {
        self.probe.primitive_test();
        self.limit = self.goal.test(&self.line, id, self.min, self.limit);
    }
}

impl<R: Real, S: Shapes<R>, M: Mailbox, P: Probe, G: Goal<R>> Visitor<R>
    for Search<'_, R, S, M, P, G>
{
    type Probe = P;

    fn start(&self) -> R {
        self.min
    }

    fn limit(&self) -> R {
        self.limit
    }

    fn visit(&mut self, ids: impl Iterator<Item = usize>) {
        for id in ids {
            if !self.mailbox.admit(id) {
                self.probe.mailbox_skip();
                continue;
            }
            self.test(id);
            if self.is_over() {
                return;
            }
        }
    }

    fn probe(&mut self) -> &mut P {
        self.probe
    }
}
