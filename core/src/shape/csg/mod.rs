//! Constructive solid geometry: unions, intersections and differences of closed solids.
//!
//! A. A. G. Requicha, H. B. Voelcker, "Constructive solid geometry", TM-25, University of Rochester
//! (1977); along rays by S. D. Roth, "Ray casting for modeling solids", Computer Graphics and Image
//! Processing 18 (1982).
//!
//! An object is written down in postfix notation, as [`Step`]s over numbered [`Parts`]: no pointers,
//! so that it can lie in flash, and no recursion. A ray is evaluated from step to step on a stack of
//! crossing lists, in memory whose size is a parameter of the type and is checked when the object
//! is made. However many parts it has, it is one shape to every structure.
//!
//! # What is skipped
//! Before a second operand the ray is tested against the box in which that matters ([`trees`] says
//! how it is cut). It is skipped when the ray passes by, or does not come there in the interval that
//! is asked for, or when nothing is there to be cut: the first operand is not met, or not within
//! the box. The first crossing is looked for from front to back: where the ray meets the first operand,
//! others that begin farther away are not asked unless that place turns out to be cut off. A skipped
//! operand cannot change an answer, bit for bit: what a part contributes is always held to its box,
//! grown by [`Ray::slack`].
//!
//! # Ties
//! Where surfaces of two operands are crossed at the very same `t`, both are passed at once. So a
//! difference leaves no skin where surfaces coincide, a union no gap, and an intersection of solids
//! that only touch is nothing. Surfaces that coincide but are computed differently (a box and a
//! cylinder's end) may be told apart by rounding; let what is cut off reach beyond.

mod evaluate;
mod lists;
mod parts;
pub mod trees;

#[cfg(test)]
mod tests;

pub use lists::Crossing;
pub use parts::Parts;
pub use trees::{Operator, Step, Trees};

use super::ShapeError;
use crate::geom::{Aabb, Ray, Slopes};
use crate::memory::{Arena, OutOfArena};
use crate::num::{Real, Vec3, Vector};
use crate::scene::Shapes;
use core::fmt;

/// Why solids cannot be combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CsgError {
    /// More steps than can be numbered.
    Steps {
        /// How many there are.
        needed: usize,
        /// How many there may be.
        available: usize,
    },
    /// A join comes before there are two operands for it.
    Operands {
        /// Its step.
        step: usize,
    },
    /// There is no such part.
    Part {
        /// The step that names it.
        step: usize,
        /// Its number.
        part: u16,
        /// How many parts there are.
        available: usize,
    },
    /// A part is unusable.
    Shape {
        /// Its number.
        part: u16,
        /// What is wrong with it.
        why: ShapeError,
    },
    /// A part has no inside: its ends are open.
    Open {
        /// Its number.
        part: u16,
    },
    /// A ray may cross an object more often than there is room for: two times a part.
    Crossings {
        /// The object.
        object: usize,
        /// How often it may be crossed.
        needed: usize,
        /// The room there is, a parameter of the type.
        available: usize,
    },
    /// An object has no end: a half-space is not cut on all sides.
    Unbounded {
        /// The object.
        object: usize,
    },
    /// Nothing is left of an object: what is intersected does not meet.
    Empty {
        /// The object.
        object: usize,
    },
    /// Constants are not those of [`Trees::build`].
    Unsound,
    /// The arena is too small.
    Memory(OutOfArena),
}

impl From<OutOfArena> for CsgError {
    fn from(error: OutOfArena) -> Self {
        Self::Memory(error)
    }
}

impl fmt::Display for CsgError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Steps { needed, available } => {
                write!(f, "{needed} steps where at most {available} can be numbered")
            }
            Self::Operands { step } => write!(f, "step {step} joins what is not there"),
            Self::Part { step, part, available } => {
                write!(f, "step {step} names part {part}, there are {available}")
            }
            Self::Shape { part, why } => write!(f, "part {part}: {why}"),
            Self::Open { part } => write!(f, "part {part} is open: close its ends"),
            Self::Crossings { object, needed, available } => write!(
                f,
                "object {object} may be crossed {needed} times, there is room for {available}"
            ),
            Self::Unbounded { object } => {
                write!(f, "object {object} has no end: a half-space is not cut on all sides")
            }
            Self::Empty { object } => {
                write!(f, "nothing is left of object {object}: what it intersects does not meet")
            }
            Self::Unsound => f.write_str("the tables of the trees do not belong together"),
            Self::Memory(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for CsgError {}

/// Combined solids, a set of shapes like a slice of one kind is: put it into a tuple with others, or
/// into a scene of its own.
///
/// `N` is how often a ray may cross an object: at least twice the number of its parts. A query needs
/// about 28 N bytes of stack in `f32`.
#[derive(Clone, Copy, Debug)]
pub struct Csg<'a, R: Real, S, const N: usize = 64> {
    parts: S,
    trees: Trees<'a, R>,
}

