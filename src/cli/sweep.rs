//! `linkwork sweep`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::sweep::{
    Columns, KeptRows, MotionReport, MotionsReport, Row, SweepSettings,
};
use linkwork::ask::{Mode, Role};
use linkwork::output::csv::Csv;
use linkwork::output::sweep as output;
#[cfg(feature = "plot")]
use linkwork::output::sweep::Picture;

use super::asked::{Posed, Ranges, Split};
use super::format::Format;
use super::search::{Search, mode};
use super::source::{Assignment, Loaded, Source};
use super::watched::watched;
use super::words::motion;
#[cfg(feature = "plot")]
use super::written::save;
use super::written::{Lines, unwritten};
use super::{Answer, Refusal, style};

/// Move the inputs and see what happens, without ever switching branch silently.
///
/// The motion begins assembled near home, or in the mode that `assemblies` lists under that number where the inputs
/// begin. It ends where the inputs have gone their way, at a limit, at a dead point of the inputs, or where branches
/// cross. With --follow it goes round dead points and straight through crossings; --follow without --input follows the
/// whole curve of a mechanism with one freedom, and --circuits lists all of them.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --steps 36\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --of left+0.5,0.2 --format csv\n  \
    linkwork sweep mechanisms/three_rps.ron --input l1=0.6..0.8 --input l2=0.6..0.7 --mode 3\n  \
    linkwork sweep mechanisms/slider_crank.ron --follow --svg slider.svg\n  \
    linkwork sweep mechanisms/four_bar.ron --circuits")]
pub struct Sweep {
    #[command(flatten)]
    source: Source,
    /// Move a joint or coordinate, e.g. --input theta1=0deg..360deg; several move together
    #[arg(long, value_name = "NAME=FROM..TO")]
    input: Vec<Assignment>,
    #[command(flatten)]
    split: Split,
    /// Into how many equal steps the way of the inputs is divided
    #[arg(long, value_name = "NUMBER", default_value_t = SweepSettings::default().steps)]
    steps: usize,
    /// Begin in this mode, numbered as `assemblies` lists it where the inputs begin
    #[arg(long, value_name = "NUMBER", conflicts_with = "all_modes")]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Move every mode there is where the inputs begin
    #[arg(long)]
    all_modes: bool,
    /// Go round dead points and straight through crossings; without --input the whole curve
    #[arg(long)]
    follow: bool,
    /// List all circuits and branches of a mechanism with one freedom
    #[arg(long, conflicts_with_all = ["input", "follow", "mode", "all_modes", "svg"])]
    circuits: bool,
    /// Trace a frame's origin, or a point beside it in its axes, e.g. --of left+0.5,0.2
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    of: Vec<String>,
    #[command(flatten)]
    search: Search,
    /// How to write the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Draw the traced paths, or else the joints over the input, to a file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Rows kept at most.
const MOST_KEPT: usize = 1_000_000;
/// Rows shown as text.
const SHOWN: usize = 37;

impl Sweep {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let answer = match self.circuits {
            true => self.list(&loaded)?,
            false => self.moved(&loaded)?,
        };
        Ok(Answer {
            remarks: loaded.warnings() + &answer.remarks,
            ..answer
        })
    }

    fn posed(&self, loaded: &Loaded) -> Result<Posed<'_>, Refusal> {
        let mut posed = self.split.pose(loaded);
        self.search.pose(&mut posed)?;
        posed.ranges(Ranges::Input, &self.input)?;
        for name in &self.of {
            posed.name(Role::Point, "--of", name);
            posed.question = posed.question.point(name);
        }
        posed.question = posed.question.mode(match self.mode {
            Some(mode) => Mode::Number(mode),
            None if self.all_modes => Mode::All,
            None => Mode::Nearest,
        });
        Ok(posed)
    }

    /// `linkwork sweep --circuits`
    fn list(&self, loaded: &Loaded) -> Result<Answer, Refusal> {
        let posed = self.posed(loaded)?;
        if self.format == Format::Csv {
            return Err(Refusal(
                "error: circuits have no rows: choose another --format, or write the rows of one with \
                 --follow --format csv\n"
                    .into(),
            ));
        }
        let report = watched(|watch| posed.question.circuits(watch));
        let report = report.map_err(|error| posed.refusal(&error))?;
        let whole = report.circuits.iter().all(|circuit| circuit.whole);
        Ok(Answer {
            data: self.format.shown(&report),
            remarks: String::new(),
            yes: whole && !report.circuits.is_empty(),
        })
    }

    fn moved(&self, loaded: &Loaded) -> Result<Answer, Refusal> {
        let mechanism = &*loaded.mechanism;
        let kept = self.format == Format::Json;
        if kept && self.steps > MOST_KEPT {
            let said = motion::no_steps(self.steps, MOST_KEPT, kept);
            return Err(Refusal(said.render(style())));
        }
        #[cfg(not(feature = "plot"))]
        if self.svg.is_some() {
            return Err(Refusal(
                "error: built without feature `plot`, which draws\n".into(),
            ));
        }
        let posed = self.posed(loaded)?;
        let settings = SweepSettings {
            steps: self.steps,
            follow: self.follow,
            ..SweepSettings::default()
        };
        let all = watched(|watch| posed.question.motions(&settings, watch));
        let all = all.map_err(|error| posed.refusal(&error))?;
        let columns = Columns::new(mechanism, all.points());
        #[cfg(feature = "plot")]
        let mut picture = Picture::new(mechanism, &all.inputs, all.points());
        let lines = Lines::new(self.format == Format::Csv);
        let mut csv = Csv::new(lines, output::row_columns(&columns)).map_err(unwritten)?;
        let mut motions = Vec::new();
        for (mode, start) in &all.starts {
            let mut rows = KeptRows::of(match self.format {
                Format::Text | Format::Markdown | Format::Html => SHOWN,
                Format::Json => MOST_KEPT + 2,
                Format::Csv => 2,
            });
            #[cfg(feature = "plot")]
            picture.begin(*mode);
            let mut sink = |row: &Row| {
                rows.take(&columns, row);
                #[cfg(feature = "plot")]
                if self.svg.is_some() {
                    picture.take(mechanism, row);
                }
                if self.format == Format::Csv {
                    // lines keep what goes wrong
                    let _ = csv.row(output::row_values(&columns, *mode, row));
                }
            };
            let report = watched(|watch| all.run(start, &mut sink, watch));
            let interrupted = report.interrupted;
            motions.push(MotionReport {
                mode: *mode,
                sweep: report,
                columns: columns.variables().to_vec(),
                values: rows.finished(),
            });
            if interrupted {
                break;
            }
        }
        csv.finish().map_err(unwritten)?.finish()?;
        #[cfg(feature = "plot")]
        if let Some(path) = &self.svg {
            save(path, &picture.svg())?;
        }
        let mut remarks = String::new();
        if self.format == Format::Csv {
            for motion in motions.iter().filter(|m| !m.sweep.ending.is_whole()) {
                let mode = motion
                    .mode
                    .map_or(String::new(), |mode| format!("mode {mode}: "));
                remarks += &format!("note: {mode}{}\n", output::sentence(&motion.sweep));
            }
        }
        Ok(Answer {
            yes: motions.iter().all(|motion| motion.sweep.ending.is_whole()),
            data: self.format.shown(&MotionsReport {
                mechanism: mechanism.name().to_owned(),
                motions,
            }),
            remarks,
        })
    }
}
