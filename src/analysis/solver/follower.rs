//! Newton's method for many motions of one mechanism side by side.
//!
//! The step is recorded once as a straight-line program, which then runs for [`BATCH`] motions at once. Each motion is
//! what it would be without the others.

mod past;

use super::iteration::{Iteration, numbered, places};
use super::{LEAST_PIVOT, NoSolver, Plan, Variable};
use crate::algebra::{BATCH, Batch, Place, Recorded, Registers, record};
use crate::mechanism::Configuration;
use crate::number::{Number, widest};
use crate::system::{Coordinate, Question, System};
use past::{Mask, Past};

/// How motions are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Following {
    /// A point is a solution when no dimensionless row exceeds this.
    pub tolerance: f64,
    /// The longest step of all unknowns together, in rad and characteristic lengths: longer ones may lead to another
    /// branch.
    pub longest_step: f64,
    /// Steps after which a motion is lost. Each must halve the rows, or the motion is lost before.
    pub most_steps: usize,
}

impl Default for Following {
    fn default() -> Self {
        Following {
            tolerance: 1e-12,
            longest_step: 0.5,
            most_steps: 12,
        }
    }
}

/// Follows motions of one question, of which each changes some held coordinates from solution to solution.
#[derive(Clone, Debug)]
pub struct Follower<'a> {
    plan: Plan<'a>,
    settings: Following,
    /// Where the coordinates that change stand among the inputs.
    changing: Vec<usize>,
    /// The values of all inputs at the start.
    inputs: Vec<f64>,
    /// Numbers of the state that are iterated; the others follow from them.
    free: Vec<usize>,
    program: Batch,
    results: Results,
}

/// The sections of the program, after the one for what depends on held values alone.
#[derive(Clone, Copy, Debug)]
enum Section {
    /// The sum of the squares of all rows.
    Rows = 1,
    /// The step, and the state moved by it.
    Step = 2,
    /// What follows from the state.
    Reached = 3,
}

/// Where the results of the program are.
#[derive(Clone, Debug)]
struct Results<T = usize> {
    /// The sum of the squares of all rows.
    size: T,
    /// More than 1 if a step is too long or a pivot small.
    doubt: T,
    /// The free numbers of the state, moved by the step.
    moved: Vec<T>,
    /// The numbers of the state that are not free, by their places.
    placed: Vec<(usize, T)>,
    /// More than 1 if what they are divided by is small.
    placing: T,
    /// All coordinates.
    columns: Vec<T>,
    /// Numbers on whose sign these rest, and whether they are negative.
    decided: Vec<(T, bool)>,
}

