//! From a well-formed description to a meaningful mechanism, or to all that is wrong with it.

use std::collections::HashMap;
use std::path::Path;

use super::model::{
    Chain, ClosedForm, Closure, FixedStep, Formula, Given, Joint, JointKind, Parameter, Platform,
    Row, Symbol,
};
use super::names::{Names, definition_order};
use super::{Frame, Mechanism, inspect};
use crate::algebra::Affine;
use crate::description::{self, Description, Displacement, Entry, MatrixEntry, Named, Note, Noun};
use crate::description::{FileError, LoadError, Problem, ProblemKind, Scope, Severity};
use crate::geometry::{Axis, Pose};

/// Collects problems while parts are resolved; a part with a problem is left out.
pub(super) struct Builder<'a> {
    pub names: Names<'a>,
    pub problems: Vec<Problem>,
    pub values: Vec<f64>,
}

impl Mechanism {
    /// Reads a mechanism file.
    ///
    /// # Errors
    /// If the file cannot be read, or with everything that is wrong with it.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, LoadError> {
        let (text, description) = description::load(&path)?;
        Mechanism::new(&description).map_err(|problems| {
            LoadError::Wrong(FileError {
                path: path.as_ref().to_owned(),
                text,
                problems,
            })
        })
    }

    /// Resolves every name and evaluates every dimension of a description.
    ///
    /// All problems are found at once, with their places in the file.
    pub fn new(description: &Description) -> Result<Self, Vec<Problem>> {
        let mut builder = Builder {
            names: Names::new(description),
            problems: Vec::new(),
            values: vec![f64::NAN; description.parameters.len()],
        };
        let parameters = builder.parameters(description);
        // without values every dimension would be wrong for the same reason again
        let Some(parameters) = parameters.filter(|_| builder.problems.is_empty()) else {
            return Err(builder.problems);
        };
        let joints = builder.joints(description);
        let chains = builder.chains(description);
        let platforms = builder.platforms(description);
        let closures = builder.closures(description);
        let closed_forms = builder.closed_forms(description);
        let mut mechanism = Mechanism {
            name: description.name.value.clone(),
            source: description.source.as_ref().map(|s| s.value.clone()),
            parameters,
            joints,
            chains,
            platforms,
            closures,
            closed_forms,
            dimensions: super::Dimensions::empty(),
            warnings: Vec::new(),
        };
        let refused = |problem: &Problem| problem.severity() == Severity::Error;
        if !builder.problems.iter().any(refused) {
            mechanism.infer_kinds();
            inspect::inspect(&mechanism, description, &mut builder.problems);
        }
        if !builder.problems.iter().any(refused) {
            match mechanism.dimensions_over(&builder.values) {
                Ok(dimensions) => mechanism.dimensions = dimensions,
                // the parts were evaluated one by one above; only their combination can fail
                Err(error) => builder
                    .problems
                    .push(ProblemKind::NoValue(error.kind).at(error.span)),
            }
        }
        builder
            .problems
            .sort_by_key(|problem| (problem.span.start, problem.span.end));
        if builder.problems.iter().any(refused) {
            return Err(builder.problems);
        }
        mechanism.warnings = builder.problems;
        Ok(mechanism)
    }
}