impl<'a, R: Real, S: Parts<R>, const N: usize> Csg<'a, R, S, N> {
    /// Prepares objects: [`Trees::build`], then [`Csg::new`].
    ///
    /// # Errors
    /// Theirs.
    pub fn build(parts: S, steps: &'a [Step], arena: &mut Arena<'a>) -> Result<Self, CsgError> {
        // Boxes of unusable shapes are nothing to compute with.
        check_parts(&parts, steps)?;
        let trees = Trees::build(&parts, steps, arena)?;
        Self::new(parts, trees)
    }

    /// Combines parts by trees that were made for them.
    ///
    /// # Errors
    /// What [`CsgError`] lists, memory and steps apart.
    pub fn new(parts: S, trees: Trees<'a, R>) -> Result<Self, CsgError> {
        if !trees.is_sound() {
            return Err(CsgError::Unsound);
        }
        check_parts(&parts, trees.steps)?;
        for object in 0..trees.objects() {
            let Some(root) = trees.root(object) else { continue };
            let steps = trees.steps.get(trees.begin(object)..=root).unwrap_or_default();
            // A tree has one join less than parts.
            let needed = steps.len() + 1;
            if needed > N {
                return Err(CsgError::Crossings { object, needed, available: N });
            }
            let bounds = trees.bounds(root);
            if bounds.is_empty() {
                return Err(CsgError::Empty { object });
            }
            if !(bounds.max_abs() < R::MAX) {
                return Err(CsgError::Unbounded { object });
            }
        }
        Ok(Self { parts, trees })
    }

    /// The parts.
    pub fn parts(&self) -> &S {
        &self.parts
    }

    /// The trees.
    pub fn trees(&self) -> &Trees<'a, R> {
        &self.trees
    }
}

/// Whether all steps name usable, closed parts.
fn check_parts<R: Real, S: Parts<R>>(parts: &S, steps: &[Step]) -> Result<(), CsgError> {
    for (step, kind) in steps.iter().enumerate() {
        let Step::Part(part) = *kind else { continue };
        let id = usize::from(part);
        if id >= parts.count() {
            return Err(CsgError::Part { step, part, available: parts.count() });
        }
        parts.check(id).map_err(|why| CsgError::Shape { part, why })?;
        if !parts.is_closed(id) {
            return Err(CsgError::Open { part });
        }
    }
    Ok(())
}

/// Every object is a shape. They have been checked when the set was made.
impl<R: Real, S: Parts<R>, const N: usize> Shapes<R> for Csg<'_, R, S, N> {
    type PerRay = (Slopes<R>, S::PerRay);

    const UNBOUNDED: bool = false;

    fn count(&self) -> usize {
        self.trees.objects()
    }

    fn bounded(&self) -> usize {
        self.trees.objects()
    }

    fn check(&self, _id: usize) -> Result<(), ShapeError> {
        Ok(())
    }

    fn bounds(&self, id: usize) -> Aabb<R> {
        self.trees.root(id).map_or_else(Aabb::empty, |root| self.trees.bounds(root))
    }

    fn per_ray(&self, ray: &Ray<R>) -> Self::PerRay {
        if self.trees.objects() == 0 {
            return Self::PerRay::default();
        }
        (Slopes::of(ray), self.parts.per_ray(ray))
    }

    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> Option<R> {
        let first = self.first_crossing(id, ray, per_ray, (min, max), &mut ());
        first.map(|crossing| crossing.t)
    }

    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &Self::PerRay, min: R, max: R) -> bool {
        self.hit(id, ray, per_ray, min, max).is_some()
    }

    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        let Some((crossing, enters)) = self.crossing_at(id, ray, t) else {
            return Vec3::<R>::default();
        };
        let normal = self.parts.normal(usize::from(crossing.part), ray, t);
        // Out of the object, also where its surface is that of something taken away.
        let leaves_part = normal.dot(ray.direction()) > R::Wide::default();
        if enters == leaves_part { -normal } else { normal }
    }

    fn shading_normal(&self, _id: usize, _ray: &Ray<R>, _t: R) -> Option<Vec3<R>> {
        None
    }

    /// What is left of a part may be much smaller than the part.
    fn reach(&self, id: usize) -> R {
        let Some(root) = self.trees.root(id) else { return R::ZERO };
        let steps = self.trees.steps.get(self.trees.begin(id)..=root).unwrap_or_default();
        let reach = |step: &Step| match step {
            Step::Part(part) => self.parts.part_reach(usize::from(*part)),
            Step::Join(_) => R::ZERO,
        };
        steps.iter().map(reach).fold(R::ZERO, R::max)
    }
}
