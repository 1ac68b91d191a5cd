//! Quantities at the configurations of a motion, from the engines of the analyses.

use std::f64::consts::{PI, TAU};

use crate::algebra::{Expression, Function, Node, SiUnit};
use crate::analysis::singularities::{Distances, SingularityMeter};
use crate::analysis::sweep::Pace;
use crate::analysis::velocity::{InputOutput, Transmission, input_output, transmission};
use crate::linear::norm;
use crate::mechanism::{
    Configuration, Figure, Frame, Kinematics, Measured, Mechanism, Order, Placement, Quantity,
};
use crate::number::Dual;
use crate::system::{
    self, Coordinate, Driven, Equilibrium, Load, Lock, Motion, Neighbourhood, Tangent,
};

/// A number with its first and second derivative by time.
type Second = Dual<Dual<f64>>;

/// What a meter is for.
pub(in super::super) struct Metered<'q> {
    pub quantities: &'q [Quantity],
    /// The question with the inputs held.
    pub question: &'q system::Question<'q>,
    pub inputs: &'q [Driven],
    pub pace: Pace,
    pub load: &'q Load,
    pub outputs: &'q [Lock],
}

/// Evaluates quantities at assembled configurations. Only what some quantity needs is worked out.
pub(in super::super) struct Meter<'q> {
    of: Metered<'q>,
    coordinates: Vec<Coordinate>,
    kinematics: Kinematics<Second>,
    placement: Placement<Second>,
    /// What stands still has no rates.
    at_rest: Configuration<Second>,
    motion: Option<Motion>,
    near: Option<Neighbourhood<'q>>,
    distances: Option<SingularityMeter<'q>>,
    wants: Wants,
    rates: Vec<f64>,
    changes: Vec<f64>,
    before: Vec<Option<f64>>,
    values: Vec<Option<f64>>,
}

/// What the quantities need beside positions.
#[derive(Clone, Copy, Default)]
struct Wants {
    rates: bool,
    forces: bool,
    transmission: bool,
    jacobian: bool,
    distances: bool,
}

impl Wants {
    fn of<'m>(measured: impl Iterator<Item = &'m Measured>) -> Self {
        let mut wants = Wants::default();
        for measured in measured {
            match measured {
                Measured::Parameter(_) => {}
                Measured::Joint(_, order) | Measured::Place(_, _, order) => {
                    wants.rates |= *order != Order::Value;
                }
                Measured::Size(..) => wants.rates = true,
                Measured::Force(_) | Measured::PlatformForce(..) => wants.forces = true,
                Measured::Transmission(_) => wants.transmission = true,
                Measured::Figure(
                    Figure::Condition | Figure::Determinant | Figure::Manipulability,
                ) => wants.jacobian = true,
                Measured::Figure(Figure::Direct | Figure::Inverse | Figure::Constraint) => {
                    wants.distances = true;
                }
            }
        }
        wants
    }
}

/// What the engines tell of one configuration.
struct Found<'a> {
    mechanism: &'a Mechanism,
    path: &'a Configuration<Second>,
    /// Whether rates are determined there.
    moves: bool,
    kinematics: &'a Kinematics<Second>,
    placement: &'a Placement<Second>,
    forces: Vec<(Coordinate, Option<f64>)>,
    transmission: Vec<Transmission>,
    jacobian: Option<InputOutput>,
    distances: Option<Distances>,
}

impl<'q> Meter<'q> {
    pub fn new(of: Metered<'q>, start: &Configuration<f64>) -> Self {
        let mechanism = of.question.mechanism();
        let all = || of.quantities.iter().flat_map(Quantity::measured);
        let wants = Wants::of(all());
        let frames: Vec<Frame> = all()
            .filter_map(|measured| match measured {
                Measured::Place(point, ..) | Measured::Size(point, _) => Some(point.frame),
                _ => None,
            })
            .collect();
        let lift = |x| Dual::constant(Dual::constant(x));
        let dimensions = mechanism.dimensions().map(&mut { lift });
        let kinematics = Kinematics::new(&dimensions, frames);
        let coordinates = of.question.driven_coordinates();
        let moves = wants.rates || wants.jacobian;
        let close = wants.forces || wants.transmission;
        let inputs: Vec<Coordinate> = system::inputs_of(of.question);
        Meter {
            placement: kinematics.placement(),
            at_rest: start.map(lift),
            motion: moves.then(|| Motion::new(mechanism, &coordinates)),
            near: close.then(|| Neighbourhood::new(mechanism)),
            distances: wants
                .distances
                .then(|| SingularityMeter::new(mechanism, &inputs, of.outputs, start)),
            rates: vec![0.0; coordinates.len()],
            changes: vec![0.0; coordinates.len()],
            before: vec![None; of.quantities.len()],
            values: vec![None; of.quantities.len()],
            kinematics,
            coordinates,
            wants,
            of,
        }
    }

