//! Cylinders and cones: the exact solution, and that of solids a little larger and smaller.

use super::number::{add, dot, greatest, least, length, sub, times};
use super::{Crossing, Line, Number, Triple};

#[derive(Clone, Debug)]
pub(crate) struct Axial<F> {
    pub(super) base: Triple<F>,
    pub(super) axis: Triple<F>,
    pub(super) height: F,
    pub(super) radii: (F, F),
    pub(super) capped: bool,
}

/// A ray as the axis sees it, in steps from its point next to the middle.
struct Frame<F> {
    start: F,
    q: Triple<F>,
    d: Triple<F>,
    z: F,
    dz: F,
}

/// Between which steps.
type Span<F> = (F, F);

impl<F: Number> Axial<F> {
    fn axis(&self) -> Triple<F> {
        let l = length(self.axis);
        self.axis.map(|x| x / l)
    }

    fn middle(&self) -> Triple<F> {
        add(self.base, times(self.axis, self.height * F::of(0.5)))
    }

    fn growth(&self) -> F {
        (self.radii.1 - self.radii.0) / self.height
    }

    fn frame(&self, line: &Line<F>) -> Frame<F> {
        let (axis, f) = (self.axis(), sub(self.middle(), line.o));
        let start = dot(f, line.d) / line.dd;
        let q = sub(times(line.d, start), f);
        let (z, dz) = (dot(q, axis), dot(line.d, axis));
        let across = |v: Triple<F>, along: F| sub(v, times(axis, along));
        Frame { start, q: across(q, z), d: across(line.d, dz), z, dz }
    }

    /// Between which steps the ray is inside the wall, moved outwards by `by`.
    fn wall(&self, frame: &Frame<F>, by: f64) -> Option<Span<F>> {
        let (zero, most) = (F::of(0.0), F::of(f64::MAX));
        let growth = self.growth();
        let by = F::of(by * (1.0 + growth.to_f64().powi(2)).sqrt());
        let middle = (self.radii.0 + self.radii.1) * F::of(0.5) + by + growth * frame.z;
        let step = growth * frame.dz;
        let a = dot(frame.d, frame.d) - step * step;
        let b = step * middle - dot(frame.q, frame.d);
        // Next to the tip of a cone the radius is small beside that which the squares are rounded for.
        let widest = greatest(self.radii.0, self.radii.1);
        let rounded = if growth == zero { zero } else { by * widest * F::of(0.5) };
        let c = dot(frame.q, frame.q) - middle * middle - rounded;
        let square = b * b - a * c;
        if square < zero {
            // Steeper than the wall, and through a tip that is rounded off: never outside.
            return (a < zero && by.to_f64() > 0.0).then_some((-most, most));
        }
        let root = square.root();
        let q = if b >= zero { b + root } else { b - root };
        if q == zero && a == zero {
            return (c <= zero && middle >= zero).then_some((-most, most));
        }
        let (s, t) = if q == zero { (zero, zero) } else { (q / a, c / q) };
        if a == zero {
            // Parallel to the wall on one side: a single crossing.
            return Some(if step > zero { (t, most) } else { (-most, t) });
        }
        let (lo, hi) = if s < t { (s, t) } else { (t, s) };
        if a < zero {
            return Some(if step > zero { (hi, most) } else { (-most, lo) });
        }
        (middle + step * (lo + hi) * F::of(0.5) >= zero).then_some((lo, hi))
    }

    /// Between which steps the ray is between the ends, moved outwards by `by`.
    fn slab(&self, frame: &Frame<F>, by: f64) -> Option<Span<F>> {
        let half = self.height * F::of(0.5) + F::of(by);
        let most = F::of(f64::MAX);
        if frame.dz == F::of(0.0) {
            return (half >= frame.z && half >= -frame.z).then_some((-most, most));
        }
        let (a, b) = ((-half - frame.z) / frame.dz, (half - frame.z) / frame.dz);
        Some(if frame.dz > F::of(0.0) { (a, b) } else { (b, a) })
    }

