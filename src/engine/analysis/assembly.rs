//! The assembled configuration near a guess.

mod report;
mod singular;

use crate::algebra::SiUnit;
use crate::geometry::Pose;
use crate::mechanism::{Configuration, Frame, Mechanism, turn_near};
use crate::number::tolerance::ROUNDING;
use crate::solve::{Equations, Newton, Stop, Watch};
pub use crate::system::{AssemblySettings, ByName, Count, FrameRecord, Gap, PlatformRecord};
use crate::system::{
    Attempt, Freedoms, Neighbourhood, Question, QuestionError, Search, approach, check_count, moved,
};
pub use report::{AssemblyReport, JointVariable, Outcome, RemainingFreedoms};

/// Finds the assembled configuration near the start of a question.
///
/// Newton's method on the loop closure from the guess; if that fails, or ends outside the limits,
/// from seeded random starts within the limits. Where less is held than the mechanism has freedoms,
/// the others change as little as closing it allows.
///
/// # Errors
/// If more is held than the mechanism has freedoms, or what is held depends on itself.
pub fn assemble(
    question: &Question,
    settings: &AssemblySettings,
    watch: &Watch,
) -> Result<AssemblyReport, QuestionError> {
    let mut search = Search::new(question, &settings.newton);
    let first = search.first();
    // a regular answer says how many freedoms there are; otherwise the mechanism is examined
    let counted = search.counted(&first);
    let (count, left) = match counted.map_or_else(|| check_count(question), Ok) {
        Ok(count) => (count, None),
        Err(QuestionError::TooFew {
            mobility,
            held,
            hold,
        }) => {
            let count = Count {
                mobility: Some(mobility),
                held,
            };
            let left = RemainingFreedoms {
                freedoms: mobility - held,
                hold,
                singular: 0,
            };
            (count, Some(left))
        }
        Err(QuestionError::TooMany {
            mobility,
            held,
            free,
            ..
        }) => {
            let agreed = agreeing(question, settings, watch, &free);
            return agreed.map_err(|apart| QuestionError::TooMany {
                mobility,
                held,
                free,
                apart,
            });
        }
        Err(error) => return Err(error),
    };
    let mut found = search.restart(first, settings.restarts, settings.seed, watch);
    let mut local_minimum = false;
    if !found.assembles() && !watch.is_stopped() {
        local_minimum = to_closest_approach(&search, &settings.newton, &mut found.attempt);
    }
    if left.is_some() && found.assembles() {
        found.attempt.at = nearest(question, &search, found.attempt.at);
    }
    let freedoms = (found.assembles()).then(|| search.freedoms(&found.attempt.at));
    let reporter = Reporter {
        question,
        mechanism: question.mechanism(),
        seed: settings.seed,
        search,
        count,
        left,
        restarts: found.restarts,
        interrupted: watch.is_stopped(),
    };
    Ok(match freedoms {
        Some(freedoms) => reporter.assembled(found.attempt, &freedoms),
        None => reporter.unassembled(found.attempt, local_minimum),
    })
}

/// The assembly of a question that holds more joints than there are freedoms, if those too many stand where the others put
/// them; otherwise the one that is farthest from there, and by how much, if that could be found.
fn agreeing(
    question: &Question,
    settings: &AssemblySettings,
    watch: &Watch,
    free: &[String],
) -> Result<AssemblyReport, Option<(String, f64, SiUnit)>> {
    let mechanism = question.mechanism();
    let joints: Option<Vec<usize>> = free.iter().map(|name| mechanism.joint(name)).collect();
    let joints = joints.ok_or(None)?;
    let eased = question.clone().letting_go(&joints);
    let mut report = assemble(&eased, settings, watch).map_err(|_| None)?;
    if !report.is_assembled() || report.left.is_some() {
        return Err(None);
    }
    let (asked, found) = (question.start(), report.configuration());
    let apart = joints.iter().map(|&joint| {
        let (value, wanted) = (found.joints[joint], asked.joints[joint]);
        let by = match mechanism.repeats(joint) {
            true => turn_near(value, wanted) - wanted,
            false => value - wanted,
        };
        (joint, by.abs())
    });
    let farthest = apart.max_by(|a, b| a.1.total_cmp(&b.1));
    let (joint, by) = farthest.ok_or(None)?;
    let turns = mechanism.joints()[joint].kind.is_angle();
    let size = if turns {
        1.0
    } else {
        mechanism.characteristic_length()
    };
    if by > ROUNDING * size {
        let name = mechanism.joints()[joint].name.clone();
        return Err(Some((name, by, SiUnit::of_coordinate(turns))));
    }
    let redundant = report.variables.iter_mut();
    redundant
        .filter(|of| free.contains(&of.name))
        .for_each(|of| of.held = true);
    report.held = question.held_names();
    report.redundant = free.to_vec();
    Ok(report)
}

