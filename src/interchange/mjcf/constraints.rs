//! Equality constraints of MJCF → loops and couplings.

use mjcf_rs::Model;
use roxmltree::Node;

use super::hinges::hinges;
use super::part::{Parts, pose};
use crate::description::ClosureKind;
use crate::geometry::{Pose, Quaternion, Vector3};
use crate::interchange::page::{Problems, children, parse};
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Attachment, Coupling, Extent, Loop, Motion, Tree};

/// Adds the constraints of a file to its tree.
pub(super) fn read(
    root: Node,
    model: &Model,
    tree: &mut Tree,
    parts: &[Parts],
    problems: &mut Problems,
    remarks: &mut Vec<Remark>,
) {
    let poses = tree.poses(|joint| joint.reference);
    let mut reader = Constraints {
        root,
        model,
        tree,
        parts,
        poses,
        problems,
        loops: Vec::new(),
        couplings: Vec::new(),
    };
    let blocks = children(root, "equality");
    let constraints = blocks
        .iter()
        .flat_map(|block| block.children().filter(Node::is_element));
    for (i, node) in constraints.enumerate() {
        let element = node.tag_name().name();
        let name = node
            .attribute("name")
            .map_or_else(|| format!("{element}{}", i + 1), str::to_owned);
        if matches!(node.attribute("active"), Some("false")) {
            remarks.push(Remark::Inactive { name });
            continue;
        }
        match element {
            "connect" => reader.connect(node, name),
            "weld" => reader.weld(node, name),
            "joint" => reader.joint(node),
            "tendon" => reader.tendon(node, name),
            _ => {
                let problem = ImportProblemKind::Unsupported {
                    what: format!("the constraint `{element}`"),
                    help: "only rigid bodies are supported: remove it",
                };
                reader.problems.say(problem, node);
            }
        }
    }
    let (loops, couplings) = (reader.loops, reader.couplings);
    tree.loops = hinges(loops);
    tree.couplings = couplings;
}

