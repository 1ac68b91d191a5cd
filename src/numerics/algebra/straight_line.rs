//! Straight-line programs: the kinematics evaluated over operations that are written down.
//!
//! [`Number`] is `Copy`, so a [`Recorded`] is a place in a list of operations that belongs to its thread.
//! [`record`] opens the list, runs the work and hands the list over. Equal operations have one place (common
//! subexpressions are shared), operations on constants are carried out, multiples of one number are added, and sums with 0
//! and products with 0, 1 and −1 are left out, so that structural zeros are recognised.

mod batch;
mod elimination;
mod operation;
mod recorded;

use std::cell::RefCell;

use rustc_hash::FxHashMap;

use super::Function;
use crate::number::Number;
pub use batch::{BATCH, Batch, Registers};
pub use elimination::{LEAST_PIVOT, Pivot, eliminate};
pub use operation::Operation;

/// Index of an operation in its list.
pub type OperationIndex = u32;

type OperationKey = (std::mem::Discriminant<Operation>, u64, u64);

/// A comparison with zero that was decided by its value at the sample: the number, and true if it is negative there.
/// The program holds only for inputs at which it comes out as there.
pub type Decision = (OperationIndex, bool);

/// The value of an operation, as long as the list it was written into is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recorded(OperationIndex);

/// The list, with the value of every operation at the sample.
#[derive(Default)]
struct List {
    operations: Vec<Operation>,
    values: Vec<f64>,
    places: FxHashMap<OperationKey, OperationIndex>,
    sample: Vec<f64>,
    /// Angles whose sine and cosine are known.
    turns: FxHashMap<OperationIndex, [Recorded; 2]>,
    decisions: Vec<Decision>,
}

thread_local! {
    static OPEN: RefCell<List> = RefCell::default();
}

/// Runs `work` with an empty list and returns its result, with all operations written. `sample` holds values of the
/// inputs, from which [`Number::real`] follows.
pub fn record<R>(sample: Vec<f64>, work: impl FnOnce() -> R) -> (R, Vec<Operation>) {
    let list = List {
        sample,
        ..List::default()
    };
    let around = OPEN.with(|open| open.replace(list));
    let made = work();
    let list = OPEN.with(|open| open.replace(around));
    (made, list.operations)
}

/// The values of all operations.
pub fn evaluate(operations: &[Operation], inputs: &[f64]) -> Vec<f64> {
    let mut values = Vec::with_capacity(operations.len());
    run(operations, inputs, &mut values);
    values
}

/// The values of all operations over any number, in storage that is kept. Inputs that are not given are 0.
pub fn run<T: Number>(operations: &[Operation], inputs: &[T], values: &mut Vec<T>) {
    values.clear();
    // a cosine follows the sine of its angle
    let mut turn = None;
    for operation in operations {
        let value = match *operation {
            Operation::Sin(x) => {
                let (sin, cos) = values[x as usize].sin_cos();
                turn = Some((x, cos));
                sin
            }
            Operation::Cos(x) if turn.is_some_and(|(of, _)| of == x) => {
                turn.map_or(T::zero(), |(_, cos)| cos)
            }
            other => {
                let input = |i: u32| inputs.get(i as usize).copied().unwrap_or(T::zero());
                other.value(|x| values[x as usize], input)
            }
        };
        values.push(value);
    }
}

/// The operations that some places need, with the places in them.
pub fn needed(operations: &[Operation], places: &mut [OperationIndex]) -> Vec<Operation> {
    let mut used = vec![false; operations.len()];
    places.iter().for_each(|place| used[*place as usize] = true);
    let mut at = vec![0; operations.len()];
    let mut kept = Vec::new();
    for place in (0..operations.len()).rev() {
        if used[place] {
            operations[place]
                .operands()
                .for_each(|of| used[of as usize] = true);
        }
    }
    for (place, operation) in operations
        .iter()
        .enumerate()
        .filter(|(place, _)| used[*place])
    {
        at[place] = kept.len() as OperationIndex;
        kept.push(operation.placed(|of| at[of as usize]));
    }
    places
        .iter_mut()
        .for_each(|place| *place = at[*place as usize]);
    kept
}

