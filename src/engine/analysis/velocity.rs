//! Velocity analysis: rates, accelerations and the input–output Jacobian of an assembled mechanism.

mod accuracy;
mod centres;
mod cut;
mod determinant;
mod frames;
mod jacobian;
mod planar;
mod plane;
mod rods;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::linear::RANK_TOLERANCE;
use crate::mechanism::{Frame, Mechanism, Point};
use crate::solve::Watch;
use crate::system::{
    Analysed, AssemblySettings, Coordinate, Drive, GivenPose, Lock, Motion, Neighbourhood,
    Question, QuestionError, Tangent, Unknown, check_angles, free_outputs, moving,
};

pub use centres::InstantCentre;
pub(crate) use frames::Spins;
pub use jacobian::InputOutput;
pub(crate) use jacobian::{Normalised, Outputs, axes, condition, row_count};
pub use planar::Transmission;
pub(crate) use planar::TransmissionAngles;

/// Velocities and accelerations of an assembled mechanism. Vectors are in ground; angles in rad, lengths in m, time in
/// s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VelocityReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// The held coordinates, with their rates and accelerations.
    pub inputs: Vec<Rate>,
    /// Every joint; rates are `None` where nothing determines them.
    pub joints: Vec<JointRate>,
    /// The joints at which loops are cut, which follow from the others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut: Vec<JointRate>,
    /// Platforms, then the points followed; empty if nothing determines their motion.
    pub frames: Vec<FrameRate>,
    /// The input–output Jacobian; `None` where the inputs do not determine the outputs.
    pub jacobian: Option<InputOutput>,
    /// Freedoms gained at a singular configuration, with all inputs at rest.
    pub gain: Option<Gain>,
    /// Rates that exist to first order only: they belong to no finite motion, so there are no accelerations.
    pub first_order_only: Option<FirstOrderOnly>,
    /// Accuracy of the rates and accelerations.
    pub accuracy: Accuracy,
    /// Transmission angles of the planar loops that are closed as dyads, one after the other.
    pub transmission: Vec<Transmission>,
    /// Instant centres, if all links move in one plane.
    pub centres: Vec<InstantCentre>,
    /// The length that makes Jacobians dimensionless, in m.
    pub normalising_length: f64,
    /// The largest rate at which a closure would open, dimensionless: rounding.
    pub mismatch: Option<f64>,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
}

impl VelocityReport {
    /// True if rates and accelerations are those of a finite motion, and certain enough to report.
    pub fn is_determined(&self) -> bool {
        self.gain.is_none()
            && self.first_order_only.is_none()
            && self.accuracy.determines_accelerations()
    }
}

/// A coordinate with its rate and acceleration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Rate {
    /// The coordinate.
    pub name: String,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// Its rate, per s.
    pub rate: f64,
    /// Its acceleration, per s².
    pub acceleration: f64,
}

/// A joint variable with its rate and acceleration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct JointRate {
    /// The joint.
    pub name: String,
    /// `rad` or `m`.
    pub unit: SiUnit,
    /// True if it is held.
    pub held: bool,
    /// Its value.
    pub value: f64,
    /// Its rate, per s.
    pub rate: Option<f64>,
    /// Its acceleration, per s².
    pub acceleration: Option<f64>,
}

/// Velocity and acceleration of a frame, or of a point of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrameRate {
    /// The frame, or a point of one.
    pub name: String,
    /// Position of the point, in m.
    pub position: [f64; 3],
    /// ω in rad/s.
    pub angular_velocity: [f64; 3],
    /// Velocity of the point in m/s.
    pub velocity: [f64; 3],
    /// ω̇ in rad/s²; `None` where accelerations are not known.
    pub angular_acceleration: Option<[f64; 3]>,
    /// Acceleration of the point in m/s².
    pub acceleration: Option<[f64; 3]>,
    /// Unit vectors of the axes about which its link spins in local freedoms: ω and ω̇ leave the spin out.
    pub spins: Vec<[f64; 3]>,
}

