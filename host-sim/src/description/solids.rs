//! Closed solids, affine maps of them, and what is put together from them.

use super::{Solid, Triple};

/// A step of a combined solid in postfix notation.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A solid.
    Part(Part),
    /// The two before it, put together.
    Join(Operator),
}

use kibiray::shape::{Plane, Polyhedron, Shape};

pub use kibiray::shape::csg::Operator;

/// A closed convex solid in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The solid.
    pub body: Body,
    /// The map that takes it to its place, where the solid itself could not be moved there.
    pub map: Option<Map>,
}

/// A closed convex solid.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "as of the solids that a file describes")]
pub enum Body {
    Sphere {
        center: Triple,
        radius: f64,
    },
    Box {
        lo: Triple,
        hi: Triple,
    },
    Cone {
        base: Triple,
        base_radius: f64,
        apex: Triple,
        apex_radius: f64,
    },
    /// What is behind all of some planes, each a point and a normal out of the solid.
    Polyhedron {
        faces: Vec<[Triple; 2]>,
    },
    /// What is behind one plane.
    HalfSpace {
        face: [Triple; 2],
    },
}

/// An affine map: the images of the directions x, y and z, and of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Images of the directions.
    pub axes: [Triple; 3],
    /// Image of the origin.
    pub origin: Triple,
}

/// What is smaller than this part of a whole is taken for rounding.
const ROUNDING: f64 = 1e-12;

impl Map {
    /// The map that changes nothing.
    pub const IDENTITY: Self =
        Self { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin: [0.0; 3] };

    /// Moves.
    pub fn translation(by: Triple) -> Self {
        Self { origin: by, ..Self::IDENTITY }
    }

    /// Stretches along the axes.
    pub fn scaling(by: Triple) -> Self {
        let axis = |i: usize| std::array::from_fn(|k| if i == k { by[i] } else { 0.0 });
        Self { axes: [0, 1, 2].map(axis), origin: [0.0; 3] }
    }

    /// Turns around an axis, anticlockwise as seen from its end (O. Rodrigues, 1840). `None` where
    /// the axis is no direction.
    pub fn rotation(axis: Triple, degrees: f64) -> Option<Self> {
        let length = dot(axis, axis).sqrt();
        if !(length > 0.0) {
            return None;
        }
        let n = axis.map(|x| x / length);
        // Right angles are right.
        let (sin, cos) = match degrees.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            degrees => degrees.to_radians().sin_cos(),
        };
        let image = |v: Triple| {
            let (across, along) = (cross(n, v), dot(n, v) * (1.0 - cos));
            std::array::from_fn(|i| v[i] * cos + across[i] * sin + n[i] * along)
        };
        Some(Self { axes: Self::IDENTITY.axes.map(image), origin: [0.0; 3] })
    }

    /// The image of a direction.
    pub fn direction(&self, v: Triple) -> Triple {
        let [x, y, z] = self.axes;
        std::array::from_fn(|i| x[i] * v[0] + y[i] * v[1] + z[i] * v[2])
    }

    /// The image of a point.
    pub fn point(&self, p: Triple) -> Triple {
        let v = self.direction(p);
        std::array::from_fn(|i| v[i] + self.origin[i])
    }

    /// The image of a normal, of some length.
    pub fn normal(&self, n: Triple) -> Triple {
        // The transposed inverse, but for the determinant, of which only the sign matters.
        let [x, y, z] = self.axes;
        let cofactors = [cross(y, z), cross(z, x), cross(x, y)];
        let sign = self.determinant().signum();
        std::array::from_fn(|i| sign * (0..3).map(|k| cofactors[k][i] * n[k]).sum::<f64>())
    }

    /// First `inner`, then this.
    #[must_use]
    pub fn after(&self, inner: &Self) -> Self {
        let axes = inner.axes.map(|axis| self.direction(axis));
        Self { axes, origin: self.point(inner.origin) }
    }

    /// How much volumes grow; negative where it mirrors.
    pub fn determinant(&self) -> f64 {
        let [x, y, z] = self.axes;
        dot(x, cross(y, z))
    }

    /// Whether there is no way back.
    pub fn flattens(&self) -> bool {
        let [x, y, z] = self.axes.map(|axis| dot(axis, axis).sqrt());
        !(self.determinant().abs() > ROUNDING * x * y * z)
    }

    /// How much it stretches everything, if it stretches every way alike.
    pub fn similarity(&self) -> Option<f64> {
        let [x, y, z] = self.axes;
        let squared = dot(x, x);
        let alike = |v: f64, w: f64| (v - w).abs() <= ROUNDING * squared;
        let lengths = alike(dot(y, y), squared) && alike(dot(z, z), squared);
        let square = [dot(x, y), dot(y, z), dot(z, x)].into_iter().all(|v| alike(v, 0.0));
        (lengths && square).then(|| squared.sqrt())
    }

    /// Whether axes stay axes.
    fn keeps_boxes(&self) -> bool {
        self.axes.iter().all(|axis| {
            let greatest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            axis.iter().filter(|x| x.abs() > ROUNDING * greatest).count() == 1
        })
    }
}

