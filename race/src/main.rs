//! Kibiray against other ray tracers: the same scenes, the same rays, one process.

mod contest;
mod frames;
mod heap;
mod mesh;
mod nff;
mod oracle;
mod peer;
mod plot;
mod rays;
mod size;
mod table;

use anyhow::{Context, Result};
use clap::{Parser, Subcommand};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

/// Kibiray against other ray tracers: the same scenes, the same rays.
#[derive(Parser)]
struct Args {
    /// Where results go: JSON lines, a table, plots.
    #[arg(long, default_value = "results")]
    out: PathBuf,
    /// The simulator, for whole frames and sizes; `race/run` builds it.
    #[arg(long, default_value = "host-sim")]
    host_sim: PathBuf,
    /// Sponza's palace, a file of the crate bvh; `race/run` finds it. Without it there is no such
    /// scene.
    #[arg(long)]
    sponza: Option<PathBuf>,
    /// Written beside the results.
    #[arg(long, default_value = "")]
    date: String,
    #[command(subcommand)]
    what: Option<What>,
}

#[derive(Subcommand, Clone)]
enum What {
    /// Ray queries: kibiray, Embree, obvhs, bvh, parry3d.
    Rays {
        /// The fastest of so many rounds counts.
        #[arg(long, default_value_t = 5)]
        repeat: usize,
        /// Only these scenes: knot-1k, knot-6k, knot-100k, sponza.
        #[arg(long)]
        scene: Vec<String>,
        /// Only contestants whose names begin so.
        #[arg(long)]
        peer: Vec<String>,
    },
    /// Whole frames of the Standard Procedural Databases: kibiray, Tachyon, POV-Ray.
    Frames {
        /// The fastest of so many rounds counts.
        #[arg(long, default_value_t = 3)]
        repeat: usize,
        /// Only these scenes.
        #[arg(long)]
        scene: Vec<String>,
    },
    /// Cost against size: kibiray on balls and tetra.
    Size,
    /// Only the table and the plots, from the JSON lines there are.
    Table,
}

fn main() -> Result<()> {
    let args = Args::parse();
    std::fs::create_dir_all(&args.out)?;
    let all = [
        What::Rays { repeat: 5, scene: vec![], peer: vec![] },
        What::Frames { repeat: 3, scene: vec![] },
        What::Size,
    ];
    for what in args.what.clone().map_or(all.to_vec(), |what| vec![what]) {
        match what {
            What::Rays { repeat, scene, peer } => {
                save(&args, "rays", contest::run(repeat, &scene, &peer, args.sponza.as_deref())?)?;
            }
            What::Frames { repeat, scene } => {
                save(&args, "frames", frames::run(&args.host_sim, repeat, &scene)?)?;
            }
            What::Size => save(&args, "size", size::run(&args.host_sim)?)?,
            What::Table => {}
        }
    }
    let [rays, frames, sizes] = ["rays", "frames", "size"].map(|name| load(&args.out, name));
    let (rays, frames, sizes) = (rays?, frames?, sizes?);
    std::fs::write(args.out.join("results.md"), table::all(&rays, &frames, &sizes))?;
    if !rays.is_empty() {
        std::fs::write(args.out.join("speed-bytes.svg"), plot::speed(&rays)?)?;
    }
    if !sizes.is_empty() {
        std::fs::write(args.out.join("size.svg"), plot::size(&sizes)?)?;
    }
    Ok(())
}

/// What was run on, without anybody's paths.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find(|line| line.starts_with("model name"));
    let model = model.and_then(|line| line.split_once(':')).map_or("unknown", |(_, name)| name);
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split(' ').next().unwrap_or_default();
    let cores = info.lines().filter(|line| line.starts_with("processor")).count();
    format!("{}, {cores} cores, load {load}", model.trim())
}

/// A line that says when and where, then the results.
fn save(args: &Args, name: &str, results: Vec<Value>) -> Result<()> {
    let first =
        json!({"date": args.date, "machine": machine(), "command": format!("race/run {name}")});
    let mut text = format!("{first}\n");
    for line in results {
        text += &format!("{line}\n");
    }
    let path = args.out.join(name).with_extension("jsonl");
    std::fs::write(&path, text).with_context(|| path.display().to_string())
}

/// Results of an earlier run; empty where there are none.
fn load(out: &Path, name: &str) -> Result<Vec<Value>> {
    match std::fs::read_to_string(out.join(name).with_extension("jsonl")) {
        Ok(text) => Ok(text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?),
        Err(_) => Ok(vec![]),
    }
}
