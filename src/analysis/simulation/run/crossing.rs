//! Straight on through singular configurations.

use super::*;

impl Run<'_, '_> {
    /// Keeps the last few states from which a singular configuration can be crossed.
    pub(super) fn remember(&mut self, time: f64, step: f64, margin: f64) {
        const KEPT: usize = 4;
        self.widest = self.widest.max(margin);
        if self.settings.through && margin > self.sick() {
            if self.sound.len() == KEPT {
                self.sound.remove(0);
            }
            self.sound.push((time, self.state.clone(), step));
        }
    }

    /// Goes on beyond a configuration at which branches of motion meet: by one step across it, from a state before it
    /// where the equations are sound. Of several steps that which keeps the energy best is taken, as rounding spoils one
    /// with a stage beside the singular configuration.
    pub(super) fn cross(&mut self, integrator: &mut Integrator) -> Result<f64, SimulationEnd> {
        /// Lengths of the step tried, in times of the last one on sound ground.
        const LENGTHS: [f64; 12] = [
            1.0, 0.85, 1.2, 0.7, 1.4, 0.55, 1.7, 0.92, 1.1, 0.62, 2.0, 0.77,
        ];
        /// The largest error of the balance of energies, of the kinetic energy.
        const KEPT: f64 = 1e-7;
        let mut best: Option<(f64, usize, f64)> = None;
        for state in (0..self.sound.len()).rev() {
            for length in LENGTHS {
                let Some((_, change)) = self.leap(integrator, state, length) else {
                    continue;
                };
                if best.is_none_or(|(least, ..)| change < least) {
                    best = Some((change, state, length));
                }
            }
        }
        let best = best.filter(|(change, ..)| *change <= KEPT * self.energy.kinetic);
        let leap = best.and_then(|(_, state, length)| self.leap(integrator, state, length));
        let (time, _) = leap.ok_or(SimulationEnd::Stuck)?;
        let event = Happened::Singular;
        self.events.push(SimulationEvent { time, event });
        Ok(time)
    }

    /// The time that one step from a sound state reaches, sound again, and the error of the balance of energies in it.
    fn leap(
        &mut self,
        integrator: &mut Integrator,
        sound: usize,
        length: f64,
    ) -> Option<(f64, f64)> {
        let (from, sound, natural) = self.sound[sound].clone();
        let (_, before) = at(self.dynamics, &self.units, from, &sound)?;
        self.dynamics.stand();
        let flow = &mut self.equations();
        (integrator.restart(flow, (from, &sound), length * natural)).ok()?;
        let after = integrator.step(flow).ok()?;
        let state = integrator.state().to_vec();
        let (_, instant) = at(self.dynamics, &self.units, after, &state)?;
        let sum = |of: &Accelerated, state: &[f64]| {
            of.kinetic + of.potential - state[2 * self.units.len()]
        };
        let change = (sum(&instant, &state) - sum(&before, &sound)).abs();
        let ahead = self.rows.last().is_none_or(|row| row[0] < after);
        (ahead && self.dynamics.margin() > self.sick()).then_some((after, change))
    }

    /// The margin below which rounding is felt in accelerations.
    pub(super) fn sick(&self) -> f64 {
        const SICK: f64 = 0.03;
        SICK * self.widest
    }
}
