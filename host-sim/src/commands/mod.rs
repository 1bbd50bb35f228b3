//! The commands, and how they end.

mod bench;
mod bounds;
mod compare;
mod render;
mod scenes;
mod serve;
mod stage;
mod stats;
mod sweep;
mod trace;

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Parser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::options::{Cli, Command};
use crate::values::is_dash;

/// Options that do not go together: wrong usage, exit status 2.
#[derive(Debug)]
pub struct Usage(pub String);

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let result = match Cli::parse().command {
        None => render::run(None),
        Some(Command::Render(options)) => render::run(Some(options)),
        Some(Command::Stats(options)) => stats::run(&options),
        Some(Command::Trace(options)) => trace::run(&options),
        Some(Command::Bench(options)) => bench::run(&options),
        Some(Command::Sweep(options)) => sweep::run(&options),
        Some(Command::Compare(options)) => compare::run(&options),
        Some(Command::Bounds(options)) => bounds::run(&options),
        Some(Command::Scene { name }) => scenes::print(&name),
        Some(Command::Scenes) => scenes::list(),
        Some(Command::Serve(options)) => serve::run(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&error),
    }
}

/// One line on standard error, unless nobody listens any more.
fn fail(error: &anyhow::Error) -> ExitCode {
    let closed = error.chain().any(|cause| {
        let cause = cause.downcast_ref::<io::Error>();
        cause.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    });
    if closed {
        // Whoever reads has seen enough, as `| head` has.
        return ExitCode::SUCCESS;
    }
    let line = format!("{error:#}").replace(char::is_control, " ");
    let _ = writeln!(io::stderr(), "error: {line}");
    ExitCode::from(if error.is::<Usage>() { 2 } else { 1 })
}

/// Writes a file, or standard output for `-`.
fn write_to(path: &Path, content: &[u8]) -> anyhow::Result<()> {
    if is_dash(path) {
        let mut out = io::stdout().lock();
        out.write_all(content)?;
        Ok(out.flush()?)
    } else {
        std::fs::write(path, content).with_context(|| format!("cannot write {}", shown(path)))
    }
}

/// Refuses, before any work is done, a file that cannot be written for lack of its folder.
fn check_folder(path: &Path) -> anyhow::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    match folder {
        Some(folder) if !is_dash(path) && !folder.is_dir() => {
            anyhow::bail!("cannot write {}: there is no folder {}", shown(path), shown(folder))
        }
        _ if path.is_dir() => anyhow::bail!("cannot write {}: it is a folder", shown(path)),
        _ => Ok(()),
    }
}

/// A path in a message.
fn shown(path: &Path) -> String {
    path.to_string_lossy().escape_debug().to_string()
}

/// A bar on the terminal, if there is one; `of`: what is counted.
fn progress(length: u64, of: &str) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let target = ProgressDrawTarget::stderr_with_hz(10);
    let bar = ProgressBar::with_draw_target(Some(length), target);
    match ProgressStyle::with_template(&format!("{of} {{bar:40}} {{pos}}/{{len}}, {{eta}} left")) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// `tetra` for `spd:tetra:3` and for `scenes/tetra.nff`: what files are called by default.
fn named_after(scene: &str) -> PathBuf {
    match scene.strip_prefix("spd:") {
        Some(spec) => spec.split(':').next().unwrap_or(spec).into(),
        None => Path::new(scene).file_stem().unwrap_or(scene.as_ref()).into(),
    }
}
