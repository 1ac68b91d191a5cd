//! Motion by itself: a mechanism let go under its loads.

mod linear;
mod run;
mod speed;

use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::linear::{Decomposition, add, dot};
use crate::mechanism::{Configuration, Point};
use crate::number::tolerance::{ROUNDING, STILL};
use crate::solve::Watch;
use crate::system::{
    Analysed, AssemblySettings, Coordinate, Drive, Dynamics, GivenPose, Load, NamedUnit,
    NoDynamics, Question, RegularFreedoms,
};

use run::Run;

pub use linear::Linear;
pub use speed::Speed;

/// The durations that a simulation takes, in s.
pub const DURATIONS: (f64, f64) = (f64::MIN_POSITIVE, 1e9);

/// The errors of a step that it takes.
pub const TOLERANCES: (f64, f64) = (1e-14, 1e-2);

/// Settings of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationSettings {
    /// Time simulated, in s.
    pub duration: f64,
    /// Number of equal intervals at the ends of which rows are given.
    pub rows: usize,
    /// Error of one step, relative to the values, in rad, characteristic lengths and these per s.
    pub tolerance: f64,
    /// Part of its speed with which a joint comes back from a limit, and rests on it once it is slow; `None` ends the
    /// simulation there.
    pub restitution: Option<f64>,
    /// True if the motion goes on straight through configurations at which branches of motion meet.
    pub through: bool,
    /// Coordinates that stay where they are.
    pub locked: Vec<Coordinate>,
    /// Coordinates that are driven, with their speeds over time.
    pub speeds: Vec<Speed>,
    /// True for the equations linearised at the start in place of a motion.
    pub linearised: bool,
    /// Points followed.
    pub points: Vec<Point>,
}

impl Default for SimulationSettings {
    fn default() -> Self {
        SimulationSettings {
            duration: 1.0,
            rows: 100,
            tolerance: 1e-10,
            restitution: None,
            through: false,
            locked: Vec::new(),
            speeds: Vec::new(),
            linearised: false,
            points: Vec::new(),
        }
    }
}

/// The motion of a mechanism that is let go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimulationReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// Freedoms with which it moves.
    pub freedoms: usize,
    /// Names and units of the columns: time, joints with their rates, platforms and points, energies.
    pub columns: Vec<NamedUnit>,
    /// Values at equal times, and at the end.
    pub rows: Vec<Vec<f64>>,
    /// The configurations of the rows.
    #[serde(skip)]
    pub configurations: Vec<Configuration<f64>>,
    /// The time reached, in s.
    pub reached: f64,
    /// The end of the simulation.
    pub end: SimulationEnd,
    /// Passages and impacts on the way.
    pub events: Vec<SimulationEvent>,
    /// The equations linearised at the start, if they are wanted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear: Option<Linear>,
    /// Balance of energies.
    pub energy: EnergyBalance,
    /// The largest residual of the closure equations at any row, dimensionless.
    pub residual: f64,
    /// Steps of the integrator.
    pub steps: usize,
    /// True if the problem was found to be stiff.
    pub stiff: bool,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
}

/// The end of a simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SimulationEnd {
    /// The time asked for is over.
    Over,
    /// It was interrupted.
    Interrupted,
    /// The equations were linearised at the start, and nothing moved.
    Linearised,
    /// The joint of that name came to a limit, in m or rad.
    Limit {
        /// The joint.
        joint: String,
        /// The limit.
        limit: f64,
        /// rad or m.
        unit: SiUnit,
    },
    /// Branches of motion meet.
    Singular,
    /// Steps became too short: a force has no value, or the motion none.
    Stuck,
    /// It could not begin.
    NotBegun(NoSimulation),
}

/// An event on the way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimulationEvent {
    /// In s.
    pub time: f64,
    /// The event.
    pub event: Happened,
}

