//! How the inputs of an assembled mechanism drive it: rates, accelerations, Jacobian.

mod jacobian;
mod planar;

use serde::Serialize;

use crate::linear::RANK_TOLERANCE;
use crate::mechanism::{Frame, Mechanism};
use crate::solve::Newton;
use crate::system::{
    Analysed, Drive, FrameMotion, FrameMotions, Freedoms, Holdable, Motion, Neighbourhood,
    Question, QuestionError, Unknown, WidestGap, check_angles, check_count, close, too_large,
};

pub use jacobian::{Axis, InputOutput};
pub use planar::{InstantCentre, Transmission};

/// How to look for the assembled configuration, and which points to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocitySettings {
    /// The iteration that closes the mechanism.
    pub newton: Newton,
    /// Random starts within limits after the guess has failed.
    pub restarts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// Frames beside the platforms whose origins are followed.
    pub points: Vec<Frame>,
}

impl Default for VelocitySettings {
    fn default() -> Self {
        VelocitySettings {
            newton: Newton::default(),
            restarts: 40,
            seed: 1,
            points: Vec::new(),
        }
    }
}

/// How an assembled mechanism moves. All vectors are in ground; angles in rad, lengths in m, time
/// in s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VelocityReport {
    /// What is held, with its rate and acceleration.
    pub inputs: Vec<Rate>,
    /// Every joint; rates are `None` where nothing determines them.
    pub joints: Vec<JointRate>,
    /// Platforms, then the points asked for; empty if nothing determines their motion.
    pub frames: Vec<FrameRate>,
    /// The input–output Jacobian; `None` where the inputs do not determine the outputs.
    pub jacobian: Option<InputOutput>,
    /// What is gained at a singular configuration: it moves although everything held stands still.
    pub gain: Option<Gain>,
    /// Transmission angles of the planar loops that are closed one dyad after the other. Loops that
    /// must be solved together have none.
    pub transmission: Vec<Transmission>,
    /// Instant centres, if all links move in one plane.
    pub centres: Vec<InstantCentre>,
    /// The length that makes Jacobians dimensionless, in m.
    pub normalising_length: f64,
    /// The largest rate at which a closure would open, dimensionless: rounding.
    pub mismatch: Option<f64>,
    /// The widest gap of the pose given, before it was closed.
    pub given_gap: Option<WidestGap>,
    /// Whether what the file holds kept its values when the mechanism was closed.
    pub kept: bool,
    /// Names of the joints that are outside their limits.
    pub outside_limits: Vec<String>,
}

/// A coordinate and how fast it changes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// The coordinate.
    pub name: String,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// Its rate, per s.
    pub rate: f64,
    /// Its acceleration, per s².
    pub acceleration: f64,
}

/// A joint variable and how fast it changes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointRate {
    /// The joint.
    pub name: String,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// Whether it is held.
    pub held: bool,
    /// Its value.
    pub value: f64,
    /// Its rate, per s.
    pub rate: Option<f64>,
    /// Its acceleration, per s².
    pub acceleration: Option<f64>,
}

/// How a frame moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameRate {
    /// The frame.
    pub name: String,
    /// Where its origin is, in m.
    pub position: [f64; 3],
    /// ω in rad/s.
    pub angular_velocity: [f64; 3],
    /// Velocity of the origin in m/s.
    pub velocity: [f64; 3],
    /// ω̇ in rad/s².
    pub angular_acceleration: [f64; 3],
    /// Acceleration of the origin in m/s².
    pub acceleration: [f64; 3],
}

/// Freedoms gained at a singular configuration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gain {
    /// How many.
    pub freedoms: usize,
    /// What moves in them, the most mobile first.
    pub moving: Vec<String>,
}

/// The unit of a coordinate.
fn unit(is_angle: bool) -> &'static str {
    match is_angle {
        true => "rad",
        false => "m",
    }
}

