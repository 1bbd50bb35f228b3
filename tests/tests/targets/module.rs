//! Modules of WebAssembly: built, made smaller as `host-sim serve` does it, and kept.

use crate::{cross, tools};
use anyhow::{Context, Result};
use kibiray_host_sim::wasm;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

const TARGET: &str = "wasm32-unknown-unknown";

/// What making a module needs.
#[derive(Clone, Debug)]
pub(crate) struct Tools(cross::Tools);

impl Tools {
    pub(crate) fn find() -> Result<Self, String> {
        tools::find(wasm::OPTIMIZER)?;
        Ok(Self(cross::Tools::find("wasm-ld")?))
    }
}

/// A module, kept where the next build leaves it alone.
#[derive(Clone, Debug)]
pub(crate) struct Module {
    /// As built.
    pub(crate) built: PathBuf,
    /// What is run and measured.
    pub(crate) small: PathBuf,
}

/// Made once, by whichever test comes first.
static MADE: Mutex<BTreeMap<String, Module>> = Mutex::new(BTreeMap::new());

/// Makes the module of a package: `wasm`, or one within.
pub(crate) fn make(Tools(tools): &Tools, package: &str) -> Result<Module> {
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(module) = made.get(package) {
        return Ok(module.clone());
    }
    let name = package.rsplit('/').next().unwrap_or(package);
    let kept = cross::target_dir().join("wasm");
    fs::create_dir_all(&kept)?;
    let [built, small] = ["built.wasm", "wasm"].map(|end| kept.join(format!("{name}.{end}")));
    let (folder, _guard) = cross::build(tools, package, TARGET, "")?;
    fs::copy(folder.join(format!("kibiray_{name}.wasm")), &built)?;
    fs::write(&small, wasm::optimized(&built)?.context(wasm::OPTIMIZER)?)?;
    let module = Module { built, small };
    made.insert(package.to_owned(), module.clone());
    Ok(module)
}
