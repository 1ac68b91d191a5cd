//! Quantities at the configurations of a motion, from the engines of the analyses.

mod block;
mod jumps;
mod planned;
mod probe;
mod programs;
mod recorded;
mod values;
mod wants;

use crate::algebra::{BATCH, Expression};
use crate::analysis::singularities::Classifier;
use crate::analysis::sweep::{Pace, Row, Schedule};
use crate::analysis::velocity::{Normalised, Outputs, Spins, TransmissionAngles, axes, condition};
use crate::linear::DENSE_LIMIT;
use crate::mechanism::{Configuration, Figure, Frame, Measured, Order, Point, Quantity};
use crate::number::Number;
use crate::system::{self, Balance, Coordinate, Driven, Load, Lock, NamedUnit, Neighbourhood};
pub(crate) use block::MeterBlock;
use probe::{Plan, Probe};
pub(crate) use programs::Name;
pub(super) use programs::{evaluated, has_atan2, turns};
use recorded::Recording;
use values::KnownHere;
use wants::{Wants, points_of};

/// Quantities to be evaluated on a motion, with the motion's inputs, law, load and outputs.
#[derive(Clone, Debug)]
pub(crate) struct Metered<'q> {
    pub quantities: Vec<Quantity>,
    /// The question with the inputs held.
    pub question: system::Question<'q>,
    pub inputs: Vec<Driven>,
    pub pace: Pace,
    pub schedule: Option<Schedule>,
    pub load: Load,
    pub outputs: Vec<Lock>,
}

/// Number of rows after which the quantities are recorded as a program: that takes as long as reading some hundred rows
/// one
/// by one. Not in the page, which would grow by a tenth.
const RECORDED_AFTER: usize = match cfg!(target_family = "wasm") {
    true => usize::MAX,
    false => 96,
};

/// Evaluates quantities at assembled configurations. What to work out, and only what some quantity needs, is planned
/// once; rates, forces and Jacobian come from one factorisation of the closures. Of a long motion many rows are read side
/// by side.
pub(crate) struct Meter<'q> {
    of: &'q Metered<'q>,
    /// For each held coordinate the number of its input and how far that goes, if it is one.
    ways: Vec<Option<(usize, f64)>>,
    turns: Vec<bool>,
    /// Frames of links that spin about a line of their own: rates beside it are not determined.
    loose: Vec<Frame>,
    coordinates: Vec<Coordinate>,
    plan: Plan,
    probe: Probe<'q, f64>,
    /// Rows that wait for others.
    block: MeterBlock,
    /// Number of rows read.
    rows: usize,
    /// Program that reads many rows at once.
    recording: Option<Recording>,
    /// Number of failed attempts to record that program.
    failed: usize,
    spinning: Spinning<'q>,
    /// With the distances that are asked for.
    distances: Option<Box<(Classifier<'q>, Vec<Figure>)>>,
    wants: Wants,
    /// True if the mechanism moves in a plane.
    planar: bool,
    /// For each component of the reactions of closures, then of links, true if equilibrium determines it at the start.
    determined: Vec<[bool; 6]>,
    /// Rates, then accelerations of the held coordinates.
    driven: [Vec<f64>; 2],
    before: Vec<Option<f64>>,
    values: Vec<Option<f64>>,
    /// The names in the quantities, each once, with the number of the point or of the work if it is of one.
    names: Vec<(Name, usize)>,
    /// The work done where it is read next, of each such name in order; not a number where that is not told.
    works: Vec<f64>,
    /// The quantities over the numbers of these names.
    programs: Vec<Expression<usize>>,
    /// The values of the names, and how far each may be off.
    known: Vec<[f64; 2]>,
    /// Uncertainty of each quantity.
    noise: Vec<f64>,
}

/// Receiver of rows with the quantities at them.
pub(crate) type Take<'t> = dyn FnMut(&MeterBlock) + 't;

