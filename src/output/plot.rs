//! Charts as SVG: curves with labelled axes over a map of colours, special points marked. Only this
//! module knows the library that draws them.

use std::sync::Arc;

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

/// Values between 0 and 1 on a grid, as colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Where the grid begins and ends, cells and all.
    pub x: (f64, f64),
    /// The same upwards.
    pub y: (f64, f64),
    /// Rows from below; what is not finite is left white.
    pub rows: Vec<Vec<f64>>,
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

/// The charts one below the other.
pub fn svg(charts: &[Chart]) -> String {
    const WIDTH: f64 = 760.0;
    const HEIGHT: f64 = 520.0;
    let plots: Vec<Vec<Plot>> = charts.iter().map(plots).collect();
    let layouts = charts.iter().zip(&plots).map(|(chart, plots)| {
        let layout = Layout::auto_from_plots(plots)
            .with_title(chart.title.as_str())
            .with_x_label(chart.x.as_str())
            .with_y_label(chart.y.as_str())
            .with_legend_position(LegendPosition::OutsideRightTop);
        match chart.equal {
            true => layout.with_equal_aspect(),
            false => layout,
        }
    });
    let layouts: Vec<Layout> = layouts.collect();
    let scene = Figure::new(charts.len(), 1)
        .with_cell_size(WIDTH, HEIGHT)
        .with_layouts(layouts)
        .with_plots(plots)
        .render();
    SvgBackend::new().render_scene(&scene)
}

/// Light greys to blue, so that curves of any colour stand out.
fn heat(heat: &Heat) -> Plot {
    let shade = |x: f64| match x.is_finite() {
        true => {
            let mix = |from: f64, to: f64| (from + x.clamp(0.0, 1.0) * (to - from)).round() as u8;
            let (r, g, b) = (mix(250.0, 60.0), mix(225.0, 150.0), mix(190.0, 215.0));
            format!("#{r:02x}{g:02x}{b:02x}")
        }
        false => "#ffffff".to_owned(),
    };
    let mut map = Heatmap::new()
        .with_data(heat.rows.clone())
        .with_color_map(ColorMap::Custom(Arc::new(shade)))
        .with_x_range(heat.x.0, heat.x.1)
        .with_y_range(heat.y.0, heat.y.1);
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