/// Kinds of events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Happened {
    /// The joint of that name came back from a limit.
    Impact {
        /// The joint.
        joint: String,
        /// Its speed before, in m/s or rad/s.
        speed: f64,
        /// Kinetic energy lost, in J.
        loss: f64,
    },
    /// The joint of that name rests, and friction holds it.
    Sticks {
        /// The joint.
        joint: String,
    },
    /// Friction no longer holds the joint of that name.
    Slips {
        /// The joint.
        joint: String,
    },
    /// The joint of that name rests on a limit.
    Rests {
        /// The joint.
        joint: String,
        /// Its speed before, in m/s or rad/s.
        speed: f64,
        /// Kinetic energy lost, in J.
        loss: f64,
    },
    /// The joint of that name leaves the limit on which it rested.
    Leaves {
        /// The joint.
        joint: String,
    },
    /// Branches of motion meet, and it went straight through.
    Singular,
}

/// Balance of the energies of a simulation, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EnergyBalance {
    /// Kinetic and potential energy at the start.
    pub start: f64,
    /// At the end.
    pub end: f64,
    /// Work of given forces, drives and dampers until then.
    pub supplied: f64,
    /// Energy lost in impacts.
    pub lost: f64,
    /// The sum of the corrections of the kinetic energy that keep the balance.
    pub corrected: f64,
    /// The largest deviation from balance at any row.
    pub error: f64,
    /// The largest kinetic energy after any step.
    pub kinetic: f64,
}

/// Reasons for which a mechanism cannot be let go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NoSimulation {
    /// Nothing can move.
    Structure,
    /// Branches of motion meet at the start.
    Singular,
    /// No coordinates determine the motion.
    NoCoordinates,
    /// These coordinates can move without moving any mass.
    NoMass(Vec<String>),
    /// The rates given cannot be had together.
    Rates,
    /// A force has no value at the start.
    NoForce,
}

/// Lets a mechanism go from the assembled configuration near the start of a question, with the rates of a drive, under
/// loads.
///
/// M(q)·q̈ = Q(q, q̇, t) is integrated in independent coordinates ([`Dynamics`]) with closures solved at every evaluation,
/// so that positions and velocities stay closed to rounding. Where steps change the balance of energies, rates are scaled
/// by a hair so that it is kept (projection: Hairer, Lubich and Wanner 2006, IV.4). Held coordinates without a rate start at rest; where these
/// leave freedoms, the motion begins with the least kinetic energy that has their rates.
pub fn simulation(
    question: &Question,
    drive: &Drive,
    load: &Load,
    settings: &SimulationSettings,
    watch: &Watch,
) -> Analysed<SimulationReport> {
    let mechanism = question.mechanism();
    let closed = match AssemblySettings::default().start(question, watch) {
        Ok(closed) => closed,
        Err(answer) => return answer,
    };
    let pose = closed.pose(mechanism);
    let begun = begin(question, drive, load, settings, &closed.configuration);
    let report = begun.and_then(|(mut dynamics, rates)| {
        let run = Run::new(mechanism, &mut dynamics, settings, rates);
        run.map(|run| run.report(watch, pose.clone()))
            .ok_or(NoSimulation::NoForce)
    });
    Analysed::Closed(report.unwrap_or_else(|why| SimulationReport {
        end: SimulationEnd::NotBegun(why),
        mechanism: mechanism.name().into(),
        freedoms: 0,
        columns: Vec::new(),
        rows: Vec::new(),
        configurations: Vec::new(),
        reached: 0.0,
        events: Vec::new(),
        linear: None,
        energy: EnergyBalance::default(),
        residual: 0.0,
        steps: 0,
        stiff: false,
        pose,
    }))
}

