//! A simulation from step to step.

mod across;
mod events;
mod rows;

use super::{
    EnergyBalance, Happened, SimulationColumn, SimulationEnd, SimulationEvent, SimulationReport,
    SimulationSettings,
};
use across::across;
use events::Met;

use crate::algebra::SiUnit;
use crate::linear::{Decomposition, add, dot, norm};
use crate::mechanism::{Configuration, Mechanism, Point, PoseCoordinate};
use crate::solve::{Flow, Integrator, Stage, Watch, edge};
use crate::system::{Accelerated, Coordinate, Dynamics, FrameTwists, GivenPose};

/// A simulation under way: the state is the values of the independent coordinates, their rates and the work supplied.
pub(super) struct Run<'a, 'd> {
    mechanism: &'a Mechanism,
    dynamics: &'d mut Dynamics<'a>,
    settings: &'d SimulationSettings,
    /// Sizes of the coordinates' dimensionless units, in m and rad.
    units: Vec<f64>,
    /// Points and frames of platforms whose positions are given.
    points: Vec<Point>,
    state: Vec<f64>,
    energy: EnergyBalance,
    rows: Vec<Vec<f64>>,
    events: Vec<SimulationEvent>,
    residual: f64,
    steps: usize,
    /// The largest margin of the closure equations so far.
    widest: f64,
}

/// The equations of motion over the state.
struct Equations<'d, 'a> {
    dynamics: &'d mut Dynamics<'a>,
    units: &'d [f64],
    /// The margin below which they are taken from both sides.
    sick: f64,
}

impl Flow for Equations<'_, '_> {
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> bool {
        let (units, free) = (self.units, self.units.len());
        let found = across(self.dynamics, units, state, self.sick, |dynamics, state| {
            let (_, instant) = at(dynamics, units, time, state)?;
            let mut changes = instant.accelerations;
            changes
                .iter_mut()
                .zip(units)
                .for_each(|(a, unit)| *a /= unit);
            changes.push(instant.supplied);
            Some(changes)
        });
        let Some(found) = found else {
            return false;
        };
        rates[..free].copy_from_slice(&state[free..2 * free]);
        rates[free..].copy_from_slice(&found);
        true
    }
}

/// Closes the mechanism in a state and evaluates it there: rates of the independent coordinates, and the instant.
fn at(
    dynamics: &mut Dynamics,
    units: &[f64],
    time: f64,
    state: &[f64],
) -> Option<(Vec<f64>, Accelerated)> {
    let free = units.len();
    let part = |from: usize| {
        let numbers = state[from..from + free].iter().zip(units);
        numbers.map(|(x, unit)| x * unit).collect::<Vec<f64>>()
    };
    if !dynamics.close(&part(0)) {
        return None;
    }
    let rates = part(free);
    let instant = dynamics.evaluate(&rates, time)?;
    Some((rates, instant))
}

impl<'a, 'd> Run<'a, 'd> {
    /// Begins where the mechanism is closed, with rates of the independent coordinates.
    pub fn new(
        mechanism: &'a Mechanism,
        dynamics: &'d mut Dynamics<'a>,
        settings: &'d SimulationSettings,
        rates: Vec<f64>,
    ) -> Option<Self> {
        let at = dynamics.configuration().clone();
        let instant = dynamics.evaluate(&rates, 0.0)?;
        let start = instant.kinetic + instant.potential;
        let mut run = Run {
            mechanism,
            settings,
            units: Vec::new(),
            points: settings.points.clone(),
            state: Vec::new(),
            energy: EnergyBalance {
                start,
                end: start,
                kinetic: instant.kinetic,
                ..EnergyBalance::default()
            },
            rows: Vec::new(),
            events: Vec::new(),
            residual: 0.0,
            steps: 0,
            widest: 0.0,
            dynamics,
        };
        run.restate(&at, &rates);
        Some(run)
    }

    /// The state at a configuration, with the work supplied so far.
    fn restate(&mut self, at: &Configuration<f64>, rates: &[f64]) {
        self.units = self.dynamics.units();
        let supplied = self.state.last().copied().unwrap_or(0.0);
        let values = self.dynamics.values(at);
        let both = values
            .iter()
            .zip(&self.units)
            .chain(rates.iter().zip(&self.units));
        self.state = both.map(|(x, unit)| x / unit).collect();
        self.state.push(supplied);
    }

    /// Integrates to the end.
    pub fn report(mut self, watch: &Watch, pose: GivenPose) -> SimulationReport {
        let duration = self.settings.duration;
        let mut integrator = Integrator::new(self.settings.tolerance, duration);
        let mut time = 0.0;
        let state = self.state.clone();
        self.row(time, &state);
        let started = integrator.start(&mut self.equations(), time, &state);
        let mut margin = self.dynamics.margin();
        self.widest = margin;
        let end = loop {
            if started.is_err() {
                break SimulationEnd::Stuck;
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
                break self.stuck(&integrator);
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
            let Some((rates, instant)) = at(self.dynamics, &self.units, time, &self.state) else {
                break SimulationEnd::Stuck;
            };
            self.energy.kinetic = self.energy.kinetic.max(instant.kinetic);
            self.dynamics.stand();
            let ends = match met {
                None => None,
                Some((_, Met::Singular)) => Some(SimulationEnd::Singular),
                Some((_, Met::Limit { joint, limit })) => {
                    self.bounce(&mut integrator, time, (joint, limit), &rates, &instant)
                }
            };
            if let Some(end) = ends {
                let state = self.state.clone();
                if self.rows.last().is_none_or(|row| row[0] < time) {
                    self.row(time, &state);
                }
                break end;
            }
            match self.dynamics.choose(&rates) {
                Ok(None) => {}
                Ok(Some(rates)) => {
                    let at = self.dynamics.configuration().clone();
                    self.restate(&at, &rates);
                    let state = self.state.clone();
                    if integrator
                        .start(&mut self.equations(), time, &state)
                        .is_err()
                    {
                        break SimulationEnd::Stuck;
                    }
                }
                Err(_) => break SimulationEnd::Singular,
            }
        };
        SimulationReport {
            mechanism: self.mechanism.name().into(),
            freedoms: self.units.len(),
            columns: self.columns(),
            rows: self.rows,
            reached: time,
            end,
            events: self.events,
            energy: self.energy,
            residual: self.residual,
            steps: self.steps,
            stiff: integrator.is_stiff(),
            pose,
        }
    }

    fn equations(&mut self) -> Equations<'_, 'a> {
        Equations {
            sick: self.sick(),
            dynamics: self.dynamics,
            units: &self.units,
        }
    }

    /// The reason for which no further step is possible.
    fn stuck(&mut self, integrator: &Integrator) -> SimulationEnd {
        /// Less than this part of the largest margin is a singular configuration.
        const SINGULAR: f64 = 0.03;
        let state = integrator.state();
        let values = state.iter().zip(&self.units).map(|(x, unit)| x * unit);
        self.dynamics.close(&values.collect::<Vec<f64>>());
        match self.dynamics.margin() < SINGULAR * self.widest {
            true => SimulationEnd::Singular,
            false => SimulationEnd::Stuck,
        }
    }
}
