//! Charts: curves with labelled axes over a map of colours or a mechanism, special points marked.

mod style;
mod within;

pub(super) use within::{broken, most};

use super::canvas::{Anchor, Canvas, Colour, INK, LETTERS, OutlineStyle, Pixel, Shape};
use super::drawing::{Framing, Viewpoint, strobe};
use super::quantity::{number, with_unit};
use crate::algebra::SiUnit;
use crate::number::real;
use crate::scene::{Scene, least_and_greatest};
use style::{SHAPES, shade, stroke};

/// A curve in a chart, or points that are marked alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Its points, those of a curve in order; a gap is a point that is not finite.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    pub(super) fn new(
        label: impl Into<String>,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (label, points) = (label.into(), points.into_iter().collect());
        Series { label, points }
    }
}

/// Values from 0 on a grid, as colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Range of the grid to the right, cells included.
    pub x: (f64, f64),
    /// Range of the grid upwards, cells included.
    pub y: (f64, f64),
    /// Rows from below; values that are not finite are left open.
    pub rows: Vec<Vec<f64>>,
    /// The upper end of the scale of colours, positive: the same for charts that are compared.
    pub highest: f64,
    /// Name of the values.
    pub label: String,
}

/// A mechanism in several places, the last of them in full, seen as the axes say.
#[derive(Clone, Debug, PartialEq)]
pub struct Strobe {
    /// View of the mechanism.
    pub view: Viewpoint,
    /// The places.
    pub scenes: Vec<Scene>,
    /// Its bounds, in m to the right and up.
    pub bounds: [(f64, f64); 2],
}

/// Curves over one pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineChart {
    /// Title above it.
    pub title: String,
    /// The label of the horizontal axis, with its unit.
    pub x: String,
    /// The label of the vertical axis, with its unit.
    pub y: String,
    /// True if a unit is as long along both axes.
    pub equal: bool,
    /// Largest range of the vertical axis: curves without bound are cut there.
    pub within: Option<(f64, f64)>,
    /// Colours under the curves.
    pub heat: Option<Heat>,
    /// The mechanism under the curves, where they are paths in m.
    pub strobe: Option<Strobe>,
    /// The curves.
    pub series: Vec<Series>,
    /// The special points.
    pub marks: Vec<Series>,
}

/// The label of an axis: `theta1 (°)`.
pub(super) fn label(name: &str, unit: SiUnit) -> String {
    match unit {
        SiUnit::ONE => name.to_owned(),
        unit => format!("{name} ({})", with_unit("", unit).trim()),
    }
}

/// The charts one below the other.
pub fn stacked(charts: &[LineChart]) -> Canvas {
    sheet(None, 1, charts)
}

/// The charts side by side in columns, row after row, under a title.
pub fn sheet(title: Option<&str>, columns: usize, charts: &[LineChart]) -> Canvas {
    let columns = columns.clamp(1, charts.len().max(1));
    let top = if title.is_some() { CHART.above } else { 0.0 };
    let height = |row: &[LineChart]| row.iter().map(height).fold(0.0, f64::max);
    let heights: Vec<f64> = charts.chunks(columns).map(height).collect();
    let mut canvas = Canvas {
        width: columns as f64 * CHART.whole[0],
        height: top + heights.iter().sum::<f64>(),
        shapes: Vec::new(),
    };
    if let Some(title) = title {
        let at = (canvas.width / 2.0, top / 2.0);
        canvas
            .shapes
            .push(Shape::words(title, at, 16.0, Anchor::Middle));
    }
    let mut below = top;
    for (row, height) in charts.chunks(columns).zip(heights) {
        for (column, chart) in row.iter().enumerate() {
            draw(
                &mut canvas.shapes,
                (column as f64 * CHART.whole[0], below),
                chart,
            );
        }
        below += height;
    }
    canvas
}

/// Sizes of a chart in pixels.
struct ChartSizes {
    whole: [f64; 2],
    /// The largest and the least side of axes with one scale.
    axes: [f64; 2],
    /// The room beside the axes for the labels, the title, and the legend with the scale.
    left: f64,
    above: f64,
    below: f64,
    right: f64,
    /// Distance of lines in the legend.
    line: f64,
    /// Height of the scale of colours with its labels.
    scale: f64,
}

const CHART: ChartSizes = ChartSizes {
    whole: [760.0, 520.0],
    axes: [600.0, 40.0],
    left: 80.0,
    above: 50.0,
    below: 65.0,
    right: 210.0,
    line: 18.0,
    scale: 190.0,
};

/// Width and height of the axes in pixels; a map of colours whose units are as long along both axes is just as
/// large as these.
fn frame(chart: &LineChart) -> [f64; 2] {
    let [highest, least] = CHART.axes;
    let widest = CHART.whole[0] - CHART.left - CHART.right;
    match chart.heat.as_ref().filter(|_| chart.equal) {
        Some(heat) => {
            let ratio = (heat.y.1 - heat.y.0) / (heat.x.1 - heat.x.0);
            let width = widest.min(highest / ratio);
            // what is so thin that no label fits is drawn thicker
            [width.max(least), (width * ratio).max(least)]
        }
        None => [widest, CHART.whole[1] - CHART.above - CHART.below],
    }
}

