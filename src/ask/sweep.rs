//! Motions and circuits.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::motions::Motions;
use super::quantities::Metered;
use super::ranges::still;
use super::{AskError, Mode, Question, Role};
use crate::analysis::assemblies::{Assembly, AssemblySolver, Wanted};
use crate::analysis::sweep::{
    CircuitsReport, CircuitsSettings, Sink, SweepReport, SweepSettings, circuits, sweep,
};
use crate::description;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate};
use crate::solve::{Stage, Watch};
use crate::system::{self, Coordinate, Driven, QuestionError, check_count, moved, sampling_range};

/// Steps made at most.
const MOST_STEPS: usize = 1_000_000_000;

impl Question {
    /// The motions of the inputs through their ranges; without inputs those along the whole curve of a mechanism with
    /// one freedom. Points of the question are traced beside those of the settings.
    ///
    /// # Errors
    /// If the question is wrong, or the mechanism does not assemble where the inputs begin.
    pub fn motions(
        &self,
        settings: &SweepSettings,
        watch: &Watch,
    ) -> Result<Motions<'_>, AskError> {
        let mechanism = &*self.mechanism;
        if self.inputs.is_empty() && !settings.follow {
            let driven = CircuitsReport::input_of(mechanism);
            let driven = driven.map(|joint| mechanism.joints()[joint].name.clone());
            return Err(AskError::NothingMoves(driven));
        }
        if !(1..=MOST_STEPS).contains(&settings.steps) {
            return Err(AskError::Steps {
                given: settings.steps,
                most: MOST_STEPS,
            });
        }
        let table = self.schedule.is_some();
        let inputs = self.driven(if table {
            |_, _| false
        } else {
            |from, to| from == to
        })?;
        // known modulo a turn
        let angle = |input: &&Driven| {
            input.coordinate.platform().is_some() && input.coordinate.is_angle(mechanism)
        };
        let wide = |input: &&Driven| (input.to - input.from).abs() > TAU * (1.0 + 1e-12);
        if let Some(input) = inputs.iter().filter(angle).find(wide) {
            return Err(AskError::MoreThanATurn(input.coordinate.name(mechanism)));
        }
        self.few_turns(&inputs)?;
        let begin: Vec<f64> = inputs.iter().map(|input| input.from).collect();
        let mut question = self.with_inputs(self.resolved()?, &begin)?;
        for (index, input) in inputs.iter().enumerate() {
            if let Coordinate::Joint(joint) = input.coordinate
                && let joint = &mechanism.joints()[joint]
                && let Some(limits) = joint.limits
                && !joint.allows(input.from)
            {
                return Err(AskError::OutsideLimits {
                    item: Role::Input.item(index),
                    name: joint.name.clone(),
                    limits,
                    is_angle: joint.kind.is_angle(),
                });
            }
        }
        let posed = question.clone();
        // everything but the inputs stands still; where none is given, the freedom is let go
        let held = match inputs.is_empty() {
            false => {
                check_count(&question).map_err(AskError::Question)?;
                question = question.with_spins_still();
                still(question.with_still(self.resolved()?.held()), &inputs)
            }
            true => {
                question = question.with_spins_still();
                question.with_still(self.one_freedom()?.held())
            }
        };
        let duration = settings.pace.duration;
        if !(duration > 0.0 && duration.is_finite()) {
            return Err(AskError::Duration(duration));
        }
        let mut pace = settings.pace;
        if let Some(schedule) = &self.schedule {
            pace.duration = schedule.duration();
        }
        let settings = SweepSettings {
            pace,
            schedule: self.schedule.clone(),
            points: [&settings.points[..], &self.named_points()?].concat(),
            ..settings.clone()
        };
        let mut quantities = self.quantities(&posed, !inputs.is_empty(), &settings.points)?;
        let dwells = self.tolerances(&posed, &mut quantities)?;
        let starts = self.starts(&question, watch)?;
        let moved = match (self.mode, &starts[..]) {
            (Mode::Nearest, [(_, at)]) => moved(&question, at),
            _ => None,
        };
        Ok(Motions {
            mechanism,
            held,
            dwells,
            metered: Metered {
                quantities,
                inputs,
                pace,
                schedule: self.schedule.clone(),
                load: self.load_of(&posed)?,
                outputs: self.asked_outputs()?,
                question: posed,
            },
            settings,
            starts,
            moved,
        })
    }

    /// The motion along the whole curve through an assembled configuration, whatever moves it: driven joints that are
    /// held there are let go. Rows trace the question's points.
    ///
    /// # Errors
    /// If the question is wrong or leaves another number of freedoms.
    pub fn through(
        &self,
        at: &Configuration<f64>,
        sink: &mut Sink,
        watch: &Watch,
    ) -> Result<SweepReport, AskError> {
        let mut asked = self.clone();
        if let Err(AskError::NothingLeft(_)) = asked.one_freedom() {
            let joints = self.mechanism.joints();
            let driven = |name: &str| {
                let joint = self.mechanism.joint(name);
                joint.is_some_and(|joint| joints[joint].role == description::Role::Actuated)
            };
            asked.hold.retain(|(name, _)| !driven(name));
        }
        let question = asked.one_freedom()?.with_spins_still();
        let held = question.with_still(question.held());
        let settings = SweepSettings {
            points: self.named_points()?,
            ..SweepSettings::default()
        };
        let mechanism = &self.mechanism;
        Ok(sweep(mechanism, &held, &[], at, &settings, sink, watch))
    }

    /// All circuits and branches of a mechanism with one freedom, with the cusps and double points of the paths of the
    /// question's points.
    ///
    /// # Errors
    /// If the question is wrong or leaves another number of freedoms.
    pub fn circuits(&self, watch: &Watch) -> Result<CircuitsReport, AskError> {
        let mechanism = &*self.mechanism;
        let released = self.one_freedom()?;
        let (input, question) = input(mechanism, &released)?;
        let question = question.with_spins_still();
        let solver = self.solver(&question, watch)?;
        let seeds = seeds(mechanism, &question, &solver, input, watch);
        let held = question.with_still(released.held());
        let settings = CircuitsSettings {
            points: self.named_points()?,
            ..CircuitsSettings::default()
        };
        let held = (&held, question.still());
        let mut report = circuits(mechanism, held, input, &seeds, &settings, watch);
        for (path, point) in report.paths.iter_mut().zip(&settings.points) {
            path.order = self.order(&point.point, watch);
        }
        report.interrupted |= watch.is_stopped();
        Ok(report)
    }

    /// The order of the path of a point: with so many different points, real or complex, a plane meets it. `None` if
    /// the search for them may have missed some.
    fn order(&self, point: &crate::mechanism::Point, watch: &Watch) -> Option<usize> {
        /// Points this near, over the characteristic length, are one that several configurations share.
        const SAME: f64 = 1e-6;
        let cut = (self.mechanism).with_point_on_a_plane(point.frame, point.offset);
        let length = cut.characteristic_length();
        let asked = Question {
            mechanism: cut.into(),
            store: None,
            ..self.clone()
        };
        let question = asked.released().ok()?;
        check_count(&question).ok()?;
        let wanted = Wanted {
            certificates: false,
            all_complex: true,
            starts: false,
            proof: None,
        };
        let report = asked
            .all(&question.with_spins_still(), wanted, watch)
            .ok()?;
        if report.may_lack_some() || report.not_isolated > 0 {
            return None;
        }
        // the slides in the plane
        let real = (report.assemblies.iter())
            .filter_map(|of| of.joints.0.last_chunk())
            .map(|[(_, x), (_, y)]| [[*x, 0.0], [*y, 0.0]]);
        let complex = (report.complex_assemblies.iter())
            .filter_map(|of| of.joints.0.last_chunk())
            .map(|[(_, x), (_, y)]| [*x, *y]);
        let mut places: Vec<[[f64; 2]; 2]> = Vec::new();
        for place in real.chain(complex) {
            let known = places.iter().any(|other| {
                let parts = other.iter().flatten().zip(place.iter().flatten());
                parts.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < SAME * length
            });
            if !known {
                places.push(place);
            }
        }
        Some(places.len())
    }

    /// The question that leaves one freedom: actuated joints are held only if that is asked for.
    fn one_freedom(&self) -> Result<system::Question<'_>, AskError> {
        let question = self.released()?;
        match check_count(&question) {
            Err(QuestionError::TooFew { mobility, held, .. }) if mobility == held + 1 => {
                Ok(question)
            }
            Ok(_) | Err(QuestionError::TooMany { .. }) => {
                Err(AskError::NothingLeft(question.held_names()))
            }
            Err(error @ QuestionError::TooFew { .. }) => Err(AskError::NotOneFreedom(error)),
            Err(error) => Err(AskError::Question(error)),
        }
    }
}

