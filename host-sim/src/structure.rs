//! Any structure that `--accel` names.

use kibiray::accel::tree::{self, AnyTree};
use kibiray::accel::{Accel, Any, Bounded, BuildError, Kind, Visitor};
use kibiray::geom::Ray;
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Scene, Shapes};
use kibiray::shape::Sphere;

use crate::costs::Costs;
use crate::options::{AccelKind, BoundKind, BuilderKind, Common, InsertionKind, Walk};

/// A structure of the core, or one that its plan does not choose.
#[derive(Debug)]
pub enum Structure<'m, R: Real> {
    /// What the plan can choose.
    Planned(Any<'m, R>),
    /// A tree of bounds.
    Tree(AnyTree<'m, R>),
    /// A list of bounds.
    Sorted(AnyTree<'m, R>),
    /// No structure but spheres around those shapes for which they pay.
    Bounded(Bounded<'m, R, Sphere<R>, u32>),
}

impl<'m, R: Real> Structure<'m, R> {
    /// Builds what the options name; `planned` where they leave it to the plan.
    ///
    /// # Errors
    /// Those of the structure.
    pub fn build<S: Shapes<R>>(
        options: &Common,
        planned: Kind,
        scene: &Scene<'_, R, S>,
        costs: &Costs,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        Ok(match options.accel {
            AccelKind::Tree => {
                let (bound, settings) = (bound(options), tree_settings(options));
                let mut tree = AnyTree::build(bound, scene, settings, arena)?;
                if let Some(most) = options.leaf_bounds {
                    tree.keep_paying(|_, probability: R| probability.to_f64() <= most);
                }
                Self::Tree(tree)
            }
            AccelKind::Sorted => {
                let settings =
                    tree::Settings { builder: tree::Builder::List, ..Default::default() };
                Self::Sorted(AnyTree::build(bound(options), scene, settings, arena)?)
            }
            AccelKind::Bounded => {
                let pays = |id, probability: R| costs.pays(id, probability.to_f64());
                Self::Bounded(Bounded::build(scene, pays, arena)?)
            }
            _ => Self::Planned(Any::build(planned, scene, arena)?),
        })
    }
}

/// The kind of bounds that options ask for.
pub fn bound(options: &Common) -> tree::Kind {
    match options.bound.unwrap_or(BoundKind::Box) {
        BoundKind::Sphere => tree::Kind::Sphere,
        BoundKind::Box | BoundKind::Kdop6 => tree::Kind::Box,
        BoundKind::Obox => tree::Kind::Oriented,
        BoundKind::Kdop14 => tree::Kind::KDop14,
        BoundKind::Kdop18 => tree::Kind::KDop18,
        BoundKind::Kdop26 => tree::Kind::KDop26,
    }
}

/// The tree that options ask for.
pub fn tree_settings(options: &Common) -> tree::Settings {
    let insertion = match options.insertion.unwrap_or(InsertionKind::Shuffled) {
        InsertionKind::File => tree::Insertion::File,
        InsertionKind::Shuffled => tree::Insertion::Shuffled(options.seed.unwrap_or(0)),
        InsertionKind::Curve => tree::Insertion::Curve,
    };
    let builder = match options.builder.unwrap_or(BuilderKind::Gs) {
        BuilderKind::Gs => tree::Builder::GoldsmithSalmon(insertion),
        BuilderKind::Rtree => tree::Builder::RTree(insertion),
        BuilderKind::Sah => tree::Builder::Sah,
    };
    let walk = match options.walk {
        Some(Walk::Heap) => tree::Walk::Heap,
        Some(Walk::Stored) => tree::Walk::Stored,
        _ => tree::Walk::Ordered,
    };
    tree::Settings { builder, walk }
}

impl<R: Real> Accel<R> for Structure<'_, R> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        match self {
            Self::Planned(accel) => accel.walk(ray, visitor),
            Self::Tree(tree) | Self::Sorted(tree) => tree.walk(ray, visitor),
            Self::Bounded(bounded) => bounded.walk(ray, visitor),
        }
    }
}
