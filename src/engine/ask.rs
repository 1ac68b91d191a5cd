//! Questions about a mechanism, posed once for every client: a program, a page, the command line.
//!
//! A [`Question`] owns all that it needs: the mechanism, what is held and what is free, where to start, which
//! coordinates move over which ranges. It is built without checks, sent anywhere and asked as often as wanted; each
//! analysis is a method, which first poses the question in full and says what is wrong with it as data
//! ([`AskError`]).

mod at_configuration;
mod circuits;
mod design;
mod error;
mod live;
mod many;
mod modes;
mod preparation;
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
mod taken;
mod workspace;

use std::sync::{Arc, OnceLock};

use rustc_hash::FxHashMap;

pub use crate::analysis::quantities::Motions;
pub use crate::description::DesignError;
pub use crate::system::{Demand, Role, Value};
pub use design::{Design, DrawnDesign};
pub use error::{AskError, Item, Unmeasured};
pub use live::{Gained, LiveReading};
pub use many::{Jacobians, Many, ManyMeasured, Unreached};
pub use modes::{Mode, Modes, Solved, Store};
pub use remedy::Remedy;
pub use schedule::{TableError, TableErrorKind};
pub use solver::{SampleAnswer, SampleForces, SolverSettings};
pub use steering::Steering;
pub use study::{Points, ScatteredPoints, Study, StudyRows, part_of, regions};
pub use study_error::StudyError;
pub use workspace::MOST_BYTES;

use crate::analysis::sweep::Schedule;
use crate::mechanism::{Configuration, Mechanism};
use crate::system;

/// Refuses random starts, or nodes that are searched, that are none or too many.
fn check_starts(given: usize) -> Result<(), AskError> {
    const MOST: usize = 1_000_000;
    match (1..=MOST).contains(&given) {
        true => Ok(()),
        false => Err(AskError::Starts { given, most: MOST }),
    }
}

/// A question about a mechanism. Every analysis refuses a question that is wrong in itself.
///
/// A fresh question holds the actuated joints at home, starts at the home configuration and moves nothing. Coordinates
/// are named as for [`system::Question`]; values are numbers in m and rad, or texts as in the file ([`Value`]).
#[derive(Clone)]
pub struct Question {
    mechanism: Arc<Mechanism>,
    demands: Vec<Demand>,
    near: Option<Configuration<f64>>,
    mode: Mode,
    seed: u64,
    schedule: Option<Schedule>,
    store: Option<Arc<dyn Store>>,
    /// The mechanism with coordinates of the points that are named, measured; made when the question is asked.
    ready: OnceLock<Arc<Mechanism>>,
}

