//! A straight-line program run for many rows of inputs at once.

use std::f64::consts::TAU;

use rustc_hash::FxHashMap;

use super::{Operation, Place};
use crate::algebra::Function;
use crate::algebra::evaluation::call;
use crate::number::Number;
use crate::number::trigonometry::{atan2_of_each, sin_cos_of_each};

/// How many numbers one instruction of the processor takes, with AVX-512.
const WIDTH: usize = 8;
/// How many of these a register holds: enough that choosing the operation costs little, few enough that the registers
/// stay in the first cache.
const DEPTH: usize = 4;

/// Rows that are run at once.
pub const BATCH: usize = WIDTH * DEPTH;

/// One number for each row.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Register([[f64; WIDTH]; DEPTH]);

/// A straight-line program for rows side by side, with the bits that its operations give one by one.
///
/// It consists of sections. The first is run once, the others in their order, as often as needed.
#[derive(Clone, Debug)]
pub struct Batch {
    sections: Vec<Vec<Instruction>>,
    /// The registers of constants.
    constants: Vec<(u32, f64)>,
    /// The registers of the places that were asked for.
    results: FxHashMap<Place, u32>,
    registers: u32,
}

/// The numbers of a program for [`BATCH`] rows.
#[derive(Clone, Debug)]
pub struct Registers(Vec<Register>);

#[derive(Clone, Copy, Debug)]
struct Instruction {
    code: Code,
    to: u32,
    of: [u32; 3],
}

#[derive(Clone, Copy, Debug)]
enum Code {
    Add,
    Subtract,
    Multiply,
    /// z + x y
    AddProduct,
    /// z − x y
    SubtractProduct,
    /// x y − z
    SubtractFromProduct,
    Divide,
    Negate,
    Root,
    /// The sine of x; its cosine goes into the register y.
    SinCos,
    RootOrZero,
    Angle,
    Near,
    Sign,
    Larger,
    Call(Function),
}

impl Batch {
    /// The program that computes the places of each section, without what none of them needs. `inputs` is the number of
    /// inputs.
    pub fn new(operations: &[Operation], inputs: usize, sections: &[Vec<Place>]) -> Self {
        let needed = needed(operations, sections);
        let kept: Vec<Place> = sections.concat();
        let (written, constants, places) = written(operations, sections.len(), &needed, &kept);
        let fixed = (inputs + constants.len()) as u32;
        let mut assignment = Assignment {
            register: vec![u32::MAX; places],
            fixed,
            free: Vec::new(),
            registers: inputs as u32,
        };
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
        let result = |&place: &Place| (place, assignment.register[place as usize]);
        Batch {
            results: kept.iter().map(result).collect(),
            registers: assignment.registers,
            sections,
            constants,
        }
    }

    /// Registers with the constants in them.
    pub fn registers(&self) -> Registers {
        let all = |value| Register([[value; WIDTH]; DEPTH]);
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
    pub fn result(&self, place: Place) -> usize {
        self.results[&place] as usize
    }
}

impl Registers {
    /// The numbers of all rows in a register.
    pub fn rows(&self, register: usize) -> &[f64; BATCH] {
        let rows = self.0[register].0.as_flattened();
        rows.try_into()
            .expect("a register has a number for each row")
    }

