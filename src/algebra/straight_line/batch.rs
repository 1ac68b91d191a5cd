//! A straight-line program run for many rows of inputs at once.

use std::cell::Cell;
use std::f64::consts::TAU;

use rustc_hash::FxHashMap;

use super::{Operation, Place};
use crate::algebra::Function;
use crate::algebra::evaluation::call;
use crate::number::Number;
use crate::number::trigonometry::{atan2_of_each, sin_cos_of_each};
use crate::number::widest;

/// Rows that are run at once: enough that choosing the operation costs little, few enough that the registers stay in the
/// first cache.
pub const BATCH: usize = 32;

/// One number for each row.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Register([f64; BATCH]);

/// A straight-line program for rows side by side, with the bits that its operations give one by one.
///
/// It consists of sections. The first is run once, then the second and after it any of the others, as often as needed.
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
    /// As many as the code takes; the others stand for nothing.
    of: [u32; OPERANDS],
}

/// The most operands of an instruction.
const OPERANDS: usize = 5;

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
    /// x y + z u
    AddedProducts,
    /// x y − z u
    SubtractedProducts,
    /// w + x y + z u
    AddProducts,
    /// w − x y − z u
    SubtractProducts,
    /// x y − w − z u
    SubtractFromAndProduct,
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

    /// What the first inputs alone determine of all that is needed for some places: what the first section computes best.
    pub fn known(operations: &[Operation], first: usize, places: &[Place]) -> Vec<Place> {
        let mut known: Vec<bool> = Vec::with_capacity(operations.len());
        for operation in operations {
            known.push(match *operation {
                Operation::Input(i) => (i as usize) < first,
                _ => operation.operands().all(|place| known[place as usize]),
            });
        }
        let needed = needed(operations, &[places.to_vec()]);
        let needed = |place: &Place| needed[*place as usize].is_some();
        let all = 0..operations.len() as Place;
        let open = all.filter(|place| needed(place) && !known[*place as usize]);
        let used = open.flat_map(|place| operations[place as usize].operands());
        let mut found: Vec<Place> = used.chain(places.iter().copied()).collect();
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
    pub fn result(&self, place: Place) -> usize {
        self.results[&place] as usize
    }
}

impl Registers {
    /// The numbers of all rows in a register.
    pub fn rows(&self, register: usize) -> &[f64; BATCH] {
        &self.0[register].0
    }

    /// The same to be set: the registers of inputs are the first ones.
    pub fn rows_mut(&mut self, register: usize) -> &mut [f64; BATCH] {
        &mut self.0[register].0
    }
}

/// For each place the section that computes it: the one that needs it, or the first or second if that or several do.
fn needed(operations: &[Operation], sections: &[Vec<Place>]) -> Vec<Option<usize>> {
    let mut users = vec![0u32; operations.len()];
    for (section, places) in sections.iter().enumerate() {
        (places.iter()).for_each(|&place| users[place as usize] |= 1 << section);
    }
    for place in (0..operations.len()).rev() {
        for operand in operations[place].operands() {
            users[operand as usize] |= users[place];
        }
    }
    let section = |users: u32| match users {
        0 => None,
        users if users.is_power_of_two() || users & 1 == 1 => Some(users.trailing_zeros() as usize),
        _ => Some(1),
    };
    users.into_iter().map(section).collect()
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
        let (code, of): (_, &[u32]) = match *operation {
            O::Constant(value) => {
                constants.push((place as u32, value));
                continue;
            }
            O::Input(_) => continue,
            O::Multiply(..) if fused[place] => continue,
            O::Add(x, y) => match (product(x), product(y)) {
                (Some((a, b)), _) => (Code::AddProduct, &[a, b, y]),
                (None, Some((a, b))) => (Code::AddProduct, &[a, b, x]),
                (None, None) => (Code::Add, &[x, y]),
            },
            O::Subtract(x, y) => match (product(x), product(y)) {
                (_, Some((a, b))) => (Code::SubtractProduct, &[a, b, x]),
                (Some((a, b)), None) => (Code::SubtractFromProduct, &[a, b, y]),
                (None, None) => (Code::Subtract, &[x, y]),
            },
            O::Multiply(x, y) => (Code::Multiply, &[x, y]),
            O::Divide(x, y) => (Code::Divide, &[x, y]),
            O::Negate(x) => (Code::Negate, &[x]),
            O::Root(x) => (Code::Root, &[x]),
            O::RootOrZero(x) => (Code::RootOrZero, &[x]),
            O::Angle(y, x) => (Code::Angle, &[y, x]),
            O::Near(x, y) => (Code::Near, &[x, y]),
            O::Sign(x) => (Code::Sign, &[x]),
            O::Larger(x, y) => (Code::Larger, &[x, y]),
            O::Call(function, x) => (Code::Call(function), &[x]),
            O::Sin(x) | O::Cos(x) => {
                let section: &mut Vec<Instruction> = &mut written[section];
                let both = angles.entry((needed[place].unwrap_or(0), x));
                let at = *both.or_insert_with(|| {
                    // the one that is not needed has a place of its own
                    let [sin, cos] = [places as u32, places as u32 + 1];
                    places += 2;
                    section.push(Instruction::new(Code::SinCos, sin, &[x, cos]));
                    section.len() - 1
                });
                match operation {
                    O::Sin(_) => section[at].to = place as u32,
                    _ => section[at].of[1] = place as u32,
                }
                continue;
            }
        };
        written[section].push(Instruction::new(code, place as u32, of));
    }
    merged(&mut written, kept, places);
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

