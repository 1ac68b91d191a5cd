//! Tables → joint coordinates, as they are written.
//!
//! The drawing shows the chains with all variables at zero, the two sides of each closure where the chains then have
//! them: nothing has to be assembled, so parameters and expressions stay. Where an axis is turned by other than right
//! angles, the displacements of the tables themselves are its place, so that nothing is rounded.
//!
//! The last link of a chain is called by the name of the chain, whose tip is its frame. Frames that only mark the end of
//! a closure, turned as the drawing and under the names that [`AxesDescription::tables`] gives them, are not written as
//! points.

mod closures;
mod frames;
mod places;

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use super::references::rename;
use super::{ConversionNote, ConvertError};
use crate::algebra::{Affine, Expression};
use crate::description::steps::{joined, link, zero};
use crate::description::{
    AxesDescription, Axis, AxisDescription, AxisKind, AxisPlace, Convention, Description,
    Displacement, Entry, GROUND, Named, RowDescription, Spanned, first_free, free_variable,
    place_of,
};
use crate::mechanism::{Body, Frame, Mechanism};

use places::{axis_along, is_oblique, place_at, point_of, rotations};

type Displacements = Vec<Displacement>;

/// The joint coordinates of a mechanism, with notes on renamed frames.
///
/// # Errors
/// If a variable moves no joint by itself.
pub fn to_axes(
    mechanism: &Mechanism,
    description: &Description,
) -> Result<(AxesDescription, Vec<ConversionNote>), ConvertError> {
    if let Some(coordinates) = &description.coordinates {
        return Ok((coordinates.axes.clone(), Vec::new()));
    }
    let mut drawing = Drawing {
        mechanism,
        description,
        places: BTreeMap::new(),
        bodies: BTreeMap::new(),
        axes: AxesDescription::default(),
        own: BTreeSet::new(),
        apart: BTreeSet::new(),
    };
    drawing.place();
    drawing.name_bodies();
    drawing.draw();
    drawing.apart = drawing.lost().collect();
    if !drawing.apart.is_empty() {
        drawing.draw();
    }
    if let Some(joint) = drawing.lost().next() {
        return Err(ConvertError::NotAlone(joint));
    }
    let renamed = drawing.frames();
    let (mut closed_forms, mut outputs, mut loads) = (
        description.closed_forms.clone(),
        description.outputs.clone(),
        description.loads.clone(),
    );
    rename(&mut closed_forms, &mut outputs, &mut loads, &renamed);
    let axes = AxesDescription {
        name: description.name.clone(),
        source: description.source.clone(),
        convention: description.convention.clone(),
        parameters: description.parameters.clone(),
        tolerance: description.tolerance.clone(),
        closed_forms,
        outputs,
        loads,
        ..drawing.axes
    };
    let tables = axes.tables().map_err(ConvertError::Wrong)?;
    Mechanism::new(&tables).map_err(ConvertError::Wrong)?;
    let renamed = renamed.into_iter().filter(|(from, to)| from != to);
    let notes = renamed.map(|(from, to)| ConversionNote::Renamed { from, to });
    Ok((axes, notes.collect()))
}

struct Drawing<'a> {
    mechanism: &'a Mechanism,
    description: &'a Description,
    /// Ground from each frame in the drawing, and from the axis before each row.
    places: BTreeMap<Frame, Displacements>,
    bodies: BTreeMap<Body, String>,
    /// The drawing so far.
    axes: AxesDescription,
    /// The variables that have a joint of their name.
    own: BTreeSet<String>,
    /// The variables that stand in sums only: the first such row becomes two joints in series about the same axis.
    apart: BTreeSet<String>,
}

/// The joint of a row: where it is, counted with the constant parts of its entries.
fn axis_of(
    before: &[Displacement],
    row: &RowDescription,
    convention: Convention,
    fixed: [Entry; 2],
) -> Displacements {
    let [d, theta] = fixed;
    let link = link([&row.a, &row.alpha, &row.beta]);
    let joint = [
        Displacement::Rotate(Axis::Z, theta),
        Displacement::Translate(Axis::Z, d),
    ];
    let steps = before.iter().cloned();
    match convention {
        Convention::Modified => joined(steps.chain(link).chain(joint)),
        Convention::Standard => joined(steps.chain(joint)),
    }
}

