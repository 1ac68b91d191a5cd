//! Valid mechanisms of random topology as text, assembled at home: every closing transform is computed from a random
//! configuration.

use std::f64::consts::PI;
use std::fmt::Write;

use linkwork::description::{ClosureKind, Description};
use linkwork::geometry::Axis;
use linkwork::mechanism::Mechanism;
use nalgebra::{Isometry3, Vector3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::kinematics::{Placed, shift, turn};

/// Random choices, the same in every run.
pub struct Dice(Pcg64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Dice(Pcg64::seed_from_u64(seed))
    }

    /// From −1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.0.random::<f64>() - 1.0
    }

    pub fn chance(&mut self, of: f64) -> bool {
        self.0.random::<f64>() < of
    }

    pub fn below(&mut self, end: usize) -> usize {
        self.0.random_range(0..end)
    }

    pub fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())].clone()
    }
}

/// What the links are like.
#[derive(Clone, Copy, PartialEq)]
enum Manner {
    /// Any twists and lengths.
    Spatial,
    /// All joints move parallel to one plane.
    Planar,
    /// Right angles and few different lengths, zero among them: links that meet, parallelograms, idle spins.
    Square,
}

struct Chain {
    on: String,
    base: String,
    rows: Vec<String>,
    tip: String,
    standard: bool,
    /// Whether its tip is where something needs it.
    closed: bool,
}

struct Joint {
    home: f64,
    slides: bool,
    actuated: bool,
    limits: Option<(f64, f64)>,
}

struct Platform {
    home: String,
    frames: Vec<String>,
}

/// A mechanism while it is made.
struct Sketch {
    dice: Dice,
    manner: Manner,
    scale: f64,
    /// Decades over which lengths are spread.
    decades: f64,
    parameters: Vec<String>,
    joints: Vec<Joint>,
    chains: Vec<Chain>,
    platforms: Vec<Platform>,
    closures: Vec<String>,
}

/// The text of a mechanism. `size` is about how many joints it has.
pub fn mechanism(seed: u64, size: usize) -> String {
    let mut dice = Dice::new(seed);
    let manner = dice.pick(&[
        Manner::Spatial,
        Manner::Spatial,
        Manner::Planar,
        Manner::Square,
    ]);
    let mut sketch = Sketch {
        manner,
        // a platform far beyond the lengths given so far would be brought back
        scale: dice.pick(&[1e-6, 1e-3, 1.0, 1.0, 1.0, 1.0, 300.0]),
        decades: dice.pick(&[0.0, 0.0, 0.0, 1.0]),
        dice,
        parameters: Vec::new(),
        joints: Vec::new(),
        chains: Vec::new(),
        platforms: Vec::new(),
        closures: Vec::new(),
    };
    match sketch.dice.below(5) {
        0 => sketch.legs(size),
        1 | 2 => sketch.loops(size),
        3 => sketch.serial(size),
        _ => sketch.anything(size),
    }
    sketch.text()
}

impl Sketch {
    fn length(&mut self) -> f64 {
        let spread = 10f64.powf(self.decades * self.dice.signed());
        let length = match self.manner {
            Manner::Square => self.dice.pick(&[0.0, 0.5, 1.0, 1.0, 2.0]),
            _ => (0.2 + self.dice.signed().abs()) * spread,
        };
        length * self.scale
    }

    fn angle(&mut self) -> f64 {
        match self.manner {
            Manner::Square => PI / 6.0 * self.dice.below(12) as f64 - PI + PI / 6.0,
            _ => PI * self.dice.signed(),
        }
    }

    fn right_angle(&mut self) -> f64 {
        self.dice.pick(&[0.0, 0.5 * PI, -0.5 * PI, PI])
    }

    /// Where a leg stands, or what else lies between two frames.
    fn displacement(&mut self) -> Isometry3<f64> {
        let [x, y, z] = [self.length(), self.length(), self.length()];
        let signs = [self.dice.signed(), self.dice.signed(), self.dice.signed()].map(f64::signum);
        match self.manner {
            Manner::Planar => {
                let by = Vector3::new(signs[0] * x, signs[1] * y, 0.0);
                shift(by) * turn(Axis::Z, self.angle())
            }
            Manner::Spatial => {
                let by = Vector3::new(signs[0] * x, signs[1] * y, signs[2] * z);
                let turned = turn(Axis::Y, 0.4 * self.angle()) * turn(Axis::X, self.angle());
                shift(by) * turn(Axis::Z, self.angle()) * turned
            }
            Manner::Square => {
                let by = Vector3::new(x, signs[1] * y, 0.0);
                shift(by) * turn(Axis::Z, self.right_angle()) * turn(Axis::X, self.right_angle())
            }
        }
    }

