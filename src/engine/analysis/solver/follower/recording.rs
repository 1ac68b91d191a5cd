//! The program of a follower.

use crate::algebra::{Decision, LEAST_PIVOT, OperationIndex, Recorded, eliminate};
use crate::analysis::solver::iteration::{Iteration, places};
use crate::analysis::solver::{NoSolver, VariablePlan};
use crate::linear::DENSE_LIMIT;
use crate::number::Number;
use crate::system::{Coordinate, System};

/// The places of the program's results.
pub(super) struct WrittenIteration {
    /// Section by section.
    pub sections: [Vec<OperationIndex>; 6],
    /// The numbers of the state that follow from the others, in their order.
    pub placed: Vec<usize>,
    pub unknowns: usize,
    pub decisions: Vec<Decision>,
}

impl VariablePlan<'_> {
    /// Records the iteration and the numbers that follow from it. The inputs are the held values that change, then the
    /// state.
    pub(super) fn recorded(
        &self,
        changing: &[usize],
        values: &[f64],
        longest: f64,
    ) -> Result<WrittenIteration, NoSolver> {
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
            jacobian,
        } = match self.placing(&system, held, &dimensions, &at) {
            Some(few) => few,
            None => self.on_all(&system, &at)?,
        };
        let unknowns = step.len();
        let unit = |row: usize| {
            let entries = (0..rows.len()).map(|i| if i == row { 1.0 } else { 0.0 });
            entries.map(Recorded::from_f64).collect()
        };
        let units = (0..rows.len()).map(unit).collect();
        let columns = match unknowns <= DENSE_LIMIT {
            true => eliminate(jacobian.clone(), units, unknowns).map_or_else(|_| vec![], |of| of.0),
            false => Vec::new(),
        };
        let inverse = (0..unknowns).flat_map(|k| columns.iter().map(move |column| column[k]));
        let inverse: Vec<Recorded> = inverse.collect();
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
        let step = moved.chain([doubt]).collect::<Vec<Recorded>>();
        placed.iter().for_each(|&(i, x)| state[i] = x);
        let (_, reached) = self.posed(&inputs, &state);
        let columns = Coordinate::all(self.mechanism).map(|of| of.of(self.mechanism, &reached));
        let following = placed.iter().map(|(_, x)| *x);
        let reached: Vec<Recorded> = [small]
            .into_iter()
            .chain(following)
            .chain(columns)
            .collect();
        let sections = [
            &[],
            &[size][..],
            &step,
            &reached,
            &jacobian.concat(),
            &inverse,
        ];
        Ok(WrittenIteration {
            sections: sections.map(places),
            placed: placed.iter().map(|(i, _)| *i).collect(),
            unknowns,
            decisions: Recorded::decisions(),
        })
    }
}
