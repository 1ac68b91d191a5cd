//! Messages for questions that have no answer as posed, with the options that would put them right. The library says
//! what is wrong; only this module names options.

pub mod question;

use linkwork::ask::{AskError, Role, TableError, TableErrorKind, Unmeasured};
use linkwork::description::{count, listed};
use linkwork::mechanism::{self, Mechanism};
use linkwork::output::complaint::{Complaint, Given, Part};
use linkwork::output::quantity::number;
use linkwork::system::QuestionError;

use super::words::question::{
    driven_complaint, frame_names, load_complaint, meant, no_point, no_quantity, quoted,
};

/// Use of ranges, which decides the words.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Ranged {
    Input,
    Locus,
    Map,
    Vary,
}

impl Ranged {
    pub fn option(self) -> &'static str {
        match self {
            Ranged::Input => "--input",
            Ranged::Locus => "--locus",
            Ranged::Map => "--map",
            Ranged::Vary => "--vary",
        }
    }
}

const ONE_OF_THEM: &str = "give only one of them";
const COARSER: &str = "give a coarser --grid, or map a part of the box at a time";

/// The error in a question, and the part of its option that it is in, if it is in one. `hold_released` writes
/// the options that hold coordinates beside free inputs.
pub fn complaint(
    mechanism: &Mechanism,
    ranged: Ranged,
    error: &AskError,
    given: Option<Given>,
    hold_released: &dyn Fn(&[String]) -> String,
) -> Complaint {
    let said = Complaint::new(error.to_string());
    let written = given.and_then(|given| given.value).unwrap_or_default();
    let option = |other| given.map_or(other, |given| given.option);
    match error {
        AskError::Named(item, error) => {
            let said = question::complaint(error);
            let (first, end) = (written.find("..").unwrap_or(written.len()), written.len());
            match item.role {
                Role::From => said.at(Part::Value(0..first)),
                Role::To => said.at(Part::Value((first + 2).min(end)..end)),
                _ => said,
            }
        }
        AskError::Question(error) => question::complaint(error),
        AskError::NotMapped(_, error) => question::complaint(error),
        AskError::Mapped {
            error,
            mapped,
            missing,
        } => wrong_count(error, mapped, missing).unwrap_or_else(|| question::complaint(error)),
        AskError::Drive(_, error) => driven_complaint(error, option("--rate")),
        AskError::Load(_, error) => load_complaint(mechanism, error, option("--load")),
        AskError::Motionless { .. } => said.label("stands still").help(
            "follow a frame of a link or of a platform, e.g. the tip of a chain by its name",
        ),
        AskError::UnknownOutput(_, name) => {
            let joints = mechanism.joints().iter().map(|joint| joint.name.clone());
            let known: Vec<String> = frame_names(mechanism).chain(joints).collect();
            said.label("not known").help(meant(name, &known, || {
                "an output is a joint, a platform coordinate such as `top.x`, a frame, or a point \
                 such as `left+0.5,0.2`"
                    .into()
            }))
        }
        AskError::Point(_, error) => no_point(mechanism, error),
        AskError::Quantity { text, error, .. } => no_quantity(mechanism, text, error),
        AskError::Unmeasured { error, .. } => match error {
            Unmeasured::NoInput => said.label("nothing moves").help(match ranged {
                Ranged::Vary => "give the rate of what moves, e.g. --rate NAME=1",
                _ => "move an input, e.g. --input NAME=0deg..360deg, or report positions and angles only",
            }),
            Unmeasured::NotHeld { held, .. } => said.label("not held").help(match held.is_empty() {
                true => "only inputs and held coordinates have a force".into(),
                false => format!("report the force that holds one of {}", listed(held)),
            }),
            Unmeasured::NoLoad => said
                .label("no load")
                .help("give a load with --wrench FRAME=Fx,Fy,Fz or --load JOINT=FORCE"),
            Unmeasured::NotSquare { .. } => said.label("not square").help(
                "report `manipulability`, the product of its singular values, which is the size of the \
                 determinant of a square one",
            ),
        },
        AskError::Duration(_) => said.help("give a time in s, e.g. --duration 2"),
        AskError::EmptyRange(_, name) => said.label("empty").at(Part::WholeValue).help(
            match ranged {
                Ranged::Input => {
                    let from = written.split("..").next().unwrap_or_default();
                    let from = quoted(from.trim());
                    format!("for one configuration use `linkwork solve` with --hold {name}={from}")
                }
                Ranged::Locus | Ranged::Map | Ranged::Vary => {
                    "write the lower end first; for one value hold it with --hold".into()
                }
            },
        ),
        AskError::OutsideLimits {
            name,
            limits,
            is_angle,
            ..
        } => {
            let written = |x: f64| match is_angle {
                true => format!("{}deg", number(x.to_degrees())),
                false => number(x),
            };
            let (low, high) = (written(limits.0), written(limits.1));
            let help = format!("sweep within them, e.g. --input {name}={low}..{high}");
            said.label("outside").at(Part::WholeValue).help(help)
        }
        AskError::AlsoHeld { .. } => said.label("also held").help(ONE_OF_THEM),
        AskError::MoreThanATurn(name) => {
            said.help(format!("one turn covers all values, e.g. {name}=-180deg..180deg"))
        }
        AskError::TooManyTurns { name, .. } => {
            let help = format!("a motion repeats after few turns, often after one: --input {name}=0deg..360deg");
            said.label("too far").at(Part::WholeValue).help(help)
        }
        AskError::NothingMoves(driven) => {
            let name = driven.as_deref().unwrap_or("NAME");
            said.help(format!(
                "give the inputs their ranges, e.g. --input {name}=0deg..360deg; follow the whole curve \
                 with --follow; or list circuits with --circuits"
            ))
        }
        AskError::NotOneCoordinate => said.help("move the inputs with --input"),
        AskError::Steps { given, most } => steps(*given, *most, false),
        AskError::Starts { most, .. } => said.help(match ranged {
            Ranged::Map => format!("give --starts and --search from 1 to {most}"),
            Ranged::Input | Ranged::Locus | Ranged::Vary => format!("give --starts from 1 to {most}"),
        }),
        AskError::NothingLeft(held) => said.help(match held.is_empty() {
            true => "`linkwork mobility` shows why it cannot move",
            false => "hold one coordinate less",
        }),
        AskError::NotOneFreedom(error) => match error {
            QuestionError::TooFew {
                mobility,
                held,
                hold,
            } => {
                let more = mobility.saturating_sub(held + 1);
                let most = hold.len().min(more);
                said.help(format!(
                    "hold {} more, e.g. {}; or prescribe the inputs with `linkwork sweep --input`",
                    count(more, "coordinate"),
                    hold_released(&hold[..most])
                ))
            }
            _ => said.help("hold other coordinates"),
        },
        AskError::NotAssembled { .. } => said.help("`linkwork solve` shows the closest approach"),
        AskError::NothingToDrive => said.help(
            "hold the driven joints with --hold; `linkwork mobility` shows whether a mechanism without \
             freedoms is infinitesimally flexible",
        ),
        AskError::Sides(given) => said.help(format!(
            "give --locus twice, e.g. --locus a=0..1 --locus b=0..1; {}",
            match given {
                1 => "for singularities along one coordinate use --input NAME=FROM..TO",
                _ => "hold the others with --hold",
            }
        )),
        AskError::Axes(0) => {
            let help = "give the coordinates and their ranges, e.g.";
            said.help(format!("{help} {}", mappable(mechanism)))
        }
        AskError::Axes(_) => said.help("hold the others with --hold"),
        AskError::Spinning(_) => said.help(
            "a locus needs a unique motion, and these links have no joint of their own that could be held: \
             write legs between two ball joints as `Distance` closures",
        ),
        AskError::Grid { .. } => {
            said.help("give one number for all coordinates or one for each, e.g. --grid 60,40")
        }
        AskError::TooFine { .. } | AskError::TooMany { .. } => said.help(COARSER),
        AskError::TooLarge { .. } => said.help("analyse a part of it"),
        _ => said,
    }
}