    /// A length as it may be written: a number, a parameter, half the double.
    fn written_length(&mut self, length: f64) -> String {
        match self.dice.below(6) {
            0 => {
                let name = format!("a{}", self.parameters.len());
                self.parameters.push(format!("\"{name}\": {length:?}"));
                format!("\"{name}\"")
            }
            1 => format!("\"2*{:?}\"", 0.5 * length),
            _ => format!("{length:?}"),
        }
    }

    fn joint(&mut self, slides: bool) -> usize {
        let home = match slides {
            true => {
                self.length()
                    + if self.manner == Manner::Square {
                        self.scale
                    } else {
                        0.0
                    }
            }
            false => self.angle(),
        };
        let scale = if slides { self.scale } else { 1.0 };
        let limits = (self.dice.chance(0.1)).then_some((home - 1.5 * scale, home + scale));
        self.joints.push(Joint {
            home,
            slides,
            actuated: self.dice.chance(0.35),
            limits,
        });
        self.joints.len() - 1
    }

    /// A variable as it may stand in a row: itself, with a sign or an offset, or that of an earlier joint.
    fn variable(&mut self, slides: bool) -> String {
        let earlier: Vec<usize> = (0..self.joints.len())
            .filter(|&j| self.joints[j].slides == slides)
            .collect();
        let offset = match (slides, self.manner) {
            (true, _) => self.length(),
            (false, Manner::Square) => self.right_angle(),
            (false, _) => self.angle(),
        };
        if !earlier.is_empty() && self.dice.chance(0.08) {
            let of = self.dice.pick(&earlier);
            let factor = self.dice.pick(&["", "-", "2*", "-0.5*"]);
            if self.dice.chance(0.5) {
                return format!("\"{factor}q{of} + {offset:?}\"");
            }
            return format!("\"q{} + {factor}q{of}\"", self.joint(slides));
        }
        let of = self.joint(slides);
        match self.dice.below(5) {
            0 => format!("\"-q{of}\""),
            1 => format!("\"{offset:?} - q{of}\""),
            _ => format!("\"q{of}\""),
        }
    }

    fn row(&mut self, last: bool) -> String {
        let planar = self.manner == Manner::Planar;
        let slides = self.dice.chance(0.2) && (!planar || last);
        let alpha = match self.manner {
            Manner::Planar => {
                if slides {
                    0.5 * PI
                } else {
                    0.0
                }
            }
            Manner::Spatial => self.angle(),
            Manner::Square => self.right_angle(),
        };
        let a = self.length();
        let mut row = format!("alpha: {alpha:?}, a: {}", self.written_length(a));
        let fixed = !planar && self.dice.chance(0.03);
        let helical = !planar && !slides && self.dice.chance(0.03);
        let (d, theta) = match (fixed, slides) {
            (true, _) => (
                format!("{:?}", self.length()),
                format!("{:?}", self.angle()),
            ),
            (false, true) if planar => (self.variable(true), "0".into()),
            (false, true) => (self.variable(true), format!("{:?}", self.angle())),
            (false, false) if helical => {
                let theta = self.variable(false);
                let of = self.joints.len() - 1;
                // of all joints so far the last one may be a slide
                match self.joints[of].slides {
                    true => ("0".into(), theta),
                    false => (format!("\"{:?}*q{of}\"", 0.1 * self.scale), theta),
                }
            }
            (false, false) if planar => ("0".into(), self.variable(false)),
            (false, false) => {
                let d = self.length();
                (self.written_length(d), self.variable(false))
            }
        };
        let _ = write!(row, ", d: {d}, theta: {theta}");
        format!("({row})")
    }

    /// A chain of so many rows on a frame; its index.
    fn chain(&mut self, on: &str, rows: usize) -> usize {
        let standard = self.dice.chance(0.3) && self.manner != Manner::Planar;
        let base = written(&self.displacement(), self.scale);
        let rows = (1..=rows).map(|k| self.row(k == rows)).collect();
        self.chains.push(Chain {
            on: on.into(),
            base,
            rows,
            tip: String::new(),
            standard,
            closed: false,
        });
        self.chains.len() - 1
    }

    fn platform(&mut self) -> usize {
        let home = written(&self.displacement(), self.scale);
        self.platforms.push(Platform {
            home,
            frames: Vec::new(),
        });
        self.platforms.len() - 1
    }

    fn kind(&mut self) -> ClosureKind {
        let simple = [
            ClosureKind::Spherical,
            ClosureKind::Revolute,
            ClosureKind::Distance,
        ];
        match self.dice.chance(0.5) {
            true => self.dice.pick(&simple),
            // all but couplings, which join no frames
            false => self
                .dice
                .pick(&ClosureKind::ALL[..ClosureKind::ALL.len() - 1]),
        }
    }

