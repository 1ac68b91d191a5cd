//! Moving a mechanism by hand: from its configuration to new values of the held coordinates, on its branch.

mod pull;
mod ways;

use std::sync::{Arc, OnceLock};

use super::{AskError, Question, Role};
use crate::analysis::sweep::{Row, SweepEnd, SweepReport, SweepSettings, sweep};
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::Watch;
use crate::system::{self, Coordinate, Driven, Held, QuestionError, Still, check_count};

/// A mechanism in a configuration, with its held coordinates.
#[derive(Clone, Debug)]
pub struct Steering {
    mechanism: Arc<Mechanism>,
    /// Coordinates that stay where they are so that links do not spin about their own lines.
    still: Vec<Still>,
    driven: Vec<Coordinate>,
    at: Configuration<f64>,
    /// The singular configuration that stopped the last motion.
    stopped: Option<Configuration<f64>>,
    /// The last configuration well determined by the held coordinates.
    regular: Option<Configuration<f64>>,
    /// True if it has been pulled through a dead point of the held coordinates, and not back.
    crossed: bool,
}

/// Before a dead point a motion stops at least this far away, in rad or characteristic lengths: the rest of the mechanism,
/// which goes by the square root, is then a thousandth away from it, where the branch is still unique.
const BEFORE: f64 = 1e-6;

/// Ways shorter than this part of where they begin, or of a rad or characteristic length, are rounding.
const ROUNDING: f64 = 1e-13;

impl Question {
    /// The mechanism assembled near the start, or in the mode asked for, ready to be moved by its held coordinates. If
    /// too little is held, or something that depends on the rest, this is corrected.
    ///
    /// # Errors
    /// If the question is wrong or nothing assembles.
    pub fn steering(&self, watch: &Watch) -> Result<Steering, AskError> {
        let asked = self.clone().completed()?;
        let (_, at) = asked.configurations(watch)?.swap_remove(0);
        asked.steering_from(at)
    }

    /// As [`Question::steering`], from the assembly that Newton's method finds near a configuration.
    ///
    /// # Errors
    /// If the question is wrong, or Newton's method leads nowhere from there.
    pub fn steering_near(
        &self,
        at: &Configuration<f64>,
        watch: &Watch,
    ) -> Result<Steering, AskError> {
        let asked = self.clone().completed()?;
        let question = asked.resolved()?.near(at).with_spins_still();
        match asked.nearest(&question, 0, watch) {
            Some(at) => asked.steering_from(at),
            None => Err(AskError::NotAssembled(question.held_names())),
        }
    }

    /// As [`Question::steering`], from an assembled configuration, at which the held coordinates may have other values.
    pub fn steering_from(&self, at: Configuration<f64>) -> Result<Steering, AskError> {
        let resolved = self.resolved()?;
        Ok(Steering {
            mechanism: self.mechanism().clone(),
            driven: resolved.held_coordinates(),
            still: resolved.with_spins_still().still().to_vec(),
            at,
            stopped: None,
            regular: None,
            crossed: false,
        })
    }

    /// Holds a coordinate no longer, so that it can be an input.
    pub fn let_go(mut self, name: &str) -> Self {
        (self.demands).retain(|of| of.role != Role::Hold || of.name != name);
        self.ready = OnceLock::new();
        self
    }

    /// With as much held as decides the configuration.
    fn completed(self) -> Result<Self, AskError> {
        let counted = check_count(&self.resolved()?);
        let (free, hold) = match counted {
            Ok(_) => return Ok(self),
            Err(QuestionError::TooFew { hold, .. }) => (Vec::new(), hold),
            Err(QuestionError::TooMany { free, .. }) => (free, Vec::new()),
            Err(QuestionError::Dependent { free, hold }) => (free, hold),
            Err(error) => return Err(AskError::Question(error)),
        };
        let mut asked = self;
        for name in free {
            asked = asked.let_go(&name);
            if asked.mechanism().joint(&name).is_some() {
                asked = asked.free(name);
            }
        }
        let values = asked.holdable(&hold).unwrap_or_default();
        for holdable in values {
            (asked.demands).retain(|of| of.role != Role::Free || of.name != holdable.name);
            asked = asked.demand(holdable);
        }
        Ok(asked)
    }
}

