//! The command `host-sim`.

use std::process::ExitCode;

fn main() -> ExitCode {
    kibiray_host_sim::commands::main()
}
