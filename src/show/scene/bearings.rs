//! Hinges that a file gives through two points: they have a bearing at each.

use super::{JointShape, JointSymbol, Scene, close};
use crate::description::{AxisDescription, AxisKind, AxisPlace};
use crate::geometry::{Pose, Vector3};
use crate::mechanism::{Frame, Mechanism};

impl Scene {
    /// Adds the bearings at the second points, to which both bodies reach as they do to the first. In a plane of motion both
    /// points are seen as one pin.
    pub(super) fn bearings(
        &mut self,
        mechanism: &Mechanism,
        pose: &impl Fn(Frame) -> Pose<f64>,
        number: &impl Fn(Frame) -> usize,
    ) {
        let made = mechanism.coordinates().filter(|_| self.normal.is_none());
        for joint in made.iter().flat_map(|made| &made.axes.joints) {
            let Some((frame, far)) = hinge(mechanism, &joint.name.value, &joint.value) else {
                continue;
            };
            let stand = pose(frame);
            let [near, far] = [0.0, far].map(|far| stand.position + stand.rotation.0[2].times(far));
            let between = joint.value.between.iter().flatten();
            let bodies = between.filter_map(|body| mechanism.frame(&body.value).map(number));
            let bodies: Vec<usize> = bodies.collect();
            let stands_here = |of: &&JointShape| {
                of.kind == JointSymbol::Revolute
                    && close(&Vector3(of.at), &near)
                    && of.bodies.iter().all(|body| bodies.contains(body))
            };
            let Some(shape) = self.joints.iter().find(stands_here).cloned() else {
                continue;
            };
            for body in shape.bodies {
                self.reach(body, near, far);
            }
            self.joints.push(JointShape { at: far.0, ..shape });
        }
    }

    /// Leads a body to a second place from all to which it leads from the first.
    fn reach(&mut self, body: usize, near: Vector3<f64>, far: Vector3<f64>) {
        self.attach(body, far);
        let lines = self.bodies[body].lines.iter();
        let pairs = lines.flat_map(|line| line.windows(2));
        let pairs = pairs.map(|pair| [Vector3(pair[0]), Vector3(pair[1])]);
        let ends = pairs.flat_map(|[from, to]| [[from, to], [to, from]]);
        let others = ends.filter_map(|[end, other]| close(&end, &near).then_some(other));
        for other in others.collect::<Vec<_>>() {
            self.line(body, [far, other]);
        }
    }
}

/// The frame whose z axis is that of a hinge given through two points, its origin at the first, and the distance of the second
/// in m.
fn hinge(mechanism: &Mechanism, name: &str, joint: &AxisDescription) -> Option<(Frame, f64)> {
    let (AxisKind::Revolute, AxisPlace::Through(first, second)) = (joint.kind, &joint.place) else {
        return None;
    };
    let point = |of: &[_; 3]| {
        let [x, y, z] = of.each_ref().map(|entry| mechanism.given(entry));
        Some(Vector3([x?, y?, z?]))
    };
    let far = (point(second)? - point(first)?).norm();
    let mut closures = mechanism.closures().iter();
    if let Some(cut) = closures.find(|closure| closure.name == name) {
        return Some((cut.frames[0], far));
    }
    // the chain of the body that the joint carries
    let between = joint.between.as_ref()?;
    let is_body = |name: &str| between.iter().any(|body| body.value == name);
    let mut chains = mechanism.chains().iter();
    let chain = chains.position(|chain| {
        is_body(&chain.name) && is_body(&mechanism.frame_name(chain.on)) && chain.rows.len() == 1
    })?;
    Some((Frame::Link { chain, row: 0 }, far))
}
