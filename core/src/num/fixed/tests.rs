use super::*;
use crate::num::{Cells as _, Halves as _, Progress as _};
use crate::shape::testing::Random;

extern crate std;

const STEP: f64 = 1.0 / 268_435_456.0;

fn any(random: &mut Random, magnitude: f64) -> Fixed {
    let scale = f64::from(random.within(0.0, 1.0)).powi(4) * magnitude;
    Fixed::new(f64::from(random.signed()) * scale)
}

#[test]
fn what_is_out_of_range_is_infinite() {
    for x in [8.0, 1.0e300, f64::INFINITY, f64::NAN] {
        assert_eq!(Fixed::new(x), Fixed::INFINITY, "{x}");
    }
    assert_eq!(Fixed::new(-8.0), -Fixed::INFINITY);
    let five = Fixed::from_i32(5);
    assert_eq!(five + five, Fixed::INFINITY);
    assert_eq!(five * -five, -Fixed::INFINITY);
    assert_eq!(five / Fixed::EPSILON, Fixed::INFINITY);
    assert_eq!(five / Fixed::ZERO, Fixed::INFINITY);
    assert_eq!(-five / Fixed::ZERO, -Fixed::INFINITY);
    assert!(!Fixed::INFINITY.is_finite() && !(-Fixed::INFINITY).is_finite());
    assert!(!Fixed::from_bits(i32::MIN).is_finite() && Fixed::MAX.is_finite());
    assert_eq!(Fixed::INFINITY.next_down(), Fixed::MAX);
    assert_eq!(Fixed::from_bits(i32::MIN).abs(), Fixed::INFINITY);
    assert_eq!(Fixed::ZERO / Fixed::from_i32(-3), Fixed::ZERO);
}

#[test]
fn products_quotients_and_roots_are_the_nearest_numbers() {
    let mut random = Random(5);
    for _ in 0..200_000 {
        let (a, b) = (any(&mut random, 2.8), any(&mut random, 2.8));
        let error = (a * b).to_f64() - a.to_f64() * b.to_f64();
        assert!(error.abs() <= STEP / 2.0 * 1.000_001, "{a:?} {b:?}");
        let exact = a.to_f64() / b.to_f64();
        if exact.abs() < 7.9 {
            assert!(((a / b).to_f64() - exact).abs() <= STEP / 2.0 * 1.000_001, "{a:?} {b:?}");
            let ratio = Fixed::ratio(a.times(Fixed::ONE), b.times(Fixed::ONE)).to_f64();
            assert!(
                (ratio - exact).abs() <= STEP * (0.5 + 0.25 * exact.abs()) + 1e-15,
                "{a:?} {b:?}"
            );
        } else {
            let ratio = Fixed::ratio(a.times(Fixed::ONE), b.times(Fixed::ONE));
            assert!(!ratio.is_finite() || ratio.abs().to_f64() > 7.8, "{a:?} {b:?}");
        }
        let root = a.abs().sqrt().to_f64();
        assert!((root - a.abs().to_f64().sqrt()).abs() <= STEP / 2.0 * 1.000_001, "{a:?}");
    }
}

#[test]
fn means_stay_among_their_numbers() {
    let mut random = Random(6);
    for _ in 0..100_000 {
        let weights =
            [0; 3].map(|_| any(&mut random, 5.0).abs().times(any(&mut random, 5.0).abs()));
        let z = [0; 3].map(|_| any(&mut random, 5.0));
        let all: f64 = weights.iter().map(|w| w.to_num::<f64>()).sum();
        if all < 1.0e-9 {
            continue;
        }
        let exact: f64 =
            weights.iter().zip(z).map(|(w, z)| w.to_num::<f64>() * z.to_f64()).sum::<f64>() / all;
        let mean = Fixed::mean(weights, z).to_f64();
        assert!((mean - exact).abs() <= 5.0 * STEP, "{weights:?} {z:?} {mean} {exact}");
    }
}

#[test]
fn vectors_of_any_length_become_units() {
    let mut random = Random(7);
    for _ in 0..100_000 {
        let scale = Fixed::new(0.5_f64.powi(i32::from(random.0 as u8 % 24)));
        let v = Vec3::new(any(&mut random, 2.0), any(&mut random, 2.0), any(&mut random, 2.0));
        let v = v * scale;
        let Some(unit) = v.unit() else {
            assert_eq!(v, Vec3::default());
            continue;
        };
        let exact = glam::DVec3::new(v.x.to_f64(), v.y.to_f64(), v.z.to_f64()).normalize();
        let unit = glam::DVec3::new(unit.x.to_f64(), unit.y.to_f64(), unit.z.to_f64());
        assert!((unit - exact).length() < 2.0 * STEP, "{v:?}");
    }
    assert_eq!(Vec3::default().unit(), None);
}

