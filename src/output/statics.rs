//! The forces in a mechanism, as text and as JSON.

use std::fmt::Write;

use serde::Serialize;

use super::closing;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::option::{Complaint, Part};
use super::quantity::{number, size};
use super::question::{driven_complaint, unknown_frame};
use crate::analysis::statics::{Force, Reaction, StaticsReport};
use crate::description::count;
use crate::description::listed;
use crate::mechanism::Mechanism;
use crate::system::LoadError;

/// The report as JSON: the fields of [`StaticsReport`] after one sentence.
pub fn json(mechanism: &Mechanism, report: &StaticsReport) -> String {
    #[derive(Serialize)]
    struct StaticsJson<'a> {
        sentence: String,
        #[serde(flatten)]
        report: &'a StaticsReport,
    }
    let json = StaticsJson {
        sentence: sentence(report),
        report,
    };
    document(mechanism.name(), &json)
}

/// The answer in one or two sentences.
fn sentence(report: &StaticsReport) -> String {
    match report.gained {
        0 => balance(report),
        gained => format!(
            "Singular: {} gained that nothing held resists. {}",
            count(gained, "freedom"),
            balance(report)
        ),
    }
}

fn balance(report: &StaticsReport) -> String {
    if !report.unbalanced.is_empty() {
        return format!(
            "Not in equilibrium: nothing held resists the load along a motion of {}; the forces \
             shown come nearest.",
            listed(&report.unbalanced)
        );
    }
    if report.loads.is_empty() && report.joint_loads.is_empty() {
        return "No load: all forces are zero.".into();
    }
    match report.self_stresses {
        0 => "In equilibrium; all forces are determined.".into(),
        stresses => format!(
            "In equilibrium, but not uniquely: {} without load can be added; what is marked * is \
             the minimum-norm choice.",
            count(stresses, "state of stress").replace("state of stresss", "states of stress")
        ),
    }
}

/// The report as text.
pub fn text(mechanism: &Mechanism, report: &StaticsReport) -> String {
    let mut heading = format!("{}\n{}\n", mechanism.name(), sentence(report));
    let _ = writeln!(
        heading,
        "  without weight and friction; condition number {}, forces times {} m beside moments",
        size(report.condition),
        number(report.normalising_length)
    );
    if let Some(gap) = &report.given_gap {
        let _ = writeln!(heading, "  {}", closing::given(gap, report.kept));
    }
    let mut sections = vec![heading];
    if !report.loads.is_empty() {
        let mut table = plain([
            "on",
            "Fx (N)",
            "Fy (N)",
            "Fz (N)",
            "Mx (N·m)",
            "My (N·m)",
            "Mz (N·m)",
        ]);
        for load in &report.loads {
            let [x, y, z] = load.force.map(number);
            let [a, b, c] = load.moment.map(number);
            table.add_row([&load.frame, &x, &y, &z, &a, &b, &c]);
        }
        align_right(&mut table, 1..7);
        sections.push(format!(
            "Loads, at the frame's origin\n{}",
            indented(&table.to_string())
        ));
    }
    if !report.joint_loads.is_empty() {
        sections.push(format!("Loads on joints\n{}", forces(&report.joint_loads)));
    }
    if !report.actuators.is_empty() {
        let title = "Held, with the force that holds it";
        sections.push(format!("{title}\n{}", forces(&report.actuators)));
    }
    if !report.closures.is_empty() {
        let title =
            "Closures, axes of ground, moments about the point given, that of the second frame";
        sections.push(format!(
            "{title}\n{}",
            reactions(&report.closures, report.normalising_length)
        ));
    }
    if !report.joints.is_empty() {
        let title = "Joints, axes of ground, moments about the point given, the origin of the frame after the joint";
        sections.push(format!(
            "{title}\n{}",
            reactions(&report.joints, report.normalising_length)
        ));
    }
    sections.join("\n")
}

fn mark(unique: bool) -> &'static str {
    if unique { "" } else { "*" }
}

fn forces(forces: &[Force]) -> String {
    let mut table = plain(["name", "force"]);
    for force in forces {
        let value = format!(
            "{}{} {}",
            number(force.force),
            mark(force.unique),
            force.unit
        );
        table.add_row([&force.name, &value]);
    }
    align_right(&mut table, [1]);
    indented(&table.to_string())
}

fn reactions(reactions: &[Reaction], length: f64) -> String {
    let header = [
        "",
        "from",
        "on",
        "at (m)",
        "Fx (N)",
        "Fy (N)",
        "Fz (N)",
        "Mx (N·m)",
        "My (N·m)",
        "Mz (N·m)",
    ];
    let mut table = plain(header);
    for reaction in reactions {
        let name = match reaction.variables.is_empty() {
            true => reaction.name.clone(),
            false => reaction.variables.join(" "),
        };
        let clean = |x: f64| if x.abs() < 1e-9 * length { 0.0 } else { x };
        let point = reaction.point.map(|x| number(clean(x)));
        let point = format!("({})", point.join(", "));
        let mut row = vec![name, reaction.from.clone(), reaction.on.clone(), point];
        let values = reaction.force.iter().chain(&reaction.moment);
        let values = values.zip(reaction.unique);
        row.extend(values.map(|(&value, unique)| number(value) + mark(unique)));
        table.add_row(row);
    }
    align_right(&mut table, 4..10);
    indented(&table.to_string())
}

/// What is wrong with a load.
pub fn complaint(mechanism: &Mechanism, error: &LoadError, option: &str) -> (Complaint, Part) {
    let (title, label, help, part) = match error {
        LoadError::Value(error) => {
            let (complaint, part) = driven_complaint(error, option);
            // of several components the wrong one is not known here
            let part = match part {
                Part::Value(_) if option == "--wrench" => Part::WholeValue,
                part => part,
            };
            return (complaint, part);
        }
        LoadError::UnknownFrame { name } => return unknown_frame(mechanism, name),
        LoadError::OnGround { name, instead } => (
            format!("`{name}` does not move: the ground carries any wrench"),
            "on the ground",
            Some(format!(
                "load a body that moves, such as {}",
                listed(instead)
            )),
            Part::Name,
        ),
        LoadError::Components { given } => (
            format!("a wrench has three or six components, not {given}"),
            "",
            Some("write Fx,Fy,Fz in N, or Fx,Fy,Fz,Mx,My,Mz with N·m".to_owned()),
            Part::WholeValue,
        ),
        LoadError::UnknownJoint {
            name,
            suggestion,
            known,
        } => (
            format!("`{name}` is not a joint"),
            "not known",
            Some(match (suggestion, known.is_empty()) {
                (Some(meant), _) => format!("did you mean `{meant}`?"),
                (None, false) => format!("the joints are {}", listed(known)),
                (None, true) => "there are no joints: load a frame with --wrench".into(),
            }),
            Part::Name,
        ),
        LoadError::Platform {
            name,
            platform,
            component,
        } => {
            let mut example = ["0"; 6];
            example[component.unwrap_or(2)] = "1";
            let given = match component {
                Some(3..) => 6,
                _ => 3,
            };
            (
                format!("`{name}` is not a joint: a platform is loaded by a wrench"),
                "not a joint",
                Some(format!(
                    "give force and moment on it in ground, e.g. --wrench {platform}={}",
                    example[..given].join(",")
                )),
                Part::Name,
            )
        }
    };
    let complaint = Complaint {
        title,
        label: label.into(),
        help,
    };
    (complaint, part)
}
