//! Grids and octrees: which cells a ray visits, against the exact set; shapes in walls, rays along
//! walls, along edges and through corners of cells.

use super::Report;
use super::tools::{BYTES, Random, conform, plain, ray_in, sub, times, unit_for, v_in};
use kibiray::accel::{self, Accel, Any, Visitor, grid, octree};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::scene::{Scene, Solids};
use kibiray::shape::AxisBox;
use kibiray_tests::Memory;
use kibiray_tests::oracle::{Tally, Tested};
use std::collections::HashSet;
use std::ops::Range;

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    let grid = |macro_cells| {
        let resolution = [CELLS as u32, CELLS as u32, 1];
        accel::Kind::Grid(grid::Settings { macro_cells, ..grid::Settings::new(resolution) })
    };
    let limits = octree::Limits { max_objects: 1, max_level: octree::DEEPEST };
    let walks = [
        octree::Walk::Restart,
        octree::Walk::Neighbours,
        octree::Walk::Descent,
        octree::Walk::Segments,
    ];
    let octrees = walks.map(|walk| accel::Kind::Octree(octree::Settings { walk, ..limits.into() }));
    let mut report = vec![
        ("drift over 1024 cells, grid", Some(drift::<R>(percent * 5, &[grid(false)], 1))),
        ("drift, grid with macro cells", Some(drift::<R>(percent * 5, &[grid(true)], 3))),
        ("drift, octree of 10 levels", Some(drift::<R>(percent * 2, &octrees, 1))),
        ("shapes in walls, rays along them", Some(walls::<R>(percent * 20))),
    ];
    if percent >= 500 {
        report.push(("1024^3 grid", Some(vast::<R>(percent))));
    }
    report
}

/// Cells along an axis. With bounds from -512 to 512 a grid's root begins at -513.03125 and an
/// octree's at -513 (`planes_and_ties.rs`); both are 1026 wide, exactly.
const CELLS: usize = 1024;
const CELL: f64 = 1026.0 / 1024.0;

/// The cells that a walk hands over, each known by the one shape in it.
#[derive(Default)]
struct Cells {
    seen: HashSet<usize>,
    probe: (),
}

impl<R: Real> Visitor<R> for Cells {
    type Probe = ();

    fn start(&self) -> R {
        R::ZERO
    }
    fn limit(&self) -> R {
        R::MAX
    }
    fn visit(&mut self, ids: impl Iterator<Item = usize>) {
        self.seen.extend(ids);
    }
    fn visit_range(&mut self, ids: Range<usize>) {
        self.seen.extend(ids);
    }
    fn probe(&mut self) -> &mut () {
        &mut self.probe
    }
}

/// Where a ray enters and leaves a square, grown or shrunk.
fn meets(o: [f64; 2], d: [f64; 2], lo: [f64; 2], grow: f64) -> bool {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for a in 0..2 {
        let (lo, hi) = (lo[a] - grow, lo[a] + CELL + grow);
        if d[a] == 0.0 {
            if o[a] < lo || o[a] > hi {
                return false;
            }
            continue;
        }
        let (s, t) = ((lo - o[a]) / d[a], (hi - o[a]) / d[a]);
        enter = enter.max(s.min(t));
        leave = leave.min(s.max(t));
    }
    enter <= leave
}

