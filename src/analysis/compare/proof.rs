//! Closed forms and chains brought to the same normal form.
//!
//! The chains run over letters, the closed form is evaluated over the same letters, and their difference is zero or is
//! printed. What holds only where the mechanism is assembled is proved if it is a sum of multiples of closure equations.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::Signed;
use serde::Serialize;

use super::consequence::{Span, follows, slip};
use super::elimination::{self, eliminated};
use super::formula::Values;
use crate::algebra::{Atom, Budget, Expression, Symbolic, Trigonometric, arrange, with_letters};
use crate::mechanism::{ClosedForm, Formal, Given, Letters, MatrixEntry, Mechanism, Symbol};
use crate::number::Number;

/// Products of two terms made at most for one closed form.
const MOST_PRODUCTS: usize = 100_000;
/// The same where loops are eliminated.
const MOST_PRODUCTS_OF_LOOPS: usize = 2_000_000;
/// A difference of more terms is not printed.
const MOST_TERMS: usize = 400;
/// Pairs of closures from which an identity is tried to be derived.
const MOST_PAIRS: usize = 15;

/// What was proved of one component of a closed form.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum Proof {
    /// It is what the chains give, for all values of joints and parameters at which it has a value.
    Identical,
    /// The same, but only with the numbers that the file gives its parameters.
    IdenticalForTheseDimensions,
    /// It is an equation of the closures, or a sum of multiples of some.
    FollowsFromClosures,
    /// The same, but only with the numbers that the file gives its parameters.
    FollowsForTheseDimensions,
    /// It is not what the chains give.
    Different(Box<Difference>),
    /// It is neither proved nor refuted: the numbers stand alone.
    NotDecided {
        /// Why.
        reason: Reason,
    },
}

/// How a closed form differs from the chains.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What the form has in the terms that differ; nothing if it has no such terms.
    pub closed_form: Expression,
    /// What the chains give there.
    pub chains: Expression,
    /// Closed form minus chains.
    pub difference: Expression,
}

/// Why a closed form is neither proved nor refuted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Roots, inverse functions or the like stand in it, which may depend on one another.
    NotPolynomial,
    /// It holds, if at all, only where the closures are whole, and is no sum of multiples of their equations.
    NeedsElimination,
    /// It depends on where a platform is, which only the closures tell.
    NeedsPlatform,
    /// It is too long.
    TooLong,
}

impl Proof {
    /// Whether it is proved.
    pub fn proved(&self) -> bool {
        use Proof::*;
        matches!(
            self,
            Identical
                | IdenticalForTheseDimensions
                | FollowsFromClosures
                | FollowsForTheseDimensions
        )
    }
}

/// What can be proved of each component of a form, in order.
pub(super) fn proofs(mechanism: &Mechanism, form: &ClosedForm) -> Vec<Proof> {
    let general = Attempt::new(mechanism, form, false);
    if general.proofs.iter().all(Proof::proved) {
        return general.proofs;
    }
    let special = Attempt::new(mechanism, form, true);
    let of_loops = matches!(form.gives, Given::Identities(_));
    let pairs = general.proofs.into_iter().zip(special.proofs);
    pairs
        .map(|(general, special)| match (general, special) {
            (general, _) if general.proved() => general,
            (_, Proof::FollowsFromClosures | Proof::FollowsForTheseDimensions) => {
                Proof::FollowsForTheseDimensions
            }
            (general, special) if of_loops && !special.proved() => general,
            (_, Proof::Identical) => Proof::IdenticalForTheseDimensions,
            // in letters it may only be hidden that it is zero; with numbers it is seen that it is not
            (Proof::Different(difference), _) => Proof::Different(difference),
            (_, special @ Proof::Different(_)) => special,
            (general, _) => general,
        })
        .collect()
}

/// How identities that numbers refute differ from what the closures give, in order; nothing where that is too long.
pub(super) fn refutations(mechanism: &Mechanism, form: &ClosedForm) -> Vec<Option<Difference>> {
    let Given::Identities(identities) = &form.gives else {
        return vec![];
    };
    let refutations = over_letters(mechanism, form, || {
        let setting = Setting::new(mechanism, form, false)?;
        let equations = setting.equations();
        let refuted = identities.iter();
        Some(
            refuted
                .map(|(_, formula)| setting.refuted(formula, &equations))
                .collect(),
        )
    });
    refutations.unwrap_or_else(|| vec![None; identities.len()])
}

