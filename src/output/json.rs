//! The envelope every JSON answer has.

use serde::Serialize;
use serde_json::{Map, Value};

/// A report as a JSON object that begins with the program's version and the mechanism's name.
///
/// Numbers keep all their digits; one that is not finite is written as `null`.
pub(super) fn document(mechanism: &str, report: &impl Serialize) -> String {
    let mut object = Map::new();
    object.insert("linkwork".into(), env!("CARGO_PKG_VERSION").into());
    object.insert("mechanism".into(), mechanism.into());
    let report = serde_json::to_value(report)
        .expect("the keys of every map in a report are texts, which alone could fail");
    if let Value::Object(report) = report {
        object.extend(report);
    }
    format!("{:#}\n", Value::Object(object))
}
