//! Numbers whose operations are written down.

use super::{Decision, Operation, OperationIndex, Recorded, elimination, with};
use crate::algebra::Function;
use crate::linear::Factorable;
use crate::number::{Field, Number, functions, operators};

impl Recorded {
    /// The input of that number.
    pub fn input(number: usize) -> Self {
        with(|list| list.put(Operation::Input(number as u32)))
    }

    /// Index of the operation.
    pub fn place(self) -> OperationIndex {
        self.0
    }

    /// Its value, if it is the same for all inputs.
    pub fn constant(self) -> Option<f64> {
        with(|list| list.constant(self))
    }

    /// x or −x, whichever is written without a sign.
    pub fn unsigned(self) -> Self {
        with(|list| list.negated(self).unwrap_or(self))
    }

    /// The angle of the vector (x, y), within half a turn of another.
    pub fn angle(y: Self, x: Self, near: Self) -> Self {
        let angle = y.atan2(x);
        with(|list| list.put(Operation::Near(angle.0, near.0)))
    }

    /// √x, and 0 where x is negative.
    pub fn root_or_zero(self) -> Self {
        with(|list| list.put(Operation::RootOrZero(self.0)))
    }

    /// −1 where it is negative, 1 elsewhere.
    pub fn sign(self) -> Self {
        with(|list| list.put(Operation::Sign(self.0)))
    }

    /// Makes its sine and cosine known, so that they are not computed from it.
    pub fn turned(self, sin: Self, cos: Self) {
        with(|list| list.turns.insert(self.0, [sin, cos]));
    }

    /// The decisions made since the list was opened: where one is another, the operations do not hold.
    pub fn decisions() -> Vec<Decision> {
        with(|list| list.decisions.clone())
    }

    fn call(self, function: Function) -> Self {
        with(|list| list.call(function, self))
    }
}

// called, not inlined: speed does not matter where operations are written down once
operators!([Recorded]
    #[inline(never)] Add add |a, b| with(|list| list.add(a, b));
    #[inline(never)] Sub sub |a, b| with(|list| list.subtract(a, b));
    #[inline(never)] Mul mul |a, b| with(|list| list.multiply(a, b));
    #[inline(never)] Div div |a, b| with(|list| list.divide(a, b));
    #[inline(never)] Neg neg |a| with(|list| list.negate(a));
);

impl Number for Recorded {
    /// No decision is made over unknowns, so that the rows are the entire ones.
    const REAL: bool = false;

    fn from_f64(x: f64) -> Self {
        with(|list| list.literal(x))
    }
    /// The value at the sample.
    fn real(self) -> f64 {
        with(|list| list.values[self.0 as usize])
    }
    fn sin_cos(self) -> (Self, Self) {
        with(|list| list.sin_cos(self))
    }
    functions!(|x|
        sqrt: with(|list| list.root(x)),
        asin: x.call(Function::Asin),
        acos: x.call(Function::Acos),
        atan: x.call(Function::Atan),
        exp: x.call(Function::Exp),
        ln: x.call(Function::Ln),
    );
    fn atan2(self, x: Self) -> Self {
        with(|list| match (list.constant(self), list.constant(x)) {
            (Some(y), Some(x)) => list.literal(Number::atan2(y, x)),
            _ => list.put(Operation::Angle(self.0, x.0)),
        })
    }
    /// As at the sample, which is a [`Decision`].
    fn less(self, other: Self) -> bool {
        let less = self.real() < other.real();
        let difference = self - other;
        if difference.constant().is_none() {
            with(|list| list.decisions.push((difference.0, less)));
        }
        less
    }
    /// Wherever it is less.
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        let difference = self - other;
        if let Some(constant) = difference.constant() {
            return if constant < 0.0 { then } else { otherwise };
        }
        if (then, otherwise) == (other, self) {
            return with(|list| list.put(Operation::Larger(self.0, other.0)));
        }
        let sign = difference.sign();
        if then == -otherwise {
            return sign * otherwise;
        }
        // 1 or 0
        let part = Self::from_f64(0.5) - sign.scale(0.5);
        then * part + otherwise * (Self::one() - part)
    }
    fn is_finite(self) -> bool {
        self.real().is_finite()
    }
}

impl Field for Recorded {
    fn conjugate(self) -> Self {
        self
    }
    fn norm_squared(self) -> f64 {
        self.real() * self.real()
    }
    fn phase(self) -> Self {
        Self::from_f64(if self.real() < 0.0 { -1.0 } else { 1.0 })
    }
}

impl Factorable for Recorded {
    type Sparse = elimination::RecordedElimination;
}
