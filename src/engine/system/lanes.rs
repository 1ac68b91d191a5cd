//! Many configurations of one mechanism at once: operations recorded at a sample, run for [`BATCH`] lanes side by side.

use crate::algebra::{BATCH, Batch, Decision, Operation, OperationIndex, Registers};
use crate::number::widest;

/// For each lane all bits or none.
pub(crate) type Mask = [u64; BATCH];

/// A number for each lane.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct LaneNumbers(pub [f64; BATCH]);

/// A recorded program for [`BATCH`] lanes. Each lane has the bits that it would have without the others.
#[derive(Clone, Debug)]
pub(crate) struct LaneProgram {
    batch: Batch,
    /// For each section the registers of its results, in their order.
    results: Vec<Vec<usize>>,
    /// Registers of the numbers on whose sign the program rests, and true for negative ones.
    decided: Vec<(usize, bool)>,
}

impl LaneProgram {
    /// The section that computes what follows from the known inputs alone, to be run before the others.
    pub const KNOWN: usize = 0;

    /// The program for the places of each section from [`KNOWN`](Self::KNOWN) on, that one empty, over so many inputs, of
    /// which the first are known. Decisions are computed with the section `decided`.
    pub fn new(
        operations: &[Operation],
        (inputs, known): (usize, usize),
        sections: &[Vec<OperationIndex>],
        (decisions, decided): (&[Decision], usize),
    ) -> Self {
        let mut all = sections.to_vec();
        all[decided].extend(decisions.iter().map(|(place, _)| *place));
        all[Self::KNOWN] = Batch::known(operations, known, &all.concat());
        let batch = Batch::new(operations, inputs, &all);
        let registers =
            |of: &Vec<OperationIndex>| of.iter().map(|&place| batch.result(place)).collect();
        LaneProgram {
            results: sections.iter().map(registers).collect(),
            decided: (decisions.iter())
                .map(|&(place, negative)| (batch.result(place), negative))
                .collect(),
            batch,
        }
    }

    /// Registers with the constants in them; those of inputs are the first.
    pub fn registers(&self) -> Registers {
        self.batch.registers()
    }

    /// Runs a section.
    pub fn run(&self, section: usize, registers: &mut Registers) {
        self.batch.run(section, registers);
    }

    /// The registers of the results of a section.
    pub fn results(&self, section: usize) -> &[usize] {
        &self.results[section]
    }

    /// Leaves those lanes in which everything is decided as at the sample.
    pub fn holds(&self, lanes: &mut Mask, registers: &Registers) {
        agree(&self.decided, lanes, registers);
    }

    /// Newton's method from what is in the registers: runs what is known, then the section of rows and that of the step,
    /// whose results are moved between registers, until no lane is open. After each of the two, `judge` closes lanes.
    pub fn newton(
        &self,
        [rows, step]: [usize; 2],
        moved: &[(usize, usize)],
        (mut open, most): (Mask, usize),
        registers: &mut Registers,
        mut judge: impl FnMut(usize, &mut Mask, &Registers),
    ) {
        self.run(Self::KNOWN, registers);
        for number in 0..=most {
            self.run(rows, registers);
            judge(rows, &mut open, registers);
            if number == most || open == [0; BATCH] {
                break;
            }
            self.run(step, registers);
            judge(step, &mut open, registers);
            assign(moved, &open, registers);
        }
    }
}

impl LaneNumbers {
    /// 0 in each lane.
    pub const ZERO: LaneNumbers = LaneNumbers([0.0; BATCH]);
}

widest! {
    /// Copies the numbers of some lanes to the first register of each pair from the second.
    pub(crate) fn assign(pairs: &[(usize, usize)], lanes: &Mask, registers: &mut Registers) runs assign_each
}

widest! {
    fn agree(decided: &[(usize, bool)], lanes: &mut Mask, registers: &Registers) runs agree_each
}

widest! {
    /// Leaves lanes in which none of the numbers in these registers is larger than a bound.
    pub(crate) fn small(of: &[usize], most: f64, lanes: &mut Mask, registers: &Registers) runs small_each
}

#[inline(always)]
fn assign_each(pairs: &[(usize, usize)], lanes: &Mask, registers: &mut Registers) {
    for &(to, from) in pairs {
        let from = *registers.rows(from);
        choose(registers.rows_mut(to), &from, lanes);
    }
}

/// Leaves lanes whose numbers have these signs; a NaN has none.
#[inline(always)]
fn agree_each(decided: &[(usize, bool)], lanes: &mut Mask, registers: &Registers) {
    for &(register, negative) in decided {
        let both = lanes.iter_mut().zip(registers.rows(register));
        match negative {
            true => both.for_each(|(lane, x)| *lane &= bits(*x < 0.0)),
            false => both.for_each(|(lane, x)| *lane &= bits(*x >= 0.0)),
        }
    }
}

/// Leaves lanes in which none of the numbers is larger than this; a NaN is.
#[inline(always)]
fn small_each(of: &[usize], most: f64, lanes: &mut Mask, registers: &Registers) {
    for &register in of {
        for (lane, x) in lanes.iter_mut().zip(registers.rows(register)) {
            *lane &= bits(x.abs() <= most);
        }
    }
}

/// Sets the numbers of some lanes.
#[inline(always)]
pub(crate) fn choose(to: &mut [f64; BATCH], from: &[f64; BATCH], lanes: &Mask) {
    for i in 0..BATCH {
        let kept = to[i].to_bits() & !lanes[i];
        to[i] = f64::from_bits(kept | from[i].to_bits() & lanes[i]);
    }
}

/// All bits, or none.
#[inline(always)]
pub(crate) fn bits(all: bool) -> u64 {
    u64::from(all).wrapping_neg()
}
