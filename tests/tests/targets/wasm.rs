//! WebAssembly, run by node.

use crate::{cross, host, run, tools};
use anyhow::{Result, ensure};
use kibiray_scenes::Subject;
use serde::Deserialize;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// What a run needs.
#[derive(Debug)]
pub(crate) struct Tools {
    cross: cross::Tools,
    node: PathBuf,
}

/// Finds them.
pub(crate) fn tools() -> Result<Tools, String> {
    Ok(Tools { node: tools::find("node")?, cross: cross::Tools::find("wasm-ld")? })
}

#[derive(Deserialize)]
struct Report {
    scene: String,
    image_crc32: String,
    hits_crc32: String,
    memory_bytes: usize,
    imports: usize,
}

/// Builds the module, runs it, and compares.
pub(crate) fn run<S: Subject>(tools: &Tools) -> Result<()> {
    let (built, _guard) = cross::build(&tools.cross, "wasm", TARGET, "")?;
    let mut command = Command::new(&tools.node);
    command.arg(cross::source("wasm").join("run.mjs")).arg(built.join("kibiray_wasm.wasm"));
    let (line, report) = run::report::<Report>(&mut command)?;
    let kept = cross::target_dir().join("wasm");
    fs::create_dir_all(&kept)?;
    fs::write(kept.join(S::NAME).with_extension("json"), line + "\n")?;

    ensure!(report.scene == S::NAME, "ran {}", report.scene);
    let expected = host::Sums::of_naive::<S>()?;
    let sums = [&report.image_crc32, &report.hits_crc32];
    ensure!(sums == [&expected.image, &expected.hits], "{sums:?} instead of {expected:?}");
    ensure!(report.memory_bytes == 65_536, "{} bytes of memory", report.memory_bytes);
    ensure!(report.imports == 0, "{} imports", report.imports);
    Ok(())
}
