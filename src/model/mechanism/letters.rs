//! A mechanism in letters: the same kinematics over symbolic numbers.

use super::closure::{ClosureEquations, EVERY_ROW};
use super::dimensions::Dimensions;
use super::kinematics::Kinematics;
use super::{Configuration, Frame, Mechanism};
use crate::algebra::{EvaluationError, Symbolic};
use crate::geometry::{Pose, Rotation, Vector3};
use crate::number::Number;
use crate::number::sorting::sort_by_key;

/// The meaning of each symbol: parameters, joint variables, platform poses and local names, in this order.
#[derive(Clone, Copy)]
pub struct Letters<'a>(pub &'a Mechanism);

/// Number of letters of a platform's pose: n, s, a and p.
const OF_POSE: usize = 12;

impl Letters<'_> {
    fn symbol(&self, place: usize) -> u32 {
        u32::try_from(place).unwrap_or(u32::MAX)
    }

    /// The letter of a parameter.
    pub fn parameter(&self, parameter: usize) -> u32 {
        self.symbol(parameter)
    }

    /// The letter of a joint.
    pub fn joint(&self, joint: usize) -> u32 {
        self.symbol(self.0.parameters().len() + joint)
    }

    /// The joint a symbol stands for.
    pub fn joint_of(&self, symbol: u32) -> Option<usize> {
        let joint = (symbol as usize).checked_sub(self.0.parameters().len())?;
        (joint < self.0.joints().len()).then_some(joint)
    }

    /// A letter of a platform's pose: of n, s, a and p, three each.
    pub fn platform(&self, platform: usize, entry: usize) -> u32 {
        let before = self.0.parameters().len() + self.0.joints().len();
        self.symbol(before + OF_POSE * platform + entry)
    }

    /// The local name of that index in a closed form.
    pub fn local(&self, local: usize) -> u32 {
        self.platform(self.0.platforms().len(), local)
    }

    /// The name of a symbol: `a2`, `theta1`, `top.nx`.
    pub fn name(&self, symbol: u32) -> String {
        let mechanism = self.0;
        let place = symbol as usize;
        let parameters = mechanism.parameters();
        if let Some(parameter) = parameters.get(place) {
            return parameter.name.to_string();
        }
        let place = place - parameters.len();
        if let Some(joint) = mechanism.joints().get(place) {
            return joint.name.clone();
        }
        let place = place - mechanism.joints().len();
        match mechanism.platforms().get(place / OF_POSE) {
            Some(platform) => {
                let (vector, axis) = (place % OF_POSE / 3, place % 3);
                let vector = ["n", "s", "a", "p"][vector];
                format!("{}.{vector}{}", platform.name, ["x", "y", "z"][axis])
            }
            None => format!("local{}", place - OF_POSE * mechanism.platforms().len()),
        }
    }

    /// The values of all letters but local names at home, in m and rad.
    pub fn values(&self) -> Vec<f64> {
        self.values_at(&self.0.home())
    }

    /// The values of all letters but local names at a configuration, over any number.
    pub fn values_at<T: Number>(&self, at: &Configuration<T>) -> Vec<T> {
        let parameters = self.0.parameters().iter();
        let parameters = parameters.map(|parameter| T::from_f64(parameter.value));
        let poses = at.platforms.iter().flat_map(|platform| {
            let pose = self.0.in_ground(platform);
            let columns = pose.rotation.0.into_iter().chain([pose.position]);
            columns.flat_map(|column| column.0).collect::<Vec<T>>()
        });
        parameters
            .chain(at.joints.iter().copied())
            .chain(poses)
            .collect()
    }

    /// Every parameter as a letter.
    pub fn parameters(&self) -> Vec<Symbolic> {
        let all = 0..self.0.parameters().len();
        all.map(|i| Symbolic::symbol(self.parameter(i))).collect()
    }

    /// Every joint variable as a letter.
    pub fn joints(&self) -> Vec<Symbolic> {
        let all = 0..self.0.joints().len();
        all.map(|i| Symbolic::symbol(self.joint(i))).collect()
    }

    fn pose(&self, platform: usize) -> Pose<Symbolic> {
        let vector = |column: usize| {
            Vector3([0, 1, 2].map(|i| Symbolic::symbol(self.platform(platform, 3 * column + i))))
        };
        Pose {
            rotation: Rotation([0, 1, 2].map(vector)),
            position: vector(3),
        }
    }
}

/// The dimensions of a mechanism and where its joints are, in letters. It lives as long as the arena of its numbers.
pub struct Formal<'a> {
    mechanism: &'a Mechanism,
    dimensions: Dimensions<Symbolic>,
    joints: Vec<Symbolic>,
    platforms: Vec<Pose<Symbolic>>,
}

impl<'a> Formal<'a> {
    /// With these parameters and joint variables; platforms have letters of their own.
    pub fn new(
        mechanism: &'a Mechanism,
        parameters: &[Symbolic],
        joints: Vec<Symbolic>,
    ) -> Result<Self, EvaluationError> {
        let mut dimensions = mechanism.dimensions_about(([0.0; 3], None), parameters)?;
        // formulas are in m and rad, in ground: nothing is made dimensionless
        dimensions.characteristic_length = 1.0;
        dimensions.joint_scales.fill(1.0);
        let letters = Letters(mechanism);
        let platforms = 0..mechanism.platforms().len();
        Ok(Formal {
            mechanism,
            dimensions,
            joints,
            platforms: platforms.map(|platform| letters.pose(platform)).collect(),
        })
    }

