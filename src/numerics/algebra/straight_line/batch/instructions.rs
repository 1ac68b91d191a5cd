//! Instructions, each of one or more operations, and registers for places.

use rustc_hash::FxHashMap;

use crate::algebra::Function;
use crate::algebra::straight_line::{Operation, OperationIndex};

#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction {
    pub code: Opcode,
    pub to: u32,
    /// As many as the code takes; the others stand for nothing.
    pub of: [u32; OPERANDS],
}

/// The most operands of an instruction.
const OPERANDS: usize = 5;

#[derive(Clone, Copy, Debug)]
pub(super) enum Opcode {
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

/// For each place the section that computes it: the one that needs it, or the first or second if that or several do.
pub(super) fn needed(
    operations: &[Operation],
    sections: &[Vec<OperationIndex>],
) -> Vec<Option<usize>> {
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

pub(super) type Instructions = (Vec<Vec<Instruction>>, Vec<(u32, f64)>, usize);

/// The instructions of each section, over places in place of registers, the constants, and how many places there are.
pub(super) fn written(
    operations: &[Operation],
    sections: usize,
    needed: &[Option<usize>],
    kept: &[OperationIndex],
) -> Instructions {
    use Operation as O;
    let fused = fused(operations, needed, kept);
    let product = |place: OperationIndex| match operations[place as usize] {
        O::Multiply(x, y) if fused[place as usize] => Some((x, y)),
        _ => None,
    };
    let mut written = vec![Vec::new(); sections];
    let mut constants = Vec::new();
    let mut angles: FxHashMap<(usize, OperationIndex), usize> = FxHashMap::default();
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
                (Some((a, b)), _) => (Opcode::AddProduct, &[a, b, y]),
                (None, Some((a, b))) => (Opcode::AddProduct, &[a, b, x]),
                (None, None) => (Opcode::Add, &[x, y]),
            },
            O::Subtract(x, y) => match (product(x), product(y)) {
                (_, Some((a, b))) => (Opcode::SubtractProduct, &[a, b, x]),
                (Some((a, b)), None) => (Opcode::SubtractFromProduct, &[a, b, y]),
                (None, None) => (Opcode::Subtract, &[x, y]),
            },
            O::Multiply(x, y) => (Opcode::Multiply, &[x, y]),
            O::Divide(x, y) => (Opcode::Divide, &[x, y]),
            O::Negate(x) => (Opcode::Negate, &[x]),
            O::Root(x) => (Opcode::Root, &[x]),
            O::RootOrZero(x) => (Opcode::RootOrZero, &[x]),
            O::Angle(y, x) => (Opcode::Angle, &[y, x]),
            O::Near(x, y) => (Opcode::Near, &[x, y]),
            O::Sign(x) => (Opcode::Sign, &[x]),
            O::Larger(x, y) => (Opcode::Larger, &[x, y]),
            O::Call(function, x) => (Opcode::Call(function), &[x]),
            O::Sin(x) | O::Cos(x) => {
                let section: &mut Vec<Instruction> = &mut written[section];
                let both = angles.entry((needed[place].unwrap_or(0), x));
                let at = *both.or_insert_with(|| {
                    // the one that is not needed has a place of its own
                    let [sin, cos] = [places as u32, places as u32 + 1];
                    places += 2;
                    section.push(Instruction::new(Opcode::SinCos, sin, &[x, cos]));
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
fn fused(operations: &[Operation], needed: &[Option<usize>], kept: &[OperationIndex]) -> Vec<bool> {
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
pub(super) fn last_uses(
    written: &[Vec<Instruction>],
    needed: &[Option<usize>],
    kept: &[OperationIndex],
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

impl Opcode {
    fn operands(self) -> usize {
        use Opcode as C;
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
    fn new(code: Opcode, to: u32, operands: &[u32]) -> Self {
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

    /// This instruction with one operand computed in place by `inner`, if there is an instruction that does both.
    fn with(&self, inner: &Instruction) -> Option<Self> {
        let ([x, y, z, ..], [u, v, w, ..]) = (self.of, inner.of);
        if z != inner.to || x == z || y == z {
            return None;
        }
        let (code, of): (_, &[u32]) = match (inner.code, self.code) {
            (Opcode::Multiply, Opcode::AddProduct) => (Opcode::AddedProducts, &[u, v, x, y]),
            (Opcode::Multiply, Opcode::SubtractProduct) => {
                (Opcode::SubtractedProducts, &[u, v, x, y])
            }
            (Opcode::Multiply, Opcode::SubtractFromProduct) => {
                (Opcode::SubtractedProducts, &[x, y, u, v])
            }
            (Opcode::AddProduct, Opcode::AddProduct) => (Opcode::AddProducts, &[u, v, x, y, w]),
            (Opcode::SubtractProduct, Opcode::SubtractProduct) => {
                (Opcode::SubtractProducts, &[u, v, x, y, w])
            }
            (Opcode::SubtractFromProduct, Opcode::SubtractProduct) => {
                (Opcode::SubtractFromAndProduct, &[u, v, x, y, w])
            }
            _ => return None,
        };
        Some(Instruction::new(code, self.to, of))
    }
}

/// Instructions of which one is used by another of the section alone are made one.
fn merged(sections: &mut [Vec<Instruction>], kept: &[OperationIndex], places: usize) {
    let mut uses = vec![0; places];
    kept.iter().for_each(|&place| uses[place as usize] += 1);
    for instruction in sections.iter().flatten() {
        (instruction.operands().into_iter()).for_each(|place| uses[place as usize] += 1);
    }
    for section in sections {
        let mut written: FxHashMap<OperationIndex, usize> = FxHashMap::default();
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
pub(super) struct RegisterAssignment {
    pub register: Vec<u32>,
    /// Number of registers that are never given again: inputs and constants.
    fixed: u32,
    free: Vec<u32>,
    pub registers: u32,
}

impl RegisterAssignment {
    /// With registers for inputs alone.
    pub fn new(inputs: usize, constants: usize, places: usize) -> Self {
        RegisterAssignment {
            register: vec![u32::MAX; places],
            fixed: (inputs + constants) as u32,
            free: Vec::new(),
            registers: inputs as u32,
        }
    }

    pub fn fresh(&mut self, place: u32) -> u32 {
        let register = self.free.pop().unwrap_or(self.registers);
        self.registers = self.registers.max(register + 1);
        self.register[place as usize] = register;
        register
    }

    /// Puts registers in the place of places.
    pub fn assign(&mut self, instruction: &mut Instruction, last: &[usize], number: usize) {
        let mut places = instruction.operands();
        places.push(instruction.to);
        instruction.to = self.fresh(instruction.to);
        let second = instruction.of[1];
        for place in &mut instruction.of[..instruction.code.operands()] {
            *place = self.register[*place as usize];
        }
        if matches!(instruction.code, Opcode::SinCos) {
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
