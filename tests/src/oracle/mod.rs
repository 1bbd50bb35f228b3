//! What a ray's right answer is, and how far from it a number type may be.
//!
//! An oracle takes the very numbers of a scene and a ray as they are stored in the number type under
//! test, computes in one with twice as many digits ([`Tested::Oracle`]), and knows nothing of
//! structures. Every crossing of a shape comes as an [`Crossing`]: the bounds between which the type
//! under test may put it, and whether it has to see it at all. Who answers outside the bounds, or
//! passes a crossing that it had to see, is **wrong**. Who is within them but names another shape
//! than the exact answer is **explained** by the bound, and counted.
//!
//! # The bounds
//! Backward errors: the computed crossing is the exact one of a shape moved by little. With u the
//! unit roundoff, f the way from the ray's origin to the shape's reference point:
//!
//! | shape | moved by | because |
//! |---|---|---|
//! | sphere | 4u(\|f\| + r) + (9u\|f\|)²/2r, as a change of r | f, d·t and f − d·t are each rounded once, r² and the squared distance cost 2.5u r; the error of t along the ray enters in its square |
//! | triangle | corners by 9u\|f\| across the ray, edges by 3u\|p\|\|q\|/\|pq\| more | the shear rounds each of two coordinates six times at most; an edge function is two products of the sheared corners p and q |
//! | polygon | outline as a triangle's; plane by 12u(\|f\| + \|td\|) and turned by 4nu s²/A | as many terms in Newell's sum as corners n; s the size, A the area |
//! | plane | 12u(\|f\| + \|td\|) | three products in either dot product, f rounded |
//! | box | each face by 4u\|td\| | a difference, a reciprocal, a product |
//! | cylinder, cone | 16u(\|f\| + h + r) + 2u\|m\| across the wall, and the ends along the axis; a cone's squares by the same times its greater radius | the middle m is rounded; taken from the ray's point next to the middle: the way there as for the sphere, then the split along an axis that is a unit within 16u |
//!
//! and along the ray by the rounding of t itself. In fixed point u is half a step, 2^-29, and what is
//! less than 1 counts as 1: rounding does not shrink with the numbers. A ray whose origin is beyond four times the scene's
//! size is moved first, which shifts it aside by u(D + 5S) an axis (`tests/far_and_long.rs`).
//! Where the numbers with twice the digits are themselves in doubt, at edges, vertices and tangents,
//! [`exact`] decides by whole numbers of any length.

mod axial;
mod cuboid;
pub mod exact;
mod flat;
mod number;
mod scene;
mod sphere;

pub use number::{Number, Tested, Triple, widen};
pub use scene::{Judge, Outcome, Tally};

use kibiray::geom::{Aabb, Ray};
use kibiray::num::Vector;
use number::{dot, length};

/// A ray in more digits.
#[derive(Clone, Copy, Debug)]
pub struct Line<F> {
    o: Triple<F>,
    d: Triple<F>,
    dd: F,
    /// The length of the direction.
    length: f64,
    /// What moving a ray from far away shifts it aside.
    aside: f64,
    /// Distances from the origin count at most so much, as it is moved to within that.
    most: f64,
    /// How far a shape may be hit outside its box.
    slack: f64,
    /// What [`Tested::rounding`] makes of 1.
    u: f64,
    /// [`Tested::LEAST`].
    least: f64,
    /// Whether sums of products are exact.
    exact: bool,
}

impl<F: Number> Line<F> {
    /// A ray into a scene of this size (greatest coordinate).
    pub fn new<R: Tested<Oracle = F>>(ray: &Ray<R>, scale: f64) -> Self {
        let (o, d) = (widen::<R, F>(ray.origin()), widen::<R, F>(ray.direction()));
        let dd = dot(d, d);
        let reach = ray.origin().max_abs().to_f64();
        // Without bounded shapes there is nothing to be moved to.
        let far = scale > 0.0 && reach > R::far(R::from_f64(scale)).to_f64();
        let aside = if far { 2.0 * R::rounding(reach + 5.0 * scale) } else { 0.0 };
        // A direction too long for fixed point is shortened, which rounds it: over the whole way, 5.
        let shortened = R::EXACT && dd.to_f64() >= 3.0;
        let aside = if shortened { aside + 5.0 * R::rounding(1.0) } else { aside };
        Self {
            o,
            d,
            dd,
            length: dd.root().to_f64(),
            aside,
            most: if far { 16.0 * scale } else { f64::INFINITY },
            slack: R::ulps_at(R::SLACK, R::from_f64(scale)).to_f64(),
            u: R::rounding(1.0),
            least: R::LEAST,
            exact: R::EXACT,
        }
    }

    /// The distance that rounding of the way to a shape's point is in proportion to.
    fn way(&self, point: Triple<F>) -> f64 {
        self.size(length(number::sub(point, self.o)).to_f64().min(self.most))
    }

    /// What a length counts where rounding is in proportion to it.
    fn size(&self, length: f64) -> f64 {
        length.max(self.least)
    }

    /// What rounding leaves of a parameter around `t`, as seen from where the ray starts.
    fn along(&self, t: F, way: f64) -> F {
        let t = t.to_f64().abs();
        let own =
            self.size(t.min(2.0 * way / self.length) * self.length) / self.length + self.least;
        let moved = if self.most.is_finite() { 4.0 * self.u * t } else { 0.0 };
        F::of(8.0 * self.u * own + moved)
    }

    /// Bounds of a parameter on the way through a box grown by the slack.
    fn within(&self, bounds: Aabb<f64>, more: f64) -> Option<(F, F)> {
        let grow = 2.0 * self.slack + more;
        let (mut enter, mut leave) = (F::of(-f64::MAX), F::of(f64::MAX));
        let (lo, hi) = (bounds.lo.to_array(), bounds.hi.to_array());
        for axis in 0..3 {
            let (lo, hi) = (F::of(lo[axis] - grow), F::of(hi[axis] + grow));
            let (o, d) = (self.o[axis], self.d[axis]);
            if d == F::of(0.0) {
                if o < lo || o > hi {
                    return None;
                }
                continue;
            }
            let (a, b) = ((lo - o) / d, (hi - o) / d);
            enter = number::greatest(enter, number::least(a, b));
            leave = number::least(leave, number::greatest(a, b));
        }
        (enter <= leave).then_some((enter, leave))
    }
}

/// A crossing of a surface: where, and how well that can be told.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<F> {
    /// The exact parameter, if the exact ray meets the exact shape.
    pub t: Option<F>,
    /// Bounds of what the type under test may say.
    pub lo: F,
    /// The upper one.
    pub hi: F,
    /// Whether it has to say that it is there.
    pub sure: bool,
}

impl<F: Number> Crossing<F> {
    fn grown(self, by: F) -> Self {
        Self { lo: self.lo - by, hi: self.hi + by, ..self }
    }
}

/// A shape in more digits.
#[derive(Clone, Debug)]
pub(crate) enum Solid<F> {
    Sphere(sphere::Sphere<F>),
    Flat(flat::Flat<F>),
    Box(cuboid::Cuboid<F>),
    Axial(axial::Axial<F>),
}

impl<F: Number> Solid<F> {
    /// All crossings, also behind the origin, in no order.
    pub(crate) fn crossings(&self, line: &Line<F>, all: &mut Vec<Crossing<F>>) {
        match self {
            Self::Sphere(it) => it.crossings(line, all),
            Self::Flat(it) => it.crossings(line, all),
            Self::Box(it) => it.crossings(line, all),
            Self::Axial(it) => it.crossings(line, all),
        }
    }
}