/// The lines about which links spin: none, or those of each configuration.
enum Spinning<'q> {
    Nothing(Spins),
    Something(Box<Neighbourhood<'q>>),
}

impl<'q> Meter<'q> {
    /// Reads the quantities.
    pub fn new(of: &'q Metered<'q>, start: &Configuration<f64>) -> Self {
        let turns = of.quantities.iter().map(turns).collect();
        Meter::reading(of, start, of.programs(), turns)
    }

    /// Reads what names stand for, angles between −π and π.
    pub fn of_names(of: &'q Metered<'q>, start: &Configuration<f64>, names: &[Name]) -> Self {
        let programs = (0..names.len()).map(Expression::name).collect();
        let turns = vec![false; names.len()];
        Meter::reading(of, start, (names.to_vec(), programs), turns)
    }

    /// The values at a configuration where a part of the time is gone; none where something is not determined.
    pub fn read(&mut self, at: &Configuration<f64>, time: f64) -> &[Option<f64>] {
        self.read_alone(at, time);
        for i in 0..self.values.len() {
            self.values[i] = self.values[i].map(|value| self.without_jump(i, value));
        }
        &self.values
    }

    /// Tells the work that is done where it is read next, for each such name in order.
    pub fn gathered(&mut self, works: &[f64]) {
        for (i, known) in self.works.iter_mut().enumerate() {
            *known = works.get(i).copied().unwrap_or(f64::NAN);
        }
    }

    /// The values at a configuration that belongs to no motion, angles between −π and π.
    pub fn read_here(&mut self, at: &Configuration<f64>) -> &[Option<f64>] {
        self.read_alone(at, 0.0);
        &self.values
    }