impl Code {
    fn operands(self) -> usize {
        use Code as C;
        match self {
            C::Negate | C::Root | C::SinCos | C::RootOrZero | C::Sign | C::Call(_) => 1,
            C::Add | C::Subtract | C::Multiply | C::Divide | C::Angle | C::Near | C::Larger => 2,
            C::AddProduct | C::SubtractProduct | C::SubtractFromProduct => 3,
            C::AddedProducts | C::SubtractedProducts => 4,
            C::AddProducts | C::SubtractProducts | C::SubtractFromAndProduct => 5,
        }
    }
}

impl Instruction {
    fn new(code: Code, to: u32, operands: &[u32]) -> Self {
        let mut of = [0; OPERANDS];
        of[..operands.len()].copy_from_slice(operands);
        Instruction { code, to, of }
    }

    /// Places or registers, each once.
    fn operands(&self) -> Vec<u32> {
        let mut operands = self.of[..self.code.operands()].to_vec();
        operands.sort_unstable();
        operands.dedup();
        operands
    }

    /// The same with one operand computed in place, if there is such an instruction.
    fn with(&self, inner: &Instruction) -> Option<Self> {
        let ([x, y, z, ..], [u, v, w, ..]) = (self.of, inner.of);
        if z != inner.to || x == z || y == z {
            return None;
        }
        let (code, of): (_, &[u32]) = match (inner.code, self.code) {
            (Code::Multiply, Code::AddProduct) => (Code::AddedProducts, &[u, v, x, y]),
            (Code::Multiply, Code::SubtractProduct) => (Code::SubtractedProducts, &[u, v, x, y]),
            (Code::Multiply, Code::SubtractFromProduct) => {
                (Code::SubtractedProducts, &[x, y, u, v])
            }
            (Code::AddProduct, Code::AddProduct) => (Code::AddProducts, &[u, v, x, y, w]),
            (Code::SubtractProduct, Code::SubtractProduct) => {
                (Code::SubtractProducts, &[u, v, x, y, w])
            }
            (Code::SubtractFromProduct, Code::SubtractProduct) => {
                (Code::SubtractFromAndProduct, &[u, v, x, y, w])
            }
            _ => return None,
        };
        Some(Instruction::new(code, self.to, of))
    }
}

