//! Judges answers of rays into a whole scene.

use super::axial::Axial;
use super::cuboid::Cuboid;
use super::flat::Flat;
use super::number::{add, times};
use super::sphere::Sphere;
use super::{Crossing, Line, Number, Solid, Tested, widen};
use kibiray::geom::{Interval, Ray};
use kibiray::num::Vec3;
use kibiray::scene::{Scene, Solids};
use std::ops::AddAssign;

/// What an answer is.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The exact one, and no other could be given.
    Right,
    /// The exact one, though the bound would allow another.
    Close,
    /// Not the exact one, but within the bound of it: another shape, or a hit more or less.
    Explained,
    /// Beyond the bound.
    Wrong(String),
}

/// How many answers are what.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Judged rays.
    pub rays: u64,
    /// Of these, answered with a hit.
    pub hits: u64,
    /// Rays whose answer is ambiguous within the bound.
    pub ambiguous: u64,
    /// Of these, answered otherwise than exact arithmetic would.
    pub explained: u64,
    /// Answers beyond the bound.
    pub wrong: u64,
    /// Greatest error of `t`, in parts of what its bound allows.
    pub worst: f64,
    /// The first wrong ones.
    pub failures: Vec<String>,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.hits += other.hits;
        self.ambiguous += other.ambiguous;
        self.explained += other.explained;
        self.wrong += other.wrong;
        self.worst = self.worst.max(other.worst);
        self.failures.extend(other.failures);
        self.failures.truncate(8);
    }
}

impl Tally {
    /// Counts an answer that is beyond every bound.
    pub fn fail(&mut self, what: impl FnOnce() -> String) {
        self.wrong += 1;
        if self.failures.len() < 8 {
            self.failures.push(what());
        }
    }

    /// Counts a ray with a decided answer.
    pub fn expect(&mut self, right: bool, what: impl FnOnce() -> String) {
        self.rays += 1;
        if !right {
            self.fail(what);
        }
    }
}

/// A scene in more digits.
#[derive(Debug)]
pub struct Judge<F: Number> {
    solids: Vec<Solid<F>>,
    /// A ball around each; shapes without bounds have none.
    balls: Vec<Option<([f64; 3], f64)>>,
    scale: f64,
    crossings: Vec<Crossing<F>>,
    starts: Vec<F>,
}

impl<F: Number> Judge<F> {
    /// Takes the numbers of a scene as they are stored.
    pub fn new<R: Tested<Oracle = F>>(scene: &Scene<'_, R, Solids<'_, R>>) -> Self {
        let v = |p: Vec3<R>| widen::<R, F>(p);
        let n = |x: R| F::of(x.to_f64());
        let shapes = scene.shapes();
        let mut solids = Vec::new();
        solids.extend(
            shapes
                .spheres
                .iter()
                .map(|s| Solid::Sphere(Sphere { center: v(s.center), radius: n(s.radius) })),
        );
        let corners = |c: &[Vec3<R>]| Solid::Flat(Flat::outline(c.iter().map(|p| v(*p)).collect()));
        solids.extend(shapes.triangles.triangles.iter().map(|t| corners(&t.corners)));
        solids.extend(shapes.polygons.iter().map(|p| corners(p.vertices())));
        solids.extend(shapes.boxes.iter().map(|b| Solid::Box(Cuboid { lo: v(b.lo), hi: v(b.hi) })));
        solids.extend(shapes.cylinders.iter().map(|c| {
            Solid::Axial(Axial {
                base: v(c.base),
                axis: v(c.axis),
                height: n(c.height),
                radii: (n(c.radius), n(c.radius)),
                capped: c.capped,
            })
        }));
        solids.extend(shapes.cones.iter().map(|c| {
            Solid::Axial(Axial {
                base: v(c.base),
                axis: v(c.axis),
                height: n(c.height),
                radii: (n(c.base_radius), n(c.apex_radius)),
                capped: c.capped,
            })
        }));
        solids.extend(
            shapes.planes.iter().map(|p| Solid::Flat(Flat::plane(v(p.point), v(p.normal)))),
        );
        let balls = solids
            .iter()
            .map(|solid| match solid {
                Solid::Sphere(it) => Some(it.around()),
                Solid::Flat(it) => it.around(),
                Solid::Box(it) => Some(it.around()),
                Solid::Axial(it) => Some(it.around()),
            })
            .collect();
        let scale = scene.bounds().max_abs().to_f64();
        Self { solids, balls, scale, crossings: Vec::new(), starts: Vec::new() }
    }

    /// The ray in more digits.
    pub fn line<R: Tested<Oracle = F>>(&self, ray: &Ray<R>) -> Line<F> {
        Line::new(ray, self.scale)
    }

    /// The crossings of one shape.
    pub fn crossings(&mut self, line: &Line<F>, id: usize) -> &[Crossing<F>] {
        self.crossings.clear();
        self.solids[id].crossings(line, &mut self.crossings);
        &self.crossings
    }

