//! `linkwork merge`

use std::path::PathBuf;

use clap::Args;
use linkwork::description::MAX_BYTES;
use linkwork::output::study::{mapped, merge, spread};

use super::read::{called, text};
use super::{Answer, Refusal};

/// Join the shards of a study.
///
/// Files may be given in any order; a shard given twice counts once. Shards of another mechanism, question or set of points are
/// refused, as each says in its first line what it is. The output is that of `study` without --shard, byte for byte; --regions
/// adds a column.
#[derive(Args)]
#[command(after_help = "Example: linkwork merge part-*.csv > study.csv")]
pub struct Merge {
    /// Files written by `linkwork study --shard`; `-` reads standard input
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Write mean, standard deviation and extremes of each column instead of the rows
    #[arg(long)]
    spread: bool,
    /// For a study on this --grid: number the regions of adjacent nodes where the mechanism assembles
    #[arg(
        long,
        value_name = "NUMBER",
        value_delimiter = ',',
        conflicts_with = "spread"
    )]
    regions: Vec<usize>,
}

impl Merge {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let read = self.files.iter().map(|file| {
            Ok::<_, Refusal>((called(file).display().to_string(), text(file, MAX_BYTES)?))
        });
        let files: Vec<(String, String)> = read.collect::<Result<_, _>>()?;
        let merged = merge(&files).map_err(Refusal::error)?;
        let twice = merged.twice.iter().map(|(shard, files)| {
            let files = files.join(" and ");
            format!("note: {files} are both shard {shard}, which counts once\n")
        });
        let remarks: String = twice.collect();
        let mut merged = merged.rows;
        if !self.regions.is_empty() {
            merged = mapped(&merged, &self.regions).map_err(Refusal::error)?;
        }
        if self.spread {
            merged = spread(&merged).map_err(Refusal::error)?;
        }
        Ok(Answer::yes(merged, remarks))
    }
}
