//! Every assembled configuration for held inputs, each with a certificate.
//!
//! The mechanism's inputs are made complex and generic; there all solutions are found once
//! ([`GenericSolutions`]) and then carried, as many paths as solutions, to any target inputs
//! for ([`AssemblySolver::at`]).
//!
//! Assemblies are numbered by their unknown coordinates at the target inputs: ascending by the first
//! unknown joint of the file, then the second and so on, then by position and quaternion of the
//! platforms; angles lie in (−π, π]. Nothing random enters. A mode keeps its name when it is
//! followed from home ([`AssemblySolver::follow`]).

mod answer;
mod family;
mod follow;
mod proof;
mod report;
mod search;
mod track;

pub use follow::{Fold, Followed, LostMode, LostReason};
pub use proof::prove;
pub use report::{
    AssembliesReport, Assembly, ByName, ClosestApproach, ComplexAssembly, Continuum, Fit,
    GenericSearch, ListedJoint, Part, PoseReport, Proof, Range, Unfit,
};
pub use search::{GenericSolutions, StoredError};

use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::Number;
use crate::solve::{Pruning, Watch};
use crate::system::{Held, Neighbourhood, Still, System, sets_of_angles};
use answer::{TargetProblem, grouped};
use family::{C, Family, KnownBound, Member};
use search::question;

/// Settings of the search for generic solutions.
#[derive(Clone, Debug, PartialEq)]
pub struct AssembliesSettings {
    /// The random seed of starts and paths. The list of assemblies does not depend on it unless solutions are missed.
    pub seed: u64,
    /// Seeds that must meet only known solutions before the search ends.
    pub quiet_seeds: usize,
    /// Independent loops that must lead to nothing new, and lose no path, before the search ends.
    pub quiet_loops: usize,
    /// Seeds never exceeded.
    pub most_seeds: usize,
    /// Loops never exceeded.
    pub most_loops: usize,
}

impl Default for AssembliesSettings {
    fn default() -> Self {
        AssembliesSettings {
            seed: 1,
            quiet_seeds: 150,
            quiet_loops: 20,
            most_seeds: 5000,
            most_loops: 200,
        }
    }
}

/// Results worked out for each question besides the solutions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Interval certificates.
    pub certificates: bool,
    /// The complex solutions that are not real.
    pub all_complex: bool,
    /// A search from other starts for solutions that no path leads to: sets of infinitely many assemblies apart
    /// from all others, and assemblies that were missed.
    pub starts: bool,
    /// A proof that the real assemblies are all that there are.
    pub proof: Option<Pruning>,
}

impl Default for Wanted {
    fn default() -> Self {
        Wanted {
            certificates: true,
            all_complex: false,
            starts: true,
            proof: None,
        }
    }
}

/// Errors of a search for assemblies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AssembliesError {
    /// An expression has no value near the mechanism's own dimensions.
    #[error("an expression has no value near the mechanism's own dimensions")]
    NoValue,
    /// The stored solutions belong to other dimensions or to another choice of inputs.
    #[error("the stored solutions belong to other dimensions or to another choice of inputs")]
    StoredForAnotherQuestion,
    /// No assembly has that number; there are this many.
    #[error("{}", no_such_mode(*.0))]
    NoSuchMode(usize),
    /// The mode was followed to the target inputs, where double precision does not tell whether
    /// it is assembled.
    #[error(
        "the mode was followed to the inputs asked for, but is so near a singular configuration \
         there that double precision does not tell whether it is assembled: hold values a little \
         farther from it (a pitch farther from 90 deg, if one is held) or hold other coordinates"
    )]
    Undecided,
    /// The work was stopped before the mode was found.
    #[error("interrupted before the mode was found")]
    Interrupted,
}

fn no_such_mode(modes: usize) -> String {
    match modes {
        0 => "there is no assembly at the home inputs for a mode to be followed from: \
              `linkwork assemblies` lists those at the inputs in question, and \
              a guess starts the search near one of them"
            .into(),
        n => format!("there is no such mode: the home inputs have modes 1 to {n}"),
    }
}