/// Methods that add a demand of a role, each with the name and the values that it takes.
macro_rules! demands {
    ($($(#[$doc:meta])* $method:ident($name:ident $(, $value:ident)*) = $Role:ident;)+) => {
        impl Question {$(
            $(#[$doc])*
            pub fn $method(self, $name: impl Into<String> $(, $value: impl Into<Value>)*) -> Self {
                let values = Vec::<Value>::from([$($value.into()),*]);
                self.demand(Demand::new(Role::$Role, $name, values))
            }
        )+}
    };
}

demands! {
    /// Holds a joint, a coordinate of a platform or of a point, `left+0.5,0.2.x`, or a whole platform. What is freed is
    /// freed first: `actuated` may be free and one actuated joint held.
    hold(name, value) = Hold;
    /// Lets a joint be solved for; `actuated` frees all actuated joints.
    free(name) = Free;
    /// Starts the search at a value.
    guess(name, value) = Guess;
    /// For mobilities: makes a joint, a coordinate of a platform or a whole platform stand still where the mechanism is
    /// closed; `actuated` locks all actuated joints.
    lock(name) = Lock;
    /// Moves a coordinate over a range; for loci a side of their box, for a map a mapped coordinate.
    input(name, from, to) = Input;
    /// Adds an output of singularities: a joint, a coordinate of a platform or of a point, or a frame with its orientation.
    output(name) = Output;
    /// Adds a point ([`Point::read`](crate::mechanism::Point::read)), such as `left` or `left+0.5,0.2`: for singularities
    /// an output, for velocities one that is followed, for a motion one whose path is traced.
    point(name) = Point;
    /// Adds quantities that motions report ([`Quantity::read`](crate::mechanism::Quantity::read)): a list such as
    /// `transmission, velocity:left+1, reach=hypot(left.x, left.y)`, with names of the file's `outputs` too.
    report(list) = Report;
    /// Asks for the longest part of a motion over which a quantity stays within a tolerance, to either side, of one value.
    dwell(quantity, tolerance) = Dwell;
    /// Gives a held coordinate a rate, in m/s or rad/s.
    rate(name, value) = Rate;
    /// Gives a held coordinate an acceleration, in m/s² or rad/s².
    acceleration(name, value) = Acceleration;
    /// Applies a force (N) or a moment (N·m) along a joint variable.
    load(joint, value) = Load;
    /// Leaves out what the file says acts: `weight`, `inertia`, `springs`, `forces`, `friction`, or one of them by its name.
    without(name) = Without;
    /// Varies a parameter or a coordinate of a [`Study`] over a range.
    vary(name, from, to) = Vary;
    /// Varies a parameter or a held coordinate of a [`Study`] normally about its value, with this standard deviation.
    deviate(name, deviation) = Deviate;
}

impl Question {
    /// The file's own question: actuated joints held at home, all else to be found.
    pub fn new(mechanism: impl Into<Arc<Mechanism>>) -> Self {
        Question {
            mechanism: mechanism.into(),
            demands: Vec::new(),
            near: None,
            mode: Mode::Nearest,
            seed: 1,
            schedule: None,
            store: None,
            ready: OnceLock::new(),
        }
    }

    /// The mechanism. Coordinates of points that the question names ([`NamedPoint`](crate::mechanism::NamedPoint)), such as `left+0.5,0.2.x`, are
    /// joints of it, and its characteristic length takes account of what is held.
    pub fn mechanism(&self) -> &Arc<Mechanism> {
        self.ready.get_or_init(|| self.prepared())
    }

    /// The demands by name, in the order in which it was demanded.
    pub fn demands(&self) -> &[Demand] {
        &self.demands
    }

    /// Adds a demand by its role. Names and values are checked when the question is asked.
    pub fn demand(mut self, demand: Demand) -> Self {
        self.add(demand);
        self
    }

    /// Adds a demand to a question that exists.
    pub fn add(&mut self, demand: Demand) {
        let demand = self.led(demand);
        self.demands.push(demand);
        self.ready = OnceLock::new();
    }

    /// Starts the search at a whole configuration, such as that of a mode; held coordinates keep their values.
    pub fn near(mut self, at: Configuration<f64>) -> Self {
        self.near = Some(at);
        self
    }

    /// Chooses one of several assemblies.
    pub fn mode(mut self, mode: Mode) -> Self {
        self.mode = mode;
        self
    }

    /// Seed of everything random. Where several assemblies exist it may decide which of them is found.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Applies a force (N) and a moment (N·m) at a point, in ground.
    pub fn wrench(self, frame: impl Into<String>, force: [f64; 3], moment: [f64; 3]) -> Self {
        let components = [force, moment].concat().into_iter().map(Value::Number);
        self.demand(Demand::new(Role::Wrench, frame, components))
    }

    /// Keeps generic solutions where they are found again.
    pub fn store(mut self, store: Arc<dyn Store>) -> Self {
        self.store = Some(store);
        self
    }

    /// The demands of a role, in their order.
    fn of(&self, role: Role) -> impl Iterator<Item = (Item, &Demand)> {
        let all = self.demands.iter().enumerate();
        let of_role = all.filter(move |(_, demand)| demand.role == role);
        of_role.map(|(index, demand)| (Item::new(index), demand))
    }

    fn has(&self, role: Role) -> bool {
        self.of(role).next().is_some()
    }

    /// The demands of a role, which names no two of them.
    fn distinct(&self, role: Role) -> Result<Vec<(Item, &Demand)>, AskError> {
        let all: Vec<_> = self.of(role).collect();
        let mut known = FxHashMap::default();
        for (item, demand) in &all {
            if let Some(first) = known.insert(&demand.name, *item) {
                return Err(AskError::Twice {
                    item: *item,
                    first,
                    name: demand.name.clone(),
                });
            }
        }
        Ok(all)
    }

    /// Refuses every mode at once where an analysis is of one.
    fn one_mode(&self) -> Result<(), AskError> {
        match self.mode {
            Mode::All => Err(AskError::AllModes),
            Mode::Nearest | Mode::Number(_) => Ok(()),
        }
    }

    /// The question without some demands, about the same mechanism.
    pub fn keeping(&self, keep: impl Fn(&Demand) -> bool) -> Question {
        self.mechanism();
        let mut asked = self.clone();
        asked.demands.retain(keep);
        asked
    }

    /// A demand on a joint in place of one on an output that follows it, at the values where the joint has these.
    /// Wrong values are refused when the question is asked.
    fn led(&self, demand: Demand) -> Demand {
        let Some(follower) = self.mechanism.follower(&demand.name) else {
            return demand;
        };
        if !matches!(demand.role, Role::Hold | Role::Guess | Role::Input) {
            return demand;
        }
        let plain = system::Question::new(&self.mechanism);
        let numbers = demand.values.iter().map(|value| {
            let read = plain.value(&demand.name, value);
            read.ok().map(|(_, number)| Value::Number(number))
        });
        match numbers.collect() {
            Some(values) => Demand {
                name: self.mechanism.joints()[follower.joint].name.clone(),
                values,
                ..demand
            },
            None => demand,
        }
    }

    /// Resolves the held, free and guessed coordinates.
    ///
    /// # Errors
    /// If a name or a value is wrong, or two demands contradict one another.
    pub fn resolved(&self) -> Result<system::Question<'_>, AskError> {
        self.resolve(system::Question::new(self.mechanism()))
    }

    /// The held, free and guessed coordinates where actuated joints are held only if that is asked for.
    fn released(&self) -> Result<system::Question<'_>, AskError> {
        let released = system::Question::new(self.mechanism()).free("actuated");
        self.resolve(released.map_err(AskError::Question)?)
    }

    /// Frees first, so that one joint of several that are free can be held.
    fn resolve<'q>(
        &self,
        mut question: system::Question<'q>,
    ) -> Result<system::Question<'q>, AskError> {
        for role in [Role::Free, Role::Hold, Role::Guess] {
            for (item, demand) in self.of(role) {
                let name = &demand.name;
                let put = match role {
                    Role::Hold => question.hold(name, demand.value(0)),
                    Role::Guess => question.guess(name, demand.value(0)),
                    _ => question.free(name),
                };
                question = put.map_err(item.wrong(AskError::Named))?;
            }
        }
        Ok(match &self.near {
            Some(at) => {
                let at = question.mechanism().completed(&self.mechanism, at);
                question.near(&at)
            }
            None => question,
        })
    }
}
