//! Keeping a mode's name: a real assembly followed continuously from inputs to other inputs.

use serde::{Deserialize, Serialize};

use super::answer::real_solution;
use super::family::{C, Family, Input};
use super::report::ByName;
use super::track::{END, START, located, polish};
use super::{AssembliesError, AssemblySolver, Wanted};
use crate::mechanism::{Configuration, Mechanism, Variable};
use crate::number::Number;
use crate::solve::{Arrival, Progress, Stage, Stages, Tracker, Watch};
use crate::system::{Held, HeldPlatform, System};

/// The configuration at the target inputs, or the reason for which the mode was not followed to them.
pub type Followed = Result<Configuration<f64>, LostReason>;

/// A point at which a mode ceases to exist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Fold {
    /// The part of the way that was gone, from 0 to 1.
    pub fraction: f64,
    /// The inputs there: joints in rad or m, platform coordinates as `platform.x`.
    pub inputs: ByName<f64>,
    /// Joint values there, rad or m.
    pub joints: ByName<f64>,
    /// True if the two modes turn back there, at a place known to the last digits. Otherwise they
    /// cross, or no more is known than that the mode cannot be followed beyond.
    pub turns_back: bool,
}

/// A mode that was not followed to the target inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LostMode {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joint variables with their units, in the order of the file.
    pub variables: Vec<Variable>,
    /// The number of the mode at home.
    pub mode: usize,
    /// The reason.
    #[serde(flatten)]
    pub reason: LostReason,
}

/// Reasons for which a mode was not followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "outcome")]
pub enum LostReason {
    /// It ceases to exist on the way.
    #[serde(rename = "mode_ceases")]
    Ceases(Fold),
    /// It meets other assemblies on the way, and its number does not tell which of them to follow.
    #[serde(rename = "mode_meets_others")]
    MeetsOthers(Fold),
    /// Assemblies meet already at home, and its number does not tell which of them to follow.
    #[serde(rename = "modes_meet_at_home")]
    MeetAtHome {
        /// Number of assemblies that meet: 0 if it is one of infinitely many.
        multiplicity: usize,
    },
}

impl LostMode {
    /// With the names that belong to a reason.
    pub fn new(mechanism: &Mechanism, mode: usize, reason: LostReason) -> Self {
        LostMode {
            mechanism: mechanism.name().into(),
            variables: Variable::joints(mechanism),
            mode,
            reason,
        }
    }
}

impl AssemblySolver {
    /// Follows mode `mode` of the home configuration to the inputs of `asked`.
    ///
    /// # Errors
    /// If the home inputs have no such mode, or rounding hides where it went.
    pub fn follow(
        &self,
        mode: usize,
        asked: &Configuration<f64>,
        held: &Held<f64>,
        watch: &Watch,
    ) -> Result<Followed, AssembliesError> {
        let home = self.mechanism.home();
        let held_home = held_at_home(&self.mechanism, held);
        let modes = self.at_targets(
            &home,
            &held_home,
            Wanted {
                certificates: false,
                ..Wanted::default()
            },
            watch,
        );
        if modes.interrupted {
            return Err(AssembliesError::Interrupted);
        }
        let found = modes.assemblies.iter().find(|a| a.mode == mode);
        let assembly = found.ok_or(AssembliesError::NoSuchMode(modes.real))?;
        let start = assembly.configuration();
        let coordinates = &self.family.coordinates;
        let stays = coordinates.inputs_of(&home, &held_home) == coordinates.inputs_of(asked, held);
        if stays {
            return Ok(Ok(start));
        }
        if assembly.multiplicity != 1 {
            let multiplicity = assembly.multiplicity;
            return Ok(Err(LostReason::MeetAtHome { multiplicity }));
        }
        self.followed((&start, &held_home), (asked, held), watch)
    }