/// Runs some work over the letters of a mechanism and a form.
fn over_letters<R>(mechanism: &Mechanism, form: &ClosedForm, work: impl FnOnce() -> R) -> R {
    let mut values = Letters(mechanism).values();
    values.resize(values.len() + form.locals.len(), 0.0);
    let products = match form.gives {
        Given::Pose { .. } => MOST_PRODUCTS,
        // the loops are seen from every link
        Given::Identities(_) => MOST_PRODUCTS_OF_LOOPS,
    };
    with_letters(values, Budget { products }, work)
}

struct Attempt {
    proofs: Vec<Proof>,
}

impl Attempt {
    /// With parameters as letters, or with the numbers of the file.
    fn new(mechanism: &Mechanism, form: &ClosedForm, numbers: bool) -> Self {
        let count = match &form.gives {
            Given::Pose { entries, .. } => entries.len(),
            Given::Identities(identities) => identities.len(),
        };
        let proofs = over_letters(mechanism, form, || {
            let setting = Setting::new(mechanism, form, numbers)?;
            Some(match &form.gives {
                Given::Pose {
                    of,
                    relative_to,
                    entries,
                } => {
                    if mechanism.carrier(*of) != mechanism.carrier(*relative_to) {
                        let reason = Reason::NeedsPlatform;
                        return Some(vec![Proof::NotDecided { reason }; count]);
                    }
                    let pose = setting.formal.transform(*relative_to, *of);
                    let proved = entries.iter().map(|(entry, formula)| {
                        let chains = match *entry {
                            MatrixEntry::Position(i) => pose.position.0[i],
                            MatrixEntry::Rotation(i, j) => pose.rotation.0[j].0[i],
                        };
                        setting.compared(formula, chains)
                    });
                    proved.collect()
                }
                Given::Identities(identities) => {
                    let equations = setting.equations();
                    let proved = identities.iter();
                    proved
                        .map(|(_, formula)| setting.vanishing(formula, &equations))
                        .collect()
                }
            })
        });
        let reason = Reason::TooLong;
        Attempt {
            proofs: proofs.unwrap_or_else(|| vec![Proof::NotDecided { reason }; count]),
        }
    }
}

/// The chains and the names of a closed form in letters.
struct Setting<'a> {
    form: &'a ClosedForm,
    letters: Letters<'a>,
    formal: Formal<'a>,
    values: Values<'a, Symbolic>,
}

impl<'a> Setting<'a> {
    fn new(mechanism: &'a Mechanism, form: &'a ClosedForm, numbers: bool) -> Option<Self> {
        let letters = Letters(mechanism);
        let independent = mechanism.independent_parameters().into_iter();
        let independent = independent.map(|i| {
            let definition = &mechanism.parameters()[i].definition;
            match numbers {
                true => definition.evaluate(&|_| Symbolic::zero()).ok(),
                false => Some(Symbolic::symbol(letters.parameter(i))),
            }
        });
        let independent: Vec<Symbolic> = independent.collect::<Option<_>>()?;
        let parameters = mechanism.parameters_from(&independent).ok()?;
        let (joints, replaced) = own_variables(&letters, form, &parameters);
        let formal = Formal::new(mechanism, &parameters, joints.clone()).ok()?;
        let values = Values::over(form, parameters, joints, &replaced);
        Some(Setting {
            form,
            letters,
            formal,
            values,
        })
    }

    fn name(&self, symbol: u32) -> String {
        let first = self.letters.local(0);
        match symbol
            .checked_sub(first)
            .and_then(|local| self.form.locals.get(local as usize))
        {
            Some((name, _)) => name.clone(),
            None => self.letters.name(symbol),
        }
    }

    fn compared(&self, formula: &crate::mechanism::Formula, chains: Symbolic) -> Proof {
        let form = self.values.of(formula).ok().and_then(Symbolic::formula);
        let (Some(form), Some(chains)) = (form, chains.formula()) else {
            let reason = Reason::TooLong;
            return Proof::NotDecided { reason };
        };
        self.decided(&form, &chains)
    }

