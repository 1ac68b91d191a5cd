//! Parts, names, bodies and frames of a mechanism.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::configuration::Configuration;
use super::kinematics::Kinematics;
use super::model::{
    Chain, ChainRow, ClosedForm, Closure, Formula, Joint, JointKind, Parameter, Platform, Symbol,
};
use super::{Dimensions, Frame, Mechanism, Quantity, Rounding, relation};
use crate::algebra::Affine;
use crate::description::{GROUND, JointCoordinates, Problem};
use crate::geometry::Pose;

/// A rigid body: frames fixed to one another whatever the joints do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Body {
    /// The fixed body.
    Ground,
    /// The platform of that index.
    Platform(usize),
    /// The link after a moving row of a chain; rows count from 1.
    Link { chain: usize, row: usize },
}

impl Mechanism {
    /// The name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its source in the literature.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// The parameters with their values, in the order of the file.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The joints, in the order of the file.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The chains, in the order of the file.
    pub fn chains(&self) -> &[Chain] {
        &self.chains
    }

    /// The platforms, in the order of the file.
    pub fn platforms(&self) -> &[Platform] {
        &self.platforms
    }

    /// The closures, in the order of the file.
    pub fn closures(&self) -> &[Closure] {
        &self.closures
    }

    /// True if a closure is a rod with a ball at each end.
    pub fn has_rods(&self) -> bool {
        let mut closures = self.closures.iter();
        closures.any(|closure| closure.kind.has_length())
    }

    /// The closed forms, in the order of the file.
    pub fn closed_forms(&self) -> &[ClosedForm] {
        &self.closed_forms
    }

    /// The quantities that the file names, in its order.
    pub fn outputs(&self) -> &[Quantity] {
        &self.outputs
    }

    /// The joint coordinates from which the tables were made, if they were.
    pub fn coordinates(&self) -> Option<&JointCoordinates> {
        self.coordinates.as_deref()
    }

    /// True if the file itself names this frame; tables made of joint coordinates have frames of their own besides.
    pub fn is_given(&self, frame: &str) -> bool {
        self.coordinates().is_none_or(|made| made.axes.names(frame))
    }

    /// Warnings: peculiarities that do not prevent an analysis.
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// All dimensions, in m and rad.
    pub fn dimensions(&self) -> &Dimensions<f64> {
        &self.dimensions
    }

    /// The characteristic length in m, by which residuals and Jacobians are made dimensionless.
    pub fn characteristic_length(&self) -> f64 {
        self.dimensions.characteristic_length
    }

    /// The index of the joint of that name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// The index of the platform of that name.
    pub fn platform(&self, name: &str) -> Option<usize> {
        self.platforms.iter().position(|part| part.name == name)
    }

    /// The frame of that name: `ground`, `leg1`, `leg1.2`, `top`, `top.S1`, or the name of a link.
    pub fn frame(&self, name: &str) -> Option<Frame> {
        let numbered = |frame: Frame| match frame {
            Frame::Link { chain, row } => format!("{}.{row}", self.chains[chain].name) == name,
            _ => false,
        };
        let mut frames = self.frames().into_iter();
        frames.find(|&frame| self.frame_name(frame) == name || numbered(frame))
    }

    /// The name of a frame.
    pub fn frame_name(&self, frame: Frame) -> String {
        match frame {
            Frame::Ground => GROUND.into(),
            Frame::Platform { platform } => self.platforms[platform].name.clone(),
            Frame::OnPlatform { platform, frame } => {
                let Platform { name, frames, .. } = &self.platforms[platform];
                format!("{name}.{}", frames[frame].0)
            }
            Frame::Link { chain, row } => {
                let Chain { name, rows, .. } = &self.chains[chain];
                let given = row.checked_sub(1).and_then(|row| rows[row].link.clone());
                given.unwrap_or_else(|| format!("{name}.{row}"))
            }
            Frame::Tip { chain } => self.chains[chain].name.clone(),
        }
    }

    /// The name of a body: `ground`, a platform, or a link by the frame that carries it.
    pub fn body_name(&self, body: Body) -> String {
        self.frame_name(self.body_frame(body))
    }

    /// The frame that carries a body.
    pub fn body_frame(&self, body: Body) -> Frame {
        match body {
            Body::Ground => Frame::Ground,
            Body::Platform(platform) => Frame::Platform { platform },
            // tables made of coordinates end in the body's own frame, under its name
            Body::Link { chain, .. } if self.coordinates.is_some() => Frame::Tip { chain },
            Body::Link { chain, row } => Frame::Link { chain, row },
        }
    }

