//! Singularities: at a configuration, along a segment of inputs, and as loci in two inputs.
//!
//! With J the closure Jacobian with nothing held, and H and O the rates of inputs and outputs, three matrices decide: J,
//! the *direct* [J; H] and the *inverse* [J; O]. Freedoms gained or lost are what their null spaces have beyond those at a
//! regular configuration nearby.

mod along;
mod classify;
mod cusps;
mod drops;
mod extents;
mod locus;
mod outputs;
mod projected;
mod starts;

pub use crate::system::{Bound, LocusEnd, default_outputs, inputs_of};
pub use along::{AlongReport, Crossing, along};
pub use classify::{Distances, Kind, Movement, Resisted, Singularity, Zlatanov};
pub use locus::{Cusp, Locus, LocusReport, loci};
pub use outputs::Coupled;
pub use projected::ImageShape;

use serde::{Deserialize, Serialize};

use crate::mechanism::{Mechanism, Variable};
use crate::solve::Watch;
use crate::system::{
    Analysed, AssemblySettings, Coordinate, GivenPose, Lock, Question, QuestionError, check_angle,
    check_angles, too_large,
};
pub(crate) use classify::Classifier;
use outputs::{coupled, outputs_of};

/// Settings of a singularity analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularitiesSettings {
    /// Seed of all random starts.
    pub seed: u64,
    /// The outputs; where there are none, the coordinates of platforms that are held or move, or
    /// else the platforms, or their substitutes ([`default_outputs`]).
    pub outputs: Vec<Lock>,
    /// If true, a motion along inputs goes on round folds and straight through crossings.
    pub follow: bool,
    /// Random starts for loci; up to ten times as many while new curves are likely.
    pub starts: usize,
}

impl Default for SingularitiesSettings {
    fn default() -> Self {
        SingularitiesSettings {
            seed: 1,
            outputs: Vec::new(),
            follow: false,
            starts: 400,
        }
    }
}

/// Singularity of an assembled configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SingularitiesReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// The joints, in the order of the file.
    pub variables: Vec<Variable>,
    /// The inputs.
    pub inputs: Vec<String>,
    /// The outputs.
    pub outputs: Vec<String>,
    /// Outputs that may hide what their positions lose.
    pub coupled: Vec<Coupled>,
    /// Joint values there, rad or m, in the order of the file.
    pub joints: Vec<f64>,
    /// Kinds of singularity and freedoms gained or lost; empty if the configuration is regular.
    pub singularity: Singularity,
    /// The length that makes the matrices dimensionless, in m.
    pub normalising_length: f64,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
}

fn names(mechanism: &Mechanism, inputs: &[Coordinate]) -> Vec<String> {
    inputs.iter().map(|input| input.name(mechanism)).collect()
}

fn output_names(mechanism: &Mechanism, outputs: &[Lock]) -> Vec<String> {
    (outputs.iter().map(|output| output.name(mechanism))).collect()
}

/// Classifies the assembled configuration near the start of a question: regular, or singular and how.
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
    watch: &Watch,
) -> Result<Analysed<SingularitiesReport>, QuestionError> {
    let mechanism = question.mechanism();
    if let Some(large) = too_large(mechanism) {
        return Ok(Analysed::TooLarge(large));
    }
    let closed = match AssemblySettings::seeded(settings.seed).determined(question, watch)? {
        Ok(closed) => closed,
        Err(answer) => return Ok(answer),
    };
    let at = &closed.configuration;
    let inputs = inputs_of(question);
    // angles that only say where the platform is are not differentiated
    if (inputs.iter()).any(|input| matches!(input, Coordinate::Pose(..))) {
        check_angles(question, at)?;
    }
    let outputs = outputs_of(mechanism, &question.held(), &[], &inputs, settings);
    for output in &outputs {
        if let Lock::Coordinate(coordinate) = *output {
            check_angle(mechanism, at, coordinate)?;
        }
    }
    let mut classifier = Classifier::new(mechanism, &inputs, &outputs, at);
    Ok(Analysed::Closed(SingularitiesReport {
        mechanism: mechanism.name().to_owned(),
        variables: Variable::joints(mechanism),
        inputs: names(mechanism, &inputs),
        outputs: output_names(mechanism, &outputs),
        coupled: coupled(mechanism, &inputs, &outputs, at, settings, true),
        joints: at.joints.clone(),
        singularity: classifier.at(at),
        normalising_length: mechanism.characteristic_length(),
        pose: closed.pose(mechanism),
    }))
}
