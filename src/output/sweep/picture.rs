//! Motions drawn: input–output curves, or the paths of points.

use crate::algebra::SiUnit;
use crate::analysis::sweep::{MetKind, MotionsReport, Row};
use crate::mechanism::{Configuration, Mechanism, Point, Variable};
use crate::output::plot::{self, Chart, Marks, Series, svg};
use crate::output::quantity;
use crate::system::{Coordinate, Driven};

/// Collects what is to be drawn; of a long motion only as many points as can be told apart.
#[derive(Clone, Debug)]
pub struct Picture {
    title: String,
    points: Vec<String>,
    input: Option<Driven>,
    input_label: String,
    /// Joints that are drawn over the input: index, name, whether it is an angle.
    outputs: Vec<(usize, String, bool)>,
    /// Quantities, drawn over the first input in a panel for each unit.
    quantities: Vec<Variable>,
    motions: Vec<Drawn>,
    double_points: Vec<[f64; 3]>,
}

#[derive(Clone, Debug, Default)]
struct Drawn {
    mode: Option<usize>,
    /// Abscissa, joints drawn, then points.
    rows: Vec<Vec<f64>>,
    marks: Vec<(&'static str, Vec<f64>)>,
    every: usize,
    seen: usize,
}

/// Points of one curve at most.
const MOST: usize = 4000;

impl Picture {
    /// Of a motion of these inputs; without points, joints are drawn over the first input.
    pub fn new(
        mechanism: &Mechanism,
        inputs: &[Driven],
        points: &[Point],
        quantities: &[Variable],
    ) -> Self {
        let joint = |joint: usize| Driven {
            coordinate: Coordinate::Joint(joint),
            from: 0.0,
            to: 1.0,
        };
        let driven = crate::analysis::sweep::CircuitsReport::input_of(mechanism).map(joint);
        let input = inputs.first().copied().or(driven);
        let label = |of: Coordinate| {
            let unit = SiUnit::of_coordinate(of.is_angle(mechanism));
            plot::label(&of.name(mechanism), unit)
        };
        let moved = |i: usize| {
            inputs
                .iter()
                .chain(&input)
                .any(|d| d.coordinate == Coordinate::Joint(i))
        };
        let joints = mechanism.joints().iter().enumerate();
        Picture {
            title: mechanism.name().to_owned(),
            points: points.iter().map(|point| point.name(mechanism)).collect(),
            input_label: input.map_or(String::new(), |input| label(input.coordinate)),
            input,
            outputs: joints
                .filter(|(i, _)| !moved(*i))
                .map(|(i, joint)| (i, joint.name.clone(), joint.kind.is_angle()))
                .collect(),
            quantities: quantities.to_vec(),
            motions: Vec::new(),
            double_points: Vec::new(),
        }
    }

    /// Also marks where paths cross themselves.
    pub fn crossed(&mut self, report: &MotionsReport) {
        let paths = report.motions.iter().flat_map(|motion| &motion.sweep.paths);
        let points = paths.flat_map(|path| &path.double_points);
        self.double_points
            .extend(points.map(|point| point.position));
    }

    /// Takes in a row of the motion in a mode; another mode begins another motion.
    pub fn take(&mut self, mechanism: &Mechanism, mode: Option<usize>, row: &Row) {
        if self.motions.last().is_none_or(|drawn| drawn.mode != mode) {
            self.motions.push(Drawn {
                mode,
                every: 1,
                ..Drawn::default()
            });
        }
        let wanted =
            (self.motions.last()).is_some_and(|drawn| drawn.seen.is_multiple_of(drawn.every));
        let values = (wanted || row.special.is_some()).then(|| self.values(mechanism, row));
        let Some(drawn) = self.motions.last_mut() else {
            return;
        };
        if let Some(values) = values {
            let mark = row.special.map(|kind| match kind {
                MetKind::Fold { .. } => "dead point of the input",
                MetKind::Turning { .. } => "turning point",
                MetKind::Limit { .. } => "limit",
                MetKind::Crossing { .. } => "branches cross",
                MetKind::Cusp { .. } => "cusp",
                MetKind::End | MetKind::Closed => "",
            });
            if let Some(mark) = mark.filter(|mark| !mark.is_empty()) {
                drawn.marks.push((mark, values.clone()));
            }
            drawn.rows.push(values);
            if drawn.rows.len() > MOST {
                let mut keep = false;
                drawn.rows.retain(|_| {
                    keep = !keep;
                    keep
                });
                drawn.every *= 2;
            }
        }
        drawn.seen += 1;
    }

    fn values(&self, mechanism: &Mechanism, row: &Row) -> Vec<f64> {
        let at: &Configuration<f64> = row.configuration;
        let unit = |of: Coordinate| SiUnit::of_coordinate(of.is_angle(mechanism));
        let shown = |of: Coordinate| quantity::shown(of.of(at), unit(of));
        let input = self.input.map_or(f64::NAN, |input| shown(input.coordinate));
        let outputs = self
            .outputs
            .iter()
            .map(|(joint, _, _)| shown(Coordinate::Joint(*joint)));
        let points = row.points.iter().flatten().copied();
        let quantities = self.quantities.iter().zip(row.quantities);
        let quantities =
            quantities.map(|(of, value)| value.map_or(f64::NAN, |x| quantity::shown(x, of.unit)));
        std::iter::once(input)
            .chain(outputs)
            .chain(points)
            .chain(quantities)
            .collect()
    }

