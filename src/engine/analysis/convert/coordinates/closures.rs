//! Closures as joints that are cut, and as rods; what floats.

use std::collections::BTreeSet;

use super::{Drawing, axis_along, is_oblique, point_of, rotations};
use crate::description::steps::zero;
use crate::description::{
    Axis, AxisDescription, AxisKind, AxisPlace, ClosureKind, Entry, GROUND, Named, Spanned,
};

impl Drawing<'_> {
    /// Free joints of platforms that nothing holds to ground.
    pub(super) fn floating(&mut self) {
        for platform in &self.description.platforms {
            let body = &platform.name.value;
            let mut held = BTreeSet::from([GROUND]);
            let mut before = 0;
            while before < held.len() {
                before = held.len();
                let joints = self.axes.joints.iter();
                let pairs = joints.filter_map(|joint| joint.value.between.as_ref());
                for [a, b] in pairs {
                    if held.contains(&*a.value) || held.contains(&*b.value) {
                        held.extend([&*a.value, &*b.value]);
                    }
                }
            }
            if !held.contains(&**body) {
                let nowhere = AxisPlace::Frame(Vec::new());
                let mut joint = AxisDescription::new(AxisKind::Free, nowhere);
                joint.between = Some([GROUND, body].map(|of| Spanned::nowhere(of.to_owned())));
                let name = self.free(&format!("{body} floats"));
                self.axes.joints.push(Named::new(name, joint));
            }
        }
    }

    pub(super) fn closures(&mut self) {
        for (index, named) in self.description.closures.iter().enumerate() {
            if let (ClosureKind::Coupling, Some(zero)) = (named.value.kind, &named.value.length) {
                let coupling = Named::new(named.name.value.clone(), zero.clone());
                self.axes.couplings.push(coupling);
                continue;
            }
            let frames = self.mechanism.closures()[index].frames;
            let at = frames.map(|frame| self.places[&frame].clone());
            let between = frames.map(|frame| self.body(frame));
            if named.value.kind == ClosureKind::Distance {
                self.rod(index, at.each_ref().map(|steps| point_of(steps)), between);
                continue;
            }
            let mut kinds = AxisKind::ALL.into_iter();
            let kind = (kinds.find(|kind| kind.closure() == Some(named.value.kind)))
                .expect("every closure restores some joint");
            let oblique = at.iter().any(|steps| is_oblique(steps));
            let parallel = rotations(&at[0]).eq(rotations(&at[1]));
            let [place, second] = [0, 1].map(|side| {
                use AxisKind::{Cylindrical, Planar, Prismatic, Revolute, Spherical, Universal};
                let steps = &at[side];
                let along = |axis: Axis| axis_along(steps, axis, 1.0);
                let across = |sense: f64| axis_along(steps, Axis::Y, sense);
                match kind {
                    Spherical => AxisPlace::Centre(point_of(steps)),
                    // its values are zero where x is first × second
                    Universal => {
                        let (z, first) = (along(Axis::Z), side == 0);
                        let axes = if first {
                            [z, across(-1.0)]
                        } else {
                            [across(1.0), z]
                        };
                        AxisPlace::Cross(point_of(steps), axes)
                    }
                    Revolute | Cylindrical | Planar if !oblique => {
                        AxisPlace::Along(Some(point_of(steps)), along(Axis::Z))
                    }
                    // its bodies do not turn against one another
                    Prismatic if !oblique && parallel => {
                        AxisPlace::Along(Some(point_of(steps)), along(Axis::Z))
                    }
                    _ => AxisPlace::Frame(steps.clone()),
                }
            });
            let name = self.free(&named.name.value);
            let mut joint = AxisDescription::new(kind, place);
            joint.between = Some(between.map(Spanned::nowhere));
            if second != joint.place {
                joint.second = Some(second);
            }
            if !kind.always_cut() {
                self.axes.cut.push(Spanned::nowhere(name.clone()));
            }
            self.axes.joints.push(Named::new(name, joint));
        }
    }

    /// A rod: of a length that is a variable of its own, or that is given.
    fn rod(&mut self, index: usize, points: [[Entry; 3]; 2], between: [String; 2]) {
        let named = &self.description.closures[index];
        let [first, second] = points;
        let mut rod = AxisDescription::new(AxisKind::Distance, AxisPlace::Through(first, second));
        rod.between = Some(between.map(Spanned::nowhere));
        let length = named.value.length.clone().unwrap_or_else(zero);
        let sum = self.entry(&length);
        let own = match &sum.terms[..] {
            [(name, factor)] if factor.as_number() == Some(1.0) && sum.constant.is_zero() => {
                Some(name.clone()).filter(|name| !self.own.contains(name))
            }
            _ => None,
        };
        let name = match own {
            Some(name) => {
                rod.home = self.declared(&name, &mut rod);
                name
            }
            None => {
                rod.value = Some(length);
                self.free(&named.name.value)
            }
        };
        self.axes.joints.push(Named::new(name, rod));
    }
}
