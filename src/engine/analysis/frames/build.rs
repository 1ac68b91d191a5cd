//! Chains, platforms and closures of a mechanism whose cuts are chosen.

use std::collections::BTreeSet;

use super::chains::{self, between, declarations, joint_axis, turned_to};
use super::values::Values;
use super::{FramesReport, PlacedChain};
use crate::description::{
    AxesDescription, AxisKind, ChainDescription, ClosureDescription, Convention, Description,
    Displacement, GROUND, Graph, Named, PlatformDescription, Role, Spanned, place_of,
};
use crate::geometry::{Axis, Line, Pose, Rotation, Vector3};
use crate::mechanism::{FrameAssignment, JointAxis, SerialAxes};

/// A mechanism file being made from axes and cuts.
pub(super) struct Build<'a> {
    axes: &'a AxesDescription,
    values: &'a Values,
    graph: &'a Graph,
    cuts: &'a BTreeSet<usize>,
    convention: Convention,
    /// For each body the frame that carries it, with its pose.
    carried: Vec<Option<(String, Pose<f64>)>>,
    /// For each joint that is cut the frames on its two bodies.
    cut_frames: Vec<[Option<String>; 2]>,
    /// For each joint that is cut where it is put back.
    cut_poses: Vec<Option<Pose<f64>>>,
    chains: Vec<Named<ChainDescription>>,
    platforms: Vec<Named<PlatformDescription>>,
    placed: Vec<PlacedChain>,
    turned: f64,
    moved: f64,
}

impl<'a> Build<'a> {
    pub fn new(
        axes: &'a AxesDescription,
        values: &'a Values,
        graph: &'a Graph,
        cuts: &'a BTreeSet<usize>,
        convention: Convention,
    ) -> Self {
        let joints = axes.joints.len();
        Build {
            axes,
            values,
            graph,
            cuts,
            convention,
            carried: vec![None; graph.bodies.len()],
            cut_frames: vec![[None, None]; joints],
            cut_poses: vec![None; joints],
            chains: Vec::new(),
            platforms: Vec::new(),
            placed: Vec::new(),
            turned: 0.0,
            moved: 0.0,
        }
    }

    /// The mechanism file.
    pub fn build(mut self) -> FramesReport {
        self.carried[0] = Some((GROUND.into(), Pose::identity()));
        self.grow(0);
        // what is held by cut joints only is a platform
        let (graph, cuts) = (self.graph, self.cuts);
        let is_cut = |joint: usize| cuts.contains(&joint);
        while let Some(root) =
            graph.next_platform(is_cut, |body| self.carried[body].is_some(), |_| false)
        {
            let joints: Vec<usize> = graph.joints_of(root).collect();
            let points = joints.iter().map(|&j| self.values.lines[j].point);
            let sum = points.fold(Vector3::zero(), |sum, point| sum + point);
            let pose = Pose::translation(sum.times(1.0 / joints.len() as f64));
            let name = self.free_name(&self.graph.bodies[root].value, "platform");
            let (home, frames) = (Displacement::of_pose(&pose), vec![]);
            let platform = PlatformDescription { home, frames };
            self.platforms.push(Named::new(name.clone(), platform));
            self.carried[root] = Some((name, pose));
            self.grow(root);
        }
        self.put_back();
        let driven = self.axes.driven();
        let role = |j: usize| [Role::Passive, Role::Actuated][usize::from(driven[j])];
        let kept = |j: usize| !self.cuts.contains(&j);
        let joints = declarations(self.axes, self.values, kept, role);
        let (related, parameters) = self.values.related.clone();
        let related = related.into_iter().map(|Named { name, value }| Named {
            value: ClosureDescription::coupling(value, name.span.clone()),
            name,
        });
        let cut = self.cuts.iter().map(|&joint| self.closure(joint));
        let closures = cut.chain(related).collect();
        FramesReport {
            mechanism: self.axes.name.value.clone(),
            convention: self.convention,
            description: Description {
                name: self.axes.name.clone(),
                source: self.axes.source.clone(),
                convention: Some(Spanned::nowhere(self.convention)),
                parameters,
                joints,
                chains: self.chains,
                platforms: self.platforms,
                closures,
                ..Description::default()
            },
            chains: self.placed,
            cuts: None,
            turned: self.turned,
            moved: self.moved,
            warnings: Vec::new(),
        }
    }

    fn free_name(&self, wanted: &str, otherwise: &str) -> String {
        let possible = |name: &String| {
            let taken = place_of(&self.chains, name).or(place_of(&self.platforms, name));
            !name.trim().is_empty() && !name.contains('.') && name != GROUND && taken.is_none()
        };
        let numbered = (1..).map(|i| format!("{otherwise}{i}"));
        let mut names = std::iter::once(wanted.to_owned()).chain(numbered);
        names.find(possible).unwrap_or_default()
    }

