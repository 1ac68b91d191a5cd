//! `linkwork simulate`

use clap::Args;
use linkwork::algebra::SiUnit;
use linkwork::analysis::simulation::{DURATIONS, SimulationSettings, TOLERANCES};
use linkwork::ask::Role;
use linkwork::output::sweep::Picture;
use linkwork::system::Analysed;

use super::pictures::Pictures;
use super::question_options::{AnalysisArgs, Forces, Posed};
use super::report_format::Format;
use super::source::Assignment;
use super::{Answer, Refusal};

/// Let the mechanism go: its motion under weights, springs, forces and inertia.
///
/// The mechanism is closed first, at the values the options ask for; then every joint is free, held or not, except those
/// of --lock. Positions and velocities stay closed to rounding. Held coordinates without a rate start at rest.
#[derive(Args)]
#[command(after_help = "Examples:\n  \
    linkwork simulate mechanisms/loads/four_bar_let_go.ron --time 1\n  \
    linkwork simulate mechanisms/loads/four_bar_let_go.ron --time 5 --rate theta=2 --format csv")]
pub struct Simulate {
    #[command(flatten)]
    forces: Forces,
    /// Time simulated, in s or with its unit, e.g. --time "500 ms"
    #[arg(long, value_name = "TIME", default_value_t = SimulationSettings::default().duration.to_string())]
    #[arg(allow_hyphen_values = true)]
    time: String,
    /// Number of rows after the first, equal in time
    #[arg(long, value_name = "ROWS", default_value_t = SimulationSettings::default().rows)]
    rows: usize,
    /// Rate of a held joint or coordinate at the start, e.g. --rate theta1=2; of a locked one its speed, which may change
    /// with time, e.g. --lock theta1 --rate "theta1=2*pi*time"
    #[arg(long, value_name = "NAME=RATE")]
    rate: Vec<Assignment>,
    /// Keep a joint, a platform coordinate or a platform where it is, or drive it with its --rate; `actuated` keeps all
    /// actuated joints
    #[arg(long, value_name = "NAME")]
    lock: Vec<String>,
    /// Also give the position of a frame's origin, or of a point beside it in its axes, e.g. --point left+0.5,0.2
    #[arg(long, value_name = "FRAME[+X,Y,Z]")]
    point: Vec<String>,
    /// Let joints come back from their limits with this part of their speed, and rest on them once they are slow, instead
    /// of ending there; 0 lets them rest at once
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    restitution: Option<String>,
    /// Go on straight through configurations at which branches of motion meet
    #[arg(long)]
    through: bool,
    /// Linearise the equations of motion at the start, in place of moving: A, B, C and D for control
    #[arg(long)]
    linearise: bool,
    /// Error of one step of the integrator, relative, and absolute in rad, characteristic lengths and these per s
    #[arg(long, value_name = "ERROR", default_value_t = SimulationSettings::default().tolerance.to_string())]
    #[arg(allow_hyphen_values = true)]
    error: String,
    #[command(flatten)]
    pictures: Pictures,
}

impl AnalysisArgs for Simulate {
    const ROWS: bool = true;

    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.forces.pose(&mut posed);
        posed.values(Role::Rate, &self.rate);
        posed.names(Role::Lock, &self.lock);
        posed.names(Role::Point, &self.point);
        let plain = |option, text: &str, range| posed.setting(option, text, SiUnit::ONE, range);
        let restitution = self.restitution.as_ref();
        let settings = SimulationSettings {
            duration: posed.setting("--time", &self.time, SiUnit::SECOND, DURATIONS)?,
            rows: self.rows,
            tolerance: plain("--error", &self.error, TOLERANCES)?,
            restitution: restitution
                .map(|part| plain("--restitution", part, (0.0, 1.0)))
                .transpose()?,
            through: self.through,
            linearised: self.linearise,
            ..SimulationSettings::default()
        };
        let report = posed.ask(|question, watch| question.simulation(&settings, watch))?;
        if let Analysed::Closed(report) = &report {
            let mechanism = posed.question.mechanism();
            let picture = || Picture::of_simulation(mechanism, &self.point, report);
            self.pictures.keep(
                || picture().drawn(mechanism, self.pictures.view),
                || picture().panels_moving(mechanism),
            )?;
        }
        posed.loaded.answer(format, &report)
    }
}
