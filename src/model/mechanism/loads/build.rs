//! Values of masses, springs and forces from a file.

mod efforts;
mod masses;

use std::ops::Range;
use std::sync::Arc;

use super::{Along, Friction, GivenEffort, GivenForce, GivenValue, Loads, Mass, Spring};
use crate::algebra::{Expression, MeasureErrorKind, SiUnit};
use crate::description::{
    Displacement, Entry, GROUND, InertiaDescription, LoadDescription, LoadField, LoadKind,
    LoadProblem, LoadsDescription, MassDescription, Named, Problem, ProblemKind, Shape,
    ShapeDescription, Spanned, nearest, unless,
};
use crate::geometry::{Pose, Rotation};
use crate::mechanism::build::problem_of;
use crate::mechanism::{Body, Measured, Mechanism, Order, Point};
use crate::number::tolerance::ROUNDING;

/// Collects problems while values are read; a part with a problem is left out.
struct Reading<'a> {
    mechanism: &'a Mechanism,
    problems: Vec<Problem>,
}

/// A unit over that of a coordinate, to a power.
fn per(unit: SiUnit, of: SiUnit) -> SiUnit {
    unit.times(of.powi(-1).expect("a first power has an inverse"))
}

impl Loads {
    /// The values of what a file says acts in a mechanism.
    ///
    /// # Errors
    /// All problems, with their places.
    pub(in crate::mechanism) fn of(
        mechanism: &Mechanism,
        file: &LoadsDescription,
    ) -> Result<Self, Vec<Problem>> {
        let mut reading = Reading {
            mechanism,
            problems: Vec::new(),
        };
        let acceleration = per(SiUnit::METRE, SiUnit::SECOND.times(SiUnit::SECOND));
        let mut loads = Loads::default();
        if let Some(gravity) = &file.gravity {
            loads.gravity = gravity.each_ref().map(|x| reading.number(x, acceleration));
        }
        for Named { name, value } in &file.masses {
            loads.masses.extend(reading.mass(name, value));
        }
        for Named { name, value } in &file.loads {
            match value.kind {
                LoadKind::Spring => loads.springs.extend(reading.spring(name, value)),
                LoadKind::Force => loads.forces.extend(reading.force(name, value)),
                LoadKind::Friction => loads.frictions.extend(reading.friction(name, value)),
            }
        }
        unless(reading.problems, loads)
    }
}

impl Mechanism {
    /// Evaluates what the file says acts in it, and returns all problems. Joints at cuts at which something acts become
    /// joints.
    pub(in crate::mechanism) fn load_all(&mut self) -> Vec<Problem> {
        let file = self.loads_file.clone();
        for name in file.joints() {
            if let Some(opened) = self.with_closing_joint(&name.value) {
                *self = opened;
            }
        }
        match Loads::of(self, &file) {
            Ok(loads) => self.loads = Arc::new(loads),
            Err(problems) => return problems,
        }
        Vec::new()
    }

    /// The loads of the mechanism.
    pub fn loads(&self) -> &Loads {
        &self.loads
    }
}

impl LoadsDescription {
    /// The joints at which something acts.
    pub(in crate::mechanism) fn joints(&self) -> impl Iterator<Item = &Spanned<String>> {
        let fields = self.loads.iter().filter_map(|of| of.value.field("joint"));
        fields.filter_map(|field| match field {
            LoadField::Name(name) => Some(name),
            _ => None,
        })
    }
}

