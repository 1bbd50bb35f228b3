//! The emulated boards.

use crate::goldens::Row;
use crate::image::Image;
use crate::{cross, host, run, tools};
use anyhow::{Context, Error, Result, ensure};
use kibiray_scenes::{Structure, Subject};
use serde::Deserialize;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

/// A board and how it is emulated.
#[derive(Debug)]
pub(crate) struct Machine {
    /// Its name in QEMU.
    pub(crate) name: &'static str,
    target: &'static str,
    emulator: &'static str,
    options: &'static [&'static str],
    /// Whether its programs could be built, once that has been tried.
    built: OnceLock<Result<(), String>>,
}

/// Bytes of stack that are enough.
const STACK: u64 = 2048;

impl Machine {
    const fn new(
        name: &'static str,
        target: &'static str,
        emulator: &'static str,
        options: &'static [&'static str],
    ) -> Self {
        Self { name, target, emulator, options, built: OnceLock::new() }
    }
}

const ARM: &str = "qemu-system-arm";

/// All of them, from the smallest memory to the largest.
pub(crate) static ALL: [Machine; 5] = [
    Machine::new("microbit", "thumbv6m-none-eabi", ARM, &[]),
    Machine::new("lm3s6965evb", "thumbv7m-none-eabi", ARM, &[]),
    Machine::new("virt", "riscv32imc-unknown-none-elf", "qemu-system-riscv32", &["-bios", "none"]),
    Machine::new("netduinoplus2", "thumbv7em-none-eabihf", ARM, &[]),
    Machine::new("mps2-an386", "thumbv7em-none-eabihf", ARM, &[]),
];

/// What a run needs.
#[derive(Debug)]
pub(crate) struct Tools {
    cross: cross::Tools,
    emulator: PathBuf,
}

/// What a program prints.
#[derive(Deserialize)]
struct Report {
    scene: String,
    structure: String,
    target: String,
    machine: String,
    image_crc32: String,
    hits_crc32: String,
    stopped_by: String,
    arena: host::Memory,
    stack_bytes: u64,
    stack_capacity: u64,
    instr_per_pixel: u64,
    instr_per_nearest: u64,
    instr_per_any: u64,
    instr_build: u64,
}

/// A program that uses as little as there is to some purpose.
#[derive(Debug)]
pub(crate) struct Cost {
    name: &'static str,
    /// Which of the optional modules it uses.
    modules: &'static [&'static str],
}

impl Cost {
    /// The name of the firmware.
    pub(crate) fn program(&self) -> String {
        format!("cost_{}", self.name)
    }
}

/// Modules of the library that a program may go without.
const OPTIONAL: [[&str; 2]; 12] = [
    ["shape", "sphere"],
    ["shape", "triangle"],
    ["shape", "polygon"],
    ["shape", "cylinder"],
    ["shape", "cone"],
    ["shape", "plane"],
    ["accel", "naive"],
    ["accel", "grid"],
    ["accel", "octree"],
    ["accel", "bvh"],
    ["trace", "renderer"],
    ["scene", "camera"],
];

/// All of them.
pub(crate) static COSTS: [Cost; 8] = [
    Cost { name: "empty", modules: &[] },
    Cost { name: "spheres", modules: &["sphere", "naive"] },
    Cost { name: "triangles", modules: &["triangle", "naive"] },
    Cost { name: "spheres_grid", modules: &["sphere", "grid"] },
    Cost { name: "spheres_octree", modules: &["sphere", "octree"] },
    Cost { name: "spheres_bvh", modules: &["sphere", "bvh"] },
    Cost { name: "spheres_octree_shadows", modules: &["sphere", "octree", "renderer", "camera"] },
    Cost {
        name: "everything",
        modules: &[
            "sphere", "triangle", "polygon", "cylinder", "cone", "plane", "naive", "grid",
            "octree", "bvh", "renderer", "camera",
        ],
    },
];

/// The name of the firmware about a subject: where only rays are shot, they are shot through one
/// structure after the other.
pub(crate) fn program<S: Subject>() -> String {
    if S::SIZE.1 > 0 { S::NAME.into() } else { format!("{}_{}", S::NAME, S::Structure::NAME) }
}

