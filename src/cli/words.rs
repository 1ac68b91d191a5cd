//! The words of the command line: its options, and what is wrong with those that no other door has.

use linkwork::ask::{Demand, Remedy, Role, TableError, TableErrorKind};
use linkwork::output::complaint::{Complaint, Door, OptionPart, Ranged, Wording, suggested};

/// Demands, settings and analyses as options and commands.
#[derive(Default)]
pub struct Options {
    /// Roles whose option has another name than the role.
    pub spelled: Vec<(Role, &'static str)>,
}

impl Door for Options {
    fn option(&self, role: Role, ranged: Ranged) -> String {
        let spelled = self.spelled.iter().rfind(|(of, _)| *of == role);
        let word = match (spelled, role) {
            (Some((_, word)), _) => word,
            (None, Role::Input) => range_word(ranged),
            (None, role) => role.word(),
        };
        format!("--{word}")
    }

    fn remedies(&self, remedies: &[Remedy], ranged: Ranged) -> String {
        let words = remedies.iter().map(|remedy| match remedy {
            Remedy::Demand(demand) => {
                let option = self.option(demand.role, ranged);
                format!("{option} {}", quoted(&assigned(demand)))
            }
            Remedy::Role(role) => self.option(*role, ranged),
            Remedy::Setting(setting, None) => format!("--{setting}"),
            Remedy::Setting(setting, Some(value)) => format!("--{setting} {value}"),
            Remedy::Analysis(analysis, None) => format!("`linkwork {analysis}`"),
            Remedy::Analysis(analysis, Some(role)) => {
                format!("`linkwork {analysis} {}`", self.option(*role, ranged))
            }
        });
        words.collect::<Vec<_>>().join(" ")
    }
}

/// The option of ranges of a use.
pub fn range_word(ranged: Ranged) -> &'static str {
    match ranged {
        Ranged::Input => "input",
        Ranged::Locus => "locus",
        Ranged::Map => "map",
        Ranged::Vary => "vary",
    }
}

/// `l1=0.7`, or the name alone.
fn assigned(demand: &Demand) -> String {
    match demand.written() {
        Some(value) => format!("{}={value}", demand.name),
        None => demand.name.clone(),
    }
}

/// The word as a shell takes it.
fn quoted(word: &str) -> String {
    let safe = |c: char| c.is_alphanumeric() || "._=,-".contains(c);
    match word.chars().all(safe) {
        true => word.into(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

pub fn no_range(option: &str, name: &str) -> Complaint {
    let help = format!(
        "write {option} {name}=FROM..TO, e.g. {option} {name}=0deg..90deg or {option} {name}=-1..1"
    );
    let said = Complaint::new(format!("`{name}` has no range")).label("no range");
    said.at(OptionPart::WholeValue).help(help)
}

/// More steps than rows of JSON are kept.
pub fn too_many_kept(given: usize, most: usize) -> Complaint {
    Complaint::new(format!(
        "{given} steps are too many to keep in memory: at most {most} are possible"
    ))
    .help("write rows as they come with --format csv")
}

pub fn no_boundary(axes: usize) -> Complaint {
    match axes {
        1 => Complaint::new("the boundary of a map with one coordinate is points, not curves")
            .help("--format json has them as `points`"),
        _ => Complaint::new("--boundary chooses the rows of --format csv")
            .help("add --format csv, or leave --boundary out: --format json has boundaries too"),
    }
}

pub fn table(path: &std::path::Path, error: &TableError) -> Complaint {
    let said = Complaint::new(format!("{}:{error}", path.display()));
    said.help(match &error.kind {
        TableErrorKind::Csv(_) => {
            "write comma-separated values, in the first line `time (s)` and the inputs".into()
        }
        TableErrorKind::NoTime(_) => "begin with a column `time (s)`".into(),
        TableErrorKind::Unknown { suggestion, .. } => suggested(suggestion.as_ref(), || {
            "name joints or coordinates, with their units, e.g. `theta1 (deg)`".into()
        }),
        TableErrorKind::Twice(_) => "give each input one column".into(),
        TableErrorKind::Gap(_) => {
            "give every row a value in every column, or leave the row out".into()
        }
        TableErrorKind::Extra(_) => "leave it out, or name its column in the first line".into(),
        TableErrorKind::Number(_) => {
            "write a number, such as 0.5 or 1e-3, in the unit of the column".into()
        }
        TableErrorKind::Value(error) => {
            let wording = Wording {
                door: &Options::default(),
                ranged: Ranged::Input,
            };
            let said = wording.question(error);
            said.help
                .unwrap_or_else(|| "write a number in the unit of the column".into())
        }
        TableErrorKind::Unsorted { .. } => "sort the rows by time, with each time once".into(),
        TableErrorKind::Still => "give the values at two times at least".into(),
    })
}
