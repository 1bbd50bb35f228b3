//! Signs of polynomials in numbers of a scene and a ray, decided by whole numbers of any length.
//!
//! Every number of every type here is a whole multiple of a power of two. All that go into a
//! decision are brought to a common one; the decisions are homogeneous, so the power does not matter.

use num_bigint::BigInt;
use num_bigint::Sign;

/// Numbers as multiples of their least power of two.
pub fn whole<const N: usize>(numbers: [f64; N]) -> [BigInt; N] {
    let parts = numbers.map(|x| {
        assert!(x.is_finite());
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32;
        let fraction = bits & ((1 << 52) - 1);
        let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 52 };
        (x < 0.0, mantissa, exponent.max(1))
    });
    let least = parts.iter().filter(|p| p.1 != 0).map(|p| p.2).min().unwrap_or(0);
    parts.map(|(negative, mantissa, exponent)| {
        let n = BigInt::from(mantissa) << (exponent - least).max(0) as usize;
        if negative { -n } else { n }
    })
}

fn cross(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

fn dot(a: &[BigInt; 3], b: &[BigInt; 3]) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn sub(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

/// The points together on one scale.
fn points<const N: usize>(points: [[f64; 3]; N]) -> [[BigInt; 3]; N] {
    let mut numbers = [0.0; 16];
    let flat = points.as_flattened();
    numbers[..flat.len()].copy_from_slice(flat);
    let whole = whole(numbers);
    std::array::from_fn(|i| std::array::from_fn(|a| whole[3 * i + a].clone()))
}

/// Whether the line through a point meets a closed triangle, edges and corners included; `None`
/// when it runs in its plane.
pub fn meets_triangle(o: [f64; 3], d: [f64; 3], corners: [[f64; 3]; 3]) -> Option<bool> {
    let [o, a, b, c] = points([o, corners[0], corners[1], corners[2]]);
    let [d] = points([d]);
    let [a, b, c] = [sub(&a, &o), sub(&b, &o), sub(&c, &o)];
    let signs = [(&b, &c), (&c, &a), (&a, &b)].map(|(p, q)| dot(&d, &cross(p, q)).sign());
    if signs.iter().all(|s| *s == Sign::NoSign) {
        return None;
    }
    Some(!(signs.contains(&Sign::Plus) && signs.contains(&Sign::Minus)))
}

/// Whether the line through a point meets or touches a ball.
pub fn meets_ball(o: [f64; 3], d: [f64; 3], center: [f64; 3], radius: f64) -> bool {
    let [o, c, [r, _, _]] = points([o, center, [radius, 0.0, 0.0]]);
    let [d] = points([d]);
    let across = cross(&sub(&c, &o), &d);
    // |f x d| <= r |d|
    dot(&across, &across) <= &r * &r * dot(&d, &d)
}

/// Whether the line through a point meets or touches a closed box.
pub fn meets_box(o: [f64; 3], d: [f64; 3], lo: [f64; 3], hi: [f64; 3]) -> bool {
    let [o, lo, hi] = points([o, lo, hi]);
    let [d] = points([d]);
    // Entered through one face before it is left through another: fractions with denominators d,
    // compared crosswise.
    let zero = BigInt::from(0);
    let mut enters = Vec::new();
    let mut leaves = Vec::new();
    for a in 0..3 {
        if d[a] == zero {
            if o[a] < lo[a] || o[a] > hi[a] {
                return false;
            }
            continue;
        }
        let (lo, hi) = (&lo[a] - &o[a], &hi[a] - &o[a]);
        let (near, far) = if d[a] > zero { (lo, hi) } else { (-hi, -lo) };
        let along = if d[a] > zero { d[a].clone() } else { -&d[a] };
        enters.push((near, along.clone()));
        leaves.push((far, along));
    }
    enters.iter().all(|(n, a)| leaves.iter().all(|(f, b)| n * b <= f * a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_is_meeting_and_a_last_bit_beside_is_not() {
        let (o, z) = ([0.0, 0.0, -5.0], [0.0, 0.0, 1.0]);
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(meets_triangle(o, z, corners), Some(true));
        assert_eq!(meets_triangle([-f64::MIN_POSITIVE, 0.0, -5.0], z, corners), Some(false));
        assert_eq!(meets_triangle([0.2, 0.2, 0.0], [1.0, 0.0, 0.0], corners), None);
        assert!(meets_ball([1.0, 0.0, -5.0], z, [0.0; 3], 1.0));
        assert!(!meets_ball([1.0 + f64::EPSILON, 0.0, -5.0], z, [0.0; 3], 1.0));
        assert!(meets_box([1.0, 1.0, -5.0], z, [-1.0; 3], [1.0; 3]));
        assert!(!meets_box([1.0 + f64::EPSILON, 1.0, -5.0], z, [-1.0; 3], [1.0; 3]));
        // Through an edge, aslant.
        assert!(meets_box([2.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0; 3], [1.0; 3]));
        let beside = [2.0 + 2.0 * f64::EPSILON, 0.0, 0.0];
        assert!(!meets_box(beside, [-1.0, 1.0, 0.0], [-1.0; 3], [1.0; 3]));
    }
}
