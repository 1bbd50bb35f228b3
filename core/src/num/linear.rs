//! What a ray's way along an axis is computed from. In fixed point none of these fits the format of
//! coordinates.

use super::Real;
use core::fmt::Debug;

/// The reciprocal of a direction's component.
pub trait Reciprocal<R>: Copy + Debug + Default + PartialEq + Send + Sync {
    /// 1 / d; 0 where that is not finite: the way along this axis is nothing.
    fn of(d: R) -> Self;
    /// 1, -1, or 0 where it is 0.
    fn sign(self) -> i32;
    /// `x / d`.
    fn times(self, x: R) -> R;
}

/// An extent divided into equal cells.
pub trait Cells<R>: Copy + Debug + Default + Send + Sync {
    /// Divides it into `count > 0` cells.
    fn new(extent: R, count: i32) -> Self;
    /// In which cell `x >= 0` lies, counted from its beginning; what lies below is in cell 0 or
    /// below, what lies beyond in the last or beyond.
    fn index(&self, x: R) -> i32;
    /// How far from the beginning cell `i` begins, rounded; `i` from 0 to their number.
    fn wall(&self, i: i32) -> R;
}

/// Parameters at which a ray meets walls at equal distances, each computed from its number and never
/// from the one before: so they cannot drift.
pub trait Progress<R: Real>: Copy + Debug + Default {
    /// As in [`Real::Reciprocal`].
    type Reciprocal;
    /// As in [`Real::Cells`].
    type Cells;
    /// The number of a wall as it is quickest to count and to compute with.
    type Count: Copy + Debug;
    /// The same walls for a descent.
    type Halves: Halves<R>;

    /// `count` walls, of which the first is `from` away; `None` where the ray does not move.
    fn new(reciprocal: Self::Reciprocal, from: R, cells: &Self::Cells, count: i32) -> Option<Self>;
    /// The same from the direction itself.
    fn of(direction: R, from: R, cells: &Self::Cells, count: i32) -> Option<Self>;
    /// The same for any direction: where a ray hardly moves it meets each wall far away.
    fn steep(direction: R, from: R, cells: &Self::Cells) -> Self;
    /// Whether walls of greater numbers come at smaller parameters.
    fn falls(&self) -> bool;
    /// Every wall is infinitely far away.
    fn never() -> Self;
    /// The parameter of wall number `i`.
    fn at(&self, i: i32) -> R;
    /// The same walls with their numbers times `sign`: for a ray that moves towards smaller numbers,
    /// -1 lets them grow; 0 for one that moves along none.
    fn along(&self, sign: i32) -> Self;
    /// A number to count from.
    fn count(i: i32) -> Self::Count;
    /// What has been counted to.
    fn number(count: Self::Count) -> i32;
    /// The next greater number.
    fn next(count: Self::Count) -> Self::Count;
    /// [`Progress::at`] of what has been counted to.
    fn at_count(&self, count: Self::Count) -> R;
    /// Numbers from wall `origin`, every 2^`shift`-th wall.
    fn rebased(&self, origin: i32, shift: u8) -> Self;
    /// Those of 2^`deepest` cells, and where the ray meets the first of them; `falls` as in
    /// [`Progress::falls`].
    fn halves(
        &self,
        falls: bool,
        deepest: u32,
    ) -> (Self::Halves, <Self::Halves as Halves<R>>::Middle);
}

/// Where a ray meets the middle walls of cells that are halved level by level, along one axis and
/// seen as the ray goes: it comes to a cell's lower half first.
pub trait Halves<R: Real>: Copy + Debug + Default {
    /// Where it meets the wall in the middle of a cell.
    type Middle: Copy + Debug + Default;
    /// What of the place of a cell this is computed from.
    type Corner: Copy + Debug + Default;

    /// Along an axis that the ray does not move along, in cell `cell` of 2^`deepest`: walls up to
    /// that one have been passed for ever, those beyond it never will be.
    fn standing(cell: i32, deepest: u32) -> (Self, Self::Middle);
    /// Where the halves of a cell with that corner begin: of the upper one, or of the lower one. Their
    /// edges are 2^`shift` cells.
    fn corner(corner: Self::Corner, upper: bool, shift: u32) -> Self::Corner;
    /// Of a cell at a level, its corner, and the half of the cell above that it is, the second one if
    /// `passed`, in the order of the ray. The root, at level 0, is the second half of what has its
    /// middle in the first wall.
    fn middle(
        &self,
        above: Self::Middle,
        passed: bool,
        corner: Self::Corner,
        level: u32,
        deepest: u32,
    ) -> Self::Middle;
    /// The part of a piece of the ray that is between the first wall and the last; of no length or
    /// less, or `None`, where there is none. `falls` and `deepest` as in [`Progress::halves`].
    fn between(
        &self,
        first: Self::Middle,
        part: (R, R),
        falls: bool,
        deepest: u32,
    ) -> Option<(R, R)>;
    /// Whether the wall has been passed at parameter `t`, and what of `exit` and its own parameter
    /// comes first beyond that.
    fn pass(&self, middle: Self::Middle, t: R, exit: R) -> (bool, R);
}
