//! Conditions under which the proof of a closed form says something about a configuration: no divisor is zero.
//!
//! A proof clears denominators. f·D = 0 says f = 0 only where D is not zero; where the closures make D zero everywhere, f
//! has no value, and any f would be "proved".

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::formula::{NamedValues, measured};
use super::proof::{self, ComponentProof, Reason};
use super::{ComponentQuantity, ComponentReport};
use crate::algebra::{Expression, Function, Node, Operator};
use crate::mechanism::{ClosedForm, Formula, Mechanism, Symbol};
use crate::number::Interval;
use crate::number::tolerance::SAME;

/// A formula in a closed form that must not be zero, and is not proved never to be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FormDivisor {
    /// A divisor of the form; cos x for tan x, √(x² + y²) for atan2(y, x), the argument of a logarithm.
    pub formula: Expression,
    /// True if chains and closures make it zero on every configuration.
    pub vanishes: bool,
    /// Samples at which it is zero, as far as configurations are solved exactly.
    pub zeros: usize,
}

/// The formulas that decide at samples if a proof of one component counts.
pub(super) struct ProofConditions {
    /// The divisors, with the number of samples at which they are zero.
    divisors: Vec<(Formula, usize)>,
    /// The difference between the form and the chains, in letters.
    difference: Option<Formula>,
    /// True once the difference is not zero at some sample.
    refuted: bool,
}

impl ProofConditions {
    pub fn new(
        mechanism: &Mechanism,
        form: &ClosedForm,
        formula: &Formula,
        proof: &ComponentProof,
    ) -> Self {
        let mut divisors: Vec<Formula> = Vec::new();
        visit(form, formula, &mut BTreeSet::new(), &mut |part| {
            divisors.extend(divisor(mechanism, part).filter(|own| !divisors.contains(own)));
        });
        divisors.retain(|divisor| !is_never_zero(mechanism, form, divisor));
        let difference = match proof {
            ComponentProof::Different(of) => resolved(mechanism, form, &of.difference),
            _ => None,
        };
        ProofConditions {
            divisors: divisors.into_iter().map(|divisor| (divisor, 0)).collect(),
            difference,
            refuted: false,
        }
    }

    /// True if no divisor is zero at a sample.
    pub fn hold(&mut self, mechanism: &Mechanism, form: &ClosedForm, joints: &[f64]) -> bool {
        let is_zero = |formula: &Formula| {
            let measured = measured(mechanism, form, formula, joints);
            measured.is_ok_and(|measured| measured.is_zero())
        };
        let mut hold = true;
        for (divisor, zeros) in &mut self.divisors {
            if is_zero(divisor) {
                *zeros += 1;
                hold = false;
            }
        }
        // terms that cancel may leave a root of their rounding
        let differs = |formula: &Formula| {
            let scales = &mechanism.dimensions().joint_scales;
            let near = (joints.iter().zip(scales))
                .map(|(joint, scale)| Interval::around(*joint, SAME * scale));
            is_not_zero(mechanism, form, formula, near.collect())
        };
        self.refuted |= hold && self.difference.as_ref().is_some_and(differs);
        hold
    }

    /// The proof of a component after its samples, and the divisors that it depends on.
    pub fn settle(
        self,
        mechanism: &Mechanism,
        form: &ClosedForm,
        component: &mut ComponentReport,
        tolerance: f64,
    ) {
        let tried = component.samples + component.without_value;
        let zeros = self.divisors.iter().filter(|(_, zeros)| *zeros == tried);
        let zeros: Vec<&Formula> = zeros.map(|(formula, _)| formula).collect();
        let vanish = proof::vanishing(mechanism, form, &zeros);
        let vanish: Vec<&Formula> = (zeros.into_iter().zip(vanish))
            .filter_map(|(formula, vanishes)| vanishes.then_some(formula))
            .collect();
        let proved = component.proof.proved();
        let nowhere = tried > 0 || proved && !self.divisors.is_empty();
        if component.samples == 0 && nowhere {
            component.proof = ComponentProof::undecided(match proved && !vanish.is_empty() {
                true => Reason::Undefined,
                false => Reason::NoValue,
            });
        } else if matches!(component.proof, ComponentProof::Different(_))
            && !self.refuted
            && component.relative <= tolerance
        {
            // letters that differ may stand for the same number here
            component.proof = ComponentProof::undecided(match component.quantity {
                ComponentQuantity::Identity => Reason::NeedsElimination,
                ComponentQuantity::Position | ComponentQuantity::Rotation => Reason::NotPolynomial,
            });
        }
        let divisors = self.divisors.iter().map(|(formula, zeros)| FormDivisor {
            formula: named(mechanism, form, formula),
            vanishes: vanish.contains(&formula),
            zeros: *zeros,
        });
        component.divisors = divisors.collect();
    }
}

