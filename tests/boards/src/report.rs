//! The line of JSON that a program prints.

use crate::console::Console;
use crate::{machine, stack};
use kibiray::accel::octree::StoppedBy;
use kibiray::memory::Part;
use semihosting::process;

/// What is known of the arena after a run.
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

/// The results of a run.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The subject's name.
    pub scene: &'static str,
    /// The structure's.
    pub structure: &'static str,
    /// Checksum of the picture.
    pub image_crc32: u32,
    /// Checksum of the answers to ray queries.
    pub hits_crc32: u32,
    /// Why the octree is not finer.
    pub stopped_by: StoppedBy,
    /// Memory.
    pub arena: ArenaUse<'a>,
    /// Most bytes of stack.
    pub stack: usize,
    /// Instructions for the building of the structure.
    pub build: u64,
    /// Instructions per pixel, rounded down.
    pub per_pixel: u64,
    /// Instructions per ray for its nearest hit, rounded down.
    pub per_nearest: u64,
    /// Instructions per ray for any hit, rounded down.
    pub per_any: u64,
}

/// A JSON object that is being written.
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

/// Prints the line.
#[inline(never)]
pub fn print(report: &Report<'_>) {
    let mut json = begin(report.scene);
    json.text("structure", report.structure);
    json.sum("image_crc32", report.image_crc32);
    json.sum("hits_crc32", report.hits_crc32);
    let stopped_by = match report.stopped_by {
        StoppedBy::Done => "done",
        StoppedBy::Level => "level",
        StoppedBy::Memory => "memory",
    };
    json.text("stopped_by", stopped_by);
    json.key("arena");
    json.0.text("{\"capacity\":");
    json.0.number(report.arena.capacity as u64);
    json.number("used", report.arena.used as u64);
    json.number("high_water", report.arena.high_water as u64);
    json.key("parts");
    let mut before = "[{\"name\":";
    for part in report.arena.parts {
        json.0.text(before);
        json.quoted(part.name);
        json.number("bytes", part.bytes as u64);
        before = "},{\"name\":";
    }
    json.0.text(if report.arena.parts.is_empty() { "[]}" } else { "}]}" });
    json.number("stack_bytes", report.stack as u64);
    json.number("stack_capacity", stack::capacity() as u64);
    json.number("instr_per_pixel", report.per_pixel);
    json.number("instr_per_nearest", report.per_nearest);
    json.number("instr_per_any", report.per_any);
    json.number("instr_build", report.build);
    json.0.text("}\n");
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
