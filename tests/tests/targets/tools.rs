//! Finding compilers, linkers and emulators.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program of that name in the search path.
pub(crate) fn find(name: &str) -> Result<PathBuf, String> {
    in_path(name).next().ok_or_else(|| format!("no {name} in PATH"))
}

fn in_path(name: &str) -> impl Iterator<Item = PathBuf> {
    let path = env::var_os("PATH").unwrap_or_default();
    let programs: Vec<_> = env::split_paths(&path).map(|folder| folder.join(name)).collect();
    programs.into_iter().filter(|program| program.is_file())
}

/// A compiler that brings the library's source, so that `core` can be built for any target: the one
/// named in `KIBIRAY_CROSS_RUSTC`, or the first in the search path (a rustup toolchain with the
/// component rust-src), or Debian's with the package rust-web-src.
pub(crate) fn rustc() -> Result<PathBuf, String> {
    let candidates: Vec<_> = match env::var_os("KIBIRAY_CROSS_RUSTC") {
        Some(rustc) => vec![rustc.into()],
        None => in_path("rustc").chain([PathBuf::from("/usr/bin/rustc")]).collect(),
    };
    let with_source = |rustc: &PathBuf| {
        sysroot(rustc)
            .is_some_and(|root| root.join("lib/rustlib/src/rust/library/core/Cargo.toml").is_file())
    };
    candidates
        .iter()
        .find(|rustc| with_source(rustc))
        .cloned()
        .ok_or_else(|| format!("none of {candidates:?} is a compiler with library source"))
}

/// The linker of the bare-metal targets: `rust-lld`, which rustup's toolchains bring but do not show,
/// or LLVM's own under the name given.
pub(crate) fn linker(llvm: &str) -> Result<PathBuf, String> {
    let hidden = in_path("rust-lld").chain(in_path("rustc").filter_map(|rustc| {
        let libraries = sysroot(&rustc)?.join("lib/rustlib").read_dir().ok()?;
        let linkers = libraries.flatten().map(|target| target.path().join("bin/rust-lld"));
        linkers.into_iter().find(|linker| linker.is_file())
    }));
    hidden.chain(in_path(llvm)).next().ok_or_else(|| format!("neither rust-lld nor {llvm}"))
}

fn sysroot(rustc: &Path) -> Option<PathBuf> {
    let output = Command::new(rustc).args(["--print", "sysroot"]).output().ok()?;
    let printed = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| PathBuf::from(printed.trim_end()))
}
