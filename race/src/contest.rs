//! Ray queries: everyone gets the same rays, round by round.

use crate::mesh::{KNOTS, Mesh};
use crate::oracle::Oracle;
use crate::peer::{self, Built, MISS, ours};
use crate::rays::{Query, Set};
use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use std::path::Path;

/// Triangle tests that right answers may cost, a ray set.
const ORACLE_TESTS: f64 = 2e8;

/// A contestant, its results so far.
struct Entry {
    name: String,
    budget: String,
    built: Built,
    seconds: f64,
    answers: Vec<(f32, u32)>,
}

impl Entry {
    fn new(name: &str, budget: &str, built: Built) -> Self {
        Self {
            name: name.into(),
            budget: budget.into(),
            built,
            seconds: f64::INFINITY,
            answers: vec![],
        }
    }

    fn is(&self, name: &str, built: &Built) -> bool {
        self.name == name && self.built.bytes_kept == built.bytes_kept
    }

    fn and_more(&mut self) {
        if !self.budget.ends_with(" or more") {
            self.budget += " or more";
        }
    }

    fn answer(&mut self, set: &Set) {
        self.answers.resize(set.rays.len(), MISS);
        let seconds = self.built.batch.answer(set.query, &set.rays, &mut self.answers);
        self.seconds = self.seconds.min(seconds);
    }
}

/// A bar that tells what is going on.
pub fn progress(steps: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{elapsed_precise} {bar:30} {pos}/{len} {msg}");
    ProgressBar::new(steps as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Runs all scenes and ray sets; gives a line a contestant, scene and set.
pub fn run(
    repeat: usize,
    scenes: &[String],
    peers: &[String],
    sponza: Option<&Path>,
) -> Result<Vec<Value>> {
    let mut lines = vec![];
    let wanted = |name: &str| scenes.is_empty() || scenes.iter().any(|scene| scene == name);
    let mut meshes: Vec<_> =
        KNOTS.into_iter().filter(|knot| wanted(knot.0)).map(Mesh::knot).collect();
    if let Some(path) = sponza.filter(|_| wanted("sponza")) {
        meshes.push(Mesh::sponza(path)?);
    }
    let runs = |name: &str| peers.is_empty() || peers.iter().any(|peer| name.starts_with(peer));
    for mesh in meshes {
        let scene = ours::scene(&mesh).map_err(anyhow::Error::msg)?;
        let mut entries = vec![];
        let mut enter = |name: &str, budget, built: Result<Built, String>| match built {
            // What took no more before takes no more now: the same.
            Ok(built) if entries.last().is_some_and(|last: &Entry| last.is(name, &built)) => {
                if let Some(last) = entries.last_mut() {
                    last.and_more();
                }
            }
            Ok(built) => entries.push(Entry::new(name, budget, built)),
            Err(why) => lines.push(json!({
                "scene": mesh.name, "peer": name, "budget": budget, "error": why,
            })),
        };
        for choice in ours::choices(mesh.len()).iter().filter(|choice| runs(choice.name)) {
            enter(choice.name, choice.budget, ours::build(scene, choice));
        }
        for (name, build) in peer::OTHERS.into_iter().filter(|peer| runs(peer.0)) {
            enter(name, "", build(&mesh));
        }
        for set in Set::all(&mesh) {
            lines.extend(one_set(&mesh, scene, &set, &mut entries, repeat));
        }
    }
    Ok(lines)
}

fn one_set(
    mesh: &Mesh,
    scene: ours::Triangles,
    set: &Set,
    entries: &mut Vec<Entry>,
    repeat: usize,
) -> Vec<Value> {
    // What the limit has to know, from the answers to all as nearest-hit queries.
    let mut known = vec![MISS; set.rays.len()];
    if let Some(one) = entries.iter_mut().find(|entry| entry.name == "kibiray bvh") {
        one.built.batch.answer(Query::Nearest, &set.rays, &mut known);
    }
    entries.push(Entry::new("limit", "", ours::limit(scene, &known)));
    entries.iter_mut().for_each(|entry| entry.seconds = f64::INFINITY);
    let bar = progress(repeat * entries.len() + 1);
    // Round by round: a noisy minute then hits everyone alike.
    for _ in 0..repeat {
        for entry in entries.iter_mut() {
            bar.set_message(format!("{} {} {}", mesh.name, set.name, entry.name));
            entry.answer(set);
            bar.inc(1);
        }
    }
    bar.set_message(format!("{} {} right answers", mesh.name, set.name));
    let oracle = Oracle::new(mesh, &set.rays, ORACLE_TESTS);
    let best = entries.last().map_or(0.0, |limit| limit.seconds);
    let n = set.rays.len() as f64;
    let lines = entries.iter_mut().map(|entry| {
        let verdict = oracle.judge(set.query, &set.rays, &entry.answers);
        let work = entry.built.batch.work(set.query, &set.rays);
        json!({
            "scene": mesh.name, "triangles": mesh.len(), "rays": set.name,
            "peer": entry.name, "budget": entry.budget,
            "rays_per_s": n / entry.seconds, "of_limit": best / entry.seconds,
            "tests_per_ray": work.map(|(tests, _)| tests as f64 / n),
            "steps_per_ray": work.and_then(|(_, steps)| steps).map(|steps| steps as f64 / n),
            "bytes_kept": entry.built.bytes_kept, "bytes_peak": entry.built.bytes_peak,
            "bytes_geometry": entry.built.bytes_geometry, "build_s": entry.built.build,
            "hits": entry.answers.iter().filter(|hit| **hit != MISS).count(),
            "sample": oracle.answers.len(), "wrong": verdict.wrong,
            "wrong_at_edges": verdict.at_edges, "leaks": verdict.leaks,
            "wrong_ids": verdict.wrong_ids, "max_rel_t_error": verdict.max_rel_t,
        })
    });
    let lines = lines.collect();
    entries.pop();
    bar.finish_and_clear();
    lines
}
