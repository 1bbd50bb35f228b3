//! The page that `host-sim serve` shows, in a real browser: it renders the very picture that the
//! host renders, and says what it takes. And the modules of WebAssembly are as small as promised.
//!
//! A test whose tools are missing is reported as ignored, in CI (`CI=true`) it fails.

mod browser;
#[allow(dead_code)]
#[path = "../targets/cross.rs"]
mod cross;
mod host;
#[path = "../targets/module.rs"]
mod module;
mod modules;
#[allow(dead_code)]
#[path = "../targets/run.rs"]
mod run;
mod server;
#[allow(dead_code)]
#[path = "../targets/tools.rs"]
mod tools;
mod visits;

use libtest_mimic::{Arguments, Failed, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    if std::env::var_os(server::AS_COMMAND).is_some() {
        return kibiray_host_sim::commands::main();
    }
    let arguments = Arguments::from_args();
    let mut trials = vec![
        trial("least_module", modules::Tools::find(), |tools| modules::least(&tools)),
        trial("page_module", modules::Tools::find(), |tools| modules::page(&tools)),
    ];
    for (name, visit) in visits::ALL {
        trials.push(trial(name, visits::Tools::find(), move |tools| visits::make(&tools, visit)));
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// A test that is ignored without its tools, unless it must not be.
fn trial<T: Send + 'static>(
    name: &str,
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