#[test]
fn across_is_the_direction_of_the_product() {
    let mut random = Random(8);
    for i in 0..100_000_u32 {
        let scale = Fixed::new(0.5_f64.powi((i % 20) as i32));
        let mut vector =
            || Vec3::new(any(&mut random, 1.0), any(&mut random, 1.0), any(&mut random, 1.0));
        let (a, b) = (vector() * scale, vector() * scale);
        let double = |v: Vec3| glam::DVec3::new(v.x.to_f64(), v.y.to_f64(), v.z.to_f64());
        let exact = double(a).cross(double(b));
        let across = a.across(b);
        if exact.length() == 0.0 {
            assert_eq!(across, Vec3::default());
            continue;
        }
        assert!(across.max_abs() >= Fixed::ONE && across.max_abs() <= Fixed::from_i32(2));
        let off = (double(across).normalize() - exact.normalize()).length();
        assert!(off < 4.0 * STEP, "{a:?} {b:?}: {off}");
    }
}

#[test]
fn walls_are_where_they_should_be() {
    let mut random = Random(9);
    for i in 0..200_000_u32 {
        let count = 1 << (i % 21);
        let extent = Fixed::new(f64::from(random.within(0.001, 1.0)));
        let cells = Cells::new(extent, count);
        let d = any(&mut random, 1.7);
        let from = any(&mut random, 2.5);
        let Some(walls) = Progress::new(Reciprocal::of(d), from, &cells, count) else {
            assert_eq!(d, Fixed::ZERO);
            continue;
        };
        let wall = (f64::from(random.within(0.0, 1.0)) * f64::from(count)) as i32;
        let place = from.to_f64() + extent.to_f64() * f64::from(wall) / f64::from(count);
        let exact = place / d.to_f64();
        let t = walls.at(wall).to_f64();
        if exact.abs() < 7.9 {
            // Half a step of t, the reciprocal's error, and that of the cell's width.
            let width = f64::from(count) * STEP * STEP / d.to_f64().abs();
            let bound = STEP / 2.0 + exact.abs() * STEP / 8.0 + width + 1.0e-15;
            assert!((t - exact).abs() <= bound, "{t} {exact} {d:?}");
        } else {
            assert!(t.abs() > 7.8, "{t} {exact} {d:?}");
        }
        let x = Fixed::new(f64::from(random.within(0.0, 1.0)) * extent.to_f64());
        let exact = x.to_f64() / extent.to_f64() * f64::from(count);
        let index = f64::from(cells.index(x));
        let margin = 1.0e-3 + f64::from(count) / extent.to_f64() * STEP;
        assert!(index <= exact + margin && index + 1.0 >= exact - margin, "{index} {exact}");
    }
}

#[test]
fn walls_of_halved_cells_are_where_they_should_be() {
    let mut random = Random(26);
    for i in 0..100_000_u32 {
        let deepest = 1 + i % 10;
        let extent = Fixed::new(f64::from(random.within(0.001, 1.0)));
        let cells = Cells::new(extent, 1 << deepest);
        let (d, from) = (any(&mut random, 1.7), any(&mut random, 2.5));
        let Some(walls) = Progress::new(Reciprocal::of(d), from, &cells, 1) else { continue };
        let falls = d < Fixed::ZERO;
        let (halves, mut middle) = walls.halves(falls, deepest);
        let (mut lower, mut passed) = (0, true);
        for level in 0..deepest {
            middle = halves.middle(middle, passed, (), level, deepest);
            let wall = f64::from(lower + (1 << (deepest - level - 1))) / f64::from(1 << deepest);
            let part = if falls { 1.0 - wall } else { wall };
            let exact = (from.to_f64() + extent.to_f64() * part) / d.to_f64();
            let margin = 24.0 * STEP / d.to_f64().abs();
            for (t, is_past) in [(exact - margin, false), (exact + margin, true)] {
                if t.abs() < 5.1 {
                    let (past, exit) = halves.pass(middle, Fixed::new(t), Fixed::MAX);
                    assert_eq!(past, is_past, "{t} {exact} {d:?}");
                    let off = (exit.to_f64() - exact).abs();
                    assert!(past || exact > 7.0 || off <= margin, "{exit:?} {exact} {d:?}");
                }
            }
            passed = random.signed() > 0.0;
            lower += i32::from(passed) << (deepest - level - 1);
        }
    }
    // Where the ray stays in a cell, it is always behind that cell's lower wall and never at its upper.
    for (cell, deepest) in [(0, 3), (5, 3), (7, 3), (0, 10), (640, 10), (1023, 10)] {
        let (halves, mut middle) = Halves::standing(cell, deepest);
        let (mut lower, mut passed) = (0, true);
        for level in 0..deepest {
            middle = halves.middle(middle, passed, (), level, deepest);
            for t in [Fixed::from_i32(-5), Fixed::ZERO, Fixed::from_i32(5)] {
                let exit = Fixed::from_i32(6);
                let (past, left) = halves.pass(middle, t, exit);
                let wall = lower + (1 << (deepest - level - 1));
                assert_eq!((past, left), (wall <= cell, exit), "{cell} {wall}");
            }
            let wall = lower + (1 << (deepest - level - 1));
            passed = wall <= cell;
            lower = if passed { wall } else { lower };
        }
        assert_eq!(lower, cell);
    }
}

