//! `linkwork design`

use std::path::{Path, PathBuf};

use clap::Args;
use linkwork::algebra::{Measure, ends_with_one_unit};
use linkwork::ask::{self, DesignError};
use linkwork::description::{
    Description, DesignDescription, DesignGoal, DesignPart, Entry, FileError, LoadError, MAX_BYTES,
    Named, Problem, ProblemKind, Spanned, Varied, is_design, load_text,
};
use linkwork::mechanism::Mechanism;
use linkwork::output::complaint::Complaint;
use linkwork::output::design::{front, panel, panels_moving};
use linkwork::output::diagnostics;
use linkwork::output::drawing::sheet;

use super::output_files::{file, written};
use super::pictures::{Pictures, keep};
use super::progress::watched;
use super::report_format::Format;
use super::source::Assignment;
use super::{Answer, Refusal, style};

/// Find dimensions with which a mechanism passes through points or poses, or gives a function.
///
/// FILE is a design file, which names its mechanism, or a mechanism file together with --vary, --path and --points. Every
/// design is judged along its whole motion: circuit, branch, order of the points, limits, bounds.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork design lid.ron -o best.ron\n  \
    linkwork design mechanisms/four_bar.ron --vary l1,l2,l3,u=-5..5,v=-5..5 --path left+u,v --points path.csv")]
pub struct DesignArguments {
    /// A design file, or a mechanism file.
    file: PathBuf,
    /// Vary parameters, each in a range, among listed values, equal to an expression of others, or from a tenth to ten times its
    /// value; new names are further unknowns, e.g. --vary "l0,l1=0.1..2,l2=[0.5, 0.6],l3=l2,u=-1..1"
    #[arg(long, value_name = "NAME[=VALUES],…")]
    vary: Vec<String>,
    /// The point that shall pass through the points, e.g. --path left+u,v
    #[arg(
        long,
        value_name = "POINT",
        requires = "points",
        allow_hyphen_values = true
    )]
    path: Option<String>,
    /// A CSV file with columns x, y and perhaps z, in m; further columns, named by their header, give inputs or quantities, in m
    /// and rad
    #[arg(long, value_name = "FILE")]
    points: Option<PathBuf>,
    /// Allow a target to be missed by so much, and weigh it accordingly, e.g. --tolerance left+u,v="1 mm"
    #[arg(long, value_name = "TARGET=VALUE")]
    tolerance: Vec<Assignment>,
    /// Require a box of quantities to be reached: its corners, the middles of its sides and its middle, e.g. --contains
    /// pen.x=-0.1..0.1
    #[arg(long, value_name = "QUANTITY=FROM..TO")]
    contains: Vec<Assignment>,
    /// Require an input to go through a range, e.g. --motion theta1=0deg..360deg
    #[arg(long, value_name = "NAME=FROM..TO")]
    motion: Vec<Assignment>,
    /// Require a quantity to be no less than a value all the time, e.g. --at-least transmission="40 deg"
    #[arg(long, value_name = "QUANTITY=VALUE")]
    at_least: Vec<Assignment>,
    /// Require a quantity to be no greater than a value all the time
    #[arg(long, value_name = "QUANTITY=VALUE")]
    at_most: Vec<Assignment>,
    /// Make a figure of a quantity over the motion small: max, min, range, mean or rms, e.g. --minimise "max(force:theta1)"; of two
    /// such goals designs are found of which none is beaten in both
    #[arg(long, value_name = "FIGURE")]
    minimise: Vec<String>,
    /// Make a figure of a quantity over the motion great, e.g. --maximise "min(transmission)"
    #[arg(long, value_name = "FIGURE")]
    maximise: Vec<String>,
    /// Allow the points to be passed in any order
    #[arg(long)]
    any_order: bool,
    /// Seed of the search
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// Random starts at most
    #[arg(long, value_name = "NUMBER", default_value_t = 400)]
    starts: usize,
    /// Search from random starts where all exact solutions could be found too
    #[arg(long)]
    approximate: bool,
    /// Generic solutions of an exact synthesis at most; where there are more it is searched from random starts
    #[arg(long, value_name = "NUMBER", default_value_t = 100)]
    solutions: usize,
    /// Designs listed at most
    #[arg(long, value_name = "NUMBER", default_value_t = 10)]
    most: usize,
    /// Write the mechanism file of the first design here
    #[arg(short, long, value_name = "FILE", value_parser = file(&["ron"]))]
    output: Option<PathBuf>,
    #[command(flatten)]
    pictures: Pictures,
    /// Draw the designs in the plane of two goals
    #[arg(long, value_name = "FILE", value_parser = file(&["svg", "png"]))]
    front: Option<PathBuf>,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    format: Format,
}

