//! Elements of an SDF file: links, joints and frames of models within models, by their full names.

use std::collections::{BTreeSet, HashMap, HashSet};

use roxmltree::Node;

use super::frames::{SdfFrames, WORLD};
use super::parts::SdfJoint;
use crate::geometry::{Pose, Vector3};
use crate::interchange::masses::{Heavy, MOMENTS};
use crate::interchange::mjcf::{Files, NotRead};
use crate::interchange::problem::ImportProblemKind;
use crate::interchange::xml_reader::{
    Problems, child, children, document, pose_of, tag, turned, version,
};

/// Models of light and floor.
const SCENERY: [&str; 2] = ["://sun", "://ground_plane"];

/// The version of a file that says none.
const LATEST: (u32, u32) = (1, 7);

/// The contents of the elements of a file.
pub(super) struct SdfReader<'f> {
    pub problems: Problems,
    files: Files<'f>,
    pub(super) version: (u32, u32),
    pub frames: SdfFrames,
    /// The links, each true if it stands still.
    pub links: Vec<(String, bool)>,
    /// Masses of links that have some.
    pub masses: HashMap<String, Heavy>,
    pub joints: Vec<SdfJoint>,
    /// Joints that a controller drives.
    pub driven: HashSet<String>,
    /// Universal joints that lack an axis.
    pub axisless: BTreeSet<String>,
    /// The number of included models that are no part of a mechanism.
    pub scenery: usize,
    /// The number of grippers, which are no joints.
    pub grippers: usize,
    /// Files that are being read: none includes itself.
    within: Vec<String>,
}

/// Scope of an element of a model: the prefix of its names, and true if all of it stands still.
#[derive(Clone)]
pub(super) struct ModelScope {
    prefix: String,
    fixed: bool,
}

impl ModelScope {
    /// The full name of a frame.
    pub fn name(&self, name: &str) -> String {
        match name.trim() {
            WORLD => WORLD.into(),
            name => format!("{}{name}", self.prefix),
        }
    }

    pub fn model(&self) -> String {
        self.name("__model__")
    }
}

impl<'f> SdfReader<'f> {
    pub fn new(files: Files<'f>) -> Self {
        SdfReader {
            problems: Problems(Vec::new()),
            files,
            version: LATEST,
            frames: SdfFrames::default(),
            links: Vec::new(),
            masses: HashMap::new(),
            joints: Vec::new(),
            driven: HashSet::new(),
            axisless: BTreeSet::new(),
            scenery: 0,
            grippers: 0,
            within: Vec::new(),
        }
    }

    /// A file: its models, or those of its world. Names of a model alone have nothing before them.
    pub fn file(&mut self, root: Node) -> String {
        self.version = version(root).unwrap_or(LATEST);
        let inside = child(root, "world").unwrap_or(root);
        let outer = ModelScope {
            prefix: String::new(),
            fixed: false,
        };
        let models = children(inside, "model");
        // what every world has around its models
        let (scenery, includes): (Vec<Node>, Vec<Node>) = children(inside, "include")
            .into_iter()
            .partition(|include| matches!(self.word(*include, "uri"), Some(uri) if SCENERY.iter().any(|name| uri.ends_with(name))));
        self.scenery = scenery.len();
        let alone = models.len() == 1 && includes.is_empty();
        for (i, model) in models.iter().enumerate() {
            let name = self.problems.needed(*model, "name").unwrap_or_default();
            let prefix = if alone {
                String::new()
            } else {
                format!("{name}::")
            };
            if i > 0
                && models[..i]
                    .iter()
                    .any(|other| other.attribute("name") == Some(name))
            {
                self.problems.duplicate("model", name, *model);
            }
            let place = self.pose(*model, &outer, WORLD);
            self.model(*model, &outer, prefix, place);
        }
        for include in includes {
            self.include(include, &outer, WORLD);
        }
        let named = models.first().copied().filter(|_| alone).unwrap_or(inside);
        named.attribute("name").unwrap_or("mechanism").to_owned()
    }

