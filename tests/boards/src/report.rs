//! The line of JSON that a program prints.

use crate::console::Console;
use crate::{machine, stack};
use kibiray::accel::octree::StoppedBy;
use kibiray::memory::Part;
use semihosting::process;

/// What is known once the structure is built.
#[derive(Clone, Copy, Debug)]
pub struct Building<'a> {
    /// The subject's name.
    pub scene: &'static str,
    /// The structure's.
    pub structure: &'static str,
    /// Why the octree is not finer.
    pub stopped_by: StoppedBy,
    /// Memory.
    pub arena: ArenaUse<'a>,
    /// Instructions for it.
    pub instructions: u64,
}

/// What is known of the arena after that.
#[derive(Clone, Copy, Debug, Default)]
pub struct ArenaUse<'a> {
    /// Its bytes.
    pub capacity: usize,
    /// Bytes that are taken.
    pub used: usize,
    /// Most bytes that were taken.
    pub high_water: usize,
    /// What for.
    pub parts: &'a [Part],
}

/// A JSON object that is being written.
#[derive(Debug)]
struct Object(Console);

impl Object {
    /// Writes `name": ` with what has to stand before it.
    fn key(&mut self, name: &str) {
        self.0.text(",\"");
        self.0.text(name);
        self.0.text("\":");
    }

    fn number(&mut self, name: &str, number: u64) {
        self.key(name);
        self.0.number(number);
    }

    fn text(&mut self, name: &str, text: &str) {
        self.key(name);
        self.quoted(text);
    }

    fn quoted(&mut self, text: &str) {
        self.0.text("\"");
        self.0.text(text);
        self.0.text("\"");
    }

    fn sum(&mut self, name: &str, sum: u32) {
        self.key(name);
        self.0.text("\"");
        self.0.hex(sum);
        self.0.text("\"");
    }
}

/// The line, of which the first part is printed. It is printed as things come to be known, so that
/// nothing stays on the stack only to be told.
#[derive(Debug)]
pub struct Report(Object);

impl Report {
    /// Prints the first part.
    #[inline(never)]
    pub fn begin(building: &Building<'_>) -> Self {
        let mut json = begin(building.scene);
        json.text("structure", building.structure);
        let stopped_by = match building.stopped_by {
            StoppedBy::Done => "done",
            StoppedBy::Level => "level",
            StoppedBy::Memory => "memory",
        };
        json.text("stopped_by", stopped_by);
        json.key("arena");
        let arena = &building.arena;
        json.0.text("{\"capacity\":");
        json.0.number(arena.capacity as u64);
        json.number("used", arena.used as u64);
        json.number("high_water", arena.high_water as u64);
        json.key("parts");
        let mut before = "[{\"name\":";
        for part in arena.parts {
            json.0.text(before);
            json.quoted(part.name);
            json.number("bytes", part.bytes as u64);
            before = "},{\"name\":";
        }
        json.0.text(if arena.parts.is_empty() { "[]}" } else { "}]}" });
        json.number("instr_build", building.instructions);
        Self(json)
    }

    /// Prints the checksum of the picture, and instructions per pixel, rounded down.
    #[inline(never)]
    pub fn picture(&mut self, crc32: u32, per_pixel: u64) {
        self.0.sum("image_crc32", crc32);
        self.0.number("instr_per_pixel", per_pixel);
    }

    /// Prints the checksum of the answers to ray queries, and instructions per ray for its nearest
    /// hit and for any hit, rounded down.
    #[inline(never)]
    pub fn queries(&mut self, crc32: u32, per_nearest: u64, per_any: u64) {
        self.0.sum("hits_crc32", crc32);
        self.0.number("instr_per_nearest", per_nearest);
        self.0.number("instr_per_any", per_any);
    }

    /// Prints the most bytes of stack, and the end.
    #[inline(never)]
    pub fn end(&mut self) {
        let stack = match stack::checked() {
            Ok(bytes) => bytes,
            Err(what) => self.fail(what),
        };
        self.0.number("stack_bytes", stack as u64);
        self.0.number("stack_capacity", stack::capacity() as u64);
        self.0.0.text("}\n");
    }

    /// Prints what went wrong instead, and ends the program.
    #[inline(never)]
    pub fn fail(&mut self, what: &str) -> ! {
        self.0.text("error", what);
        self.0.0.text("}\n");
        process::exit(1)
    }
}

fn begin(scene: &str) -> Object {
    let mut json = Object(Console::open());
    json.0.text("{\"scene\":");
    json.quoted(scene);
    json.text("target", machine::TARGET);
    json.text("machine", machine::NAME);
    json
}

/// Prints what went wrong and ends the program with a status.
#[inline(never)]
pub fn fail(what: &str, status: i32) -> ! {
    let mut json = begin("");
    json.text("error", what);
    json.0.text("}\n");
    process::exit(status)
}