fn height(chart: &LineChart) -> f64 {
    let scale = if chart.heat.is_some() {
        CHART.scale
    } else {
        0.0
    };
    let legend = (chart.series.len() + chart.marks.len()) as f64 * CHART.line + scale;
    CHART.above + frame(chart)[1].max(legend) + CHART.below
}

/// Ranges of the axes.
fn ranges(chart: &LineChart) -> [(f64, f64); 2] {
    if let Some(heat) = &chart.heat {
        return [heat.x, heat.y];
    }
    let all = chart.series.iter().chain(&chart.marks);
    let points = all.flat_map(|series| &series.points);
    let mut points: Vec<[f64; 2]> = points.map(|p| [p.0, p.1]).collect();
    if let Some((low, high)) = chart.within {
        points.iter_mut().for_each(|p| p[1] = p[1].clamp(low, high));
    }
    if let Some(Strobe { bounds: [x, y], .. }) = &chart.strobe {
        points.extend([[x.0, y.0], [x.1, y.1]]);
    }
    // joints are larger than their points
    let margin = if chart.strobe.is_some() { 0.07 } else { 0.03 };
    let mut ranges = [0, 1].map(|axis| {
        let values = points.iter().map(|p| p[axis]).filter(|x| x.is_finite());
        let (low, high) = least_and_greatest(values);
        let angle = [&chart.x, &chart.y][axis].ends_with("(°)");
        match high - low {
            // an axis of whole turns ends where they end
            width
                if angle
                    && (width / 360.0 - (width / 360.0).round()).abs() < 1e-6
                    && width > 1.0 =>
            {
                (low, high)
            }
            width if width > 1e-9 * low.abs().max(high.abs()) => {
                (low - margin * width, high + margin * width)
            }
            _ if low.is_finite() => {
                let half = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
                (low - half, high + half)
            }
            _ => (0.0, 1.0),
        }
    });
    if chart.equal {
        let pixels = frame(chart);
        let unit = [0, 1].map(|axis| (ranges[axis].1 - ranges[axis].0) / pixels[axis]);
        let unit = unit[0].max(unit[1]);
        for (range, pixels) in ranges.iter_mut().zip(pixels) {
            let (middle, half) = (0.5 * (range.0 + range.1), 0.5 * unit * pixels);
            *range = (middle - half, middle + half);
        }
    }
    ranges
}

/// Multiples of 1, 2 or 5 times a power of ten within a range, about as many as wanted; of degrees those of parts of a
/// right angle where they are wide apart.
fn labels((low, high): (f64, f64), wanted: f64, degrees: bool) -> Vec<f64> {
    let rough = (high - low) / wanted;
    let power = real::pow(10_f64, real::log10(rough).floor());
    let steps = match degrees && rough > 10.0 {
        true => vec![15.0, 30.0, 45.0, 90.0, 180.0, 360.0],
        false => [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).to_vec(),
    };
    let step = steps.iter().copied().find(|step| *step >= rough);
    let step = step.unwrap_or_else(|| (rough / 360.0).ceil() * 360.0);
    let slack = 1e-9 * (high - low);
    let (first, last) = (
        ((low - slack) / step).ceil(),
        ((high + slack) / step).floor(),
    );
    (first as i64..=last as i64)
        .map(|k| k as f64 * step)
        .collect()
}

