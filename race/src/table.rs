//! Results as Markdown.

use crate::size::slope;
use serde_json::Value;
use std::fmt::Write;

/// Everything there is.
pub fn all(rays: &[Value], frames: &[Value], sizes: &[Value]) -> String {
    let mut out = String::from("# Results\n");
    for (title, lines, table) in [
        ("Ray queries", rays, queries as fn(&[Value], &mut String)),
        ("Whole frames", frames, pictures),
        ("Cost against size", sizes, growth),
    ] {
        if let [first, lines @ ..] = lines {
            let text = |key: &str| first[key].as_str().unwrap_or_default();
            let (date, machine, command) = (text("date"), text("machine"), text("command"));
            let _ = writeln!(out, "\n## {title}\n\n{date}, {machine}, by `{command}`.\n");
            let ran: Vec<_> =
                lines.iter().filter(|line| line["error"].is_null()).cloned().collect();
            table(&ran, &mut out);
            out.push('\n');
            for line in lines.iter().filter(|line| line["error"].is_string()) {
                let text = |key: &str| line[key].as_str().unwrap_or_default();
                let (scene, peer, budget) = (text("scene"), text("peer"), text("budget"));
                let _ = writeln!(out, "* not run: {scene}, {peer} {budget}: {}", text("error"));
            }
        }
    }
    out
}

/// Values of a key in the order in which they come, each once.
fn distinct(lines: &[Value], key: impl Fn(&Value) -> String) -> Vec<String> {
    let mut seen = vec![];
    for line in lines {
        let value = key(line);
        if !seen.contains(&value) {
            seen.push(value);
        }
    }
    seen
}

fn text(line: &Value, key: &str) -> String {
    line[key].as_str().unwrap_or_default().to_string()
}

fn who(line: &Value) -> String {
    let (peer, budget) = (text(line, "peer"), text(line, "budget"));
    if budget.is_empty() { peer } else { format!("{peer}, {budget}") }
}

fn number(line: &Value, key: &str, digits: usize) -> String {
    line[key].as_f64().map_or("–".into(), |x| format!("{x:.digits$}"))
}

fn queries(lines: &[Value], out: &mut String) {
    *out += "Speed in million rays a second of processor time; in parentheses tests and, where they \
             can be counted, steps a ray. Bytes a triangle. Wrong: of the sampled answers those that \
             are not what f64 says, edges excepted; leaks: of the sampled rays at edges and corners \
             those that went through the closed surface. What is told that rays are \
             incoherent is told so of all.\n";
    for scene in distinct(lines, |line| text(line, "scene")) {
        let here: Vec<Value> =
            lines.iter().filter(|line| line["scene"] == scene.as_str()).cloned().collect();
        let _ = writeln!(out, "\n### {scene}, {} triangles\n", here[0]["triangles"]);
        *out += "| | primary | incoherent | shadow | of the limit | kept | peak | geometry \
                 | build ms | wrong | leaks |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
        for name in distinct(&here, who) {
            let mine: Vec<_> = here.iter().filter(|line| who(line) == name).collect();
            let set = |set: &str| mine.iter().find(|line| line["rays"] == set);
            let speed = |name: &str| {
                let Some(line) = set(name) else { return String::new() };
                let mega = line["rays_per_s"].as_f64().unwrap_or(0.0) / 1e6;
                let mut cell = format!("{mega:.2}");
                if line["tests_per_ray"].is_number() {
                    let _ = write!(cell, " ({}", number(line, "tests_per_ray", 1));
                    if line["steps_per_ray"].is_number() {
                        let _ = write!(cell, ", {}", number(line, "steps_per_ray", 1));
                    }
                    cell.push(')');
                }
                cell
            };
            let share: f64 = ["primary", "incoherent", "shadow"]
                .iter()
                .filter_map(|name| set(name)?["of_limit"].as_f64())
                .map(f64::ln)
                .sum();
            let line = mine[0];
            let each = |key: &str| {
                let n = line["triangles"].as_f64().unwrap_or(1.0);
                format!("{:.1}", line[key].as_f64().unwrap_or(0.0) / n)
            };
            let wrong: u64 = mine
                .iter()
                .filter(|line| line["rays"] != "edges")
                .filter_map(|line| Some(line["wrong"].as_u64()? - line["wrong_at_edges"].as_u64()?))
                .sum();
            let leaks = set("edges")
                .map_or("–".into(), |line| format!("{} of {}", line["leaks"], line["sample"]));
            let _ = writeln!(
                out,
                "| {name} | {} | {} | {} | {:.0} % | {} | {} | {} | {:.2} | {wrong} | {leaks} |",
                speed("primary"),
                speed("incoherent"),
                speed("shadow"),
                (share / 3.0).exp() * 100.0,
                each("bytes_kept"),
                each("bytes_peak"),
                each("bytes_geometry"),
                line["build_s"].as_f64().unwrap_or(0.0) * 1e3,
            );
        }
    }
}

