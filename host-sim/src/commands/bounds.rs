//! `bounds`: which bounds pay, by kind of bound and kind of shape.

use std::fmt::Write;

use kibiray::num::{Fixed, Real};
use kibiray::scene::Camera;

use crate::description::load::load;
use crate::efficiency::{Efficiency, measure};
use crate::frame::Frame;
use crate::options::{Bounds, Number};
use crate::tables::Tables;
use crate::values::is_dash;

pub(super) fn run(options: &Bounds) -> anyhow::Result<()> {
    if let Some(json) = &options.json {
        super::check_folder(json)?;
    }
    let measured = match options.num {
        Number::F32 => of_scene::<f32>(&options.scene)?,
        Number::F64 => of_scene::<f64>(&options.scene)?,
        Number::Fixed => of_scene::<Fixed>(&options.scene)?,
    };
    if let Some(json) = &options.json {
        let mut text = serde_json::to_vec_pretty(&measured)?;
        text.push(b'\n');
        super::write_to(json, &text)?;
        if is_dash(json) {
            return Ok(());
        }
    }
    super::write_to("-".as_ref(), table(&options.scene, &measured)?.as_bytes())
}

fn of_scene<R: Real>(name: &str) -> anyhow::Result<Efficiency> {
    let description = load(name)?;
    let moved = Frame::of::<R>(&description).apply(&description);
    let tables = Tables::<R>::new(&moved)?;
    let polygons = tables.polygons();
    let scene = tables.scene(&polygons)?;
    measure(&scene, &tables.kinds(), &Camera::new(tables.view(), R::ONE)?)
}

/// B and I in nanoseconds, p in percent.
fn table(name: &str, measured: &Efficiency) -> anyhow::Result<String> {
    let mut text = format!(
        "{name}, {} rays; B + p I < I: times in nanoseconds, every shape tested | in a tree\n\n",
        measured.rays
    );
    writeln!(
        text,
        "{:9} {:>6} {:>6}   {:7}{:>6} | {:>7} {:>7}      | {:>7} {:>7}",
        "shape", "count", "I", "bound", "B", "p", "B + pI", "p", "B + pI"
    )?;
    for kind in &measured.shapes {
        let mut head = format!("{:9} {:>6} {:>6.1}", kind.kind, kind.count, kind.test_ns);
        for it in &kind.bounds {
            let cost = |p: f64| it.test_ns + p * kind.test_ns;
            let word = |pays: bool| if pays { "pays" } else { "" };
            let (alone, tree) = (it.hit_ratio, it.hit_ratio_in_tree);
            writeln!(
                text,
                "{head:23}   {:7}{:>6.1} | {:>5.1} % {:>7.1} {:4} | {:>5.1} % {:>7.1} {:4}",
                it.bound,
                it.test_ns,
                100.0 * alone,
                cost(alone),
                word(it.pays),
                100.0 * tree,
                cost(tree),
                word(it.pays_in_tree),
            )?;
            head.clear();
        }
    }
    writeln!(
        text,
        "\n{:7} {:>8} | {:>23} | {:>23}",
        "tree of", "paying", "all bounds", "those of leaves that pay"
    )?;
    for tree in &measured.trees {
        let cells = [tree.all, tree.chosen].map(|it| {
            format!("{:>6.1} + {:>5.2} {:>6.0} ns", it.bound_tests, it.shape_tests, it.ns)
        });
        writeln!(text, "{:7} {:>8} | {} | {}", tree.bound, tree.paying, cells[0], cells[1])?;
    }
    writeln!(text, "(tests of bounds and of shapes a ray)")?;
    Ok(text)
}
