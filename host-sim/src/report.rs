//! The report: what a run took, as JSON. Keys that do not apply are left out.

use std::collections::HashSet;

use kibiray::accel::octree::{AnyOctree, StoppedBy, Storage};
use kibiray::accel::tree::AnyTree;
use kibiray::accel::{Any, Bvh, Grid, Id, Octree};
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::probe::Counters;
use serde::Serialize;

use crate::costs::{BoundedReport, Costs};
use crate::structure::Structure;

/// Everything that is reported.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// What was traced.
    pub scene: SceneReport,
    /// The number type.
    pub num: &'static str,
    /// The structure.
    pub accel: AccelReport,
    /// The arena.
    pub memory: MemoryReport,
    /// How many rays there were.
    pub rays: RaysReport,
    /// What they had to do.
    pub work: WorkReport,
    /// How long it took.
    pub time: TimeReport,
    /// The picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageReport>,
}

/// What was traced.
#[derive(Clone, Debug, Serialize)]
pub struct SceneReport {
    /// As it was asked for.
    pub name: String,
    /// Primitives in the file.
    pub primitives: usize,
    /// Shapes that have no surface and were left out.
    pub skipped: usize,
    /// Bytes of the tables that would lie in flash.
    pub bytes: usize,
    /// Lights, including one that was put up because the file has none.
    pub lights: usize,
}

/// The structure.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AccelReport {
    /// Its name.
    pub kind: &'static str,
    /// Divided cells of an octree, nodes of a hierarchy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interior_nodes: Option<usize>,
    /// Leaves, or cells of a grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leaves: Option<usize>,
    /// Of these, how many list nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub empty_leaves: Option<usize>,
    /// Entries of all lists.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub references: Option<usize>,
    /// Shapes kept beside the structure; in no list.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aside: Option<usize>,
    /// Lists that differ from each other, the empty one not counted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distinct_lists: Option<usize>,
    /// Bytes that leaves or cells save by sharing lists; below 0 where the lengths of shared lists take
    /// more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shared_bytes: Option<isize>,
    /// Shapes in a leaf of a hierarchy, in the mean.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shapes_per_leaf: Option<f64>,
    /// Shapes in the largest leaf of a hierarchy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_leaf: Option<usize>,
    /// Level of the deepest leaf of an octree or a hierarchy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_level: Option<u32>,
    /// Tests of bounds and of shapes that a ray should take by the cost model of a tree of bounds, if
    /// it hits the root's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub predicted_bound_tests: Option<f64>,
    /// See [`Self::predicted_bound_tests`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub predicted_shape_tests: Option<f64>,
    /// Why an octree was not divided further.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_by: Option<&'static str>,
    /// Which shapes have bounds of their own, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounded: Option<Vec<BoundedReport>>,
    /// Cells of a grid along each axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<[u32; 3]>,
    /// The mailbox.
    pub mailbox: &'static str,
}

/// Leaves, empty ones, entries and distinct lists of some leaves.
fn lists<'l, I: Id + Eq + std::hash::Hash + 'l>(
    lists: impl Iterator<Item = &'l [I]>,
) -> (usize, usize, usize, usize) {
    let (mut leaves, mut empty, mut references) = (0, 0, 0);
    let mut distinct = HashSet::new();
    for list in lists {
        leaves += 1;
        references += list.len();
        if list.is_empty() {
            empty += 1;
        } else {
            distinct.insert(list);
        }
    }
    (leaves, empty, references, distinct.len())
}

impl AccelReport {
    /// Of a structure, looked at from outside.
    pub fn of<R: Real>(accel: &Structure<'_, R>, mailbox: &'static str, costs: &Costs) -> Self {
        let report = match accel {
            Structure::Planned(accel) => Self::planned(accel),
            Structure::Tree(tree) => Self::tree(tree),
            Structure::Sorted(list) => Self { kind: "sorted", ..Self::tree(list) },
            Structure::Bounded(it) => Self {
                kind: "bounded",
                bounded: Some(costs.report(it.ids().iter().map(|id| *id as usize))),
                ..Self::default()
            },
        };
        Self { mailbox, ..report }
    }