#[test]
fn tangents_and_powers_are_those_of_floats() {
    for i in 0..1440 {
        let x = f64::from(i) / 1000.0;
        let tan = Fixed::new(x).tan().to_f64();
        let bound = STEP * (1.0 + x.tan()) * (1.0 + x.tan());
        assert!((tan - x.tan()).abs() <= bound, "{x}");
    }
    for i in 0..=1000 {
        let x = f64::from(i) / 1000.0;
        for exponent in [0.0, 0.3, 1.0, 27.8, 100.0, 1.0e4] {
            let power = Fixed::new(x).powf(Fixed::exponent(exponent)).to_f64();
            assert!((power - x.powf(exponent)).abs() < 1.0 / 2700.0, "{x} {exponent}");
        }
    }
}

#[test]
fn lights_far_away_are_seen_in_their_direction() {
    for position in [[0.1, 0.2, -0.3], [5.0, -70.0, 100.0], [1.0e6, 1.0e5, 3.0]] {
        let far = Fixed::far_point(position);
        assert!(Fixed::is_usable_far(far));
        let from = Vec3::from_f64([0.5, -0.25, 0.125]);
        let towards = Fixed::towards(from, far).unit().unwrap().to_array().map(Real::to_f64);
        let [x, y, z] = position;
        let exact = glam::DVec3::new(x - 0.5, y + 0.25, z - 0.125).normalize();
        assert!((glam::DVec3::from_array(towards) - exact).length() < 8.0 * STEP, "{position:?}");
    }
    assert!(!Fixed::is_usable_far(Fixed::far_point([1.0e12, 0.0, 0.0])));
    assert!(!Fixed::is_usable_far(Fixed::far_point([f64::NAN, 0.0, 0.0])));
}

#[test]
fn whole_numbers_and_bytes_are_exact() {
    for (a, b, floor) in
        [(7, 2, 3), (-7, 2, -4), (6, 3, 2), (-6, 3, -2), (0, 5, 0), (1, 0, i32::MAX)]
    {
        let of = |i: i32| Fixed::from_bits(i);
        assert_eq!(of(a).floor_ratio(of(b)), floor, "{a} {b}");
    }
    for i in 0..=255 {
        assert_eq!(Fixed::fraction(i, 255).to_byte(), i as u8);
    }
    assert_eq!((Fixed::from_i32(-1).to_byte(), Fixed::from_i32(2).to_byte()), (0, 255));
}

