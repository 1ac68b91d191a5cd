//! `linkwork singularities`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::singularities::{AlongEnd, Coupled, SingularitiesSettings};
use linkwork::ask::{Mode, Role};
use linkwork::output::closing::is_about_the_file;
use linkwork::output::singularities as output;

use super::asked::{Asked, Posed, Ranges};
use super::format::Format;
use super::search::{Search, mode};
use super::source::{Assignment, Source};
use super::watched::watched;
#[cfg(feature = "plot")]
use super::written::save;
use super::written::{INTERRUPTED_REMARK, rows};
use super::{Answer, Refusal};

/// Find singularities: at a configuration, along inputs, or as curves in two inputs.
///
/// The inputs are the joints that are held, and the outputs the platforms; without platforms the joints on the ground
/// that are not driven, or else the points where chains are joined. Where coordinates of platforms are held or moved
/// these are the outputs, the actuated joints are free, and are the inputs. Every singularity is located to rounding
/// and told by its types (Gosselin and Angeles 1, 2, 3; Zlatanov, Fenton and Benhabib), by the freedoms lost and gained,
/// and by what moves.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork singularities mechanisms/parallelogram.ron --hold theta1=0\n  \
    linkwork singularities mechanisms/four_bar.ron --input theta1=0deg..360deg\n  \
    linkwork singularities mechanisms/three_rps.ron --locus l1=0.4..1 --locus l2=0.4..1 --svg loci.svg")]
pub struct Singularities {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    asked: Asked,
    /// Move a joint or coordinate, e.g. --input theta1=0deg..360deg; several move together
    #[arg(long, value_name = "NAME=FROM..TO")]
    input: Vec<Assignment>,
    /// A side of the box for loci: give it twice, e.g. --locus l1=0.4..1 --locus l2=0.4..1
    #[arg(long, value_name = "NAME=FROM..TO", conflicts_with_all = ["input", "mode", "follow"])]
    locus: Vec<Assignment>,
    /// An output: a joint, a platform coordinate or a frame with its orientation
    #[arg(long, value_name = "NAME")]
    output: Vec<String>,
    /// An output: the origin of a frame alone
    #[arg(long, value_name = "FRAME")]
    point: Vec<String>,
    /// Begin in this mode, numbered as `assemblies` lists it where the inputs begin
    #[arg(long, value_name = "NUMBER")]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Go round folds and straight through crossings of branches
    #[arg(long, requires = "input")]
    follow: bool,
    /// Random starts from which loci are sought; up to ten times as many while more curves are likely
    #[arg(long, value_name = "NUMBER", default_value_t = SingularitiesSettings::default().starts)]
    starts: usize,
    #[command(flatten)]
    search: Search,
    /// How to write the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Draw the loci to a file
    #[arg(long, value_name = "FILE", requires = "locus")]
    svg: Option<PathBuf>,
}

impl Singularities {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let settings = SingularitiesSettings {
            starts: self.starts,
            follow: self.follow,
            ..SingularitiesSettings::default()
        };
        let mut posed = self.asked.pose(&loaded);
        self.search.pose(&mut posed)?;
        for name in &self.output {
            posed.name(Role::Output, "--output", name);
            posed.question = posed.question.output(name);
        }
        for name in &self.point {
            posed.name(Role::Point, "--point", name);
            posed.question = posed.question.point(name);
        }
        match self.locus.is_empty() {
            true => posed.ranges(Ranges::Input, &self.input)?,
            false => posed.ranges(Ranges::Locus, &self.locus)?,
        }
        let mode = self.mode.map_or(Mode::Nearest, Mode::Number);
        posed.question = posed.question.mode(mode);
        let answer = match (self.input.is_empty(), self.locus.is_empty()) {
            (_, false) => self.loci(&posed, &settings)?,
            (false, true) => self.along(&posed, &settings)?,
            (true, true) => self.here(&posed, &settings)?,
        };
        Ok(Answer {
            remarks: loaded.warnings() + &answer.remarks,
            ..answer
        })
    }

    fn here(&self, posed: &Posed, settings: &SingularitiesSettings) -> Result<Answer, Refusal> {
        if self.format == Format::Csv {
            return Err(Refusal(
                "error: one configuration has no rows: choose another --format, or ask for rows \
                 along --input or --locus\n"
                    .into(),
            ));
        }
        let report = watched(|watch| posed.question.singularities(settings, watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let found = report.report();
        Ok(Answer {
            remarks: found.map(output::limits_remark).unwrap_or_default(),
            yes: found.is_some_and(|report| {
                let (gap, length) = (report.given_gap.as_ref(), report.normalising_length);
                is_about_the_file(report.kept, gap, length)
            }),
            data: self.format.shown(&report),
        })
    }

    fn along(&self, posed: &Posed, settings: &SingularitiesSettings) -> Result<Answer, Refusal> {
        let report = watched(|watch| posed.question.along(settings, watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let yes = matches!(
            report.ending,
            AlongEnd::Complete | AlongEnd::Returned | AlongEnd::Closed
        );
        let whole = match self.format {
            Format::Csv => rows(output::along_rows(&report))?,
            _ => true,
        };
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: match self.format {
                Format::Csv if !yes => format!("note: {}\n", output::ending(&report)),
                _ => String::new(),
            } + &self.beside_rows(&report.coupled),
            yes: yes && whole,
        })
    }

    fn loci(&self, posed: &Posed, settings: &SingularitiesSettings) -> Result<Answer, Refusal> {
        #[cfg(not(feature = "plot"))]
        if self.svg.is_some() {
            return Err(Refusal(
                "error: built without feature `plot`, which draws\n".into(),
            ));
        }
        let report = watched(|watch| posed.question.loci(settings, watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        #[cfg(feature = "plot")]
        if let Some(path) = &self.svg {
            save(path, &output::svg(&report))?;
        }
        let whole = match self.format {
            Format::Csv => rows(output::locus_rows(&report))?,
            _ => true,
        };
        let data = self.format.shown(&report);
        Ok(Answer {
            data,
            remarks: match self.format {
                Format::Csv if !whole => INTERRUPTED_REMARK.to_owned(),
                Format::Csv => {
                    let said = output::pinned(&report).into_iter();
                    let said = said.chain([output::completeness(&report)]);
                    said.map(|said| format!("note: {said}\n")).collect()
                }
                _ => String::new(),
            } + &self.beside_rows(&report.coupled),
            yes: !report.loci.is_empty() && whole,
        })
    }

    /// What is said of the outputs where only rows are written.
    fn beside_rows(&self, coupled: &[Coupled]) -> String {
        match (self.format, output::note(coupled)) {
            (Format::Csv, Some(note)) => format!("note: {note}\n"),
            _ => String::new(),
        }
    }
}
