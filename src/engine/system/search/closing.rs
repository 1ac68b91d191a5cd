//! Closing a mechanism before it is analysed: published poses are often not closed.

use serde::{Deserialize, Serialize};

use super::{RESTARTS, Search};
use crate::algebra::SiUnit;
use crate::linear::SPECTRUM_LIMIT;
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::real;
use crate::number::tolerance::{EXACT, ROUNDING};
use crate::solve::{Equations, Newton, Watch};
use crate::system::{Gap, Held, Question, QuestionError, System, check_count};

/// The closure with the widest gap at a given pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WidestGap {
    /// Name of the closure.
    pub closure: String,
    /// Distance in m.
    pub distance: f64,
    /// Angle in rad.
    pub angle: f64,
}

impl WidestGap {
    /// The larger of distance over the characteristic length and angle.
    pub fn size(&self, mechanism: &Mechanism) -> f64 {
        (self.distance / mechanism.characteristic_length()).max(self.angle)
    }

    /// True if the gap is wider than the rounding of written poses explains: over 1 % of a length (m), or 0.01 rad.
    pub fn is_wide(&self, length: f64) -> bool {
        self.distance > 0.01 * length || self.angle > 0.01
    }
}

/// Settings of the search for the assembled configuration near the start of a question.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblySettings {
    /// The iteration that closes the mechanism.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
}

impl Default for AssemblySettings {
    fn default() -> Self {
        AssemblySettings::seeded(1)
    }
}

impl AssemblySettings {
    /// Default settings with another seed.
    pub fn seeded(seed: u64) -> Self {
        AssemblySettings {
            newton: Newton::default(),
            restarts: RESTARTS,
            seed,
        }
    }

    /// The closed mechanism, or the answer of an analysis that cannot be made without it.
    pub fn start<R>(&self, question: &Question, watch: &Watch) -> Result<Closed, Analysed<R>> {
        let starts = (self.restarts, self.seed);
        close(question, &self.newton, starts, watch).map_err(Analysed::NotClosed)
    }

    /// As [`AssemblySettings::start`], for a question that must leave no freedom.
    ///
    /// # Errors
    /// Those of [`check_count`].
    pub fn determined<R>(
        &self,
        question: &Question,
        watch: &Watch,
    ) -> Result<Result<Closed, Analysed<R>>, QuestionError> {
        check_count(question)?;
        Ok(self.start(question, watch))
    }
}

/// A pose that moves no more than this, in rad or characteristic lengths, is only rounded.
const SMALL: f64 = 0.1;

/// The joint or platform that moved most when a given pose was closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Moved {
    /// Its name.
    pub name: String,
    /// The unit of the distance, rad or m.
    pub unit: SiUnit,
    /// Distance it moved, in rad or m.
    pub distance: f64,
    /// The distance in rad or characteristic lengths.
    pub size: f64,
}

impl Moved {
    /// True if the given pose was only rounded: nothing moved by more than 0.1 rad or 0.1 characteristic lengths.
    pub fn is_small(&self) -> bool {
        self.size <= SMALL
    }
}

/// Correction of the given pose, for reports about the configuration closed from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GivenPose {
    /// The widest gap it had; `None` if it was assembled but for rounding.
    pub given_gap: Option<WidestGap>,
    /// The joint or platform that moved most from its guess, or from a pose of the file that was more than rounded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<Moved>,
    /// True if the coordinates held by the file kept their values when the mechanism was closed.
    pub kept: bool,
    /// Names of the joints that are outside their limits in the assembled configuration.
    pub outside_limits: Vec<String>,
}

/// A mechanism closed near the pose a question starts from.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    /// The assembled configuration.
    pub configuration: Configuration<f64>,
    /// The widest gap of the file's pose; `None` without closures or from other values.
    pub given: Option<WidestGap>,
    /// The joint or platform that moved most from its guess, or from the file's pose if that is not merely rounded.
    pub moved: Option<Moved>,
    /// True if the held coordinates kept their values.
    pub kept: bool,
}

