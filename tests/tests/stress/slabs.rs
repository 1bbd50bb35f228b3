//! Boxes one unit in the last place thick; rays in faces, edges and corners; zeros of both signs.

use super::Report;
use super::tools::{BYTES, Court, Random, add, conform, len, ray, structures, sub, v, wide};
use kibiray::geom::Interval;
use kibiray::num::{Vec3, Vector};
use kibiray::scene::{Scene, Solids};
use kibiray::shape::{AxisBox, Shape};
use kibiray_tests::Memory;
use kibiray_tests::oracle::{Tally, Tested, exact};

pub(super) fn run<R: Tested>(percent: usize) -> Report {
    let (plates, specks) = thin::<R>(percent * 1500);
    vec![
        ("plates one ulp thick", Some(plates)),
        ("rods and specks one ulp thick", Some(specks)),
        ("in faces, signed zeros", Some(faces::<R>(percent * 1000))),
        ("through edges and corners", Some(corners::<R>(percent * 500))),
        ("thin boxes in structures", Some(thin_in_structures::<R>(percent * 20))),
    ]
}

/// A box that is one unit in the last place thick along some axes.
fn thin_box<R: Tested>(random: &mut Random, axes: [bool; 3]) -> AxisBox<R> {
    let corner = random.vector().map(|x| len::<R>(x * 4.0));
    let lo = Vec3::<R>::from_array(corner);
    let size = random.vector().map(|x| 0.2 + x.abs());
    let hi = [0, 1, 2]
        .map(|a| if axes[a] { corner[a].next_up() } else { corner[a] + len::<R>(size[a]) });
    AxisBox::new(lo, Vec3::<R>::from_array(hi))
}

/// Plates have two faces that no rounding swaps: who aims inside hits. What is thinner than the
/// bound along two axes may be missed, and only be hit where it is.
fn thin<R: Tested>(rays: usize) -> (Tally, Tally) {
    let mut random = Random::new(1);
    let (mut plates, mut specks) = (Tally::default(), Tally::default());
    for i in 0..rays / 25 {
        let k = i % 3;
        let axes = match i % 4 {
            0 | 1 => [k == 0, k == 1, k == 2],
            2 => [k != 0, k != 1, k != 2],
            _ => [true; 3],
        };
        let boxes = [thin_box::<R>(&mut random, axes)];
        if boxes[0].check().is_err() {
            continue;
        }
        let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
        let mut court = Court::new(&scene);
        let (lo, hi) = (wide::<R>(boxes[0].lo), wide::<R>(boxes[0].hi));
        for _ in 0..25 {
            let at = [0, 1, 2]
                .map(|a| if axes[a] { lo[a] } else { random.within(lo[a] + 0.05, hi[a] - 0.05) });
            let from = random.vector().map(|x| x * 12.0);
            let Some(ray) = ray::<R>(from, sub(at, from)) else { continue };
            let tally = if i % 4 < 2 { &mut plates } else { &mut specks };
            court.shoot(&ray, tally);
        }
    }
    (plates, specks)
}

/// Along an axis, with zeros of either sign: inside the closed box or not, exactly.
fn faces<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(2);
    let mut tally = Tally::default();
    for i in 0..rays {
        let a = thin_box::<R>(&mut random, [i % 5 == 0, false, i % 7 == 0]);
        let axis = i % 3;
        let (lo, hi) = (a.lo.to_array(), a.hi.to_array());
        let mut inside = true;
        let mut from = [0, 1, 2].map(|axis| {
            let ends = [lo[axis], hi[axis], lo[axis].next_down(), hi[axis].next_up()];
            ends[random.below(4)]
        });
        let mut way = [0; 3].map(|_: i32| R::from_f64(0.0 * random.sign()));
        for other in 0..3 {
            if other != axis {
                inside &= from[other] >= lo[other] && from[other] <= hi[other];
            }
        }
        let sign = random.sign();
        from[axis] = len::<R>(-20.0 * sign);
        way[axis] = R::from_f64(sign * if i % 2 == 0 { 1.0 } else { 0.25 });
        let boxes = [a];
        let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
        let (o, d) = (Vec3::<R>::from_array(from), Vec3::<R>::from_array(way));
        let Some(ray) = ray::<R>(wide::<R>(o), wide::<R>(d)) else { continue };
        let hit = super::tools::nearest(&scene, &ray, Interval::RAY);
        tally.hits += u64::from(hit.is_some());
        tally.expect(hit.is_some() == inside, || format!("{a:?} {ray:?}: {hit:?}"));
    }
    tally
}

/// Through edges and corners, and a step beside them, where no operation rounds: small whole
/// numbers, directions of powers of two. Then the closed box is met or not, exactly.
fn corners<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(3);
    let mut tally = Tally::default();
    let (lo, hi) = ([-1.0, -2.0, -1.5], [1.0, 0.5, 2.0]);
    let boxes = [AxisBox::new(v::<R>(lo), v::<R>(hi))];
    let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
    for i in 0..rays {
        let mut at = [0, 1, 2].map(|a| if random.rng().bool() { lo[a] } else { hi[a] });
        if i % 2 == 0 {
            at[i / 2 % 3] = random.rng().i32(-8..9).into();
            at[i / 2 % 3] *= 0.25;
        }
        let way = [0; 3].map(|_: i32| random.sign() * [0.0, 0.5, 1.0, 2.0][random.below(4)]);
        let from = sub(at, way.map(|x| 2.0 * x));
        let beside = [0; 3].map(|_: i32| f64::from(random.rng().i8(-1..=1)) / 64.0);
        let from = if i % 3 == 0 { add(from, beside) } else { from };
        let Some(ray) = ray::<R>(from, way) else { continue };
        let hit =
            super::tools::nearest(&scene, &ray, Interval::new(-R::from_i32(8), R::from_i32(8)));
        let met = exact::meets_box(from, way, lo, hi);
        tally.hits += u64::from(hit.is_some());
        tally.expect(hit.is_some() == met, || format!("{ray:?}: {hit:?}, exact {met}"));
    }
    tally
}

/// Structures lose none of them.
fn thin_in_structures<R: Tested>(rays: usize) -> Tally {
    let mut random = Random::new(4);
    let mut memory = Memory::new(BYTES);
    let mut tally = Tally::default();
    let boxes: Vec<AxisBox<R>> = (0..300)
        .map(|i| thin_box::<R>(&mut random, [i % 2 == 0, i % 3 == 0, i % 5 == 0]))
        .filter(|b| b.check().is_ok())
        .collect();
    let scene = Scene::new(Solids { boxes: &boxes, ..Solids::default() }).unwrap();
    let shots: Vec<_> = (0..rays)
        .filter_map(|i| {
            let b = boxes[random.below(boxes.len())];
            let (lo, hi) = (wide::<R>(b.lo), wide::<R>(b.hi));
            let at = [0, 1, 2].map(|a| if random.rng().bool() { lo[a] } else { hi[a] });
            let way = if i % 3 == 0 {
                let mut way = [0.0; 3];
                way[i / 3 % 3] = random.sign();
                way
            } else {
                random.direction()
            };
            Some((ray::<R>(sub(at, way.map(|x| 6.0 * x)), way)?, Interval::RAY))
        })
        .collect();
    conform(&scene, &structures(&scene), &shots, &mut memory, &mut tally);
    tally
}
