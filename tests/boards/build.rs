//! Puts the memory map of the machine named in `MACHINE` where the linker finds it.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let machine = env::var("MACHINE").unwrap_or_else(|_| "mps2-an386".into());
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by cargo"));
    let map = format!("memory/{machine}.x");
    fs::copy(&map, out.join("memory.x"))
        .unwrap_or_else(|e| panic!("MACHINE={machine}: {map}: {e}"));
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-cfg=machine=\"{machine}\"");
    println!("cargo:rustc-env=MACHINE={machine}");
    println!("cargo:rerun-if-env-changed=MACHINE");
    println!("cargo:rerun-if-changed=memory");
}
