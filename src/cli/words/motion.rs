//! Questions about motions that cannot be answered: what to ask instead.

use super::question::{quoted, unknown_frame, value};
use linkwork::analysis::sweep::PointError;
use linkwork::description::{count, listed};
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::{Complaint, Part};
use linkwork::output::quantity::{number, quantity};
use linkwork::system::QuestionError;

/// Nothing is said to move.
pub fn what_moves(actuated: Option<&str>) -> Complaint {
    let name = actuated.unwrap_or("NAME");
    Complaint::with_help(
        "no input moves".into(),
        "",
        format!(
            "give the inputs their ranges, e.g. --input {name}=0deg..360deg; follow the whole curve \
             with --follow; or list circuits with --circuits"
        ),
    )
}

/// A value that is no range.
pub fn no_range(name: &str) -> Complaint {
    let said = Complaint::with_help(
        format!("the input `{name}` has no range"),
        "no range",
        format!("write --input {name}=FROM..TO, e.g. --input {name}=0deg..90deg"),
    );
    said.at(Part::WholeValue)
}

/// A range of no length.
pub fn nothing_moves(name: &str, value: &str) -> Complaint {
    let said = Complaint::with_help(
        format!("`{name}` does not move: its range begins where it ends"),
        "no length",
        format!(
            "for one configuration ask `linkwork solve`, with --hold {name}={}",
            quoted(value.trim())
        ),
    );
    said.at(Part::WholeValue)
}

/// A number of steps that is none.
pub fn no_steps(steps: usize, most: usize, rows_kept: bool) -> Complaint {
    match steps {
        0 => Complaint::with_help(
            "a motion in no steps has no rows".into(),
            "",
            "give at least one step, e.g. --steps 100; for one configuration ask `linkwork solve`"
                .into(),
        ),
        _ if rows_kept => Complaint::with_help(
            format!("{steps} steps are too many to keep: up to {most} are"),
            "",
            "write rows as they come with --format csv".into(),
        ),
        _ => Complaint::with_help(
            format!("{steps} steps are too many: up to {most} are made"),
            "",
            "dead points and crossings between the rows are located exactly, however long the steps are"
                .into(),
        ),
    }
}

/// An input that begins outside the limits of its joint.
pub fn outside(name: &str, limits: (f64, f64), is_angle: bool) -> Complaint {
    let shown = |x: f64| quantity(x, is_angle);
    let written = |x: f64| match is_angle {
        true => format!("{}deg", number(x.to_degrees())),
        false => number(x),
    };
    let said = Complaint::with_help(
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
    said.at(Part::WholeValue)
}

/// Not one freedom is left to follow.
pub fn not_one_freedom(error: &QuestionError, hold_at: &dyn Fn(&[String]) -> String) -> Complaint {
    match error {
        QuestionError::TooFew {
            mobility,
            held,
            hold,
        } => {
            let left = mobility.saturating_sub(*held);
            let most = hold.len().min(left.saturating_sub(1));
            Complaint::with_help(
                format!("{} remain, but a curve has one", count(left, "freedom")),
                "",
                format!(
                    "hold {}, e.g. {}; or prescribe the inputs with --input",
                    count(left.saturating_sub(1), "coordinate") + " more",
                    hold_at(&hold[..most])
                ),
            )
        }
        other => Complaint::with_help(other.title(), "", "hold other coordinates".into()),
    }
}

/// Nothing is left to move.
pub fn nothing_left(held: &[String]) -> Complaint {
    let (title, help) = match held.is_empty() {
        true => (
            "the mechanism has no freedom, so there is no motion to follow".to_owned(),
            "`linkwork mobility` shows why it cannot move".to_owned(),
        ),
        false => (
            format!("with {} held no freedom remains", listed(held)),
            "hold one coordinate less".to_owned(),
        ),
    };
    Complaint::with_help(title, "", help)
}

/// What is wrong with a traced point.
pub fn point_complaint(mechanism: &Mechanism, error: &PointError) -> Complaint {
    match error {
        PointError::NoFrame(name) => unknown_frame(mechanism, name),
        PointError::Value { text, error } => value(text, error).at(Part::Name),
        PointError::TooMany(given) => Complaint::with_help(
            format!("a point has three offsets from its frame, and {given} are given"),
            "too many",
            "write FRAME+X,Y,Z, e.g. --of left+0.5,0.2,0".into(),
        ),
    }
}
