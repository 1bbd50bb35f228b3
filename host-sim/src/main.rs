//! The command `host-sim`.
fn main() {}