/// Freedoms with all held coordinates at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Gain {
    /// Number of freedoms.
    pub freedoms: usize,
    /// Joints and platforms that move, the most mobile first.
    pub moving: Vec<String>,
    /// True if they are finite, so that more can be held; false if they are infinitesimal at least.
    pub finite: bool,
}

/// Rates that exist to first order and belong to no motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FirstOrderOnly {
    /// True for a shaky structure: one infinitesimal freedom, and no finite motion at all.
    pub shaky: bool,
    /// Residual of the closure equations after a finite step along the rates, dimensionless.
    pub gap_after_step: Option<f64>,
    /// The acceleration, dimensionless per s², at which a closure would open.
    pub mismatch: f64,
}

/// Accuracy of rates and accelerations. Near a singular configuration the rounding left in the closures may displace
/// the mechanism far along the direction in which they hardly resist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Accuracy {
    /// The smallest singular value of the dimensionless closure equations with what is held, of
    /// those that count; `None` if nothing is unknown.
    pub smallest_singular_value: Option<f64>,
    /// Possible error of the configuration in that direction, in rad and normalising lengths.
    pub configuration: f64,
    /// Change of the rates for that, relative to the largest. Above 0.01 none are given.
    pub rates: f64,
    /// Change of the accelerations, relative to the largest or to the squared rates.
    pub accelerations: f64,
}

impl Accuracy {
    /// Largest relative uncertainty of rates and accelerations that are reported.
    const LOST: f64 = 0.01;

    /// True if rates are certain enough to report.
    pub fn determines_rates(&self) -> bool {
        self.rates <= Accuracy::LOST
    }

    /// True if accelerations are certain enough to report.
    pub fn determines_accelerations(&self) -> bool {
        self.determines_rates() && self.accelerations <= Accuracy::LOST
    }
}