    fn decided(&self, form: &Trigonometric, chains: &Trigonometric) -> Proof {
        let difference = form.minus(chains);
        let mut budget = Budget {
            products: MOST_PRODUCTS,
        };
        match difference.vanishes(&mut budget) {
            Some(true) => Proof::Identical,
            Some(false) if difference.len() > MOST_TERMS => {
                let reason = Reason::TooLong;
                Proof::NotDecided { reason }
            }
            Some(false) => {
                let own = form.restricted_to(&difference);
                let theirs = chains.restricted_to(&difference);
                Proof::Different(Box::new(self.written(&own, &theirs, &difference)))
            }
            None => Proof::NotDecided {
                reason: match difference.is_opaque() {
                    true => Reason::NotPolynomial,
                    false => Reason::TooLong,
                },
            },
        }
    }

    /// The equations of all closures.
    fn equations(&self) -> Vec<Trigonometric> {
        let closures = 0..self.letters.0.closures().len();
        closures
            .flat_map(|closure| self.of_closure(closure))
            .collect()
    }

    fn of_closure(&self, closure: usize) -> Vec<Trigonometric> {
        let conditions = self.formal.closure(closure).conditions.into_iter();
        let formulas = conditions.filter_map(|condition| Some((*condition.formula()?).clone()));
        formulas.filter(|formula| !formula.is_empty()).collect()
    }

    /// The sum of which a root is a part, times the same with the other sign of the root: P a² − b² of a√P + b, where b is
    /// a negative number and a a positive one, so that the other factor is not zero.
    fn without_root(&self, form: &Trigonometric, budget: &mut Budget) -> Option<Trigonometric> {
        let is_root = |(atom, power): &(Atom, i32)| matches!(atom, Atom::Root(_)) && *power == 1;
        let mut other = Trigonometric::zero();
        let mut rest = Trigonometric::zero();
        let mut roots = 0;
        for (key, coefficient) in form.terms() {
            let part = Trigonometric::term(key.clone(), coefficient.clone());
            match key.powers.iter().any(is_root) {
                true => {
                    let alone = key.powers.len() == 1 && key.wave.0.is_empty() && !key.imaginary;
                    if !alone || !coefficient.is_positive() {
                        return None;
                    }
                    roots += 1;
                    other = other.plus(&part);
                }
                false => rest = rest.plus(&part),
            }
        }
        let constants = self.letters.joint(0);
        let constant = rest.symbols().iter().all(|symbol| *symbol < constants);
        let values = self.letters.values();
        let negative = rest.value(&|symbol| values[symbol as usize]) < 0.0;
        if roots != 1 || !constant || !negative {
            return None;
        }
        form.times(&other.minus(&rest), budget)
    }

    /// Whether an identity follows from some of the equations.
    fn consequence(
        &self,
        form: &Trigonometric,
        equations: &[Trigonometric],
        budget: &mut Budget,
    ) -> bool {
        let first = self.letters.platform(0, 0);
        if Span::new(equations).contains(form) || follows(form, equations, first, budget) {
            return true;
        }
        // two closures are enough for what holds between two legs
        let count = self.letters.0.closures().len();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
        for pair in pairs.take(if count > 2 { MOST_PAIRS } else { 0 }) {
            let mut own = Vec::new();
            for closure in pair {
                own.extend(self.of_closure(closure));
            }
            if follows(form, &own, first, budget) {
                return true;
            }
        }
        eliminated(form, &elimination::equations(self.letters.0, &self.formal))
    }

    /// How an identity differs from what the closures give: in one term, or altogether.
    fn refuted(
        &self,
        formula: &crate::mechanism::Formula,
        equations: &[Trigonometric],
    ) -> Option<Difference> {
        let form = self.values.of(formula).ok().and_then(Symbolic::formula)?;
        let mut budget = Budget {
            products: MOST_PRODUCTS,
        };
        let first = self.letters.platform(0, 0);
        let difference = match slip(&form, equations, first, &mut budget) {
            Some(slip) => slip,
            None => (*form).clone(),
        };
        (difference.len() <= MOST_TERMS).then(|| {
            let own = form.restricted_to(&difference);
            let theirs = own.minus(&difference);
            self.written(&own, &theirs, &difference)
        })
    }

    fn written(
        &self,
        own: &Trigonometric,
        theirs: &Trigonometric,
        difference: &Trigonometric,
    ) -> Difference {
        let all = [own, theirs, difference];
        let mut expressions = arrange(&all, &|symbol| self.name(symbol)).expressions;
        let mut next = || expressions.remove(0);
        Difference {
            closed_form: next(),
            chains: next(),
            difference: next(),
        }
    }

