//! Quantities at the configurations of a motion, from the engines of the analyses.

use std::f64::consts::{PI, TAU};

use super::places::Places;
use crate::algebra::{Expression, Function, Node, SiUnit};
use crate::analysis::singularities::SingularityMeter;
use crate::analysis::sweep::{Pace, Schedule};
use crate::analysis::velocity::{
    Normalised, Outputs, Spins, TransmissionAngles, condition, outputs,
};
use crate::geometry::Vector3;
use crate::mechanism::{Configuration, Figure, Frame, Measured, Mechanism, Order, Point, Quantity};
use crate::system::{self, Coordinate, Driven, Load, Loaded, Lock, Motion, Neighbourhood};

/// What a meter is for.
pub(in super::super) struct Metered<'q> {
    pub quantities: &'q [Quantity],
    /// The question with the inputs held.
    pub question: &'q system::Question<'q>,
    pub inputs: &'q [Driven],
    pub pace: Pace,
    pub schedule: Option<&'q Schedule>,
    pub load: &'q Load,
    pub outputs: &'q [Lock],
}

/// Evaluates quantities at assembled configurations. What to work out, and only what some quantity needs, is planned
/// once; rates, forces and Jacobian come from one factorisation of the closures.
pub(in super::super) struct Meter<'q> {
    of: Metered<'q>,
    /// For each held coordinate the number of its input and how far that goes, if it is one.
    ways: Vec<Option<(usize, f64)>>,
    turns: Vec<bool>,
    places: Places,
    /// Frames of links that spin about a line of their own: rates beside it are not determined.
    loose: Vec<Frame>,
    motion: Option<Motion>,
    loaded: Option<Loaded>,
    /// What everything does for a unit rate of each held coordinate, and what holds these against the load.
    responses: Vec<Vec<f64>>,
    forces: Vec<f64>,
    outputs: Option<(Outputs<'q>, Spinning<'q>)>,
    transmission: Option<TransmissionAngles>,
    /// With the distances that are asked for.
    distances: Option<(SingularityMeter<'q>, Vec<Figure>)>,
    wants: Wants,
    /// Rates, then accelerations of the held coordinates.
    driven: [Vec<f64>; 2],
    before: Vec<Option<f64>>,
    values: Vec<Option<f64>>,
    /// What the names in the quantities stand for, each once.
    names: Vec<Measured>,
    /// The quantities over the numbers of these names.
    programs: Vec<Expression<usize>>,
    /// The values of the names, and how far each may be off.
    known: Vec<[f64; 2]>,
    /// How far each quantity may be off.
    noise: Vec<f64>,
}

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

/// What the engines tell of one configuration.
struct Found<'a> {
    mechanism: &'a Mechanism,
    places: &'a Places,
    loose: &'a [Frame],
    /// Whether rates are determined there.
    moves: bool,
    /// The largest rate and acceleration, in rad and characteristic lengths.
    rates: [f64; 2],
    coordinates: &'a [Coordinate],
    forces: &'a [f64],
    transmission: Vec<(&'a str, Option<f64>)>,
    jacobian: Option<Normalised>,
    singular_values: Vec<f64>,
    distances: Vec<(Figure, Option<f64>)>,
}

