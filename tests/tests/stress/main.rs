//! Guards promises 4 and 5: numbers that can be trusted, under stress. A file a class of rays, each
//! with a decided expectation; answers are judged by `kibiray_tests::oracle`. At the end a table of
//! all classes says how many rays there were and what became of them.
//!
//! Some seven million rays by default; `KIBIRAY_STRESS=5` shoots five times as many of the same kinds,
//! into a grid of 1024^3 cells, too, which takes 2 GiB.

mod axials;
mod cells;
mod extremes;
mod meshes;
mod no_rays;
mod polygons;
mod secondary;
mod slabs;
mod spheres;
mod tools;
mod triangles;

use kibiray::num::Fixed;
use kibiray_tests::oracle::{Tally, Tested};
use libtest_mimic::{Arguments, Trial};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// What a class of rays came to, by kind of ray; nothing where a number type has no such rays.
type Report = Vec<(&'static str, Option<Tally>)>;

/// A class: its name, and what shoots its rays, given how many in percent of the usual number.
type Class = (&'static str, fn(usize) -> Report);

/// The place of a line in the table: class, number type, kind of ray.
type Line = (usize, &'static str, &'static str, usize);

/// All there is to say, in the order of classes.
static TABLE: Mutex<BTreeMap<Line, (&str, Option<Tally>)>> = Mutex::new(BTreeMap::new());

/// How many times the usual number of rays.
fn effort() -> usize {
    match std::env::var("KIBIRAY_STRESS") {
        Ok(times) => {
            times.parse().expect("KIBIRAY_STRESS is a number, how many times as many rays")
        }
        Err(_) => 1,
    }
}

/// The classes in one number type, at `share` of the usual number of rays.
fn classes<R: Tested>(share: usize) -> Vec<Trial> {
    let classes: [Class; 10] = [
        ("slabs", slabs::run::<R>),
        ("spheres", spheres::run::<R>),
        ("triangles", triangles::run::<R>),
        ("meshes", meshes::run::<R>),
        ("cylinders and cones", axials::run::<R>),
        ("polygons", polygons::run::<R>),
        ("cells", cells::run::<R>),
        ("extremes", extremes::run::<R>),
        ("rays that are not", no_rays::run::<R>),
        ("secondary rays", secondary::run::<R>),
    ];
    let trial = |(place, (class, run)): (usize, Class)| {
        let name = format!("{} {class}", R::NAME).replace(' ', "_");
        Trial::test(name, move || {
            let report = run((100 * effort() / share).max(1));
            let mut failures = Vec::new();
            let mut table = TABLE.lock().map_err(|_| "another class failed")?;
            for (i, (kind, tally)) in report.into_iter().enumerate() {
                if let Some(tally) = tally.as_ref().filter(|tally| tally.wrong > 0) {
                    let some = tally.failures.join("\n  ");
                    failures.push(format!("{kind}: {} of {}\n  {some}", tally.wrong, tally.rays));
                }
                table.insert((place, class, R::NAME, i), (kind, tally));
            }
            if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
        })
    };
    classes.into_iter().enumerate().map(trial).collect()
}

fn print_table() {
    let Ok(table) = TABLE.lock() else { return };
    println!(
        "{:46} {:5} {:>9} {:>9} {:>9} {:>9} {:>6} {:>8}",
        "class", "num", "rays", "hits", "ambiguous", "explained", "wrong", "worst"
    );
    let mut all = Tally::default();
    for ((_, class, number, _), (kind, tally)) in table.iter() {
        let name = format!("{class}: {kind}");
        let Some(tally) = tally else {
            println!("{name:46} {number:5} {:>9}", "-");
            continue;
        };
        let Tally { rays, hits, ambiguous, explained, wrong, worst, .. } = tally;
        println!(
            "{name:46} {number:5} {rays:>9} {hits:>9} {ambiguous:>9} {explained:>9} {wrong:>6} {worst:>8.3}"
        );
        all += tally.clone();
    }
    let Tally { rays, hits, ambiguous, explained, wrong, .. } = all;
    println!("{:46} {:5} {rays:>9} {hits:>9} {ambiguous:>9} {explained:>9} {wrong:>6}", "all", "");
    println!(
        "ambiguous: the bound allows more than one answer; explained: of these, not the exact"
    );
    println!(
        "one; worst: greatest error of t in parts of its bound; -: no such rays, as scenes in"
    );
    println!("fixed point lie about the origin, with coordinates up to 1/2 in steps of 2^-28");
}

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = classes::<f32>(1);
    // Judged in 106 bits, which takes a while.
    trials.extend(classes::<f64>(8));
    trials.extend(classes::<Fixed>(1));
    let conclusion = libtest_mimic::run(&arguments, trials);
    print_table();
    conclusion.exit();
}
