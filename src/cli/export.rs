//! `linkwork export`

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use linkwork::interchange::{Remark, tree_of, write_mjcf, write_urdf};
use linkwork::output::{Report, closing, text};

use super::asked::Asked;
use super::source::Source;
use super::watched::watched;
use super::{Answer, Refusal};

/// Write a mechanism as a file for another program.
///
/// The mechanism is assembled first, as `solve` does it, at home unless --hold, --free and --guess say otherwise. MJCF
/// gets the loops as equality constraints and the assembled configuration as the keyframe `home`; URDF knows no loops
/// and gets the tree. What a format cannot say, or says another way, is named on stderr.
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
    asked: Asked,
}

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum To {
    /// The format of ROS: trees.
    Urdf,
    /// The format of MuJoCo.
    Mjcf,
}

impl Export {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let posed = self.asked.pose(&loaded);
        let closed = watched(|watch| posed.question.closed(watch));
        let closed = match closed.map_err(|error| posed.refusal(&error))? {
            Ok(closed) => closed,
            Err(open) => {
                let open = text::render(&open.document());
                return Ok(Answer {
                    data: String::new(),
                    remarks: loaded.warnings() + &open + "Nothing is written.\n",
                    yes: false,
                });
            }
        };
        let (tree, mut said) = tree_of(&loaded.mechanism, &closed.configuration);
        let (text, more): (String, Vec<Remark>) = match self.to {
            To::Mjcf => write_mjcf(&tree, &said),
            To::Urdf => write_urdf(&tree),
        };
        said.extend(more);
        let mut remarks = loaded.warnings();
        remarks += &closing::limits_warning(&closed.outside_limits(&loaded.mechanism));
        for remark in &said {
            let word = if remark.is_loss() { "warning" } else { "note" };
            remarks += &format!("{word}: {remark}\n");
        }
        let data = match &self.output {
            None => text,
            Some(path) => {
                std::fs::write(path, text).map_err(|error| {
                    Refusal(format!("error: cannot write {}: {error}\n", path.display()))
                })?;
                String::new()
            }
        };
        Ok(Answer {
            data,
            remarks,
            yes: true,
        })
    }
}