    /// Follows an assembled configuration along the straight way between two sets of inputs.
    fn followed(
        &self,
        from: (&Configuration<f64>, &Held<f64>),
        to: (&Configuration<f64>, &Held<f64>),
        watch: &Watch,
    ) -> Result<Followed, AssembliesError> {
        let (mechanism, family) = (&self.mechanism, &self.family);
        let c = &family.coordinates;
        let (start, mut end) = (self.member(from.0, from.1), self.member(to.0, to.1));
        let mut first = 0;
        for (input, x) in c.split(&start.inputs) {
            let to = &mut end.inputs[first..first + x.len()];
            first += x.len();
            if matches!(input, Input::Pose(_) | Input::Orientation(_)) {
                // of q and −q the one on this side: the short way round
                let along: C = x[..4].iter().zip(to.iter()).map(|(a, b)| a * b).sum();
                let sign = if along.re < 0.0 { -1.0 } else { 1.0 };
                to[..4].iter_mut().for_each(|x| *x *= sign);
            }
        }
        let homotopy = family.homotopy(&start, &end);
        let mut homotopy = homotopy.ok_or(AssembliesError::NoValue)?;
        let mut x = c.flat(from.0);
        let whole = (START, END);
        // real inputs keep every number real, so no step can leave the real branch unnoticed
        let tracker = Tracker {
            shortest: 1e-12,
            max_steps: 20_000,
            ..Tracker::default().tightened(0.05)
        };
        let mut stages = Stages::new(c.count(), (watch, Progress::of(Stage::Paths)));
        let track = tracker.track(&mut homotopy, whole, &mut x, &mut stages);
        if watch.is_stopped() {
            return Err(AssembliesError::Interrupted);
        }
        let (mut done, mut turns_back) = match track.arrival {
            Arrival::There => (1.0, false),
            Arrival::Stuck(at) | Arrival::Diverged(at) => (at, false),
        };
        let arrived = track.arrival == Arrival::There && polish(&mut homotopy, whole.1, &mut x);
        if !arrived && let Some(meeting) = located(&mut homotopy, done, &x) {
            (done, x, turns_back) = (meeting.s, meeting.x, meeting.turns_back);
        }
        let inputs = start.inputs.iter().zip(&end.inputs);
        let inputs: Vec<f64> = inputs.map(|(a, b)| a.re + done * (b.re - a.re)).collect();
        if arrived {
            let system = System::new(mechanism.dimensions(), to.1);
            let point = real_solution(&x, false, c, &system, &mut system.work(), to.0);
            let mut point = point.ok_or(AssembliesError::Undecided)?;
            for (j, value) in point.joints.iter_mut().enumerate() {
                *value = mechanism.by_limits(j, *value);
            }
            return Ok(Ok(point));
        }
        let mut last = c.placed(&x, from.0);
        for (input, value) in c.split(&inputs) {
            if let Input::Joint(j) = input {
                last.joints[j] = C::from_f64(value[0]);
            }
        }
        let names = input_names(mechanism, family).into_iter();
        let fold = Fold {
            fraction: done,
            inputs: names.zip(inputs).collect(),
            joints: mechanism.named_joints(&last.map(|z| z.re).joints),
            turns_back,
        };
        Ok(Err(match turns_back {
            true => LostReason::Ceases(fold),
            false => LostReason::MeetsOthers(fold),
        }))
    }
}

/// The held coordinates at their values at home.
fn held_at_home(mechanism: &Mechanism, held: &Held<f64>) -> Held<f64> {
    let home = mechanism.home();
    let mut held = held.clone();
    for (held, pose) in held.platforms.iter_mut().zip(&home.platforms) {
        if let HeldPlatform::Partly(parts) = held {
            let pose = mechanism.in_ground(pose);
            (parts.coordinates.iter_mut()).for_each(|(c, value)| *value = c.of(&pose));
            parts.orientation = parts.orientation.map(|_| pose.rotation);
        }
    }
    held
}

/// Names of the flat inputs.
fn input_names(mechanism: &Mechanism, family: &Family) -> Vec<String> {
    const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];
    let of_platform = |p: usize, parts: &[&str]| -> Vec<String> {
        let platform = &mechanism.platforms()[p].name;
        parts
            .iter()
            .map(|part| format!("{platform}.{part}"))
            .collect()
    };
    let names = family.coordinates.inputs.iter().map(|input| match *input {
        Input::Joint(j) => vec![mechanism.joints()[j].name.clone()],
        Input::Pose(p) => of_platform(p, &[&QUATERNION[..], &["x", "y", "z"]].concat()),
        Input::Target(p, coordinate) => of_platform(p, &[coordinate.word()]),
        Input::Orientation(p) => of_platform(p, &QUATERNION),
    });
    names.flatten().collect()
}
