//! A view, a light and a background for descriptions that have none.

use crate::description::solids::Step;
use crate::description::{Description, Light, Solid, Triple, View};

/// The description's view; without one a view of everything from the front right, a little above.
pub fn of(description: &Description) -> View {
    if let Some(view) = description.view {
        return view;
    }
    let (lo, hi) = bounds(description);
    let middle = std::array::from_fn(|i| (lo[i] + hi[i]) / 2.0);
    let half: Triple = std::array::from_fn(|i| (hi[i] - lo[i]) / 2.0);
    let radius = length(half).max(1e-3);
    let angle: f64 = 40.0;
    let towards = [0.55, 0.4, 1.0];
    let distance = radius / (angle.to_radians() / 2.0).sin() / length(towards);
    let from = std::array::from_fn(|i| middle[i] + towards[i] * distance);
    View {
        from,
        at: middle,
        up: [0.0, 1.0, 0.0],
        angle,
        hither: radius / 1000.0,
        resolution: [512, 512],
    }
}

/// The description's lights; without any, one above and to the left of the eye.
pub fn lights_of(description: &Description, view: &View) -> Vec<Light> {
    if !description.lights.is_empty() {
        return description.lights.clone();
    }
    let forward: Triple = std::array::from_fn(|i| view.at[i] - view.from[i]);
    let up = view.up.map(|u| u / length(view.up).max(f64::MIN_POSITIVE));
    let [(fx, fy, fz), (ux, uy, uz)] = [forward, up].map(|[x, y, z]| (x, y, z));
    let right = [fy * uz - fz * uy, fz * ux - fx * uz, fx * uy - fy * ux];
    let far = length(forward);
    let position = std::array::from_fn(|i| view.from[i] + 0.2 * far * up[i] - 0.1 * right[i]);
    vec![Light { position, color: None }]
}

/// The description's background; a dark blue where neither it nor a view is given, so that
/// outlines show.
pub fn background_of(description: &Description) -> Triple {
    let chosen = description.view.is_none() && description.background == [0.0; 3];
    if chosen { [0.10, 0.13, 0.18] } else { description.background }
}

fn length(v: Triple) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The box around all corners and spheres; cones by their ends, planes left out.
pub fn bounds(description: &Description) -> (Triple, Triple) {
    let mut lo = [f64::INFINITY; 3];
    let mut hi = [f64::NEG_INFINITY; 3];
    let mut include = |p: &Triple, radius: f64| {
        for i in 0..3 {
            lo[i] = lo[i].min(p[i] - radius);
            hi[i] = hi[i].max(p[i] + radius);
        }
    };
    for item in &description.items {
        match &item.solid {
            Solid::Sphere { center, radius } => include(center, *radius),
            Solid::Cone { base, base_radius, apex, apex_radius, .. } => {
                include(base, *base_radius);
                include(apex, *apex_radius);
            }
            Solid::Polygon { vertices, .. } | Solid::Fan { vertices, .. } => {
                vertices.iter().for_each(|v| include(v, 0.0));
            }
            Solid::Box { lo, hi } => {
                include(lo, 0.0);
                include(hi, 0.0);
            }
            Solid::Plane { .. } => {}
            Solid::Csg { steps } => steps.iter().for_each(|step| {
                if let Step::Part(part) = step {
                    part.corners().iter().for_each(|corner| include(corner, 0.0));
                }
            }),
        }
    }
    if lo[0] <= hi[0] { (lo, hi) } else { ([-1.0; 3], [1.0; 3]) }
}
