//! Equality constraints of MJCF → loops and couplings.

use std::collections::HashMap;

use mjcf_rs::Model;
use roxmltree::Node;

use super::cranks::{SliderCrank, slider_cranks};
use super::hinges::hinges;
use super::part::{BodyParts, pose};
use crate::description::{ClosureKind, GivenNames};
use crate::geometry::{Pose, Quaternion, Vector3};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Attachment, Bend, Coupling, Extent, Tree, TreeJoint, TreeLoop};
use crate::interchange::xml_reader::{Problems, children, parse, tag};

/// Adds the constraints of a file to its tree.
pub(super) fn read(
    root: Node,
    model: &Model,
    tree: &mut Tree,
    parts: &[BodyParts],
    problems: &mut Problems,
    remarks: &mut Vec<Remark>,
) {
    let poses = tree.poses(|joint| joint.reference);
    let mut joints = HashMap::new();
    for joint in tree.joints() {
        joints.entry(joint.name.as_str()).or_insert(joint);
    }
    let mut reader = Constraints {
        root,
        model,
        tree,
        joints,
        parts,
        poses,
        problems,
    };
    let mut loops: Vec<TreeLoop> = Vec::new();
    let mut couplings = Vec::new();
    let blocks = children(root, "equality");
    let constraints = blocks
        .iter()
        .flat_map(|block| block.children().filter(Node::is_element));
    for (i, node) in constraints.enumerate() {
        let element = node.tag_name().name();
        let own = node.attribute("name").map(str::to_owned);
        let name = own.unwrap_or_else(|| format!("{element}{}", i + 1));
        if matches!(node.attribute("active"), Some("false")) {
            remarks.push(Remark::Inactive { name });
            continue;
        }
        match element {
            "connect" => loops.extend(reader.connect(node, name)),
            "weld" => loops.extend(reader.weld(node, name)),
            "joint" => couplings.extend(reader.joint(node)),
            "tendon" => match reader.tendon(node, name) {
                Some(Tendon::Rod(rod)) => loops.push(*rod),
                Some(Tendon::Coupling(coupling)) => couplings.push(coupling),
                None => {}
            },
            _ => {
                let help = "only rigid bodies are supported: remove it";
                let what = format!("the constraint `{element}`");
                reader.problems.unsupported::<()>(what, help, node);
            }
        }
    }
    let home = reader.tree.home();
    let (mut sliders, mut broken) = (Vec::new(), 0);
    for node in slider_cranks(root) {
        let Some(of) = reader.slider_crank(node, sliders.len()) else {
            continue;
        };
        match of.parts(&home) {
            Some((slider, rod)) => {
                sliders.push(slider);
                loops.push(rod);
            }
            None => broken += 1,
        }
    }
    if broken > 0 {
        let (element, count) = ("slider-crank whose rod is too short".into(), broken);
        remarks.push(Remark::Ignored { element, count });
    }
    let mut names = GivenNames::default();
    for part in &mut loops {
        part.name = names.give_longer(std::mem::take(&mut part.name));
    }
    tree.bodies.extend(sliders);
    tree.loops = hinges(loops);
    tree.couplings = couplings;
}

/// Constraint on a tendon: between two sites a rod, along joints a relation of their values.
enum Tendon {
    Rod(Box<TreeLoop>),
    Coupling(Coupling),
}

/// The part of a polynomial beyond its line, if there is one.
fn bend(terms: Vec<(String, f64)>, constant: f64, powers: [f64; 3]) -> Option<Bend> {
    let bends = powers.iter().any(|power| *power != 0.0);
    bends.then(|| Bend {
        terms,
        constant,
        powers: powers.to_vec(),
    })
}

struct Constraints<'a, 'r, 'i> {
    root: Node<'r, 'i>,
    model: &'a Model,
    tree: &'a Tree,
    joints: HashMap<&'a str, &'a TreeJoint>,
    parts: &'a [BodyParts],
    /// Ground from every body where the joints have their references.
    poses: Vec<Pose<f64>>,
    problems: &'a mut Problems,
}

