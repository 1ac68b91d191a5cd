//! Expression → constant + Σ coefficient·variable.

use linkwork::algebra::*;

fn affine(text: &str) -> Result<Affine<String>, NonAffine> {
    Expression::parse(text)
        .unwrap()
        .affine(|name| matches!(name.as_str(), "q" | "phi1" | "phi2"))
}

fn parts(text: &str) -> String {
    let Affine { constant, terms } = affine(text).unwrap();
    let terms = terms
        .iter()
        .map(|(name, coefficient)| format!(" | {name}: {coefficient}"));
    format!("{constant}{}", terms.collect::<String>())
}

#[test]
fn the_entries_of_printed_tables_come_apart() {
    assert_eq!(parts("pi/2 - phi1"), "pi/2 | phi1: -1");
    assert_eq!(parts("-q"), "0 | q: -1");
    assert_eq!(parts("2*q"), "0 | q: 2");
    assert_eq!(parts("phi1 + phi2"), "0 | phi1: 1 | phi2: 1");
    assert_eq!(parts("n*q + 0.1"), "0.1 | q: n");
    assert_eq!(parts("a*b"), "a*b");
    assert_eq!(parts("q"), "0 | q: 1");
}

#[test]
fn terms_of_one_variable_are_merged() {
    assert_eq!(parts("phi1 - phi1"), "0");
    assert_eq!(parts("3*q - q/2 + 1 + q"), "1 | q: 3.5");
    assert_eq!(parts("a*q - a*q"), "0");
    assert_eq!(parts("a*q + q"), "0 | q: a + 1");
    assert_eq!(parts("0*q + a"), "a");
}

#[test]
fn products_and_quotients_by_constants_are_distributed() {
    assert_eq!(parts("n*(q + 1)"), "n | q: n");
    assert_eq!(parts("(q - a)/2"), "-a/2 | q: 0.5");
    assert_eq!(parts("-(2*(phi1 - 3) - phi2)*2"), "12 | phi1: -4 | phi2: 2");
    assert_eq!(parts("(phi1 - phi1 + a)^2 + q"), "a^2 | q: 1");
}

#[test]
fn a_doubtful_division_is_left_to_evaluation() {
    assert_eq!(parts("q/(a - a)"), "0/(a - a) | q: 1/(a - a)");
}
