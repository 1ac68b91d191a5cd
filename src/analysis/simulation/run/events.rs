//! Events within a step: limits and singular configurations.

use super::*;

/// The earliest event within a step.
pub(super) enum Met {
    Limit { joint: usize, limit: f64 },
    Singular,
}

impl Run<'_, '_> {
    /// Comes back from a limit, or ends there.
    pub(super) fn bounce(
        &mut self,
        integrator: &mut Integrator,
        time: f64,
        (joint, limit): (usize, f64),
        rates: &[f64],
        instant: &Accelerated,
    ) -> Option<SimulationEnd> {
        /// Slower than this, in rad and characteristic lengths per s, a joint rests on its limit.
        const AT_REST: f64 = 1e-4;
        let of = Coordinate::Joint(joint);
        let name = self.mechanism.joints()[joint].name.clone();
        let normal = self.dynamics.rates_of(of);
        let speed = dot(&normal, rates);
        let free = rates.len();
        let pushed = Decomposition::of(free, free, &instant.mass).solve(&normal);
        let restitution = self.settings.restitution.unwrap_or(0.0);
        if speed.abs() * restitution < AT_REST * of.scale(self.mechanism) {
            return Some(SimulationEnd::Limit {
                joint: name,
                limit,
                unit: SiUnit::of_coordinate(of.is_angle(self.mechanism)),
            });
        }
        let inertia = 1.0 / dot(&normal, &pushed);
        let mut rates = rates.to_vec();
        add(&mut rates, -(1.0 + restitution) * speed * inertia, &pushed);
        let loss = 0.5 * (1.0 - restitution * restitution) * speed * speed * inertia;
        self.energy.lost += loss;
        let event = Happened::Impact {
            joint: name,
            speed: speed.abs(),
            loss,
        };
        self.events.push(SimulationEvent { time, event });
        let at = self.dynamics.configuration().clone();
        self.restate(&at, &rates);
        let state = self.state.clone();
        match integrator.start(&mut self.equations(), time, &state) {
            Ok(()) => None,
            Err(_) => Some(SimulationEnd::Stuck),
        }
    }

    /// The configuration within the last step.
    pub(super) fn within(
        &mut self,
        integrator: &mut Integrator,
        time: f64,
    ) -> Option<Configuration<f64>> {
        let state = integrator.within(time);
        let values = state.iter().zip(&self.units).map(|(x, unit)| x * unit);
        let closed = self.dynamics.close(&values.collect::<Vec<f64>>());
        closed.then(|| self.dynamics.configuration().clone())
    }

    /// The first event of a step, with its time.
    pub(super) fn met(
        &mut self,
        integrator: &mut Integrator,
        (before, margin_before): (f64, f64),
        after: f64,
        margin: &mut f64,
    ) -> Option<(f64, Met)> {
        let limit = self.limit(integrator, before, after);
        let singular = self.singular(integrator, (before, margin_before), after, margin);
        match (limit, singular) {
            (Some(limit), Some(time)) if time < limit.0 => Some((time, Met::Singular)),
            (Some((time, joint, limit)), _) => Some((time, Met::Limit { joint, limit })),
            (None, time) => time.map(|time| (time, Met::Singular)),
        }
    }

    /// The first time within a step at which a joint passes a limit outwards, looked for at its quarters.
    pub(super) fn limit(
        &mut self,
        integrator: &mut Integrator,
        before: f64,
        after: f64,
    ) -> Option<(f64, usize, f64)> {
        const QUARTERS: usize = 4;
        let joints = self.mechanism.joints();
        if joints.iter().all(|joint| joint.limits.is_none()) {
            return None;
        }
        let beyond = |at: &Configuration<f64>, joint: usize, upper: bool| {
            let (low, high) = joints[joint]
                .limits
                .unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
            match upper {
                true => at.joints[joint] - high,
                false => low - at.joints[joint],
            }
        };
        let mut last = before;
        let mut from = self.within(integrator, before)?;
        for quarter in 1..=QUARTERS {
            let time = before + (after - before) * (quarter as f64 / QUARTERS as f64);
            let at = self.within(integrator, time)?;
            let mut first: Option<(f64, usize, f64)> = None;
            for (joint, of) in joints.iter().enumerate() {
                let Some((low, high)) = of.limits else {
                    continue;
                };
                for (upper, limit) in [(false, low), (true, high)] {
                    let (a, b) = (beyond(&from, joint, upper), beyond(&at, joint, upper));
                    if !(b > 0.0 && b > a) {
                        continue;
                    }
                    let (mut inside, mut outside) = (last, time);
                    for _ in 0..60 {
                        let middle = 0.5 * (inside + outside);
                        let there = self.within(integrator, middle)?;
                        match beyond(&there, joint, upper) > 0.0 {
                            true => outside = middle,
                            false => inside = middle,
                        }
                    }
                    if first.is_none_or(|(time, ..)| inside < time) {
                        first = Some((inside, joint, limit));
                    }
                }
            }
            if first.is_some() {
                return first;
            }
            (last, from) = (time, at);
        }
        None
    }

    /// The time within a step at which branches of motion meet, if the margin falls to nothing there.
    pub(super) fn singular(
        &mut self,
        integrator: &mut Integrator,
        (before, margin_before): (f64, f64),
        after: f64,
        margin: &mut f64,
    ) -> Option<f64> {
        /// Part of a step in which the slope of the margin is seen.
        const SHORT: f64 = 0.02;
        /// Less than this is a zero.
        const ZERO: f64 = 1e-6;
        if self.settings.through {
            self.within(integrator, after)?;
            *margin = self.dynamics.margin();
            return None;
        }
        let near = SHORT * (after - before);
        let height = |run: &mut Self, integrator: &mut Integrator, time: f64| {
            run.within(integrator, time)?;
            Some(-run.dynamics.margin())
        };
        let end = -height(self, integrator, after)?;
        *margin = end;
        let falls = -height(self, integrator, before + near)? < margin_before;
        let rises = -height(self, integrator, after - near)? < end;
        if !(falls && rises) {
            return None;
        }
        let (time, least) = edge(before, after, |time| height(self, integrator, time))?;
        (-least < ZERO && time > before + ZERO * (after - before)).then_some(time)
    }
}