    /// The picture as SVG.
    pub fn svg(&self) -> String {
        let charts = match (self.points.is_empty(), self.quantities.is_empty()) {
            (true, true) => self.outputs_over_input(),
            (true, false) => self.quantities_over_input(),
            (false, true) => vec![self.paths()],
            (false, false) => {
                let mut charts = vec![self.paths()];
                charts.extend(self.quantities_over_input());
                charts
            }
        };
        svg(&charts)
    }

    fn label(&self, name: &str, mode: Option<usize>) -> String {
        match mode {
            Some(mode) if self.motions.len() > 1 => format!("{name}, mode {mode}"),
            _ => name.to_owned(),
        }
    }

    /// Curves of column pairs with their names, and marks on all of them.
    fn chart(&self, pairs: &[(String, usize, usize)]) -> (Vec<Series>, Vec<Marks>) {
        let mut series = Vec::new();
        let mut marks: Vec<Marks> = Vec::new();
        for drawn in &self.motions {
            for (name, x, y) in pairs {
                series.push(Series {
                    label: self.label(name, drawn.mode),
                    points: drawn.rows.iter().map(|row| (row[*x], row[*y])).collect(),
                });
                for (label, values) in &drawn.marks {
                    let point = (values[*x], values[*y]);
                    match marks.iter_mut().find(|marks| marks.label == *label) {
                        Some(known) => known.points.push(point),
                        None => marks.push(Marks {
                            label: (*label).to_owned(),
                            points: vec![point],
                        }),
                    }
                }
            }
        }
        (series, marks)
    }

    fn outputs_over_input(&self) -> Vec<Chart> {
        let mut charts = Vec::new();
        for angles in [true, false] {
            let outputs = self
                .outputs
                .iter()
                .enumerate()
                .filter(|(_, o)| o.2 == angles);
            let pairs: Vec<(String, usize, usize)> = outputs
                .map(|(i, (_, name, _))| (name.clone(), 0, i + 1))
                .collect();
            if pairs.is_empty() {
                continue;
            }
            let name = match &pairs[..] {
                [(name, _, _)] => name,
                _ if angles => "joint angles",
                _ => "slides",
            };
            charts.push(self.over_input(&pairs, plot::label(name, SiUnit::of_coordinate(angles))));
        }
        charts
    }

    /// One panel a unit; the time is none of the quantities.
    fn quantities_over_input(&self) -> Vec<Chart> {
        let first = 1 + self.outputs.len() + 3 * self.points.len();
        let timed = usize::from(
            self.quantities
                .first()
                .is_some_and(|of| of.unit == SiUnit::SECOND),
        );
        let all = || self.quantities.iter().enumerate().skip(timed);
        let mut units: Vec<SiUnit> = Vec::new();
        for (_, of) in all() {
            if !units.contains(&of.unit) {
                units.push(of.unit);
            }
        }
        let chart = |unit: SiUnit| {
            let of_it = all().filter(|(_, of)| of.unit == unit);
            let pairs: Vec<(String, usize, usize)> = of_it
                .map(|(i, of)| (of.name.clone(), 0, first + i))
                .collect();
            let name = match &pairs[..] {
                [(name, _, _)] => name.clone(),
                _ => "quantities".into(),
            };
            self.over_input(&pairs, plot::label(&name, unit))
        };
        units.into_iter().map(chart).collect()
    }

    fn over_input(&self, pairs: &[(String, usize, usize)], label: String) -> Chart {
        let (series, marks) = self.chart(pairs);
        Chart {
            title: self.title.clone(),
            x: self.input_label.clone(),
            y: label,
            equal: false,
            heat: None,
            series,
            marks,
        }
    }

    /// Paths seen along the axis along which they extend least.
    fn paths(&self) -> Chart {
        let first = 1 + self.outputs.len();
        let extent = |axis: usize| {
            let last = first + 3 * self.points.len();
            let values = self.motions.iter().flat_map(|drawn| &drawn.rows);
            let values = values.flat_map(|row| row[first..last].iter().skip(axis).step_by(3));
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                (l.min(*x), h.max(*x))
            });
            high - low
        };
        let flat = (0..3)
            .rev()
            .min_by(|&a, &b| extent(a).total_cmp(&extent(b)))
            .unwrap_or(2);
        let (x, y) = match flat {
            0 => (1, 2),
            1 => (0, 2),
            _ => (0, 1),
        };
        let pairs: Vec<(String, usize, usize)> = (self.points.iter().enumerate())
            .map(|(i, point)| (point.clone(), first + 3 * i + x, first + 3 * i + y))
            .collect();
        let (series, mut marks) = self.chart(&pairs);
        if !self.double_points.is_empty() {
            let seen = self.double_points.iter().map(|point| (point[x], point[y]));
            marks.push(Marks {
                label: "double points".into(),
                points: seen.collect(),
            });
        }
        let axis = ["x (m)", "y (m)", "z (m)"];
        Chart {
            title: self.title.clone(),
            x: axis[x].into(),
            y: axis[y].into(),
            equal: true,
            heat: None,
            series,
            marks,
        }
    }
}
