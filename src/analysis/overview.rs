//! What a mechanism file means, part by part.

mod count;
mod loops;

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

pub use count::{MobilityCount, PlanarCount};
pub use loops::{Loop, LoopStep};

use crate::algebra::{Affine, Node, SiUnit};
use crate::description::{AxesDescription, axes_text};
use crate::geometry::{Pose, Quaternion, RollPitchYaw};
use crate::mechanism::{
    Chain, ClosureKind, Convention, FixedStep, Formula, Frame, Given, Joint, JointKind, Mechanism,
    NamedClosure, Platform, Role, Row, Symbol,
};

/// What a mechanism file means.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overview {
    /// What the mechanism is called.
    #[serde(rename = "mechanism")]
    pub name: String,
    /// Where it comes from.
    pub source: Option<String>,
    /// The joint coordinates from which the tables were made, if they were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinates: Option<CoordinatesOverview>,
    /// The parameters.
    pub parameters: Vec<ParameterOverview>,
    /// The joints.
    pub joints: Vec<JointOverview>,
    /// The chains with their tables.
    pub chains: Vec<ChainOverview>,
    /// The platforms.
    pub platforms: Vec<PlatformOverview>,
    /// The closures.
    pub closures: Vec<ClosureOverview>,
    /// Independent loops.
    pub loops: Vec<Loop>,
    /// How many freedoms counting leads to expect.
    pub count: MobilityCount,
    /// The closed forms.
    pub closed_forms: Vec<ClosedFormOverview>,
    /// What is odd about the file, one sentence each.
    pub warnings: Vec<String>,
}

/// Joint coordinates, and what was chosen to make tables of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoordinatesOverview {
    /// The file of joint coordinates, serialised as its text.
    #[serde(rename = "file", with = "axes_text")]
    pub axes: AxesDescription,
    /// The joints that are cut, beside balls and rods.
    pub cut: Vec<String>,
    /// Bodies with nothing but two balls, taken for rods.
    pub rods: Vec<String>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterOverview {
    /// Its name.
    pub name: String,
    /// What it is defined as.
    pub definition: String,
    /// Its value, in m or rad or without unit.
    pub value: f64,
}

/// A joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointOverview {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub kind: JointUse,
    /// Whether it is driven.
    pub role: Role,
    /// Unit of its values, rad or m; none if it is unused.
    pub unit: Option<SiUnit>,
    /// Its value in the home configuration, rad or m.
    pub home: f64,
    /// Lowest and highest value, rad or m.
    pub limits: Option<(f64, f64)>,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointUse {
    /// It turns.
    Revolute,
    /// It slides.
    Prismatic,
    /// It turns and slides at once.
    Helical,
    /// It stands nowhere.
    Unused,
}

impl JointUse {
    /// What it is called.
    pub fn word(self) -> &'static str {
        match self {
            JointUse::Revolute => JointKind::Revolute.word(),
            JointUse::Prismatic => JointKind::Prismatic.word(),
            JointUse::Helical => JointKind::Helical.word(),
            JointUse::Unused => "unused",
        }
    }
}

/// A chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainOverview {
    /// Its name.
    pub name: String,
    /// The frame it stands on.
    pub on: String,
    /// How its rows are read.
    pub convention: Convention,
    /// From that frame to the chain's frame 0, as written.
    pub base: Vec<String>,
    /// The rows of its table.
    pub rows: Vec<RowOverview>,
    /// From its last link frame to its tip, as written.
    pub tip: Vec<String>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowOverview {
    /// Twist.
    pub alpha: EntryOverview,
    /// Length.
    pub a: EntryOverview,
    /// Offset.
    pub d: EntryOverview,
    /// Joint angle.
    pub theta: EntryOverview,
}

/// An entry of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EntryOverview {
    /// As written in the file.
    pub written: String,
    /// Its value (rad or m), if no joint variable stands in it.
    pub value: Option<f64>,
    /// Whether parameters stand in it, so that the value says more than what is written.
    pub uses_parameters: bool,
}

/// A platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlatformOverview {
    /// Its name.
    pub name: String,
    /// Where its origin is at home (m).
    pub position: [f64; 3],
    /// Its orientation at home, scalar part first.
    pub quaternion: [f64; 4],
    /// Its orientation at home: roll, pitch, yaw (rad), Rz(yaw)·Ry(pitch)·Rx(roll).
    pub roll_pitch_yaw: [f64; 3],
    /// Frames fixed in it, as written.
    pub frames: Vec<PlatformFrameOverview>,
}

