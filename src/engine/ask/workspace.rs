//! Maps of the workspace.

use std::f64::consts::TAU;

use super::ranges::{middles, of_platform};
use super::{AskError, Mode, Question, Role, check_starts};
use crate::analysis::workspace::{WorkspaceReport, WorkspaceSettings, cell_bytes, workspace};
use crate::mechanism::Configuration;
use crate::number::tolerance::ROUNDING;
use crate::solve::Watch;
use crate::system::{
    self, Coordinate, Driven, QuestionError, RESTARTS, RegularFreedoms, TooLarge, check_count,
    too_large,
};

/// Bytes that a map takes at most.
pub const MOST_BYTES: f64 = 4e9;

impl Question {
    /// Maps the inputs over their ranges. Where coordinates of platforms are mapped or held the actuated joints are
    /// free. With [`Mode::All`] the map begins with all assemblies in the middle of the box too, besides those that
    /// random starts lead to.
    ///
    /// `settings.nodes` are one number for each input, one for all of them, or none for what suits their number.
    ///
    /// # Errors
    /// If the question is wrong, holds too much or too little, or the map would take more than [`MOST_BYTES`].
    pub fn workspace(
        &self,
        settings: &WorkspaceSettings,
        watch: &Watch,
    ) -> Result<WorkspaceReport, AskError> {
        self.takes("workspace")?;
        let axes = self.axes()?;
        let question = self.mapped(&axes)?.with_spins_still();
        let bytes = cell_bytes(&question, axes.len()) as f64;
        let nodes = nodes(&settings.nodes, axes.len(), bytes)?;
        for given in [settings.starts, settings.searched] {
            check_starts(given)?;
        }
        let known = match self.mode {
            Mode::Nearest => Vec::new(),
            Mode::Number(_) | Mode::All => match self.starts(&question, watch) {
                Err(AskError::NoSuchMode { .. }) if self.mode == Mode::All => Vec::new(),
                starts => starts?,
            },
        };
        let known: Vec<_> = known.into_iter().map(|(_, at)| at).collect();
        let settings = WorkspaceSettings {
            nodes,
            seed: self.seed,
            most: settings.most.min((MOST_BYTES / bytes) as usize),
            ..settings.clone()
        };
        let home = self.home(&axes, watch)?;
        let begun = (&known[..], home.as_ref());
        let report = workspace(&question, &axes, begun, &settings, watch);
        report.map_err(|error| AskError::TooMany {
            cells: error.most,
            most: error.most as f64 * bytes,
        })
    }

    /// The assembly near home, or near the guess, with the mapped coordinates where it has them.
    ///
    /// If actuated joints are free on the map, this is the assembly with the actuated joints at home, from which the
    /// held coordinates then move to their values.
    fn home(&self, axes: &[Driven], watch: &Watch) -> Result<Option<Configuration<f64>>, AskError> {
        let closed = |question: system::Question, restarts: usize| {
            self.nearest(&question.with_spins_still(), restarts, watch)
        };
        if !self.is_inverse(axes)? {
            return Ok(closed(self.resolved()?, RESTARTS));
        }
        let own = self.keeping(|of| !matches!(of.role, Role::Hold | Role::Free));
        let Some(home) = closed(own.resolved()?, RESTARTS) else {
            return Ok(None);
        };
        let values: Vec<f64> = axes
            .iter()
            .map(|axis| axis.coordinate.of(self.mechanism(), &home))
            .collect();
        let question = self.with_inputs(self.released()?, &values)?;
        let question = match self.has(Role::Hold) {
            true => question,
            false => question.near(&home),
        };
        // what a random start leads to is not home
        Ok(closed(question, 0))
    }

    /// True if coordinates of platforms are mapped or held, so that actuated joints are free.
    fn is_inverse(&self, axes: &[Driven]) -> Result<bool, AskError> {
        let held = self.resolved()?.held_coordinates();
        let mapped = axes.iter().map(|axis| axis.coordinate);
        Ok(mapped
            .chain(held)
            .any(|h| of_platform(self.mechanism(), &h)))
    }