/// A box in the middle of every `every`th cell of a layer: whatever is visited has to be met by the
/// ray, give or take the pad, and what the ray passes deeper than the pad has to be visited.
fn drift<R: Tested>(rays: usize, kinds: &[accel::Kind], every: usize) -> Tally {
    let unit = unit_for::<R>(1024.0);
    let mut tally = Tally::default();
    let mut memory = Memory::new(2 * BYTES);
    for kind in kinds {
        let is_octree = matches!(kind, accel::Kind::Octree(_));
        let first = if is_octree { -513.0 } else { -513.03125 };
        let corner = |i: usize| first + CELL * i as f64;
        let small = |x: f64, y: f64| {
            AxisBox::new(
                v_in::<R>(unit, [x - 0.25, y - 0.25, 300.25]),
                v_in::<R>(unit, [x + 0.25, y + 0.25, 300.5]),
            )
        };
        let places: Vec<[usize; 2]> = (1..CELLS - 1)
            .flat_map(|i| (1..CELLS - 1).map(move |j| [i, j]))
            // A leaf of an octree is larger than a cell where it holds a single box.
            .filter(|[i, j]| !is_octree || ((2..256).contains(i) && *j > 769))
            .filter(|[i, j]| (i + j) % every == 0)
            .collect();
        let mut boxes: Vec<AxisBox<R>> = places
            .iter()
            .map(|[i, j]| small(corner(*i) + 0.5 * CELL, corner(*j) + 0.5 * CELL))
            .collect();
        // What makes the bounds round.
        for end in [-512.0, 511.5] {
            boxes.push(AxisBox::new(v_in::<R>(unit, [end; 3]), v_in::<R>(unit, [end + 0.5; 3])));
        }
        let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
        let mut arena = Arena::new(memory.bytes(2 * BYTES));
        let accel = match Any::build(*kind, &scene, &mut arena) {
            Ok(accel) => accel,
            Err(error) => {
                tally.fail(|| format!("{kind:?}: {error}"));
                return tally;
            }
        };
        let place: std::collections::HashMap<[usize; 2], usize> =
            places.iter().enumerate().map(|(id, p)| (*p, id)).collect();
        let pad = scene.pad().to_f64() / unit;
        let mut random = Random::new(61);
        for i in 0..rays / kinds.len() {
            let Some(ray) = lattice_ray::<R>(&mut random, i, first) else { continue };
            let mut cells = Cells::default();
            accel.walk(&ray, &mut cells);
            let [o, d] = [ray.origin(), ray.direction()].map(|p| plain::<R>(p).map(|x| x / unit));
            let (o2, d2) = ([o[0], o[1]], [d[0], d[1]]);
            let lo = |[i, j]: [usize; 2]| [corner(i), corner(j)];
            let strayed = cells
                .seen
                .iter()
                .filter_map(|id| places.get(*id))
                .find(|p| !meets(o2, d2, lo(**p), 2.0 * pad));
            let skipped = (1..CELLS - 1)
                .flat_map(|i| rows(o2, d2, corner(i), first, pad).map(move |j| [i, j]))
                .find(|p| {
                    place.get(p).is_some_and(|id| {
                        meets(o2, d2, lo(*p), -2.0 * pad) && !cells.seen.contains(id)
                    })
                });
            tally.hits += cells.seen.len() as u64;
            tally.expect(strayed.is_none() && skipped.is_none(), || {
                format!("{kind:?} {ray:?}: strayed to {strayed:?}, skipped {skipped:?}")
            });
        }
    }
    tally
}

/// The rows that a ray may pass in a column.
fn rows(o: [f64; 2], d: [f64; 2], x: f64, first: f64, pad: f64) -> Range<usize> {
    let all = 1..CELLS - 1;
    let (s, t) = if d[0] == 0.0 {
        if o[0] < x - pad || o[0] > x + CELL + pad {
            return 0..0;
        }
        (0.0, f64::INFINITY)
    } else {
        let (s, t) = ((x - pad - o[0]) / d[0], (x + CELL + pad - o[0]) / d[0]);
        (s.min(t).max(0.0), s.max(t))
    };
    if t < s {
        return 0..0;
    }
    let y = |t: f64| if d[1] == 0.0 { o[1] } else { o[1] + d[1] * t };
    let (a, b) = (y(s), y(t));
    let row = |y: f64| ((y - first) / CELL).floor();
    let from = row(a.min(b) - pad).max(all.start as f64) as usize;
    let to = (row(a.max(b) + pad) + 1.0).min(all.end as f64).max(0.0) as usize;
    from..to.max(from)
}

/// Through the layer of boxes: any, along an axis in a wall or beside it, through lattice points,
/// almost along an axis.
fn lattice_ray<R: Tested>(random: &mut Random, i: usize, first: f64) -> Option<Ray<R>> {
    let unit = unit_for::<R>(1024.0);
    let wall = |random: &mut Random| first + CELL * random.below(CELLS) as f64;
    let mut to = [random.signed() * 500.0, random.signed() * 500.0, 300.3];
    let mut way = random.direction();
    way[2] = 0.0;
    match i % 5 {
        0 => {
            to = [wall(random), wall(random), 300.3];
            way = [random.sign(), random.sign(), 0.0];
        }
        1 => {
            let axis = i / 5 % 2;
            way = [0.0, 0.0, 0.0];
            way[axis] = random.sign();
            to[1 - axis] = wall(random);
        }
        2 => {
            let axis = i / 5 % 2;
            way[axis] = random.sign();
            way[1 - axis] = random.sign() * random.decade(-7.0, -2.0);
            to[1 - axis] = wall(random);
        }
        _ => {}
    }
    ray_in::<R>(unit, sub(to, times(way, 700.0)), way)
}

