//! Quantities at the configurations of a motion, from the engines of the analyses.

mod found;
mod probe;
mod programs;
mod waiting;

use std::f64::consts::{PI, TAU};

use crate::algebra::Expression;
use crate::analysis::singularities::Classifier;
use crate::analysis::sweep::{Pace, Row, Schedule};
use crate::analysis::velocity::{
    Normalised, Outputs, Spins, TransmissionAngles, condition, outputs,
};
use crate::linear::DENSE_LIMIT;
use crate::mechanism::{Configuration, Figure, Frame, Measured, Order, Point, Quantity};
use crate::number::{LANES, Lanes, Number, Packed};
use crate::system::{self, Coordinate, Driven, Load, Loaded, Lock, Neighbourhood};
use found::Here;
use probe::{Found, Plan, Probe};
use programs::{evaluated, turns};
use waiting::Waiting;

/// What a meter is for.
#[derive(Clone, Debug)]
pub(in super::super) struct Metered<'q> {
    pub quantities: Vec<Quantity>,
    /// The question with the inputs held.
    pub question: system::Question<'q>,
    pub inputs: Vec<Driven>,
    pub pace: Pace,
    pub schedule: Option<Schedule>,
    pub load: Load,
    pub outputs: Vec<Lock>,
}

/// Whether rows are read in lanes: a second copy of the engine of rates, which would be nearly a tenth of the page.
const SIDE_BY_SIDE: bool = !cfg!(target_family = "wasm");

/// Evaluates quantities at assembled configurations. What to work out, and only what some quantity needs, is planned
/// once; rates, forces and Jacobian come from one factorisation of the closures, of eight rows of a motion side by side.
pub(in super::super) struct Meter<'q> {
    of: &'q Metered<'q>,
    /// For each held coordinate the number of its input and how far that goes, if it is one.
    ways: Vec<Option<(usize, f64)>>,
    turns: Vec<bool>,
    /// Frames of links that spin about a line of their own: rates beside it are not determined.
    loose: Vec<Frame>,
    coordinates: Vec<Coordinate>,
    plan: Plan,
    probe: Probe<'q, f64>,
    /// That of rows side by side, once there are so many.
    side_by_side: Option<Box<Side<'q>>>,
    /// Rows that wait for others, and how many do.
    waiting: Vec<Waiting>,
    waits: usize,
    jacobian: Normalised,
    spinning: Spinning<'q>,
    /// With the distances that are asked for.
    distances: Option<(Classifier<'q>, Vec<Figure>)>,
    wants: Wants,
    /// Rates, then accelerations of the held coordinates.
    driven: [Vec<f64>; 2],
    before: Vec<Option<f64>>,
    values: Vec<Option<f64>>,
    figures: Vec<(Figure, Option<f64>)>,
    /// What the names in the quantities stand for, each once, with the number of the point, if it is of one.
    names: Vec<(Measured, usize)>,
    /// The quantities over the numbers of these names.
    programs: Vec<Expression<usize>>,
    /// The values of the names, and how far each may be off.
    known: Vec<[f64; 2]>,
    /// How far each quantity may be off.
    noise: Vec<f64>,
}

/// A configuration in each lane, and rates and accelerations of what is held there.
struct Side<'q> {
    probe: Probe<'q, Lanes>,
    at: Configuration<Lanes>,
    driven: [Vec<Lanes>; 2],
}

/// What takes rows with the part of the time that is gone, their values, and how far these may be off.
pub(in super::super) type Take<'t> = dyn FnMut(&Row, f64, &[Option<f64>], &[f64]) + 't;

/// The lines about which links spin: none, or those of each configuration.
enum Spinning<'q> {
    Nothing(Spins),
    Something(Box<Neighbourhood<'q>>),
}

/// What the quantities need beside positions.
#[derive(Clone, Copy)]
struct Wants {
    order: Order,
    forces: bool,
    transmission: bool,
    jacobian: bool,
    determinant: bool,
    singular_values: bool,
    distances: bool,
}