    /// The mapped coordinates with their ranges.
    fn axes(&self) -> Result<Vec<Driven>, AskError> {
        let mechanism = self.mechanism();
        let question = system::Question::new(mechanism);
        for (item, input) in self.of(Role::Input) {
            let wrong = |error| AskError::NotMapped(item, Box::new(error));
            (question.value(&input.name, "home")).map_err(wrong)?;
        }
        // a range that is no number is refused too
        let axes = self.driven(|a, b| a >= b || !(b - a).is_finite())?;
        // what comes round again is mapped once
        let turns = |axis: &Driven| match axis.coordinate {
            Coordinate::Joint(joint) => mechanism.repeats(joint),
            of => of.is_angle(mechanism),
        };
        let round = |axis: &&Driven| turns(axis) && axis.to - axis.from > TAU * (1.0 + ROUNDING);
        if let Some(axis) = axes.iter().find(round) {
            return Err(AskError::MoreThanATurn(axis.coordinate.name(mechanism)));
        }
        match axes.len() {
            1..=3 => Ok(axes),
            n => Err(AskError::Axes(n)),
        }
    }

    /// The question with the mapped coordinates in the middle of their ranges.
    fn mapped(&self, axes: &[Driven]) -> Result<system::Question<'_>, AskError> {
        let mechanism = self.mechanism();
        let inverse = self.is_inverse(axes)?;
        let question = match inverse {
            true => self.released()?,
            false => self.resolved()?,
        };
        let demanded = self.of(Role::Hold).chain(self.of(Role::Free));
        let demanded: Vec<&String> = demanded.map(|(_, demand)| &demand.name).collect();
        for ((item, input), axis) in self.of(Role::Input).zip(axes) {
            let platform = match axis.coordinate {
                Coordinate::Pose(platform, _) => Some(&mechanism.platforms()[platform].name),
                Coordinate::Joint(_) | Coordinate::Turn(..) => None,
            };
            if (demanded.iter()).any(|name| **name == input.name || Some(*name) == platform) {
                return Err(AskError::AlsoHeld(item, input.name.clone()));
            }
        }
        let question = self.with_inputs(question, &middles(axes))?;
        if let Some(TooLarge { unknowns, .. }) = too_large(mechanism) {
            return Err(AskError::TooLarge(unknowns));
        }
        // roll and yaw turn about one axis there, and do not tell a map
        for axis in axes {
            if let Coordinate::Pose(platform, c) = axis.coordinate
                && c.is_angle()
                && (question.held_coordinates().iter())
                    .any(|held| matches!(held, Coordinate::Turn(of, _) if *of == platform))
            {
                let platform = mechanism.platforms()[platform].name.clone();
                return Err(AskError::Question(QuestionError::AnglesLocked(platform)));
            }
        }
        check_count(&question).map_err(|error| AskError::Mapped {
            missing: match error {
                QuestionError::TooFew { .. } if inverse => missing(&question),
                _ => Vec::new(),
            },
            mapped: (self.of(Role::Input).map(|(_, input)| input.name.clone())).collect(),
            error: Box::new(error),
        })?;
        Ok(question)
    }
}

/// Nodes along each coordinate, each of which takes so many bytes.
fn nodes(given: &[usize], axes: usize, bytes: f64) -> Result<Vec<usize>, AskError> {
    let nodes = match given[..] {
        [] => vec![[200, 60, 24][axes - 1]; axes],
        [one] => vec![one; axes],
        _ => given.to_vec(),
    };
    if nodes.len() != axes || nodes.iter().any(|n| *n < 2) {
        return Err(AskError::Grid { nodes, axes });
    }
    let all: f64 = nodes.iter().map(|n| *n as f64).product();
    let bytes = all * bytes;
    let most = MOST_BYTES;
    match bytes > most {
        true => Err(AskError::TooFine {
            nodes: all,
            bytes,
            most,
        }),
        false => Ok(nodes),
    }
}

/// Coordinates of platforms that are to be mapped or held too.
fn missing(question: &system::Question) -> Vec<String> {
    let mechanism = question.mechanism();
    let held = question.held_coordinates();
    let coordinates = Coordinate::all(mechanism).filter(|of| of_platform(mechanism, of));
    let candidates: Vec<Coordinate> = held.iter().copied().chain(coordinates).collect();
    let Some(mobility) = RegularFreedoms::near(mechanism, &question.start()) else {
        return Vec::new();
    };
    let chosen = mobility.independent(mechanism, &candidates).into_iter();
    let new = chosen.filter(|c| !held.contains(c));
    new.map(|c| c.name(mechanism)).collect()
}
