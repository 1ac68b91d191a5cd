//! Quantities at the configurations of a motion, from the engines of the analyses.

mod found;
mod moving;
mod waiting;

use std::f64::consts::{PI, TAU};

use crate::algebra::{Expression, Function, Node, SiUnit};
use crate::analysis::singularities::Classifier;
use crate::analysis::sweep::{Pace, Row, Schedule};
use crate::analysis::velocity::{
    Normalised, Outputs, Spins, TransmissionAngles, condition, outputs,
};
use crate::linear::DENSE_LIMIT;
use crate::mechanism::{
    Configuration, Figure, Frame, Kinematics, Measured, Order, Placement, Point, Quantity,
};
use crate::number::{Dual, LANES, Lanes, Number, Packed};
use crate::system::{
    self, Coordinate, Driven, FrameTwists, Held, Load, Loaded, Lock, Neighbourhood, System, Unknown,
};
use found::Here;
use moving::{Moved, Moving, Plan};
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

/// Evaluates quantities at assembled configurations. What to work out, and only what some quantity needs, is planned
/// once; rates, forces and Jacobian come from one factorisation of the closures, of eight rows of a motion side by side.
pub(in super::super) struct Meter<'q> {
    of: &'q Metered<'q>,
    /// For each held coordinate the number of its input and how far that goes, if it is one.
    ways: Vec<Option<(usize, f64)>>,
    turns: Vec<bool>,
    /// The points and how they move.
    twists: FrameTwists<f64>,
    /// Its frames with those of the closures, and where these are.
    kinematics: Kinematics<f64>,
    placement: Placement<f64>,
    /// Frames of links that spin about a line of their own: rates beside it are not determined.
    loose: Vec<Frame>,
    plan: Plan,
    /// The rates, if some are wanted.
    moving: Option<Moving<f64>>,
    /// Those of rows side by side, once there are so many.
    side_by_side: Option<Box<Side>>,
    /// Rows that wait for others.
    waiting: Vec<Waiting>,
    waits: usize,
    moved: Moved,
    coordinates: Vec<Coordinate>,
    loaded: Option<Loaded>,
    /// What holds each held coordinate against the load.
    forces: Vec<f64>,
    outputs: Option<(Outputs<'q>, Spinning<'q>)>,
    jacobian: Normalised,
    transmission: Option<TransmissionAngles>,
    angles: Vec<Option<f64>>,
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

