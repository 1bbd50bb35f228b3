//! Triangles, polygons and planes: corners sheared along the ray, in more digits.

use super::number::{cross, dot, greatest, least, length, sub};
use super::{Crossing, Line, Number, Triple};
use kibiray::geom::Aabb;
use kibiray::num::Vector;

/// What lies in a plane.
#[derive(Clone, Debug)]
pub(crate) struct Flat<F> {
    /// Three for a triangle, none for a plane.
    corners: Vec<Triple<F>>,
    point: Triple<F>,
    /// Across the plane, of length 1.
    normal: Triple<F>,
    /// By how much the type under test may turn it, in multiples of u.
    turned: f64,
    bounds: Option<Aabb<f64>>,
    size: f64,
}

type Pair<F> = (F, F);

impl<F: Number> Flat<F> {
    pub(super) fn plane(point: Triple<F>, normal: Triple<F>) -> Self {
        let l = length(normal);
        let normal = normal.map(|x| x / l);
        Self { corners: Vec::new(), point, normal, turned: 0.0, bounds: None, size: 0.0 }
    }

    pub(super) fn outline(corners: Vec<Triple<F>>) -> Self {
        let zero = [F::of(0.0); 3];
        let first = corners[0];
        let (mut sum, mut before) = (zero, zero);
        for corner in &corners {
            let arm = sub(*corner, first);
            sum = super::number::add(sum, cross(before, arm));
            before = arm;
        }
        let area = length(sum);
        let arm = |c: &Triple<F>| length(sub(*c, first)).to_f64();
        let size = corners.iter().map(arm).fold(0.0, f64::max);
        let narrow = |c: &Triple<F>| <glam::DVec3 as Vector<f64>>::from_array(c.map(F::to_f64));
        let bounds = Aabb::<f64>::around(corners.iter().map(narrow));
        let turned = 4.0 * corners.len() as f64 * size * size / area.to_f64();
        let normal = sum.map(|x| x / area);
        Self { corners, point: first, normal, turned, bounds: Some(bounds), size }
    }

    pub(super) fn crossings(&self, line: &Line<F>, all: &mut Vec<Crossing<F>>) {
        match self.corners.len() {
            0 => all.extend(self.in_plane(line)),
            3 => all.extend(self.in_triangle(line)),
            _ => all.extend(self.in_outline(line)),
        }
    }

    /// The crossing of the plane, displaced either way.
    fn in_plane(&self, line: &Line<F>) -> Option<Crossing<F>> {
        let slope = dot(self.normal, line.d);
        let t = dot(self.normal, sub(self.point, line.o)) / slope;
        let cosine = slope.to_f64().abs() / line.length;
        // A plane is met by rays that are not moved, too.
        let way = length(sub(self.point, line.o)).to_f64();
        let way = line.size(if self.bounds.is_some() { way.min(line.most) } else { way });
        let reach = way + (t.to_f64().abs() * line.length).min(way / cosine);
        let moved = 12.0 * line.u * reach + self.turned * line.u * self.size + line.aside;
        let by = moved / cosine / line.length;
        if !(cosine > 16.0 * line.u) || !by.is_finite() {
            // Along the plane: nothing can be told.
            let most = F::of(f64::MAX);
            return Some(Crossing { t: None, lo: -most, hi: most, sure: false });
        }
        let by = F::of(by) + line.along(t, reach);
        Some(Crossing { t: Some(t), lo: t - by, hi: t + by, sure: true })
    }

    fn in_outline(&self, line: &Line<F>) -> Option<Crossing<F>> {
        let (inside, clear) = self.place(line, &self.sheared(line));
        if clear && !inside {
            return None;
        }
        let crossing = self.in_plane(line)?;
        let exact = crossing.t.filter(|_| inside);
        self.kept(line, Crossing { t: exact, sure: crossing.sure && clear, ..crossing })
    }

