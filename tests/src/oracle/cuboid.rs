//! Boxes: where the exact ray meets each of the six faces' planes.

use super::number::{greatest, least};
use super::{Crossing, Line, Number, Triple};

#[derive(Clone, Debug)]
pub(crate) struct Cuboid<F> {
    pub(super) lo: Triple<F>,
    pub(super) hi: Triple<F>,
}

/// A parameter between bounds.
#[derive(Clone, Copy)]
struct Span<F> {
    lo: F,
    t: F,
    hi: F,
}

impl<F: Number> Cuboid<F> {
    pub(super) fn crossings(&self, line: &Line<F>, all: &mut Vec<Crossing<F>>) {
        let infinity = F::of(f64::MAX);
        let none = |t: F| Span { lo: t, t, hi: t };
        let (mut enters, mut leaves) = ([none(-infinity); 3], [none(infinity); 3]);
        for axis in 0..3 {
            let (o, d) = (line.o[axis], line.d[axis]);
            let (lo, hi) = (self.lo[axis], self.hi[axis]);
            if d == F::of(0.0) {
                if o < lo || o > hi {
                    return;
                }
                continue;
            }
            let span = |wall: F| {
                let t = (wall - o) / d;
                let aside = line.aside / d.to_f64().abs();
                let way = line.size((t.to_f64().abs() * line.length).min(line.most));
                let by = F::of(4.0 * line.u * way / line.length + aside) + line.along(t, way);
                Span { lo: t - by, t, hi: t + by }
            };
            let (a, b) = (span(lo), span(hi));
            (enters[axis], leaves[axis]) = if d > F::of(0.0) { (a, b) } else { (b, a) };
        }
        // The two faces across an axis come in their order however they are rounded.
        let pairs = || (0..9).map(|i| (i / 3, i % 3)).filter(|(i, j)| i != j);
        let sure = pairs().all(|(i, j)| enters[i].hi <= leaves[j].lo);
        if pairs().any(|(i, j)| enters[i].lo > leaves[j].hi) {
            return;
        }
        let max =
            |f: fn(Span<F>) -> F| greatest(f(enters[0]), greatest(f(enters[1]), f(enters[2])));
        let min = |f: fn(Span<F>) -> F| least(f(leaves[0]), least(f(leaves[1]), f(leaves[2])));
        let (enter, leave) = (max(|s| s.t), min(|s| s.t));
        let exact = enter <= leave;
        let t = |t: F| exact.then_some(t);
        all.push(Crossing { t: t(enter), lo: max(|s| s.lo), hi: max(|s| s.hi), sure });
        all.push(Crossing { t: t(leave), lo: min(|s| s.lo), hi: min(|s| s.hi), sure });
    }

    pub(super) fn around(&self) -> ([f64; 3], f64) {
        let (lo, hi) = (self.lo.map(F::to_f64), self.hi.map(F::to_f64));
        let middle = [0, 1, 2].map(|i| (lo[i] + hi[i]) / 2.0);
        let half = [0, 1, 2].map(|i| (hi[i] - lo[i]) / 2.0);
        (middle, half.iter().map(|x| x * x).sum::<f64>().sqrt())
    }
}
