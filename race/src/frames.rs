//! Whole frames, 512x512, one thread, each program run as a user would.

use crate::contest::progress;
use crate::nff::Nff;
use anyhow::{Context, Result, bail};
use nix::sys::resource::{UsageWho, getrusage};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

const SCENES: [&str; 11] = [
    "balls", "gears", "mount", "rings", "teapot", "tetra", "tree", "lattice", "shells", "sombrero",
    "jacks",
];

/// A frame: seconds of processor time for tracing alone.
type Frame = Result<f64>;

/// Runs all scenes; gives a line a program and scene.
pub fn run(host_sim: &Path, repeat: usize, scenes: &[String]) -> Result<Vec<Value>> {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    let wanted: Vec<&str> = SCENES
        .into_iter()
        .filter(|&s| scenes.is_empty() || scenes.iter().any(|o| o == s))
        .collect();
    let bar = progress(wanted.len() * repeat * 4);
    let mut lines = vec![];
    for scene in wanted {
        let text = output(Command::new(host_sim).args(["scene", scene]), folder)?.0;
        let nff = Nff::parse(&text).with_context(|| scene.to_string())?;
        std::fs::write(folder.join("scene.pov"), nff.povray())?;
        std::fs::write(folder.join("scene.dat"), nff.tachyon())?;
        let programs: [(&str, &dyn Fn() -> Frame); 4] = [
            ("kibiray, 256 KiB", &|| kibiray(host_sim, scene, "256KiB", folder)),
            ("kibiray, unlimited", &|| kibiray(host_sim, scene, "1GiB", folder)),
            ("Tachyon", &|| tachyon(folder)),
            ("POV-Ray", &|| povray(folder)),
        ];
        let mut results = programs.map(|_| Ok(f64::INFINITY));
        for _ in 0..repeat {
            for ((name, program), result) in programs.iter().zip(&mut results) {
                bar.set_message(format!("{scene} {name}"));
                *result = match (&*result, program()) {
                    (Ok(before), Ok(now)) => Ok(before.min(now)),
                    (Err(_), _) => continue,
                    (_, Err(why)) => Err(why),
                };
                bar.inc(1);
            }
        }
        for ((name, _), result) in programs.iter().zip(results) {
            let mut line = json!({"scene": scene, "shapes": nff.len(), "peer": name});
            match result {
                Ok(seconds) => line["frame_s"] = json!(seconds),
                Err(why) => line["error"] = json!(why.to_string()),
            }
            lines.push(line);
        }
    }
    bar.finish_and_clear();
    Ok(lines)
}

/// What a program says, and its processor time as a share of the time that it ran.
pub fn output(command: &mut Command, folder: &Path) -> Result<(String, f64)> {
    let used = || -> Result<f64> {
        let usage = getrusage(UsageWho::RUSAGE_CHILDREN)?;
        let seconds = |t: nix::sys::time::TimeVal| t.tv_sec() as f64 + t.tv_usec() as f64 * 1e-6;
        Ok(seconds(usage.user_time()) + seconds(usage.system_time()))
    };
    let (before, start) = (used()?, Instant::now());
    let name = command.get_program().to_string_lossy().into_owned();
    let name = name.rsplit('/').next().unwrap_or_default();
    let output = command.current_dir(folder).stdin(Stdio::null()).output();
    let output = output.map_err(|_| anyhow::anyhow!("{name} is not installed"))?;
    let share = ((used()? - before) / start.elapsed().as_secs_f64()).min(1.0);
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        bail!("{name}: {}", said.lines().last().unwrap_or_default());
    }
    Ok((said.into_owned(), share))
}

/// The number that follows, in a text.
fn number(text: &str, after: &str) -> Result<f64> {
    let rest = text.split_once(after).with_context(|| format!("no \"{after}\" in the output"))?.1;
    let rest = rest.trim_start();
    let end = rest.find(|c: char| c != '.' && !c.is_ascii_digit()).unwrap_or(rest.len());
    Ok(rest[..end].parse()?)
}

fn kibiray(host_sim: &Path, scene: &str, ram: &str, folder: &Path) -> Frame {
    let scene = format!("spd:{scene}");
    let arguments = ["render", &scene, "--size", "512x512", "--ram", ram];
    let files = ["-o", "kibiray.png", "--json", "kibiray.json"];
    output(Command::new(host_sim).args(arguments).args(files), folder)?;
    let report: Value = serde_json::from_slice(&std::fs::read(folder.join("kibiray.json"))?)?;
    report["time"]["trace_cpu_s"].as_f64().context("no trace_cpu_s")
}

/// It tells the time on the wall only: its share of the processor is taken as that of the whole run.
fn tachyon(folder: &Path) -> Frame {
    let arguments = ["scene.dat", "-res", "512", "512", "-numthreads", "1", "+V"];
    let files = ["-format", "PPM", "-o", "tachyon.ppm"];
    let (said, share) = output(Command::new("tachyon").args(arguments).args(files), folder)?;
    Ok(number(&said, "Ray Tracing Time:")? * share)
}

fn povray(folder: &Path) -> Frame {
    let arguments = ["+Iscene.pov", "+Opovray.png", "+W512", "+H512", "+WT1", "-D", "-A", "-V"];
    let (said, _) = output(Command::new("povray").args(arguments), folder)?;
    let trace = said.split_once("Trace Time:").context("no \"Trace Time\" in the output")?.1;
    number(trace, "thread(s) with")
}
