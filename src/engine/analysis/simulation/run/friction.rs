//! Joints that stick, by friction or on a limit, and go on.

use super::*;
use crate::algebra::Expression;
use crate::mechanism::Friction;
use crate::number::tolerance::ROUNDING;

/// A joint that no longer sticks.
pub(super) struct Slip<'a> {
    stuck: Stuck,
    /// Its dimensionless acceleration in the direction in which it goes.
    pub pace: f64,
    slides: Vec<f64>,
    dynamics: Dynamics<'a>,
    rates: Vec<f64>,
}

impl Stuck {
    /// Friction holds that joint.
    fn rubbing(joint: usize) -> Self {
        Stuck { joint, limit: None }
    }
}

impl<'a> Run<'a, '_> {
    /// Finds the directions in which joints slide at the start; those at rest are held where friction suffices.
    pub(super) fn begin_friction(&mut self, rates: &[f64]) {
        let frictions = self.dynamics.frictions();
        if frictions.is_empty() {
            return;
        }
        let all = self.dynamics.rates().to_vec();
        let largest = all.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let sign = |of: &Friction| match all[of.joint].abs() <= ROUNDING * largest {
            true => 0.0,
            false => all[of.joint].signum(),
        };
        self.slides = frictions.iter().map(sign).collect();
        let mut rates = rates.to_vec();
        for (i, friction) in frictions.iter().enumerate() {
            if self.slides[i] == 0.0
                && let Some(others) = self.stick(Stuck::rubbing(friction.joint), &rates)
            {
                rates = others;
            }
        }
        self.settle(0.0, rates);
        let held = self.stuck.iter().map(|of| SimulationEvent {
            time: 0.0,
            event: Happened::Sticks {
                joint: self.mechanism.joints()[of.joint].name.clone(),
            },
        });
        self.events.extend(held);
    }

    /// At a joint that comes to rest, or without one where one slips. Returns an end if there is one.
    pub(super) fn stick_or_slip(
        &mut self,
        integrator: &mut Integrator,
        time: f64,
        friction: Option<usize>,
        rates: &[f64],
    ) -> Option<SimulationEnd> {
        let mut rates = rates.to_vec();
        let name = |joint: usize| self.mechanism.joints()[joint].name.clone();
        let rests = friction.map(|friction| self.dynamics.frictions()[friction].joint);
        let sticks = rests.map(|joint| Happened::Sticks { joint: name(joint) });
        if let (Some(friction), Some(joint)) = (friction, rests) {
            self.slides[friction] = 0.0;
            if let Some(others) = self.stick(Stuck::rubbing(joint), &rates) {
                rates = others;
            }
        }
        let slips = self.settle(time, rates);
        let event = match (sticks, slips) {
            (None, Some(Stuck { joint, limit: None })) => {
                Some(Happened::Slips { joint: name(joint) })
            }
            (None, Some(Stuck { joint, .. })) => Some(Happened::Leaves { joint: name(joint) }),
            // a joint that turns back does not rest
            (Some(_), Some(_)) => None,
            (sticks, None) => sticks,
        };
        let event = event.map(|event| SimulationEvent { time, event });
        self.events.extend(event);
        self.resume(integrator, time)
    }

    /// Releases joints that no longer stick, and goes on from there; returns the first of them.
    pub(super) fn settle(&mut self, time: f64, mut rates: Vec<f64>) -> Option<Stuck> {
        let mut first = None;
        while let Some(slip) = self.slipping(time, &rates) {
            first = first.or(Some(slip.stuck));
            let mut stuck = self.stuck.clone();
            stuck.retain(|of| *of != slip.stuck);
            self.slides = slip.slides;
            self.take(slip.dynamics, stuck);
            rates = slip.rates;
        }
        self.dynamics.slide(&self.slides);
        let at = self.dynamics.configuration().clone();
        self.restate(&at, &rates);
        first
    }

    /// Holds a joint where it is, and lets friction rest in all joints that then do. Returns the rates of the coordinates
    /// left, or nothing if the joint rests already.
    pub(super) fn stick(&mut self, held: Stuck, rates: &[f64]) -> Option<Vec<f64>> {
        if !self.moves(held.joint) {
            return None;
        }
        let stuck = [&self.stuck[..], &[held]].concat();
        let dynamics = self.held(&stuck)?;
        let rates = self.dynamics.rates_for(&dynamics, rates);
        self.take(dynamics, stuck);
        for (i, friction) in self.dynamics.frictions().iter().enumerate() {
            if self.settings.speeds.is_empty() && !self.moves(friction.joint) {
                self.slides[i] = 0.0;
            }
        }
        Some(rates)
    }

    /// True if a joint moves with the independent coordinates.
    fn moves(&self, joint: usize) -> bool {
        let slope = self.dynamics.rates_of(Coordinate::Joint(joint));
        slope[..self.free()].iter().any(|x| x.abs() > ROUNDING)
    }

    /// The equations with these joints held, at the configuration last closed.
    fn held(&self, stuck: &[Stuck]) -> Option<Dynamics<'a>> {
        let joints = stuck.iter().map(|of| Coordinate::Joint(of.joint));
        let joints: Vec<Coordinate> = joints.collect();
        self.dynamics
            .driving(self.settings.speeds.len(), &joints)
            .ok()
    }

    fn take(&mut self, dynamics: Dynamics<'a>, stuck: Vec<Stuck>) {
        *self.dynamics = dynamics;
        self.laws.speeds.truncate(self.settings.speeds.len());
        let held = stuck.iter().map(|of| Speed {
            coordinate: Coordinate::Joint(of.joint),
            rate: Expression::number(0.0),
            parameters: Vec::new(),
        });
        self.laws.speeds.extend(held);
        self.laws.units = self.dynamics.units();
        self.stuck = stuck;
    }

    /// A joint that no longer sticks at the configuration last closed, with these rates: with all friction against a motion
    /// of it in one direction, away from a limit if it rests on one, it is accelerated in that direction.
    pub(super) fn slipping(&mut self, time: f64, rates: &[f64]) -> Option<Slip<'a>> {
        for (k, &stuck) in self.stuck.iter().enumerate() {
            let joint = stuck.joint;
            let mut others = self.stuck.clone();
            others.remove(k);
            let mut dynamics = self.held(&others)?;
            let rates = self.dynamics.rates_for(&dynamics, rates);
            let free = dynamics.coordinates().len();
            let mass = Decomposition::of(free, free, &dynamics.mass()?);
            let along = |dynamics: &Dynamics, joint: usize| {
                dynamics.rates_of(Coordinate::Joint(joint))[..free].to_vec()
            };
            let pushed = mass.solve(&along(&dynamics, joint));
            let driven = self.settings.speeds.iter().map(|of| of.at(time)[1]);
            let driven: Vec<f64> = driven.chain(others.iter().map(|_| 0.0)).collect();
            let sides = stuck.limit.map_or([1.0, -1.0], |side| [-side; 2]);
            for side in sides {
                let sign = |(of, slides): (&Friction, &f64)| {
                    let slope = along(&dynamics, of.joint);
                    let rate = dot(&slope, &pushed);
                    let rests = rate.abs() <= ROUNDING * norm(&pushed) * norm(&slope);
                    match *slides {
                        0.0 if rests || others.iter().any(|other| other.joint == of.joint) => 0.0,
                        0.0 => side * rate.signum(),
                        slides => slides,
                    }
                };
                let slides = dynamics.frictions().iter().zip(&self.slides);
                let slides: Vec<f64> = slides.map(sign).collect();
                dynamics.slide(&slides);
                let Some(now) = dynamics.evaluate(&rates, &driven, time) else {
                    continue;
                };
                let pace = side * dynamics.accelerations(&now.accelerations, &driven)[joint];
                if pace > ROUNDING {
                    return Some(Slip {
                        stuck,
                        pace,
                        slides,
                        dynamics,
                        rates,
                    });
                }
            }
        }
        None
    }
}
