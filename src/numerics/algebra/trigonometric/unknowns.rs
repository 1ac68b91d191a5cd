//! Trigonometric polynomials as equations, sorted by products of unknowns.

use crate::number::tolerance::SUMMED;
use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_rational::{BigRational, Ratio};
use num_traits::{Signed, ToPrimitive};

use super::{Atom, Budget, Key, Powers, Trigonometric, Wave, constants};

/// Bits of the denominator of a decimal number as it is typed.
const DIGITS: u64 = 60;

/// The unknown part of a term: an angle Σ k x in its wave, and a product of powers.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Monomial {
    /// The angle, by symbols.
    pub angle: Vec<(u32, Ratio<i64>)>,
    /// Powers of symbols, above zero.
    pub powers: Vec<(u32, i32)>,
}

impl Monomial {
    /// The monomial with the opposite angle.
    pub fn reversed(&self) -> Self {
        Monomial {
            angle: self.angle.iter().map(|(x, k)| (*x, -k)).collect(),
            powers: self.powers.clone(),
        }
    }

    /// True if the first symbol of the angle has a positive factor.
    pub fn is_positive(&self) -> bool {
        self.angle.first().is_none_or(|(_, k)| k.is_positive())
    }
}

/// Known coefficients T of an equation, by monomials of the unknowns: Σ T · m · e^iw over angles w and products of
/// powers m.
pub type ByUnknowns = BTreeMap<Monomial, Trigonometric>;

impl Key {
    /// Its unknown part and the rest; `None` if an unknown stands elsewhere than alone in an angle or as a factor.
    fn split(&self, unknown: &BTreeSet<u32>) -> Option<(Monomial, Key)> {
        let (mut found, mut rest) = (Monomial::default(), Key::default());
        (rest.root, rest.imaginary) = (self.root, self.imaginary);
        let is_known = |atom: &Atom| {
            let mut symbols = BTreeSet::new();
            atom.symbols(&mut symbols);
            symbols.is_disjoint(unknown)
        };
        for (angle, k) in &self.wave.0 {
            match angle.as_slice() {
                [(Atom::Symbol(x), 1)] if unknown.contains(x) => found.angle.push((*x, *k)),
                _ if angle.iter().all(|(atom, _)| is_known(atom)) => {
                    rest.wave.0.push((angle.clone(), *k));
                }
                _ => return None,
            }
        }
        for (atom, power) in &self.powers {
            match atom {
                Atom::Symbol(x) if unknown.contains(x) && *power > 0 => {
                    found.powers.push((*x, *power));
                }
                _ if is_known(atom) => rest.powers.push((atom.clone(), *power)),
                _ => return None,
            }
        }
        Some((found, rest))
    }
}

impl Wave {
    /// Its angle as a sum.
    pub fn angle(&self) -> Trigonometric {
        let mut sum = Trigonometric::zero();
        for (angle, k) in &self.0 {
            let [over, under] = [*k.numer(), *k.denom()].map(BigInt::from);
            sum.add_term(Key::of(angle.clone()), BigRational::new(over, under));
        }
        sum
    }

    /// A whole multiple of the angle of a symbol.
    pub fn of_symbol(symbol: u32, factor: i64) -> Self {
        let angle = vec![(Atom::Symbol(symbol), 1)];
        Wave(vec![(angle, Ratio::from_integer(factor))])
    }
}

impl Trigonometric {
    /// The equation sorted by monomials; `None` if an unknown stands elsewhere than alone in an angle or as a factor.
    pub fn by_unknowns(&self, unknown: &BTreeSet<u32>) -> Option<ByUnknowns> {
        let mut sorted = ByUnknowns::new();
        for (key, coefficient) in &self.terms {
            let (monomial, rest) = key.split(unknown)?;
            let sum = sorted.entry(monomial).or_default();
            sum.add_term(rest, coefficient.clone());
        }
        Some(sorted)
    }

    /// The terms in which one of the symbols stands, and the others.
    pub fn split_by(&self, symbols: &BTreeSet<u32>) -> [Self; 2] {
        let mut parts = [Trigonometric::zero(), Trigonometric::zero()];
        for (key, coefficient) in &self.terms {
            let mut own = BTreeSet::new();
            key.symbols(&mut own);
            let part = usize::from(own.is_disjoint(symbols));
            parts[part].add_term(key.clone(), coefficient.clone());
        }
        parts
    }