/// A frame of a platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlatformFrameOverview {
    /// Its name.
    pub name: String,
    /// Where it is in the platform, as written.
    pub placed: Vec<String>,
}

/// A closure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosureOverview {
    /// Its name.
    pub name: String,
    /// The kind of joint.
    pub kind: ClosureKind,
    /// The frames it joins.
    pub frames: [String; 2],
    /// Its length, if it is a `Distance`.
    pub length: Option<String>,
    /// How many equations it adds.
    pub equations: usize,
}

/// A closed form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosedFormOverview {
    /// Its name.
    pub name: String,
    /// How many entries of a pose or identities it gives.
    pub formulas: usize,
    /// The frame whose pose it gives and the frame this is seen from; none for identities.
    pub pose_of: Option<[String; 2]>,
    /// Where it is printed.
    pub source: Option<String>,
}

/// Says what a mechanism consists of.
pub fn overview(mechanism: &Mechanism) -> Overview {
    let parameters = mechanism.parameters().iter();
    let closed_forms = mechanism.closed_forms().iter();
    Overview {
        name: mechanism.name().into(),
        source: mechanism.source().map(str::to_owned),
        coordinates: mechanism.coordinates().map(|made| CoordinatesOverview {
            axes: made.axes.clone(),
            cut: made.cut.clone(),
            rods: made.rods.clone(),
        }),
        parameters: parameters
            .map(|parameter| ParameterOverview {
                name: parameter.name.clone(),
                definition: written(mechanism, &parameter.definition),
                value: parameter.value,
            })
            .collect(),
        joints: joints(mechanism),
        chains: (mechanism.chains().iter())
            .map(|part| chain(mechanism, part))
            .collect(),
        platforms: (mechanism.platforms().iter())
            .map(|part| platform(mechanism, part))
            .collect(),
        closures: (mechanism.closures().iter())
            .map(|part| closure(mechanism, part))
            .collect(),
        loops: loops::loops(mechanism),
        count: count::count(mechanism),
        closed_forms: closed_forms
            .map(|form| {
                let (formulas, pose_of) = match &form.gives {
                    Given::Identities(identities) => (identities.len(), None),
                    Given::Pose {
                        of,
                        relative_to,
                        entries,
                    } => {
                        let names = [*of, *relative_to].map(|f| mechanism.frame_name(f));
                        (entries.len(), Some(names))
                    }
                };
                ClosedFormOverview {
                    name: form.name.clone(),
                    formulas,
                    pose_of,
                    source: form.source.clone(),
                }
            })
            .collect(),
        warnings: (mechanism.warnings().iter())
            .map(|problem| problem.kind.title())
            .collect(),
    }
}

fn joints(mechanism: &Mechanism) -> Vec<JointOverview> {
    let rows = mechanism.chains().iter().flat_map(|chain| &chain.rows);
    let lengths = mechanism
        .closures()
        .iter()
        .filter_map(|c| c.length.as_ref());
    let entries = rows.flat_map(|row| [&row.d, &row.theta]).chain(lengths);
    let used: HashSet<Symbol> = entries
        .flat_map(|entry| entry.terms.iter().map(|(symbol, _)| *symbol))
        .collect();
    let joints = mechanism.joints().iter().enumerate();
    joints
        .map(|(i, part)| joint(part, used.contains(&Symbol::Joint(i))))
        .collect()
}

fn joint(joint: &Joint, used: bool) -> JointOverview {
    let unit = SiUnit::of_coordinate(joint.kind.is_angle());
    let kind = match joint.kind {
        _ if !used => JointUse::Unused,
        JointKind::Revolute => JointUse::Revolute,
        JointKind::Prismatic => JointUse::Prismatic,
        JointKind::Helical => JointUse::Helical,
    };
    JointOverview {
        name: joint.name.clone(),
        kind,
        role: joint.role,
        unit: used.then_some(unit),
        home: joint.home,
        limits: joint.limits,
    }
}

fn chain(mechanism: &Mechanism, chain: &Chain) -> ChainOverview {
    ChainOverview {
        name: chain.name.clone(),
        on: mechanism.frame_name(chain.on),
        convention: chain.convention,
        base: steps(mechanism, &chain.base),
        rows: chain.rows.iter().map(|part| row(mechanism, part)).collect(),
        tip: steps(mechanism, &chain.tip),
    }
}

