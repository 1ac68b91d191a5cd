//! `linkwork merge`

use std::path::PathBuf;

use clap::Args;
use linkwork::output::study::merge;

use super::{Answer, Refusal};

/// Put the shards of a study together.
///
/// Files may be given in any order, and shards that were worked out twice count once. What is written is what `study`
/// writes without --shard, to the byte.
#[derive(Args)]
#[command(after_help = "Example: linkwork merge part-*.csv > study.csv")]
pub struct Merge {
    /// What `linkwork study --shard` wrote
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

impl Merge {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let read = self.files.iter().map(|file| {
            let name = file.display().to_string();
            match std::fs::read_to_string(file) {
                Ok(text) => Ok((name, text)),
                Err(error) => Err(Refusal(format!("error: {name}: {error}\n"))),
            }
        });
        let files: Vec<(String, String)> = read.collect::<Result<_, _>>()?;
        let merged = merge(&files).map_err(|error| Refusal(format!("error: {error}\n")))?;
        Ok(Answer {
            data: merged,
            remarks: String::new(),
            yes: true,
        })
    }
}
