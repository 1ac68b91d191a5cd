//! Motions drawn: the mechanism in several places with the paths of points, input–output curves, quantities.

use super::course::{Course, Thinned};
use crate::algebra::SiUnit;
use crate::analysis::sweep::{CircuitsReport, MetKind, MotionsReport, Row};
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Mechanism, NamedPoint, Variable};
use crate::output::canvas::Canvas;
use crate::output::drawing::{Camera, View};
use crate::output::plot::{self, Chart, Series, Strobe, stacked};
use crate::output::quantity;
use crate::scene::{Scene, Triple, least_and_greatest};
use crate::system::{Coordinate, Driven};

/// Collects what is to be drawn; of a long motion only as many points as can be distinguished.
#[derive(Clone, Debug)]
pub struct Picture {
    title: String,
    points: Vec<String>,
    input: Option<Driven>,
    input_label: String,
    /// Joints that are drawn over the input.
    outputs: Vec<(usize, Variable)>,
    /// Quantities, drawn over the first input in a panel for each unit.
    quantities: Vec<Variable>,
    motions: Vec<Drawn>,
    /// Whether inputs were given.
    driven: bool,
    /// What tells motions apart.
    what: &'static str,
    double_points: Vec<Triple>,
    /// Quantities without bound, by name, with what the abscissa is where they have none.
    unbounded: Vec<(String, Vec<f64>)>,
    course: Course,
}

/// A curve with its name: where it is for the values of a row.
type Curve<'c> = (String, Plotted<'c>);

#[derive(Clone, Debug)]
struct Drawn {
    mode: Option<usize>,
    /// Abscissa, joints drawn, points, then quantities.
    rows: Thinned<Vec<f64>>,
    marks: Vec<(&'static str, Vec<f64>)>,
}

impl Drawn {
    fn new(mode: Option<usize>, rows: Vec<Vec<f64>>) -> Self {
        Drawn {
            mode,
            rows: Thinned::new(rows),
            marks: Vec::new(),
        }
    }
}

/// Points of one curve at most.
const MOST: usize = 4000;

impl Picture {
    /// Of a motion of these inputs; without points, joints are drawn over the first input.
    pub fn new(
        mechanism: &Mechanism,
        inputs: &[Driven],
        points: &[NamedPoint],
        quantities: &[Variable],
    ) -> Self {
        let joint = |joint: usize| Driven {
            coordinate: Coordinate::Joint(joint),
            from: 0.0,
            to: 1.0,
        };
        let driven = CircuitsReport::input_of(mechanism).map(joint);
        let input = inputs.first().copied().or(driven);
        let label = |of: Coordinate| {
            let unit = SiUnit::of_coordinate(of.is_angle(mechanism));
            plot::label(&of.name(mechanism), unit)
        };
        let moved = |i: usize| {
            let mut moved = inputs.iter().chain(&input);
            moved.any(|of| of.coordinate == Coordinate::Joint(i))
        };
        let joints = mechanism.joints().iter().enumerate();
        Picture {
            title: mechanism.name().to_owned(),
            points: points.iter().map(|point| point.name.clone()).collect(),
            input_label: input.map_or(String::new(), |input| label(input.coordinate)),
            input,
            outputs: joints
                .filter(|(i, _)| !moved(*i))
                .map(|(i, joint)| {
                    let unit = SiUnit::of_coordinate(joint.kind.is_angle());
                    (i, Variable::new(&joint.name, unit))
                })
                .collect(),
            quantities: quantities.to_vec(),
            motions: Vec::new(),
            driven: !inputs.is_empty(),
            what: "mode",
            double_points: Vec::new(),
            unbounded: Vec::new(),
            course: Course::of(points.iter().map(|named| named.point)),
        }
    }

    /// Of the circuits of a mechanism, joints over the input.
    pub fn of_circuits(mechanism: &Mechanism, report: &CircuitsReport) -> Self {
        let mut picture = Picture::new(mechanism, &[], &[], &[]);
        picture.what = "circuit";
        if let Some(joint) = mechanism.joint(&report.input) {
            let input = |driven: Driven| Driven {
                coordinate: Coordinate::Joint(joint),
                ..driven
            };
            picture.input = picture.input.map(input);
        }
        let shown = |joint: usize, x: f64| {
            let unit = SiUnit::of_coordinate(mechanism.joints()[joint].kind.is_angle());
            quantity::shown(x, unit)
        };
        let Some(Coordinate::Joint(input)) = picture.input.map(|input| input.coordinate) else {
            return picture;
        };
        let joints: Vec<usize> = picture.outputs.iter().map(|(joint, ..)| *joint).collect();
        let drawn = report.circuits.iter().map(|circuit| {
            let rows = circuit.course.iter().map(|at| {
                let all = std::iter::once(&input).chain(&joints);
                all.map(|joint| shown(*joint, at[*joint])).collect()
            });
            Drawn::new(Some(circuit.number), rows.collect())
        });
        picture.motions = drawn.collect();
        picture
    }