    /// How far a point is outside a shape's surface, or on which side of its plane; `None` for boxes.
    pub fn height<R: Tested<Oracle = F>>(&self, id: usize, p: Vec3<R>) -> Option<f64> {
        let p = widen::<R, F>(p);
        let height = match &self.solids[id] {
            Solid::Sphere(it) => it.height(p),
            Solid::Flat(it) => it.height(p),
            Solid::Axial(it) => it.height(p),
            Solid::Box(_) => return None,
        };
        Some(height.to_f64())
    }

    /// The point of a ray.
    pub fn at(&self, line: &Line<F>, t: f64) -> [f64; 3] {
        add(line.o, times(line.d, F::of(t))).map(F::to_f64)
    }

    /// Judges what a ray was answered: the nearest hit.
    pub fn judge<R: Tested<Oracle = F>>(
        &mut self,
        ray: &Ray<R>,
        interval: Interval<R>,
        answer: Option<(R, usize)>,
        tally: &mut Tally,
    ) -> Outcome {
        tally.rays += 1;
        tally.hits += u64::from(answer.is_some());
        let line = self.line(ray);
        let (min, max) = (F::of(interval.min.to_f64()), F::of(interval.max.to_f64().min(1e300)));
        let none = F::of(f64::MAX);
        // The first crossing that has to be seen, the exact first one, whether any is in doubt, and
        // the bounds of those of the shape that is named.
        let (mut sure, mut exact) = (none, (none, usize::MAX));
        let mut named: Option<Crossing<F>> = None;
        let mut starts = std::mem::take(&mut self.starts);
        starts.clear();
        let direction = line.d.map(F::to_f64);
        let origin = line.o.map(F::to_f64);
        let t = answer.map(|(t, _)| F::of(t.to_f64()));
        for id in 0..self.solids.len() {
            if let Some((center, radius)) = self.balls[id]
                && !near(origin, direction, line.length, center, radius, &line)
            {
                continue;
            }
            self.crossings.clear();
            self.solids[id].crossings(&line, &mut self.crossings);
            for crossing in &self.crossings {
                if crossing.hi < min || crossing.lo > max {
                    continue;
                }
                if let Some(at) = crossing.t
                    && at > min
                    && at < max
                    && at < exact.0
                {
                    exact = (at, id);
                }
                starts.push(crossing.lo);
                if crossing.sure && crossing.lo > min && crossing.hi < max && crossing.hi < sure {
                    sure = crossing.hi;
                }
                if let (Some(t), Some((_, answered))) = (t, answer)
                    && id == answered
                    && t >= crossing.lo
                    && t <= crossing.hi
                {
                    named = Some(*crossing);
                }
            }
        }
        // Any other that may come before the first that has to be seen.
        let before = starts.iter().filter(|lo| **lo <= sure).count();
        let doubt = before > usize::from(sure < none);
        self.starts = starts;
        let describe = |what: &str| {
            let (o, d) = (ray.origin(), ray.direction());
            let (sure, exact) = (sure.to_f64(), (exact.0.to_f64(), exact.1));
            let shape = answer.map(|(_, id)| &self.solids[id]);
            format!(
                "{what}: {o:?} {d:?} {interval:?} answered {answer:?}, exact {exact:?}, sure {sure:e}, \
                 {shape:?}"
            )
        };
        let wrong = match (t, named) {
            (None, _) => (sure < none).then(|| describe("missed")),
            (Some(_), None) => Some(describe("no such crossing")),
            (Some(t), Some(_)) if t > sure => Some(describe("passed through")),
            (Some(t), Some(crossing)) => {
                if let Some(exact) = crossing.t {
                    let off = (t - exact).to_f64();
                    let room = if off < 0.0 { exact - crossing.lo } else { crossing.hi - exact };
                    if crossing.sure && off != 0.0 {
                        tally.worst = tally.worst.max(off.abs() / room.to_f64());
                    }
                }
                None
            }
        };
        if let Some(wrong) = wrong {
            tally.fail(|| wrong.clone());
            return Outcome::Wrong(wrong);
        }
        tally.ambiguous += u64::from(doubt);
        let as_exact = match answer {
            None => exact.1 == usize::MAX,
            // Of shapes that coincide any is the exact one.
            Some((_, id)) => exact.1 == id || named.and_then(|c| c.t).is_some_and(|t| t <= exact.0),
        };
        if !as_exact {
            tally.explained += 1;
            Outcome::Explained
        } else if doubt {
            Outcome::Close
        } else {
            Outcome::Right
        }
    }
}

/// Whether a ray comes near a ball, generously.
fn near<F: Number>(
    o: [f64; 3],
    d: [f64; 3],
    length: f64,
    center: [f64; 3],
    radius: f64,
    line: &Line<F>,
) -> bool {
    let f = [center[0] - o[0], center[1] - o[1], center[2] - o[2]];
    let across = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
    let ff = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt();
    let off = (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]).sqrt();
    let within = radius * 1.001
        + 200.0 * line.u * line.size(ff.min(line.most) + radius)
        + 4.0 * line.slack
        + 4.0 * line.aside
        + 1e-12 * ff;
    off <= within * length
}
