//! `linkwork sweep`

mod circuits;

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::sweep::{
    CircuitsReport, Columns, KeptRows, MotionReport, MotionsReport, Row, SweepReport,
    SweepSettings, TracedPoint, follow, sweep,
};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::output::csv::Csv;
use linkwork::output::option::{Given, Part};
use linkwork::output::sweep as output;
#[cfg(feature = "plot")]
use linkwork::output::sweep::Picture;
use linkwork::solve::{Newton, Watch};
use linkwork::system::{
    Driven, Held, Holdable, Question, QuestionError, Search as NearbySearch, check_count,
};

use super::asked::{Split, refusal};
use super::format::Format;
use super::range::{RangeWords, ranges};
use super::search::{Search, mode};
use super::source::{Assignment, Source};
use super::watched::watched;
#[cfg(feature = "plot")]
use super::written::save;
use super::written::{Lines, unwritten};
use super::{Answer, Refusal, style};

/// Move the inputs and see what happens: one branch, never another without a word.
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

/// The number of a mode, if one was asked for, and its configuration where the inputs begin.
type Start = (Option<usize>, Configuration<f64>);

/// Steps made at most, and kept at most.
const MOST_STEPS: usize = 1_000_000_000;
const MOST_KEPT: usize = 1_000_000;
/// Rows shown as text.
const SHOWN: usize = 37;

