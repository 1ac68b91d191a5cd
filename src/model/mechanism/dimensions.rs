//! Every dimension of a mechanism as numbers: the one place where the real-valued mechanism is
//! lifted to complex, dual and other number types.

use super::{ClosureKind, Frame, JointRelation};
use crate::geometry::{Pose, Rotation, Vector3};
use crate::number::Number;

/// A linear form Σ cⱼ qⱼ in the joint variables, as (joint, coefficient) pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearForm<T>(pub Vec<(usize, T)>);

impl<T: Number> LinearForm<T> {
    /// The value at the given joint values.
    #[inline(always)]
    pub fn at(&self, joints: &[T]) -> T {
        match self.0.as_slice() {
            [] => T::zero(),
            [(joint, factor)] => *factor * joints[*joint],
            terms => terms.iter().fold(T::zero(), |sum, (joint, factor)| {
                sum + *factor * joints[*joint]
            }),
        }
    }

    /// The coefficient of a joint variable.
    pub fn coefficient(&self, joint: usize) -> T {
        let mut terms = self.0.iter().filter(|(j, _)| *j == joint);
        terms.next().map_or(T::zero(), |(_, factor)| *factor)
    }
}

/// One row of a table as: a fixed displacement, a motion about and along z, a fixed displacement.
///
/// Modified: before = Rx(αᵢ₋₁)·Tx(aᵢ₋₁)·Ry(βᵢ₋₁)·Rz(θ₀)·Tz(d₀), after = 1.
/// Standard: before = Rz(θ₀)·Tz(d₀), after = Tx(aᵢ)·Rx(αᵢ)·Ry(βᵢ).
#[derive(Clone, Debug, PartialEq)]
pub struct RowDimensions<T> {
    /// Displacement ahead of the joint axis.
    pub before: Pose<T>,
    /// Rotation about the joint axis, in rad.
    pub turn: LinearForm<T>,
    /// Translation along the joint axis, in m.
    pub slide: LinearForm<T>,
    /// Displacement behind the joint axis.
    pub after: Pose<T>,
}

impl<T> RowDimensions<T> {
    /// True if a joint variable occurs in the row.
    pub fn moves(&self) -> bool {
        !self.turn.0.is_empty() || !self.slide.0.is_empty()
    }
}

/// The dimensions of one chain.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainDimensions<T> {
    /// The frame to which the chain is attached.
    pub on: Frame,
    /// Pose of the chain's frame 0 in that frame; for a chain on ground with its position from the
    /// [centre](Dimensions::centre).
    pub base: Pose<T>,
    /// The rows of the table.
    pub rows: Vec<RowDimensions<T>>,
    /// Pose of the chain's tip frame in the last link frame.
    pub tip: Pose<T>,
}

/// The dimensions of one closure.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosureDimensions<T> {
    /// The joint that the closure restores.
    pub kind: ClosureKind,
    /// The two frames it joins.
    pub frames: [Frame; 2],
    /// Constant part of the length of a `Distance`, in m.
    pub length: T,
    /// Variable part of the length of a `Distance`, in m.
    pub extension: LinearForm<T>,
    /// The expression that a `Coupling` makes zero.
    pub relation: Option<JointRelation<T>>,
}

/// All dimensions of a mechanism over one number type.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimensions<T> {
    /// The characteristic length in m that makes residuals and Jacobians dimensionless.
    pub characteristic_length: f64,
    /// The place in ground, in m, from which positions are measured, along ground's axes: the origin, or for a mechanism
    /// far from it a place amid its bases. What is a metre long keeps all its digits there.
    pub centre: [f64; 3],
    /// Axes in ground along which positions are measured instead of ground's, as [`Mechanism::level`](super::Mechanism::level)
    /// chooses them.
    pub axes: Option<Rotation<f64>>,
    /// For each joint the natural size of its variable: 1 rad, or the characteristic length.
    pub joint_scales: Vec<f64>,
    /// The chains.
    pub chains: Vec<ChainDimensions<T>>,
    /// For each platform its named frames.
    pub platforms: Vec<Vec<Pose<T>>>,
    /// The closures.
    pub closures: Vec<ClosureDimensions<T>>,
}

