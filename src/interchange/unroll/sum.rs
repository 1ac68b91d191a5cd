//! Sums written as briefly as a person would write them.

use crate::algebra::Expression;
use crate::description::Entry;

/// constant + Σ factor · name, as text.
pub(super) fn sum(constant: Entry, terms: &[(String, f64)]) -> Entry {
    let mut text = String::new();
    for (name, factor) in terms.iter().filter(|(_, factor)| *factor != 0.0) {
        let size = factor.abs();
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        text += sign;
        if size != 1.0 {
            text += &format!("{size}*");
        }
        text += name;
    }
    if text.is_empty() {
        return constant;
    }
    if !constant.expression.is_zero() {
        let constant = constant.expression.to_string();
        text += &match constant.strip_prefix('-') {
            Some(size) => format!(" - {size}"),
            None => format!(" + {constant}"),
        };
    }
    let expression = Expression::parse(&text);
    Entry::from(expression.expect("sums of numbers and names are expressions"))
}
