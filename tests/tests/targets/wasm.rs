//! WebAssembly, run by node.

use crate::goldens::Row;
use crate::machine::program;
use crate::{cross, host, module, run, tools};
use anyhow::{Result, ensure};
use kibiray_scenes::{Structure, Subject};
use serde::Deserialize;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// What a run needs.
#[derive(Debug)]
pub(crate) struct Tools {
    module: module::Tools,
    node: PathBuf,
}

/// Finds them.
pub(crate) fn tools() -> Result<Tools, String> {
    Ok(Tools { node: tools::find("node")?, module: module::Tools::find()? })
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
    for (package, name) in [("wasm", "wasm"), ("wasm/least", "least"), ("wasm/page", "page")] {
        let module = module::make(&tools.module, package)?;
        let [built, bytes] = [fs::metadata(module.built)?.len(), fs::metadata(module.small)?.len()];
        println!("{name} module: {bytes} bytes; as built {built}");
        Row::new(&format!("module_{name}"), "-", "wasm").with("flash", bytes).check()?;
    }
    Ok(())
}

/// Builds the module, runs it, and compares.
pub(crate) fn run<S: Subject>(tools: &Tools, Number(number): Number) -> Result<()> {
    let module = module::make(&tools.module, "wasm")?.small;
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
