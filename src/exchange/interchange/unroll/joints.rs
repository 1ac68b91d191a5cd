//! The variables of a mechanism, and the joints that follow them.

use std::collections::{HashMap, HashSet};

use super::Unroller;
use crate::algebra::Expression;
use crate::description::{Entry, JointDescription, Named, Role};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{BodyMotion, TreeJoint};

impl Unroller<'_> {
    /// constant + Σ coefficient · joint in terms of variables: joints that follow are replaced by their leaders.
    pub(super) fn affine<'n>(
        &self,
        constant: f64,
        terms: impl IntoIterator<Item = (&'n String, f64)>,
    ) -> (f64, Vec<(String, f64)>) {
        let (mut constant, mut variables) = (constant, Vec::new());
        for (joint, coefficient) in terms.into_iter().filter(|(_, c)| *c != 0.0) {
            let own = [(joint.clone(), 1.0)];
            let terms = match self.followers.get(joint) {
                None => &own[..],
                Some(following) => {
                    constant += coefficient * following.offset;
                    &following.terms
                }
            };
            for (leader, factor) in terms.iter().filter(|(_, factor)| *factor != 0.0) {
                let variable = self.variables.get(leader);
                variables.extend(variable.map(|of| (of.clone(), coefficient * factor)));
            }
        }
        (constant, variables)
    }

    /// Joints that follow, as outputs of their names: what stands still and what has its limits elsewhere is said.
    pub(super) fn outputs(&mut self) -> Vec<Named<Entry>> {
        let mut outputs = Vec::new();
        // variables that turn something are angles
        let turning = self
            .tree
            .joints()
            .filter(|joint| joint.motion == BodyMotion::Turn);
        let angles = turning.flat_map(|joint| match self.followers.get(&joint.name) {
            Some(following) => following
                .terms
                .iter()
                .map(|(leader, _)| leader)
                .collect::<Vec<&String>>(),
            None => vec![&joint.name],
        });
        let angles: HashSet<String> = angles.cloned().collect();
        for joint in self.tree.joints() {
            let Some(following) = self.followers.get(&joint.name) else {
                continue;
            };
            let (name, value) = (joint.name.clone(), following.offset);
            let unit = if joint.motion == BodyMotion::Turn {
                "rad"
            } else {
                "m"
            };
            match following.terms.len() {
                0 => self.remarks.push(Remark::Stands {
                    joint: name,
                    value,
                    unit,
                }),
                1 => {}
                _ if joint.limits.is_some() => {
                    self.remarks.push(Remark::LimitsLost { joint: name });
                }
                _ => {}
            }
            // names with dots are those that a written mechanism gives to parts of rows
            if following.terms.is_empty() || joint.name.contains('.') {
                continue;
            }
            let slides = joint.motion == BodyMotion::Slide;
            let terms = following.terms.iter().filter_map(|(leader, factor)| {
                let variable = self.variables.get(leader)?;
                let term = match slides && angles.contains(leader) {
                    // metres in a radian
                    true => Expression::parse(&format!("{variable}/(1 rad)*(1 m)")).ok()?,
                    false => Expression::name(variable.clone()),
                };
                Some((*factor, term))
            });
            let terms: Vec<(f64, Expression)> = terms.collect();
            let constant = if slides {
                Entry::length(value)
            } else {
                Entry::angle(value)
            };
            let terms = terms.iter().map(|(factor, term)| (*factor, term));
            let value = Expression::sum(terms.chain([(1.0, &constant.expression)]));
            let name = self.names.variable(&joint.name);
            outputs.push(Named::new(name, value.into()));
        }
        outputs
    }

    /// The joint variables: those of joints that lead, within the limits of all that follow.
    pub(super) fn joints(&mut self) -> Vec<Named<JointDescription>> {
        let (mut joints, mut moved) = (Vec::new(), Vec::new());
        let mut coupled: HashMap<&str, Vec<(&TreeJoint, f64, f64)>> = HashMap::new();
        for follower in self.tree.joints() {
            let following = self.followers.get(&follower.name);
            if let Some([(leader, factor)]) = following.map(|of| &of.terms[..])
                && *factor != 0.0
            {
                let of = coupled.entry(leader).or_default();
                of.push((follower, self.followers[&follower.name].offset, *factor));
            }
        }
        for joint in self.tree.joints() {
            let Some(variable) = self.variables.get(&joint.name) else {
                continue;
            };
            let (mut limits, mut actuated) = (joint.limits, joint.actuated);
            let mut angle = joint.motion == BodyMotion::Turn;
            let coupled = coupled.get(joint.name.as_str()).into_iter().flatten();
            for &(follower, offset, factor) in coupled {
                actuated |= follower.actuated;
                angle |= follower.motion == BodyMotion::Turn;
                if let Some((low, high)) = follower.limits {
                    let ends = [low, high].map(|end| (end - offset) / factor);
                    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                    let (least, most) = limits.unwrap_or((low, high));
                    limits = Some((least.max(low), most.min(high)))
                        .filter(|(low, high)| low <= high)
                        .or(limits);
                }
            }
            let entry = if angle { Entry::angle } else { Entry::length };
            let home = limits.map_or(joint.home, |(low, high)| joint.home.clamp(low, high));
            if home != joint.home {
                moved.push(joint.name.clone());
                self.outside.push((variable.clone(), joint.home));
            }
            let role = [Role::Passive, Role::Actuated][usize::from(actuated)];
            let description = JointDescription {
                limits: limits.map(|(low, high)| (entry(low), entry(high))),
                ..JointDescription::new(role, entry(home))
            };
            joints.push(Named::new(variable.clone(), description));
        }
        if !moved.is_empty() {
            self.remarks.push(Remark::Moved { joints: moved });
        }
        joints
    }
}
