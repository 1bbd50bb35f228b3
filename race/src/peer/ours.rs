//! Kibiray: every structure in several budgets, and the limit of them all.

use super::{ANY, Batch, Built, MISS, Peer, fastest};
use crate::mesh::Mesh;
use crate::rays::{Query, Ray};
use glam::Vec3;
use kibiray::accel::mailbox::{AnyMailbox, Off};
use kibiray::accel::{Accel, Any, Mailbox, Visitor};
use kibiray::geom::{self, Interval};
use kibiray::memory::Arena;
use kibiray::plan::{Structure, Wishes, plan};
use kibiray::probe::{Counters, Probe};
use kibiray::scene::Scene;
use kibiray::shape::Triangle;
use std::cell::Cell;

/// Lives as long as the program.
pub type Triangles = Scene<'static, f32, &'static [Triangle<f32>]>;

/// With so few triangles the race waits for the structure that is none.
const NAIVE: usize = 2_000;

/// The mesh as kibiray takes it.
pub fn scene(mesh: &Mesh) -> Result<Triangles, String> {
    let one = |i| mesh.triangle(i).map(Vec3::from);
    let triangles: Vec<_> =
        (0..mesh.len()).map(one).map(|[a, b, c]| Triangle::new(a, b, c)).collect();
    Scene::new(&*triangles.leak()).map_err(|error| error.to_string())
}

/// A structure in a budget.
pub struct Choice {
    pub name: &'static str,
    structure: Structure,
    /// Whether it is told that rays differ from one another.
    incoherent: bool,
    pub budget: &'static str,
    bytes: usize,
}

/// What races, for a mesh of so many triangles.
pub fn choices(triangles: usize) -> Vec<Choice> {
    let mut budgets = [
        ("12 B/tri", 12 * triangles),
        ("24 B/tri", 24 * triangles),
        ("256 KiB", 256 << 10),
        ("unlimited", 1 << 30),
    ];
    budgets.sort_by_key(|(_, bytes)| *bytes);
    let structures = [
        ("kibiray naive", Structure::Naive, false),
        ("kibiray grid", Structure::Grid, false),
        ("kibiray octree", Structure::Octree, false),
        ("kibiray bvh", Structure::Bvh, false),
        ("kibiray bvh for incoherent rays", Structure::Bvh, true),
    ];
    let mut all = vec![];
    for (name, structure, incoherent) in structures {
        for (budget, bytes) in budgets {
            if structure != Structure::Naive || triangles <= NAIVE {
                all.push(Choice { name, structure, incoherent, budget, bytes });
            }
        }
    }
    all
}

/// Plans and builds within a budget.
pub fn build(scene: Triangles, choice: &Choice) -> Result<Built, String> {
    // Pages that nobody writes to are never there.
    let memory: &'static mut [u64] = vec![0; choice.bytes / 8].leak();
    let wishes = Wishes { structure: Some(choice.structure), ..Wishes::default() };
    let (first, build) = fastest(|| make(&scene, &wishes, memory).map(|_| ()));
    first?;
    let (accel, mailbox, arena) = make(&scene, &wishes, memory)?;
    let accel = if choice.incoherent { accel.for_incoherent_rays() } else { accel };
    let (bytes_kept, bytes_peak) = (arena.used(), arena.high_water());
    let batch = match accel {
        Any::Naive(accel) => ready(scene, accel, mailbox),
        Any::Clipped(accel) => ready(scene, accel, mailbox),
        Any::SmallGrid(accel) => ready(scene, accel, mailbox),
        Any::Grid(accel) => ready(scene, accel, mailbox),
        Any::LargeGrid(accel) => ready(scene, accel, mailbox),
        Any::Octree(accel) => ready(scene, accel, mailbox),
        Any::Bvh(accel) => ready(scene, accel, mailbox),
        Any::LargeBvh(accel) => ready(scene, accel, mailbox),
    };
    let bytes_geometry = size_of_val(*scene.shapes());
    Ok(Built { batch, build, bytes_kept, bytes_peak, bytes_geometry })
}

type Made<'m> = (Any<'m, f32>, AnyMailbox<'m>, Arena<'m>);

