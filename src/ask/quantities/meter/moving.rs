//! Rates where a mechanism is, or at several configurations side by side.

use super::Metered;
use crate::geometry::Vector3;
use crate::linear::Factorable;
use crate::mechanism::{Configuration, Frame, Measured, Order, Placement, Point, PoseCoordinate};
use crate::number::{Dual, Packed};
use crate::system::{FrameTwists, Motion};

/// Which rates are wanted.
pub(super) struct Plan {
    pub points: Vec<Point>,
    /// Frames that are placed beside those of the closures.
    pub frames: Vec<Frame>,
    /// For each held coordinate whether what everything does for a unit rate of it is wanted.
    pub wanted: Vec<bool>,
    /// Angles whose accelerations are wanted, with the numbers of their points.
    pub angles: Vec<(usize, PoseCoordinate)>,
    pub accelerations: bool,
}

/// Rates of all unknowns with one factorisation of the closures.
pub(super) struct Moving<T: Factorable> {
    pub motion: Motion<T>,
    /// How the points move to second order, if that is wanted.
    changing: Option<FrameTwists<Dual<T>>>,
    responses: Vec<Vec<T>>,
    shifts: Vec<Vector3<T>>,
    turns: Vec<T>,
}

/// The motion at one configuration.
#[derive(Default)]
pub(super) struct Moved {
    /// Whether rates are determined.
    pub moves: bool,
    /// Rates and accelerations of all unknowns.
    pub orders: [Vec<f64>; 2],
    /// What everything does for a unit rate of each held coordinate for which that is wanted.
    pub responses: Vec<Vec<f64>>,
    /// Accelerations of the points, and of the angles of the plan.
    pub shifts: Vec<Vector3<f64>>,
    pub turns: Vec<f64>,
}

impl Plan {
    /// The number of an angle among those whose accelerations are wanted.
    pub fn angle(&self, point: usize, c: PoseCoordinate) -> Option<usize> {
        self.angles.iter().position(|of| *of == (point, c))
    }

    /// The angles of these names whose accelerations are wanted.
    pub fn angles_of(names: &[(Measured, usize)]) -> Vec<(usize, PoseCoordinate)> {
        let angles = names.iter().filter_map(|(name, point)| match name {
            Measured::Place(_, c, Order::Acceleration) if c.is_angle() => Some((*point, *c)),
            _ => None,
        });
        angles.collect()
    }
}

impl<T: Factorable + Packed> Moving<T> {
    pub fn new(of: &Metered, plan: &Plan) -> Self {
        let mechanism = of.question.mechanism();
        let coordinates = of.question.driven_coordinates();
        let still = of.question.clone().with_spins_still();
        let motion = Motion::placing(mechanism, &coordinates, &plan.frames, |held| {
            still.with_still(held)
        });
        let changing =
            (plan.accelerations).then(|| FrameTwists::moving(mechanism, &motion, &plan.points));
        Moving {
            changing,
            responses: vec![Vec::new(); coordinates.len()],
            shifts: vec![Vector3::zero(); plan.points.len()],
            turns: vec![T::zero(); plan.angles.len()],
            motion,
        }
    }

    /// Works out what is wanted at a configuration for rates and accelerations of the held coordinates.
    pub fn at(
        &mut self,
        plan: &Plan,
        at: &Configuration<T>,
        placement: Option<&Placement<T>>,
        [rates, changes]: &[Vec<T>; 2],
    ) {
        let motion = &mut self.motion;
        motion.placed_at(at, placement);
        let wanted = self.responses.iter_mut().zip(&plan.wanted).enumerate();
        for (i, (response, _)) in wanted.filter(|(_, (_, wanted))| **wanted) {
            response.clear();
            response.extend_from_slice(motion.response(i));
        }
        let mut known = plan.wanted.iter().zip(rates);
        match known.all(|(known, rate)| *known || *rate == T::zero()) {
            true => motion.set_rates(&self.responses, rates),
            false => _ = motion.rates(rates),
        }
        let Some(changing) = &self.changing else {
            return;
        };
        motion.accelerations(changes);
        let (rates, placement) = motion.changes();
        for (i, shift) in self.shifts.iter_mut().enumerate() {
            *shift = (changing.twist(i, placement, rates).velocity).map(|part| part.slope);
        }
        for (turn, &(i, c)) in self.turns.iter_mut().zip(&plan.angles) {
            let omega = changing.twist(i, placement, rates).omega;
            *turn = c.turned(changing.frame(i, placement), &omega).slope;
        }
    }

    /// Whether rates are determined and finite in every place.
    pub fn is_sure(&self) -> bool {
        let known = self.motion.known().into_iter().flatten();
        let mut all = known.chain(self.responses.iter().flatten());
        self.motion.is_determined() && all.all(|x| x.is_finite())
    }

    /// What was worked out in one place.
    pub fn take(&self, place: usize, to: &mut Moved) {
        let part = |from: &[T], to: &mut Vec<f64>| {
            to.clear();
            to.extend(from.iter().map(|x| x.part(place)));
        };
        to.moves = self.motion.is_determined();
        for (from, to) in self.motion.known().into_iter().zip(&mut to.orders) {
            part(from, to);
        }
        to.responses.resize_with(self.responses.len(), Vec::new);
        for (from, to) in self.responses.iter().zip(&mut to.responses) {
            part(from, to);
        }
        if self.changing.is_some() {
            to.shifts.clear();
            (to.shifts).extend(self.shifts.iter().map(|shift| shift.map(|x| x.part(place))));
            part(&self.turns, &mut to.turns);
        }
    }
}