impl Reading<'_> {
    fn note(&mut self, problem: LoadProblem, span: &Range<usize>) {
        self.problems.push(problem.at(span));
    }

    /// A constant in a unit; not a number if it has a problem.
    fn number(&mut self, entry: &Entry, unit: SiUnit) -> f64 {
        let Some(resolved) = self.given(entry, unit) else {
            return f64::NAN;
        };
        let changing = resolved.names().find(|(of, _)| !of.is_constant());
        if let Some((_, span)) = changing {
            let name = entry.expression.names().find(|(_, at)| *at == span);
            let name = name.map(|(name, _)| name.clone()).unwrap_or_default();
            self.note(LoadProblem::NotConstant { name }, &span.clone());
            return f64::NAN;
        }
        let parameters = self.mechanism.parameters();
        let value = resolved.evaluate(&|of: &Measured| match *of {
            Measured::Parameter(i) => parameters[i].value,
            _ => f64::NAN,
        });
        value.unwrap_or_else(|error| {
            let kind = ProblemKind::NoValue(error.kind);
            self.problems.push(kind.at(error.span));
            f64::NAN
        })
    }

    /// A constant that is not negative.
    fn positive(&mut self, entry: &Entry, unit: SiUnit, what: &'static str) -> f64 {
        let value = self.number(entry, unit);
        if value < 0.0 {
            self.note(LoadProblem::Negative { what, value }, &entry.span);
        }
        value
    }

    /// An expression over quantities in a unit.
    fn given(&mut self, entry: &Entry, unit: SiUnit) -> Option<Expression<Measured>> {
        let read = (entry.expression).try_resolve(|name, span| {
            match Measured::read(self.mechanism, name) {
                Ok(of) if of.follows_from_forces() => {
                    let name = name.clone();
                    Err(Box::new(LoadProblem::NotGiven { name }.at(span)))
                }
                Ok(of) => Ok(of),
                Err(error) => Err(Box::new(problem_of(error).at(span.clone()))),
            }
        });
        let resolved = match read {
            Ok(resolved) => resolved,
            Err(problems) => {
                self.problems.extend(problems.into_iter().map(|of| *of));
                return None;
            }
        };
        match resolved.unit(&|of: &Measured| of.unit(self.mechanism)) {
            // a plain number is in the unit that is wanted
            Ok(Some(found))
                if ![SiUnit::ONE, unit.without_angle()].contains(&found.without_angle()) =>
            {
                let kind = MeasureErrorKind::Instead(unit.of_result(), found);
                let span = entry.span.clone();
                self.problems.push(ProblemKind::Unit(kind).at(span));
                None
            }
            Ok(_) => Some(resolved),
            Err(error) => {
                let kind = ProblemKind::Unit(error.kind);
                self.problems.push(kind.at(error.span));
                None
            }
        }
    }

    fn point(&mut self, name: &Spanned<String>) -> Option<Point> {
        let read = Point::read(self.mechanism, &name.value);
        let refused = |error| {
            let problem = crate::mechanism::QuantityError::Point {
                name: name.value.clone(),
                error,
            };
            self.problems
                .push(problem_of(problem).at(name.span.clone()));
        };
        read.map_err(refused).ok()
    }

    fn joint(&mut self, name: &Spanned<String>) -> Option<usize> {
        let found = self.mechanism.joint(&name.value);
        if found.is_none() {
            let closing = self.mechanism.closing_joints().iter().map(|of| &of.name);
            let known = self.mechanism.joints().iter().map(|of| &of.name);
            let meant = nearest(&name.value, known.chain(closing).map(String::as_str));
            let problem = LoadProblem::NoJoint {
                name: name.value.clone(),
                suggestion: meant.map(str::to_owned),
            };
            self.note(problem, &name.span);
        }
        found
    }

    /// The place at which something acts.
    fn along(&mut self, name: &Spanned<String>, of: &LoadDescription) -> Option<Along> {
        match (of.field("between"), of.field("joint")) {
            (Some(LoadField::Points(names)), None) => {
                let [a, b] = names.each_ref().map(|name| self.point(name));
                let points = [a?, b?];
                let [first, second] = points.map(|of| self.mechanism.body(of.frame));
                if first == second {
                    let name = name.value.clone();
                    let span = names[0].span.start..names[1].span.end;
                    self.note(LoadProblem::SameBody { name }, &span);
                    return None;
                }
                Some(Along::Points(points))
            }
            (None, Some(LoadField::Name(joint))) => Some(Along::Joint(self.joint(joint)?)),
            _ => {
                let fields = match of.kind {
                    LoadKind::Force => "`between`, `joint` or `at`",
                    _ => "`between` or `joint`",
                };
                let name = name.value.clone();
                self.note(LoadProblem::Needs { name, fields }, &of.span);
                None
            }
        }
    }

    /// The units of a coordinate and of what acts along it.
    fn units(&self, along: &Along) -> [SiUnit; 2] {
        let turns = match *along {
            Along::Joint(joint) => self.mechanism.joints()[joint].kind.is_angle(),
            Along::Points(_) => false,
        };
        [SiUnit::of_coordinate(turns), SiUnit::of_effort(turns)]
    }

    /// An expression of any unit.
    fn argument(&mut self, entry: &Entry) -> Option<Expression<Measured>> {
        let before = self.problems.len();
        let found = self.given(entry, SiUnit::ONE);
        let new = self.problems.get(before).map(|problem| &problem.kind);
        match new {
            Some(&ProblemKind::Unit(MeasureErrorKind::Instead(_, unit))) => {
                self.problems.truncate(before);
                self.given(entry, unit)
            }
            _ => found,
        }
    }

    fn table(&mut self, rows: &[[Entry; 2]]) -> Option<Vec<[f64; 2]>> {
        let values = rows.iter().map(|row| row.each_ref().map(|x| self.any(x)));
        let values: Vec<[f64; 2]> = values.collect();
        let rises = values.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        if !rises || values.len() < 2 {
            let span = rows.first().zip(rows.last());
            let span = span.map_or(0..0, |(first, last)| first[0].span.start..last[1].span.end);
            self.note(LoadProblem::Table, &span);
            return None;
        }
        Some(values)
    }

    /// A constant of any unit.
    fn any(&mut self, entry: &Entry) -> f64 {
        let unit = entry.expression.unit(&|_| None).ok().flatten();
        self.number(entry, unit.unwrap_or(SiUnit::ONE))
    }
}

impl Measured {
    /// True for a parameter.
    pub fn is_constant(&self) -> bool {
        matches!(self, Measured::Parameter(_))
    }

    /// True for what is known only once all forces are.
    pub fn follows_from_forces(&self) -> bool {
        match self {
            Measured::Parameter(_) | Measured::Time => false,
            Measured::Joint(_, order) | Measured::Place(_, _, order) | Measured::Size(_, order) => {
                *order == Order::Acceleration
            }
            _ => true,
        }
    }
}
