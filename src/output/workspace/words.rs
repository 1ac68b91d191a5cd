//! What is said about a map of the workspace.

use super::{percent, range};
use crate::analysis::workspace::{AspectReport, BoundaryKind, WorkspaceReport};
use crate::description::{count, listed};
use crate::mechanism::{Mechanism, Role};
use crate::output::option::{Complaint, Part};
use crate::output::quantity::{number, quantity};
use crate::system::QuestionError;

/// What is mapped, and what is held.
pub(super) fn question(report: &WorkspaceReport) -> String {
    let axes = report.axes.iter();
    let axes: Vec<String> = axes
        .map(|a| range(&a.name, a.from, a.to, a.unit, a.nodes))
        .collect();
    let held = report.held.iter();
    let held: Vec<String> = held
        .map(|h| format!("{} = {}", h.name, quantity(h.value, h.unit.is_angle())))
        .collect();
    match held.is_empty() {
        true => format!("Map of {}.", listed(&axes)),
        false => format!("Map of {}, with {}.", listed(&axes), listed(&held)),
    }
}

/// A size with its unit.
pub(super) fn area(report: &WorkspaceReport, size: f64) -> String {
    // located to the second order of the grid: four digits are plenty
    let digits = match size {
        0.0 => 0,
        size => (3 - size.abs().log10().floor() as i32).clamp(0, 9),
    };
    let factor = 10f64.powi(digits);
    format!(
        "{} {}",
        number((size * factor).round() / factor),
        report.unit
    )
}

/// What is reached, in a sentence or two.
pub fn sentence(report: &WorkspaceReport) -> String {
    if report.reached == 0 {
        return match report.outside {
            0 => "Nothing in the box is reached.".into(),
            n => format!(
                "Nothing in the box is reached within limits: {} met in the search had a joint outside \
                 them.",
                count(n, "assembled configuration")
            ),
        };
    }
    format!(
        "Within limits {} of {} are reached: {} or {} of the box, in {} with {}.",
        report.reached,
        count(report.nodes, "node"),
        area(report, report.reached_size),
        percent(report.reached_size / report.size),
        count(report.modes.len(), "mode"),
        count(report.aspects.len(), "aspect"),
    )
}

/// What the columns of aspects tell, line by line.
pub(super) fn explanation(report: &WorkspaceReport) -> String {
    let names = |names: &[String]| match names {
        [one] => one.clone(),
        all => format!("({})", all.join(", ")),
    };
    let axes = report.axes.iter().map(|axis| axis.name.clone());
    let held = report.held.iter().map(|held| held.name.clone());
    let coordinates: Vec<String> = axes.chain(held).collect();
    let mut lines: Vec<String> = Vec::new();
    let mut sign = |column: &str, of: &[String], told: bool| {
        if told {
            lines.push(format!(
                "{column}: sign of det ∂{}/∂{}",
                names(of),
                names(&coordinates)
            ));
        }
    };
    let told = |sign: fn(&AspectReport) -> i8| report.aspects.iter().any(|a| sign(a) != 0);
    sign("direct", &report.inputs, told(|a| a.direct));
    sign("inverse", &report.outputs, told(|a| a.inverse));
    if report.outputs.is_empty() {
        lines.push("no inverse singularities are told: it takes as many independent coordinates of platforms as freedoms".into());
    }
    lines.push(match report.inputs.is_empty() {
        true => "no condition and no direct singularities are told: it takes as many actuated joints \
                 as freedoms"
            .into(),
        false => format!(
            "best and worst: condition number of the Jacobian from {} to {}, at nodes, with lengths \
             over {} m",
            listed(&report.inputs),
            match report.outputs.is_empty() {
                true => "what moves".into(),
                false => listed(&report.outputs),
            },
            number(report.normalising_length)
        ),
    });
    lines.iter().map(|line| format!("  {line}\n")).collect()
}