    /// The joints that lead away from a body to bodies not carried yet, with those bodies.
    fn onward(&self, body: usize) -> Vec<(usize, usize)> {
        let joints = self.graph.joints_of(body);
        joints
            .filter(|j| !self.cuts.contains(j))
            .map(|j| {
                let [a, b] = self.graph.ends[j];
                (j, if a == body { b } else { a })
            })
            .filter(|&(_, to)| self.carried[to].is_none())
            .collect()
    }

    /// The longest way of joints and bodies from a body that does not go back through a joint.
    fn longest(&self, start: (usize, usize)) -> Vec<(usize, usize)> {
        // depth first without recursion: trees may be a thousand bodies deep
        let mut best = Vec::new();
        let mut stack = vec![(start, 0usize)];
        let mut path: Vec<(usize, usize)> = Vec::new();
        while let Some((step, depth)) = stack.pop() {
            path.truncate(depth);
            path.push(step);
            if path.len() > best.len() {
                best = path.clone();
            }
            let onward = self.onward(step.1).into_iter().rev();
            let new = onward.filter(|(j, _)| *j != step.0);
            stack.extend(new.map(|next| (next, depth + 1)));
        }
        best
    }

    /// Chains for all that hangs on a body that is carried.
    fn grow(&mut self, root: usize) {
        let mut waiting = vec![root];
        while let Some(body) = waiting.pop() {
            let mut passed = Vec::new();
            while let Some(&start) = self.onward(body).first() {
                let way = self.longest(start);
                self.chain(body, &way);
                passed.extend(way.iter().map(|&(_, body)| body));
            }
            waiting.extend(passed.into_iter().rev());
        }
    }

    fn chain(&mut self, from: usize, way: &[(usize, usize)]) {
        let (on, parent) = match &self.carried[from] {
            Some(carried) => carried.clone(),
            None => return,
        };
        let end = way.last().map_or(from, |&(_, body)| body);
        let serial = self.axes.is_serial();
        let wanted = match serial {
            true => "chain",
            false => &self.graph.bodies[end].value,
        };
        let name = self.free_name(wanted, "chain");
        let mut before = from;
        let mut joints = Vec::new();
        for &(joint, body) in way {
            let forwards = self.graph.ends[joint][0] == before;
            joints.push(joint_axis(self.axes, self.values, joint, forwards));
            before = body;
        }
        let base = match from {
            0 => self.values.base,
            _ => Some(parent),
        };
        let tool = self.values.tool.filter(|_| serial);
        let serial = SerialAxes { base, joints, tool };
        let open = |joint: &usize| {
            let side = self.graph.ends[*joint].iter().position(|&body| body == end);
            let side = side.unwrap_or(0);
            self.cuts.contains(joint) && self.cut_frames[*joint][side].is_none()
        };
        let cut = self.graph.joints_of(end).find(open);
        let variables: Vec<String> = (way.iter())
            .map(|&(joint, _)| self.axes.joints[joint].name.value.clone())
            .collect();
        let (made, tip) = match cut {
            Some(cut) => self.ended(serial.clone(), cut),
            None => {
                let made = serial.assign(self.convention);
                let tip = made.table.tip;
                (made, tip)
            }
        };
        let frames = made.table.frames();
        for (k, &(_, body)) in way.iter().enumerate() {
            self.carried[body] = Some((format!("{name}.{}", k + 1), frames[k + 1]));
        }
        self.measure(serial.difference(&made.table));
        if let Some(cut) = cut {
            let side = usize::from(self.graph.ends[cut][0] != end);
            self.cut_frames[cut][side] = Some(name.clone());
            self.cut_poses[cut].get_or_insert(frames[way.len()] * tip);
        }
        let chain = ChainDescription {
            rows: chains::rows(&made.table, &variables),
            tip: match cut.map(|cut| self.axes.joints[cut].value.kind) {
                Some(AxisKind::Spherical) => Displacement::of_position(tip.position.0),
                _ => Displacement::of_pose(&tip),
            },
            ..ChainDescription::frame(&on, between(&parent, &made.table.base))
        };
        self.chains.push(Named::new(name.clone(), chain));
        let placed = PlacedChain::of(name, on, variables, &made);
        self.placed.push(placed);
    }

    fn measure(&mut self, (turned, moved): (f64, f64)) {
        self.turned = self.turned.max(turned);
        self.moved = self.moved.max(moved);
    }