impl<'q> Meter<'q> {
    pub fn new(of: Metered<'q>, start: &Configuration<f64>) -> Self {
        let question = of.question;
        let mechanism = question.mechanism();
        let all = || of.quantities.iter().flat_map(Quantity::measured);
        let wants = Wants::of(all());
        let frames = all().filter_map(|measured| match measured {
            Measured::Place(point, ..) | Measured::Size(point, _) | Measured::Curvature(point) => {
                Some(point.frame)
            }
            _ => None,
        });
        let frames: Vec<Frame> = frames.collect();
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
        let programs = programs.collect();
        let coordinates = question.driven_coordinates();
        let moves = wants.order > Order::Value || wants.responses();
        let still = question.clone().with_spins_still();
        let hold = |held| still.with_still(held);
        let motion = moves.then(|| Motion::with(mechanism, &coordinates, hold));
        let mut held = Neighbourhood::holding(mechanism, &question.held());
        let rest = held.tangent(start.clone());
        let spins = Spins::of(&held, &rest);
        let loose = frames
            .iter()
            .filter(|frame| !spins.lines_of(**frame).is_empty());
        let way = |of_it: &Coordinate| {
            let mut inputs = of.inputs.iter();
            let place = inputs.position(|input| input.coordinate == *of_it)?;
            Some((place, of.inputs[place].to - of.inputs[place].from))
        };
        Meter {
            ways: coordinates.iter().map(way).collect(),
            turns: of.quantities.iter().map(turns).collect(),
            places: Places::new(mechanism, &frames, wants.order),
            loaded: (motion.as_ref().filter(|_| wants.forces))
                .map(|motion| Loaded::new(mechanism, motion.unknowns(), of.load)),
            responses: Vec::new(),
            forces: Vec::new(),
            loose: loose.copied().collect(),
            outputs: (motion.as_ref().filter(|_| wants.jacobian)).map(|motion| {
                let outputs = outputs(mechanism, motion, &held, &rest);
                match spins.is_empty() {
                    true => (outputs, Spinning::Nothing(spins)),
                    false => (outputs, Spinning::Something(Box::new(held))),
                }
            }),
            transmission: wants.transmission.then(|| {
                let mut near = Neighbourhood::new(mechanism);
                TransmissionAngles::new(&mut near, start, &coordinates)
            }),
            distances: wants.distances.then(|| {
                let inputs = system::inputs_of(question);
                let distances = Figure::ALL.into_iter().filter(|figure| {
                    figure.is_distance() && all().any(|of| *of == Measured::Figure(*figure))
                });
                let meter = SingularityMeter::new(mechanism, &inputs, of.outputs, start);
                (meter, distances.collect())
            }),
            motion,
            driven: [(); 2].map(|()| vec![0.0; coordinates.len()]),
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
        let [_, rate, change] = self.of.pace.at(time);
        let [rates, changes] = &mut self.driven;
        for (i, way) in self.ways.iter().enumerate() {
            (rates[i], changes[i]) = match (way, self.of.schedule) {
                (None, _) => (0.0, 0.0),
                (Some((_, way)), None) => (way * rate, way * change),
                (Some((input, _)), Some(schedule)) => {
                    let [_, rate, change] = schedule.at(*input, time);
                    (rate, change)
                }
            };
        }
        let (mut moves, responses) = (false, &mut self.responses);
        if let Some(motion) = &mut self.motion {
            motion.at(at);
            moves = motion.is_determined();
            if self.wants.responses() {
                motion.responses_into(responses);
                motion.set_rates(responses, rates);
            } else {
                motion.rates(rates);
            }
        }
        match (&mut self.places, &mut self.motion) {
            (Places::Values(places), _) => places.place(at),
            (Places::Velocities(places), Some(motion)) => places.place(motion.first_path(at)),
            (Places::Accelerations(places), Some(motion)) => {
                motion.accelerations(at, rates, changes);
                places.place(motion.path(at));
            }
            (_, None) => unreachable!("rates are those of a motion"),
        }
        self.forces.clear();
        if let Some(loaded) = self.loaded.as_mut().filter(|_| moves) {
            // τ δh + g δx = 0: what holds a coordinate does the work of the load
            loaded.place(at);
            let forces = responses.iter().map(|rates| -loaded.power(rates));
            self.forces.extend(forces);
        }
        let jacobian = self.outputs.as_mut().filter(|_| moves);
        let jacobian = jacobian.map(|(outputs, spinning)| {
            outputs.place(at);
            match spinning {
                Spinning::Nothing(spins) => outputs.normalised(at, responses, spins),
                Spinning::Something(held) => {
                    let rest = held.tangent(at.clone());
                    outputs.normalised(at, responses, &Spins::of(held, &rest))
                }
            }
        });
        let transmission = self.transmission.as_mut().map(|angles| angles.angles(at));
        let distances = self.distances.iter_mut().flat_map(|(meter, figures)| {
            let figures = figures.iter();
            figures.map(move |figure| (*figure, meter.at(*figure, at)))
        });
        let values = jacobian.as_ref().filter(|_| self.wants.singular_values);
        let found = Found {
            mechanism: self.of.question.mechanism(),
            places: &self.places,
            loose: &self.loose,
            moves,
            rates: self.motion.as_ref().map_or([0.0; 2], Motion::largest),
            coordinates: self.motion.as_ref().map_or(&[], Motion::coordinates),
            forces: &self.forces,
            transmission: transmission.into_iter().flatten().collect(),
            singular_values: values.map_or_else(Vec::new, Normalised::singular_values),
            jacobian,
            distances: distances.collect(),
        };
        for (known, name) in self.known.iter_mut().zip(&self.names) {
            *known = found.value(name);
        }
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
        &self.values
    }

    /// The values last read.
    pub fn values(&self) -> &[Option<f64>] {
        &self.values
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

impl Found<'_> {
    /// The value of a name, not a number where it is not determined, and how far it may be off.
    fn value(&self, of: &Measured) -> [f64; 2] {
        [self.known(of).unwrap_or(f64::NAN), self.noise(of)]
    }

    /// How far the value of a name may be off: configurations are closed to 1e-12.
    fn noise(&self, of: &Measured) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let [rate, change] = self.rates;
        let most = |order: Order| match order {
            Order::Value => 1.0,
            Order::Velocity => rate,
            Order::Acceleration => change.max(rate * rate),
        };
        let length = self.mechanism.characteristic_length();
        let scale = |is_angle: bool| if is_angle { 1.0 } else { length };
        let size = match *of {
            Measured::Parameter(_) => 0.0,
            Measured::Joint(joint, order) => {
                self.mechanism.dimensions().joint_scales[joint] * most(order)
            }
            Measured::Place(_, c, order) => scale(c.is_angle()) * most(order),
            Measured::Size(_, order) => length * most(order),
            Measured::Transmission(_) => 10.0,
            Measured::Force(_) | Measured::PlatformForce(..) => self
                .forces
                .iter()
                .fold(0.0, |most: f64, x| most.max(x.abs())),
            // κ = |v × a| / |v|³ by δv and δa
            Measured::Curvature(point) => {
                let [v, a] = [Order::Velocity, Order::Acceleration]
                    .map(|order| self.vector(point, order).map_or(0.0, |v| v.norm()));
                length * (change.max(rate * rate) + rate * a / v) / (v * v)
            }
            Measured::Figure(_) => self.known(of).map_or(0.0, f64::abs),
        };
        ROUNDING * size
    }

    fn known(&self, of: &Measured) -> Option<f64> {
        match *of {
            Measured::Parameter(parameter) => Some(self.mechanism.parameters()[parameter].value),
            Measured::Joint(joint, order) => self.moving(self.places.joint(joint, order), order),
            Measured::Place(point, coordinate, order) => {
                let loose = self.loose.contains(&point.frame)
                    && order > Order::Value
                    && (coordinate.is_angle() || !point.is_origin());
                self.moving(self.places.coordinate(point, coordinate, order), order)
                    .filter(|_| !loose)
            }
            Measured::Size(point, order) => Some(self.vector(point, order)?.norm()),
            // κ = |v × a| / |v|³
            Measured::Curvature(point) => {
                let velocity = self.vector(point, Order::Velocity)?;
                if velocity.norm() <= self.noise(&Measured::Size(point, Order::Velocity)) {
                    return None;
                }
                let across = velocity.cross(&self.vector(point, Order::Acceleration)?);
                Some(across.norm() / velocity.norm().powi(3))
            }
            Measured::Force(joint) => self.force(Coordinate::Joint(joint)),
            Measured::PlatformForce(platform, c) => self.force(Coordinate::Pose(platform, c)),
            Measured::Transmission(closure) => {
                let name = closure.map(|closure| &*self.mechanism.closures()[closure].name);
                let angles = self.transmission.iter();
                let of_it = angles.filter(|(closure, _)| name.is_none_or(|name| name == *closure));
                of_it.filter_map(|(_, angle)| *angle).reduce(f64::min)
            }
            Measured::Figure(figure) => match figure {
                Figure::Condition => {
                    self.jacobian.as_ref()?;
                    condition(&self.singular_values)
                }
                Figure::Determinant => self.jacobian.as_ref()?.determinant(),
                Figure::Manipulability => {
                    self.jacobian.as_ref()?;
                    Some(self.singular_values.iter().product())
                }
                distance => {
                    let mut known = self.distances.iter();
                    known.find(|(of, _)| *of == distance)?.1
                }
            },
        }
    }

    /// Place, velocity or acceleration of a point.
    fn vector(&self, point: Point, order: Order) -> Option<Vector3<f64>> {
        let loose = order > Order::Value && !point.is_origin() && self.loose.contains(&point.frame);
        let known = (self.moves || order == Order::Value) && !loose;
        known.then(|| self.places.vector(point, order))?
    }

    /// A derivative, if rates are determined.
    fn moving(&self, value: Option<f64>, order: Order) -> Option<f64> {
        value.filter(|_| self.moves || order == Order::Value)
    }

    fn force(&self, of: Coordinate) -> Option<f64> {
        let place = self.coordinates.iter().position(|known| *known == of)?;
        self.forces.get(place).copied()
    }
}

/// The value of a quantity, if it has one, and how far it may be off, over values of names that may be. A value that
/// only rounding keeps finite, as that of 1/x where x is nothing but rounding, is none: away from it, it shrinks.
fn evaluated(program: &Expression<usize>, known: &[[f64; 2]]) -> (Option<f64>, f64) {
    if let Node::Name(name) = program.node {
        let [value, noise] = known[name];
        return (value.is_finite().then_some(value), noise);
    }
    let Ok(value) = program.evaluate(&|&name| known[name][0]) else {
        return (None, 0.0);
    };
    // uneven, so that differences of names are off too
    let beside = [1.0, -1.0].map(|side| {
        let off = |name: usize| side * [1.0, -0.73, 0.87, -0.61][name % 4];
        let value = program.evaluate(&|&name| known[name][0] + off(name) * known[name][1]);
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
