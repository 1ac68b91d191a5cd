//! A simulation from step to step.

mod across;
mod events;
mod friction;
mod linearise;
mod rows;

use super::{
    EnergyBalance, Happened, SimulationEnd, SimulationEvent, SimulationReport, SimulationSettings,
    Speed,
};
use across::{NEARLY_SINGULAR, across};
use events::EarliestEvent;

use crate::algebra::SiUnit;
use crate::linear::{Decomposition, add, dot, norm};
use crate::mechanism::{Configuration, Mechanism, Point, PoseCoordinate};
use crate::number::tolerance::SUMMED;
use crate::solve::{Flow, Integrator, Stage, Watch, edge};
use crate::system::{Accelerated, Coordinate, Dynamics, FrameTwists, GivenPose, NamedUnit};

/// A simulation under way: the state is the values of the coordinates that move, the rates of the independent ones and the
/// work supplied.
pub(super) struct Run<'a, 'd> {
    mechanism: &'a Mechanism,
    dynamics: &'d mut Dynamics<'a>,
    settings: &'d SimulationSettings,
    laws: Laws,
    /// Freedoms at the start.
    freedoms: usize,
    /// Joints that do not move now.
    stuck: Vec<Stuck>,
    /// For each friction the direction in which its joint slides, 0 where it does not.
    slides: Vec<f64>,
    /// Points and frames of platforms whose positions are given.
    points: Vec<Point>,
    state: Vec<f64>,
    energy: EnergyBalance,
    rows: Vec<Vec<f64>>,
    configurations: Vec<Configuration<f64>>,
    events: Vec<SimulationEvent>,
    residual: f64,
    steps: usize,
    /// The largest margin of the closure equations so far.
    widest: f64,
}

/// A joint that does not move although it could: friction holds it, or it rests on a limit.
#[derive(Clone, Copy, PartialEq)]
struct Stuck {
    joint: usize,
    /// The side of its limit, 1 of the upper one and −1 of the lower one.
    limit: Option<f64>,
}

/// The meaning of a state.
struct Laws {
    /// Sizes of the dimensionless units of the coordinates that move, in m and rad.
    units: Vec<f64>,
    /// Speeds of the last ones.
    speeds: Vec<Speed>,
}

impl Laws {
    /// The number of independent coordinates.
    fn free(&self) -> usize {
        self.units.len() - self.speeds.len()
    }

    /// Values of the coordinates of a state, in m and rad.
    fn values(&self, state: &[f64]) -> Vec<f64> {
        let both = state.iter().zip(&self.units);
        both.map(|(x, unit)| x * unit).collect()
    }

    /// Rates of the coordinates in a state, in m/s and rad/s, and accelerations of those that are driven.
    fn rates(&self, time: f64, state: &[f64]) -> [Vec<f64>; 2] {
        let rates = state[self.units.len()..].iter().zip(&self.units);
        let mut rates: Vec<f64> = rates.map(|(x, unit)| x * unit).collect();
        rates.truncate(self.free());
        let driven = self.speeds.iter().map(|of| of.at(time));
        let (speeds, changes): (Vec<f64>, Vec<f64>) = driven.map(|[v, a]| (v, a)).unzip();
        rates.extend(speeds);
        [rates, changes]
    }
}

/// The equations of motion over the state.
struct StateFlow<'r, 'a> {
    dynamics: &'r mut Dynamics<'a>,
    laws: &'r Laws,
    /// The margin below which they are taken from both sides.
    sick: f64,
}

impl Flow for StateFlow<'_, '_> {
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> bool {
        let laws = self.laws;
        let [moving, _] = laws.rates(time, state);
        let moved = moving.iter().zip(&laws.units).map(|(x, unit)| x / unit);
        rates
            .iter_mut()
            .zip(moved)
            .for_each(|(to, rate)| *to = rate);
        let found = across(
            self.dynamics,
            laws,
            (time, state),
            self.sick,
            |dynamics, state| {
                let (_, instant) = at(dynamics, laws, time, state)?;
                let mut changes = instant.accelerations;
                let units = changes.iter_mut().zip(&laws.units);
                units.for_each(|(a, unit)| *a /= unit);
                changes.push(instant.supplied);
                Some(changes)
            },
        );
        let Some(found) = found else {
            return false;
        };
        rates[laws.units.len()..].copy_from_slice(&found);
        true
    }
}

