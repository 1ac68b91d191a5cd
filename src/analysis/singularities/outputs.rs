//! What moves out: the outputs of a question, and what their choice may hide.

use serde::{Deserialize, Serialize};

use super::SingularitiesSettings;
use super::classify::Classifier;
use crate::description::Role;
use crate::geometry::Axis;
use crate::linear::{norm, orthonormal, remove};
use crate::mechanism::{Body, Configuration, Coordinate, Frame, Mechanism};
use crate::system::{Driven, Held, HeldPlatform, Holdable, Lock, Locked, Mobility, Question};

/// What is driven: the held coordinates if all of them are joints, else the actuated joints.
pub fn inputs_of(question: &Question) -> Vec<Holdable> {
    let held = question.held_coordinates();
    if held.iter().all(|h| matches!(h, Holdable::Joint(_))) {
        let mut held = held;
        held.sort_by_key(|h| match h {
            Holdable::Joint(joint) => *joint,
            Holdable::Coordinate(..) | Holdable::Turn(..) => usize::MAX,
        });
        return held;
    }
    let joints = question.mechanism().joints().iter().enumerate();
    let actuated = joints.filter(|(_, joint)| joint.role == Role::Actuated);
    let actuated: Vec<Holdable> = actuated.map(|(i, _)| Holdable::Joint(i)).collect();
    match actuated.is_empty() {
        true => held,
        false => actuated,
    }
}

/// What moves out where nothing else is asked for: the platforms; of an open chain the tips; else
/// the joints on the ground that are not driven; else the points where the chains are joined.
pub fn default_outputs(mechanism: &Mechanism, inputs: &[Holdable]) -> Vec<Lock> {
    let platforms = 0..mechanism.platforms().len();
    let platforms: Vec<Lock> = platforms
        .map(|platform| Lock::Frame(Frame::Platform { platform }))
        .collect();
    if !platforms.is_empty() {
        return platforms;
    }
    if mechanism.closures().is_empty() {
        let tips = 0..mechanism.chains().len();
        return tips
            .map(|chain| Lock::Frame(Frame::Tip { chain }))
            .collect();
    }
    let mut grounded: Vec<Holdable> = Vec::new();
    for chain in mechanism.chains() {
        let first = chain.rows.iter().map(|row| row.joints());
        let first = first.into_iter().find(|joints| !joints.is_empty());
        if mechanism.body(chain.on) == Body::Ground {
            grounded.extend(first.into_iter().flatten().map(Holdable::Joint));
        }
    }
    grounded.retain(|joint| !inputs.contains(joint));
    grounded.dedup();
    if !grounded.is_empty() {
        return grounded.into_iter().map(Lock::Coordinate).collect();
    }
    let closures = mechanism.closures().iter();
    closures
        .map(|closure| Lock::Point(closure.frames[0]))
        .collect()
}

/// The coordinates of platforms that a question is about, where it is about nothing else: those that
/// are held, and those that move. A whole orientation turns about the axes of ground, and a whole
/// pose is the platform.
fn asked_outputs(held: &Held<f64>, moved: &[Driven], inputs: &[Holdable]) -> Option<Vec<Lock>> {
    let joint = |h: &Holdable| matches!(h, Holdable::Joint(_));
    let moves_joint = moved.iter().any(|driven| joint(&driven.coordinate));
    if held.joints.contains(&true) || moves_joint || !inputs.iter().all(joint) {
        return None;
    }
    let mut outputs = Vec::new();
    for (platform, held) in held.platforms.iter().enumerate() {
        let asked = |c: Coordinate| {
            let held = match held {
                HeldPlatform::Free => false,
                HeldPlatform::Pose => true,
                HeldPlatform::Partly {
                    coordinates,
                    orientation,
                } => {
                    coordinates.iter().any(|(held, _)| *held == c)
                        || orientation.is_some() && c.is_angle()
                }
            };
            let coordinate = Holdable::Coordinate(platform, c);
            held || moved.iter().any(|driven| driven.coordinate == coordinate)
        };
        let all: Vec<Coordinate> = Coordinate::ALL.into_iter().filter(|c| asked(*c)).collect();
        if all.len() == Coordinate::ALL.len() {
            outputs.push(Lock::Frame(Frame::Platform { platform }));
            continue;
        }
        let turned = all.iter().filter(|c| c.is_angle()).count() == 3;
        outputs.extend(all.into_iter().map(|c| {
            Lock::Coordinate(match c {
                Coordinate::Roll if turned => Holdable::Turn(platform, Axis::X),
                Coordinate::Pitch if turned => Holdable::Turn(platform, Axis::Y),
                Coordinate::Yaw if turned => Holdable::Turn(platform, Axis::Z),
                c => Holdable::Coordinate(platform, c),
            })
        }));
    }
    (!outputs.is_empty()).then_some(outputs)
}