    /// The values at a configuration where a part of the time is gone; none where something is not determined.
    pub fn read(&mut self, at: &Configuration<f64>, time: f64) -> &[Option<f64>] {
        let mechanism = self.of.question.mechanism();
        let [_, rate, change] = self.of.pace.at(time);
        for (i, coordinate) in self.coordinates.iter().enumerate() {
            let input = self
                .of
                .inputs
                .iter()
                .find(|input| input.coordinate == *coordinate);
            let way = input.map_or(0.0, |input| input.to - input.from);
            (self.rates[i], self.changes[i]) = (way * rate, way * change);
        }
        let transmission = match &mut self.near {
            Some(near) if self.wants.transmission => transmission(near, at, &self.coordinates),
            _ => Vec::new(),
        };
        let tangent = self.near.as_mut().filter(|_| self.wants.forces);
        let tangent = tangent.map(|near| near.tangent(at.clone()));
        let forces = tangent.map_or_else(Vec::new, |tangent| self.forces(&tangent));
        let (mut moves, mut jacobian) = (false, None);
        let path = match &mut self.motion {
            Some(motion) => {
                motion.at(at);
                moves = motion.is_determined();
                if self.wants.jacobian && moves {
                    let inputs = self.of.inputs.iter().map(|input| input.coordinate);
                    let values = inputs.map(|coordinate| (coordinate, coordinate.of(at)));
                    let held = self.of.question.clone().at_values(values).held();
                    let mut held = Neighbourhood::holding(mechanism, &held);
                    jacobian = input_output(mechanism, motion, &mut held, at);
                }
                motion.rates(&self.rates);
                motion.accelerations(at, &self.rates, &self.changes);
                motion.path(at)
            }
            None => {
                self.at_rest = at.map(|x| Dual::constant(Dual::constant(x)));
                &self.at_rest
            }
        };
        self.kinematics.place(path, &mut self.placement);
        let found = Found {
            mechanism,
            path,
            moves,
            kinematics: &self.kinematics,
            placement: &self.placement,
            forces,
            transmission,
            jacobian,
            distances: self.distances.as_mut().map(|meter| meter.at(at)),
        };
        for (i, quantity) in self.of.quantities.iter().enumerate() {
            let value = quantity.expression.evaluate(&|of| found.value(of));
            let value = value
                .ok()
                .map(|value| match (turns(quantity), self.before[i]) {
                    // an angle is told without jumps
                    (true, Some(before)) if (value - before).abs() > PI => {
                        value - TAU * ((value - before) / TAU).round()
                    }
                    _ => value,
                });
            self.values[i] = value;
            self.before[i] = value.or(self.before[i]);
        }
        &self.values
    }

    /// Angles are told near to these values from here on.
    pub fn settle(&mut self, values: &[Option<f64>]) {
        self.before.copy_from_slice(values);
    }

    /// The forces that hold coordinates.
    fn forces(&self, tangent: &Tangent) -> Vec<(Coordinate, Option<f64>)> {
        let Some(near) = &self.near else {
            return Vec::new();
        };
        let mechanism = near.mechanism();
        let balance = Equilibrium::of(near, tangent, &self.coordinates, self.of.load);
        let rows = near.system().rows();
        let resisted = norm(&balance.left) <= 1e-9 * norm(&balance.generalised);
        let held = self.coordinates.iter().enumerate();
        held.map(|(i, coordinate)| {
            let force = balance.forces[rows + i] / coordinate.scale(mechanism);
            let known = resisted && balance.determines(rows + i);
            (*coordinate, known.then_some(force))
        })
        .collect()
    }
}

impl Found<'_> {
    /// The value of a name; not a number where it is not determined.
    fn value(&self, of: &Measured) -> f64 {
        self.known(of).unwrap_or(f64::NAN)
    }

    fn known(&self, of: &Measured) -> Option<f64> {
        match *of {
            Measured::Parameter(parameter) => Some(self.mechanism.parameters()[parameter].value),
            Measured::Joint(joint, order) => self.derivative(self.path.joints[joint], order),
            Measured::Place(point, coordinate, order) => {
                let mut pose = *self.kinematics.pose(point.frame, self.placement)?;
                pose.position = point.placed(&pose);
                self.derivative(coordinate.of(&pose), order)
            }
            Measured::Size(point, order) => {
                let pose = self.kinematics.pose(point.frame, self.placement)?;
                let [x, y, z] = point.placed(pose).0.map(|x| self.derivative(x, order));
                Some(norm(&[x?, y?, z?]))
            }
            Measured::Force(joint) => self.force(Coordinate::Joint(joint)),
            Measured::PlatformForce(platform, c) => self.force(Coordinate::Pose(platform, c)),
            Measured::Transmission(closure) => {
                let name = closure.map(|closure| &self.mechanism.closures()[closure].name);
                let angles = self.transmission.iter();
                let of_it = angles.filter(|angle| name.is_none_or(|name| *name == angle.closure));
                of_it.map(|angle| angle.transmission_angle).reduce(f64::min)
            }
            Measured::Figure(figure) => match figure {
                Figure::Condition => self.jacobian.as_ref()?.condition,
                Figure::Determinant => self.jacobian.as_ref()?.determinant,
                Figure::Manipulability => Some(self.jacobian.as_ref()?.manipulability),
                Figure::Direct => self.distances.as_ref()?.direct,
                Figure::Inverse => self.distances.as_ref()?.inverse,
                Figure::Constraint => self.distances.as_ref()?.constraint,
            },
        }
    }

    fn derivative(&self, x: Second, order: Order) -> Option<f64> {
        match order {
            Order::Value => Some(x.value.value),
            Order::Velocity => self.moves.then_some(x.slope.value),
            Order::Acceleration => self.moves.then_some(x.slope.slope),
        }
    }

    fn force(&self, of: Coordinate) -> Option<f64> {
        let known = self.forces.iter().find(|(coordinate, _)| *coordinate == of);
        known.and_then(|(_, force)| *force)
    }
}

/// Whether a quantity is an angle that is told modulo a turn.
fn turns(quantity: &Quantity) -> bool {
    fn has_atan2(expression: &Expression<Measured>) -> bool {
        matches!(expression.node, Node::Call(Function::Atan2, _))
            || expression.operands().any(has_atan2)
    }
    let angle = |of: &Measured| matches!(of, Measured::Place(_, c, Order::Value) if c.is_angle());
    quantity.unit == SiUnit::RADIAN
        && (quantity.measured().any(angle) || has_atan2(&quantity.expression))
}
