//! Charts as SVG: curves with labelled axes over a map of colours, special points marked. Only this
//! module knows the library that draws them.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::quantity::{number, with_unit};
use crate::algebra::SiUnit;

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
const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x00, 0x00, 0x00),
];

/// The label of an axis: `theta1 (°)`.
pub(super) fn label(name: &str, unit: SiUnit) -> String {
    format!("{name} ({})", with_unit("", unit).trim())
}

/// The charts one below the other.
pub fn svg(charts: &[Chart]) -> String {
    sheet(None, 1, charts)
}

/// The charts side by side in columns, row after row, under a title.
pub fn sheet(title: Option<&str>, columns: usize, charts: &[Chart]) -> String {
    let columns = columns.clamp(1, charts.len().max(1));
    let top = if title.is_some() { ABOVE } else { 0.0 };
    let height = |row: &[Chart]| row.iter().map(height).fold(0.0, f64::max);
    let heights: Vec<f64> = charts.chunks(columns).map(height).collect();
    let (width, height) = (columns as f64 * WIDTH, top + heights.iter().sum::<f64>());
    let mut text = String::new();
    let drawn = (|| {
        let size = (fine(width) as u32, fine(height) as u32);
        let sheet = SVGBackend::with_string(&mut text, size).into_drawing_area();
        sheet.fill(&WHITE)?;
        if let Some(title) = title {
            sheet.draw_text(
                title,
                &words(16.0, HPos::Center),
                at(width / 2.0, top / 2.0),
            )?;
        }
        let mut below = top;
        for (row, height) in charts.chunks(columns).zip(heights) {
            for (column, chart) in row.iter().enumerate() {
                draw(&sheet, (column as f64 * WIDTH, below), chart)?;
            }
            below += height;
        }
        sheet.present()
    })();
    drawn.expect("a picture in memory needs neither files nor fonts");
    // the drawing is finer than a pixel, the picture as large as it is said to be
    let [fine, plain] = [(fine(width), fine(height)), (width as i32, height as i32)]
        .map(|(width, height)| format!("<svg width=\"{width}\" height=\"{height}\""));
    text.replacen(&fine, &plain, 1)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Size of a chart, and the room beside its axes for the labels, the title, and the legend with the scale.
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 520.0;
const LEFT: f64 = 80.0;
const ABOVE: f64 = 50.0;
const BELOW: f64 = 65.0;
const RIGHT: f64 = 210.0;
/// From one line of the legend to the next.
const LINE: f64 = 18.0;
/// Height of the scale of colours with its labels.
const SCALE: f64 = 190.0;

/// The library places everything on whole numbers: tenths of a pixel keep curves smooth.
fn fine(pixels: f64) -> i32 {
    (10.0 * pixels).round() as i32
}

fn at(x: f64, y: f64) -> (i32, i32) {
    (fine(x), fine(y))
}

/// Letters of a height in pixels; the library writes a size of 1 as 1/1.24.
fn letters(size: f64) -> TextStyle<'static> {
    ("sans-serif", f64::from(fine(size)) * 1.24)
        .into_font()
        .into()
}

fn words(size: f64, across: HPos) -> TextStyle<'static> {
    letters(size).pos(Pos::new(across, VPos::Center))
}

/// Width and height of the axes in pixels; a map of colours whose units are as long along both axes is just as
/// large as these.
fn frame(chart: &Chart) -> [f64; 2] {
    const HIGHEST: f64 = 600.0;
    const LEAST: f64 = 40.0;
    let widest = WIDTH - LEFT - RIGHT;
    match chart.heat.as_ref().filter(|_| chart.equal) {
        Some(heat) => {
            let ratio = (heat.y.1 - heat.y.0) / (heat.x.1 - heat.x.0);
            let width = widest.min(HIGHEST / ratio);
            // what is so thin that no label fits is drawn thicker
            [width.max(LEAST), (width * ratio).max(LEAST)]
        }
        None => [widest, HEIGHT - ABOVE - BELOW],
    }
}

fn height(chart: &Chart) -> f64 {
    let scale = if chart.heat.is_some() { SCALE } else { 0.0 };
    let legend = (chart.series.len() + chart.marks.len()) as f64 * LINE + scale;
    ABOVE + frame(chart)[1].max(legend) + BELOW
}