    /// The frame relative to which an element is given, and its pose there.
    pub(super) fn pose(
        &mut self,
        node: Node,
        scope: &ModelScope,
        default: &str,
    ) -> (String, Pose<f64>) {
        let nowhere = (default.to_owned(), Pose::identity());
        let Some(part) = child(node, "pose") else {
            return nowhere;
        };
        let given = part.attribute("relative_to").or(part.attribute("frame"));
        let relative_to = match given.map_or("", str::trim) {
            "" => default.to_owned(),
            name => scope.name(name),
        };
        let text = part.text().unwrap_or_default();
        if text.trim().is_empty() {
            return (relative_to, Pose::identity());
        }
        let quaternion = part.attribute("rotation_format") == Some("quat_xyzw");
        let count = if quaternion { 7 } else { 6 };
        let Some(v) = self.problems.parsed(text, count, tag(part)) else {
            return nowhere;
        };
        let at = [v[0], v[1], v[2]];
        let pose = match quaternion {
            true if v[3..].iter().all(|x| *x == 0.0) => {
                let text = text.trim().to_owned();
                self.problems
                    .say(ImportProblemKind::NoOrientation { text }, part);
                return nowhere;
            }
            true => Pose {
                rotation: turned([v[6], v[3], v[4], v[5]]),
                position: Vector3(at),
            },
            false => {
                let degrees = part.attribute("degrees") == Some("true");
                let unit = if degrees { 1f64.to_radians() } else { 1.0 };
                pose_of(at, [v[3] * unit, v[4] * unit, v[5] * unit])
            }
        };
        (relative_to, pose)
    }

    /// A model at a place.
    fn model(
        &mut self,
        node: Node,
        outer: &ModelScope,
        prefix: String,
        place: (String, Pose<f64>),
    ) {
        let fixed = outer.fixed || matches!(self.word(node, "static"), Some("true" | "1"));
        let scope = ModelScope { prefix, fixed };
        let before = self.links.len();
        let part = "placement_frame";
        if node.has_attribute(part) || child(node, part).is_some() {
            let what = "a model that is placed by one of its frames";
            let help = "give the pose of the model itself";
            self.problems.unsupported::<()>(what, help, node);
        }
        for link in children(node, "link") {
            if let Some(name) = self.named(link, &scope) {
                let place = self.pose(link, &scope, &scope.model());
                self.add("link", link, &name, place, None);
                let before = self.problems.0.len();
                let heavy = self.heavy(link, &scope);
                let heavy = match self.problems.forget_after(before) {
                    true => Some(Heavy::UNREADABLE),
                    false => heavy,
                };
                self.masses.extend(heavy.map(|heavy| (name.clone(), heavy)));
                self.links.push((name, fixed));
            }
        }
        for inner in children(node, "model") {
            if let Some(name) = self.named(inner, &scope) {
                let place = self.pose(inner, &scope, &scope.model());
                self.model(inner, &scope, format!("{name}::"), place);
                let own = (format!("{name}::__model__"), Pose::identity());
                let carried = Some(format!("{name}::__model__"));
                self.add("model", inner, &name, own, carried);
            }
        }
        for include in children(node, "include") {
            self.include(include, &scope, &scope.model());
        }
        let canonical = node
            .attribute("canonical_link")
            .map(|name| scope.name(name));
        let canonical = canonical.or_else(|| self.links.get(before).map(|(name, _)| name.clone()));
        let whole = canonical.unwrap_or_else(|| WORLD.into());
        self.add("model", node, &scope.model(), place, Some(whole));
        for frame in children(node, "frame") {
            if let Some(name) = self.named(frame, &scope) {
                let carrier = frame
                    .attribute("attached_to")
                    .filter(|name| !name.is_empty());
                let carrier = carrier.map_or_else(|| scope.model(), |name| scope.name(name));
                let place = self.pose(frame, &scope, &carrier);
                self.add("frame", frame, &name, place, Some(carrier));
            }
        }
        for joint in children(node, "joint") {
            if let Some(joint) = self.joint(joint, &scope) {
                self.joints.push(joint);
            }
        }
        // it holds what lies between its links, which joints join
        self.grippers += children(node, "gripper").len();
        for plugin in children(node, "plugin") {
            for part in plugin
                .descendants()
                .filter(|part| part.has_tag_name("joint_name"))
            {
                self.driven.extend(part.text().map(|name| scope.name(name)));
            }
        }
    }

    /// The mass of a link in its frame, if one is given.
    fn heavy(&mut self, link: Node, scope: &ModelScope) -> Option<Heavy> {
        let inertial = child(link, "inertial")?;
        let [mass] = self.numbers(inertial, "mass").unwrap_or([1.0]);
        let (_, pose) = self.pose(inertial, scope, &scope.model());
        let inertia = child(inertial, "inertia");
        let moments = MOMENTS.map(|name| {
            let given = inertia.and_then(|of| self.numbers::<1>(of, name));
            given.map_or(0.0, |[moment]| moment)
        });
        (mass > 0.0).then(|| Heavy::at(mass, moments, &pose))
    }