impl Drawing<'_> {
    fn entry(&self, entry: &Entry) -> Affine<String> {
        let is_joint = |name: &String| place_of(&self.description.joints, name).is_some();
        let affine = entry.expression.affine(is_joint);
        affine.unwrap_or_else(|_| entry.expression.clone().into())
    }

    fn constants(&self, row: &RowDescription) -> [Entry; 2] {
        [&row.d, &row.theta].map(|entry| self.entry(entry).constant.into())
    }

    /// Places every frame; chains after those that carry them.
    fn place(&mut self) {
        self.places.insert(Frame::Ground, Vec::new());
        for (platform, part) in self.description.platforms.iter().enumerate() {
            let home = part.value.home.clone();
            for (frame, named) in part.value.frames.iter().enumerate() {
                let steps = joined(home.iter().chain(&named.value).cloned());
                self.places
                    .insert(Frame::OnPlatform { platform, frame }, steps);
            }
            self.places
                .insert(Frame::Platform { platform }, joined(home));
        }
        let chains = self.description.chains.len();
        let mut waiting: Vec<usize> = (0..chains).collect();
        while !waiting.is_empty() {
            let on = |chain: usize| self.mechanism.chains()[chain].on;
            let ready = (waiting.iter()).position(|&c| self.places.contains_key(&on(c)));
            // a valid mechanism has no chain that stands on itself
            let Some(next) = ready else { return };
            self.place_chain(waiting.remove(next));
        }
    }

    fn place_chain(&mut self, chain: usize) {
        let part = &self.description.chains[chain].value;
        let built = &self.mechanism.chains()[chain];
        let start = self.places[&built.on].iter().chain(&part.base).cloned();
        let mut at = joined(start);
        self.places
            .insert(Frame::Link { chain, row: 0 }, at.clone());
        for (k, row) in part.rows.iter().enumerate() {
            at = axis_of(&at, row, built.convention, self.constants(row));
            if built.convention == Convention::Standard {
                let link = link([&row.a, &row.alpha, &row.beta]);
                at = joined(at.into_iter().chain(link));
            }
            self.places
                .insert(Frame::Link { chain, row: k + 1 }, at.clone());
        }
        let tip = joined(at.into_iter().chain(part.tip.iter().cloned()));
        self.places.insert(Frame::Tip { chain }, tip);
    }

    fn name_bodies(&mut self) {
        for body in self.mechanism.bodies() {
            let name = match body {
                Body::Ground => GROUND.to_owned(),
                Body::Platform(platform) => self.mechanism.platforms()[platform].name.clone(),
                Body::Link { chain, .. } if self.carries_tip(body) => {
                    self.mechanism.chains()[chain].name.clone()
                }
                Body::Link { chain, row } => {
                    let wanted = format!("{}_{row}", self.mechanism.chains()[chain].name);
                    let taken = |name: &str| {
                        !self.description.is_free_body(name)
                            || self.bodies.values().any(|other| other == name)
                    };
                    first_free(&wanted, |name| !taken(name))
                }
            };
            self.bodies.insert(body, name);
        }
    }

    /// True if a body is the last link of its chain, which then has the frame and the name of the tip.
    fn carries_tip(&self, body: Body) -> bool {
        let Body::Link { chain, .. } = body else {
            return false;
        };
        self.mechanism.body(Frame::Tip { chain }) == body
    }

    fn body(&self, frame: Frame) -> String {
        self.bodies[&self.mechanism.body(frame)].clone()
    }

    /// A name for a joint that no variable and no other joint has.
    fn free(&self, wanted: &str) -> String {
        free_variable(wanted, |name| {
            place_of(&self.description.joints, name).is_none()
                && place_of(&self.description.parameters, name).is_none()
                && place_of(&self.axes.joints, name).is_none()
        })
    }

    /// The variables that move no joint by themselves.
    fn lost(&self) -> impl Iterator<Item = String> + '_ {
        let all = self
            .description
            .joints
            .iter()
            .map(|joint| &joint.name.value);
        all.filter(|name| !self.own.contains(*name)).cloned()
    }

    /// A name for a body that the tables do not have.
    fn between_links(&self, wanted: &str) -> String {
        let connects = |joint: &Named<AxisDescription>, name: &str| {
            let mut ends = joint.value.between.iter().flatten();
            ends.any(|end| end.value == name)
        };
        first_free(wanted, |name| {
            self.description.is_free_body(name)
                && !self.axes.joints.iter().any(|j| connects(j, name))
        })
    }

    /// Draws all joints.
    fn draw(&mut self) {
        self.axes = AxesDescription::default();
        self.own.clear();
        self.rows();
        self.closures();
        self.floating();
    }

    fn rows(&mut self) {
        for (chain, named) in self.description.chains.iter().enumerate() {
            let convention = self.mechanism.chains()[chain].convention;
            for (k, row) in named.value.rows.iter().enumerate() {
                let link = |row: usize| Frame::Link { chain, row };
                let before = &self.places[&link(k)];
                let at = axis_of(before, row, convention, self.constants(row));
                let [from, to] = [k, k + 1].map(|row| self.body(link(row)));
                let (slide, turn) = (self.entry(&row.d), self.entry(&row.theta));
                let wanted = format!("{}_{}", named.name.value, k + 1);
                match (turn.terms.is_empty(), slide.terms.is_empty()) {
                    (true, true) => {}
                    (false, true) => {
                        self.joint(AxisKind::Revolute, &turn, &at, [from, to], &wanted)
                    }
                    (true, false) => {
                        self.joint(AxisKind::Prismatic, &slide, &at, [from, to], &wanted);
                    }
                    (false, false) => {
                        let screw = match (&turn.terms[..], &slide.terms[..]) {
                            ([(one, factor)], [(two, travel)]) if one == two => {
                                (factor.as_number() == Some(1.0)).then(|| travel.clone())
                            }
                            _ => None,
                        };
                        if let Some(travel) = screw {
                            let turns = Expression::parse("2*pi").unwrap_or(travel.clone());
                            self.joint(AxisKind::Helical, &turn, &at, [from, to], &wanted);
                            if let Some(joint) = self.axes.joints.last_mut() {
                                joint.value.pitch = Some(turns.times(&travel).into());
                            }
                            continue;
                        }
                        let middle = self.between_links(&format!("{to}_turned"));
                        let ends = [from, middle.clone()];
                        self.joint(AxisKind::Revolute, &turn, &at, ends, &wanted);
                        let wanted = format!("{wanted}_slide");
                        self.joint(AxisKind::Prismatic, &slide, &at, [middle, to], &wanted);
                    }
                }
            }
        }
    }

    /// A joint that a sum of variables moves: one of its own, or one that follows.
    fn joint(
        &mut self,
        kind: AxisKind,
        sum: &Affine<String>,
        at: &[Displacement],
        between: [String; 2],
        wanted: &str,
    ) {
        if let Some((alone, rest)) = self.split(sum) {
            let [from, to] = between;
            let middle = self.between_links(&format!("{to}_part"));
            self.joint(kind, &alone, at, [from, middle.clone()], wanted);
            self.joint(kind, &rest, at, [middle, to], wanted);
            return;
        }
        let own = match &sum.terms[..] {
            [(name, factor)] if !self.own.contains(name) => {
                let sense = factor.as_number().filter(|factor| factor.abs() == 1.0);
                sense.map(|sense| (name.clone(), sense))
            }
            _ => None,
        };
        let sense = own.as_ref().map_or(1.0, |(_, sense)| *sense);
        let place = match is_oblique(at) {
            true => {
                let turned = Displacement::Rotate(Axis::X, Entry::angle(PI));
                let over = (sense < 0.0).then_some(turned);
                AxisPlace::Frame(joined(at.iter().cloned().chain(over)))
            }
            false => AxisPlace::Along(Some(point_of(at)), axis_along(at, Axis::Z, sense)),
        };
        let mut joint = AxisDescription::new(kind, place);
        joint.between = Some(between.map(Spanned::nowhere));
        let name = match own {
            Some((name, _)) => {
                joint.home = self.declared(&name, &mut joint);
                joint.home.take_if(|home| home.expression.is_zero());
                joint.drawn = joint.home.is_some().then(zero);
                name
            }
            None => {
                joint.value = Some(written(sum));
                self.free(wanted)
            }
        };
        self.axes.joints.push(Named::new(name, joint));
    }

    /// Gives a joint the role and the limits of the variable whose own it is; returns the home value.
    fn declared(&mut self, name: &str, joint: &mut AxisDescription) -> Option<Entry> {
        self.own.insert(name.to_owned());
        let declared = place_of(&self.description.joints, name)?;
        let declared = &self.description.joints[declared].value;
        joint.role = Some(declared.role);
        joint.limits = declared.limits.clone();
        Some(declared.home.clone())
    }

    /// A sum as a variable that stands nowhere alone, and the rest.
    fn split(&self, sum: &Affine<String>) -> Option<(Affine<String>, Affine<String>)> {
        let waits = |name: &String| self.apart.contains(name) && !self.own.contains(name);
        let is_one = |factor: &Expression| factor.as_number().is_some_and(|f| f.abs() == 1.0);
        let found = |(name, factor): &(String, Expression)| waits(name) && is_one(factor);
        let index = sum.terms.iter().position(found)?;
        let (mut alone, mut rest) = (sum.clone(), sum.clone());
        alone.terms = vec![rest.terms.remove(index)];
        (!rest.terms.is_empty()).then_some((alone, rest))
    }
}

/// Σ factor·variable.
fn written(sum: &Affine<String>) -> Entry {
    let terms: Vec<Expression> = (sum.terms.iter())
        .map(|(name, factor)| factor.times(&Expression::name(name.clone())))
        .collect();
    Expression::sum(terms.iter().map(|term| (1.0, term))).into()
}
