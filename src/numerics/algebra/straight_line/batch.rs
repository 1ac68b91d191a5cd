//! A straight-line program run for many rows of inputs at once.

mod instructions;

use std::cell::Cell;
use std::f64::consts::TAU;

use rustc_hash::FxHashMap;

use super::{Operation, OperationIndex};
use crate::algebra::evaluation::call;
use crate::number::Number;
use crate::number::trigonometry::{atan2_of_each, sin_cos_of_each};
use crate::number::widest;
use instructions::{Instruction, Opcode, RegisterAssignment, last_uses, needed, written};

/// Rows that are run at once: enough that choosing the operation costs little, few enough that the registers stay in the
/// first cache.
pub const BATCH: usize = 32;

/// A number for each row.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Register([f64; BATCH]);

/// A straight-line program for rows side by side, with the bits that its operations give one by one.
///
/// It consists of sections. The first is run once, then the second and after it any of the others, as often as needed. The
/// results of a section hold until one before it is run again.
#[derive(Clone, Debug)]
pub struct Batch {
    sections: Vec<Vec<Instruction>>,
    /// The registers of constants.
    constants: Vec<(u32, f64)>,
    /// The registers of the places that were asked for.
    results: FxHashMap<OperationIndex, u32>,
    registers: u32,
}

/// The numbers of a program for [`BATCH`] rows.
#[derive(Clone, Debug)]
pub struct Registers(Vec<Register>);

impl Batch {
    /// The program that computes the places of each section, without what none of them needs. `inputs` is the number of
    /// inputs.
    pub fn new(operations: &[Operation], inputs: usize, sections: &[Vec<OperationIndex>]) -> Self {
        let needed = needed(operations, sections);
        let kept: Vec<OperationIndex> = sections.concat();
        let (written, constants, places) = written(operations, sections.len(), &needed, &kept);
        let mut assignment = RegisterAssignment::new(inputs, constants.len(), places);
        for (place, operation) in operations.iter().enumerate() {
            if let Operation::Input(input) = *operation {
                assignment.register[place] = input;
            }
        }
        let constants = constants.into_iter();
        let constants = constants.map(|(place, value)| (assignment.fresh(place), value));
        let constants: Vec<(u32, f64)> = constants.collect();
        let last = last_uses(&written, &needed, &kept, places);
        let mut number = 0;
        let mut assigned = |mut instruction: Instruction| {
            assignment.assign(&mut instruction, &last, number);
            number += 1;
            instruction
        };
        let sections = written.into_iter();
        let sections = sections.map(|section| section.into_iter().map(&mut assigned).collect());
        let sections = sections.collect();
        let result = |&place: &OperationIndex| (place, assignment.register[place as usize]);
        Batch {
            results: kept.iter().map(result).collect(),
            registers: assignment.registers,
            sections,
            constants,
        }
    }

    /// Results needed for `places` that follow from the first inputs alone: those for the first section to compute.
    pub fn known(
        operations: &[Operation],
        first: usize,
        places: &[OperationIndex],
    ) -> Vec<OperationIndex> {
        let mut known: Vec<bool> = Vec::with_capacity(operations.len());
        for operation in operations {
            known.push(match *operation {
                Operation::Input(i) => (i as usize) < first,
                _ => operation.operands().all(|place| known[place as usize]),
            });
        }
        let needed = needed(operations, &[places.to_vec()]);
        let needed = |place: &OperationIndex| needed[*place as usize].is_some();
        let all = 0..operations.len() as OperationIndex;
        let open = all.filter(|place| needed(place) && !known[*place as usize]);
        let used = open.flat_map(|place| operations[place as usize].operands());
        let mut found: Vec<OperationIndex> = used.chain(places.iter().copied()).collect();
        found.sort_unstable();
        found.dedup();
        found.retain(|&place| {
            let computed = operations[place as usize].operands().next().is_some();
            computed && known[place as usize]
        });
        found
    }

    /// Registers with the constants in them.
    pub fn registers(&self) -> Registers {
        let all = |value| Register([value; BATCH]);
        let mut registers = vec![all(0.0); self.registers as usize];
        for &(register, value) in &self.constants {
            registers[register as usize] = all(value);
        }
        Registers(registers)
    }

    /// Runs a section.
    pub fn run(&self, section: usize, registers: &mut Registers) {
        run(&self.sections[section], &mut registers.0);
    }

    /// The register in which the number of a place of a section is found.
    ///
    /// # Panics
    /// If no section has that place.
    pub fn result(&self, place: OperationIndex) -> usize {
        self.results[&place] as usize
    }
}

impl Registers {
    /// The numbers of all rows in a register.
    pub fn rows(&self, register: usize) -> &[f64; BATCH] {
        &self.0[register].0
    }

    /// The numbers of all rows in a register, to be set; those of inputs are the first registers.
    pub fn rows_mut(&mut self, register: usize) -> &mut [f64; BATCH] {
        &mut self.0[register].0
    }
}

widest! {
    fn run(instructions: &[Instruction], registers: &mut [Register]) runs each
}

/// The numbers of a register.
type RegisterRow<'a> = &'a [Cell<f64>; BATCH];

