//! `linkwork formulas`

use clap::Args;
use linkwork::algebra::EvaluationError;
use linkwork::analysis::formulas::{FormulasReport, FormulasSettings, formulas};
use linkwork::ask::AskError;
use linkwork::description::quoted;
use linkwork::mechanism::Frame;
use linkwork::output::complaint::Complaint;
use linkwork::output::formulas as output;

use super::progress::watched;
use super::question_options::{self, AnalysisArgs, Posed};
use super::report_format::Format;
use super::source::LoadedFile;
use super::{Answer, Refusal, lines};

/// Write out transforms, closure equations and screw Jacobians in closed form.
///
/// Without --of and --in: every link, every chain's tip in ground with its Jacobian, and every closure. Parameters stay
/// symbols, except those given by --set, whose values are inserted.
///
/// With --solve: the unknowns in closed form for given held coordinates, as far as the loops can be solved one after
/// another: planar linkages of dyads (Assur groups of class II), and legs whose platform is held. Every assembly is one
/// combination of the signs, each +1 or -1. The formulas are checked by substitution into the closure equations.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork formulas mechanisms/puma560_modified.ron --of arm.3 --latex\n  \
    linkwork formulas mechanisms/four_bar.ron --solve")]
pub struct Formulas {
    /// The frame whose transform is wanted, e.g. --of arm.3
    #[arg(long, value_name = "FRAME")]
    of: Option<String>,
    /// The frame it is seen from, `ground` if not given
    #[arg(long = "in", value_name = "FRAME")]
    relative_to: Option<String>,
    /// Solve the closures for the unknowns in closed form
    #[arg(long, conflicts_with_all = ["of", "ron"])]
    solve: bool,
    /// Write LaTeX, displayed equations for amsmath or KaTeX
    #[arg(long, group = "script", conflicts_with = "format")]
    latex: bool,
    /// Write Unicode for a terminal (the default)
    #[arg(long, group = "script", conflicts_with = "format")]
    unicode: bool,
    /// Write closed forms to be pasted into a mechanism file
    #[arg(long, group = "script", conflicts_with = "format")]
    ron: bool,
    /// Write Rust functions
    #[arg(long, group = "script", conflicts_with = "format")]
    rust: bool,
}

impl AnalysisArgs for Formulas {
    fn answer(&self, posed: Posed, format: Format) -> Result<Answer, Refusal> {
        if self.solve {
            return self.solved(&posed, format);
        }
        let loaded = &posed.loaded;
        let named = |name: &Option<String>, option| {
            let frame = |name| question_options::frame(&loaded.mechanism, name, option);
            name.as_deref().map(frame).transpose()
        };
        let (of, relative_to) = (named(&self.of, "--of")?, named(&self.relative_to, "--in")?);
        if let (None, Some(_)) = (of, relative_to) {
            let title = "`--in` says from where a frame is seen, but not which frame";
            return Err(Complaint::new(title).help("add --of FRAME").into());
        }
        let settings = FormulasSettings {
            transform: of.map(|of| (of, relative_to.unwrap_or(Frame::Ground))),
            numbers: loaded.set.clone(),
            ..FormulasSettings::default()
        };
        let report = formulas(&loaded.mechanism, &settings);
        let report = report.map_err(|error| too_long(loaded, &error))?;
        let answer = self.written(loaded, &report, format)?;
        let set = (!settings.numbers.is_empty()).then(|| {
            let set = quoted(&settings.numbers);
            format!("{set} set by --set, written out; other parameters are letters")
        });
        Ok(answer.after(lines("note", set)))
    }
}

impl Formulas {
    fn solved(&self, posed: &Posed, format: Format) -> Result<Answer, Refusal> {
        // what is too long stands in the file
        let report = match watched(|watch| posed.question.solution(watch)) {
            Err(AskError::Formula(error)) => Err(too_long(&posed.loaded, &error)),
            report => posed.ask(|_, _| report),
        }?;
        self.written(&posed.loaded, &report, format)
    }

    fn written(
        &self,
        loaded: &LoadedFile,
        report: &FormulasReport,
        format: Format,
    ) -> Result<Answer, Refusal> {
        let mut answer = loaded.answer(format, report)?;
        match (self.latex, self.ron, self.rust) {
            (true, ..) => answer.data = output::latex(report),
            (_, true, _) => answer.data = output::ron(report),
            (_, _, true) => answer.data = output::rust(report),
            _ => {}
        }
        Ok(answer)
    }
}

fn too_long(loaded: &LoadedFile, error: &EvaluationError) -> Refusal {
    let part = loaded.excerpt(&error.span);
    let title = format!("`{part}` is too long to be multiplied out in letters");
    Complaint::new(title)
        .help("give it a name among the parameters")
        .into()
}