/// Where the axes begin and end.
fn ranges(chart: &Chart) -> [(f64, f64); 2] {
    if let Some(heat) = &chart.heat {
        return [heat.x, heat.y];
    }
    let lines = chart.series.iter().flat_map(|series| &series.points);
    let points = lines.chain(chart.marks.iter().flat_map(|marks| &marks.points));
    let points: Vec<[f64; 2]> = points.map(|p| [p.0, p.1]).collect();
    let mut ranges = [0, 1].map(|axis| {
        let values = points.iter().map(|p| p[axis]).filter(|x| x.is_finite());
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        match high - low {
            width if width > 1e-9 * low.abs().max(high.abs()) => {
                (low - 0.03 * width, high + 0.03 * width)
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

/// An axis with a label at every multiple of 1, 2 or 5 times a power of ten, about as many as wanted.
struct Axis {
    low: f64,
    high: f64,
    labels: Vec<f64>,
}

impl Axis {
    fn new((low, high): (f64, f64), wanted: f64) -> Self {
        let rough = (high - low) / wanted;
        let power = 10_f64.powf(rough.log10().floor());
        let steps = [1.0, 2.0, 5.0].map(|factor| factor * power);
        let step = steps.into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(10.0 * power);
        let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
        Axis {
            low,
            high,
            labels: (first..=last).map(|k| k as f64 * step).collect(),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.low) / (self.high - self.low);
        from + (part * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.labels.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

/// Draws a chart with its upper left corner at the given point of the sheet.
fn draw(sheet: &Area, corner: (f64, f64), chart: &Chart) -> Drawn {
    let [width, height] = frame(chart);
    let at = |x: f64, y: f64| at(corner.0 + x, corner.1 + y);
    let title = words(15.0, HPos::Center);
    sheet.draw_text(&chart.title, &title, at(LEFT + width / 2.0, ABOVE / 2.0))?;
    let [x, y] = ranges(chart);
    let size = (fine(LEFT + width), fine(height + BELOW));
    let mut axes = ChartBuilder::on(&sheet.clone().shrink(at(0.0, ABOVE), size))
        .x_label_area_size(fine(BELOW))
        .y_label_area_size(fine(LEFT))
        .build_cartesian_2d(Axis::new(x, width / 60.0), Axis::new(y, height / 50.0))?;
    axes.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225).stroke_width(fine(0.8) as u32))
        .axis_style(BLACK.stroke_width(fine(1.0) as u32))
        .set_all_tick_mark_size(fine(5.0))
        .label_style(letters(12.0))
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&|y| number(*y))
        .draw()?;
    let name = words(13.0, HPos::Center);
    let upwards = name.clone().transform(FontTransform::Rotate270);
    let below = at(LEFT + width / 2.0, ABOVE + height + 0.7 * BELOW);
    sheet.draw_text(&chart.x, &name, below)?;
    sheet.draw_text(&chart.y, &upwards, at(0.25 * LEFT, ABOVE + height / 2.0))?;
    let pixels = |points: &[(f64, f64)]| -> Vec<(i32, i32)> {
        points.iter().map(|p| axes.backend_coord(p)).collect()
    };
    let right = LEFT + width + 20.0;
    let mut line = ABOVE + 8.0;
    if let Some(heat) = &chart.heat {
        let across = heat.rows.first().map_or(1, Vec::len) as f64;
        let up = heat.rows.len().max(1) as f64;
        let corner = |i: usize, k: usize| {
            let x = heat.x.0 + (heat.x.1 - heat.x.0) * i as f64 / across;
            let y = heat.y.0 + (heat.y.1 - heat.y.0) * k as f64 / up;
            axes.backend_coord(&(x, y))
        };
        for (k, row) in heat.rows.iter().enumerate() {
            for (i, value) in row.iter().enumerate().filter(|(_, x)| x.is_finite()) {
                // a little of the next cell is covered, so that no seam shines through
                let (right, top) = corner(i + 1, k + 1);
                let corners = [corner(i, k), (right + fine(0.5), top - fine(0.5))];
                let filled = shade(value / heat.highest).filled();
                sheet.draw(&Rectangle::new(corners, filled))?;
            }
        }
        line += scale(sheet, heat, |x, y| at(right + x, line + y))?;
    }
    for (i, series) in chart.series.iter().enumerate() {
        // a gap ends a line; its pieces have one colour and one entry in the legend
        let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        for piece in series.points.split(|p| !finite(p)) {
            stroke(sheet, pixels(piece), i)?;
        }
        stroke(sheet, vec![at(right, line), at(right + 24.0, line)], i)?;
        sheet.draw_text(
            &series.label,
            &words(12.0, HPos::Left),
            at(right + 32.0, line),
        )?;
        line += LINE;
    }
    for (i, marks) in chart.marks.iter().enumerate() {
        let finite = |p: &&(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let points: Vec<(f64, f64)> = marks.points.iter().filter(finite).copied().collect();
        for place in pixels(&points).into_iter().chain([at(right + 12.0, line)]) {
            let outline = SHAPES[i % SHAPES.len()].iter();
            let outline = outline.map(|(x, y)| (place.0 + fine(*x), place.1 + fine(*y)));
            let style = RGBColor(0x33, 0x33, 0x33).stroke_width(fine(1.5) as u32);
            sheet.draw(&PathElement::new(outline.collect::<Vec<_>>(), style))?;
        }
        sheet.draw_text(
            &marks.label,
            &words(12.0, HPos::Left),
            at(right + 32.0, line),
        )?;
        line += LINE;
    }
    Ok(())
}

/// Draws the scale of colours, with 0 at its lower end, and gives the height it takes.
fn scale(
    sheet: &Area,
    heat: &Heat,
    at: impl Fn(f64, f64) -> (i32, i32),
) -> Result<f64, DrawingAreaErrorKind<std::io::Error>> {
    const BANDS: i32 = 40;
    let small = words(12.0, HPos::Left);
    sheet.draw_text(&heat.label, &small, at(0.0, 0.0))?;
    let height = |part: f64| LINE + (1.0 - part) * (SCALE - 3.0 * LINE);
    for band in 0..BANDS {
        let part = |k: i32| f64::from(k) / f64::from(BANDS);
        let corners = [
            at(0.0, height(part(band + 1))),
            at(24.0, height(part(band))),
        ];
        let filled = shade(0.5 * (part(band) + part(band + 1))).filled();
        sheet.draw(&Rectangle::new(corners, filled))?;
    }
    for value in Axis::new((0.0, heat.highest), 5.0).labels {
        let place = at(32.0, height(value / heat.highest));
        sheet.draw_text(&number(value), &small, place)?;
    }
    Ok(SCALE)
}

/// The line of the i-th series: colours first, then dashes and dots.
fn stroke(sheet: &Area, points: Vec<(i32, i32)>, i: usize) -> Drawn {
    let style = COLOURS[i % COLOURS.len()].stroke_width(fine(1.5) as u32);
    let (dash, gap) = match i / COLOURS.len() % 3 {
        0 => return sheet.draw(&PathElement::new(points, style)),
        1 => (6.0, 4.0),
        _ => (1.5, 3.0),
    };
    let dashes = DashedPathElement::new(points, fine(dash), fine(gap), style);
    sheet.draw(&dashes)
}

/// Shapes of marks in pixels about their point.
const SHAPES: [&[(f64, f64)]; 5] = [
    // an octagon is as round as a circle of this size
    &[
        (5.0, 2.1),
        (2.1, 5.0),
        (-2.1, 5.0),
        (-5.0, 2.1),
        (-5.0, -2.1),
        (-2.1, -5.0),
        (2.1, -5.0),
        (5.0, -2.1),
        (5.0, 2.1),
    ],
    &[
        (4.5, 4.5),
        (-4.5, 4.5),
        (-4.5, -4.5),
        (4.5, -4.5),
        (4.5, 4.5),
    ],
    &[(5.2, 4.0), (-5.2, 4.0), (0.0, -5.0), (5.2, 4.0)],
    &[(5.5, 0.0), (0.0, 5.5), (-5.5, 0.0), (0.0, -5.5), (5.5, 0.0)],
    &[
        (4.5, 4.5),
        (-4.5, -4.5),
        (0.0, 0.0),
        (-4.5, 4.5),
        (4.5, -4.5),
    ],
];

/// Light greys to blue, so that curves of any colour stand out.
fn shade(value: f64) -> RGBColor {
    let mix = |from: f64, to: f64| (from + value.clamp(0.0, 1.0) * (to - from)).round() as u8;
    RGBColor(mix(250.0, 60.0), mix(225.0, 150.0), mix(190.0, 215.0))
}