    /// Every frame: ground, the link and tip frames of each chain, the frames of each platform.
    pub fn frames(&self) -> Vec<Frame> {
        let mut frames = vec![Frame::Ground];
        for (chain, part) in self.chains.iter().enumerate() {
            frames.extend((0..=part.rows.len()).map(|row| Frame::Link { chain, row }));
            frames.push(Frame::Tip { chain });
        }
        for (platform, part) in self.platforms.iter().enumerate() {
            frames.push(Frame::Platform { platform });
            let named = 0..part.frames.len();
            frames.extend(named.map(|frame| Frame::OnPlatform { platform, frame }));
        }
        frames
    }

    /// The most by which numbers of the file are off, in m, if it says so.
    pub fn tolerance(&self) -> Option<f64> {
        self.tolerance
    }

    /// The effect of the rounding of its numbers, if it was looked at and has one.
    pub fn rounding(&self) -> Option<&Rounding> {
        self.rounding.as_deref()
    }

    /// The mechanism with the effect of the rounding of its numbers.
    pub fn with_rounding(self, rounding: Rounding) -> Self {
        let rounding = Some(Arc::new(rounding));
        Mechanism { rounding, ..self }
    }

    /// The home configuration of the file; it need not be assembled.
    pub fn home(&self) -> Configuration<f64> {
        let length = self.characteristic_length();
        let joint = |joint: &Joint| match joint.kind {
            JointKind::Prismatic => joint.home * within_reach(joint.home, length),
            JointKind::Revolute | JointKind::Helical => joint.home,
        };
        let platform = |platform: &Platform| {
            let mut home = self.from_ground(&platform.home);
            let far = within_reach(home.position.norm(), length);
            if far < 1.0 {
                home.position = home.position.times(far);
            }
            home
        };
        Configuration {
            joints: self.joints.iter().map(joint).collect(),
            platforms: self.platforms.iter().map(platform).collect(),
        }
    }

    /// ⁱⱼT: the pose of frame `of` seen from frame `relative_to`, positions in m.
    pub fn transform(&self, relative_to: Frame, of: Frame, at: &Configuration<f64>) -> Pose<f64> {
        let poses = self.poses_about_centre(&[relative_to, of], at);
        poses[0].inverse() * poses[1]
    }

    /// Ground from the frame of that name, positions in m; `None` if there is no such frame.
    pub fn pose(&self, frame: &str, at: &Configuration<f64>) -> Option<Pose<f64>> {
        let frame = self.frame(frame)?;
        Some(self.transform(Frame::Ground, frame, at))
    }

    /// Ground from each of the given frames.
    pub fn poses<const N: usize>(
        &self,
        frames: [Frame; N],
        at: &Configuration<f64>,
    ) -> [Pose<f64>; N] {
        let poses = self.placed(&frames, at);
        poses.try_into().expect("one for each frame")
    }

    /// Poses of any number of frames.
    pub fn placed(&self, frames: &[Frame], at: &Configuration<f64>) -> Vec<Pose<f64>> {
        let poses = self.poses_about_centre(frames, at).into_iter();
        poses.map(|pose| self.shifted(pose)).collect()
    }

    /// Poses of frames with positions from the centre, for differences of positions.
    pub fn poses_about_centre(&self, frames: &[Frame], at: &Configuration<f64>) -> Vec<Pose<f64>> {
        let kinematics = Kinematics::new(&self.dimensions, frames.iter().copied());
        let mut placement = kinematics.placement();
        kinematics.place(at, &mut placement);
        let pose = |&frame| {
            *kinematics
                .pose(frame, &placement)
                .expect("the kinematics was planned for these frames")
        };
        frames.iter().map(pose).collect()
    }

    /// The body that a frame is fixed to.
    pub fn body(&self, frame: Frame) -> Body {
        let moving = self.chains_below(frame).find_map(|(chain, rows)| {
            let row = 1 + rows.iter().rposition(ChainRow::moves)?;
            Some(Body::Link { chain, row })
        });
        let carrier = || self.carrier(frame).map_or(Body::Ground, Body::Platform);
        moving.unwrap_or_else(carrier)
    }

    /// The chains that carry a frame, from it downwards, each with the rows between.
    pub(super) fn chains_below(&self, frame: Frame) -> impl Iterator<Item = (usize, &[ChainRow])> {
        let below = |&(chain, _): &(usize, usize)| self.on_chain(self.chains[chain].on).ok();
        let chains = std::iter::successors(self.on_chain(frame).ok(), below);
        chains.map(|(chain, rows)| (chain, &self.chains[chain].rows[..rows]))
    }

    /// The chain of a frame and the number of rows before it, or the platform it is fixed to; none for the ground.
    fn on_chain(&self, frame: Frame) -> Result<(usize, usize), Option<usize>> {
        match frame {
            Frame::Ground => Err(None),
            Frame::Platform { platform } | Frame::OnPlatform { platform, .. } => {
                Err(Some(platform))
            }
            Frame::Link { chain, row } => Ok((chain, row)),
            Frame::Tip { chain } => Ok((chain, self.chains[chain].rows.len())),
        }
    }