/// Visits a formula, its parts, and the definitions of the names that it uses, each once.
fn visit(
    form: &ClosedForm,
    formula: &Formula,
    seen: &mut BTreeSet<usize>,
    visitor: &mut impl FnMut(&Formula),
) {
    visitor(formula);
    match formula.node {
        Node::Name(Symbol::Local(local)) if seen.insert(local) => {
            visit(form, &form.locals[local].1, seen, visitor);
        }
        _ => (formula.operands()).for_each(|part| visit(form, part, seen, visitor)),
    }
}

/// A formula that must not be zero for an operation to have a value.
fn divisor(mechanism: &Mechanism, operation: &Formula) -> Option<Formula> {
    let call = |function, of: &[Formula]| Node::Call(function, of.to_vec()).at(0..0);
    match &operation.node {
        Node::Binary(Operator::Divide, _, by) => Some((**by).clone()),
        Node::Binary(Operator::Power, base, exponent) => {
            let value = exponent.evaluate(&|symbol| match *symbol {
                Symbol::Parameter(i) => mechanism.parameters()[i].value,
                Symbol::Joint(_) | Symbol::Local(_) => f64::NAN,
            });
            (!value.is_ok_and(|value| value >= 0.0)).then(|| (**base).clone())
        }
        Node::Call(Function::Tan, of) => Some(call(Function::Cos, of)),
        Node::Call(Function::Atan2, of) => Some(call(Function::Hypot, of)),
        Node::Call(Function::Ln, of) => Some(of[0].clone()),
        _ => None,
    }
}

/// True if interval arithmetic shows that a formula is not zero at any joint values.
fn is_never_zero(mechanism: &Mechanism, form: &ClosedForm, formula: &Formula) -> bool {
    // in rad or m
    let anywhere = |_| Interval::around(0.0, 1e9);
    let joints = mechanism.joints().iter().map(anywhere);
    is_not_zero(mechanism, form, formula, joints.collect())
}

/// True if interval arithmetic shows that a formula is not zero at any of some joint values.
fn is_not_zero(
    mechanism: &Mechanism,
    form: &ClosedForm,
    formula: &Formula,
    joints: Vec<Interval>,
) -> bool {
    let parameters = mechanism.parameters().iter();
    let parameters = parameters.map(|parameter| Interval::point(parameter.value));
    let range = NamedValues::new(form, parameters.collect(), joints, &[]).of(formula);
    range.is_ok_and(|range| !range.contains(0.0))
}

/// The formula with names as they are written.
fn named(mechanism: &Mechanism, form: &ClosedForm, formula: &Formula) -> Expression {
    let named = formula.try_resolve(|symbol, _| {
        Ok::<_, ()>(match *symbol {
            Symbol::Parameter(i) => mechanism.parameters()[i].name.to_string(),
            Symbol::Joint(i) => mechanism.joints()[i].name.clone(),
            Symbol::Local(i) => form.locals[i].0.clone(),
        })
    });
    named.expect("every symbol has a name")
}

/// The formula of an expression over the names of a form; `None` if others stand in it, as those of platforms.
fn resolved(mechanism: &Mechanism, form: &ClosedForm, of: &Expression) -> Option<Formula> {
    let parameters = mechanism.parameters().iter().map(|p| &*p.name);
    let parameters: Vec<&str> = parameters.collect();
    let symbol_of = |name: &String, _: &_| {
        let local = form.locals.iter().position(|(own, _)| own == name);
        let joint = || mechanism.joints().iter().position(|own| own.name == *name);
        let parameter = || parameters.iter().position(|own| own == name);
        let known = local.map(Symbol::Local);
        let known = known.or_else(|| joint().map(Symbol::Joint));
        known
            .or_else(|| parameter().map(Symbol::Parameter))
            .ok_or(())
    };
    of.try_resolve(symbol_of).ok()
}
