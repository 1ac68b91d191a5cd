//! Tree → MJCF: loops as equality constraints, home as a keyframe.
//!
//! With A and B the frames of a closure, and ℓ a length, the closures are written as:
//!
//! | closure | in MJCF |
//! |---|---|
//! | Spherical | `connect` of the origins |
//! | Revolute | `connect` of the origins and of the points at ℓ on the z axes |
//! | Universal | `connect` of the origins, and a `tendon` of length √2 ℓ between the points at ℓ on the z axes |
//! | Rigid | `weld` |
//! | Prismatic, Cylindrical, Planar | a body on A that slides and turns as the joint allows, and a `weld` of it to B |
//! | Distance | a `tendon` of that length; a joint in the length is a second, fixed tendon |

use super::joint::{joint_attributes, joint_tag};
use super::sliders::with_sliders;
use crate::description::ClosureKind;
use crate::geometry::{Quaternion, Vector3};
use crate::interchange::remark::Remark;
use crate::interchange::tree::{Attachment, Body, Extent, Joint, Loop, Motion, Tree};
use crate::interchange::xml::{Xml, numbers, place, vector};

/// The text of an MJCF file, with remarks on what it expresses differently from the mechanism.
pub fn write(tree: &Tree, known: &[Remark]) -> (String, Vec<Remark>) {
    let (tree, mut remarks) = with_sliders(tree);
    let mut page = Page {
        size: tree.size,
        xml: Xml::new(),
        marks: vec![Vec::new(); tree.bodies.len()],
        tendons: Vec::new(),
        equalities: Vec::new(),
        tree: &tree,
    };
    remarks.extend(tree.loops.iter().filter_map(|l| page.equality(l)));
    remarks.push(Remark::MassesInvented);
    page.couplings();
    let told: Vec<String> = (known.iter().chain(&remarks))
        .map(Remark::to_string)
        .collect();
    page.document(&told);
    (page.xml.text(), remarks)
}

/// A constraint: tag and attributes.
type Element = (&'static str, Vec<(&'static str, String)>);

struct Page<'a> {
    tree: &'a Tree,
    size: f64,
    xml: Xml,
    /// Further points on the bodies.
    marks: Vec<Vec<(String, Vector3<f64>)>>,
    tendons: Vec<Tendon>,
    equalities: Vec<Element>,
}

enum Tendon {
    /// Between two sites.
    Spatial(String, [String; 2]),
    /// A sum of joint values.
    Fixed(String, Vec<(String, f64)>),
}

