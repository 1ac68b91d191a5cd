//! Questions about a mechanism, posed once for every client: a program, a page, the command line.
//!
//! A [`Question`] owns all that it needs: the mechanism, what is held and what is free, where to start, which
//! coordinates move over which ranges. It is built without checks, sent anywhere and asked as often as wanted; each
//! analysis is a method, which first poses the question in full and says what is wrong with it as data
//! ([`AskError`]).
//!
//! ```
//! use linkwork::ask::Question;
//! use linkwork::mechanism::Mechanism;
//! use linkwork::solve::Watch;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mechanism = Mechanism::load(std::path::Path::new("mechanisms/four_bar.ron"))?;
//! let question = Question::new(mechanism).hold("theta1", "60 deg");
//! let report = question.assemblies(Default::default(), &Watch::none())?;
//! assert_eq!(report.real, 2);
//! # Ok(())
//! # }
//! ```

mod at_configuration;
mod circuits;
mod error;
mod live;
mod many;
mod modes;
mod quantities;
mod ranges;
mod remedy;
mod schedule;
mod singularities;
mod solver;
mod steering;
mod study;
mod study_error;
mod sweep;
mod workspace;

use std::sync::Arc;

pub use crate::analysis::quantities::Motions;
pub use crate::system::Value;
pub use error::{AskError, Item, Role, Unmeasured};
pub use live::{Gained, Reading};
pub use many::Many;
pub use modes::{Mode, Modes, Solved, Store};
pub use remedy::Holdable;
pub use schedule::{TableError, TableErrorKind};
pub use solver::Example;
pub use steering::Steering;
pub use study::{Points, Spread, Study, StudyRows, part_of, regions};
pub use study_error::StudyError;
pub use workspace::MOST_BYTES;

use crate::analysis::sweep::Schedule;
use crate::mechanism::{Body, Configuration, Mechanism, NamedPoint};
use crate::system::{self, Coordinate};

/// Random starts where one assembly near the start is wanted.
const RESTARTS: usize = 20;

/// Refuses random starts, or nodes that are searched, that are none or too many.
fn check_starts(given: usize) -> Result<(), AskError> {
    const MOST: usize = 1_000_000;
    match (1..=MOST).contains(&given) {
        true => Ok(()),
        false => Err(AskError::Starts { given, most: MOST }),
    }
}

/// A coordinate that moves or is mapped over a range.
#[derive(Clone, Debug, PartialEq)]
struct Range {
    name: String,
    from: Value,
    to: Value,
}

/// A force and a moment at a point.
#[derive(Clone, Debug, PartialEq)]
enum Wrench {
    Numbers([f64; 3], [f64; 3]),
    Text(String),
}

/// A question about a mechanism. Every analysis refuses one that is wrong in itself.
///
/// A fresh question holds the actuated joints at home, starts at the home configuration and moves nothing. Coordinates
/// are named as for [`system::Question`]; values are numbers in m and rad, or texts as in the file ([`Value`]).
#[derive(Clone)]
pub struct Question {
    mechanism: Arc<Mechanism>,
    hold: Vec<(String, Value)>,
    free: Vec<String>,
    guess: Vec<(String, Value)>,
    near: Option<Configuration<f64>>,
    lock: Vec<String>,
    mode: Mode,
    seed: u64,
    inputs: Vec<Range>,
    schedule: Option<Schedule>,
    outputs: Vec<String>,
    points: Vec<String>,
    reports: Vec<String>,
    dwells: Vec<(String, Value)>,
    rates: Vec<(String, Value)>,
    accelerations: Vec<(String, Value)>,
    wrenches: Vec<(String, Wrench)>,
    loads: Vec<(String, Value)>,
    store: Option<Arc<dyn Store>>,
}