/// The engine of rates over lanes, a configuration in each, and rates and accelerations of what is held there.
struct Side {
    moving: Moving<Lanes>,
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
                Measured::Figure(Figure::Determinant) => wants.jacobian = true,
                Measured::Figure(Figure::Condition | Figure::Manipulability) => {
                    (wants.jacobian, wants.singular_values) = (true, true);
                }
                Measured::Figure(_) => wants.distances = true,
            }
        }
        wants
    }

    /// Whether what everything does for a unit rate of each input is needed.
    fn responses(self) -> bool {
        self.forces || self.jacobian
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
        let moves = wants.order > Order::Value || wants.responses();
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
        let (dimensions, nothing) = (mechanism.dimensions(), Held::nothing(mechanism));
        let placing = System::placing(mechanism, dimensions, &nothing, &frames);
        let kinematics = placing.kinematics().clone();
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
        let plan = Plan {
            wanted: wanted.collect(),
            angles: Plan::angles_of(&names),
            accelerations: wants.order == Order::Acceleration,
            points,
            frames,
        };
        let moving = moves.then(|| Moving::<f64>::new(of, &plan));
        let unknowns: &[Unknown] = moving.as_ref().map_or(&[], |of| of.motion.unknowns());
        let loaded = (moves && wants.forces)
            .then(|| Loaded::new(mechanism, unknowns, &of.load, &kinematics));
        let transmission = wants.transmission.then(|| {
            let mut near = Neighbourhood::new(mechanism);
            TransmissionAngles::new(&mut near, start, &coordinates, &kinematics)
        });
        let twists = FrameTwists::sharing(&kinematics, dimensions, unknowns, &plan.points);
        let way = |of_it: &Coordinate| {
            let mut inputs = of.inputs.iter();
            let place = inputs.position(|input| input.coordinate == *of_it)?;
            Some((place, of.inputs[place].to - of.inputs[place].from))
        };
        Meter {
            ways: coordinates.iter().map(way).collect(),
            turns: of.quantities.iter().map(turns).collect(),
            forces: Vec::new(),
            outputs: (moving.as_ref().filter(|_| wants.jacobian)).map(|moving| {
                let outputs = Outputs::new(mechanism, &moving.motion, outputs);
                match spins.is_empty() {
                    true => (outputs, Spinning::Nothing(spins)),
                    false => (outputs, Spinning::Something(Box::new(held))),
                }
            }),
            jacobian: Normalised::default(),
            angles: Vec::new(),
            figures: Vec::new(),
            twists,
            placement: kinematics.placement(),
            kinematics,
            loose,
            loaded,
            transmission,
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
            moving,
            plan,
            side_by_side: None,
            waiting: Vec::new(),
            waits: 0,
            moved: Moved::default(),
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
        let mut placement = std::mem::take(&mut self.placement);
        self.kinematics.place(at, &mut placement);
        self.read_placed(at, &placement, time);
        self.placement = placement;
        &self.values
    }

    /// The same where the [frames](Self::frames) are placed.
    fn read_placed(&mut self, at: &Configuration<f64>, placement: &Placement<f64>, time: f64) {
        if let Some(moving) = &mut self.moving {
            driven(self.of, &self.ways, |_| time, &mut self.driven);
            moving.at(&self.plan, at, Some(placement), &self.driven);
            moving.take(0, &mut self.moved);
        }
        self.evaluate(at, placement);
    }

    /// Reads a row of a motion where a part of the time is gone, or lets it wait for others; rows go to `take` in their
    /// order, with their times.
    pub fn read_row(&mut self, row: &Row, time: f64, take: &mut Take) {
        let (at, few) = (row.configuration, self.plan_is_small());
        if !few {
            match row.placement {
                Some(placement) => self.read_placed(at, placement, time),
                None => _ = self.read(at, time),
            }
            return take(row, time, &self.values, &self.noise);
        }
        if self.waits == self.waiting.len() {
            self.waiting.push(Waiting::new(at, &self.kinematics));
        }
        self.waiting[self.waits].put(row, time, &self.kinematics);
        self.waits += 1;
        if self.waits == LANES {
            self.read_waiting(take);
        }
    }

    /// Whether rates are wanted of a mechanism for which they are worked out side by side.
    fn plan_is_small(&self) -> bool {
        let moving = self.moving.as_ref();
        moving.is_some_and(|moving| moving.motion.unknowns().len() <= DENSE_LIMIT)
    }

    /// Reads the rows that wait.
    pub fn read_waiting(&mut self, take: &mut Take) {
        let rows = std::mem::take(&mut self.waiting);
        let waits = std::mem::take(&mut self.waits);
        let together = waits == LANES && self.move_side_by_side(&rows);
        for (place, row) in rows[..waits].iter().enumerate() {
            match &self.side_by_side {
                Some(side) if together => {
                    side.moving.take(place, &mut self.moved);
                    self.evaluate(&row.at, &row.placement);
                }
                _ => self.read_placed(&row.at, &row.placement, row.time),
            }
            take(&row.row(), row.time, &self.values, &self.noise);
        }
        self.waiting = rows;
    }

    /// Works out the rates of eight rows, if they are determined at each.
    fn move_side_by_side(&mut self, rows: &[Waiting]) -> bool {
        let side = self.side_by_side.get_or_insert_with(|| {
            Box::new(Side {
                moving: Moving::new(self.of, &self.plan),
                at: rows[0].at.map(Lanes::from_f64),
                driven: [(); 2].map(|()| vec![Lanes::zero(); self.coordinates.len()]),
            })
        });
        for (lane, row) in rows.iter().enumerate() {
            side.at.set_lane(lane, &row.at);
        }
        driven(
            self.of,
            &self.ways,
            |lane| rows[lane].time,
            &mut side.driven,
        );
        (side.moving).at(&self.plan, &side.at, None, &side.driven);
        side.moving.is_sure()
    }

    /// Values at a configuration whose motion is known.
    fn evaluate(&mut self, at: &Configuration<f64>, placement: &Placement<f64>) {
        let Moved {
            moves,
            orders,
            responses,
            ..
        } = &self.moved;
        let moves = *moves;
        self.forces.clear();
        if let Some(loaded) = self.loaded.as_mut().filter(|_| moves) {
            // τ δh + g δx = 0: what holds a coordinate does the work of the load
            let forces = responses.iter().zip(&self.plan.wanted);
            self.forces
                .extend(forces.map(|(rates, wanted)| match wanted {
                    true => -loaded.power(rates, placement),
                    false => f64::NAN,
                }));
        }
        self.figures.clear();
        if let Some((outputs, spinning)) = self.outputs.as_mut().filter(|_| moves) {
            let jacobian = &mut self.jacobian;
            match spinning {
                Spinning::Nothing(spins) => {
                    outputs.normalised_into(jacobian, at, placement, responses, spins);
                }
                Spinning::Something(held) => {
                    let rest = held.tangent(at.clone());
                    let spins = Spins::of(held, &rest);
                    outputs.normalised_into(jacobian, at, placement, responses, &spins);
                }
            }
            (self.figures).push((Figure::Determinant, jacobian.determinant()));
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
        self.angles.clear();
        if let Some(transmission) = &self.transmission {
            self.angles.extend(transmission.angles(placement));
        }
        let here = Here {
            at,
            placement,
            moves,
            largest: [0, 1].map(|k| orders[k].iter().fold(0.0, |most: f64, x| most.max(x.abs()))),
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

    /// The frames that it places with those of the closures.
    pub fn frames(&self) -> &[Frame] {
        &self.plan.frames
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

/// The value of a quantity, if it has one, and how far it may be off, over values of names that may be. A value that
/// only rounding keeps finite, as that of 1/x where x is nothing but rounding, is none: away from it, it shrinks.
fn evaluated(program: &Expression<usize>, known: &[[f64; 2]]) -> (Option<f64>, f64) {
    if let Node::Name(name) = program.node {
        let [value, noise] = known[name];
        return (value.is_finite().then_some(value), noise);
    }
    // uneven, so that differences of names are off too
    let off = |name: usize| [1.0, -0.73, 0.87, -0.61][name % 4] * known[name][1];
    let along = program.evaluate(&|&name| Dual {
        value: known[name][0],
        slope: off(name),
    });
    if let Ok(Dual { value, slope }) = along
        && 4.0 * slope.abs() <= value.abs()
    {
        return (Some(value), slope.abs());
    }
    let Ok(value) = program.evaluate(&|&name| known[name][0]) else {
        return (None, 0.0);
    };
    let beside = [1.0, -1.0].map(|side| {
        let value = program.evaluate(&|&name| known[name][0] + side * off(name));
        value.ok()
    });
    let shrinks = |of: &Option<f64>| of.is_some_and(|x| 2.0 * x.abs() < value.abs());
    let off = beside.iter().flatten();
    let noise = off.fold(0.0, |most: f64, x| most.max((x - value).abs()));
    ((!beside.iter().all(shrinks)).then_some(value), noise)
}

/// Whether a quantity is an angle that is known but for whole turns.
fn turns(quantity: &Quantity) -> bool {
    fn has_atan2(expression: &Expression<Measured>) -> bool {
        matches!(expression.node, Node::Call(Function::Atan2, _))
            || expression.operands().any(has_atan2)
    }
    let angle = |of: &Measured| matches!(of, Measured::Place(_, c, Order::Value) if c.is_angle());
    quantity.unit == SiUnit::RADIAN
        && (quantity.measured().any(angle) || has_atan2(&quantity.expression))
}