    fn planned<R: Real>(accel: &Any<'_, R>) -> Self {
        match accel {
            Any::Naive(_) | Any::Clipped(_) => Self { kind: "naive", ..Self::default() },
            Any::SmallGrid(grid) => Self::grid(grid),
            Any::Grid(grid) => Self::grid(grid),
            Any::LargeGrid(grid) => Self::grid(grid),
            Any::SmallShared(grid) => Self::shared_grid(grid),
            Any::Shared(grid) => Self::shared_grid(grid),
            Any::LargeShared(grid) => Self::shared_grid(grid),
            Any::Bvh(bvh) => Self::bvh(bvh),
            Any::LargeBvh(bvh) => Self::bvh(bvh),
            Any::Octree(octree) => match octree {
                AnyOctree::Implicit(octree, _) => Self::octree(octree),
                AnyOctree::Small(octree, _) => Self::octree(octree),
                AnyOctree::Medium(octree, _) => Self::octree(octree),
                AnyOctree::Large(octree, _) => Self::octree(octree),
                AnyOctree::Hashed(octree, _) => Self::octree(octree),
                AnyOctree::LargeHashed(octree, _) => Self::octree(octree),
            },
        }
    }

    fn tree<R: Real>(tree: &AnyTree<'_, R>) -> Self {
        let summary = tree.summary();
        Self {
            kind: "tree",
            interior_nodes: Some(summary.interior_nodes),
            leaves: Some(summary.shapes),
            references: Some(summary.shapes),
            shapes_per_leaf: Some(1.0),
            max_level: Some(summary.levels as u32),
            predicted_bound_tests: Some(summary.cost.bounds.to_f64()),
            predicted_shape_tests: Some(summary.cost.shapes.to_f64()),
            ..Self::default()
        }
    }

    fn shared_grid<R: Real, I: Id + Eq + std::hash::Hash, O: Id>(
        grid: &Grid<'_, R, I, O, true>,
    ) -> Self {
        Self { shared_bytes: Some(grid.shared_bytes()), ..Self::grid(grid) }
    }

    fn grid<R: Real, I: Id + Eq + std::hash::Hash, O: Id, const SHARED: bool>(
        grid: &Grid<'_, R, I, O, SHARED>,
    ) -> Self {
        let (leaves, empty, references, distinct) = lists(grid.lists());
        Self {
            kind: "grid",
            leaves: Some(leaves),
            empty_leaves: Some(empty),
            references: Some(references),
            aside: Some(grid.aside()),
            distinct_lists: Some(distinct),
            resolution: Some(grid.resolution()),
            ..Self::default()
        }
    }

    fn bvh<R: Real, I: Id>(bvh: &Bvh<'_, R, I>) -> Self {
        let lengths = || bvh.leaves().map(<[I]>::len);
        let (leaves, references) = (lengths().count(), lengths().sum::<usize>());
        Self {
            kind: "bvh",
            interior_nodes: Some(bvh.nodes()),
            leaves: Some(leaves),
            references: Some(references),
            shapes_per_leaf: Some(references as f64 / leaves.max(1) as f64),
            largest_leaf: Some(lengths().max().unwrap_or(0)),
            max_level: Some(bvh.levels() as u32),
            ..Self::default()
        }
    }

    fn octree<'m, R: Real, I: Id + Eq + std::hash::Hash, C: Storage<'m>>(
        octree: &Octree<'m, R, I, C>,
    ) -> Self {
        let (leaves, empty, references, distinct) = lists(octree.leaves());
        Self {
            kind: "octree",
            interior_nodes: Some(octree.interior_nodes()),
            leaves: Some(leaves),
            empty_leaves: Some(empty),
            references: Some(references),
            aside: Some(octree.aside()),
            distinct_lists: Some(distinct),
            shared_bytes: Some(octree.shared_bytes() as isize).filter(|bytes| *bytes > 0),
            max_level: Some(octree.max_level()),
            stopped_by: Some(match octree.stopped_by() {
                StoppedBy::Done => "done",
                StoppedBy::Level => "level",
                StoppedBy::Memory => "memory",
            }),
            ..Self::default()
        }
    }
}

