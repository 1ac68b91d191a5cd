//! Newton's method for many motions of one mechanism side by side.
//!
//! The step is recorded once as a straight-line program, which then runs for [`BATCH`] motions at once. Each motion is
//! what it would be without the others.

mod certain;
mod past;
mod recording;

use super::curvature::Curvature;
use super::{NoSolver, StateVariable, VariablePlan};
use crate::algebra::{BATCH, Registers, record};
use crate::mechanism::Configuration;
use crate::number::tolerance::{LONGEST_STEP, SOLVED};
use crate::number::widest;
use crate::system::{Coordinate, LaneProgram, Mask, Question, assign, bits};
use certain::{Certain, LaneJacobians};
use past::Past;

/// Steps after which a motion is lost. Each must halve the rows, or the motion is lost before.
const MOST_STEPS: usize = 12;

/// Follows motions of one question, of which each changes some held coordinates from solution to solution.
#[derive(Clone, Debug)]
pub struct Follower<'a> {
    plan: VariablePlan<'a>,
    /// Indices of the changing coordinates among the inputs.
    changing: Vec<usize>,
    /// The values of all inputs at the start.
    inputs: Vec<f64>,
    program: LaneProgram,
    /// Registers of the numbers of the state that are iterated, each with that of its value after a step.
    moved: Vec<(usize, usize)>,
    /// Registers of the numbers of the state that follow from these, each with that of its new value.
    placed: Vec<(usize, usize)>,
    /// The number of unknowns of a step.
    unknowns: usize,
    /// Factors that make changes of the changing inputs, then of the state, dimensionless, and the rate of the
    /// Jacobian.
    curvature: Curvature,
}

/// The section of the sum of the squares of all rows.
const ROWS: usize = 1;
/// The section of the free numbers of the state moved by a step, and of a number of more than 1 if that is too long or a
/// pivot small.
const STEP: usize = 2;
/// The section of a number of more than 1 where the numbers that follow from the state divide by a small one, of these
/// numbers, and of all coordinates.
const REACHED: usize = 3;
/// The section of the Jacobian, row by row.
const JACOBIAN: usize = 4;
/// The section of its left inverse, row by row; empty for many unknowns.
const INVERSE: usize = 5;

/// The latest solutions of [`BATCH`] motions.
#[derive(Clone, Debug)]
pub struct FollowerState {
    registers: Registers,
    past: Past,
    certain: Certain,
}

impl<'a> Follower<'a> {
    /// For a question, near an assembled configuration, where the order of elimination is chosen.
    ///
    /// # Errors
    /// If nothing is unknown or nothing held, or the configuration is singular.
    ///
    /// # Panics
    /// If a coordinate that changes is not held.
    pub fn new(
        question: &Question<'a>,
        at: &Configuration<f64>,
        changing: &[Coordinate],
    ) -> Result<Self, NoSolver> {
        let plan = VariablePlan::new(question);
        plan.check()?;
        let place = |&of: &Coordinate| {
            plan.inputs
                .iter()
                .position(|v| *v == StateVariable::Held(of))
        };
        let changing = changing.iter().map(place);
        let changing: Vec<usize> = changing
            .map(|place| place.expect("what changes is held"))
            .collect();
        let (inputs, state) = plan.values(at);
        let mut sample: Vec<f64> = changing.iter().map(|&i| inputs[i]).collect();
        sample.extend(&state);
        let (written, operations) = record(sample.clone(), || {
            plan.recorded(&changing, &inputs, LONGEST_STEP)
        });
        let written = written?;
        let (count, known) = (sample.len(), changing.len());
        let decisions = (&written.decisions[..], REACHED);
        let program = LaneProgram::new(&operations, (count, known), &written.sections, decisions);
        let inputs_of = changing.iter().map(|&i| plan.inputs[i]);
        let variables: Vec<StateVariable> = inputs_of.chain(plan.state.iter().copied()).collect();
        let jacobian = &written.sections[JACOBIAN];
        let curvature = plan.curvature(&operations, jacobian, &variables, &sample);
        let (placed, moved): (Vec<usize>, Vec<usize>) =
            (known..count).partition(|register| written.placed.contains(&(register - known)));
        let results = |section: usize| program.results(section).iter().copied();
        Ok(Follower {
            moved: moved.into_iter().zip(results(STEP)).collect(),
            placed: placed.into_iter().zip(results(REACHED).skip(1)).collect(),
            unknowns: written.unknowns,
            plan,
            changing,
            inputs,
            program,
            curvature,
        })
    }

    /// [`BATCH`] motions that begin at a configuration.
    pub fn motions(&self, at: &Configuration<f64>) -> FollowerState {
        let registers = self.program.registers();
        let numbers = 0..self.curvature.weights.len();
        let jacobian = self.program.results(JACOBIAN).len();
        let mut motions = FollowerState {
            past: Past::none(self.moved.iter().map(|(register, _)| *register), &registers),
            certain: Certain::none(numbers.zip(&self.curvature.weights), jacobian),
            registers,
        };
        (0..BATCH).for_each(|motion| self.set(&mut motions, motion, at));
        self.keep_certain(&mut motions, &[u64::MAX; BATCH]);
        motions
    }

    /// Takes the solutions of motions for ones of their branches.
    fn keep_certain(&self, motions: &mut FollowerState, which: &Mask) {
        let FollowerState {
            registers, certain, ..
        } = motions;
        (LaneProgram::KNOWN..=ROWS).for_each(|section| self.program.run(section, registers));
        certain.keep(which, &self.jacobians(registers), registers);
    }

