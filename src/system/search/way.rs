//! The way from home to what a question holds, in small steps.

use super::{Attempt, Search};
use crate::geometry::Quaternion;
use crate::mechanism::{Configuration, PlatformPose, PoseCoordinate};
use crate::solve::{Report, Stop};
use crate::system::HeldPlatform;

/// Longest step of anything held, in rad or characteristic lengths.
const STEP: f64 = 0.2;

/// A way of more steps leads somewhere else altogether.
const MOST: f64 = 64.0;

impl Search<'_> {
    /// Where the mechanism comes when what is held moves from home to its values: the assembly mode
    /// of home, where one long step may end in another. `None` if home does not assemble or the way
    /// is long or leads through a configuration from which Newton's method does not go on.
    pub(crate) fn moved_from_home(&self) -> Option<Attempt> {
        let home = self.mechanism.home();
        let to = self.question.start();
        let longest = self.changes(&home, &to).fold(0.0, f64::max);
        let steps = (longest / STEP).ceil().max(1.0);
        if steps > MOST {
            return None;
        }
        let mut system = self.system.clone();
        let (mut at, mut work) = (home.clone(), system.work());
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
                for &(coordinate, value) in coordinates(held) {
                    let value = between(coordinate.of(&home.pose()), value, share);
                    system.set_target(i, coordinate, value);
                }
            }
            let mut trial = at.clone();
            let report = (self.newton).solve(&system, &mut at, &mut trial, &mut work);
            taken += report.steps;
            if report.stop != Stop::Solved {
                return None;
            }
            if share == 1.0 {
                let steps = taken;
                let report = Report { steps, ..report };
                return Some(Attempt { at, report });
            }
        }
        None
    }

    /// How far each held coordinate moves, in rad or characteristic lengths.
    fn changes(
        &self,
        home: &Configuration<f64>,
        to: &Configuration<f64>,
    ) -> impl Iterator<Item = f64> {
        let length = self.mechanism.characteristic_length();
        let joints = (0..home.joints.len()).filter(|&i| self.held.joints[i]);
        let joints =
            joints.map(|i| (to.joints[i] - home.joints[i]).abs() / self.system.joint_scale(i));
        let platforms = self.held.platforms.iter().enumerate();
        let platforms = platforms.flat_map(move |(i, held)| {
            let (home, to) = (&home.platforms[i], &to.platforms[i]);
            let single = coordinates(held).iter().map(|(coordinate, value)| {
                let change = (value - coordinate.of(&home.pose())).abs();
                change
                    * if coordinate.is_angle() {
                        1.0
                    } else {
                        1.0 / length
                    }
            });
            let whole = (*held == HeldPlatform::Pose).then(|| {
                let shift = (to.position - home.position).norm() / length;
                let turn: f64 = (home.orientation.0.iter().zip(to.orientation.0))
                    .map(|(a, b)| a * b)
                    .sum();
                shift.max(2.0 * turn.abs().min(1.0).acos())
            });
            single.chain(whole).collect::<Vec<f64>>()
        });
        joints.chain(platforms).collect::<Vec<f64>>().into_iter()
    }
}

fn coordinates(held: &HeldPlatform<f64>) -> &[(PoseCoordinate, f64)] {
    match held {
        HeldPlatform::Partly { coordinates, .. } => coordinates,
        HeldPlatform::Free | HeldPlatform::Pose => &[],
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
    let cos: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let toward = share * cos.signum();
    let mixed = std::array::from_fn(|i| (1.0 - share) * a[i] + toward * b[i]);
    PlatformPose {
        orientation: Quaternion(mixed).normalised(),
        position: from.position + (to.position - from.position).times(share),
    }
}