    /// The Jacobian where it was read last, row by row with units; none where rates are not determined, or nothing that
    /// was read needs it.
    pub fn jacobian(&self) -> Option<impl Iterator<Item = f64> + '_> {
        let found = &self.probe.found;
        let columns = self.coordinates.len();
        let rows = found.jacobian.given().len() / columns.max(1);
        let entries = (0..rows).flat_map(move |row| (0..columns).map(move |c| c * rows + row));
        found
            .moves
            .then(|| entries.map(|entry| found.jacobian.given()[entry]))
    }

    /// The rows and columns of the Jacobian.
    pub fn axes(&self) -> [Vec<NamedUnit>; 2] {
        let outputs = self.plan.outputs.as_deref().unwrap_or_default();
        axes(self.of.question.mechanism(), outputs, &self.coordinates)
    }

    /// Reads a row of a motion where a part of the time is gone, or lets it wait for others; rows go to `take` in their
    /// order.
    pub fn read_row(&mut self, row: &Row, time: f64, take: &mut Take) {
        self.block.put(row, time, &self.works);
        let rubs = self.wants.forces && self.of.load.has_friction();
        let alone = rubs || self.probe.unknowns() > DENSE_LIMIT || self.spins().is_none();
        if alone || self.block.len() == BATCH {
            self.read_waiting(take);
        }
    }

    /// Reads the rows that wait.
    pub fn read_waiting(&mut self, take: &mut Take) {
        /// A row may be singular.
        const TRIED: usize = 3;
        let mut block = std::mem::take(&mut self.block);
        let full = block.len() == BATCH;
        if full && self.rows >= RECORDED_AFTER && self.recording.is_none() && self.failed < TRIED {
            self.recording = self.recorded(&block);
            self.failed += usize::from(self.recording.is_none());
        }
        let read = self.read_together(&mut block);
        for i in (0..block.len()).filter(|i| !read[*i]) {
            let (row, time) = block.row(i);
            self.gathered(block.works(i));
            self.read_alone(row.configuration, time);
            for (column, known) in block
                .columns
                .iter_mut()
                .zip(self.values.iter().zip(&self.noise))
            {
                column.values[i] = known.0.unwrap_or(f64::NAN);
                column.noise[i] = *known.1;
            }
        }
        let count = block.len();
        for (i, column) in block.columns.iter_mut().enumerate() {
            if self.turns[i] {
                self.without_jumps(i, &mut column.values[..count]);
            }
        }
        self.rows += count;
        take(&block);
        block.clear();
        self.block = block;
    }

    /// The lines about which links spin, if they are the same everywhere.
    fn spins(&self) -> Option<&Spins> {
        match &self.spinning {
            Spinning::Nothing(spins) => Some(spins),
            Spinning::Something(_) => None,
        }
    }

    /// The figures of a Jacobian; none if they cannot be had over such numbers.
    fn figures_of<T: Number>(&self, jacobian: &Normalised<T>) -> Option<Vec<(Figure, Option<T>)>> {
        let mut figures = Vec::new();
        if self.wants.determinant {
            figures.push((Figure::Determinant, Some(jacobian.determinant()?)));
        }
        if self.wants.singular_values {
            let values = jacobian.singular_values()?;
            let product = values.iter().fold(T::one(), |product, x| product * *x);
            figures.push((Figure::Condition, condition(&values)));
            figures.push((Figure::Manipulability, Some(product)));
        }
        Some(figures)
    }

    /// The values at one configuration, angles between −π and π.
    fn read_alone(&mut self, at: &Configuration<f64>, time: f64) {
        let pace = self.drive(time);
        let seconds = time * self.of.pace.duration;
        match &mut self.spinning {
            Spinning::Nothing(spins) => {
                (self.probe).at(&self.plan, at, &self.driven, (pace, seconds), spins)
            }
            Spinning::Something(held) => {
                let rest = held.tangent(at.clone());
                let spins = Spins::of(held, &rest);
                (self.probe).at(&self.plan, at, &self.driven, (pace, seconds), &spins)
            }
        }
        let found = std::mem::take(&mut self.probe.found);
        let figures = match found.moves {
            true => self.figures_of(&found.jacobian),
            false => None,
        };
        let mut figures = figures.unwrap_or_default();
        if let Some((classifier, distances)) = self.distances.as_deref_mut() {
            let of = |figure: &Figure| (*figure, classifier.distance(*figure, at));
            figures.extend(distances.iter().map(of));
        }
        let both = KnownHere::both(
            at,
            &found,
            &figures,
            (pace, seconds, &self.works),
            &self.probe,
        );
        let mut known = std::mem::take(&mut self.known);
        for (known, (name, number)) in known.iter_mut().zip(&self.names) {
            *known = self.value(&both[usize::from(name.geometric)], &name.of, *number);
        }
        for (i, program) in self.programs.iter().enumerate() {
            (self.values[i], self.noise[i]) = evaluated(program, &known);
        }
        self.known = known;
        self.probe.found = found;
    }

    /// Sets rates and accelerations of the held coordinates where a part of the time is gone: those at a constant pace,
    /// with the pace there, s′ and s″ over the duration; of a table its own, with the pace 1. Where a table is at rest its
    /// accelerations are the rates: so it begins to move.
    fn drive(&mut self, time: f64) -> [f64; 2] {
        let [rates, changes] = &mut self.driven;
        changes.fill(0.0);
        let Some(schedule) = &self.of.schedule else {
            for (rate, way) in rates.iter_mut().zip(&self.ways) {
                *rate = way.map_or(0.0, |(_, way)| way / self.of.pace.duration);
            }
            return self.of.pace.relative(time);
        };
        for (i, way) in self.ways.iter().enumerate() {
            let driven = way.map_or([0.0; 2], |(input, _)| schedule.rates(input, time));
            [rates[i], changes[i]] = driven;
        }
        if rates.iter().any(|rate| *rate != 0.0) {
            return [1.0, 0.0];
        }
        std::mem::swap(rates, changes);
        [0.0, 1.0]
    }

    /// The time of the motion, in s.
    pub fn duration(&self) -> f64 {
        self.of.pace.duration
    }

    /// Uncertainty of each value last read.
    pub fn noise(&self) -> &[f64] {
        &self.noise
    }
}
