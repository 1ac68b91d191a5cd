//! Display of a mechanism on a page, in the words and numbers of the command line.

use serde_json::{Value, json};

use crate::algebra::{Measure, SiUnit};
use crate::ask::Steering;
use crate::description::{Description, Lines, Problem, Severity};
use crate::mechanism::{Configuration, Mechanism};
use crate::output::complaint::Complaint;
use crate::output::quantity::{number, quantity};
use crate::system::{Coordinate, Freedoms, sampling_range};

/// Problems of a file with where they are; lines and columns from 1.
pub fn problems(text: &str, problems: &[Problem]) -> Vec<Value> {
    let lines = Lines::new(text);
    let shown = problems.iter().map(|problem| {
        let said = Complaint::of(problem);
        let (line, column) = lines.position(problem.span.start);
        let units = |bytes: usize| {
            text.get(..bytes)
                .map(|before| before.encode_utf16().count())
        };
        json!({
            "severity": match problem.severity() {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            "line": line,
            "column": column,
            // as scripts count characters
            "from": units(problem.span.start),
            "to": units(problem.span.end),
            "title": said.title,
            "label": said.label,
            "help": said.help,
        })
    });
    shown.collect()
}

/// The parts that do not change as it moves.
pub fn mechanism(mechanism: &Mechanism, description: &Description) -> Value {
    let parameters = mechanism.parameters().iter().zip(&description.parameters);
    let parameters = parameters.map(|(parameter, described)| {
        json!({
            "name": &*parameter.name,
            "written": described.value.expression.to_string(),
            "value": parameter.value,
            "angle": parameter.measure == Measure::Angle,
            // only a number can be slid; the others follow
            "free": parameter.definition.names().next().is_none(),
        })
    });
    let home = mechanism.home();
    let length = mechanism.characteristic_length();
    let coordinates = Coordinate::all(mechanism).map(|of| {
        let angle = of.is_angle(mechanism);
        let (range, limits, driven) = match of {
            Coordinate::Joint(joint) => {
                let joint_of = &mechanism.joints()[joint];
                let range = sampling_range(joint_of, home.joints[joint], length);
                let driven = joint_of.role == crate::description::Role::Actuated;
                (range, joint_of.limits, driven)
            }
            _ if angle => ((-std::f64::consts::PI, std::f64::consts::PI), None, false),
            _ => (
                (
                    of.of(mechanism, &home) - length,
                    of.of(mechanism, &home) + length,
                ),
                None,
                false,
            ),
        };
        json!({
            "name": of.name(mechanism),
            "angle": angle,
            "joint": matches!(of, Coordinate::Joint(_)),
            "driven": driven,
            "range": [range.0, range.1],
            "limits": limits.map(|(low, high)| [low, high]),
        })
    });
    json!({
        "name": mechanism.name(),
        "source": mechanism.source(),
        "length": length,
        "coordinates": coordinates.collect::<Vec<_>>(),
        "parameters": parameters.collect::<Vec<_>>(),
        "loaded": !mechanism.loads().is_empty(),
        "outputs": mechanism.outputs().iter().map(|output| &output.name).collect::<Vec<_>>(),
    })
}

/// The coordinates as they are, in the order of [`mechanism`]: in rad or m, and as they are read.
pub fn values(mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<Value> {
    let values = Coordinate::all(mechanism).map(|of| {
        let value = of.of(mechanism, at);
        let unit = SiUnit::of_coordinate(of.is_angle(mechanism));
        json!([value, quantity(value, unit)])
    });
    values.collect()
}

/// The names of the held coordinates.
pub fn held(steering: &Steering) -> Vec<String> {
    let driven = steering.driven().iter();
    driven.map(|of| of.name(steering.mechanism())).collect()
}

/// Distance of the mechanism from a singular configuration.
pub fn figures(steering: &Steering) -> Value {
    let mechanism = steering.mechanism();
    let freedoms = Freedoms::at(mechanism.dimensions(), &steering.held(), steering.at());
    let condition = freedoms.condition();
    json!({
        "condition": condition.is_finite().then_some(condition),
        "stopped": steering.is_stopped(),
        "shown": match condition.is_finite() {
            true => number(condition),
            false => "infinite".into(),
        },
    })
}
