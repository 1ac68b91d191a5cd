//! The joints at which loops are cut: their values, and their variables as rows.
//!
//! A cut joint is a closure, which needs no variable. With A and B its frames, A⁻¹B is the motion of the joint:
//!
//! | closure | A⁻¹B | values |
//! |---|---|---|
//! | revolute | Rz(q) | q |
//! | prismatic | Tz(q) | q |
//! | cylindrical | Tz(q₂)·Rz(q₁) | turn q₁, slide q₂ |
//! | universal | Rz(q₁)·Rx(90°)·Rz(q₂) | q₁, q₂ |
//!
//! Where such a joint is held, moved or limited, these rows stand behind A, and a rigid closure behind them: as many unknowns
//! more as equations.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::model::{Chain, ChainRow, Closure, Formula, Joint, JointKind, Symbol};
use super::{
    ClosureKind, Configuration, Convention, Frame, Kinematics, Mechanism, NamedPoint,
    PoseCoordinate, Role,
};
use crate::algebra::Affine;
use crate::description::{Description, free_variable, place_of};
use crate::geometry::{Axis, Pose};
use crate::number::Number;

/// A variable of a joint at which a loop is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosingJoint {
    /// Its name: that of the closure, with `_turn` and `_slide` or `_1` and `_2` where the joint has two.
    pub name: String,
    /// Rotation or translation.
    pub kind: JointKind,
    /// The index of the closure.
    pub closure: usize,
}

/// The values of a joint of a kind whose second frame has this pose in the first, in rad and m.
pub fn joint_values<T: Number>(kind: ClosureKind, pose: &Pose<T>) -> Vec<T> {
    let about_z = |pose: &Pose<T>| {
        let [x, ..] = pose.rotation.0;
        x.0[1].atan2(x.0[0])
    };
    let along_z = pose.position.0[2];
    match kind {
        ClosureKind::Revolute => vec![about_z(pose)],
        ClosureKind::Prismatic => vec![along_z],
        ClosureKind::Cylindrical => vec![about_z(pose), along_z],
        ClosureKind::Universal => {
            // Rz(q₁)·Rx(90°) takes z to (sin q₁, −cos q₁, 0)
            let [.., z] = pose.rotation.0;
            let first = z.0[0].atan2(-z.0[1]);
            let right_angle = Pose::rotation(Axis::X, T::from_f64(FRAC_PI_2));
            let cross = Pose::rotation(Axis::Z, first) * right_angle;
            vec![first, about_z(&(cross.inverse() * *pose))]
        }
        ClosureKind::Spherical
        | ClosureKind::Planar
        | ClosureKind::Rigid
        | ClosureKind::Distance
        | ClosureKind::Coupling => vec![],
    }
}

/// The joints at which loops of a mechanism are cut, ready to be read off its configurations.
#[derive(Clone, Debug)]
pub struct ClosingValues {
    kinematics: Kinematics<f64>,
    closures: Vec<(ClosureKind, [Frame; 2])>,
}

impl ClosingValues {
    /// Those of the [closing joints](Mechanism::closing_joints) of a mechanism.
    pub fn new(mechanism: &Mechanism) -> Self {
        let closures = mechanism.closures.iter();
        let closures = closures.filter(|closure| !closure.kind.variables().is_empty());
        let closures: Vec<_> = closures.map(|of| (of.kind, of.frames)).collect();
        let frames = closures.iter().flat_map(|(_, frames)| *frames);
        ClosingValues {
            kinematics: Kinematics::new(&mechanism.dimensions, frames),
            closures,
        }
    }

    /// Their values where the mechanism is assembled, in rad from −π to π and m.
    pub fn at(&self, at: &Configuration<f64>) -> Vec<f64> {
        if self.closures.is_empty() {
            return Vec::new();
        }
        let mut placement = self.kinematics.placement();
        self.kinematics.place(at, &mut placement);
        let values = self.closures.iter().flat_map(|(kind, frames)| {
            let poses = frames.map(|frame| {
                let pose = self.kinematics.pose(frame, &placement);
                *pose.expect("the kinematics was planned for these frames")
            });
            joint_values(*kind, &(poses[0].inverse() * poses[1]))
        });
        values.collect()
    }
}

impl Mechanism {
    /// The variables of the joints at which loops are cut, in the order of the closures. They are not among the
    /// [`joints`](Mechanism::joints), and a [`Configuration`] has no values of them.
    pub fn closing_joints(&self) -> &[ClosingJoint] {
        &self.closing
    }

    /// The values of the [closing joints](Mechanism::closing_joints) where the mechanism is assembled, in rad from −π to π
    /// and m.
    pub fn closing_values(&self, at: &Configuration<f64>) -> Vec<f64> {
        ClosingValues::new(self).at(at)
    }

    /// The mechanism with the closing joint of that name among its last joints, passive and without limits; `None`
    /// if there is none.
    pub fn with_closing_joint(&self, name: &str) -> Option<Mechanism> {
        let named = self.closing.iter().find(|of| of.name == name)?;
        let values = self.closing_values(&self.home());
        let of_closure = self.closing.iter().zip(values);
        let of_closure = of_closure.filter(|(of, _)| of.closure == named.closure);
        let mut opened = self.clone();
        let first = opened.joints.len();
        opened.joints.extend(of_closure.map(|(of, home)| Joint {
            name: of.name.clone(),
            role: Role::Passive,
            kind: of.kind,
            home,
            limits: None,
        }));
        let variables: Vec<usize> = (first..opened.joints.len()).collect();
        opened.added_unknowns += variables.len();
        opened.open(named.closure, &variables);
        opened.name_closing_joints();
        Some(opened.remeasured(self.characteristic_length()))
    }