/// Closes the mechanism in a state and evaluates it there: rates of the coordinates that move, and the instant.
fn at(
    dynamics: &mut Dynamics,
    laws: &Laws,
    time: f64,
    state: &[f64],
) -> Option<(Vec<f64>, Accelerated)> {
    if !dynamics.close(&laws.values(state)[..laws.units.len()]) {
        return None;
    }
    let [rates, driven] = laws.rates(time, state);
    let instant = dynamics.evaluate(&rates, &driven, time)?;
    Some((rates, instant))
}

impl<'a, 'd> Run<'a, 'd> {
    /// Begins where the mechanism is closed, with rates of the independent coordinates.
    pub fn new(
        mechanism: &'a Mechanism,
        dynamics: &'d mut Dynamics<'a>,
        settings: &'d SimulationSettings,
        mut rates: Vec<f64>,
    ) -> Option<Self> {
        let at = dynamics.configuration().clone();
        let laws = Laws {
            units: dynamics.units(),
            speeds: settings.speeds.clone(),
        };
        let (speeds, driven): (Vec<f64>, Vec<f64>) =
            laws.speeds.iter().map(|of| of.at(0.0).into()).unzip();
        rates.extend(speeds);
        let instant = dynamics.evaluate(&rates, &driven, 0.0)?;
        let start = instant.kinetic + instant.potential;
        let mut run = Run {
            mechanism,
            settings,
            freedoms: laws.free(),
            laws,
            stuck: Vec::new(),
            slides: Vec::new(),
            points: settings.points.clone(),
            state: Vec::new(),
            energy: EnergyBalance {
                start,
                end: start,
                kinetic: instant.kinetic,
                ..EnergyBalance::default()
            },
            rows: Vec::new(),
            configurations: Vec::new(),
            events: Vec::new(),
            residual: 0.0,
            steps: 0,
            widest: 0.0,
            dynamics,
        };
        run.restate(&at, &rates);
        run.begin_friction(&rates);
        Some(run)
    }

    /// The state at a configuration, with the work supplied so far.
    fn restate(&mut self, at: &Configuration<f64>, rates: &[f64]) {
        self.laws.units = self.dynamics.units();
        let supplied = self.state.last().copied().unwrap_or(0.0);
        let values = self.dynamics.values(at);
        let units = &self.laws.units;
        let free = &rates[..self.laws.free()];
        let both = values.iter().zip(units).chain(free.iter().zip(units));
        self.state = both.map(|(x, unit)| x / unit).collect();
        self.state.push(supplied);
    }

    /// The number of independent coordinates.
    fn free(&self) -> usize {
        self.laws.free()
    }

