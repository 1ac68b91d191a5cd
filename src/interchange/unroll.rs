//! A tree of bodies and its loops → the description of a mechanism.
//!
//! Bodies that move one after the other without a branch become one chain; its table is placed on the joint axes by
//! [`SerialAxes`], at the reference values of the joints. At a branch a new chain stands on a link of the chain before.
//! Bodies with a ball or free joint become platforms, a ball joint a spherical closure. Bodies that do not move
//! against their parent are parts of it. A frame that is asked for becomes the tip of its chain, or, if that is taken,
//! a chain without rows.

use std::collections::{HashMap, HashSet};

use super::names::{Names, fit};
use super::problem::ImportProblemKind;
use super::remark::Remark;
use super::tree::{Attachment, Body, Coupling, Extent, Joint, Loop, Motion, Tree};
use crate::algebra::Expression;
use crate::description::{
    ChainDescription, ClosureDescription, ClosureKind, Convention, Description, Displacement,
    Entry, GROUND, JointDescription, Named, PlatformDescription, Role, Row, Spanned,
};
use crate::geometry::{Line, Pose};
use crate::mechanism::{JointAxis, SerialAxes, Table};

/// A description and what is worth knowing about it.
pub(super) struct Unrolled {
    pub description: Description,
    pub remarks: Vec<Remark>,
    /// What the frames that were asked for are called.
    pub references: Vec<(String, String)>,
}

/// The description of a tree, in which the frames of the given names can be found.
pub(super) fn describe(
    tree: &Tree,
    convention: Convention,
    asked: &[String],
    source: String,
) -> Result<Unrolled, ImportProblemKind> {
    within_reason(tree)?;
    let mut unroller = Unroller {
        tree,
        convention,
        carriers: carriers(tree),
        zero: tree.poses(|joint| joint.reference),
        leaders: leaders(tree)?,
        variables: HashMap::new(),
        names: Names::default(),
        needs: Vec::new(),
        places: HashMap::new(),
        chains: Vec::new(),
        references: Vec::new(),
        remarks: Vec::new(),
    };
    unroller.variables();
    unroller.needs(asked);
    let platforms = unroller.platforms();
    unroller.chains();
    let (platforms, closures) = unroller.closures(platforms);
    let moves = unroller
        .chains
        .iter()
        .any(|chain| !chain.value.rows.is_empty());
    if !moves && platforms.is_empty() {
        return Err(ImportProblemKind::NothingMoves);
    }
    let description = Description {
        name: spanned(match tree.name.trim() {
            "" => "mechanism".to_owned(),
            name => name.to_owned(),
        }),
        source: Some(spanned(source)),
        convention: Some(Spanned::new(convention, 0..0)),
        parameters: Vec::new(),
        joints: unroller.joints(),
        chains: unroller.chains,
        platforms,
        closures,
        closed_forms: Vec::new(),
    };
    Ok(Unrolled {
        description,
        remarks: unroller
            .remarks
            .into_iter()
            .chain(unroller.names.renamed())
            .collect(),
        references: unroller.references,
    })
}

/// The body that carries each body, and the pose of the body in it: the nearest one that moves.
fn carriers(tree: &Tree) -> Vec<(usize, Pose<f64>)> {
    let mut carriers: Vec<(usize, Pose<f64>)> = Vec::with_capacity(tree.bodies.len());
    for (i, body) in tree.bodies.iter().enumerate() {
        carriers.push(match body.parent {
            Some(parent) if body.joints.is_empty() => {
                (carriers[parent].0, carriers[parent].1 * body.pose)
            }
            _ => (i, Pose::identity()),
        });
    }
    carriers
}

