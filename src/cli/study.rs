//! `linkwork study`

use std::path::PathBuf;

use clap::Args;
use linkwork::ask::{self, Points, Question, Role};
use linkwork::output::study::{csv, spread};
use linkwork::system::Value;

use super::asked::{Asked, Forces};
use super::search::Search;
use super::source::{Assignment, Source, once};
use super::watched::watched;
use super::words::Ranged;
use super::written::{file, save};
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
pub struct Study {
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
    asked: Asked,
    /// Rate of a held joint or coordinate, for quantities such as velocity:left, e.g. --rate theta1=1
    #[arg(long, value_name = "NAME=RATE")]
    rate: Vec<Assignment>,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    search: Search,
    /// Compute only this shard, e.g. --shard 3/200
    #[arg(long, value_name = "PART/OF", value_parser = shard, default_value = "1/1")]
    shard: (usize, usize),
    /// Write mean, standard deviation and extremes of each column instead of the rows
    #[arg(long, conflicts_with = "shard")]
    spread: bool,
    /// Write to a file, which appears only when it is complete
    #[arg(short, long, value_name = "FILE", value_parser = file(&["csv", "txt"]))]
    output: Option<PathBuf>,
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
    parts.ok_or_else(|| "write PART/OF, e.g. 3/200".into())
}

impl Study {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.asked.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        once("--rate", &self.rate)?;
        posed.names(
            Role::Quantity,
            "--quantity",
            &self.quantity,
            Question::report,
        );
        posed.values(Role::Rate, "--rate", &self.rate, Question::rate);
        self.forces.pose(&mut posed);
        let vary = posed.varied(Ranged::Vary, &self.vary)?.into_iter();
        let vary: Vec<(String, Value, Value)> = vary
            .map(|(name, from, to)| (name, from.into(), to.into()))
            .collect();
        once("--deviate", &self.deviate)?;
        let deviate = self.deviate.iter();
        let deviate: Vec<(String, Value)> = deviate
            .map(|of| (of.name.clone(), of.value.as_str().into()))
            .collect();
        let points = match self.samples {
            Some(samples) if self.latin => Points::LatinHypercube(samples),
            Some(samples) => Points::Sobol(samples),
            None if self.grid.len() == 1 => Points::Grid(vec![self.grid[0]; vary.len()]),
            None => Points::Grid(self.grid.clone()),
        };
        let study = posed.ask(|question, _| ask::Study::new(question, &vary, &deviate, points))?;
        let (part, of) = self.shard;
        let range = study.shard(part, of).map_err(Refusal::error)?;
        let rows = watched(|watch| study.rows(range, watch));
        let whole = !rows.interrupted;
        let note = (!whole).then(|| "interrupted: rows are missing at the end".to_owned());
        let mut data = csv(&study, &rows);
        if self.spread {
            data = spread(&data).map_err(Refusal::error)?;
        }
        if let Some(path) = &self.output {
            // a part of a shard is none
            if whole {
                save(path, data.as_bytes())?;
            }
            data.clear();
        }
        Ok(Answer {
            data,
            remarks: posed.loaded.warnings() + &lines("note", note),
            yes: whole,
        })
    }
}
