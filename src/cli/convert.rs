//! `linkwork convert`

use clap::Args;
use clap::ValueEnum;
use linkwork::analysis::convert::{ConvertSettings, convert, possible_cuts, to_axes};
use linkwork::analysis::frames::AxesReport;
use linkwork::description::Convention;
use linkwork::output::complaint::Complaint;
use linkwork::output::{Report, conversion};

use super::format::{Format, Tables, with_file};
use super::source::Source;
use super::{Answer, Refusal, lines};

/// Write a mechanism in the other convention, broken at another joint, or by joint coordinates, with the same
/// configurations.
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
    convention: Option<Tables>,
    /// Break the mechanism at this joint; a closure of its loop becomes rows with variables of its own
    #[arg(long, value_name = "JOINT")]
    cut: Option<String>,
    /// Write it by joint coordinates, or as tables
    #[arg(long, value_enum, conflicts_with_all = ["convention", "cut"])]
    to: Option<Form>,
    /// How to write the answer
    #[arg(long, value_name = "FORMAT", default_value = "ron", value_parser = with_file())]
    format: Format,
}

/// How a file says where joints are.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Form {
    /// Joint coordinates: points and directions
    Axes,
    /// Denavit–Hartenberg tables
    Tables,
}

impl Convert {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        if self.convention.is_none() && self.cut.is_none() && self.to.is_none() {
            let said = Complaint::new("nothing to convert: give a convention, a joint to cut or a form")
                .help("give --convention modified or standard, --cut JOINT, or both, or --to axes or tables");
            return Err(said.into());
        }
        let settings = ConvertSettings {
            convention: self.convention.map(Convention::from),
            cut: self.cut.clone(),
        };
        let (mechanism, description) = (&loaded.mechanism, &loaded.description);
        if self.to == Some(Form::Axes) {
            let (axes, notes) = to_axes(mechanism, description)
                .map_err(|error| Refusal::from(conversion::complaint(&error, &[])))?;
            let answer = loaded.answer(self.format, &AxesReport::from(axes))?;
            return Ok(answer.after(lines("note", notes.iter().map(conversion::note))));
        }
        let converted = convert(mechanism, description, &settings).map_err(|error| {
            let possible = possible_cuts(mechanism, description);
            Refusal::from(conversion::complaint(&error, &possible))
        })?;
        let answer = loaded.answer(self.format, &converted)?;
        Ok(answer.after(lines("note", converted.document().notes)))
    }
}
