//! Results as SVG, over logarithmic axes.

use crate::table::points;
use anyhow::Result;
use plotters::coord::Shift;
use plotters::prelude::*;
use serde_json::Value;

struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
}

/// Speed against bytes kept, a panel a scene: kibiray's structures as curves over their budgets.
pub fn speed(lines: &[Value]) -> Result<String> {
    let mut scenes: Vec<&str> = lines.iter().filter_map(|line| line["scene"].as_str()).collect();
    scenes.dedup();
    let rays = "incoherent";
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (1200, 560)).into_drawing_area();
        root.fill(&WHITE)?;
        let panels = root.split_evenly((1, scenes.len().max(1)));
        for (i, (scene, panel)) in scenes.iter().zip(&panels).enumerate() {
            let here: Vec<_> =
                lines.iter().filter(|l| l["scene"] == *scene && l["rays"] == rays).collect();
            let mut curves: Vec<Curve> = vec![];
            for line in here {
                let get = |key: &str| line[key].as_f64();
                let name = line["peer"].as_str().unwrap_or_default().to_string();
                let (Some(speed), Some(kept), Some(n)) =
                    (get("rays_per_s"), get("bytes_kept"), get("triangles"))
                else {
                    continue;
                };
                // No structure has no place on a logarithmic axis.
                if kept == 0.0 {
                    continue;
                }
                let point = (kept / n, speed / 1e6);
                match curves.iter_mut().find(|curve| curve.name == name) {
                    Some(curve) => curve.points.push(point),
                    None => curves.push(Curve { name, points: vec![point] }),
                }
            }
            let title = format!("{scene}, {rays} rays");
            let axes = ["bytes a triangle, kept", "million rays a second"];
            if !curves.is_empty() {
                draw(panel, &title, axes, &curves, i == 0)?;
            }
        }
        root.present()?;
    }
    Ok(svg)
}

/// Time and steps a ray against the number of shapes.
pub fn size(lines: &[Value]) -> Result<String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (1000, 460)).into_drawing_area();
        root.fill(&WHITE)?;
        let keys = [("us_per_ray", "µs a ray"), ("steps_per_ray", "steps a ray")];
        for ((key, name), panel) in keys.iter().zip(root.split_evenly((1, 2))) {
            let curve = |scene: &str| Curve {
                name: scene.to_string(),
                points: points(lines, scene, key, 0.0),
            };
            draw(&panel, name, ["shapes", name], &["balls", "tetra"].map(curve), true)?;
        }
        root.present()?;
    }
    Ok(svg)
}

fn draw<D: DrawingBackend>(
    area: &DrawingArea<D, Shift>,
    title: &str,
    [x_axis, y_axis]: [&str; 2],
    curves: &[Curve],
    legend: bool,
) -> Result<()>
where
    D::ErrorType: 'static,
{
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, 0.0_f64), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let (left, right) = ends(&mut all().map(|p| p.0));
    let (low, high) = ends(&mut all().map(|p| p.1));
    // Numbers begin at a power of ten. The legend needs room above.
    let low = 0.999 * 10_f64.powf(low.log10().floor());
    let x = left / 1.3..right * 1.3;
    let y = low..high * if legend { 4.0 } else { 1.3 };
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 20))
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    let number = |x: &f64| format!("{}", (x * 1e3).round() / 1e3);
    let mut mesh = chart.configure_mesh();
    mesh.x_labels(4)
        .y_labels(20)
        .max_light_lines(1)
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .x_desc(x_axis)
        .y_desc(y_axis)
        .label_style(("sans-serif", 14))
        .draw()?;
    for curve in curves {
        let style = colour(&curve.name).stroke_width(2);
        let mut points = curve.points.clone();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        chart
            .draw_series(LineSeries::new(points, style.filled()).point_size(4))?
            .label(curve.name.as_str())
            .legend(move |(x, y)| Circle::new((x + 10, y), 4, style.filled()));
    }
    if legend {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 13))
            .draw()?;
    }
    Ok(())
}

/// The same for a name in every panel.
fn colour(name: &str) -> PaletteColor<Palette99> {
    let known = [
        "kibiray bvh",
        "kibiray octree",
        "kibiray grid",
        "Embree 3.13",
        "Embree 3.13 compact, robust",
        "obvhs 0.4 BVH2",
        "obvhs 0.4 CWBVH",
        "parry3d 0.31",
        "bvh 0.13",
        "kibiray bvh for incoherent rays",
    ];
    Palette99::pick(known.iter().position(|k| *k == name).unwrap_or(usize::from(name == "tetra")))
}