fn row(mechanism: &Mechanism, row: &Row) -> RowOverview {
    let [alpha, a, d, theta] = row.written.clone();
    let fixed = |written: String, formula: &Formula| EntryOverview {
        written,
        value: value(mechanism, formula),
        uses_parameters: formula.names().next().is_some(),
    };
    let affine = |written: String, affine: &Affine<Symbol>| match affine.terms.is_empty() {
        true => fixed(written, &affine.constant),
        false => EntryOverview {
            written,
            value: None,
            uses_parameters: false,
        },
    };
    RowOverview {
        alpha: fixed(alpha, &row.alpha),
        a: fixed(a, &row.a),
        d: affine(d, &row.d),
        theta: affine(theta, &row.theta),
    }
}

fn platform(mechanism: &Mechanism, platform: &Platform) -> PlatformOverview {
    let Pose { rotation, position } = &platform.home;
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::from_rotation(rotation);
    PlatformOverview {
        name: platform.name.clone(),
        position: position.0,
        quaternion: Quaternion::from_rotation(rotation).canonical().0,
        roll_pitch_yaw: [roll, pitch, yaw],
        frames: (platform.frames.iter())
            .map(|(name, placed)| PlatformFrameOverview {
                name: name.clone(),
                placed: steps(mechanism, placed),
            })
            .collect(),
    }
}

fn closure(mechanism: &Mechanism, closure: &NamedClosure) -> ClosureOverview {
    ClosureOverview {
        name: closure.name.clone(),
        kind: closure.kind,
        frames: closure
            .frames
            .map(|frame: Frame| mechanism.frame_name(frame)),
        length: (closure.length.as_ref()).map(|length| written_affine(mechanism, length)),
        equations: closure.kind.equations(),
    }
}

/// A fixed transform as in the file: `Tx(l2)`.
fn steps(mechanism: &Mechanism, steps: &[FixedStep]) -> Vec<String> {
    let written = |formula: &Formula| written(mechanism, formula);
    let step = |step: &FixedStep| match step {
        FixedStep::Translate(axis, length) => format!("T{}({})", axis.letter(), written(length)),
        FixedStep::Rotate(axis, angle) => format!("R{}({})", axis.letter(), written(angle)),
        FixedStep::TranslateBy(vector) => {
            format!("T({})", vector.each_ref().map(&written).join(", "))
        }
    };
    steps.iter().map(step).collect()
}

fn name(mechanism: &Mechanism, symbol: Symbol) -> String {
    match symbol {
        Symbol::Parameter(i) => mechanism.parameters()[i].name.clone(),
        Symbol::Joint(i) => mechanism.joints()[i].name.clone(),
        Symbol::Local(i) => format!("local{i}"),
    }
}

fn written(mechanism: &Mechanism, formula: &Formula) -> String {
    let named = formula.try_resolve(|&symbol, _| Ok::<_, ()>(name(mechanism, symbol)));
    named.map_or_else(|_| String::new(), |formula| formula.to_string())
}

/// An affine entry put together again: joint variables first, then the constant.
fn written_affine(mechanism: &Mechanism, affine: &Affine<Symbol>) -> String {
    let mut terms: Vec<String> = Vec::new();
    for (symbol, coefficient) in &affine.terms {
        let variable = name(mechanism, *symbol);
        let factor = written(mechanism, coefficient);
        terms.push(match (coefficient.as_number(), &coefficient.node) {
            (Some(1.0), _) => variable,
            (Some(-1.0), _) => format!("-{variable}"),
            (_, Node::Binary(..)) => format!("({factor})*{variable}"),
            _ => format!("{factor}*{variable}"),
        });
    }
    if terms.is_empty() || !affine.constant.is_zero() {
        terms.push(written(mechanism, &affine.constant));
    }
    terms.join(" + ").replace("+ -", "- ")
}

/// The value of a formula over parameters.
fn value(mechanism: &Mechanism, formula: &Formula) -> Option<f64> {
    let value = formula.evaluate(&|&symbol| match symbol {
        Symbol::Parameter(i) => mechanism.parameters()[i].value,
        Symbol::Joint(_) | Symbol::Local(_) => f64::NAN,
    });
    value.ok()
}
