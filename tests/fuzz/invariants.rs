//! What must hold for every answer, whatever the mechanism.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use linkwork::analysis::assemblies::{AssembliesReport, Fit, Wanted};
use linkwork::analysis::assembly::{AssemblySettings, Outcome};
use linkwork::analysis::convert::{ConvertSettings, convert, possible_cuts};
use linkwork::analysis::mobility::{Character, LocalFreedom, MobilityReport};
use linkwork::ask::{AskError, Question, Solved};
use linkwork::description::{Description, Role};
use linkwork::mechanism::{Configuration, Mechanism};
use linkwork::output::Report;
use linkwork::solve::{Progress, Watch};
use linkwork::system::QuestionError;

use crate::generator::Dice;
use crate::kinematics::Placed;
use crate::motions::motions;
use crate::questions::Asked;

/// What went wrong, in words.
pub type Broken = Result<(), String>;

macro_rules! hold {
    ($holds:expr, $($said:tt)+) => {
        match $holds {
            true => {}
            false => return Err(format!($($said)+)),
        }
    };
}

/// How far a case is followed before it is left.
pub struct Budget {
    /// Calls of a watch for one answer.
    pub steps: usize,
}

impl Budget {
    /// The answer, and whether it was left unfinished.
    pub fn spend<R>(&self, work: impl FnOnce(&Watch) -> R) -> (R, bool) {
        let steps = AtomicUsize::new(0);
        let observer = |_: Progress| match steps.fetch_add(1, Ordering::Relaxed) < self.steps {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        };
        let watch = Watch::new(&observer);
        let answer = work(&watch);
        (answer, watch.is_stopped())
    }
}

pub fn read(text: &str) -> Result<Mechanism, String> {
    let description = Description::read(text).map_err(|p| format!("not read: {p:?}"))?;
    let mechanism = Mechanism::new(&description).map_err(|p| format!("refused: {p:?}"))?;
    let again = description
        .to_ron()
        .map_err(|e| format!("not written: {e}"))?;
    let again = Description::read(&again).map_err(|p| format!("not read back: {p:?}"))?;
    let again = Mechanism::new(&again).map_err(|p| format!("refused when read back: {p:?}"))?;
    hold!(
        again.dimensions() == mechanism.dimensions() && again.home() == mechanism.home(),
        "another mechanism is read back"
    );
    Ok(mechanism)
}

/// All that is asked of a mechanism that is assembled at home.
pub fn check(mechanism: &Mechanism, asked: &Asked, budget: &Budget) -> Broken {
    let question = asked.of(mechanism);
    mobility(&question, budget)?;
    let solved = solution(&question, budget)?;
    assemblies(&question, solved.as_ref(), budget)?;
    if let Some((at, true)) = &solved {
        rates(asked, mechanism, at, budget)?;
        motions(
            asked,
            mechanism,
            at,
            budget,
            &mut Dice::new(asked.line().len() as u64),
        )?;
    }
    Ok(())
}

/// A report's words and whether they are a yes, which is what the exit status says.
fn said(report: &impl Report) -> (String, bool) {
    let document = report.document();
    let words = [vec![document.answer], document.notes, document.method].concat();
    (words.join("\n"), report.is_yes())
}

pub fn mobility(question: &Question, budget: &Budget) -> Broken {
    let mut reports: Vec<MobilityReport> = Vec::new();
    for seed in [1, 2] {
        let (answer, left) = budget.spend(|watch| question.clone().seed(seed).mobility(watch));
        let answer = answer.map_err(|e| format!("mobility: {e}"))?;
        let Some(report) = answer.closed() else {
            return Ok(());
        };
        if left || report.interrupted {
            return Ok(());
        }
        let (words, _) = said(&report);
        hold!(
            report.infinitesimal >= report.mobility || report.gimbal_locked > 0,
            "more finite freedoms than infinitesimal ones: {words}"
        );
        hold!(
            report.kutzbach == report.unknowns as i64 - report.equations as i64,
            "Kutzbach's count is no difference: {words}"
        );
        hold!(
            report.rank + report.redundant == report.equations,
            "rank {} and {} dependent of {} equations",
            report.rank,
            report.redundant,
            report.equations
        );
        let idle = report.idle_freedoms.iter();
        let idle = idle.filter(|of| !matches!(of, LocalFreedom::Rod(_)));
        let freedoms = report.infinitesimal + idle.count();
        hold!(
            report.rank + freedoms == report.unknowns || report.gimbal_locked > 0,
            "rank {} and {freedoms} infinitesimal freedoms, idle ones among them, of {} unknowns: {words}",
            report.rank,
            report.unknowns
        );
        let regular = matches!(report.character, Character::Regular | Character::Structure);
        hold!(
            !regular || report.infinitesimal == report.mobility || report.gimbal_locked > 0,
            "regular, and infinitesimal freedoms are not finite: {words}"
        );
        reports.push(report);
    }
    let [a, b] = &reports[..] else {
        unreachable!("two seeds")
    };
    let key = |r: &MobilityReport| {
        (
            r.mobility,
            r.rank,
            r.infinitesimal,
            r.character,
            r.gimbal_locked,
        )
    };
    hold!(
        key(a) == key(b),
        "mobilities by seed: {:?} and {:?}",
        key(a),
        key(b)
    );
    Ok(())
}

