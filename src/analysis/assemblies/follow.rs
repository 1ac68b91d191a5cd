//! Keeping a mode's name: a real assembly followed continuously from inputs to other inputs.

use serde::{Deserialize, Serialize};

use super::AssembliesError;
use super::answer::{named_joints, real_solution};
use super::family::{C, Family, Member};
use super::report::Named;
use super::track::{ParameterHomotopy, located, polish};
use crate::mechanism::{Configuration, Mechanism, Variable};
use crate::number::Number;
use crate::solve::{Arrival, Homotopy, Progress, Stage, Stages, Tracker, Watch};
use crate::system::{Held, System};

/// Where a mode went when its inputs changed.
#[derive(Clone, Debug, PartialEq)]
pub enum Followed {
    /// It is assembled at the target inputs.
    Arrived(Configuration<f64>),
    /// It ceased to exist on the way: there it meets another mode, and beyond neither is real.
    Fold(Fold),
    /// Solutions meet there already where it starts, and its number does not tell which of them to
    /// follow.
    Meets {
        /// How many meet: 0 if it is one of infinitely many.
        multiplicity: usize,
    },
}

/// Where a mode ceases to exist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// The part of the way that was gone, from 0 to 1.
    pub fraction: f64,
    /// The inputs there: joints in rad or m, platform coordinates as `platform.x`.
    pub inputs: Named<f64>,
    /// Joint values there, rad or m.
    pub joints: Named<f64>,
    /// Whether the two modes turn back there, at a place known to the last digits. Otherwise they
    /// cross, or no more is known than that the mode cannot be followed beyond.
    pub turns_back: bool,
}

/// A mode that was not followed to the target inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LostMode {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The joint variables with their units, in the order of the file.
    pub variables: Vec<Variable>,
    /// The number of the mode at home.
    pub mode: usize,
    /// Why it was not.
    #[serde(flatten)]
    pub reason: LostReason,
}

/// Why a mode was not followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
        /// How many meet: 0 if it is one of infinitely many.
        multiplicity: usize,
    },
}

impl Followed {
    /// The configuration at the target inputs, or why there is none.
    ///
    /// # Errors
    /// If the mode was not followed to the inputs.
    pub fn arrived(
        self,
        mechanism: &Mechanism,
        mode: usize,
    ) -> Result<Configuration<f64>, Box<LostMode>> {
        let reason = match self {
            Followed::Arrived(at) => return Ok(at),
            Followed::Fold(fold) if fold.turns_back => LostReason::Ceases(fold),
            Followed::Fold(fold) => LostReason::MeetsOthers(fold),
            Followed::Meets { multiplicity } => LostReason::MeetAtHome { multiplicity },
        };
        Err(Box::new(LostMode {
            mechanism: mechanism.name().into(),
            variables: Variable::joints(mechanism),
            mode,
            reason,
        }))
    }
}

