//! `linkwork convert`

use clap::Args;
use linkwork::analysis::convert::{ConvertSettings, convert, possible_cuts};
use linkwork::description::Convention;
use linkwork::output::conversion;

use super::frames::{FileFormat, Named};
use super::source::Source;
use super::{Answer, Refusal, style};

/// Write a mechanism in the other convention, or broken at another joint, with the same configurations.
///
/// Rows are moved as they are written, so names, expressions, limits and closed forms stay; comments do not. What is
/// called otherwise, or can no longer be said, is noted on stderr.
#[derive(Args)]
#[command(after_help = "Example: linkwork convert mechanisms/four_bar.ron --cut phi2")]
pub struct Convert {
    #[command(flatten)]
    source: Source,
    /// The convention of all chains
    #[arg(long, value_enum)]
    convention: Option<Named>,
    /// Break the mechanism at this joint; a closure of its loop becomes rows with variables of its own
    #[arg(long, value_name = "JOINT")]
    cut: Option<String>,
    /// How to write the answer
    #[arg(long, value_enum, default_value_t = FileFormat::Ron)]
    format: FileFormat,
}

impl Convert {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        if self.convention.is_none() && self.cut.is_none() {
            return Err(Refusal(conversion::nothing_asked().render(style())));
        }
        let settings = ConvertSettings {
            convention: self.convention.map(Convention::from),
            cut: self.cut.clone(),
        };
        let converted =
            convert(&loaded.mechanism, &loaded.description, &settings).map_err(|error| {
                let possible = possible_cuts(&loaded.mechanism, &loaded.description);
                Refusal(conversion::complaint(&error, &possible).render(style()))
            })?;
        let unwritten =
            |error| Refusal(format!("error: the mechanism cannot be written: {error}\n"));
        Ok(Answer {
            data: self.format.shown(&converted, || {
                converted.description.to_ron().map_err(unwritten)
            })?,
            remarks: loaded.warnings() + &conversion::notes(&converted.notes),
            yes: true,
        })
    }
}
