//! The report for people: a table on the terminal.

use std::fmt::Write;
use std::path::Path;

use kibiray::plan::Plan;

use crate::costs::BoundedReport;
use crate::image::HeatMap;
use crate::report::{AccelReport, MemoryReport, Report, TimeReport};
use crate::values::readable;

/// What the table tells besides the report.
#[derive(Debug)]
pub struct Outcome<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Where the picture is.
    pub output: &'a Path,
    /// Where the heat map is, and what its colours mean.
    pub heat: Option<&'a (&'a Path, HeatMap)>,
    /// Threads that traced.
    pub threads: u16,
}

/// Width of a bar that is full.
const BAR: usize = 32;

/// The table.
pub fn table(report: &Report, outcome: &Outcome<'_>) -> String {
    let mut rows = Rows::default();
    let scene = &report.scene;
    let skipped = match scene.skipped {
        0 => String::new(),
        n => format!(", {} left out", plural(n, "shape")),
    };
    rows.add(
        "scene",
        format!(
            "{}: {}{skipped}, {}, {} of tables (flash)",
            scene.name,
            plural(scene.primitives, "primitive"),
            plural(scene.lights, "light"),
            readable(scene.bytes)
        ),
    );
    rows.add("plan", format!("{} ({})", structure(&report.accel), outcome.plan.reason));
    rows.more(format!("mailbox {}, numbers {}", report.accel.mailbox, report.num));
    memory(&mut rows, &report.memory);
    work(&mut rows, report);
    let TimeReport { load_s, build_s, trace_s, rays_per_s, .. } = report.time;
    rows.add(
        "time",
        format!(
            "load {}, build {}, trace {} on {}, {} rays a second",
            seconds(load_s),
            seconds(build_s),
            seconds(trace_s),
            plural(outcome.threads.into(), "thread"),
            thousands(rays_per_s as u64)
        ),
    );
    if let Some(image) = &report.image {
        let path = outcome.output.display();
        rows.add(
            "image",
            format!("{path}, {}x{}, CRC-32 {}", image.width, image.height, image.crc32),
        );
    }
    if let Some((path, heat)) = outcome.heat {
        rows.add("heat map", format!("{}: tests and steps of every pixel", path.display()));
        let half = heat.brightest / 2;
        rows.more(format!("black 0, red {half}, pale yellow {} and more", heat.brightest));
        rows.more(format!("half of the pixels up to {}, the worst {}", heat.median, heat.most));
    }
    rows.text
}

fn structure(accel: &AccelReport) -> String {
    if let Some(kinds) = &accel.bounded {
        let kind = |it: &BoundedReport| {
            let BoundedReport { kind, count, bounded, bound_ns, test_ns } = it;
            format!("{kind} {bounded} of {count}, {bound_ns} ns to save {test_ns}")
        };
        let kinds: Vec<_> = kinds.iter().map(kind).collect();
        return format!("spheres around shapes where they pay: {}", kinds.join("; "));
    }
    let leaves = accel.leaves.unwrap_or(0);
    if let (Some(nodes), Some(mean), Some(level)) =
        (accel.interior_nodes, accel.shapes_per_leaf, accel.max_level)
    {
        let tree = format!("hierarchy of {nodes} nodes on {level} levels");
        return format!("{tree}: {leaves} leaves of {mean:.1} shapes");
    }
    let lists = format!(
        "{} empty, {} references",
        accel.empty_leaves.unwrap_or(0),
        accel.references.unwrap_or(0)
    );
    match (accel.resolution, accel.max_level) {
        (Some([x, y, z]), _) => format!("grid {x}x{y}x{z}: {leaves} cells, {lists}"),
        (_, Some(level)) => {
            let stop = match accel.stopped_by {
                Some("memory") => ", stopped by memory",
                Some("level") => ", stopped by depth",
                _ => "",
            };
            format!("octree to level {level}{stop}: {leaves} leaves, {lists}")
        }
        _ => "no structure, every shape is tested".into(),
    }
}

fn memory(rows: &mut Rows, memory: &MemoryReport) {
    let MemoryReport { capacity_bytes, used_bytes, high_water_bytes, parts } = memory;
    let share = |bytes: usize| 100.0 * bytes as f64 / (*capacity_bytes).max(1) as f64;
    rows.add("memory", format!("{} in the arena", readable(*capacity_bytes)));
    let used = parts.iter().map(|part| (part.name, part.bytes));
    let totals = [("used", *used_bytes), ("high water", *high_water_bytes)];
    for (name, bytes) in used.chain(totals) {
        let length = (share(bytes) / 100.0 * BAR as f64).round() as usize;
        let bar = "#".repeat(length.min(BAR));
        rows.more(format!("{name:<16} {bytes:>9} B {:>6.1} %  |{bar:<BAR$}|", share(bytes)));
    }
}

fn work(rows: &mut Rows, report: &Report) {
    let rays = &report.rays;
    rows.add("rays", format!("{:>12} {:>12}", "shot", "hit"));
    if let Some(kinds) = &rays.kinds {
        let kinds = [
            ("primary", kinds.primary, kinds.primary_hits),
            ("shadow", kinds.shadow, kinds.shadow_hits),
            ("secondary", kinds.secondary, kinds.secondary_hits),
        ];
        for (name, shot, hit) in kinds {
            rows.named(name, format!("{:>12} {:>12}", thousands(shot), thousands(hit)));
        }
    }
    rows.named("all", format!("{:>12} {:>12}", thousands(rays.total), thousands(rays.hits)));
    let work = &report.work;
    let per_ray = |n: u64| n as f64 / rays.total.max(1) as f64;
    rows.add(
        "a ray takes",
        format!(
            "{:.2} tests, {:.2} traversal steps, {:.2} leaves ({:.2} empty), {:.2} tests skipped",
            per_ray(work.primitive_tests),
            per_ray(work.traversal_steps),
            per_ray(work.leaves_visited),
            per_ray(work.empty_leaves_visited),
            per_ray(work.mailbox_skips)
        ),
    );
}

/// Lines with their names aligned.
#[derive(Default)]
struct Rows {
    text: String,
}

impl Rows {
    fn add(&mut self, name: &str, value: String) {
        self.named(name, value);
    }

    fn more(&mut self, value: String) {
        self.named("", value);
    }

    fn named(&mut self, name: &str, value: String) {
        // Writing into a string cannot fail.
        let _ = writeln!(self.text, "{name:<12} {value}");
    }
}

fn plural(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn seconds(s: f64) -> String {
    if s < 1.0 { format!("{:.1} ms", s * 1e3) } else { format!("{s:.2} s") }
}

/// Digits in groups of three.
fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_come_in_threes() {
        assert_eq!(thousands(0), "0");
        assert_eq!(thousands(999), "999");
        assert_eq!(thousands(1000), "1,000");
        assert_eq!(thousands(1_234_567), "1,234,567");
    }
}