    /// ⁱⱼT. The part of the chain that carries both frames is left out, so that nothing has to cancel.
    pub fn transform(&self, relative_to: Frame, of: Frame) -> Pose<Symbolic> {
        let (dimensions, platforms) = self.seen_from_common(relative_to, of);
        let kinematics = Kinematics::new(&dimensions, [relative_to, of]);
        let mut placement = kinematics.placement();
        kinematics.place_on(&platforms, &self.joints, &mut placement);
        let [relative_to, of] = [relative_to, of].map(|frame| {
            let pose = kinematics.pose(frame, &placement);
            pose.expect("the kinematics was planned for these frames")
        });
        relative_to.inverse() * *of
    }

    fn seen_from_common(
        &self,
        relative_to: Frame,
        of: Frame,
    ) -> (Dimensions<Symbolic>, Vec<Pose<Symbolic>>) {
        let below = self.mechanism.stands_on(relative_to);
        let of = self.mechanism.stands_on(of);
        let mut platforms = self.platforms.clone();
        match of.iter().find(|frame| below.contains(frame)) {
            Some(Frame::Platform { platform } | Frame::OnPlatform { platform, .. }) => {
                platforms[*platform] = Pose::identity();
                (self.dimensions.clone(), platforms)
            }
            // the ground and no common frame leave all as it is
            common => {
                let frame = common.copied().unwrap_or(Frame::Ground);
                (self.dimensions.standing_on(frame), platforms)
            }
        }
    }

    /// The twists (ω, v) of a frame seen from one that carries it, for a unit rate of each joint that moves it; v is the velocity
    /// of its origin. `None` if that frame does not carry it.
    pub fn twists(&self, relative_to: Frame, of: Frame) -> Option<Vec<UnitTwist>> {
        if !self.mechanism.stands_on(of).contains(&relative_to) {
            return None;
        }
        let (dimensions, platforms) = self.seen_from_common(relative_to, of);
        let kinematics = Kinematics::new(&dimensions, [relative_to, of]);
        let mut placement = kinematics.placement();
        kinematics.place_on(&platforms, &self.joints, &mut placement);
        let slot = kinematics.slot(of)?;
        let point = placement.pose(slot).position;
        // a named frame is fixed to its platform, but displaced from it
        let seen = *kinematics.pose(relative_to, &placement)?;
        let mut twists: Vec<UnitTwist> = Vec::new();
        for mover in kinematics.movers(slot, &dimensions.joint_scales).0 {
            let (omega, velocity) = placement.twist(&mover, &point);
            let omega = seen.rotation.inverse_rotate(&omega);
            let velocity = seen.rotation.inverse_rotate(&velocity);
            let joint = mover.joint;
            match twists.iter_mut().find(|twist| twist.joint == joint) {
                Some(twist) => {
                    twist.omega += omega;
                    twist.velocity += velocity;
                }
                None => twists.push(UnitTwist {
                    joint,
                    omega,
                    velocity,
                }),
            }
        }
        sort_by_key(&mut twists, |twist| twist.joint);
        Some(twists)
    }

    /// Quantities that vanish where a closure holds; from its second frame to its first as seen from ground, and the length of
    /// a `Distance`.
    pub fn closure(&self, closure: usize) -> ClosureInLetters {
        let own = &self.dimensions.closures[closure];
        let kinematics = Kinematics::new(&self.dimensions, own.frames);
        let mut placement = kinematics.placement();
        kinematics.place_on(&self.platforms, &self.joints, &mut placement);
        let closure = ClosureEquations::new(&self.dimensions, own, &kinematics, EVERY_ROW);
        let [a, b] = closure.frames(&placement);
        ClosureInLetters {
            gap: b.position - a.position,
            length: own.length + own.extension.at(&self.joints),
            conditions: closure.conditions(&placement, &self.joints),
            alignment: closure.alignment(&placement),
        }
    }
}

/// Twist of a frame for a unit rate of a joint variable.
pub struct UnitTwist {
    pub joint: usize,
    pub omega: Vector3<Symbolic>,
    pub velocity: Vector3<Symbolic>,
}

pub struct ClosureInLetters {
    pub gap: Vector3<Symbolic>,
    pub length: Symbolic,
    pub conditions: Vec<Symbolic>,
    /// Expression that, with the conditions, vanishes only where the axes point the same way.
    pub alignment: Option<Symbolic>,
}

impl Mechanism {
    /// The frame itself and all frames that carry it, ending with ground or a platform.
    pub fn stands_on(&self, frame: Frame) -> Vec<Frame> {
        let mut frames = vec![frame];
        let mut frame = frame;
        loop {
            frame = match frame {
                Frame::Ground | Frame::Platform { .. } => return frames,
                Frame::OnPlatform { platform, .. } => Frame::Platform { platform },
                Frame::Tip { chain } => Frame::Link {
                    chain,
                    row: self.chains()[chain].rows.len(),
                },
                Frame::Link { chain, row: 0 } => self.chains()[chain].on,
                Frame::Link { chain, row } => Frame::Link {
                    chain,
                    row: row - 1,
                },
            };
            frames.push(frame);
        }
    }
}