impl Sweep {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mechanism = &loaded.mechanism;
        let answer = match self.circuits {
            true => self.list(mechanism)?,
            false => self.moved(mechanism)?,
        };
        Ok(Answer {
            remarks: loaded.warnings() + &answer.remarks,
            ..answer
        })
    }

    fn moved(&self, mechanism: &Mechanism) -> Result<Answer, Refusal> {
        if self.input.is_empty() && !self.follow {
            let driven = CircuitsReport::input_of(mechanism);
            let driven = driven.map(|joint| mechanism.joints()[joint].name.as_str());
            return Err(Refusal(output::what_moves(driven).render(style())));
        }
        self.check_steps()?;
        let inputs = self.inputs(mechanism)?;
        let mut question = self.split.question(mechanism)?;
        for (assignment, input) in self.input.iter().zip(&inputs) {
            let from = assignment.value.split("..").next().unwrap_or_default();
            let held = question.hold(&assignment.name, from);
            question = held.map_err(|error| refusal(&error, Some(assignment.given("--input"))))?;
            self.check_limits(mechanism, assignment, input)?;
        }
        // everything but the inputs stands still; where none is given, the freedom is let go
        let held = match inputs.is_empty() {
            false => {
                check_count(&question).map_err(|error| refusal(&error, None))?;
                let without = |held: Held<f64>, input: &Driven| held.without(input.coordinate);
                let still = self.split.question(mechanism)?.held();
                inputs.iter().fold(still, without)
            }
            true => self.one_freedom(mechanism)?.held(),
        };
        let points = self.points(mechanism)?;
        let columns = Columns::new(mechanism, &points);
        let settings = SweepSettings {
            steps: self.steps,
            follow: self.follow,
            points: points.clone(),
            ..SweepSettings::default()
        };
        let starts = self.starts(&question)?;
        #[cfg(feature = "plot")]
        let mut picture = Picture::new(mechanism, &inputs, &points);
        #[cfg(not(feature = "plot"))]
        if self.svg.is_some() {
            return Err(Refusal(
                "error: built without feature `plot`, which draws\n".into(),
            ));
        }
        let lines = Lines::new(self.format == Format::Csv);
        let mut csv = Csv::new(lines, output::row_columns(&columns)).map_err(unwritten)?;
        let mut motions = Vec::new();
        for (mode, start) in starts {
            let mut rows = KeptRows::of(match self.format {
                Format::Text | Format::Markdown | Format::Html => SHOWN,
                Format::Json => MOST_KEPT + 2,
                Format::Csv => 2,
            });
            #[cfg(feature = "plot")]
            picture.begin(mode);
            let mut sink = |row: &Row| {
                rows.take(&columns, row);
                #[cfg(feature = "plot")]
                if self.svg.is_some() {
                    picture.take(mechanism, row);
                }
                if self.format == Format::Csv {
                    // lines keep what goes wrong
                    let _ = csv.row(output::row_values(&columns, mode, row));
                }
            };
            let report: SweepReport = watched(|watch| match inputs.is_empty() {
                true => follow(mechanism, &held, &start, &settings, &mut sink, watch),
                false => sweep(
                    mechanism, &held, &inputs, &start, &settings, &mut sink, watch,
                ),
            });
            motions.push(MotionReport {
                mode,
                sweep: report,
                columns: columns.variables().to_vec(),
                values: rows.finished(),
            });
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

    fn check_steps(&self) -> Result<(), Refusal> {
        let kept = self.format == Format::Json;
        let most = if kept { MOST_KEPT } else { MOST_STEPS };
        match self.steps {
            0 => Err(Refusal(output::no_steps(0, most, kept).render(style()))),
            n if n > most => Err(Refusal(output::no_steps(n, most, kept).render(style()))),
            _ => Ok(()),
        }
    }

    /// The inputs with their ranges.
    fn inputs(&self, mechanism: &Mechanism) -> Result<Vec<Driven>, Refusal> {
        let words = RangeWords {
            no_range: output::no_range,
            refused: output::nothing_moves,
        };
        ranges(
            mechanism,
            "--input",
            &self.input,
            |from, to| from == to,
            &words,
        )
    }

    fn check_limits(
        &self,
        mechanism: &Mechanism,
        assignment: &Assignment,
        input: &Driven,
    ) -> Result<(), Refusal> {
        let Holdable::Joint(joint) = input.coordinate else {
            return Ok(());
        };
        let joint = &mechanism.joints()[joint];
        match joint.limits {
            Some(limits) if !joint.allows(input.from) => {
                let (complaint, part) = output::outside(&joint.name, limits, joint.kind.is_angle());
                let given = assignment.given("--input");
                Err(Refusal(complaint.render_in(&given, &part, style())))
            }
            _ => Ok(()),
        }
    }

    /// The question that leaves one freedom.
    fn one_freedom<'a>(&self, mechanism: &'a Mechanism) -> Result<Question<'a>, Refusal> {
        let question = self.split.released(mechanism)?;
        match check_count(&question) {
            Err(QuestionError::TooFew { mobility, held, .. }) if mobility == held + 1 => {
                Ok(question)
            }
            Ok(_) | Err(QuestionError::TooMany { .. }) => {
                let held = question.held_names();
                Err(Refusal(output::nothing_left(&held).render(style())))
            }
            Err(error @ QuestionError::TooFew { .. }) => {
                Err(Refusal(output::not_one_freedom(&error).render(style())))
            }
            Err(error) => Err(refusal(&error, None)),
        }
    }

    fn points(&self, mechanism: &Mechanism) -> Result<Vec<TracedPoint>, Refusal> {
        let points = self.of.iter().map(|text| {
            TracedPoint::read(mechanism, text).map_err(|error| {
                let given = Given {
                    option: "--of",
                    name: text,
                    value: None,
                };
                let (complaint, _) = output::point_complaint(mechanism, &error);
                Refusal(complaint.render_in(&given, &Part::Name, style()))
            })
        });
        points.collect()
    }

    /// Assembled configurations where the inputs begin, with the numbers of their modes.
    fn starts(&self, question: &Question) -> Result<Vec<Start>, Refusal> {
        if self.mode.is_none() && !self.all_modes {
            let newton = Newton::default();
            let found =
                NearbySearch::new(question, &newton).run(20, self.search.seed, &Watch::none());
            if !found.assembles() {
                return Err(Refusal(format!(
                    "error: the mechanism does not assemble where the motion is to begin\n  \
                     = help: `linkwork solve` says how near it comes: {}\n",
                    question.held_names().join(", ")
                )));
            }
            return Ok(vec![(None, found.attempt.at)]);
        }
        let wanted = Wanted {
            certificates: false,
            all_complex: false,
            starts: true,
        };
        let report = watched(|watch| {
            let solver = self.search.solver(question, watch)?;
            Ok(solver.at_targets(&question.start(), &question.held(), wanted, watch))
        })?;
        let like = question.start();
        let modes = report.assemblies.iter();
        let modes: Vec<_> = modes
            .filter(|assembly| self.mode.is_none_or(|mode| mode == assembly.mode))
            .map(|assembly| (Some(assembly.mode), assembly.configuration(&like)))
            .collect();
        if modes.is_empty() {
            return Err(Refusal(match report.real {
                0 => "error: there is no assembly where the inputs begin\n".into(),
                n => format!(
                    "error: there is no such mode: where the inputs begin there are modes 1 to {n}\n"
                ),
            }));
        }
        Ok(modes)
    }
}
