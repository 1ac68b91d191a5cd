//! What is said about a motion.

use crate::analysis::sweep::{Ending, InputReport, Met, MetKind, PointError, SweepReport};
use crate::description::{count, listed};
use crate::mechanism::Mechanism;
use crate::output::layout::{align_right, indented};
use crate::output::option::{Complaint, Part};
use crate::output::quantity::{number, quantity};
use crate::output::question::{unknown_frame, value};
use crate::system::QuestionError;

fn at(input: &InputReport, value: f64) -> String {
    format!(
        "{} = {}",
        input.name,
        quantity(value, input.unit.is_angle())
    )
}

/// `theta1 = 60° and l2 = 0.5 m`
fn inputs_at(report: &SweepReport, met: &Met) -> String {
    let inputs = report.inputs.iter().zip(&met.inputs);
    listed(
        &inputs
            .map(|(input, value)| at(input, *value))
            .collect::<Vec<_>>(),
    )
}

/// How a motion ended, in a sentence or two.
pub fn sentence(report: &SweepReport) -> String {
    let last = report.met.last();
    let way: Vec<String> = (report.inputs.iter())
        .map(|input| {
            let value = |x| quantity(x, input.unit.is_angle());
            format!(
                "{} from {} to {}",
                input.name,
                value(input.from),
                value(input.to)
            )
        })
        .collect();
    let way = match way.is_empty() {
        true => "The whole curve".to_owned(),
        false => listed(&way),
    };
    let folds = report
        .met
        .iter()
        .filter(|met| matches!(met.kind, MetKind::Fold { .. }))
        .count();
    let crossings = report
        .met
        .iter()
        .filter(|met| matches!(met.kind, MetKind::Crossing { .. }));
    let crossings = crossings.count();
    let mut through = Vec::new();
    if folds > 0 {
        through.push(format!("round {}", count(folds, "fold")));
    }
    if crossings > 0 {
        through.push(format!("straight through {}", count(crossings, "crossing")));
    }
    let through = match through.is_empty() {
        true => String::new(),
        false => format!(", {}", listed(&through)),
    };
    let place = last.map(|met| inputs_at(report, met)).unwrap_or_default();
    match (report.ending, last.map(|met| &met.kind)) {
        (Ending::Complete, _) if through.is_empty() => {
            format!("{way}: complete, on one branch.")
        }
        (Ending::Complete, _) => format!("{way}: complete{through}."),
        (Ending::Returned, _) => format!(
            "{way}: the end is not reached. The curve comes back to where the inputs began{through}."
        ),
        (Ending::Closed, _) => format!("{way} closes{through}."),
        (Ending::Limits, _) => {
            format!("{way} was followed from limit to limit{through}.")
        }
        (Ending::Fold, Some(MetKind::Fold { locked, moving })) => {
            let verb = if locked.len() == 1 { "locks" } else { "lock" };
            let moving = match moving {
                Some(moving) => format!(
                    "; {moving} moves there while {} not",
                    match locked.len() {
                        1 => "it does",
                        _ => "they do",
                    }
                ),
                None => String::new(),
            };
            let place = match (&report.inputs[..], last.map(|met| &met.inputs[..])) {
                ([input], Some([value])) => quantity(*value, input.unit.is_angle()),
                _ => place,
            };
            format!(
                "{} {verb} at {place}: a dead point, where this branch ends{moving}. With --follow \
                 the motion goes round it, back on the other branch.",
                listed(locked)
            )
        }
        (
            Ending::Limit,
            Some(MetKind::Limit {
                joint,
                limit,
                unit,
                upper,
            }),
        ) => format!(
            "{joint} reaches its {} limit of {}{}.",
            if *upper { "upper" } else { "lower" },
            quantity(*limit, unit.is_angle()),
            match report.inputs.iter().any(|input| input.name == *joint) {
                true => String::new(),
                false => format!(" at {place}"),
            }
        ),
        (Ending::Crossing, Some(MetKind::Crossing { freedoms, branches })) => format!(
            "Branches cross at {place}: there are {} there and {}. Which to take is not for the \
             sweep to choose; with --follow it goes straight on.",
            count(*freedoms, "infinitesimal freedom"),
            match branches.len() {
                1 => "1 branch was found".into(),
                n => format!("{n} branches pass"),
            }
        ),
        (Ending::SingularStart, Some(MetKind::Crossing { branches, .. })) => format!(
            "Branches cross where the motion is to begin, and {}: begin beside it, where it is clear \
             which branch is meant.",
            match branches.len() {
                1 => "1 was found".into(),
                n => format!("{n} pass"),
            }
        ),
        (Ending::SingularStart, _) => {
            "More than one freedom is left where the motion is to begin, so that it is not \
             determined: hold more, or begin elsewhere. `linkwork mobility` names what can move."
                .into()
        }
        (
            Ending::OutsideLimits,
            Some(MetKind::Limit {
                joint,
                limit,
                unit,
                upper,
            }),
        ) => format!(
            "{joint} is outside its {} limit of {} where the motion is to begin: begin elsewhere, or \
             in another mode with --mode.",
            if *upper { "upper" } else { "lower" },
            quantity(*limit, unit.is_angle())
        ),
        (Ending::Stopped, _) => "Stopped before the end.".into(),
        _ => format!(
            "No step is short enough to be sure of the branch beyond {}: the curve ends there in a \
             point of higher order, or bends too sharply.",
            match place.is_empty() {
                true => "the last row".into(),
                false => place,
            }
        ),
    }
}

