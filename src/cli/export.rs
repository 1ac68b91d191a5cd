//! `linkwork export`

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use linkwork::ask::Question;
use linkwork::interchange::{Remark, tree_of, write_mjcf, write_sdf, write_urdf};
use linkwork::output::{Report, assembly_remarks, text};
use linkwork::system::{Analysed, Closed};

use super::output_files::{fits, written};
use super::question_options::{Posed, QuestionOptions};
use super::source::Source;
use super::{Answer, Refusal, lines};

/// Write a mechanism as a file for another program.
///
/// The mechanism is assembled first, as `solve` does it, at home unless --hold, --free and --guess say otherwise. MJCF
/// gets the loops as equality constraints and the assembled configuration as the keyframe `home`; SDF gets them as joints,
/// which are at 0 there; URDF has no loops and gets the tree. What the format cannot express, or expresses differently, is listed on stderr.
#[derive(Args)]
#[command(
    after_help = "Example: linkwork export mechanisms/four_bar.ron --to mjcf --output four_bar.xml"
)]
pub struct Export {
    #[command(flatten)]
    source: Source,
    /// The format
    #[arg(long, value_enum)]
    to: To,
    /// Write to this file instead of stdout
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    asked: QuestionOptions,
}

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum To {
    /// The format of ROS: trees.
    Urdf,
    /// The format of MuJoCo.
    Mjcf,
    /// The format of Gazebo.
    Sdf,
}

impl Export {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let endings: &[&str] = match self.to {
            To::Urdf => &["urdf", "xml"],
            To::Mjcf => &["xml", "mjcf"],
            To::Sdf => &["sdf", "world", "xml"],
        };
        let output = self.output.as_deref();
        output
            .map_or(Ok(()), |path| fits(path, endings))
            .map_err(Refusal::error)?;
        let posed = self.asked.pose(&self.source)?;
        let found = posed.ask(Question::closed)?;
        let open: &dyn Report = match &found {
            Analysed::Closed(closed) => return self.write(&posed, closed),
            Analysed::NotClosed(open) => open,
            Analysed::TooLarge(large) => large,
        };
        Ok(Answer {
            data: String::new(),
            remarks: posed.loaded.warnings()
                + &text::render(&open.document())
                + "Nothing is written.\n",
            yes: false,
        })
    }

    fn write(&self, posed: &Posed, closed: &Closed) -> Result<Answer, Refusal> {
        let mechanism = &posed.loaded.mechanism;
        let (tree, mut said) = tree_of(mechanism, &closed.configuration);
        let (text, more): (String, Vec<Remark>) = match self.to {
            To::Mjcf => write_mjcf(&tree, &said),
            To::Sdf => write_sdf(&tree, &said),
            To::Urdf => write_urdf(&tree),
        };
        said.extend(more);
        let outside = assembly_remarks::outside_limits(&closed.outside_limits(mechanism));
        let said = lines("warning", outside) + &remarks(&said);
        let data = written(text, self.output.as_deref())?;
        Ok(Answer::yes(data, posed.loaded.warnings() + &said))
    }
}

/// Losses of a format, and decisions that a file left open, a line each.
pub fn remarks(said: &[Remark]) -> String {
    let lines = said.iter().map(|remark| {
        let word = if remark.is_loss() { "warning" } else { "note" };
        format!("{word}: {remark}\n")
    });
    lines.collect()
}
