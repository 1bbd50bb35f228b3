//! A tree whose bound is chosen while the program runs.

use super::links::Links;
use super::{Cost, Settings, Tree, footprint};
use crate::accel::{Accel, BuildError, Visitor};
use crate::bound::{KDop, OrientedBox, Stored};
use crate::geom::{Aabb, Ray};
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::probe::Probe;
use crate::scene::{Scene, Shapes};
use crate::shape::Sphere;
use core::ops::Range;

/// The kinds of bounds that a tree can consist of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// [`Aabb`].
    #[default]
    Box,
    /// [`Sphere`].
    Sphere,
    /// [`OrientedBox`].
    Oriented,
    /// [`KDop`] of 14 planes.
    KDop14,
    /// Of 18 planes.
    KDop18,
    /// Of 26 planes.
    KDop26,
}

impl Kind {
    /// All of them. A k-dop of 6 planes is the box.
    pub const ALL: [Self; 6] =
        [Self::Box, Self::Sphere, Self::Oriented, Self::KDop14, Self::KDop18, Self::KDop26];
}

/// A tree with the smallest numbers that suffice.
#[derive(Debug)]
pub enum Widths<'m, R: Real, B: Stored<R>> {
    /// Of up to 16,384 shapes.
    Small(Tree<'m, R, B, u16>),
    /// Of more.
    Large(Tree<'m, R, B, u32>),
}

impl<'m, R: Real, B: Stored<R>> Widths<'m, R, B> {
    fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        settings: Settings,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        Ok(if is_small(scene.shapes().bounded()) {
            Self::Small(Tree::build(scene, settings, arena)?)
        } else {
            Self::Large(Tree::build(scene, settings, arena)?)
        })
    }

    fn footprint(shapes: usize, settings: Settings) -> Footprint {
        if is_small(shapes) {
            footprint::<R, B, u16>(shapes, settings.builder)
        } else {
            footprint::<R, B, u32>(shapes, settings.builder)
        }
    }

    fn walk(&self, ray: &Ray<R>, visitor: &mut Erased<'_, R>) {
        match self {
            Self::Small(tree) => tree.walk(ray, visitor),
            Self::Large(tree) => tree.walk(ray, visitor),
        }
    }

    fn keep_paying(&mut self, pays: impl FnMut(usize, R) -> bool) -> usize {
        match self {
            Self::Small(tree) => tree.keep_paying(pays),
            Self::Large(tree) => tree.keep_paying(pays),
        }
    }

    fn refit<S: Shapes<R>>(&mut self, scene: &Scene<'_, R, S>) {
        match self {
            Self::Small(tree) => tree.refit(scene),
            Self::Large(tree) => tree.refit(scene),
        }
    }

    fn summary(&self) -> Summary<R> {
        match self {
            Self::Small(tree) => tree.summary(),
            Self::Large(tree) => tree.summary(),
        }
    }
}

fn is_small(shapes: usize) -> bool {
    shapes <= Links::<u16>::MOST_SHAPES
}