/// What each joint that follows another one is: the first leader, factor and offset.
fn leaders(tree: &Tree) -> Result<HashMap<String, Coupling>, ImportProblemKind> {
    let mut direct: HashMap<&str, &Coupling> = HashMap::new();
    for coupling in &tree.couplings {
        if direct.insert(&coupling.joint, coupling).is_some() {
            let joint = coupling.joint.clone();
            return Err(ImportProblemKind::FollowsTwo { joint });
        }
    }
    let mut leaders = HashMap::new();
    for coupling in &tree.couplings {
        let mut total = coupling.clone();
        let mut steps = 0;
        while let Some(next) = direct.get(total.leader.as_str()) {
            total.offset += total.factor * next.offset;
            total.factor *= next.factor;
            total.leader = next.leader.clone();
            steps += 1;
            if steps > direct.len() {
                let joint = coupling.joint.clone();
                return Err(ImportProblemKind::FollowsItself { joint });
            }
        }
        leaders.insert(coupling.joint.clone(), total);
    }
    Ok(leaders)
}

/// Refuses what no mechanism can have: lengths beside which all others drown in rounding.
fn within_reason(tree: &Tree) -> Result<(), ImportProblemKind> {
    const MOST: f64 = 1e12;
    let fits = |x: &f64| x.abs() <= MOST;
    let pose = |pose: &Pose<f64>| {
        let axes = pose.rotation.0.iter().flat_map(|axis| &axis.0);
        pose.position.0.iter().chain(axes).all(fits)
    };
    let refuse = |of: &str| Err(ImportProblemKind::TooLarge { of: of.to_owned() });
    let zero = tree.poses(|joint| joint.reference);
    let home = tree.home();
    for (i, body) in tree.bodies.iter().enumerate() {
        if ![&body.pose, &zero[i], &home[i]].into_iter().all(pose) {
            return refuse(&body.name);
        }
        if let Some((name, _)) = body.frames.iter().find(|(_, frame)| !pose(frame)) {
            return refuse(name);
        }
        for joint in &body.joints {
            let point = joint.point.0.iter().chain(&joint.axis.0);
            let limits = joint.limits.map_or([0.0; 2], |(low, high)| [low, high]);
            let values = [joint.reference, joint.home];
            if !point.chain(&values).chain(&limits).all(fits) {
                return refuse(&joint.name);
            }
        }
    }
    for coupling in &tree.couplings {
        if ![coupling.factor, coupling.offset].iter().all(fits) {
            return refuse(&coupling.joint);
        }
    }
    for part in &tree.loops {
        let lengths = part.length.iter().flat_map(|length| {
            let factors = length.terms.iter().map(|(_, factor)| *factor);
            factors.chain([length.constant])
        });
        if !part.sides.iter().all(|side| pose(&side.pose)) || !lengths.into_iter().all(|x| fits(&x))
        {
            return refuse(&part.name);
        }
    }
    Ok(())
}

/// Where a body that moves by rows is: its chain and its last row; the pose of that link frame at the references.
#[derive(Clone)]
struct Placed {
    chain: usize,
    row: usize,
    frame: Pose<f64>,
}

struct Unroller<'a> {
    tree: &'a Tree,
    convention: Convention,
    carriers: Vec<(usize, Pose<f64>)>,
    /// Ground from every body at the references.
    zero: Vec<Pose<f64>>,
    leaders: HashMap<String, Coupling>,
    /// The variable of each joint that leads.
    variables: HashMap<String, String>,
    names: Names,
    /// Frames that must have a name: the name, the carrier, the pose in it.
    needs: Vec<(String, usize, Pose<f64>)>,
    places: HashMap<usize, Placed>,
    chains: Vec<Named<ChainDescription>>,
    references: Vec<(String, String)>,
    remarks: Vec<Remark>,
}

/// A platform and the body that it is.
type Floating = (usize, Named<PlatformDescription>);
type Platforms = Vec<Named<PlatformDescription>>;
type Closures = Vec<Named<ClosureDescription>>;

fn spanned<T>(value: T) -> Spanned<T> {
    Spanned::new(value, 0..0)
}

