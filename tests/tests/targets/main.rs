//! Guards promise 3, the same answer everywhere, and that the core needs neither std nor alloc:
//! firmware and a WebAssembly module are built from source with `core` alone, linked, and run in
//! emulators; their pictures and hits are bit for bit those of the host, which tests every shape.
//!
//! A test whose tools are missing is reported as ignored, in CI (`CI=true`) it fails.

mod cross;
mod host;
mod image;
mod machine;
mod run;
mod tools;
mod wasm;

use kibiray_scenes::{Marbles, Subject};
use libtest_mimic::{Arguments, Failed, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = vec![trial("marbles_from_octrees_of_all_sizes".into(), Ok(()), |()| {
        host::structures_agree::<Marbles>()
    })];
    for machine in &machine::ALL {
        let name = format!("{}_on_{}", Marbles::NAME, machine.name);
        trials.push(trial(name, machine.tools(), |tools| machine.run::<Marbles>(&tools)));
    }
    let name = format!("{}_in_wasm", Marbles::NAME);
    trials.push(trial(name, wasm::tools(), |tools| wasm::run::<Marbles>(&tools)));
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// A test that is ignored without its tools, unless it must not be.
fn trial<T: Send + 'static>(
    name: String,
    tools: Result<T, String>,
    test: impl FnOnce(T) -> anyhow::Result<()> + Send + 'static,
) -> Trial {
    let must_run = std::env::var("CI").is_ok_and(|ci| ci == "true");
    let missing = tools.as_ref().err().cloned();
    if let (Some(missing), false) = (&missing, must_run) {
        eprintln!("{name} is ignored: {missing}");
    }
    Trial::test(name, move || {
        let tools = tools.map_err(Failed::from)?;
        test(tools).map_err(|error| Failed::from(format!("{error:#}")))
    })
    .with_ignored_flag(missing.is_some() && !must_run)
}