    /// What a closure leaves between its frames.
    fn between(&mut self, kind: ClosureKind) -> Isometry3<f64> {
        let along = |z| shift(Vector3::z() * z);
        let (angle, length) = (self.angle(), self.length());
        let about_z = turn(Axis::Z, angle);
        let any = self.displacement();
        match kind {
            ClosureKind::Spherical => {
                Isometry3::from_parts(shift(Vector3::zeros()).translation, any.rotation)
            }
            ClosureKind::Revolute => about_z,
            ClosureKind::Prismatic => along(length),
            ClosureKind::Universal => {
                about_z * turn(Axis::X, 0.5 * PI) * turn(Axis::Z, self.angle())
            }
            ClosureKind::Cylindrical => about_z * along(length),
            ClosureKind::Planar => shift(Vector3::new(length, self.length(), 0.0)) * about_z,
            ClosureKind::Rigid => Isometry3::identity(),
            ClosureKind::Coupling => unreachable!("it joins no frames"),
            ClosureKind::Distance => any * shift(Vector3::x() * 0.3 * self.scale),
        }
    }

    /// A joint between two frames, closed where they are: what it needs is added to the second one.
    fn close(&mut self, kind: ClosureKind, a: &str, b: &str) {
        let description = Description::read(&self.text()).unwrap();
        let Ok(mechanism) = Mechanism::new(&description) else {
            panic!("{}", self.text());
        };
        let [a_frame, b_frame] = [a, b].map(|name| mechanism.frame(name).unwrap());
        if mechanism.body(a_frame) == mechanism.body(b_frame) {
            return;
        }
        let home = mechanism.home();
        let placed = Placed {
            mechanism: &mechanism,
            at: &home,
        };
        let between = self.between(kind);
        let needed = placed.pose(b_frame).inverse() * placed.pose(a_frame) * between;
        let needed = written(&needed, self.scale);
        let platform = b.strip_prefix('p').map(|p| p.parse::<usize>().unwrap());
        // the last link of a chain whose tip is not needed elsewhere
        let own = (0..self.chains.len()).find(|&i| !self.chains[i].closed && self.end(i) == b);
        let second = match (platform, own) {
            (Some(p), _) => {
                let name = format!("F{}", self.platforms[p].frames.len());
                self.platforms[p]
                    .frames
                    .push(format!("\"{name}\": {needed}"));
                format!("p{p}.{name}")
            }
            (None, Some(chain)) => {
                self.chains[chain].tip = needed;
                self.chains[chain].closed = true;
                format!("c{chain}")
            }
            (None, None) => {
                self.chains.push(Chain {
                    on: b.into(),
                    base: needed,
                    rows: Vec::new(),
                    tip: String::new(),
                    standard: false,
                    closed: true,
                });
                format!("c{}", self.chains.len() - 1)
            }
        };
        let name = format!("k{}", self.closures.len());
        let length = match kind {
            ClosureKind::Distance => {
                let length = between.translation.vector.norm();
                match self.dice.chance(0.2) {
                    true => {
                        let joint = self.joint(true);
                        (self.joints[joint].home, self.joints[joint].limits) = (length, None);
                        format!(", \"q{joint}\"")
                    }
                    false => format!(", {length:?}"),
                }
            }
            _ => String::new(),
        };
        let [first, second] = match self.dice.chance(0.5) {
            true => [a, &second],
            false => [second.as_str(), a],
        };
        let closure = format!(
            "\"{name}\": {}(\"{first}\", \"{second}\"{length})",
            kind.word()
        );
        self.closures.push(closure);
    }

    /// The last link of a chain.
    fn end(&self, chain: usize) -> String {
        format!("c{chain}.{}", self.chains[chain].rows.len())
    }

    /// Any frame that moves, or ground.
    fn anywhere(&mut self) -> String {
        let mut frames = vec!["ground".to_owned()];
        for (i, chain) in self.chains.iter().enumerate() {
            frames.extend((1..=chain.rows.len()).map(|k| format!("c{i}.{k}")));
        }
        frames.extend((0..self.platforms.len()).map(|p| format!("p{p}")));
        self.dice.pick(&frames)
    }

    /// A platform on legs.
    fn legs(&mut self, size: usize) {
        self.platform();
        let legs = 2 + self.dice.below(5);
        for _ in 0..legs {
            let rows = self.dice.below(1 + (size / legs).min(4));
            let kind = self.kind();
            let leg = self.chain("ground", rows.max(1));
            let end = self.end(leg);
            self.close(kind, &end, "p0");
        }
    }

