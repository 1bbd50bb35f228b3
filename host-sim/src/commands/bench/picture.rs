//! Pictures: how far those of few rays are from one of very many.

use image_compare::Algorithm;
use image_compare::prelude::RgbImage;
use indicatif::ProgressBar;
use kibiray::num::{Fixed, Real};
use kibiray::scene::Camera;
use kibiray::trace::{Secondary, Settings};
use serde::Serialize;

use super::{SceneReport, name_of};
use crate::commands::stage::{self, Loaded, Stage};
use crate::engine::Picture;
use crate::image::Image;
use crate::options::{Antialiasing, Bench, Common, Number};
use crate::picture::{self, Rendered};
use crate::plot::{self, Cloud};

/// Along an edge of a pixel, for the picture that others are compared with: 256 in all.
const REFERENCE: u8 = 16;

/// Memory enough for every picture's structure and samples.
const AMPLE: usize = 64 << 20;

/// How a picture is made.
#[derive(Clone, Copy)]
pub(super) struct Way {
    pub(super) num: Number,
    pub(super) aa: Antialiasing,
    pub(super) cutoff: f64,
    /// Whether rays are left out by their share at all, those that add nothing too; otherwise
    /// recursion ends by depth alone.
    pub(super) adaptive_recursion: bool,
}

/// What a way to make the picture gives.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) num: String,
    pub(super) aa: String,
    pub(super) cutoff: f64,
    /// Root of the mean squared error against 256 rays a pixel in doubles, in levels of 8 bits.
    pub(super) rmse: f64,
    /// Mean structural similarity to it, 1 for the same (Z. Wang et al., IEEE TIP 13(4), 2004).
    pub(super) ssim: f64,
    pub(super) rays: u64,
    /// Processor time, in parts of the first row's.
    pub(super) time: f64,
    /// Whether no other is both as fast and as right.
    pub(super) best: bool,
    #[serde(skip)]
    image: Image,
}

pub(super) fn reference(
    options: &Bench,
    loaded: &Loaded,
    common: &Common,
) -> anyhow::Result<Image> {
    let aa = Antialiasing::Uniform(REFERENCE);
    let way = Way { num: Number::F64, aa, cutoff: 0.0, adaptive_recursion: true };
    let options = Bench { repeat: 0, ..options.clone() };
    Ok(shoot(&options, loaded, common, way)?.image)
}

fn shoot(options: &Bench, loaded: &Loaded, common: &Common, way: Way) -> anyhow::Result<Rendered> {
    match way.num {
        Number::F32 => render::<f32>(options, loaded, common, way),
        Number::F64 => render::<f64>(options, loaded, common, way),
        Number::Fixed => render::<Fixed>(options, loaded, common, way),
    }
}

fn render<R: Real>(
    options: &Bench,
    loaded: &Loaded,
    common: &Common,
    way: Way,
) -> anyhow::Result<Rendered> {
    let (width, height) = options.size;
    let picture = Picture { width, aa: way.aa };
    let mut rendered = None;
    stage::set::<R>(loaded, common, AMPLE, picture, |stage| {
        let Stage { tables, scene, built, .. } = stage;
        let camera = Camera::new(tables.view(), R::fraction(width.into(), height.into()))?;
        let secondary =
            if way.adaptive_recursion { Secondary::Contributing } else { Secondary::All };
        let settings =
            Settings { cutoff: R::from_f64(way.cutoff), secondary, ..Settings::default() };
        let bar = ProgressBar::hidden();
        let repeat = options.repeat + 1;
        let size = (width, height);
        rendered = Some(picture::render(scene, built, camera, settings, size, repeat, &bar));
        Ok(())
    })?;
    rendered.ok_or_else(|| anyhow::anyhow!("no picture"))
}

pub(super) fn row(
    options: &Bench,
    loaded: &Loaded,
    common: &Common,
    way: Way,
    reference: &Image,
) -> anyhow::Result<Row> {
    let Rendered { image, counters, pass, .. } = shoot(options, loaded, common, way)?;
    let [a, b] = [&image, reference].map(|image| {
        RgbImage::from_raw(image.width.into(), image.height.into(), image.rgb.clone())
    });
    let ssim = match (a, b) {
        (Some(a), Some(b)) => {
            image_compare::rgb_similarity_structure(&Algorithm::MSSIMSimple, &a, &b)?.score
        }
        _ => anyhow::bail!("no picture"),
    };
    Ok(Row {
        num: name_of(&way.num),
        aa: match way.aa {
            Antialiasing::Off => "off".into(),
            Antialiasing::Uniform(n) => format!("{n}x{n}"),
            Antialiasing::Adaptive(t) => format!("adaptive:{t}"),
        },
        cutoff: way.cutoff,
        rmse: rmse(&image, reference),
        ssim,
        rays: counters.primary.shot + counters.shadow.shot + counters.secondary.shot,
        time: pass.cpu_s.max(1e-9),
        best: false,
        image,
    })
}

