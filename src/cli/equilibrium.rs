//! `linkwork equilibrium`

use clap::Args;
use linkwork::analysis::equilibrium::EquilibriumSettings;
use linkwork::ask::Role;
use linkwork::output::drawing::sheet;
use linkwork::output::equilibrium::panels;
use linkwork::system::Analysed;

use super::pictures::Pictures;
use super::question_options::{AnalysisArgs, Forces, Posed};
use super::report_format::Format;
use super::search_options::seed;
use super::{Answer, Refusal};

/// Find where the mechanism rests under weights, springs and forces, whether it is stable, and how it swings about it.
///
/// The mechanism is closed first, at the values the options ask for; then every joint is free, held or not, except those
/// of --lock, and moves downhill in potential energy.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork equilibrium mechanisms/loads/four_bar_let_go.ron\n  \
    linkwork equilibrium mechanisms/loads/four_bar_let_go.ron --all")]
pub struct EquilibriumArguments {
    #[command(flatten)]
    forces: Forces,
    /// Look for all rest positions, stable or not; from random starts where the equations are not algebraic
    #[arg(long)]
    all: bool,
    /// Number of these random starts
    #[arg(long, value_name = "STARTS", default_value_t = EquilibriumSettings::default().starts)]
    starts: usize,
    /// Keep a joint, a platform coordinate or a platform where it is; `actuated` keeps all actuated joints
    #[arg(long, value_name = "NAME")]
    lock: Vec<String>,
    /// Seed of the random starts
    #[arg(long, value_parser = seed, allow_negative_numbers = true)]
    #[arg(default_value_t = EquilibriumSettings::default().seed)]
    seed: u64,
    #[command(flatten)]
    pictures: Pictures,
}

impl AnalysisArgs for EquilibriumArguments {
    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.forces.pose(&mut posed);
        posed.names(Role::Lock, &self.lock);
        posed.ask_with(|question| question.seed(self.seed));
        let settings = EquilibriumSettings {
            all: self.all,
            starts: self.starts,
            seed: self.seed,
            ..EquilibriumSettings::default()
        };
        let report = posed.ask(|question, watch| question.equilibrium(&settings, watch))?;
        if let Analysed::Closed(report) = &report {
            let mechanism = posed.question.mechanism();
            self.pictures.keep(
                || sheet(&panels(mechanism, report, false), &self.pictures.settings()),
                || panels(mechanism, report, true),
            )?;
        }
        posed.loaded.answer(format, &report)
    }
}