/// Follows an assembled configuration along the straight way between two sets of inputs.
pub(super) fn follow(
    mechanism: &Mechanism,
    family: &Family,
    from: (&Configuration<f64>, &Held<f64>),
    to: (&Configuration<f64>, &Held<f64>),
    watch: &Watch,
) -> Result<Followed, AssembliesError> {
    let c = &family.coordinates;
    let start = c.inputs(from.0, from.1);
    let mut end = c.inputs(to.0, to.1);
    for q in c.input_quaternions() {
        // of q and −q the one on this side: the short way round
        let along: f64 = (0..4).map(|i| start[q + i] * end[q + i]).sum();
        if along < 0.0 {
            end[q..q + 4].iter_mut().for_each(|x| *x = -*x);
        }
    }
    let member = |inputs: &[f64]| Member {
        parameters: family.parameters.clone(),
        inputs: inputs.iter().map(|x| C::from_f64(*x)).collect(),
    };
    let homotopy = family.homotopy(&member(&start), &member(&end));
    let mut homotopy = homotopy.ok_or(AssembliesError::NoValue)?;
    let mut x = c.flatten(&from.0.map(C::from_f64));
    let whole = (C::from_f64(0.0), C::from_f64(1.0));
    // real inputs keep every number real, so no step can leave the real branch unnoticed
    let tracker = Tracker {
        shortest: 1e-12,
        max_steps: 20_000,
        ..Tracker::default().tightened(0.05)
    };
    let mut stages = Stages::new(c.count(), (watch, Progress::of(Stage::Paths)));
    let track = tracker.track(&mut Assembled(&mut homotopy), whole, &mut x, &mut stages);
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
    let inputs: Vec<f64> = start
        .iter()
        .zip(&end)
        .map(|(a, b)| a + done * (b - a))
        .collect();
    if arrived {
        let system = System::new(mechanism.dimensions(), to.1);
        let point = real_solution(&x, false, c, &system, &mut system.work(), to.0);
        let mut point = point.ok_or(AssembliesError::Undecided)?;
        for (j, value) in point.joints.iter_mut().enumerate() {
            *value = mechanism.by_limits(j, *value);
        }
        return Ok(Followed::Arrived(point));
    }
    let mut last = from.0.map(C::from_f64);
    c.unflatten(&x, &mut last);
    for (&j, value) in c.held_joints.iter().zip(&inputs) {
        last.joints[j] = C::from_f64(*value);
    }
    Ok(Followed::Fold(Fold {
        fraction: done,
        inputs: Named(
            input_names(mechanism, family)
                .into_iter()
                .zip(inputs)
                .collect(),
        ),
        joints: named_joints(mechanism, &last.map(|z| z.re)),
        turns_back,
    }))
}

/// A homotopy that is left where the closures open.
///
/// Beyond a fold nothing closes, but where the Jacobian is singular the least-squares step takes no
/// notice of the gap that is left: without this, a path may go on through configurations that are
/// singular instead of assembled.
struct Assembled<'w, 'f>(&'w mut ParameterHomotopy<'f>);

impl Homotopy for Assembled<'_, '_> {
    fn settle(&self, x: &mut [C]) {
        self.0.settle(x);
    }

    fn velocity(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        self.0.velocity(s, x, out)
    }

    fn velocity_again(&mut self, s: C, x: &[C], out: &mut [C]) -> bool {
        self.0.velocity_again(s, x, out)
    }

    fn correct(&mut self, s: C, x: &mut [C]) -> f64 {
        /// A gap is that much larger than a step that leaves it open; slopes are near 1.
        const UNSEEN: f64 = 1e3;
        /// What rounding leaves of a gap.
        const ROUNDING: f64 = 1e-10;
        let gap = self.0.residual(s, x);
        let step = self.0.correct(s, x);
        match gap > ROUNDING && gap > UNSEEN * step {
            true => f64::NAN,
            false => step,
        }
    }

    fn residual(&mut self, s: C, x: &[C]) -> f64 {
        self.0.residual(s, x)
    }
}

/// Names of the flat inputs.
fn input_names(mechanism: &Mechanism, family: &Family) -> Vec<String> {
    const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];
    let c = &family.coordinates;
    let platform = |p: usize| &mechanism.platforms()[p].name;
    let mut names: Vec<String> = c
        .held_joints
        .iter()
        .map(|&j| mechanism.joints()[j].name.clone())
        .collect();
    for &p in &c.held_poses {
        let parts = QUATERNION.iter().chain(&["x", "y", "z"]);
        names.extend(parts.map(|part| format!("{}.{part}", platform(p))));
    }
    names.extend(
        c.targets
            .iter()
            .map(|&(p, coordinate)| format!("{}.{}", platform(p), coordinate.name())),
    );
    for &p in &c.orientations {
        names.extend(
            QUATERNION
                .iter()
                .map(|part| format!("{}.{part}", platform(p))),
        );
    }
    names
}
