//! Axis-aligned boxes as bounds.

use crate::num::{Real, Vec3, Vector};

/// An axis-aligned box, closed: its faces belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<R: Real> {
    /// Least corner.
    pub lo: Vec3<R>,
    /// Greatest corner.
    pub hi: Vec3<R>,
}

impl<R: Real> Aabb<R> {
    /// The box that contains nothing; a union with it changes nothing.
    pub fn empty() -> Self {
        Self { lo: Vec3::<R>::splat(R::INFINITY), hi: Vec3::<R>::splat(-R::INFINITY) }
    }

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = Vec3<R>>) -> Self {
        points.into_iter().fold(Self::empty(), |b, p| Self { lo: b.lo.min(p), hi: b.hi.max(p) })
    }

    /// The smallest box around both.
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Every face moved outwards by `margin`.
    pub fn grown(self, margin: R) -> Self {
        let margin = Vec3::<R>::splat(margin);
        Self { lo: self.lo - margin, hi: self.hi + margin }
    }

    /// Whether a point lies inside or on a face.
    pub fn contains(&self, p: Vec3<R>) -> bool {
        let ([ax, ay, az], [bx, by, bz]) = (self.lo.to_array(), self.hi.to_array());
        p.x() >= ax && p.x() <= bx && p.y() >= ay && p.y() <= by && p.z() >= az && p.z() <= bz
    }

    /// The edge lengths.
    pub fn size(&self) -> Vec3<R> {
        self.hi.zip(self.lo, |hi, lo| hi - lo)
    }

    /// Whether it contains no point at all; also when a bound is not a number.
    pub fn is_empty(&self) -> bool {
        let size = self.size();
        !(size.x() >= R::ZERO && size.y() >= R::ZERO && size.z() >= R::ZERO)
    }

    /// The greatest absolute coordinate: what rounding errors are proportional to.
    pub fn max_abs(&self) -> R {
        self.lo.max_abs().max(self.hi.max_abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn empty_is_neutral_and_empty() {
        let unit = Aabb::<f32> { lo: Vec3::ZERO, hi: Vec3::ONE };
        assert_eq!(Aabb::empty().union(unit), unit);
        assert!(Aabb::<f32>::empty().is_empty());
        assert!(!unit.is_empty());
        assert!(unit.contains(Vec3::ONE) && !unit.contains(Vec3::splat(1.0 + f32::EPSILON)));
        assert!(!unit.contains(Vec3::NAN));
    }
}
