//! `linkwork assemblies`

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::ask::AskError;
use linkwork::solve::Pruning;

use super::question_options::Split;
use super::report_format::{Format, readable};
use super::search_options::SearchArgs;
use super::source::Source;
use super::{Answer, Refusal, style};

/// List all assembled configurations for held inputs, numbered, each with a certificate.
///
/// The actuated joints are held at home and the rest is solved, unless --hold and --free say otherwise, as for
/// `solve`. The list says how complete it is: how many complex solutions there are, how they were searched for, and
/// whether a bound is known. Where infinitely many assemblies are connected, the dimension of the set and samples of it
/// are given. Where assemblies share poses of the platforms, or differ only in the angles of ball joints written as three
/// rows, the list has one row for each pose. Exit code 1: there is no real assembly, or an isolated one may be missing;
/// with --prove also: it is not proved that none is missing.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork assemblies mechanisms/four_bar.ron --hold theta1=\"60 deg\"\n  \
    linkwork assemblies mechanisms/planar_3r.ron --free actuated --hold tool.x=1 --hold tool.y=0.4 --hold tool.yaw=0\n  \
    linkwork assemblies mechanisms/stewart_gough_6sps.ron --store stewart.store --hold l1=1.1")]
pub struct Assemblies {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    split: Split,
    /// Also list the complex solutions that are not real
    #[arg(long)]
    all_complex: bool,
    /// Prove that no other real assembly exists, by excluding boxes of joint values, or say what is left
    #[arg(long)]
    prove: bool,
    /// Number of boxes after which the proof is abandoned
    #[arg(long, value_name = "N", requires = "prove", default_value_t = Pruning::default().most_boxes)]
    boxes: usize,
    #[command(flatten)]
    search: SearchArgs,
    /// Format of the answer; errors are always text on stderr
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = readable())]
    format: Format,
}

impl Assemblies {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let mut posed = self.split.pose(&self.source)?;
        self.search.pose(&mut posed)?;
        let wanted = Wanted {
            all_complex: self.all_complex,
            proof: self.prove.then(|| Pruning {
                most_boxes: self.boxes,
                ..Pruning::default()
            }),
            ..Wanted::default()
        };
        // samples answer a question that holds too little, but what is missing is said too
        let missing = match posed.question.count() {
            Err(error @ AskError::Question(_)) => posed.complaint(&error).render_warning(style()),
            _ => String::new(),
        };
        let answer = posed.answer(self.format, |q, watch| q.assemblies(wanted, watch))?;
        Ok(answer.after(missing))
    }
}
