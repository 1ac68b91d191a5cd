//! Bodies and the joints between them, and which joints are driven.

use std::collections::BTreeSet;

use super::problem;
use crate::description::{
    AxesDescription, AxesProblem, AxisDescription, AxisKind, GROUND, Named, Problem, Role,
};

/// Bodies and the joints between them.
pub(super) struct Graph {
    /// Ground first.
    pub bodies: Vec<String>,
    /// For each joint its two bodies.
    pub ends: Vec<[usize; 2]>,
}

impl Graph {
    pub fn of(axes: &AxesDescription) -> Result<Self, Vec<Problem>> {
        let mut graph = Graph {
            bodies: vec![GROUND.into()],
            ends: Vec::new(),
        };
        let mut problems = Vec::new();
        for joint in &axes.joints {
            let Some(names) = &joint.value.between else {
                let name = joint.name.value.clone();
                let kind = AxesProblem::NotBetween { joint: name };
                problems.push(problem(kind, &joint.name.span));
                continue;
            };
            let mut body = |name: &String| match graph.bodies.iter().position(|b| b == name) {
                Some(known) => known,
                None => {
                    graph.bodies.push(name.clone());
                    graph.bodies.len() - 1
                }
            };
            let [first, second] = [&names[0].value, &names[1].value].map(&mut body);
            if first == second {
                let body = names[0].value.clone();
                problems.push(problem(AxesProblem::OneBody { body }, &names[1].span));
            }
            graph.ends.push([first, second]);
        }
        if axes.tool.is_some() {
            let kind = AxesProblem::SerialOnly { field: "tool" };
            problems.push(problem(kind, &axes.name.span));
        }
        if problems.is_empty() {
            problems.extend(graph.disconnected(axes));
        }
        match problems.is_empty() {
            true => Ok(graph),
            false => Err(problems),
        }
    }

    fn disconnected(&self, axes: &AxesDescription) -> Option<Problem> {
        let parts = self.parts(|_| true);
        let lost = (0..self.bodies.len()).find(|&b| parts[b] != parts[0])?;
        let joint = self.ends.iter().position(|ends| ends.contains(&lost))?;
        let kind = match self.ends.iter().any(|ends| ends.contains(&0)) {
            false => AxesProblem::NoGround,
            true => AxesProblem::NotConnected {
                body: self.bodies[lost].clone(),
            },
        };
        Some(problem(kind, &axes.joints[joint].name.span))
    }

    /// For each body a body of the part it belongs to, the parts being held together by some joints.
    pub fn parts(&self, joins: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut part: Vec<usize> = (0..self.bodies.len()).collect();
        for (joint, &[a, b]) in self.ends.iter().enumerate() {
            if joins(joint) && part[a] != part[b] {
                let (kept, lost) = (part[a].min(part[b]), part[a].max(part[b]));
                part.iter_mut()
                    .filter(|p| **p == lost)
                    .for_each(|p| *p = kept);
            }
        }
        part
    }

    pub fn loops(&self, joins: impl Fn(usize) -> bool + Copy) -> usize {
        let parts: BTreeSet<usize> = self.parts(joins).into_iter().collect();
        let joints = (0..self.ends.len()).filter(|&j| joins(j)).count();
        joints + parts.len() - self.bodies.len()
    }
}

/// The joints that are driven: those the file says, or else the first that it does not cut.
pub(super) fn driven(axes: &AxesDescription) -> Vec<bool> {
    let said = axes.joints.iter().any(|joint| joint.value.role.is_some());
    let is_cut = |name: &String| axes.cut.iter().any(|cut| cut.value == *name);
    let first = (axes.joints.iter())
        .position(|j| j.value.kind != AxisKind::Spherical && !is_cut(&j.name.value));
    let driven = |(k, joint): (usize, &Named<AxisDescription>)| match said {
        true => joint.value.role == Some(Role::Actuated),
        false => Some(k) == first,
    };
    axes.joints.iter().enumerate().map(driven).collect()
}
