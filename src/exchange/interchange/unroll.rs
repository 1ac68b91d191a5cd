//! A tree of bodies and its loops → the description of a mechanism.
//!
//! Bodies that move one after the other without a branch become one chain; its table is placed on the joint axes by
//! [`SerialAxes`], at the reference values of the joints. At a branch a new chain is attached to a link of the previous chain.
//! Bodies with a ball or free joint become platforms, a ball joint a spherical closure. Bodies that do not move
//! against their parent are parts of it. A requested frame becomes the tip of its chain, or, if the chain has one already, a
//! chain without rows.

mod closures;
mod joints;
mod loads;
mod relations;

use std::collections::{HashMap, HashSet};

pub(super) use relations::carriers;
use relations::{FollowingJoint, followers, within_reason};

use super::names::ImportedNames;
use super::problem::ImportProblemKind;
use super::remark::Remark;
use super::tree::{Attachment, BodyMotion, Tree};
use crate::algebra::Expression;
use crate::description::{
    ChainDescription, ClosureDescription, Convention, Description, Displacement, Entry, GROUND,
    Named, PlatformDescription, RowDescription, Spanned,
};
use crate::geometry::{Line, Pose};
use crate::mechanism::{DhTable, JointAxis, SerialAxes};

/// A description with remarks.
pub(super) struct Unrolled {
    pub description: Description,
    pub remarks: Vec<Remark>,
    /// The names of the requested frames.
    pub references: Vec<(String, String)>,
    /// The home values of the file that were outside the limits.
    pub outside: Vec<(String, f64)>,
}

/// The description of a tree, in which the frames of the given names can be found.
pub(super) fn describe(
    tree: &Tree,
    convention: Convention,
    kept: &[String],
    source: String,
) -> Result<Unrolled, ImportProblemKind> {
    within_reason(tree)?;
    let mut unroller = Unroller {
        tree,
        convention,
        carriers: carriers(tree),
        zero: tree.poses(|joint| joint.reference),
        followers: followers(tree)?,
        variables: HashMap::new(),
        names: ImportedNames::default(),
        needs: Vec::new(),
        tips: HashMap::new(),
        places: HashMap::new(),
        chains: Vec::new(),
        references: Vec::new(),
        remarks: Vec::new(),
        outside: Vec::new(),
    };
    unroller.variables();
    let outputs = unroller.outputs();
    unroller.needs(kept);
    unroller.tips();
    let platforms = unroller.platforms();
    unroller.chains();
    let (platforms, closures) = unroller.closures(platforms);
    let moves = |chain: &Named<ChainDescription>| !chain.value.rows.is_empty();
    if !unroller.chains.iter().any(moves) && platforms.is_empty() {
        return Err(ImportProblemKind::NothingMoves);
    }
    let joints = unroller.joints();
    let loads = unroller.loads();
    let description = Description {
        name: Spanned::nowhere(match tree.name.trim() {
            "" => "mechanism".to_owned(),
            name => name.to_owned(),
        }),
        source: Some(Spanned::nowhere(source)),
        convention: Some(Spanned::nowhere(convention)),
        joints,
        chains: unroller.chains,
        platforms,
        closures,
        outputs,
        loads,
        ..Description::default()
    };
    let mut remarks = unroller.remarks;
    remarks.extend(unroller.names.renamed);
    Ok(Unrolled {
        description,
        remarks,
        references: unroller.references,
        outside: unroller.outside,
    })
}

/// Position of a body that moves by rows: its chain and its last row; the pose of that link frame at the references.
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
    followers: HashMap<String, FollowingJoint>,
    /// The variable of each joint that leads.
    variables: HashMap<String, String>,
    names: ImportedNames,
    /// Frames that must have a name: the name, the carrier, the pose in it.
    needs: Vec<(String, usize, Pose<f64>)>,
    /// The frame at the end of the chain that ends with a body: its name and its pose in the body.
    tips: HashMap<usize, (String, Pose<f64>)>,
    places: HashMap<usize, Placed>,
    chains: Vec<Named<ChainDescription>>,
    references: Vec<(String, String)>,
    remarks: Vec<Remark>,
    outside: Vec<(String, f64)>,
}

/// A platform and the body that it is.
type Floating = (usize, Named<PlatformDescription>);
type Platforms = Vec<Named<PlatformDescription>>;
type Closures = Vec<Named<ClosureDescription>>;

/// constant + Σ factor · name.
fn sum(constant: &Entry, terms: &[(String, f64)]) -> Entry {
    let names = terms
        .iter()
        .map(|(name, factor)| (*factor, Expression::name(name.clone())));
    let names: Vec<(f64, Expression)> = names.collect();
    let terms = names.iter().map(|(factor, name)| (*factor, name));
    Expression::sum(terms.chain([(1.0, &constant.expression)])).into()
}

/// True if a pose can be left out because it is the identity.
fn is_identity(pose: &Pose<f64>) -> bool {
    Displacement::of_pose(pose).is_empty()
}