    /// A chain that ends at a joint to be put back: its frames, and from the last of them the frame
    /// there.
    fn ended(&self, serial: SerialAxes, cut: usize) -> (FrameAssignment, Pose<f64>) {
        let rows = serial.joints.len();
        let kind = self.axes.joints[cut].value.kind;
        let line = self.values.lines[cut];
        let last = serial.joints.last().copied();
        let slides = last.is_none_or(|joint| joint.is_prismatic());
        let at_tool = |tool: Pose<f64>| {
            let made = SerialAxes {
                tool: Some(tool),
                ..serial.clone()
            };
            let made = made.assign(self.convention);
            let tip = made.table.frames()[rows].inverse() * tool;
            (made, tip)
        };
        let known = self.cut_poses[cut];
        let axis = match (kind, last) {
            (AxisKind::Spherical, _) if slides => {
                return at_tool(Pose::translation(line.point));
            }
            // the link then points to the ball
            (AxisKind::Spherical, Some(last)) => {
                let direction = last.line.direction;
                JointAxis::revolute(Line { direction, ..line }, 0.0)
            }
            (AxisKind::Prismatic, _) => match known {
                Some(pose) => return at_tool(pose),
                None => JointAxis::prismatic(line, 0.0),
            },
            _ => JointAxis::revolute(line, 0.0),
        };
        let mut extended = serial.clone();
        extended.joints.push(axis);
        let made = extended.assign(self.convention);
        let frames = made.table.frames();
        let mut end = frames[rows + 1];
        if kind == AxisKind::Spherical {
            end.position = line.point;
        } else if let Some(known) = known {
            let z = end.rotation.column(Axis::Z);
            end.position += z.times((known.position - end.position).dot(&z));
        }
        (made, frames[rows].inverse() * end)
    }

    /// Frames for the sides of cut joints that no chain ends at.
    fn put_back(&mut self) {
        for &joint in self.cuts {
            for side in 0..2 {
                if self.cut_frames[joint][side].is_some() {
                    continue;
                }
                let body = self.graph.ends[joint][side];
                let Some((on, parent)) = self.carried[body].clone() else {
                    continue;
                };
                let pose = match self.cut_poses[joint] {
                    Some(pose) => pose,
                    None => self.upright(joint, &parent),
                };
                self.cut_poses[joint] = Some(pose);
                let kind = self.axes.joints[joint].value.kind;
                // only of a sliding joint the x axes must agree
                let pose = match kind {
                    AxisKind::Spherical => Pose {
                        rotation: parent.rotation,
                        ..pose
                    },
                    AxisKind::Prismatic => pose,
                    _ => turned_to(&pose, &parent),
                };
                let steps = between(&parent, &pose);
                self.cut_frames[joint][side] = Some(self.fixed_frame(joint, body, on, steps));
            }
        }
    }

    /// The name of a frame that is fixed to a carried body.
    fn fixed_frame(
        &mut self,
        joint: usize,
        body: usize,
        on: String,
        steps: Vec<Displacement>,
    ) -> String {
        if steps.is_empty() {
            return on;
        }
        let joint = &self.axes.joints[joint].name.value;
        if let Some(platform) = place_of(&self.platforms, &on) {
            self.platforms[platform]
                .value
                .frames
                .push(Named::new(joint.clone(), steps));
            return format!("{on}.{joint}");
        }
        let wanted = format!("{joint} on {}", self.graph.bodies[body].value);
        let name = self.free_name(&wanted, "frame");
        let chain = ChainDescription::frame(&on, steps);
        self.chains.push(Named::new(name.clone(), chain));
        name
    }

    /// A frame with z along a joint's axis, nearest to a body's frame.
    fn upright(&self, joint: usize, parent: &Pose<f64>) -> Pose<f64> {
        let line = self.values.lines[joint];
        let frame = Pose {
            rotation: Rotation([Vector3::unit(0), Vector3::unit(1), line.direction]),
            position: line.foot(&parent.position),
        };
        match self.axes.joints[joint].value.kind {
            AxisKind::Spherical => Pose {
                rotation: parent.rotation,
                position: line.point,
            },
            _ => turned_to(&frame, parent),
        }
    }

    fn closure(&self, joint: usize) -> Named<ClosureDescription> {
        let described = &self.axes.joints[joint];
        let kind = described.value.kind.closure();
        let kind = kind.expect("tables are made of joints that can be cut");
        let frames = self.cut_frames[joint]
            .clone()
            .map(Option::unwrap_or_default);
        let closure = ClosureDescription::new(kind, frames);
        Named::new(described.name.value.clone(), closure)
    }
}
