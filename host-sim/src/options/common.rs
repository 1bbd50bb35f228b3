//! What all commands that trace have in common.

use clap::Args;
use kibiray::accel::octree;
use kibiray::num::Real;
use kibiray::trace::{Secondary, Settings, Skips};
use std::path::PathBuf;

use super::{
    AccelKind, BoundKind, BuilderKind, Growth, Huge, InsertionKind, ListKind, MailboxKind, Number,
    Overlap, Skip, Store, Switch, Walk,
};
use crate::values;

/// What render, stats and trace share.
#[derive(Clone, Debug, Args)]
pub struct Common {
    /// The acceleration structure; `auto`: what the plan finds best
    #[arg(long, value_enum, default_value_t = AccelKind::Auto)]
    pub accel: AccelKind,
    /// The numbers to compute in
    #[arg(long, value_enum, default_value_t = Number::F32)]
    pub num: Number,
    /// Memory of which shapes a ray has been tested against: none, a stamp a shape, or a table of
    /// constant size
    #[arg(long, value_enum, default_value_t = MailboxKind::Auto)]
    pub mailbox: MailboxKind,
    /// Cells of a grid [default: by the plan]
    #[arg(long, value_name = "NXxNYxNZ", value_parser = values::resolution)]
    pub grid: Option<[u32; 3]>,
    /// Octree: a cell with more objects than this is divided [default: by the plan]
    #[arg(long, value_name = "M")]
    pub max_objects: Option<usize>,
    /// Octree: no cell is deeper than this; the root is level 0 [default: by the plan]
    #[arg(long, value_name = "K")]
    #[arg(value_parser = clap::value_parser!(u32).range(0..=i64::from(octree::DEEPEST)))]
    pub max_level: Option<u32>,
    /// Grid and octree: shapes much larger than the others are listed like these, or kept beside the
    /// structure [default: aside; inside for stats with a fixed resolution or limit, as the
    /// published counts are made so]
    #[arg(long, value_enum, value_name = "KIND")]
    pub huge: Option<Huge>,
    /// Grid: empty cells know how far it is to the next that is not [default: on; off for stats with
    /// a fixed resolution, as the published counts are made so]
    #[arg(long, value_enum, value_name = "SWITCH")]
    pub macro_cells: Option<Switch>,
    /// Octree: which cells are divided first, while memory lasts [default: fifo]
    #[arg(long, value_enum, value_name = "ORDER")]
    pub growth: Option<Growth>,
    /// Grid and octree: whether cells with equal lists share one, which a ray is tested against once
    /// [default: own]
    #[arg(long, value_enum, value_name = "KIND")]
    pub lists: Option<ListKind>,
    /// Octree: how its cells are stored [default: links]
    #[arg(long, value_enum, value_name = "KIND")]
    pub store: Option<Store>,
    /// Octree: how a ray gets from leaf to leaf [default: descent; restart for stats with
    /// --max-objects or --max-level, as the published counts are made so]. Tree: which node comes
    /// next [default: ordered]
    #[arg(long, value_enum, value_name = "KIND")]
    pub walk: Option<Walk>,
    /// Tree: what bounds shapes and nodes [default: box]
    #[arg(long, value_enum, value_name = "KIND")]
    pub bound: Option<BoundKind>,
    /// Tree: a shape has a bound of its own only if at most this share of the rays that hit the one
    /// above hit it, by surfaces: B + pI < I says 1 - B/I [default: 1]
    #[arg(long, value_name = "P", value_parser = values::share)]
    pub leaf_bounds: Option<f64>,
    /// Tree: how it comes about [default: gs]
    #[arg(long, value_enum, value_name = "KIND")]
    pub builder: Option<BuilderKind>,
    /// Tree: in which order shapes are inserted [default: shuffled]
    #[arg(long, value_enum, value_name = "ORDER")]
    pub insertion: Option<InsertionKind>,
    /// Tree: which of all ways to shuffle [default: 0]
    #[arg(long, value_name = "N")]
    pub seed: Option<u32>,
    /// Grid and octree: when a shape belongs to a cell [default: by the plan; box for stats]
    #[arg(long, value_enum)]
    pub overlap: Option<Overlap>,
    /// Do in spite of everything what is skipped otherwise, to see what that gains
    #[arg(long, value_enum, value_name = "WORK", value_delimiter = ',')]
    pub no_skip: Vec<Skip>,
    /// Also write the report as JSON; `-`: standard output
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Threads of the host; each has its own mailbox, all within --ram
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: u16,
    /// Trace everything so many times and report the fastest time
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,
}