impl List {
    fn put(&mut self, operation: Operation) -> Recorded {
        if let Some(&place) = self.places.get(&operation.key()) {
            return Recorded(place);
        }
        let place = self.operations.len() as OperationIndex;
        let input = |i: u32| self.sample.get(i as usize).copied().unwrap_or(f64::NAN);
        let value = operation.value(|x| self.values[x as usize], input);
        self.operations.push(operation);
        self.values.push(value);
        self.places.insert(operation.key(), place);
        Recorded(place)
    }

    fn constant(&self, of: Recorded) -> Option<f64> {
        match self.operations[of.0 as usize] {
            Operation::Constant(x) => Some(x),
            _ => None,
        }
    }

    fn negated(&self, of: Recorded) -> Option<Recorded> {
        match self.operations[of.0 as usize] {
            Operation::Negate(x) => Some(Recorded(x)),
            _ => None,
        }
    }

    /// k and x of k x with a constant k.
    fn scaled(&self, of: Recorded) -> Option<(f64, Recorded)> {
        match self.operations[of.0 as usize] {
            Operation::Multiply(k, x) => Some((self.constant(Recorded(k))?, Recorded(x))),
            _ => None,
        }
    }

    /// k x + l x of two multiples of the same number.
    fn merged(&mut self, x: Recorded, y: Recorded, sign: f64) -> Option<Recorded> {
        let (a, b) = (self.scaled(x), self.scaled(y));
        let (k, of) = a.unwrap_or((1.0, x));
        let (l, other) = b.unwrap_or((1.0, y));
        if of != other || (a.is_none() && b.is_none()) {
            return None;
        }
        let factor = self.literal(k + sign * l);
        Some(self.multiply(factor, of))
    }

    fn literal(&mut self, x: f64) -> Recorded {
        // −0 and 0 are one constant
        self.put(Operation::Constant(x + 0.0))
    }

    fn negate(&mut self, x: Recorded) -> Recorded {
        if let Some(value) = self.constant(x) {
            return self.literal(-value);
        }
        match self.operations[x.0 as usize] {
            Operation::Negate(inner) => Recorded(inner),
            Operation::Subtract(a, b) => self.put(Operation::Subtract(b, a)),
            _ => self.put(Operation::Negate(x.0)),
        }
    }

    fn add(&mut self, x: Recorded, y: Recorded) -> Recorded {
        match (self.constant(x), self.constant(y)) {
            (Some(a), Some(b)) => return self.literal(a + b),
            (Some(0.0), _) => return y,
            (_, Some(0.0)) => return x,
            _ => {}
        }
        if let Some(sum) = self.merged(x, y, 1.0) {
            return sum;
        }
        match (self.negated(x), self.negated(y)) {
            (_, Some(b)) => self.subtract(x, b),
            (Some(a), None) => self.subtract(y, a),
            (None, None) => self.put(Operation::Add(x.0.min(y.0), x.0.max(y.0))),
        }
    }

    fn subtract(&mut self, x: Recorded, y: Recorded) -> Recorded {
        match (self.constant(x), self.constant(y)) {
            (Some(a), Some(b)) => return self.literal(a - b),
            (Some(0.0), _) => return self.negate(y),
            (_, Some(0.0)) => return x,
            _ => {}
        }
        if let Some(difference) = self.merged(x, y, -1.0) {
            return difference;
        }
        if let Some(rest) = self.without(x, y, 0) {
            return rest;
        }
        if let Some(rest) = self.without(y, x, 0) {
            return self.negate(rest);
        }
        match (self.negated(x), self.negated(y)) {
            (_, Some(b)) => self.add(x, b),
            (Some(a), None) => {
                let sum = self.add(a, y);
                self.negate(sum)
            }
            (None, None) => self.put(Operation::Subtract(x.0, y.0)),
        }
    }