    /// Chains one beside the other, joined to each other.
    fn loops(&mut self, size: usize) {
        let chains = 2 + self.dice.below(2);
        for _ in 0..chains {
            let on = match self.dice.chance(0.7) {
                true => "ground".into(),
                false => self.anywhere(),
            };
            let rows = 1 + self.dice.below((size / chains).max(1));
            self.chain(&on, rows);
        }
        for chain in 1..chains {
            let kind = match self.manner {
                Manner::Planar => self.dice.pick(&[
                    ClosureKind::Revolute,
                    ClosureKind::Revolute,
                    ClosureKind::Spherical,
                ]),
                _ => self.kind(),
            };
            let other = self.dice.below(chain);
            let (a, b) = (self.end(other), self.end(chain));
            self.close(kind, &a, &b);
        }
    }

    /// One chain, perhaps with a platform for its hand.
    fn serial(&mut self, size: usize) {
        let rows = 1 + self.dice.below(size.min(6));
        let chain = self.chain("ground", rows);
        if self.dice.chance(0.7) {
            self.platform();
            let end = self.end(chain);
            self.close(ClosureKind::Rigid, &end, "p0");
        }
    }

    fn anything(&mut self, size: usize) {
        for _ in 0..1 + self.dice.below(4) {
            let on = self.anywhere();
            let rows = 1 + self.dice.below((size / 2).clamp(1, 4));
            self.chain(&on, rows);
        }
        for platform in 0..self.dice.below(3) {
            self.platform();
            for _ in 0..1 + self.dice.below(4) {
                let (kind, a) = (self.kind(), self.anywhere());
                self.close(kind, &a, &format!("p{platform}"));
            }
        }
        for _ in 0..self.dice.below(3) {
            let (kind, a, b) = (self.kind(), self.anywhere(), self.anywhere());
            self.close(kind, &a, &b);
        }
    }

    fn text(&self) -> String {
        let list = |items: Vec<String>| {
            items
                .iter()
                .map(|i| format!("        {i},\n"))
                .collect::<String>()
        };
        let joints = self.joints.iter().enumerate().map(|(j, joint)| {
            let role = if joint.actuated {
                "Actuated"
            } else {
                "Passive"
            };
            let limits = joint
                .limits
                .map(|(a, b)| format!(", limits: ({a:?}, {b:?})"));
            let limits = limits.unwrap_or_default();
            format!("\"q{j}\": {role}(home: {:?}{limits})", joint.home)
        });
        let chains = self.chains.iter().enumerate().map(|(i, c)| {
            let convention = if c.standard { "Standard" } else { "Modified" };
            let tip = match c.tip.is_empty() {
                true => String::new(),
                false => format!(", tip: {}", c.tip),
            };
            let on = match c.on.as_str() {
                "ground" => String::new(),
                on => format!("on: \"{on}\", "),
            };
            let rows = c.rows.join(", ");
            format!(
                "\"c{i}\": Chain({on}convention: {convention}, base: {}, rows: [{rows}]{tip})",
                c.base
            )
        });
        let platforms = self.platforms.iter().enumerate().map(|(p, platform)| {
            let frames = platform.frames.join(", ");
            format!(
                "\"p{p}\": Platform(home: {}, frames: {{{frames}}})",
                platform.home
            )
        });
        format!(
            "Mechanism(\n    version: 1,\n    name: \"random\",\n    convention: Modified,\n    parameters: {{\n{}    }},\n    \
             joints: {{\n{}    }},\n    chains: {{\n{}    }},\n    platforms: {{\n{}    }},\n    closures: {{\n{}    }},\n)\n",
            list(self.parameters.clone()),
            list(joints.collect()),
            list(chains.collect()),
            list(platforms.collect()),
            list(self.closures.clone()),
        )
    }
}

/// A pose as a list of displacements to all its digits; right angles and zeros are written as such.
fn written(pose: &Isometry3<f64>, scale: f64) -> String {
    let [x, y, z] = [0, 1, 2].map(|i| match pose.translation.vector[i] {
        x if x.abs() < 1e-13 * scale => 0.0,
        x => x,
    });
    let matrix = pose.rotation.to_rotation_matrix();
    let yaw = matrix[(1, 0)].atan2(matrix[(0, 0)]);
    // where yaw and roll turn about one axis, the rest of the rotation decides
    let rest = turn(Axis::Z, -yaw).rotation.to_rotation_matrix() * matrix;
    let pitch = (-rest[(2, 0)]).atan2(rest[(0, 0)]);
    let roll = (-rest[(1, 2)]).atan2(rest[(1, 1)]);
    let angle = |angle: f64| {
        let part = (angle / (PI / 12.0)).round();
        match (angle - part * PI / 12.0).abs() < 1e-13 {
            true => format!("\"{} deg\"", 15.0 * part),
            false => format!("{angle:?}"),
        }
    };
    let mut steps = vec![format!("T({x:?}, {y:?}, {z:?})")];
    for (word, by) in [("Rz", yaw), ("Ry", pitch), ("Rx", roll)] {
        if by.abs() > 1e-13 {
            steps.push(format!("{word}({})", angle(by)));
        }
    }
    format!("[{}]", steps.join(", "))
}
