//! What tests take, for the choice of shapes that get a bound: rounded from what `host-sim bounds` told
//! on one machine. On others ratios count, which differ less.

use kibiray::bound::pays;
use serde::Serialize;

use crate::options::Number;

/// A kind of shape in a report: how many of them have a bound, and what that was decided from.
#[derive(Clone, Debug, Serialize)]
pub struct BoundedReport {
    /// Its name.
    pub kind: &'static str,
    /// How many there are.
    pub count: usize,
    /// How many of them have a bound.
    pub bounded: usize,
    /// What the test of a bound takes, in nanoseconds: B.
    pub bound_ns: f64,
    /// What the test of a shape takes that is passed by: I.
    pub test_ns: f64,
}

/// What tests take in one number type.
#[derive(Clone, Debug)]
pub struct Costs {
    bound_ns: f64,
    /// Of each kind in the order of their ids: its name, how many there are, what a test takes.
    kinds: Vec<(&'static str, usize, f64)>,
}

impl Costs {
    /// For the kinds of shapes of a scene and how many there are.
    pub fn of(num: Number, kinds: &[(&'static str, usize)]) -> Self {
        let kinds = kinds.iter().map(|(kind, count)| (*kind, *count, test_ns(num, kind)));
        Self { bound_ns: BOUND_NS[num as usize], kinds: kinds.collect() }
    }

    /// Whether a bound around a shape pays that rays hit with some probability.
    pub fn pays(&self, id: usize, probability: f64) -> bool {
        let mut end = 0;
        let kind = self.kinds.iter().find(|(_, count, _)| {
            end += count;
            id < end
        });
        kind.is_some_and(|(_, _, test_ns)| pays(self.bound_ns, probability, *test_ns))
    }

    /// What has been decided, given the ids of shapes with bounds.
    pub fn report(&self, ids: impl Iterator<Item = usize> + Clone) -> Vec<BoundedReport> {
        let mut first = 0;
        let kinds = self.kinds.iter().map(|&(kind, count, test_ns)| {
            let of_kind = first..first + count;
            first = of_kind.end;
            let bounded = ids.clone().filter(|id| of_kind.contains(id)).count();
            BoundedReport { kind, count, bounded, bound_ns: self.bound_ns, test_ns }
        });
        kinds.filter(|kind| kind.count > 0).collect()
    }
}

/// In `f32`, `f64` and fixed point: a sphere as a bound, with what it takes to go from one shape to the
/// next; shapes without bounds are tested in loops of a kind.
const BOUND_NS: [f64; 3] = [4.3, 4.3, 4.8];

/// The test of a shape that is passed by, rounded. Polygons and combined solids test a box of their own
/// first: what follows that for those who hit it is spared by no bound.
fn test_ns(num: Number, kind: &str) -> f64 {
    let each = match kind {
        "sphere" => [4.1, 4.1, 5.1],
        "triangle" => [5.2, 5.2, 9.0],
        "polygon" => [20.0, 20.0, 50.0],
        "box" => [5.0, 5.0, 10.0],
        "cylinder" => [20.0, 20.0, 70.0],
        "cone" => [24.0, 24.0, 97.0],
        _ => [20.0, 20.0, 20.0],
    };
    each[num as usize]
}
