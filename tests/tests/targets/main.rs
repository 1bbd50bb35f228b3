//! Guards promise 3, the same answer everywhere, and that the core needs neither std nor alloc:
//! firmware and a WebAssembly module are built from source with `core` alone, linked, and run in
//! emulators; their pictures and hits are bit for bit those of the host, which tests every shape.
//! What they take is compared with a table.
//!
//! A test whose tools are missing is reported as ignored, in CI (`CI=true`) it fails.

mod cross;
mod examples;
mod goldens;
mod host;
mod image;
mod machine;
mod module;
mod run;
mod tools;
mod wasm;

use kibiray_scenes::{Each, Marbles, Subject};
use libtest_mimic::{Arguments, Failed, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = Trials::default();
    trials.trials.push(trial("marbles_from_octrees_of_all_sizes".into(), Ok(()), |()| {
        host::structures_agree::<Marbles>()
    }));
    trials
        .trials
        .push(trial("card_plain_is_the_card".into(), Ok(()), |()| host::plain_is_the_card()));
    for machine in &machine::ALL {
        let name = format!("card_plain_on_{}", machine.name);
        trials.trials.push(trial(name, machine.tools(), |tools| machine.run_plain(&tools)));
        for cost in machine::COSTS.iter().filter(|cost| machine.runs(&cost.program())) {
            let name = format!("{}_on_{}", cost.program(), machine.name);
            trials
                .trials
                .push(trial(name, machine.tools(), |tools| machine.run_cost(&tools, cost)));
        }
    }
    let example = [examples::picture as fn() -> _, examples::range];
    for (name, test) in ["example_picture", "example_range"].into_iter().zip(example) {
        trials.trials.push(trial(name.into(), examples::tools(), move |()| test()));
    }
    let sizes = trial("wasm_modules".into(), wasm::tools(), |tools| wasm::sizes(&tools));
    trials.trials.push(sizes);
    kibiray_scenes::all(&mut trials);
    let conclusion = libtest_mimic::run(&arguments, trials.trials);
    let all = conclusion.num_filtered_out == 0 && conclusion.num_ignored == 0;
    if let Err(error) = goldens::finish(all && !arguments.list && !conclusion.has_failed()) {
        eprintln!("{error:#}");
        return ExitCode::FAILURE;
    }
    conclusion.exit_code()
}

/// Tests of every subject.
#[derive(Default)]
struct Trials {
    trials: Vec<Trial>,
    subjects: usize,
}

impl Each for Trials {
    fn subject<S: Subject>(&mut self) {
        let number = wasm::Number(self.subjects);
        self.subjects += 1;
        let program = machine::program::<S>();
        for machine in machine::ALL.iter().filter(|machine| machine.runs(&program)) {
            let name = format!("{program}_on_{}", machine.name);
            self.trials.push(trial(name, machine.tools(), |tools| machine.run::<S>(&tools)));
        }
        let name = format!("{program}_in_wasm");
        self.trials.push(trial(name, wasm::tools(), move |tools| wasm::run::<S>(&tools, number)));
    }
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