    /// The same to be set: the registers of inputs are the first ones.
    pub fn rows_mut(&mut self, register: usize) -> &mut [f64; BATCH] {
        let rows = self.0[register].0.as_flattened_mut();
        rows.try_into()
            .expect("a register has a number for each row")
    }
}

/// For each place the first section that needs it.
fn needed(operations: &[Operation], sections: &[Vec<Place>]) -> Vec<Option<usize>> {
    let mut needed = vec![None; operations.len()];
    for (section, places) in sections.iter().enumerate() {
        for &place in places {
            needed[place as usize].get_or_insert(section);
        }
        for place in (0..operations.len()).rev() {
            if needed[place] == Some(section) {
                for operand in operations[place].operands() {
                    needed[operand as usize].get_or_insert(section);
                }
            }
        }
    }
    needed
}

type Written = (Vec<Vec<Instruction>>, Vec<(u32, f64)>, usize);

/// The instructions of each section, over places in place of registers, the constants, and how many places there are.
fn written(
    operations: &[Operation],
    sections: usize,
    needed: &[Option<usize>],
    kept: &[Place],
) -> Written {
    use Operation as O;
    let fused = fused(operations, needed, kept);
    let product = |place: Place| match operations[place as usize] {
        O::Multiply(x, y) if fused[place as usize] => Some((x, y)),
        _ => None,
    };
    let mut written = vec![Vec::new(); sections];
    let mut constants = Vec::new();
    let mut angles: FxHashMap<(usize, Place), usize> = FxHashMap::default();
    let mut places = operations.len();
    for (place, operation) in operations.iter().enumerate() {
        let Some(section) = needed[place] else {
            continue;
        };
        let (code, of) = match *operation {
            O::Constant(value) => {
                constants.push((place as u32, value));
                continue;
            }
            O::Input(_) => continue,
            O::Multiply(..) if fused[place] => continue,
            O::Add(x, y) => match (product(x), product(y)) {
                (Some((a, b)), _) => (Code::AddProduct, [a, b, y]),
                (None, Some((a, b))) => (Code::AddProduct, [a, b, x]),
                (None, None) => (Code::Add, [x, y, x]),
            },
            O::Subtract(x, y) => match (product(x), product(y)) {
                (_, Some((a, b))) => (Code::SubtractProduct, [a, b, x]),
                (Some((a, b)), None) => (Code::SubtractFromProduct, [a, b, y]),
                (None, None) => (Code::Subtract, [x, y, x]),
            },
            O::Multiply(x, y) => (Code::Multiply, [x, y, x]),
            O::Divide(x, y) => (Code::Divide, [x, y, x]),
            O::Negate(x) => (Code::Negate, [x; 3]),
            O::Root(x) => (Code::Root, [x; 3]),
            O::RootOrZero(x) => (Code::RootOrZero, [x; 3]),
            O::Angle(y, x) => (Code::Angle, [y, x, y]),
            O::Near(x, y) => (Code::Near, [x, y, x]),
            O::Sign(x) => (Code::Sign, [x; 3]),
            O::Larger(x, y) => (Code::Larger, [x, y, x]),
            O::Call(function, x) => (Code::Call(function), [x; 3]),
            O::Sin(x) | O::Cos(x) => {
                let section: &mut Vec<Instruction> = &mut written[section];
                let both = angles.entry((needed[place].unwrap_or(0), x));
                let at = *both.or_insert_with(|| {
                    // the one that is not needed has a place of its own
                    let [sin, cos] = [places as u32, places as u32 + 1];
                    places += 2;
                    section.push(Instruction {
                        code: Code::SinCos,
                        to: sin,
                        of: [x, cos, x],
                    });
                    section.len() - 1
                });
                match operation {
                    O::Sin(_) => section[at].to = place as u32,
                    _ => section[at].of[1] = place as u32,
                }
                continue;
            }
        };
        written[section].push(Instruction {
            code,
            to: place as u32,
            of,
        });
    }
    (written, constants, places)
}

/// The products that are used once only, by a sum or difference of their own section, and are computed with it.
fn fused(operations: &[Operation], needed: &[Option<usize>], kept: &[Place]) -> Vec<bool> {
    let mut users: Vec<Option<usize>> = vec![None; operations.len()];
    let mut fused = vec![false; operations.len()];
    let mut used_again = vec![false; operations.len()];
    let users_of = (0..operations.len()).filter(|&place| needed[place].is_some());
    for user in users_of {
        for operand in operations[user].operands() {
            let operand = operand as usize;
            used_again[operand] |= users[operand].replace(user).is_some();
        }
    }
    kept.iter()
        .for_each(|&place| used_again[place as usize] = true);
    let mut taken = vec![false; operations.len()];
    for place in 0..operations.len() {
        let (Operation::Multiply(..), Some(user)) = (operations[place], users[place]) else {
            continue;
        };
        let sum = matches!(
            operations[user],
            Operation::Add(..) | Operation::Subtract(..)
        );
        if sum && !used_again[place] && needed[place] == needed[user] && !taken[user] {
            taken[user] = true;
            fused[place] = true;
        }
    }
    fused
}

/// For each place the number of the last instruction that uses it; never for those that must stay.
fn last_uses(
    written: &[Vec<Instruction>],
    needed: &[Option<usize>],
    kept: &[Place],
    places: usize,
) -> Vec<usize> {
    let mut last = vec![0; places];
    let mut number = 0;
    for (section, instructions) in written.iter().enumerate() {
        for instruction in instructions {
            for place in instruction.operands() {
                let first = needed[place as usize] == Some(0);
                let last = &mut last[place as usize];
                // what the first section computes is used whenever the others are run
                let next = if first && section > 0 {
                    usize::MAX
                } else {
                    number
                };
                *last = next.max(*last);
            }
            number += 1;
        }
    }
    kept.iter()
        .for_each(|&place| last[place as usize] = usize::MAX);
    last
}

impl Instruction {
    fn operands(&self) -> impl Iterator<Item = u32> {
        let [x, y, z] = self.of;
        let one = matches!(self.code, Code::SinCos);
        [x, if one { x } else { y }, z].into_iter()
    }
}

/// Registers are given to places, and again to others when they are no longer used.
struct Assignment {
    register: Vec<u32>,
    /// Those before it are never given again: inputs and constants.
    fixed: u32,
    free: Vec<u32>,
    registers: u32,
}

impl Assignment {
    fn fresh(&mut self, place: u32) -> u32 {
        let register = self.free.pop().unwrap_or(self.registers);
        self.registers = self.registers.max(register + 1);
        self.register[place as usize] = register;
        register
    }

