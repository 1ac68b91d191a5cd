//! Bodies and the joints between them: which joints are driven, and which are cut.

use std::collections::{BTreeSet, HashSet, VecDeque};

use super::{AxesDescription, AxisDescription, AxisKind};
use crate::description::{
    AxesProblem, GROUND, Named, Problem, Role, Spanned, first_free, names_of, nearest, place_of,
    unless,
};
use crate::linear::{join, root};
use crate::number::sorting::sort_by_key;

/// Bodies and the joints between them.
pub struct Graph {
    /// Ground first.
    pub bodies: Vec<Spanned<String>>,
    /// For each joint its two bodies.
    pub ends: Vec<[usize; 2]>,
}

impl Graph {
    /// The bodies that joints connect; an error if the joints do not say it, or do not hold all bodies to the ground.
    pub fn of(axes: &AxesDescription) -> Result<Self, Vec<Problem>> {
        let mut graph = Graph {
            bodies: vec![Spanned::nowhere(GROUND.into())],
            ends: Vec::new(),
        };
        if axes.is_serial() {
            let known: Vec<&str> = names_of(&axes.points).collect();
            for (k, joint) in axes.joints.iter().enumerate() {
                let free = |name: &str| !known.contains(&name);
                let name = first_free(&format!("link{}", k + 1), free);
                let span = joint.name.span.clone();
                graph.bodies.push(Spanned::new(name, span));
                graph.ends.push([k, k + 1]);
            }
            return Ok(graph);
        }
        let mut problems = Vec::new();
        for joint in &axes.joints {
            let Some(names) = &joint.value.between else {
                let name = joint.name.value.clone();
                let kind = AxesProblem::NotBetween { joint: name };
                problems.push(kind.at(&joint.name.span));
                continue;
            };
            let mut body = |name: &Spanned<String>| match graph.body(&name.value) {
                Some(known) => known,
                None => {
                    graph.bodies.push(name.clone());
                    graph.bodies.len() - 1
                }
            };
            let [first, second] = [&names[0], &names[1]].map(&mut body);
            if first == second {
                let body = names[0].value.clone();
                problems.push(AxesProblem::OneBody { body }.at(&names[1].span));
            }
            graph.ends.push([first, second]);
        }
        if axes.tool.is_some() {
            let kind = AxesProblem::SerialOnly { field: "tool" };
            problems.push(kind.at(&axes.name.span));
        }
        if problems.is_empty() {
            problems.extend(graph.disconnected(axes));
        }
        unless(problems, graph)
    }

    fn disconnected(&self, axes: &AxesDescription) -> Option<Problem> {
        let parts = self.parts(|_| true);
        let lost = (0..self.bodies.len()).find(|&b| parts[b] != parts[0])?;
        let joint = self.ends.iter().position(|ends| ends.contains(&lost))?;
        let kind = match self.ends.iter().any(|ends| ends.contains(&0)) {
            false => AxesProblem::NoGround,
            true => AxesProblem::NotConnected {
                body: self.bodies[lost].value.clone(),
            },
        };
        Some(kind.at(&axes.joints[joint].name.span))
    }

    /// The body of that name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.value == name)
    }

    /// The joints of a body.
    pub fn joints_of(&self, body: usize) -> impl DoubleEndedIterator<Item = usize> + '_ {
        (0..self.ends.len()).filter(move |&joint| self.ends[joint].contains(&body))
    }

    /// A body that nothing holds yet, which carries the others of its part: one that is `asked` for, or else with the most
    /// joints; the first of those.
    pub fn next_platform(
        &self,
        is_cut: impl Fn(usize) -> bool,
        is_held: impl Fn(usize) -> bool,
        is_asked: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let parts = self.parts(|joint| !is_cut(joint));
        let first = (0..parts.len()).find(|&body| !is_held(body))?;
        let same = (0..parts.len()).filter(|&body| parts[body] == parts[first]);
        same.rev()
            .max_by_key(|&body| (is_asked(body), self.joints_of(body).count()))
    }

    /// For each body the number of joints between it and the ground.
    fn depths(&self) -> Vec<usize> {
        let mut depths = vec![usize::MAX; self.bodies.len()];
        depths[0] = 0;
        let mut waiting = VecDeque::from([0]);
        while let Some(body) = waiting.pop_front() {
            for ends in self.ends.iter().filter(|ends| ends.contains(&body)) {
                let other = ends[usize::from(ends[0] == body)];
                if depths[other] == usize::MAX {
                    depths[other] = depths[body] + 1;
                    waiting.push_back(other);
                }
            }
        }
        depths
    }

    /// For each body a body of the part it belongs to, the parts being held together by some joints.
    pub fn parts(&self, joins: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut roots: Vec<usize> = (0..self.bodies.len()).collect();
        let joints = self.ends.iter().enumerate();
        for (_, &[a, b]) in joints.filter(|(joint, _)| joins(*joint)) {
            join(&mut roots, a, b);
        }
        (0..roots.len())
            .map(|body| root(&mut roots, body))
            .collect()
    }

    /// The number of independent loops that some joints close.
    pub fn loops(&self, joins: impl Fn(usize) -> bool + Copy) -> usize {
        let parts: BTreeSet<usize> = self.parts(joins).into_iter().collect();
        let joints = (0..self.ends.len()).filter(|&j| joins(j)).count();
        joints + parts.len() - self.bodies.len()
    }
}

impl AxesDescription {
    /// True for a serial chain: joints in sequence that name no bodies.
    pub fn is_serial(&self) -> bool {
        self.joints
            .iter()
            .all(|joint| joint.value.between.is_none())
    }

