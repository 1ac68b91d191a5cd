//! Motions drawn: the mechanism in several places with the paths of points, input–output curves, quantities.

mod charts;

use super::course::DrawnCourse;
use crate::algebra::SiUnit;
use crate::analysis::simulation::SimulationReport;
use crate::analysis::sweep::{CircuitsReport, MetKind, MotionsReport, Row, Thinned};
use crate::mechanism::{Configuration, Mechanism, NamedPoint, Point, Variable};
use crate::output::drawing::Panel;
use crate::output::plot;
use crate::output::quantity;
use crate::scene::{Scene, Triple};
use crate::system::{Coordinate, Driven};

/// Collects points to be drawn; of a long motion only as many as can be distinguished.
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
    /// True if inputs were given.
    driven: bool,
    /// Name of the things that distinguish motions.
    what: &'static str,
    double_points: Vec<Triple>,
    /// Quantities without bound, by name, with the abscissa where they have none.
    unbounded: Vec<(String, Vec<f64>)>,
    /// Curves of quantities that do not change but for rounding, with their values.
    constant: Vec<(String, f64)>,
    course: DrawnCourse,
}

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
            rows: Thinned::of(rows),
            marks: Vec::new(),
        }
    }
}

/// Points of one curve at most.
const MOST: usize = 4000;

impl Picture {
    /// Picture of a motion of these inputs; without points, joints are drawn over the first input.
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
            constant: Vec::new(),
            course: DrawnCourse::of(points.iter().map(|named| named.point)),
        }
    }

    /// Picture of the circuits of a mechanism, joints over the input.
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

    /// Picture of a motion by itself: joints, forces of drives and energies over the time.
    pub fn of_simulation(
        mechanism: &Mechanism,
        points: &[String],
        report: &SimulationReport,
    ) -> Self {
        let read = points.iter().filter_map(|name| {
            let point = Point::read(mechanism, name).ok()?;
            Some(NamedPoint {
                name: name.clone(),
                point,
            })
        });
        let points: Vec<NamedPoint> = read.collect();
        let first = 1 + 2 * mechanism.joints().len() + 6 * mechanism.platforms().len();
        let after = first + 3 * points.len();
        let joints = (1..=mechanism.joints().len()).map(|i| 2 * i - 1);
        let drawn: Vec<usize> = joints.chain(after..report.columns.len()).collect();
        let variable = |&i: &usize| Variable::new(&report.columns[i].name, report.columns[i].unit);
        let quantities: Vec<Variable> = drawn.iter().map(variable).collect();
        let mut picture = Picture::new(mechanism, &[], &points, &quantities);
        picture.outputs.clear();
        picture.input_label = plot::label("time", SiUnit::SECOND);
        let rows = report.rows.iter().map(|row| {
            let quantities = drawn
                .iter()
                .map(|&i| quantity::shown(row[i], report.columns[i].unit));
            (row[..1].iter().chain(&row[first..after]).copied())
                .chain(quantities)
                .collect()
        });
        picture.motions = vec![Drawn::new(None, rows.collect())];
        report
            .configurations
            .iter()
            .for_each(|at| picture.course.take(None, at));
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

    /// These places as pictures.
    pub fn panels_moving(&self, mechanism: &Mechanism) -> Vec<Panel> {
        let panel = |(mode, scene)| Panel::new(mechanism.name(), mode, scene);
        self.scenes(mechanism).into_iter().map(panel).collect()
    }

    /// Also marks where paths cross themselves, breaks curves where they have no bound, and levels those that are constant.
    pub fn completed(&mut self, mechanism: &Mechanism, report: &MotionsReport) {
        let all = report.motions.iter();
        for (mode, of) in all.flat_map(|motion| motion.extremes.iter().map(|of| (motion.mode, of)))
        {
            if let Some(value) = of.constant {
                let value = quantity::shown(value, of.unit);
                self.constant.push((self.label(&of.name, mode), value));
            }
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
        let shown = |of: Coordinate| quantity::shown(of.of(mechanism, at), unit(of));
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
}

/// True if a joint is at a limit.
fn at_limit(mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
    let scales = &mechanism.dimensions().joint_scales;
    let joints = mechanism.joints().iter().zip(&at.joints).zip(scales);
    joints
        .filter_map(|((joint, x), scale)| Some((joint.limits?, x, scale)))
        .any(|((low, high), x, scale)| (x - low).abs().min((x - high).abs()) < 1e-9 * scale)
}