    /// The mechanism from place to place with the paths of its points, mode after mode, with the numbers of the modes;
    /// there and back again where a motion does not end where it began.
    pub fn scenes(&self, mechanism: &Mechanism) -> Vec<(Option<usize>, Scene)> {
        let first = 1 + self.outputs.len();
        let mut scenes = self.course.scenes(mechanism);
        for (mode, scene) in &mut scenes {
            let Some(drawn) = self.motions.iter().find(|drawn| drawn.mode == *mode) else {
                continue;
            };
            for (i, path) in scene.paths.iter_mut().enumerate() {
                let from = first + 3 * i;
                let place = |row: &Vec<f64>| [row[from], row[from + 1], row[from + 2]];
                path.points = drawn.rows.kept.iter().map(place).collect();
            }
        }
        scenes
    }

    /// Also marks where paths cross themselves, and breaks curves where they have no bound.
    pub fn completed(&mut self, mechanism: &Mechanism, report: &MotionsReport) {
        for of in report.motions.iter().flat_map(|motion| &motion.extremes) {
            let abscissas = of.unbounded.iter().filter_map(|pole| {
                let input = self.input?.coordinate;
                let value = match input {
                    Coordinate::Joint(joint) => *pole.joints.get(joint)?,
                    _ => *pole.inputs.first()?,
                };
                let unit = SiUnit::of_coordinate(input.is_angle(mechanism));
                Some(quantity::shown(value, unit))
            });
            let abscissas: Vec<f64> = abscissas.collect();
            if !abscissas.is_empty() {
                self.unbounded.push((of.name.clone(), abscissas));
            }
        }
        let paths = report.motions.iter().flat_map(|motion| &motion.sweep.paths);
        let points = paths.flat_map(|path| &path.double_points);
        self.double_points
            .extend(points.map(|point| point.position));
    }

    /// Takes in a row of the motion in a mode; another mode begins another motion.
    pub fn take(&mut self, mechanism: &Mechanism, mode: Option<usize>, row: &Row) {
        if self.motions.last().is_none_or(|drawn| drawn.mode != mode) {
            self.motions.push(Drawn::new(mode, Vec::new()));
        }
        if row.step.is_some() || (!self.driven && row.special.is_none()) {
            self.course.take(mode, row.configuration);
        }
        let wanted = (self.motions.last()).is_some_and(|drawn| drawn.rows.wants_next());
        let values = (wanted || row.special.is_some()).then(|| self.values(mechanism, row));
        let Some(drawn) = self.motions.last_mut() else {
            return;
        };
        if let Some(values) = &values {
            let begins = drawn.rows.begins() && at_limit(mechanism, row.configuration);
            let mark = row.special.map(|kind| match kind {
                MetKind::Fold { .. } => "dead point of the input",
                MetKind::Turning { .. } => "turning point",
                MetKind::Limit { .. } => "limit",
                MetKind::Crossing { .. } => "branches cross",
                MetKind::Cusp { .. } => "cusp",
                MetKind::End | MetKind::Closed => "",
            });
            let mark = mark.or(begins.then_some("limit"));
            if let Some(mark) = mark.filter(|mark| !mark.is_empty()) {
                drawn.marks.push((mark, values.clone()));
            }
        }
        drawn.rows.take(values, MOST);
    }

