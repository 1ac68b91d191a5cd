//! Joints of an SDF file.

use roxmltree::Node;

use super::model::{ModelScope, SdfReader};
use super::parts::{KINDS, SdfAxis, SdfJoint, SdfType, frame_of};
use crate::geometry::{Pose, Vector3};
use crate::interchange::xml_reader::{child, tag};

impl SdfReader<'_> {
    pub(super) fn joint(&mut self, node: Node, scope: &ModelScope) -> Option<SdfJoint> {
        let name = self.named(node, scope);
        let kind = self.problems.word(node, "type", &KINDS);
        let ends = ["parent", "child"].map(|end| {
            let part = self.problems.needed_child(node, end)?;
            let text = part.text().or(part.attribute("link")).unwrap_or_default();
            Some(scope.name(text))
        });
        let ([parent, carrier], name, kind) = (ends, name?, kind?);
        let (parent, carrier) = (parent?, carrier?);
        let place = self.pose(node, scope, &carrier);
        let own = frame_of(&name);
        if !self.frames.add(&own, place, Some(carrier.clone())) {
            self.problems.duplicate("joint", &name, node);
        }
        // before version 1.7 a joint may be called as a link, which then has the name
        if !self.frames.has(&name) {
            let at = (own.clone(), Pose::identity());
            self.frames.add(&name, at, Some(own.clone()));
        }
        let wanted: &[&str] = match kind {
            SdfType::Ball | SdfType::Fixed => &[],
            SdfType::Universal | SdfType::Gear => &["axis", "axis2"],
            _ => &["axis"],
        };
        let mut axes: Vec<SdfAxis> = Vec::new();
        let without = child(node, "axis").is_none();
        for part in wanted {
            let axis = match child(node, part) {
                None if kind == SdfType::Universal => {
                    let along = match axes.first() {
                        None => 0,
                        Some(_) if without => 1,
                        // across the first where that is along z
                        Some(first) if first.along.0[2].abs() > 0.9 => 0,
                        Some(_) => 2,
                    };
                    self.axisless.insert(name.clone());
                    SdfAxis::new(Vector3::unit(along), own.clone())
                }
                _ => {
                    let part = self.problems.needed_child(node, part)?;
                    self.axis(part, scope, &name)?
                }
            };
            axes.push(axis);
        }
        // metres per turn, 1 unless given, or before in rad/m against the turn
        let advance = self.numbers::<1>(node, "screw_thread_pitch");
        let before = self.numbers::<1>(node, "thread_pitch");
        let pitch = match (advance, before) {
            (Some([advance]), _) => advance / std::f64::consts::TAU,
            (None, Some([turn])) if turn != 0.0 => -1.0 / turn,
            _ => 1.0 / std::f64::consts::TAU,
        };
        let gear = match kind {
            SdfType::Gear => {
                let part = self.problems.needed_child(node, "gearbox_reference_body")?;
                let [ratio] = self.numbers(node, "gearbox_ratio").unwrap_or([1.0]);
                Some((scope.name(part.text().unwrap_or_default()), ratio))
            }
            _ => None,
        };
        Some(SdfJoint {
            gear,
            name,
            kind,
            ends: [parent, carrier],
            axes,
            pitch,
            span: tag(node),
        })
    }

    fn axis(&mut self, node: Node, scope: &ModelScope, joint: &str) -> Option<SdfAxis> {
        let given = self.numbers(node, "xyz").unwrap_or([0.0, 0.0, 1.0]);
        let example = "<xyz>0 0 1</xyz>";
        let along = self.problems.axis(given, joint, example, node)?;
        let expressed_in = child(node, "xyz").and_then(|xyz| xyz.attribute("expressed_in"));
        let of_model = match self.word(node, "use_parent_model_frame") {
            Some(word) => matches!(word, "true" | "1"),
            None => self.version < (1, 5),
        };
        let seen_from = match expressed_in.map_or("", str::trim) {
            "" if of_model => scope.model(),
            "" => frame_of(joint),
            name => scope.name(name),
        };
        let limit = child(node, "limit");
        let ends = ["lower", "upper"].map(|end| {
            let part = child(limit?, end)?;
            let value: Option<f64> = part.text().and_then(|text| text.trim().parse().ok());
            if value.is_none_or(f64::is_nan) {
                (self.problems).not_numbers(part.text().unwrap_or_default(), 1, tag(part));
            }
            // farther is as good as nowhere
            value.filter(|value| value.abs() < 1e15)
        });
        let limits = match ends {
            [Some(low), Some(high)] => Some((low, high)).filter(|_| low <= high),
            _ => None,
        };
        let mimic = child(node, "mimic").and_then(|mimic| {
            let leader = scope.name(self.problems.needed(mimic, "joint")?);
            let [factor] = self.numbers(mimic, "multiplier").unwrap_or([1.0]);
            let [offset] = self.numbers(mimic, "offset").unwrap_or([0.0]);
            let [reference] = self.numbers(mimic, "reference").unwrap_or([0.0]);
            Some((leader, factor, offset - factor * reference))
        });
        Some(SdfAxis {
            limits,
            one_sided: ends.iter().flatten().count() == 1,
            mimic,
            ..SdfAxis::new(along, seen_from)
        })
    }
}
