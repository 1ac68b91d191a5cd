//! `linkwork formulas`

use clap::Args;
use linkwork::analysis::formulas::{FormulasSettings, formulas};
use linkwork::description::listed;
use linkwork::mechanism::Frame;
use linkwork::output::formulas as output;

use super::format::Written;
use super::source::Source;
use super::{Answer, Refusal, asked};

/// Multiply a mechanism out: transforms, closure equations and screw Jacobians as closed forms.
///
/// Without --of and --in: every link, every chain's tip in ground with its Jacobian, and every closure. Parameters are
/// letters, except those that --set gives another value: these are written out.
#[derive(Args)]
#[command(
    after_help = "Example: linkwork formulas mechanisms/puma560_modified.ron --of arm.3 --latex"
)]
pub struct Formulas {
    #[command(flatten)]
    source: Source,
    /// The frame whose transform is asked for, e.g. --of arm.3
    #[arg(long, value_name = "FRAME")]
    of: Option<String>,
    /// The frame it is seen from, `ground` if not given
    #[arg(long = "in", value_name = "FRAME")]
    relative_to: Option<String>,
    /// Write LaTeX, displayed equations for amsmath or KaTeX
    #[arg(long, group = "script", conflicts_with = "format")]
    latex: bool,
    /// Write for a terminal, which is the default
    #[arg(long, group = "script", conflicts_with = "format")]
    unicode: bool,
    /// Write closed forms to be pasted into a mechanism file
    #[arg(long, group = "script", conflicts_with = "format")]
    ron: bool,
    /// Write Rust functions
    #[arg(long, group = "script", conflicts_with = "format")]
    rust: bool,
    #[command(flatten)]
    format: Written,
}

impl Formulas {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mechanism = &loaded.mechanism;
        let named = |name: &Option<String>, option| match name {
            Some(name) => asked::frame(mechanism, name, option).map(Some),
            None => Ok(None),
        };
        let (of, relative_to) = (named(&self.of, "--of")?, named(&self.relative_to, "--in")?);
        let transform = match (of, relative_to) {
            (None, None) => None,
            (Some(of), relative_to) => Some((of, relative_to.unwrap_or(Frame::Ground))),
            (None, Some(_)) => {
                return Err(Refusal(
                    "error: `--in` says from where a frame is seen, but not which frame\n = help: add --of FRAME\n".into(),
                ));
            }
        };
        let set = loaded.set();
        let settings = FormulasSettings {
            transform,
            numbers: set.clone(),
            ..FormulasSettings::default()
        };
        let report = formulas(mechanism, &settings).map_err(|error| {
            let part = loaded.excerpt(&error.span);
            Refusal(format!(
                "error: `{part}` is too long to be multiplied out in letters\n = help: give it a name among the parameters\n"
            ))
        })?;
        let data = match (self.latex, self.ron, self.rust) {
            (true, ..) => output::latex(&report),
            (_, true, _) => output::ron(&report),
            (_, _, true) => output::rust(&report),
            _ => self.format.shown(&report),
        };
        Ok(Answer {
            data,
            remarks: match set.is_empty() {
                true => loaded.warnings(),
                false => {
                    let quoted: Vec<String> = set.iter().map(|name| format!("`{name}`")).collect();
                    loaded.warnings()
                        + &format!(
                            "note: {} set by --set, written out; other parameters are letters\n",
                            listed(&quoted)
                        )
                }
            },
            yes: true,
        })
    }
}
