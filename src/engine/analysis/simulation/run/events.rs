//! Events within a step: limits and singular configurations.

use super::*;

/// The earliest event within a step.
pub(super) enum EarliestEvent {
    Limit(JointLimit),
    Singular,
    /// The joint of that friction comes to rest, or, without one, a joint that friction held slips.
    Friction {
        friction: Option<usize>,
    },
}

/// A joint at its upper limit, side 1, or at its lower one, −1.
#[derive(Clone, Copy)]
pub(super) struct JointLimit {
    joint: usize,
    limit: f64,
    side: f64,
}

/// The end of a smooth piece of the motion.
enum Guard {
    Limit(JointLimit),
    /// The joint of that friction turns against the direction in which it slides.
    Rest(usize),
    /// Friction no longer holds a joint.
    Slip,
}

impl Run<'_, '_> {
    /// Comes back from a limit, rests on it, or ends there.
    pub(super) fn bounce(
        &mut self,
        integrator: &mut Integrator,
        time: f64,
        JointLimit { joint, limit, side }: JointLimit,
        rates: &[f64],
        instant: &Accelerated,
    ) -> Option<SimulationEnd> {
        let (place, of) = (joint, Coordinate::Joint(joint));
        let name = self.mechanism.joints()[joint].name.clone();
        let mut normal = self.dynamics.rates_of(of);
        let speed = dot(&normal, rates);
        let free = self.free();
        normal.truncate(free);
        let pushed = Decomposition::of(free, free, &instant.mass).solve(&normal);
        let end = || {
            let joint = self.mechanism.joints()[joint].name.clone();
            let unit = SiUnit::of_coordinate(of.is_angle(self.mechanism));
            Some(SimulationEnd::Limit { joint, limit, unit })
        };
        let Some(mut restitution) = self.settings.restitution else {
            return end();
        };
        // slower, in rad and characteristic lengths per s, it rests on the limit
        let rests = speed.abs() * restitution < 1e-4 * of.scale(self.mechanism);
        if rests {
            restitution = 0.0;
        }
        let inertia = 1.0 / dot(&normal, &pushed);
        let mut rates = rates.to_vec();
        add(
            &mut rates[..free],
            -(1.0 + restitution) * speed * inertia,
            &pushed,
        );
        let loss = 0.5 * (1.0 - restitution * restitution) * speed * speed * inertia;
        let (joint, speed) = (name, speed.abs());
        let event = match rests {
            true => {
                let limit = Some(side);
                let Some(others) = self.stick(
                    Stuck {
                        joint: place,
                        limit,
                    },
                    &rates,
                ) else {
                    return end();
                };
                self.settle(time, others);
                Happened::Rests { joint, speed, loss }
            }
            false => {
                let at = self.dynamics.configuration().clone();
                self.restate(&at, &rates);
                Happened::Impact { joint, speed, loss }
            }
        };
        self.energy.lost += loss;
        self.events.push(SimulationEvent { time, event });
        self.resume(integrator, time)
    }

    /// Goes on from the state; returns an end if that is impossible.
    pub(super) fn resume(
        &mut self,
        integrator: &mut Integrator,
        time: f64,
    ) -> Option<SimulationEnd> {
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
        let values = self.laws.values(&state);
        let closed = self.dynamics.close(&values[..self.laws.units.len()]);
        closed.then(|| self.dynamics.configuration().clone())
    }

    /// The first event of a step, with its time.
    pub(super) fn met(
        &mut self,
        integrator: &mut Integrator,
        (before, margin_before): (f64, f64),
        after: f64,
        margin: &mut f64,
    ) -> Option<(f64, EarliestEvent)> {
        let limit = self.limit(integrator, before, after);
        let mut singular = self.singular(integrator, (before, margin_before), after, margin);
        if self.settings.through {
            let passed = singular.take();
            let passed =
                passed.filter(|time| (limit.as_ref()).is_none_or(|(limit, ..)| time < limit));
            self.events.extend(passed.map(|time| SimulationEvent {
                time,
                event: Happened::Singular,
            }));
        }
        match (limit, singular) {
            (Some(limit), Some(time)) if time < limit.0 => Some((time, EarliestEvent::Singular)),
            (Some(limit), _) => Some(limit),
            (None, time) => time.map(|time| (time, EarliestEvent::Singular)),
        }
    }