/// Draws a chart with its upper left corner at the given point of the sheet.
fn draw(shapes: &mut Vec<Shape>, corner: Pixel, chart: &LineChart) {
    let [width, height] = frame(chart);
    let at = |x: f64, y: f64| (corner.0 + x, corner.1 + y);
    let title = at(CHART.left + width / 2.0, CHART.above / 2.0 + 5.0);
    shapes.push(Shape::words(&chart.title, title, 15.0, Anchor::Middle));
    let [x, y] = ranges(chart);
    let place = |p: (f64, f64)| {
        let across = (p.0 - x.0) / (x.1 - x.0);
        let up = (p.1 - y.0) / (y.1 - y.0);
        at(
            CHART.left + across * width,
            CHART.above + (1.0 - up) * height,
        )
    };
    let (grid, axis) = (
        OutlineStyle::line(Colour(0xe1e1e1), 0.8),
        OutlineStyle::line(INK, 1.0),
    );
    let mut ticks = |value: f64, ends: [(f64, f64); 2], out: Pixel, words: Pixel, anchor| {
        let [from, to] = ends.map(place);
        let beyond = |by: Pixel| (from.0 + by.0, from.1 + by.1);
        shapes.push(Shape::line([from, to], grid));
        shapes.push(Shape::line([from, beyond(out)], axis));
        shapes.push(Shape::words(number(value), beyond(words), LETTERS, anchor));
    };
    let degrees = [&chart.x, &chart.y].map(|label| label.ends_with("(°)"));
    for at in labels(x, width / 60.0, degrees[0]) {
        let ends = [(at, y.0), (at, y.1)];
        ticks(at, ends, (0.0, 5.0), (0.0, 18.0), Anchor::Middle);
    }
    for at in labels(y, height / 50.0, degrees[1]) {
        let ends = [(x.0, at), (x.1, at)];
        ticks(at, ends, (-5.0, 0.0), (-9.0, 4.0), Anchor::End);
    }
    shapes.push(Shape::rectangle(place((x.0, y.1)), place((x.1, y.0)), axis));
    let below = at(
        CHART.left + width / 2.0,
        CHART.above + height + 0.7 * CHART.below,
    );
    shapes.push(Shape::words(&chart.x, below, 13.0, Anchor::Middle));
    shapes.push(Shape::Words {
        text: chart.y.clone(),
        at: at(0.25 * CHART.left, CHART.above + height / 2.0),
        size: 13.0,
        anchor: Anchor::Middle,
        upwards: true,
    });
    let right = CHART.left + width + 20.0;
    let mut line = CHART.above + 8.0;
    if let Some(heat) = &chart.heat {
        let across = heat.rows.first().map_or(1, Vec::len) as f64;
        let up = heat.rows.len().max(1) as f64;
        let corner = |i: usize, k: usize| {
            let x = heat.x.0 + (heat.x.1 - heat.x.0) * i as f64 / across;
            let y = heat.y.0 + (heat.y.1 - heat.y.0) * k as f64 / up;
            place((x, y))
        };
        for (k, row) in heat.rows.iter().enumerate() {
            for (i, value) in row.iter().enumerate().filter(|(_, x)| x.is_finite()) {
                // a little of the next cell is covered, so that no seam shines through
                let (right, top) = corner(i + 1, k + 1);
                let filled = OutlineStyle::filled(shade(value / heat.highest));
                let opposite = (right + 0.5, top - 0.5);
                shapes.push(Shape::rectangle(corner(i, k), opposite, filled));
            }
        }
        line += scale(shapes, heat, |x, y| at(right + x, line + y));
    }
    if let Some(Strobe { view, scenes, .. }) = &chart.strobe {
        let fit = Framing {
            middle: (0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)),
            scale: width / (x.1 - x.0),
        };
        let centre = at(CHART.left + width / 2.0, CHART.above + height / 2.0);
        shapes.extend(strobe(scenes, *view, fit, centre));
    }
    let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
    for (i, series) in chart.series.iter().enumerate() {
        // a gap ends a line; its pieces have one colour and one entry in the legend
        let pieces = series.points.split(|p| !finite(p));
        let style = stroke(i);
        for piece in pieces.filter(|piece| !piece.is_empty()) {
            for part in within::inside(piece, chart.within) {
                shapes.push(Shape::line(part.into_iter().map(place), style));
            }
        }
        let sample = [at(right, line), at(right + 24.0, line)];
        shapes.push(Shape::line(sample, style));
        let beside = at(right + 32.0, line + 4.0);
        shapes.push(Shape::words(&series.label, beside, LETTERS, Anchor::Start));
        line += CHART.line;
    }
    for (i, marks) in chart.marks.iter().enumerate() {
        let within = |y: f64| (chart.within).is_none_or(|(low, high)| (low..=high).contains(&y));
        let points = marks.points.iter().filter(|p| finite(p) && within(p.1));
        let points = points.map(|p| place(*p));
        for place in points.chain([at(right + 12.0, line)]) {
            let outline = SHAPES[i % SHAPES.len()].iter();
            let outline = outline.map(|(x, y)| (place.0 + x, place.1 + y));
            shapes.push(Shape::line(
                outline,
                OutlineStyle::line(Colour(0x333333), 1.5),
            ));
        }
        let beside = at(right + 32.0, line + 4.0);
        shapes.push(Shape::words(&marks.label, beside, LETTERS, Anchor::Start));
        line += CHART.line;
    }
}

/// Draws the scale of colours, with 0 at its lower end, and gives the height it takes.
fn scale(shapes: &mut Vec<Shape>, heat: &Heat, at: impl Fn(f64, f64) -> Pixel) -> f64 {
    const BANDS: i32 = 40;
    shapes.push(Shape::words(
        &heat.label,
        at(0.0, 4.0),
        LETTERS,
        Anchor::Start,
    ));
    let height = |part: f64| CHART.line + (1.0 - part) * (CHART.scale - 3.0 * CHART.line);
    for band in 0..BANDS {
        let part = |k: i32| f64::from(k) / f64::from(BANDS);
        let (top, bottom) = (height(part(band + 1)), height(part(band)));
        let filled = OutlineStyle::filled(shade(0.5 * (part(band) + part(band + 1))));
        shapes.push(Shape::rectangle(at(0.0, top), at(24.0, bottom), filled));
    }
    for value in labels((0.0, heat.highest), 5.0, false) {
        let place = at(32.0, height(value / heat.highest) + 4.0);
        shapes.push(Shape::words(number(value), place, LETTERS, Anchor::Start));
    }
    CHART.scale
}
