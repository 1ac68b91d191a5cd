//! Motion of a mechanism under its loads, in independent coordinates.

mod accelerated;
mod chart;
mod closing;

pub use accelerated::{Accelerated, NoDynamics};

use super::{Coordinate, Freedoms, Instant, Load, Motion, Still, System};
use crate::linear::{add, dot, norm};
use crate::mechanism::{Configuration, Friction, Mechanism, turn_near};
use crate::number::tolerance::SUMMED;
use chart::{Base, Chart, accelerations};

/// The equations of motion of an assembled mechanism, M(q)·q̈ = Q(q, q̇, t), in independent coordinates q: joints and
/// platform coordinates that determine all others near a configuration.
///
/// M and Q are the inertia and the power of what acts for unit rates of q, with everything else moved along by the
/// closures (Kane and Levinson 1985; coordinate partitioning: Wehage and Haug 1982). Other coordinates are
/// [chosen](Dynamics::choose) where these no longer lead well.
pub struct Dynamics<'a> {
    mechanism: &'a Mechanism,
    load: &'a Load,
    /// Coordinates that move as they are told, then those that keep their values.
    locked: Vec<Coordinate>,
    /// The number of the former.
    driven: usize,
    /// For each friction the direction in which its joint slides; empty if rates tell.
    slides: Vec<f64>,
    still: Vec<Still>,
    chart: Chart,
    /// Rates of all unknowns for unit rates of each coordinate that [moves](Dynamics::moved).
    responses: Vec<Vec<f64>>,
    residual: f64,
    /// An assembled configuration with the values and responses there: closing begins from it along its path, so that
    /// no branch is changed where branches come near.
    base: Base,
    /// Rates of the independent coordinates as last evaluated, and the accelerations of all unknowns while these stay.
    latest: (Vec<f64>, Vec<f64>),
}

/// Corrections of accelerations for friction.
const SETTLING: usize = 30;

impl<'a> Dynamics<'a> {
    /// The equations near an assembled configuration with so many freedoms left by what is locked, of which the first ones
    /// move as they are told.
    ///
    /// # Errors
    /// If it is singular.
    pub fn new(
        mechanism: &'a Mechanism,
        load: &'a Load,
        (driven, locked, still): (usize, Vec<Coordinate>, Vec<Still>),
        freedoms: usize,
        at: &Configuration<f64>,
    ) -> Result<Self, NoDynamics> {
        let mut dynamics = Dynamics {
            chart: Chart::at(mechanism, load, (&locked, &still), freedoms, at)?,
            responses: Vec::new(),
            residual: 0.0,
            base: Base {
                at: at.clone(),
                values: Vec::new(),
                responses: Vec::new(),
                rates: Vec::new(),
                curvature: Vec::new(),
            },
            latest: (Vec::new(), Vec::new()),
            mechanism,
            load,
            driven,
            slides: Vec::new(),
            locked,
            still,
        };
        dynamics.mass().ok_or(NoDynamics::Singular)?;
        dynamics.stand();
        Ok(dynamics)
    }