    pub(super) fn crossings(&self, line: &Line<F>, all: &mut Vec<Crossing<F>>) {
        let frame = self.frame(line);
        let way = line.way(self.middle());
        let (_, size) = self.around();
        let middle = length(self.middle()).to_f64();
        let moved = line.u * (16.0 * (way + 2.0 * size) + 2.0 * middle) + line.aside;
        // Where the sign of the way along the axis is not told, the ends are as good as parallel.
        let level = frame.dz.to_f64().abs() <= 16.0 * line.u * line.length;
        let frame = if level { Frame { dz: F::of(0.0), ..frame } } else { frame };
        let (Some(wide), Some(long)) = (self.wall(&frame, moved), self.slab(&frame, moved)) else {
            return;
        };
        let (thin, short) = (self.wall(&frame, -moved), self.slab(&frame, -moved));
        let small = (2.0 * moved) < size;
        let sure = small && thin.is_some() && short.is_some();
        // Where a smaller one is not met at all, a crossing may be anywhere within the larger one.
        let (thin, short) = (thin.unwrap_or((wide.1, wide.0)), short.unwrap_or((long.1, long.0)));
        let ordered = |a: F, b: F| (least(a, b), greatest(a, b));
        let (w0, w1) = (ordered(wide.0, thin.0), ordered(wide.1, thin.1));
        let (s0, s1) = (ordered(long.0, short.0), ordered(long.1, short.1));
        let near = (greatest(w0.0, s0.0), greatest(w0.1, s0.1));
        let far = (least(w1.0, s1.0), least(w1.1, s1.1));
        if near.0 > far.1 {
            return;
        }
        let sure = sure && near.1 <= far.0;
        let upwards = frame.dz > F::of(0.0);
        let zero = F::of(0.0);
        let closed = |radius: F| self.capped || radius == zero;
        let (base, apex) = (closed(self.radii.0), closed(self.radii.1));
        let (first, last) = if upwards { (base, apex) } else { (apex, base) };
        let exact = self.exact(&frame);
        let by = line.along(frame.start, way + size) + F::of(moved / line.length);
        let mut push = |closed: bool, at: Span<F>, wall: Span<F>, enters: bool| {
            // Wall, end, or either of them.
            let (is_wall, is_end) = if enters {
                (wall.0 >= s0.1, wall.1 < s0.0)
            } else {
                (wall.1 <= s1.0, wall.0 > s1.1)
            };
            if is_end && !closed {
                return;
            }
            let t = exact.and_then(|(a, b)| if enters { a } else { b });
            let crossing = Crossing {
                t: t.map(|s| frame.start + s),
                lo: frame.start + at.0,
                hi: frame.start + at.1,
                sure: sure && (closed || is_wall),
            };
            all.push(crossing.grown(by));
        };
        push(first, near, w0, true);
        push(last, far, w1, false);
    }

    /// The exact crossings, of those parts of the surface that are there.
    fn exact(&self, frame: &Frame<F>) -> Option<(Option<F>, Option<F>)> {
        let (wall, slab) = (self.wall(frame, 0.0)?, self.slab(frame, 0.0)?);
        let (near, far) = (greatest(wall.0, slab.0), least(wall.1, slab.1));
        if near > far {
            return None;
        }
        let there = |at: F, wall: F| (self.capped || at == wall).then_some(at);
        Some((there(near, wall.0), there(far, wall.1)))
    }

    pub(super) fn around(&self) -> ([f64; 3], f64) {
        let r = self.radii.0.to_f64().max(self.radii.1.to_f64());
        (self.middle().map(F::to_f64), self.height.to_f64() * 0.5 + r)
    }

    /// How far outside the wall a point is, across the wall.
    pub(super) fn height(&self, p: Triple<F>) -> F {
        let (axis, growth) = (self.axis(), self.growth());
        let p = sub(p, self.base);
        let z = dot(p, axis);
        let off = length(sub(p, times(axis, z))) - (self.radii.0 + growth * z);
        off / (F::of(1.0) + growth * growth).root()
    }
}
