//! The emulated boards.

use crate::image::Image;
use crate::{cross, host, run, tools};
use anyhow::{Result, ensure};
use kibiray_scenes::Subject;
use serde::Deserialize;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// A board and how it is emulated.
#[derive(Debug)]
pub(crate) struct Machine {
    /// Its name in QEMU.
    pub(crate) name: &'static str,
    target: &'static str,
    emulator: &'static str,
    options: &'static [&'static str],
}

const ARM: &str = "qemu-system-arm";

/// All of them, from the smallest memory to the largest.
pub(crate) static ALL: [Machine; 5] = [
    Machine { name: "microbit", target: "thumbv6m-none-eabi", emulator: ARM, options: &[] },
    Machine { name: "lm3s6965evb", target: "thumbv7m-none-eabi", emulator: ARM, options: &[] },
    Machine {
        name: "virt",
        target: "riscv32imc-unknown-none-elf",
        emulator: "qemu-system-riscv32",
        options: &["-bios", "none"],
    },
    Machine { name: "netduinoplus2", target: "thumbv7em-none-eabihf", emulator: ARM, options: &[] },
    Machine { name: "mps2-an386", target: "thumbv7em-none-eabihf", emulator: ARM, options: &[] },
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
    target: String,
    machine: String,
    image_crc32: String,
    hits_crc32: String,
    stopped_by: String,
    arena: host::Memory,
}

impl Machine {
    /// Finds them.
    pub(crate) fn tools(&self) -> Result<Tools, String> {
        let emulator = tools::find(self.emulator)?;
        Ok(Tools { cross: cross::Tools::find("ld.lld")?, emulator })
    }

    /// Builds the firmware for a subject, runs it, and compares.
    pub(crate) fn run<S: Subject>(&self, tools: &Tools) -> Result<()> {
        let kept = cross::target_dir().join(self.name);
        let elf = kept.join(S::NAME);
        {
            let (built, _guard) = cross::build(&tools.cross, "boards", self.target, self.name)?;
            fs::create_dir_all(&kept)?;
            fs::copy(built.join(S::NAME), &elf)?;
        }
        let image = Image::read(&elf)?;
        image.allocates_nothing()?;
        image.formats_nothing()?;
        image.panics_nowhere()?;

        let (line, report) = run::report::<Report>(&mut self.emulate(tools, &elf))?;
        let line = format!("{},\"flash_bytes\":{}}}\n", line.trim_end_matches('}'), image.flash());
        fs::write(elf.with_extension("json"), line)?;
        let ran = [&report.scene, &report.target, &report.machine].map(String::as_str);
        ensure!(ran == [S::NAME, self.target, self.name], "ran {ran:?}");

        let expected = host::Sums::of_naive::<S>()?;
        let sums = [&report.image_crc32, &report.hits_crc32];
        ensure!(sums == [&expected.image, &expected.hits], "{sums:?} instead of {expected:?}");
        let arena = host::arena::<S>(report.arena.capacity)?;
        let stopped_by = (&report.arena, report.stopped_by.as_str());
        ensure!(stopped_by == (&arena.0, arena.1), "{stopped_by:?} instead of {arena:?}");
        Ok(())
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