/// Finds how everything moves when the held coordinates of a question move as given, at the
/// assembled configuration near the start of the question.
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
    settings: &VelocitySettings,
) -> Result<Analysed<VelocityReport>, QuestionError> {
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
    check_angles(question, at)?;
    let mut motion = Motion::new(mechanism, &drive.coordinates);
    let mut near = Neighbourhood::new(mechanism);
    let idle = near.tangent(at.clone()).idle.len();
    let freedoms = Freedoms::at(mechanism.dimensions(), motion.held(), at);
    let gained = freedoms.motions.len().saturating_sub(idle);
    let gain = (gained > 0).then(|| Gain {
        freedoms: gained,
        moving: freedoms.moving(mechanism),
    });
    let determined = gain.is_none();

    motion.at(at);
    // idle motions are all there are, if the rest is determined
    let spinning: Vec<usize> = (0..mechanism.joints().len())
        .filter(|&joint| {
            let mut unknowns = freedoms.unknowns.iter();
            let place = unknowns.position(|u| *u == Unknown::Joint(joint));
            place.is_some_and(|k| freedoms.motions.iter().any(|m| m[k].abs() > RANK_TOLERANCE))
        })
        .collect();
    let jacobian = determined.then(|| {
        let mut outputs = jacobian::outputs(mechanism, &drive.coordinates, &spinning);
        outputs.extend(jacobian::followed(&outputs, &settings.points));
        jacobian::input_output(mechanism, &mut motion, at, &outputs)
    });
    let centres = match determined {
        true => planar::centres(mechanism, &mut motion, at, drive),
        false => Vec::new(),
    };
    let rates = motion.rates(&drive.rates).to_vec();
    let mismatch = determined.then(|| motion.mismatch(at));
    let changes = motion.accelerations(at, &drive.rates, &drive.accelerations);
    let scales = &mechanism.dimensions().joint_scales;
    let joints = mechanism.joints().iter().enumerate();
    let joints = joints.map(|(i, joint)| JointRate {
        name: joint.name.clone(),
        unit: unit(joint.kind.is_angle()),
        held: drive.coordinates.contains(&Holdable::Joint(i)),
        value: at.joints[i],
        rate: (determined && !spinning.contains(&i)).then(|| rates[i] * scales[i]),
        acceleration: (determined && !spinning.contains(&i)).then(|| changes[i] * scales[i]),
    });
    let joints = joints.collect();
    let frames = match determined {
        true => frames(mechanism, &mut motion, at, &settings.points),
        false => Vec::new(),
    };
    let inputs = drive.coordinates.iter().enumerate();
    let inputs = inputs.map(|(i, coordinate)| Rate {
        name: coordinate.name(mechanism),
        unit: unit(coordinate.is_angle(mechanism)),
        rate: drive.rates[i],
        acceleration: drive.accelerations[i],
    });
    Ok(Analysed::Closed(VelocityReport {
        inputs: inputs.collect(),
        joints,
        frames,
        jacobian,
        gain,
        transmission: planar::transmission(&mut near, at, &drive.coordinates),
        centres,
        normalising_length: mechanism.characteristic_length(),
        mismatch,
        outside_limits: closed.outside_limits(mechanism),
        given_gap: closed.given.filter(|gap| gap.size(mechanism) > 1e-9),
        kept: closed.kept,
    }))
}

fn frames(
    mechanism: &Mechanism,
    motion: &mut Motion,
    at: &crate::mechanism::Configuration<f64>,
    points: &[Frame],
) -> Vec<FrameRate> {
    let platforms = 0..mechanism.platforms().len();
    let platforms = platforms.map(|platform| Frame::Platform { platform });
    let mut frames: Vec<Frame> = platforms.collect();
    frames.extend(
        points
            .iter()
            .filter(|point| !matches!(point, Frame::Platform { .. })),
    );
    let mut motions = FrameMotions::new(mechanism, motion, &frames);
    motions.place(motion, at);
    let named = frames.iter().enumerate();
    named
        .map(|(i, &frame)| {
            let FrameMotion {
                position,
                twist,
                change,
            } = motions.motion(i);
            FrameRate {
                name: mechanism.frame_name(frame),
                position: position.0,
                angular_velocity: twist.omega.0,
                velocity: twist.velocity.0,
                angular_acceleration: change.omega.0,
                acceleration: change.velocity.0,
            }
        })
        .collect()
}
