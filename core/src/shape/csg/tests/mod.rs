use super::*;
use crate::probe::Counters;
use crate::shape::testing::{Random, ray};
use crate::shape::{AxisBox, Cylinder, Plane, Sphere};
use glam::{Vec3, vec3};

extern crate std;
use std::vec::Vec;
use std::{println, vec};

use Operator::{Difference, Intersection, Union};

mod points;

const OPERATORS: [Operator; 3] = [Union, Intersection, Difference];

fn csg<S: Parts<f32>>(parts: S, steps: &[Step]) -> Result<Csg<'static, f32, S>, CsgError> {
    let bytes = Trees::<f32>::footprint(steps).peak;
    let bytes: &'static mut [u8] = bytemuck::cast_slice_mut(Vec::leak(vec![0_u64; bytes / 8]));
    Csg::build(parts, Vec::leak(steps.to_vec()), &mut Arena::new(bytes))
}

/// All crossings, or those in a window.
fn crossings<S: Parts<f32>>(
    csg: &Csg<'_, f32, S>,
    object: usize,
    ray: &Ray<f32>,
    window: (f32, f32),
    skipping: bool,
) -> (Vec<(f32, u16)>, u64) {
    let (mut all, mut probe) = (Vec::new(), Counters::default());
    csg.crossings(object, ray, window, skipping, &mut probe, |c| all.push((c.t, c.part)));
    (all, probe.primitive_tests)
}

const LINE: (f32, f32) = (-f32::INFINITY, f32::INFINITY);

/// Whether a point is in an object of which it is known in which parts it is.
fn holds(steps: &[Step], inside: impl Fn(usize, u16) -> bool) -> bool {
    let mut stack = Vec::new();
    for (step, kind) in steps.iter().enumerate() {
        match kind {
            Step::Part(part) => stack.push(inside(step, *part)),
            Step::Join(operator) => {
                let (second, first) = (stack.pop().unwrap(), stack.pop().unwrap());
                stack.push(operator.holds(first, second));
            }
        }
    }
    assert_eq!(stack.len(), 1);
    stack[0]
}

/// A random tree over so many parts, each used once, in order.
fn tree(random: &mut Random, parts: u16) -> Vec<Step> {
    let (mut steps, mut open, mut next) = (Vec::new(), 0, 0);
    while next < parts || open > 1 {
        if open > 1 && (next == parts || random.signed() > 0.0) {
            let operator = OPERATORS[(random.within(0.0, 2.99)) as usize];
            steps.push(Step::Join(operator));
            open -= 1;
        } else {
            steps.push(Step::Part(next));
            next += 1;
            open += 1;
        }
    }
    steps
}

/// Boxes one behind the other along x, from and to whole numbers.
fn bars(ends: &[(f32, f32)]) -> &'static [AxisBox<f32>] {
    let bar = |(lo, hi): &(f32, f32)| AxisBox::new(vec3(*lo, -1.0, -1.0), vec3(*hi, 1.0, 1.0));
    Vec::leak(ends.iter().map(bar).collect())
}