    fn vanishing(&self, formula: &crate::mechanism::Formula, equations: &[Trigonometric]) -> Proof {
        let not_decided = |reason| Proof::NotDecided { reason };
        let Some(form) = self.values.of(formula).ok().and_then(Symbolic::formula) else {
            return not_decided(Reason::TooLong);
        };
        let mut budget = Budget {
            products: MOST_PRODUCTS,
        };
        if form.vanishes(&mut budget) == Some(true) {
            return Proof::Identical;
        }
        if Span::new(equations).contains(&form) {
            return Proof::FollowsFromClosures;
        }
        let Some(form) = form.without_denominators(&mut budget) else {
            return not_decided(Reason::TooLong);
        };
        if self.consequence(&form, equations, &mut budget) {
            return Proof::FollowsFromClosures;
        }
        if let Some(squared) = self.without_root(&form, &mut budget)
            && self.consequence(&squared, equations, &mut budget)
        {
            return Proof::FollowsForTheseDimensions;
        }
        // a slip in an equation leaves less of it than there was
        let nearest = (equations.iter())
            .filter_map(|equation| form.nearest_multiple(equation))
            .min_by_key(|multiple| form.minus(multiple).len());
        match nearest {
            Some(nearest) if 2 * form.minus(&nearest).len() <= form.len() => {
                match self.decided(&form, &nearest) {
                    different @ Proof::Different(_) => different,
                    _ => not_decided(Reason::NeedsElimination),
                }
            }
            _ => not_decided(Reason::NeedsElimination),
        }
    }
}

/// Joint variables in terms of the form's own ones: where it defines θ₂ as 90° − φ₂ and uses φ₂ nowhere else, the joint is
/// 90° − θ₂, and a difference is printed in θ₂. Also which locals are letters for that reason.
fn own_variables(
    letters: &Letters,
    form: &ClosedForm,
    parameters: &[Symbolic],
) -> (Vec<Symbolic>, Vec<Option<Symbolic>>) {
    let mut joints = letters.joints();
    let mut replaced = vec![None; form.locals.len()];
    let formulas: Vec<&crate::mechanism::Formula> = match &form.gives {
        Given::Pose { entries, .. } => entries.iter().map(|(_, formula)| formula).collect(),
        Given::Identities(identities) => identities.iter().map(|(_, formula)| formula).collect(),
    };
    let locals = form.locals.iter().map(|(_, formula)| formula);
    let all: Vec<&crate::mechanism::Formula> = locals.chain(formulas).collect();
    for (local, (_, definition)) in form.locals.iter().enumerate() {
        let used: Vec<Symbol> = definition.names().map(|(symbol, _)| *symbol).collect();
        let [Symbol::Joint(joint)] = used.as_slice() else {
            continue;
        };
        let uses = all.iter().flat_map(|formula| formula.names());
        let alone = uses
            .filter(|(symbol, _)| **symbol == Symbol::Joint(*joint))
            .count()
            == 1;
        let of = |value: Symbolic| {
            let value = definition.evaluate(&|symbol| match *symbol {
                Symbol::Parameter(i) => parameters[i],
                _ => value,
            });
            value.ok()
        };
        let symbol = Symbolic::symbol(letters.joint(*joint));
        let (Some(whole), Some(constant)) = (of(symbol), of(Symbolic::zero())) else {
            continue;
        };
        let slope = whole - constant;
        if alone && (slope == symbol || slope == -symbol) {
            let own = Symbolic::symbol(letters.local(local));
            let rest = own - constant;
            joints[*joint] = if slope == symbol { rest } else { -rest };
            replaced[local] = Some(own);
        }
    }
    (joints, replaced)
}

impl Trigonometric {
    /// The multiple of the other that shares a term with it and leaves the fewest.
    fn nearest_multiple(&self, other: &Self) -> Option<Self> {
        let common = other
            .terms()
            .filter_map(|(key, coefficient)| Some(self.coefficient(key)? / coefficient));
        // the ratio that most terms have
        let mut ratios: BTreeMap<BigRational, usize> = BTreeMap::new();
        common.for_each(|ratio| *ratios.entry(ratio).or_default() += 1);
        let (ratio, _) = ratios.into_iter().max_by_key(|(_, count)| *count)?;
        Some(other.scaled(&ratio))
    }
}