    /// The independent coordinates.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.chart.coordinates[..self.chart.free]
    }

    /// The independent coordinates, then those that are driven.
    pub fn moved(&self) -> &[Coordinate] {
        &self.chart.coordinates[..self.chart.free + self.driven]
    }

    /// The equations at the configuration last closed, with other coordinates beside the first driven ones that are driven.
    ///
    /// # Errors
    /// If it is singular.
    pub fn driving(&self, first: usize, others: &[Coordinate]) -> Result<Self, NoDynamics> {
        let (before, kept) = self.locked.split_at(self.driven);
        let locked = [&before[..first], others, kept].concat();
        let freedoms = (self.chart.free + self.driven).checked_sub(first + others.len());
        let held = (first + others.len(), locked, self.still.clone());
        let freedoms = freedoms.ok_or(NoDynamics::NoCoordinates)?;
        Dynamics::new(
            self.mechanism,
            self.load,
            held,
            freedoms,
            self.configuration(),
        )
    }

    /// Friction in joints.
    pub fn frictions(&self) -> &'a [Friction] {
        &self.load.own.frictions
    }

    /// Tells for each friction the direction in which its joint slides, 0 where it does not.
    pub fn slide(&mut self, slides: &[f64]) {
        self.slides = slides.to_vec();
    }

    /// Accelerations of all unknowns, dimensionless, where it was last evaluated, for those of the independent coordinates
    /// and of the driven ones.
    pub fn accelerations(&mut self, found: &[f64], driven: &[f64]) -> &[f64] {
        let mut given = vec![0.0; self.chart.coordinates.len()];
        let both = found.iter().chain(driven);
        given.iter_mut().zip(both).for_each(|(to, x)| *to = *x);
        self.chart.motion.accelerations(&given)
    }

    /// The configuration last closed.
    pub fn configuration(&self) -> &Configuration<f64> {
        self.chart.tracker.configuration()
    }

    /// Rates of all unknowns ([`Motion::unknowns`]), dimensionless, as last evaluated.
    pub fn rates(&self) -> &[f64] {
        self.chart.motion.known()[0]
    }

    /// Rates of all unknowns for unit rates of each coordinate that moves, as last evaluated.
    pub fn responses(&self) -> &[Vec<f64>] {
        &self.responses
    }

    /// The motion in which rates are.
    pub fn motion(&self) -> &Motion {
        &self.chart.motion
    }

    /// Values of the coordinates that move at a configuration, in m and rad; angles of platforms beside those at the base.
    pub fn values(&self, at: &Configuration<f64>) -> Vec<f64> {
        let at = self.chart.measured(at);
        let value = |(i, of): (usize, &Coordinate)| {
            let value = of.of(self.mechanism, &at);
            match (of, self.base.values.get(i)) {
                (Coordinate::Pose(_, c), Some(base)) if c.is_angle() => turn_near(value, *base),
                _ => value,
            }
        };
        self.moved().iter().enumerate().map(value).collect()
    }

    /// The name of one of its coordinates.
    pub fn name(&self, of: Coordinate) -> String {
        self.chart.name(of, self.mechanism)
    }

    /// The sizes of the dimensionless units of the coordinates that move, in m and rad.
    pub fn units(&self) -> Vec<f64> {
        let coordinates = self.moved().iter();
        coordinates.map(|of| of.scale(self.mechanism)).collect()
    }

    /// Chooses other independent coordinates if something moves much faster than these, and returns the rates of the new
    /// ones for those of the old, driven ones last.
    ///
    /// # Errors
    /// If the configuration is singular.
    pub fn choose(&mut self, rates: &[f64]) -> Result<Option<Vec<f64>>, NoDynamics> {
        let largest = |of: &Vec<f64>| of.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let units = self.coordinates().iter();
        let mut units = units
            .map(|of| of.scale(self.mechanism))
            .zip(&self.responses);
        // nothing may move by more than 4 rad or characteristic lengths for a unit rate of an independent coordinate
        let slow = units.all(|(unit, of)| largest(of) * unit <= 4.0);
        if slow && self.chart.leads(self.configuration()) {
            return Ok(None);
        }
        let (at, free) = (self.configuration().clone(), self.chart.free);
        let fixed = (&self.locked[..], &self.still[..]);
        let others = Chart::choice(self.mechanism, fixed, free, &at)?;
        if self.chart.is(&others) {
            return Ok(None);
        }
        let others = Chart::of(self.mechanism, self.load, &self.still, others, free, &at);
        let rates = self.rates_in(&others, rates);
        self.chart = others;
        self.base.values.clear();
        self.mass().ok_or(NoDynamics::Singular)?;
        self.stand();
        Ok(Some(rates))
    }

    /// Rates of the coordinates of other equations at this configuration, driven ones last, for those of these.
    pub fn rates_for(&self, others: &Dynamics, rates: &[f64]) -> Vec<f64> {
        let mut found = self.rates_in(&others.chart, rates);
        let driven = &others.moved()[others.chart.free..];
        found.extend(driven.iter().map(|of| dot(&self.rates_of(*of), rates)));
        found
    }

    /// Rates of the independent coordinates of another choice.
    fn rates_in(&self, others: &Chart, rates: &[f64]) -> Vec<f64> {
        let at = others.measured(self.configuration());
        let all = others.coordinates[..others.free].iter();
        all.map(|of| dot(&self.rates_at(*of, &at), rates)).collect()
    }

    /// The rate of a coordinate for unit rates of each that moves where these were last evaluated.
    pub fn rates_of(&self, of: Coordinate) -> Vec<f64> {
        self.rates_at(of, self.configuration())
    }

    fn rates_at(&self, of: Coordinate, at: &Configuration<f64>) -> Vec<f64> {
        let joints = self.mechanism.joints().len();
        let scale = of.scale(self.mechanism);
        let slope: Vec<(usize, f64)> = match of {
            Coordinate::Joint(joint) => vec![(joint, 1.0)],
            Coordinate::Pose(platform, _) | Coordinate::Turn(platform, _) => {
                let pose = at.platforms[platform].pose();
                let slope = of.slope(&pose, self.mechanism.characteristic_length());
                (joints + 6 * platform..).zip(slope).collect()
            }
        };
        let rate = |response: &Vec<f64>| {
            let parts = slope.iter().map(|&(place, slope)| slope * response[place]);
            scale * parts.sum::<f64>()
        };
        self.responses.iter().map(rate).collect()
    }

    /// The smallest singular value of the closure equations over the largest: 0 where branches of motion meet or a locked
    /// angle of a platform has no value, 1 without equations.
    pub fn margin(&self) -> f64 {
        if self.chart.is_gimbal_locked(self.configuration()) {
            return 0.0;
        }
        let fixed = (&self.locked[..], &self.still[..]);
        let at = self.configuration();
        let held = Chart::held(self.mechanism, fixed, at);
        let system = System::new(self.mechanism.dimensions(), &held);
        let found = Freedoms::of(&system, at, &mut system.work());
        match found.motions.len() > self.chart.free {
            true => 0.0,
            false => 1.0 / found.condition_of_determined(),
        }
    }

    /// The mass matrix at the configuration last closed, row by row; `None` if the coordinates do not determine the
    /// motion.
    pub fn mass(&mut self) -> Option<Vec<f64>> {
        let Chart {
            free,
            motion,
            tracker,
            balance,
            ..
        } = &mut self.chart;
        motion.at(tracker.configuration());
        if !motion.is_determined() {
            return None;
        }
        let free = *free;
        self.responses.resize(free + self.driven, Vec::new());
        for (i, response) in self.responses.iter_mut().enumerate() {
            response.clear();
            response.extend_from_slice(motion.response(i));
        }
        Some(balance.inertias(motion, &self.responses[..free]))
    }

    /// The power of what acts at rest for unit rates of the independent coordinates, in N and N·m, and the potential
    /// energy, in J.
    ///
    /// # Errors
    /// Where coordinates do not determine the motion, or a force has no value.
    pub fn at_rest(&mut self) -> Result<(Vec<f64>, f64), NoDynamics> {
        self.mass().ok_or(NoDynamics::Singular)?;
        let forces = self.powers(0.0, Some(0.0));
        let potential = self.chart.balance.acting.potential;
        let known = forces.iter().chain([&potential]).all(|x| x.is_finite());
        known
            .then_some((forces, potential))
            .ok_or(NoDynamics::NoForce)
    }

    /// The size of all forces that act as last evaluated, times the characteristic length, and moments, in N·m.
    pub fn size(&self) -> f64 {
        let length = self.mechanism.characteristic_length();
        let acting = &self.chart.balance.acting;
        let wrenches = acting.wrenches.iter();
        let wrenches = wrenches.map(|[force, moment]| force.norm() * length + moment.norm());
        let scales = &self.mechanism.dimensions().joint_scales;
        let efforts = acting.efforts.iter().zip(scales);
        wrenches
            .chain(efforts.map(|(x, scale)| x.abs() * scale))
            .sum()
    }

    /// The power of all that acts for unit rates of the independent coordinates.
    fn powers(&mut self, time: f64, impending: Option<f64>) -> Vec<f64> {
        let Chart {
            motion,
            tracker,
            balance,
            ..
        } = &mut self.chart;
        balance.slides.clone_from(&self.slides);
        let responses = self.responses.iter().map(|of| (&of[..], true));
        let instant = Instant {
            pace: [1.0, 0.0],
            time,
            impending,
        };
        balance.at(
            motion,
            tracker.configuration(),
            &responses.collect::<Vec<_>>(),
            instant,
        );
        balance.forces.iter().map(|held| -held).collect()
    }

    /// Evaluates the equations of motion at the configuration last closed, for rates of the independent coordinates, then of
    /// those that are driven, in m/s and rad/s, and accelerations of the latter. `None` if they do not determine the motion,
    /// or a force has no value.
    pub fn evaluate(&mut self, rates: &[f64], driven: &[f64], time: f64) -> Option<Accelerated> {
        let mass = self.mass()?;
        let free = self.chart.free;
        let motion = &mut self.chart.motion;
        let mut given = vec![0.0; self.chart.coordinates.len()];
        given[..rates.len()].copy_from_slice(rates);
        motion.set_rates(&self.responses, &given);
        given.fill(0.0);
        given[free..free + driven.len()].copy_from_slice(driven);
        motion.accelerations(&given);
        self.latest = (rates.to_vec(), motion.known()[1].to_vec());
        let mut forces = self.powers(time, None);
        let mut drives = forces.split_off(free);
        let mut found = accelerations(&mass, &forces);
        // friction depends on reactions, and these on accelerations: what is left unbalanced corrects them
        let corrections = match (self.load.has_friction(), driven) {
            (true, _) => SETTLING,
            (false, []) => 0,
            _ => 1,
        };
        for _ in 0..corrections {
            given[..free].copy_from_slice(&found);
            self.chart.motion.accelerations(&given);
            let mut left = self.powers(time, None);
            drives = left.split_off(free);
            let correction = accelerations(&mass, &left);
            let (size, change) = (norm(&found), norm(&correction));
            add(&mut found, 1.0, &correction);
            if change <= SUMMED * size || change == 0.0 {
                break;
            }
        }
        drives.iter_mut().for_each(|drive| *drive = -*drive);
        let acting = &self.chart.balance.acting;
        let now = Accelerated {
            accelerations: found,
            kinetic: acting.kinetic,
            potential: acting.potential,
            supplied: acting.supplied + dot(&drives, &rates[free..]),
            drives,
            forces,
            mass,
        };
        let numbers = now.accelerations.iter().chain(&now.forces);
        let others = now.drives.iter().chain([&now.potential]);
        let known = numbers.chain(others).all(|x| x.is_finite());
        known.then_some(now)
    }
}