/// The equations at the start, and the rates there.
fn begin<'a>(
    question: &Question<'a>,
    drive: &Drive,
    load: &'a Load,
    settings: &SimulationSettings,
    at: &Configuration<f64>,
) -> Result<(Dynamics<'a>, Vec<f64>), NoSimulation> {
    let mechanism = question.mechanism();
    let driven = settings.speeds.len();
    let locked: Vec<Coordinate> = (settings.speeds.iter().map(|of| of.coordinate))
        .chain(settings.locked.iter().copied())
        .collect();
    let locking = Question::locking(mechanism, &locked, at);
    let mobility = RegularFreedoms::near(mechanism, at).ok_or(NoSimulation::Singular)?;
    let all = mobility.count() + mobility.idle();
    let moves = |left: &usize| *left + driven > 0;
    let freedoms = all.checked_sub(locked.len()).filter(moves);
    let freedoms = freedoms.ok_or(NoSimulation::Structure)?;
    let begin = |still, freedoms| {
        let held = (driven, locked.clone(), still);
        Dynamics::new(mechanism, load, held, freedoms, at).map_err(|why| match why {
            NoDynamics::Singular => NoSimulation::Singular,
            NoDynamics::NoCoordinates => NoSimulation::NoCoordinates,
            NoDynamics::NoForce => NoSimulation::NoForce,
        })
    };
    let mut dynamics = begin(Vec::new(), freedoms)?;
    let mut massless = massless(&mut dynamics)?;
    // links of no inertia about their own line do not spin
    if !massless.is_empty() && mobility.idle() > 0 {
        let still = locking.with_spins_still().still().to_vec();
        let left = freedoms.checked_sub(still.len());
        if let Some(left) = left.filter(moves) {
            dynamics = begin(still, left)?;
            massless = self::massless(&mut dynamics)?;
        }
    }
    if !massless.is_empty() {
        return Err(NoSimulation::NoMass(massless));
    }
    let rates = initial(question, drive, &mut dynamics).ok_or(NoSimulation::Rates)?;

    Ok((dynamics, rates))
}

/// Independent coordinates of motions that move no mass.
fn massless(dynamics: &mut Dynamics) -> Result<Vec<String>, NoSimulation> {
    let free = dynamics.coordinates().len();
    let Some(mass) = dynamics.mass() else {
        return Err(NoSimulation::Singular);
    };
    let decomposition = Decomposition::of(free, free, &mass);
    let largest = mass.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest > 0.0 && decomposition.rank() == free {
        return Ok(Vec::new());
    }
    let motions = match largest > 0.0 {
        true => decomposition.null_space(),
        false => (0..free)
            .map(|i| (0..free).map(|j| f64::from(u8::from(i == j))).collect())
            .collect(),
    };
    let moves = |i: usize| {
        motions
            .iter()
            .any(|motion: &Vec<f64>| motion[i].abs() > STILL)
    };
    let coordinates = dynamics.coordinates().iter().enumerate();
    let names = coordinates.filter(|(i, _)| moves(*i));
    Ok(names.map(|(_, of)| dynamics.name(*of)).collect())
}

/// Rates of the independent coordinates for those of a drive: of many those of least kinetic energy, M⁻¹Aᵀ(A M⁻¹Aᵀ)⁺r.
fn initial(question: &Question, drive: &Drive, dynamics: &mut Dynamics) -> Option<Vec<f64>> {
    let free = dynamics.coordinates().len();
    let still = vec![0.0; free];
    if !drive.given {
        return Some(still);
    }
    let mass = Decomposition::of(free, free, &dynamics.mass()?);
    let held = question.held_coordinates().len() >= free;
    let given = drive.coordinates.iter().zip(&drive.rates);
    let given: Vec<(Coordinate, f64)> = given
        .map(|(of, rate)| (*of, *rate))
        .filter(|(_, rate)| held || *rate != 0.0)
        .collect();
    let rows: Vec<Vec<f64>> = (given.iter())
        .map(|(of, _)| dynamics.rates_of(*of)[..free].to_vec())
        .collect();
    let solved: Vec<Vec<f64>> = rows.iter().map(|row| mass.solve(row)).collect();
    let square = rows
        .iter()
        .flat_map(|row| solved.iter().map(|other| dot(row, other)));
    let square = Decomposition::of(rows.len(), rows.len(), &square.collect::<Vec<f64>>());
    let wanted: Vec<f64> = given.iter().map(|(_, rate)| *rate).collect();
    let shares = square.solve(&wanted);
    let mut rates = still;
    for (share, column) in shares.iter().zip(&solved) {
        add(&mut rates, *share, column);
    }
    let size = wanted.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let met = rows.iter().zip(&wanted);
    let met = met.map(|(row, wanted)| (dot(row, &rates) - wanted).abs());
    met.fold(0.0, f64::max)
        .le(&(ROUNDING * size))
        .then_some(rates)
}
