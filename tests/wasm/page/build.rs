//! Twenty pages of 64 KiB that cannot grow, sixteen of them the largest arena; the stack comes
//! first: what overflows it traps.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for argument in
        ["-zstack-size=32768", "--stack-first", "--initial-memory=1310720", "--max-memory=1310720"]
    {
        println!("cargo::rustc-link-arg-cdylib={argument}");
    }
}
