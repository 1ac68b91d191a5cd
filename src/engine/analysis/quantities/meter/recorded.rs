//! Quantities at many rows at once, by the operations that give them at one.

use super::Meter;
use super::block::{MeterBlock, MeterColumn};
use super::probe::Probe;
use super::programs::{estimated, is_clear, is_name};
use super::values::KnownHere;
use crate::algebra::{BATCH, Decision, OperationIndex, Recorded, Registers, record};
use crate::mechanism::Configuration;
use crate::number::{Number, widest};
use crate::system::{LaneProgram, Mask, bits};

/// The quantities as a program, which holds wherever all that was decided at one row is decided in the same way.
pub(super) struct Recording {
    program: LaneProgram,
    registers: Registers,
    /// For each quantity, true if its value must be large beside how far it may be off.
    clear: Vec<bool>,
    /// The register of the first of the figures that follow from the entries of a Jacobian row by row.
    figures: usize,
}

/// The section of the entries of a Jacobian, if its figures follow from them row by row.
const ENTRIES: usize = 1;
/// The section of each quantity's value and how far that may be off.
const VALUES: usize = 2;

impl Recording {
    /// Runs the program for the rows of a block whose numbers are put into the registers; for each, true if it holds.
    fn run(&mut self, block: &mut MeterBlock) -> [bool; BATCH] {
        self.program.run(VALUES, &mut self.registers);
        let mut holds = [u64::MAX; BATCH];
        self.program.holds(&mut holds, &self.registers);
        told(self, &mut block.columns, &mut holds);
        holds.map(|of| of != 0)
    }

    /// Gives the quantities to columns and leaves the rows in which all have values.
    #[inline(always)]
    fn tell(&self, columns: &mut [MeterColumn], holds: &mut Mask) {
        let values = self.program.results(VALUES).chunks_exact(2);
        for ((column, of), clear) in columns.iter_mut().zip(values).zip(&self.clear) {
            let [value, noise] = [0, 1].map(|k| self.registers.rows(of[k]));
            column.values = *value;
            for (i, holds) in holds.iter_mut().enumerate() {
                let (value, noise) = (value[i], noise[i].abs());
                column.noise[i] = noise;
                let clear = !clear | is_clear([value, noise]);
                *holds &= bits(value.is_finite() & clear);
            }
        }
    }
}

widest! {
    fn told(recording: &Recording, columns: &mut [MeterColumn], holds: &mut Mask) runs Recording::tell
}