    /// Puts registers in the place of places. All operands are read before anything is set, so that one of them may be
    /// the result too.
    fn assign(&mut self, instruction: &mut Instruction, last: &[usize], number: usize) {
        let mut places: Vec<u32> = instruction.operands().collect();
        let registers = instruction.of.map(|place| self.register[place as usize]);
        places.sort_unstable();
        places.dedup();
        self.release(&places, last, number);
        let [mut to, mut second] = [instruction.to, instruction.of[1]];
        places.clear();
        places.push(to);
        to = self.fresh(to);
        instruction.of = registers;
        if matches!(instruction.code, Code::SinCos) {
            places.push(second);
            second = self.fresh(second);
            instruction.of[1] = second;
        }
        instruction.to = to;
        // a cosine may be of no use
        self.release(&places, last, number);
    }

    fn release(&mut self, places: &[u32], last: &[usize], number: usize) {
        let done = places
            .iter()
            .filter(|place| last[**place as usize] <= number);
        let registers = done.map(|place| self.register[*place as usize]);
        self.free
            .extend(registers.filter(|register| *register >= self.fixed));
    }
}

/// Runs the instructions in the widest registers of the processor; the bits are the same in all.
fn run(instructions: &[Instruction], registers: &mut [Register]) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx512f")]
        fn run_avx512(instructions: &[Instruction], registers: &mut [Register]) {
            each(instructions, registers);
        }
        #[target_feature(enable = "avx2")]
        fn run_avx2(instructions: &[Instruction], registers: &mut [Register]) {
            each(instructions, registers);
        }
        // SAFETY: the processor has the instructions that each of the two is compiled to
        #[allow(unsafe_code)]
        unsafe {
            if is_x86_feature_detected!("avx512f") {
                return run_avx512(instructions, registers);
            }
            if is_x86_feature_detected!("avx2") {
                return run_avx2(instructions, registers);
            }
        }
    }
    each(instructions, registers);
}

#[inline(always)]
fn each(instructions: &[Instruction], registers: &mut [Register]) {
    for &Instruction { code, to, of } in instructions {
        let to = to as usize;
        let [x, y, z] = of.map(|register| register as usize);
        match code {
            Code::Add => set(registers, to, [x, y], |[x, y]| x + y),
            Code::Subtract => set(registers, to, [x, y], |[x, y]| x - y),
            Code::Multiply => set(registers, to, [x, y], |[x, y]| x * y),
            Code::AddProduct => set(registers, to, [x, y, z], |[x, y, z]| z + x * y),
            Code::SubtractProduct => set(registers, to, [x, y, z], |[x, y, z]| z - x * y),
            Code::SubtractFromProduct => set(registers, to, [x, y, z], |[x, y, z]| x * y - z),
            Code::Divide => set(registers, to, [x, y], |[x, y]| x / y),
            Code::Negate => set(registers, to, [x], |[x]| -x),
            Code::Root => set(registers, to, [x], |[x]| x.sqrt()),
            Code::RootOrZero => set(registers, to, [x], |[x]| x.max(0.0).sqrt()),
            Code::Near => set(registers, to, [x, y], |[x, y]| {
                x + TAU * ((y - x) / TAU).round()
            }),
            Code::Sign => set(registers, to, [x], |[x]| if x < 0.0 { -1.0 } else { 1.0 }),
            Code::Larger => set(registers, to, [x, y], |[x, y]| x.greater(y)),
            Code::Call(f) => set(registers, to, [x], |[x]| call(f, x, x)),
            Code::Angle => {
                for part in 0..DEPTH {
                    let angle = atan2_of_each(registers[x].0[part], registers[y].0[part]);
                    registers[to].0[part] = angle;
                }
            }
            Code::SinCos => {
                for part in 0..DEPTH {
                    let (sin, cos) = sin_cos_of_each(registers[x].0[part]);
                    registers[to].0[part] = sin;
                    registers[y].0[part] = cos;
                }
            }
        }
    }
}

#[inline(always)]
fn set<const N: usize>(
    registers: &mut [Register],
    to: usize,
    of: [usize; N],
    f: impl Fn([f64; N]) -> f64,
) {
    for part in 0..DEPTH {
        let of = of.map(|register| registers[register].0[part]);
        let mut result = [0.0; WIDTH];
        for (i, result) in result.iter_mut().enumerate() {
            *result = f(of.map(|of| of[i]));
        }
        registers[to].0[part] = result;
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
        for section in [0, 1, 2, 1, 2] {
            batch.run(section, &mut registers);
        }
        for i in 0..BATCH {
            let mut values: Vec<f64> = Vec::new();
            for operation in &operations {
                let value = operation.value(|x| values[x as usize], |input| row(i)[input as usize]);
                values.push(value);
            }
            for &place in places.iter().flatten() {
                let found = registers.rows(batch.result(place))[i];
                assert_eq!(found.to_bits(), values[place as usize].to_bits());
            }
        }
    }
}
