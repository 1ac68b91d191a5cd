//! Whether a sum that contains constant angles such as 20° is zero.
//!
//! exp(iπk) for k no multiple of 1/12 is a root of unity, and roots of unity obey relations beyond the addition
//! theorems, as 1 + ζ + ζ² + ζ³ + ζ⁴ = 0 for ζ = exp(2πi/5). All constants are written as sums of powers of one root
//! of unity, whose order N has the denominators of all k as divisors.

use std::collections::BTreeMap;

use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::Zero;

use super::{Atom, Budget, Key, Trigonometric};

/// Beyond this prime the relation is longer than any practical formula.
const LARGEST_PRIME: i64 = 61;

impl Trigonometric {
    /// Whether it is zero for all values of its letters at which its denominators are not.
    ///
    /// `None` if undecided: not zero in this form, but it contains letters such as roots and inverse functions that may
    /// depend on others, or it is too long.
    pub fn vanishes(&self, budget: &mut Budget) -> Option<bool> {
        if self.is_empty() {
            return Some(true);
        }
        let cleared = self.without_denominators(budget)?;
        let has_turns = cleared.terms.keys().any(|key| key.wave.of_pi().is_some());
        let vanishes = match has_turns {
            true => cleared.constants_vanish()?,
            false => cleared.is_empty(),
        };
        match vanishes {
            true => Some(true),
            false if cleared.is_opaque() => None,
            // beyond √2 and √3 a root and a root of unity may depend on one another
            false if has_turns && cleared.terms.keys().any(|key| key.root > 6) => None,
            false => Some(false),
        }
    }

    /// Multiplied by every denominator P that occurs in it as 1/P; `None` if that is too long.
    pub fn without_denominators(&self, budget: &mut Budget) -> Option<Self> {
        let mut sum = self.clone();
        loop {
            let mut powers = sum.terms.keys().flat_map(|key| &key.powers);
            let inverse = powers.find_map(|(atom, _)| match atom {
                Atom::Inverse(inside) => Some(inside.clone()),
                _ => None,
            });
            let Some(inside) = inverse else {
                return Some(sum);
            };
            let letter = Atom::Inverse(inside.clone());
            let power_in = |key: &Key| {
                let found = key.powers.iter().find(|(atom, _)| *atom == letter);
                found.map_or(0, |(_, power)| *power)
            };
            let most = sum.terms.keys().map(power_in).max()?.max(0);
            let mut cleared = Trigonometric::zero();
            for (key, coefficient) in &sum.terms {
                let factor = inside.to_power(most - power_in(key), budget)?;
                let mut key = key.clone();
                key.powers.retain(|(atom, _)| *atom != letter);
                let term = Trigonometric::term(key, coefficient.clone());
                cleared = cleared.plus(&term.times(&factor, budget)?);
            }
            sum = cleared;
        }
    }

    /// Whether the constants in front of every product of letters and waves are zero.
    fn constants_vanish(&self) -> Option<bool> {
        // by what they are the constants of: the exponents n of e^(2πi n/N) and their coefficients
        let mut constants: BTreeMap<Key, BTreeMap<i64, BigRational>> = BTreeMap::new();
        let mut halves = self.terms.keys().filter_map(|key| key.wave.of_pi());
        let order = halves.try_fold(24, |order: i64, k| {
            let divisor = 2 * k.denom();
            (order / order.gcd(&divisor)).checked_mul(divisor)
        })?;
        let primes = primes_of(order)?;
        for (key, coefficient) in &self.terms {
            let k = key.wave.of_pi().unwrap_or_else(Ratio::zero);
            let turn = k.numer() * (order / (2 * k.denom()));
            let turn = turn + if key.imaginary { order / 4 } else { 0 };
            // √2 = e^(πi/4) + e^(−πi/4), √3 = e^(πi/6) + e^(−πi/6)
            let mut turns = vec![turn];
            for (prime, part) in [(2, 8), (3, 12)] {
                if key.root % prime == 0 {
                    let both = turns
                        .iter()
                        .flat_map(|n| [n + order / part, n - order / part]);
                    turns = both.collect();
                }
            }
            let mut bare = Key {
                wave: key.wave.without_pi(),
                imaginary: false,
                ..key.clone()
            };
            bare.root /= key.root.gcd(&6);
            let constant = constants.entry(bare).or_default();
            for n in turns {
                *constant
                    .entry(n.rem_euclid(order))
                    .or_insert_with(BigRational::zero) += coefficient;
            }
        }
        let zero = |constant| is_zero(constant, order, &primes);
        Some(constants.into_values().all(zero))
    }
}

/// Whether Σ cₙ ζⁿ is zero for ζ = e^(2πi/N): the product of Σ cₙ xⁿ with x^(N/p) − 1 for all primes p that divide N
/// vanishes at all other roots of xᴺ − 1 and is zero at ζ only if the sum is, as it is then at all primitive roots.
fn is_zero(constant: BTreeMap<i64, BigRational>, order: i64, primes: &[i64]) -> bool {
    let mut product = constant;
    for prime in primes {
        let mut next = BTreeMap::new();
        for (n, coefficient) in product {
            let further = (n + order / prime).rem_euclid(order);
            *next.entry(further).or_insert_with(BigRational::zero) += &coefficient;
            *next.entry(n).or_insert_with(BigRational::zero) -= coefficient;
        }
        next.retain(|_, coefficient| !coefficient.is_zero());
        product = next;
    }
    product.is_empty()
}

/// The primes that divide a number; `None` if there are larger ones than are looked for.
fn primes_of(number: i64) -> Option<Vec<i64>> {
    let (mut left, mut primes) = (number, Vec::new());
    for prime in 2..=LARGEST_PRIME {
        if left % prime == 0 {
            primes.push(prime);
        }
        while left % prime == 0 {
            left /= prime;
        }
    }
    (left == 1).then_some(primes)
}