/// The mechanism broken at other joints has the freedoms it has.
pub fn other_cuts(text: &str, budget: &Budget) -> Broken {
    let description = Description::read(text).map_err(|p| format!("not read: {p:?}"))?;
    let count = |description: &Description| {
        let mechanism = Mechanism::new(description).map_err(|p| format!("refused: {p:?}"))?;
        let (answer, left) = budget.spend(|watch| Question::new(mechanism).mobility(watch));
        let report = answer.map_err(|e| format!("mobility: {e}"))?.closed();
        // angles of rows stand in gimbal lock where those of another cut do not
        let whole = |r: &MobilityReport| !left && !r.interrupted && r.gimbal_locked == 0;
        Ok::<_, String>(report.filter(whole).map(|r| (r.mobility, r.infinitesimal)))
    };
    let Some(freedoms) = count(&description)? else {
        return Ok(());
    };
    let mechanism = Mechanism::new(&description).map_err(|p| format!("refused: {p:?}"))?;
    // a driven link whose spin counts is no longer driven when its joint is broken
    let passive = |name: &String| {
        let joint = mechanism.joint(name);
        joint.is_none_or(|joint| mechanism.joints()[joint].role == Role::Passive)
    };
    let mut cuts = possible_cuts(&mechanism, &description);
    cuts.retain(passive);
    for joint in cuts.iter().step_by(1 + cuts.len() / 2) {
        let settings = ConvertSettings {
            cut: Some(joint.clone()),
            ..ConvertSettings::default()
        };
        let conversion = convert(&mechanism, &description, &settings);
        let conversion = conversion.map_err(|e| format!("not cut at {joint}: {e}"))?;
        let cut = count(&conversion.description)?;
        hold!(
            cut.is_none_or(|cut| cut == freedoms),
            "freedoms, finite and infinitesimal: {freedoms:?}, and {cut:?} when cut at {joint}"
        );
    }
    Ok(())
}

/// The assembly near home, and whether it is a regular one.
fn solution(
    question: &Question,
    budget: &Budget,
) -> Result<Option<(Configuration<f64>, bool)>, String> {
    let (answer, left) = budget.spend(|watch| question.solve(&AssemblySettings::default(), watch));
    let report = match answer {
        Ok(Solved::Ended(report)) => report,
        Ok(Solved::Lost(_)) => return Err("a mode is lost that nobody asked for".into()),
        Err(AskError::Question(error)) => {
            return sensible(&error).map(|()| None);
        }
        Err(error) => return Err(format!("solve: {error}")),
    };
    let at = report.configuration();
    let mechanism = question.mechanism();
    let gap = Placed { mechanism, at: &at }.gap();
    match report.is_assembled() {
        true => hold!(gap < 1e-8, "assembled with a gap of {gap:e}"),
        false => {
            hold!(gap > 1e-13, "not assembled with a gap of {gap:e}");
            let home = mechanism.home();
            let held_home = question.clone().resolved().is_ok_and(|q| q.start() == home);
            hold!(
                left || !held_home,
                "home is assembled and not found: {:?}",
                report.outcome
            );
            return Ok(None);
        }
    }
    let regular = matches!(
        report.outcome,
        Outcome::Converged | Outcome::ConvergedOutsideLimits { .. }
    );
    Ok(Some((
        at,
        regular && report.condition < 1e6 && report.left.is_none() && report.idle == 0,
    )))
}

/// An error that a question of the right form may meet.
fn sensible(error: &QuestionError) -> Broken {
    match error {
        QuestionError::TooMany { .. }
        | QuestionError::TooFew { .. }
        | QuestionError::Dependent { .. }
        | QuestionError::AnglesLocked(_) => Ok(()),
        _ => Err(format!("not to be expected: {error}")),
    }
}