/// Continues from the end of Newton's method to the closest approach, which may be assembled after all; true if it is a
/// local minimum of the gaps.
fn to_closest_approach(search: &Search, newton: &Newton, attempt: &mut Attempt) -> bool {
    let system = search.system();
    let (at, local_minimum) = approach(system, &attempt.at);
    attempt.report.size = system.residual(&at, &mut system.work());
    attempt.at = at;
    if attempt.report.size.largest <= newton.tolerance {
        attempt.report.stop = Stop::Solved;
    }
    local_minimum
}

/// The assembled configuration nearest to the start of a question that leaves freedoms, downhill from
/// one that was found. It does not leave limits that this one is within.
fn nearest(question: &Question, search: &Search, found: Configuration<f64>) -> Configuration<f64> {
    let mechanism = question.mechanism();
    let mut start = question.start();
    for joint in (0..start.joints.len()).filter(|&joint| mechanism.repeats(joint)) {
        start.joints[joint] = turn_near(start.joints[joint], found.joints[joint]);
    }
    let mut near = Neighbourhood::holding(mechanism, search.held());
    let nearest = near.nearest(&start, found.clone());
    let outside = |at: &Configuration<f64>| mechanism.outside_limits(&at.joints).count();
    match outside(&nearest) > outside(&found) {
        true => found,
        false => nearest,
    }
}

/// Writes the report on an attempt.
struct Reporter<'a> {
    question: &'a Question<'a>,
    mechanism: &'a Mechanism,
    seed: u64,
    search: Search<'a>,
    count: Count,
    left: Option<RemainingFreedoms>,
    restarts: usize,
    interrupted: bool,
}