impl DesignArguments {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let text = load_text(&self.file)?;
        let (mut asked, mechanism) = match is_design(&text) {
            true => {
                let asked = DesignDescription::read(&text)
                    .map_err(|problems| LoadError::wrong(&self.file, text.clone(), problems))?;
                let folder = self.file.parent().unwrap_or(Path::new(""));
                let path = folder.join(&asked.mechanism.value);
                (asked, path)
            }
            false => (DesignDescription::default(), self.file.clone()),
        };
        let (mechanism_text, description) = Mechanism::read_within(&mechanism, MAX_BYTES)?;
        let of_file = asked.clone();
        self.add(&mut asked, &description)?;
        let design = ask::Design {
            mechanism: description,
            asked,
            seed: self.seed,
            starts: self.starts,
            own: false,
            approximate: self.approximate,
            solutions: self.solutions,
            most: self.most.max(1),
        };
        let report = watched(|watch| design.report(watch));
        let report = report.map_err(|error| match error {
            DesignError::Mechanism(problems) => {
                LoadError::wrong(&mechanism, mechanism_text, problems).into()
            }
            DesignError::Part {
                part,
                value,
                problem,
            } => {
                let known = match part {
                    DesignPart::Whole => true,
                    DesignPart::Output(i) => i < of_file.outputs.len(),
                    DesignPart::Goal(_) => self.minimise.is_empty() && self.maximise.is_empty(),
                    DesignPart::Weight(i) => i < of_file.weights.len(),
                    DesignPart::Tolerance(i) => i < of_file.tolerances.len(),
                    DesignPart::Vary(i) => i < of_file.vary.len(),
                    DesignPart::Position(k, _) => {
                        k < of_file.positions.len() || !of_file.contains.is_empty()
                    }
                    DesignPart::Motion(i) => i < of_file.motion.len(),
                    DesignPart::AtLeast(i) => i < of_file.at_least.len(),
                    DesignPart::AtMost(i) => i < of_file.at_most.len(),
                };
                if known && is_design(&text) {
                    let kind = ProblemKind::Design(Box::new(problem));
                    let problem: Problem = kind.at(of_file.span(part, value));
                    let wrong = FileError::new(&self.file, text.clone(), vec![problem]);
                    return Refusal(diagnostics::render(&wrong, style()));
                }
                let said = Complaint::new(problem.to_string());
                Refusal::from(match problem.help() {
                    Some(help) => said.help(help),
                    None => said,
                })
            }
        })?;
        if let (Some(path), Some(first)) = (&self.output, report.designs.first()) {
            written(first.file.clone(), Some(path))?;
        }
        if let (true, Some(first)) = (self.pictures.are_wanted(), report.designs.first()) {
            let drawn = watched(|watch| design.drawn(first, watch)).ok_or_else(|| {
                Refusal::error("the first design cannot be drawn: it does not assemble")
            })?;
            if self.pictures.are_moving() && drawn.moving.is_empty() {
                let why = "the first design cannot be drawn moving: it does not have one freedom";
                return Err(Refusal::error(why));
            }
            self.pictures.keep(
                || sheet(&[panel(&drawn)], &self.pictures.settings()),
                || panels_moving(&drawn),
            )?;
        }
        if let Some(path) = &self.front {
            let drawn = front(&report).ok_or_else(|| {
                let said = Complaint::new("`--front` draws designs in the plane of two goals");
                said.help("name two, by `--minimise` and `--maximise`")
            })?;
            let png = path
                .extension()
                .is_some_and(|of| of.eq_ignore_ascii_case("png"));
            keep(Some(path), || match png {
                true => drawn.png(),
                false => drawn.svg().into_bytes(),
            })?;
        }
        self.format.answer(&report)
    }

    /// Adds what the options ask for.
    fn add(&self, asked: &mut DesignDescription, mechanism: &Description) -> Result<(), Refusal> {
        for given in self.vary.iter().flat_map(|all| outside_brackets(all)) {
            let (name, values) = match given.split_once('=') {
                Some((name, values)) => (name.trim(), varied(name, values.trim())?),
                None => (given.trim(), about(mechanism, given.trim())?),
            };
            asked.vary.push(Named::new(name, values));
        }
        for Assignment { name, value } in &self.tolerance {
            let most = vec![entry("--tolerance", value)?];
            asked.tolerances.push(Named::new(name.as_str(), most));
        }
        for Assignment { name, value } in &self.contains {
            let range = range("--contains", name, value)?;
            asked.contains.push(Named::new(name.as_str(), range));
        }
        for Assignment { name, value } in &self.motion {
            let range = range("--motion", name, value)?;
            asked.motion.push(Named::new(name.as_str(), range));
        }
        for Assignment { name, value } in &self.at_least {
            let bound = entry("--at-least", value)?;
            asked.at_least.push(Named::new(name.as_str(), bound));
        }
        for Assignment { name, value } in &self.at_most {
            let bound = entry("--at-most", value)?;
            asked.at_most.push(Named::new(name.as_str(), bound));
        }
        let small = self.minimise.iter().map(|figure| (figure, false));
        let great = self.maximise.iter().map(|figure| (figure, true));
        let goals = small.chain(great).map(|(figure, greatest)| DesignGoal {
            figure: Spanned::new(figure.clone(), 0..0),
            greatest,
        });
        let goals: Vec<DesignGoal> = goals.collect();
        if !goals.is_empty() {
            asked.goals = goals;
        }
        asked.any_order |= self.any_order;
        if let Some(path) = &self.points {
            asked.positions.extend(self.positions(path)?);
        }
        Ok(())
    }

    /// The positions of a table.
    fn positions(&self, path: &Path) -> Result<Vec<Vec<Named<Vec<Entry>>>>, Refusal> {
        let text = load_text(path)?;
        let lines = text.lines().enumerate();
        let mut lines = lines
            .map(|(i, line)| (i + 1, line.split(',').map(str::trim).collect::<Vec<_>>()))
            .filter(|(_, cells)| {
                !cells.iter().all(|cell| cell.is_empty()) && !cells[0].starts_with('#')
            })
            .peekable();
        let header =
            lines.next_if(|(_, cells)| cells.iter().any(|cell| cell.parse::<f64>().is_err()));
        let names: Vec<String> = match header {
            Some((_, names)) => names.into_iter().map(str::to_owned).collect(),
            None => ["x", "y", "z"].map(str::to_owned).to_vec(),
        };
        let mut positions = Vec::new();
        for (line, cells) in lines {
            let place = || format!("{}:{line}", path.display());
            if cells.len() > names.len() {
                return Err(Refusal::error(format!(
                    "{}: the row has {} values for {} columns",
                    place(),
                    cells.len(),
                    names.len()
                )));
            }
            let mut point = Vec::new();
            let mut position = Vec::new();
            for (name, cell) in names.iter().zip(&cells) {
                let entry = Entry::read(cell).map_err(|error| {
                    Refusal::error(format!("{}: `{cell}` is no value: {error}", place()))
                })?;
                match ["x", "y", "z"].contains(&name.as_str()) && self.path.is_some() {
                    true => point.push(entry),
                    false => position.push(Named::new(name.as_str(), vec![entry])),
                }
            }
            if let (Some(name), false) = (&self.path, point.is_empty()) {
                position.push(Named::new(name.as_str(), point));
            }
            positions.push(position);
        }
        Ok(positions)
    }
}

