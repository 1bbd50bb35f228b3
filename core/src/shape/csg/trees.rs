//! Expressions in postfix notation, and the boxes in which their operands matter.
//!
//! S. Cameron, "Efficient bounds in constructive solid geometry", IEEE CG&A 11(3) (1991), his
//! S-bounds; first for rendering by S. D. Roth, "Ray casting for modeling solids", Computer Graphics
//! and Image Processing 18 (1982). Upwards, a union has the box around both of its operands', an
//! intersection what they have in common, a difference the left one. Downwards, an operand matters
//! only inside its parent's box, and what is taken away only inside the box of what it is taken
//! from. Both ways again, until nothing changes: boxes only shrink, to walls that others have.

use super::CsgError;
use super::parts::Parts;
use crate::geom::Aabb;
use crate::memory::{Arena, Footprint};
use crate::num::{Real, Vec3, Vector};

/// How two solids are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// What is in either.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first and not in the second.
    Difference,
}

impl Operator {
    /// Whether a point is inside that is or is not in the first and in the second operand.
    pub const fn holds(self, first: bool, second: bool) -> bool {
        match self {
            Self::Union => first || second,
            Self::Intersection => first && second,
            Self::Difference => first && !second,
        }
    }
}

/// A step of a postfix notation; 4 bytes.
///
/// "A without B and C" is A, B, difference, C, difference; or A, B, C, union, difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The solid with this number.
    Part(u16),
    /// The two before it, put together.
    Join(Operator),
}

/// The most steps there can be: they are numbered with 16 bits.
pub const MOST_STEPS: usize = 1 << 16;

/// Objects in postfix notation, one after the other, and for every step what makes it quick to
/// evaluate: 26 bytes a step and 2 an object in `f32`. All of it may lie in flash.
#[derive(Clone, Copy, Debug)]
pub struct Trees<'a, R: Real> {
    pub(super) steps: &'a [Step],
    /// Of a join: where its second operand begins. Of a part where a second operand begins: the join.
    /// Of any other part: 0.
    links: &'a [u16],
    /// Corners of the boxes in which steps matter.
    bounds: &'a [[R::Vec3; 2]],
    /// The last step of every object.
    roots: &'a [u16],
}

impl<'a, R: Real> Trees<'a, R> {
    /// What [`Trees::build`] found out, given as constants.
    pub const fn of_parts(
        steps: &'a [Step],
        links: &'a [u16],
        bounds: &'a [[R::Vec3; 2]],
        roots: &'a [u16],
    ) -> Self {
        Self { steps, links, bounds, roots }
    }

    /// The bytes that [`Trees::build`] takes.
    pub fn footprint(steps: &[Step]) -> Footprint {
        Footprint::of::<u16>(steps.len())
            .then(Footprint::of::<u16>(objects(steps)))
            .then(Footprint::of::<[R::Vec3; 2]>(steps.len()))
    }

    /// Finds out where operands begin, and cuts their boxes. What two steps leave open is the next
    /// object. Time in proportion to the number of steps times the depth of the trees, for each of a
    /// few sweeps.
    ///
    /// # Errors
    /// [`CsgError::Steps`], [`CsgError::Operands`], [`CsgError::Part`], [`CsgError::Memory`].
    pub fn build(
        parts: &impl Parts<R>,
        steps: &'a [Step],
        arena: &mut Arena<'a>,
    ) -> Result<Self, CsgError> {
        if steps.len() > MOST_STEPS {
            return Err(CsgError::Steps { needed: steps.len(), available: MOST_STEPS });
        }
        arena.require(Self::footprint(steps))?;
        let links = arena.keep::<u16>("csg links", steps.len())?;
        let roots = arena.keep::<u16>("csg objects", objects(steps))?;
        let bounds = arena.keep::<[R::Vec3; 2]>("csg bounds", steps.len())?;
        link(steps, links)?;
        let mut end = steps.len();
        for root in roots.iter_mut().rev() {
            let last = end.saturating_sub(1);
            *root = last as u16;
            end = first(steps, links, last);
        }
        for (step, (bounds, kind)) in bounds.iter_mut().zip(steps).enumerate() {
            let all = match kind {
                Step::Part(part) if usize::from(*part) < parts.count() => {
                    parts.extent(usize::from(*part))
                }
                Step::Part(part) => {
                    return Err(CsgError::Part { step, part: *part, available: parts.count() });
                }
                Step::Join(_) => everything(),
            };
            *bounds = [all.lo, all.hi];
        }
        cut::<R>(steps, links, bounds);
        Ok(Self { steps, links, bounds, roots })
    }

    /// How many objects there are.
    pub fn objects(&self) -> usize {
        self.roots.len()
    }