    /// The first time within a step at which a joint passes a limit outwards, or friction begins or
    /// ceases to hold one. It passes between two of nine times if it is
    /// beyond at the second, or turns back between them beyond it: the polynomial of a step, of degree 7, hardly turns
    /// twice in an eighth of it.
    pub(super) fn limit(
        &mut self,
        integrator: &mut Integrator,
        before: f64,
        after: f64,
    ) -> Option<(f64, EarliestEvent)> {
        const PARTS: usize = 8;
        let joints = self.mechanism.joints().iter().enumerate();
        let limits = joints
            .filter_map(|(joint, of)| of.limits.map(|limits| (joint, limits)))
            .filter(|(joint, _)| self.stuck.iter().all(|of| of.joint != *joint))
            .flat_map(|(joint, (low, high))| [(joint, low, -1.0), (joint, high, 1.0)]);
        let slides = self.slides.iter().enumerate();
        let slides = slides.filter(|(_, sign)| **sign != 0.0);
        let guards: Vec<Guard> = limits
            .map(|(joint, limit, side)| Guard::Limit(JointLimit { joint, limit, side }))
            .chain(slides.map(|(friction, _)| Guard::Rest(friction)))
            .chain((!self.stuck.is_empty()).then_some(Guard::Slip))
            .collect();
        let mut last: Vec<[f64; 2]> = Vec::new();
        for part in 0..=PARTS {
            let time = |part: usize| before + (after - before) * (part as f64 / PARTS as f64);
            let (from, time) = (time(part.saturating_sub(1)), time(part));
            let mut now = Vec::with_capacity(guards.len());
            let mut first: Option<(f64, EarliestEvent)> = None;
            for (i, guard) in guards.iter().enumerate() {
                let [out, rate] = self.beyond(integrator, guard, time)?;
                now.push([out, rate]);
                let Some(&[was, went]) = last.get(i) else {
                    continue;
                };
                let mut outside = time;
                if out <= 0.0 || out <= was {
                    // it turns back on the way
                    if !(was <= 0.0 && went > 0.0 && rate < 0.0) {
                        continue;
                    }
                    let (turn, most) = edge(from, time, |time| {
                        Some(self.beyond(integrator, guard, time)?[0])
                    })?;
                    if most <= 0.0 {
                        continue;
                    }
                    outside = turn;
                }
                let mut inside = from;
                for _ in 0..60 {
                    let middle = 0.5 * (inside + outside);
                    match self.beyond(integrator, guard, middle)?[0] > 0.0 {
                        true => outside = middle,
                        false => inside = middle,
                    }
                }
                let (time, met) = match *guard {
                    Guard::Limit(limit) => (inside, EarliestEvent::Limit(limit)),
                    Guard::Rest(friction) => {
                        let friction = Some(friction);
                        (inside, EarliestEvent::Friction { friction })
                    }
                    Guard::Slip => (outside, EarliestEvent::Friction { friction: None }),
                };
                if first.as_ref().is_none_or(|(known, _)| time < *known) {
                    first = Some((time, met));
                }
            }
            if let Some((time, met)) = first {
                let guard = match met {
                    EarliestEvent::Limit(limit) => Guard::Limit(limit),
                    EarliestEvent::Friction {
                        friction: Some(friction),
                    } => Guard::Rest(friction),
                    _ => return Some((time, met)),
                };
                return Some((
                    self.sharpened(integrator, &guard, time, [before, after])?,
                    met,
                ));
            }
            last = now;
        }
        None
    }

    /// The time of an event by Newton's method on states as accurate as those at the ends of steps.
    fn sharpened(
        &mut self,
        integrator: &mut Integrator,
        guard: &Guard,
        mut time: f64,
        [before, after]: [f64; 2],
    ) -> Option<f64> {
        const STEPS: usize = 3;
        for _ in 0..STEPS {
            let state = integrator.reached(&mut self.equations(), time);
            let [out, rate] = self.out(guard, time, &state)?;
            if rate <= 0.0 {
                break;
            }
            time = (time - out / rate).clamp(before, after);
        }
        Some(time)
    }

    /// As [`Run::out`], within the last step.
    fn beyond(
        &mut self,
        integrator: &mut Integrator,
        guard: &Guard,
        time: f64,
    ) -> Option<[f64; 2]> {
        let state = integrator.within(time);
        self.out(guard, time, &state)
    }

    /// The distance of a joint beyond a limit in a state, or its speed against the direction in which it slides, with its
    /// rate; or a number that is positive once a joint no longer sticks.
    fn out(&mut self, guard: &Guard, time: f64, state: &[f64]) -> Option<[f64; 2]> {
        let (rates, instant) = at(self.dynamics, &self.laws, time, state)?;
        let scales = &self.mechanism.dimensions().joint_scales;
        let rate = |joint: usize| self.dynamics.rates()[joint] * scales[joint];
        Some(match *guard {
            Guard::Limit(JointLimit { joint, limit, side }) => {
                let value = self.dynamics.configuration().joints[joint];
                [side * (value - limit), side * rate(joint)]
            }
            Guard::Rest(friction) => {
                let joint = self.dynamics.frictions()[friction].joint;
                let rate = rate(joint);
                let [_, driven] = self.laws.rates(time, state);
                let all = self.dynamics.accelerations(&instant.accelerations, &driven);
                [rate, all[joint] * scales[joint]].map(|x| -self.slides[friction] * x)
            }
            Guard::Slip => match self.slipping(time, &rates) {
                Some(slip) => [slip.pace, 0.0],
                None => [-1.0, 0.0],
            },
        })
    }

    /// The time within a step at which branches of motion meet, if the margin falls to nothing there.
    pub(super) fn singular(
        &mut self,
        integrator: &mut Integrator,
        (before, margin_before): (f64, f64),
        after: f64,
        margin: &mut f64,
    ) -> Option<f64> {
        /// As near as the place of a dip is found.
        const ZERO: f64 = 1e-6;
        // the slope of the margin is seen in a fiftieth of the step
        let near = 0.02 * (after - before);
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