    fn values(&self, mechanism: &Mechanism, row: &Row) -> Vec<f64> {
        let at: &Configuration<f64> = row.configuration;
        let unit = |of: Coordinate| SiUnit::of_coordinate(of.is_angle(mechanism));
        let shown = |of: Coordinate| quantity::shown(of.of(at), unit(of));
        let input = self.input.map_or(f64::NAN, |input| shown(input.coordinate));
        let outputs = self.outputs.iter();
        let outputs = outputs.map(|(joint, _)| shown(Coordinate::Joint(*joint)));
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

    /// The mechanism in several places with the paths of points, seen from where it is said, then the curves.
    pub fn drawn(&self, mechanism: &Mechanism, view: Option<View>) -> Canvas {
        let mut charts: Vec<Chart> = self.places(mechanism, view).into_iter().collect();
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

    fn label(&self, name: &str, mode: Option<usize>) -> String {
        match mode {
            Some(mode) if self.motions.len() > 1 => format!("{name}, {} {mode}", self.what),
            _ => name.to_owned(),
        }
    }

    /// Curves with their names, and marks on all of them.
    fn chart(&self, curves: &[Curve]) -> (Vec<Series>, Vec<Series>) {
        let mut series = Vec::new();
        let mut marks: Vec<Series> = Vec::new();
        for drawn in &self.motions {
            for (name, at) in curves {
                series.push(Series {
                    label: self.label(name, drawn.mode),
                    points: drawn.rows.kept.iter().map(|row| at(row)).collect(),
                });
                for (label, values) in &drawn.marks {
                    let point = at(values);
                    match marks.iter_mut().find(|marks| marks.label == *label) {
                        Some(known) => known.points.push(point),
                        None => marks.push(Series {
                            label: (*label).to_owned(),
                            points: vec![point],
                        }),
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
    ) -> Vec<Chart> {
        let panel = |unit: &SiUnit| {
            let of_it = columns.clone().filter(|(of, _)| of.unit == *unit);
            let curves: Vec<Curve> = of_it
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

    fn over_input(&self, pairs: &[Curve], label: String) -> Chart {
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
            let poles = unbounded(&series.label);
            heights.extend(series.points.iter().map(|(_, y)| *y));
            if !poles.is_empty() {
                series.points = plot::broken(&series.points, &poles);
            }
        }
        let mut all = series.iter();
        let any = all.any(|series| !unbounded(&series.label).is_empty());
        Chart {
            title: self.title.clone(),
            x: self.input_label.clone(),
            y: label,
            within: any.then(|| plot::most(heights)).flatten(),
            series,
            marks,
            ..Chart::default()
        }
    }

    /// The mechanism in several places, and the paths; nothing of circuits.
    fn places(&self, mechanism: &Mechanism, view: Option<View>) -> Option<Chart> {
        let scenes = self.course.strobe(mechanism);
        let normal = scenes.first()?.normal;
        let first = 1 + self.outputs.len();
        let traced = (self.motions.iter())
            .flat_map(|drawn| &drawn.rows.kept)
            .flat_map(|row| row[first..first + 3 * self.points.len()].chunks(3))
            .map(|point| [point[0], point[1], point[2]]);
        let view = view.unwrap_or_else(|| match (normal, self.points.is_empty()) {
            (None, false) => widest(&traced.collect::<Vec<Triple>>()),
            _ => View::Natural,
        });
        let camera = Camera::new(view, normal);
        let seen = move |point: &[f64]| {
            let (x, y, _) = camera.project(&[point[0], point[1], point[2]]);
            (x, y)
        };
        let curves: Vec<Curve> = (self.points.iter().enumerate())
            .map(|(i, point)| {
                let from = first + 3 * i;
                let at = move |row: &[f64]| seen(&row[from..from + 3]);
                (point.clone(), Box::new(at) as Box<dyn Fn(&[f64]) -> _>)
            })
            .collect();
        let (series, mut marks) = self.chart(&curves);
        if !self.double_points.is_empty() {
            marks.push(Series {
                label: "double points".into(),
                points: self.double_points.iter().map(|point| seen(point)).collect(),
            });
        }
        let points: Vec<Triple> = scenes.iter().flat_map(Scene::points).collect();
        let bounds = camera.bounds(&points);
        Some(Chart {
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
            ..Chart::default()
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
fn widest(points: &[Triple]) -> View {
    let extent = |axis: usize| {
        let (low, high) = least_and_greatest(points.iter().map(|point| point[axis]));
        high - low
    };
    let views = [View::From(0.0, 0.0), View::Front, View::Top];
    let ordered = views.into_iter().enumerate().rev();
    let least = ordered.min_by(|(a, _), (b, _)| extent(*a).total_cmp(&extent(*b)));
    least.map_or(View::Top, |(_, view)| view)
}

/// Whether a joint is at a limit.
fn at_limit(mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
    let scales = &mechanism.dimensions().joint_scales;
    let joints = mechanism.joints().iter().zip(&at.joints).zip(scales);
    joints
        .filter_map(|((joint, x), scale)| Some((joint.limits?, x, scale)))
        .any(|((low, high), x, scale)| (x - low).abs().min((x - high).abs()) < 1e-9 * scale)
}
