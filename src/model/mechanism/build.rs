//! A valid mechanism from a well-formed description, or all problems in it.

mod closed_form;
mod closures;
mod coordinates;
mod entries;
mod outputs;
mod parameters;

pub(super) use closures::fault_of_length;
pub(super) use outputs::problem as problem_of;

use std::collections::HashSet;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use super::lift::product;
use super::model::{
    Chain, ChainRow, FixedStep, Formula, Homes, Joint, JointHome, JointKind, Platform,
};
use super::names::{FileNames, definition_order};
use super::{Frame, Mechanism, inspect};
use crate::algebra::Measure;
use crate::description::{self, Description, Displacement, Draft, Entry, Named};
use crate::description::{LoadError, MAX_BYTES, Problem, ProblemKind, Severity, load_text_within};
use crate::geometry::Pose;
use crate::number::sorting::sort_by_key;

/// A chain as far as it could be resolved.
struct ResolvedChain {
    name: String,
    doubtful: bool,
    on: Option<Frame>,
    /// True if it is attached to itself through other chains.
    in_ring: bool,
    convention: description::Convention,
    base: Vec<FixedStep>,
    rows: Vec<Option<ChainRow>>,
    tip: Vec<FixedStep>,
}

impl ResolvedChain {
    /// The chain, if all of it could be resolved.
    fn finished(self) -> Option<Chain> {
        Some(Chain {
            name: self.name,
            on: self.on?,
            convention: self.convention,
            base: self.base,
            rows: self.rows.into_iter().collect::<Option<_>>()?,
            tip: self.tip,
        })
    }
}

/// Collects problems while parts are resolved; a part with a problem is left out.
pub(super) struct ModelBuilder<'a> {
    pub names: FileNames<'a>,
    pub problems: Vec<Problem>,
    /// The values of the parameters; NaN where one is unknown.
    pub values: Vec<f64>,
    /// The dimensions of the parameters: length, angle or none.
    pub measures: Vec<Measure>,
    /// For each parameter, true if its definition contains no unit.
    pub bare: Vec<bool>,
    /// Names whose meaning is uncertain after an error; expressions that use them are not checked further.
    doubtful: &'a HashSet<String>,
}

impl Mechanism {
    /// Reads a mechanism file as a description, to be changed before it becomes a mechanism. Returns its text too.
    ///
    /// # Errors
    /// If the file cannot be read or is not well formed; then with all its problems.
    pub fn read(path: impl AsRef<Path>) -> Result<(String, Description), LoadError> {
        Mechanism::read_within(path, MAX_BYTES)
    }

    /// As [`Mechanism::read`], for a file of at most `limit` bytes.
    ///
    /// # Errors
    /// If the file cannot be read or is not well formed; then with all its problems.
    pub fn read_within(
        path: impl AsRef<Path>,
        limit: u64,
    ) -> Result<(String, Description), LoadError> {
        let text = load_text_within(&path, limit)?;
        Mechanism::read_text(path, text)
    }

    /// As [`Mechanism::read`], for a text that errors call `path`.
    ///
    /// # Errors
    /// If the text is not well formed; then with all its problems.
    pub fn read_text(
        path: impl AsRef<Path>,
        text: String,
    ) -> Result<(String, Description), LoadError> {
        match Description::read(&text) {
            Ok(description) => {
                let folder = path
                    .as_ref()
                    .parent()
                    .map(Path::to_owned)
                    .unwrap_or_default();
                match description.with_tables_in(&folder) {
                    Ok(description) => Ok((text, description)),
                    Err(problems) => Err(LoadError::wrong(path, text, problems)),
                }
            }
            Err(_) => {
                let problems = Mechanism::problems(&text);
                Err(LoadError::wrong(path, text, problems))
            }
        }
    }

    /// All problems in the text of a mechanism file, of form and of meaning, in the order of the text; empty if it
    /// describes a mechanism.
    pub fn problems(text: &str) -> Vec<Problem> {
        let draft = match Draft::read(text) {
            Ok(draft) => draft,
            Err(problems) => return problems,
        };
        let mut problems = draft.problems.clone();
        if let Err(found) = Mechanism::build(&draft.description, &draft.doubtful) {
            // warnings of a file that is only partly read may be wrong
            let error = |problem: &Problem| problem.severity() == Severity::Error;
            let new = |problem: &Problem| error(problem) && !draft.explains(problem);
            let whole = draft.problems.is_empty();
            problems.extend(found.into_iter().filter(|problem| whole || new(problem)));
        }
        sort_by_key(&mut problems, |problem| {
            (problem.span.start, problem.span.end)
        });
        problems
    }