impl Wants {
    fn of<'m>(measured: impl Iterator<Item = &'m Measured>) -> Self {
        let mut wants = Wants {
            order: Order::Value,
            forces: false,
            transmission: false,
            jacobian: false,
            determinant: false,
            singular_values: false,
            distances: false,
        };
        for measured in measured {
            match measured {
                Measured::Parameter(_) => {}
                Measured::Joint(_, order)
                | Measured::Place(_, _, order)
                | Measured::Size(_, order) => wants.order = wants.order.max(*order),
                Measured::Curvature(_) => wants.order = Order::Acceleration,
                Measured::Force(_) | Measured::PlatformForce(..) => wants.forces = true,
                Measured::Transmission(_) => wants.transmission = true,
                Measured::Figure(Figure::Determinant) => {
                    (wants.jacobian, wants.determinant) = (true, true);
                }
                Measured::Figure(Figure::Condition | Figure::Manipulability) => {
                    (wants.jacobian, wants.singular_values) = (true, true);
                }
                Measured::Figure(_) => wants.distances = true,
            }
        }
        wants
    }
}

impl<'q> Meter<'q> {
    pub fn new(of: &'q Metered<'q>, start: &Configuration<f64>) -> Self {
        let question = &of.question;
        let mechanism = question.mechanism();
        let all = || of.quantities.iter().flat_map(Quantity::measured);
        let wants = Wants::of(all());
        let mut points: Vec<Point> = Vec::new();
        for measured in all() {
            if let Measured::Place(point, ..)
            | Measured::Size(point, _)
            | Measured::Curvature(point) = measured
                && !points.contains(point)
            {
                points.push(*point);
            }
        }
        let mut names: Vec<Measured> = Vec::new();
        let mut number = |name: &Measured| {
            let known = names.iter().position(|of| of == name);
            known.unwrap_or_else(|| {
                names.push(*name);
                names.len() - 1
            })
        };
        let programs = of.quantities.iter().map(|quantity| {
            let program = (quantity.expression).try_resolve(|name, _| Ok::<_, ()>(number(name)));
            program.expect("every name has a number")
        });
        let programs: Vec<Expression<usize>> = programs.collect();
        let coordinates = question.driven_coordinates();
        let mut held = Neighbourhood::holding(mechanism, &question.held());
        let rest = held.tangent(start.clone());
        let spins = Spins::of(&held, &rest);
        let outputs = match wants.jacobian {
            true => outputs(mechanism, &coordinates, &held, &rest),
            false => Vec::new(),
        };
        let mut frames: Vec<Frame> = points.iter().map(|point| point.frame).collect();
        let loose = frames
            .iter()
            .filter(|frame| !spins.lines_of(**frame).is_empty());
        let loose = loose.copied().collect();
        frames.extend(Outputs::frames(&outputs).chain(Loaded::frames(&of.load)));
        if wants.transmission {
            frames.extend(TransmissionAngles::frames(mechanism));
        }
        let numbered = names.iter().map(|name| match name {
            Measured::Place(point, ..) | Measured::Size(point, _) | Measured::Curvature(point) => {
                let number = points.iter().position(|known| known == point);
                (*name, number.unwrap_or(0))
            }
            _ => (*name, 0),
        });
        let names: Vec<(Measured, usize)> = numbered.collect();
        let held_by = |coordinate: &Coordinate| {
            names.iter().any(|(name, _)| match *name {
                Measured::Force(joint) => *coordinate == Coordinate::Joint(joint),
                Measured::PlatformForce(platform, c) => {
                    *coordinate == Coordinate::Pose(platform, c)
                }
                _ => false,
            })
        };
        let wanted = coordinates.iter();
        let wanted = wanted.map(|of_it| wants.jacobian || held_by(of_it));
        let angles = names.iter().filter_map(|(name, point)| match name {
            Measured::Place(_, c, order) if c.is_angle() => Some((*point, *c, *order)),
            _ => None,
        });
        let mut plan = Plan {
            order: wants.order,
            angles: angles.collect(),
            responses: wanted.collect(),
            forces: wants.forces,
            outputs: wants.jacobian.then_some(outputs),
            transmission: None,
            points,
            frames,
        };
        let probe = Probe::new(of, &plan);
        plan.transmission = wants.transmission.then(|| {
            let mut near = Neighbourhood::new(mechanism);
            TransmissionAngles::new(&mut near, start, &coordinates, probe.kinematics())
        });
        let way = |of_it: &Coordinate| {
            let mut inputs = of.inputs.iter();
            let place = inputs.position(|input| input.coordinate == *of_it)?;
            Some((place, of.inputs[place].to - of.inputs[place].from))
        };
        Meter {
            ways: coordinates.iter().map(way).collect(),
            turns: of.quantities.iter().map(turns).collect(),
            spinning: match spins.is_empty() || !wants.jacobian {
                true => Spinning::Nothing(spins),
                false => Spinning::Something(Box::new(held)),
            },
            figures: Vec::new(),
            loose,
            distances: wants.distances.then(|| {
                let inputs = system::inputs_of(question);
                let distances = Figure::ALL.into_iter().filter(|figure| {
                    figure.is_distance() && all().any(|of| *of == Measured::Figure(*figure))
                });
                let outputs = match &of.outputs[..] {
                    [] => system::default_outputs(mechanism, &inputs),
                    outputs => outputs.to_vec(),
                };
                let classifier = Classifier::new(mechanism, &inputs, &outputs, start);
                (classifier, distances.collect())
            }),
            driven: [(); 2].map(|()| vec![0.0; coordinates.len()]),
            coordinates,
            plan,
            probe,
            side_by_side: None,
            waiting: Vec::new(),
            waits: 0,
            jacobian: Normalised::default(),
            before: vec![None; of.quantities.len()],
            values: vec![None; of.quantities.len()],
            known: vec![[0.0; 2]; names.len()],
            noise: vec![0.0; of.quantities.len()],
            names,
            programs,
            wants,
            of,
        }
    }