    /// The Jacobians where the motions are.
    fn jacobians<'f>(&'f self, registers: &mut Registers) -> LaneJacobians<'f> {
        self.program.run(JACOBIAN, registers);
        self.program.run(INVERSE, registers);
        LaneJacobians {
            jacobian: self.program.results(JACOBIAN),
            inverse: self.program.results(INVERSE),
            unknowns: self.unknowns,
            curvature: self.curvature.largest,
        }
    }

    /// Puts a motion at a configuration, and forgets where it came from.
    pub fn put(&self, motions: &mut FollowerState, motion: usize, at: &Configuration<f64>) {
        self.set(motions, motion, at);
        let mut which = [0; BATCH];
        which[motion] = u64::MAX;
        self.keep_certain(motions, &which);
    }

    fn set(&self, motions: &mut FollowerState, motion: usize, at: &Configuration<f64>) {
        let (inputs, state) = self.plan.values(at);
        let changing = self.changing.iter().map(|&i| inputs[i]);
        for (register, value) in changing.chain(state).enumerate() {
            motions.registers.rows_mut(register)[motion] = value;
        }
        motions.past.forget(motion, &motions.registers);
    }

    /// The values of a coordinate that changes, one for each motion, to be set before [`solve`](Self::solve).
    pub fn values<'m>(
        &self,
        motions: &'m mut FollowerState,
        coordinate: usize,
    ) -> &'m mut [f64; BATCH] {
        motions.registers.rows_mut(coordinate)
    }

    /// Leads the motions that go to the values set, and says which arrive, certainly on their branch; the others stay at
    /// their latest solution.
    pub fn solve(&self, motions: &mut FollowerState, going: &[bool; BATCH]) -> [bool; BATCH] {
        let FollowerState {
            registers,
            past,
            certain,
        } = motions;
        let square = SOLVED.powi(2);
        let going = going.map(bits);
        predict(past, &going, registers);
        let (mut solved, mut last) = ([0; BATCH], [f64::INFINITY; BATCH]);
        let judge = |section: usize, open: &mut Mask, registers: &Registers| {
            let results = self.program.results(section);
            let told = registers.rows(results[results.len() - 1]);
            match section {
                ROWS => settle(open, &mut solved, told, &mut last, square),
                _ => trust(open, told),
            }
        };
        let (sections, open) = ([ROWS, STEP], (going, MOST_STEPS));
        (self.program).newton(sections, &self.moved, open, registers, judge);
        self.program.run(REACHED, registers);
        // after that section: what it needs is no longer kept for the next
        let far = certain.beyond(&solved, past, registers);
        if far != [0; BATCH] {
            let now = self.jacobians(registers);
            let sure = certain.sure(&far, &now, registers);
            certain.keep(&sure, &now, registers);
            (0..BATCH).for_each(|i| solved[i] &= !far[i] | sure[i]);
        }
        let placing = self.program.results(REACHED)[0];
        trust(&mut solved, registers.rows(placing));
        self.program.holds(&mut solved, registers);
        assign(&self.placed, &solved, registers);
        learn(past, &solved, registers);
        for motion in 0..BATCH {
            if going[motion] & !solved[motion] != 0 {
                past.restore(motion, registers);
                past.forget(motion, registers);
            }
        }
        solved.map(|of| of != 0)
    }

    /// Values reached by the last [`solve`](Self::solve): all motions' values of each coordinate, in the order of
    /// [`Coordinate::all`], in rad and m.
    pub fn columns<'m>(
        &self,
        motions: &'m FollowerState,
    ) -> impl Iterator<Item = &'m [f64; BATCH]> {
        let columns = &self.program.results(REACHED)[1 + self.placed.len()..];
        columns
            .iter()
            .map(|&register| motions.registers.rows(register))
    }

    /// The latest solution of a motion, found for these values of the coordinates that change.
    pub fn configuration(
        &self,
        motions: &FollowerState,
        motion: usize,
        values: &[f64],
    ) -> Configuration<f64> {
        let mut inputs = self.inputs.clone();
        for (&place, &value) in self.changing.iter().zip(values) {
            inputs[place] = value;
        }
        let first = self.changing.len();
        let state: Vec<f64> = (first..first + self.plan.state.len())
            .map(|register| motions.registers.rows(register)[motion])
            .collect();
        self.plan.posed(&inputs, &state).1
    }
}

widest! {
    fn predict(past: &Past, going: &Mask, registers: &mut Registers) runs Past::predict
}

widest! {
    fn learn(past: &mut Past, reached: &Mask, registers: &Registers) runs Past::learn
}

widest! {
    fn settle(open: &mut Mask, solved: &mut Mask, size: &[f64; BATCH], last: &mut [f64; BATCH], square: f64) runs settle_each
}

widest! {
    fn trust(motions: &mut Mask, doubt: &[f64; BATCH]) runs trust_each
}

/// Open motions whose rows are small are solved; those whose rows have not halved are no longer open.
#[inline(always)]
fn settle_each(
    open: &mut Mask,
    solved: &mut Mask,
    size: &[f64; BATCH],
    last: &mut [f64; BATCH],
    square: f64,
) {
    for i in 0..BATCH {
        let done = open[i] & bits(size[i] <= square);
        solved[i] |= done;
        // not so either where it is not a number
        open[i] &= !done & bits(size[i] < 0.25 * last[i]);
    }
    *last = *size;
}

#[inline(always)]
fn trust_each(motions: &mut Mask, doubt: &[f64; BATCH]) {
    for i in 0..BATCH {
        motions[i] &= bits(doubt[i] <= 1.0);
    }
}
