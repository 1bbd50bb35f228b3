//! Spheres: the exact solution, and that of spheres a little larger and smaller.

use super::number::{dot, length, sub, times};
use super::{Crossing, Line, Number, Triple};

#[derive(Clone, Debug)]
pub(crate) struct Sphere<F> {
    pub(super) center: Triple<F>,
    pub(super) radius: F,
}

impl<F: Number> Sphere<F> {
    pub(super) fn crossings(&self, line: &Line<F>, all: &mut Vec<Crossing<F>>) {
        let u = line.u;
        let f = sub(self.center, line.o);
        let r = self.radius.to_f64();
        let way = line.way(self.center);
        let moved = 4.0 * u * (way + r) + (9.0 * u * way).powi(2) / (2.0 * r) + line.aside;
        let middle = dot(f, line.d) / line.dd;
        let across = sub(f, times(line.d, middle));
        let aa = dot(across, across);
        let half = |r: F| {
            let square = r * r - aa;
            (square >= F::of(0.0)).then(|| (square / line.dd).root())
        };
        let Some(outer) = half(self.radius + F::of(moved)) else { return };
        let (exact, inner) = (half(self.radius), half(self.radius - F::of(moved)));
        let inner = if self.radius.to_f64() > moved { inner } else { None };
        // The smaller root comes of the product of both: its error grows where they are small.
        let far = (middle.to_f64().abs() + outer.to_f64()) * line.length;
        let near = (6.0 * u * way * way + 2.0 * u * r * r + 2.0 * r * moved) / far;
        let near = if line.exact { 0.0 } else { near.min(far) };
        let along = F::of((16.0 * u * (way + r) + near) / line.length) + line.along(middle, way);
        let mut push = |sign: f64| {
            let at = |half: F| middle + half * F::of(sign);
            let ends = (at(outer), at(inner.unwrap_or(-outer)));
            let (lo, hi) = if ends.0 < ends.1 { ends } else { (ends.1, ends.0) };
            let crossing = Crossing { t: exact.map(at), lo, hi, sure: inner.is_some() };
            all.push(crossing.grown(along));
        };
        push(-1.0);
        push(1.0);
    }

    pub(super) fn around(&self) -> ([f64; 3], f64) {
        (self.center.map(F::to_f64), self.radius.to_f64())
    }

    /// How far above the surface a point is.
    pub(super) fn height(&self, p: Triple<F>) -> F {
        length(sub(p, self.center)) - self.radius
    }
}
