//! Motions and circuits.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::quantities::{Extremes, Meter, Metered};
use super::ranges::still;
use super::{AskError, Question, Role};
use crate::algebra::SiUnit;
use crate::analysis::assemblies::{AssemblySolver, Wanted};
use crate::analysis::sweep::{
    CircuitsReport, CircuitsSettings, Columns, Extremum, KeptRows, MotionReport, MotionsReport,
    Row, Sink, SweepReport, SweepSettings, circuits, follow, sweep,
};
use crate::description;
use crate::mechanism::{Configuration, Mechanism, Point, PoseCoordinate, Quantity, Variable};
use crate::solve::{Stage, Watch};
use crate::system::{
    self, Coordinate, Driven, Held, Load, Lock, QuestionError, check_count, sampling_range,
};

/// Steps made at most.
const MOST_STEPS: usize = 1_000_000_000;

/// Motions that can begin: of one mode or of several.
#[derive(Clone, Debug)]
pub struct Motions<'q> {
    mechanism: &'q Mechanism,
    held: Held<f64>,
    settings: SweepSettings,
    /// With the inputs held.
    question: system::Question<'q>,
    quantities: Vec<Quantity>,
    load: Load,
    outputs: Vec<Lock>,
    /// The inputs; none where the whole curve is followed.
    pub inputs: Vec<Driven>,
    /// Where each begins, with the number of its mode if one was asked for.
    pub starts: super::Modes,
}