pub fn no_range(ranged: Ranged, name: &str) -> Complaint {
    let option = ranged.option();
    let help = format!(
        "write {option} {name}=FROM..TO, e.g. {option} {name}=0deg..90deg or {option} {name}=-1..1"
    );
    let said = Complaint::new(format!("`{name}` has no range")).label("no range");
    said.at(Part::WholeValue).help(help)
}

/// A number of steps that is none, or too many.
pub fn steps(given: usize, most: usize, rows_kept: bool) -> Complaint {
    match given {
        0 => Complaint::new("a motion needs at least one step").help(
            "for example --steps 100; for one configuration use `linkwork solve`",
        ),
        _ if rows_kept => Complaint::new(format!(
            "{given} steps are too many to keep in memory: at most {most} are possible"
        ))
        .help("write rows as they come with --format csv"),
        _ => Complaint::new(format!("{given} steps are too many: at most {most} are possible")).help(
            "dead points and crossings between the rows are located exactly, however long the steps are",
        ),
    }
}

pub fn no_boundary(axes: usize) -> Complaint {
    match axes {
        1 => Complaint::new("the boundary of a map with one coordinate is points, not curves")
            .help("--format json has them as `points`"),
        _ => Complaint::new("--boundary chooses the rows of --format csv")
            .help("add --format csv, or leave --boundary out: --format json has boundaries too"),
    }
}