fn entry(option: &str, text: &str) -> Result<Entry, Refusal> {
    Entry::read(text).map_err(|error| {
        let title = format!("`{option}` has a value that is none, `{text}`: {error}");
        Complaint::new(title).into()
    })
}

fn range(option: &str, name: &str, text: &str) -> Result<[Entry; 2], Refusal> {
    match text.split_once("..") {
        Some((from, to)) => {
            let [from, to] = ends_with_one_unit([from, to]);
            Ok([entry(option, &from)?, entry(option, &to)?])
        }
        None => {
            let title = format!("`{option} {name}={text}` is no range");
            let help = format!("write {option} {name}=FROM..TO");
            Err(Complaint::new(title).help(help).into())
        }
    }
}

/// The parts of a text between commas that are in no brackets.
fn outside_brackets(text: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0;
    text.split(move |c| {
        depth += i32::from("([".contains(c)) - i32::from(")]".contains(c));
        c == ',' && depth == 0
    })
}

/// A range, listed values, or an expression of other numbers.
fn varied(name: &str, text: &str) -> Result<Varied, Refusal> {
    let list = text
        .strip_prefix('[')
        .and_then(|text| text.strip_suffix(']'));
    Ok(match list {
        Some(list) => {
            let values = outside_brackets(list).map(|text| entry("--vary", text.trim()));
            Varied::OneOf(values.collect::<Result<_, _>>()?)
        }
        None if !text.contains("..") => Varied::Equal(entry("--vary", text)?),
        None => Varied::Range(range("--vary", name, text)?),
    })
}

/// From a tenth to ten times the value of a parameter; all of a turn for an angle.
fn about(mechanism: &Description, name: &str) -> Result<Varied, Refusal> {
    let read = Mechanism::new(mechanism).ok();
    let parameter = read.as_ref().and_then(|mechanism| {
        let mut all = mechanism.parameters().iter();
        all.find(|of| *of.name == *name)
    });
    let Some(parameter) = parameter else {
        let title = format!("the file has no parameter `{name}`");
        let help = format!("give a further unknown its range: --vary {name}=FROM..TO");
        return Err(Complaint::new(title).help(help).into());
    };
    let (low, high) = match (parameter.measure, parameter.value) {
        (Measure::Angle, _) => (-std::f64::consts::PI, std::f64::consts::PI),
        (_, 0.0) => (-1.0, 1.0),
        (_, value) if value < 0.0 => (10.0 * value, 0.1 * value),
        (_, value) => (0.1 * value, 10.0 * value),
    };
    let ends = [low, high].map(|value| Entry::number(value, 0..0));
    Ok(Varied::Range(ends))
}
