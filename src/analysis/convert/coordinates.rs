//! Tables → joint coordinates, as they are written.
//!
//! The drawing shows the chains with all variables at zero, the two sides of each closure where the chains then have
//! them: nothing has to be assembled, so parameters and expressions stay. Where an axis is turned by other than right
//! angles, the displacements of the tables themselves are its place, so that nothing is rounded.
//!
//! The last link of a chain is called by the name of the chain, whose tip is its frame. Frames that only mark the end of
//! a closure, turned as the drawing and under the names that [`AxesDescription::tables`] gives them, are not written as
//! points.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use super::references::{frame_in, rename};
use super::{ConversionNote, ConvertError};
use crate::algebra::{Affine, Expression};
use crate::description::steps::{carried, doing_something, joined, zero};
use crate::description::{
    AxesDescription, Axis, AxisDescription, AxisKind, AxisPlace, ClosureKind, Convention,
    Description, Displacement, Entry, GROUND, Named, PointDescription, Row, Spanned, first_free,
    free_variable, place_of,
};
use crate::mechanism::{Body, Frame, Mechanism};

type Steps = Vec<Displacement>;

/// The joint coordinates of a mechanism, with what they say by other names.
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
    let (mut closed_forms, mut outputs) = (
        description.closed_forms.clone(),
        description.outputs.clone(),
    );
    rename(&mut closed_forms, &mut outputs, &renamed);
    let axes = AxesDescription {
        name: description.name.clone(),
        source: description.source.clone(),
        convention: description.convention.clone(),
        parameters: description.parameters.clone(),
        closed_forms,
        outputs,
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
    places: BTreeMap<Frame, Steps>,
    bodies: BTreeMap<Body, String>,
    /// What is drawn so far.
    axes: AxesDescription,
    /// The variables that have a joint of their name.
    own: BTreeSet<String>,
    /// The variables that stand in sums only: the first such row becomes two joints in series about the same axis.
    apart: BTreeSet<String>,
}

/// The joint of a row: where it is, counted with the constant parts of its entries.
fn axis_of(before: &[Displacement], row: &Row, convention: Convention, fixed: [Entry; 2]) -> Steps {
    let [d, theta] = fixed;
    let link = [
        Displacement::Rotate(Axis::X, row.alpha.clone()),
        Displacement::Translate(Axis::X, row.a.clone()),
    ];
    let joint = [
        Displacement::Rotate(Axis::Z, theta),
        Displacement::Translate(Axis::Z, d),
    ];
    let steps = before.iter().cloned();
    match convention {
        Convention::Modified => joined(steps.chain(doing_something(link)).chain(joint)),
        Convention::Standard => joined(steps.chain(joint)),
    }
}

/// Whether something is turned by other than right angles.
fn is_oblique(steps: &[Displacement]) -> bool {
    let oblique = |step: &Displacement| match step {
        Displacement::Rotate(_, angle) => match angle.expression.fixed_value() {
            Some(angle) => angle.sin().abs().min(angle.cos().abs()) > 1e-12,
            None => true,
        },
        _ => false,
    };
    steps.iter().any(oblique)
}

/// The rotations among displacements.
fn rotations(steps: &[Displacement]) -> impl Iterator<Item = &Displacement> {
    let is_rotation = |step: &&Displacement| matches!(step, Displacement::Rotate(..));
    steps.iter().filter(is_rotation)
}

fn point_of(steps: &[Displacement]) -> [Entry; 3] {
    carried(steps, [zero(), zero(), zero()], true)
}

fn axis_along(steps: &[Displacement], axis: Axis, sense: f64) -> [Entry; 3] {
    let mut along = [zero(), zero(), zero()];
    along[axis as usize] = Entry::number(sense, 0..0);
    carried(steps, along, false)
}

/// A frame by its origin where nothing is turned.
fn place_at(steps: &[Displacement]) -> AxisPlace {
    match rotations(steps).next() {
        Some(_) => AxisPlace::Frame(steps.to_vec()),
        None => AxisPlace::Centre(point_of(steps)),
    }
}

impl Drawing<'_> {
    fn entry(&self, entry: &Entry) -> Affine<String> {
        let is_joint = |name: &String| place_of(&self.description.joints, name).is_some();
        let affine = entry.expression.affine(is_joint);
        affine.unwrap_or_else(|_| entry.expression.clone().into())
    }

    fn constants(&self, row: &Row) -> [Entry; 2] {
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
                let link = [
                    Displacement::Translate(Axis::X, row.a.clone()),
                    Displacement::Rotate(Axis::X, row.alpha.clone()),
                ];
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
                    first_free(&wanted, "_", |name| !taken(name))
                }
            };
            self.bodies.insert(body, name);
        }
    }

    /// Whether a body is the last link of its chain, which then has the frame and the name of the tip.
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
        first_free(wanted, "_", |name| {
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

    fn closures(&mut self) {
        for (index, named) in self.description.closures.iter().enumerate() {
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
                match kind {
                    Spherical => AxisPlace::Centre(point_of(steps)),
                    // the axis that the other body has is any perpendicular one
                    Universal => {
                        let axes = [[Axis::Z, Axis::X], [Axis::X, Axis::Z]][side];
                        AxisPlace::Cross(point_of(steps), axes.map(along))
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

    /// Whether a closed form or a quantity names a frame.
    fn is_asked(&self, frame: &str) -> bool {
        let forms = self.description.closed_forms.iter();
        let mut frames = forms.flat_map(|form| form.value.of.iter().chain(&form.value.relative_to));
        let outputs = self.description.outputs.iter();
        let mut names = outputs.flat_map(|output| output.value.expression.names());
        frames.any(|name| name.value == frame)
            || names.any(|(name, _)| name[frame_in(name)] == *frame)
    }

    /// Whether a frame has the name that the end of a closure gets in tables.
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

    /// Whether the frame of a body stands where it does if nothing is said: at the joint that carries it.
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
    fn frames(&mut self) -> Vec<(String, String)> {
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
                    let name = first_free(&wanted, "_", free);
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

/// Σ factor·variable.
fn written(sum: &Affine<String>) -> Entry {
    let terms: Vec<Expression> = (sum.terms.iter())
        .map(|(name, factor)| factor.times(&Expression::name(name.clone())))
        .collect();
    Expression::sum(terms.iter().map(|term| (1.0, term))).into()
}
