//! Guards that macro-cells only skip what is empty: a ray meets exactly the lists that single steps
//! from cell to cell would meet, in the same order, ties between walls included.

use core::ops::Range;
use kibiray::accel::{Accel, Grid, Visitor, grid};
use kibiray::geom::{Interval, Ray};
use kibiray::memory::Arena;
use kibiray::num::Real;
use kibiray::probe::Counters;
use kibiray_host_sim::description::load::load;
use kibiray_host_sim::tables::Tables;
use kibiray_tests::{Memory, SMALL_SCENES, shots};

/// Bytes of an arena.
const SIZE: usize = 1 << 24;

/// Writes down the lists it is given, each closed by a mark.
struct Lists<R> {
    interval: Interval<R>,
    ids: Vec<usize>,
    counters: Counters,
}

impl<R: Real> Visitor<R> for Lists<R> {
    type Probe = Counters;

    fn start(&self) -> R {
        self.interval.min
    }

    fn limit(&self) -> R {
        self.interval.max
    }

    fn visit(&mut self, ids: impl Iterator<Item = usize>) {
        self.ids.extend(ids);
        self.ids.push(usize::MAX);
    }

    fn visit_range(&mut self, ids: Range<usize>) {
        self.visit(ids);
    }

    fn probe(&mut self) -> &mut Counters {
        &mut self.counters
    }
}

fn walk<R: Real>(accel: &impl Accel<R>, ray: &Ray<R>, interval: Interval<R>) -> Lists<R> {
    let mut lists = Lists { interval, ids: Vec::new(), counters: Counters::default() };
    accel.walk(ray, &mut lists);
    lists
}

fn same_lists<R: Real>(number: &str) {
    let (mut rays, mut full, mut single, mut leaps) = (0, 0, 0, 0);
    for name in SMALL_SCENES {
        let tables = Tables::<R>::new(&load(name).unwrap()).unwrap();
        let polygons = tables.polygons();
        let scene = tables.scene(&polygons).unwrap();
        let shots = shots(scene.bounds(), tables.view(), 20_000, 1994);
        for resolution in [[16; 3], [61, 47, 53], [1, 90, 7]] {
            let settings = |macro_cells| grid::Settings { macro_cells, ..resolution.into() };
            let (mut one, mut other) = (Memory::new(SIZE), Memory::new(SIZE));
            let (mut one, mut other) = (Arena::new(one.bytes(SIZE)), Arena::new(other.bytes(SIZE)));
            let plain = Grid::<R, u16, u32>::build(&scene, settings(false), &mut one).unwrap();
            let marked = Grid::<R, u16, u32>::build(&scene, settings(true), &mut other).unwrap();
            assert!(plain.lists().eq(marked.lists()), "{name} {resolution:?}");
            assert_eq!(one.high_water(), other.high_water(), "the distances take no memory");
            for (ray, interval) in &shots {
                let (one, other) = (walk(&plain, ray, *interval), walk(&marked, ray, *interval));
                assert_eq!(one.ids, other.ids, "{name} {resolution:?} {ray:?}");
                let (one, other) = (one.counters, other.counters);
                assert!(other.steps <= one.steps, "{name} {resolution:?} {ray:?}");
                rays += 1;
                full += one.leaves - one.empty_leaves;
                single += one.empty_leaves;
                leaps += other.empty_leaves;
            }
        }
    }
    println!("{number}: {rays} rays, {full} full cells, {single} empty ones, {leaps} leaps");
    assert!(full > 1_000_000 && leaps * 2 < single);
}

#[test]
fn the_full_cells_are_those_of_single_steps_in_f32() {
    same_lists::<f32>("f32");
}

#[test]
fn the_full_cells_are_those_of_single_steps_in_f64() {
    same_lists::<f64>("f64");
}
