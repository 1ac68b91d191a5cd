//! Maps that cannot be made: what to ask instead.

use linkwork::description::{count, listed};
use linkwork::mechanism::{Mechanism, Role};
use linkwork::output::complaint::{Complaint, Part};
use linkwork::output::quantity::number;
use linkwork::system::QuestionError;

/// A mapped coordinate without a range.
pub fn no_range(name: &str) -> Complaint {
    let help = format!(
        "write --map {name}=FROM..TO, e.g. --map {name}=-1..1 or --map {name}=-90deg..90deg"
    );
    Complaint::with_help(
        format!("the map of `{name}` has no range"),
        "no range",
        help,
    )
    .at(Part::WholeValue)
}

/// A range that comes round again.
pub fn more_than_a_turn(name: &str) -> Complaint {
    Complaint::with_help(
        format!(
            "the map of `{name}` is wider than a full turn, after which everything comes again"
        ),
        "too wide",
        format!("map a turn, e.g. --map {name}=-180deg..180deg"),
    )
}

/// A box without an inside.
pub fn empty_side(name: &str, _: &str) -> Complaint {
    let title = format!("the map is empty: the range of `{name}` does not end above its beginning");
    let help = "write the lower end first; for one value hold it with --hold".to_owned();
    Complaint::with_help(title, "empty", help).at(Part::WholeValue)
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
        0 => Complaint::with_help(
            "nothing is mapped".into(),
            "",
            format!("say which coordinates, and from where to where, e.g. {example}"),
        ),
        n => Complaint::with_help(
            format!("{n} coordinates are mapped, and a map has one, two or three"),
            "",
            "hold the others with --hold".into(),
        ),
    }
}

/// A coordinate that is mapped and held.
pub fn also_held(name: &str) -> Complaint {
    let title = format!("`{name}` is both mapped and held");
    Complaint::with_help(title, "also held", "give only one of them".into())
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
    Some(Complaint::with_help(
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
            (!away.is_empty()).then(|| Complaint::with_help(title, "", help))
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
            Some(Complaint::with_help(title, "", help))
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
            (!away.is_empty()).then(|| Complaint::with_help(title, "", help))
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
        true => Complaint::with_help(
            "a grid has at least 2 nodes along each coordinate".into(),
            "",
            "give --grid 50, or a number for each coordinate, e.g. --grid 60,40".into(),
        ),
        false => Complaint::with_help(
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
    Complaint::with_help(
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
    Complaint::with_help(
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
    Complaint::with_help(
        "the boundary of a map with one coordinate is points, not curves".into(),
        "",
        "--format json has them as `points`".into(),
    )
}