/// What the motion took.
pub(super) fn work(report: &SweepReport) -> String {
    format!(
        "  {}, {}; length {} in rad and units of {} m\n",
        count(report.rows, "row"),
        count(report.sure_steps, "sure step"),
        number((report.length * 1e3).round() / 1e3),
        number(report.characteristic_length)
    )
}

/// What was met on the way, as a table.
pub(super) fn met(mechanism: &Mechanism, report: &SweepReport) -> String {
    const SHOWN: usize = 24;
    let worth = |met: &&Met| !matches!(met.kind, MetKind::End | MetKind::Closed);
    let all = report.met.iter().filter(worth).count() + report.more_met;
    if all == 0 {
        return String::new();
    }
    let mut table = comfy_table::Table::new();
    table.load_style(comfy_table::presets::NOTHING);
    let names = mechanism.joints().iter().map(|joint| joint.name.clone());
    let first = ["what".to_owned(), "type".to_owned()];
    table.add_row(first.into_iter().chain(names));
    if let Some(first) = table.column_mut(0) {
        first.set_padding((0, 1));
    }
    for met in report.met.iter().filter(worth).take(SHOWN) {
        let what = match &met.kind {
            MetKind::Turning { joint } => format!("{joint} turns back"),
            MetKind::Fold { locked, .. } => format!("dead point of {}", listed(locked)),
            MetKind::Limit { joint, upper, .. } => {
                format!(
                    "{} limit of {joint}",
                    if *upper { "upper" } else { "lower" }
                )
            }
            MetKind::Crossing { branches, .. } => match branches.len() {
                0 | 1 => "branches meet".into(),
                n => format!("{n} branches cross"),
            },
            MetKind::End | MetKind::Closed => String::new(),
        };
        let kind = met
            .singularity
            .map_or(String::new(), |kind| kind.to_string());
        let values = mechanism.joints().iter().zip(&met.joints);
        let values = values.map(|(joint, value)| quantity(*value, joint.kind.is_angle()));
        table.add_row([what, kind].into_iter().chain(values));
    }
    align_right(&mut table, 1..mechanism.joints().len() + 2);
    let more = match all > SHOWN {
        true => format!(", {SHOWN} of {all}"),
        false => String::new(),
    };
    format!(
        "\nMet on the way{more}, with the type of Gosselin and Angeles\n{}",
        indented(&table.to_string())
    )
}

fn complaint(title: String, label: &str, help: String) -> Complaint {
    Complaint {
        title,
        label: label.into(),
        help: Some(help),
    }
}

/// Nothing is said to move.
pub fn what_moves(actuated: Option<&str>) -> Complaint {
    let name = actuated.unwrap_or("NAME");
    complaint(
        "nothing is said to move".into(),
        "",
        format!(
            "give the inputs their ranges, e.g. --input {name}=0deg..360deg; follow the whole curve \
             with --follow; or list circuits with --circuits"
        ),
    )
}

