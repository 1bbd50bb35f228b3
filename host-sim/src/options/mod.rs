//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use kibiray::trace::MOST_DEPTH;

use crate::values;

mod choices;
mod common;

pub use choices::*;
pub use common::Common;

const ABOUT: &str = "\
Ray tracing in kibibytes, simulated: traces a scene with the very code that runs on a \
microcontroller, inside an arena of as many bytes as you say, and reports what it took.";

const EXAMPLES: &str = "\
Examples:
  host-sim                                       the demo scene in 64 KiB, into kibiray.png
  host-sim render spd:tetra                      a fractal tetrahedron, into tetra.png
  host-sim render bunny.obj --ram 1MiB --size 800x600 --threads 2
  host-sim render spd:gears --accel grid --heatmap heat.png
  host-sim stats spd:balls --accel octree --max-objects 4
  host-sim trace room.nff --rays in.csv --hits out.csv
  host-sim sweep spd:balls --ram 4KiB..256KiB    how much memory is worth having, into balls.svg
  host-sim bounds spd:tree                       which bounding solids pay for their tests
  host-sim scene tetra:3 > tetra.nff

A SCENE is
  NAME             a built-in scene; `host-sim scenes` lists them
  spd:NAME[:SIZE]  a generated scene of the Standard Procedural Databases
  FILE.nff         a file in the Neutral File Format
  FILE.obj         a Wavefront file; without a view of its own, one is chosen

Exit status: 0 done, 1 a scene, file or memory that does not do, 2 wrong usage.";

/// What was asked for.
#[derive(Clone, Debug, Parser)]
#[command(name = "host-sim", version, about = ABOUT, after_help = EXAMPLES)]
#[command(propagate_version = true, max_term_width = 100)]
pub struct Cli {
    /// The command; without one the demo scene is rendered.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Render a picture and report memory and work
    Render(Render),
    /// Trace the published ray set and print the report as JSON
    Stats(Stats),
    /// Answer ray queries from a CSV file
    #[command(after_help = TRACE_HELP)]
    Trace(Trace),
    /// Render a scene in less and more memory, and plot what that costs
    Sweep(Sweep),
    /// Measure choices against each other, in turn, round by round; tables as Markdown
    Compare(Compare),
    /// Measure which bounding solids pay, by kind of bound and kind of shape
    Bounds(Bounds),
    /// Measure time and errors over number formats, structures, memory and ways to sample
    Bench(Bench),
    /// Print a generated scene as NFF
    Scene {
        /// NAME or NAME:SIZE, as in `tetra:3`
        name: String,
    },
    /// List the built-in scenes
    Scenes,
    /// Show a page in the browser that renders by itself, as WebAssembly
    Serve(Serve),
}

const TRACE_HELP: &str = "\
IN.csv has the header ox,oy,oz,dx,dy,dz,tmin,tmax and a ray a row; tmax may be inf. A hit at t is \
at o + t*d, with d of any length.
OUT.csv has the header t,id,nx,ny,nz and a row a ray, in order: the nearest hit with \
tmin < t < tmax, the place of its primitive in the file, and the unit normal that faces the \
origin. A miss is inf,-1,0,0,0; a row that is no ray (a component that is not finite, or a zero \
direction) is nan,-1,0,0,0. With --any the header is occluded and a row is 0 or 1.";

/// `render`.
#[derive(Clone, Debug, Args)]
pub struct Render {
    /// What to render [default: the demo scene, with --ram 64KiB]
    pub scene: Option<String>,
    /// The picture, a PNG [default: the scene's name; kibiray.png for the demo scene]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Pixels [default: what the scene says, or 512x512]
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<(u16, u16)>,
    /// Depth of mirrored and refracted rays; a ray from the eye has depth 1
    #[arg(long, value_name = "D", default_value_t = 5)]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=i64::from(MOST_DEPTH)))]
    pub max_depth: u8,
    /// Rays a pixel: `off`, one through the middle; N, a square of N by N; `adaptive[:T]`, through
    /// the corners, divided up to 8 times along an edge where a channel differs by more than T
    /// [T: 0.1]
    #[arg(long, value_name = "off|N|adaptive[:T]", default_value = "off")]
    #[arg(value_parser = values::antialiasing)]
    pub aa: Antialiasing,
    /// Leave out rays whose share of the pixel is less, as in 0.004: mirrored and refracted ones, and
    /// shadow rays, whose light then counts as half in shadow
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    #[arg(value_parser = values::share)]
    pub cutoff: f64,
    /// Do not try first, for a shadow ray, what blocked the last ray to that light
    #[arg(long)]
    pub no_shadow_cache: bool,
    /// Also draw the work of every pixel (tests and traversal steps) as colours
    #[arg(long, value_name = "FILE")]
    pub heatmap: Option<PathBuf>,
    /// The arena: structure, mailboxes and build scratch fit in so many bytes (12345, 16KiB, 1MiB)
    /// [default: 256KiB]
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub ram: Option<usize>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub common: Common,
}

/// `stats`.
#[derive(Clone, Debug, Args)]
pub struct Stats {
    /// What to trace
    pub scene: String,
    /// The ray set; `spd`: 513x513 rays through the corners of the pixels of the published
    /// pictures, depth 5, a mirrored ray from all that mirrors or transmits
    #[arg(long, value_enum, default_value_t = RaySet::Spd)]
    pub rays: RaySet,
    /// The arena: structure, mailboxes and build scratch fit in so many bytes (12345, 16KiB, 1MiB)
    /// [default: 256KiB]
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub ram: Option<usize>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub common: Common,
}

