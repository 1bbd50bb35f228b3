//! Building for other targets, `core` included.

use crate::tools;
use anyhow::{Context, Result, bail};
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One build at a time: they share a folder, so that `core` is built once a target.
static BUILDING: Mutex<()> = Mutex::new(());

/// What a build needs.
#[derive(Clone, Debug)]
pub(crate) struct Tools {
    rustc: PathBuf,
    linker: PathBuf,
}

impl Tools {
    /// Finds them; `linker` is LLVM's name of a linker for the target.
    pub(crate) fn find(linker: &str) -> Result<Self, String> {
        Ok(Self { rustc: tools::rustc()?, linker: tools::linker(linker)? })
    }
}

/// The folder with everything that is built here.
pub(crate) fn target_dir() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("boards")
}

/// A folder below that of the tests.
pub(crate) fn source(package: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(package)
}

/// Flags from outside would replace those of a package, and with them the linker script. The library
/// path is that of the compiler that built this test.
pub(crate) fn without_flags(command: &mut Command) -> &mut Command {
    for (name, _) in env::vars_os() {
        let name = name.to_string_lossy();
        let flags = name.ends_with("RUSTFLAGS") || name.starts_with("CARGO_PROFILE_");
        let compiler = name.starts_with("RUSTC") || name.starts_with("CARGO_BUILD_");
        if flags || compiler || name == "LD_LIBRARY_PATH" {
            command.env_remove(&*name);
        }
    }
    command
}

/// Builds all of a package for a target, without std and without alloc. Gives the folder that it lies
/// in, which stays as it is as long as the guard is held.
pub(crate) fn build(
    tools: &Tools,
    package: &str,
    target: &str,
    machine: &str,
) -> Result<(PathBuf, MutexGuard<'static, ()>)> {
    build_programs(tools, package, target, machine, &[])
}

/// Builds some of a package's programs, or all of the package where none is named.
pub(crate) fn build_programs(
    tools: &Tools,
    package: &str,
    target: &str,
    machine: &str,
    programs: &[String],
) -> Result<(PathBuf, MutexGuard<'static, ()>)> {
    let guard = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = target_dir();
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    without_flags(&mut command);
    let linker = format!("CARGO_TARGET_{}_LINKER", target.to_uppercase().replace('-', "_"));
    command
        .args(["build", "--release", "--locked", "-Z", "build-std=core", "--target", target])
        .args(programs.iter().flat_map(|program| ["--bin", program]))
        .current_dir(source(package))
        .env("MACHINE", machine)
        .env("RUSTC", &tools.rustc)
        // Lets a stable compiler build its library.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_TARGET_DIR", &folder)
        .env(linker, &tools.linker)
        .stdin(Stdio::null());
    let output = command.output().with_context(|| format!("{command:?}"))?;
    if !output.status.success() {
        bail!("{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok((folder.join(target).join("release"), guard))
}
