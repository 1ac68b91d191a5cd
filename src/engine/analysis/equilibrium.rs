//! Rest positions under weights, springs and forces, with stability and small oscillations.

mod all;
mod descent;
mod oscillation;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

use crate::algebra::SiUnit;
use crate::mechanism::{Configuration, Mechanism, turn_near};
use crate::number::sorting::sort_by;
use crate::number::tolerance::SAME;
use crate::solve::{Newton, Stage, Watch};
use crate::system::{
    Analysed, AssemblySettings, ByName, Coordinate, Dynamics, GivenPose, Load, Neighbourhood,
    NoDynamics, NotAlgebraic, PlatformRecord, Question, RegularFreedoms, Still,
    random_configuration,
};

pub use all::AllRest;
pub use oscillation::{NaturalMode, Stability, Stiffness};

/// Settings of a search for rest positions.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumSettings {
    /// True for all rest positions, not only the one nearest downhill.
    pub all: bool,
    /// Number of random starts.
    pub starts: usize,
    /// Their seed.
    pub seed: u64,
    /// Coordinates that stay where they are.
    pub locked: Vec<Coordinate>,
}

impl Default for EquilibriumSettings {
    fn default() -> Self {
        EquilibriumSettings {
            all: false,
            starts: 100,
            seed: 1,
            locked: Vec::new(),
        }
    }
}

/// Rest positions of a mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquilibriumReport {
    /// The mechanism's name.
    pub mechanism: String,
    /// Freedoms in which it can move.
    pub freedoms: usize,
    /// Units of the joints, rad or m.
    pub units: ByName<SiUnit>,
    /// The rest positions, that of least potential energy first.
    pub positions: Vec<RestPosition>,
    /// The reason for which there is none.
    pub none: Option<NoRest>,
    /// Random starts that were closed and followed to a rest position or not; 0 if only the given pose was.
    pub starts: usize,
    /// Their seed.
    pub seed: u64,
    /// The solutions of the equations of rest, if these are algebraic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub complete: Option<AllRest>,
    /// The reason for which they are not, so that random starts are left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_algebraic: Option<NotAlgebraic>,
    /// True if the search was interrupted.
    pub interrupted: bool,
    /// Correction of the given pose.
    #[serde(flatten)]
    pub pose: GivenPose,
}

/// A rest position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RestPosition {
    /// The configuration.
    #[serde(skip)]
    pub place: Option<Configuration<f64>>,
    /// Values of the joints, in rad and m.
    pub joints: ByName<f64>,
    /// Poses of the platforms.
    pub platforms: ByName<PlatformRecord>,
    /// Potential energy of weights and springs, in J.
    pub potential: f64,
    /// The force that is left along any independent coordinate, in N or N·m: rounding.
    pub left: f64,
    /// Its stability.
    pub stability: Stability,
    /// Small oscillations about it, slowest first; empty where bodies have no mass.
    pub modes: Vec<NaturalMode>,
    /// Compliance of each platform, and stiffness where it moves in all six directions.
    pub stiffness: Vec<Stiffness>,
    /// Joints outside their limits.
    pub outside_limits: Vec<String>,
}

/// Reasons for which no rest position is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NoRest {
    /// Nothing can move.
    Structure,
    /// The start is singular: branches of motion meet.
    Singular,
    /// The potential energy falls without end, or to a configuration beyond which nothing closes.
    Endless,
    /// A force has no value.
    NoForce,
}

impl From<NoDynamics> for NoRest {
    fn from(why: NoDynamics) -> Self {
        match why {
            NoDynamics::Singular | NoDynamics::NoCoordinates => NoRest::Singular,
            NoDynamics::NoForce => NoRest::NoForce,
        }
    }
}

