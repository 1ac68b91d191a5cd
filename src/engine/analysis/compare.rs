//! The closed forms of a mechanism checked against its chains: proved or refuted in letters, and compared with numbers.

mod conditions;
mod consequence;
mod echelon;
mod elimination;
mod formula;
mod identity;
mod proof;
mod samples;
mod variables;

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::algebra::EvaluationError;
use crate::mechanism::{ClosedForm, Configuration, GivenForm, MatrixEntry, Mechanism};
use crate::number::tolerance::SAME;
use crate::solve::{Progress, Stage, Watch};
use crate::system::{ByName, FormulaNames};
pub use conditions::FormDivisor;
use conditions::ProofConditions;
use formula::{NamedValues, measured};
pub use proof::{ComponentProof, Difference, Reason};
use samples::SampleStream;
use variables::formulas;

/// Settings of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct CompareSettings {
    /// Random joint values to try besides the home configuration.
    pub samples: usize,
    /// Seed of the random joint values.
    pub seed: u64,
    /// The relative difference above which a form disagrees; rounding gives some 1e-15, solved configurations 1e-12.
    pub tolerance: f64,
}

impl Default for CompareSettings {
    fn default() -> Self {
        CompareSettings {
            samples: 100,
            seed: 1,
            tolerance: 1e-9,
        }
    }
}

/// Report on the closed forms of a mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CompareReport {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The names that stand in its formulas.
    pub names: FormulaNames,
    /// True if every form agrees.
    pub agree: bool,
    /// The forms, in the order of the file.
    pub closed_forms: Vec<FormReport>,
    /// True if the mechanism assembles from its home configuration.
    pub home_assembles: bool,
    /// Random inputs at which the mechanism did not assemble; forms that need an assembled
    /// configuration were not tried there.
    pub not_assembled: usize,
    /// Seed of the random joint values.
    pub seed: u64,
    /// The relative difference above which a form disagrees.
    pub tolerance: f64,
    /// True if the work was stopped early: fewer samples were tried, and perhaps nothing proved.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
}

/// Report on one closed form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FormReport {
    /// Its name.
    pub name: String,
    /// True if it agrees; false also if it could not be tried.
    pub agree: bool,
    /// Outcome at the samples.
    pub verdict: Verdict,
    /// The largest difference of any component: m, or without unit.
    pub max_difference: f64,
    /// Configurations at which it was evaluated.
    pub samples: usize,
    /// Publication in which it is printed.
    pub source: Option<String>,
    /// Its entries or identities.
    pub components: Vec<ComponentReport>,
    /// The joint values at which its worst component differs most, rad or m; empty if there was no
    /// sample.
    pub worst: ByName<f64>,
}

/// Outcome of comparing a closed form with the chains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It agrees at every sample.
    Agrees,
    /// It disagrees at some sample.
    Disagrees,
    /// Some component has no value at any sample.
    Undefined,
    /// No sample assembles.
    NotTried,
}

/// Report on one entry of a pose or one identity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComponentReport {
    /// `px`, `r11`, … or the name of the identity.
    pub name: String,
    /// Kind of quantity.
    pub quantity: ComponentQuantity,
    /// True if it agrees at every sample at which it has a value, has one somewhere, and is not refuted.
    pub agree: bool,
    /// The proof that it holds wherever it has a value. Samples show only that there are such configurations.
    pub proof: ComponentProof,
    /// The largest difference: m, or without unit.
    pub max_difference: f64,
    /// The largest difference relative to the size of the values compared, which decides.
    pub relative: f64,
    /// Samples at which it has a value.
    pub samples: usize,
    /// Samples at which it has none, as when it divides by zero.
    pub without_value: usize,
    /// Formulas that must not be zero for it to have a value, and are not shown never to be.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub divisors: Vec<FormDivisor>,
    /// The sample with the largest difference.
    pub worst: Option<WorstSample>,
}

/// The sample at which a component differs most.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorstSample {
    /// Joint values, rad or m.
    pub joints: ByName<f64>,
    /// Value of the closed form.
    pub closed_form: f64,
    /// Value from the chains; zero for an identity.
    pub chains: f64,
}

/// Kind of quantity of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ComponentQuantity {
    /// A coordinate of a position, in m.
    Position,
    /// An entry of a rotation matrix.
    Rotation,
    /// An identity, in whatever unit it is written.
    Identity,
}

