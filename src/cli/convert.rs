//! `linkwork convert`

use clap::Args;
use clap::ValueEnum;
use linkwork::analysis::convert::{ConvertSettings, cognates, convert, possible_cuts, to_axes};
use linkwork::analysis::frames::AxesReport;
use linkwork::description::Convention;
use linkwork::mechanism::NamedPoint;
use linkwork::output::complaint::{Complaint, OptionPart, no_point};
use linkwork::output::{Report, conversion};

use super::report_format::{Format, with_file};
use super::source::{Assignment, LoadedFile, Source};
use super::{Answer, Refusal, lines, style};

/// Write a mechanism in the other convention, broken at another joint, or by joint coordinates, with the same
/// configurations.
///
/// Rows are rearranged as they are written, so names, expressions, limits and closed forms stay; comments do not.
/// Renamed frames, and what is lost, are listed on stderr.
#[derive(Args)]
#[command(after_help = "Example: linkwork convert mechanisms/four_bar.ron --cut phi2")]
pub struct Convert {
    #[command(flatten)]
    source: Source,
    /// The convention of all chains
    #[arg(long, value_enum)]
    convention: Option<Convention>,
    /// Break the mechanism at this joint; a closure of its loop becomes rows with variables of its own
    #[arg(long, value_name = "JOINT")]
    cut: Option<String>,
    /// Write one of the two cognates of a 4-bar, whose couplers trace the same curve as this point of its coupler: 1 keeps
    /// the ground pivot of the first link, 2 that of the other, e.g. --cognate left+0.5,0.2=1
    #[arg(long, value_name = "POINT=NUMBER", conflicts_with_all = ["convention", "cut", "to"])]
    cognate: Option<Assignment>,
    /// Write the file by joint coordinates, or as tables
    #[arg(long, value_enum, conflicts_with_all = ["convention", "cut"])]
    to: Option<Form>,
    /// Format of the answer
    #[arg(long, value_name = "FORMAT", default_value = "ron", value_parser = with_file())]
    format: Format,
}

/// Form in which a file gives its joints.
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
        let tables = self.convention.is_some() || self.cut.is_some();
        if !tables && self.to.is_none() && self.cognate.is_none() {
            let said = Complaint::new("nothing to convert: give a convention, a joint to cut or a form")
                .help("give --convention modified or standard, --cut JOINT, or both, or --to axes or tables");
            return Err(said.into());
        }
        let settings = ConvertSettings {
            convention: self.convention,
            cut: self.cut.clone(),
        };
        let (mechanism, description) = (&loaded.mechanism, &loaded.description);
        if let Some(asked) = &self.cognate {
            return cognate(&loaded, asked, self.format);
        }
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

fn cognate(loaded: &LoadedFile, asked: &Assignment, format: Format) -> Result<Answer, Refusal> {
    let refused = |said: Complaint| Refusal(said.render_in(&asked.given("--cognate"), style()));
    let point = NamedPoint::read(&loaded.mechanism, &asked.name)
        .map_err(|error| refused(no_point(&loaded.mechanism, &error)))?;
    let number = ["1", "2"].iter().position(|known| *known == asked.value);
    let number = number.ok_or_else(|| {
        let said = Complaint::new("a 4-bar has two cognates, 1 and 2").at(OptionPart::WholeValue);
        refused(said.help("give --cognate POINT=1 or POINT=2"))
    })?;
    let found = cognates(&loaded.mechanism, &point)
        .map_err(|error| refused(Complaint::new(error.to_string())))?;
    let answer = loaded.answer(format, &found[number])?;
    Ok(answer.after(lines("note", found[number].document().notes)))
}