/// `trace`.
#[derive(Clone, Debug, Args)]
pub struct Trace {
    /// What to trace
    pub scene: String,
    /// The rays; `-`: standard input
    #[arg(long, value_name = "IN.csv")]
    pub rays: PathBuf,
    /// Where the answers go; `-`: standard output
    #[arg(long, value_name = "OUT.csv")]
    pub hits: PathBuf,
    /// Only ask whether anything is hit
    #[arg(long)]
    pub any: bool,
    /// The arena: structure, mailboxes and build scratch fit in so many bytes (12345, 16KiB, 1MiB)
    /// [default: 256KiB]
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub ram: Option<usize>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub common: Common,
}

/// `sweep`.
#[derive(Clone, Debug, Args)]
pub struct Sweep {
    /// What to render
    pub scene: String,
    /// Least and most memory; every size is twice the one before
    #[arg(long, value_name = "SIZE..SIZE", default_value = "1KiB..1MiB")]
    #[arg(value_parser = values::bytes_range)]
    pub ram: (usize, usize),
    /// Pixels
    #[arg(long, value_name = "WxH", default_value = "128x128", value_parser = values::size)]
    pub size: (u16, u16),
    /// The plot, an SVG [default: the scene's name]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub common: Common,
}

/// `compare`.
#[derive(Clone, Debug, Args)]
pub struct Compare {
    /// What against what
    #[arg(value_enum)]
    pub table: Table,
    /// Scenes [default: the Standard Procedural Databases as published]
    pub scenes: Vec<String>,
    /// Pixels
    #[arg(long, value_name = "WxH", default_value = "192x192", value_parser = values::size)]
    pub size: (u16, u16),
    /// Rounds, of which the fastest counts
    #[arg(long, value_name = "N", default_value_t = 3)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
}

/// What `compare` compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[allow(missing_docs)]
pub enum Table {
    #[value(help = "what the plan chooses with every fixed structure, in four sizes of memory")]
    Plan,
    #[value(help = "12 and 24 bytes a shape, and 64KiB for some 1,000, with unlimited memory")]
    Budget,
    #[value(help = "an octree's division by benefit with first in, first out")]
    Growth,
    #[value(help = "lists by boxes with exact ones")]
    Overlap,
    #[value(help = "equal lists of a grid or an octree stored once with every cell its own")]
    Lists,
    #[value(help = "every way to skip work with going without it")]
    Skips,
    #[value(help = "ways to store an octree")]
    Stores,
    #[value(help = "time, memory and building of balls and tetra up to a million shapes")]
    Size,
}

/// `bounds`.
#[derive(Clone, Debug, Args)]
pub struct Bounds {
    /// What to measure
    pub scene: String,
    /// The numbers to compute in
    #[arg(long, value_enum, default_value_t = Number::F32)]
    pub num: Number,
    /// Also write what was measured as JSON; `-`: to standard output instead of the table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

/// `bench`. Every list is one of values with commas between; all combinations are measured.
#[derive(Clone, Debug, Args)]
pub struct Bench {
    /// What to trace
    #[arg(default_values = ["spd:tetra:4", "spd:mount:4"])]
    pub scenes: Vec<String>,
    /// The numbers to compute in [default: all there are]
    #[arg(long, value_enum, value_delimiter = ',')]
    pub num: Vec<Number>,
    /// The structures
    #[arg(long, value_enum, value_delimiter = ',', default_value = "bvh,octree,grid")]
    pub accel: Vec<AccelKind>,
    /// The arenas
    #[arg(long, value_name = "SIZE", value_parser = values::bytes, value_delimiter = ',')]
    #[arg(default_value = "256KiB,16KiB")]
    pub ram: Vec<usize>,
    /// Ways to sample; pictures are made with the plan's structure in ample memory
    #[arg(long, value_name = "off|N|adaptive[:T]", value_delimiter = ',')]
    #[arg(value_parser = values::antialiasing)]
    #[arg(default_value = "off,2,3,4,adaptive:0.3,adaptive,adaptive:0.03")]
    pub aa: Vec<Antialiasing>,
    /// Shares below which mirrored and refracted rays are left out
    #[arg(long, value_name = "SHARE", value_delimiter = ',', default_value = "0,0.004,0.016")]
    #[arg(value_parser = values::share)]
    pub cutoff: Vec<f64>,
    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "64x64", value_parser = values::size)]
    pub size: (u16, u16),
    /// Rays along an edge of the square of queries
    #[arg(long, value_name = "N", default_value_t = 129)]
    #[arg(value_parser = clap::value_parser!(u16).range(2..=4096))]
    pub rays: u16,
    /// Measure everything so many times; the fastest counts
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,
    /// The firmware's table, for what number formats and structures cost on boards
    #[arg(long, value_name = "FILE")]
    pub boards: Option<PathBuf>,
    /// What the names of all files begin with: a table, JSON, and plots of each scene
    #[arg(short, long, value_name = "PREFIX", default_value = "bench")]
    pub output: PathBuf,
}

/// `serve`.
#[derive(Clone, Debug, Args)]
pub struct Serve {
    /// Port on this machine, which nobody else can reach; 0: any that is free
    #[arg(long, value_name = "N", default_value_t = 8080)]
    pub port: u16,
    /// The module that the page runs; made smaller by Binaryen's wasm-opt where that is in the search path
    #[arg(long, value_name = "FILE")]
    #[arg(default_value = "target/wasm32-unknown-unknown/release/kibiray_page.wasm")]
    pub wasm: PathBuf,
}