/// The outputs: those of the settings; else the coordinates of platforms that the question is about;
/// else the [default](default_outputs).
pub(super) fn outputs_of(
    mechanism: &Mechanism,
    held: &Held<f64>,
    moved: &[Driven],
    inputs: &[Holdable],
    settings: &SingularitiesSettings,
) -> Vec<Lock> {
    if !settings.outputs.is_empty() {
        return settings.outputs.clone();
    }
    asked_outputs(held, moved, inputs).unwrap_or_else(|| default_outputs(mechanism, inputs))
}

/// An output whose turning and shifting depend on one another: it has fewer freedoms than there are
/// directions in which it moves somewhere. What its position loses, its twist as a whole need not
/// lose: a stretched 2R arm still turns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coupled {
    /// The frame.
    pub output: String,
    /// Its freedoms where nothing is special.
    pub freedoms: usize,
    /// As many of its coordinates that are independent, if it is a platform.
    pub coordinates: Vec<String>,
    /// Freedoms that its origin alone loses, where a configuration is told of.
    pub origin_loses: Option<usize>,
}

/// The outputs that are coupled, where they were not chosen; `here` tells what their origins lose.
pub(super) fn coupled(
    mechanism: &Mechanism,
    inputs: &[Holdable],
    outputs: &[Lock],
    at: &Configuration<f64>,
    settings: &SingularitiesSettings,
    here: bool,
) -> Vec<Coupled> {
    if !settings.outputs.is_empty() {
        return Vec::new();
    }
    // two places that are not special
    let Some(first) = Mobility::beside(mechanism, at) else {
        return Vec::new();
    };
    let Some(second) = Mobility::beside(mechanism, first.at()) else {
        return Vec::new();
    };
    let frames = outputs.iter().filter_map(|output| match output {
        Lock::Frame(frame) => Some(*frame),
        Lock::Point(_) | Lock::Coordinate(_) => None,
    });
    let coupled = frames.filter_map(|frame| {
        /// Directions of unit twists this near are the same.
        const SAME: f64 = 1e-6;
        let [near, far] = [&first, &second].map(|place| twists(mechanism, frame, place.at()));
        let beyond = far.into_iter().any(|mut twist| {
            remove(&mut twist, &near);
            norm(&twist) > SAME
        });
        beyond.then(|| {
            let platform = match frame {
                Frame::Platform { platform } => Some(platform),
                _ => None,
            };
            let own = platform
                .into_iter()
                .flat_map(|platform| Coordinate::ALL.map(|c| Holdable::Coordinate(platform, c)));
            let own: Vec<Holdable> = own.collect();
            let independent = first.independent(mechanism, &own).into_iter();
            let origin = here.then(|| {
                Classifier::new(mechanism, inputs, &[Lock::Point(frame)], at)
                    .at(at)
                    .loss
            });
            Coupled {
                output: mechanism.frame_name(frame),
                freedoms: near.len(),
                coordinates: independent.map(|c| c.name(mechanism)).collect(),
                origin_loses: origin,
            }
        })
    });
    coupled.collect()
}

/// The twists of a frame about its origin, (ω; v/L), that the closures leave it: orthonormal.
fn twists(mechanism: &Mechanism, frame: Frame, at: &Configuration<f64>) -> Vec<Vec<f64>> {
    let motions = Locked::new(mechanism, &[]).decomposition(at).null_space();
    let mut locked = Locked::new(mechanism, &[Lock::Frame(frame)]);
    let entries = locked.jacobian(at);
    let rows = locked.rows();
    let twists: Vec<Vec<f64>> = (motions.iter())
        .map(|motion| {
            let mut twist = vec![0.0; 6];
            for (column, rate) in entries.chunks_exact(rows).zip(motion) {
                let own = column[rows - 6..].iter();
                (twist.iter_mut().zip(own)).for_each(|(sum, x)| *sum += rate * x);
            }
            twist
        })
        .collect();
    orthonormal(&twists, 1e-6)
}