impl Motions<'_> {
    /// The points that are traced.
    pub fn points(&self) -> &[Point] {
        &self.settings.points
    }

    /// What the columns of rows are.
    pub fn columns(&self) -> Columns {
        Columns::new(self.mechanism, self.points(), self.quantities())
    }

    /// What the columns of quantities are: the time if any is asked for and inputs move, then these.
    pub fn quantities(&self) -> Vec<Variable> {
        let of = |quantity: &Quantity| Variable::new(&quantity.name, quantity.unit);
        let quantities: Vec<Variable> = self.quantities.iter().map(of).collect();
        let timed = !quantities.is_empty() && !self.inputs.is_empty();
        let time = timed.then(|| Variable::new("time", SiUnit::SECOND));
        time.into_iter().chain(quantities).collect()
    }

    /// The part of the time that is gone where the inputs are.
    fn time(&self, at: &Configuration<f64>) -> f64 {
        let joint = |input: &&Driven| matches!(input.coordinate, Coordinate::Joint(_));
        let measure = self.inputs.iter().find(joint).or(self.inputs.first());
        let part = measure.map_or(0.0, |input| {
            let way = input.to - input.from;
            let gone = input.coordinate.of(at) - input.from;
            match input.coordinate {
                Coordinate::Joint(_) => gone / way,
                // an angle of a platform is told modulo a turn
                of if of.is_angle(self.mechanism) => {
                    let middle = 0.5 * way;
                    (middle + (gone - middle + PI).rem_euclid(TAU) - PI) / way
                }
                _ => gone / way,
            }
        });
        self.settings.pace.law.inverse(part.clamp(0.0, 1.0))
    }

    /// The same with rows between those asked for, so near to one another that a line through them looks smooth.
    #[must_use]
    pub fn smooth(mut self, smooth: bool) -> Self {
        self.settings.between = smooth;
        self
    }

    /// Moves from every start and keeps no more than `most` rows of each motion. All rows go to `sink` as they are
    /// found, with the number of their mode.
    pub fn report(
        &self,
        most: usize,
        sink: &mut dyn FnMut(Option<usize>, &Row),
        watch: &Watch,
    ) -> MotionsReport {
        let columns = self.columns();
        let mut motions = Vec::new();
        for (mode, start) in &self.starts {
            let mut rows = KeptRows::of(most);
            let mut take = |row: &Row| {
                if !row.between {
                    rows.take(&columns, row);
                }
                sink(*mode, row);
            };
            let (sweep, extremes) = self.measured(start, &mut take, watch);
            let interrupted = sweep.interrupted;
            motions.push(MotionReport {
                mode: *mode,
                sentence: String::new(),
                sweep,
                pace: (!self.inputs.is_empty()).then_some(self.settings.pace),
                extremes,
                columns: columns.variables().to_vec(),
                values: rows.finished(),
            });
            if interrupted {
                break;
            }
        }
        MotionsReport {
            mechanism: self.mechanism.name().to_owned(),
            motions,
        }
    }

    /// Moves from one of the starts. Rows go to `sink` as they are found.
    pub fn run(&self, start: &Configuration<f64>, sink: &mut Sink, watch: &Watch) -> SweepReport {
        self.measured(start, sink, watch).0
    }

    /// The same with the extremes of the quantities, which are sought between rows too.
    fn measured(
        &self,
        start: &Configuration<f64>,
        sink: &mut Sink,
        watch: &Watch,
    ) -> (SweepReport, Vec<Extremum>) {
        if self.quantities.is_empty() {
            return (self.moved(start, sink, watch), Vec::new());
        }
        let metered = Metered {
            quantities: &self.quantities,
            question: &self.question,
            inputs: &self.inputs,
            pace: self.settings.pace,
            load: &self.load,
            outputs: &self.outputs,
        };
        let mut meter = Meter::new(metered, start);
        let mut extremes = Extremes::new(self.quantities.len());
        let timed = !self.inputs.is_empty();
        let mut values = Vec::new();
        let steps = self.settings.steps as f64;
        let mut measured = |row: &Row| {
            let at = row.configuration;
            let time = row
                .step
                .map_or_else(|| self.time(at), |step| step as f64 / steps);
            let found = meter.read(at, time);
            if !row.between {
                extremes.take(at, found);
            }
            values.clear();
            values.extend(timed.then_some(Some(time * self.settings.pace.duration)));
            values.extend_from_slice(found);
            sink(&Row {
                quantities: &values,
                ..*row
            });
        };
        let report = self.moved(start, &mut measured, watch);
        let found = extremes.located(
            &self.quantities,
            self.mechanism,
            (&self.held, &self.inputs),
            &mut meter,
            &|at| self.time(at),
        );
        (report, found)
    }

    fn moved(&self, start: &Configuration<f64>, sink: &mut Sink, watch: &Watch) -> SweepReport {
        let Motions {
            mechanism,
            held,
            settings,
            inputs,
            ..
        } = self;
        match inputs.is_empty() {
            true => follow(mechanism, held, start, settings, sink, watch),
            false => sweep(mechanism, held, inputs, start, settings, sink, watch),
        }
    }
}

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
            return Err(AskError::NothingMoves {
                driven: driven.map(|joint| mechanism.joints()[joint].name.clone()),
            });
        }
        if !(1..=MOST_STEPS).contains(&settings.steps) {
            return Err(AskError::Steps {
                given: settings.steps,
                most: MOST_STEPS,
            });
        }
        let inputs = self.driven(|from, to| from == to)?;
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
        let settings = SweepSettings {
            points: [&settings.points[..], &self.asked_points()?].concat(),
            ..settings.clone()
        };
        let quantities = self.quantities(&posed, &settings.points)?;
        Ok(Motions {
            mechanism,
            held,
            quantities,
            load: self.load_of(&posed)?,
            outputs: self.asked_outputs()?,
            question: posed,
            settings,
            inputs,
            starts: self.starts(&question, watch)?,
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
        if let Err(AskError::NothingLeft { .. }) = asked.one_freedom() {
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
            points: self.asked_points()?,
            follow: true,
            ..SweepSettings::default()
        };
        Ok(follow(&self.mechanism, &held, at, &settings, sink, watch))
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
            points: self.asked_points()?,
            ..CircuitsSettings::default()
        };
        let mut report = circuits(mechanism, &held, input, &seeds, &settings, watch);
        for (path, point) in report.paths.iter_mut().zip(&settings.points) {
            path.order = self.order(point, watch);
        }
        report.interrupted |= watch.is_stopped();
        Ok(report)
    }

    /// The order of the path of a point: with so many different points, real or complex, a plane meets it. `None` if
    /// the search for them may have missed some.
    fn order(&self, point: &Point, watch: &Watch) -> Option<usize> {
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
        };
        let report = asked
            .all(&question.with_spins_still(), wanted, watch)
            .ok()?;
        if report.may_lack_some() || report.not_isolated > 0 || report.interrupted {
            return None;
        }
        let real = report.assemblies.iter().map(|of| {
            let values = of.joints.0.iter().map(|(_, x)| [*x, 0.0]);
            values.collect::<Vec<_>>()
        });
        let complex = report.complex_assemblies.iter().map(|of| {
            let values = of.joints.0.iter().map(|(_, x)| *x);
            values.collect::<Vec<_>>()
        });
        let mut places: Vec<Vec<[f64; 2]>> = Vec::new();
        for joints in real.chain(complex) {
            // the slides in the plane
            let place = joints[joints.len() - 2..].to_vec();
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
            Ok(_) | Err(QuestionError::TooMany { .. }) => Err(AskError::NothingLeft {
                held: question.held_names(),
            }),
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
        seeds.extend(found.map(|assembly| assembly.configuration(&at)));
    }
    seeds
}