impl Steering {
    /// The mechanism.
    pub fn mechanism(&self) -> &Arc<Mechanism> {
        &self.mechanism
    }

    /// The present configuration, which is assembled.
    pub fn at(&self) -> &Configuration<f64> {
        &self.at
    }

    /// True if a singular configuration stopped the last motion.
    pub fn is_stopped(&self) -> bool {
        self.stopped.is_some()
    }

    /// True if it has been pulled through a dead point of the held coordinates, on to another branch.
    pub fn is_crossed(&self) -> bool {
        self.crossed
    }

    /// The mechanism at the singular configuration that stopped the last motion, if one did.
    pub(super) fn where_stopped(&self) -> Self {
        let mut there = self.clone();
        there.at = there.stopped.take().unwrap_or(there.at);
        there
    }

    /// The held coordinates, at their present values.
    pub fn held(&self) -> Held<f64> {
        self.held_but(&[])
    }

    fn held_but(&self, released: &[Coordinate]) -> Held<f64> {
        let kept = self.driven.iter().filter(|of| !released.contains(of));
        let kept: Vec<Coordinate> = kept.copied().collect();
        let question = system::Question::locking(&self.mechanism, &kept, &self.at);
        Still::beside(&self.still, question.held())
    }

    /// The coordinates that can be moved: those that are held.
    pub fn driven(&self) -> &[Coordinate] {
        &self.driven
    }

    /// The question that holds the held coordinates at their present values.
    pub fn question(&self) -> Question {
        let name = |coordinate: &Coordinate| coordinate.name(&self.mechanism);
        let joints = (0..self.mechanism.joints().len()).map(Coordinate::Joint);
        let free = joints.filter(|joint| !self.driven.contains(joint));
        let asked = Question::new(self.mechanism.clone()).free("actuated");
        let asked = self.driven.iter().fold(asked, |asked, coordinate| {
            asked.hold(name(coordinate), coordinate.of(&self.mechanism, &self.at))
        });
        free.fold(asked, |asked, joint| {
            asked.guess(name(&joint), joint.of(&self.mechanism, &self.at))
        })
    }

    /// Moves held coordinates together to these values, in m or rad, as far as the branch and the limits allow. At a
    /// dead point, and where branches cross, the mechanism stops just before it.
    pub fn move_to(&mut self, targets: &[(Coordinate, f64)], watch: &Watch) -> SweepReport {
        let inputs = targets.iter().map(|&(coordinate, to)| Driven {
            coordinate,
            from: coordinate.of(&self.mechanism, &self.at),
            to,
        });
        let moves = |input: &Driven| {
            let size = input
                .coordinate
                .scale(&self.mechanism)
                .max(input.from.abs());
            (input.to - input.from).abs() > ROUNDING * size
        };
        let inputs: Vec<Driven> = inputs.filter(moves).collect();
        if inputs.is_empty() {
            return SweepReport {
                rows: 1,
                ..SweepReport::of(&self.mechanism, &[], SweepEnd::Complete)
            };
        }
        let (report, end) = self.moved(&inputs, watch);
        let leaves = |ending| matches!(ending, SweepEnd::Complete | SweepEnd::Limit);
        if !leaves(report.ending)
            && let Some(from) = self.regular.take()
            && from != self.at
        {
            // too near to a dead point to tell its branches apart: back to the one on which it came
            let mut back = Steering {
                at: from,
                ..self.clone()
            };
            let again = back.move_to(targets, watch);
            if leaves(again.ending) {
                *self = back;
                return again;
            }
        }
        self.stopped = None;
        let part = report.met.last().and_then(|met| met.part).unwrap_or(0.0);
        match report.ending {
            SweepEnd::Complete | SweepEnd::Limit => {
                self.at = end;
                self.regular = Some(self.at.clone());
            }
            SweepEnd::Fold | SweepEnd::Crossing => {
                let size = |input: &Driven| {
                    (input.to - input.from).abs() / input.coordinate.scale(&self.mechanism)
                };
                let size = inputs.iter().map(size).fold(0.0, f64::max);
                // a long step sees the end and the dead point behind it as one: from farther away it does not
                let mut before = BEFORE / size;
                while before < part {
                    let nearer = inputs.iter().map(|input| Driven {
                        to: input.at(part - before),
                        ..*input
                    });
                    let (nearer, end) = self.moved(&nearer.collect::<Vec<_>>(), watch);
                    if nearer.ending == SweepEnd::Complete {
                        self.at = end;
                        break;
                    }
                    before *= 10.0;
                }
                self.stopped = Some(end);
            }
            _ => {}
        }
        report
    }