impl Reporter<'_> {
    fn report(&self, attempt: Attempt, outcome: Outcome, condition: f64) -> AssemblyReport {
        let mechanism = self.mechanism;
        let gaps = Gap::of(mechanism, &attempt.at);
        let at = self.by_limits(attempt.at);
        let held = &self.search.held().joints;
        // of the coordinates of points those that are asked for
        let listed = |joint: &usize| held[*joint] || !mechanism.is_of_point(*joint);
        let joints = (0..held.len()).filter(listed);
        let joints = joints.map(|i| (i, &mechanism.joints()[i], at.joints[i]));
        let platforms = mechanism.platforms().iter().zip(&at.platforms);
        let [own_chains, _] = mechanism.own_parts();
        let named = mechanism.frames().into_iter().filter(|frame| match *frame {
            Frame::Tip { chain } => chain < own_chains,
            Frame::OnPlatform { .. } => true,
            _ => false,
        });
        let named = named.map(|frame| (mechanism.frame_name(frame), frame));
        let (names, named): (Vec<String>, Vec<Frame>) =
            named.filter(|(name, _)| mechanism.is_given(name)).unzip();
        let poses = mechanism.placed(&named, &at);
        let ground = Pose::identity().inverse();
        let poses = poses.iter().map(|pose| FrameRecord::of(&(ground * *pose)));
        let frames = names.into_iter().zip(poses);
        let cut = mechanism.closing_joints().iter();
        let cut = cut.zip(mechanism.closing_values(&at));
        let closing = cut.clone().map(|(joint, _)| JointVariable {
            name: joint.name.clone(),
            unit: SiUnit::of_coordinate(joint.kind.is_angle()),
            role: crate::description::Role::Passive,
            held: false,
            limits: None,
            within_limits: true,
        });
        let closing_values = cut
            .clone()
            .map(|(joint, value)| (joint.name.clone(), value));
        let mut report = AssemblyReport {
            mechanism: mechanism.name().into(),
            // four digits of the joint values are lost
            near_singular: attempt.report.stop == Stop::Solved && condition > 1e4,
            condition,
            outcome,
            steps: attempt.report.steps,
            restarts: self.restarts,
            seed: self.seed,
            residual: attempt.report.size.largest,
            mobility: self.count.mobility,
            idle: 0,
            left: self.left.clone(),
            moved: None,
            held: self.question.held_names(),
            redundant: Vec::new(),
            frames: frames.collect(),
            centre: mechanism.dimensions().centre,
            platforms: platforms
                .map(|(part, pose)| {
                    (
                        part.name.clone(),
                        PlatformRecord::of(&mechanism.in_ground(pose)),
                    )
                })
                .collect(),
            gaps: (mechanism.closures().iter().zip(gaps))
                .map(|(closure, gap)| (closure.name.clone(), gap))
                .collect(),
            variables: (joints.clone())
                .map(|(i, joint, value)| JointVariable {
                    name: joint.name.clone(),
                    unit: SiUnit::of_coordinate(joint.kind.is_angle()),
                    role: joint.role,
                    held: held[i],
                    limits: joint.limits,
                    within_limits: joint.allows(value),
                })
                .chain(closing)
                .collect(),
            joints: joints
                .map(|(_, joint, value)| (joint.name.clone(), value))
                .chain(closing_values)
                .collect(),
            cut: mechanism.cut_joints(),
            outputs: (mechanism.joint_outputs(&at.joints))
                .map(|(output, value)| (output.name.clone(), value))
                .collect(),
            output_units: (mechanism.joint_outputs(&at.joints))
                .map(|(output, _)| output.unit)
                .collect(),
            squared_lengths: false,
            warnings: (mechanism.warnings().iter())
                .map(|problem| problem.kind.title())
                .collect(),
            interrupted: self.interrupted,
        };
        report.warnings.extend(report.warning());
        report
    }

    /// Angles that were solved for by the turn that is within their limits, if one is.
    fn by_limits(&self, mut at: Configuration<f64>) -> Configuration<f64> {
        let held = &self.search.held().joints;
        for j in (0..held.len()).filter(|&j| !held[j]) {
            at.joints[j] = self.mechanism.by_limits(j, at.joints[j]);
        }
        at
    }

    fn assembled(&self, attempt: Attempt, freedoms: &Freedoms) -> AssemblyReport {
        let moved = moved(self.question, &attempt.at);
        if let Some(left) = &self.left {
            let report = self.with_freedoms(attempt, freedoms, left);
            return AssemblyReport { moved, ..report };
        }
        let idle = match freedoms.are_local(self.mechanism, &attempt.at) {
            true => freedoms.motions.len(),
            false => 0,
        };
        let outcome = if freedoms.motions.len() > idle {
            singular::causes(self.mechanism, self.search.held(), &attempt.at, freedoms)
        } else {
            self.converged(&attempt.at)
        };
        let condition = match idle {
            0 => freedoms.condition(),
            // unknowns that nothing determines have no part in the conditioning of the others
            _ => freedoms.condition_of_determined(),
        };
        AssemblyReport {
            idle,
            moved,
            ..self.report(attempt, outcome, condition)
        }
    }

    fn converged(&self, at: &Configuration<f64>) -> Outcome {
        let outside = self.mechanism.outside_limits(&at.joints);
        let names = outside.map(|joint| self.mechanism.joints()[joint].name.clone());
        let joints: Vec<String> = names.collect();
        match joints.is_empty() {
            true => Outcome::Converged,
            false => Outcome::ConvergedOutsideLimits { joints },
        }
    }

    /// Report of an assembled configuration with freedoms left, which are no singularity.
    fn with_freedoms(
        &self,
        attempt: Attempt,
        freedoms: &Freedoms,
        left: &RemainingFreedoms,
    ) -> AssemblyReport {
        let mut near = Neighbourhood::holding(self.mechanism, self.search.held());
        let residual = near.residual(&attempt.at);
        let tangent = near.tangent(attempt.at.clone());
        let condition = freedoms.condition_of_determined();
        let outcome = self.converged(&attempt.at);
        AssemblyReport {
            residual,
            idle: tangent.idle.len(),
            left: Some(RemainingFreedoms {
                singular: tangent.motions.len().saturating_sub(left.freedoms),
                ..left.clone()
            }),
            ..self.report(attempt, outcome, condition)
        }
    }

    fn unassembled(&self, attempt: Attempt, local_minimum: bool) -> AssemblyReport {
        let settled = attempt.report.stop == Stop::Minimum;
        let held = self.search.held();
        let condition = Freedoms::at(self.mechanism.dimensions(), held, &attempt.at).condition();
        let gaps = Gap::of(self.mechanism, &attempt.at);
        let width = |gap: &Gap| gap.size(self.mechanism);
        let worst = (0..gaps.len()).fold(0, |worst, i| {
            if width(&gaps[i]) > width(&gaps[worst]) {
                i
            } else {
                worst
            }
        });
        let closures = self.mechanism.closures();
        let worst = (closures.get(worst)).map_or(String::new(), |closure| closure.name.clone());
        let outcome = if !self.interrupted && (settled || local_minimum) {
            Outcome::CannotBeAssembled {
                worst,
                local_minimum,
            }
        } else {
            Outcome::GaveUp { worst }
        };
        AssemblyReport {
            squared_lengths: self.mechanism.has_rods(),
            left: None,
            ..self.report(attempt, outcome, condition)
        }
    }
}