/// The latest solutions of [`BATCH`] motions.
#[derive(Clone, Debug)]
pub struct Motions {
    registers: Registers,
    past: Past,
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
        settings: Following,
    ) -> Result<Self, NoSolver> {
        let plan = Plan::new(question);
        plan.check()?;
        let place = |&of: &Coordinate| plan.inputs.iter().position(|v| *v == Variable::Held(of));
        let changing = changing.iter().map(place);
        let changing: Vec<usize> = changing
            .map(|place| place.expect("what changes is held"))
            .collect();
        let (inputs, state) = plan.values(at);
        let mut sample: Vec<f64> = changing.iter().map(|&i| inputs[i]).collect();
        sample.extend(&state);
        let count = sample.len();
        let (written, operations) = record(sample, || {
            plan.recorded(&changing, &inputs, settings.longest_step)
        });
        let written = written?;
        let mut sections = [
            Vec::new(),
            vec![written.size],
            written.moved.clone(),
            Vec::new(),
        ];
        sections[Section::Step as usize].push(written.doubt);
        let reached = &mut sections[Section::Reached as usize];
        reached.push(written.placing);
        reached.extend(written.placed.iter().map(|(_, place)| *place));
        reached.extend(&written.columns);
        reached.extend(written.decided.iter().map(|(place, _)| *place));
        sections[0] = Batch::known(&operations, changing.len(), &sections.concat());
        let program = Batch::new(&operations, count, &sections);
        let at = |place: Place| program.result(place);
        let results = Results {
            size: at(written.size),
            doubt: at(written.doubt),
            moved: written.moved.iter().map(|&place| at(place)).collect(),
            placed: (written.placed.iter())
                .map(|&(i, place)| (i, at(place)))
                .collect(),
            placing: at(written.placing),
            columns: written.columns.iter().map(|&place| at(place)).collect(),
            decided: (written.decided.iter())
                .map(|&(place, negative)| (at(place), negative))
                .collect(),
        };
        let placed = |i: &usize| written.placed.iter().any(|(of, _)| of == i);
        let free = (0..plan.state.len()).filter(|i| !placed(i)).collect();
        Ok(Follower {
            plan,
            settings,
            changing,
            inputs,
            free,
            program,
            results,
        })
    }

    /// [`BATCH`] motions that begin at a configuration.
    pub fn motions(&self, at: &Configuration<f64>) -> Motions {
        let registers = self.program.registers();
        let mut motions = Motions {
            past: Past::none(&self.state(self.free.iter().copied()), &registers),
            registers,
        };
        (0..BATCH).for_each(|motion| self.put(&mut motions, motion, at));
        motions
    }

    /// The registers of numbers of the state.
    fn state(&self, numbers: impl Iterator<Item = usize>) -> Vec<usize> {
        numbers.map(|i| self.changing.len() + i).collect()
    }

    /// Puts a motion at a configuration, and forgets where it came from.
    pub fn put(&self, motions: &mut Motions, motion: usize, at: &Configuration<f64>) {
        let (inputs, state) = self.plan.values(at);
        let changing = self.changing.iter().map(|&i| inputs[i]);
        for (register, value) in changing.chain(state).enumerate() {
            motions.registers.rows_mut(register)[motion] = value;
        }
        motions.past.forget(motion, &motions.registers);
    }

    /// The values of a coordinate that changes, one for each motion, to be set before [`solve`](Self::solve).
    pub fn values<'m>(&self, motions: &'m mut Motions, coordinate: usize) -> &'m mut [f64; BATCH] {
        motions.registers.rows_mut(coordinate)
    }

    /// Leads the motions that go to the values set, and says which arrive; the others stay at their latest solution.
    pub fn solve(&self, motions: &mut Motions, going: &[bool; BATCH]) -> [bool; BATCH] {
        let Motions { registers, past } = motions;
        let Results {
            size,
            doubt,
            moved,
            placed,
            placing,
            decided,
            ..
        } = &self.results;
        let square = self.settings.tolerance.powi(2);
        self.program.run(0, registers);
        let (mut open, mut solved) = (going.map(bits), [0; BATCH]);
        predict(past, &open, registers);
        let mut last = [f64::INFINITY; BATCH];
        for step in 0..=self.settings.most_steps {
            self.program.run(Section::Rows as usize, registers);
            let size = registers.rows(*size);
            settle(&mut open, &mut solved, size, &mut last, square);
            if step == self.settings.most_steps || open == [0; BATCH] {
                break;
            }
            self.program.run(Section::Step as usize, registers);
            trust(&mut open, registers.rows(*doubt));
            let free = self.free.iter().map(|i| self.changing.len() + i);
            free.zip(moved)
                .for_each(|(to, &from)| assign(to, from, &open, registers));
        }
        self.program.run(Section::Reached as usize, registers);
        trust(&mut solved, registers.rows(*placing));
        for &(register, negative) in decided {
            agree(&mut solved, registers.rows(register), negative);
        }
        for &(i, from) in placed {
            assign(self.changing.len() + i, from, &solved, registers);
        }
        learn(past, &solved, registers);
        for motion in 0..BATCH {
            if going[motion] && solved[motion] == 0 {
                past.restore(motion, registers);
                past.forget(motion, registers);
            }
        }
        solved.map(|of| of != 0)
    }

    /// Where the last [`solve`](Self::solve) led: all motions' values of each coordinate, in the order of
    /// [`Coordinate::all`], in rad and m.
    pub fn columns<'m>(&self, motions: &'m Motions) -> impl Iterator<Item = &'m [f64; BATCH]> {
        let columns = self.results.columns.iter();
        columns.map(|&register| motions.registers.rows(register))
    }

    /// The latest solution of a motion, found for these values of the coordinates that change.
    pub fn configuration(
        &self,
        motions: &Motions,
        motion: usize,
        values: &[f64],
    ) -> Configuration<f64> {
        let mut inputs = self.inputs.clone();
        for (&place, &value) in self.changing.iter().zip(values) {
            inputs[place] = value;
        }
        let state = self.state(0..self.plan.state.len()).into_iter();
        let state: Vec<f64> = state
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
    fn assign(to: usize, from: usize, motions: &Mask, registers: &mut Registers) runs past::assign
}