    pub(super) fn named(&mut self, node: Node, scope: &ModelScope) -> Option<String> {
        let name = self.problems.needed(node, "name")?;
        Some(scope.name(name))
    }

    pub(super) fn add(
        &mut self,
        noun: &'static str,
        node: Node,
        name: &str,
        place: (String, Pose<f64>),
        carrier: Option<String>,
    ) {
        if !self.frames.add(name, place, carrier) {
            self.problems.duplicate(noun, name, node);
        }
    }

    /// The text of an element in another.
    pub(super) fn word<'a>(&self, node: Node<'a, '_>, name: &str) -> Option<&'a str> {
        child(node, name)?.text().map(str::trim)
    }

    /// Numbers in an element, if it is there.
    pub(super) fn numbers<const N: usize>(&mut self, node: Node, name: &str) -> Option<[f64; N]> {
        let part = child(node, name)?;
        let found = (self.problems).parsed(part.text().unwrap_or_default(), N, tag(part))?;
        found.try_into().ok()
    }

    /// A model in another file of the folder.
    fn include(&mut self, node: Node, scope: &ModelScope, frame: &str) {
        let Some(uri) = self.word(node, "uri") else {
            self.problems.missing(node, "element `uri`".into());
            return;
        };
        let path = uri
            .strip_prefix("model://")
            .or(uri.strip_prefix("file://"))
            .unwrap_or(uri);
        let files = self.files;
        let texts = [
            path.to_owned(),
            format!("{}/model.sdf", path.trim_end_matches('/')),
        ];
        let read = |name: &String| files(name).map(|text| (name.clone(), text));
        let (name, text) = match read(&texts[0]).or_else(|first| read(&texts[1]).map_err(|_| first))
        {
            Ok(read) => read,
            Err(why) => {
                let file = path.to_owned();
                let problem = match why {
                    NotRead::Outside => ImportProblemKind::Outside { file },
                    NotRead::Failed(reason) => ImportProblemKind::NotIncluded { file, reason },
                };
                return self.problems.say(problem, node);
            }
        };
        if self.within.contains(&name) {
            let reason = "it includes itself".into();
            return self
                .problems
                .say(ImportProblemKind::NotIncluded { file: name, reason }, node);
        }
        let place = self.pose(node, scope, frame);
        let own = std::mem::replace(&mut self.problems, Problems(Vec::new()));
        let version = self.version;
        self.within.push(name.clone());
        match document(&text) {
            Ok(page) => self.included(node, page.root_element(), scope, place),
            Err(problem) => self.problems.0.push(problem),
        }
        self.within.pop();
        self.version = version;
        let inside = std::mem::replace(&mut self.problems, own);
        for problem in inside.0 {
            let message = format!("{name}: {problem}");
            self.problems
                .say(ImportProblemKind::Reader { message }, node);
        }
    }

    fn included(&mut self, node: Node, root: Node, scope: &ModelScope, place: (String, Pose<f64>)) {
        if !root.has_tag_name("sdf") {
            let found = root.tag_name().name().to_owned();
            let expected = &["sdf"];
            return self
                .problems
                .say(ImportProblemKind::NotThisFormat { found, expected }, root);
        }
        self.version = version(root).unwrap_or(LATEST);
        let Some(model) = child(root, "model") else {
            return self.problems.missing(root, "element `model`".into());
        };
        let own = model.attribute("name").unwrap_or("model");
        let name = scope.name(self.word(node, "name").unwrap_or(own));
        // the pose of the include takes the place of that of the model
        let place = match child(node, "pose") {
            Some(_) => place,
            None => (place.0, self.pose(model, scope, WORLD).1),
        };
        let fixed = scope.fixed || matches!(self.word(node, "static"), Some("true" | "1"));
        let outer = ModelScope {
            fixed,
            ..scope.clone()
        };
        self.model(model, &outer, format!("{name}::"), place);
        let inner = format!("{name}::__model__");
        self.add(
            "model",
            node,
            &name,
            (inner.clone(), Pose::identity()),
            Some(inner),
        );
    }
}
