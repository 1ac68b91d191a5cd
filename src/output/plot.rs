//! Charts as SVG: curves with labelled axes over a map of colours, special points marked. Only this
//! module knows the library that draws them.

use std::sync::Arc;

use super::quantity::with_unit;
use crate::algebra::SiUnit;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{ColorMap, Heatmap, LegendPosition, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

/// A curve in a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is called in the legend.
    pub label: String,
    /// Its points in order; a gap is a point that is not finite.
    pub points: Vec<(f64, f64)>,
}

/// Points that are marked alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// What they are called in the legend.
    pub label: String,
    /// The points.
    pub points: Vec<(f64, f64)>,
}

/// Values from 0 on a grid, as colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Where the grid begins and ends, cells and all.
    pub x: (f64, f64),
    /// The same upwards.
    pub y: (f64, f64),
    /// Rows from below; what is not finite is left open.
    pub rows: Vec<Vec<f64>>,
    /// The upper end of the scale of colours, positive: the same for charts that are compared.
    pub highest: f64,
    /// What the values are.
    pub label: String,
}

/// Curves over one pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// What stands above it.
    pub title: String,
    /// The label of the horizontal axis, with its unit.
    pub x: String,
    /// The label of the vertical axis, with its unit.
    pub y: String,
    /// Whether a unit is as long along both axes.
    pub equal: bool,
    /// What is under the curves.
    pub heat: Option<Heat>,
    /// The curves.
    pub series: Vec<Series>,
    /// The special points.
    pub marks: Vec<Marks>,
}

/// Colours that people with any colour vision tell apart, from M. Okabe and K. Ito 2008.
const COLOURS: [&str; 7] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000",
];

const SHAPES: [MarkerShape; 5] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::Cross,
];

/// The label of an axis: `theta1 (°)`.
pub(super) fn label(name: &str, unit: SiUnit) -> String {
    format!("{name} ({})", with_unit("", unit).trim())
}