    /// The values at a configuration where a part of the time is gone; none where something is not determined.
    pub fn read(&mut self, at: &Configuration<f64>, time: f64) -> &[Option<f64>] {
        driven(self.of, &self.ways, |_| time, &mut self.driven);
        match &mut self.spinning {
            Spinning::Nothing(spins) => self.probe.at(&self.plan, at, &self.driven, spins),
            Spinning::Something(held) => {
                let rest = held.tangent(at.clone());
                let spins = Spins::of(held, &rest);
                self.probe.at(&self.plan, at, &self.driven, &spins)
            }
        }
        let found = std::mem::take(&mut self.probe.found);
        self.evaluate(at, &found, 0);
        self.probe.found = found;
        &self.values
    }

    /// Reads a row of a motion where a part of the time is gone, or lets it wait for others; rows go to `take` in their
    /// order.
    pub fn read_row(&mut self, row: &Row, time: f64, take: &mut Take) {
        let (at, unknowns) = (row.configuration, self.probe.unknowns());
        let alone = unknowns > DENSE_LIMIT || matches!(self.spinning, Spinning::Something(_));
        if alone || !SIDE_BY_SIDE {
            self.read(at, time);
            return take(row, time, &self.values, &self.noise);
        }
        if self.waits == self.waiting.len() {
            self.waiting.push(Waiting::new(at));
        }
        self.waiting[self.waits].put(row, time);
        self.waits += 1;
        if self.waits == LANES {
            self.read_waiting(take);
        }
    }

    /// Reads the rows that wait.
    pub fn read_waiting(&mut self, take: &mut Take) {
        let rows = std::mem::take(&mut self.waiting);
        let waits = std::mem::take(&mut self.waits);
        let full = SIDE_BY_SIDE && waits == LANES;
        let side = full.then(|| self.side_by_side(&rows)).flatten();
        let together = side.as_ref().and_then(|side| side.probe.sure());
        for (place, row) in rows[..waits].iter().enumerate() {
            match together {
                Some(found) => self.evaluate(&row.at, found, place),
                None => _ = self.read(&row.at, row.time),
            }
            take(&row.row(), row.time, &self.values, &self.noise);
        }
        self.side_by_side = side;
        self.waiting = rows;
    }

