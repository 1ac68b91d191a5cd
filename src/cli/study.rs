//! `linkwork study`

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use linkwork::ask::{self, Points, Role};
use linkwork::output::complaint::Ranged;
use linkwork::output::study::{Label, csv, spread};

use super::output_files::{file, save};
use super::progress::{cut_short_is_said, watched};
use super::question_options::{Forces, QuestionOptions};
use super::search_options::SearchArgs;
use super::source::{Assignment, Source};
use super::{Answer, Refusal, lines};

/// Compute quantities over many values of parameters and coordinates.
///
/// Rows are written as CSV: the varied values, whether the mechanism assembles there, and the quantities, in SI units and
/// radians. A study can be divided into shards for any number of machines; `linkwork merge` joins them to the same bytes.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork study mechanisms/four_bar.ron --vary l2=3..5 --vary theta1=0deg..360deg --grid 20,36 --quantity transmission\n  \
    linkwork study mechanisms/three_rps.ron --vary a=0.3..0.6 --vary b=0.8..1.2 --samples 1000 --quantity condition,assemblies\n  \
    linkwork study mechanisms/four_bar.ron --deviate l2=0.001 --deviate theta1=0.1deg --samples 1000 --quantity phi1 --spread\n  \
    linkwork study mechanisms/four_bar.ron --vary l2=3..5 --samples 1000000 --quantity phi1 --shard 3/200 > part-3.csv")]
pub struct StudyArguments {
    #[command(flatten)]
    source: Source,
    /// Vary a parameter, or a coordinate, which is then held, e.g. --vary l2=3..5 or --vary theta1=0deg..360deg
    #[arg(
        long,
        value_name = "NAME=FROM..TO",
        required_unless_present = "deviate"
    )]
    vary: Vec<Assignment>,
    /// Let a parameter or a held coordinate be normally distributed about its value, with this standard deviation, as for
    /// a tolerance, e.g. --deviate l2=0.001
    #[arg(long, value_name = "NAME=DEVIATION", conflicts_with = "grid")]
    deviate: Vec<Assignment>,
    /// Number of points of Sobol's sequence, spread evenly over the ranges
    #[arg(long, value_name = "NUMBER", required_unless_present = "grid")]
    samples: Option<usize>,
    /// With --samples: a Latin hypercube instead, drawn with --seed
    #[arg(long, requires = "samples")]
    latin: bool,
    /// Every combination of this many equally spaced values of each, e.g. --grid 20,36
    #[arg(
        long,
        value_name = "NUMBER",
        value_delimiter = ',',
        conflicts_with = "samples"
    )]
    grid: Vec<usize>,
    /// Quantities to compute, as for --report of `sweep`; also `assemblies`, the number of real assemblies, e.g.
    /// --quantity transmission,reach=hypot(left.x, left.y)
    #[arg(long, value_name = "QUANTITIES", allow_hyphen_values = true)]
    quantity: Vec<String>,
    #[command(flatten)]
    asked: QuestionOptions,
    /// Rate of a held joint or coordinate, for quantities such as velocity:left, e.g. --rate theta1=1
    #[arg(long, value_name = "NAME=RATE")]
    rate: Vec<Assignment>,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    search: SearchArgs,
    /// Compute only this shard, e.g. --shard 3/200
    #[arg(long, value_name = "PART/OF", value_parser = shard, default_value = "1/1")]
    shard: (usize, usize),
    /// Write mean, standard deviation and extremes of each column instead of the rows
    #[arg(long, conflicts_with = "shard")]
    spread: bool,
    /// Write to a file. Where the work is interrupted it has the rows that are finished, and the same command goes on from there
    #[arg(short, long, value_name = "FILE", value_parser = file(&["csv", "txt"]))]
    output: Option<PathBuf>,
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
    parts.ok_or_else(|| "write PART/OF, e.g. 3/200".into())
}

impl StudyArguments {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        posed.spelled(Role::Report, "quantity");
        posed.names(Role::Report, &self.quantity);
        posed.values(Role::Rate, &self.rate);
        self.forces.pose(&mut posed);
        posed.ranges(Ranged::Vary, &self.vary)?;
        posed.values(Role::Deviate, &self.deviate);
        let points = match self.samples {
            Some(samples) if self.latin => Points::LatinHypercube(samples),
            Some(samples) => Points::Sobol(samples),
            None if self.grid.len() == 1 => Points::Grid(vec![self.grid[0]; self.vary.len()]),
            None => Points::Grid(self.grid.clone()),
        };
        let study = posed.ask(|question, _| ask::Study::new(question, points))?;
        let (part, of) = self.shard;
        let mut range = study.shard(part, of).map_err(Refusal::error)?;
        let written = posed.loaded.description.to_ron().map_err(Refusal::error)?;
        let label = Label::new(&written, &study, self.shard);
        // what an interrupted run left
        let begun = self.output.as_deref().filter(|_| !self.spread);
        let begun = begun.and_then(|path| unfinished(path, label, &range));
        let mut remarks = posed.loaded.warnings();
        if let (Some((rows, _)), Some(path)) = (&begun, &self.output) {
            range.start += rows;
            let path = path.display();
            remarks += &format!(
                "note: {path} has rows up to {}: going on from there\n",
                range.start
            );
        }
        let rows = watched(|watch| study.rows(range.clone(), watch));
        let whole = !rows.interrupted;
        let done = range.start + rows.rows.len();
        let mut data = csv(&study, &rows);
        if let Some((_, known)) = begun {
            let new = data.split_once('\n').map_or("", |(_, rows)| rows);
            data = known + new;
        }
        if self.spread {
            data = spread(&data).map_err(Refusal::error)?;
        } else if of > 1 || !whole && self.output.is_some() {
            data = format!("{label}{data}");
        }
        let Some(path) = &self.output else {
            let note = (!whole).then(|| "interrupted: rows are missing at the end".to_owned());
            return Ok(Answer {
                data,
                remarks: remarks + &lines("note", note),
                yes: whole,
            });
        };
        let first = study.shard(part, of).map_err(Refusal::error)?.start;
        let worth = whole || !self.spread && done > first;
        if worth {
            save(path, data.as_bytes())?;
        }
        if !whole {
            let (path, count) = (path.display(), study.count());
            let said = match worth {
                true => format!(
                    "{path} has rows {first} to {} of {count}; the same command goes on from there",
                    done - 1
                ),
                false => format!("nothing is written to {path}"),
            };
            remarks += &format!("note: interrupted: {said}\n");
            cut_short_is_said();
        }
        Ok(Answer {
            data: String::new(),
            remarks,
            yes: whole,
        })
    }
}

/// Number of rows in the file of an interrupted shard, and these with their header.
fn unfinished(path: &Path, label: Label, of: &Range<usize>) -> Option<(usize, String)> {
    // what is no file may never end
    let text = path.is_file().then(|| fs::read_to_string(path).ok())??;
    let (known, rows) = Label::of(&text);
    let lines = rows.lines().skip(1).zip(of.start..);
    let lines = lines.take_while(|(line, row)| line.split(',').next() == Some(&row.to_string()));
    let count = lines.count();
    let whole = rows.ends_with('\n') && rows.lines().count() == count + 1;
    (known == Some(label) && whole && count < of.len()).then(|| (count, rows.to_owned()))
}