impl<T> Dimensions<T> {
    /// Ground seen from the centre, along the axes of positions.
    pub fn ground(&self) -> Pose<T>
    where
        T: Number,
    {
        let from_centre = Vector3(self.centre.map(|x| T::zero() - T::from_f64(x)));
        match self.axes {
            None => Pose::translation(from_centre),
            Some(axes) => {
                let rotation = Rotation(axes.0.map(|axis| axis.map(T::from_f64)));
                Pose {
                    rotation: rotation.transpose(),
                    position: rotation.inverse_rotate(&from_centre),
                }
            }
        }
    }

    /// The dimensions over another number, as constants.
    pub fn map<U>(&self, mut lift: impl FnMut(T) -> U) -> Dimensions<U>
    where
        T: Number,
    {
        let lift: &mut dyn FnMut(T) -> U = &mut lift;
        let form = |form: &LinearForm<T>, lift: &mut dyn FnMut(T) -> U| {
            let terms = form.0.iter().map(|&(joint, factor)| (joint, lift(factor)));
            LinearForm(terms.collect())
        };
        Dimensions {
            characteristic_length: self.characteristic_length,
            centre: self.centre,
            axes: self.axes,
            joint_scales: self.joint_scales.clone(),
            chains: (self.chains.iter())
                .map(|chain| ChainDimensions {
                    on: chain.on,
                    base: chain.base.map(&mut *lift),
                    rows: (chain.rows.iter())
                        .map(|row| RowDimensions {
                            before: row.before.map(&mut *lift),
                            turn: form(&row.turn, lift),
                            slide: form(&row.slide, lift),
                            after: row.after.map(&mut *lift),
                        })
                        .collect(),
                    tip: chain.tip.map(&mut *lift),
                })
                .collect(),
            platforms: (self.platforms.iter())
                .map(|frames| frames.iter().map(|frame| frame.map(&mut *lift)).collect())
                .collect(),
            closures: (self.closures.iter())
                .map(|closure| ClosureDimensions {
                    kind: closure.kind,
                    frames: closure.frames,
                    length: lift(closure.length),
                    extension: form(&closure.extension, lift),
                    relation: (closure.relation.as_ref()).map(|of| of.map(&mut *lift)),
                })
                .collect(),
        }
    }

    /// Makes the travel of a joint, where it turns something as well, that of another one.
    pub fn detach_travel(&mut self, joint: usize, travel: usize) {
        let rows = self.chains.iter_mut().flat_map(|chain| &mut chain.rows);
        let lengths = self.closures.iter_mut().map(|c| &mut c.extension);
        let terms = (rows.map(|row| &mut row.slide).chain(lengths)).flat_map(|form| &mut form.0);
        terms
            .filter(|(j, _)| *j == joint)
            .for_each(|term| term.0 = travel);
        self.joint_scales.push(self.joint_scales[joint]);
    }

    /// The dimensions with a link or tip frame as ground; only the frames that it carries keep their place.
    pub(super) fn standing_on(&self, frame: Frame) -> Dimensions<T>
    where
        T: Number,
    {
        let mut seen = self.clone();
        let (chain, fixed) = match frame {
            Frame::Link { chain, row } => (chain, row),
            Frame::Tip { chain } => (chain, self.chains[chain].rows.len()),
            _ => return seen,
        };
        let part = &mut seen.chains[chain];
        part.on = Frame::Ground;
        part.base = Pose::identity();
        for row in &mut part.rows[..fixed] {
            (row.before, row.after) = (Pose::identity(), Pose::identity());
            (row.turn, row.slide) = (LinearForm(vec![]), LinearForm(vec![]));
        }
        if let Frame::Tip { .. } = frame {
            part.tip = Pose::identity();
        }
        seen
    }

    /// The dimensions of a mechanism that has nothing.
    pub(super) fn empty() -> Self {
        Dimensions {
            characteristic_length: 1.0,
            centre: [0.0; 3],
            axes: None,
            joint_scales: vec![],
            chains: vec![],
            platforms: vec![],
            closures: vec![],
        }
    }
}