impl<'r, 'i> Constraints<'_, 'r, 'i> {
    /// The body of the tree that a body of the model is, in an attribute; the world if there is no attribute.
    fn body(&mut self, node: Node, attribute: &str) -> Option<usize> {
        let Some(name) = node.attribute(attribute) else {
            return Some(0);
        };
        let found = match name {
            "world" => Some(0),
            name => self.model.body_id_by_name(name),
        };
        let bodies = self.model.bodies.iter();
        let known = bodies.filter_map(|entry| entry.body.name.as_deref());
        let found = (self.problems).known(found, (node, attribute), ("body", name), known)?;
        self.parts[found].last().copied()
    }

    fn site(&mut self, node: Node, attribute: &str, name: &str) -> Option<Attachment> {
        let bodies = self.model.bodies.iter().enumerate();
        let mut sites = bodies.flat_map(|(body, entry)| {
            let sites = entry.body.sites.iter();
            sites.filter_map(move |site| Some((body, site.name.as_deref()?, &site.pose)))
        });
        let known = sites.clone().map(|(_, known, _)| known);
        let found = sites.find(|(_, known, _)| *known == name);
        let found = (self.problems).known(found, (node, attribute), ("site", name), known);
        let (body, _, at) = found?;
        Some(Attachment {
            body: *self.parts[body].last()?,
            frame: name.to_owned(),
            pose: pose(at),
        })
    }

    fn sites(&mut self, node: Node) -> Option<Option<[Attachment; 2]>> {
        let (Some(a), Some(b)) = (node.attribute("site1"), node.attribute("site2")) else {
            return Some(None);
        };
        let (a, b) = (self.site(node, "site1", a), self.site(node, "site2", b));
        Some(Some([a?, b?]))
    }

    /// A point of two bodies: two sites, or one point of the first that is given, and the point of the second that
    /// lies there where the joints have their references.
    fn connect(&mut self, node: Node, name: String) -> Option<TreeLoop> {
        let sides = match self.sites(node)? {
            Some(sides) => sides,
            None => {
                self.problems.needed(node, "body1")?;
                self.problems.needed(node, "anchor")?;
                let anchor = Vector3(self.problems.numbers(node, "anchor")?);
                let (a, b) = (self.body(node, "body1"), self.body(node, "body2"));
                let (a, b) = (a?, b?);
                let point = self.poses[b].inverse() * self.poses[a] * anchor;
                let ends = [(a, anchor), (b, point)];
                TreeLoop::sides(&name, ends.map(|(body, p)| (body, Pose::translation(p))))
            }
        };
        Some(TreeLoop::new(name, ClosureKind::Spherical, sides))
    }

    /// Two frames: two sites, or two bodies with the second's pose in the first. One without torques holds a point of the
    /// second.
    fn weld(&mut self, node: Node, name: String) -> Option<TreeLoop> {
        let sides = match self.sites(node)? {
            Some(sides) => sides,
            None => {
                self.problems.needed(node, "body1")?;
                let (a, b) = (self.body(node, "body1"), self.body(node, "body2"));
                let (a, b) = (a?, b?);
                let given = self.problems.numbers::<7>(node, "relpose");
                let given = given.filter(|v| v[3..].iter().any(|x| x.abs() > 1e-12));
                let relative = match given {
                    Some([x, y, z, q0, q1, q2, q3]) => Pose {
                        rotation: Quaternion([q0, q1, q2, q3]).normalised().rotation(),
                        position: Vector3([x, y, z]),
                    },
                    None => self.poses[a].inverse() * self.poses[b],
                };
                TreeLoop::sides(&name, [(a, relative), (b, Pose::identity())])
            }
        };
        if self.problems.number(node, "torquescale") == Some(0.0) {
            let anchor = self.problems.numbers(node, "anchor").unwrap_or_default();
            let sides = sides.map(|side| Attachment {
                pose: side.pose * Pose::translation(Vector3(anchor)),
                ..side
            });
            return Some(TreeLoop::new(name, ClosureKind::Spherical, sides));
        }
        Some(TreeLoop::new(name, ClosureKind::Rigid, sides))
    }

    /// The coefficients c₀ to c₄ of a polynomial.
    fn polynomial(&mut self, node: Node) -> Option<[f64; 5]> {
        let text = node.attribute("polycoef").unwrap_or("0 1");
        let Some(numbers) = parse(text).filter(|numbers| numbers.len() <= 5) else {
            self.problems.not_numbers(text, 5, tag(node));
            return None;
        };
        let mut all = [0.0, 1.0, 0.0, 0.0, 0.0];
        all[..numbers.len()].copy_from_slice(&numbers);
        Some(all)
    }

    /// The reference of a joint that turns or slides.
    fn reference(&mut self, node: Node, attribute: &str, name: &str) -> Option<f64> {
        let found = self.joints.get(name).copied();
        let known = self.tree.joints().map(|joint| joint.name.as_str());
        let found = (self.problems).known(found, (node, attribute), ("joint", name), known)?;
        if found.motion.floats() {
            let what = format!("a constraint on `{name}`, which is neither a hinge nor a slide");
            return self.problems.unsupported(what, "leave it out", node);
        }
        Some(found.reference)
    }

    /// y − y₀ = c₀ + c₁ (x − x₀) + … + c₄ (x − x₀)⁴, with the references x₀ and y₀.
    fn joint(&mut self, node: Node) -> Option<Coupling> {
        let follower = self.problems.needed(node, "joint1")?.to_owned();
        let (found, y0) = (
            self.polynomial(node),
            self.reference(node, "joint1", &follower),
        );
        let ([c0, c1, powers @ ..], y0) = (found?, y0?);
        let Some(leader) = node.attribute("joint2") else {
            // alone it stands still
            return Some(Coupling::linear(vec![(follower, 1.0)], y0 + c0));
        };
        let x0 = self.reference(node, "joint2", leader)?;
        let terms = vec![(leader.to_owned(), 1.0)];
        Some(Coupling {
            bend: bend(terms, -x0, powers),
            ..Coupling::of(follower, leader.to_owned(), c1, y0 + c0 - c1 * x0)
        })
    }

    /// A tendon that has a constant length, or that of a fixed tendon: between two sites, or fixed itself.
    ///
    /// y − y₀ = c₀ + c₁ (x − x₀) for the lengths y and x, whose values where the joints have their references are y₀ and x₀.
    fn tendon(&mut self, node: Node, name: String) -> Option<Tendon> {
        let first = self.problems.needed(node, "tendon1")?;
        let [c0, c1, powers @ ..] = self.polynomial(node)?;
        let tendon = self.tendon_named(node, "tendon1", first)?;
        let mut length = Extent {
            constant: c0,
            terms: Vec::new(),
        };
        let mut bent = None;
        if let Some(second) = node.attribute("tendon2") {
            let fixed = self.tendon_named(node, "tendon2", second)?;
            if !fixed.has_tag_name("fixed") {
                let what =
                    format!("two spatial tendons `{first}` and `{second}` of related lengths");
                let help = "a length may depend on joints, through a fixed tendon";
                return self.problems.unsupported(what, help, node);
            }
            let second = self.fixed(fixed)?;
            let sum = second
                .iter()
                .map(|(joint, factor, _)| (joint.clone(), *factor));
            let at_references: f64 = second.iter().map(|(_, factor, x0)| factor * x0).sum();
            bent = bend(sum.collect(), -at_references, powers);
            length.constant -= c1 * at_references;
            for (joint, factor, _) in second {
                length.terms.push((joint, c1 * factor));
            }
        }
        if tendon.has_tag_name("fixed") {
            let (mut terms, mut constant) = (Vec::new(), length.constant);
            for (joint, factor, y0) in self.fixed(tendon)? {
                constant += factor * y0;
                terms.push((joint, factor));
            }
            terms.extend(
                length
                    .terms
                    .into_iter()
                    .map(|(joint, factor)| (joint, -factor)),
            );
            return Some(Tendon::Coupling(Coupling {
                terms,
                constant,
                bend: bent,
            }));
        }
        if bent.is_some() {
            let what = format!("a tendon `{first}` whose length is a polynomial of joints");
            let help = "the length of a spatial tendon may be a constant plus multiples of joints";
            return self.problems.unsupported(what, help, node);
        }
        let sites: Vec<Node> = tendon.children().filter(Node::is_element).collect();
        let names: Vec<&str> = sites.iter().filter_map(|s| s.attribute("site")).collect();
        let two = tendon.has_tag_name("spatial") && sites.len() == 2;
        let ([a, b], true) = (&names[..], two) else {
            let help = "a tendon of constant length must lead straight from one site to another";
            let what = format!("the constraint on tendon `{first}`");
            return self.problems.unsupported(what, help, node);
        };
        let (a, b) = (
            self.site(sites[0], "site", a),
            self.site(sites[1], "site", b),
        );
        let sides = [a?, b?];
        let [p, q] = [0, 1].map(|i| (self.poses[sides[i].body] * sides[i].pose).position);
        length.constant += (q - p).norm();
        Some(Tendon::Rod(Box::new(TreeLoop {
            length: Some(length),
            ..TreeLoop::new(name, ClosureKind::Distance, sides)
        })))
    }

    /// The slider-crank of an actuator.
    fn slider_crank(&mut self, node: Node, before: usize) -> Option<SliderCrank> {
        let ends = ["slidersite", "cranksite"].map(|end| {
            let site = self.problems.needed(node, end)?;
            self.site(node, end, site)
        });
        self.problems.needed(node, "cranklength")?;
        let [length] = self.problems.numbers(node, "cranklength")?;
        let [Some(line), Some(crank)] = ends else {
            return None;
        };
        let mut taken: GivenNames = self.joints.keys().map(|name| (*name).to_owned()).collect();
        let given = node.attribute("name").map(str::to_owned);
        let given = given.unwrap_or_else(|| format!("slider{}", before + 1));
        Some(SliderCrank {
            name: taken.give(&given),
            body: self.tree.bodies.len() + before,
            line,
            crank,
            length,
        })
    }

    /// The joints of a fixed tendon with their factors and references.
    fn fixed(&mut self, tendon: Node) -> Option<Vec<(String, f64, f64)>> {
        let terms = children(tendon, "joint").into_iter().map(|term| {
            let joint = self.problems.needed(term, "joint")?;
            let coefficient = term.attribute("coef").map_or(Some(vec![1.0]), parse);
            let x0 = self.reference(term, "joint", joint)?;
            Some((joint.to_owned(), *coefficient?.first()?, x0))
        });
        terms.collect()
    }

    fn tendon_named(&mut self, node: Node, attribute: &str, name: &str) -> Option<Node<'r, 'i>> {
        let blocks = children(self.root, "tendon").into_iter();
        let tendons = blocks.flat_map(|block| block.children().filter(Node::is_element));
        let tendons: Vec<(Node, &str)> = tendons
            .filter_map(|tendon| Some((tendon, tendon.attribute("name")?)))
            .collect();
        let found = tendons.iter().find(|(_, known)| *known == name);
        let known = tendons.iter().map(|(_, known)| *known);
        let found = (self.problems).known(found, (node, attribute), ("tendon", name), known);
        found.map(|(tendon, _)| *tendon)
    }
}