fn mappable(mechanism: &Mechanism) -> String {
    if let Some(platform) = mechanism.platforms().first() {
        return format!("--map {0}.x=-1..1 --map {0}.y=-1..1", platform.name);
    }
    let driven = |joint: &&mechanism::Joint| joint.role == mechanism::Role::Actuated;
    let joints = mechanism.joints().iter().filter(driven).take(2);
    let options = joints.map(|joint| match joint.kind.is_angle() {
        true => format!("--map {}=-180deg..180deg", joint.name),
        false => format!("--map {}=0..1", joint.name),
    });
    options.collect::<Vec<String>>().join(" ")
}

/// More or less is mapped and held than there are freedoms. `missing` are coordinates that would do. Nothing where the
/// question's own words will do.
fn wrong_count(error: &QuestionError, mapped: &[String], missing: &[String]) -> Option<Complaint> {
    let is_mapped = |name: &String| mapped.contains(name);
    match error {
        QuestionError::TooMany { free, .. } => {
            let away: Vec<String> = free.iter().filter(|n| is_mapped(n)).cloned().collect();
            let help = format!("do not map {}: the others determine it", listed(&away));
            (!away.is_empty()).then(|| Complaint::new(error.title()).help(help))
        }
        QuestionError::TooFew { .. } => {
            let first = missing.first()?;
            let range = match first.rsplit('.').next() {
                Some("roll" | "pitch" | "yaw") => "-90deg..90deg",
                _ => "-1..1",
            };
            let help = format!(
                "map or hold {} too, e.g. --hold {first}=home or --map {first}={range}",
                listed(missing)
            );
            Some(Complaint::new(error.title()).help(help))
        }
        QuestionError::Dependent { free, hold } => {
            let (away, rest): (Vec<String>, Vec<String>) =
                free.iter().cloned().partition(|name| is_mapped(name));
            let mut ways = vec![format!("do not map {}", listed(&away))];
            if !rest.is_empty() {
                ways.push(format!("do not hold {}", listed(&rest)));
            }
            let ways = ways.join(" and ");
            let help = format!("{ways}; map or hold {} instead", listed(hold));
            (!away.is_empty()).then(|| Complaint::new(error.title()).help(help))
        }
        _ => None,
    }
}

pub fn table(path: &std::path::Path, error: &TableError) -> Complaint {
    let said = Complaint::new(format!("{}:{error}", path.display()));
    said.help(match &error.kind {
        TableErrorKind::Csv(_) => {
            "write comma-separated values, in the first line `time (s)` and the inputs".into()
        }
        TableErrorKind::NoTime(_) => "begin with a column `time (s)`".into(),
        TableErrorKind::Unknown { suggestion, .. } => match suggestion {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => "name joints or coordinates, with their units, e.g. `theta1 (deg)`".into(),
        },
        TableErrorKind::Twice(_) => "give each input one column".into(),
        TableErrorKind::Gap(_) => {
            "give every row a value in every column, or leave the row out".into()
        }
        TableErrorKind::Extra(_) => "leave it out, or name its column in the first line".into(),
        TableErrorKind::Number(_) => {
            "write a number, such as 0.5 or 1e-3, in the unit of the column".into()
        }
        TableErrorKind::Value(error) => {
            let said = question::complaint(error);
            said.help
                .unwrap_or_else(|| "write a number in the unit of the column".into())
        }
        TableErrorKind::Unsorted { .. } => "sort the rows by time, with each time once".into(),
        TableErrorKind::Still => "give the values at two times at least".into(),
    })
}