/// A value that is no range.
pub fn no_range(name: &str) -> (Complaint, Part) {
    let said = complaint(
        format!("the input `{name}` has no range"),
        "no range",
        format!("write --input {name}=FROM..TO, e.g. --input {name}=0deg..90deg"),
    );
    (said, Part::WholeValue)
}

/// A range of no length.
pub fn nothing_moves(name: &str, value: &str) -> (Complaint, Part) {
    let said = complaint(
        format!("`{name}` does not move: its range begins where it ends"),
        "no length",
        format!(
            "for one configuration ask `linkwork solve`, with --hold {name}={}",
            quoted(value)
        ),
    );
    (said, Part::WholeValue)
}

fn quoted(value: &str) -> String {
    match value.trim().contains(' ') {
        true => format!("\"{}\"", value.trim()),
        false => value.trim().into(),
    }
}

/// A number of steps that is none.
pub fn no_steps(steps: usize, most: usize, rows_kept: bool) -> Complaint {
    match steps {
        0 => complaint(
            "a motion in no steps has no rows".into(),
            "",
            "give at least one step, e.g. --steps 100; for one configuration ask `linkwork solve`"
                .into(),
        ),
        _ if rows_kept => complaint(
            format!("{steps} steps are too many to keep: up to {most} are"),
            "",
            "write rows as they come with --format csv".into(),
        ),
        _ => complaint(
            format!("{steps} steps are too many: up to {most} are made"),
            "",
            "what happens between them is found without them: dead points and crossings are located \
             exactly"
                .into(),
        ),
    }
}

/// An input that begins outside the limits of its joint.
pub fn outside(name: &str, limits: (f64, f64), is_angle: bool) -> (Complaint, Part) {
    let shown = |x: f64| quantity(x, is_angle);
    let written = |x: f64| match is_angle {
        true => format!("{}deg", number(x.to_degrees())),
        false => number(x),
    };
    let said = complaint(
        format!(
            "the range of `{name}` begins outside its limits, {} to {}",
            shown(limits.0),
            shown(limits.1)
        ),
        "outside",
        format!(
            "sweep within them, e.g. --input {name}={}..{}",
            written(limits.0),
            written(limits.1)
        ),
    );
    (said, Part::WholeValue)
}

/// Not one freedom is left to follow.
pub fn not_one_freedom(error: &QuestionError) -> Complaint {
    match error {
        QuestionError::TooFew {
            mobility,
            held,
            hold,
        } => {
            let left = mobility.saturating_sub(*held);
            let most = hold.len().min(left.saturating_sub(1));
            let options: Vec<String> = hold[..most]
                .iter()
                .map(|name| format!("--hold {name}=home"))
                .collect();
            complaint(
                format!("{} are left, and a curve has one", count(left, "freedom")),
                "",
                format!(
                    "hold {}, e.g. {}; or prescribe the inputs with --input",
                    count(left.saturating_sub(1), "coordinate") + " more",
                    options.join(" ")
                ),
            )
        }
        other => complaint(other.title(), "", "hold other coordinates".into()),
    }
}

/// Nothing is left to move.
pub fn nothing_left(held: &[String]) -> Complaint {
    let (title, help) = match held.is_empty() {
        true => (
            "the mechanism has no freedom, so that there is no motion to follow".to_owned(),
            "ask `linkwork mobility` why it cannot move".to_owned(),
        ),
        false => (
            format!("with {} held no freedom is left to follow", listed(held)),
            "hold one less".to_owned(),
        ),
    };
    complaint(title, "", help)
}

/// What is wrong with a traced point.
pub fn point_complaint(mechanism: &Mechanism, error: &PointError) -> (Complaint, Part) {
    match error {
        PointError::NoFrame(name) => unknown_frame(mechanism, name),
        PointError::Value { text, error } => {
            let (said, _) = value(text, error);
            (said, Part::Name)
        }
        PointError::TooMany(given) => {
            let said = complaint(
                format!("a point has three offsets from its frame, and {given} are given"),
                "too many",
                "write FRAME+X,Y,Z, e.g. --of left+0.5,0.2,0".into(),
            );
            (said, Part::Name)
        }
    }
}
