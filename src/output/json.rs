//! The envelope every JSON answer has.

use serde::Serialize;
use serde_json::{Map, Value};

use super::document::Report;

/// The report as JSON: its own fields, after the program's version, the mechanism's name and the
/// answer in words. Numbers are in SI units and rad.
pub fn render(report: &impl Report) -> String {
    let document = report.shown();
    let mut object = Map::new();
    object.insert("linkwork".into(), env!("CARGO_PKG_VERSION").into());
    object.insert("mechanism".into(), document.title.into());
    if !document.answer.is_empty() {
        object.insert("sentence".into(), document.answer.into());
    }
    for (name, sentence) in report.sentences() {
        object.insert(name.into(), sentence.into());
    }
    for (name, sentences) in report.lists() {
        object.insert(name.into(), sentences.into());
    }
    extended(object, report)
}

/// The fields of a report after those of the envelope. Numbers keep all their digits; one that is
/// not finite is written as `null`, a negative zero as zero.
fn extended(mut object: Map<String, Value>, report: &impl Serialize) -> String {
    let report = serde_json::to_value(report)
        .expect("the keys of every map in a report are texts, which alone could fail");
    if let Value::Object(report) = report {
        object.extend(report);
    }
    let mut document = Value::Object(object);
    unsign_zeros(&mut document);
    format!("{document:#}\n")
}

/// A zero has no sign: what is left of one tells of the way a number was computed.
fn unsign_zeros(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() && number.as_f64() == Some(0.0) => {
            *value = 0.0.into();
        }
        Value::Array(parts) => parts.iter_mut().for_each(unsign_zeros),
        Value::Object(parts) => parts.values_mut().for_each(unsign_zeros),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_have_no_sign_however_deep() {
        let report = serde_json::json!({ "a": [-0.0, [-1.5, { "b": -0.0 }]], "c": -0.0 });
        let written: Value = serde_json::from_str(&extended(Map::new(), &report)).unwrap();
        assert_eq!(written["a"].to_string(), "[0.0,[-1.5,{\"b\":0.0}]]");
        assert_eq!(written["c"].to_string(), "0.0");
    }
}
