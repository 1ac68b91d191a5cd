//! Joint coordinates → tables, as they are written.
//!
//! Nothing is evaluated: coordinates stay expressions of the parameters, so that another value of a parameter moves
//! everything that depends on it, and the structure never depends on values. Each body becomes a chain of one row,
//!
//! ```text
//! base = F_parent⁻¹·J,  row = the motion about or along z,  tip = J'⁻¹·F_body
//! ```
//!
//! with J the frame of the joint on its parent, J' that on the body, which is the same where the drawing shows them
//! together, and F the frames of the bodies in the drawing (a product of exponentials, as in R. W.
//! Brockett, Robotic manipulators and the product of exponentials formula, 1984): the tip carries the name of the
//! body. Common normals, which would need divisions by zero where axes become parallel, are not needed for that;
//! `frames` places them on numbers. Joints that are cut become closures, bodies that only these hold become platforms.

mod tree;

use std::collections::BTreeSet;

use super::graph::Graph;
use super::places::{at, difference, frame_of, length, origin};
use super::{AxesDescription, AxisKind, AxisPlace};
use crate::algebra::Expression;
use crate::description::steps::{joined, zero};
use crate::description::{
    AxesProblem, ClosureDescription, Convention, Description, Displacement, Entry, GROUND,
    GivenNames, JointDescription, Named, PlatformDescription, Problem, Role, Spanned, first_free,
    names_of, nearest, place_of,
};

/// Joint coordinates, with the choices made in writing tables of them.
#[derive(Debug, Clone, PartialEq)]
pub struct JointCoordinates {
    /// The file, rods of bodies written as such.
    pub axes: AxesDescription,
    /// The joints that are cut, besides rods and balls.
    pub cut: Vec<String>,
    /// Bodies with nothing but two balls, taken for rods.
    pub rods: Vec<String>,
}

/// A body with its frame: how that is called, and where it is in the drawing.
#[derive(Clone)]
pub(super) struct PlacedBody {
    pub name: String,
    pub frame: Vec<Displacement>,
    pub platform: Option<usize>,
}

/// Tables being made.
pub(super) struct Tables<'a> {
    pub axes: &'a AxesDescription,
    pub graph: &'a Graph,
    /// For each joint the change of its value against the drawing, over variables.
    pub moved: Vec<Entry>,
    cuts: &'a BTreeSet<usize>,
    pub bodies: Vec<Option<PlacedBody>>,
    pub taken: GivenNames,
    pub made: Description,
}

impl AxesDescription {
    /// The mechanism file of the same mechanism; it remembers the coordinates.
    ///
    /// # Errors
    /// All problems of the connection of bodies.
    pub fn tables(&self) -> Result<Description, Vec<Problem>> {
        let (axes, rods) = self.with_rods();
        let graph = Graph::of(&axes)?;
        let mut problems = axes.misplaced(&graph);
        let cuts = match axes.cut.is_empty() {
            true => axes.placed_cuts(&graph),
            false => axes.named_cuts(&graph),
        };
        let moved = axes.moved().map_err(|found| problems.extend(found));
        let cuts = cuts.map_err(|found| problems.extend(found));
        let screws = cuts.iter().flatten().map(|&joint| &axes.joints[joint]);
        for screw in screws.filter(|joint| joint.value.kind == AxisKind::Helical) {
            let joint = screw.name.value.clone();
            problems.push(AxesProblem::ScrewCut { joint }.at(&screw.name.span));
        }
        let (Ok(cuts), Ok(moved), true) = (cuts, moved, problems.is_empty()) else {
            return Err(problems);
        };
        let convention = Spanned::nowhere(Convention::Modified);
        let mut tables = Tables {
            axes: &axes,
            graph: &graph,
            moved,
            cuts: &cuts,
            bodies: vec![None; graph.bodies.len()],
            taken: GivenNames::default(),
            made: Description {
                name: axes.name.clone(),
                source: axes.source.clone(),
                convention: Some(axes.convention.clone().unwrap_or(convention)),
                tolerance: axes.tolerance.clone(),
                parameters: axes.parameters.clone(),
                closed_forms: axes.closed_forms.clone(),
                outputs: axes.outputs.clone(),
                loads: axes.loads.clone(),
                ..Description::default()
            },
        };
        tables.all();
        let made = tables.made;
        let always = axes.always_cut();
        let name = |j: &usize| axes.joints[*j].name.value.clone();
        let cut: Vec<String> = cuts.difference(&always).map(name).collect();
        let coordinates = JointCoordinates { axes, cut, rods };
        Ok(Description {
            coordinates: Some(Box::new(coordinates)),
            ..made
        })
    }

    /// Bodies of points and frames that no joint connects, and values given twice.
    fn misplaced(&self, graph: &Graph) -> Vec<Problem> {
        let mut problems = Vec::new();
        let points = self.points.iter().map(|point| &point.value.body);
        let bodies = self.bodies.iter().map(|body| &body.name);
        for body in points.chain(bodies) {
            if graph.body(&body.value).is_none() {
                let known = graph.bodies.iter().map(|body| body.value.as_str());
                let kind = AxesProblem::UnknownBody {
                    name: body.value.clone(),
                    suggestion: nearest(&body.value, known).map(str::to_owned),
                };
                problems.push(kind.at(&body.span));
            }
        }
        for Named { name, value } in &self.joints {
            let fields = [
                ("role", value.role.is_some()),
                ("home", value.home.is_some()),
                ("limits", value.limits.is_some()),
            ];
            let by = value.kind.follows_by();
            for (field, _) in fields
                .iter()
                .filter(|(_, given)| *given && value.value.is_some())
            {
                let joint = name.value.clone();
                problems.push(AxesProblem::Follows { joint, by, field }.at(&name.span));
            }
        }
        problems
    }
}