/// The answer of an analysis of assembled configurations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Analysed<R> {
    /// The mechanism closes near the pose given; the report is about the configuration there.
    Closed(R),
    /// It has more unknowns than singular values are computed for.
    TooLarge(TooLarge),
    /// It does not close.
    NotClosed(NotClosed),
}

impl<R> Analysed<R> {
    /// The report, if there is one.
    pub fn closed(self) -> Option<R> {
        match self {
            Analysed::Closed(report) => Some(report),
            Analysed::NotClosed(_) | Analysed::TooLarge(_) => None,
        }
    }

    /// As [`Analysed::closed`], by reference.
    pub fn report(&self) -> Option<&R> {
        match self {
            Analysed::Closed(report) => Some(report),
            Analysed::NotClosed(_) | Analysed::TooLarge(_) => None,
        }
    }
}

/// A mechanism that does not close near the pose given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NotClosed {
    /// The mechanism's name.
    pub mechanism: String,
    /// Always false.
    pub closed: bool,
    /// The widest gap that is left at the closest approach.
    pub left: Option<WidestGap>,
    /// Names of the held coordinates.
    pub held: Vec<String>,
    /// True if the search was stopped before all starts were made.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// A mechanism with more unknowns than singular values are computed for
/// ([`SPECTRUM_LIMIT`](crate::linear::SPECTRUM_LIMIT)).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TooLarge {
    /// The mechanism's name.
    pub mechanism: String,
    /// Number of unknowns with nothing held.
    pub unknowns: usize,
}

/// Closes a mechanism as a question asks. Held coordinates keep their values.
///
/// Near a whole pose, which may be rounded or overdetermined, values held by the file alone may move if no assembly
/// beside it has them, and in the end however far if the file's own pose leads to no other.
pub fn close(
    question: &Question,
    newton: &Newton,
    (restarts, seed): (usize, u64),
    watch: &Watch,
) -> Result<Closed, NotClosed> {
    let mechanism = question.mechanism();
    let start = question.start();
    // values held by name move the mechanism, whatever the file's pose
    let given = match question.gives_pose() {
        true => widest(mechanism, &start),
        false => None,
    };
    let closed = |configuration: Configuration<f64>, kept| Closed {
        moved: moved(question, &configuration),
        given: given.clone(),
        configuration,
        kept,
    };
    if question.gives_pose() && is_exact(mechanism, &start) {
        return Ok(closed(start.clone(), true));
    }
    let mut search = Search::new(question, newton);
    let way = |at: &Configuration<f64>| {
        farthest(question, &start, at, None).map_or(0.0, |moved| moved.size)
    };
    let mut loose = None;
    if question.gives_pose() {
        let first = search.run(0, seed, &Watch::none());
        let with_all = match first.assembles() {
            true => way(&first.attempt.at),
            false => f64::INFINITY,
        };
        if with_all > SMALL {
            loose = with_file_loose(question, newton, &start);
        }
        if let Some(at) = &loose
            // much nearer: no farther than a tenth of the way
            && way(at) <= SMALL.min(0.1 * with_all)
        {
            return Ok(closed(at.clone(), false));
        }
    }
    let found = search.run(restarts, seed, watch);
    if found.assembles() {
        return Ok(closed(found.attempt.at, true));
    }
    if let Some(at) = loose
        && !question.differs_from_home()
    {
        return Ok(closed(at, false));
    }
    Err(NotClosed {
        mechanism: mechanism.name().to_owned(),
        closed: false,
        left: widest(mechanism, &found.attempt.at),
        held: question.held_names(),
        interrupted: watch.is_stopped(),
    })
}

impl Closed {
    /// The correction of the given pose, as reports give it.
    pub fn pose(&self, mechanism: &Mechanism) -> GivenPose {
        let given = self.given.clone();
        GivenPose {
            given_gap: given.filter(|gap| gap.size(mechanism) > ROUNDING),
            moved: self.moved.clone(),
            kept: self.kept,
            outside_limits: self.outside_limits(mechanism),
        }
    }

    /// Names of the joints that are outside their limits.
    pub fn outside_limits(&self, mechanism: &Mechanism) -> Vec<String> {
        let outside = mechanism.outside_limits(&self.configuration.joints);
        outside
            .map(|joint| mechanism.joints()[joint].name.clone())
            .collect()
    }
}