impl Unroller<'_> {
    fn variables(&mut self) {
        for joint in self.tree.joints() {
            if !joint.motion.floats() && !self.followers.contains_key(&joint.name) {
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

    /// Names for the frames of loops and the requested frames.
    fn needs(&mut self, kept: &[String]) {
        let mut named: HashMap<&str, Vec<(usize, Pose<f64>)>> = HashMap::new();
        for (body, &(carrier, own)) in self.tree.bodies.iter().zip(&self.carriers) {
            for (frame, pose) in &body.frames {
                let places = named.entry(frame).or_default();
                places.push((carrier, own * *pose));
            }
        }
        let mut found = Vec::new();
        for name in kept {
            let places = named.get(name.as_str()).into_iter().flatten();
            found.extend(places.map(|&(carrier, pose)| (name.clone(), carrier, pose)));
        }
        for side in self.tree.loops.iter().flat_map(|l| &l.sides) {
            let (carrier, pose) = self.carried(side);
            found.push((side.frame.clone(), carrier, pose));
        }
        let mut seen = HashSet::new();
        found.retain(|(name, ..)| seen.insert(name.clone()));
        self.needs = found;
    }

    /// The frames at the ends of chains: the first that must have a name, or a part fixed to the last link that has no
    /// children.
    fn tips(&mut self) {
        for (name, carrier, pose) in &self.needs {
            let tip = || (name.clone(), *pose);
            self.tips.entry(*carrier).or_insert_with(tip);
        }
        let children = self.tree.children();
        for (i, &(carrier, pose)) in self.carriers.iter().enumerate() {
            if i != carrier && children[i].is_empty() {
                let tip = || (self.tree.bodies[i].name.clone(), pose);
                self.tips.entry(carrier).or_insert_with(tip);
            }
        }
    }

    fn platforms(&mut self) -> Vec<Floating> {
        let mut platforms = Vec::new();
        for (i, body) in self.tree.bodies.iter().enumerate() {
            if body.floats() {
                let home = body.home.unwrap_or(self.zero[i]);
                let platform = PlatformDescription {
                    home: Displacement::of_pose(&home),
                    frames: Vec::new(),
                };
                let name = self.names.platform(i, &body.name);
                platforms.push((i, Named::new(name, platform)));
            }
        }
        platforms
    }

    fn chains(&mut self) {
        let tree = self.tree;
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); tree.bodies.len()];
        for (i, body) in tree.bodies.iter().enumerate() {
            let turns = !body.joints.is_empty() && !body.floats();
            if let (true, Some(parent)) = (turns, body.parent) {
                below[self.carriers[parent].0].push(i);
            }
        }
        let is_chain = |body: usize| body != 0 && !tree.bodies[body].floats();
        for first in 0..tree.bodies.len() {
            let body = &tree.bodies[first];
            let Some(parent) = body.parent else { continue };
            let parent = self.carriers[parent].0;
            let goes_on = is_chain(parent) && below[parent].len() == 1;
            if body.joints.is_empty() || body.floats() || goes_on {
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
        let own = || (self.tree.bodies[last].name.clone(), Pose::identity());
        self.tips.get(&last).cloned().unwrap_or_else(own)
    }

    fn chain(&mut self, on: usize, links: &[usize]) {
        let tree = self.tree;
        // a prismatic axis has no position: the first one is placed at its body
        let first = &tree.bodies[links[0]].joints[0];
        let seen_from = match first.motion {
            BodyMotion::Slide => self.zero[links[0]],
            _ => Pose::identity(),
        };
        let zero = |link: usize| seen_from.inverse() * self.zero[link];
        let mut joints = Vec::new();
        for &link in links {
            let body = &tree.bodies[link];
            // a joint carries those after it; at the references all coincide with the body
            for joint in &body.joints {
                let pose = zero(link);
                let line = Line::new(pose * joint.point, pose.rotation * joint.axis);
                let line = line.expect("readers refuse axes without direction");
                joints.push(match joint.motion {
                    BodyMotion::Slide => JointAxis::prismatic(line, joint.reference),
                    _ => JointAxis::revolute(line, joint.reference),
                });
            }
        }
        let last = links[links.len() - 1];
        let (wanted, tip) = self.tip(last);
        let axes = SerialAxes {
            base: None,
            joints,
            tool: Some(zero(last) * tip),
        };
        let table = axes.assign(self.convention).table;
        let chain = self.chains.len();
        let frames = table.frames();
        let mut row = 0;
        for &link in links {
            row += tree.bodies[link].joints.len();
            let frame = seen_from * frames[row];
            self.places.insert(link, Placed { chain, row, frame });
        }
        let (on, base) = self.standing(on, seen_from * table.base);
        let name = self.names.frame(&wanted, last, &tip);
        let rows = self.rows(links, &table);
        let chain = ChainDescription {
            rows,
            tip: Displacement::of_pose(&table.tip),
            ..ChainDescription::frame(&on, Displacement::of_pose(&base))
        };
        self.chains.push(Named::new(name, chain));
    }

    /// The frame to which a chain is attached, and the pose of its first frame there.
    fn standing(&self, on: usize, base: Pose<f64>) -> (String, Pose<f64>) {
        match self.places.get(&on) {
            Some(Placed { chain, row, frame }) => {
                let name = format!("{}.{row}", self.chains[*chain].name.value);
                (name, frame.inverse() * base)
            }
            None if on == 0 => (GROUND.into(), base),
            None => {
                let name = &self.names.platforms[&on];
                (name.clone(), self.zero[on].inverse() * base)
            }
        }
    }

    fn rows(&self, links: &[usize], table: &DhTable) -> Vec<RowDescription> {
        let joints = links
            .iter()
            .flat_map(|&link| &self.tree.bodies[link].joints);
        let rows = joints.zip(&table.rows).map(|(joint, row)| {
            let entry = |kind: fn(f64) -> Entry, constant: f64, coefficient: f64| {
                let (constant, terms) = self.affine(constant, [(&joint.name, coefficient)]);
                sum(&kind(constant), &terms)
            };
            let (alpha, a) = (Entry::angle(row.alpha), Entry::length(row.a));
            let d = entry(Entry::length, row.d, row.slide);
            RowDescription {
                beta: Entry::angle(row.beta),
                ..RowDescription::new(alpha, a, d, entry(Entry::angle, row.theta, row.turn))
            }
        });
        rows.collect()
    }
}
