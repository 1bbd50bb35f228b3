//! An octree whose storage and walk are chosen while the program runs.

use super::{Growth, Hashed, Implicit, Limits, Links, Lists, Octree, StoppedBy, Walk};
use crate::accel::listing::Aside;
use crate::accel::{Accel, BuildError, Id, Visitor};
use crate::geom::Ray;
use crate::memory::{Arena, Footprint};
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// How cells are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Store {
    /// [`Links`].
    #[default]
    Links,
    /// [`Hashed`].
    Hashed,
    /// [`Implicit`] for up to 65,535 shapes and 32,767 list entries, and breadth-first; beyond that,
    /// [`Links`].
    Implicit,
}

/// All that is chosen about an octree while the program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// How it grows.
    pub growth: Growth<Lists>,
    /// How cells are stored.
    pub store: Store,
    /// How a ray gets from leaf to leaf.
    pub walk: Walk,
}

impl From<Limits> for Settings {
    fn from(limits: Limits) -> Self {
        Self { growth: Growth::new(limits), store: Store::default(), walk: Walk::default() }
    }
}

/// One of the octrees, with the smallest numbers that suffice. Programs that know which one they
/// want name it, and the others are not linked.
#[derive(Debug)]
pub enum AnyOctree<'m, R: Real> {
    /// Up to 65,535 shapes and 32,767 list entries.
    Small(Octree<'m, R, u16>, Walk),
    /// Up to 65,535 shapes.
    Medium(Octree<'m, R, u16, Links<'m, u32>>, Walk),
    /// More shapes.
    Large(Octree<'m, R, u32, Links<'m, u32>>, Walk),
    /// In order, up to 65,535 shapes and 32,767 list entries.
    Implicit(Octree<'m, R, u16, Implicit<'m>>, Walk),
    /// In a hash table, up to 65,535 shapes.
    Hashed(Octree<'m, R, u16, Hashed<'m>>, Walk),
    /// In a hash table, more shapes.
    LargeHashed(Octree<'m, R, u32, Hashed<'m>>, Walk),
}

impl<'m, R: Real> AnyOctree<'m, R> {
    /// Builds an octree.
    ///
    /// # Errors
    /// As [`Octree::build`].
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        Settings { growth, store, walk }: Settings,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let narrow = scene.shapes().bounded() <= <u16 as Id>::MAX;
        Ok(match store {
            Store::Links if narrow => match Octree::build_in_words(scene, growth, arena, false) {
                Err(BuildError::TooMany { .. }) => {
                    Self::Medium(Octree::build(scene, growth, arena)?, walk)
                }
                octree => Self::Small(octree?, walk),
            },
            Store::Implicit if narrow => {
                match Octree::build_in_words(scene, growth, arena, false) {
                    Err(BuildError::TooMany { .. }) => {
                        Self::Medium(Octree::build(scene, growth, arena)?, walk)
                    }
                    octree => Self::Implicit(octree?, walk),
                }
            }
            Store::Links | Store::Implicit => {
                Self::Large(Octree::build(scene, growth, arena)?, walk)
            }
            Store::Hashed if narrow => Self::Hashed(Octree::build(scene, growth, arena)?, walk),
            Store::Hashed => Self::LargeHashed(Octree::build(scene, growth, arena)?, walk),
        })
    }

    /// As [`Octree::footprint`].
    ///
    /// # Errors
    /// As [`Octree::footprint`], but never for words that are too narrow.
    pub fn footprint<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        Settings { growth, store, .. }: Settings,
    ) -> Result<Footprint, BuildError> {
        let narrow = scene.shapes().bounded() <= <u16 as Id>::MAX;
        match store {
            Store::Links if narrow => match Octree::<R, u16>::footprint(scene, growth) {
                Err(BuildError::TooMany { .. }) => {
                    Octree::<R, u16, Links<'_, u32>>::footprint(scene, growth)
                }
                footprint => footprint,
            },
            Store::Implicit if narrow => {
                match Octree::<R, u16, Implicit<'_>>::footprint(scene, growth) {
                    Err(BuildError::TooMany { .. }) => {
                        Octree::<R, u16, Links<'_, u32>>::footprint(scene, growth)
                    }
                    footprint => footprint,
                }
            }
            Store::Links | Store::Implicit => {
                Octree::<R, u32, Links<'_, u32>>::footprint(scene, growth)
            }
            Store::Hashed if narrow => Octree::<R, u16, Hashed<'_>>::footprint(scene, growth),
            Store::Hashed => Octree::<R, u32, Hashed<'_>>::footprint(scene, growth),
        }
    }

    /// The fewest bytes that [`AnyOctree::build`] takes: those of a single cell. Links no code that
    /// divides cells.
    pub fn least<S: Shapes<R>>(scene: &Scene<'_, R, S>, settings: Settings) -> Footprint {
        let (aside, _) = Aside::of(scene, settings.growth.huge);
        let listed = scene.shapes().bounded() - aside.count();
        // A list begins with its length.
        let entries = listed.saturating_add(usize::from(listed > 0));
        if scene.shapes().bounded() <= <u16 as Id>::MAX {
            Footprint::of::<u16>(entries)
        } else {
            Footprint::of::<u32>(entries)
        }
    }

    /// Why the division ended.
    pub fn stopped_by(&self) -> StoppedBy {
        match self {
            Self::Small(octree, _) => octree.stopped_by(),
            Self::Medium(octree, _) => octree.stopped_by(),
            Self::Large(octree, _) => octree.stopped_by(),
            Self::Implicit(octree, _) => octree.stopped_by(),
            Self::Hashed(octree, _) => octree.stopped_by(),
            Self::LargeHashed(octree, _) => octree.stopped_by(),
        }
    }
}

impl<R: Real> Accel<R> for AnyOctree<'_, R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        match self {
            Self::Small(octree, walk) => octree.by(*walk).walk(ray, visitor),
            Self::Medium(octree, walk) => octree.by(*walk).walk(ray, visitor),
            Self::Large(octree, walk) => octree.by(*walk).walk(ray, visitor),
            Self::Implicit(octree, walk) => octree.by(*walk).walk(ray, visitor),
            Self::Hashed(octree, walk) => octree.by(*walk).walk(ray, visitor),
            Self::LargeHashed(octree, walk) => octree.by(*walk).walk(ray, visitor),
        }
    }
}