/// Finds rest positions near the assembled configuration of a question: configurations at which the forces that act are
/// in balance along every motion.
///
/// Without `all` it walks down the potential energy from the start (argmin) and then solves Q(q) = 0 by Newton's method.
/// With it, the solutions of the [equations of rest](crate::system::RestEquations) are sought for generic complex loads until random
/// loops and starts bring no more, and followed to those of the mechanism (monodromy: Duff et al. 2019). Where the equations are not algebraic it goes from random assembled
/// starts, up as well as down, and from each by Newton's method alone.
/// A position is stable if the Hessian of the energy on the closed configurations, −∂Q/∂q, is positive definite.
pub fn equilibrium(
    question: &Question,
    load: &Load,
    settings: &EquilibriumSettings,
    watch: &Watch,
) -> Analysed<EquilibriumReport> {
    let mechanism = question.mechanism();
    let closed = match AssemblySettings::seeded(settings.seed).start(question, watch) {
        Ok(closed) => closed,
        Err(answer) => return answer,
    };
    let at = &closed.configuration;
    let mut report = EquilibriumReport {
        mechanism: mechanism.name().into(),
        freedoms: 0,
        units: (mechanism.joints().iter())
            .map(|joint| {
                (
                    joint.name.clone(),
                    SiUnit::of_coordinate(joint.kind.is_angle()),
                )
            })
            .collect(),
        positions: Vec::new(),
        none: None,
        starts: 0,
        seed: settings.seed,
        complete: None,
        not_algebraic: None,
        interrupted: false,
        pose: closed.pose(mechanism),
    };
    let still = Question::locking(mechanism, &settings.locked, at).with_spins_still();
    let held = (settings.locked.clone(), still.still().to_vec());
    let freedoms = RegularFreedoms::near(mechanism, at).map(|found| found.count() + found.idle());
    let freedoms = freedoms.unwrap_or(0);
    let left = freedoms.checked_sub(held.0.len() + held.1.len());
    let Some(left) = left.filter(|left| *left > 0) else {
        report.none = Some(NoRest::Structure);
        return Analysed::Closed(report);
    };
    report.freedoms = left;
    let from = Start {
        mechanism,
        load,
        held: &held,
        freedoms: left,
    };
    match from.fall(at, 1.0) {
        Ok(position) => report.positions.push(position),
        Err(why) => report.none = Some(why),
    }
    if settings.all {
        match from.all((at, settings.seed), &mut report, watch) {
            Ok(ended) => report.interrupted = !ended,
            Err(why) => {
                report.not_algebraic = Some(why);
                from.search(settings, watch, at, &mut report);
            }
        }
        sort_by(&mut report.positions, |a, b| {
            a.potential.total_cmp(&b.potential)
        });
        if !report.positions.is_empty() {
            report.none = None;
        }
    }
    Analysed::Closed(report)
}

/// Data shared by all starts of a search.
struct Start<'a> {
    mechanism: &'a Mechanism,
    load: &'a Load,
    held: &'a (Vec<Coordinate>, Vec<Still>),
    freedoms: usize,
}

impl<'a> Start<'a> {
    fn dynamics(&self, at: &Configuration<f64>) -> Result<Dynamics<'a>, NoRest> {
        let (locked, still) = self.held.clone();
        let held = (0, locked, still);
        Ok(Dynamics::new(
            self.mechanism,
            self.load,
            held,
            self.freedoms,
            at,
        )?)
    }

    /// The rest position downhill, or uphill for −1.
    fn fall(&self, at: &Configuration<f64>, sign: f64) -> Result<RestPosition, NoRest> {
        let mut dynamics = self.dynamics(at)?;
        descent::fall(&mut dynamics, sign)?;
        self.position(&mut dynamics)
    }

    /// The rest position to which Newton's method leads, of whatever kind.
    fn settle(&self, at: &Configuration<f64>) -> Result<RestPosition, NoRest> {
        let mut dynamics = self.dynamics(at)?;
        descent::settle(&mut dynamics)?;
        self.position(&mut dynamics)
    }

    fn position(&self, dynamics: &mut Dynamics) -> Result<RestPosition, NoRest> {
        oscillation::position(self.mechanism, dynamics)
    }

    /// Adds the rest positions to which random starts lead.
    fn search(
        &self,
        settings: &EquilibriumSettings,
        watch: &Watch,
        home: &Configuration<f64>,
        report: &mut EquilibriumReport,
    ) {
        let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
        let mut near = Neighbourhood::new(self.mechanism);
        for start in 0..settings.starts {
            if watch.stops(Stage::Starts, start, Some(settings.starts)) {
                report.interrupted = true;
                return;
            }
            let random = random_configuration(self.mechanism, home, &mut rng);
            let Some(at) = near.solve(&Newton::default(), random) else {
                continue;
            };
            report.starts += 1;
            let found = [self.fall(&at, 1.0), self.fall(&at, -1.0), self.settle(&at)];
            for position in found.into_iter().flatten() {
                self.add(position, report);
            }
        }
    }

    /// Adds a rest position if it is new.
    fn add(&self, position: RestPosition, report: &mut EquilibriumReport) {
        let mut known = report.positions.iter();
        if !known.any(|known| self.is_same(known, &position)) {
            report.positions.push(position);
        }
    }

    /// True if two rest positions are one: every joint is, angles modulo a turn, and every platform.
    fn is_same(&self, a: &RestPosition, b: &RestPosition) -> bool {
        let length = self.mechanism.characteristic_length();
        let joints = self.mechanism.joints().iter();
        let values = a.joints.values().zip(b.joints.values());
        let mut joints = joints
            .zip(values)
            .map(|(joint, (a, b))| match joint.kind.is_angle() {
                true => turn_near(a - b, 0.0).abs(),
                false => (a - b).abs() / length,
            });
        let mut platforms = a.platforms.values().zip(b.platforms.values());
        joints.all(|apart| apart < SAME)
            && platforms.all(|(a, b)| {
                let place = a.frame.position.iter().zip(b.frame.position);
                let turn = a.frame.rotation.iter().flatten();
                let turn = turn.zip(b.frame.rotation.iter().flatten());
                place
                    .map(|(x, y)| (x - y).abs() / length)
                    .all(|apart| apart < SAME)
                    && turn.map(|(x, y)| (x - y).abs()).all(|apart| apart < SAME)
            })
    }
}
