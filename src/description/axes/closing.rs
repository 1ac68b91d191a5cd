//! The closures of joints that are cut, and frames that stand on bodies.

use super::places::{difference, length};
use super::tables::Tables;
use super::{AxisKind, AxisPlace};
use crate::algebra::Expression;
use crate::description::steps::between;
use crate::description::{
    ChainDescription, ClosureDescription, Displacement, Named, Spanned, first_free, place_of,
};

impl Tables<'_> {
    /// A frame on a body under a name.
    pub(super) fn stand(&mut self, body: usize, name: Spanned<String>, steps: &[Displacement]) {
        let Some(placed) = &self.bodies[body] else {
            return;
        };
        let base = between(&placed.frame, steps);
        let chain = ChainDescription::frame(&placed.name, base);
        self.made.chains.push(Named { name, value: chain });
    }

    pub(super) fn close(&mut self, joint: usize) {
        let described = &self.axes.joints[joint];
        let Some(kind) = described.value.kind.closure() else {
            return;
        };
        let first = self.bodies[self.graph.ends[joint][0]].clone();
        let otherwise = first.map_or_else(Vec::new, |body| body.frame);
        let frames = [0, 1].map(|side| self.side(joint, side, &otherwise));
        let length = (described.value.kind == AxisKind::Distance).then(|| {
            match (&described.value.place, &described.value.value) {
                (_, Some(value)) => value.clone(),
                (AxisPlace::Through(first, second), _) if !described.value.is_variable() => {
                    length(&difference(first, second))
                }
                _ => Expression::name(described.name.value.clone()).into(),
            }
        });
        let closure = ClosureDescription {
            kind,
            frames: frames.map(|name| Spanned::new(name, described.value.span.clone())),
            length,
            span: described.value.span.clone(),
        };
        let name = described.name.clone();
        self.made.closures.push(Named {
            name,
            value: closure,
        });
    }

    /// The name of the frame of a cut joint on one of its bodies.
    fn side(&mut self, joint: usize, side: usize, otherwise: &[Displacement]) -> String {
        let body = self.graph.ends[joint][side];
        let steps = self.joint_frame(joint, side, side, otherwise);
        let Some(placed) = self.bodies[body].clone() else {
            return String::new();
        };
        let relative = between(&placed.frame, &steps);
        if relative.is_empty() {
            return placed.name;
        }
        let wanted = &self.axes.joints[joint].name.value;
        if let Some(platform) = placed.platform {
            let frames = &mut self.made.platforms[platform].value.frames;
            let name = first_free(wanted, "_", |name| place_of(frames, name).is_none());
            frames.push(Named::new(name.clone(), relative));
            return format!("{}.{name}", placed.name);
        }
        let name = self.free_name(&format!("{wanted}_{}", side + 1));
        let chain = ChainDescription::frame(&placed.name, relative);
        self.made.chains.push(Named::new(name.clone(), chain));
        name
    }
}
