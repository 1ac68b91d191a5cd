//! `linkwork singularities`

use std::path::PathBuf;

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::analysis::singularities::{
    Coupled, Ending, SingularitiesSettings, along, inputs_of, loci, singularities,
};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::output::option::Given;
use linkwork::output::{singularities as output, sweep as motion};
use linkwork::solve::{Newton, Watch};
use linkwork::system::{
    Driven, Held, Holdable, Lock, Question, QuestionError, Search as NearbySearch, check_count,
    too_large,
};

use super::asked::{Asked, frame, refusal};
use super::format::Format;
use super::range::{RangeWords, ranges};
use super::search::Search;
use super::source::{Assignment, Source};
use super::watched::watched;
#[cfg(feature = "plot")]
use super::written::save;
use super::written::{INTERRUPTED_REMARK, rows};
use super::{Answer, Refusal, style};

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
    /// Begin in this mode, numbered as `assemblies` lists it
    #[arg(long, value_name = "NUMBER")]
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

/// Random starts made at most.
const MOST_STARTS: usize = 1_000_000;

impl Singularities {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mechanism = &loaded.mechanism;
        if self.starts == 0 || self.starts > MOST_STARTS {
            return Err(Refusal(format!(
                "error: {} random starts are sought from: give --starts from 1 to {MOST_STARTS}\n",
                self.starts
            )));
        }
        let settings = SingularitiesSettings {
            seed: self.search.seed,
            starts: self.starts,
            follow: self.follow,
            outputs: self.outputs(mechanism)?,
            ..SingularitiesSettings::default()
        };
        let answer = match (self.input.is_empty(), self.locus.is_empty()) {
            (_, false) => self.loci(mechanism, &settings)?,
            (false, true) => self.along(mechanism, &settings)?,
            (true, true) => self.here(mechanism, &settings)?,
        };
        Ok(Answer {
            remarks: loaded.warnings() + &answer.remarks,
            ..answer
        })
    }

    /// The outputs that are asked for.
    fn outputs(&self, mechanism: &Mechanism) -> Result<Vec<Lock>, Refusal> {
        let question = Question::new(mechanism);
        let named = self.output.iter().map(|name| {
            if let Ok((coordinate, _)) = question.value(name, "home") {
                return Ok(Lock::Coordinate(coordinate));
            }
            mechanism.frame(name).map(Lock::Frame).ok_or_else(|| {
                let given = Given {
                    option: "--output",
                    name,
                    value: None,
                };
                let (complaint, part) = output::unknown_output(mechanism, name);
                Refusal(complaint.render_in(&given, &part, style()))
            })
        });
        let points = self.point.iter();
        let points = points.map(|name| frame(mechanism, name, "--point").map(Lock::Point));
        named.chain(points).collect()
    }

    /// The inputs of a question, of which there must be some.
    fn inputs(&self, question: &Question) -> Result<Vec<Holdable>, Refusal> {
        let inputs = inputs_of(question);
        match inputs.is_empty() {
            true => Err(Refusal(output::nothing_to_drive().render(style()))),
            false => Ok(inputs),
        }
    }

    fn here(
        &self,
        mechanism: &Mechanism,
        settings: &SingularitiesSettings,
    ) -> Result<Answer, Refusal> {
        let (mut question, _) = self.holding(mechanism, "--hold", &[], [].into_iter())?;
        self.inputs(&question)?;
        if self.mode.is_some() {
            let start = self.start(&question)?;
            question = question.near(&start);
        }
        let report = watched(|watch| singularities(&question, settings, watch))
            .map_err(|error| refusal(&error, None))?;
        if self.format == Format::Csv {
            return Err(Refusal(
                "error: one configuration has no rows: choose another --format, or ask for rows \
                 along --input or --locus\n"
                    .into(),
            ));
        }
        let found = report.report();
        Ok(Answer {
            remarks: found.map(output::limits_remark).unwrap_or_default(),
            yes: found.is_some(),
            data: self.format.shown(&report),
        })
    }

    fn along(
        &self,
        mechanism: &Mechanism,
        settings: &SingularitiesSettings,
    ) -> Result<Answer, Refusal> {
        let words = RangeWords {
            no_range: motion::no_range,
            refused: motion::nothing_moves,
        };
        let moved = ranges(mechanism, "--input", &self.input, |a, b| a == b, &words)?;
        let ends = moved.iter().map(|input| input.from);
        let (question, held) = self.holding(mechanism, "--input", &self.input, ends)?;
        let inputs = self.inputs(&question)?;
        let held = still(held, &moved);
        let start = self.start(&question)?;
        let report =
            watched(|watch| along(mechanism, &held, &moved, &inputs, &start, settings, watch));
        let yes = matches!(
            report.ending,
            Ending::Complete | Ending::Returned | Ending::Closed
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

    fn loci(
        &self,
        mechanism: &Mechanism,
        settings: &SingularitiesSettings,
    ) -> Result<Answer, Refusal> {
        let words = RangeWords {
            no_range: output::no_side,
            refused: |name, _| output::empty_side(name),
        };
        let sides = ranges(mechanism, "--locus", &self.locus, |a, b| a >= b, &words)?;
        let [a, b] = sides[..] else {
            return Err(Refusal(output::not_two_sides(sides.len()).render(style())));
        };
        let middles = sides.iter().map(|side| 0.5 * (side.from + side.to));
        let (question, held) = self.holding(mechanism, "--locus", &self.locus, middles)?;
        if let Some(large) = too_large(mechanism) {
            return Err(Refusal(format!(
                "error: the mechanism has {} unknowns, too many for loci: ask about a part of it\n",
                large.unknowns
            )));
        }
        let inputs = self.inputs(&question)?;
        let held = still(held, &sides);
        #[cfg(not(feature = "plot"))]
        if self.svg.is_some() {
            return Err(Refusal(
                "error: built without feature `plot`, which draws\n".into(),
            ));
        }
        let start = question.start();
        let report =
            watched(|watch| loci(mechanism, &held, [a, b], &inputs, &start, settings, watch))
                .map_err(|spins| Refusal(output::spinning(spins).render(style())))?;
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

    /// The question with what moves held at values, which must leave no freedom, and what it holds
    /// without that. Where coordinates of platforms make it hold too much, the actuated joints that
    /// only the file holds are free.
    fn holding<'a>(
        &self,
        mechanism: &'a Mechanism,
        option: &str,
        moved: &[Assignment],
        values: impl Iterator<Item = f64> + Clone,
    ) -> Result<(Question<'a>, Held<f64>), Refusal> {
        let with_moved = |asked: Question<'a>| {
            let held = asked.held();
            let mut question = asked;
            for (assignment, value) in moved.iter().zip(values.clone()) {
                // all digits, so that the value is the one that was read
                let held = question.hold(&assignment.name, &format!("{value:?}"));
                question = held.map_err(|error| refusal(&error, Some(assignment.given(option))))?;
            }
            Ok((question, held))
        };
        let mut asked = with_moved(self.asked.question(mechanism)?)?;
        let mut count = check_count(&asked.0);
        let platform = |h: &Holdable| !matches!(h, Holdable::Joint(_));
        let inverse = asked.0.held_coordinates().iter().any(platform);
        if inverse && matches!(count, Err(QuestionError::TooMany { .. })) {
            asked = with_moved(self.asked.released(mechanism)?)?;
            count = check_count(&asked.0);
        }
        count.map_err(|error| refusal(&error, None))?;
        Ok(asked)
    }

    /// The assembled configuration of the mode that is asked for, or near the start.
    fn start(&self, question: &Question) -> Result<Configuration<f64>, Refusal> {
        let Some(mode) = self.mode else {
            let newton = Newton::default();
            let found =
                NearbySearch::new(question, &newton).run(20, self.search.seed, &Watch::none());
            return match found.assembles() {
                true => Ok(found.attempt.at),
                false => Err(Refusal(format!(
                    "error: the mechanism does not assemble where the motion is to begin\n  \
                     = help: `linkwork solve` says how near it comes: {}\n",
                    question.held_names().join(", ")
                ))),
            };
        };
        let wanted = Wanted {
            certificates: false,
            all_complex: false,
            starts: true,
        };
        let like = question.start();
        let report = watched(|watch| {
            let solver = self.search.solver(question, watch)?;
            Ok(solver.at_targets(&like, &question.held(), wanted, watch))
        })?;
        let mut modes = report.assemblies.iter();
        let wanted = modes.find(|assembly| assembly.mode == mode);
        wanted
            .map(|assembly| assembly.configuration(&like))
            .ok_or_else(|| {
                Refusal(match report.real {
                    0 => "error: there is no assembly with these inputs\n".into(),
                    n => format!("error: there is no mode {mode}: with these inputs there are modes 1 to {n}\n"),
                })
            })
    }
}

/// What is held while these move.
fn still(held: Held<f64>, moved: &[Driven]) -> Held<f64> {
    let without = |held: Held<f64>, input: &Driven| held.without(input.coordinate);
    moved.iter().fold(held, without)
}