    /// The platform that carries a frame; `None` if ground carries it. Joint values alone determine
    /// where a frame is on its carrier.
    pub fn carrier(&self, frame: Frame) -> Option<usize> {
        match self.on_chain(frame) {
            Ok((chain, _)) => self.carrier(self.chains[chain].on),
            Err(platform) => platform,
        }
    }

    /// Every moving or fixed body, ground first.
    pub fn bodies(&self) -> Vec<Body> {
        let frames = self.frames().into_iter();
        let bodies: BTreeSet<Body> = frames.map(|frame| self.body(frame)).collect();
        bodies.into_iter().collect()
    }

    /// Every entry that may contain joint variables.
    pub(super) fn affine_entries(&self) -> impl Iterator<Item = &Affine<Symbol>> {
        let rows = self.chains.iter().flat_map(|chain| &chain.rows);
        let lengths = self.closures.iter().filter_map(|c| c.length.as_ref());
        rows.flat_map(|row| [&row.d, &row.theta]).chain(lengths)
    }

    /// The value of a formula over the parameters; it is known to exist.
    pub(super) fn constant(&self, formula: &Formula) -> f64 {
        let value = formula.evaluate(&|symbol| match *symbol {
            Symbol::Parameter(i) => self.parameters[i].value,
            Symbol::Joint(_) | Symbol::Local(_) => f64::NAN,
        });
        value.unwrap_or(f64::NAN)
    }

    /// A joint is revolute if its variable occurs in θ, prismatic if it occurs in d or in a length.
    pub(super) fn infer_kinds(&mut self) {
        let mut turns = vec![false; self.joints.len()];
        let mut slides = vec![false; self.joints.len()];
        for row in self.chains.iter().flat_map(|chain| &chain.rows) {
            joints_of(&row.theta).for_each(|joint| turns[joint] = true);
            joints_of(&row.d).for_each(|joint| slides[joint] = true);
        }
        for length in self.closures.iter().filter_map(|c| c.length.as_ref()) {
            joints_of(length).for_each(|joint| slides[joint] = true);
        }
        for (joint, (turns, slides)) in self.joints.iter_mut().zip(turns.into_iter().zip(slides)) {
            joint.kind = match (turns, slides) {
                (true, true) => JointKind::Helical,
                (false, true) => JointKind::Prismatic,
                (_, false) => JointKind::Revolute,
            };
        }
    }

    /// The joints that affect some closure.
    pub(super) fn joints_in_closures(&self) -> BTreeSet<usize> {
        let closures = self.closures.iter();
        closures
            .flat_map(|closure| self.joints_moving(closure))
            .collect()
    }

    /// The joints that move one side of this closure or change its length.
    pub fn joints_moving(&self, closure: &Closure) -> Vec<usize> {
        let length = closure.length.iter().flat_map(joints_of);
        let frames = closure.frames.into_iter();
        let related = closure.relation.iter().flat_map(relation::joints_of);
        length
            .chain(related)
            .chain(frames.flat_map(|frame| self.joints_below(frame)))
            .collect()
    }

    /// The joints that affect no closure: those of open chains.
    pub fn joints_outside_closures(&self) -> BTreeSet<usize> {
        let inside = self.joints_in_closures();
        let all = 0..self.joints.len();
        all.filter(|joint| !inside.contains(joint)).collect()
    }

    /// The joints between a frame and the ground or platform that carries it.
    pub fn joints_below(&self, frame: Frame) -> Vec<usize> {
        let chains = self.chains_below(frame);
        let rows = chains.flat_map(|(_, rows)| rows.iter().rev());
        rows.flat_map(ChainRow::joints).collect()
    }
}

/// The joints in an affine entry.
pub(super) fn joints_of(affine: &Affine<Symbol>) -> impl Iterator<Item = usize> {
    affine.terms.iter().filter_map(|(symbol, _)| match symbol {
        Symbol::Joint(joint) => Some(*joint),
        _ => None,
    })
}

impl ChainRow {
    /// True if a joint variable occurs in the row.
    pub(crate) fn moves(&self) -> bool {
        let mut joints = joints_of(&self.theta).chain(joints_of(&self.d));
        joints.next().is_some()
    }

    /// The joints whose variables occur in the row.
    pub fn joints(&self) -> Vec<usize> {
        let joints: BTreeSet<usize> = joints_of(&self.theta).chain(joints_of(&self.d)).collect();
        joints.into_iter().collect()
    }
}

/// The factor that brings a guessed length, in m, back to the size of the mechanism if it is far beyond it.
fn within_reach(guess: f64, length: f64) -> f64 {
    match guess.abs() > 1e3 * length {
        true => length / guess.abs(),
        false => 1.0,
    }
}