/// A tree of one kind of bounds or another. Programs that know which one they want name it, and the
/// others are not linked.
#[derive(Debug)]
pub enum AnyTree<'m, R: Real> {
    /// Of boxes.
    Box(Widths<'m, R, Aabb<R>>),
    /// Of spheres.
    Sphere(Widths<'m, R, Sphere<R>>),
    /// Of oriented boxes.
    Oriented(Widths<'m, R, OrientedBox<R>>),
    /// Of k-dops of 14 planes.
    KDop14(Widths<'m, R, KDop<R, 7>>),
    /// Of k-dops of 18 planes.
    KDop18(Widths<'m, R, KDop<R, 9>>),
    /// Of k-dops of 26 planes.
    KDop26(Widths<'m, R, KDop<R, 13>>),
}

/// What a tree has come to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary<R> {
    /// See [`Tree::shapes`].
    pub shapes: usize,
    /// See [`Tree::interior_nodes`].
    pub interior_nodes: usize,
    /// See [`Tree::levels`].
    pub levels: usize,
    /// See [`Tree::cost`].
    pub cost: Cost<R>,
}

impl<'m, R: Real> AnyTree<'m, R> {
    /// As [`Tree::build`].
    ///
    /// # Errors
    /// Those of [`Tree::build`].
    pub fn build<S: Shapes<R>>(
        kind: Kind,
        scene: &Scene<'_, R, S>,
        settings: Settings,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        Ok(match kind {
            Kind::Box => Self::Box(Widths::build(scene, settings, arena)?),
            Kind::Sphere => Self::Sphere(Widths::build(scene, settings, arena)?),
            Kind::Oriented => Self::Oriented(Widths::build(scene, settings, arena)?),
            Kind::KDop14 => Self::KDop14(Widths::build(scene, settings, arena)?),
            Kind::KDop18 => Self::KDop18(Widths::build(scene, settings, arena)?),
            Kind::KDop26 => Self::KDop26(Widths::build(scene, settings, arena)?),
        })
    }

    /// The bytes that [`AnyTree::build`] takes.
    pub fn footprint(kind: Kind, shapes: usize, settings: Settings) -> Footprint {
        match kind {
            Kind::Box => Widths::<R, Aabb<R>>::footprint(shapes, settings),
            Kind::Sphere => Widths::<R, Sphere<R>>::footprint(shapes, settings),
            Kind::Oriented => Widths::<R, OrientedBox<R>>::footprint(shapes, settings),
            Kind::KDop14 => Widths::<R, KDop<R, 7>>::footprint(shapes, settings),
            Kind::KDop18 => Widths::<R, KDop<R, 9>>::footprint(shapes, settings),
            Kind::KDop26 => Widths::<R, KDop<R, 13>>::footprint(shapes, settings),
        }
    }

    /// As [`Tree::keep_paying`].
    pub fn keep_paying(&mut self, pays: impl FnMut(usize, R) -> bool) -> usize {
        match self {
            Self::Box(tree) => tree.keep_paying(pays),
            Self::Sphere(tree) => tree.keep_paying(pays),
            Self::Oriented(tree) => tree.keep_paying(pays),
            Self::KDop14(tree) => tree.keep_paying(pays),
            Self::KDop18(tree) => tree.keep_paying(pays),
            Self::KDop26(tree) => tree.keep_paying(pays),
        }
    }

    /// As [`Tree::refit`].
    pub fn refit<S: Shapes<R>>(&mut self, scene: &Scene<'_, R, S>) {
        match self {
            Self::Box(tree) => tree.refit(scene),
            Self::Sphere(tree) => tree.refit(scene),
            Self::Oriented(tree) => tree.refit(scene),
            Self::KDop14(tree) => tree.refit(scene),
            Self::KDop18(tree) => tree.refit(scene),
            Self::KDop26(tree) => tree.refit(scene),
        }
    }

    /// What it has come to.
    pub fn summary(&self) -> Summary<R> {
        match self {
            Self::Box(tree) => tree.summary(),
            Self::Sphere(tree) => tree.summary(),
            Self::Oriented(tree) => tree.summary(),
            Self::KDop14(tree) => tree.summary(),
            Self::KDop18(tree) => tree.summary(),
            Self::KDop26(tree) => tree.summary(),
        }
    }
}

impl<R: Real> Accel<R> for AnyTree<'_, R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let visitor = &mut Erased(visitor);
        match self {
            Self::Box(tree) => tree.walk(ray, visitor),
            Self::Sphere(tree) => tree.walk(ray, visitor),
            Self::Oriented(tree) => tree.walk(ray, visitor),
            Self::KDop14(tree) => tree.walk(ray, visitor),
            Self::KDop18(tree) => tree.walk(ray, visitor),
            Self::KDop26(tree) => tree.walk(ray, visitor),
        }
    }
}

/// A visitor as a tree sees it, whatever it looks for and however it counts: so there is one walk for
/// every kind of tree, and not one for every kind of query besides.
trait Seeker<R> {
    fn from(&self) -> R;
    fn to(&self) -> R;
    fn meet(&mut self, id: usize);
    fn meet_range(&mut self, ids: Range<usize>);
    fn count_step(&mut self);
    fn count_leaf(&mut self, empty: bool);
}

impl<R: Real, V: Visitor<R>> Seeker<R> for V {
    fn from(&self) -> R {
        self.start()
    }
    fn to(&self) -> R {
        self.limit()
    }
    fn meet(&mut self, id: usize) {
        self.visit(core::iter::once(id));
    }
    fn meet_range(&mut self, ids: Range<usize>) {
        self.visit_range(ids);
    }
    fn count_step(&mut self) {
        self.probe().step();
    }
    fn count_leaf(&mut self, empty: bool) {
        self.probe().leaf(empty);
    }
}

struct Erased<'v, R>(&'v mut dyn Seeker<R>);

impl<R> Probe for Erased<'_, R> {
    fn step(&mut self) {
        self.0.count_step();
    }
    fn leaf(&mut self, empty: bool) {
        self.0.count_leaf(empty);
    }
}

impl<R: Real> Visitor<R> for Erased<'_, R> {
    type Probe = Self;

    fn start(&self) -> R {
        self.0.from()
    }
    fn limit(&self) -> R {
        self.0.to()
    }
    fn visit(&mut self, ids: impl Iterator<Item = usize>) {
        ids.for_each(|id| self.0.meet(id));
    }
    fn visit_range(&mut self, ids: Range<usize>) {
        self.0.meet_range(ids);
    }
    fn probe(&mut self) -> &mut Self {
        self
    }
}