/// Boxes, flat ones too, whose faces are walls of cells of a 16^3 grid and of an octree; rays along
/// walls, edges, through corners, from corners.
fn walls<R: Tested>(rays: usize) -> Tally {
    let unit = unit_for::<R>(1024.0);
    let mut tally = Tally::default();
    let mut random = Random::new(62);
    let mut memory = Memory::new(BYTES);
    let wall = |random: &mut Random| {
        if random.rng().bool() {
            -513.0 + 1026.0 / 16.0 * random.below(17) as f64
        } else {
            -513.03125 + 1026.0 / 16.0 * random.below(17) as f64
        }
    };
    let mut boxes = vec![];
    for end in [-512.0, 511.0] {
        boxes.push(AxisBox::new(v_in::<R>(unit, [end; 3]), v_in::<R>(unit, [end + 1.0; 3])));
    }
    for i in 0..200 {
        let [a, b] =
            [0, 1].map(|_: i32| [0; 3].map(|_: i32| wall(&mut random).clamp(-512.0, 512.0)));
        let lo = [0, 1, 2].map(|k| a[k].min(b[k]));
        let mut hi = [0, 1, 2].map(|k| a[k].max(b[k]).max(lo[k] + 1.0).min(512.0));
        if i % 3 == 0 {
            hi[i / 3 % 3] = lo[i / 3 % 3];
        }
        let b = AxisBox::new(v_in::<R>(unit, lo), v_in::<R>(unit, hi));
        if kibiray::shape::Shape::<R>::check(&b).is_ok() {
            boxes.push(b);
        }
    }
    let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
    let mut shots = Vec::new();
    for i in 0..rays {
        let from = [0; 3].map(|_: i32| wall(&mut random));
        let to = [0; 3].map(|_: i32| wall(&mut random));
        let mut way = match i % 3 {
            0 => [0; 3].map(|_: i32| f64::from(random.rng().i8(-1..=1))),
            1 => sub(to, from),
            _ => random.direction(),
        };
        if i % 6 > 2 {
            way[i % 3] = 0.0;
        }
        if let Some(ray) = ray_in::<R>(unit, from, way) {
            shots.push((ray, Interval::RAY));
        }
    }
    let octree = |walk, store| {
        let limits = octree::Limits { max_objects: 1, max_level: 6 };
        accel::Kind::Octree(octree::Settings { walk, store, ..limits.into() })
    };
    use octree::{Store, Walk};
    let kinds = [
        accel::Kind::Grid(grid::Settings::new([16; 3])),
        accel::Kind::Grid(grid::Settings { macro_cells: true, ..grid::Settings::new([32; 3]) }),
        octree(Walk::Descent, Store::Links),
        octree(Walk::Restart, Store::Hashed),
        octree(Walk::Neighbours, Store::Links),
        octree(Walk::Segments, Store::Links),
        accel::Kind::Bvh(boxes.len()),
    ];
    conform(&scene, &kinds, &shots, &mut memory, &mut tally);
    tally
}

/// A grid of 1024 cells along every axis, 2 GiB of it, nearly all empty.
fn vast<R: Tested>(percent: usize) -> Tally {
    let unit = unit_for::<R>(1024.0);
    let mut tally = Tally::default();
    let mut random = Random::new(63);
    let boxes: Vec<AxisBox<R>> = (0..2000)
        .map(|_| {
            let p = times(random.vector(), 511.0);
            AxisBox::new(v_in::<R>(unit, p), v_in::<R>(unit, [p[0] + 0.5, p[1] + 0.5, p[2] + 0.5]))
        })
        .collect();
    let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
    let shots: Vec<_> = (0..percent)
        .filter_map(|i| {
            let lo = plain::<R>(boxes[random.below(boxes.len())].lo).map(|x| x / unit);
            let at = [lo[0] + 0.2, lo[1] + 0.3, lo[2] + 0.25];
            let mut way = random.direction();
            if i % 4 == 0 {
                way[i / 4 % 3] = 0.0;
            }
            Some((ray_in::<R>(unit, sub(at, times(way, 600.0)), way)?, Interval::RAY))
        })
        .collect();
    let bytes =
        Any::footprint(accel::Kind::Grid(grid::Settings::new([1024; 3])), &scene).unwrap().peak;
    let mut memory = Memory::new(bytes + 64);
    let naive: Vec<_> =
        shots.iter().map(|(ray, interval)| super::tools::nearest(&scene, ray, *interval)).collect();
    for macro_cells in [false, true] {
        let kind =
            accel::Kind::Grid(grid::Settings { macro_cells, ..grid::Settings::new([1024; 3]) });
        let mut arena = Arena::new(memory.bytes(bytes + 64));
        let accel = Any::build(kind, &scene, &mut arena).unwrap();
        for ((ray, interval), expected) in shots.iter().zip(&naive) {
            let off = &mut kibiray::accel::mailbox::Off;
            let found = accel.nearest(&scene, ray, *interval, off, &mut ());
            tally.hits += u64::from(found.is_some());
            let same = found.map(|h| (h.t, h.id)) == expected.map(|h| (h.t, h.id));
            tally.expect(same, || format!("{ray:?}: {found:?} for {expected:?}"));
        }
    }
    tally
}
