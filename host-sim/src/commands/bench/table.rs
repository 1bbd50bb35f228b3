//! The results as Markdown.

use std::fmt::{self, Write as _};

use super::query::Spread;
use super::{Report, SceneReport};
use crate::options::Bench;
use crate::values::readable;

pub(super) fn markdown(options: &Bench, report: &Report) -> Result<String, fmt::Error> {
    let mut text = String::new();
    summary(&mut text, report)?;
    for scene in &report.scenes {
        writeln!(text, "\n## {}, {} primitives", scene.name, scene.primitives)?;
        queries(&mut text, scene)?;
        pictures(&mut text, options, scene)?;
    }
    super::boards::table(&mut text, &report.boards)?;
    Ok(text)
}

fn summary(text: &mut String, report: &Report) -> fmt::Result {
    writeln!(
        text,
        "| scene | numbers | RMSE of 4x4 rays, levels | adaptive rays for that, of 4x4's | \
         adaptive recursion, left out below: rays saved, RMSE |\n|---|---|---|---|---|"
    )?;
    for scene in &report.scenes {
        for found in &scene.findings {
            let or_none = |x: Option<String>| x.unwrap_or_else(|| "not reached".into());
            let uniform = or_none(found.uniform_rmse.map(|x| format!("{x:.2}")));
            let adaptive = or_none(found.adaptive_rays.map(|x| format!("{x:.2}")));
            let cutoffs: Vec<String> = found
                .cutoffs
                .iter()
                .map(|(share, saved, rmse)| format!("{share}: {:.1} %, {rmse:.2}", 100.0 * saved))
                .collect();
            let cutoffs = cutoffs.join("; ");
            writeln!(
                text,
                "| {} | {} | {uniform} | {adaptive} | {cutoffs} |",
                scene.name, found.num
            )?;
        }
    }
    Ok(())
}

fn queries(text: &mut String, scene: &SceneReport) -> fmt::Result {
    writeln!(
        text,
        "\nErrors as median / 99 of 100 / greatest, against doubles; t in parts of 1e-9 of the \
         scene's diagonal.\n\n\
         | numbers | structure | memory | error of t | in units in the last place | normal, \
         degrees | wrong ids (explained), of rays | speed |\n|---|---|---|---|---|---|---|---|"
    )?;
    for row in &scene.queries {
        write!(text, "| {} | {} | {} | ", row.num, row.accel, readable(row.ram))?;
        let Some(it) = &row.measured else {
            writeln!(text, "too little memory | | | | |")?;
            continue;
        };
        let spread = |s: &Spread, unit: f64| {
            let number = |x: f64| {
                let x = x / unit;
                if x == 0.0 {
                    "0".into()
                } else if (0.01..1e5).contains(&x) {
                    format!("{x:.2}")
                } else {
                    format!("{x:.1e}")
                }
            };
            format!("{} / {} / {}", number(s.median), number(s.p99), number(s.max))
        };
        writeln!(
            text,
            "{} | {} | {} | {} ({}), {} | {:.2} |",
            spread(&it.t_of_scene, 1e-9),
            spread(&it.t_ulp, 1.0),
            spread(&it.normal_degrees, 1.0),
            it.wrong_ids,
            it.explained,
            it.rays,
            it.speed,
        )?;
    }
    Ok(())
}

fn pictures(text: &mut String, options: &Bench, scene: &SceneReport) -> fmt::Result {
    let (width, height) = options.size;
    writeln!(
        text,
        "\nPictures of {width}x{height} pixels against 256 rays a pixel in doubles; * no other is \
         both as fast and as right.\n\n\
         | numbers | sampling | left out below | RMSE, levels | similarity | rays | time | |\n\
         |---|---|---|---|---|---|---|---|"
    )?;
    for row in &scene.pictures {
        writeln!(
            text,
            "| {} | {} | {} | {:.2} | {:.4} | {} | {:.2} | {} |",
            row.num,
            row.aa,
            row.cutoff,
            row.rmse,
            row.ssim,
            row.rays,
            row.time,
            if row.best { "*" } else { "" },
        )?;
    }
    Ok(())
}
