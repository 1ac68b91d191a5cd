//! Continuation from home to the held values, in small steps.

use std::borrow::Cow;

use super::{Attempt, Search};
use crate::geometry::Quaternion;
use crate::mechanism::{Configuration, PlatformPose};
use crate::number::real;
use crate::solve::{NewtonReport, Stop};
use crate::system::HeldPlatform;

impl Search<'_> {
    /// The configuration reached in the assembly mode of home, as held coordinates move from home to their values in
    /// small steps. `None` if home does not assemble, the way is too long or a step fails.
    pub(crate) fn moved_from_home(&mut self) -> Option<Attempt> {
        let home = self.mechanism.home();
        let to = self.question.start();
        // steps of at most 0.2 rad or characteristic lengths
        let steps = (self.longest_change(&home, &to) / 0.2).ceil().max(1.0);
        // a longer way is not tried
        if steps > 64.0 {
            return None;
        }
        // copied only where targets move
        let mut system = Cow::Borrowed(&self.system);
        let mut at = home.clone();
        let mut taken = 0;
        for k in 0..=steps as usize {
            let share = k as f64 / steps;
            for i in (0..home.joints.len()).filter(|&i| self.held.joints[i]) {
                at.joints[i] = between(home.joints[i], to.joints[i], share);
            }
            for (i, held) in self.held.platforms.iter().enumerate() {
                let (home, to) = (&home.platforms[i], &to.platforms[i]);
                if *held == HeldPlatform::Pose {
                    at.platforms[i] = pose_between(home, to, share);
                }
                for &(coordinate, value) in held.coordinates() {
                    let value = self.system.about_centre(coordinate, value);
                    let value = between(coordinate.of(&home.pose()), value, share);
                    system
                        .to_mut()
                        .set_target_about_centre(i, coordinate, value);
                }
            }
            let mut trial = at.clone();
            let report = (self.newton).solve(&*system, &mut at, &mut trial, &mut self.work);
            taken += report.steps;
            if report.stop != Stop::Solved {
                return None;
            }
            if share == 1.0 {
                let steps = taken;
                let report = NewtonReport { steps, ..report };
                return Some(Attempt { at, report });
            }
        }
        None
    }

    /// Largest change of a held coordinate, in rad or characteristic lengths.
    fn longest_change(&self, home: &Configuration<f64>, to: &Configuration<f64>) -> f64 {
        let length = self.mechanism.characteristic_length();
        let mut longest: f64 = 0.0;
        for i in (0..home.joints.len()).filter(|&i| self.held.joints[i]) {
            let change = (to.joints[i] - home.joints[i]).abs() / self.system.joint_scale(i);
            longest = longest.max(change);
        }
        for (i, held) in self.held.platforms.iter().enumerate() {
            let (home, to) = (&home.platforms[i], &to.platforms[i]);
            for (coordinate, value) in held.coordinates() {
                let scale = if coordinate.is_angle() {
                    1.0
                } else {
                    1.0 / length
                };
                let value = self.system.about_centre(*coordinate, *value);
                longest = longest.max((value - coordinate.of(&home.pose())).abs() * scale);
            }
            if *held == HeldPlatform::Pose {
                let shift = (to.position - home.position).norm() / length;
                let cos = home.orientation.half_cosine(&to.orientation);
                longest = longest.max(shift).max(2.0 * real::acos(cos.abs().min(1.0)));
            }
        }
        longest
    }
}

/// The value itself at the end, without rounding.
fn between(from: f64, to: f64, share: f64) -> f64 {
    match share {
        1.0 => to,
        _ => from + share * (to - from),
    }
}

/// The pose on the way, turned along the shorter arc.
fn pose_between(from: &PlatformPose<f64>, to: &PlatformPose<f64>, share: f64) -> PlatformPose<f64> {
    if share == 1.0 {
        return *to;
    }
    let (a, b) = (from.orientation.0, to.orientation.0);
    let cos = from.orientation.half_cosine(&to.orientation);
    let toward = share * cos.signum();
    let mixed = std::array::from_fn(|i| (1.0 - share) * a[i] + toward * b[i]);
    PlatformPose {
        orientation: Quaternion(mixed).normalised(),
        position: from.position + (to.position - from.position).times(share),
    }
}
