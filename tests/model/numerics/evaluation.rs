//! Values of expressions.

use linkwork::algebra::EvaluationErrorKind::NotFinite;
use linkwork::algebra::Expression;

#[test]
fn a_name_without_a_finite_value_is_pointed_at() {
    let expression = Expression::parse("1 + x").unwrap();
    let error = expression.evaluate(&|_| f64::NAN).unwrap_err();
    assert_eq!((error.kind, error.span), (NotFinite, 4..5));
}

#[test]
fn whole_powers_of_negative_numbers_have_values() {
    let expression = Expression::parse("(-2)^3 + (-2)^n").unwrap();
    assert_eq!(expression.evaluate(&|_| 2.0), Ok(-4.0));
}