/// How sure the map is.
pub fn completeness(report: &WorkspaceReport) -> String {
    let [nodes, starts] = report.searched;
    let [probed, few] = report.probed;
    let all = if probed == report.nodes { "all " } else { "" };
    let mut text = format!(
        "Modes were sought at {} from {} each and at {all}{} from {few} (seed {}): what none of these \
         led to can be missing, and so can what is smaller than a cell of the grid. Aspects of few \
         nodes were joined with others only where {} of a cell tells that they are. Sizes are those of \
         polygons in the cells: what is as thin as a cell comes out too small.",
        count(nodes, "node"),
        count(starts, "start"),
        count(probed, "node"),
        report.seed,
        if report.parts == 8 {
            "an eighth"
        } else {
            "a quarter"
        }
    );
    if report.unsure > 0 {
        text += &format!(
            " At the ends of {} no sure step led on, as at a node exactly where modes end; such an \
             end counts as half an edge.",
            count(report.unsure, "edge")
        );
    }
    text
}

/// The name of a boundary.
pub(super) fn kind(kind: &BoundaryKind) -> String {
    match kind {
        BoundaryKind::Inverse => "inverse singularity".into(),
        BoundaryKind::Direct => "direct singularity".into(),
        BoundaryKind::Fold => "fold".into(),
        BoundaryKind::Limit { joint, upper } => format!(
            "{} limit of {joint}",
            if *upper { "upper" } else { "lower" }
        ),
    }
}

fn said(title: String, label: &str, help: String) -> Complaint {
    Complaint {
        title,
        label: label.into(),
        help: Some(help),
    }
}

/// A mapped coordinate without a range.
pub fn no_range(name: &str) -> (Complaint, Part) {
    let help = format!(
        "write --map {name}=FROM..TO, e.g. --map {name}=-1..1 or --map {name}=-90deg..90deg"
    );
    (
        said(
            format!("the map of `{name}` has no range"),
            "no range",
            help,
        ),
        Part::WholeValue,
    )
}

/// A range that comes round again.
pub fn more_than_a_turn(name: &str) -> Complaint {
    said(
        format!(
            "the map of `{name}` is wider than a full turn, after which everything comes again"
        ),
        "too wide",
        format!("map a turn, e.g. --map {name}=-180deg..180deg"),
    )
}

/// A box without an inside.
pub fn empty_side(name: &str, _: &str) -> (Complaint, Part) {
    let title = format!("the map is empty: the range of `{name}` does not end above its beginning");
    let help = "write the lower end first; for one value hold it with --hold".to_owned();
    (said(title, "empty", help), Part::WholeValue)
}

/// Nothing mapped, or too much.
pub fn too_many_axes(mechanism: &Mechanism, given: usize) -> Complaint {
    let platforms = mechanism.platforms();
    let joints = mechanism
        .joints()
        .iter()
        .filter(|j| j.role == Role::Actuated);
    let example = match platforms.first() {
        Some(p) => format!("--map {0}.x=-1..1 --map {0}.y=-1..1", p.name),
        None => joints
            .take(2)
            .map(|joint| match joint.kind.is_angle() {
                true => format!("--map {}=-180deg..180deg", joint.name),
                false => format!("--map {}=0..1", joint.name),
            })
            .collect::<Vec<String>>()
            .join(" "),
    };
    match given {
        0 => said(
            "nothing is mapped".into(),
            "",
            format!("say which coordinates, and from where to where, e.g. {example}"),
        ),
        n => said(
            format!("{n} coordinates are mapped, and a map has one, two or three"),
            "",
            "hold the others with --hold".into(),
        ),
    }
}

/// A coordinate that is mapped and held.
pub fn also_held(name: &str) -> (Complaint, Part) {
    let title = format!("`{name}` is both mapped and held");
    (
        said(title, "also held", "give only one of them".into()),
        Part::Name,
    )
}

/// A name where there is no platform.
pub fn no_platform(mechanism: &Mechanism, error: &QuestionError) -> Option<Complaint> {
    let QuestionError::UnknownName {
        name,
        suggestion: None,
    } = error
    else {
        return None;
    };
    if !mechanism.platforms().is_empty() {
        return None;
    }
    let joints = mechanism.joints().iter();
    let joints: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
    Some(said(
        format!("`{name}` is no joint, and the mechanism has no platform"),
        "not known",
        format!(
            "map joints ({}); to map where a link is, give the file a platform that is closed to it \
             by `Rigid`",
            listed(&joints.iter().map(|j| (*j).to_owned()).collect::<Vec<_>>())
        ),
    ))
}