struct Constraints<'a, 'r, 'i> {
    root: Node<'r, 'i>,
    model: &'a Model,
    tree: &'a Tree,
    parts: &'a [Parts],
    /// Ground from every body where the joints have their references.
    poses: Vec<Pose<f64>>,
    problems: &'a mut Problems,
    loops: Vec<Loop>,
    couplings: Vec<Coupling>,
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
        if found.is_none() {
            let known = self
                .model
                .bodies
                .iter()
                .filter_map(|entry| entry.body.name.clone());
            let known: Vec<String> = known.collect();
            self.problems.unknown(node, attribute, "body", name, &known);
        }
        found.and_then(|body| self.parts[body].last().copied())
    }

    /// The site of that name.
    fn site(&mut self, node: Node, attribute: &str, name: &str) -> Option<Attachment> {
        for (body, entry) in self.model.bodies.iter().enumerate() {
            let mut sites = entry.body.sites.iter();
            if let Some(site) = sites.find(|site| site.name.as_deref() == Some(name)) {
                return Some(Attachment {
                    body: *self.parts[body].last()?,
                    frame: name.to_owned(),
                    pose: pose(&site.pose),
                });
            }
        }
        let sites = self.model.bodies.iter().flat_map(|entry| &entry.body.sites);
        let known: Vec<String> = sites.filter_map(|site| site.name.clone()).collect();
        self.problems.unknown(node, attribute, "site", name, &known);
        None
    }

    /// The sites of a constraint, if it has them.
    fn sites(&mut self, node: Node) -> Option<Option<[Attachment; 2]>> {
        let (Some(a), Some(b)) = (node.attribute("site1"), node.attribute("site2")) else {
            return Some(None);
        };
        let (a, b) = (self.site(node, "site1", a), self.site(node, "site2", b));
        Some(Some([a?, b?]))
    }

    fn push(
        &mut self,
        name: String,
        kind: ClosureKind,
        sides: [Attachment; 2],
        length: Option<Extent>,
    ) {
        let mut unique = name;
        while self.loops.iter().any(|other| other.name == unique) {
            unique += "_";
        }
        self.loops.push(Loop {
            name: unique,
            kind,
            sides,
            length,
        });
    }

    /// A point of two bodies: two sites, or one point of the first that is given, and the point of the second that
    /// lies there where the joints have their references.
    fn connect(&mut self, node: Node, name: String) {
        let Some(sites) = self.sites(node) else {
            return;
        };
        if let Some(sides) = sites {
            return self.push(name, ClosureKind::Spherical, sides, None);
        }
        let Some(_) = self.problems.needed(node, "body1") else {
            return;
        };
        let Some(_) = self.problems.needed(node, "anchor") else {
            return;
        };
        let Some(anchor) = self.problems.numbers::<3>(node, "anchor") else {
            return;
        };
        let (Some(a), Some(b)) = (self.body(node, "body1"), self.body(node, "body2")) else {
            return;
        };
        let first = Pose::translation(Vector3(anchor));
        let point = self.poses[b].inverse() * self.poses[a] * Vector3(anchor);
        let sides = named(&name, [(a, first), (b, Pose::translation(point))]);
        self.push(name, ClosureKind::Spherical, sides, None);
    }

    /// Two frames: two sites, or two bodies with the second's pose in the first.
    fn weld(&mut self, node: Node, name: String) {
        let Some(sites) = self.sites(node) else {
            return;
        };
        if let Some(sides) = sites {
            return self.push(name, ClosureKind::Rigid, sides, None);
        }
        let Some(_) = self.problems.needed(node, "body1") else {
            return;
        };
        let (Some(a), Some(b)) = (self.body(node, "body1"), self.body(node, "body2")) else {
            return;
        };
        let given = self.problems.numbers::<7>(node, "relpose");
        let given = given.filter(|v| v[3..].iter().any(|x| x.abs() > 1e-12));
        let relative = match given {
            Some([x, y, z, q0, q1, q2, q3]) => Pose {
                rotation: Quaternion([q0, q1, q2, q3]).normalised().rotation(),
                position: Vector3([x, y, z]),
            },
            None => self.poses[a].inverse() * self.poses[b],
        };
        let sides = named(&name, [(a, relative), (b, Pose::identity())]);
        self.push(name, ClosureKind::Rigid, sides, None);
    }

    /// Coefficients c₀, c₁ of a polynomial without higher powers.
    fn line(&mut self, node: Node) -> Option<[f64; 2]> {
        let text = node.attribute("polycoef").unwrap_or("0 1");
        let numbers: Option<Vec<f64>> = text
            .split_whitespace()
            .map(|word| word.parse().ok())
            .collect();
        let numbers =
            numbers.filter(|numbers| numbers.len() <= 5 && numbers.iter().all(|x| x.is_finite()));
        let Some(numbers) = numbers else {
            self.problems
                .not_numbers(text, 5, super::super::page::tag(node));
            return None;
        };
        if numbers.iter().skip(2).any(|c| *c != 0.0) {
            let problem = ImportProblemKind::Unsupported {
                what: "a polynomial of a higher degree than 1".into(),
                help: "a joint can follow another by a factor and an offset only",
            };
            self.problems.say(problem, node);
            return None;
        }
        let coefficient = |i: usize, default: f64| numbers.get(i).copied().unwrap_or(default);
        Some([coefficient(0, 0.0), coefficient(1, 1.0)])
    }

    /// The reference of a joint that turns or slides.
    fn reference(&mut self, node: Node, attribute: &str, name: &str) -> Option<f64> {
        let mut joints = self.tree.bodies.iter().flat_map(|body| &body.joints);
        match joints.find(|joint| joint.name == name) {
            Some(joint) if matches!(joint.motion, Motion::Turn | Motion::Slide) => {
                Some(joint.reference)
            }
            Some(_) => {
                let problem = ImportProblemKind::Unsupported {
                    what: format!("a constraint on `{name}`, which is neither a hinge nor a slide"),
                    help: "remove it",
                };
                self.problems.say(problem, node);
                None
            }
            None => {
                let joints = self.tree.bodies.iter().flat_map(|body| &body.joints);
                let known: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
                self.problems
                    .unknown(node, attribute, "joint", name, &known);
                None
            }
        }
    }

    /// y − y₀ = c₀ + c₁ (x − x₀), with the references x₀ and y₀.
    fn joint(&mut self, node: Node) {
        let Some(follower) = self.problems.needed(node, "joint1").map(str::to_owned) else {
            return;
        };
        let (Some([c0, c1]), Some(y0)) =
            (self.line(node), self.reference(node, "joint1", &follower))
        else {
            return;
        };
        let coupling = match node.attribute("joint2") {
            None => Coupling {
                leader: follower.clone(),
                joint: follower,
                factor: 0.0,
                offset: y0 + c0,
            },
            Some(leader) => {
                let Some(x0) = self.reference(node, "joint2", leader) else {
                    return;
                };
                Coupling {
                    joint: follower,
                    leader: leader.to_owned(),
                    factor: c1,
                    offset: y0 + c0 - c1 * x0,
                }
            }
        };
        self.couplings.push(coupling);
    }

    /// A tendon between two sites that has a constant length, or that of a fixed tendon.
    fn tendon(&mut self, node: Node, name: String) {
        let Some(first) = self.problems.needed(node, "tendon1") else {
            return;
        };
        let Some([c0, c1]) = self.line(node) else {
            return;
        };
        let Some(spatial) = self.tendon_named(node, "tendon1", first) else {
            return;
        };
        let sites: Vec<Node> = spatial.children().filter(Node::is_element).collect();
        let two = spatial.has_tag_name("spatial") && sites.len() == 2;
        let names: Vec<&str> = sites
            .iter()
            .filter_map(|site| site.attribute("site"))
            .collect();
        let ([a, b], true) = (&names[..], two) else {
            let problem = ImportProblemKind::Unsupported {
                what: format!("the constraint on tendon `{first}`"),
                help: "a tendon of constant length must lead straight from one site to another",
            };
            return self.problems.say(problem, node);
        };
        let (Some(a), Some(b)) = (
            self.site(sites[0], "site", a),
            self.site(sites[1], "site", b),
        ) else {
            return;
        };
        let [p, q] = [&a, &b].map(|side| (self.poses[side.body] * side.pose).position);
        let mut length = Extent {
            constant: (q - p).norm() + c0,
            terms: Vec::new(),
        };
        if let Some(second) = node.attribute("tendon2") {
            let Some(fixed) = self.tendon_named(node, "tendon2", second) else {
                return;
            };
            if !fixed.has_tag_name("fixed") {
                let problem = ImportProblemKind::Unsupported {
                    what: format!(
                        "two spatial tendons `{first}` and `{second}` of related lengths"
                    ),
                    help: "a length may depend on joints, through a fixed tendon",
                };
                return self.problems.say(problem, node);
            }
            for term in children(fixed, "joint") {
                let Some(joint) = self.problems.needed(term, "joint") else {
                    return;
                };
                let coefficient = term
                    .attribute("coef")
                    .map_or(Some(1.0), |text| Some(parse::<1>(text)?[0]));
                let (Some(coefficient), Some(x0)) =
                    (coefficient, self.reference(term, "joint", joint))
                else {
                    return;
                };
                length.constant -= c1 * coefficient * x0;
                length.terms.push((joint.to_owned(), c1 * coefficient));
            }
        }
        self.push(name, ClosureKind::Distance, [a, b], Some(length));
    }

    fn tendon_named(&mut self, node: Node, attribute: &str, name: &str) -> Option<Node<'r, 'i>> {
        let blocks = children(self.root, "tendon");
        let tendons: Vec<Node> = blocks
            .iter()
            .flat_map(|block| block.children().filter(Node::is_element))
            .collect();
        let found = tendons
            .iter()
            .find(|tendon| tendon.attribute("name") == Some(name))
            .copied();
        if found.is_none() {
            let known = tendons.iter().filter_map(|tendon| tendon.attribute("name"));
            let known: Vec<String> = known.map(str::to_owned).collect();
            self.problems
                .unknown(node, attribute, "tendon", name, &known);
        }
        found
    }
}

fn named(name: &str, sides: [(usize, Pose<f64>); 2]) -> [Attachment; 2] {
    [0, 1].map(|side| Attachment {
        body: sides[side].0,
        frame: format!("{name}_{}", side + 1),
        pose: sides[side].1,
    })
}
