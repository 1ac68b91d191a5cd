//! `linkwork simulate`

use clap::Args;
use linkwork::analysis::simulation::SimulationSettings;
use linkwork::ask::Role;
use linkwork::output::sweep::Picture;
use linkwork::system::Analysed;

use super::asked::{Analysis, Forces, Posed};
use super::format::Format;
use super::pictures::Pictures;
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
    /// Time simulated, in s
    #[arg(long, value_name = "SECONDS", default_value_t = SimulationSettings::default().duration)]
    #[arg(value_parser = |text: &str| within(text, f64::MIN_POSITIVE, 1e9), allow_negative_numbers = true)]
    time: f64,
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
    #[arg(long, value_name = "FACTOR", value_parser = |text: &str| within(text, 0.0, 1.0))]
    #[arg(allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Go on straight through configurations at which branches of motion meet
    #[arg(long)]
    through: bool,
    /// Linearise the equations of motion at the start, in place of moving: A, B, C and D for control
    #[arg(long)]
    linearise: bool,
    /// Error of one step of the integrator, relative, and absolute in rad, characteristic lengths and these per s
    #[arg(long, value_name = "ERROR", default_value_t = SimulationSettings::default().tolerance)]
    #[arg(value_parser = |text: &str| within(text, 1e-14, 1e-2), allow_negative_numbers = true)]
    error: f64,
    #[command(flatten)]
    pictures: Pictures,
}

impl Analysis for Simulate {
    const ROWS: bool = true;

    fn answer(&self, mut posed: Posed, format: Format) -> Result<Answer, Refusal> {
        self.forces.pose(&mut posed);
        posed.values(Role::Rate, &self.rate);
        posed.names(Role::Lock, &self.lock);
        posed.names(Role::Point, &self.point);
        let settings = SimulationSettings {
            duration: self.time,
            rows: self.rows,
            tolerance: self.error,
            restitution: self.restitution,
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

/// A number between two others.
fn within(text: &str, least: f64, most: f64) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "it is not a number".to_owned())?;
    match (least..=most).contains(&number) {
        true => Ok(number),
        false if least == f64::MIN_POSITIVE => Err(format!("it is more than 0 and at most {most}")),
        false => Err(format!("it is between {least} and {most}")),
    }
}