    /// Integrates to the end.
    pub fn report(mut self, watch: &Watch, pose: GivenPose) -> SimulationReport {
        let duration = self.settings.duration;
        let mut integrator = Integrator::new(self.settings.tolerance, duration);
        let mut time = 0.0;
        let state = self.state.clone();
        self.row(time, &state);
        let linear = match self.settings.linearised {
            true => self.linear(),
            false => None,
        };
        let started = integrator.start(&mut self.equations(), time, &state);
        let mut margin = self.dynamics.margin();
        self.widest = margin;
        let end = loop {
            if started.is_err() {
                break SimulationEnd::Stuck;
            }
            if margin == 0.0 && !self.settings.through {
                break SimulationEnd::Singular;
            }
            if self.settings.linearised {
                break match linear {
                    Some(_) => SimulationEnd::Linearised,
                    None => SimulationEnd::Stuck,
                };
            }
            if time >= duration {
                break SimulationEnd::Over;
            }
            let done = self.rows.len() - 1;
            if watch.stops(Stage::Rows, done, Some(self.settings.rows)) {
                break SimulationEnd::Interrupted;
            }
            let before = (time, margin);
            let Ok(after) = integrator.step(&mut self.equations()) else {
                break SimulationEnd::Stuck;
            };
            self.steps += 1;
            let met = self.met(&mut integrator, before, after, &mut margin);
            let until = met.as_ref().map_or(after, |(time, _)| *time);
            if !self.rows_until(&mut integrator, until) {
                break SimulationEnd::Stuck;
            }
            time = until;
            self.state = match met {
                Some(_) => integrator.reached(&mut self.equations(), until),
                None => integrator.state().to_vec(),
            };
            self.widest = self.widest.max(margin);
            if met.is_none() && margin < self.sick() {
                continue;
            }
            let Some((rates, instant)) = at(self.dynamics, &self.laws, time, &self.state) else {
                break SimulationEnd::Stuck;
            };
            self.energy.kinetic = self.energy.kinetic.max(instant.kinetic);
            self.dynamics.stand();
            let ends = match met {
                None => None,
                Some((_, EarliestEvent::Singular)) => Some(Some(SimulationEnd::Singular)),
                Some((_, EarliestEvent::Friction { friction })) => {
                    Some(self.stick_or_slip(&mut integrator, time, friction, &rates))
                }
                Some((_, EarliestEvent::Limit(limit))) => {
                    Some(self.bounce(&mut integrator, time, limit, &rates, &instant))
                }
            };
            match ends {
                None => {}
                Some(None) => continue,
                Some(Some(end)) => {
                    let state = self.state.clone();
                    if self.rows.last().is_none_or(|row| row[0] < time) {
                        self.row(time, &state);
                    }
                    break end;
                }
            }
            let scale = match integrator.is_stiff() {
                true => None,
                false => self.projection(&instant),
            };
            let kept: Vec<f64> = rates
                .iter()
                .map(|rate| rate * scale.unwrap_or(1.0))
                .collect();
            let (at, others) = match self.dynamics.choose(&kept) {
                Ok(None) if scale.is_none() => continue,
                Ok(others) => (self.dynamics.configuration().clone(), others),
                Err(_) => break SimulationEnd::Singular,
            };
            self.restate(&at, &others.unwrap_or(kept));
            let state = self.state.clone();
            if (integrator.start(&mut self.equations(), time, &state)).is_err() {
                break SimulationEnd::Stuck;
            }
        };
        let end = match end {
            SimulationEnd::Stuck => self.stuck(&integrator),
            end => end,
        };
        SimulationReport {
            mechanism: self.mechanism.name().into(),
            freedoms: self.freedoms,
            columns: self.columns(),
            rows: self.rows,
            configurations: self.configurations,
            reached: time,
            end,
            events: self.events,
            linear,
            energy: self.energy,
            residual: self.residual,
            steps: self.steps,
            stiff: integrator.is_stiff(),
            pose,
        }
    }

    fn equations(&mut self) -> StateFlow<'_, 'a> {
        StateFlow {
            sick: self.sick(),
            dynamics: self.dynamics,
            laws: &self.laws,
        }
    }

    /// The factor of the rates that brings kinetic and potential energy into balance with the work, where the kinetic energy
    /// is not small and steps have changed the balance by more than rounding.
    fn projection(&mut self, instant: &Accelerated) -> Option<f64> {
        let energy = &mut self.energy;
        let supplied = self.state.last().copied().unwrap_or(0.0);
        let sum = instant.kinetic + instant.potential;
        let missing = energy.start + supplied - energy.lost - sum;
        let rounding = SUMMED * (instant.potential.abs() + energy.kinetic);
        // beside the largest kinetic energy
        let wanted = missing.abs() > (1e-11 * energy.kinetic).max(rounding)
            && instant.kinetic > 0.1 * energy.kinetic
            && self.settings.speeds.is_empty();
        wanted.then(|| {
            energy.corrected += missing.abs();
            (1.0 + missing / instant.kinetic).max(0.0).sqrt()
        })
    }

    /// The reason for which no further step is possible.
    fn stuck(&mut self, integrator: &Integrator) -> SimulationEnd {
        self.dynamics.close(&self.laws.values(integrator.state()));
        match self.dynamics.margin() < NEARLY_SINGULAR * self.widest {
            true => SimulationEnd::Singular,
            false => SimulationEnd::Stuck,
        }
    }
}
