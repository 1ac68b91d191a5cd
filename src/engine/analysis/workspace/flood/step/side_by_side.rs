//! Many steps side by side, by operations recorded once.

use super::LongestCorrection;
use crate::algebra::{BATCH, Decision, OperationIndex, Recorded, Registers, record};
use crate::analysis::workspace::problem::{HeldMotions, MapProblem, Rates, Targets};
use crate::mechanism::Configuration;
use crate::number::Number;
use crate::number::tolerance::SOLVED;
use crate::solve::Equations;
use crate::system::{HeldPlatform, LaneProgram, Mask, System, bits, small};

/// Newton's method and the motions at its end as a program for [`BATCH`] places.
///
/// Pivots are in one order, chosen where the operations are recorded. Where one of them is small, a place is left open.
#[derive(Clone, Debug)]
pub(super) struct SideBySide {
    program: LaneProgram,
    registers: Registers,
    /// The register of each number: those that the equations hold, then those of a configuration.
    given: Vec<usize>,
    /// Number of held values in the equations.
    asked: usize,
    /// Registers of the numbers of a configuration that steps move, each with that of its new value.
    moved: Vec<(usize, usize)>,
}

/// Places where a step arrived, and those where the program does not hold; elsewhere a correction was too long, or there
/// were too many.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StepEnds {
    pub arrived: Mask,
    pub open: Mask,
}

/// The section of the rows, and of the decisions of elimination.
const ROWS: usize = 1;
/// The section of a configuration after a step, and of the square of the step's length.
const STEP: usize = 2;
/// The section of the motions.
const MOTIONS: usize = 3;
/// The section of the rates at which rows open in these.
const OPENING: usize = 4;

impl SideBySide {
    /// Records the operations at an assembled configuration; none if it is singular, or there are so many unknowns that
    /// the program would be long.
    pub fn new(
        problem: &MapProblem,
        (targets, rates): (&Targets, &Rates),
        at: &Configuration<f64>,
        values: &[f64],
    ) -> Option<Self> {
        const MOST: usize = 40;
        let held = problem.question.held();
        let unknowns = problem.question.system().unknowns().len();
        if unknowns == 0 || unknowns > MOST {
            return None;
        }
        // what no step moves comes first: what follows from it alone is computed once
        let mut sample: Vec<f64> = targets.numbers(values).collect();
        let asked = sample.len();
        let platforms = held.platforms.iter();
        let stands = platforms.flat_map(|held| [*held == HeldPlatform::Pose; 7]);
        let stands: Vec<bool> = held.joints.iter().copied().chain(stands).collect();
        let mut inputs: Vec<usize> = (0..stands.len()).collect();
        inputs.sort_by_key(|&number| !stands[number]);
        let known = asked + stands.iter().filter(|stands| **stands).count();
        let mut given: Vec<usize> = (0..asked + stands.len()).collect();
        let numbers: Vec<f64> = at.numbers().collect();
        for number in inputs {
            given[asked + number] = sample.len();
            sample.push(numbers[number]);
        }
        let count = sample.len();
        let (written, operations) = record(sample, || {
            let mut inputs = given.iter().map(|&number| Recorded::input(number));
            let mut system: System<Recorded> = problem.question.system_over();
            targets.set(&mut system, inputs.by_ref().take(asked));
            let at = at.map(|_| inputs.next().expect("as many as there are numbers"));
            written(&system, rates, &at)
        });
        let (sections, decisions) = written?;
        let program = LaneProgram::new(&operations, (count, known), &sections, (&decisions, ROWS));
        let moved = given[asked..].iter().zip(program.results(STEP));
        let moved = moved.filter(|(from, to)| from != to);
        Some(SideBySide {
            moved: moved.map(|(from, to)| (*from, *to)).collect(),
            registers: program.registers(),
            given,
            asked,
            program,
        })
    }

