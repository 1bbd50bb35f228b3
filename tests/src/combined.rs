//! Scenes of combined solids.

use std::fmt::Write;

use kibiray_host_sim::description::load::load;
use kibiray_host_sim::description::{Description, nff};

/// Built-in scenes of combined solids.
pub const SHOWPIECES: [&str; 3] = ["carved", "dice", "chess"];

/// Many small objects of every operator, kind of part and map.
fn crowd() -> Description {
    let mut rng = fastrand::Rng::with_seed(1977);
    let mut text = String::new();
    for i in 0..300 {
        let mut at = || rng.f64() * 12.0 - 6.0;
        let (x, y, z) = (at(), at(), at());
        let (turn, scale) = (rng.f64() * 360.0, 0.3 + rng.f64() * 0.5);
        let operator = ["union", "intersection", "difference"][i % 3];
        let first = ["box -1 -1 -1 1 1 1", "s 0 0 0 1.2", "cone 0 0 -1 1 0 0 1 0.5"][i / 3 % 3];
        let second = [
            "cone -2 0 0 0.6 2 0 0 0.6",
            "scale 1 1 2 s 0 0 0 0.7 end",
            "rotate 1 1 1 40 box -0.5 -0.5 -2 0.5 0.5 2 end",
            "polyhedron 4 0 0 -1.1 0 0 -1  1 1 1 1 1 1  -1 0 0 -1 0.2 0  0 -1 0 0 -1 0.3",
        ][i / 9 % 4];
        write!(
            text,
            "translate {x} {y} {z} rotate 1 2 3 {turn} scale {scale} {scale} {scale}\n{operator}\n\
             {first}\n{second}\ndifference s 0.5 0 0.5 0.8 halfspace 0 0 0.4 0 0.3 -1 end\nend\n\
             end end end\ns {y} {z} {x} 0.2\n"
        )
        .unwrap();
    }
    nff::parse(&text).unwrap()
}

/// The showpieces and a crowd of small objects.
pub fn combined_scenes() -> Vec<(&'static str, Description)> {
    let mut all: Vec<_> = SHOWPIECES.iter().map(|name| (*name, load(name).unwrap())).collect();
    all.push(("crowd", crowd()));
    all
}