fn box_corners(lo: Triple, hi: Triple) -> [Triple; 8] {
    std::array::from_fn(|i| std::array::from_fn(|k| if i >> k & 1 == 0 { lo[k] } else { hi[k] }))
}

fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Triple, b: Triple) -> Triple {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl Part {
    /// A solid, taken to its place by a map that does not flatten it: by moving the solid where its
    /// image is of the same kind.
    pub fn new(body: Body, map: &Map) -> Self {
        if *map == Map::IDENTITY {
            return Self { body, map: None };
        }
        let face = |[point, normal]: &[Triple; 2]| [map.point(*point), map.normal(*normal)];
        let moved = match (&body, map.similarity()) {
            (Body::Sphere { center, radius }, Some(scale)) => {
                Body::Sphere { center: map.point(*center), radius: radius * scale }
            }
            (Body::Cone { base, base_radius, apex, apex_radius }, Some(scale)) => Body::Cone {
                base: map.point(*base),
                base_radius: base_radius * scale,
                apex: map.point(*apex),
                apex_radius: apex_radius * scale,
            },
            (Body::Polyhedron { faces }, _) => {
                Body::Polyhedron { faces: faces.iter().map(face).collect() }
            }
            (Body::HalfSpace { face: plane }, _) => Body::HalfSpace { face: face(plane) },
            (Body::Box { lo, hi }, _) if map.keeps_boxes() => {
                let (a, b) = (map.point(*lo), map.point(*hi));
                let lo = std::array::from_fn(|i| a[i].min(b[i]));
                Body::Box { lo, hi: std::array::from_fn(|i| a[i].max(b[i])) }
            }
            _ => return Self::image(body, map),
        };
        Self { body: moved, map: None }
    }

    /// A solid around the origin and in about its final size, and the map that remains.
    fn image(body: Body, map: &Map) -> Self {
        let corners = Self { body: body.clone(), map: None }.corners();
        let middle: Triple = std::array::from_fn(|i| {
            let along = corners.iter().map(|corner| corner[i]);
            (along.clone().fold(f64::MAX, f64::min) + along.fold(f64::MIN, f64::max)) / 2.0
        });
        let size = map.determinant().abs().cbrt();
        let around = Map::scaling([size; 3]).after(&Map::translation(middle.map(|x| -x)));
        let axes = map.axes.map(|axis| axis.map(|x| x / size));
        let body = Self::new(body, &around).body;
        Self { body, map: Some(Map { axes, origin: map.point(middle) }) }
    }

    /// Moves it, and scales it by the factor by which the move stretches everything.
    pub fn moved(&mut self, point: &dyn Fn(Triple) -> Triple, scale: f64) {
        match &mut self.map {
            Some(map) => {
                map.origin = point(map.origin);
                let body = self.body.clone();
                self.body = Self::new(body, &Map::scaling([scale; 3])).body;
            }
            None => {
                let axes = Map::scaling([scale; 3]).axes;
                let moved = Self::new(self.body.clone(), &Map { axes, origin: point([0.0; 3]) });
                self.body = moved.body;
                // The points of planes near to the middle.
                let faces = match &mut self.body {
                    Body::Polyhedron { faces } => &mut faces[..],
                    Body::HalfSpace { face } => std::slice::from_mut(face),
                    _ => &mut [],
                };
                for [point, normal] in faces {
                    let t = dot(*point, *normal) / dot(*normal, *normal);
                    *point = normal.map(|x| x * t);
                }
            }
        }
    }

    /// The simplest primitive that it is.
    pub fn into_solid(self) -> Solid {
        match (self.body, self.map) {
            (Body::Sphere { center, radius }, None) => Solid::Sphere { center, radius },
            (Body::Box { lo, hi }, None) => Solid::Box { lo, hi },
            (Body::Cone { base, base_radius, apex, apex_radius }, None) => {
                Solid::Cone { base, base_radius, apex, apex_radius, capped: true }
            }
            (body, map) => Solid::Csg { steps: vec![Step::Part(Self { body, map })] },
        }
    }

    /// Points whose box is about that of the solid; none for a half-space.
    pub fn corners(&self) -> Vec<Triple> {
        let around = |at: &Triple, r: f64| box_corners(at.map(|x| x - r), at.map(|x| x + r));
        let corners = match &self.body {
            Body::Sphere { center, radius } => around(center, *radius).into(),
            Body::Box { lo, hi } => box_corners(*lo, *hi).into(),
            Body::Cone { base, base_radius, apex, apex_radius } => {
                [around(base, *base_radius), around(apex, *apex_radius)].concat()
            }
            Body::Polyhedron { faces } => {
                let plane = |[point, normal]: &[Triple; 2]| {
                    Plane::<f64>::new((*point).into(), (*normal).into())
                };
                let faces: Vec<_> = faces.iter().map(plane).collect();
                let bounds = Polyhedron::new(&faces).bounds();
                if bounds.is_empty() || bounds.max_abs() == f64::MAX {
                    Vec::new()
                } else {
                    box_corners(bounds.lo.to_array(), bounds.hi.to_array()).into()
                }
            }
            Body::HalfSpace { .. } => Vec::new(),
        };
        let map = self.map.unwrap_or(Map::IDENTITY);
        corners.into_iter().map(|corner| map.point(corner)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Triple, b: Triple) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12)
    }

    #[test]
    fn maps_do_what_their_names_say() {
        let x = [1.0, 0.0, 0.0];
        assert_eq!(Map::rotation([0.0, 0.0, 5.0], 90.0).unwrap().point(x), [0.0, 1.0, 0.0]);
        assert_eq!(Map::rotation([0.0, 2.0, 0.0], -90.0).unwrap().point(x), [0.0, 0.0, 1.0]);
        assert_eq!(Map::rotation([0.0; 3], 30.0), None);
        let thirds = Map::rotation([1.0; 3], 120.0).unwrap();
        assert!(near(thirds.point(x), [0.0, 1.0, 0.0]));
        let both = Map::translation([1.0, 2.0, 3.0]).after(&Map::scaling([2.0, 3.0, 4.0]));
        assert_eq!(both.point([1.0; 3]), [3.0, 5.0, 7.0]);
        assert_eq!(both.determinant(), 24.0);
        assert_eq!((both.similarity(), thirds.after(&thirds).similarity().is_some()), (None, true));
        assert!(!both.flattens() && Map::scaling([1.0, 0.0, 1.0]).flattens());
        // Normals stay square to their planes, also where a map mirrors.
        for scale in [[2.0, 3.0, 4.0], [-2.0, 3.0, 4.0]] {
            let map = Map::scaling(scale).after(&Map::rotation([1.0, 2.0, 0.0], 40.0).unwrap());
            let (n, out) = ([0.0, 0.0, 1.0], map.normal([0.0, 0.0, 1.0]));
            assert!(dot(out, map.direction([1.0, 0.0, 0.0])).abs() < 1e-12);
            assert!(dot(out, map.direction([3.0, 1.0, 0.0])).abs() < 1e-12);
            assert!(dot(out, map.direction(n)) > 0.0);
        }
    }

    #[test]
    fn solids_are_moved_themselves_where_that_is_possible() {
        let ball = Body::Sphere { center: [1.0, 0.0, 0.0], radius: 1.0 };
        let cube = Body::Box { lo: [0.0; 3], hi: [1.0, 2.0, 3.0] };
        let turn = Map::rotation([0.0, 0.0, 1.0], 90.0).unwrap();
        let tilt = Map::rotation([1.0, 0.0, 1.0], 30.0).unwrap();
        let egg = Map::scaling([1.0, 1.0, 2.0]);
        let twice = turn.after(&Map::scaling([2.0; 3]));
        let moved = Part::new(ball.clone(), &twice);
        let expected = Body::Sphere { center: [0.0, 2.0, 0.0], radius: 2.0 };
        assert_eq!(moved, Part { body: expected, map: None });
        let moved = Part::new(cube.clone(), &turn);
        let expected = Body::Box { lo: [-2.0, 0.0, 0.0], hi: [0.0, 1.0, 3.0] };
        assert_eq!(moved, Part { body: expected, map: None });
        // Others are around the origin and in their size, and a map remains.
        let image = Part::new(ball, &egg);
        let size = 2.0_f64.cbrt();
        assert_eq!(image.body, Body::Sphere { center: [0.0; 3], radius: size });
        let map = image.map.unwrap();
        assert_eq!(map.origin, [1.0, 0.0, 0.0]);
        assert!(near(map.point([0.0, 0.0, size]), [1.0, 0.0, 2.0]));
        let mut image = Part::new(cube, &tilt);
        image.moved(&|p| p.map(|x| x / 4.0 + 1.0), 0.25);
        let lo = tilt.point([0.0; 3]).map(|x| x / 4.0 + 1.0);
        assert!(image.corners().into_iter().any(|corner| near(corner, lo)));
    }
}
