//! Circuits.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{AskError, Question};
use crate::analysis::assemblies::{Assembly, AssemblySolver, Fit, Wanted};
use crate::analysis::sweep::{CircuitsReport, CircuitsSettings, Slice, Swept, circuits};
use crate::description;
use crate::mechanism::{Configuration, Mechanism, PoseCoordinate, turn_near};
use crate::number::tolerance::SAME;
use crate::solve::{GOLDEN, Stage, Watch};
use crate::system::{self, Coordinate, check_count, sampling_range};

impl Question {
    /// All circuits and branches of a mechanism with one freedom, with the cusps and double points of the paths of the
    /// question's points.
    ///
    /// # Errors
    /// If the question is wrong or leaves another number of freedoms.
    pub fn circuits(&self, watch: &Watch) -> Result<CircuitsReport, AskError> {
        self.takes("circuits")?;
        let mechanism = &**self.mechanism();
        let released = self.one_freedom()?;
        let (input, question) = input(mechanism, &released)?;
        let question = question.with_spins_still();
        let held = question.with_still(released.held());
        let mut settings = CircuitsSettings {
            points: self.named_points()?,
            ..CircuitsSettings::default()
        };
        let at_rest = (&held, question.still());
        let follow =
            |seeds: &[_], settings: &_| circuits(mechanism, at_rest, input, seeds, settings, watch);
        let home = [question.start()];
        let mut report = match sliced(mechanism, &released, (input, &question)) {
            None => follow(&home, &settings),
            Some((joint, question)) => {
                let solver = self.solver(&question, watch)?;
                let mut values = vec![beside_home(mechanism, joint)];
                let mut uncovered = f64::INFINITY;
                loop {
                    let of =
                        |value: &f64| slice(mechanism, &question, &solver, (joint, *value), watch);
                    settings.slices.extend(values.iter().map(of));
                    let report = follow(&home, &settings);
                    // beyond values at which configurations go to infinity others begin
                    let gaps = report.swept.iter().flat_map(|swept| &swept.gaps);
                    values = gaps.clone().map(|[from, to]| 0.5 * (from + to)).collect();
                    let before = uncovered;
                    uncovered = gaps.map(|[from, to]| to - from).sum();
                    // more are looked at as long as less than 0.8 of what was uncovered is left
                    let most = settings.slices.len() >= MOST_SLICES || uncovered > 0.8 * before;
                    if values.is_empty() || most || watch.is_stopped() {
                        break report;
                    }
                }
            }
        };
        if !(report.swept.as_ref().is_some_and(Swept::is_whole) || watch.is_stopped()) {
            let solver = self.solver(&question, watch)?;
            let seeds = seeds(mechanism, &question, &solver, input, watch);
            report = follow(&[&home, &seeds[..]].concat(), &settings);
        }
        for (path, point) in report.paths.iter_mut().zip(&settings.points) {
            path.order = self.order(&point.point, watch);
        }
        report.interrupted |= watch.is_stopped();
        Ok(report)
    }

    /// The order of the path of a point: with so many different points, real or complex, a plane meets it. `None` if
    /// the search for them may have missed some.
    fn order(&self, point: &crate::mechanism::Point, watch: &Watch) -> Option<usize> {
        let cut = (self.mechanism()).with_point_on_a_plane(point.frame, point.offset);
        let length = cut.characteristic_length();
        let asked = Question {
            store: None,
            ..self.about(cut.into())
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
            .filter_map(|of| of.configuration().joints.last_chunk().copied())
            .map(|[x, y]| [[x, 0.0], [y, 0.0]]);
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
        let question = (released.clone()).at_values([(*of, of.of(mechanism, &home))]);
        match check_count(&question) {
            Ok(_) => return Ok((*of, question)),
            Err(error) if driven(of) => refused = refused.or(Some(error)),
            Err(_) => {}
        }
    }
    Err(refused.map_or(AskError::NotOneCoordinate, AskError::Question))
}

/// The joint along whose values complex configurations are followed, with the question that holds it too: the input if
/// it comes back to where it was, else another joint that does, else the input.
fn sliced<'q>(
    mechanism: &Mechanism,
    released: &system::Question<'q>,
    (input, question): (Coordinate, &system::Question<'q>),
) -> Option<(usize, system::Question<'q>)> {
    let repeats = |of: &Coordinate| match of {
        Coordinate::Joint(joint) => mechanism.turns_to_repeat(*joint).is_some(),
        _ => false,
    };
    let held = released.held_coordinates();
    let home = mechanism.home();
    let others = Coordinate::all(mechanism).filter(|of| repeats(of) && !held.contains(of));
    let all = Some(input).filter(repeats).into_iter().chain(others);
    let found = all.into_iter().find_map(|of| {
        let question = released.clone().at_values([(of, of.of(mechanism, &home))]);
        check_count(&question).is_ok().then_some((of, question))
    });
    match found.map_or((input, question.clone()), |(of, question)| {
        (of, question.with_spins_still())
    }) {
        (Coordinate::Joint(joint), question) => Some((joint, question)),
        _ => None,
    }
}

/// Values at most at which all configurations are found.
const MOST_SLICES: usize = 12;

/// rad or m in one unit of a joint's variable.
fn unit(mechanism: &Mechanism, joint: usize) -> f64 {
    match mechanism.joints()[joint].kind.is_angle() {
        true => 1.0,
        false => mechanism.characteristic_length(),
    }
}

/// A value of a joint that is not special, near home for one that does not come back.
fn beside_home(mechanism: &Mechanism, joint: usize) -> f64 {
    let home = mechanism.home().joints[joint];
    match mechanism.turns_to_repeat(joint) {
        Some(_) => turn_near(home + GOLDEN * TAU, 0.0),
        None => home + 0.1 * GOLDEN * unit(mechanism, joint),
    }
}

/// All configurations at a value of a joint.
fn slice(
    mechanism: &Mechanism,
    question: &system::Question,
    solver: &AssemblySolver,
    (joint, value): (usize, f64),
    watch: &Watch,
) -> Slice {
    let question = question
        .clone()
        .at_values([(Coordinate::Joint(joint), value)]);
    let wanted = Wanted {
        certificates: false,
        all_complex: true,
        ..Wanted::default()
    };
    let report = solver.at_targets(&question.start(), &question.held(), wanted, watch);
    // samples of sets of infinitely many have multiplicity 0
    let complex = report.complex_assemblies.iter();
    let complex: Vec<_> = complex.filter(|a| a.multiplicity > 0).collect();
    let isolated = report.assemblies.iter().filter(|a| a.multiplicity > 0);
    let simple = isolated.clone().all(|a| a.multiplicity == 1)
        && complex.iter().all(|a| a.multiplicity == 1);
    let mut real: Vec<_> = isolated.map(Assembly::configuration).collect();
    for at in &mut real {
        at.joints[joint] = value;
    }
    Slice {
        joint,
        value,
        // so far slides are followed
        reach: 5.0 * unit(mechanism, joint),
        real,
        complex: (complex.iter().map(|at| at.configuration(mechanism))).collect(),
        freedoms: match report.fit {
            Fit::FreedomLeft(freedoms) => freedoms,
            _ => 0,
        },
        whole: simple && !report.may_lack_some(),
    }
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
    let home = input.of(mechanism, &mechanism.home());
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
