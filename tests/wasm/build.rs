//! Eight pages of 64 KiB that cannot grow, the stack in their first 8 KiB: what overflows it traps.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for argument in
        ["-zstack-size=8192", "--stack-first", "--initial-memory=524288", "--max-memory=524288"]
    {
        println!("cargo::rustc-link-arg-cdylib={argument}");
    }
}
