//! The charts of a motion.

use super::Picture;
use crate::algebra::SiUnit;
use crate::geometry::Vector3;
use crate::mechanism::{Mechanism, Variable};
use crate::output::canvas::Canvas;
use crate::output::drawing::{Camera, Viewpoint};
use crate::output::plot::{self, LineChart, Series, Strobe, stacked};
use crate::scene::{Scene, Triple, least_and_greatest};

/// A curve with its name: where it is for the values of a row.
type NamedCurve<'c> = (String, Plotted<'c>);

impl Picture {
    /// The mechanism in several places with the paths of points, seen from where it is said, then the curves.
    pub fn drawn(&self, mechanism: &Mechanism, view: Option<Viewpoint>) -> Canvas {
        let mut charts: Vec<LineChart> = self.places(mechanism, view).into_iter().collect();
        charts.extend(match (self.points.is_empty(), self.quantities.is_empty()) {
            (true, true) => {
                let units = [true, false].map(SiUnit::of_coordinate);
                let outputs = self.outputs.iter().map(|(_, of)| of);
                self.panels(&units, outputs.zip(1..), |unit| match unit.is_angle() {
                    true => "joint angles",
                    false => "slides",
                })
            }
            (false, true) => Vec::new(),
            (_, false) => {
                let first = 1 + self.outputs.len() + 3 * self.points.len();
                let quantities = self.quantities.iter().zip(first..);
                // the time is none of them
                let timed = (self.quantities.first()).is_some_and(|of| of.unit == SiUnit::SECOND);
                let quantities = quantities.skip(usize::from(timed));
                let mut units: Vec<SiUnit> = Vec::new();
                for (of, _) in quantities.clone() {
                    if !units.contains(&of.unit) {
                        units.push(of.unit);
                    }
                }
                self.panels(&units, quantities, |_| "quantities")
            }
        });
        stacked(&charts)
    }

    pub(super) fn label(&self, name: &str, mode: Option<usize>) -> String {
        match mode {
            Some(mode) if self.motions.len() > 1 => format!("{name}, {} {mode}", self.what),
            _ => name.to_owned(),
        }
    }

    /// Curves with their names, and marks on all of them.
    fn chart(&self, curves: &[NamedCurve]) -> (Vec<Series>, Vec<Series>) {
        let mut series = Vec::new();
        let mut marks: Vec<Series> = Vec::new();
        for drawn in &self.motions {
            for (name, at) in curves {
                let points = drawn.rows.kept.iter().map(|row| at(row));
                series.push(Series::new(self.label(name, drawn.mode), points));
                for (label, values) in &drawn.marks {
                    let point = at(values);
                    match marks.iter_mut().find(|marks| marks.label == *label) {
                        Some(known) => known.points.push(point),
                        None => marks.push(Series::new(*label, [point])),
                    }
                }
            }
        }
        (series, marks)
    }

    /// Columns over the input, a panel for each unit; several in one panel have one name together.
    fn panels<'p>(
        &'p self,
        units: &[SiUnit],
        columns: impl Iterator<Item = (&'p Variable, usize)> + Clone,
        together: fn(SiUnit) -> &'static str,
    ) -> Vec<LineChart> {
        let panel = |unit: &SiUnit| {
            let of_it = columns.clone().filter(|(of, _)| of.unit == *unit);
            let curves: Vec<NamedCurve> = of_it
                .map(|(of, place)| (of.name.clone(), column(place)))
                .collect();
            let name = match &curves[..] {
                [] => return None,
                [(name, _)] => name,
                _ => together(*unit),
            };
            Some(self.over_input(&curves, plot::label(name, *unit)))
        };
        units.iter().filter_map(panel).collect()
    }