    /// Resolves every name and evaluates every dimension of a description.
    ///
    /// All problems are found at once, with their places in the file.
    pub fn new(description: &Description) -> Result<Self, Vec<Problem>> {
        Mechanism::build(description, &HashSet::new())
    }

    fn build(description: &Description, doubtful: &HashSet<String>) -> Result<Self, Vec<Problem>> {
        let mut builder = ModelBuilder {
            names: FileNames::new(description),
            problems: Vec::new(),
            values: vec![f64::NAN; description.parameters.len()],
            measures: vec![Measure::Open; description.parameters.len()],
            bare: vec![false; description.parameters.len()],
            doubtful,
        };
        let parameters = builder.parameters(description);
        let tolerance = description.tolerance.as_ref();
        let tolerance = tolerance.and_then(|of| builder.measured(of, Measure::Length));
        let (joints, homes) = builder.joints(description);
        let chains = builder.chains(description);
        let (platforms, poses) = builder.platforms(description);
        let closures = builder.closures(description, &chains);
        let closed_forms = builder.closed_forms(description);
        if let Some(coordinates) = &description.coordinates {
            builder.check_coordinates(coordinates);
        }
        if description.chains.is_empty() && description.platforms.is_empty() {
            builder.refuse(ProblemKind::NothingToAnalyse, &description.name.span);
        }
        let mut mechanism = Mechanism {
            name: description.name.value.clone(),
            source: description.source.as_ref().map(|s| s.value.clone()),
            parameters,
            joints,
            chains: Arc::new(
                (chains.into_iter())
                    .filter_map(ResolvedChain::finished)
                    .collect(),
            ),
            platforms,
            closures: closures.into(),
            closed_forms: closed_forms.into(),
            outputs: Arc::default(),
            homes: Arc::new(Homes {
                joints: homes,
                platforms: poses,
            }),
            closing: Arc::default(),
            loads: Arc::default(),
            loads_file: Arc::new(description.loads.clone()),
            own: [description.chains.len(), description.closures.len()],
            added_unknowns: 0,
            dimensions: super::Dimensions::empty().into(),
            cycles: Vec::new(),
            rows_that_vary: OnceLock::new(),
            coordinates: description.coordinates.clone().map(Arc::from),
            warnings: Arc::default(),
            tolerance: tolerance.map(|(_, value)| value.abs()),
            rounding: None,
        };
        let refused = |problem: &Problem| problem.severity() == Severity::Error;
        if !builder.problems.iter().any(refused) {
            mechanism.open_declared(description);
            mechanism.infer_kinds();
            builder.check_joint_units(description, &mechanism.joints);
            mechanism.outputs = builder.outputs(description, &mechanism).into();
            mechanism.name_closing_joints();
            inspect::inspect(&mechanism, description, &mut builder.problems);
        }
        if !builder.problems.iter().any(refused) {
            match mechanism.centred(&builder.values) {
                Ok(dimensions) => {
                    mechanism.set_dimensions(dimensions);
                    if let Some(kind) = mechanism.far_away() {
                        builder.refuse(kind, &description.name.span);
                    }
                }
                // the parts were evaluated one by one above; only their combination can fail
                Err(error) => builder.refuse(ProblemKind::NoValue(error.kind), &error.span),
            }
        }
        if !builder.problems.iter().any(refused) {
            let problems = mechanism.load_all();
            builder.problems.extend(problems);
        }
        let problems = &mut builder.problems;
        sort_by_key(problems, |problem| (problem.span.start, problem.span.end));
        // a coordinate occurs in several entries of the tables
        problems.dedup();
        // what follows from a problem that has a place is no problem of its own
        let placed = |problem: &Problem| problem.span != (0..0);
        if problems
            .iter()
            .any(|problem| refused(problem) && placed(problem))
        {
            problems.retain(placed);
        }
        if builder.problems.iter().any(refused) {
            return Err(builder.problems);
        }
        mechanism.warnings = builder.problems.into();
        Ok(mechanism)
    }
}