fn assemblies(
    question: &Question,
    solved: Option<&(Configuration<f64>, bool)>,
    budget: &Budget,
) -> Broken {
    let mechanism = question.mechanism();
    let wanted = Wanted {
        all_complex: true,
        ..Wanted::default()
    };
    let mut reports: Vec<AssembliesReport> = Vec::new();
    for seed in [1, 2] {
        let (answer, left) =
            budget.spend(|watch| question.clone().seed(seed).assemblies(wanted, watch));
        let report = match answer {
            Ok(report) => report,
            Err(AskError::Question(error)) => return sensible(&error),
            Err(error) => return Err(format!("assemblies: {error}")),
        };
        if left || report.interrupted {
            return Ok(());
        }
        consistent(mechanism, &report, solved)
            .map_err(|broken| format!("seed {seed}: {broken}"))?;
        reports.push(report);
    }
    let [a, b] = &reports[..] else {
        unreachable!("two seeds")
    };
    let sure =
        !a.may_lack_some() && !b.may_lack_some() && a.fit == Fit::Finite && b.fit == Fit::Finite;
    if sure {
        let key = |r: &AssembliesReport| {
            let isolated = r.assemblies.iter().filter(|a| a.multiplicity > 0).count();
            let sets: Vec<usize> = r.continua.iter().map(|set| set.dimension).collect();
            (r.complex, isolated, r.generic, sets)
        };
        hold!(
            key(a) == key(b),
            "assemblies by seed: {:?} and {:?}",
            key(a),
            key(b)
        );
    }
    let sure = !a.may_lack_some() && !b.may_lack_some();
    hold!(
        !sure || a.fit == b.fit,
        "by seed: {:?} and {:?}",
        a.fit,
        b.fit
    );
    Ok(())
}

fn consistent(
    mechanism: &Mechanism,
    report: &AssembliesReport,
    solved: Option<&(Configuration<f64>, bool)>,
) -> Broken {
    let (words, yes) = said(report);
    hold!(
        report.real == report.assemblies.len(),
        "{} real, {} listed",
        report.real,
        report.assemblies.len()
    );
    let points: Vec<Configuration<f64>> = (report.assemblies.iter())
        .map(|a| a.configuration())
        .collect();
    for (i, at) in points.iter().enumerate() {
        let placed = Placed { mechanism, at };
        let gap = placed.gap();
        // where solutions meet only half the digits are known
        let known = if report.assemblies[i].multiplicity == 1 {
            1e-8
        } else {
            1e-6
        };
        let size = at
            .joints
            .iter()
            .map(|q| q.abs() / mechanism.characteristic_length())
            .fold(1.0, f64::max);
        hold!(gap < known * size, "mode {} has a gap of {gap:e}", i + 1);
        for (k, other) in points[..i].iter().enumerate() {
            let apart = placed.apart(other);
            hold!(
                apart > 1e-9,
                "modes {} and {} are one: {apart:e} apart",
                k + 1,
                i + 1
            );
        }
    }
    let doubtful = [
        "may be missing",
        "may be incomplete",
        "may be more",
        "not decided",
    ];
    let doubted = doubtful.iter().any(|doubt| words.contains(doubt));
    let sampled = matches!(report.fit, Fit::FreedomLeft(_));
    hold!(
        sampled || doubted != yes || report.real == 0,
        "status {yes}: {words}"
    );
    hold!(
        yes || report.real == 0 || report.may_lack_some(),
        "status {yes}: {words}"
    );
    if report.fit == Fit::Finite {
        let real: usize = report.assemblies.iter().map(|a| a.multiplicity).sum();
        let others: usize = report
            .complex_assemblies
            .iter()
            .map(|c| c.multiplicity)
            .sum();
        hold!(
            others.is_multiple_of(2),
            "{others} solutions that are not real: {words}"
        );
        if !report.may_lack_some() {
            hold!(
                real + others == report.complex,
                "{real} real and {others} other solutions are not {}",
                report.complex
            );
            let all =
                report.complex + report.at_infinity + report.not_isolated + report.half_a_turn_away;
            hold!(
                all == report.generic,
                "{all} solutions of {} paths: {words}",
                report.generic
            );
        }
        if let Some(bound) = report.bound {
            hold!(
                report.generic <= bound,
                "{} solutions beyond the bound of {bound}",
                report.generic
            );
        }
        let connected = !report.continua.is_empty();
        if let (Some((at, true)), false, true) = (
            solved,
            connected,
            yes || report.real == 0 && !report.may_lack_some(),
        ) {
            let placed = Placed { mechanism, at };
            let listed = points.iter().any(|point| placed.apart(point) < 1e-4);
            hold!(
                listed,
                "the assembly that `solve` finds is not listed: {words}"
            );
        }
    }
    Ok(())
}