#[test]
fn whole_quotients_and_roots_are_exact() {
    let mut random = Random(10);
    let mut any = || {
        let bits = (u64::from(random.within(0.0, 1.0).to_bits()) << 41)
            ^ (u64::from(random.within(0.0, 1.0).to_bits()) << 20)
            ^ u64::from(random.within(0.0, 1.0).to_bits());
        bits >> (random.within(0.0, 63.0) as u32)
    };
    let edges = [0, 1, 2, 3, 0xffff, 0x1_0000, 0x1_0001, u32::MAX, u32::MAX - 1, 1 << 31];
    for i in 0..200_000 {
        let d = edges.get(i).copied().unwrap_or_else(|| any() as u32);
        for n in [any(), u64::from(d) * 77, (u64::from(d) << 32).wrapping_sub(1)] {
            let exact = n.checked_div(d.into()).unwrap_or(u64::MAX).min(u32::MAX.into());
            assert_eq!(u64::from(quotient(n, d)), exact, "{n} {d}");
        }
    }
    for i in 0..400_000_u64 {
        let x = if i < 1000 { i } else { any() >> 1 };
        let root = x.isqrt();
        let nearest = root + u64::from(x - root * root > root);
        assert_eq!(u64::from(nearest_root(x)), nearest, "{x}");
    }
    for i in 0..400_000_u64 {
        let root = any() as u32 >> 1;
        let square = u64::from(root) * u64::from(root);
        assert_eq!(nearest_root(square + (i & 1)), root + u32::from(root == 0 && i & 1 == 1));
    }
    for digits in 1..32 {
        for x in [0, 1, -1, i64::MAX, i64::MIN, i64::from(i32::MAX) << digits, (1 << 31) << digits]
        {
            let exact = (x >> digits).clamp(-i64::from(i32::MAX) - 1, i32::MAX.into());
            let found = i64::from(shifted(x, digits));
            assert!(
                found == exact || (exact < -i64::from(i32::MAX) && found == exact + 1),
                "{x} {digits}"
            );
        }
    }
}

#[test]
fn units_have_length_1_within_a_step_or_two() {
    let mut random = crate::shape::testing::Random(9);
    for up in 0..28 {
        for _ in 0..2_000 {
            let mut part =
                || ((random.within(-1.0, 1.0) * 16.0) as f64 / f64::from(1_u32 << up)) * 0.49;
            let v = Vec3::new(Fixed::new(part()), Fixed::new(part()), Fixed::new(part()));
            let Some(unit) = v.unit() else {
                assert_eq!(v, Vec3::default());
                continue;
            };
            let exact = v.to_array().map(Fixed::to_f64);
            let length = exact.iter().map(|x| x * x).sum::<f64>().sqrt();
            for (x, u) in exact.iter().zip(unit.to_array()) {
                assert!(
                    (x / length - u.to_f64()).abs() < 1.1 / f64::from(1 << 28),
                    "{v:?} {unit:?}"
                );
            }
        }
    }
    let ends = Fixed::from_i32(7);
    for v in [[-ends, -ends, -ends], [Fixed::ONE, Fixed::ZERO, Fixed::ZERO], [-Fixed::EPSILON; 3]] {
        let unit = Vec3::from_array(v).unit().unwrap();
        let off = (unit.dot(unit).to_num::<f64>() - 1.0).abs();
        assert!(off < 4.0 / f64::from(1 << 28), "{v:?} {off}");
    }
}

/// What is computed in another way where products are short is tested here, too.
#[test]
fn halves_give_the_same_bits() {
    let mut random = Random(21);
    let edges = [0, 1, -1, 0xffff, 0x1_0000, -0x1_0000, i32::MAX, i32::MIN, i32::MIN + 1];
    let mut any =
        || random.within(-1.0, 1.0).to_bits() as i32 ^ (random.signed().to_bits() << 9) as i32;
    for i in 0..200_000 {
        let [a, b] = [i / edges.len(), i % edges.len()]
            .map(|i| edges.get(i).copied())
            .map(|x| x.unwrap_or_else(&mut any));
        assert_eq!(whole::of_halves(a, b), i64::from(a) * i64::from(b), "{a} {b}");
        let high = ((a as u32 as u64 * b as u32 as u64) >> 32) as u32;
        assert_eq!(whole::high_of_halves(a as u32, b as u32), high, "{a} {b}");
        let x = (i64::from(a) << 32 | i64::from(b as u32)) as u64 >> (i % 64);
        if x != 0 {
            assert_eq!(whole::zeros_by_halves(x), x.leading_zeros(), "{x}");
        }
    }
}

#[test]
fn reciprocal_roots_and_powers_are_off_by_a_few_steps() {
    let mut off = [0.0_f64; 2];
    for i in (1_u64 << 30..1 << 32).step_by(4_111).chain(1 << 30..(1 << 30) + 9_999) {
        let exact = 2.0_f64.powi(47) / (i as f64).sqrt();
        let error = f64::from(whole::reciprocal_root(i as u32)) - exact;
        off = [off[0].min(error), off[1].max(error)];
    }
    assert!(off[0] >= -3.0 && off[1] <= 3.0, "{off:?}");
    for n in [0, 1, 2, 3, 8, 27, 32, 64] {
        for i in 0..=10_000 {
            let base = Fixed::fraction(i, 10_000);
            let power = f64::from(whole_power(base.to_bits() as u32, n)) * STEP;
            let exact = base.to_f64().powi(n as i32);
            assert!((power - exact).abs() <= 4.5 * STEP, "{i} {n}: {power} {exact}");
        }
    }
}

