//! Why a mode was not followed, as a document.

use super::tables::times;
use crate::analysis::assemblies::{Fold, LostMode, LostReason};
use crate::mechanism::{PoseCoordinate, Variable};
use crate::output::document::{Document, Report, Section};
use crate::output::quantity::{number, quantity};

impl Report for LostMode {
    fn document(&self) -> Document {
        let document = Document::new(&self.mechanism, sentence(self));
        let (LostReason::Ceases(fold) | LostReason::MeetsOthers(fold)) = &self.reason else {
            return document;
        };
        let inputs = (fold.inputs.0.iter())
            .map(|(name, value)| format!("{name} = {}", input(&self.variables, name, *value)));
        let joints = fold.joints.0.iter().zip(&self.variables);
        let joints = joints.map(|((name, value), joint)| {
            format!("{name} = {}", quantity(*value, joint.unit.is_angle()))
        });
        document
            .section(Section::new("Inputs there").list(inputs))
            .section(Section::new("Joints there").list(joints))
    }
}

fn sentence(lost: &LostMode) -> String {
    let mode = lost.mode;
    let percent = |fold: &Fold| number(100.0 * fold.fraction);
    match &lost.reason {
        LostReason::Ceases(fold) => format!(
            "Mode {mode} ceases to exist {} % of the way from home, where it meets another mode.",
            percent(fold)
        ),
        LostReason::MeetsOthers(fold) => format!(
            "Mode {mode} cannot be followed beyond {} % of the way from home: it meets other \
             assemblies there, and its number does not tell which of them to follow.",
            percent(fold)
        ),
        LostReason::MeetAtHome { multiplicity } => {
            let what = match multiplicity {
                0 => "one of infinitely many connected assemblies".into(),
                n => format!("{}: {n} assemblies meet there", times(*n)),
            };
            format!(
                "At home mode {mode} is {what}, and its number does not tell which of them to \
                 follow. `linkwork assemblies` lists those at the inputs in question; \
                 a guess starts the search near one of them."
            )
        }
    }
}

/// An input with its unit: joints and platform coordinates by name, parts of quaternions without.
fn input(variables: &[Variable], name: &str, value: f64) -> String {
    if let Some(joint) = variables.iter().find(|joint| joint.name == name) {
        return quantity(value, joint.unit.is_angle());
    }
    let coordinate = name
        .rsplit_once('.')
        .and_then(|(_, c)| PoseCoordinate::from_word(c));
    coordinate.map_or(number(value), |c| quantity(value, c.is_angle()))
}
