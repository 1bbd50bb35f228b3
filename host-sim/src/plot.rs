//! Plots, as SVG and PNG.

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

/// Points of one kind.
#[derive(Clone, Debug)]
pub struct Cloud {
    /// What the legend says.
    pub name: String,
    /// Its points, all greater than 0.
    pub points: Vec<(f64, f64)>,
}

/// Clouds over logarithmic axes, and the line along which nothing is better in both.
///
/// # Errors
/// The drawing library's.
pub fn clouds(
    title: &str,
    x_axis: &str,
    y_axis: &str,
    clouds: &[Cloud],
    front: &[(f64, f64)],
) -> anyhow::Result<String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let all = || clouds.iter().flat_map(|cloud| &cloud.points);
        let (x, y) = (range(&mut all().map(|p| p.0)), range(&mut all().map(|p| p.1)));
        let mut chart = ChartBuilder::on(&root)
            .caption(title, ("sans-serif", 22))
            .margin(12)
            .x_label_area_size(50)
            .y_label_area_size(64)
            .build_cartesian_2d(x.log_scale(), y.log_scale())?;
        chart
            .configure_mesh()
            .x_desc(x_axis)
            .y_desc(y_axis)
            .light_line_style(TRANSPARENT)
            .x_label_formatter(&|x| short(*x))
            .y_label_formatter(&|y| short(*y))
            .label_style(("sans-serif", 15))
            .draw()?;
        let line = BLACK.mix(0.6).stroke_width(1);
        chart
            .draw_series(LineSeries::new(front.iter().copied(), line))?
            .label("nothing is faster and better")
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], line));
        for (i, cloud) in clouds.iter().enumerate() {
            // Two neighbours in the list: rings and discs.
            let color = Palette99::pick(i).to_rgba();
            let style = if i % 2 == 0 { color.stroke_width(2) } else { color.filled() };
            chart
                .draw_series(cloud.points.iter().map(|p| Circle::new(*p, 5, style)))?
                .label(cloud.name.as_str())
                .legend(move |(x, y)| Circle::new((x + 10, y), 5, style));
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

/// A range of numbers with room on both sides.
fn range(values: &mut dyn Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (lo, hi) = values.fold((f64::INFINITY, 0.0_f64), |(lo, hi), v| (lo.min(v), hi.max(v)));
    if lo <= hi { lo / 1.3..hi * 1.3 } else { 0.5..2.0 }
}

/// A number at an axis.
fn short(x: f64) -> String {
    if x >= 10.0 {
        format!("{x:.0}")
    } else {
        format!("{x:.2}").trim_end_matches('0').trim_end_matches('.').into()
    }
}

/// An SVG as the content of a PNG file, in the fonts that this host has.
///
/// # Errors
/// It is no SVG.
pub fn png(svg: &str) -> anyhow::Result<Vec<u8>> {
    let mut options = resvg::usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    // Any without serifs, or the first there is.
    let names = fonts.faces().filter_map(|face| Some(face.families.first()?.0.clone()));
    let names: Vec<String> = names.collect();
    let plain = |name: &&String| name.ends_with(" Sans");
    if let Some(name) = names.iter().find(plain).or(names.first()) {
        fonts.set_sans_serif_family(name.clone());
    }
    let tree = resvg::usvg::Tree::from_str(svg, &options)?;
    let no_picture = || anyhow::anyhow!("no room for a picture");
    let mut pixels = resvg::tiny_skia::Pixmap::new(SIZE.0, SIZE.1).ok_or_else(no_picture)?;
    resvg::render(&tree, resvg::tiny_skia::Transform::default(), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}
