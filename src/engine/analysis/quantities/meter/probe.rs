//! Ingredients of quantities, at a configuration or over recorded numbers: rates, forces, Jacobian.

use super::Metered;
use crate::analysis::velocity::{Normalised, Outputs, Spins, TransmissionAngles};
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Frame, Kinematics, Order, Placement, Point, PoseCoordinate};
use crate::number::{Dual, Number};
use crate::system::{Balance, FrameTwists, Instant, Lock, Motion, Unknown};

/// Ingredients that some quantity needs, and no others.
pub(super) struct Plan {
    pub order: Order,
    pub points: Vec<Point>,
    /// Angles of frames with the numbers of their points, and the order in which they are wanted.
    pub angles: Vec<(usize, PoseCoordinate, Order)>,
    /// For each held coordinate, true if the motion for a unit rate of it is wanted.
    pub responses: Vec<bool>,
    pub forces: bool,
    pub reactions: bool,
    /// The outputs of the Jacobian, if it is wanted.
    pub outputs: Option<Vec<Lock>>,
    pub transmission: Option<TransmissionAngles>,
    /// All frames that these need besides those of the closures.
    pub frames: Vec<Frame>,
}

/// Computes the planned ingredients, with one factorisation of the closures.
pub(super) struct Probe<'q, T: Factorable> {
    motion: Option<Motion<T>>,
    /// Its frames, if no rates are wanted.
    kinematics: Kinematics<T>,
    placement: Placement<T>,
    twists: FrameTwists<T>,
    /// Motion of the points to second order, if that is wanted.
    changing: Option<FrameTwists<Dual<T>>>,
    pub balance: Option<Balance<T>>,
    outputs: Option<Outputs<'q, T>>,
    responses: Vec<Vec<T>>,
    centre: [f64; 3],
    pub found: FoundHere<T>,
}

/// Ingredients at one configuration.
pub(super) struct FoundHere<T> {
    /// True if rates are determined.
    pub moves: bool,
    /// Rates and accelerations of all unknowns.
    pub rates: [Vec<T>; 2],
    /// Places, velocities and accelerations of the points.
    pub points: [Vec<Vector3<T>>; 3],
    pub angles: Vec<T>,
    pub jacobian: Normalised<T>,
    pub transmission: Vec<T>,
}

impl Plan {
    /// True if rates are wanted.
    pub fn moves(&self) -> bool {
        self.order > Order::Value || self.forces || self.outputs.is_some()
    }
}

impl<'q, T: Factorable> Probe<'q, T> {
    pub fn new(of: &Metered<'q>, plan: &Plan) -> Self {
        let mechanism = of.question.mechanism();
        let coordinates = of.question.driven_coordinates();
        let still = of.question.clone().with_spins_still();
        let motion = plan.moves().then(|| {
            let hold = |held| still.with_still(held);
            Motion::placing(mechanism, &coordinates, &plan.frames, hold)
        });
        let dimensions = mechanism.dimensions().map(T::from_f64);
        let kinematics = match &motion {
            Some(motion) => motion.kinematics().clone(),
            None => Kinematics::new(&dimensions, plan.frames.iter().copied()),
        };
        let unknowns: &[Unknown] = motion.as_ref().map_or(&[], Motion::unknowns);
        let outputs = motion.as_ref().zip(plan.outputs.as_ref());
        Probe {
            twists: FrameTwists::sharing(&kinematics, &dimensions, unknowns, &plan.points),
            changing: (motion
                .as_ref()
                .filter(|_| plan.order == Order::Acceleration))
            .map(|motion| FrameTwists::moving(mechanism, motion, &plan.points)),
            balance: motion.as_ref().filter(|_| plan.forces).map(|motion| {
                Balance::new(mechanism, &of.load, motion, &kinematics, plan.reactions)
            }),
            outputs: outputs.map(|(motion, of)| Outputs::new(mechanism, motion, of.clone())),
            responses: vec![Vec::new(); coordinates.len()],
            centre: mechanism.dimensions().centre,
            found: FoundHere::default(),
            placement: kinematics.placement(),
            kinematics,
            motion,
        }
    }

    /// The force of the moving bodies on ground and its moment about the origin.
    pub fn shaking(&self) -> [Vector3<T>; 2] {
        let both = self.balance.as_ref().zip(self.motion.as_ref());
        both.map_or([Vector3::zero(); 2], |(balance, motion)| {
            balance.shaking(motion, self.centre)
        })
    }