fn pictures(lines: &[Value], out: &mut String) {
    let programs = distinct(lines, |line| text(line, "peer"));
    *out += "512x512, one thread, seconds of processor time for tracing alone; last: how many times \
             faster kibiray with all memory is than the better of the others.\n\n| scene | shapes |";
    programs.iter().for_each(|name| *out += &format!(" {name} |"));
    *out += " ratio |\n|---|---|---|";
    programs.iter().for_each(|_| *out += "---|");
    out.push('\n');
    let mut ratios = vec![];
    for scene in distinct(lines, |line| text(line, "scene")) {
        let here: Vec<_> = lines.iter().filter(|line| line["scene"] == scene.as_str()).collect();
        let _ = write!(out, "| {scene} | {} |", here[0]["shapes"]);
        let (mut ours, mut theirs) = (f64::NAN, f64::INFINITY);
        for name in &programs {
            let line = here.iter().find(|line| line["peer"] == name.as_str());
            let seconds = line.and_then(|line| line["frame_s"].as_f64());
            match (name.starts_with("kibiray"), seconds) {
                (true, Some(s)) => ours = s,
                (false, Some(s)) => theirs = theirs.min(s),
                _ => {}
            }
            let _ = write!(out, " {} |", seconds.map_or("–".into(), |s| format!("{s:.3}")));
        }
        let ratio = theirs / ours;
        if ratio.is_finite() {
            ratios.push(ratio.ln());
        }
        let _ = writeln!(out, " {ratio:.2} |");
    }
    if !ratios.is_empty() {
        let mean = (ratios.iter().sum::<f64>() / ratios.len() as f64).exp();
        let _ = writeln!(out, "\nGeometric mean of the ratios: {mean:.2}.");
    }
}

fn growth(lines: &[Value], out: &mut String) {
    *out += "What `auto` chooses with memory for everything; the published counting rays. Build time \
             is by the clock on the wall.\n\n\
             | scene | shapes | µs a ray | tests a ray | steps a ray | bytes a shape (peak) \
             | build, µs a reference |\n|---|---|---|---|---|---|---|\n";
    for line in lines {
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} ({}) | {} |",
            text(line, "scene"),
            number(line, "shapes", 0),
            number(line, "us_per_ray", 3),
            number(line, "tests_per_ray", 2),
            number(line, "steps_per_ray", 2),
            number(line, "bytes_per_shape", 1),
            number(line, "bytes_per_shape_peak", 1),
            number(line, "build_us_per_reference", 3),
        );
    }
    for scene in distinct(lines, |line| text(line, "scene")) {
        let slope = |key| slope(&points(lines, &scene, key, 800.0));
        let (time, steps) = (slope("us_per_ray"), slope("steps_per_ray"));
        let _ = writeln!(
            out,
            "\n{scene}, from 800 shapes on: time a ray grows as shapes^{time:.2}, steps as \
             shapes^{steps:.2}."
        );
    }
}

/// A key against the number of shapes, for scenes of at least so many.
pub fn points(lines: &[Value], scene: &str, key: &str, least: f64) -> Vec<(f64, f64)> {
    let here = lines.iter().filter(|line| line["scene"] == scene);
    here.filter_map(|line| Some((line["shapes"].as_f64()?, line[key].as_f64()?)))
        .filter(|point| point.0 >= least)
        .collect()
}
