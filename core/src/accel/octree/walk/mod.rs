//! Ways of getting from leaf to leaf along a ray.
//!
//! All of them hold the ray's place in whole numbers, counted in cells of the deepest level, and
//! compute walls from these: no point is nudged, no leaf is skipped, and every step passes at least
//! one wall that was not passed before, so the walk ends after at most three times as many leaves as
//! there are cells along an axis.

mod descent;
mod places;

use super::{Octree, Storage};
use crate::accel::{Accel, Id, Visitor, listing};
use crate::geom::{Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;
use descent::Descent;
use places::Places;

/// How a ray gets from leaf to leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Walk {
    /// Every leaf is located from the root.
    ///
    /// A. Glassner, "Space subdivision for fast ray tracing", IEEE CG&A 4(10) (1984).
    Restart,
    /// The next leaf is located from the smallest cell that contains both.
    ///
    /// H. Samet, "Implementing ray tracing with octrees and neighbor finding", Computers & Graphics
    /// 13(4) (1989).
    Neighbours,
    /// Down the tree front to back, with a stack of the cells that are not done with.
    ///
    /// J. Revelles, C. Ureña, M. Lastra, "An efficient parametric algorithm for octree traversal",
    /// WSCG 2000, made a loop.
    #[default]
    Descent,
    /// The ray is cut into its pieces in the next 16 leaves before their lists are tested.
    Segments,
}

/// Pieces that a ray is cut into at a time.
pub(super) const SEGMENTS: usize = 16;

/// An octree with a way of walking it.
#[derive(Debug)]
pub struct By<'o, O> {
    octree: &'o O,
    walk: Walk,
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Octree<'m, R, I, C> {
    /// The octree, walked in a given way. The hits are the same.
    pub fn by(&self, walk: Walk) -> By<'_, Self> {
        By { octree: self, walk }
    }
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Accel<R> for By<'_, Octree<'m, R, I, C>> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let octree = self.octree;
        if self.walk == Walk::Descent {
            return octree.walk(ray, visitor);
        }
        octree.aside.visit(visitor);
        let interval = (visitor.start(), visitor.limit());
        if self.walk == Walk::Segments {
            if let Some(descent) = Descent::new(octree, ray, interval) {
                in_pieces(octree, descent, visitor);
            }
            return;
        }
        let slopes = Slopes::of(ray);
        let part = octree.lattice.clip(&slopes, interval.0, interval.1);
        let Some((enter, _)) = part else { return };
        if self.walk == Walk::Restart {
            let places = &mut Places::<_, _, _, false>::new(octree, ray, &slopes, enter);
            one_by_one(octree, places, visitor);
        } else {
            let places = &mut Places::<_, _, _, true>::new(octree, ray, &slopes, enter);
            one_by_one(octree, places, visitor);
        }
    }
}

impl<'m, R: Real, I: Id, C: Storage<'m>> Accel<R> for Octree<'m, R, I, C> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        self.aside.visit(visitor);
        let mut descent = Descent::new(self, ray, (visitor.start(), visitor.limit()));
        if let Some(descent) = &mut descent {
            one_by_one(self, descent, visitor);
        }
    }
}

/// A leaf, and the parameter at which the ray leaves it.
type Piece<C, R> = (C, R);

/// Finds the leaves of a ray, in order.
trait Leaves<R, C> {
    /// The next leaf.
    fn next(&mut self, probe: &mut impl Probe) -> Option<C>;
    /// The parameter at which the ray leaves it.
    fn exit(&self) -> R;
}

/// Tests a leaf's list; false when nothing beyond the leaf is of interest.
fn test<'m, R: Real, I: Id, C: Storage<'m>, V: Visitor<R>>(
    octree: &Octree<'m, R, I, C>,
    (leaf, exit): Piece<C::Cell, R>,
    visitor: &mut V,
) -> bool {
    let (place, list) = octree.list(leaf);
    visitor.probe().leaf(list.is_empty());
    if !list.is_empty() && visitor.admit_list(place) {
        listing::visit(list, visitor);
    }
    visitor.limit() > exit
}

/// Tests every leaf when it is found.
fn one_by_one<'m, R: Real, I: Id, C: Storage<'m>, V: Visitor<R>>(
    octree: &Octree<'m, R, I, C>,
    leaves: &mut impl Leaves<R, C::Cell>,
    visitor: &mut V,
) {
    while let Some(leaf) = leaves.next(visitor.probe()) {
        if !test(octree, (leaf, leaves.exit()), visitor) {
            return;
        }
    }
}

/// Finds several leaves before testing them.
fn in_pieces<'m, R: Real, I: Id, C: Storage<'m>, V: Visitor<R>>(
    octree: &Octree<'m, R, I, C>,
    mut leaves: impl Leaves<R, C::Cell>,
    visitor: &mut V,
) {
    let mut pieces = [None; SEGMENTS];
    loop {
        for piece in &mut pieces {
            *piece = leaves.next(visitor.probe()).map(|leaf| (leaf, leaves.exit()));
            if piece.is_none() {
                break;
            }
        }
        for piece in pieces {
            let Some(piece) = piece else { return };
            if !test(octree, piece, visitor) {
                return;
            }
        }
    }
}