/// Checks every closed form of a mechanism against its chains.
///
/// Entries of poses are checked at random joint values within limits and at the home configuration;
/// identities, and poses that depend on where a platform is, at the configurations the mechanism
/// assembles to when the actuated joints are given random values.
pub fn compare(mechanism: &Mechanism, settings: &CompareSettings, watch: &Watch) -> CompareReport {
    let all = mechanism.closed_forms();
    let mut forms: Vec<Checked> = (all.iter().enumerate())
        .map(|(i, form)| {
            let proves = !watch.stops(Stage::Proofs, i, Some(all.len()));
            Checked::new(mechanism, form, proves)
        })
        .collect();
    let (mut closed, mut open): (Vec<&mut Checked>, Vec<&mut Checked>) =
        (forms.iter_mut()).partition(|checked| must_be_assembled(mechanism, checked.form));
    let mut samples = SampleStream::new(mechanism, settings.samples, settings.seed);
    let passes = 1 + usize::from(!closed.is_empty());
    let total = settings.samples.saturating_add(1).saturating_mul(passes);
    let mut done = 0;
    let mut sampled = || {
        let (stage, of) = (Stage::Samples, Some(total));
        let flow = watch.at(Progress { stage, done, of });
        done = total.min(done + 1);
        flow
    };
    let mut flow = samples.anywhere(&mut |at| {
        sampled()?;
        open.iter_mut()
            .for_each(|checked| checked.add(mechanism, at));
        ControlFlow::Continue(())
    });
    let mut not_assembled = 0;
    if flow.is_continue() && !closed.is_empty() {
        flow = samples.assembled(settings.seed, &mut |found| {
            sampled()?;
            match found {
                Some(at) => closed
                    .iter_mut()
                    .for_each(|checked| checked.add(mechanism, at)),
                None => not_assembled += 1,
            }
            ControlFlow::Continue(())
        });
    }
    let home_assembles = samples.home_assembles();
    let closed_forms: Vec<FormReport> = forms
        .into_iter()
        .map(|checked| checked.report(mechanism, settings.tolerance, watch))
        .collect();
    CompareReport {
        mechanism: mechanism.name().into(),
        names: mechanism.names_in_formulas(),
        agree: closed_forms.iter().all(|form| form.agree),
        closed_forms,
        home_assembles,
        not_assembled,
        seed: settings.seed,
        tolerance: settings.tolerance,
        interrupted: flow.is_break(),
    }
}

/// True if a form holds only where the closures are closed: joint values then fix the platforms.
fn must_be_assembled(mechanism: &Mechanism, form: &ClosedForm) -> bool {
    match form.gives {
        GivenForm::Identities(_) => true,
        GivenForm::Pose {
            of, relative_to, ..
        } => mechanism.carrier(of) != mechanism.carrier(relative_to),
    }
}

/// One closed form while it is being checked.
struct Checked<'a> {
    form: &'a ClosedForm,
    components: Vec<ComponentReport>,
    conditions: Vec<ProofConditions>,
}

impl<'a> Checked<'a> {
    fn new(mechanism: &Mechanism, form: &'a ClosedForm, proves: bool) -> Self {
        let named: Vec<(String, ComponentQuantity)> = match &form.gives {
            GivenForm::Pose { entries, .. } => (entries.iter())
                .map(|(entry, _)| match entry {
                    MatrixEntry::Position(_) => (entry.to_string(), ComponentQuantity::Position),
                    MatrixEntry::Rotation(..) => (entry.to_string(), ComponentQuantity::Rotation),
                })
                .collect(),
            GivenForm::Identities(identities) => (identities.iter())
                .map(|(name, _)| (name.clone(), ComponentQuantity::Identity))
                .collect(),
        };
        let proofs = match proves {
            true => proof::proofs(mechanism, form),
            false => vec![ComponentProof::undecided(Reason::Interrupted); named.len()],
        };
        let new = |((name, quantity), proof)| ComponentReport {
            name,
            quantity,
            agree: false,
            proof,
            max_difference: 0.0,
            relative: 0.0,
            samples: 0,
            without_value: 0,
            divisors: Vec::new(),
            worst: None,
        };
        let formulas = formulas(form).into_iter().zip(&proofs);
        let conditions =
            formulas.map(|(of, proof)| ProofConditions::new(mechanism, form, of, proof));
        Checked {
            form,
            conditions: conditions.collect(),
            components: named.into_iter().zip(proofs).map(new).collect(),
        }
    }

