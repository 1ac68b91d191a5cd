//! The values of a closed form's formulas.

use crate::algebra::{EvaluationError, Node, Operator};
use crate::mechanism::{ClosedForm, Formula, Mechanism, Symbol};
use crate::number::tolerance::{SAME, SUMMED};
use crate::number::{Dual, Number};

/// Values of the names in a closed form at some joint values.
pub(super) struct NamedValues<T> {
    parameters: Vec<T>,
    joints: Vec<T>,
    locals: Vec<Result<T, EvaluationError>>,
}

impl<T: Number> NamedValues<T> {
    /// Values at joint values, with the parameters of the mechanism.
    pub fn at(mechanism: &Mechanism, form: &ClosedForm, joints: &[T]) -> Self {
        let parameters = mechanism.parameters().iter();
        let parameters = parameters.map(|p| T::from_f64(p.value)).collect();
        NamedValues::new(form, parameters, joints.to_vec(), &[])
    }

    /// For given values of parameters and joints, and of some local names.
    pub fn new(
        form: &ClosedForm,
        parameters: Vec<T>,
        joints: Vec<T>,
        replaced: &[Option<T>],
    ) -> Self {
        let mut values = NamedValues {
            parameters,
            joints,
            locals: Vec::with_capacity(form.locals.len()),
        };
        for (i, (_, formula)) in form.locals.iter().enumerate() {
            let value = match replaced.get(i) {
                Some(Some(value)) => Ok(*value),
                _ => values.of(formula),
            };
            values.locals.push(value);
        }
        values
    }

    /// The value of a formula. A local name without a value is to blame only where it is used.
    pub fn of(&self, formula: &Formula) -> Result<T, EvaluationError> {
        for (symbol, _) in formula.names() {
            if let Symbol::Local(local) = *symbol {
                self.locals[local].clone()?;
            }
        }
        formula.evaluate(&|symbol| match *symbol {
            Symbol::Parameter(i) => self.parameters[i],
            Symbol::Joint(i) => self.joints[i],
            Symbol::Local(i) => (self.locals[i].clone()).unwrap_or(T::from_f64(f64::NAN)),
        })
    }
}

/// The value of a formula with the sizes that it is compared with.
pub(super) struct MeasuredFormula {
    pub value: f64,
    /// The absolute terms of its sum.
    terms: f64,
    /// The change for a joint motion of natural size, Σ |∂f/∂qⱼ| sⱼ: ε times that is an error of ε in a joint.
    motion: f64,
}

impl MeasuredFormula {
    /// The size relative to which the value of an identity is small.
    pub fn size(&self) -> f64 {
        self.terms + self.motion
    }

    /// True if it may be zero at the configuration that this one was solved for.
    pub fn is_zero(&self) -> bool {
        self.value.abs() <= SAME * self.motion + SUMMED * self.terms
    }
}

/// The value of a formula at joint values.
pub(super) fn measured(
    mechanism: &Mechanism,
    form: &ClosedForm,
    formula: &Formula,
    joints: &[f64],
) -> Result<MeasuredFormula, EvaluationError> {
    let values = NamedValues::at(mechanism, form, joints);
    let (value, terms) = (values.of(formula)?, terms(&values, formula)?);
    let mut motion = 0.0;
    let mut moving: Vec<Dual<f64>> = joints.iter().map(|&x| Dual::constant(x)).collect();
    let scales = &mechanism.dimensions().joint_scales;
    for (joint, scale) in scales.iter().enumerate() {
        moving[joint].slope = *scale;
        // a slope that is not finite says nothing
        if let Ok(moved) = NamedValues::at(mechanism, form, &moving).of(formula) {
            motion += moved.slope.abs();
        }
        moving[joint].slope = 0.0;
    }
    Ok(MeasuredFormula {
        value,
        terms,
        motion,
    })
}

/// The sum of the absolute values of the terms an expression adds up.
fn terms(values: &NamedValues<f64>, formula: &Formula) -> Result<f64, EvaluationError> {
    match &formula.node {
        Node::Binary(Operator::Add | Operator::Subtract, x, y) => {
            Ok(terms(values, x)? + terms(values, y)?)
        }
        Node::Negate(x) => terms(values, x),
        _ => Ok(values.of(formula)?.abs()),
    }
}
