//! The modules by themselves: how large they are, and what the smallest one renders.

use crate::{cross, host, module, run, tools};
use anyhow::{Result, ensure};
use serde::Deserialize;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// One structure and one kind of shape. The compiler orders and inlines functions by names that
/// contain the folder of the checkout, which moves the size by up to 350 bytes.
const LEAST_BYTES: u64 = 20 * 1024;

/// Four structures, three mailboxes, seven kinds of shapes, planning, counting, five scenes. The aim of
/// 40 KiB is missed: two queries, each through four structures to seven kinds of shapes, are written
/// out in code, a hierarchy takes 12 KiB, and the scenes take 8 KiB.
const PAGE_BYTES: u64 = 86 * 1024;

/// What these tests need.
#[derive(Debug)]
pub(crate) struct Tools {
    module: module::Tools,
    node: PathBuf,
}

impl Tools {
    pub(crate) fn find() -> Result<Self, String> {
        Ok(Self { node: tools::find("node")?, module: module::Tools::find()? })
    }
}

fn small_enough(tools: &Tools, name: &str, most: u64) -> Result<PathBuf> {
    let module::Module { built, small: module } =
        module::make(&tools.module, &format!("wasm/{name}"))?;
    let [built, bytes] = [fs::metadata(&built)?.len(), fs::metadata(&module)?.len()];
    println!("{name} module: {bytes} bytes, {:.1} KiB; as built {built}", bytes as f64 / 1024.0);
    let line =
        format!("{{\"module\":\"{name}\",\"module_bytes\":{bytes},\"built_bytes\":{built}}}\n");
    fs::write(module.with_extension("json"), line)?;
    ensure!(bytes <= most, "the {name} module has {bytes} bytes, more than {most}");
    Ok(module)
}

pub(crate) fn page(tools: &Tools) -> Result<()> {
    small_enough(tools, "page", PAGE_BYTES).map(drop)
}

#[derive(Deserialize)]
struct Report {
    image_crc32: String,
    memory_bytes: usize,
    imports: usize,
}

/// Runs the smallest module and compares its picture with the host's.
pub(crate) fn least(tools: &Tools) -> Result<()> {
    let module = small_enough(tools, "least", LEAST_BYTES)?;
    let mut command = Command::new(&tools.node);
    command.arg(cross::source("wasm").join("least/run.mjs")).arg(module);
    let (_, report) = run::report::<Report>(&mut command)?;
    let expected = host::least(64, 48)?;
    ensure!(report.image_crc32 == expected, "{} instead of {expected}", report.image_crc32);
    ensure!(report.memory_bytes == 65_536, "{} bytes of memory", report.memory_bytes);
    ensure!(report.imports == 0, "{} imports", report.imports);
    Ok(())
}