    /// Where operands begin: see [`Trees::of_parts`].
    pub fn links(&self) -> &'a [u16] {
        self.links
    }

    /// Corners of the boxes in which steps matter: see [`Trees::of_parts`].
    pub fn boxes(&self) -> &'a [[R::Vec3; 2]] {
        self.bounds
    }

    /// The last steps of objects: see [`Trees::of_parts`].
    pub fn roots(&self) -> &'a [u16] {
        self.roots
    }

    /// The last step of an object.
    pub(super) fn root(&self, object: usize) -> Option<usize> {
        self.roots.get(object).map(|root| usize::from(*root))
    }

    /// The first step of an object.
    pub(super) fn begin(&self, object: usize) -> usize {
        let before = object.checked_sub(1).and_then(|object| self.root(object));
        before.map_or(0, |root| root + 1)
    }

    /// Where a step matters.
    pub(super) fn bounds(&self, step: usize) -> Aabb<R> {
        self.bounds.get(step).map_or_else(Aabb::empty, |[lo, hi]| Aabb { lo: *lo, hi: *hi })
    }

    /// The operator whose second operand begins with a part, and its step.
    pub(super) fn gate(&self, part: usize) -> Option<(Operator, usize)> {
        let step = usize::from(*self.links.get(part)?);
        match self.steps.get(step) {
            Some(Step::Join(operator)) if step > part => Some((*operator, step)),
            _ => None,
        }
    }

    /// Whether constants are what [`Trees::build`] would have found out, boxes apart.
    pub(super) fn is_sound(&self) -> bool {
        let Self { steps, links, bounds, roots } = *self;
        let link = |step: usize| links.get(step).copied().map_or(usize::MAX, usize::from);
        let fits = |(step, kind): (usize, &Step)| match kind {
            Step::Part(_) => link(step) == 0 || (link(step) > step && link(link(step)) == step),
            Step::Join(_) => {
                let begin = link(step);
                let whole = step > 0 && first(steps, links, step - 1) == begin;
                whole && begin > 0 && link(begin) == step
            }
        };
        let mut begin = 0;
        let objects_fit = roots.iter().all(|root| {
            let object = core::mem::replace(&mut begin, usize::from(*root) + 1);
            usize::from(*root) >= object && first(steps, links, usize::from(*root)) == object
        });
        [links.len(), bounds.len(), begin].into_iter().all(|len| len == steps.len())
            && steps.iter().enumerate().all(fits)
            && objects_fit
    }
}

/// How many objects steps make: every join leaves one less than it found.
fn objects(steps: &[Step]) -> usize {
    let parts = steps.iter().filter(|step| matches!(step, Step::Part(_))).count();
    parts.saturating_sub(steps.len() - parts)
}

/// Where the operand begins that ends with a step. Every turn leads to an earlier step.
fn first(steps: &[Step], links: &[u16], mut step: usize) -> usize {
    while let (Some(Step::Join(_)), Some(link)) = (steps.get(step), links.get(step)) {
        match usize::from(*link).checked_sub(1) {
            Some(left) if left < step => step = left,
            _ => break,
        }
    }
    step
}

/// Finds where second operands begin.
fn link(steps: &[Step], links: &mut [u16]) -> Result<(), CsgError> {
    links.fill(0);
    for (step, kind) in steps.iter().enumerate() {
        if let Step::Join(_) = kind {
            let begin = step.checked_sub(1).map_or(0, |right| first(steps, links, right));
            let (Some(link), true) = (links.get_mut(step), begin > 0) else {
                return Err(CsgError::Operands { step });
            };
            *link = begin as u16;
            if let Some(back) = links.get_mut(begin) {
                *back = step as u16;
            }
        }
    }
    Ok(())
}

/// Passes boxes up and down until nothing changes. A sweep that changes nothing is the last; there
/// are never more than steps, and to stop early would only leave boxes greater than need be.
fn cut<R: Real>(steps: &[Step], links: &[u16], bounds: &mut [[R::Vec3; 2]]) {
    for _ in 0..=steps.len() {
        let mut changed = false;
        for step in 0..steps.len() {
            let Some((operator, left, right)) = operands(steps, links, step) else { continue };
            let (left, right) = (get::<R>(bounds, left), get::<R>(bounds, right));
            let all = match operator {
                Operator::Union => left.union(right),
                Operator::Intersection => common(left, right),
                Operator::Difference => left,
            };
            changed |= narrow::<R>(bounds, step, all);
        }
        for step in (0..steps.len()).rev() {
            let Some((operator, left, right)) = operands(steps, links, step) else { continue };
            let all = get::<R>(bounds, step);
            changed |= narrow::<R>(bounds, left, all);
            changed |= narrow::<R>(bounds, right, all);
            if operator == Operator::Difference {
                let left = get::<R>(bounds, left);
                changed |= narrow::<R>(bounds, right, left);
            }
        }
        if !changed {
            break;
        }
    }
}

/// The operator of a join and the last steps of its operands.
fn operands(steps: &[Step], links: &[u16], step: usize) -> Option<(Operator, usize, usize)> {
    match steps.get(step)? {
        Step::Join(operator) => {
            let left = usize::from(*links.get(step)?).checked_sub(1)?;
            Some((*operator, left, step.checked_sub(1)?))
        }
        Step::Part(_) => None,
    }
}

fn get<R: Real>(bounds: &[[R::Vec3; 2]], step: usize) -> Aabb<R> {
    bounds.get(step).map_or_else(Aabb::empty, |[lo, hi]| Aabb { lo: *lo, hi: *hi })
}

/// Cuts the box of a step; whether that changed it.
fn narrow<R: Real>(bounds: &mut [[R::Vec3; 2]], step: usize, to: Aabb<R>) -> bool {
    let old = get::<R>(bounds, step);
    let new = common(old, to);
    if let Some(bounds) = bounds.get_mut(step) {
        *bounds = [new.lo, new.hi];
    }
    new != old
}

/// What two boxes have in common; one of the empty box's form where that is nothing.
fn common<R: Real>(a: Aabb<R>, b: Aabb<R>) -> Aabb<R> {
    let all = Aabb { lo: a.lo.max(b.lo), hi: a.hi.min(b.hi) };
    if all.is_empty() { Aabb::empty() } else { all }
}

fn everything<R: Real>() -> Aabb<R> {
    Aabb { lo: Vec3::<R>::splat(-R::MAX), hi: Vec3::<R>::splat(R::MAX) }
}