#[inline(always)]
fn each(instructions: &[Instruction], registers: &mut [Register]) {
    let registers = Cell::from_mut(registers).as_slice_of_cells();
    let row = |register: u32| row(&registers[register as usize]);
    for instruction in instructions {
        let to = row(instruction.to);
        let of = |i: usize| row(instruction.of[i]);
        let two = || [of(0), of(1)];
        let three = || [of(0), of(1), of(2)];
        let four = || [of(0), of(1), of(2), of(3)];
        let five = || [of(0), of(1), of(2), of(3), of(4)];
        match instruction.code {
            Opcode::Add => set(to, two(), |[x, y]| x + y),
            Opcode::Subtract => set(to, two(), |[x, y]| x - y),
            Opcode::Multiply => set(to, two(), |[x, y]| x * y),
            Opcode::AddProduct => set(to, three(), |[x, y, z]| z + x * y),
            Opcode::SubtractProduct => set(to, three(), |[x, y, z]| z - x * y),
            Opcode::SubtractFromProduct => set(to, three(), |[x, y, z]| x * y - z),
            Opcode::AddedProducts => set(to, four(), |[x, y, z, u]| x * y + z * u),
            Opcode::SubtractedProducts => set(to, four(), |[x, y, z, u]| x * y - z * u),
            Opcode::AddProducts => set(to, five(), |[x, y, z, u, w]| (w + x * y) + z * u),
            Opcode::SubtractProducts => set(to, five(), |[x, y, z, u, w]| (w - x * y) - z * u),
            Opcode::SubtractFromAndProduct => {
                set(to, five(), |[x, y, z, u, w]| (x * y - w) - z * u);
            }
            Opcode::Divide => set(to, two(), |[x, y]| x / y),
            Opcode::Negate => set(to, [of(0)], |[x]| -x),
            Opcode::Root => set(to, [of(0)], |[x]| x.sqrt()),
            Opcode::RootOrZero => set(to, [of(0)], |[x]| x.max(0.0).sqrt()),
            Opcode::Near => set(to, two(), |[x, y]| {
                x + TAU * ((y - x) / TAU).round_ties_even()
            }),
            Opcode::Sign => set(to, [of(0)], |[x]| if x < 0.0 { -1.0 } else { 1.0 }),
            Opcode::Larger => set(to, two(), |[x, y]| x.greater(y)),
            Opcode::Call(f) => set(to, [of(0)], |[x]| call(f, x, x)),
            Opcode::Angle => {
                let [y, x] = two();
                let angles = atan2_of_each(numbers(y), numbers(x));
                (0..BATCH).for_each(|i| to[i].set(angles[i]));
            }
            Opcode::SinCos => {
                let [x, second] = two();
                let (sin, cos) = sin_cos_of_each(numbers(x));
                for i in 0..BATCH {
                    to[i].set(sin[i]);
                    second[i].set(cos[i]);
                }
            }
        }
    }
}

/// Several registers are borrowed at once and one of them is set, in a loop that the compiler makes into vector
/// instructions. With copies of parts of registers in place of cells it does not: a step took four times as long.
#[inline(always)]
fn row(register: &Cell<Register>) -> RegisterRow<'_> {
    let first: *const Cell<Register> = register;
    // SAFETY: a cell is laid out as what is in it, and a register begins with its numbers
    #[allow(unsafe_code)]
    unsafe {
        &*first.cast()
    }
}

#[inline(always)]
fn numbers(row: RegisterRow) -> [f64; BATCH] {
    std::array::from_fn(|i| row[i].get())
}

#[inline(always)]
fn set<const N: usize>(to: RegisterRow, of: [RegisterRow; N], f: impl Fn([f64; N]) -> f64) {
    for i in 0..BATCH {
        to[i].set(f(of.map(|of| of[i].get())));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Recorded, record};
    use crate::number::Number;

    /// Inputs of one row.
    fn row(i: usize) -> [f64; 3] {
        let x = i as f64;
        [0.4 + 0.03 * x, 1.7 - 0.11 * x, -0.9 + 0.05 * x]
    }

    #[test]
    fn rows_have_the_bits_of_the_operations_one_by_one() {
        let (places, operations) = record(row(0).to_vec(), || {
            let [x, y, z] = [0, 1, 2].map(Recorded::input);
            let (sin, cos) = x.sin_cos();
            let held = sin * y + cos;
            let angle = Recorded::angle(z * held - y, x * y, z);
            let (sin, cos) = (z * y).sin_cos();
            let first = vec![held.place()];
            let root = (y * z - held * sin).root_or_zero() + (x * x).sqrt();
            let more = [
                angle,
                root / (cos + held),
                (held - y * z).sign(),
                -sin - x * z,
                x.greater(z * y),
                (x * z).exp(),
                // two products in one instruction
                x * held + y * cos,
                x * sin - z * held,
                held + x * root + z * root,
                sin - y * root - z * cos,
                y * held - root - x * cos,
            ];
            vec![
                first,
                vec![more[0].place()],
                more.map(Recorded::place).to_vec(),
            ]
        });
        let batch = Batch::new(&operations, 3, &places);
        let mut registers = batch.registers();
        for i in 0..BATCH {
            for (input, value) in row(i).into_iter().enumerate() {
                registers.rows_mut(input)[i] = value;
            }
        }
        let mut narrow = registers.clone();
        for section in [0, 1, 2, 1, 2] {
            batch.run(section, &mut registers);
            each(&batch.sections[section], &mut narrow.0);
        }
        for i in 0..BATCH {
            let mut values: Vec<f64> = Vec::new();
            for operation in &operations {
                let value = operation.value(|x| values[x as usize], |input| row(i)[input as usize]);
                values.push(value);
            }
            for &place in places.iter().flatten() {
                let expected = values[place as usize].to_bits();
                for registers in [&registers, &narrow] {
                    let found = registers.rows(batch.result(place))[i];
                    assert_eq!(found.to_bits(), expected);
                }
            }
        }
    }
}
