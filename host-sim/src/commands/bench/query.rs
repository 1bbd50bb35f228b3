//! Queries: how far a number format's hits are from those of doubles.

use kibiray::accel::{Accel, Any, Hit, Kind, mailbox};
use kibiray::geom::{Interval, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Camera, Scene, Shapes};
use serde::Serialize;

use super::name_of;
use crate::commands::stage::{self, Loaded, Stage, TooLittle};
use crate::engine::{Memory, Picture, fastest};
use crate::options::{Bench, Common};
use crate::tables::{HostShapes, Tables};

/// A measure's median, 99th percentile and maximum.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Spread {
    pub(super) median: f64,
    pub(super) p99: f64,
    pub(super) max: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let place = (part * values.len().saturating_sub(1) as f64).round() as usize;
            values.get(place).copied().unwrap_or_default()
        };
        Self { median: at(0.5), p99: at(0.99), max: at(1.0) }
    }
}

/// What one number format, structure and arena give.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) num: String,
    pub(super) accel: String,
    pub(super) ram: usize,
    /// None where the structure has no room.
    #[serde(flatten)]
    pub(super) measured: Option<Measured>,
}

/// Errors against doubles on the same rays, in the shapes as the scene's file has them.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Measured {
    pub(super) rays: usize,
    pub(super) hits: usize,
    /// |t - t64|, in parts of the scene's diagonal.
    pub(super) t_of_scene: Spread,
    /// The same in units in the last place of the number format.
    pub(super) t_ulp: Spread,
    /// Degrees between normals.
    pub(super) normal_degrees: Spread,
    /// Rays that name another shape than in doubles, or hit or miss otherwise.
    pub(super) wrong_ids: usize,
    /// Of these, those that doubles answer so, too, on one of eight rays beside, as far away as a
    /// shape may claim hits outside its box.
    pub(super) explained: usize,
    /// By processor time.
    pub(super) rays_per_s: f64,
    /// In parts of the first row's.
    pub(super) speed: f64,
}

/// Fills in what is told relative to the first row.
pub(super) fn relate(rows: &mut [Row]) {
    let mut first = None;
    for row in rows.iter_mut().filter_map(|row| row.measured.as_mut()) {
        row.speed = row.rays_per_s / *first.get_or_insert(row.rays_per_s);
    }
}

pub(super) fn row<R: Real>(
    options: &Bench,
    loaded: &Loaded,
    common: &Common,
    ram: usize,
) -> anyhow::Result<Row> {
    let mut measured = None;
    let done = stage::set::<R>(loaded, common, ram, Picture::NONE, |stage| {
        measured = Some(measure(options, loaded, stage)?);
        Ok(())
    });
    match done {
        Err(error) if error.is::<TooLittle>() => {}
        done => done?,
    }
    Ok(Row { num: name_of(&common.num), accel: name_of(&common.accel), ram, measured })
}

/// Doubles: a scene and a structure over it.
struct Exact<'a> {
    scene: &'a Scene<'a, f64, HostShapes<'a, f64>>,
    accel: Any<'a, f64>,
}

impl Exact<'_> {
    fn nearest(&self, ray: &Ray<f64>) -> Option<Hit<f64>> {
        self.accel.nearest(self.scene, ray, Interval::RAY, &mut mailbox::Off, &mut ())
    }
}

fn measure<R: Real>(
    options: &Bench,
    loaded: &Loaded,
    stage: Stage<'_, R>,
) -> anyhow::Result<Measured> {
    let Stage { tables, scene, frame, mut built, .. } = stage;
    let camera = Camera::new(tables.view(), R::ONE)?;
    let side = i32::from(options.rays) - 1;
    let across = |i: i32| R::fraction(2 * i - side, side);
    let rays: Vec<Ray<R>> = (0..=side)
        .flat_map(|y| (0..=side).map(move |x| (x, y)))
        .filter_map(|(x, y)| camera.ray(across(x), -across(y)))
        .collect();

    let moved = frame.apply(&loaded.description);
    let exact_tables = Tables::<f64>::new(&moved)?;
    let polygons = exact_tables.polygons();
    let exact_scene = exact_tables.scene(&polygons)?;
    let kind = Kind::Bvh(exact_scene.shapes().bounded());
    let mut memory = Memory::new(Any::footprint(kind, &exact_scene)?.peak)?;
    let accel = Any::build(kind, &exact_scene, &mut memory.arena())?;
    let exact = Exact { scene: &exact_scene, accel };

    let mut off = mailbox::Lists::new(mailbox::AnyMailbox::Off, false);
    let mailbox = built.mailboxes.first_mut().unwrap_or(&mut off);
    let accel = &built.accel;
    let pass = fastest(options.repeat + 1, || {
        for ray in &rays {
            std::hint::black_box(accel.nearest(scene, ray, Interval::RAY, mailbox, &mut ()));
        }
    });

    let size = exact_scene.bounds().size();
    let diagonal = size.dot(size).sqrt();
    let aside = 2.0 * scene.slack().to_f64();
    let (mut hits, mut wrong_ids, mut explained) = (0, 0, 0);
    let (mut of_scene, mut ulps, mut degrees) = (Vec::new(), Vec::new(), Vec::new());
    for ray in &rays {
        let wide = |v: Vec3<R>| glam::DVec3::from_array(v.to_array().map(R::to_f64));
        let (o, d) = (wide(ray.origin()), wide(ray.direction()));
        let Ok(wide_ray) = Ray::<f64>::new(o, d) else { continue };
        let found = accel.nearest(scene, ray, Interval::RAY, mailbox, &mut ());
        let right = exact.nearest(&wide_ray);
        hits += usize::from(found.is_some());
        let id = found.map(|hit| tables.file_id(hit.id));
        let named = |hit: Option<Hit<f64>>| hit.map(|hit| exact_tables.file_id(hit.id));
        if id != named(right) {
            wrong_ids += 1;
            let beside = beside(o, d, aside).any(|ray| named(exact.nearest(&ray)) == id);
            explained += usize::from(beside);
            continue;
        }
        let (Some(found), Some(right)) = (found, right) else { continue };
        let error = (found.t.to_f64() - right.t).abs();
        of_scene.push(error * d.length() / diagonal);
        let near = R::from_f64(right.t);
        ulps.push(error / (near.next_up().to_f64() - near.to_f64()));
        let normals = (scene.surface(ray, &found), exact_scene.surface(&wide_ray, &right));
        if let (Some(a), Some(b)) = normals {
            let (a, b) = (wide(a.normal), b.normal);
            degrees.push(a.cross(b).length().atan2(a.dot(b)).to_degrees());
        }
    }
    Ok(Measured {
        rays: rays.len(),
        hits,
        t_of_scene: Spread::of(of_scene),
        t_ulp: Spread::of(ulps),
        normal_degrees: Spread::of(degrees),
        wrong_ids,
        explained,
        rays_per_s: rays.len() as f64 / pass.cpu_s.max(1e-9),
        speed: 1.0,
    })
}

/// Eight rays around one, at a distance.
fn beside(o: glam::DVec3, d: glam::DVec3, distance: f64) -> impl Iterator<Item = Ray<f64>> {
    let a = d.normalize().any_orthonormal_vector();
    let b = d.cross(a).normalize();
    (0..8).filter_map(move |k| {
        let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        Ray::new(o + (a * c + b * s) * distance, d).ok()
    })
}
