//! Joints of an SDF file as joints of the tree, and as loops.

use std::collections::HashSet;

use super::parts::{SdfAxis, SdfJoint, SdfType, direction_in, frame_of};
use super::read::Builder;
use crate::description::{ClosureKind, GivenNames};
use crate::geometry::{Pose, Vector3};
use crate::interchange::problem::{ImportProblem, ImportProblemKind};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{self, BodyMotion, Coupling, TreeLoop};
use crate::interchange::xml_reader::along_z;

impl Builder<'_> {
    /// World from the frame of a joint, and its axes there, each a unit vector.
    fn at(&mut self, joint: usize) -> Option<(Pose<f64>, Vec<Vector3<f64>>)> {
        let name = frame_of(&self.reader.joints[joint].name);
        let place = self.reader.frames.place(&name);
        let place = self.found(place, Some(joint))?;
        let mut along = Vec::new();
        for axis in 0..self.reader.joints[joint].axes.len() {
            let SdfAxis {
                seen_from,
                along: own,
                ..
            } = &self.reader.joints[joint].axes[axis];
            let (own, seen_from) = (*own, self.reader.frames.place(seen_from));
            let seen_from = self.found(seen_from, Some(joint))?;
            along.push(direction_in(&place, &seen_from, own));
        }
        Some((place, along))
    }

    /// The joints that move a link against its parent; `outwards` if it is the child of the joint in the file too.
    pub(super) fn moving(
        &mut self,
        index: usize,
        link: usize,
        outwards: bool,
        actuated: bool,
        taken: &mut GivenNames,
        couplings: &mut Vec<Coupling>,
    ) -> Option<Vec<tree::TreeJoint>> {
        let (place, along) = self.at(index)?;
        let SdfJoint {
            name,
            kind,
            axes,
            pitch,
            ..
        } = &self.reader.joints[index];
        let given = &self.names[name];
        let at = self.poses[link].inverse() * place;
        let sign = if outwards { 1.0 } else { -1.0 };
        let mut made = |word: &str| taken.give(&format!("{given}_{word}"));
        let joint = |name: String, motion: BodyMotion, i: usize| tree::TreeJoint {
            point: at.position,
            limits: axes.get(i).and_then(|axis| axis.limits),
            actuated,
            ..tree::TreeJoint::new(
                name,
                motion,
                along
                    .get(i)
                    .map_or(Vector3::unit(2), |along| at.rotation * along.times(sign)),
            )
        };
        let one_sided = axes.iter().any(|axis| axis.one_sided);
        let mut joints = match kind {
            SdfType::Fixed | SdfType::Gear => Vec::new(),
            SdfType::Ball => vec![joint(given.clone(), BodyMotion::Ball, 0)],
            SdfType::Turn => vec![joint(given.clone(), BodyMotion::Turn, 0)],
            SdfType::Slide => vec![joint(given.clone(), BodyMotion::Slide, 0)],
            SdfType::Universal => {
                let second = joint(made("2"), BodyMotion::Turn, 1);
                vec![joint(given.clone(), BodyMotion::Turn, 0), second]
            }
            SdfType::Screw => {
                let mut slide = joint(made("slide"), BodyMotion::Slide, 0);
                slide.limits = None;
                slide.actuated = false;
                couplings.push(Coupling::of(slide.name.clone(), given.clone(), *pitch, 0.0));
                vec![joint(given.clone(), BodyMotion::Turn, 0), slide]
            }
        };
        for (axis, joint) in axes.iter().zip(&mut joints) {
            if let Some((leader, factor, offset)) = &axis.mimic {
                let Some(known) = self.names.get(leader) else {
                    let kind = ImportProblemKind::Unknown {
                        noun: "joint",
                        name: leader.clone(),
                        suggestion: None,
                    };
                    let span = Some(self.reader.joints[index].span.clone());
                    self.problems.push(ImportProblem { kind, span });
                    return None;
                };
                joint.actuated = false;
                couplings.push(Coupling::of(
                    joint.name.clone(),
                    known.clone(),
                    *factor,
                    *offset,
                ));
            }
        }
        // from child to parent the second axis comes first
        if !outwards {
            joints.reverse();
        }
        if one_sided {
            self.remarks.push(Remark::OneSided {
                joint: given.clone(),
            });
        }
        Some(joints)
    }

    /// The relation of a gearbox between the joints that its links have with the third: θ₂ = −ratio θ₁.
    pub(super) fn gear(
        &mut self,
        index: usize,
        ends: &[[usize; 2]],
        third: usize,
        used: &HashSet<usize>,
    ) -> Option<Coupling> {
        let (_, along) = self.at(index)?;
        let turned = ends[index].iter().zip(along).map(|(&link, along)| {
            let hinge = (0..ends.len()).find(|&joint| {
                let turns =
                    self.reader.joints[joint].kind == SdfType::Turn && used.contains(&joint);
                turns && (ends[joint] == [third, link] || ends[joint] == [link, third])
            })?;
            let (at, own) = self.at(hinge)?;
            let (frame, _) = self.at(index)?;
            let same = (at.rotation * own[0]).dot(&(frame.rotation * along));
            let outwards = if ends[hinge][0] == third { 1.0 } else { -1.0 };
            let name = self.names[&self.reader.joints[hinge].name].clone();
            (same.abs() > 1.0 - 1e-6).then_some((name, outwards * same.signum()))
        });
        let turned: Option<Vec<(String, f64)>> = turned.collect();
        let of = &self.reader.joints[index];
        let ratio = of.gear.as_ref().map_or(1.0, |(_, ratio)| *ratio);
        let Some([(first, s), (second, t)]) = turned.as_deref() else {
            let kind = ImportProblemKind::Unsupported {
                what: format!("the gearbox `{}`", self.names[&of.name]),
                help: "each of its links needs a revolute joint with the reference body, along its axis and closing no loop",
            };
            let span = Some(of.span.clone());
            self.problems.push(ImportProblem { kind, span });
            return None;
        };
        let terms = vec![(second.clone(), *t), (first.clone(), ratio * s)];
        Some(Coupling::linear(terms, 0.0))
    }

    /// A joint that closes a loop: its frame where all joints are at 0 is on both links.
    pub(super) fn closing(&mut self, index: usize, links: [(usize, usize); 2]) -> Option<TreeLoop> {
        let (place, along) = self.at(index)?;
        let SdfJoint {
            name,
            kind,
            axes,
            span,
            ..
        } = &self.reader.joints[index];
        let given = self.names[name].clone();
        let kind = match kind {
            SdfType::Turn => ClosureKind::Revolute,
            SdfType::Slide => ClosureKind::Prismatic,
            SdfType::Ball => ClosureKind::Spherical,
            SdfType::Universal => ClosureKind::Universal,
            SdfType::Fixed => ClosureKind::Rigid,
            SdfType::Gear => return None,
            SdfType::Screw => {
                let kind = ImportProblemKind::Unsupported {
                    what: "a screw that closes a loop".into(),
                    help: "let another joint of the loop close it",
                };
                let span = Some(span.clone());
                self.problems.push(ImportProblem { kind, span });
                return None;
            }
        };
        let second = along.len().saturating_sub(1);
        let ends = [0, second].map(|axis| match along.get(axis) {
            Some(along) => place * along_z(along),
            None => place,
        });
        let sides = [0, 1].map(|side| {
            let (link, body) = links[side];
            (body, self.poses[link].inverse() * ends[side])
        });
        if axes.iter().any(|axis| axis.limits.is_some()) {
            self.remarks.push(Remark::ClosingLimits {
                joint: given.clone(),
            });
        }
        let sides = TreeLoop::sides(&given, sides);
        Some(TreeLoop::new(given, kind, sides))
    }
}
