//! From a scene and a number of bytes to a structure with its parameters, and the reason.

use crate::accel::{self, BuildError, Huge, Overlap, bvh, grid, mailbox, octree};
use crate::memory::OutOfArena;
use crate::num::Real;
use crate::scene::{Scene, Shapes};

/// A kind of structure, its parameters left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// [`accel::Naive`].
    Naive,
    /// [`accel::Grid`].
    Grid,
    /// [`accel::Octree`].
    Octree,
    /// [`accel::Bvh`].
    Bvh,
}

/// What is already decided; the plan fills in the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wishes {
    /// The structure.
    pub structure: Option<Structure>,
    /// The mailbox.
    pub mailbox: Option<mailbox::Kind>,
    /// Whether, without a structure, only rays that meet the box of the scene are tested at all.
    pub clipped: Option<bool>,
    /// Cells of a grid along each axis.
    pub resolution: Option<[u32; 3]>,
    /// An octree's limit of shapes per cell.
    pub max_objects: Option<usize>,
    /// An octree's limit of depth.
    pub max_level: Option<u32>,
    /// What grids and octrees do with shapes much larger than the others.
    pub huge: Option<Huge>,
    /// When a shape is listed in a cell of a grid or an octree.
    pub overlap: Option<Overlap>,
    /// Whether a grid's empty cells know how far it is to the next that is not.
    pub macro_cells: Option<bool>,
    /// Which cells of an octree are divided first.
    pub order: Option<octree::Order>,
    /// Whether a grid's cells or an octree's leaves with equal lists share one.
    pub shared: Option<bool>,
    /// How an octree's cells are stored.
    pub store: Option<octree::Store>,
    /// How an octree is walked.
    pub walk: Option<octree::Walk>,
}

impl Wishes {
    fn huge(&self) -> Huge {
        self.huge.unwrap_or(Huge::Aside)
    }

    fn overlap(&self) -> Overlap {
        self.overlap.unwrap_or(Overlap::Exact)
    }

    fn grid(&self, resolution: [u32; 3]) -> grid::Settings<Overlap> {
        let macro_cells = self.macro_cells.unwrap_or(true);
        let (huge, overlap) = (self.huge(), self.overlap());
        let shared = self.shared.unwrap_or(false);
        grid::Settings { resolution, huge, overlap, macro_cells, shared }
    }

    /// An octree that takes what memory it can use.
    fn octree(&self) -> octree::Settings {
        let limits = octree::Limits {
            max_objects: self.max_objects.unwrap_or(MAX_OBJECTS),
            max_level: self.max_level.unwrap_or(octree::DEEPEST),
        };
        octree::Settings {
            growth: octree::Growth {
                limits,
                huge: self.huge(),
                lists: octree::Lists {
                    overlap: self.overlap(),
                    shared: self.shared.unwrap_or(false),
                },
                order: self.order.unwrap_or_default(),
            },
            store: self.store.unwrap_or_default(),
            walk: self.walk.unwrap_or_default(),
        }
    }

    /// Whether a parameter is given that only an octree has.
    fn asks_for_octree(&self) -> bool {
        self.max_objects.is_some()
            || self.max_level.is_some()
            || self.order.is_some()
            || self.shared.is_some()
            || self.store.is_some()
            || self.walk.is_some()
    }
}

/// Why a plan is what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// It was asked for.
    Asked,
    /// So few shapes are tested faster than a structure is walked.
    FewShapes {
        /// How many there are.
        shapes: usize,
    },
    /// Not even the smallest structure fits.
    NoMemory {
        /// Bytes that the smallest one takes.
        needed: usize,
        /// Bytes there are.
        available: usize,
    },
    /// A hierarchy does not fit, but a grid does.
    LittleMemory {
        /// Bytes that the smallest hierarchy takes.
        needed: usize,
        /// Bytes there are.
        available: usize,
    },
    /// Shapes of much the same size everywhere, or so large that they lie in each other: a grid.
    EvenOrLargeShapes {
        /// How many there are.
        shapes: usize,
    },
    /// A hierarchy that takes what memory it can use.
    ManyShapes {
        /// How many there are.
        shapes: usize,
    },
}

impl core::fmt::Display for Reason {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Asked => f.write_str("as asked for"),
            Self::FewShapes { shapes } => {
                write!(f, "{shapes} shapes: testing all is cheaper than any structure")
            }
            Self::NoMemory { needed, available } => {
                write!(f, "the smallest structure takes {needed} bytes of {available}")
            }
            Self::LittleMemory { needed, available } => {
                write!(
                    f,
                    "the smallest hierarchy takes {needed} bytes of {available}: a coarse grid"
                )
            }
            Self::EvenOrLargeShapes { shapes } => {
                write!(f, "{shapes} shapes, spread evenly or lying in each other: a grid")
            }
            Self::ManyShapes { shapes } => {
                write!(f, "{shapes} shapes: a hierarchy as fine as the memory allows")
            }
        }
    }
}

/// A structure and a mailbox, decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The structure with its parameters.
    pub accel: accel::Kind,
    /// The mailbox.
    pub mailbox: mailbox::Kind,
    /// Why this structure.
    pub reason: Reason,
}

/// Up to this many shapes are tested one by one.
const FEW: usize = 4;

/// Shapes in a cell of an octree that is not divided further. More than meet at most corners of a
/// mesh: a cell around a corner lists all of them however small it is.
const MAX_OBJECTS: usize = 8;

