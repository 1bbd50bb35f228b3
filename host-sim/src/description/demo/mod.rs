//! Scenes to look at, built in. The z axis points up.

mod canvas;
mod helix;
mod room;
mod still_life;

use super::Description;

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

static DEMOS: &[Demo] = &[
    Demo {
        name: DEFAULT,
        about: "every kind of shape on a terrace by the sea; fits 64KiB",
        build: still_life::build,
    },
    Demo { name: "helix", about: "a double helix over a mirror; fits 32KiB", build: helix::build },
    Demo {
        name: "room",
        about: "a room with a mirror and a glass ball; needs no structure, so no memory",
        build: room::build,
    },
];

/// All of them.
pub fn all() -> &'static [Demo] {
    DEMOS
}

/// The scene of this name.
pub fn find(name: &str) -> Option<&'static Demo> {
    DEMOS.iter().find(|demo| demo.name == name)
}