/// The coordinate that moves where one freedom is left, with the question that holds it too: a driven joint, else a
/// passive one, else a coordinate of a platform.
fn input<'q>(
    mechanism: &Mechanism,
    released: &system::Question<'q>,
) -> Result<(Coordinate, system::Question<'q>), AskError> {
    let held = released.held_coordinates();
    let driven = |of: &Coordinate| match of {
        Coordinate::Joint(joint) => mechanism.joints()[*joint].role == description::Role::Actuated,
        _ => false,
    };
    // an angle beside a whole orientation that is held does not move
    let turned = |of: &Coordinate| {
        let whole =
            |h: &Coordinate| matches!(h, Coordinate::Turn(p, _) if of.platform() == Some(*p));
        of.platform().is_some() && of.is_angle(mechanism) && held.iter().any(whole)
    };
    let (first, rest): (Vec<Coordinate>, Vec<Coordinate>) = Coordinate::all(mechanism)
        .filter(|of| !held.contains(of) && !turned(of))
        .partition(driven);
    let home = mechanism.home();
    let mut refused = None;
    for of in first.iter().chain(&rest) {
        let question = (released.clone()).at_values([(*of, of.of(&home))]);
        match check_count(&question) {
            Ok(_) => return Ok((*of, question)),
            Err(error) if driven(of) => refused = refused.or(Some(error)),
            Err(_) => {}
        }
    }
    Err(refused.map_or(AskError::NotOneCoordinate, AskError::Question))
}