fn make<'m>(scene: &Triangles, wishes: &Wishes, memory: &'m mut [u64]) -> Result<Made<'m>, String> {
    let mut arena = Arena::new(bytemuck::cast_slice_mut(memory));
    let plan = plan(scene, arena.available(), wishes).map_err(|error| error.to_string())?;
    let mailbox = AnyMailbox::new(plan.mailbox, scene.shapes().len(), &mut arena)
        .map_err(|error| error.to_string())?;
    let accel = Any::build(plan.accel, scene, &mut arena).map_err(|error| error.to_string())?;
    Ok((accel, mailbox, arena))
}

/// The types as a program would name them that knows what it wants.
fn ready(
    scene: Triangles,
    accel: impl Accel<f32> + 'static,
    mailbox: AnyMailbox<'static>,
) -> Box<dyn Batch> {
    match mailbox {
        AnyMailbox::Off => Box::new(Ours { scene, accel, mailbox: Off }),
        AnyMailbox::Stamps(mailbox) => Box::new(Ours { scene, accel, mailbox }),
        AnyMailbox::Cache(mailbox) => Box::new(Ours { scene, accel, mailbox }),
    }
}

struct Ours<A, M> {
    scene: Triangles,
    accel: A,
    mailbox: M,
}

impl<A: Accel<f32>, M: Mailbox> Ours<A, M> {
    fn nearest(&mut self, r: &Ray, probe: &mut impl Probe) -> (f32, u32) {
        let Ok(ray) = geom::Ray::new(r.o.into(), r.d.into()) else { return MISS };
        let interval = Interval::new(r.tmin, r.tmax);
        match self.accel.nearest(&self.scene, &ray, interval, &mut self.mailbox, probe) {
            Some(hit) => (hit.t, hit.id as u32),
            None => MISS,
        }
    }

    fn occluded(&mut self, r: &Ray, probe: &mut impl Probe) -> (f32, u32) {
        let Ok(ray) = geom::Ray::new(r.o.into(), r.d.into()) else { return MISS };
        let interval = Interval::new(r.tmin, r.tmax);
        let hit = self.accel.occluded(&self.scene, &ray, interval, &mut self.mailbox, probe);
        if hit { ANY } else { MISS }
    }
}

impl<A: Accel<f32>, M: Mailbox> Peer for Ours<A, M> {
    fn closest(&mut self, r: &Ray) -> (f32, u32) {
        self.nearest(r, &mut ())
    }

    fn any(&mut self, r: &Ray) -> (f32, u32) {
        self.occluded(r, &mut ())
    }

    fn work(&mut self, r: &Ray, query: Query) -> Option<(u64, Option<u64>)> {
        let mut counters = Counters::default();
        match query {
            Query::Nearest => self.nearest(r, &mut counters),
            Query::Any => self.occluded(r, &mut counters),
        };
        Some((counters.primitive_tests, Some(counters.steps)))
    }
}

/// A structure that knows the answer: each ray is tested against the shape it hits, if any.
struct Only(Cell<Option<usize>>);

impl Accel<f32> for Only {
    fn walk<V: Visitor<f32>>(&self, _: &geom::Ray<f32>, visitor: &mut V) {
        if let Some(id) = self.0.get() {
            visitor.visit_range(id..id + 1);
        }
    }
}

/// What no structure can beat.
struct Limit {
    ours: Ours<Only, Off>,
    ids: Vec<Option<usize>>,
    next: usize,
}

impl Limit {
    /// Rays come in their order, time and again.
    fn prepare(&mut self) {
        self.ours.accel.0.set(self.ids[self.next]);
        self.next = if self.next + 1 == self.ids.len() { 0 } else { self.next + 1 };
    }
}

impl Peer for Limit {
    fn closest(&mut self, r: &Ray) -> (f32, u32) {
        self.prepare();
        self.ours.closest(r)
    }

    fn any(&mut self, r: &Ray) -> (f32, u32) {
        self.prepare();
        self.ours.any(r)
    }

    fn work(&mut self, r: &Ray, query: Query) -> Option<(u64, Option<u64>)> {
        self.prepare();
        Peer::work(&mut self.ours, r, query)
    }
}

/// The limit for rays whose hits are known.
pub fn limit(scene: Triangles, hits: &[(f32, u32)]) -> Built {
    let ids = hits.iter().map(|hit| (*hit != MISS).then_some(hit.1 as usize)).collect();
    let ours = Ours { scene, accel: Only(Cell::new(None)), mailbox: Off };
    let bytes_geometry = size_of_val(*scene.shapes());
    let batch = Box::new(Limit { ours, ids, next: 0 });
    Built { batch, build: 0.0, bytes_kept: 0, bytes_peak: 0, bytes_geometry }
}