    /// Compares every component at a configuration.
    fn add(&mut self, mechanism: &Mechanism, at: &Configuration<f64>) {
        let (form, joints) = (self.form, &at.joints);
        // what the form gives, what the chains give, and the size these are compared with
        let compared: Vec<Result<[f64; 3], EvaluationError>> = match &form.gives {
            GivenForm::Pose {
                of,
                relative_to,
                entries,
            } => {
                let values = NamedValues::at(mechanism, form, joints);
                let pose = mechanism.transform(*relative_to, *of, at);
                let compared = entries.iter().map(|(entry, formula)| {
                    let given = values.of(formula)?;
                    let found = entry.of(&pose);
                    let natural = match entry {
                        MatrixEntry::Position(_) => mechanism.characteristic_length(),
                        MatrixEntry::Rotation(..) => 1.0,
                    };
                    let size = natural.max(given.abs()).max(found.abs());
                    Ok([given, found, size])
                });
                compared.collect()
            }
            GivenForm::Identities(identities) => (identities.iter())
                .map(|(_, formula)| {
                    let found = measured(mechanism, form, formula, joints)?;
                    Ok([found.value, 0.0, found.size()])
                })
                .collect(),
        };
        let components = self.components.iter_mut().zip(&mut self.conditions);
        for ((component, conditions), compared) in components.zip(compared) {
            let holds = conditions.hold(mechanism, form, joints);
            let Some([closed_form, chains, size]) = compared.ok().filter(|_| holds) else {
                component.without_value += 1;
                continue;
            };
            let difference = (closed_form - chains).abs();
            if difference != 0.0 {
                component.relative = component.relative.max(difference / size);
            }
            component.samples += 1;
            if component.worst.is_none() || difference > component.max_difference {
                component.max_difference = difference;
                component.worst = Some(WorstSample {
                    joints: mechanism.named_joints(joints),
                    closed_form,
                    chains,
                });
            }
        }
    }

    fn report(self, mechanism: &Mechanism, tolerance: f64, watch: &Watch) -> FormReport {
        let Checked {
            form,
            mut components,
            conditions,
        } = self;
        for (component, conditions) in components.iter_mut().zip(conditions) {
            conditions.settle(mechanism, form, component, tolerance);
        }
        for component in components.iter_mut().filter(|c| c.worst.is_some()) {
            // what is proved may still be off by what solving leaves near singular configurations, and beside terms that
            // all vanish there: by the root of the residual
            let relative = component.relative;
            let off = relative > SAME && component.max_difference > tolerance;
            let refuted = matches!(component.proof, ComponentProof::Different(_));
            component.agree = !refuted && relative <= tolerance || component.proof.proved() && !off;
        }
        let refuted = |component: &ComponentReport| {
            let open = component.proof == ComponentProof::undecided(Reason::NeedsElimination);
            !component.agree && component.samples > 0 && open
        };
        if components.iter().any(refuted) && !watch.is_stopped() {
            // what numbers refute is written out
            let differences = proof::refutations(mechanism, form);
            for (component, difference) in components.iter_mut().zip(differences) {
                if let (true, Some(difference)) = (refuted(component), difference) {
                    component.proof = ComponentProof::Different(Box::new(difference));
                }
            }
        }
        let tried = || components.iter().filter(|c| c.samples > 0);
        let verdict = match components.iter().all(|component| component.agree) {
            _ if tried().any(|component| !component.agree) => Verdict::Disagrees,
            true if !components.is_empty() => Verdict::Agrees,
            _ if components
                .iter()
                .any(|c| c.samples == 0 && c.without_value > 0) =>
            {
                Verdict::Undefined
            }
            _ => Verdict::NotTried,
        };
        let worst = tried()
            .reduce(|a, b| if b.relative > a.relative { b } else { a })
            .and_then(|component| component.worst.as_ref());
        FormReport {
            name: form.name.clone(),
            agree: verdict == Verdict::Agrees,
            verdict,
            max_difference: (components.iter()).fold(0.0, |m, c| c.max_difference.max(m)),
            samples: components.iter().map(|c| c.samples).max().unwrap_or(0),
            source: form.source.clone(),
            worst: worst.map_or(ByName::default(), |worst| worst.joints.clone()),
            components,
        }
    }
}