impl Tables<'_> {
    fn all(&mut self) {
        let bodies = self.graph.bodies.iter().map(|body| body.value.clone());
        let points = names_of(&self.axes.points).map(str::to_owned);
        self.taken = bodies.chain(points).collect();
        self.variables();
        self.bodies[0] = Some(PlacedBody {
            name: GROUND.into(),
            frame: self.frame_given(0).unwrap_or_default(),
            platform: None,
        });
        self.grow(0);
        let (graph, axes, cuts) = (self.graph, self.axes, self.cuts);
        let asked = |body: usize| {
            let name = &graph.bodies[body].value;
            let mut joints = graph.joints_of(body);
            axes.points
                .iter()
                .any(|point| point.value.body.value == *name)
                || joints.any(|joint| axes.joints[joint].value.kind == AxisKind::Free)
        };
        let is_cut = |joint: usize| cuts.contains(&joint);
        while let Some(root) = graph.next_platform(is_cut, |b| self.bodies[b].is_some(), asked) {
            let frame = self
                .frame_given(root)
                .unwrap_or_else(|| self.first_point(root));
            let name = self.graph.bodies[root].clone();
            self.bodies[root] = Some(PlacedBody {
                name: name.value.clone(),
                frame: frame.clone(),
                platform: Some(self.made.platforms.len()),
            });
            let home = joined(frame);
            let frames = Vec::new();
            let value = PlatformDescription { home, frames };
            self.made.platforms.push(Named { name, value });
            self.grow(root);
        }
        for &joint in cuts {
            self.close(joint);
        }
        for Named { name, value } in &axes.couplings {
            let value = ClosureDescription::coupling(value.clone(), name.span.clone());
            let name = name.clone();
            self.made.closures.push(Named { name, value });
        }
        for point in &axes.points {
            let Some(body) = self.graph.body(&point.value.body.value) else {
                continue;
            };
            let steps = frame_of(&point.value.place, 0, &[]);
            self.stand(body, point.name.clone(), &steps);
        }
        if let (Some(tool), true) = (&axes.tool, axes.is_serial()) {
            let name = self.taken.give("tool");
            let last = self.graph.bodies.len() - 1;
            self.stand(last, Spanned::nowhere(name), tool);
        }
    }

    /// The joint variables, those of cut joints left out that nothing drives, limits or follows.
    fn variables(&mut self) {
        let (driven, leading) = (self.axes.driven(), self.axes.leading());
        for (j, joint) in self.axes.joints.iter().enumerate() {
            let Named { name, value } = joint;
            let kept = !self.cuts.contains(&j)
                || value.kind == AxisKind::Distance
                || driven[j]
                || value.limits.is_some()
                || leading.contains(&*name.value);
            if !value.is_variable() || !kept {
                continue;
            }
            let home = match (&value.home, &value.place) {
                (Some(home), _) => home.clone(),
                (None, AxisPlace::Through(first, second)) if value.kind == AxisKind::Distance => {
                    length(&difference(first, second))
                }
                (None, _) => zero(),
            };
            let role = [Role::Passive, Role::Actuated][usize::from(driven[j])];
            let joint = JointDescription {
                limits: value.limits.clone(),
                span: value.span.clone(),
                ..JointDescription::new(role, home)
            };
            let name = name.clone();
            self.made.joints.push(Named { name, value: joint });
        }
    }

    /// A passive variable of a joint that has several.
    fn variable(&mut self, wanted: &str) -> Entry {
        let taken = |name: &str| {
            place_of(&self.made.joints, name).is_some()
                || place_of(&self.axes.joints, name).is_some()
                || place_of(&self.axes.parameters, name).is_some()
        };
        let name = first_free(wanted, |name| !taken(name));
        let joint = JointDescription::new(Role::Passive, zero());
        self.made.joints.push(Named::new(name.clone(), joint));
        Expression::name(name).into()
    }

    /// Frame of a body as the file gives it, if it does.
    fn frame_given(&self, body: usize) -> Option<Vec<Displacement>> {
        let index = place_of(&self.axes.bodies, &self.graph.bodies[body].value)?;
        Some(frame_of(&self.axes.bodies[index].value, 0, &[]))
    }

    fn first_point(&self, body: usize) -> Vec<Displacement> {
        let placed = |&joint: &usize| !self.axes.joints[joint].value.has_no_place();
        let Some(joint) = self.graph.joints_of(body).find(placed) else {
            return Vec::new();
        };
        let side = usize::from(self.graph.ends[joint][1] == body);
        at(&origin(&self.joint_frame(joint, side, side, &[])))
    }

    /// The frame of a joint where one of its bodies has it, along the axis of the first body or the second.
    pub(super) fn joint_frame(
        &self,
        joint: usize,
        side: usize,
        axis: usize,
        otherwise: &[Displacement],
    ) -> Vec<Displacement> {
        let joint = &self.axes.joints[joint].value;
        let place = match &joint.second {
            Some(second) if side == 1 => second,
            _ => &joint.place,
        };
        match (place, joint.kind) {
            (AxisPlace::Through(first, second), AxisKind::Distance) => at([first, second][side]),
            (AxisPlace::Frame(steps), AxisKind::Fixed | AxisKind::Free) if steps.is_empty() => {
                otherwise.to_vec()
            }
            _ => frame_of(place, axis, otherwise),
        }
    }
}