fn named<T>(name: String, value: T) -> Named<T> {
    Named {
        name: spanned(name),
        value,
    }
}

/// Whether nothing is lost when a pose is left out.
fn is_identity(pose: &Pose<f64>) -> bool {
    Displacement::of_pose(pose).is_empty()
}

fn floats(body: &Body) -> Option<&Joint> {
    let mut joints = body.joints.iter();
    joints.find(|joint| matches!(joint.motion, Motion::Ball | Motion::Free))
}

impl Unroller<'_> {
    fn variables(&mut self) {
        for joint in self.tree.bodies.iter().flat_map(|body| &body.joints) {
            let moves = matches!(joint.motion, Motion::Turn | Motion::Slide);
            if moves && !self.leaders.contains_key(&joint.name) {
                let variable = self.names.variable(&joint.name);
                self.variables.insert(joint.name.clone(), variable);
            }
        }
    }

    /// An attachment as a carrier and a pose in it.
    fn carried(&self, side: &Attachment) -> (usize, Pose<f64>) {
        let (carrier, pose) = &self.carriers[side.body];
        (*carrier, *pose * side.pose)
    }

    /// Names for the frames of loops and those asked for.
    fn needs(&mut self, asked: &[String]) {
        let mut found = Vec::new();
        for name in asked {
            for (i, body) in self.tree.bodies.iter().enumerate() {
                for (frame, pose) in body.frames.iter().filter(|(frame, _)| frame == name) {
                    let (carrier, own) = self.carriers[i];
                    found.push((frame.clone(), carrier, own * *pose));
                }
            }
        }
        for side in self.tree.loops.iter().flat_map(|l| &l.sides) {
            let (carrier, pose) = self.carried(side);
            found.push((side.frame.clone(), carrier, pose));
        }
        for (name, carrier, pose) in found {
            let known = self.needs.iter().any(|(other, ..)| *other == name);
            if !known {
                self.needs.push((name, carrier, pose));
            }
        }
    }

    fn platforms(&mut self) -> Vec<Floating> {
        let mut platforms = Vec::new();
        for (i, body) in self.tree.bodies.iter().enumerate() {
            if floats(body).is_some() {
                let home = body.home.unwrap_or(self.zero[i]);
                let platform = PlatformDescription {
                    home: Displacement::of_pose(&home),
                    frames: Vec::new(),
                };
                platforms.push((i, named(self.names.platform(&body.name), platform)));
            }
        }
        platforms
    }

    fn chains(&mut self) {
        let tree = self.tree;
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); tree.bodies.len()];
        for (i, body) in tree.bodies.iter().enumerate() {
            let turns = !body.joints.is_empty() && floats(body).is_none();
            if let (true, Some(parent)) = (turns, body.parent) {
                below[self.carriers[parent].0].push(i);
            }
        }
        let is_chain = |body: usize| body != 0 && floats(&tree.bodies[body]).is_none();
        for first in 0..tree.bodies.len() {
            let body = &tree.bodies[first];
            let Some(parent) = body.parent else { continue };
            let parent = self.carriers[parent].0;
            let goes_on = is_chain(parent) && below[parent].len() == 1;
            if body.joints.is_empty() || floats(body).is_some() || goes_on {
                continue;
            }
            let mut links = vec![first];
            while let [next] = below[links[links.len() - 1]][..] {
                links.push(next);
            }
            self.chain(parent, &links);
        }
    }

    /// A name for the end of a chain, and the pose of that frame in the last link.
    fn tip(&self, last: usize) -> (String, Pose<f64>) {
        if let Some((name, _, pose)) = self.needs.iter().find(|(_, carrier, _)| *carrier == last) {
            return (name.clone(), *pose);
        }
        // the last of the parts fixed to the link, where there is one that none hangs on
        let fixed = (last + 1..self.tree.bodies.len()).filter(|&i| self.carriers[i].0 == last);
        let fixed: Vec<usize> = fixed.collect();
        let hung: HashSet<Option<usize>> =
            self.tree.bodies.iter().map(|body| body.parent).collect();
        let end = fixed
            .into_iter()
            .find(|i| !hung.contains(&Some(*i)))
            .unwrap_or(last);
        (self.tree.bodies[end].name.clone(), self.carriers[end].1)
    }

    fn chain(&mut self, on: usize, links: &[usize]) {
        let tree = self.tree;
        let mut joints = Vec::new();
        for &link in links {
            let body = &tree.bodies[link];
            // a joint carries those after it; at the references all stand where the body does
            for joint in &body.joints {
                let line = Line::new(
                    self.zero[link] * joint.point,
                    self.zero[link].rotation * joint.axis,
                );
                let line = line.expect("readers refuse axes without direction");
                joints.push(match joint.motion {
                    Motion::Slide => JointAxis::prismatic(line, joint.reference),
                    _ => JointAxis::revolute(line, joint.reference),
                });
            }
        }
        let last = links[links.len() - 1];
        let (wanted, tip) = self.tip(last);
        let axes = SerialAxes {
            base: None,
            joints,
            tool: Some(self.zero[last] * tip),
        };
        let table = axes.assign(self.convention).table;
        let chain = self.chains.len();
        let frames = table.frames();
        let mut row = 0;
        for &link in links {
            row += tree.bodies[link].joints.len();
            let frame = frames[row];
            self.places.insert(link, Placed { chain, row, frame });
        }
        let (on, base) = self.standing(on, &table);
        let name = self.names.frame(&wanted);
        let rows = self.rows(links, &table);
        let chain = ChainDescription {
            on: (on != GROUND).then(|| spanned(on)),
            convention: None,
            base: Displacement::of_pose(&base),
            rows,
            tip: Displacement::of_pose(&table.tip),
        };
        self.chains.push(named(name, chain));
    }

    /// The frame that a chain stands on, and the pose of its first frame there.
    fn standing(&self, on: usize, table: &Table) -> (String, Pose<f64>) {
        match self.places.get(&on) {
            Some(Placed { chain, row, frame }) => {
                let name = format!("{}.{row}", self.chains[*chain].name.value);
                (name, frame.inverse() * table.base)
            }
            None if on == 0 => (GROUND.into(), table.base),
            None => {
                let name = self.names.of_platform(&self.tree.bodies[on].name);
                (name, self.zero[on].inverse() * table.base)
            }
        }
    }

    fn rows(&self, links: &[usize], table: &Table) -> Vec<Row> {
        let joints = links
            .iter()
            .flat_map(|&link| &self.tree.bodies[link].joints);
        let rows = joints.zip(&table.rows).map(|(joint, row)| Row {
            alpha: Entry::angle(row.alpha),
            a: Entry::length(row.a),
            d: self.affine(Entry::length, row.d, row.slide, joint),
            theta: self.affine(Entry::angle, row.theta, row.turn, joint),
            span: 0..0,
        });
        rows.collect()
    }

    /// constant + coefficient · joint, where a joint that follows is what it follows.
    fn affine(
        &self,
        entry: fn(f64) -> Entry,
        constant: f64,
        coefficient: f64,
        joint: &Joint,
    ) -> Entry {
        if coefficient == 0.0 {
            return entry(constant);
        }
        match self.leaders.get(&joint.name) {
            None => sum(
                entry(constant),
                &[(self.variables[&joint.name].clone(), coefficient)],
            ),
            Some(coupling) => {
                let constant = constant + coefficient * coupling.offset;
                let terms = self.variables.get(&coupling.leader);
                let terms = terms.map(|leader| (leader.clone(), coefficient * coupling.factor));
                sum(entry(constant), &terms.into_iter().collect::<Vec<_>>())
            }
        }
    }

    /// The name of a frame; a new one is made where it has none.
    fn frame(&mut self, side: &Attachment, platforms: &mut [Floating]) -> String {
        let (carrier, pose) = self.carried(side);
        self.frame_on(&side.frame, carrier, &pose, platforms)
    }

    fn frame_on(
        &mut self,
        wanted: &str,
        carrier: usize,
        pose: &Pose<f64>,
        platforms: &mut [Floating],
    ) -> String {
        if let Some((_, platform)) = platforms.iter_mut().find(|(body, _)| *body == carrier) {
            let owner = platform.name.value.clone();
            if is_identity(pose) {
                return owner;
            }
            let steps = Displacement::of_pose(pose);
            let frames = &mut platform.value.frames;
            // frames of the same name are the same frame
            let own = wanted.strip_prefix(&format!("{owner}.")).unwrap_or(wanted);
            let own = if own.trim().is_empty() { "frame" } else { own }.to_owned();
            if !frames.iter().any(|frame| frame.name.value == own) {
                frames.push(named(own.clone(), steps));
            }
            return format!("{owner}.{own}");
        }
        let (on, base) = match self.places.get(&carrier) {
            None => (GROUND.to_owned(), *pose),
            Some(Placed { chain, row, frame }) => {
                let part = &self.chains[*chain];
                let at = frame.inverse() * self.zero[carrier] * *pose;
                if self.names.of_frame(wanted) == Some(&part.name.value)
                    && *row == part.value.rows.len()
                {
                    return part.name.value.clone();
                }
                (format!("{}.{row}", part.name.value), at)
            }
        };
        if let Some(name) = self.names.of_frame(wanted) {
            return name.clone();
        }
        if is_identity(&base) && fit(wanted) != wanted {
            return on;
        }
        let name = self.names.frame(wanted);
        let chain = ChainDescription {
            on: (on != GROUND).then(|| spanned(on)),
            convention: None,
            base: Displacement::of_pose(&base),
            rows: Vec::new(),
            tip: Vec::new(),
        };
        self.chains.push(named(name.clone(), chain));
        name
    }

    /// The platforms with their frames, and the closures between all frames.
    fn closures(&mut self, platforms: Vec<Floating>) -> (Platforms, Closures) {
        let mut platforms = platforms;
        for (name, carrier, pose) in self.needs.clone() {
            let reference = self.frame_on(&name, carrier, &pose, &mut platforms);
            self.references.push((name, reference));
        }
        let mut closures: Closures = Vec::new();
        for closing in self.balls().iter().chain(&self.tree.loops) {
            let Loop {
                name, kind, sides, ..
            } = closing;
            let movers = [0, 1].map(|side| self.mover(sides[side].body));
            if movers[0] == movers[1] {
                let name = name.clone();
                self.remarks.push(Remark::WithinBody { name });
                continue;
            }
            let frames = [&sides[0], &sides[1]].map(|side| self.frame(side, &mut platforms));
            let closure = ClosureDescription {
                kind: *kind,
                frames: frames.map(spanned),
                length: closing.length.as_ref().map(|length| self.length(length)),
                span: 0..0,
            };
            let mut label = match name.trim() {
                "" => "closure".to_owned(),
                name => name.to_owned(),
            };
            while closures.iter().any(|other| other.name.value == label) {
                label += "_";
            }
            closures.push(named(label, closure));
        }
        let platforms = platforms.into_iter().map(|(_, platform)| platform);
        (platforms.collect(), closures)
    }

    /// Ball joints as loops: spherical closures between parents and platforms.
    fn balls(&self) -> Vec<Loop> {
        let bodies = self.tree.bodies.iter().enumerate();
        let balls = bodies.filter_map(|(i, body)| {
            let ball = floats(body).filter(|joint| joint.motion == Motion::Ball)?;
            let point = Pose::translation(ball.point);
            let sides = [(body.parent?, body.pose * point), (i, point)];
            let sides = [0, 1].map(|side| Attachment {
                body: sides[side].0,
                frame: format!("{}_{}", ball.name, side + 1),
                pose: sides[side].1,
            });
            Some(Loop {
                name: ball.name.clone(),
                kind: ClosureKind::Spherical,
                sides,
                length: None,
            })
        });
        balls.collect()
    }

    /// The body that a body moves with: the nearest one with a joint that has a variable.
    fn mover(&self, body: usize) -> usize {
        let moves = |joint: &Joint| match self.leaders.get(&joint.name) {
            None => true,
            Some(coupling) => {
                coupling.factor != 0.0 && self.variables.contains_key(&coupling.leader)
            }
        };
        let mut at = body;
        while let Some(parent) = self.tree.bodies[at].parent {
            if self.tree.bodies[at].joints.iter().any(moves) {
                break;
            }
            at = parent;
        }
        at
    }

    fn length(&self, extent: &Extent) -> Entry {
        let mut constant = extent.constant;
        let mut terms = Vec::new();
        for (joint, factor) in &extent.terms {
            match self.leaders.get(joint) {
                None => terms.push((self.variables[joint].clone(), *factor)),
                Some(coupling) => {
                    constant += factor * coupling.offset;
                    let leader = self.variables.get(&coupling.leader);
                    terms.extend(leader.map(|leader| (leader.clone(), factor * coupling.factor)));
                }
            }
        }
        terms.retain(|(_, factor)| *factor != 0.0);
        // a length has no sign
        let constant = if terms.is_empty() {
            constant.abs()
        } else {
            constant
        };
        sum(Entry::length(constant), &terms)
    }

    /// The joint variables: those of joints that lead, within the limits of all that follow.
    fn joints(&self) -> Vec<Named<JointDescription>> {
        let mut joints = Vec::new();
        let all = || self.tree.bodies.iter().flat_map(|body| &body.joints);
        for joint in all() {
            let Some(variable) = self.variables.get(&joint.name) else {
                continue;
            };
            let mut limits = joint.limits;
            let mut actuated = joint.actuated;
            let mut angle = joint.motion == Motion::Turn;
            for follower in all() {
                let Some(coupling) = self
                    .leaders
                    .get(&follower.name)
                    .filter(|c| c.leader == joint.name)
                else {
                    continue;
                };
                actuated |= follower.actuated;
                angle |= follower.motion == Motion::Turn;
                if let (Some((low, high)), true) = (follower.limits, coupling.factor != 0.0) {
                    let ends = [low, high].map(|end| (end - coupling.offset) / coupling.factor);
                    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                    let (least, most) = limits.unwrap_or((low, high));
                    limits = Some((least.max(low), most.min(high)))
                        .filter(|(low, high)| low <= high)
                        .or(limits);
                }
            }
            let entry = if angle { Entry::angle } else { Entry::length };
            let description = JointDescription {
                role: if actuated {
                    Role::Actuated
                } else {
                    Role::Passive
                },
                home: entry(joint.home),
                limits: limits.map(|(low, high)| (entry(low), entry(high))),
                span: 0..0,
            };
            joints.push(named(variable.clone(), description));
        }
        joints
    }
}

/// constant + Σ factor · name, as it would be written.
fn sum(constant: Entry, terms: &[(String, f64)]) -> Entry {
    let mut text = String::new();
    for (name, factor) in terms.iter().filter(|(_, factor)| *factor != 0.0) {
        let size = factor.abs();
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        text += sign;
        if size != 1.0 {
            text += &format!("{size}*");
        }
        text += name;
    }
    if text.is_empty() {
        return constant;
    }
    if !constant.expression.is_zero() {
        let constant = constant.expression.to_string();
        text += &match constant.strip_prefix('-') {
            Some(size) => format!(" - {size}"),
            None => format!(" + {constant}"),
        };
    }
    let expression = Expression::parse(&text).expect("sums of numbers and names are expressions");
    Entry {
        expression,
        span: 0..0,
    }
}
