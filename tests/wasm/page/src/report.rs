//! What the page is told, at fixed places in memory.

use crate::accel::Small;
use kibiray::accel::octree::StoppedBy;
use kibiray::accel::{BuildError, mailbox};
use kibiray::memory::Arena;
use kibiray::plan::{Plan, Reason};
use kibiray::probe::Counters;

/// Most parts of an arena that are told.
const PARTS: usize = 12;

/// Numbers only, 8 bytes each, in an order that the page knows as well. What does not apply is 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub(crate) struct Report {
    /// Shapes of the scene, and bytes of its tables, which lie outside the arena.
    pub(crate) shapes: f64,
    pub(crate) scene_bytes: f64,
    /// The arena.
    capacity: f64,
    used: f64,
    high_water: f64,
    /// Bytes it would have to have, when it is too small.
    needed: f64,
    /// 0 none, 1 grid, 2 octree, 3 hierarchy.
    structure: f64,
    /// 0 off, 1 stamps, 2 cache.
    mailbox: f64,
    /// 0 asked for, 1 few shapes, 2 no memory (see `needed`), 3 many shapes.
    reason: f64,
    /// Cells of a grid along each axis.
    resolution: [f64; 3],
    /// Divided cells of an octree, nodes of a hierarchy.
    divided: f64,
    /// Of an octree.
    max_level: f64,
    /// 0 done, 1 by its level, 2 by memory.
    stopped_by: f64,
    /// Of all rays since the picture was begun.
    tests: f64,
    skips: f64,
    steps: f64,
    primary: f64,
    shadow: f64,
    secondary: f64,
    /// Number of parts.
    parts: f64,
    part: [Part; PARTS],
}

/// Where a name lies, its length, and the bytes that go by it.
#[repr(C)]
#[derive(Clone, Copy)]
struct Part {
    name: f64,
    len: f64,
    bytes: f64,
}

impl Report {
    pub(crate) const EMPTY: Self = Self {
        shapes: 0.0,
        scene_bytes: 0.0,
        capacity: 0.0,
        used: 0.0,
        high_water: 0.0,
        needed: 0.0,
        structure: 0.0,
        mailbox: 0.0,
        reason: 0.0,
        resolution: [0.0; 3],
        divided: 0.0,
        max_level: 0.0,
        stopped_by: 0.0,
        tests: 0.0,
        skips: 0.0,
        steps: 0.0,
        primary: 0.0,
        shadow: 0.0,
        secondary: 0.0,
        parts: 0.0,
        part: [Part { name: 0.0, len: 0.0, bytes: 0.0 }; PARTS],
    };

    pub(crate) fn refused(&mut self, error: &BuildError) {
        if let BuildError::Memory(memory) = error {
            self.needed = memory.needed as f64;
            self.capacity = memory.available as f64;
        }
    }

    pub(crate) fn planned(&mut self, plan: &Plan) {
        self.mailbox = match plan.mailbox {
            mailbox::Kind::Off => 0.0,
            mailbox::Kind::Stamps => 1.0,
            mailbox::Kind::Cache => 2.0,
        };
        self.reason = match plan.reason {
            Reason::FewShapes { .. } => 1.0,
            Reason::NoMemory { needed, .. } => {
                self.needed = needed as f64;
                2.0
            }
            Reason::ManyShapes { .. } => 3.0,
            _ => 0.0,
        };
    }

    pub(crate) fn built(&mut self, accel: &Small<'_>) {
        match accel {
            Small::Naive(_) => {}
            Small::Grid(grid) => {
                self.structure = 1.0;
                self.resolution = grid.resolution().map(f64::from);
            }
            Small::Bvh(bvh) => {
                self.structure = 3.0;
                self.divided = bvh.nodes() as f64;
            }
            Small::Octree(octree) => {
                self.structure = 2.0;
                self.divided = octree.interior_nodes() as f64;
                self.max_level = octree.max_level().into();
                self.stopped_by = match octree.stopped_by() {
                    StoppedBy::Done => 0.0,
                    StoppedBy::Level => 1.0,
                    StoppedBy::Memory => 2.0,
                };
            }
        }
    }

    pub(crate) fn memory(&mut self, arena: &Arena<'_>) {
        self.capacity = arena.capacity() as f64;
        self.used = arena.used() as f64;
        self.high_water = arena.high_water() as f64;
        self.parts = 0.0;
        for (told, part) in self.part.iter_mut().zip(arena.parts()) {
            let name = part.name;
            let bytes = part.bytes as f64;
            *told = Part { name: name.as_ptr() as usize as f64, len: name.len() as f64, bytes };
            self.parts += 1.0;
        }
    }

    pub(crate) fn counted(&mut self, counters: &Counters) {
        self.tests = counters.primitive_tests as f64;
        self.skips = counters.mailbox_skips as f64;
        self.steps = counters.steps as f64;
        self.primary = counters.primary.shot as f64;
        self.shadow = counters.shadow.shot as f64;
        self.secondary = counters.secondary.shot as f64;
    }
}