/// All generic solutions of one mechanism for one choice of inputs, ready for many values of them.
#[derive(Clone, Debug)]
pub struct AssemblySolver {
    mechanism: Mechanism,
    held: Held<f64>,
    family: Family,
    bound: Option<KnownBound>,
    generic: GenericSolutions,
    interrupted: bool,
}

impl AssemblySolver {
    /// Finds the generic solutions. Only which coordinates `held` holds matters, not their values.
    ///
    /// # Errors
    /// If a dimension has no value near the mechanism's own.
    pub fn new(
        mechanism: &Mechanism,
        held: &Held<f64>,
        settings: &AssembliesSettings,
        watch: &Watch,
    ) -> Result<Self, AssembliesError> {
        let mechanism = &mechanism.level();
        let searched = |family: Family| {
            let bound = family::known_bound(mechanism, &family);
            let count = bound.as_ref().map(|bound| bound.count);
            let question = question(mechanism, &family);
            let generic = search::search(&family, question, count, settings, watch);
            Some((family, bound, generic?))
        };
        let mut found = searched(Family::new(mechanism, held));
        if let Some((.., generic)) = &found
            && generic.search.multiple > 0
            && generic.freedom == 0
            && let Some(wider) = Family::wider(mechanism, held).and_then(searched)
            && wider.2.search.multiple == 0
        {
            found = Some(wider);
        }
        let (family, bound, mut generic) = found.ok_or(AssembliesError::NoValue)?;
        if generic.freedom > 1
            && let Some(least) = freedoms_beside_home(mechanism, held)
        {
            // far out, where the few seeds that close may end, rounding hides equations
            generic.freedom = generic.freedom.min(least.max(1));
        }
        Ok(AssemblySolver {
            mechanism: mechanism.clone(),
            held: held.clone(),
            family,
            bound,
            generic,
            interrupted: watch.is_stopped(),
        })
    }

    /// A solver from stored generic solutions, without a search.
    ///
    /// # Errors
    /// If they were stored for other dimensions or for another choice of inputs.
    pub fn from_stored(
        mechanism: &Mechanism,
        held: &Held<f64>,
        stored: GenericSolutions,
    ) -> Result<Self, AssembliesError> {
        let mechanism = &mechanism.level();
        let mut family = Family::new(mechanism, held);
        if stored.parameters.len() != family.parameters.len()
            && let Some(wider) = Family::wider(mechanism, held)
        {
            family = wider;
        }
        let sizes = stored.parameters.len() == family.parameters.len()
            && stored.inputs.len() == family.coordinates.input_count()
            && (stored.legwise.iter())
                .all(|solutions_at_pose| solutions_at_pose.fits(&family.coordinates));
        let asked = stored.question == question(mechanism, &family);
        if !(sizes && asked && stored.solves(&family)) {
            return Err(AssembliesError::StoredForAnotherQuestion);
        }
        Ok(AssemblySolver {
            mechanism: mechanism.clone(),
            held: held.clone(),
            bound: family::known_bound(mechanism, &family),
            family,
            generic: stored,
            interrupted: false,
        })
    }

    /// True if the search for generic solutions was stopped early.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// The generic solutions, for storing.
    pub fn generic(&self) -> &GenericSolutions {
        &self.generic
    }

    /// All assemblies for the values that `asked` has for held joints and poses; held platform
    /// coordinates have the values the solver was made with.
    pub fn at(
        &self,
        asked: &Configuration<f64>,
        wanted: Wanted,
        watch: &Watch,
    ) -> AssembliesReport {
        self.at_targets(asked, &self.held, wanted, watch)
    }

