//! The links of a chain along the common normals of its table, and the joints between them.

use super::{JointShape, JointSymbol, Scene, close};
use crate::description::Role;
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Convention, Frame, Mechanism};

impl Scene {
    /// Adds the bodies and joints of a chain.
    ///
    /// A row of the modified convention goes along a of the frame before it, then along d of the frame after it, where
    /// its joint stands; one of the standard convention along d of the frame before it, where its joint stands, then
    /// along a.
    pub(super) fn chain(
        &mut self,
        mechanism: &Mechanism,
        chain: usize,
        pose: &impl Fn(Frame) -> Pose<f64>,
        number: &impl Fn(Frame) -> usize,
    ) {
        let part = &mechanism.chains()[chain];
        let link = |row: usize| Frame::Link { chain, row };
        let first = pose(link(0));
        let on = number(part.on);
        if !self.bodies[on].ground {
            self.line(on, [pose(part.on).position, first.position]);
        }
        let from = self.joints.len();
        for (i, row) in part.rows.iter().enumerate() {
            let [before, after] = [i, i + 1].map(|row| pose(link(row)));
            let bodies = [i, i + 1].map(|row| number(link(row)));
            let (turns, slides) = (!row.theta.terms.is_empty(), !row.d.terms.is_empty());
            let (axis, normal) = match part.convention {
                Convention::Modified => (after.rotation.0[2], before.rotation.0[0]),
                Convention::Standard => (before.rotation.0[2], after.rotation.0[0]),
            };
            let step = after.position - before.position;
            let corner = match part.convention {
                Convention::Modified => before.position + normal.times(step.dot(&normal)),
                Convention::Standard => before.position + axis.times(step.dot(&axis)),
            };
            // a slide on ground is where its block is; in a leg it stands halfway, apart from the joints at its ends
            let sliding = |from: Vector3<f64>, to: Vector3<f64>| match self.bodies[bodies[0]].ground
            {
                true => to,
                false => (from + to).times(0.5),
            };
            let at = match part.convention {
                Convention::Modified if slides => sliding(corner, after.position),
                Convention::Modified => after.position,
                Convention::Standard if slides => sliding(before.position, corner),
                Convention::Standard => before.position,
            };
            let path = [before.position, corner, after.position];
            // the joint cuts the path: what is before it belongs to one body, what is behind it to the other
            let (first, second): (&[_], &[_]) = match part.convention {
                Convention::Modified => (&[path[0], path[1], at], &[at, path[2]]),
                Convention::Standard => (&[path[0], at], &[at, path[1], path[2]]),
            };
            for (body, points) in bodies.into_iter().zip([first, second]) {
                points
                    .windows(2)
                    .for_each(|pair| self.line(body, [pair[0], pair[1]]));
            }
            let kind = match (turns, slides) {
                (false, false) => continue,
                (true, false) => JointSymbol::Revolute,
                (false, true) => JointSymbol::Prismatic,
                (true, true) if row.joints().len() > 1 => JointSymbol::Cylindrical,
                (true, true) => JointSymbol::Helical,
            };
            let joints = row.joints();
            let driven =
                (joints.iter()).any(|&joint| mechanism.joints()[joint].role == Role::Actuated);
            bodies.into_iter().for_each(|body| self.attach(body, at));
            let names = joints
                .iter()
                .map(|&joint| mechanism.joints()[joint].name.clone());
            self.joints.push(JointShape {
                names: names.collect(),
                kind,
                at: at.0,
                axes: vec![axis.0],
                bodies,
                driven,
                closure: false,
            });
        }
        self.join_turning(from);
        let (last, tip) = (link(part.rows.len()), Frame::Tip { chain });
        let (body, end) = (number(last), pose(tip).position);
        self.line(body, [pose(last).position, end]);
        self.attach(body, end);
    }

    /// Puts slides on ground where their blocks are: a table may place one anywhere on its axis, and a block is where the only
    /// other thing that it carries stands.
    pub(super) fn blocks(&mut self) {
        for joint in &mut self.joints {
            let on_ground = joint.bodies.map(|body| self.bodies[body].ground);
            let block = match (joint.kind, on_ground) {
                (JointSymbol::Prismatic, [true, false]) => joint.bodies[1],
                (JointSymbol::Prismatic, [false, true]) => joint.bodies[0],
                _ => continue,
            };
            let (at, axis) = (Vector3(joint.at), Vector3(joint.axes[0]));
            let along = |point: &[f64; 3]| {
                let from = Vector3(*point) - at;
                from.cross(&axis).norm() <= 1e-9 * from.norm()
            };
            let body = &mut self.bodies[block];
            let elsewhere = |corner: &&[f64; 3]| !close(&Vector3(**corner), &at);
            let others: Vec<[f64; 3]> = body.corners.iter().filter(elsewhere).copied().collect();
            if let [place] = others[..]
                && body.lines.iter().flatten().chain(&others).all(along)
            {
                joint.at = place;
                body.corners = others;
                body.lines.clear();
            }
        }
    }

    pub(super) fn line(&mut self, body: usize, [from, to]: [Vector3<f64>; 2]) {
        if close(&from, &to) {
            return;
        }
        let lines = &mut self.bodies[body].lines;
        match lines.last_mut() {
            Some(line) if line.last() == Some(&from.0) => line.push(to.0),
            _ => lines.push(vec![from.0, to.0]),
        }
    }

    /// Revolute joints one after the other whose axes meet are one universal or spherical joint.
    fn join_turning(&mut self, from: usize) {
        let mut joined: Vec<JointShape> = Vec::new();
        for joint in self.joints.drain(from..) {
            let meets = |before: &&mut JointShape| {
                joint.kind == JointSymbol::Revolute
                    && matches!(before.kind, JointSymbol::Revolute | JointSymbol::Universal)
                    && before.bodies[1] == joint.bodies[0]
                    && close(&Vector3(before.at), &Vector3(joint.at))
            };
            match joined.last_mut().filter(meets) {
                Some(before) => {
                    before.kind = match before.kind {
                        JointSymbol::Revolute => JointSymbol::Universal,
                        _ => JointSymbol::Spherical,
                    };
                    before.names.extend(joint.names);
                    before.axes.extend(joint.axes);
                    before.bodies[1] = joint.bodies[1];
                    before.driven |= joint.driven;
                }
                None => joined.push(joint),
            }
        }
        self.joints.append(&mut joined);
    }
}
