//! Scenes to look at, built in.

use super::{Description, Item, Light, Material, Solid, View};

/// The scene that is rendered when none is named.
pub const DEFAULT: &str = "still-life";

/// A built-in scene.
#[derive(Clone, Copy, Debug)]
pub struct Demo {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub about: &'static str,
    build: fn() -> Description,
}

impl Demo {
    /// The scene.
    pub fn describe(&self) -> Description {
        Description { name: self.name.into(), ..(self.build)() }
    }
}

/// All of them.
pub fn all() -> &'static [Demo] {
    &[Demo { name: DEFAULT, about: "one of every shape", build: still_life }]
}

/// The scene of this name.
pub fn find(name: &str) -> Option<&'static Demo> {
    all().iter().find(|demo| demo.name == name)
}

fn still_life() -> Description {
    Description {
        background: [0.2, 0.3, 0.5],
        view: Some(View {
            from: [0.0, -5.0, 2.0],
            at: [0.0, 0.0, 0.5],
            up: [0.0, 0.0, 1.0],
            angle: 40.0,
            hither: 0.1,
            resolution: [640, 480],
        }),
        lights: vec![Light { position: [5.0, -5.0, 5.0], color: None }],
        materials: vec![Material {
            color: [0.8, 0.3, 0.2],
            diffuse: 0.8,
            specular: 0.1,
            shine: 20.0,
            transmission: 0.0,
            index: 1.0,
        }],
        items: vec![Item {
            material: 0,
            solid: Solid::Sphere { center: [0.0, 0.0, 0.5], radius: 0.5 },
        }],
        ..Description::default()
    }
}
