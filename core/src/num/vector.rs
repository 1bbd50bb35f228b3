//! Three numbers, as the shapes and structures use them.

use super::Real;
use bytemuck::Pod;
use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

/// One of the three axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// All of them, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Its place: 0, 1 or 2.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The two that follow it in the cycle x, y, z.
    pub const fn others(self) -> (Self, Self) {
        match self {
            Self::X => (Self::Y, Self::Z),
            Self::Y => (Self::Z, Self::X),
            Self::Z => (Self::X, Self::Y),
        }
    }
}

/// A point, a direction or a colour.
pub trait Vector<R: Real<Vec3 = Self>>:
    Pod
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<R, Output = Self>
{
    /// From its three components.
    fn new(x: R, y: R, z: R) -> Self;
    /// The first component.
    fn x(self) -> R;
    /// The second component.
    fn y(self) -> R;
    /// The third component.
    fn z(self) -> R;

    /// The same number three times.
    fn splat(v: R) -> Self {
        Self::new(v, v, v)
    }
    /// From an array.
    fn from_array(v: [R; 3]) -> Self {
        let [x, y, z] = v;
        Self::new(x, y, z)
    }
    /// As an array.
    fn to_array(self) -> [R; 3] {
        [self.x(), self.y(), self.z()]
    }
    /// From doubles, rounded to the nearest.
    fn from_f64(v: [f64; 3]) -> Self {
        Self::from_array(v.map(R::from_f64))
    }
    /// The component along an axis.
    fn along(self, axis: Axis) -> R {
        match axis {
            Axis::X => self.x(),
            Axis::Y => self.y(),
            Axis::Z => self.z(),
        }
    }
    /// The component along an axis, of a vector in memory: one load.
    fn pick(&self, axis: Axis) -> R {
        let components: &[R; 3] = bytemuck::must_cast_ref(self);
        components.get(axis.index()).copied().unwrap_or_default()
    }
    /// Component by component.
    fn map(self, f: impl Fn(R) -> R) -> Self {
        Self::new(f(self.x()), f(self.y()), f(self.z()))
    }
    /// Component by component with another.
    fn zip(self, other: Self, f: impl Fn(R, R) -> R) -> Self {
        Self::new(f(self.x(), other.x()), f(self.y(), other.y()), f(self.z(), other.z()))
    }
    /// The smaller components.
    fn min(self, other: Self) -> Self {
        self.zip(other, R::min)
    }
    /// The greater components.
    fn max(self, other: Self) -> Self {
        self.zip(other, R::max)
    }
    /// Component times component: colours through colours.
    fn scale(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
    /// The scalar product, x + y first.
    fn dot(self, other: Self) -> R::Wide {
        self.x().times(other.x()) + self.y().times(other.y()) + self.z().times(other.z())
    }
    /// The vector product.
    fn cross(self, other: Self) -> Self {
        let f = |a: R, b: R, c: R, d: R| R::narrow(a.times(b) - c.times(d));
        Self::new(
            f(self.y(), other.z(), self.z(), other.y()),
            f(self.z(), other.x(), self.x(), other.z()),
            f(self.x(), other.y(), self.y(), other.x()),
        )
    }
    /// The vector product, or a positive multiple of it where a fixed-point type would lose it.
    fn across(self, other: Self) -> Self {
        self.cross(other)
    }
    /// The length.
    fn length(self) -> R {
        R::sqrt_wide(self.dot(self))
    }
    /// The greatest absolute value of the three; not-a-number when z is.
    fn max_abs(self) -> R {
        self.x().abs().max(self.y().abs()).max(self.z().abs())
    }
    /// The axis of the greatest absolute value; the first of equal ones.
    fn major_axis(self) -> Axis {
        let [x, y, z] = self.to_array().map(R::abs);
        if x >= y && x >= z {
            Axis::X
        } else if y >= z {
            Axis::Y
        } else {
            Axis::Z
        }
    }
    /// The same direction with length 1; `None` for zero, infinite or not-a-number vectors.
    fn unit(self) -> Option<Self> {
        let squared = R::narrow(self.dot(self));
        let least = R::EPSILON * R::EPSILON;
        if squared > least && squared * least < R::ONE {
            return Some(self * (R::ONE / squared.sqrt()));
        }
        unit_of_any_length::<R>(self)
    }
    /// No component is infinite or not a number.
    fn is_finite(self) -> bool {
        // What is not finite times 0 is not a number: one comparison for three.
        let v = self * R::ZERO;
        v.x() + v.y() + v.z() == R::ZERO
    }
    /// Every component is 0 or -0.
    fn is_zero(self) -> bool {
        self == Self::default()
    }
}

/// Scaled by a power of two first, so that squares neither overflow nor vanish.
#[cold]
#[inline(never)]
fn unit_of_any_length<R: Real>(v: R::Vec3) -> Option<R::Vec3> {
    let m = v.max_abs();
    if !(m > R::ZERO && v.is_finite()) {
        return None;
    }
    let exponent = m.exponent_to_one();
    let v = v.map(|x| x.ldexp(exponent));
    Some(v * (R::ONE / v.length()))
}
