//! Cylinders and cones: along the axis and the wall, through the tip, tangents and double roots.

use super::Report;
use super::tools::{Court, Random, V, add, cross, len, length, ray, sub, times, v};
use kibiray::scene::{Scene, Solids};
use kibiray::shape::{Cone, Cylinder, Shape};
use kibiray_tests::oracle::{Tally, Tested};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    let mut report: Report = Vec::new();
    for (name, way) in [
        ("at random", Way::Random),
        ("along the axis", Way::Axis),
        ("along the wall", Way::Wall),
        ("through the tip and the rims", Way::Ends),
        ("tangents", Way::Tangent),
        ("from on the wall", Way::On),
    ] {
        report.push((name, Some(shoot::<R>(percent * 1000, way))));
    }
    report
}

#[derive(Clone, Copy, PartialEq)]
enum Way {
    Random,
    Axis,
    Wall,
    Ends,
    Tangent,
    On,
}

/// A ray of a sort, at a solid between `base` and `apex`.
fn aimed(random: &mut Random, way: Way, base: V, apex: V, radii: [f64; 2]) -> (V, V) {
    let axis = sub(apex, base);
    let up = times(axis, 1.0 / length(axis));
    let side = random.across(axis);
    let s = random.within(0.0, 1.0);
    let r = radii[0] + (radii[1] - radii[0]) * s;
    let on = add(add(base, times(axis, s)), times(side, r));
    let size = length(axis) + radii[0] + radii[1];
    let away = size * random.decade(-1.0, 2.0);
    // Along the wall, upwards.
    let wall = add(axis, times(side, radii[1] - radii[0]));
    let tilt = if random.rng().bool() { 0.0 } else { random.decade(-9.0, -2.0) };
    let tilted = |random: &mut Random, d: V| add(d, times(random.vector(), tilt));
    match way {
        Way::Random => {
            let d = random.direction();
            (sub(add(on, times(random.vector(), 0.5 * size)), times(d, away)), d)
        }
        Way::Axis => {
            // Inside, on the wall, outside.
            let off = [random.within(0.0, 1.0), 1.0, random.within(1.0, 1.2)][random.below(3)];
            let from = add(base, times(side, off * radii[0].max(radii[1])));
            let d = times(up, random.sign());
            let d = tilted(random, d);
            (sub(from, times(d, away)), d)
        }
        Way::Wall => {
            let off = times(random.across(wall), size * [0.0, 0.2][random.below(2)] * s);
            let d = times(wall, random.sign());
            let d = tilted(random, d);
            (sub(add(on, off), times(d, random.within(-2.0, 2.0))), d)
        }
        Way::Ends => {
            let d = random.direction();
            let (end, r) = if random.rng().bool() { (base, radii[0]) } else { (apex, radii[1]) };
            let rim = add(end, times(side, r));
            (sub(rim, times(d, away)), d)
        }
        Way::Tangent => {
            let out = times(cross(wall, cross(side, wall)), 1.0 / length(wall).powi(2));
            let d = cross(out, random.direction());
            let off = times(out, size * random.signed() * tilt);
            (sub(add(on, off), times(d, away)), d)
        }
        Way::On => (on, random.direction()),
    }
}

fn shoot<R: Tested>(rays: usize, way: Way) -> Tally {
    let mut random = Random::new(41 + way as u64);
    let mut tally = Tally::default();
    for i in 0..rays / 25 {
        let base = times(random.vector(), 3.0);
        let apex = add(base, times(random.direction(), random.decade(-1.0, 0.5)));
        let r = random.decade(-1.5, 0.3);
        let other = match i % 4 {
            0 | 1 => r,
            2 => 0.0,
            _ => random.decade(-1.5, 0.3),
        };
        let radii = if i % 8 < 4 { [r, other] } else { [other, r] };
        let (b, a) = (v::<R>(base), v::<R>(apex));
        let (rb, ra) = (len::<R>(radii[0]), len::<R>(radii[1]));
        let capped = random.rng().bool();
        let (cylinders, cones) = if i % 4 < 2 {
            let c = Cylinder::new(b, a, rb);
            (vec![if capped { c.capped() } else { c }], vec![])
        } else {
            let c = Cone::new(b, a, rb, ra);
            (vec![], vec![if capped { c.capped() } else { c }])
        };
        if cylinders.iter().any(|c| c.check().is_err()) || cones.iter().any(|c| c.check().is_err())
        {
            continue;
        }
        let solids = Solids { cylinders: &cylinders, cones: &cones, ..Solids::default() };
        let scene = Scene::new(solids).unwrap();
        let mut court = Court::new(&scene);
        for _ in 0..25 {
            let (from, d) = aimed(&mut random, way, base, apex, radii);
            if let Some(ray) = ray::<R>(from, d) {
                court.shoot(&ray, &mut tally);
            }
        }
    }
    tally
}