    /// The joints that are driven: those the file says; or else all of a serial chain, the first of loops that is not
    /// cut.
    pub fn driven(&self) -> Vec<bool> {
        let said = self.joints.iter().any(|joint| joint.value.role.is_some());
        let is_cut = |name: &String| self.cut.iter().any(|cut| cut.value == *name);
        let mut joints = self.joints.iter();
        let first = joints.position(|j| j.value.is_variable() && !is_cut(&j.name.value));
        let serial = self.is_serial();
        let driven = |(k, joint): (usize, &Named<AxisDescription>)| match said {
            true => joint.value.role == Some(Role::Actuated),
            false => Some(k) == first || serial && joint.value.is_variable(),
        };
        self.joints.iter().enumerate().map(driven).collect()
    }

    /// The names in values of joints and in couplings: joints of these names must have variables.
    pub fn leading(&self) -> HashSet<&str> {
        let values = self.joints.iter().flat_map(|joint| &joint.value.value);
        let related = self.couplings.iter().map(|coupling| &coupling.value);
        let names = values
            .chain(related)
            .flat_map(|value| value.expression.names());
        names.map(|(name, _)| name.as_str()).collect()
    }

    /// The joints that are closures whatever is chosen.
    pub fn always_cut(&self) -> BTreeSet<usize> {
        let cut = |j: &usize| self.joints[*j].value.kind.always_cut();
        (0..self.joints.len()).filter(cut).collect()
    }

    /// The joints that the file cuts, and those that are cut in any case; an error if a loop stays closed.
    pub fn named_cuts(&self, graph: &Graph) -> Result<BTreeSet<usize>, Vec<Problem>> {
        let mut cuts = self.always_cut();
        let mut problems = Vec::new();
        for cut in &self.cut {
            match place_of(&self.joints, &cut.value) {
                Some(joint) => {
                    cuts.insert(joint);
                }
                None => {
                    let kind = AxesProblem::UnknownCut {
                        name: cut.value.clone(),
                        suggestion: nearest(&cut.value, names_of(&self.joints)).map(str::to_owned),
                    };
                    problems.push(kind.at(&cut.span));
                }
            }
        }
        if problems.is_empty() && graph.loops(|j| !cuts.contains(&j)) > 0 {
            // a joint whose cut keeps everything together
            let opens = |&joint: &usize| {
                let [a, b] = graph.ends[joint];
                let parts = graph.parts(|j| !cuts.contains(&j) && j != joint);
                !cuts.contains(&joint) && parts[a] == parts[b]
            };
            let joint = (0..self.joints.len()).find(opens).unwrap_or(0);
            let joint = self.joints[joint].name.value.clone();
            problems.push(AxesProblem::StillClosed { joint }.at(&self.cut[0].span));
        }
        unless(problems, cuts)
    }

    /// The joints to cut: joints that must keep their variables stay, then those with limits, those drawn in place, those
    /// of one freedom and those near the ground. The chains are short then, and the same whatever the values of the
    /// parameters. An error if the joints that must stay close a loop.
    pub(crate) fn placed_cuts(&self, graph: &Graph) -> Result<BTreeSet<usize>, Vec<Problem>> {
        let mut cuts = self.always_cut();
        let (driven, leading, depths) = (self.driven(), self.leading(), graph.depths());
        let order = |j: usize| {
            let joint = &self.joints[j].value;
            let stays =
                driven[j] || joint.value.is_some() || leading.contains(&*self.joints[j].name.value);
            match joint.kind {
                AxisKind::Fixed if joint.second.is_none() => 0,
                AxisKind::Helical => 1,
                _ if stays => 1,
                _ if joint.limits.is_some() => 2,
                _ if joint.second.is_some() => 5,
                AxisKind::Cylindrical | AxisKind::Universal => 4,
                _ => 3,
            }
        };
        let depth = |j: usize| graph.ends[j].map(|body| depths[body]).into_iter().max();
        let mut joints: Vec<usize> = (0..self.joints.len())
            .filter(|j| !cuts.contains(j))
            .collect();
        sort_by_key(&mut joints, |&j| (order(j), depth(j), j));
        let mut roots: Vec<usize> = (0..graph.bodies.len()).collect();
        let mut problems = Vec::new();
        for joint in joints {
            let [a, b] = graph.ends[joint];
            if root(&mut roots, a) != root(&mut roots, b) {
                join(&mut roots, a, b);
                continue;
            }
            cuts.insert(joint);
            if order(joint) == 1 {
                problems.push(AxesProblem::NothingToCut.at(&self.joints[joint].name.span));
            }
        }
        unless(problems, cuts)
    }

    /// Problems of cut joints that were driven or have limits, which go with their variables.
    pub fn lost_by_cuts(&self, is_cut: impl Fn(&str) -> bool) -> Vec<Problem> {
        let mut lost = Vec::new();
        let cut = |joint: &&Named<AxisDescription>| {
            joint.value.kind.has_variable() && is_cut(&joint.name.value)
        };
        for joint in self.joints.iter().filter(cut) {
            let (name, at) = (joint.name.value.clone(), &joint.name.span);
            if joint.value.role == Some(Role::Actuated) {
                let joint = name.clone();
                lost.push(AxesProblem::DriveCut { joint }.at(at));
            }
            if joint.value.limits.is_some() {
                lost.push(AxesProblem::LimitsCut { joint: name }.at(at));
            }
        }
        lost
    }
}
