//! The k-dop: what lies between k/2 pairs of planes in fixed directions.
//!
//! T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986; the sets of directions
//! are those of J. Klosowski et al., "Efficient collision detection using bounding volume
//! hierarchies of k-dops", IEEE TVCG 4(1) (1998): the axes, the diagonals of the faces of a cube, the
//! diagonals of the cube.
//!
//! In units in the last place of the scene's greatest coordinate, for a diagonal of two (three)
//! components of 1: a shape may be hit 64 (96) outside, and the pad is twice that. The products of
//! the diagonal with the ray's origin and direction, the parameter of a side and the side itself are
//! off by 4, 5, 13 and 15 (10, 8, 19 and 25).

use super::slab::{Course, courses, cut, cut_by_box};
use super::{Bound, Fitted, Region, Stored, shrunk};
use crate::geom::{Aabb, Ray};
use crate::num::{Axis, Real, Reciprocal, Vec3, Vector};

/// Signs of a diagonal's components.
type Signs = [i8; 3];

/// Of the faces, and of the cube. A diagonal's components are half of these.
const DIAGONALS: [Signs; 10] = [
    [1, 1, 0],
    [1, -1, 0],
    [0, 1, 1],
    [0, 1, -1],
    [1, 0, 1],
    [-1, 0, 1],
    [1, 1, 1],
    [1, 1, -1],
    [1, -1, 1],
    [-1, 1, 1],
];

/// Diagonals of the faces.
const FACES: usize = 6;

/// A k-dop of `K` pairs of planes: 3 (the box), 7, 9 or 13; `8 K` bytes in `f32`. With any other
/// number it has no planes but the box's, and what is left of the bytes is wasted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KDop<R: Real, const K: usize> {
    /// Least and greatest product with each direction: those of the axes first.
    slabs: [[R; 2]; K],
}

impl<R: Real, const K: usize> KDop<R, K> {
    /// Directions that are no axes.
    const DIAGONALS: &'static [Signs] = match (K, DIAGONALS.split_at(FACES)) {
        (7, (_, cube)) => cube,
        (9, (faces, _)) => faces,
        (13, _) => &DIAGONALS,
        _ => &[],
    };

    /// The box among the slabs.
    fn aabb(&self) -> Aabb<R> {
        let of = |axis: Axis| self.slabs.get(axis.index()).copied().unwrap_or_default();
        let [x, y, z] = Axis::ALL.map(of);
        Aabb { lo: Vec3::<R>::new(x[0], y[0], z[0]), hi: Vec3::<R>::new(x[1], y[1], z[1]) }
    }

    /// The slabs of the diagonals.
    fn diagonals(&self) -> impl Iterator<Item = (&'static Signs, &[R; 2])> {
        Self::DIAGONALS.iter().zip(self.slabs.iter().skip(3))
    }

    /// How far it reaches at most along two axes together, with a sign each; the third one is `w`.
    fn reach(&self, (u, v, w): (Axis, Axis, Axis), (su, sv): (i8, i8), aabb: &Aabb<R>) -> R {
        let side = |axis: Axis, sign: i8| {
            if sign > 0 { aabb.hi.along(axis) } else { -aabb.lo.along(axis) }
        };
        let mut most = side(u, su) + side(v, sv);
        for (signs, [lo, hi]) in self.diagonals() {
            let of = |axis: Axis| signs.get(axis.index()).copied().unwrap_or(0);
            let reach = if of(u) == su && of(v) == sv {
                *hi
            } else if of(u) == -su && of(v) == -sv {
                -*lo
            } else {
                continue;
            };
            // The part of the third axis can be taken away again.
            let third = of(w) * of(u) * su;
            let reach = reach + reach;
            most = most.min(if third == 0 { reach } else { reach + side(w, -third) });
        }
        most
    }
}

/// The product of a diagonal with a vector.
#[inline]
fn along<R: Real>(signs: &Signs, v: Vec3<R>) -> R {
    let [x, y, z] = signs;
    let part = |sign: &i8, x: R| match sign {
        1 => x * R::HALF,
        -1 => -(x * R::HALF),
        _ => R::ZERO,
    };
    part(x, v.x()) + part(y, v.y()) + part(z, v.z())
}

