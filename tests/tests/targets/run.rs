//! Running a program under a time limit.

use anyhow::{Context, Result, bail};
use std::io::Read;
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// What a program printed, and how it ended. Hangs are usual with emulators: after the limit it is
/// ended, which is an error.
pub(crate) fn within(limit: Duration, command: &mut Command) -> Result<(ExitStatus, String)> {
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| format!("{command:?}"))?;
    let mut stdout = child.stdout.take().context("a pipe")?;
    let reader = thread::spawn(move || {
        let mut text = String::new();
        stdout.read_to_string(&mut text).map(|_| text)
    });
    let deadline = Instant::now() + limit;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if Instant::now() > deadline {
            child.kill()?;
            child.wait()?;
            bail!("did not end within {limit:?}: {command:?}");
        }
        thread::sleep(Duration::from_millis(10));
    };
    let text = reader.join().ok().context("the reader panicked")??;
    Ok((status, text))
}

/// The line of JSON among what an image printed that ended well.
pub(crate) fn report<T: serde::de::DeserializeOwned>(command: &mut Command) -> Result<(String, T)> {
    let (status, text) = within(Duration::from_secs(300), command)?;
    let line = text.lines().find(|line| line.starts_with('{'));
    let line = line.with_context(|| format!("no report, {status}: {command:?}\n{text}"))?;
    if !status.success() {
        bail!("{status}: {line}");
    }
    let report = serde_json::from_str(line).with_context(|| format!("not a report: {line}"))?;
    Ok((line.into(), report))
}