/// The charts one below the other.
pub fn svg(charts: &[Chart]) -> String {
    sheet(None, 1, charts)
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 520.0;

/// The charts side by side in columns, row after row, under a title.
pub fn sheet(title: Option<&str>, columns: usize, charts: &[Chart]) -> String {
    let columns = columns.clamp(1, charts.len().max(1));
    let rows = charts.len().div_ceil(columns);
    let plots: Vec<Vec<Plot>> = charts.iter().map(plots).collect();
    let layouts = charts.iter().zip(&plots);
    let layouts = layouts.map(|(chart, plots)| layout(chart, plots)).collect();
    let mut figure = Figure::new(rows, columns)
        .with_cell_size(WIDTH, HEIGHT)
        .with_layouts(layouts)
        .with_plots(plots);
    for (row, charts) in charts.chunks(columns).enumerate() {
        let heights = charts.iter().map(|chart| match frame(chart) {
            Some([_, height]) => height + ABOVE + BELOW,
            None => HEIGHT,
        });
        figure = figure.with_row_height(row, heights.fold(0.0, f64::max));
    }
    if let Some(title) = title {
        figure = figure.with_title(title);
    }
    SvgBackend::new().render_scene(&figure.render())
}

/// Room beside the axes in pixels: for the labels, the title, and the legend with the scale.
const LEFT: f64 = 80.0;
const ABOVE: f64 = 50.0;
const BELOW: f64 = 65.0;
const RIGHT: f64 = 260.0;

/// Width and height of the axes in pixels, where they are just as large as the map of colours and a
/// unit is as long along both.
fn frame(chart: &Chart) -> Option<[f64; 2]> {
    const HIGHEST: f64 = 600.0;
    const LEAST: f64 = 40.0;
    let heat = chart.heat.as_ref().filter(|_| chart.equal)?;
    let ratio = (heat.y.1 - heat.y.0) / (heat.x.1 - heat.x.0);
    let width = (WIDTH - LEFT - RIGHT).min(HIGHEST / ratio);
    // what is so thin that no label fits is drawn thicker
    Some([width.max(LEAST), (width * ratio).max(LEAST)])
}

fn layout(chart: &Chart, plots: &[Plot]) -> Layout {
    let mut layout = Layout::auto_from_plots(plots)
        .with_title(chart.title.as_str())
        .with_x_label(chart.x.as_str())
        .with_y_label(chart.y.as_str())
        .with_legend_position(LegendPosition::OutsideRightTop);
    if let Some(heat) = &chart.heat {
        // axes end where the map does
        layout = layout
            .with_x_axis_min(heat.x.0)
            .with_x_axis_max(heat.x.1)
            .with_y_axis_min(heat.y.0)
            .with_y_axis_max(heat.y.1);
    }
    match frame(chart) {
        Some([width, _]) => layout
            .with_force_margins(LEFT, WIDTH - LEFT - width)
            .with_force_margins_y(ABOVE, BELOW),
        None if chart.equal => layout.with_equal_aspect(),
        None => layout,
    }
}

/// Light greys to blue, so that curves of any colour stand out.
fn heat(heat: &Heat) -> Plot {
    let shade = |x: f64| match x.is_finite() {
        true => {
            let mix = |from: f64, to: f64| (from + x.clamp(0.0, 1.0) * (to - from)).round() as u8;
            let (r, g, b) = (mix(250.0, 60.0), mix(225.0, 150.0), mix(190.0, 215.0));
            format!("#{r:02x}{g:02x}{b:02x}")
        }
        false => "none".to_owned(),
    };
    // the library's colours go from the least to the greatest value of one map: a row above the
    // axes, which is clipped, holds the ends of the scale; cells overlap, hence one between
    let mut rows = heat.rows.clone();
    let across = heat.rows.first().map_or(0, Vec::len);
    let mut ends = vec![f64::NAN; across];
    for (end, value) in ends.iter_mut().zip([0.0, heat.highest]) {
        *end = value;
    }
    rows.extend([vec![f64::NAN; across], ends]);
    let row = (heat.y.1 - heat.y.0) / heat.rows.len().max(1) as f64;
    let mut map = Heatmap::new()
        .with_data(rows)
        .with_color_map(ColorMap::Custom(Arc::new(shade)))
        .with_x_range(heat.x.0, heat.x.1)
        .with_y_range(heat.y.0, heat.y.1 + 2.0 * row);
    map.cell_size = 1.0;
    map.legend_label = Some(heat.label.clone());
    map.into()
}

fn plots(chart: &Chart) -> Vec<Plot> {
    let mut plots: Vec<Plot> = Vec::new();
    plots.extend(chart.heat.as_ref().map(heat));
    for (i, series) in chart.series.iter().enumerate() {
        // a gap ends a line; its pieces have one colour and one entry in the legend
        let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let pieces = series
            .points
            .split(|p| !finite(p))
            .filter(|piece| !piece.is_empty());
        for (k, piece) in pieces.enumerate() {
            let line = LinePlot::new()
                .with_data(piece.to_vec())
                .with_color(COLOURS[i % COLOURS.len()])
                .with_stroke_width(1.5);
            let line = match i / COLOURS.len() % 3 {
                0 => line,
                1 => line.with_dashed(),
                _ => line.with_dotted(),
            };
            plots.push(match k {
                0 => line.with_legend(series.label.as_str()).into(),
                _ => line.into(),
            });
        }
    }
    for (i, marks) in chart.marks.iter().enumerate() {
        let scatter = ScatterPlot::new()
            .with_data(marks.points.clone())
            .with_color("#333333")
            .with_size(5.0)
            .with_marker(SHAPES[i % SHAPES.len()])
            .with_marker_opacity(0.0)
            .with_marker_stroke_width(1.5)
            .with_legend(marks.label.as_str());
        plots.push(scatter.into());
    }
    plots
}