/// Instructions of which one is used by another of the section alone are made one.
fn merged(sections: &mut [Vec<Instruction>], kept: &[Place], places: usize) {
    let mut uses = vec![0; places];
    kept.iter().for_each(|&place| uses[place as usize] += 1);
    for instruction in sections.iter().flatten() {
        (instruction.operands().into_iter()).for_each(|place| uses[place as usize] += 1);
    }
    for section in sections {
        let mut written: FxHashMap<Place, usize> = FxHashMap::default();
        let mut gone = vec![false; section.len()];
        for number in 0..section.len() {
            let instruction = section[number];
            let inner = written
                .get(&instruction.of[2])
                .filter(|_| instruction.code.operands() == 3);
            if let Some(&inner) = inner.filter(|_| uses[instruction.of[2] as usize] == 1)
                && let Some(both) = instruction.with(&section[inner])
            {
                section[number] = both;
                gone[inner] = true;
            }
            written.insert(instruction.to, number);
        }
        let mut gone = gone.into_iter();
        section.retain(|_| gone.next() == Some(false));
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

    /// Puts registers in the place of places.
    fn assign(&mut self, instruction: &mut Instruction, last: &[usize], number: usize) {
        let mut places = instruction.operands();
        places.push(instruction.to);
        instruction.to = self.fresh(instruction.to);
        let second = instruction.of[1];
        for place in &mut instruction.of[..instruction.code.operands()] {
            *place = self.register[*place as usize];
        }
        if matches!(instruction.code, Code::SinCos) {
            places.push(second);
            instruction.of[1] = self.fresh(second);
        }
        // results of no use too, as a cosine may be
        places.sort_unstable();
        places.dedup();
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

widest! {
    fn run(instructions: &[Instruction], registers: &mut [Register]) runs each
}

/// The numbers of a register.
type Row<'a> = &'a [Cell<f64>; BATCH];

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
            Code::Add => set(to, two(), |[x, y]| x + y),
            Code::Subtract => set(to, two(), |[x, y]| x - y),
            Code::Multiply => set(to, two(), |[x, y]| x * y),
            Code::AddProduct => set(to, three(), |[x, y, z]| z + x * y),
            Code::SubtractProduct => set(to, three(), |[x, y, z]| z - x * y),
            Code::SubtractFromProduct => set(to, three(), |[x, y, z]| x * y - z),
            Code::AddedProducts => set(to, four(), |[x, y, z, u]| x * y + z * u),
            Code::SubtractedProducts => set(to, four(), |[x, y, z, u]| x * y - z * u),
            Code::AddProducts => set(to, five(), |[x, y, z, u, w]| (w + x * y) + z * u),
            Code::SubtractProducts => set(to, five(), |[x, y, z, u, w]| (w - x * y) - z * u),
            Code::SubtractFromAndProduct => {
                set(to, five(), |[x, y, z, u, w]| (x * y - w) - z * u);
            }
            Code::Divide => set(to, two(), |[x, y]| x / y),
            Code::Negate => set(to, [of(0)], |[x]| -x),
            Code::Root => set(to, [of(0)], |[x]| x.sqrt()),
            Code::RootOrZero => set(to, [of(0)], |[x]| x.max(0.0).sqrt()),
            Code::Near => set(to, two(), |[x, y]| {
                x + TAU * ((y - x) / TAU).round_ties_even()
            }),
            Code::Sign => set(to, [of(0)], |[x]| if x < 0.0 { -1.0 } else { 1.0 }),
            Code::Larger => set(to, two(), |[x, y]| x.greater(y)),
            Code::Call(f) => set(to, [of(0)], |[x]| call(f, x, x)),
            Code::Angle => {
                let [y, x] = two();
                let angles = atan2_of_each(numbers(y), numbers(x));
                (0..BATCH).for_each(|i| to[i].set(angles[i]));
            }
            Code::SinCos => {
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
fn row(register: &Cell<Register>) -> Row<'_> {
    let first: *const Cell<Register> = register;
    // SAFETY: a cell is laid out as what is in it, and a register as its numbers
    #[allow(unsafe_code)]
    unsafe {
        &*first.cast()
    }
}

#[inline(always)]
fn numbers(row: Row) -> [f64; BATCH] {
    std::array::from_fn(|i| row[i].get())
}

#[inline(always)]
fn set<const N: usize>(to: Row, of: [Row; N], f: impl Fn([f64; N]) -> f64) {
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
