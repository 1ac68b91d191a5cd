//! The report as JSON: lengths in m, angles in rad, every number with all its digits.

use serde::Serialize;
use serde_json::{Map, Value};

use super::super::json::document;
use super::{sentence, warnings};
use crate::analysis::assembly::{AssemblyReport, Outcome};
use crate::geometry::{Pose, Quaternion, RollPitchYaw};
use crate::mechanism::Frame;
use crate::system::Question;

/// A report as it is written. A number that is not finite is written as `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolutionJson {
    /// `converged`, `converged_outside_limits`, `singular`, `cannot_be_assembled` or `gave_up`.
    pub outcome: &'static str,
    /// The outcome in words.
    pub sentence: String,
    /// Newton steps of the start that succeeded.
    pub steps: usize,
    /// Random starts made after the guess.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// The largest closure row, dimensionless.
    pub residual: f64,
    /// Ratio of the largest to the smallest singular value; `null` if infinite.
    pub condition: f64,
    /// Whether the condition number is poor.
    pub near_singular: bool,
    /// Freedoms of the mechanism; `null` if it was not found to assemble.
    pub mobility: Option<usize>,
    /// Freedoms that only turn a link about its own line.
    pub idle: usize,
    /// What was held.
    pub held: Vec<String>,
    /// Value of each joint, rad or m.
    pub joints: Map<String, Value>,
    /// Pose of each platform in ground.
    pub platforms: Map<String, Value>,
    /// Tip frame of each chain in ground.
    pub frames: Map<String, Value>,
    /// How far each closure is from being whole.
    pub gaps: Map<String, Value>,
    /// Joints outside their limits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outside_limits: Vec<String>,
    /// What can move at a singular configuration although all inputs are held.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub moving: Vec<String>,
    /// Held joints that cannot drive the mechanism at a singular configuration.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub powerless: Vec<String>,
    /// At a singular configuration the closure whose equations depend on the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dependent_closure: Option<String>,
    /// The closure with the widest gap, if it is not assembled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst: Option<String>,
    /// Whether the closest approach is a true local minimum, if it cannot be assembled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub local_minimum: Option<bool>,
    /// What is odd about the file or the answer.
    pub warnings: Vec<String>,
}

/// A frame in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FrameJson {
    /// Its origin (m).
    pub position: [f64; 3],
    /// Its rotation matrix, row by row; the columns are n, s, a.
    pub rotation: [[f64; 3]; 3],
    /// The same as a quaternion w, x, y, z.
    pub quaternion: [f64; 4],
}

/// A platform in ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlatformJson {
    /// Its own frame.
    #[serde(flatten)]
    pub frame: FrameJson,
    /// Roll, pitch, yaw (rad): R = Rz(yaw)·Ry(pitch)·Rx(roll).
    pub roll_pitch_yaw: [f64; 3],
}

/// How far a closure is from being whole.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapJson {
    /// Distance (m).
    pub distance: f64,
    /// Angle (rad).
    pub angle: f64,
}

impl FrameJson {
    fn of(pose: &Pose<f64>) -> Self {
        FrameJson {
            position: pose.position.0,
            rotation: pose.rotation.rows(),
            quaternion: Quaternion::from_rotation(&pose.rotation).canonical().0,
        }
    }
}

impl PlatformJson {
    fn of(pose: &Pose<f64>) -> Self {
        let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(&pose.rotation);
        PlatformJson {
            frame: FrameJson::of(pose),
            roll_pitch_yaw: [roll, pitch, yaw],
        }
    }
}

/// The outcome in one word.
fn word(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "converged",
        Outcome::ConvergedOutsideLimits { .. } => "converged_outside_limits",
        Outcome::Singular { .. } => "singular",
        Outcome::CannotBeAssembled { .. } => "cannot_be_assembled",
        Outcome::GaveUp { .. } => "gave_up",
    }
}

impl SolutionJson {
    /// The report of a question.
    pub fn new(question: &Question, report: &AssemblyReport) -> Self {
        let mechanism = question.mechanism();
        let at = &report.configuration;
        let joint_names = |joints: &[usize]| -> Vec<String> {
            let names = joints.iter().map(|&i| mechanism.joints()[i].name.clone());
            names.collect()
        };
        let closure_name = |i: usize| mechanism.closures().get(i).map(|c| c.name.clone());
        let joints = mechanism.joints().iter().zip(&at.joints);
        let platforms = mechanism.platforms().iter().zip(&at.platforms);
        let frames = mechanism.chains().iter().enumerate().map(|(chain, part)| {
            let pose = mechanism.transform(Frame::Ground, Frame::Tip { chain }, at);
            (part.name.clone(), value(FrameJson::of(&pose)))
        });
        let gaps = mechanism.closures().iter().zip(&report.gaps);
        let file = mechanism.warnings().iter();
        let mut json = SolutionJson {
            outcome: word(&report.outcome),
            sentence: sentence(mechanism, report),
            steps: report.steps,
            restarts: report.restarts,
            seed: report.seed,
            residual: report.residual,
            condition: report.condition,
            near_singular: report.near_singular,
            mobility: report.count.mobility,
            idle: report.idle,
            held: question.held_names(),
            joints: joints
                .map(|(joint, &x)| (joint.name.clone(), value(x)))
                .collect(),
            platforms: platforms
                .map(|(part, pose)| (part.name.clone(), value(PlatformJson::of(&pose.pose()))))
                .collect(),
            frames: frames.collect(),
            gaps: gaps
                .map(|(closure, gap)| {
                    let (distance, angle) = (gap.distance, gap.angle);
                    (closure.name.clone(), value(GapJson { distance, angle }))
                })
                .collect(),
            outside_limits: vec![],
            moving: vec![],
            powerless: vec![],
            dependent_closure: None,
            worst: None,
            local_minimum: None,
            warnings: (file.map(|problem| problem.kind.title()))
                .chain(warnings(report))
                .collect(),
        };
        match &report.outcome {
            Outcome::Converged => {}
            Outcome::ConvergedOutsideLimits { joints } => json.outside_limits = joint_names(joints),
            Outcome::Singular {
                moving,
                closure,
                powerless,
            } => {
                json.moving = moving.clone();
                json.powerless = joint_names(powerless);
                json.dependent_closure = closure_name(*closure);
            }
            Outcome::CannotBeAssembled {
                worst,
                local_minimum,
            } => {
                json.worst = closure_name(*worst);
                json.local_minimum = Some(*local_minimum);
            }
            Outcome::GaveUp { worst } => json.worst = closure_name(*worst),
        }
        json
    }
}

/// Numbers, lists and structures of them always have a JSON form.
fn value(part: impl Serialize) -> Value {
    serde_json::to_value(part).unwrap_or(Value::Null)
}

/// The report as JSON, as the command line prints it.
pub fn json(question: &Question, report: &AssemblyReport) -> String {
    document(
        question.mechanism().name(),
        &SolutionJson::new(question, report),
    )
}