    /// Times exp(i w).
    pub fn turned(&self, by: &Wave, budget: &mut Budget) -> Option<Self> {
        match by.0.is_empty() {
            true => Some(self.clone()),
            false => self.times(&Trigonometric::one_of(Key::turning(by.clone())), budget),
        }
    }

    /// Times i.
    pub fn times_i(&self) -> Self {
        let mut turned = Trigonometric::zero();
        for (key, coefficient) in &self.terms {
            let (key, sign) = key.times_i();
            turned.add_term(key, coefficient * sign);
        }
        turned
    }

    /// With an angle in place of a symbol, which may stand in angles only, a whole number of times.
    pub fn with_angle(&self, symbol: u32, by: &Wave, budget: &mut Budget) -> Option<Self> {
        let own = vec![(Atom::Symbol(symbol), 1)];
        let mut sum = Trigonometric::zero();
        for (key, coefficient) in &self.terms {
            let place = key.wave.0.iter().position(|(angle, _)| *angle == own);
            let mut key = key.clone();
            let k = place.map(|place| key.wave.0.remove(place).1);
            let mut left = BTreeSet::new();
            key.symbols(&mut left);
            if left.contains(&symbol) || k.is_some_and(|k| !k.is_integer()) {
                return None;
            }
            let term = Trigonometric::term(key, coefficient.clone());
            let by = k.map_or(Wave::default(), |k| by.times(k.to_integer()));
            sum = sum.plus(&term.turned(&by, budget)?);
        }
        Some(sum)
    }

    /// Without what only rounding has left: terms of 10⁻¹³ of the largest, and digits beyond the fifteenth.
    pub fn without_rounding(&self) -> Self {
        let size = |(key, coefficient): (&Key, &BigRational)| {
            coefficient.to_f64().map_or(f64::INFINITY, f64::abs) * (key.root as f64).sqrt()
        };
        let largest = self.terms.iter().map(size).fold(0.0, f64::max);
        let mut kept = self.clone();
        let stays = |key: &Key, c: &mut BigRational| size((key, c)) > SUMMED * largest;
        kept.terms.retain(stays);
        for coefficient in kept.terms.values_mut() {
            if coefficient.denom().bits() > DIGITS {
                let rounded = coefficient.to_f64().map(|value| format!("{value:.14e}"));
                let rounded = rounded.and_then(|text| text.parse().ok());
                *coefficient = rounded
                    .and_then(constants::decimal)
                    .unwrap_or_else(|| coefficient.clone());
            }
        }
        kept
    }

    /// The powers of some symbols that every term of all sums has.
    pub fn common_factor(sums: &[&Self], of: &impl Fn(u32) -> bool) -> Powers {
        let mut keys = sums.iter().flat_map(|sum| sum.terms.keys());
        let Some(first) = keys.next() else {
            return Powers::new();
        };
        let own = |(atom, power): &(Atom, i32)| {
            *power > 0 && matches!(atom, Atom::Symbol(symbol) if of(*symbol))
        };
        let mut common: Powers = first.powers.iter().filter(|x| own(x)).cloned().collect();
        for key in keys {
            common.retain_mut(|(atom, power)| {
                let other = key.powers.iter().find(|(other, _)| other == atom);
                *power = other.map_or(0, |(_, other)| *other).min(*power);
                *power > 0
            });
        }
        common
    }

    /// Without powers that every term has.
    pub fn over(&self, factor: &Powers) -> Self {
        let mut quotient = Trigonometric::zero();
        for (key, coefficient) in &self.terms {
            let mut key = key.clone();
            for (atom, power) in &mut key.powers {
                let own = factor.iter().find(|(other, _)| other == atom);
                *power -= own.map_or(0, |(_, power)| *power);
            }
            key.powers.retain(|(_, power)| *power != 0);
            quotient.add_term(key, coefficient.clone());
        }
        quotient
    }

    /// True if it is positive for all values other than zero of its letters: a sum of positive multiples of even
    /// powers.
    pub fn is_positive(&self) -> bool {
        let square = |key: &Key| {
            let even = key.powers.iter().all(|(_, power)| power % 2 == 0);
            even && key.wave.0.is_empty() && !key.imaginary
        };
        let mut terms = self.terms.iter();
        !self.is_empty() && terms.all(|(key, c)| square(key) && c.is_positive())
    }
}