    /// The order in which frames are placed.
    pub fn kinematics(&self) -> &Kinematics<T> {
        &self.kinematics
    }

    /// Number of unknowns of the closures with nothing held, if rates are wanted.
    pub fn unknowns(&self) -> usize {
        self.motion.as_ref().map_or(0, |of| of.unknowns().len())
    }

    /// Computes the ingredients at a configuration for rates and accelerations of the held coordinates, with the pace of
    /// the motion against these and the time in s.
    pub fn at(
        &mut self,
        plan: &Plan,
        at: &Configuration<T>,
        [rates, changes]: &[Vec<T>; 2],
        (pace, time): ([T; 2], T),
        spins: &Spins,
    ) {
        let found = &mut self.found;
        match &mut self.motion {
            None => self.kinematics.place(at, &mut self.placement),
            Some(motion) => {
                motion.at(at);
                found.moves = motion.is_determined();
                let wanted = self.responses.iter_mut().zip(&plan.responses);
                for (i, (response, _)) in wanted.enumerate().filter(|(_, (_, wanted))| **wanted) {
                    response.clear();
                    response.extend_from_slice(motion.response(i));
                }
                let mut known = plan.responses.iter().zip(rates);
                match known.all(|(known, rate)| *known || *rate == T::zero()) {
                    true => motion.set_rates(&self.responses, rates),
                    false => _ = motion.rates(rates),
                }
                if plan.order == Order::Acceleration {
                    motion.accelerations(changes);
                }
                if let Some(balance) = &mut self.balance {
                    let responses = self.responses.iter().zip(&plan.responses);
                    let responses = responses.map(|(rates, wanted)| (&rates[..], *wanted));
                    let instant = Instant {
                        pace,
                        time,
                        impending: None,
                    };
                    let responses: Vec<_> = responses.collect();
                    balance.at(motion, at, &responses, instant);
                    balance.feel(motion, &responses);
                }
                for (to, from) in found.rates.iter_mut().zip(motion.known()) {
                    to.clear();
                    to.extend_from_slice(from);
                }
            }
        }
        let motion = self.motion.as_ref();
        let placement = motion.map_or(&self.placement, Motion::placement);
        let [places, velocities, accelerations] = &mut found.points;
        let numbers = 0..plan.points.len();
        places.clear();
        places.extend(numbers.clone().map(|i| self.twists.origin(i, placement)));
        let turning = |i: usize| self.twists.twist(i, placement, &found.rates[0]);
        if plan.order > Order::Value {
            velocities.clear();
            velocities.extend(numbers.clone().map(|i| turning(i).velocity));
        }
        let changes = motion.map(Motion::changes);
        let changing = |i: usize| {
            let (changing, (rates, placement)) = self.changing.as_ref().zip(changes)?;
            Some((
                changing.frame(i, placement),
                changing.twist(i, placement, rates),
            ))
        };
        accelerations.clear();
        accelerations.extend(numbers.filter_map(|i| {
            let (_, twist) = changing(i)?;
            Some(twist.velocity.map(|part| part.slope))
        }));
        let angles = plan.angles.iter().map(|&(i, c, order)| {
            let frame = self.twists.frame(i, placement);
            match order {
                Order::Value => c.of(frame),
                Order::Velocity => c.turned(frame, &turning(i).omega),
                Order::Acceleration => changing(i).map_or(T::zero(), |(frame, twist)| {
                    c.turned(frame, &twist.omega).slope
                }),
            }
        });
        found.angles.clear();
        found.angles.extend(angles);
        if let Some(outputs) = &self.outputs {
            let jacobian = &mut found.jacobian;
            outputs.normalised_into(jacobian, at, placement, &self.responses, spins);
        }
        found.transmission.clear();
        if let Some(angles) = &plan.transmission {
            found.transmission.extend(angles.angles(placement));
        }
    }
}

impl<T: Number> Default for FoundHere<T> {
    fn default() -> Self {
        FoundHere {
            moves: false,
            rates: Default::default(),
            points: Default::default(),
            angles: Vec::new(),
            jacobian: Normalised::default(),
            transmission: Vec::new(),
        }
    }
}