impl Page<'_> {
    /// A constraint between the frames of a loop.
    fn join(&mut self, tag: &'static str, name: &str, sites: [&str; 2]) {
        let [a, b] = sites.map(str::to_owned);
        let attributes = vec![("name", name.to_owned()), ("site1", a), ("site2", b)];
        self.equalities.push((tag, attributes));
    }

    /// The points at ℓ on the z axes of the frames of a loop.
    fn axis_points(&mut self, of: &Loop) -> [String; 2] {
        [0, 1].map(|side| {
            let Attachment { body, pose, .. } = &of.sides[side];
            let name = format!("{}.axis{}", of.name, side + 1);
            let point = pose.position + pose.rotation.0[2].times(self.size);
            self.marks[*body].push((name.clone(), point));
            name
        })
    }

    fn equality(&mut self, of: &Loop) -> Option<Remark> {
        let [a, b] = [&of.sides[0], &of.sides[1]];
        let sites = [a.frame.as_str(), &b.frame];
        match of.kind {
            ClosureKind::Spherical => self.join("connect", &of.name, sites),
            ClosureKind::Revolute => {
                self.join("connect", &of.name, sites);
                let [a, b] = self.axis_points(of);
                self.join("connect", &format!("{}.axis", of.name), [&a, &b]);
            }
            ClosureKind::Universal => {
                self.join("connect", &of.name, sites);
                let points = self.axis_points(of);
                let length = Extent {
                    constant: std::f64::consts::SQRT_2 * self.size,
                    terms: Vec::new(),
                };
                self.tendon(&format!("{}.square", of.name), of, points, true, &length);
            }
            ClosureKind::Distance => {
                let length = of.length.clone().unwrap_or(Extent {
                    constant: 0.0,
                    terms: Vec::new(),
                });
                if length.constant == 0.0 && length.terms.is_empty() {
                    self.join("connect", &of.name, sites);
                    let closure = of.name.clone();
                    return Some(Remark::ZeroDistance { closure });
                }
                self.tendon(&of.name, of, sites.map(str::to_owned), false, &length);
            }
            // the others were replaced by sliders
            _ => self.join("weld", &of.name, sites),
        }
        None
    }

    /// A tendon of a given length between two sites.
    ///
    /// MuJoCo sets y − y₀ = c₀ + c₁ (x − x₀) for the lengths y, x and their values y₀, x₀ where every joint is 0.
    fn tendon(&mut self, name: &str, of: &Loop, sites: [String; 2], marked: bool, length: &Extent) {
        let poses = self.tree.poses(|joint| joint.reference);
        let [p, q] = [0, 1].map(|side| {
            let Attachment { body, pose, .. } = &of.sides[side];
            let point = match marked {
                true => pose.position + pose.rotation.0[2].times(self.size),
                false => pose.position,
            };
            poses[*body] * point
        });
        let at_zero = (q - p).norm();
        let value = |joint: &str| {
            let found = self.tree.joints().find(|part| part.name == joint);
            found.map_or(0.0, |part| part.home)
        };
        let terms = length.terms.iter();
        let home = terms.fold(length.constant, |sum, (joint, c)| sum + c * value(joint));
        let sign = if home < 0.0 { -1.0 } else { 1.0 };
        let constant = sign * length.constant - at_zero;
        let mut equality = vec![("name", name.to_owned()), ("tendon1", name.to_owned())];
        self.tendons.push(Tendon::Spatial(name.into(), sites));
        if length.terms.is_empty() {
            equality.push(("polycoef", numbers([constant, 0.0, 0.0, 0.0, 0.0])));
        } else {
            let second = format!("{name}.length");
            let terms = length
                .terms
                .iter()
                .map(|(joint, c)| (joint.clone(), sign * c));
            let fixed = Tendon::Fixed(second.clone(), terms.collect());
            self.tendons.push(fixed);
            equality.push(("tendon2", second));
            equality.push(("polycoef", numbers([constant, 1.0, 0.0, 0.0, 0.0])));
        }
        self.equalities.push(("tendon", equality));
    }

    fn couplings(&mut self) {
        for coupling in &self.tree.couplings {
            let polynomial = [coupling.offset, coupling.factor, 0.0, 0.0, 0.0];
            let attributes = vec![
                ("name", coupling.joint.clone()),
                ("joint1", coupling.joint.clone()),
                ("joint2", coupling.leader.clone()),
                ("polycoef", numbers(polynomial)),
            ];
            self.equalities.push(("joint", attributes));
        }
    }

    fn document(&mut self, told: &[String]) {
        let size = self.size;
        let one = |name, value: String| [(name, value)];
        self.xml
            .open("mujoco", &one("model", self.tree.name.clone()));
        for line in told {
            self.xml.comment(line);
        }
        self.xml.leaf(
            "compiler",
            &[("angle", "radian".into()), ("autolimits", "true".into())],
        );
        self.xml.open("default", &[]);
        let damped = [("armature", "0.01".into()), ("damping", "0.1".into())];
        self.xml.leaf("joint", &damped);
        let hollow = [
            ("contype", "0".into()),
            ("conaffinity", "0".into()),
            ("size", numbers([rounded(0.015 * size)])),
            ("rgba", "0.5 0.6 0.7 1".into()),
        ];
        self.xml.leaf("geom", &hollow);
        let dot = [
            ("size", numbers([rounded(0.02 * size)])),
            ("group", "3".into()),
        ];
        self.xml.leaf("site", &dot);
        self.xml
            .leaf("tendon", &[("width", numbers([rounded(0.008 * size)]))]);
        self.xml.close("default");
        self.xml.open("worldbody", &[]);
        let order = self.bodies();
        self.xml.close("worldbody");
        self.blocks();
        self.keyframe(&order);
        self.xml.close("mujoco");
    }

    /// All bodies, nested; returns their order.
    fn bodies(&mut self) -> Vec<usize> {
        let children = self.tree.children();
        let mut order = Vec::new();
        // to do next: a body to open, or one to close
        let mut next = vec![(0, false)];
        while let Some((body, close)) = next.pop() {
            if close {
                self.xml.close("body");
                continue;
            }
            order.push(body);
            self.body(body, &children[body]);
            if body != 0 {
                next.push((body, true));
            }
            next.extend(children[body].iter().rev().map(|&child| (child, false)));
        }
        order
    }

    fn body(&mut self, index: usize, children: &[usize]) {
        let body = &self.tree.bodies[index];
        if index != 0 {
            let mut attributes = vec![("name", body.name.clone())];
            attributes.extend(place(&body.pose));
            self.xml.open("body", &attributes);
            let (mass, inertia) = (0.1, rounded(1e-3 * self.size * self.size));
            let inertial = [
                ("pos", "0 0 0".into()),
                ("mass", numbers([mass])),
                ("diaginertia", numbers([inertia; 3])),
            ];
            self.xml.leaf("inertial", &inertial);
        }
        for joint in &body.joints {
            self.xml.leaf(joint_tag(joint), &joint_attributes(joint));
        }
        let tree = self.tree;
        let ends = (children.iter()).map(|&child| tree.bodies[child].pose.position);
        let ends = ends.chain(body.frames.iter().map(|(_, pose)| pose.position));
        self.shapes(body, ends.collect(), index == 0);
        for (name, pose) in &body.frames {
            let mut attributes = vec![("name", name.clone())];
            attributes.extend(place(pose));
            self.xml.leaf("site", &attributes);
        }
        for (name, point) in &self.marks[index] {
            self.xml
                .leaf("site", &[("name", name.clone()), ("pos", vector(point))]);
        }
    }

    /// A ball at every joint and a bar to every point of interest.
    fn shapes(&mut self, body: &Body, ends: Vec<Vector3<f64>>, ground: bool) {
        let least = 0.02 * self.size;
        let mut drawn: Vec<Vector3<f64>> = Vec::new();
        let slides = body
            .joints
            .iter()
            .filter(|joint| joint.motion == Motion::Slide);
        let rods = slides.map(|joint| joint.axis.times(-joint.home));
        for end in ends.into_iter().chain(rods) {
            let far = |other: &Vector3<f64>| (end - *other).norm() > least;
            if end.norm() > least && drawn.iter().all(far) {
                drawn.push(end);
            }
        }
        if !ground || drawn.is_empty() {
            let ball = [
                ("type", "sphere".into()),
                ("size", numbers([rounded(least)])),
            ];
            self.xml.leaf("geom", &ball);
        }
        for end in drawn {
            let short = end.0.map(rounded);
            let bar = [
                ("type", "capsule".into()),
                ("fromto", numbers([0.0, 0.0, 0.0].into_iter().chain(short))),
            ];
            self.xml.leaf("geom", &bar);
        }
    }

    fn blocks(&mut self) {
        if !self.tendons.is_empty() {
            self.xml.open("tendon", &[]);
            for tendon in &self.tendons {
                match tendon {
                    Tendon::Spatial(name, sites) => {
                        self.xml.open("spatial", &[("name", name.clone())]);
                        for site in sites {
                            self.xml.leaf("site", &[("site", site.clone())]);
                        }
                        self.xml.close("spatial");
                    }
                    Tendon::Fixed(name, terms) => {
                        self.xml.open("fixed", &[("name", name.clone())]);
                        for (joint, c) in terms {
                            let term = [("joint", joint.clone()), ("coef", numbers([*c]))];
                            self.xml.leaf("joint", &term);
                        }
                        self.xml.close("fixed");
                    }
                }
            }
            self.xml.close("tendon");
        }
        if !self.equalities.is_empty() {
            self.xml.open("equality", &[]);
            for (tag, attributes) in &self.equalities {
                self.xml.leaf(tag, attributes);
            }
            self.xml.close("equality");
        }
        let actuated = actuated(self.tree);
        if !actuated.is_empty() {
            self.xml.open("actuator", &[]);
            for joint in actuated {
                let stiffness = match joint.motion {
                    Motion::Slide => 100.0,
                    _ => rounded(100.0 * self.size * self.size),
                };
                let servo = [
                    ("name", joint.name.clone()),
                    ("joint", joint.name.clone()),
                    ("kp", numbers([stiffness])),
                    ("dampratio", "1".into()),
                ];
                self.xml.leaf("position", &servo);
            }
            self.xml.close("actuator");
        }
    }

    fn keyframe(&mut self, order: &[usize]) {
        let mut values = Vec::new();
        for &body in order {
            let body = &self.tree.bodies[body];
            for joint in &body.joints {
                match (joint.motion, &body.home) {
                    (Motion::Free, Some(home)) => {
                        values.extend(home.position.0);
                        values.extend(Quaternion::from_rotation(&home.rotation).canonical().0);
                    }
                    _ => values.push(joint.home),
                }
            }
        }
        if values.is_empty() {
            return;
        }
        let actuated = actuated(self.tree);
        let inputs: Vec<f64> = actuated.iter().map(|joint| joint.home).collect();
        let mut attributes = vec![("name", "home".to_owned()), ("qpos", numbers(values))];
        if !inputs.is_empty() {
            attributes.push(("ctrl", numbers(inputs)));
        }
        self.xml.open("keyframe", &[]);
        self.xml.leaf("key", &attributes);
        self.xml.close("keyframe");
    }
}

fn actuated(tree: &Tree) -> Vec<&Joint> {
    tree.joints().filter(|joint| joint.actuated).collect()
}

/// Three digits: enough for dimensions that are only displayed.
fn rounded(value: f64) -> f64 {
    let short = format!("{value:.2e}").parse();
    short.unwrap_or(value)
}