/// In levels of 8 bits.
fn rmse(a: &Image, b: &Image) -> f64 {
    let squares = a.rgb.iter().zip(&b.rgb).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2));
    (squares.sum::<f64>() / a.rgb.len().max(1) as f64).sqrt()
}

/// Fills in what is told relative to other rows.
pub(super) fn relate(rows: &mut [Row]) {
    let Some(first) = rows.first().map(|row| row.time) else { return };
    rows.iter_mut().for_each(|row| row.time /= first);
    for i in 0..rows.len() {
        let (rmse, time) = (rows[i].rmse, rows[i].time);
        let better = |other: &Row| {
            other.rmse <= rmse && other.time <= time && (other.rmse < rmse || other.time < time)
        };
        rows[i].best = !rows.iter().any(better);
    }
}

/// What leaving out rays gains, in one number format.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Findings {
    pub(super) num: String,
    /// Error of 16 rays a pixel.
    pub(super) uniform_rmse: Option<f64>,
    /// Rays that adaptive sampling shoots for that error, in parts of those; between two
    /// thresholds by interpolation, none where all of them are worse.
    pub(super) adaptive_rays: Option<f64>,
    /// For each share below which rays are left out: of the rays of a picture with one a pixel whose
    /// recursion ends by depth alone, the part that is saved, and the error that it costs, in levels of
    /// 8 bits. Below 0: those that add nothing.
    pub(super) cutoffs: Vec<(f64, f64, f64)>,
}

pub(super) fn findings(rows: &[Row], by_depth: &[Row]) -> Vec<Findings> {
    let mut nums: Vec<&str> = rows.iter().map(|row| row.num.as_str()).collect();
    nums.dedup();
    nums.into_iter()
        .map(|num| {
            let all = || rows.iter().filter(move |row| row.num == num && row.cutoff == 0.0);
            let uniform = all().find(|row| row.aa == "4x4");
            let mut adaptive: Vec<_> = all()
                .filter(|row| row.aa.starts_with("adaptive"))
                .map(|row| (row.rmse, row.rays as f64))
                .collect();
            adaptive.sort_by(|a, b| b.0.total_cmp(&a.0));
            let needed = uniform.and_then(|uniform| rays_for(&adaptive, uniform.rmse));
            let whole = by_depth.iter().find(|row| row.num == num);
            let off = rows.iter().filter(|row| row.num == num && row.aa == "off");
            let cutoffs = whole.map_or_else(Vec::new, |whole| {
                off.map(|row| {
                    let saved = 1.0 - row.rays as f64 / whole.rays.max(1) as f64;
                    (row.cutoff, saved, rmse(&row.image, &whole.image))
                })
                .collect()
            });
            Findings {
                num: num.into(),
                uniform_rmse: uniform.map(|row| row.rmse),
                adaptive_rays: uniform.zip(needed).map(|(row, rays)| rays / row.rays as f64),
                cutoffs,
            }
        })
        .collect()
}

/// Rays for an error, on a curve of points from the greatest error to the least.
fn rays_for(curve: &[(f64, f64)], rmse: f64) -> Option<f64> {
    let reached = curve.iter().position(|(error, _)| *error <= rmse)?;
    let (error, rays) = curve[reached];
    let Some((before, fewer)) = reached.checked_sub(1).map(|i| curve[i]) else { return Some(rays) };
    let part = (before / rmse).ln() / (before / error).ln();
    Some((fewer.ln() + (rays / fewer).ln() * part).exp())
}

/// Time against error, a cloud for each number format and family of ways to sample.
pub(super) fn plot(scene: &SceneReport) -> anyhow::Result<String> {
    let family = |row: &Row| match row.aa.split(':').next() {
        Some("adaptive") => format!("{}, adaptive", row.num),
        _ => format!("{}, squares of rays", row.num),
    };
    let mut clouds: Vec<Cloud> = Vec::new();
    for row in scene.pictures.iter().filter(|row| row.rmse > 0.0) {
        let name = family(row);
        let point = (row.time, row.rmse);
        match clouds.iter_mut().find(|cloud| cloud.name == name) {
            Some(cloud) => cloud.points.push(point),
            None => clouds.push(Cloud { name, points: vec![point] }),
        }
    }
    let mut front: Vec<_> = scene
        .pictures
        .iter()
        .filter(|row| row.best && row.rmse > 0.0)
        .map(|row| (row.time, row.rmse))
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    plot::clouds(
        &scene.name,
        "processor time, in that of the first: one ray a pixel",
        "RMSE against 256 rays a pixel, in levels of 8 bits",
        &clouds,
        &front,
    )
}