/// The arena.
#[derive(Clone, Debug, Serialize)]
pub struct MemoryReport {
    /// Bytes it has.
    pub capacity_bytes: usize,
    /// Bytes that stay taken while tracing.
    pub used_bytes: usize,
    /// Most bytes taken at any moment.
    pub high_water_bytes: usize,
    /// What the used bytes are for.
    pub parts: Vec<PartReport>,
}

/// A part of the arena.
#[derive(Clone, Debug, Serialize)]
pub struct PartReport {
    /// What it is for.
    pub name: &'static str,
    /// How large it is.
    pub bytes: usize,
}

impl MemoryReport {
    /// Of an arena.
    pub fn of(arena: &Arena<'_>) -> Self {
        let part = |p: &kibiray::memory::Part| PartReport { name: p.name, bytes: p.bytes };
        Self {
            capacity_bytes: arena.capacity(),
            used_bytes: arena.used(),
            high_water_bytes: arena.high_water(),
            parts: arena.parts().iter().map(part).collect(),
        }
    }
}

/// How many rays of each kind, and how many of these hit something.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct RaysReport {
    /// Rays by kind; not there where rays have no kind.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub kinds: Option<KindsReport>,
    /// All rays.
    pub total: u64,
    /// All that hit something or were blocked.
    pub hits: u64,
}

/// Rays by kind.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct KindsReport {
    /// From the eye.
    pub primary: u64,
    /// Of these, how many hit something.
    pub primary_hits: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Of these, how many were blocked.
    pub shadow_hits: u64,
    /// Mirrored and refracted.
    pub secondary: u64,
    /// Of these, how many hit something.
    pub secondary_hits: u64,
}

impl RaysReport {
    /// Of what was counted.
    pub fn of(counters: &Counters) -> Self {
        let Counters { primary, shadow, secondary, .. } = counters;
        Self {
            kinds: Some(KindsReport {
                primary: primary.shot,
                primary_hits: primary.hit,
                shadow: shadow.shot,
                shadow_hits: shadow.hit,
                secondary: secondary.shot,
                secondary_hits: secondary.hit,
            }),
            total: primary.shot + shadow.shot + secondary.shot,
            hits: primary.hit + shadow.hit + secondary.hit,
        }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// What the rays had to do.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct WorkReport {
    /// Tests of a ray against a shape.
    pub primitive_tests: u64,
    /// Tests that a mailbox made unnecessary.
    pub mailbox_skips: u64,
    /// Lists skipped as a whole, which cells share.
    #[serde(skip_serializing_if = "is_zero")]
    pub list_skips: u64,
    /// Nodes or cells looked at.
    pub traversal_steps: u64,
    /// Leaves or cells entered.
    pub leaves_visited: u64,
    /// Of these, how many list nothing.
    pub empty_leaves_visited: u64,
}

impl WorkReport {
    /// Of what was counted.
    pub fn of(counters: &Counters) -> Self {
        Self {
            primitive_tests: counters.primitive_tests,
            mailbox_skips: counters.mailbox_skips,
            list_skips: counters.list_skips,
            traversal_steps: counters.steps,
            leaves_visited: counters.leaves,
            empty_leaves_visited: counters.empty_leaves,
        }
    }
}

/// How long it took, in seconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct TimeReport {
    /// Reading or generating the scene.
    pub load_s: f64,
    /// Planning, mailboxes and structure.
    pub build_s: f64,
    /// Its processor time.
    pub build_cpu_s: f64,
    /// The fastest pass.
    pub trace_s: f64,
    /// Its processor time, all threads together.
    pub trace_cpu_s: f64,
    /// Rays of a pass by [`Self::trace_s`].
    pub rays_per_s: f64,
}

/// The picture.
#[derive(Clone, Debug, Serialize)]
pub struct ImageReport {
    /// Pixels in a row.
    pub width: u16,
    /// Rows.
    pub height: u16,
    /// CRC-32 of the rows of 8-bit RGB from the top.
    pub crc32: String,
}