/// Finds the velocities and accelerations of all bodies for given rates of the held coordinates, at the
/// assembled configuration near the start of the question. `points` beside the origins of the
/// platforms are followed too.
///
/// Rates solve J ẋ = −H ḣ with J and H the derivatives of the closure equations by free and held
/// coordinates, accelerations the same equations once more differentiated.
/// Source: Ghosal, Robotics, 2006, §5.3 and §5.5; J. M. Selig, Geometric Fundamentals of Robotics.
///
/// # Errors
/// If more or less is held than the mechanism has freedoms, if what is held depends on itself, or if
/// an angle is held of a platform pitched by ±90°.
pub fn velocity(
    question: &Question,
    drive: &Drive,
    points: &[Point],
    watch: &Watch,
) -> Result<Analysed<VelocityReport>, QuestionError> {
    let mechanism = question.mechanism();
    let closed = match AssemblySettings::default().determined(question, watch)? {
        Ok(closed) => closed,
        Err(answer) => return Ok(answer),
    };
    let at = &closed.configuration;
    check_angles(question, at)?;
    let mut near = Neighbourhood::new(mechanism);
    let mut held = Neighbourhood::holding(mechanism, &question.held());
    let rest = held.tangent(at.clone());
    let (spins, spinning) = (Spins::of(&held, &rest), spinning(&held, &rest));
    let mut outputs = free_outputs(mechanism, &drive.coordinates, &spinning);
    outputs.extend(jacobian::followed(&outputs, points));
    let points = frames::followed(mechanism, points);
    let mut frames: Vec<Frame> = points.iter().map(|point| point.frame).collect();
    frames.extend(Outputs::frames(&outputs).chain(TransmissionAngles::frames(mechanism)));
    frames.extend(cut::frames(mechanism));
    let mut motion = Motion::placing(mechanism, &drive.coordinates, &frames, |held| held);
    let gain = gain(mechanism, &mut held, &rest);
    let accuracy = accuracy::of(&mut motion, &mut held, &rest, drive);
    let determined = gain.is_none() && accuracy.determines_rates();

    motion.at(at);
    let transmission =
        TransmissionAngles::new(&mut near, at, &drive.coordinates, motion.kinematics());
    let transmission = transmission.table(motion.placement());
    let jacobian = determined
        .then(|| Outputs::new(mechanism, &motion, outputs).report(&mut motion, at, &spins));
    let centres = match determined {
        true => centres::centres(mechanism, &mut motion, at, drive),
        false => Vec::new(),
    };
    let first_order_only = match determined {
        true => accuracy::first_order_only(&mut near, &mut motion, at, drive),
        false => None,
    };
    let rates = motion.rates(&drive.rates).to_vec();
    let mismatch = determined.then(|| motion.mismatch());
    let changes = motion.accelerations(&drive.accelerations);
    let exist = first_order_only.is_none() && accuracy.determines_accelerations();
    let scales = &mechanism.dimensions().joint_scales;
    let joints = mechanism.joints().iter().enumerate();
    let is_held = |i: usize| drive.coordinates.contains(&Coordinate::Joint(i));
    // of the coordinates of points those that are asked for
    let listed = joints.filter(|(i, _)| is_held(*i) || !mechanism.is_of_point(*i));
    let joints = listed.map(|(i, joint)| {
        let is_held = is_held(i);
        let known = determined && !spinning.contains(&i);
        JointRate {
            name: joint.name.clone(),
            unit: SiUnit::of_coordinate(joint.kind.is_angle()),
            held: is_held,
            value: at.joints[i],
            rate: known.then(|| rates[i] * scales[i]),
            acceleration: (known && (exist || is_held)).then(|| changes[i] * scales[i]),
        }
    });
    let joints = joints.collect();
    let cut = cut::rates(mechanism, &motion, at, &spins, (determined, exist));
    let frames = match determined {
        true => frames::rates(mechanism, &mut motion, at, &points, &spins, exist),
        false => Vec::new(),
    };
    let inputs = drive.coordinates.iter().enumerate();
    let inputs = inputs.map(|(i, coordinate)| Rate {
        name: coordinate.name(mechanism),
        unit: SiUnit::of_coordinate(coordinate.is_angle(mechanism)),
        rate: drive.rates[i],
        acceleration: drive.accelerations[i],
    });
    Ok(Analysed::Closed(VelocityReport {
        mechanism: mechanism.name().to_owned(),
        inputs: inputs.collect(),
        joints,
        cut,
        frames,
        jacobian,
        gain,
        first_order_only,
        accuracy,
        transmission,
        centres,
        normalising_length: mechanism.characteristic_length(),
        mismatch,
        pose: closed.pose(mechanism),
    }))
}

/// The outputs that are free where nothing else is asked for; `held` holds what drives them.
pub(crate) fn outputs(
    mechanism: &Mechanism,
    inputs: &[Coordinate],
    held: &Neighbourhood,
    rest: &Tangent,
) -> Vec<Lock> {
    free_outputs(mechanism, inputs, &spinning(held, rest))
}

/// Freedoms with all held coordinates at rest; `None` if there are none.
fn gain(mechanism: &Mechanism, held: &mut Neighbourhood, rest: &Tangent) -> Option<Gain> {
    (!rest.motions.is_empty()).then(|| Gain {
        freedoms: rest.motions.len(),
        moving: moving(mechanism, held.system().unknowns(), &rest.motions),
        finite: held.is_mobile(rest),
    })
}

/// The joints that move only in local freedoms.
fn spinning(held: &Neighbourhood, rest: &Tangent) -> Vec<usize> {
    let unknowns = held.system().unknowns().iter().enumerate();
    let spins = |i: usize| rest.idle.iter().any(|m| m[i].abs() > RANK_TOLERANCE);
    unknowns
        .filter_map(|(i, unknown)| match *unknown {
            Unknown::Joint(joint) if spins(i) => Some(joint),
            _ => None,
        })
        .collect()
}