    /// All assemblies, with other values of held platform coordinates.
    pub fn at_targets(
        &self,
        asked: &Configuration<f64>,
        held: &Held<f64>,
        wanted: Wanted,
        watch: &Watch,
    ) -> AssembliesReport {
        // whole turns of an input change nothing but the way to it
        let mut asked = asked.clone();
        for (i, value) in asked.joints.iter_mut().enumerate() {
            if held.joints[i] && self.mechanism.repeats(i) {
                *value = turn_near(*value, 0.0);
            }
        }
        let asked = &asked;
        let question = TargetProblem {
            mechanism: &self.mechanism,
            coordinates: &self.family.coordinates,
            flips: self.family.ways(),
            held,
            asked,
            bound: self.bound.as_ref(),
            system: System::new(self.mechanism.dimensions(), held),
            watch,
            interrupted: self.interrupted,
        };
        let fit = match (self.generic.legwise.is_empty(), self.generic.freedom) {
            (false, 0) => Fit::Finite,
            // nothing was found yet, and nothing can be said
            (true, 0) if self.interrupted => Fit::Finite,
            (true, 0) if self.generic.endless => Fit::Endless,
            (true, 0) if self.generic.search.multiple > 0 => Fit::AlwaysMultiple,
            (true, 0) => Fit::TooManyHeld,
            (_, freedom) => Fit::FreedomLeft(freedom),
        };
        let member = self.member(asked, held);
        let generic = &self.generic;
        let ends = track::track_to_target(
            &self.family,
            &generic.member(),
            &member,
            &generic.legwise,
            watch,
        );
        let near = Neighbourhood::holding(&self.mechanism, held);
        let starts = |which| search::solved(&self.family, &near, asked, which, watch);
        let mut report = question.answer(
            &self.generic,
            fit,
            &ends.unwrap_or_default(),
            (self.family.homotopy(&member, &member), &starts),
            wanted,
        );
        if let (Some(settings), false) = (&wanted.proof, report.interrupted) {
            let known = (report.assemblies.iter()).filter(|assembly| assembly.dimension == 0);
            let known: Vec<_> = known.map(|a| (a.mode, a.configuration())).collect();
            let proof = prove(&self.mechanism, (held, asked), &known, settings, watch);
            report.interrupted |= watch.is_stopped();
            report.proof = Some(proof);
        }
        report
    }

    /// Writes into a report which of its assemblies differ in sets of angles only. Coordinates in `still`, which stop
    /// local spins, are held too.
    pub fn group_sets_of_angles(
        &self,
        report: &mut AssembliesReport,
        held: &Held<f64>,
        still: &[Still],
    ) {
        if report.fit != Fit::Finite || !report.continua.is_empty() {
            return;
        }
        let coordinates = &self.family.coordinates;
        let all = report.assemblies.iter().map(Assembly::configuration);
        let sets: Vec<Vec<Vec<C>>> = all
            .map(|at| {
                let sets = sets_of_angles(&self.mechanism, (held, still), &at);
                sets.iter().map(|at| coordinates.flat(at)).collect()
            })
            .collect();
        let same = |known: usize, mode: usize| {
            let known = &sets[known - 1][0];
            sets[mode - 1].iter().any(|x| coordinates.same(known, x))
        };
        let positions = grouped(sets.len(), same);
        if positions.len() < sets.len() {
            report.positions = positions;
        }
    }

    /// The member with the mechanism's own dimensions and the target inputs.
    fn member(&self, asked: &Configuration<f64>, held: &Held<f64>) -> Member {
        let inputs = self.family.coordinates.inputs_of(asked, held);
        Member {
            parameters: self.family.parameters.clone(),
            inputs: inputs.into_iter().map(C::from_f64).collect(),
        }
    }
}

/// The fewest freedoms left at assembled configurations beside home.
fn freedoms_beside_home(mechanism: &Mechanism, held: &Held<f64>) -> Option<usize> {
    let mut near = Neighbourhood::holding(mechanism, held);
    let beside = (1..4).filter_map(|k| near.beside(&mechanism.home(), k));
    let freedoms = beside.map(|tangent| tangent.motions.len() + tangent.idle.len());
    freedoms.min()
}