    /// A configuration of this mechanism from that of another one, from which it was made by giving joints at cuts, points
    /// and frames variables of their own.
    pub fn completed(&self, of: &Mechanism, at: &Configuration<f64>) -> Configuration<f64> {
        let mut all = at.clone();
        let known = of.closing.iter().zip(of.closing_values(at));
        let known: Vec<(&str, f64)> = known.map(|(of, x)| (of.name.as_str(), x)).collect();
        for joint in self.joints.iter().skip(at.joints.len()) {
            let cut = known.iter().find(|(name, _)| *name == joint.name);
            let place = || {
                let (point, word) = joint.name.rsplit_once('.')?;
                let place = NamedPoint::read(of, point).ok()?.point.at(of, at);
                Some(place.0[PoseCoordinate::from_word(word)? as usize % 3])
            };
            let value = cut.map(|(_, value)| *value).or_else(place);
            all.joints.push(value.unwrap_or(joint.home));
        }
        for platform in self.platforms.iter().skip(at.platforms.len()) {
            let pose = of.pose(&platform.name, at).unwrap_or(platform.home);
            all.platforms.push(self.from_ground(&pose));
        }
        all
    }

    /// Gives closures the variables that the file declares under their names and uses nowhere else.
    pub(super) fn open_declared(&mut self, description: &Description) {
        let rows = self.chains.iter().flat_map(|chain| &chain.rows);
        let used: Vec<usize> = rows.flat_map(ChainRow::joints).collect();
        for closure in 0..self.closures.len() {
            let Closure { name, kind, .. } = &self.closures[closure];
            let variables = kind.variables().iter();
            let variables = variables.map(|(end, _)| {
                let joint = place_of(&description.joints, &format!("{name}{end}"))?;
                // in coordinates a closure is the joint of its name
                let own = description.coordinates.is_some() || !used.contains(&joint);
                own.then_some(joint)
            });
            if let Some(variables) = variables.collect::<Option<Vec<usize>>>()
                && !variables.is_empty()
            {
                self.open(closure, &variables);
            }
        }
    }

    /// Puts the rows of a closure behind its first frame.
    fn open(&mut self, closure: usize, variables: &[usize]) {
        let Closure {
            name, kind, frames, ..
        } = self.closures[closure].clone();
        let number = Formula::number;
        let form = |joint: Option<usize>| Affine {
            constant: number(0.0),
            terms: (joint.map(|joint| (Symbol::Joint(joint), number(1.0))))
                .into_iter()
                .collect(),
        };
        let rows = kind.variables().iter().zip(variables).enumerate();
        let rows = rows.map(|(k, ((_, slides), &joint))| ChainRow {
            alpha: number(match (kind, k) {
                (ClosureKind::Universal, 1) => FRAC_PI_2,
                _ => 0.0,
            }),
            a: number(0.0),
            d: form(slides.then_some(joint)),
            theta: form((!slides).then_some(joint)),
            beta: number(0.0),
            written: Default::default(),
            link: None,
        });
        let chain = Chain {
            name: self.free_name(&name),
            on: frames[0],
            convention: Convention::Modified,
            base: Vec::new(),
            rows: rows.collect(),
            tip: Vec::new(),
        };
        Arc::make_mut(&mut self.chains).push(chain);
        let tip = Frame::Tip {
            chain: self.chains.len() - 1,
        };
        let opened = &mut Arc::make_mut(&mut self.closures)[closure];
        opened.opened = Some((kind, frames[0]));
        opened.kind = ClosureKind::Rigid;
        opened.frames[0] = tip;
    }

    /// The mechanism with every closure as the file writes it.
    pub fn as_written(&self) -> Mechanism {
        let mut written = self.clone();
        for closure in Arc::make_mut(&mut written.closures) {
            if let Some((kind, frame)) = closure.opened.take() {
                (closure.kind, closure.frames[0]) = (kind, frame);
            }
        }
        Arc::make_mut(&mut written.chains).truncate(self.own[0]);
        written.remeasured(self.characteristic_length())
    }

    /// The mechanism with dimensions that belong to its parts, and a characteristic length in m.
    pub(super) fn remeasured(mut self, length: f64) -> Mechanism {
        let values: Vec<f64> = self.parameters.iter().map(|of| of.value).collect();
        let dimensions = self.dimensions_over(&values);
        let dimensions = dimensions.expect("expressions had values before, and these are numbers");
        self.set_dimensions(dimensions);
        self.measured(length)
    }

    /// Names the variables of closures that have none.
    pub(super) fn name_closing_joints(&mut self) {
        let joints = self.joints.iter().map(|joint| joint.name.as_str());
        let parameters = self.parameters.iter().map(|of| &*of.name);
        let platforms = self.platforms.iter().map(|of| of.name.as_str());
        let outputs = self.outputs.iter().map(|of| of.name.as_str());
        let taken: Vec<&str> = joints
            .chain(parameters)
            .chain(platforms)
            .chain(outputs)
            .collect();
        let mut closing: Vec<ClosingJoint> = Vec::new();
        for (index, closure) in self.closures.iter().enumerate() {
            for (end, slides) in closure.kind.variables() {
                let wanted = format!("{}{end}", closure.name);
                let name = free_variable(&wanted, |name| {
                    !taken.contains(&name) && closing.iter().all(|of| of.name != name)
                });
                let kind = match slides {
                    true => JointKind::Prismatic,
                    false => JointKind::Revolute,
                };
                closing.push(ClosingJoint {
                    name,
                    kind,
                    closure: index,
                });
            }
        }
        self.closing = closing.into();
    }
}
