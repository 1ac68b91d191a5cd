//! The outputs of a question, and the singularities that their choice may hide.

use serde::{Deserialize, Serialize};

use super::SingularitiesSettings;
use super::classify::Classifier;
use crate::linear::{norm, orthonormal, remove};
use crate::mechanism::{Configuration, Frame, Mechanism, PoseCoordinate};
use crate::number::tolerance::{SAME, STILL};
use crate::system::{
    Coordinate, Driven, Held, Lock, Locked, RegularFreedoms, default_outputs, platform_outputs,
};

/// The outputs: of the settings, else coordinates of platforms asked about, else the default.
pub(super) fn outputs_of(
    mechanism: &Mechanism,
    held: &Held<f64>,
    moved: &[Driven],
    inputs: &[Coordinate],
    settings: &SingularitiesSettings,
) -> Vec<Lock> {
    if !settings.outputs.is_empty() {
        return settings.outputs.clone();
    }
    let moved: Vec<Coordinate> = moved.iter().map(|driven| driven.coordinate).collect();
    platform_outputs(held, &moved, inputs).unwrap_or_else(|| default_outputs(mechanism, inputs))
}

/// A full pose as an output whose rotation and translation depend on one another. What its position
/// loses, its twist need not lose: a stretched 2R arm still turns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Coupled {
    /// The frame.
    pub output: String,
    /// Its freedoms at a regular configuration.
    pub freedoms: usize,
    /// As many of its coordinates that are independent, if it is a platform.
    pub coordinates: Vec<String>,
    /// Freedoms that its origin alone loses at the configuration, if there is one.
    pub origin_loses: Option<usize>,
}

/// The coupled outputs, unless outputs were chosen; with `here` what their origins lose too.
pub(super) fn coupled(
    mechanism: &Mechanism,
    inputs: &[Coordinate],
    outputs: &[Lock],
    at: &Configuration<f64>,
    settings: &SingularitiesSettings,
    here: bool,
) -> Vec<Coupled> {
    if !settings.outputs.is_empty() {
        return Vec::new();
    }
    // two regular configurations
    let first = RegularFreedoms::beside(mechanism, at);
    let second = (first.as_ref()).and_then(|first| RegularFreedoms::beside(mechanism, first.at()));
    let (Some(first), Some(second)) = (first, second) else {
        return Vec::new();
    };
    let coupled = outputs.iter().filter_map(|output| {
        let Lock::Frame(frame) = *output else {
            return None;
        };
        let [near, far] = [&first, &second].map(|place| twists(mechanism, frame, place.at()));
        let beyond = far.into_iter().any(|mut twist| {
            remove(&mut twist, &near);
            norm(&twist) > SAME
        });
        beyond.then(|| {
            let own = match frame {
                Frame::Platform { platform } => PoseCoordinate::ALL
                    .map(|c| Coordinate::Pose(platform, c))
                    .to_vec(),
                _ => Vec::new(),
            };
            let independent = first.independent(mechanism, &own).into_iter();
            let origin = [Lock::Point(frame.into())];
            let origin = || Classifier::new(mechanism, inputs, &origin, at).at(at).loss;
            Coupled {
                output: mechanism.frame_name(frame),
                freedoms: near.len(),
                coordinates: independent.map(|c| c.name(mechanism)).collect(),
                origin_loses: here.then(origin),
            }
        })
    });
    coupled.collect()
}

/// The twists of a frame about its origin, (ω; v/L), that the closures leave it: orthonormal.
fn twists(mechanism: &Mechanism, frame: Frame, at: &Configuration<f64>) -> Vec<Vec<f64>> {
    let motions = Locked::new(mechanism, &[]).decomposition(at).null_space();
    let mut locked = Locked::new(mechanism, &[Lock::Frame(frame)]);
    orthonormal(&locked.rates(at, &motions), STILL)
}