impl Question {
    /// The file's own question: actuated joints held at home, all else to be found.
    pub fn new(mechanism: impl Into<Arc<Mechanism>>) -> Self {
        Question {
            mechanism: mechanism.into(),
            hold: Vec::new(),
            free: Vec::new(),
            guess: Vec::new(),
            near: None,
            lock: Vec::new(),
            mode: Mode::Nearest,
            seed: 1,
            inputs: Vec::new(),
            schedule: None,
            outputs: Vec::new(),
            points: Vec::new(),
            reports: Vec::new(),
            dwells: Vec::new(),
            rates: Vec::new(),
            accelerations: Vec::new(),
            wrenches: Vec::new(),
            loads: Vec::new(),
            store: None,
        }
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Arc<Mechanism> {
        &self.mechanism
    }

    /// Holds a joint, a coordinate of a platform or of a point, `left+0.5,0.2.x`, or a whole platform. What is freed is
    /// freed first: `actuated` may be free and one actuated joint held.
    pub fn hold(mut self, name: impl Into<String>, value: impl Into<Value>) -> Self {
        let (name, [value]) = self.led(name.into(), [value.into()]);
        self.hold.push((name, value));
        self.measured()
    }

    /// Lets a joint be solved for; `actuated` frees all actuated joints.
    pub fn free(mut self, name: impl Into<String>) -> Self {
        let name = self.placed(name.into());
        self.free.push(name);
        self.measured()
    }

    /// Starts the search at a value.
    pub fn guess(mut self, name: impl Into<String>, value: impl Into<Value>) -> Self {
        let (name, [value]) = self.led(name.into(), [value.into()]);
        self.guess.push((name, value));
        self
    }

    /// Starts the search at a whole configuration, such as that of a mode; held coordinates keep their values.
    pub fn near(mut self, at: Configuration<f64>) -> Self {
        self.near = Some(at);
        self
    }

    /// For mobilities: makes a joint, a coordinate of a platform or a whole platform stand still where the mechanism is
    /// closed; `actuated` locks all actuated joints.
    pub fn lock(mut self, name: impl Into<String>) -> Self {
        let name = self.placed(name.into());
        self.lock.push(name);
        self
    }

    /// Chooses among several assemblies.
    pub fn mode(mut self, mode: Mode) -> Self {
        self.mode = mode;
        self
    }

    /// Seed of everything random. Where several assemblies exist it may decide which of them is found.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Moves a coordinate over a range; for loci a side of their box, for a map a mapped coordinate.
    pub fn input(
        mut self,
        name: impl Into<String>,
        from: impl Into<Value>,
        to: impl Into<Value>,
    ) -> Self {
        let (name, [from, to]) = self.led(name.into(), [from.into(), to.into()]);
        self.inputs.push(Range { name, from, to });
        self.measured()
    }

    /// Adds an output of singularities: a joint, a coordinate of a platform or of a point, or a frame with its orientation.
    pub fn output(mut self, name: impl Into<String>) -> Self {
        let name = self.placed(name.into());
        self.outputs.push(name);
        self
    }

    /// Adds a point ([`Point::read`](crate::mechanism::Point::read)), such as `left` or `left+0.5,0.2`: for singularities
    /// an output, for velocities one that is followed, for a motion one whose path is traced.
    pub fn point(mut self, name: impl Into<String>) -> Self {
        self.points.push(name.into());
        self
    }

    /// Adds quantities that motions report ([`Quantity::read`](crate::mechanism::Quantity::read)): a list such as
    /// `transmission, velocity:left+1, reach=hypot(left.x, left.y)`, with names of the file's `outputs` too.
    pub fn report(mut self, list: impl Into<String>) -> Self {
        self.reports.push(list.into());
        self
    }

    /// Asks for the longest part of a motion over which a quantity stays within a tolerance, to either side, of one value.
    pub fn dwell(mut self, quantity: impl Into<String>, tolerance: impl Into<Value>) -> Self {
        self.dwells.push((quantity.into(), tolerance.into()));
        self
    }

    /// Gives a held coordinate a rate, in m/s or rad/s.
    pub fn rate(mut self, name: impl Into<String>, value: impl Into<Value>) -> Self {
        let name = self.placed(name.into());
        self.rates.push((name, value.into()));
        self
    }

    /// Gives a held coordinate an acceleration, in m/s² or rad/s².
    pub fn acceleration(mut self, name: impl Into<String>, value: impl Into<Value>) -> Self {
        let name = self.placed(name.into());
        self.accelerations.push((name, value.into()));
        self
    }

    /// Applies a force (N) and a moment (N·m) at a point, in ground.
    pub fn wrench(mut self, frame: impl Into<String>, force: [f64; 3], moment: [f64; 3]) -> Self {
        let wrench = Wrench::Numbers(force, moment);
        self.wrenches.push((frame.into(), wrench));
        self
    }

    /// Applies a wrench given as `Fx,Fy,Fz` or `Fx,Fy,Fz,Mx,My,Mz`, with expressions as in the file.
    pub fn wrench_text(mut self, frame: impl Into<String>, text: impl Into<String>) -> Self {
        let wrench = Wrench::Text(text.into());
        self.wrenches.push((frame.into(), wrench));
        self
    }

    /// Applies a force (N) or a moment (N·m) along a joint variable.
    pub fn load(mut self, joint: impl Into<String>, value: impl Into<Value>) -> Self {
        self.loads.push((joint.into(), value.into()));
        self
    }

    /// Keeps generic solutions where they are found again.
    pub fn store(mut self, store: Arc<dyn Store>) -> Self {
        self.store = Some(store);
        self
    }

    /// A name of a coordinate with values. An output that follows a joint is that joint, at the values where it has
    /// these. Errors in values are reported when the question is asked.
    fn led<const N: usize>(&mut self, name: String, values: [Value; N]) -> (String, [Value; N]) {
        let name = self.placed(name);
        let Some(follower) = self.mechanism.follower(&name) else {
            return (name, values);
        };
        let plain = system::Question::new(&self.mechanism);
        let numbers = values
            .each_ref()
            .map(|value| plain.value(&name, value).ok());
        match numbers.iter().all(Option::is_some) {
            true => {
                let leader = self.mechanism.joints()[follower.joint].name.clone();
                (leader, numbers.map(|of| of.map_or(0.0, |(_, x)| x).into()))
            }
            false => (name, values),
        }
    }

    /// A name of a coordinate. That of a point ([`NamedPoint`]), `left+0.5,0.2.x`, becomes a joint of the mechanism.
    fn placed(&mut self, name: String) -> String {
        let plain = system::Question::new(&self.mechanism);
        if plain.coordinates(&name).is_err()
            && let Some((point, "x" | "y" | "z")) = name.rsplit_once('.')
            && let Ok(point) = NamedPoint::read(&self.mechanism, point)
            && self.mechanism.body(point.point.frame) != Body::Ground
        {
            self.mechanism = self.mechanism.with_coordinates_of(&point).into();
        }
        name
    }

    /// Measures the mechanism by its dimensions and by the held lengths. Errors in values are reported when the
    /// question is asked.
    fn measured(mut self) -> Self {
        if let Some(measured) =
            (self.given_lengths()).and_then(|held| self.mechanism.measured_by(&held))
        {
            self.mechanism = Arc::new(measured);
        }
        self
    }

    /// The lengths that are held or that inputs go through, in m, if there is nothing wrong with them.
    fn given_lengths(&self) -> Option<Vec<f64>> {
        let plain = system::Question::new(&self.mechanism);
        let mut inputs = Vec::new();
        for range in &self.inputs {
            let (coordinate, from) = plain.value(&range.name, &range.from).ok()?;
            let (_, to) = plain.value(&range.name, &range.to).ok()?;
            inputs.push((coordinate, [from, to]));
        }
        // where coordinates of platforms move, actuated joints are held only if that is asked for
        let released = inputs
            .iter()
            .any(|(c, _)| ranges::of_platform(&self.mechanism, c));
        let question = match released {
            true => self.released().ok()?,
            false => self.resolved().ok()?,
        };
        let moved = inputs.iter().fold(question, |q, (c, _)| q.without(*c));
        let lengths = inputs.iter().filter(|(c, _)| !c.is_angle(&self.mechanism));
        let own = |(of, ends): &(Coordinate, [f64; 2])| {
            ends.map(|end| of.own_length(&self.mechanism, end))
        };
        let mut lengths: Vec<f64> = lengths.flat_map(own).collect();
        lengths.extend(moved.held_lengths());
        Some(lengths)
    }

    /// Resolves the held, free and guessed coordinates.
    ///
    /// # Errors
    /// If a name or a value is wrong, or two demands contradict one another.
    pub fn resolved(&self) -> Result<system::Question<'_>, AskError> {
        self.put(system::Question::new(&self.mechanism))
    }

    /// As [`Question::resolved`], with the actuated joints held only if that is asked for.
    fn released(&self) -> Result<system::Question<'_>, AskError> {
        let released = system::Question::new(&self.mechanism).free("actuated");
        self.put(released.map_err(AskError::Question)?)
    }

    /// Puts the demands to a question: first what is freed, so that one joint of several that are free can be held.
    fn put<'q>(
        &self,
        mut question: system::Question<'q>,
    ) -> Result<system::Question<'q>, AskError> {
        for (index, name) in self.free.iter().enumerate() {
            question = (question.free(name)).map_err(Role::Free.named(index))?;
        }
        for (index, (name, value)) in self.hold.iter().enumerate() {
            question = (question.hold(name, value)).map_err(Role::Hold.named(index))?;
        }
        for (index, (name, value)) in self.guess.iter().enumerate() {
            question = (question.guess(name, value)).map_err(Role::Guess.named(index))?;
        }
        Ok(match &self.near {
            Some(at) => question.near(at),
            None => question,
        })
    }
}
