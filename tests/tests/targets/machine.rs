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
    instr_per_pixel: u64,
    instr_per_nearest: u64,
    instr_per_any: u64,
    instr_build: u64,
}

/// The name of the firmware about a subject.
pub(crate) fn program<S: Subject>() -> String {
    S::NAME.into()
}

impl Machine {
    /// Finds them.
    pub(crate) fn tools(&self) -> Result<Tools, String> {
        let emulator = tools::find(self.emulator)?;
        Ok(Tools { cross: cross::Tools::find("ld.lld")?, emulator })
    }

    /// A program for this machine. All of them are built at once, the first time.
    fn elf(&self, tools: &Tools, program: &str) -> Result<PathBuf> {
        let kept = cross::target_dir().join(self.name);
        let built = self.built.get_or_init(|| {
            let build = || -> Result<()> {
                let (built, _guard) = cross::build(&tools.cross, "boards", self.target, self.name)?;
                fs::create_dir_all(&kept)?;
                for source in fs::read_dir(cross::source("boards/src/bin"))? {
                    let name = source?.path().with_extension("");
                    let name = name.file_name().context("a file name")?;
                    // Another machine's build for the same target replaces the original.
                    fs::copy(built.join(name), kept.join(name))?;
                }
                Ok(())
            };
            build().map_err(|error| format!("{error:#}"))
        });
        built.clone().map_err(Error::msg)?;
        Ok(kept.join(program))
    }

    /// Runs a program, and checks what holds for all of them. Gives what the program printed, and
    /// the row of the table with what it takes.
    fn report(&self, tools: &Tools, program: &str) -> Result<(Report, Row)> {
        let elf = self.elf(tools, program)?;
        let image = Image::read(&elf)?;
        image.allocates_nothing()?;
        image.formats_nothing()?;
        image.panics_nowhere()?;
        let (line, report) = run::report::<Report>(&mut self.emulate(tools, &elf))?;
        println!("{line}");
        fs::write(elf.with_extension("json"), line + "\n")?;
        let ran = [&report.target, &report.machine].map(String::as_str);
        ensure!(ran == [self.target, self.name], "ran {ran:?}");
        let row = Row::new(program, &report.structure, self.name)
            .with("image", &report.image_crc32)
            .with("flash", image.flash())
            .with("ram", image.ram())
            .with("stack", report.stack_bytes)
            .with("pixel", report.instr_per_pixel);
        Ok((report, row))
    }

    /// Runs the firmware about a subject, and compares.
    pub(crate) fn run<S: Subject>(&self, tools: &Tools) -> Result<()> {
        let (report, row) = self.report(tools, &program::<S>())?;
        let ran = [&report.scene, &report.structure].map(String::as_str);
        ensure!(ran == [S::NAME, S::Structure::NAME], "ran {ran:?}");
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
        let (report, row) = self.report(tools, "card_plain")?;
        let expected = host::plain_sum();
        ensure!(report.image_crc32 == expected, "{} instead of {expected}", report.image_crc32);
        row.check()
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