    fn over_input(&self, pairs: &[NamedCurve], label: String) -> LineChart {
        let (mut series, marks) = self.chart(pairs);
        let unbounded = |label: &str| -> Vec<f64> {
            let of_it = self.unbounded.iter().filter(|(name, _)| {
                (label.strip_prefix(name.as_str()))
                    .is_some_and(|l| l.is_empty() || l.starts_with(','))
            });
            of_it.flat_map(|(_, poles)| poles.clone()).collect()
        };
        let mut heights = Vec::new();
        for series in &mut series {
            let constant = self.constant.iter().find(|(of, _)| *of == series.label);
            if let Some((_, value)) = constant {
                series.points.iter_mut().for_each(|point| point.1 = *value);
            }
            let poles = unbounded(&series.label);
            heights.extend(series.points.iter().map(|(_, y)| *y));
            if !poles.is_empty() {
                series.points = plot::broken(&series.points, &poles);
            }
        }
        let mut all = series.iter();
        let any = all.any(|series| !unbounded(&series.label).is_empty());
        LineChart {
            title: self.title.clone(),
            x: self.input_label.clone(),
            y: label,
            within: any.then(|| plot::most(heights)).flatten(),
            series,
            marks,
            ..LineChart::default()
        }
    }

    /// The mechanism in several places, and the paths; nothing of circuits.
    fn places(&self, mechanism: &Mechanism, view: Option<Viewpoint>) -> Option<LineChart> {
        let scenes = self.course.strobe(mechanism);
        let normal = scenes.first()?.normal;
        let first = 1 + self.outputs.len();
        let traced = (self.motions.iter())
            .flat_map(|drawn| &drawn.rows.kept)
            .flat_map(|row| row[first..first + 3 * self.points.len()].chunks(3))
            .map(|point| [point[0], point[1], point[2]]);
        let view = view.unwrap_or_else(|| match (normal, self.points.is_empty()) {
            (None, false) => widest(&traced.collect::<Vec<Triple>>()),
            _ => Viewpoint::Natural,
        });
        let camera = Camera::new(view, normal);
        let seen = move |point: &[f64]| {
            let (x, y, _) = camera.project(&[point[0], point[1], point[2]]);
            (x, y)
        };
        let curves: Vec<NamedCurve> = (self.points.iter().enumerate())
            .map(|(i, point)| {
                let from = first + 3 * i;
                let at = move |row: &[f64]| seen(&row[from..from + 3]);
                (point.clone(), Box::new(at) as Box<dyn Fn(&[f64]) -> _>)
            })
            .collect();
        let (series, mut marks) = self.chart(&curves);
        if !self.double_points.is_empty() {
            let points = self.double_points.iter().map(|point| seen(point));
            marks.push(Series::new("double points", points));
        }
        let points: Vec<Triple> = scenes.iter().flat_map(Scene::points).collect();
        let bounds = camera.bounds(&points);
        Some(LineChart {
            title: self.title.clone(),
            x: axis(&camera.right, "across"),
            y: axis(&camera.up, "up"),
            equal: true,
            strobe: Some(Strobe {
                view,
                scenes,
                bounds,
            }),
            series,
            marks,
            ..LineChart::default()
        })
    }
}

/// The point of a row in a chart.
type Plotted<'c> = Box<dyn Fn(&[f64]) -> (f64, f64) + 'c>;

/// A column over the input.
fn column<'c>(y: usize) -> Plotted<'c> {
    Box::new(move |row| (row[0], row[y]))
}

/// The label of an axis of a picture in m.
fn axis(along: &Vector3<f64>, otherwise: &str) -> String {
    let names = ["x", "y", "z"].into_iter().zip(along.0);
    let mut along = names.filter(|(_, part)| part.abs() > 1.0 - 1e-9);
    match along.next() {
        Some((name, part)) if part < 0.0 => format!("-{name} (m)"),
        Some((name, _)) => format!("{name} (m)"),
        None => format!("{otherwise} (m)"),
    }
}

/// Along the axis along which points extend least.
fn widest(points: &[Triple]) -> Viewpoint {
    let extent = |axis: usize| {
        let (low, high) = least_and_greatest(points.iter().map(|point| point[axis]));
        high - low
    };
    let views = [Viewpoint::From(0.0, 0.0), Viewpoint::Front, Viewpoint::Top];
    let ordered = views.into_iter().enumerate().rev();
    let least = ordered.min_by(|(a, _), (b, _)| extent(*a).total_cmp(&extent(*b)));
    least.map_or(Viewpoint::Top, |(_, view)| view)
}
