//! WebAssembly, run by node.

use crate::goldens::Row;
use crate::machine::program;
use crate::{cross, host, run, tools};
use anyhow::{Result, ensure};
use kibiray_scenes::{Structure, Subject};
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

/// By which number the module knows a subject: its place among [`kibiray_scenes::all`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(pub(crate) usize);

/// Bytes of the module's memory, fixed when it is linked.
const MEMORY: usize = 8 * 65_536;

#[derive(Deserialize)]
struct Report {
    image_crc32: String,
    hits_crc32: String,
    memory_bytes: usize,
    imports: usize,
}

/// How large the modules are: of all scenes, the smallest one, and that of the page.
pub(crate) fn sizes(tools: &Tools) -> Result<()> {
    for (package, module) in [("wasm", "wasm"), ("wasm/least", "least"), ("wasm/page", "page")] {
        let (built, _guard) = cross::build(&tools.cross, package, TARGET, "")?;
        let bytes = fs::metadata(built.join(format!("kibiray_{module}.wasm")))?.len();
        println!("{module} module: {bytes} bytes");
        Row::new(&format!("module_{module}"), "-", "wasm").with("flash", bytes).check()?;
    }
    Ok(())
}

/// Builds the module, runs it, and compares.
pub(crate) fn run<S: Subject>(tools: &Tools, Number(number): Number) -> Result<()> {
    let (built, _guard) = cross::build(&tools.cross, "wasm", TARGET, "")?;
    let module = built.join("kibiray_wasm.wasm");
    let mut command = Command::new(&tools.node);
    command.arg(cross::source("wasm").join("run.mjs")).arg(module).arg(number.to_string());
    let (line, report) = run::report::<Report>(&mut command)?;
    let kept = cross::target_dir().join("wasm");
    fs::create_dir_all(&kept)?;
    fs::write(kept.join(S::NAME).with_extension("json"), line + "\n")?;

    let expected = host::Sums::of_naive::<S>()?;
    let sums = [&report.image_crc32, &report.hits_crc32];
    ensure!(sums == [&expected.image, &expected.hits], "{sums:?} instead of {expected:?}");
    ensure!(report.memory_bytes == MEMORY, "{} bytes of memory", report.memory_bytes);
    ensure!(report.imports == 0, "{} imports", report.imports);
    let row = Row::new(&program::<S>(), S::Structure::NAME, "wasm").with("hits", report.hits_crc32);
    if S::SIZE.1 > 0 { row.with("image", report.image_crc32) } else { row }.check()
}