    /// What is planned, worked out for eight rows.
    fn side_by_side(&mut self, rows: &[Waiting]) -> Option<Box<Side<'q>>> {
        let Spinning::Nothing(spins) = &self.spinning else {
            return None;
        };
        let mut side = self.side_by_side.take().unwrap_or_else(|| {
            Box::new(Side {
                probe: Probe::new(self.of, &self.plan),
                at: rows[0].at.map(Lanes::from_f64),
                driven: [(); 2].map(|()| vec![Lanes::zero(); self.coordinates.len()]),
            })
        });
        for (lane, row) in rows.iter().enumerate() {
            side.at.set_lane(lane, &row.at);
        }
        let time = |lane: usize| rows[lane].time;
        driven(self.of, &self.ways, time, &mut side.driven);
        side.probe.at(&self.plan, &side.at, &side.driven, spins);
        Some(side)
    }

    /// Values at a configuration from what was found there, in one place.
    fn evaluate<T: Packed>(&mut self, at: &Configuration<f64>, found: &Found<T>, place: usize) {
        self.figures.clear();
        if found.moves && self.wants.jacobian {
            let jacobian = &mut self.jacobian;
            found.jacobian.take(place, jacobian);
            if self.wants.determinant {
                (self.figures).push((Figure::Determinant, jacobian.determinant()));
            }
            if self.wants.singular_values {
                let values = jacobian.singular_values();
                let product = values.iter().product();
                (self.figures).push((Figure::Condition, condition(&values)));
                (self.figures).push((Figure::Manipulability, Some(product)));
            }
        }
        if let Some((classifier, figures)) = &mut self.distances {
            let figures = figures
                .iter()
                .map(|figure| (*figure, classifier.distance(*figure, at)));
            self.figures.extend(figures);
        }
        let largest = |of: &[T]| {
            let sizes = of.iter().map(|x| x.part(place).abs());
            sizes.fold(0.0, f64::max)
        };
        let here = Here {
            at,
            found,
            place,
            largest: [largest(&found.rates[0]), largest(&found.rates[1])],
        };
        let mut known = std::mem::take(&mut self.known);
        for (known, (name, number)) in known.iter_mut().zip(&self.names) {
            *known = self.value(&here, name, *number);
        }
        self.known = known;
        for (i, program) in self.programs.iter().enumerate() {
            let (value, noise) = evaluated(program, &self.known);
            let value = value.map(|value| match (self.turns[i], self.before[i]) {
                // an angle is given without jumps
                (true, Some(before)) if (value - before).abs() > PI => {
                    value - TAU * ((value - before) / TAU).round()
                }
                _ => value,
            });
            self.values[i] = value;
            self.noise[i] = noise;
            self.before[i] = value.or(self.before[i]);
        }
    }

    /// How far each value last read may be off.
    pub fn noise(&self) -> &[f64] {
        &self.noise
    }

    /// Angles are given near to these values from here on.
    pub fn settle(&mut self, values: &[Option<f64>]) {
        self.before.copy_from_slice(values);
    }
}

/// Rates and accelerations of the held coordinates where a part of the time is gone, in each place.
fn driven<T: Packed>(
    of: &Metered,
    ways: &[Option<(usize, f64)>],
    time: impl Fn(usize) -> f64,
    driven: &mut [Vec<T>; 2],
) {
    for (i, way) in ways.iter().enumerate() {
        let Some((input, way)) = *way else { continue };
        for (order, driven) in driven.iter_mut().enumerate() {
            driven[i] = T::of_parts(|place| match &of.schedule {
                None => way * of.pace.at(time(place))[1 + order],
                Some(schedule) => schedule.at(input, time(place))[1 + order],
            });
        }
    }
}
