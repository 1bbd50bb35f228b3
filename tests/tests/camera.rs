//! Guards that a view that shows nothing is refused, and every other one is not.

use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Camera, View, ViewError};

fn v<R: Real>(x: f64, y: f64, z: f64) -> Vec3<R> {
    Vec3::<R>::from_f64([x, y, z])
}

/// Up along the line of sight has no picture, whichever way both point and however long they are.
fn parallel<R: Real>() {
    let mut rng = fastrand::Rng::with_seed(5);
    let mut signed = |scale: f64| (rng.f64() * 2.0 - 1.0) * scale;
    let half = R::HALF;
    for i in 0..10_000 {
        let d = [signed(1.0), signed(1.0), signed(1.0)];
        // From the origin, the line of sight is that vector in full; from elsewhere it is rounded.
        let away = if i % 2 == 0 { 0.0 } else { 4.0 };
        let from = Vec3::<R>::from_f64([signed(away), signed(away), signed(away)]);
        let at = from + Vec3::<R>::from_f64(d);
        let scale = R::from_f64(10.0_f64.powf(signed(9.0)) * signed(1.0).signum());
        let view = View { from, at, up: (at - from) * scale, angle: half };
        assert_eq!(Camera::new(&view, R::ONE), Err(ViewError), "{view:?}");
        // A thousandth beside it there is one.
        let across = (at - from).cross(v::<R>(0.3, 0.5, 0.8));
        let view = View { up: (at - from) + across * R::from_f64(1.0e-3), ..view };
        assert!(Camera::new(&view, R::ONE).is_ok(), "{view:?}");
    }
}

#[test]
fn a_view_along_its_up_is_refused() {
    parallel::<f32>();
    parallel::<f64>();
}

fn angles<R: Real>() {
    let pi = std::f64::consts::PI;
    let view = |angle| View {
        from: v::<R>(1.0, 2.0, 3.0),
        at: v::<R>(0.0, 0.0, 0.0),
        up: v::<R>(0.0, 1.0, 0.0),
        angle,
    };
    let nan = R::from_f64(f64::NAN);
    let refused =
        [0.0, -0.0, -1.0e-30, -0.5, -pi, -4.0, -7.0, pi, 3.2, 4.0, 6.0, 6.5, 7.0, 9.5, 1.0e9];
    for angle in refused.map(R::from_f64).into_iter().chain([nan, R::INFINITY, -R::INFINITY]) {
        assert_eq!(Camera::new(&view(angle), R::ONE), Err(ViewError), "{angle:?}");
    }
    for angle in [1.0e-3, 0.5, 1.0, 1.57, 2.0, 3.0, 3.125] {
        let camera = Camera::new(&view(R::from_f64(angle)), R::ONE).unwrap();
        // Along the upper edge it looks half the angle upwards.
        let (middle, edge) = (camera.ray(R::ZERO, R::ZERO), camera.ray(R::ZERO, R::ONE));
        let [middle, edge] = [middle, edge].map(|ray| ray.unwrap().direction());
        let tangent = R::narrow((edge - middle).dot(edge - middle)).sqrt() / middle.length();
        let expected = (angle / 2.0).tan();
        // Half an angle near 90° is off by a rounding of 2^-24, and its tangent by that times
        // 1 + tan².
        let bound = R::EPSILON.to_f64() * 8.0 * (1.0 + expected * expected);
        assert!((tangent.to_f64() - expected).abs() <= bound, "{angle}");
    }
}

#[test]
fn angles_of_view_are_between_0_and_pi() {
    angles::<f32>();
    angles::<f64>();
}
