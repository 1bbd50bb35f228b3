//! Modules of WebAssembly, made smaller.

use std::io::ErrorKind;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::Context;

/// What makes a module smaller, from Binaryen.
pub const OPTIMIZER: &str = "wasm-opt";

/// What rustc's modules use beyond the first version of WebAssembly; then what to do with them.
const ARGUMENTS: [&str; 7] = [
    "--enable-bulk-memory",
    "--enable-mutable-globals",
    "--enable-nontrapping-float-to-int",
    "--enable-sign-ext",
    "--strip-debug",
    "--strip-producers",
    "-Oz",
];

/// The module in a file as small as it gets: what is served and what is tested. Nothing where there
/// is no [`OPTIMIZER`].
///
/// # Errors
/// What the optimizer says.
pub fn optimized(module: &Path) -> anyhow::Result<Option<Vec<u8>>> {
    let mut command = Command::new(OPTIMIZER);
    command.args(ARGUMENTS).arg(module).args(["-o", "-"]).stdin(Stdio::null());
    let output = match command.output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        output => output.with_context(|| format!("{command:?}"))?,
    };
    let said = String::from_utf8_lossy(&output.stderr);
    anyhow::ensure!(output.status.success(), "{command:?}: {}", said.trim_end());
    Ok(Some(output.stdout))
}
