//! Grips: points and bodies taken hold of by a pointer.

use serde_json::{Value, json};

use super::request::{Grip, Hold};
use super::{RefusedReply, nothing};
use crate::ask::Steering;
use crate::geometry::Vector3;
use crate::mechanism::{Frame, Mechanism, Point};

/// A place of a body, or of a rod, which its ends carry in proportion; with the name of the point if it is one.
pub fn grab(steering: &Steering, part: Grip, at: [f64; 3]) -> Result<Value, RefusedReply> {
    let mechanism = steering.mechanism();
    let bodies = mechanism.bodies();
    let held = |frame: Frame, at: Vector3<f64>, share: f64| {
        let body = mechanism.body(frame);
        let frame = mechanism.body_frame(body);
        let pose = mechanism.transform(Frame::Ground, frame, steering.at());
        let offset = (pose.inverse() * at).0;
        let number = bodies.iter().position(|known| *known == body);
        let body = number.expect("every frame belongs to a body of the mechanism");
        (
            Hold {
                body,
                offset,
                share,
            },
            Point { frame, offset },
        )
    };
    let at = Vector3(at);
    match part {
        Grip::Body(body) => {
            let (hold, point) = held(frame(mechanism, body)?, at, 1.0);
            Ok(json!({ "grip": [hold], "name": point.name(mechanism) }))
        }
        Grip::Rod(rod) => {
            let mut rods = mechanism
                .closures()
                .iter()
                .filter(|of| of.kind.has_length());
            let rod = rods
                .nth(rod)
                .ok_or_else(|| nothing("there is no such rod"))?;
            let ends = (rod.frames).map(|frame| {
                mechanism
                    .transform(Frame::Ground, frame, steering.at())
                    .position
            });
            let along = ends[1] - ends[0];
            let part = (at - ends[0]).dot(&along) / along.dot(&along);
            let part = if part.is_finite() {
                part.clamp(0.0, 1.0)
            } else {
                0.0
            };
            let [(first, _), (second, _)] = [(0, 1.0 - part), (1, part)]
                .map(|(end, share)| held(rod.frames[end], ends[end], share));
            Ok(json!({ "grip": [first, second], "name": Value::Null }))
        }
    }
}

/// The points of a grip with their shares.
pub fn points(mechanism: &Mechanism, grip: &[Hold]) -> Result<Vec<(Point, f64)>, RefusedReply> {
    let points = grip.iter().map(|hold| {
        let frame = frame(mechanism, hold.body)?;
        let offset = hold.offset;
        Ok((Point { frame, offset }, hold.share))
    });
    points.collect()
}

fn frame(mechanism: &Mechanism, body: usize) -> Result<Frame, RefusedReply> {
    let bodies = mechanism.bodies();
    let body = bodies
        .get(body)
        .ok_or_else(|| nothing("there is no such body"))?;
    Ok(mechanism.body_frame(*body))
}
