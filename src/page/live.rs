//! Values that a page reads off the mechanism while it moves, in the words and numbers of the command line.

use serde_json::{Value, json};

use super::request::Press;
use super::{RefusedReply, nothing, words};
use crate::algebra::SiUnit;
use crate::ask::Steering;
use crate::geometry::Vector3;
use crate::mechanism::Point;
use crate::output::complaint::no_point;
use crate::output::drawing::movement;
use crate::output::quantity::{quantity, three_digits};
use crate::scene::{ForceArrow, Scene};
use crate::solve::Watch;

const TRANSMISSION: &str = "transmission";
const UNKNOWN: &str = "not determined";

/// The quantities that the file names, and the transmission angle if there is one.
pub fn usual(steering: &Steering) -> String {
    let outputs = steering.mechanism().outputs().iter();
    let mut names: Vec<&str> = outputs.map(|output| output.name.as_str()).collect();
    if !names.contains(&TRANSMISSION) {
        names.push(TRANSMISSION);
    }
    let known = |name: &&str| {
        let readings = steering.readings(name);
        readings.is_ok_and(|readings| readings.iter().all(|of| of.value.is_some()))
    };
    names.retain(known);
    names.join(", ")
}

/// Quantities as they are now.
pub fn readings(steering: &Steering, list: &str) -> Value {
    if list.is_empty() {
        return json!([]);
    }
    match steering.readings(list) {
        Ok(readings) => readings
            .iter()
            .map(|of| {
                let shown = of.value.map(|value| quantity(value, of.unit));
                json!([of.name, shown.unwrap_or_else(|| UNKNOWN.into())])
            })
            .collect(),
        Err(error) => json!({ "error": words::refused(&steering.question(), &error) }),
    }
}

/// The forces that balance a load, in the scene and as numbers of the held coordinates.
pub fn pressed(steering: &Steering, load: &Press, scene: Scene) -> (Scene, Value) {
    let mechanism = steering.mechanism();
    let point = match Point::read(mechanism, &load.point) {
        Ok(point) => point,
        Err(error) => {
            let why = words::in_a_line(no_point(mechanism, &error));
            return (scene, json!({ "error": why }));
        }
    };
    let found = steering.forces(&point, load.force, &Watch::none());
    let report = match found {
        Ok(found) => found.closed(),
        Err(error) => {
            return (
                scene,
                json!({ "error": words::refused(&steering.question(), &error) }),
            );
        }
    };
    let Some(report) = report else {
        return (scene, Value::Null);
    };
    let held = report.actuators.iter();
    let held = held.map(|force| {
        let known = force.unique.then(|| quantity(force.force, force.unit));
        json!([force.name, known.unwrap_or_else(|| UNKNOWN.into())])
    });
    let scene = scene.with_forces(mechanism, steering.at(), &report);
    let sizes = |of: fn(&ForceArrow) -> [f64; 3], unit| -> Vec<String> {
        let arrows = scene.arrows.iter();
        arrows
            .map(|arrow| three_digits(Vector3(of(arrow)).norm(), unit))
            .collect()
    };
    let forces = json!({
        "held": held.collect::<Vec<_>>(),
        "arrows": sizes(|arrow| arrow.force, SiUnit::NEWTON),
        "moments": sizes(|arrow| arrow.moment, SiUnit::NEWTON_METRE),
        "unbalanced": report.unbalanced,
    });
    (scene, forces)
}

/// The freedoms gained at a singular configuration, with the mechanism on both sides of each.
pub fn gained(steering: &Steering, watch: &Watch) -> Result<Value, RefusedReply> {
    let mechanism = steering.mechanism();
    let gained = steering.gained(watch);
    let gained = gained.map_err(|error| nothing(&words::refused(&steering.question(), &error)))?;
    let Some(gained) = gained else {
        return Ok(json!({ "scene": null, "words": [], "swings": [] }));
    };
    let scene = |at| Scene::of(mechanism, at);
    let there = scene(&gained.at).with_gained(&gained.report);
    let swings = gained.swings.iter();
    let swings = swings.map(|phases| phases.iter().map(scene).collect::<Vec<_>>());
    Ok(json!({
        "words": there.screws.iter().map(movement).collect::<Vec<_>>(),
        "scene": there,
        "swings": swings.collect::<Vec<_>>(),
    }))
}
