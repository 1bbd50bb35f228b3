//! `host-sim serve` as a process of its own.

use anyhow::{Context, Result};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// With this in the environment the test program is the command `host-sim`.
pub(crate) const AS_COMMAND: &str = "KIBIRAY_TEST_AS_COMMAND";

/// A process that ends with its owner.
pub(crate) struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Process {
    /// Starts a program and waits for a line about which `find` has something to say.
    pub(crate) fn start<T>(
        command: &mut Command,
        find: impl Fn(&str) -> Option<T>,
    ) -> Result<(Self, T)> {
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
        let mut process = Self(child.with_context(|| format!("{command:?}"))?);
        let stdout = process.0.stdout.take().context("a pipe")?;
        let mut lines = BufReader::new(stdout).lines();
        let found = lines.by_ref().map_while(Result::ok).find_map(|line| find(&line));
        let found = found.with_context(|| format!("ended without a word: {command:?}"))?;
        // What else it prints must go somewhere.
        std::thread::spawn(move || lines.for_each(drop));
        Ok((process, found))
    }
}

/// Serves the page with a module as built, which is made smaller here. Gives its address.
pub(crate) fn serve(module: &Path) -> Result<(Process, String)> {
    let mut command = Command::new(std::env::current_exe()?);
    command.env(AS_COMMAND, "1").args(["serve", "--port", "0", "--wasm"]).arg(module);
    Process::start(&mut command, |line| {
        let address = line.split_whitespace().next()?;
        address.starts_with("http://127.0.0.1:").then(|| address.to_owned())
    })
}
