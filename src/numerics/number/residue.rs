//! Residues modulo a prime: arithmetic in which elimination costs no growing fractions.

use std::ops::{Add, Mul, SubAssign};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

/// Numbers that an elimination divides by one another.
pub trait ExactField:
    Clone + Zero + for<'a> SubAssign<&'a Self> + for<'a> Mul<&'a Self, Output = Self>
{
    /// One divided by the number, which is not zero.
    fn inverse(&self) -> Self;
}

impl ExactField for BigRational {
    fn inverse(&self) -> Self {
        self.recip()
    }
}

/// A residue modulo the prime 2⁶¹ − 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residue(u64);

const PRIME: u64 = (1 << 61) - 1;

impl Residue {
    /// The residue of a fraction; `None` if the prime divides its denominator.
    pub fn of(fraction: &BigRational) -> Option<Self> {
        let residue = |x: &BigInt| {
            let rest = (x % PRIME + PRIME) % PRIME;
            Residue(rest.to_u64().expect("less than the prime"))
        };
        let below = residue(fraction.denom());
        (!below.is_zero()).then(|| residue(fraction.numer()) * &below.inverse())
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Residue((self.0 + other.0) % PRIME)
    }
}

impl Zero for Residue {
    fn zero() -> Self {
        Residue(0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
}

impl SubAssign<&Residue> for Residue {
    fn sub_assign(&mut self, other: &Residue) {
        self.0 = (self.0 + PRIME - other.0) % PRIME;
    }
}

impl Mul<&Residue> for Residue {
    type Output = Self;
    fn mul(self, other: &Residue) -> Self {
        Residue((u128::from(self.0) * u128::from(other.0) % u128::from(PRIME)) as u64)
    }
}

impl ExactField for Residue {
    /// x^(p − 2), as x^(p − 1) = 1 (Fermat).
    fn inverse(&self) -> Self {
        let (mut power, mut square) = (Residue(1), *self);
        for bit in 0..61 {
            if (PRIME - 2) >> bit & 1 == 1 {
                power = power * &square;
            }
            square = square * &square;
        }
        power
    }
}