impl Meter<'_> {
    /// The numbers at a row from which its quantities follow.
    fn given(&mut self, at: &Configuration<f64>, time: f64, mut put: impl FnMut(usize, f64)) {
        let mut next = 0;
        let mut put = |x: f64| {
            put(next, x);
            next += 1;
        };
        at.numbers().for_each(&mut put);
        put(time);
        if let Some(schedule) = &self.of.schedule {
            let inputs = self.ways.iter().flatten();
            let rates = inputs.flat_map(|(input, _)| schedule.rates(*input, time));
            rates.for_each(&mut put);
        }
        self.works.iter().copied().for_each(&mut put);
        if let Some((classifier, figures)) = self.distances.as_deref_mut() {
            for figure in figures {
                put(classifier.distance(*figure, at).unwrap_or(f64::NAN));
            }
        }
    }

    /// Writes the quantities down at a row; none if not all of them can be, or if it is singular.
    pub(super) fn recorded(&mut self, block: &MeterBlock) -> Option<Recording> {
        let (row, time) = block.row(0);
        self.gathered(block.works(0));
        let mut sample = Vec::new();
        self.given(row.configuration, time, |_, x| sample.push(x));
        // the figures of the row that was read last
        let known = self.figures_of(&self.probe.found.jacobian)?;
        let first = sample.len();
        sample.extend(known.iter().map(|(_, value)| value.unwrap_or(f64::NAN)));
        let inputs = sample.len();
        let (written, operations) = record(sample, || self.written(row.configuration));
        let (sections, decisions) = written?;
        let program = LaneProgram::new(&operations, (inputs, 0), &sections, (&decisions, VALUES));
        Some(Recording {
            registers: program.registers(),
            clear: self.programs.iter().map(|of| !is_name(of)).collect(),
            figures: first,
            program,
        })
    }

    /// Writes everything, section by section.
    fn written(
        &self,
        at: &Configuration<f64>,
    ) -> Option<([Vec<OperationIndex>; 3], Vec<Decision>)> {
        let mut all = (0..).map(Recorded::input);
        let mut next = || all.next().expect("there is no last one");
        let at = at.map(|_| next());
        let mut driven = [(); 2].map(|()| vec![Recorded::zero(); self.ways.len()]);
        let time = next();
        let seconds = time.scale(self.of.pace.duration);
        let pace = match self.of.schedule {
            None => self.of.pace.relative(time),
            Some(_) => [Recorded::one(), Recorded::zero()],
        };
        for (of, way) in self.ways.iter().enumerate() {
            let Some((_, way)) = *way else { continue };
            [driven[0][of], driven[1][of]] = match self.of.schedule {
                None => [way / self.of.pace.duration, 0.0].map(Recorded::from_f64),
                Some(_) => [next(), next()],
            };
        }
        let works: Vec<Recorded> = self.works.iter().map(|_| next()).collect();
        let mut probe = Probe::new(self.of, &self.plan);
        probe.at(&self.plan, &at, &driven, (pace, seconds), self.spins()?);
        let found = &probe.found;
        if self.plan.moves() && !found.moves {
            return None;
        }
        let mut distances = Vec::new();
        if let Some((_, wanted)) = self.distances.as_deref() {
            distances.extend(wanted.iter().map(|figure| (*figure, Some(next()))));
        }
        let (mut figures, entries) = match self.figures_of(&found.jacobian) {
            Some(figures) => (figures, Vec::new()),
            None => {
                let known = self.figures_of(&self.probe.found.jacobian)?;
                let given = known.iter().map(|(figure, _)| (*figure, Some(next())));
                let entries = found.jacobian.entries().iter().map(|x| x.place());
                (given.collect(), entries.collect())
            }
        };
        figures.extend(distances);
        let both = KnownHere::both(&at, found, &figures, (pace, seconds, &works), &probe);
        let names = self.names.iter();
        let known: Vec<[Recorded; 2]> = names
            .map(|(name, number)| self.value(&both[usize::from(name.geometric)], &name.of, *number))
            .collect();
        let mut values = Vec::new();
        for program in &self.programs {
            values.extend(estimated(program, &known)?.map(Recorded::place));
        }
        Some(([Vec::new(), entries, values], Recorded::decisions()))
    }

    /// Reads the rows of a block side by side; for each, true if it could be.
    pub(super) fn read_together(&mut self, block: &mut MeterBlock) -> [bool; BATCH] {
        let Some(mut recording) = self.recording.take() else {
            return [false; BATCH];
        };
        for i in 0..block.len() {
            let (row, time) = block.row(i);
            self.gathered(block.works(i));
            let registers = &mut recording.registers;
            self.given(row.configuration, time, |input, x| {
                registers.rows_mut(input)[i] = x;
            });
        }
        let Recording {
            program,
            registers,
            figures: first,
            ..
        } = &mut recording;
        (LaneProgram::KNOWN..=ENTRIES).for_each(|section| program.run(section, registers));
        let entries = program.results(ENTRIES);
        if !entries.is_empty() {
            let mut jacobian = std::mem::take(&mut self.probe.found.jacobian);
            for i in 0..block.len() {
                jacobian.set_entries(entries.iter().map(|of| registers.rows(*of)[i]));
                let figures = self.figures_of(&jacobian).into_iter().flatten();
                for (k, (_, value)) in figures.enumerate() {
                    registers.rows_mut(*first + k)[i] = value.unwrap_or(f64::NAN);
                }
            }
            self.probe.found.jacobian = jacobian;
        }
        let holds = recording.run(block);
        self.recording = Some(recording);
        holds
    }
}
