//! Singularities: at a configuration, along a segment of inputs, and as loci in two inputs.
//!
//! With J the closure Jacobian with nothing held, and H and O the rates of inputs and outputs, three
//! matrices tell everything: J itself, the *direct* [J; H] and the *inverse* [J; O]. What they map to
//! zero beyond what they do at a configuration nearby that is not special is what is gained or lost.

mod along;
mod classify;
mod drops;
mod locus;

pub use crate::system::LocusEnd;
pub use along::{AlongReport, Crossing, Ending, along};
pub use classify::{Distances, Movement, Resisted, Singularity, Zlatanov};
pub use locus::{Bound, Kind, Locus, LocusReport, loci};

use serde::Serialize;

use crate::description::Role;
use crate::mechanism::{Body, Frame, Mechanism};
use crate::solve::{Continuation, Newton};
use crate::system::{
    Analysed, Holdable, Lock, Question, QuestionError, WidestGap, check_angles, check_count, close,
    too_large,
};
use classify::Classifier;

/// How to look for singularities.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularitiesSettings {
    /// The iteration that closes the mechanism.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of all random starts.
    pub seed: u64,
    /// The outputs; where there are none, the platforms, or what stands for them
    /// ([`default_outputs`]).
    pub outputs: Vec<Lock>,
    /// Whether a motion along inputs goes round folds and straight through crossings.
    pub follow: bool,
    /// Random starts from which loci are sought; up to ten times as many while some curve was met
    /// only once, or hardly any start arrives.
    pub starts: usize,
    /// How carefully curves are followed.
    pub continuation: Continuation,
}

impl Default for SingularitiesSettings {
    fn default() -> Self {
        SingularitiesSettings {
            newton: Newton::default(),
            restarts: 40,
            seed: 1,
            outputs: Vec::new(),
            follow: false,
            starts: 400,
            continuation: Continuation::default(),
        }
    }
}

/// What is special about an assembled configuration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SingularitiesReport {
    /// The inputs.
    pub inputs: Vec<String>,
    /// The outputs.
    pub outputs: Vec<String>,
    /// Joint values there, rad or m, in the order of the file.
    pub joints: Vec<f64>,
    /// What is singular.
    pub singularity: Singularity,
    /// The length that makes the matrices dimensionless, in m.
    pub normalising_length: f64,
    /// The widest gap of the pose given, before it was closed.
    pub given_gap: Option<WidestGap>,
    /// Whether what the file holds kept its values when the mechanism was closed.
    pub kept: bool,
    /// Names of the joints that are outside their limits.
    pub outside_limits: Vec<String>,
}

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

fn outputs_of(
    mechanism: &Mechanism,
    inputs: &[Holdable],
    settings: &SingularitiesSettings,
) -> Vec<Lock> {
    match settings.outputs.is_empty() {
        true => default_outputs(mechanism, inputs),
        false => settings.outputs.clone(),
    }
}

fn names(mechanism: &Mechanism, inputs: &[Holdable]) -> Vec<String> {
    inputs.iter().map(|input| input.name(mechanism)).collect()
}

fn output_names(mechanism: &Mechanism, outputs: &[Lock]) -> Vec<String> {
    outputs
        .iter()
        .map(|output| output.name(mechanism))
        .collect()
}

/// Tells whether and how the assembled configuration near the start of a question is singular.
///
/// Sources: Gosselin and Angeles 1990; Zlatanov, Fenton and Benhabib 1994; Zlatanov, Bonev and
/// Gosselin 2002 (constraint singularities); Ghosal and Ravani 2001 (loss and gain of freedoms).
///
/// # Errors
/// If more or less is held than the mechanism has freedoms, if what is held depends on itself, or if
/// an angle is held of a platform pitched by ±90°.
pub fn singularities(
    question: &Question,
    settings: &SingularitiesSettings,
) -> Result<Analysed<SingularitiesReport>, QuestionError> {
    let mechanism = question.mechanism();
    if let Some(unknowns) = too_large(mechanism) {
        return Ok(Analysed::TooLarge { unknowns });
    }
    check_count(question)?;
    let closed = match close(question, &settings.newton, settings.restarts, settings.seed) {
        Ok(closed) => closed,
        Err(open) => return Ok(Analysed::NotClosed(open)),
    };
    let at = &closed.configuration;
    let inputs = inputs_of(question);
    // angles that only say where the platform is are not differentiated
    if inputs
        .iter()
        .any(|input| matches!(input, Holdable::Coordinate(..)))
    {
        check_angles(question, at)?;
    }
    let outputs = outputs_of(mechanism, &inputs, settings);
    let mut classifier = Classifier::new(mechanism, &inputs, &outputs, at);
    Ok(Analysed::Closed(SingularitiesReport {
        inputs: names(mechanism, &inputs),
        outputs: output_names(mechanism, &outputs),
        joints: at.joints.clone(),
        singularity: classifier.at(at),
        normalising_length: mechanism.characteristic_length(),
        outside_limits: closed.outside_limits(mechanism),
        given_gap: closed.given.filter(|gap| gap.size(mechanism) > 1e-9),
        kept: closed.kept,
    }))
}