impl ModelBuilder<'_> {
    fn joints(&mut self, description: &Description) -> (Vec<Joint>, Vec<JointHome>) {
        let mut joints = Vec::new();
        let mut written = Vec::new();
        for Named { name, value } in &description.joints {
            let home = self.constant(&value.home);
            let (formula, home) = home.unwrap_or_else(|| (Formula::number(0.0), 0.0));
            let limits = value.limits.as_ref().and_then(|(low, high)| {
                let (low, high) = (self.constant(low), self.constant(high));
                low.zip(high)
            });
            let (limits, formulas) = limits
                .map(|(low, high)| ((low.1, high.1), [low.0, high.0]))
                .unzip();
            written.push((formula, formulas));
            if let (Some((low, high)), Some((l, h))) = (limits, &value.limits)
                && low > high
            {
                let joint = name.value.clone();
                let kind = ProblemKind::LimitsReversed { joint, low, high };
                self.refuse(kind, &(l.span.start..h.span.end));
            }
            // a joint with a problem still counts, so that the indices of the others stay right
            joints.push(Joint {
                name: name.value.clone(),
                role: value.role,
                kind: JointKind::Revolute,
                home,
                limits,
            });
        }
        (joints, written)
    }

    fn fixed(&mut self, displacements: &[Displacement]) -> Vec<FixedStep> {
        let mut steps = Vec::new();
        for displacement in displacements {
            let measure = match displacement {
                Displacement::Rotate(..) => Measure::Angle,
                _ => Measure::Length,
            };
            let formula = |entry: &Entry| {
                let measured = self.measured(entry, measure);
                measured.map(|(formula, _)| formula).ok_or(())
            };
            steps.extend(displacement.try_map(formula));
        }
        steps
    }

    fn frame(&mut self, name: &description::Spanned<String>) -> Option<Frame> {
        let found = self.names.frame(&name.value);
        found.map_err(|kind| self.refuse(kind, &name.span)).ok()
    }

    fn chains(&mut self, description: &Description) -> Vec<ResolvedChain> {
        let mut chains = Vec::new();
        for Named { name, value } in &description.chains {
            let convention = value
                .convention
                .as_ref()
                .or(description.convention.as_ref());
            let on = match &value.on {
                Some(on) => self.frame(on),
                None => Some(Frame::Ground),
            };
            let base = self.fixed(&value.base);
            let mut rows = Vec::new();
            for row in &value.rows {
                let alpha = self.measured(&row.alpha, Measure::Angle);
                let a = self.measured(&row.a, Measure::Length);
                let d = self.affine(&row.d, Measure::Length);
                let theta = self.affine(&row.theta, Measure::Angle);
                let beta = self.measured(&row.beta, Measure::Angle);
                let entries = [&row.alpha, &row.a, &row.d, &row.theta, &row.beta];
                let whole = || {
                    Some(ChainRow {
                        alpha: alpha?.0,
                        a: a?.0,
                        d: d?,
                        theta: theta?,
                        beta: beta?.0,
                        written: entries.map(|entry| entry.expression.to_string()),
                        link: row.link.as_ref().map(|link| link.value.clone()),
                    })
                };
                rows.push(whole());
            }
            chains.push(ResolvedChain {
                doubtful: self.doubtful.contains(&name.value),
                name: name.value.clone(),
                on,
                convention: convention.map_or(description::Convention::Modified, |c| c.value),
                base,
                rows,
                tip: self.fixed(&value.tip),
                in_ring: false,
            });
        }
        self.check_mounting(description, &mut chains);
        chains
    }

    /// Chains may be attached to one another, but not in a cycle.
    fn check_mounting(&mut self, description: &Description, chains: &mut [ResolvedChain]) {
        let uses: Vec<Vec<usize>> = (chains.iter())
            .map(|chain| match chain.on {
                Some(Frame::Tip { chain } | Frame::Link { chain, .. }) => vec![chain],
                _ => vec![],
            })
            .collect();
        for cycle in definition_order(&uses).cycles {
            let names = cycle.iter().map(|&i| chains[i].name.clone()).collect();
            let places = cycle.iter().map(|&i| {
                let Named { name, value } = &description.chains[i];
                value.on.as_ref().map_or(&name.span, |on| &on.span).clone()
            });
            self.refuse_cycle(ProblemKind::ChainCycle { names }, places);
            cycle.iter().for_each(|&i| chains[i].in_ring = true);
        }
    }

    fn platforms(&mut self, description: &Description) -> (Vec<Platform>, Vec<Vec<FixedStep>>) {
        let (mut platforms, mut homes) = (Vec::new(), Vec::new());
        for Named { name, value } in &description.platforms {
            let home = self.fixed(&value.home);
            platforms.push(Platform {
                name: name.value.clone(),
                home: product(&home, &self.values).unwrap_or_else(|_| Pose::identity()),
                frames: (value.frames.iter())
                    .map(|frame| (frame.name.value.clone(), self.fixed(&frame.value)))
                    .collect(),
            });
            homes.push(home);
        }
        (platforms, homes)
    }
}