    /// Puts a place near where it is to arrive; the numbers that the equations hold come first.
    pub fn put(&mut self, place: usize, asked: impl Iterator<Item = f64>, at: &Configuration<f64>) {
        for (register, value) in self.given.iter().zip(asked.chain(at.numbers())) {
            self.registers.rows_mut(*register)[place] = value;
        }
    }

    /// Leads the first places on, as far as corrections may be.
    pub fn solve(&mut self, reaches: impl Iterator<Item = LongestCorrection>) -> StepEnds {
        let SideBySide {
            program, registers, ..
        } = self;
        let mut reaches: Vec<LongestCorrection> = reaches.collect();
        let most = LongestCorrection::most(reaches.iter().copied());
        let going: Mask = std::array::from_fn(|i| bits(i < reaches.len()));
        let (rows, step) = (program.results(ROWS), program.results(STEP));
        let mut ends = StepEnds::default();
        let judge = |section: usize, going: &mut Mask, registers: &Registers| match section {
            ROWS => {
                let before = *going;
                program.holds(going, registers);
                let mut solved = *going;
                small(rows, SOLVED, &mut solved, registers);
                for i in 0..BATCH {
                    ends.open[i] |= before[i] & !going[i];
                    ends.arrived[i] |= solved[i];
                    going[i] &= !solved[i];
                }
            }
            _ => {
                let squares = registers.rows(step[step.len() - 1]);
                for (i, reach) in reaches.iter_mut().enumerate() {
                    let before = going[i];
                    if before != 0 {
                        going[i] = bits(reach.allows(squares[i].sqrt()));
                    }
                    // the pivots of elimination may be worse than those of a factorisation
                    ends.open[i] |= before & !going[i] & bits(!squares[i].is_finite());
                }
            }
        };
        program.newton([ROWS, STEP], &self.moved, (going, most), registers, judge);
        program.run(MOTIONS, registers);
        program.run(OPENING, registers);
        ends
    }

    /// Copies the solution of a place, with its motions.
    pub fn get(&self, place: usize, at: &mut Configuration<f64>, motions: &mut HeldMotions<f64>) {
        let number = |register: &usize| self.registers.rows(*register)[place];
        let numbers = self.given[self.asked..].iter().map(number);
        at.numbers_mut().zip(numbers).for_each(|(at, x)| *at = x);
        let fill = |to: &mut Vec<f64>, section: usize| {
            to.clear();
            to.extend(self.program.results(section).iter().map(number));
        };
        fill(&mut motions.motions, MOTIONS);
        fill(&mut motions.opening, OPENING);
    }
}

/// Writes everything, section by section; none where the equations are singular.
fn written(
    system: &System<Recorded>,
    rates: &Rates,
    at: &Configuration<Recorded>,
) -> Option<([Vec<OperationIndex>; 5], Vec<Decision>)> {
    let mut work = system.work();
    system.linearise(at, &mut work);
    let rows = system.residual_of(&work).to_vec();
    system.factorise(0.0, &mut work);
    if system.undetermined(&work) > 0 {
        return None;
    }
    for side in system.sides_of_angles(&work) {
        // a decision, which must hold everywhere
        side.less(Recorded::zero());
    }
    system.step(&mut work);
    let step = system.step_of(&work).to_vec();
    let square = step.iter().fold(Recorded::zero(), |sum, &x| sum + x * x);
    let mut moved: Vec<Recorded> = system.displaced(at, &step).numbers().collect();
    moved.push(square);
    let (motions, opening) = Default::default();
    let mut found = HeldMotions { motions, opening };
    rates.motions(at, system, &mut work, &mut found);
    // as many rows as unknowns stay closed by the elimination itself
    if rows.len() <= step.len() {
        found.opening.clear();
    }
    let sections = [Vec::new(), rows, moved, found.motions, found.opening];
    let places = |of: Vec<Recorded>| of.into_iter().map(Recorded::place).collect();
    Some((sections.map(places), Recorded::decisions()))
}