/// Rates against differences of solved positions, and forces by virtual work against rates.
fn rates(asked: &Asked, mechanism: &Mechanism, at: &Configuration<f64>, budget: &Budget) -> Broken {
    const STEP: f64 = 1e-5;
    let length = mechanism.characteristic_length();
    let question = asked.of(mechanism);
    let resolved = question.resolved().map_err(|e| e.to_string())?;
    for name in resolved.held_names() {
        let Ok((coordinate, _)) = resolved.value(&name, "home") else {
            continue;
        };
        let unit = if coordinate.is_angle(mechanism) {
            1.0
        } else {
            length
        };
        let here = coordinate.of(mechanism, at);
        let mut fixed = Question::new(mechanism.clone()).free("actuated");
        for other in resolved.held_names() {
            let Ok((of, _)) = resolved.value(&other, "home") else {
                continue;
            };
            if other != name {
                fixed = fixed.hold(&other, of.of(mechanism, at));
            }
        }
        let still = near(fixed.clone().hold(&name, here), mechanism, at);
        let (answer, _) = budget.spend(|watch| still.clone().rate(&name, unit).velocity(watch));
        let Ok(answer) = answer else { return Ok(()) };
        let Some(report) = answer.closed() else {
            return Ok(());
        };
        if !report.is_determined() {
            return Ok(());
        }
        let beside = |by: f64| -> Result<Option<Configuration<f64>>, String> {
            let moved = fixed.clone().hold(&name, here + by * unit);
            let moved = near(moved, mechanism, at);
            let settings = AssemblySettings {
                restarts: 0,
                ..AssemblySettings::default()
            };
            let (answer, _) = budget.spend(|watch| moved.solve(&settings, watch));
            match answer {
                Ok(Solved::Ended(report)) => {
                    Ok(report.is_assembled().then(|| report.configuration()))
                }
                Ok(Solved::Lost(_)) => Ok(None),
                Err(error) => Err(format!("solve beside: {error}")),
            }
        };
        let mut differences = Vec::new();
        for step in [STEP, 2.0 * STEP] {
            let (Some(after), Some(before)) = (beside(step)?, beside(-step)?) else {
                return Ok(());
            };
            let joints = after.joints.iter().zip(&before.joints);
            differences.push(
                joints
                    .map(|(a, b)| (a - b) / (2.0 * step))
                    .collect::<Vec<f64>>(),
            );
        }
        for (j, joint) in report.joints.iter().enumerate() {
            let Some(rate) = joint.rate else { continue };
            let unit = match mechanism.joints()[j].kind.is_angle() {
                true => 1.0,
                false => length,
            };
            let [fine, coarse] = [0, 1].map(|k| differences[k][j] / unit);
            let rate = rate / unit;
            // near a fold differences over different steps differ
            let known = 1e-4 * (1.0 + rate.abs()) + 2.0 * (fine - coarse).abs();
            hold!(
                (rate - fine).abs() < known,
                "rate of {} with {name}: {rate} and by differences {fine}",
                joint.name
            );
        }
        virtual_work(&still, &report, &name, unit, budget)?;
    }
    Ok(())
}

/// Starts where the mechanism is assembled.
pub fn near(question: Question, mechanism: &Mechanism, at: &Configuration<f64>) -> Question {
    let held = question
        .resolved()
        .map(|q| q.held())
        .expect("the names are right");
    let joints = mechanism
        .joints()
        .iter()
        .enumerate()
        .filter(|(j, _)| !held.joints[*j]);
    let mut question = joints.fold(question.clone(), |q, (j, joint)| {
        q.guess(&joint.name, at.joints[j])
    });
    for (platform, pose) in mechanism.platforms().iter().zip(&at.platforms) {
        for coordinate in linkwork::mechanism::PoseCoordinate::ALL {
            let name = format!("{}.{}", platform.name, coordinate.word());
            let with = question.clone().guess(name, coordinate.of(&pose.pose()));
            if with.resolved().is_ok() {
                question = with;
            }
        }
    }
    question
}

fn virtual_work(
    question: &Question,
    report: &linkwork::analysis::velocity::VelocityReport,
    name: &str,
    unit: f64,
    budget: &Budget,
) -> Broken {
    let force = [3.0, -2.0, 1.0];
    let moment = [0.3, 0.5, -0.7].map(|m| m * report.normalising_length);
    for frame in &report.frames {
        let loaded = question.clone().wrench(&frame.name, force, moment);
        let (answer, _) = budget.spend(|watch| loaded.statics(watch));
        let answer = answer.map_err(|e| format!("statics: {e}"))?;
        let Some(statics) = answer.closed() else {
            continue;
        };
        if !statics.balanced || !frame.spins.is_empty() {
            continue;
        }
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let given = dot(force, frame.velocity) + dot(moment, frame.angular_velocity);
        let Some(actuator) = statics.actuators.iter().find(|a| a.name == name) else {
            continue;
        };
        let taken = actuator.force * unit;
        let size = dot(force.map(f64::abs), frame.velocity.map(f64::abs))
            + dot(moment.map(f64::abs), frame.angular_velocity.map(f64::abs))
            + dot(force.map(f64::abs), [report.normalising_length; 3]);
        hold!(
            !actuator.unique || (given + taken).abs() < 1e-6 * size,
            "virtual work at {} with {name}: {given} and {taken}",
            frame.name
        );
    }
    Ok(())
}