/// More or less is mapped and held than there are freedoms. `missing` are coordinates that would do;
/// where there is no word of its own the question's will do.
pub fn wrong_count(
    error: &QuestionError,
    mapped: &[String],
    missing: &[String],
) -> Option<Complaint> {
    match error {
        QuestionError::TooMany {
            free,
            mobility,
            held,
        } => {
            let away = free.iter().filter(|name| mapped.contains(name)).cloned();
            let away: Vec<String> = away.collect();
            let title = format!(
                "the mechanism has {}, and {} mapped and held",
                count(*mobility, "freedom"),
                are(*held)
            );
            let help = format!("do not map {}: the others determine it", listed(&away));
            (!away.is_empty()).then(|| said(title, "", help))
        }
        QuestionError::TooFew { mobility, held, .. } => {
            let first = missing.first()?;
            let title = format!(
                "the mechanism has {}, and only {} mapped and held",
                count(*mobility, "freedom"),
                are(*held)
            );
            let range = match first.rsplit('.').next() {
                Some("roll" | "pitch" | "yaw") => "-90deg..90deg",
                _ => "-1..1",
            };
            let help = format!(
                "map or hold {} too, e.g. --hold {first}=home or --map {first}={range}",
                listed(missing)
            );
            Some(said(title, "", help))
        }
        QuestionError::Dependent { free, hold } => {
            let (away, rest): (Vec<String>, Vec<String>) =
                free.iter().cloned().partition(|name| mapped.contains(name));
            let mut ways = Vec::new();
            if !away.is_empty() {
                ways.push(format!("do not map {}", listed(&away)));
            }
            if !rest.is_empty() {
                ways.push(format!("do not hold {}", listed(&rest)));
            }
            let title = format!(
                "as much is mapped and held as there are freedoms, but {} cannot be chosen beside \
                 the others, and {} {} undetermined",
                listed(free),
                listed(hold),
                if hold.len() == 1 { "stays" } else { "stay" }
            );
            let help = format!(
                "{}; map or hold {} instead",
                ways.join(" and "),
                listed(hold)
            );
            (!away.is_empty()).then(|| said(title, "", help))
        }
        _ => None,
    }
}

fn are(held: usize) -> String {
    let verb = if held == 1 { "is" } else { "are" };
    format!("{} {verb}", count(held, "coordinate"))
}

/// A grid that is none, or not one for these coordinates.
pub fn wrong_grid(given: &[usize], axes: usize) -> Complaint {
    match given.iter().any(|n| *n < 2) {
        true => said(
            "a grid has at least 2 nodes along each coordinate".into(),
            "",
            "give --grid 50, or a number for each coordinate, e.g. --grid 60,40".into(),
        ),
        false => said(
            format!(
                "{} numbers of nodes are given for {}",
                given.len(),
                count(axes, "mapped coordinate")
            ),
            "",
            "give one for all of them or one for each, e.g. --grid 60,40".into(),
        ),
    }
}

/// A grid that is too fine to be kept.
pub fn too_fine(nodes: f64, bytes: f64, most: f64) -> Complaint {
    said(
        format!(
            "the grid has {} nodes, which in one mode alone take some {} GB",
            number(nodes),
            number((bytes / 1e8).round() / 10.0)
        ),
        "",
        format!(
            "give a coarser --grid: up to {} GB are taken; or map a part of the box at a time",
            number(most / 1e9)
        ),
    )
}

/// More modes than can be kept.
pub fn too_many_cells(cells: usize, most: f64) -> Complaint {
    said(
        format!(
            "{cells} nodes in modes were reached, which take the {} GB that may be taken",
            number(most / 1e9)
        ),
        "",
        "give a coarser --grid, or map a part of the box at a time".into(),
    )
}

/// A boundary of a map with one coordinate is no curve.
pub fn boundary_flat() -> Complaint {
    said(
        "the boundary of a map with one coordinate is points, not curves".into(),
        "",
        "--format json has them as `points`".into(),
    )
}