/// Decides on a structure for a scene and a number of bytes.
///
/// # Errors
/// [`BuildError::Memory`] when what was wished for cannot fit: an empty arena of exactly the bytes
/// that it names, starting at a multiple of 8, holds the plan. Without wishes there is always a plan, even for 0 bytes.
pub fn plan<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    budget: usize,
    wishes: &Wishes,
) -> Result<Plan, BuildError> {
    let shapes = scene.shapes().bounded();
    let (structure, reason) = match wishes.structure {
        Some(structure) => (structure, Reason::Asked),
        None if wishes.resolution.is_some() => (Structure::Grid, Reason::Asked),
        None if wishes.asks_for_octree() => (Structure::Octree, Reason::Asked),
        None => choose(scene, shapes, budget, wishes),
    };
    let mailbox = match (wishes.mailbox, structure) {
        (Some(mailbox), _) => mailbox,
        // They test no shape twice anyway.
        (None, Structure::Naive | Structure::Bvh) => mailbox::Kind::Off,
        (None, _) => mailbox_for(shapes, budget),
    };
    let plan = |mailbox| fit(scene, budget, wishes, structure, mailbox);
    let (accel, mailbox) = match plan(mailbox) {
        // Better no mailbox than no structure.
        Err(BuildError::Memory(_)) if wishes.mailbox.is_none() => {
            (plan(mailbox::Kind::Off)?, mailbox::Kind::Off)
        }
        accel => (accel?, mailbox),
    };
    Ok(Plan { accel, mailbox, reason })
}

/// The parameters of a structure beside a mailbox.
fn fit<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    budget: usize,
    wishes: &Wishes,
    structure: Structure,
    mailbox: mailbox::Kind,
) -> Result<accel::Kind, BuildError> {
    let taken = mailbox.footprint(scene.shapes().bounded());
    let accel = match structure {
        Structure::Naive => {
            // Up to a few shapes, the box would cost as much as they do.
            let pays = wishes.structure.is_none() && scene.shapes().bounded() > FEW;
            if wishes.clipped.unwrap_or(pays) { accel::Kind::Clipped } else { accel::Kind::Naive }
        }
        Structure::Grid => accel::Kind::Grid(match wishes.resolution {
            Some(resolution) => wishes.grid(resolution),
            None => grid_for(scene, wishes, budget.saturating_sub(taken.kept)),
        }),
        Structure::Octree => accel::Kind::Octree(wishes.octree()),
        Structure::Bvh => {
            let shapes = scene.shapes().bounded();
            let room = budget.saturating_sub(taken.kept);
            accel::Kind::Bvh(if shapes <= <u16 as accel::Id>::MAX {
                bvh::nodes_within::<u16>(shapes, room)
            } else {
                bvh::nodes_within::<u32>(shapes, room)
            })
        }
    };
    let needed = taken.then(accel::Any::least(accel, scene)).peak;
    if needed > budget {
        return Err(OutOfArena { needed, available: budget }.into());
    }
    Ok(accel)
}

/// A structure for a scene without wishes.
fn choose<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    shapes: usize,
    budget: usize,
    wishes: &Wishes,
) -> (Structure, Reason) {
    if shapes <= FEW {
        return (Structure::Naive, Reason::FewShapes { shapes });
    }
    let mailbox = wishes.mailbox.unwrap_or(mailbox::Kind::Off).footprint(shapes);
    let needed = mailbox.then(accel::Any::least(accel::Kind::Bvh(0), scene)).peak;
    if needed <= budget {
        let mailbox = wishes.mailbox.unwrap_or(mailbox_for(shapes, budget)).footprint(shapes);
        let room = budget.saturating_sub(mailbox.kept);
        // In fewer cells a grid is no match for a hierarchy.
        if let Some(cells) = grid::suits(scene, wishes.huge()) {
            let resolution = grid_for(scene, wishes, room).resolution;
            let there_are = resolution.iter().map(|n| *n as usize).product::<usize>();
            if there_are / shapes >= cells {
                return (Structure::Grid, Reason::EvenOrLargeShapes { shapes });
            }
        }
        return (Structure::Bvh, Reason::ManyShapes { shapes });
    }
    let cell = accel::Kind::Grid(wishes.grid([1; 3]));
    let coarse = mailbox.then(accel::Any::least(cell, scene)).peak;
    if coarse <= budget {
        (Structure::Grid, Reason::LittleMemory { needed, available: budget })
    } else {
        (Structure::Naive, Reason::NoMemory { needed: coarse, available: budget })
    }
}

/// Stamps where they take no more than an eighth of the memory, otherwise the table of constant
/// size, where that takes no more.
fn mailbox_for(shapes: usize, budget: usize) -> mailbox::Kind {
    let affordable = |kind: &mailbox::Kind| kind.footprint(shapes).kept <= budget / 8;
    [mailbox::Kind::Stamps, mailbox::Kind::Cache]
        .into_iter()
        .find(affordable)
        .unwrap_or(mailbox::Kind::Off)
}

/// The finest grid, of at most eight cells a shape, that fits.
fn grid_for<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    wishes: &Wishes,
    room: usize,
) -> grid::Settings<Overlap> {
    // A cell takes two bytes at least.
    let mut cells = scene.shapes().bounded().saturating_mul(8).min(room / 2).max(1);
    loop {
        let settings = wishes.grid(grid::resolution_for(scene, wishes.huge(), cells));
        let footprint = accel::Any::least(accel::Kind::Grid(settings), scene);
        if footprint.peak <= room || cells == 1 {
            return settings;
        }
        cells = cells / 2 + cells / 4;
    }
}
