//! Configurations anywhere on the curve of a motion.

use std::f64::consts::{PI, TAU};

use super::rows::holding;
use super::{Pace, Schedule};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::Newton;
use crate::system::{Coordinate, Driven, Held, MotionTracker, System};

/// A short piece of the curve of a motion, between two places of one sure step.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// The configurations at its ends.
    pub ends: [Configuration<f64>; 2],
    /// The parts of the time that are gone there.
    times: [f64; 2],
    /// The coordinate prescribed along it instead of the inputs, which moves most; `None` where the inputs are
    /// prescribed.
    along: Option<Driven>,
    /// Largest distance of a configuration from its ends, in rad and characteristic lengths.
    reach: f64,
}

impl Stretch {
    /// True if it is no more than one place.
    pub fn is_place(&self) -> bool {
        self.reach < 1e-9 + 1e-11 && self.times[0] == self.times[1]
    }

    /// The coordinate by which the way along it is measured, or `None` for the time, with the values at its ends.
    pub fn measured(&self) -> (Option<Coordinate>, [f64; 2]) {
        match &self.along {
            Some(along) => (Some(along.coordinate), [along.from, along.to]),
            None => (None, self.times),
        }
    }
}

/// Interpolates a motion by configurations solved on [`Stretch`]es: at a part of the way between their ends, in time
/// where the inputs are prescribed.
pub struct Passage<'m> {
    pub mechanism: &'m Mechanism,
    held: &'m Held<f64>,
    pub inputs: &'m [Driven],
    pace: Pace,
    schedule: Option<&'m Schedule>,
    scales: Vec<(Coordinate, f64)>,
    /// Trackers, each with the coordinate prescribed, or `None` for the inputs.
    trackers: Vec<(Option<Coordinate>, MotionTracker)>,
}

