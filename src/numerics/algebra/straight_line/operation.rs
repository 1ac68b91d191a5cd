//! The operations of straight-line programs.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{OperationIndex, OperationKey};
use crate::algebra::Function;
use crate::algebra::evaluation::call;
use crate::number::Number;

/// One operation of a straight-line program; operands stand at lower places.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Operation {
    /// A constant.
    Constant(f64),
    /// The input of that number.
    Input(u32),
    /// x + y
    Add(OperationIndex, OperationIndex),
    /// x − y
    Subtract(OperationIndex, OperationIndex),
    /// x y
    Multiply(OperationIndex, OperationIndex),
    /// x/y
    Divide(OperationIndex, OperationIndex),
    /// −x
    Negate(OperationIndex),
    /// √x
    Root(OperationIndex),
    /// sin x
    Sin(OperationIndex),
    /// cos x
    Cos(OperationIndex),
    /// √x, and 0 where x is negative.
    RootOrZero(OperationIndex),
    /// The angle of the vector (x, y), of y and x.
    Angle(OperationIndex, OperationIndex),
    /// The angle x, whole turns on, within half a turn of y; the number of turns is even where two are as near.
    Near(OperationIndex, OperationIndex),
    /// −1 where x is negative, 1 elsewhere.
    Sign(OperationIndex),
    /// The larger of x and y.
    Larger(OperationIndex, OperationIndex),
    /// A function of x that no operation computes.
    Call(Function, OperationIndex),
}

impl Operation {
    /// The places of its operands.
    pub fn operands(self) -> impl Iterator<Item = OperationIndex> {
        use Operation::{
            Add, Angle, Call, Constant, Cos, Divide, Input, Larger, Multiply, Near, Negate, Root,
            RootOrZero, Sign, Sin, Subtract,
        };
        let both = match self {
            Constant(_) | Input(_) => [None, None],
            Add(x, y)
            | Subtract(x, y)
            | Multiply(x, y)
            | Divide(x, y)
            | Angle(x, y)
            | Near(x, y)
            | Larger(x, y) => [Some(x), Some(y)],
            Negate(x) | Root(x) | Sin(x) | Cos(x) | RootOrZero(x) | Sign(x) | Call(_, x) => {
                [Some(x), None]
            }
        };
        both.into_iter().flatten()
    }

    /// The operation with other places of its operands.
    pub(super) fn placed(self, at: impl Fn(OperationIndex) -> OperationIndex) -> Self {
        use Operation::{
            Add, Angle, Call, Constant, Cos, Divide, Input, Larger, Multiply, Near, Negate, Root,
            RootOrZero, Sign, Sin, Subtract,
        };
        match self {
            Constant(_) | Input(_) => self,
            Add(x, y) => Add(at(x), at(y)),
            Subtract(x, y) => Subtract(at(x), at(y)),
            Multiply(x, y) => Multiply(at(x), at(y)),
            Divide(x, y) => Divide(at(x), at(y)),
            Negate(x) => Negate(at(x)),
            Root(x) => Root(at(x)),
            Sin(x) => Sin(at(x)),
            Cos(x) => Cos(at(x)),
            RootOrZero(x) => RootOrZero(at(x)),
            Angle(y, x) => Angle(at(y), at(x)),
            Near(x, y) => Near(at(x), at(y)),
            Sign(x) => Sign(at(x)),
            Larger(x, y) => Larger(at(x), at(y)),
            Call(function, x) => Call(function, at(x)),
        }
    }

    /// Key of equal operations: kind and operands; constants by their bits.
    pub(super) fn key(self) -> OperationKey {
        let mut operands = self.operands().map(u64::from);
        let first = match self {
            Operation::Constant(x) => x.to_bits(),
            Operation::Input(i) => u64::from(i),
            _ => operands.next().unwrap_or(0),
        };
        let second = match self {
            Operation::Call(function, _) => function as u64,
            _ => operands.next().unwrap_or(0),
        };
        (std::mem::discriminant(&self), first, second)
    }

    /// Its value over any number, from those of its operands and of the inputs.
    pub(super) fn value<T: Number>(
        self,
        at: impl Fn(OperationIndex) -> T,
        input: impl Fn(u32) -> T,
    ) -> T {
        match self {
            Operation::Constant(x) => T::from_f64(x),
            Operation::Input(i) => input(i),
            Operation::Add(x, y) => at(x) + at(y),
            Operation::Subtract(x, y) => at(x) - at(y),
            Operation::Multiply(x, y) => at(x) * at(y),
            Operation::Divide(x, y) => at(x) / at(y),
            Operation::Negate(x) => -at(x),
            Operation::Root(x) => at(x).sqrt(),
            Operation::Sin(x) => at(x).sin_cos().0,
            Operation::Cos(x) => at(x).sin_cos().1,
            Operation::RootOrZero(x) if T::zero().less(at(x)) => at(x).sqrt(),
            Operation::RootOrZero(_) => T::zero(),
            Operation::Angle(y, x) => at(y).atan2(at(x)),
            Operation::Near(x, y) => {
                let turns = ((at(y) - at(x)).real() / TAU).round_ties_even();
                at(x) + T::from_f64(TAU * turns)
            }
            Operation::Sign(x) if at(x).less(T::zero()) => -T::one(),
            Operation::Sign(_) => T::one(),
            Operation::Larger(x, y) => at(x).greater(at(y)),
            Operation::Call(function, x) => call(function, at(x), at(x)),
        }
    }
}
