//! Whether a sum that contains constant angles such as 20° is zero.
//!
//! exp(iπk) for k no multiple of 1/12 is a root of unity, and roots of unity obey relations beyond the addition
//! theorems, as 1 + ζ + ζ² + ζ³ + ζ⁴ = 0 for ζ = exp(2πi/5). They are written in a basis of the cyclotomic field over
//! ℚ(i, √2, √3): of the part of k/2 with denominator 2ᵃ3ᵇ the remainder modulo 1/24 is kept, and of every part
//! with denominator pᵏ, p ≥ 5, the leading digit p − 1 is replaced by minus the sum of the others (after W. Bosma,
//! Canonical bases for cyclotomic fields, 1990).

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::Ratio;
use num_traits::Zero;

use super::{Atom, Budget, Key, Trigonometric};

/// Beyond this prime the relation is longer than any practical formula.
const LARGEST_PRIME: i64 = 61;

impl Trigonometric {
    /// Whether it is zero for all values of its letters at which its denominators are not.
    ///
    /// `None` if undecided: not zero as it stands, but it contains letters such as roots and inverse functions that may
    /// depend on others, or it is too long.
    pub fn vanishes(&self, budget: &mut Budget) -> Option<bool> {
        if self.is_empty() {
            return Some(true);
        }
        let cleared = self.without_denominators(budget)?;
        let reduced = cleared.in_basis()?;
        match reduced.is_empty() {
            true => Some(true),
            false if reduced.is_opaque() => None,
            // beyond √2 and √3 a root and a root of unity may depend on one another
            false if reduced.terms().any(|(key, _)| key.root > 6) && reduced.has_turns() => None,
            false => Some(false),
        }
    }

    fn has_turns(&self) -> bool {
        self.terms().any(|(key, _)| key.wave.of_pi().is_some())
    }

    /// Multiplied by every denominator P that stands in it as 1/P; `None` if that is too long.
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

    /// Every constant angle in the basis.
    fn in_basis(&self) -> Option<Self> {
        if !self.has_turns() {
            return Some(self.clone());
        }
        let mut sum = Trigonometric::zero();
        for (key, coefficient) in &self.terms {
            let Some(k) = key.wave.of_pi() else {
                sum.add_term(key.clone(), coefficient.clone());
                continue;
            };
            let bare = Key {
                wave: key.wave.without_pi(),
                ..key.clone()
            };
            for (twelfths, rest, sign) in basis(k)? {
                let turn = Key {
                    wave: super::Wave::default().with_pi(Ratio::new(twelfths, 12)),
                    ..Key::default()
                };
                let factor = coefficient * BigInt::from(sign);
                for (part, factor) in bare.times(&turn, factor)? {
                    // put back as it is: a product would take it out of the basis
                    let wave = part.wave.with_pi(rest);
                    sum.add_term(Key { wave, ..part }, factor);
                }
            }
        }
        Some(sum)
    }
}

/// exp(iπk) = Σ ± exp(iπ n/12) exp(iπ rest), each rest in the basis.
fn basis(k: Ratio<i64>) -> Option<Vec<(i64, Ratio<i64>, i64)>> {
    let turn = k / 2;
    let turn = turn - turn.floor();
    let mut left = *turn.denom();
    // parts with denominators pᵏ, p ≥ 5
    let mut found = vec![(Ratio::zero(), 1)];
    let mut small = turn;
    for prime in 5..=LARGEST_PRIME {
        let mut power = 1;
        while left % prime == 0 {
            power *= prime;
            left /= prime;
        }
        if power == 1 {
            continue;
        }
        let others = turn.denom() / power;
        let inverse = others.extended_gcd(&power).x.rem_euclid(power);
        let top = (turn.numer().rem_euclid(power) * inverse).rem_euclid(power);
        small -= Ratio::new(top, power);
        let digit = power / prime;
        let tops: Vec<(i64, i64)> = match top / digit == prime - 1 {
            true => (0..prime - 1)
                .map(|d| (top % digit + d * digit, -1))
                .collect(),
            false => vec![(top, 1)],
        };
        let mut longer = Vec::new();
        for (sum, sign) in &found {
            longer.extend((tops.iter()).map(|(top, s)| (sum + Ratio::new(*top, power), sign * s)));
        }
        found = longer;
    }
    while left % 2 == 0 {
        left /= 2;
    }
    while left % 3 == 0 {
        left /= 3;
    }
    if left != 1 {
        return None;
    }
    let scaled = (small - small.floor()) * 24;
    let (whole, rest) = (scaled.floor(), (scaled - scaled.floor()) / 24);
    let parts = found.into_iter();
    Some(
        parts
            .map(|(sum, sign)| (whole.to_integer(), (rest + sum) * 2, sign))
            .collect(),
    )
}
