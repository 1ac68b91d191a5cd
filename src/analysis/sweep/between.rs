//! Configurations between rows that follow one another.

use super::Schedule;
use super::rows::holding;
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::Newton;
use crate::system::{Coordinate, Driven, Held, MotionTracker, System};

/// Solves for configurations between three rows on one branch: the first is where 0 is, the last where 1 is.
///
/// What is prescribed are the inputs, where they go one way through the three; else, as at a dead point, the
/// coordinate that moves most.
pub struct Between {
    tracker: MotionTracker,
    moved: Vec<Driven>,
    /// What the inputs follow, with the parts of the time at the first and the last row.
    schedule: Option<(Schedule, [f64; 2])>,
    middle: Configuration<f64>,
    /// The part of the way where the middle row is.
    part: f64,
    /// How far, in rad and characteristic lengths, a configuration may be from that of the middle row.
    reach: f64,
    scales: Vec<(Coordinate, f64)>,
}

impl Between {
    /// Between three rows of a motion; `held` holds none of the inputs. None where nothing goes one way, as between
    /// rows of a motion that turns back with several inputs.
    pub fn new(
        mechanism: &Mechanism,
        held: &Held<f64>,
        inputs: &[Driven],
        schedule: Option<(Schedule, [f64; 2])>,
        rows: [&Configuration<f64>; 3],
    ) -> Option<Self> {
        let scales = Coordinate::all(mechanism).map(|c| (c, c.scale(mechanism)));
        let scales: Vec<(Coordinate, f64)> = scales.collect();
        let [first, middle, last] = rows;
        let along = |of: Coordinate| Driven {
            coordinate: of,
            from: of.of(mechanism, first),
            to: of.of(mechanism, last),
        };
        // how far it goes one way, at the slower side
        let goes = |of: Coordinate| {
            let steps = [
                of.from_centre(middle) - of.from_centre(first),
                of.from_centre(last) - of.from_centre(middle),
            ];
            match steps[0] * steps[1] > 0.0 {
                true => steps[0].abs().min(steps[1].abs()) / of.scale(mechanism),
                false => 0.0,
            }
        };
        let prescribed = schedule.is_some()
            || !inputs.is_empty() && inputs.iter().all(|input| goes(input.coordinate) > 1e-12);
        let moved = match (prescribed, inputs) {
            (true, _) => inputs.iter().map(|input| along(input.coordinate)).collect(),
            (false, [] | [_]) => {
                let all = Coordinate::all(mechanism);
                let most = all.max_by(|a, b| goes(*a).total_cmp(&goes(*b)))?;
                (goes(most) > 1e-12).then(|| vec![along(most)])?
            }
            _ => return None,
        };
        // rows that follow a schedule are equal parts of the time
        let part = match (&schedule, &moved[..]) {
            (
                None,
                [
                    Driven {
                        coordinate,
                        from,
                        to,
                    },
                    ..,
                ],
            ) => (coordinate.of(mechanism, middle) - from) / (to - from),
            _ => 0.5,
        };
        let held = holding(held, &moved)?;
        let system = System::reduced(mechanism, mechanism.dimensions(), &held);
        let mut between = Between {
            tracker: MotionTracker::new(system, middle.clone()),
            moved,
            schedule,
            middle: middle.clone(),
            part,
            reach: 0.0,
            scales,
        };
        between.reach = 2.0 * (between.far(first) + between.far(last)) + 1e-9;
        Some(between)
    }

    fn far(&self, at: &Configuration<f64>) -> f64 {
        let far = |(of, scale): &(Coordinate, f64)| {
            (of.from_centre(at) - of.from_centre(&self.middle)).abs() / scale
        };
        self.scales.iter().map(far).fold(0.0, f64::max)
    }

    /// The part of the time at a part of the way, where the inputs follow a schedule.
    pub fn time(&self, part: f64) -> Option<f64> {
        let (_, [from, to]) = self.schedule.as_ref()?;
        Some(from + part * (to - from))
    }

    /// The part of the way where the middle row is.
    pub fn middle(&self) -> f64 {
        self.part
    }

    /// The assembled configuration at a part of the way, if the branch of the rows has one there.
    pub fn at(&mut self, part: f64) -> Option<&Configuration<f64>> {
        /// Steps in which it is gone to from the middle row where one is too long.
        const STEPS: u32 = 32;
        self.tracker.restart(&self.middle);
        if !self.go(part) {
            self.tracker.restart(&self.middle);
            let from = self.middle();
            for k in 1..=STEPS {
                if !self.go(from + (part - from) * f64::from(k) / f64::from(STEPS)) {
                    return None;
                }
            }
        }
        // slopes are taken of what is found here, so that it is solved as well as it can be
        self.tracker.recover(&Newton {
            tolerance: 1e-15,
            ..Newton::default()
        });
        Some(self.tracker.configuration())
    }

    /// Goes on to a part of the way, if that leads to a configuration near the rows.
    fn go(&mut self, part: f64) -> bool {
        let moved = self.moved.iter().map(|input| input.coordinate);
        let report = self.tracker.solve_at(moved, |i| match &self.schedule {
            Some((schedule, [from, to])) => schedule.at(i, from + part * (to - from))[0],
            None => self.moved[i].at(part),
        });
        report.solved && self.far(self.tracker.configuration()) <= self.reach
    }
}
