//! Overview of a mechanism file, part by part.

mod count;
mod loops;
mod report;

use std::collections::HashSet;

pub use count::{MobilityCount, PlanarCount};
pub use loops::{Loop, LoopStep};
pub use report::*;

use crate::algebra::{Affine, Node, SiUnit};
use crate::description::AxisKind;
use crate::geometry::{Pose, Quaternion, RollPitchYaw};
use crate::mechanism::{
    Body, Chain, ChainRow, ClosureKind, FixedStep, Formula, Frame, GivenForm, JointKind, Mechanism,
    NamedClosure, Platform, Symbol,
};

/// Lists the parts of a mechanism, with its loops and the count of its freedoms.
pub fn overview(mechanism: &Mechanism) -> Overview {
    let parameters = mechanism.parameters().iter();
    let [own_chains, _] = mechanism.own_parts();
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
                name: parameter.name.to_string(),
                definition: written(mechanism, &parameter.definition),
                value: parameter.value,
            })
            .collect(),
        joints: joints(mechanism),
        chains: (mechanism.chains()[..own_chains].iter())
            .map(|part| chain(mechanism, part))
            .collect(),
        bodies: bodies(mechanism),
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
                    GivenForm::Identities(identities) => (identities.len(), None),
                    GivenForm::Pose {
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
    let closures = mechanism.closures().iter();
    let lengths = closures.filter_map(|closure| closure.length.as_ref());
    let entries = rows.flat_map(|row| [&row.d, &row.theta]).chain(lengths);
    let related = mechanism.closures().iter().flat_map(|of| &of.relation);
    let related = related.flat_map(|formula| formula.names().map(|(symbol, _)| *symbol));
    let used: HashSet<Symbol> = entries
        .flat_map(|entry| entry.terms.iter().map(|(symbol, _)| *symbol))
        .chain(related)
        .collect();
    let joints = mechanism.joints().iter().enumerate().map(|(i, joint)| {
        let used = used.contains(&Symbol::Joint(i));
        JointOverview {
            name: joint.name.clone(),
            kind: match joint.kind {
                _ if !used => JointUse::Unused,
                JointKind::Revolute => JointUse::Revolute,
                JointKind::Prismatic => JointUse::Prismatic,
                JointKind::Helical if is_screw(mechanism, &joint.name) => JointUse::Helical,
                JointKind::Helical => JointUse::Revolute,
            },
            role: joint.role,
            unit: used.then_some(SiUnit::of_coordinate(joint.kind.is_angle())),
            home: joint.home,
            limits: joint.limits,
        }
    });
    joints.collect()
}

/// True if a variable that turns something and slides something is that of a screw: gears with racks have such too.
fn is_screw(mechanism: &Mechanism, name: &str) -> bool {
    let given = mechanism.coordinates().map(|made| &made.axes.joints);
    let given = given.and_then(|joints| joints.iter().find(|joint| joint.name.value == name));
    given.is_none_or(|joint| joint.value.kind == AxisKind::Helical)
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

fn row(mechanism: &Mechanism, row: &ChainRow) -> RowOverview {
    let [alpha, a, d, theta, beta] = row.written.clone();
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
        beta: (!row.beta.is_zero()).then(|| fixed(beta, &row.beta)),
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
    let (kind, frames) = closure.written();
    ClosureOverview {
        name: closure.name.clone(),
        kind,
        frames: frames.map(|frame| mechanism.frame_name(frame)),
        length: (closure.length.as_ref()).map(|length| written_affine(mechanism, length)),
        equations: kind.equations(),
    }
}

/// The bodies with what joins them, and with the tips of chains and the frames of platforms on them.
fn bodies(mechanism: &Mechanism) -> Vec<BodyOverview> {
    let bodies = mechanism.bodies().into_iter();
    let mut known: Vec<(Body, BodyOverview)> = (bodies.filter(|body| !mechanism.is_added(*body)))
        .map(|body| {
            let overview = BodyOverview {
                name: mechanism.body_name(body),
                joints: Vec::new(),
                frames: Vec::new(),
            };
            (body, overview)
        })
        .collect();
    let mut joined = |of: Body, by: &str| {
        let found = known.iter_mut().find(|(body, _)| *body == of);
        if let Some((_, body)) = found.filter(|(_, body)| body.joints.iter().all(|one| one != by)) {
            body.joints.push(by.to_owned());
        }
    };
    let [own_chains, _] = mechanism.own_parts();
    for (chain, part) in mechanism.chains()[..own_chains].iter().enumerate() {
        let mut below = mechanism.body(part.on);
        for (i, row) in part.rows.iter().enumerate() {
            let body = mechanism.body(Frame::Link { chain, row: i + 1 });
            for joint in row.joints() {
                let joint = &mechanism.joints()[joint].name;
                joined(below, joint);
                joined(body, joint);
            }
            below = body;
        }
    }
    let closures = mechanism.closures().iter();
    for closure in closures.filter(|closure| closure.kind != ClosureKind::Coupling) {
        let (_, frames) = closure.written();
        for frame in frames {
            joined(mechanism.body(frame), &closure.name);
        }
    }
    for frame in mechanism.frames() {
        let own = match frame {
            Frame::Tip { chain } => chain < own_chains,
            Frame::OnPlatform { .. } => true,
            _ => false,
        };
        let name = mechanism.frame_name(frame);
        let found = known
            .iter_mut()
            .find(|(of, _)| *of == mechanism.body(frame));
        if let (true, Some((_, body))) = (own && mechanism.is_given(&name), found)
            && body.name != name
        {
            body.frames.push(name);
        }
    }
    known.into_iter().map(|(_, body)| body).collect()
}

/// A fixed transform as in the file: `Tx(l2)`.
fn steps(mechanism: &Mechanism, steps: &[FixedStep]) -> Vec<String> {
    let written = |formula: &Formula| written(mechanism, formula);
    let step = |step: &FixedStep| {
        let entries: Vec<String> = step.entries().iter().map(written).collect();
        format!("{}({})", step.word(), entries.join(", "))
    };
    steps.iter().map(step).collect()
}

fn name(mechanism: &Mechanism, symbol: Symbol) -> String {
    match symbol {
        Symbol::Parameter(i) => mechanism.parameters()[i].name.to_string(),
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
