//! `scene` and `scenes`: what is built in.

use std::io::{self, Write};

use super::Usage;
use crate::description::{demo, spd};

/// Prints a built-in scene as NFF.
pub(super) fn print(name: &str) -> anyhow::Result<()> {
    if let Some(demo) = demo::find(name) {
        let Some(text) = demo.text() else {
            let name = name.escape_debug();
            return Err(Usage(format!("{name} is built by code and not written as NFF")).into());
        };
        io::stdout().lock().write_all(text.as_bytes())?;
        return Ok(());
    }
    let spec = name.strip_prefix("spd:").unwrap_or(name);
    let (name, size) = match spec.split_once(':') {
        Some((name, size)) => (name, Some(size)),
        None => (spec, None),
    };
    let generator = spd::find(name)?;
    let size = match size.map(str::parse) {
        None => generator.default_size,
        Some(Ok(size)) => size,
        Some(Err(_)) => {
            let spec = spec.escape_debug();
            return Err(Usage(format!("{spec}: the size is not a whole number")).into());
        }
    };
    generator.generate(size, &mut io::stdout().lock())?;
    Ok(())
}

/// Prints the table of built-in scenes.
pub(super) fn list() -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{:<14} {:>5} {:>11}  what it is", "scene", "size", "primitives")?;
    for demo in demo::all() {
        let count = demo.describe().items.len();
        writeln!(out, "{:<14} {:>5} {count:>11}  {}", demo.name, "", demo.about)?;
    }
    for generator in spd::generators() {
        let name = format!("spd:{}", generator.name);
        let size = generator.default_size;
        let count = generator.primitives(size)?;
        writeln!(out, "{name:<14} {size:>5} {count:>11}  {}", about(generator.name))?;
    }
    writeln!(out, "\nspd:NAME:SIZE gives another size; primitives multiply from size to size.")?;
    Ok(())
}

fn about(name: &str) -> &'static str {
    match name {
        "balls" => "spheres with spheres on them, on a mirroring floor",
        "gears" => "meshed gearwheels, some of glass: concave polygons of 144 corners",
        "mount" => "a fractal mountain of triangles under four glass spheres",
        "rings" => "a pyramid of interlocked rings of cylinders and spheres",
        "teapot" => "Newell's teapot in triangles with vertex normals, on a checkerboard",
        "tetra" => "a fractal tetrahedron of triangles",
        "tree" => "a tree of cones and spheres, seven lights",
        "lattice" => "mirroring spheres joined by cylinders",
        "shells" => "a sea shell of overlapping spheres",
        "sombrero" => "a wave function as a field of triangles",
        "jacks" => "a jack of spheres and cylinders, with smaller ones in all octants",
        _ => "",
    }
}