/// The assembly that a start leads to if only coordinates held by name keep their values.
fn with_file_loose(
    question: &Question,
    newton: &Newton,
    start: &Configuration<f64>,
) -> Option<Configuration<f64>> {
    if question.split_changed() {
        return None;
    }
    let held = Held {
        joints: question.joints_held_by_name().to_vec(),
        ..question.held()
    };
    System::new(question.mechanism().dimensions(), &held).solved(newton, start)
}

/// The guessed joint or platform that moved most in assembling; without guesses, the one that moved most from the
/// file's pose, if by more than rounding.
pub fn moved(question: &Question, to: &Configuration<f64>) -> Option<Moved> {
    let start = &question.start();
    let guessed = [question.guessed_joints(), question.guessed_platforms()];
    match guessed.concat().contains(&true) {
        true => farthest(question, start, to, Some(guessed)),
        false if question.gives_pose() => {
            farthest(question, start, to, None).filter(|moved| !moved.is_small())
        }
        false => None,
    }
}

/// The joint or platform that moves most between two configurations, beyond rounding and local spins; of all, or of
/// those in `among`.
fn farthest(
    question: &Question,
    from: &Configuration<f64>,
    to: &Configuration<f64>,
    among: Option<[&[bool]; 2]>,
) -> Option<Moved> {
    let mechanism = question.mechanism();
    let length = mechanism.characteristic_length();
    let moved = |name: &str, is_angle: bool, distance: f64| Moved {
        name: name.to_owned(),
        unit: SiUnit::of_coordinate(is_angle),
        distance,
        size: if is_angle {
            distance
        } else {
            distance / length
        },
    };
    let counts = |kind: usize, i: usize| among.is_none_or(|among| among[kind][i]);
    let joints = mechanism.joints().iter().enumerate();
    let joints = joints.filter(|(i, _)| counts(0, *i));
    let joints = joints.map(|(i, joint)| {
        let change = to.joints[i] - from.joints[i];
        let change = match mechanism.repeats(i) {
            true => turn_near(change, 0.0),
            false => change,
        };
        moved(&joint.name, joint.kind.is_angle(), change.abs())
    });
    let platforms = mechanism.platforms().iter().enumerate();
    let platforms = platforms.filter(|(i, _)| counts(1, *i));
    let platforms = platforms.flat_map(|(i, platform)| {
        let (a, b) = (&from.platforms[i], &to.platforms[i]);
        let shift = (b.position - a.position).norm();
        let cos = a.orientation.half_cosine(&b.orientation);
        let turn = 2.0 * real::acos(cos.abs().min(1.0));
        [
            moved(&platform.name, false, shift),
            moved(&platform.name, true, turn),
        ]
    });
    let all = joints.chain(platforms);
    let all = all.filter(|moved| moved.size > ROUNDING);
    all.max_by(|a, b| a.size.total_cmp(&b.size))
}

/// Report of a mechanism with more unknowns than singular values are computed for.
pub fn too_large(mechanism: &Mechanism) -> Option<TooLarge> {
    let unknowns = mechanism.joints().len() + 6 * mechanism.platforms().len();
    (unknowns > SPECTRUM_LIMIT).then(|| TooLarge {
        mechanism: mechanism.name().to_owned(),
        unknowns,
    })
}

/// A pose typed with expressions is exact, and no step can make it better.
fn is_exact(mechanism: &Mechanism, at: &Configuration<f64>) -> bool {
    let system = System::new(mechanism.dimensions(), &Held::nothing(mechanism));
    system.residual(at, &mut system.work()).largest <= EXACT
}

fn widest(mechanism: &Mechanism, at: &Configuration<f64>) -> Option<WidestGap> {
    let gaps = Gap::of(mechanism, at);
    let closures = mechanism.closures().iter().zip(gaps);
    let widest = closures.max_by(|(_, a), (_, b)| a.size(mechanism).total_cmp(&b.size(mechanism)));
    widest.map(|(closure, gap)| WidestGap {
        closure: closure.name.clone(),
        distance: gap.distance,
        angle: gap.angle,
    })
}