#[test]
fn points_of_rays_are_the_same_by_every_way() {
    let mut random = Random(22);
    for _ in 0..200_000 {
        let [origin, direction] = [(); 2].map(|()| {
            let v = random.vector();
            Vec3::from_f64([v.x, v.y, v.z].map(|x| f64::from(x) * 1.9))
        });
        let (t, reach) = (any(&mut random, 7.9), origin.max_abs());
        assert_eq!(Fixed::along(origin, direction, t, reach), Fixed::at(origin, direction, t));
        let Some(unit) = direction.unit() else { continue };
        let error = Fixed::ulps(16);
        assert_eq!(Fixed::beside(origin, unit, error, reach), Fixed::at(origin, unit, error));
    }
}

#[test]
fn products_of_vectors_are_the_nearest_numbers_in_range_or_not() {
    let mut random = Random(27);
    for i in 0..200_000 {
        let most = [0.9, 1.99, 2.01, 3.99, 7.9][i % 5];
        let mut any = || any(&mut random, most);
        let [p, v, w] = [(); 3].map(|()| Vec3::new(any(), any(), any()));
        let t = any();
        let nearest = |p: Fixed, a: Fixed, b: Fixed| {
            let [p, a, b] = [p, a, b].map(|x| i64::from(x.to_bits()));
            Fixed::saturated(((p << DIGITS) + a * b + (1 << (DIGITS - 1))) >> DIGITS)
        };
        assert_eq!(p.at(v, t), p.zip(v, |p, v| nearest(p, v, t)));
        assert_eq!(v * t, v.map(|v| nearest(Fixed::ZERO, v, t)));
        assert_eq!(v.scale(w), v.zip(w, |v, w| nearest(Fixed::ZERO, v, w)));
    }
}

#[test]
fn no_sphere_that_is_met_is_passed_by() {
    let mut random = Random(23);
    let (mut told, mut passed) = ([0; 2], 0);
    for i in 0..300_000 {
        let mut place = |most: f64| {
            let v = random.vector();
            Vec3::from_f64([v.x, v.y, v.z].map(|x| f64::from(x) * most))
        };
        let (center, origin) = (place(0.5), place([0.25, 0.5, 1.0, 2.0][i % 4]));
        let Some(unit) = place(1.0).unit() else { continue };
        // Aimed at a place within twice the radius of the centre, or anywhere.
        let radius = Fixed::new(random.within(0.02, 0.5).into());
        let aim = center + unit * (radius + radius);
        let towards = center - origin;
        let direction = if i % 3 == 0 { unit } else { (aim - origin).unit().unwrap_or(unit) };
        let [x, y, z] = towards.to_array().map(Fixed::to_bits);
        let met = chord::chord(x, y, z, direction, Fixed::ONE, radius, -Fixed::INFINITY).is_some();
        let (passes, short) = chord::both(direction, origin.max_abs(), towards, radius);
        assert!(!(met && (passes || short)), "{origin:?} {direction:?} {center:?} {radius:?}");
        passed += u32::from(!met);
        told[0] += u32::from(passes);
        told[1] += u32::from(short);
    }
    // Of those passed by, nearly all are told.
    assert!(told[0] * 100 > passed * 99 && told[1] * 100 > passed * 90, "{told:?} of {passed}");
}

#[test]
fn roots_next_to_powers_of_two_and_lengths_of_units_are_right() {
    let mut random = Random(25);
    for digits in 2..63 {
        for i in 0..4_000_u64 {
            let away = if i < 2_000 { i } else { (random.within(0.0, 1.0) * 1e6) as u64 * i };
            for x in [(1_u64 << digits).saturating_sub(away), (1_u64 << digits) + away] {
                let root = x.isqrt();
                let nearest = root + u64::from(x - root * root > root);
                assert_eq!(u64::from(nearest_root(x)), nearest, "{x}");
            }
        }
    }
    for _ in 0..300_000 {
        let v = random.vector();
        let Some(unit) = Vec3::from_f64([v.x, v.y, v.z].map(f64::from)).unit() else { continue };
        assert!((unit.length() - Fixed::ONE).abs() <= Fixed::ulps(2), "{unit:?}");
    }
}