    /// A sum less one of its terms, without a subtraction: (x + y) + z − x = y + z.
    fn without(&mut self, sum: Recorded, term: Recorded, depth: usize) -> Option<Recorded> {
        /// Sums within sums that are looked through.
        const DEEPEST: usize = 12;
        if sum == term {
            return Some(self.literal(0.0));
        }
        if depth == DEEPEST {
            return None;
        }
        match self.operations[sum.0 as usize] {
            Operation::Add(x, y) => {
                let (x, y) = (Recorded(x), Recorded(y));
                match self.without(x, term, depth + 1) {
                    Some(rest) => Some(self.add(rest, y)),
                    None => (self.without(y, term, depth + 1)).map(|rest| self.add(x, rest)),
                }
            }
            Operation::Subtract(x, y) => {
                let rest = self.without(Recorded(x), term, depth + 1)?;
                Some(self.subtract(rest, Recorded(y)))
            }
            _ => None,
        }
    }

    fn multiply(&mut self, x: Recorded, y: Recorded) -> Recorded {
        let (x, y) = match self.constant(y) {
            Some(_) => (y, x),
            None => (x, y),
        };
        if let Some(factor) = self.constant(x) {
            if let Some(value) = self.constant(y) {
                return self.literal(factor * value);
            }
            match factor {
                0.0 | 1.0 => return if factor == 0.0 { x } else { y },
                -1.0 => return self.negate(y),
                _ => {}
            }
            if let Some((second, inner)) = self.scaled(y) {
                let factor = self.literal(factor * second);
                return self.multiply(factor, inner);
            }
        } else {
            // l (k sin x) = k (l sin x): a length times directions at fixed angles to one another is one product
            for (x, y) in [(x, y), (y, x)] {
                if let Some((factor, inner)) = self.scaled(x)
                    && let Operation::Sin(_) | Operation::Cos(_) = self.operations[inner.0 as usize]
                    && let Operation::Input(_) = self.operations[y.0 as usize]
                {
                    let (factor, product) = (self.literal(factor), self.multiply(inner, y));
                    return self.multiply(factor, product);
                }
            }
        }
        match (self.negated(x), self.negated(y)) {
            (Some(a), Some(b)) => self.multiply(a, b),
            (Some(a), None) => {
                let product = self.multiply(a, y);
                self.negate(product)
            }
            (None, Some(b)) => {
                let product = self.multiply(x, b);
                self.negate(product)
            }
            (None, None) if self.constant(x).is_some() => self.put(Operation::Multiply(x.0, y.0)),
            (None, None) => self.put(Operation::Multiply(x.0.min(y.0), x.0.max(y.0))),
        }
    }

    fn divide(&mut self, x: Recorded, y: Recorded) -> Recorded {
        match (self.constant(x), self.constant(y)) {
            (Some(a), Some(b)) => self.literal(a / b),
            (Some(0.0), None) => x,
            (None, Some(b)) => {
                let inverse = self.literal(1.0 / b);
                self.multiply(inverse, x)
            }
            _ => match self.negated(y) {
                Some(b) => {
                    let quotient = self.divide(x, b);
                    self.negate(quotient)
                }
                None => self.put(Operation::Divide(x.0, y.0)),
            },
        }
    }

    fn sin_cos(&mut self, x: Recorded) -> (Recorded, Recorded) {
        if let Some(angle) = self.constant(x) {
            let (sin, cos) = Number::sin_cos(angle);
            return (self.literal(sin), self.literal(cos));
        }
        if let Some(&[sin, cos]) = self.turns.get(&x.0) {
            return (sin, cos);
        }
        match self.negated(x) {
            Some(angle) => {
                let (sin, cos) = self.sin_cos(angle);
                (self.negate(sin), cos)
            }
            None => (self.put(Operation::Sin(x.0)), self.put(Operation::Cos(x.0))),
        }
    }

    fn call(&mut self, function: Function, x: Recorded) -> Recorded {
        let called = self.put(Operation::Call(function, x.0));
        match self.constant(x) {
            Some(_) => self.literal(self.values[called.0 as usize]),
            None => called,
        }
    }

    fn root(&mut self, x: Recorded) -> Recorded {
        match self.constant(x) {
            Some(value) => self.literal(value.sqrt()),
            None => self.put(Operation::Root(x.0)),
        }
    }
}

fn with<R>(f: impl FnOnce(&mut List) -> R) -> R {
    OPEN.with(|open| f(&mut open.borrow_mut()))
}
