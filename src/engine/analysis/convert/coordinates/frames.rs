//! Frames of bodies, and the points that remain of other frames.

use super::{Drawing, place_at, rotations};
use crate::analysis::convert::references::{frame_in, frame_of};
use crate::description::{
    AxisDescription, AxisPlace, GROUND, Named, PointDescription, Spanned, first_free, place_of,
};
use crate::mechanism::Frame;

impl Drawing<'_> {
    /// True if a closed form, a quantity or a load names a frame.
    fn is_asked(&self, frame: &str) -> bool {
        let mut loads = self.description.loads.clone();
        let mut loads = loads.points();
        let forms = self.description.closed_forms.iter();
        let mut frames = forms.flat_map(|form| form.value.of.iter().chain(&form.value.relative_to));
        let outputs = self.description.outputs.iter();
        let mut names = outputs.flat_map(|output| output.value.expression.names());
        frames.any(|name| name.value == frame)
            || loads.any(|point| point.value[..frame_of(&point.value)] == *frame)
            || names.any(|(name, _)| name[frame_in(name)] == *frame)
    }

    /// True if a frame has the name that the end of a closure gets in tables.
    fn ends_closure(&self, frame: &str) -> bool {
        self.description.closures.iter().any(|closure| {
            let mut ends = closure.value.frames.iter().enumerate();
            let name = &closure.name.value;
            ends.any(|(side, end)| {
                let on_platform = end
                    .value
                    .split_once('.')
                    .is_some_and(|(_, end)| end == name);
                end.value == frame && (on_platform || *frame == format!("{name}_{}", side + 1))
            })
        })
    }

    /// True if the frame of a body is where it is by default: at the joint that carries it.
    fn is_at_joint(&self, body: &str, place: &AxisPlace) -> bool {
        let carries = |joint: &&Named<AxisDescription>| {
            let between = joint.value.between.as_ref();
            between.is_some_and(|between| between[1].value == body)
        };
        let carrier = self.axes.joints.iter().find(carries);
        carrier.is_some_and(|joint| match (&joint.value.place, place) {
            (AxisPlace::Along(Some(point), _), AxisPlace::Centre(origin)) => point == origin,
            (joint, place) => joint == place,
        })
    }

    /// Adds the frames of bodies and the points; returns the new names of frames.
    pub(super) fn frames(&mut self) -> Vec<(String, String)> {
        let connected = |body: &String| {
            let mut joints =
                (self.axes.joints.iter()).flat_map(|j| j.value.between.iter().flatten());
            body == GROUND || joints.any(|end| end.value == *body)
        };
        let (mut bodies, mut points, mut renamed) = (Vec::new(), Vec::new(), Vec::new());
        for frame in self.mechanism.frames() {
            let (old, body) = (self.mechanism.frame_name(frame), self.body(frame));
            if !connected(&body) || frame == Frame::Ground {
                continue;
            }
            let steps = &self.places[&frame];
            let carrier = self.mechanism.body(frame);
            let named = self.carries_tip(carrier);
            let moves = self.mechanism.body_frame(carrier) == frame;
            let asked = self.is_asked(&old);
            // such an end has a name of its own, if it is not the frame of the body itself
            let own = self.places.get(&self.mechanism.body_frame(carrier));
            let is_end =
                rotations(steps).next().is_none() && own != Some(steps) && self.ends_closure(&old);
            match frame {
                Frame::Platform { .. } => bodies.push(Named::new(body, place_at(steps))),
                Frame::Tip { .. } if named && body == old => {
                    let place = place_at(steps);
                    if !self.is_at_joint(&body, &place) {
                        bodies.push(Named::new(body, place));
                    }
                }
                Frame::Link { .. } if !asked => {}
                _ if !asked && is_end => {}
                Frame::Link { .. } if moves && !named => {
                    bodies.push(Named::new(body.clone(), AxisPlace::Frame(steps.clone())));
                    renamed.push((old, body));
                }
                _ => {
                    let wanted = old.replace('.', "_");
                    let free = |name: &str| {
                        !self.bodies.values().any(|other| other == name)
                            && place_of(&points, name).is_none()
                    };
                    let name = first_free(&wanted, free);
                    let body = Spanned::nowhere(body);
                    let place = place_at(steps);
                    points.push(Named::new(name.clone(), PointDescription { body, place }));
                    renamed.push((old, name));
                }
            }
        }
        (self.axes.bodies, self.axes.points) = (bodies, points);
        renamed
    }
}