widest! {
    fn settle(open: &mut Mask, solved: &mut Mask, size: &[f64; BATCH], last: &mut [f64; BATCH], square: f64) runs settle_each
}

widest! {
    fn trust(motions: &mut Mask, doubt: &[f64; BATCH]) runs trust_each
}

widest! {
    fn agree(motions: &mut Mask, numbers: &[f64; BATCH], negative: bool) runs agree_each
}

#[inline(always)]
fn bits(all: bool) -> u64 {
    u64::from(all).wrapping_neg()
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

/// Leaves those whose numbers have this sign.
#[inline(always)]
fn agree_each(motions: &mut Mask, numbers: &[f64; BATCH], negative: bool) {
    for i in 0..BATCH {
        motions[i] &= bits((numbers[i] < 0.0) == negative);
    }
}

impl Plan<'_> {
    /// Records the iteration and what follows from it. The inputs are the held values that change, then the state.
    fn recorded(
        &self,
        changing: &[usize],
        values: &[f64],
        longest: f64,
    ) -> Result<Results<Place>, NoSolver> {
        let input = |(i, &value): (usize, &f64)| match changing.iter().position(|of| *of == i) {
            Some(number) => Recorded::input(number),
            None => Recorded::from_f64(value),
        };
        let inputs: Vec<Recorded> = values.iter().enumerate().map(input).collect();
        let state = (0..self.state.len()).map(|i| Recorded::input(changing.len() + i));
        let mut state: Vec<Recorded> = state.collect();
        let (held, at) = self.posed(&inputs, &state);
        let dimensions = self.dimensions();
        let system = System::new(&dimensions, &held);
        let Iteration {
            rows,
            step,
            pivots,
            placed,
            placing,
        } = match self.placing(&system, held, &dimensions, &at) {
            Some(few) => few,
            None => self.on_all(&system, &at)?,
        };
        let squares = |of: Vec<Recorded>| {
            let all = of.into_iter();
            all.fold(Recorded::zero(), |sum, x| sum + x * x)
        };
        let size = squares(
            rows.iter()
                .map(|(row, factor)| row.scale(*factor))
                .collect(),
        );
        let too_long = step.iter().map(|(_, x)| x.scale(1.0 / longest));
        let too_small = (pivots.iter()).map(|pivot| pivot.inverse.scale(pivot.scale * LEAST_PIVOT));
        let doubt = squares(too_long.chain(too_small).collect());
        // what is made of their pivots is their root
        let small = placing.iter().map(|pivot| {
            let least = Recorded::from_f64(pivot.scale * LEAST_PIVOT);
            least / (pivot.inverse * pivot.inverse)
        });
        let small = squares(small.collect());
        let mut along = vec![Recorded::zero(); system.unknowns().len()];
        step.iter().for_each(|&(i, x)| along[i] = x);
        let moved = system.displaced(&at, &along);
        let moved = self.state.iter().enumerate().filter_map(|(i, variable)| {
            let free = placed.iter().all(|(of, _)| *of != i);
            free.then(|| variable.of(self.mechanism, &moved))
        });
        let moved: Vec<Recorded> = moved.collect();
        placed.iter().for_each(|&(i, x)| state[i] = x);
        let (_, reached) = self.posed(&inputs, &state);
        let columns =
            Coordinate::all(self.mechanism).map(|of| of.of(self.mechanism, &reached).place());
        Ok(Results {
            size: size.place(),
            doubt: doubt.place(),
            moved: places(&moved),
            placed: numbered(&placed),
            placing: small.place(),
            columns: columns.collect(),
            decided: Recorded::decisions(),
        })
    }
}
