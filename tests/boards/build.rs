//! Puts the memory map of the machine named in `MACHINE`, or of the usual one for the target, where
//! the linker finds it.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let machine = env::var("MACHINE").unwrap_or_else(|_| usual().into());
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

/// The machine that `cargo run` emulates.
fn usual() -> &'static str {
    match env::var("TARGET").as_deref() {
        Ok("thumbv6m-none-eabi") => "microbit",
        Ok("thumbv7m-none-eabi") => "lm3s6965evb",
        Ok("riscv32imc-unknown-none-elf") => "virt",
        _ => "netduinoplus2",
    }
}