/// All assemblies at home and at values of the input spread over its range.
fn seeds(
    mechanism: &Mechanism,
    question: &system::Question,
    solver: &AssemblySolver,
    input: Coordinate,
    watch: &Watch,
) -> Vec<Configuration<f64>> {
    const VALUES: u32 = 12;
    let home = input.of(&mechanism.home());
    let length = mechanism.characteristic_length();
    let (low, high) = match input {
        Coordinate::Joint(joint) => match mechanism.joints()[joint].limits {
            Some(limits) => limits,
            None if mechanism.repeats(joint) => (home, home + TAU),
            None => sampling_range(&mechanism.joints()[joint], home, length),
        },
        Coordinate::Pose(_, PoseCoordinate::Pitch) => (-FRAC_PI_2, FRAC_PI_2),
        of if of.is_angle(mechanism) => (home, home + TAU),
        _ => (home - 2.0 * length, home + 2.0 * length),
    };
    let wanted = Wanted {
        certificates: false,
        ..Wanted::default()
    };
    let mut seeds = Vec::new();
    for k in 0..=VALUES {
        if watch.stops(Stage::Inputs, k as usize, Some(VALUES as usize + 1)) {
            break;
        }
        // uneven, so that nothing special is hit
        let part = (f64::from(k) - 0.618_034) / f64::from(VALUES);
        let value = if k > 0 {
            low + part * (high - low)
        } else {
            home
        };
        let question = question.clone().at_values([(input, value)]);
        let at = question.start();
        let report = solver.at_targets(&at, &question.held(), wanted, watch);
        let found = report.assemblies.iter();
        seeds.extend(found.map(Assembly::configuration));
    }
    seeds
}
