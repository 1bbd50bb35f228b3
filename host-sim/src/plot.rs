//! Plots, as SVG.

use plotters::prelude::*;

/// A line through points, in the order of x.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What the legend says.
    pub name: String,
    /// Its points, all greater than 0.
    pub points: Vec<(f64, f64)>,
}

/// Pixels of a plot.
const SIZE: (u32, u32) = (800, 500);

/// Curves over logarithmic axes; `mark`: an upright line.
///
/// # Errors
/// The drawing library's.
pub fn log_log(
    title: &str,
    x_axis: &str,
    curves: &[Curve],
    mark: Option<f64>,
) -> anyhow::Result<String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let all = || curves.iter().flat_map(|curve| &curve.points);
        let range = |values: &mut dyn Iterator<Item = f64>| {
            let (lo, hi) =
                values.fold((f64::INFINITY, 0.0_f64), |(lo, hi), v| (lo.min(v), hi.max(v)));
            if lo <= hi { lo / 1.3..hi * 1.3 } else { 0.5..2.0 }
        };
        let (x, y) = (range(&mut all().map(|p| p.0)), range(&mut all().map(|p| p.1)));
        let mut chart = ChartBuilder::on(&root)
            .caption(title, ("sans-serif", 22))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(60)
            .build_cartesian_2d(x.log_scale(), y.clone().log_scale())?;
        chart.configure_mesh().x_desc(x_axis).label_style(("sans-serif", 15)).draw()?;
        for (i, curve) in curves.iter().enumerate() {
            let style = Palette99::pick(i).stroke_width(2);
            chart
                .draw_series(LineSeries::new(curve.points.iter().copied(), style).point_size(3))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], style));
        }
        if let Some(mark) = mark {
            let line = [(mark, y.start), (mark, y.end)];
            chart
                .draw_series(LineSeries::new(line, BLACK.mix(0.4)))?
                .label("knee")
                .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], BLACK.mix(0.4)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 15))
            .draw()?;
        root.present()?;
    }
    Ok(svg)
}