    fn moved(&self, inputs: &[Driven], watch: &Watch) -> (SweepReport, Configuration<f64>) {
        let settings = SweepSettings {
            steps: 1,
            ..SweepSettings::default()
        };
        let moved: Vec<Coordinate> = inputs.iter().map(|input| input.coordinate).collect();
        let held = self.held_but(&moved);
        let mut end = self.at.clone();
        let mut last = |row: &Row| end.clone_from(row.configuration);
        let report = sweep(
            &self.mechanism,
            &held,
            inputs,
            &self.at,
            &settings,
            &mut last,
            watch,
        );
        (report, end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector3;
    use crate::mechanism::Point;

    fn four_bar() -> Question {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/four_bar.ron");
        Question::new(Mechanism::load(file).unwrap())
    }

    /// The rocker of a crank-rocker, driven, locks where crank and coupler are in line: cos φ₁ there by the law of cosines
    /// on l0 = 5, l3 = 4 and l1 + l2 = 4 or l2 − l1 = 2.
    #[test]
    fn a_driven_rocker_stops_before_its_dead_points_and_comes_back() {
        let watch = &Watch::none();
        let asked = four_bar().free("theta1").hold("phi1", "129 deg");
        let mut steering = asked.steering(watch).unwrap();
        let [driven] = *steering.driven() else {
            panic!("one coordinate is held")
        };
        let begin = steering.at().clone();
        let side = |at: &Configuration<f64>| at.joints[1].sin().signum();
        for sum in [4.0_f64, 2.0] {
            let cosine: f64 = (25.0 + 16.0 - sum * sum) / 40.0;
            let dead = std::f64::consts::PI - cosine.acos();
            let way = (dead - begin.joints[2]).signum();
            let report = steering.move_to(&[(driven, begin.joints[2] + 2.0 * way)], watch);
            assert_eq!(report.ending, SweepEnd::Fold);
            let there = steering.at().joints[2];
            assert!((there - dead).abs() < 2e-3, "{there} is not {dead}");
            assert!((dead - there) * way > 0.0, "it stops before the dead point");
            assert_eq!(side(steering.at()), side(&begin));
            // further on there is nothing, and the way back leads to where it began
            let again = steering.move_to(&[(driven, begin.joints[2] + 3.0 * way)], watch);
            assert_eq!(again.ending, SweepEnd::Fold);
            let back = steering.move_to(&[(driven, begin.joints[2])], watch);
            assert_eq!(back.ending, SweepEnd::Complete);
            for (a, b) in steering.at().joints.iter().zip(&begin.joints) {
                assert!((a - b).abs() < 1e-9, "{a} is not {b}");
            }
        }
    }

    #[test]
    fn a_point_is_pulled_to_where_the_crank_can_bring_it() {
        let watch = &Watch::none();
        let mut steering = four_bar().steering(watch).unwrap();
        let frame = steering.mechanism().frame("left.2").unwrap();
        let point = Point::from(frame);
        // the pin of the crank, pulled to 80°; it can go nowhere else
        let angle = 80_f64.to_radians();
        let to = [2.0 * angle.cos(), 2.0 * angle.sin(), 0.0];
        for _ in 0..60 {
            steering.pull(&[(point, 1.0)], to, None, watch);
        }
        let reached = steering.at().joints[0];
        assert!((reached - angle).abs() < 1e-3, "{reached} is not {angle}");
    }

    /// The rocker is held, and the pin of the crank is pulled all the way round, through both of its dead points.
    #[test]
    fn a_crank_is_pulled_through_the_dead_points_of_the_rocker_that_is_held() {
        let watch = &Watch::none();
        let asked = four_bar().free("theta1").hold("phi1", "129 deg");
        let mut steering = asked.steering(watch).unwrap();
        let point = Point::from(steering.mechanism().frame("left.2").unwrap());
        let begin = steering.at().joints[0];
        let mut crossed = 0;
        for step in 1..=72 {
            let angle = begin + f64::from(step) * 5_f64.to_radians();
            let before = steering.is_crossed();
            for _ in 0..4 {
                steering.pull(
                    &[(point, 1.0)],
                    [angle.cos(), angle.sin(), 0.0],
                    None,
                    watch,
                );
            }
            crossed += usize::from(before != steering.is_crossed());
            let reached = steering.at().joints[0];
            assert!((reached - angle).abs() < 0.02, "{reached} is not {angle}");
        }
        // a turn passes both dead points
        assert_eq!(crossed, 2);
        assert!(!steering.is_crossed());
    }

    /// The plate of a 3-RPS manipulator is pulled far down, past where its three lengths decide its pose, and back up.
    #[test]
    fn a_plate_that_is_pulled_down_comes_back() {
        let watch = &Watch::none();
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/three_rps.ron");
        let asked = Question::new(Mechanism::load(file).unwrap());
        let mut steering = asked.steering(watch).unwrap();
        let point = Point::from(steering.mechanism().frame("top").unwrap());
        let place = |steering: &Steering| point.at(steering.mechanism(), steering.at());
        let home = place(&steering);
        let down = |k: usize| home - Vector3([0.0, 0.0, 0.05 * k as f64]);
        for k in (0..16).chain((0..16).rev()) {
            for _ in 0..3 {
                steering.pull(&[(point, 1.0)], down(k).0, None, watch);
            }
        }
        for _ in 0..20 {
            steering.pull(&[(point, 1.0)], home.0, None, watch);
        }
        let missed = (place(&steering) - home).norm();
        assert!(missed < 1e-2, "it stays {missed} m away");
        // up, to where its legs end, and down again
        for k in [40, 1] {
            for _ in 0..30 {
                let to = home + Vector3([0.0, 0.0, 0.05 * f64::from(k)]);
                steering.pull(&[(point, 1.0)], to.0, None, watch);
            }
            let longest = steering.at().joints.iter().skip(1).step_by(2);
            assert!(longest.clone().all(|l| *l <= 1.2 + 1e-6));
            assert_eq!(longest.clone().any(|l| *l > 1.2 - 1e-5), k == 40);
        }
    }

    /// A platform that is held whole moves along one of its coordinates; its legs are then as long as the points they join
    /// are apart.
    #[test]
    fn a_platform_that_is_held_whole_is_moved_and_moved_again() {
        let watch = &Watch::none();
        let file = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/mechanisms/stewart_gough_6ups.ron"
        );
        let asked = Question::new(Mechanism::load(file).unwrap()).free("actuated");
        let names = ["x", "y", "z", "roll", "pitch", "yaw"].map(|c| format!("top.{c}"));
        let asked = names
            .iter()
            .fold(asked, |asked, name| asked.hold(name, "home"));
        let mut steering = asked.steering(watch).unwrap();
        let driven = steering.driven().to_vec();
        assert_eq!(driven.len(), 6);
        for (of, way) in [
            (driven[2], 0.1),
            (driven[0], 0.05),
            (driven[2], -0.05),
            (driven[5], 0.1),
        ] {
            let to = of.of(steering.mechanism(), steering.at()) + way;
            let before: Vec<f64> = driven
                .iter()
                .map(|of| of.of(steering.mechanism(), steering.at()))
                .collect();
            let report = steering.move_to(&[(of, to)], watch);
            assert_eq!(report.ending, SweepEnd::Complete);
            for (other, before) in driven.iter().zip(before) {
                let wanted = if *other == of { to } else { before };
                assert!((other.of(steering.mechanism(), steering.at()) - wanted).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn what_leaves_freedoms_or_depends_on_itself_is_put_right() {
        let watch = &Watch::none();
        let none = four_bar().free("actuated").steering(watch).unwrap();
        assert_eq!(none.driven().len(), 1);
        let both = four_bar().hold("phi1", "129 deg").steering(watch).unwrap();
        assert_eq!(both.driven().len(), 1);
    }

    #[test]
    fn what_assembles_nowhere_is_refused() {
        let watch = &Watch::none();
        let asked = four_bar().free("theta1").hold("phi1", "0 deg");
        let refused = asked.steering(watch);
        assert!(
            matches!(refused, Err(AskError::NotAssembled { .. })),
            "{refused:?}"
        );
    }
}
