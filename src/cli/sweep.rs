//! `linkwork sweep`

use std::path::PathBuf;

use clap::Args;
use clap::builder::TypedValueParser;
use linkwork::algebra::SiUnit;
use linkwork::analysis::sweep::{Law, Pace, Row, SweepSettings};
use linkwork::ask::{Mode, Question, Role};
use linkwork::description::MAX_BYTES;
use linkwork::output::Report;
use linkwork::output::complaint::Ranged;
use linkwork::output::csv::Csv;
use linkwork::output::sweep::{Picture, SHOWN, certified, row_columns, row_values, sentence};

use super::output_files::{StdoutLines, unwritten};
use super::pictures::Pictures;
use super::progress::watched;
use super::question_options::{AnalysisArgs, Forces, Posed};
use super::read::{called, text};
use super::report_format::Format;
use super::search_options::{SearchArgs, mode};
use super::source::Assignment;
use super::words;
use super::{Answer, Refusal, lines};

/// Move the inputs through their ranges: positions, rates, forces and other quantities; never switches branch silently.
///
/// The motion begins assembled near home or near the values of --guess, or in the mode that `assemblies` lists under
/// that number where the inputs begin. It ends at the end of the ranges, at a limit, at a dead point of the inputs, or
/// where branches cross. With --follow it continues around dead points and straight through crossings; --follow without
/// --input follows the whole curve of a mechanism with one freedom, and --circuits lists all of them.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --steps 36\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --of left+0.5,0.2 --format csv\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --report transmission,velocity:phi1\n  \
    linkwork sweep mechanisms/four_bar.ron --motion crank.csv --report velocity:phi1,acceleration:phi1\n  \
    linkwork sweep mechanisms/three_rps.ron --input l1=0.6..0.8 --input l2=0.6..0.7 --mode 3\n  \
    linkwork sweep mechanisms/four_bar.ron --input theta1=60deg..90deg --guess phi1=\"-130 deg\"\n  \
    linkwork sweep mechanisms/slider_crank.ron --follow --svg slider.svg\n  \
    linkwork sweep mechanisms/jansen_leg.ron --input theta=0deg..360deg --animate leg.gif\n  \
    linkwork sweep mechanisms/four_bar.ron --circuits")]
pub struct Sweep {
    /// Move a joint or coordinate, e.g. --input theta1=0deg..360deg; several move together
    #[arg(long, value_name = "NAME=FROM..TO")]
    input: Vec<Assignment>,
    /// Move the inputs through the rows of a CSV file by natural cubic splines: its first line names `time (s)` and the
    /// inputs with their units, e.g. `theta1 (deg)`; --steps are equal parts of its time
    #[arg(long, value_name = "FILE.csv")]
    #[arg(conflicts_with_all = ["input", "law", "duration", "follow", "circuits"])]
    motion: Option<PathBuf>,
    /// Number of steps, equal in time
    #[arg(long, value_name = "NUMBER", default_value_t = SweepSettings::default().steps)]
    steps: usize,
    /// Begin in this mode, numbered as `assemblies` lists it where the inputs begin
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["all_modes", "guess"])]
    #[arg(value_parser = mode, allow_negative_numbers = true)]
    mode: Option<usize>,
    /// Sweep every mode that exists where the inputs begin
    #[arg(long, conflicts_with = "guess")]
    all_modes: bool,
    /// Continue around dead points and straight through crossings; without --input follow the whole curve
    #[arg(long)]
    follow: bool,
    /// Prove by interval arithmetic that all rows lie on one branch; exit code 1 if that fails
    #[arg(long, requires = "input", conflicts_with_all = ["follow", "circuits", "motion"])]
    certify: bool,
    /// List all circuits and branches of a mechanism with one freedom; a coordinate of a platform is the input where no
    /// joint moves
    #[arg(long, conflicts_with_all = ["input", "follow", "mode", "all_modes", "guess", "animate", "glb"])]
    circuits: bool,
    /// Trace a frame's origin, or a point beside it in its axes, e.g. --of left+0.5,0.2: its path with cusps and double
    /// points; with --circuits over all of them
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    of: Vec<String>,
    /// Report quantities, e.g. --report transmission,velocity:left+1,"atan2(left.y, left.x)": expressions over joints,
    /// coordinates of points, rates and forces; without it the `outputs` of the file
    #[arg(
        long,
        value_name = "QUANTITIES",
        conflicts_with = "circuits",
        allow_hyphen_values = true
    )]
    report: Vec<String>,
    /// Report how far each path of --of deviates from the straight line nearest to it
    #[arg(long, requires = "of", conflicts_with = "circuits")]
    straight: bool,
    /// Find where a quantity stays longest within a tolerance of one value, e.g. --dwell left.yaw="0.5 deg"
    #[arg(long, value_name = "QUANTITY=TOLERANCE", conflicts_with = "circuits")]
    dwell: Vec<Assignment>,
    /// The law by which the inputs go through their ranges; rows are equal parts of the time
    #[arg(long, value_name = "LAW", default_value = "constant", value_parser = law())]
    law: Law,
    /// Duration of the motion, in s or with its unit, e.g. --duration "500 ms"
    #[arg(long, value_name = "TIME", default_value_t = Pace::default().duration.to_string())]
    #[arg(allow_hyphen_values = true)]
    duration: String,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    search: SearchArgs,
    #[command(flatten)]
    pictures: Pictures,
}