impl<'m> Passage<'m> {
    /// `held` holds none of the inputs.
    pub fn new(
        mechanism: &'m Mechanism,
        held: &'m Held<f64>,
        inputs: &'m [Driven],
        (pace, schedule): (Pace, Option<&'m Schedule>),
    ) -> Self {
        Passage {
            mechanism,
            held,
            inputs,
            pace,
            schedule,
            scales: Coordinate::all(mechanism)
                .map(|of| (of, of.scale(mechanism)))
                .collect(),
            trackers: Vec::new(),
        }
    }

    /// The part of the time that is gone where the inputs are, unless a table says it.
    pub fn time(&self, at: &Configuration<f64>) -> f64 {
        let joint = |input: &&Driven| matches!(input.coordinate, Coordinate::Joint(_));
        let measure = self.inputs.iter().find(joint).or(self.inputs.first());
        let part = measure.map_or(0.0, |input| {
            let way = input.to - input.from;
            let gone = input.coordinate.of(self.mechanism, at) - input.from;
            match input.coordinate {
                Coordinate::Joint(_) => gone / way,
                // an angle of a platform is known modulo a turn
                of if of.is_angle(self.mechanism) => (0.5 * way + turned(gone - 0.5 * way)) / way,
                _ => gone / way,
            }
        });
        self.pace.law.inverse(part.clamp(0.0, 1.0))
    }

    /// The part of a stretch at which a place on it is.
    pub fn part(&self, stretch: &Stretch, at: &Configuration<f64>, time: f64) -> f64 {
        let [begin, end] = stretch.times;
        let part = match &stretch.along {
            Some(along) => {
                self.change(along.coordinate, [&stretch.ends[0], at]) / (along.to - along.from)
            }
            None if begin == end => 0.0,
            None => (time - begin) / (end - begin),
        };
        part.clamp(0.0, 1.0)
    }

    /// The change of a coordinate; angles of platforms are known modulo a turn.
    fn change(&self, of: Coordinate, [from, to]: [&Configuration<f64>; 2]) -> f64 {
        let change = of.about_centre(to) - of.about_centre(from);
        match of.platform().is_some() && of.is_angle(self.mechanism) {
            true => turned(change),
            false => change,
        }
    }

    /// The distance of two configurations: the largest, in rad and characteristic lengths.
    pub fn far(&self, ends: [&Configuration<f64>; 2]) -> f64 {
        let far = |(of, scale): &(Coordinate, f64)| self.change(*of, ends).abs() / scale;
        self.scales.iter().map(far).fold(0.0, f64::max)
    }

    /// The piece between two places with the parts of the time there; beside a fold, where the inputs stand still, they
    /// cannot be prescribed.
    pub fn stretch(&self, ends: [Configuration<f64>; 2], times: [f64; 2], fold: bool) -> Stretch {
        let both = [&ends[0], &ends[1]];
        let goes = |of: Coordinate, scale: f64| self.change(of, both).abs() / scale;
        let most = |joints: bool| {
            let all = self.scales.iter();
            let all = all.filter(|(of, _)| !joints || matches!(of, Coordinate::Joint(_)));
            all.max_by(|a, b| goes(a.0, a.1).total_cmp(&goes(b.0, b.1)))
        };
        // a joint can be prescribed whatever else is held
        let (joint, most) = (most(true), most(false));
        let fast = |of: &&(Coordinate, f64)| {
            most.is_some_and(|most| goes(of.0, of.1) > 0.1 * goes(most.0, most.1))
        };
        let most = joint.filter(fast).or(most);
        let inputs = self.inputs.iter();
        let slow = inputs
            .map(|of| goes(of.coordinate, of.coordinate.scale(self.mechanism)))
            .fold(0.0, f64::max)
            // so slow beside the largest motion, they are nearly at a fold
            <= most.map_or(0.0, |most| 0.05 * goes(most.0, most.1));
        let along = match (self.inputs, self.schedule) {
            ([_], None) if !fold && !slow => None,
            ([] | [_], None) => most.map(|(of, _)| Driven {
                coordinate: *of,
                from: of.of(self.mechanism, both[0]),
                to: of.of(self.mechanism, both[0]) + self.change(*of, both),
            }),
            _ => None,
        };
        Stretch {
            reach: 2.0 * self.far(both) + 1e-9,
            ends,
            times,
            along,
        }
    }

    fn tracker(&mut self, stretch: &Stretch) -> Option<&mut MotionTracker> {
        let key = stretch.along.map(|of| of.coordinate);
        if let Some(known) = self.trackers.iter().position(|(of, _)| *of == key) {
            return Some(&mut self.trackers[known].1);
        }
        let held = match &stretch.along {
            Some(along) => holding(self.held, std::slice::from_ref(along)),
            None => holding(self.held, self.inputs),
        }?;
        let system = System::reduced(self.mechanism, self.mechanism.dimensions(), &held);
        let tracker = MotionTracker::new(system, stretch.ends[0].clone());
        self.trackers.push((key, tracker));
        self.trackers.last_mut().map(|(_, tracker)| tracker)
    }

    /// The assembled configuration at a part of a piece, and the part of the time that is gone there; none where that
    /// branch has none. `from` is a configuration near it, on the same piece, at the part given with it.
    pub fn at(
        &mut self,
        stretch: &Stretch,
        part: f64,
        from: (f64, &Configuration<f64>),
    ) -> Option<(&Configuration<f64>, f64)> {
        /// Steps in which it is gone to where one is too long.
        const STEPS: u32 = 32;
        let (inputs, pace, schedule) = (self.inputs, self.pace, self.schedule);
        let [begin, end] = stretch.times;
        let go = |tracker: &mut MotionTracker, part: f64| match &stretch.along {
            Some(along) => tracker.solve_at([along.coordinate].into_iter(), |_| along.at(part)),
            None => {
                let time = begin + part * (end - begin);
                let [gone, ..] = pace.law.at(time);
                let moved = inputs.iter().map(|input| input.coordinate);
                tracker.solve_at(moved, |i| match schedule {
                    Some(schedule) => schedule.at(i, time)[0],
                    None => inputs[i].at(gone),
                })
            }
        };
        let tracker = self.tracker(stretch)?;
        tracker.restart(from.1);
        if part != from.0 || part != 0.0 && part != 1.0 {
            if !go(tracker, part).solved {
                tracker.restart(from.1);
                let between = |k| from.0 + (part - from.0) * f64::from(k) / f64::from(STEPS);
                if !(1..=STEPS).all(|k| go(tracker, between(k)).solved) {
                    return None;
                }
            }
            // slopes are taken of what is found here, so that it is solved as well as it can be
            tracker.recover(&Newton {
                tolerance: 1e-15,
                ..Newton::default()
            });
        }
        let key = stretch.along.map(|of| of.coordinate);
        let found = self
            .trackers
            .iter()
            .find(|(of, _)| *of == key)?
            .1
            .configuration();
        if stretch
            .ends
            .iter()
            .any(|end| self.far([end, found]) > stretch.reach)
        {
            return None;
        }
        let time = match (&stretch.along, part) {
            (_, 0.0) => begin,
            (_, 1.0) => end,
            (None, _) => begin + part * (end - begin),
            (Some(_), _) => self.time(found),
        };
        Some((found, time))
    }
}

/// An angle but for whole turns.
fn turned(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