#[cfg(test)]
mod tests {
    use super::super::{StepStart, Steps};
    use super::*;
    use crate::analysis::workspace::flood::arrivals::Arrivals;

    use crate::mechanism::Mechanism;
    use crate::solve::{Newton, Watch};
    use crate::system::{Driven, Question, close};

    /// Steps of coordinates of a shipped file from home: where they lead side by side and one by one.
    fn compared(file: &str, held: &[&str], mapped: &[(&str, f64)]) {
        let path = format!("{}/../../mechanisms/{file}.ron", env!("CARGO_MANIFEST_DIR"));
        let mechanism = Mechanism::new(&Mechanism::read(&path).unwrap().1).unwrap();
        let mut question = Question::new(&mechanism).free("actuated").unwrap();
        for name in held.iter().chain(mapped.iter().map(|(name, _)| name)) {
            question = question.hold(name, "home").unwrap();
        }
        let home = close(&question, &Newton::default(), (1, 1), &Watch::none()).unwrap();
        let home = home.configuration;
        let axis = |&(name, size): &(&str, f64)| {
            let (coordinate, value) = question.value(name, "home").unwrap();
            let (from, to) = (value - size, value + size);
            Driven {
                coordinate,
                from,
                to,
            }
        };
        let axes: Vec<Driven> = mapped.iter().map(axis).collect();
        let problem = MapProblem::new(&question, &axes);
        let values = |part: f64| {
            let along = |axis: &Driven| axis.from + part * (axis.to - axis.from);
            std::array::from_fn(|i| axes.get(i).map_or(0.0, along))
        };
        let start = |i: usize| StepStart {
            from: home.view(),
            along: None,
            reach: 1.0,
            values: values(i as f64 / BATCH as f64),
        };
        let starts: Vec<StepStart> = (0..BATCH).map(start).collect();
        let mut together = Arrivals::default();
        let mut steps = Steps::new(&problem).recorded(&problem, &home, &values(0.5));
        assert!(steps.is_recorded(), "{file}");
        steps.settle(&starts, &mut together);
        let (mut alone, mut arrived) = (Arrivals::default(), 0);
        for (start, found) in starts.into_iter().zip(together.iter()) {
            steps.settle(&[start], &mut alone);
            let [found, expected] = [found, alone.get(0)];
            assert_eq!(found.is_some(), expected.is_some(), "{file}");
            let (Some(found), Some(expected)) = (found, expected) else {
                continue;
            };
            arrived += 1;
            let of = |at: Configuration<f64>| at.numbers().collect::<Vec<f64>>();
            let same = |a: &[f64], b: &[f64]| {
                let off = a
                    .iter()
                    .zip(b)
                    .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
                assert!(off.fold(0.0, f64::max) < 1e-9, "{file}: {a:?} {b:?}");
            };
            same(&of(found.at.owned()), &of(expected.at.owned()));
            same(found.motions, expected.motions);
            let (found, expected) = (found.indicators, expected.indicators);
            same(
                &[found.direct, found.inverse],
                &[expected.direct, expected.inverse],
            );
        }
        assert!(arrived > BATCH / 2, "{file}: {arrived}");
    }

    #[test]
    fn steps_lead_where_they_lead_one_by_one() {
        let plane = [("hand.x", 0.05), ("hand.y", 0.05)];
        compared("five_bar_hand", &[], &plane);
        compared(
            "three_rps",
            &["top.z"],
            &[("top.roll", 0.1), ("top.pitch", 0.1)],
        );
        let held = ["top.z", "top.roll", "top.pitch", "top.yaw"];
        compared(
            "stewart_gough_6ups",
            &held,
            &[("top.x", 0.05), ("top.y", 0.05)],
        );
        compared(
            "stewart_gough_6ups",
            &held[..3],
            &[("top.x", 0.05), ("top.y", 0.05), ("top.yaw", 0.1)],
        );
        compared("four_bar", &[], &[("theta1", 0.3)]);
    }
}