    fn in_triangle(&self, line: &Line<F>) -> Option<Crossing<F>> {
        let sheared = self.sheared(line);
        let (inside, clear) = self.place(line, &sheared);
        if clear && !inside {
            return None;
        }
        let [(a, za), (b, zb), (c, zc)] = [sheared[0], sheared[1], sheared[2]];
        let weights = [edge(c, b), edge(a, c), edge(b, a)];
        let det = weights[0] + weights[1] + weights[2];
        let t = (weights[0] * za + weights[1] * zb + weights[2] * zc) / det;
        let [sa, sb, sc] = [a, b, c].map(size);
        let range = greatest(za, greatest(zb, zc)) - least(za, least(zb, zc));
        let depth = [za, zb, zc].map(|z| z.to_f64().abs()).into_iter().fold(0.0, f64::max);
        // Corners moved across the ray, each by so much, turn the plane and shift it there.
        let moved = self.moved(line);
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| size((p.0 - q.0, p.1 - q.1)));
        let swept = moved * sides.iter().sum::<f64>() + 2.0 * moved * moved;
        let rounded = 3.0 * line.u * (sa * sb + sb * sc + sc * sa);
        let doubt = swept + rounded;
        let det = det.to_f64().abs();
        let most = F::of(f64::MAX);
        if !(det > 2.0 * doubt) {
            let none = Crossing { t: None, lo: -most, hi: most, sure: false };
            return self.kept(line, none);
        }
        let by = 2.0 * doubt / det * range.to_f64()
            + 8.0 * line.u * line.size(depth.min(2.0 * line.most) * line.length) / line.length;
        let by = F::of(by) + line.along(t, self.farthest(line));
        let exact = inside.then_some(t);
        self.kept(line, Crossing { t: exact, lo: t - by, hi: t + by, sure: clear })
    }

    fn farthest(&self, line: &Line<F>) -> f64 {
        self.corners.iter().map(|c| line.way(*c)).fold(0.0, f64::max)
    }

    fn moved(&self, line: &Line<F>) -> f64 {
        9.0 * line.u * self.farthest(line) + 2.0 * line.aside
    }

    /// Corners across the ray, and their depth.
    fn sheared(&self, line: &Line<F>) -> Vec<(Pair<F>, F)> {
        let d = line.d.map(|x| x.to_f64().abs());
        let w = if d[0] >= d[1] && d[0] >= d[2] {
            0
        } else if d[1] >= d[2] {
            1
        } else {
            2
        };
        let (u, v) = ((w + 1) % 3, (w + 2) % 3);
        let shear = |c: &Triple<F>| {
            let z = (c[w] - line.o[w]) / line.d[w];
            let x = c[u] - line.o[u] - line.d[u] * z;
            let y = c[v] - line.o[v] - line.d[v] * z;
            ((x, y), z)
        };
        self.corners.iter().map(shear).collect()
    }

    /// Whether the ray passes inside, and whether it is clear of every edge.
    fn place(&self, line: &Line<F>, sheared: &[(Pair<F>, F)]) -> (bool, bool) {
        let zero = F::of(0.0);
        let (mut inside, mut clear) = (false, true);
        let moved = self.moved(line);
        let mut p = sheared[sheared.len() - 1].0;
        for (q, _) in sheared {
            let way = (q.0 - p.0, q.1 - p.1);
            let side = edge(p, *q);
            if (p.1 > zero) != (q.1 > zero) && ((side > zero) == (q.1 > zero)) {
                inside = !inside;
            }
            let (l, lp, lq) = (size(way), size(p), size(*q));
            let doubt = moved + 3.0 * line.u * lp * lq / l;
            // The distance of the ray from the edge.
            let on = -(p.0 * way.0 + p.1 * way.1).to_f64() / (l * l);
            let distance = if on <= 0.0 {
                lp
            } else if on >= 1.0 {
                lq
            } else {
                side.to_f64().abs() / l
            };
            clear &= distance > doubt;
            p = *q;
        }
        (inside, clear)
    }

    /// A hit is kept in the box.
    fn kept(&self, line: &Line<F>, crossing: Crossing<F>) -> Option<Crossing<F>> {
        let (enter, leave) = line.within(self.bounds?, self.moved(line))?;
        let along = line.along(leave, line.most.min(self.farthest(line)));
        let (enter, leave) = (enter - along, leave + along);
        let clamp = |t: F| greatest(enter, least(leave, t));
        Some(Crossing { lo: clamp(crossing.lo), hi: clamp(crossing.hi), ..crossing })
    }

    pub(super) fn around(&self) -> Option<([f64; 3], f64)> {
        self.bounds.map(|_| (self.point.map(F::to_f64), self.size))
    }

    /// How far a point is from the plane, on either side.
    pub(super) fn height(&self, p: Triple<F>) -> F {
        dot(self.normal, sub(p, self.point))
    }
}

fn edge<F: Number>(p: Pair<F>, q: Pair<F>) -> F {
    p.0 * q.1 - p.1 * q.0
}

fn size<F: Number>(p: Pair<F>) -> f64 {
    (p.0 * p.0 + p.1 * p.1).root().to_f64()
}