impl Common {
    /// Options that were given but mean nothing together, or are not there yet.
    ///
    /// # Errors
    /// One line for the user.
    pub fn check(&self) -> Result<(), String> {
        let grid = self.grid.is_some() || self.macro_cells.is_some();
        let octree = self.max_objects.is_some()
            || self.max_level.is_some()
            || self.growth.is_some()
            || self.store.is_some()
            || self.walk.is_some_and(|walk| !walk.is_of_tree());
        let lists = self.lists.is_some();
        let tree = self.builder.is_some()
            || self.insertion.is_some()
            || self.seed.is_some()
            || self.leaf_bounds.is_some()
            || self.walk.is_some_and(Walk::is_of_tree);
        if grid && octree {
            return Err("--grid and --macro-cells are for grids, --max-objects, --max-level, --store and --walk are for octrees".into());
        }
        if grid && !matches!(self.accel, AccelKind::Auto | AccelKind::Grid) {
            return Err("--grid and --macro-cells are only for --accel grid".into());
        }
        if octree && !matches!(self.accel, AccelKind::Auto | AccelKind::Octree) {
            return Err(
                "--max-objects, --max-level, --store and --walk are only for --accel octree".into(),
            );
        }
        if lists && !matches!(self.accel, AccelKind::Auto | AccelKind::Grid | AccelKind::Octree) {
            return Err("--lists is only for --accel grid and octree".into());
        }
        if self.bound.is_some() && !matches!(self.accel, AccelKind::Tree | AccelKind::Sorted) {
            return Err("--bound is only for --accel tree and sorted".into());
        }
        if tree && self.accel != AccelKind::Tree {
            return Err("--builder, --insertion, --seed, --leaf-bounds and --walk ordered, heap or stored are only for --accel tree".into());
        }
        if self.seed.is_some() && self.insertion.is_some_and(|it| it != InsertionKind::Shuffled) {
            return Err("--seed is only for --insertion shuffled".into());
        }
        Ok(())
    }

    /// Whether rays remember lists that leaves share.
    pub fn shares_lists(&self) -> bool {
        self.lists == Some(ListKind::Shared) && !self.does(Skip::Lists)
    }

    /// Whether that is done which is skipped otherwise.
    pub fn does(&self, skip: Skip) -> bool {
        self.no_skip.contains(&skip)
    }

    /// What `--no-skip` says of how rays are followed.
    pub fn settings<R: Real>(&self) -> Settings<R> {
        Settings {
            secondary: if self.does(Skip::Contribution) {
                Secondary::All
            } else {
                Secondary::Contributing
            },
            shadow_cache: !self.does(Skip::Occluder),
            skips: Skips {
                shadows: !self.does(Skip::Shadows),
                mirrors: !self.does(Skip::Mirrors),
                facing: !self.does(Skip::Facing),
            },
            ..Settings::default()
        }
    }

    /// What `--no-skip` says of structures, where nothing else does.
    #[must_use]
    pub fn without_skips(mut self) -> Self {
        for skip in self.no_skip.clone() {
            match skip {
                Skip::Empty => drop(self.macro_cells.get_or_insert(Switch::Off)),
                Skip::Cells => drop(self.overlap.get_or_insert(Overlap::Box)),
                Skip::Huge => drop(self.huge.get_or_insert(Huge::Inside)),
                Skip::Tested if self.mailbox == MailboxKind::Auto => {
                    self.mailbox = MailboxKind::Off;
                }
                _ => {}
            }
        }
        self
    }

    /// With the parameters of a structure fixed, what is not given is as in the published counts.
    #[must_use]
    pub fn as_published(mut self) -> Self {
        let octree = self.max_objects.is_some() || self.max_level.is_some();
        if octree {
            self.walk.get_or_insert(Walk::Restart);
        }
        if self.grid.is_some() {
            self.macro_cells.get_or_insert(Switch::Off);
        }
        self.overlap.get_or_insert(Overlap::Box);
        if octree || self.grid.is_some() {
            self.huge.get_or_insert(Huge::Inside);
        }
        self
    }

    /// Whether the report goes to standard output.
    pub fn json_to_stdout(&self) -> bool {
        self.json.as_deref().is_some_and(values::is_dash)
    }
}