fn law() -> impl clap::builder::TypedValueParser<Value = Law> {
    let words = clap::builder::PossibleValuesParser::new(Law::ALL.map(Law::word));
    words.map(|word| Law::from_word(&word).unwrap_or(Law::Constant))
}

const MOST_KEPT: usize = 1_000_000;

impl AnalysisArgs for Sweep {
    const ROWS: bool = true;

    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.search.pose(&mut posed)?;
        posed.ranges(Ranged::Input, &self.input)?;
        if let Some(path) = &self.motion {
            let (text, path) = (text(path, MAX_BYTES)?, &called(path));
            let moved = posed.question.clone().through_rows(&text);
            let moved = moved.map_err(|error| Refusal::from(words::table(path, &error)))?;
            posed.ask_with(|_| moved);
        }
        posed.spelled(Role::Point, "of");
        posed.names(Role::Point, &self.of);
        posed.names(Role::Report, &self.report);
        posed.values(Role::Dwell, &self.dwell);
        self.forces.pose(&mut posed);
        posed.mode(self.mode);
        if self.all_modes {
            posed.ask_with(|question| question.mode(Mode::All));
        }
        match self.circuits {
            true => self.circuits(&posed, format),
            false => self.moved(&posed, format),
        }
    }
}

impl Sweep {
    fn circuits(&self, posed: &Posed, format: Format) -> Result<Answer, Refusal> {
        let report = posed.ask(Question::circuits)?;
        self.keep(
            posed,
            &Picture::of_circuits(posed.question.mechanism(), &report),
        )?;
        posed.loaded.answer(format, &report)
    }

    fn keep(&self, posed: &Posed, picture: &Picture) -> Result<(), Refusal> {
        let mechanism = posed.question.mechanism();
        self.pictures.keep(
            || picture.drawn(mechanism, self.pictures.view),
            || picture.panels_moving(mechanism),
        )
    }

    fn moved(&self, posed: &Posed, format: Format) -> Result<Answer, Refusal> {
        if format == Format::Json && self.steps > MOST_KEPT {
            return Err(words::too_many_kept(self.steps, MOST_KEPT).into());
        }
        const ANY: (f64, f64) = (f64::MIN, f64::MAX);
        let settings = SweepSettings {
            steps: self.steps,
            follow: self.follow,
            pace: Pace {
                law: self.law,
                // the library says which are possible
                duration: posed.setting("--duration", &self.duration, SiUnit::SECOND, ANY)?,
            },
            straightness: self.straight,
            certify: self.certify,
            between: self.pictures.are_wanted(),
            ..SweepSettings::default()
        };
        let all = posed.ask(|question, watch| question.motions(&settings, watch))?;
        let (mechanism, columns) = (&**posed.question.mechanism(), all.columns());
        let quantities = all.quantities();
        let mut picture = Picture::new(mechanism, all.inputs(), all.points(), &quantities);
        let out = StdoutLines::new(format == Format::Csv);
        let mut csv = Csv::new(out, row_columns(&columns)).map_err(unwritten)?;
        let mut sink = |mode: Option<usize>, row: &Row| {
            if self.pictures.are_wanted() {
                picture.take(mechanism, mode, row);
            }
            if format == Format::Csv && !row.between {
                // lines keep what goes wrong
                let _ = csv.row(row_values(&columns, mode, row));
            }
        };
        let kept = match format {
            Format::Json => MOST_KEPT + 2,
            Format::Csv => 2,
            _ => SHOWN,
        };
        let report = watched(|watch| all.report(kept, &mut sink, watch));
        csv.finish().map_err(unwritten)?.finish()?;
        picture.completed(mechanism, &report);
        self.keep(posed, &picture)?;
        let unfinished = report.motions.iter().filter(|m| !m.sweep.ending.is_whole());
        let unfinished = unfinished.filter(|_| format == Format::Csv);
        let unfinished = unfinished.map(|motion| match motion.mode {
            Some(mode) => format!("mode {mode}: {}", sentence(&motion.sweep)),
            None => sentence(&motion.sweep),
        });
        let rows_alone = report.motions.iter().filter(|_| format == Format::Csv);
        let certified = rows_alone.flat_map(|motion| certified(&motion.sweep));
        let report = posed.loaded.prefaced(&report);
        let document = report.document();
        Ok(Answer {
            data: format.shown(&report, &document),
            remarks: posed.loaded.warnings_beside(format)
                + &lines("note", unfinished.chain(certified)),
            yes: !document.no,
        })
    }
}