impl Machine {
    /// Finds them.
    pub(crate) fn tools(&self) -> Result<Tools, String> {
        let emulator = tools::find(self.emulator)?;
        Ok(Tools { cross: cross::Tools::find("ld.lld")?, emulator })
    }

    /// Whether a program is run on this machine. What a part of the library takes in flash is asked
    /// for on the smallest core and on one with an FPU; the machine for large scenes has the same
    /// core, so figures of queries would be the same.
    pub(crate) fn runs(&self, program: &str) -> bool {
        let queries = ["spheres_", "triangles_"].iter().any(|prefix| program.starts_with(prefix));
        // 144 KiB of triangles, and a structure of 36 KiB: for flash and RAM of a larger board.
        let large = program.starts_with("knot_4096");
        match self.name {
            // A tree of 512 boxes takes 28 KiB.
            "microbit" => program != "spheres_tree" && !program.starts_with("knot_"),
            "netduinoplus2" => true,
            "mps2-an386" => !queries && !program.starts_with("cost_"),
            _ => !large && !program.starts_with("cost_"),
        }
    }

    /// The programs for this machine, by the names of their files.
    fn programs(&self) -> Result<Vec<String>> {
        let mut programs = Vec::new();
        for file in fs::read_dir(cross::source("boards/src/bin"))? {
            let name = file?.path();
            let name = name.file_stem().and_then(|name| name.to_str()).context("a file name")?;
            if self.runs(name) {
                programs.push(name.into());
            }
        }
        Ok(programs)
    }

    /// A program for this machine. All of them are built at once, the first time.
    fn elf(&self, tools: &Tools, program: &str) -> Result<PathBuf> {
        let kept = cross::target_dir().join(self.name);
        let built = self.built.get_or_init(|| {
            let build = || -> Result<()> {
                let (cross, programs) = (&tools.cross, self.programs()?);
                let (target, machine) = (self.target, self.name);
                let (built, _guard) =
                    cross::build_programs(cross, "boards", target, machine, &programs)?;
                fs::create_dir_all(&kept)?;
                for program in programs {
                    // Another machine's build for the same target replaces the original.
                    fs::copy(built.join(&program), kept.join(&program))?;
                }
                Ok(())
            };
            build().map_err(|error| format!("{error:#}"))
        });
        built.clone().map_err(Error::msg)?;
        Ok(kept.join(program))
    }

    /// A program and what is in it: for all of them holds what the library promises.
    fn image(&self, tools: &Tools, program: &str) -> Result<(PathBuf, Image)> {
        let elf = self.elf(tools, program)?;
        let image = Image::read(&elf)?;
        image.allocates_nothing()?;
        image.formats_nothing()?;
        image.panics_nowhere()?;
        Ok((elf, image))
    }

    /// Bytes of RAM, from the memory map that the linker goes by.
    fn memory(&self) -> Result<u64> {
        let map = cross::source("boards/memory").join(self.name).with_extension("x");
        let map = fs::read_to_string(map)?;
        let line = map.lines().find(|line| line.trim_start().starts_with("RAM "));
        let length = line.and_then(|line| Some(line.rsplit_once('=')?.1.trim()));
        let kib = length.and_then(|length| length.strip_suffix('K')).context("RAM in KiB")?;
        Ok(kib.parse::<u64>()? * 1024)
    }

    /// RAM part by part, as the device and the linker see it, adds up to what there is.
    fn adds_up(&self, report: &Report, statics: u64) -> Result<()> {
        let arena = report.arena.capacity as u64;
        let taken: usize = report.arena.parts.iter().map(|part| part.bytes).sum();
        let rest = arena - taken as u64;
        let other = statics.checked_sub(arena).context("the arena is a static")?;
        let parts = report.arena.parts.iter().map(|part| format!("{} {}", part.name, part.bytes));
        let parts = parts.collect::<Vec<_>>().join(", ");
        let (stack, all) = (report.stack_capacity, self.memory()?);
        println!(
            "{} on {}: {parts}, rest of the arena {rest}, other statics {other}, \
             for the stack {stack}: {all} bytes of RAM",
            report.scene, self.name
        );
        let sum = taken as u64 + rest + other + stack;
        ensure!(sum == all, "{sum} bytes of RAM are accounted for, of {all}");
        Ok(())
    }