#[test]
fn published_truth_table() {
    // J. Buck, The Ray Tracer Challenge (2019), chapter 16: whether a crossing of the left or of the
    // right operand counts, inside or outside of the left and of the right one. In his order.
    const TABLE: [(Operator, [u8; 8]); 3] = [
        (Union, [0, 1, 0, 1, 0, 0, 1, 1]),
        (Intersection, [1, 0, 1, 0, 1, 1, 0, 0]),
        (Difference, [0, 1, 0, 1, 1, 1, 0, 0]),
    ];
    let mut rows = 0;
    for (operator, results) in TABLE {
        for (row, counts) in results.into_iter().enumerate() {
            let [left_hit, in_left, in_right] = [4, 2, 1].map(|bit| row & bit == 0);
            // A solid that ends (or begins) at 5, another around 5 or elsewhere.
            let hit = |inside: bool| if inside { (1.0, 5.0) } else { (5.0, 9.0) };
            let other = |inside: bool| if inside { (0.0, 10.0) } else { (20.0, 30.0) };
            let parts = if left_hit {
                [hit(in_left), other(in_right)]
            } else {
                [other(in_left), hit(in_right)]
            };
            let steps = [Step::Part(0), Step::Part(1), Step::Join(operator)];
            let at_5 = match csg(bars(&parts), &steps) {
                Ok(csg) => {
                    let ray = ray([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
                    crossings(&csg, 0, &ray, LINE, true).0.iter().any(|(t, _)| *t == 10.0)
                }
                Err(error) => {
                    assert_eq!(error, CsgError::Empty { object: 0 });
                    false
                }
            };
            assert_eq!(at_5, counts == 1, "{operator:?} {row}");
            rows += 1;
        }
    }
    assert_eq!(rows, 24);
}

#[test]
fn published_crossings() {
    let r = ray([0.0, 0.0, -5.0], [0.0, 0.0, 1.0]);
    // Four crossings, of the first, the second, the first and the second operand.
    let spheres = [Sphere::new(Vec3::ZERO, 1.0), Sphere::new(vec3(0.0, 0.0, 0.5), 1.0)];
    for (operator, expected) in [
        (Union, [(4.0, 0), (6.5, 1)]),
        (Intersection, [(4.5, 1), (6.0, 0)]),
        (Difference, [(4.0, 0), (4.5, 1)]),
    ] {
        let csg = csg(&spheres[..], &[Step::Part(0), Step::Part(1), Step::Join(operator)]).unwrap();
        assert_eq!(crossings(&csg, 0, &r, LINE, true).0, expected);
        let per_ray = csg.per_ray(&r);
        assert_eq!(csg.hit(0, &r, &per_ray, 0.0, 9.0), Some(expected[0].0));
        assert_eq!(csg.hit(0, &r, &per_ray, expected[0].0, 9.0), Some(expected[1].0));
        assert_eq!(csg.hit(0, &r, &per_ray, expected[1].0, 9.0), None);
        assert_eq!(csg.hit(0, &r, &per_ray, 0.0, 3.9), None);
        assert_eq!(csg.hit(1, &r, &per_ray, 0.0, 9.0), None);
        // Out of the object at both.
        assert!(csg.normal(0, &r, expected[0].0).z < 0.0);
        assert!(csg.normal(0, &r, expected[1].0).z > 0.0);
        let past = ray([0.0, 2.0, -5.0], [0.0, 0.0, 1.0]);
        assert_eq!(csg.hit(0, &past, &csg.per_ray(&past), 0.0, 9.0), None);
    }
}

#[test]
fn every_nesting_of_intervals_is_what_its_points_are() {
    let mut random = Random(12);
    let (mut objects, mut found, mut empty) = (0, 0, 0);
    let mut check = |parts: &[(f32, f32)], steps: &[Step]| {
        objects += 1;
        let along = ray([-1.0, 0.25, 0.5], [0.5, 0.0, 0.0]);
        // Between whole numbers nothing changes.
        let inside = |at: f32| {
            holds(steps, |_, i| {
                let (lo, hi) = parts[usize::from(i)];
                at > lo && at < hi
            })
        };
        let changes = (-1..40_i16).map(f32::from).filter(|x| inside(x - 0.5) != inside(x + 0.5));
        let expected: Vec<f32> = changes.map(|x| (x + 1.0) * 2.0).collect();
        match csg(bars(parts), steps) {
            Ok(csg) => {
                let all = crossings(&csg, 0, &along, LINE, true).0;
                let all: Vec<f32> = all.into_iter().map(|(t, _)| t).collect();
                assert_eq!(all, expected, "{parts:?} {steps:?}");
                found += all.len();
            }
            Err(error) => {
                assert_eq!(error, CsgError::Empty { object: 0 });
                assert!(expected.is_empty());
                empty += 1;
            }
        }
    };
    // Two operators, both ways, over all ways in which three intervals can lie.
    let ends: Vec<(f32, f32)> =
        (0..4_i16).flat_map(|a| (a + 1..5).map(move |b| (f32::from(a), f32::from(b)))).collect();
    let [a, b, c] = [0, 1, 2].map(Step::Part);
    for one in OPERATORS.map(Step::Join) {
        for other in OPERATORS.map(Step::Join) {
            for first in &ends {
                for second in &ends {
                    for third in &ends {
                        let parts = [*first, *second, *third];
                        check(&parts, &[a, b, one, c, other]);
                        check(&parts, &[a, b, c, one, other]);
                    }
                }
            }
        }
    }
    for _ in 0..50_000 {
        let parts: Vec<(f32, f32)> = (0..2 + (random.within(0.0, 18.0) as usize))
            .map(|_| {
                let lo = random.within(0.0, 30.0).floor();
                (lo, lo + 1.0 + random.within(0.0, 8.0).floor())
            })
            .collect();
        check(&parts, &tree(&mut random, parts.len() as u16));
    }
    println!("{objects} objects, {empty} of them nothing, {found} crossings");
    assert!(objects > 60_000 && found > 100_000 && empty < objects / 2);
}

#[test]
fn what_cannot_be_combined_is_refused_with_numbers() {
    let [a, b, join] = [Step::Part(0), Step::Part(1), Step::Join(Union)];
    let bars = bars(&[(0.0, 1.0), (2.0, 3.0)]);
    let why = |steps: &[Step]| csg(bars, steps).unwrap_err();
    assert_eq!(why(&[join]), CsgError::Operands { step: 0 });
    assert_eq!(why(&[a, join]), CsgError::Operands { step: 1 });
    assert_eq!(why(&[a, b, join, join]), CsgError::Operands { step: 3 });
    let no_part = CsgError::Part { step: 1, part: 7, available: 2 };
    assert_eq!(why(&[a, Step::Part(7), join]), no_part);
    let empty = [b, a, b, Step::Join(Intersection)];
    assert_eq!(why(&empty), CsgError::Empty { object: 1 });
    let minus = [a, a, Step::Join(Difference), b, Step::Join(Intersection)];
    assert_eq!(why(&minus), CsgError::Empty { object: 0 });

    // 32 parts fit 64 crossings, one more does not.
    let chain = |parts: usize| -> Vec<Step> {
        let more = (1..parts).flat_map(|_| [b, join]);
        core::iter::once(a).chain(more).collect()
    };
    assert!(csg(bars, &chain(32)).is_ok());
    let full = CsgError::Crossings { object: 0, needed: 66, available: 64 };
    assert_eq!(why(&chain(33)), full);

    let sphere = [Sphere::<f32>::new(Vec3::ZERO, -1.0)];
    let negative = CsgError::Shape { part: 0, why: ShapeError::Negative };
    assert_eq!(csg(&sphere[..], &[a]).unwrap_err(), negative);
    let pipe = [Cylinder::<f32>::new(Vec3::ZERO, Vec3::X, 1.0)];
    assert_eq!(csg(&pipe[..], &[a]).unwrap_err(), CsgError::Open { part: 0 });
    assert!(csg(&pipe.map(Cylinder::capped)[..], &[a]).is_ok());

    // A half-space alone has no end, nor has a box from which nothing but it is kept.
    let spaces = [Plane::<f32>::new(Vec3::ZERO, Vec3::Y)];
    let with = (bars, &spaces[..]);
    let endless = CsgError::Unbounded { object: 0 };
    assert_eq!(csg(with, &[Step::Part(2)]).unwrap_err(), endless);
    assert_eq!(csg(with, &[a, Step::Part(2), join]).unwrap_err(), endless);
    assert_eq!(csg(with, &[Step::Part(2), a, Step::Join(Difference)]).unwrap_err(), endless);
    let half = csg(with, &[a, Step::Part(2), Step::Join(Intersection)]).unwrap();
    assert_eq!(half.bounds(0).hi, vec3(1.0, 0.0, 1.0));

    let steps = vec![a; MOST + 1];
    let needed = MOST + 1;
    assert_eq!(why(&steps), CsgError::Steps { needed, available: MOST });
}

const MOST: usize = trees::MOST_STEPS;

#[test]
fn exactly_the_bytes_of_the_footprint_are_needed() {
    let bars = bars(&[(0.0, 1.0), (2.0, 3.0)]);
    let [a, b] = [Step::Part(0), Step::Part(1)];
    let steps: &[Step] = &[a, b, Step::Join(Union), b, a, Step::Join(Difference), a];
    let needed = Trees::<f32>::footprint(steps).peak;
    let mut bytes = [0_u64; 64];
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut bytes);
    for available in 0..=needed {
        let mut arena = Arena::new(&mut bytes[..available]);
        let made = Csg::<f32, _>::build(bars, steps, &mut arena).map(|csg| csg.count());
        let expected = if available < needed {
            Err(CsgError::Memory(OutOfArena { needed, available }))
        } else {
            Ok(3)
        };
        assert_eq!(made, expected, "{available}");
    }
}

#[test]
fn constants_are_taken_when_they_belong_together() {
    let bars = bars(&[(0.0, 2.0), (1.0, 3.0)]);
    let [a, b] = [Step::Part(0), Step::Part(1)];
    let join = Step::Join(Union);
    let steps = [a, b, join, a, b, a, join, Step::Join(Difference)];
    let steps: &'static [Step] = Vec::leak(steps.to_vec());
    let made = csg(bars, steps).unwrap();
    let trees = made.trees();
    let (links, bounds, roots) = (trees.links(), trees.boxes(), trees.roots());
    let with = |links: &[u16], roots: &[u16]| {
        Csg::<f32, _>::new(bars, Trees::of_parts(steps, links, bounds, roots))
            .map(|csg| csg.count())
    };
    assert_eq!(with(links, roots), Ok(2));
    for i in 0..links.len() {
        for wrong in [links[i].wrapping_add(1), links[i].wrapping_sub(1), 5000] {
            let mut other = links.to_vec();
            other[i] = wrong;
            assert_eq!(with(&other, roots), Err(CsgError::Unsound), "{i} {wrong}");
        }
    }
    for wrong in [&[][..], &[2], &[7], &[2, 6], &[7, 2], &[2, 7, 7], &[2, 7, 9], &[1, 7]] {
        assert_eq!(with(links, wrong), Err(CsgError::Unsound), "{wrong:?}");
    }
    assert_eq!(with(&links[1..], roots), Err(CsgError::Unsound));
}