/// What k-dops want to know of a ray.
#[derive(Clone, Copy, Debug)]
pub struct Lines<R: Real> {
    axes: [Course<R>; 3],
    diagonals: [Course<R>; DIAGONALS.len()],
}

impl<R: Real, const K: usize> Bound<R> for KDop<R, K> {
    type PerRay = Lines<R>;

    /// Half the surface of a box is the sum of its shadows along the axes; so are these, of the
    /// corners that the diagonals cut off bereft.
    fn half_area(&self) -> R {
        let aabb = self.aabb();
        let mut sum = R::ZERO;
        for w in Axis::ALL {
            let (u, v) = w.others();
            let size = aabb.size();
            let (width, height) = (size.along(u), size.along(v));
            let mut shadow = R::narrow(shrunk(width).times(shrunk(height)));
            for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let side = |axis: Axis, sign: i8| {
                    if sign > 0 { aabb.hi.along(axis) } else { -aabb.lo.along(axis) }
                };
                let corner = side(u, signs.0) + side(v, signs.1);
                let cut = corner - self.reach((u, v, w), signs, &aabb);
                let cut = shrunk(cut.clamp(R::ZERO, width.min(height) * R::HALF));
                shadow = shadow - R::narrow(cut.times(cut)) * R::HALF;
            }
            sum = sum + shadow;
        }
        sum
    }

    fn middle(&self) -> Vec3<R> {
        self.aabb().middle()
    }

    fn per_ray(ray: &Ray<R>) -> Lines<R> {
        let mut diagonals = [(R::ZERO, R::Reciprocal::default()); DIAGONALS.len()];
        for (line, signs) in diagonals.iter_mut().zip(Self::DIAGONALS) {
            let step = along::<R>(signs, ray.direction());
            *line = (along::<R>(signs, ray.origin()), R::Reciprocal::of(step));
        }
        Lines { axes: courses(ray), diagonals }
    }

    #[inline]
    fn enter(&self, lines: &Lines<R>, start: R, limit: R) -> Option<R> {
        if !(start <= limit) {
            return None;
        }
        let aabb = self.aabb();
        let mut part = cut_by_box::<R>((start, limit), &lines.axes, aabb.lo, aabb.hi)?;
        for (course, (_, slab)) in lines.diagonals.iter().zip(self.diagonals()) {
            part = cut::<R>(part, *course, *slab)?;
        }
        Some(part.0)
    }
}

impl<R: Real, const K: usize> Fitted<R> for KDop<R, K> {
    fn around(region: &Region<R>, pad: R) -> Self {
        let mut slabs = [[R::ZERO; 2]; K];
        let bounds = region.bounds().grown(pad);
        let (lo, hi) = (bounds.lo.to_array(), bounds.hi.to_array());
        for (slab, (lo, hi)) in slabs.iter_mut().zip(lo.into_iter().zip(hi)) {
            *slab = [lo, hi];
        }
        for (slab, signs) in slabs.iter_mut().skip(3).zip(Self::DIAGONALS) {
            let direction = signs.map(|sign| R::HALF.times_int(sign.into()));
            let components = signs.iter().filter(|sign| **sign != 0).count();
            let margin = pad.times_int(components as i32) * R::HALF;
            let (lo, hi) = region.places(Vec3::<R>::from_array(direction), pad);
            *slab = [lo - margin, hi + margin];
        }
        Self { slabs }
    }

    fn union(self, other: Self) -> Self {
        let mut slabs = self.slabs;
        for (slab, other) in slabs.iter_mut().zip(other.slabs) {
            *slab = [slab[0].min(other[0]), slab[1].max(other[1])];
        }
        Self { slabs }
    }
}

impl<R: Real, const K: usize> Stored<R> for KDop<R, K>
where
    [[R; 2]; K]: bytemuck::Pod,
{
    type Plain = [[R; 2]; K];

    fn plain(self) -> Self::Plain {
        self.slabs
    }

    fn of(slabs: &Self::Plain) -> Self {
        Self { slabs: *slabs }
    }
}