impl Builder<'_> {
    /// The formula of an entry, or `None` with its problems recorded.
    fn formula(
        &mut self,
        entry: &Entry,
        scope: Scope,
        locals: &HashMap<&str, usize>,
    ) -> Option<Formula> {
        let resolved = (entry.expression).try_resolve(|name, span| {
            let symbol = self.names.symbol(name, scope, locals);
            symbol.map_err(|kind| Box::new(kind.at(span.clone())))
        });
        match resolved {
            Ok(formula) => Some(formula),
            Err(problems) => {
                self.problems
                    .extend(problems.into_iter().map(|problem| *problem));
                None
            }
        }
    }

    /// A formula over parameters, with its value.
    fn constant(&mut self, entry: &Entry) -> Option<(Formula, f64)> {
        let formula = self.formula(entry, Scope::Parameters, &HashMap::new())?;
        let value = self.value(&formula)?;
        Some((formula, value))
    }

    /// The value of a formula over parameters.
    fn value(&mut self, formula: &Formula) -> Option<f64> {
        let values = &self.values;
        let result = formula.evaluate(&|symbol| match *symbol {
            Symbol::Parameter(i) => values[i],
            Symbol::Joint(_) | Symbol::Local(_) => f64::NAN,
        });
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let problem = ProblemKind::NoValue(error.kind).at(error.span);
                self.problems.push(problem);
                None
            }
        }
    }

    /// An entry affine in the joint variables.
    fn affine(&mut self, entry: &Entry) -> Option<Affine<Symbol>> {
        let formula = self.formula(entry, Scope::ParametersAndJoints, &HashMap::new())?;
        match formula.affine(|symbol| matches!(symbol, Symbol::Joint(_))) {
            Ok(affine) => {
                self.value(&affine.constant)?;
                for (_, coefficient) in &affine.terms {
                    self.value(coefficient)?;
                }
                Some(affine)
            }
            Err(refusal) => {
                self.problems.push(ProblemKind::NotAffine.at(refusal.span));
                None
            }
        }
    }

    fn parameters(&mut self, description: &Description) -> Option<Vec<Parameter>> {
        let entries = &description.parameters;
        let none = HashMap::new();
        let formulas: Vec<Option<Formula>> = (entries.iter())
            .map(|named| self.formula(&named.value, Scope::Parameters, &none))
            .collect();
        let formulas: Vec<Formula> = formulas.into_iter().collect::<Option<_>>()?;
        let order = self.order(Noun::Parameter, entries, &formulas, |symbol| match symbol {
            Symbol::Parameter(i) => Some(i),
            _ => None,
        })?;
        for i in order {
            // a parameter without a value makes those defined through it fail for the same reason
            self.values[i] = self.value(&formulas[i])?;
        }
        let parts = entries.iter().zip(formulas).zip(&self.values);
        Some(
            parts
                .map(|((named, definition), &value)| Parameter {
                    name: named.name.value.clone(),
                    definition,
                    value,
                })
                .collect(),
        )
    }

    /// The order in which definitions can be evaluated, or `None` with the cycle recorded.
    fn order(
        &mut self,
        noun: Noun,
        entries: &[Named<Entry>],
        formulas: &[Formula],
        definition: impl Fn(Symbol) -> Option<usize>,
    ) -> Option<Vec<usize>> {
        let uses: Vec<Vec<usize>> = (formulas.iter())
            .map(|formula| {
                formula
                    .names()
                    .filter_map(|(symbol, _)| definition(*symbol))
                    .collect()
            })
            .collect();
        match definition_order(&uses) {
            Ok(order) => Some(order),
            Err(cycle) => {
                let names = cycle
                    .iter()
                    .map(|&i| entries[i].name.value.clone())
                    .collect();
                let kind = ProblemKind::DefinitionCycle { noun, names };
                let problem = kind.at(entries[cycle[0]].name.span.clone());
                let rest = cycle[1..].iter().map(|&i| entries[i].name.span.clone());
                let problem =
                    rest.fold(problem, |problem, span| problem.with(span, Note::ThenHere));
                self.problems.push(problem);
                None
            }
        }
    }

    fn joints(&mut self, description: &Description) -> Vec<Joint> {
        let mut joints = Vec::new();
        for Named { name, value } in &description.joints {
            let home = self.constant(&value.home).map(|(_, home)| home);
            let limits = value.limits.as_ref().and_then(|(low, high)| {
                let (low, high) = (self.constant(low), self.constant(high));
                Some((low?.1, high?.1))
            });
            let joint = name.value.clone();
            if let Some((low, high)) = limits.filter(|(low, high)| low > high) {
                let span = value
                    .limits
                    .as_ref()
                    .map_or(name.span.clone(), |(l, h)| l.span.start..h.span.end);
                let kind = ProblemKind::LimitsReversed { joint, low, high };
                self.problems.push(kind.at(span));
            }
            // a joint with a problem still counts, so that the indices of the others stay right
            joints.push(Joint {
                name: name.value.clone(),
                role: value.role,
                kind: JointKind::Revolute,
                home: home.unwrap_or(0.0),
                limits,
            });
        }
        joints
    }

    fn fixed(&mut self, displacements: &[Displacement]) -> Vec<FixedStep> {
        let mut steps = Vec::new();
        for displacement in displacements {
            let axis = |axis: &description::Axis| match axis {
                description::Axis::X => Axis::X,
                description::Axis::Y => Axis::Y,
                description::Axis::Z => Axis::Z,
            };
            let step = match displacement {
                Displacement::Translate(along, entry) => self
                    .constant(entry)
                    .map(|(f, _)| FixedStep::Translate(axis(along), f)),
                Displacement::Rotate(about, entry) => self
                    .constant(entry)
                    .map(|(f, _)| FixedStep::Rotate(axis(about), f)),
                Displacement::TranslateBy(entries) => {
                    let [x, y, z] = [0, 1, 2].map(|i| self.constant(&entries[i]));
                    match (x, y, z) {
                        (Some((x, _)), Some((y, _)), Some((z, _))) => {
                            Some(FixedStep::TranslateBy([x, y, z]))
                        }
                        _ => None,
                    }
                }
            };
            steps.extend(step);
        }
        steps
    }

    fn frame(&mut self, name: &description::Spanned<String>) -> Frame {
        self.names.frame(&name.value).unwrap_or_else(|kind| {
            self.problems.push(kind.at(name.span.clone()));
            Frame::Ground
        })
    }

    fn chains(&mut self, description: &Description) -> Vec<Chain> {
        let mut chains = Vec::new();
        for Named { name, value } in &description.chains {
            let convention = value
                .convention
                .as_ref()
                .or(description.convention.as_ref());
            let on = value.on.as_ref().map_or(Frame::Ground, |on| self.frame(on));
            let base = self.fixed(&value.base);
            let mut rows = Vec::new();
            for row in &value.rows {
                let (alpha, a) = (self.constant(&row.alpha), self.constant(&row.a));
                let (d, theta) = (self.affine(&row.d), self.affine(&row.theta));
                if let (Some((alpha, _)), Some((a, _)), Some(d), Some(theta)) = (alpha, a, d, theta)
                {
                    let entries = [&row.alpha, &row.a, &row.d, &row.theta];
                    rows.push(Row {
                        alpha,
                        a,
                        d,
                        theta,
                        written: entries.map(|entry| entry.expression.to_string()),
                    });
                }
            }
            chains.push(Chain {
                name: name.value.clone(),
                on,
                convention: convention.map_or(description::Convention::Modified, |c| c.value),
                base,
                rows,
                tip: self.fixed(&value.tip),
            });
        }
        self.check_mounting(description, &chains);
        chains
    }

    /// Chains may stand on one another, but not in a ring.
    fn check_mounting(&mut self, description: &Description, chains: &[Chain]) {
        let uses: Vec<Vec<usize>> = (chains.iter())
            .map(|chain| match chain.on {
                Frame::Tip { chain } | Frame::Link { chain, .. } => vec![chain],
                _ => vec![],
            })
            .collect();
        if let Err(cycle) = definition_order(&uses) {
            let names = cycle.iter().map(|&i| chains[i].name.clone()).collect();
            let place = |i: usize| {
                let chain = &description.chains[i];
                chain
                    .value
                    .on
                    .as_ref()
                    .map_or(chain.name.span.clone(), |on| on.span.clone())
            };
            let problem = ProblemKind::ChainCycle { names }.at(place(cycle[0]));
            let rest = cycle[1..].iter().map(|&i| place(i));
            let problem = rest.fold(problem, |problem, span| problem.with(span, Note::ThenHere));
            self.problems.push(problem);
        }
    }

    fn platforms(&mut self, description: &Description) -> Vec<Platform> {
        let mut platforms = Vec::new();
        for Named { name, value } in &description.platforms {
            let home = self.fixed(&value.home);
            let values = self.values.clone();
            let home = home.iter().try_fold(Pose::identity(), |pose, step| {
                Ok::<_, crate::algebra::EvaluationError>(pose * step.over(&values)?)
            });
            platforms.push(Platform {
                name: name.value.clone(),
                home: home.unwrap_or_else(|_| Pose::identity()),
                frames: (value.frames.iter())
                    .map(|frame| (frame.name.value.clone(), self.fixed(&frame.value)))
                    .collect(),
            });
        }
        platforms
    }

    fn closures(&mut self, description: &Description) -> Vec<Closure> {
        let mut closures = Vec::new();
        for Named { name, value } in &description.closures {
            closures.push(Closure {
                name: name.value.clone(),
                kind: value.kind,
                frames: [0, 1].map(|i| self.frame(&value.frames[i])),
                length: value.length.as_ref().and_then(|length| self.affine(length)),
            });
        }
        closures
    }

    fn closed_forms(&mut self, description: &Description) -> Vec<ClosedForm> {
        let mut forms = Vec::new();
        for Named { name, value } in &description.closed_forms {
            if let Some((locals, gives)) = self.closed_form(value) {
                forms.push(ClosedForm {
                    name: name.value.clone(),
                    source: value.source.as_ref().map(|s| s.value.clone()),
                    locals,
                    gives,
                });
            }
        }
        forms
    }

    fn closed_form(
        &mut self,
        form: &description::ClosedFormDescription,
    ) -> Option<(Vec<(String, Formula)>, Given)> {
        let names = form.locals.iter().map(|local| local.name.value.as_str());
        let indices: HashMap<&str, usize> = names.enumerate().map(|(i, n)| (n, i)).collect();
        let scope = Scope::ClosedForm;
        let formulas: Vec<Option<Formula>> = (form.locals.iter())
            .map(|local| self.formula(&local.value, scope, &indices))
            .collect();
        let mut entries = Vec::new();
        let mut add = |builder: &mut Self, place: MatrixEntry, entry: &Entry| {
            let formula = builder.formula(entry, scope, &indices);
            entries.extend(formula.map(|formula| (place, formula)));
        };
        for (i, entry) in form.position.iter().flatten().enumerate() {
            add(self, MatrixEntry::Position(i), entry);
        }
        for (i, row) in form.rotation.iter().flatten().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                add(self, MatrixEntry::Rotation(i, j), entry);
            }
        }
        for (i, row) in form.transform.iter().flatten().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let place = match j {
                    3 => MatrixEntry::Position(i),
                    _ => MatrixEntry::Rotation(i, j),
                };
                add(self, place, entry);
            }
        }
        for (place, entry) in &form.entries {
            add(self, place.value, entry);
        }
        let mut identities = Vec::new();
        if let Some(entry) = &form.identity {
            let formula = self.formula(entry, scope, &indices);
            identities.extend(formula.map(|formula| (String::from("identity"), formula)));
        }
        for Named { name, value } in &form.identities {
            let formula = self.formula(value, scope, &indices);
            identities.extend(formula.map(|formula| (name.value.clone(), formula)));
        }
        let of = form.of.as_ref().map(|frame| self.frame(frame));
        let relative_to = form
            .relative_to
            .as_ref()
            .map_or(Frame::Ground, |frame| self.frame(frame));

        let formulas: Vec<Formula> = formulas.into_iter().collect::<Option<_>>()?;
        let order = self.order(
            Noun::LocalName,
            &form.locals,
            &formulas,
            |symbol| match symbol {
                Symbol::Local(i) => Some(i),
                _ => None,
            },
        )?;
        // the locals are stored in the order of evaluation, so their indices change
        let mut place = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old] = new;
        }
        let renumber = |formula: &Formula| {
            let renumbered = formula.try_resolve(|symbol, _| {
                Ok::<_, std::convert::Infallible>(match *symbol {
                    Symbol::Local(i) => Symbol::Local(place[i]),
                    other => other,
                })
            });
            renumbered.expect("no error is possible")
        };
        let locals = order
            .iter()
            .map(|&i| (form.locals[i].name.value.clone(), renumber(&formulas[i])));
        let locals = locals.collect();
        let gives = match of {
            Some(of) => Given::Pose {
                of,
                relative_to,
                entries: entries.iter().map(|(e, f)| (*e, renumber(f))).collect(),
            },
            None => Given::Identities(
                identities
                    .iter()
                    .map(|(n, f)| (n.clone(), renumber(f)))
                    .collect(),
            ),
        };
        Some((locals, gives))
    }
}