    /// Runs a program, and checks what holds for all of them. Gives what the program printed, and
    /// the row of the table with what it takes.
    fn report(&self, tools: &Tools, program: &str) -> Result<(Report, Image, Row)> {
        let (elf, image) = self.image(tools, program)?;
        let (line, report) = run::report::<Report>(&mut self.emulate(tools, &elf))?;
        println!("{line}");
        fs::write(elf.with_extension("json"), line + "\n")?;
        let ran = [&report.target, &report.machine].map(String::as_str);
        ensure!(ran == [self.target, self.name], "ran {ran:?}");
        ensure!(report.stack_bytes <= STACK, "{} bytes of stack", report.stack_bytes);
        let row = Row::new(program, &report.structure, self.name)
            .with("flash", image.flash())
            .with("ram", image.ram())
            .with("stack", report.stack_bytes);
        let row = if report.instr_per_pixel == 0 {
            row
        } else {
            row.with("image", &report.image_crc32).with("pixel", report.instr_per_pixel)
        };
        Ok((report, image, row))
    }

    /// Runs the firmware about a subject, and compares.
    pub(crate) fn run<S: Subject>(&self, tools: &Tools) -> Result<()> {
        let (report, image, row) = self.report(tools, &program::<S>())?;
        let ran = [&report.scene, &report.structure].map(String::as_str);
        ensure!(ran == [S::NAME, S::Structure::NAME], "ran {ran:?}");
        self.adds_up(&report, image.ram())?;
        let expected = host::Sums::of_naive::<S>()?;
        let sums = [&report.image_crc32, &report.hits_crc32];
        ensure!(sums == [&expected.image, &expected.hits], "{sums:?} instead of {expected:?}");
        let arena = host::arena::<S>(report.arena.capacity)?;
        let stopped_by = (&report.arena, report.stopped_by.as_str());
        ensure!(stopped_by == (&arena.0, arena.1), "{stopped_by:?} instead of {arena:?}");
        row.with("hits", report.hits_crc32)
            .with("nearest", report.instr_per_nearest)
            .with("any", report.instr_per_any)
            .with("build", report.instr_build)
            .with("kept", report.arena.used)
            .with("peak", report.arena.high_water)
            .check()
    }

    /// Runs the plain program.
    pub(crate) fn run_plain(&self, tools: &Tools) -> Result<()> {
        let (report, _, row) = self.report(tools, "card_plain")?;
        let expected = host::plain_sum();
        ensure!(report.image_crc32 == expected, "{} instead of {expected}", report.image_crc32);
        row.check()
    }

    /// Runs the least program that uses some modules; of the others that programs may go without,
    /// there is no code in it.
    pub(crate) fn run_cost(&self, tools: &Tools, cost: &Cost) -> Result<()> {
        let program = cost.program();
        let (elf, image) = self.image(tools, &program)?;
        for path in OPTIONAL {
            let expected = cost.modules.contains(&path[1]);
            ensure!(image.has_code_of(path) == expected, "code of {path:?}: {}", !expected);
        }
        let limit = Duration::from_secs(60);
        let (status, text) = run::within(limit, &mut self.emulate(tools, &elf))?;
        ensure!(status.success() && text.is_empty(), "{status}: {text}");
        Row::new(&program, "-", self.name)
            .with("flash", image.flash())
            .with("ram", image.ram())
            .check()
    }

    fn emulate(&self, tools: &Tools, elf: &std::path::Path) -> Command {
        let mut command = Command::new(&tools.emulator);
        command
            .args(["-M", self.name])
            .args(self.options)
            // An instruction takes a nanosecond, so that the machine's timers count instructions.
            .args(["-nographic", "-icount", "shift=0"])
            .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
            .arg(elf);
        command
    }
}
