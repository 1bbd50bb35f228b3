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
    build: Build,
}

/// Where a scene comes from.
#[derive(Clone, Copy, Debug)]
enum Build {
    Code(fn() -> Description),
    /// The text of a file in `host-sim/scenes`.
    Nff(&'static str),
}

impl Demo {
    /// The file that it was read from.
    pub fn text(&self) -> Option<&'static str> {
        match self.build {
            Build::Code(_) => None,
            Build::Nff(text) => Some(text),
        }
    }

    /// The scene.
    pub fn describe(&self) -> Description {
        let description = match self.build {
            Build::Code(build) => build(),
            Build::Nff(text) => super::nff::parse(text).unwrap_or_default(),
        };
        Description { name: self.name.into(), ..description }
    }
}

static DEMOS: &[Demo] = &[
    Demo {
        name: DEFAULT,
        about: "every kind of shape on a terrace by the sea; fits 64KiB",
        build: Build::Code(still_life::build),
    },
    Demo {
        name: "helix",
        about: "a double helix over a mirror; fits 32KiB",
        build: Build::Code(helix::build),
    },
    Demo {
        name: "room",
        about: "a room with a mirror and a glass ball; needs no structure, so no memory",
        build: Build::Code(room::build),
    },
    Demo {
        name: "carved",
        about: "a cube and a ball without three cylinders; host-sim/scenes/carved.nff",
        build: Build::Nff(include_str!("../../../scenes/carved.nff")),
    },
    Demo {
        name: "dice",
        about: "two dice and a magnifying glass; host-sim/scenes/dice.nff",
        build: Build::Nff(include_str!("../../../scenes/dice.nff")),
    },
    Demo {
        name: "chess",
        about: "king, bishop, rook and pawns on a board; host-sim/scenes/chess.nff",
        build: Build::Nff(include_str!("../../../scenes/chess.nff")),
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
