//! `linkwork assemblies`

use clap::Args;
use linkwork::analysis::assemblies::Wanted;
use linkwork::ask::AskError;

use super::asked::Split;
use super::format::Written;
use super::search::Search;
use super::source::Source;
use super::watched::watched;
use super::words::question::complaint;
use super::{Answer, Refusal, style};

/// List all assembled configurations for held inputs, numbered, each with a certificate.
///
/// The actuated joints are held at home and the rest is solved, unless --hold and --free say otherwise, as for
/// `solve`. The list says how complete it is: how many complex solutions there are, how they were searched for, and
/// whether a bound is known. Where infinitely many assemblies are connected, their dimension is told and samples stand
/// for them. Exit code 1 means that there is no real assembly, or that one that is isolated may be missing.
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
    /// List the complex solutions that are not real too
    #[arg(long)]
    all_complex: bool,
    #[command(flatten)]
    search: Search,
    #[command(flatten)]
    format: Written,
}

impl Assemblies {
    pub fn run(&self) -> Result<Answer, Refusal> {
        let loaded = self.source.load()?;
        let mut posed = self.split.pose(&loaded);
        self.search.pose(&mut posed)?;
        let (question, refusal) = (&posed.question, |error| posed.refusal(&error));
        let mut remarks = loaded.warnings();
        // samples answer a question that holds too little, but what is missing is said too
        if let Err(AskError::Question(error)) = question.count() {
            remarks += &complaint(&error).render_warning(style());
        }
        let wanted = Wanted {
            all_complex: self.all_complex,
            ..Wanted::default()
        };
        let report = watched(|watch| question.assemblies(wanted, watch)).map_err(refusal)?;
        Ok(Answer {
            data: self.format.shown(&report),
            remarks,
            yes: report.real > 0 && !report.may_lack_some(),
        })
    }
}
