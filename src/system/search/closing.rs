//! Closing a mechanism before it is analysed: published poses are often not closed.

use serde::{Deserialize, Serialize};

use super::Search;
use crate::linear::SPECTRUM_LIMIT;
use crate::mechanism::{Configuration, Mechanism};
use crate::solve::{Equations, Newton, Stop, Watch};
use crate::system::{Gap, Held, Question, QuestionError, System, check_count};

/// How far a closure of a given pose is open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

    /// Whether it is more than what a pose is rounded by when it is written down; beside a length in m.
    pub fn is_wide(&self, length: f64) -> bool {
        const ROUNDED: f64 = 1e-2;
        self.distance > ROUNDED * length || self.angle > ROUNDED
    }
}

/// How to look for the assembled configuration near the start of a question.
#[derive(Clone, Debug, PartialEq)]
pub struct Closing {
    /// The iteration that closes the mechanism.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
}

impl Default for Closing {
    fn default() -> Self {
        Closing::seeded(1)
    }
}

impl Closing {
    /// The usual way with another seed.
    pub fn seeded(seed: u64) -> Self {
        Closing {
            newton: Newton::default(),
            restarts: 40,
            seed,
        }
    }

    /// The closed mechanism, or the answer of an analysis that cannot be made without it.
    pub fn start<R>(&self, question: &Question, watch: &Watch) -> Result<Closed, Analysed<R>> {
        if let Some(large) = too_large(question.mechanism()) {
            return Err(Analysed::TooLarge(large));
        }
        let starts = (self.restarts, self.seed);
        close(question, &self.newton, starts, watch).map_err(Analysed::NotClosed)
    }

    /// The same for a question that must leave no freedom.
    ///
    /// # Errors
    /// Those of [`check_count`].
    pub fn determined<R>(
        &self,
        question: &Question,
        watch: &Watch,
    ) -> Result<Result<Closed, Analysed<R>>, QuestionError> {
        if too_large(question.mechanism()).is_none() {
            check_count(question)?;
        }
        Ok(self.start(question, watch))
    }
}

/// A mechanism closed near the pose a question starts from.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    /// The assembled configuration.
    pub configuration: Configuration<f64>,
    /// The widest gap of the file's pose; `None` if the mechanism has no closures or the question
    /// starts from other values.
    pub given: Option<WidestGap>,
    /// Whether what the question holds kept its values.
    pub kept: bool,
}

/// The answer of an analysis of assembled configurations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

    /// The same without taking it away.
    pub fn report(&self) -> Option<&R> {
        match self {
            Analysed::Closed(report) => Some(report),
            Analysed::NotClosed(_) | Analysed::TooLarge(_) => None,
        }
    }
}

/// A mechanism that does not close near the pose given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NotClosed {
    /// The mechanism's name.
    pub mechanism: String,
    /// Always false.
    pub closed: bool,
    /// The widest gap that is left at the closest approach.
    pub left: Option<WidestGap>,
    /// Names of the held coordinates.
    pub held: Vec<String>,
    /// Whether the search was stopped before all starts were made.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// A mechanism with more unknowns than singular values are computed for
/// ([`SPECTRUM_LIMIT`](crate::linear::SPECTRUM_LIMIT)).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TooLarge {
    /// The mechanism's name.
    pub mechanism: String,
    /// How many unknowns it has with nothing held.
    pub unknowns: usize,
}

/// Closes a mechanism as a question asks, the same way as for the question itself.
///
/// What is held keeps its values. If nothing was asked for beyond the file and that fails, the
/// actuated joints may move too, because the file's pose may be rounded or overdetermined.
pub fn close(
    question: &Question,
    newton: &Newton,
    (restarts, seed): (usize, u64),
    watch: &Watch,
) -> Result<Closed, NotClosed> {
    let mechanism = question.mechanism();
    let start = question.start();
    // values that were asked for move the mechanism: that says nothing about the file
    let given = match question.differs_from_home() {
        true => None,
        false => widest(mechanism, &start),
    };
    let closed = |configuration, kept| Closed {
        configuration,
        given: given.clone(),
        kept,
    };
    if !question.differs_from_home() && is_exact(mechanism, &start) {
        return Ok(closed(start, true));
    }
    let found = Search::new(question, newton).run(restarts, seed, watch);
    if found.assembles() {
        return Ok(closed(found.attempt.at, true));
    }
    if !question.differs_from_home() && !question.split_changed() {
        let nothing = Held::nothing(mechanism);
        let system = System::new(mechanism.dimensions(), &nothing);
        let (mut at, mut trial) = (start.clone(), start);
        let report = newton.solve(&system, &mut at, &mut trial, &mut system.work());
        if report.stop == Stop::Solved {
            return Ok(closed(at, false));
        }
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
    /// Names of the joints that are outside their limits.
    pub fn outside_limits(&self, mechanism: &Mechanism) -> Vec<String> {
        let outside = mechanism.outside_limits(&self.configuration.joints);
        outside
            .map(|joint| mechanism.joints()[joint].name.clone())
            .collect()
    }
}

/// What is to be said if there are more unknowns than the whole spectrum is computed for.
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

/// Below this a dimensionless closure row is rounding.
const EXACT: f64 = 1e-15;

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
