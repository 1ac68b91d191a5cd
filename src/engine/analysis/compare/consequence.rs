//! Proof that a formula vanishes because other formulas do.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::Zero;
use rustc_hash::FxHashMap;

use super::echelon::{Combination, Echelon};
use crate::algebra::{Atom, Budget, Key, Powers, Trigonometric};
use crate::mechanism::Letters;
use crate::number::residue::Residue;
use crate::number::sorting::sort_by_key;

/// Rows of the elimination at most.
const MOST_ROWS: usize = 2_000;
/// Terms of all equations together at most; those of spatial loops have thousands.
const MOST_TERMS: usize = 120;
/// Common factors of a formula that are tried.
const MOST_FACTORS: usize = 48;

/// Linear combinations of formulas over the rationals. What is none modulo a prime is taken for none, and what is one there
/// is tried with those formulas alone that it combines.
pub(super) struct Span {
    columns: FxHashMap<Key, usize>,
    rows: Vec<Vec<(usize, BigRational)>>,
    residues: Echelon<Residue>,
}

impl Span {
    /// The combinations of the formulas with coefficients a + b√3.
    pub fn new(formulas: &[Trigonometric]) -> Self {
        Span::over(formulas, &[1, 3])
    }

    /// The combinations of the formulas with coefficients that are sums of multiples of roots.
    pub fn over(formulas: &[Trigonometric], roots: &[u64]) -> Self {
        let mut span = Span {
            columns: FxHashMap::default(),
            rows: Vec::new(),
            residues: Echelon::new(std::iter::empty()),
        };
        let mut budget = Budget { products: 100_000 };
        for formula in formulas {
            for &root in roots {
                let root = Trigonometric::one_of(Key::root(root));
                if let Some(turned) = formula.times(&root, &mut budget) {
                    let row = span.row(&turned);
                    span.rows.push(row);
                }
            }
        }
        let rows = span.rows.iter().enumerate();
        span.residues = Echelon::new(rows.filter_map(|(i, row)| residues(row, Some(i))));
        span
    }

    fn row(&mut self, formula: &Trigonometric) -> Vec<(usize, BigRational)> {
        let mut row = Vec::new();
        for (key, coefficient) in formula.terms() {
            let next = self.columns.len();
            let column = *self.columns.entry(key.clone()).or_insert(next);
            row.push((column, coefficient.clone()));
        }
        sort_by_key(&mut row, |entry| entry.0);
        row
    }

    /// Remainder of a formula modulo the prime.
    fn rest(&mut self, formula: &Trigonometric) -> Option<Combination<Residue>> {
        let row = residues(&self.row(formula), None)?;
        Some(self.residues.reduced(row))
    }

    /// The combinations of some of the formulas, without remainders.
    fn exactly(&self, of: &BTreeSet<usize>) -> Echelon<BigRational> {
        let rows = of.iter().map(|&i| self.rows[i].clone());
        Echelon::new(rows.map(Combination::alone))
    }

    /// True if the formula is such a combination.
    pub fn contains(&mut self, formula: &Trigonometric) -> bool {
        let Some(rest) = self.rest(formula).filter(|rest| rest.entries.is_empty()) else {
            return false;
        };
        let row = Combination::alone(self.row(formula));
        self.exactly(&rest.of).reduced(row).entries.is_empty()
    }
}

/// A row modulo the prime; `of` is its number, if it is one of the span.
fn residues(row: &[(usize, BigRational)], of: Option<usize>) -> Option<Combination<Residue>> {
    let entries = row
        .iter()
        .map(|(column, x)| Some((*column, Residue::of(x)?)));
    let entries = entries.filter(|entry| entry.is_none_or(|(_, x)| !x.is_zero()));
    Some(Combination {
        entries: entries.collect::<Option<_>>()?,
        of: of.into_iter().collect(),
    })
}

/// The terms of the equations as factors: products of letters times a sine or cosine.
fn factors(equations: &[Trigonometric]) -> Vec<Trigonometric> {
    let mut keys: BTreeSet<Key> = BTreeSet::new();
    for (key, _) in equations.iter().flat_map(Trigonometric::terms) {
        let bare = Key {
            root: 1,
            imaginary: false,
            ..key.clone()
        };
        let opposite = Key {
            wave: bare.wave.times(-1),
            ..bare.clone()
        };
        keys.insert(bare.min(opposite));
    }
    keys.into_iter().flat_map(circular).collect()
}

/// Twice the cosine and the sine of a wave times letters; the letters alone if the wave is zero.
pub(super) fn circular(key: Key) -> Vec<Trigonometric> {
    let one = Trigonometric::one_of;
    if key.wave.0.is_empty() {
        return vec![one(key)];
    }
    let opposite = Key {
        wave: key.wave.times(-1),
        ..key.clone()
    };
    let turned = |key: Key| Key {
        imaginary: true,
        ..key
    };
    let cosine = one(key.clone()).plus(&one(opposite.clone()));
    vec![cosine, one(turned(key)).minus(&one(turned(opposite)))]
}

/// Orthonormality of the axes n, s, a of platforms, as equations, times products of two of the lengths that multiply
/// these axes. `first` is the symbol of the first letter of the first platform, which has twelve.
fn orthogonality(equations: &[Trigonometric], first: u32) -> Vec<Trigonometric> {
    let mut lengths: BTreeSet<Powers> = BTreeSet::new();
    let mut platforms: BTreeSet<u32> = BTreeSet::new();
    for (key, _) in equations.iter().flat_map(Trigonometric::terms) {
        let powers = key.powers.iter().cloned();
        let (own, others): (Powers, Powers) =
            powers.partition(|(atom, _)| matches!(atom, Atom::Symbol(symbol) if *symbol >= first));
        for (atom, _) in &own {
            if let Atom::Symbol(symbol) = atom {
                platforms.insert((symbol - first) / 12);
                lengths.insert(others.clone());
            }
        }
    }
    let mut budget = Budget { products: 100_000 };
    let product = |powers: &Powers| Trigonometric::one_of(Key::of(powers.clone()));
    let mut relations = Vec::new();
    for platform in platforms {
        let letter = |k: u32| Trigonometric::symbol(first + 12 * platform + k);
        for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)] {
            let mut sum = match i == j {
                true => Trigonometric::one().negated(),
                false => Trigonometric::zero(),
            };
            for k in 0..3 {
                let term = letter(3 * i + k).times(&letter(3 * j + k), &mut budget);
                sum = sum.plus(&term.unwrap_or_default());
            }
            for x in &lengths {
                for y in lengths.iter().filter(|y| *y >= x) {
                    let square = product(x).times(&product(y), &mut budget);
                    let relation = square.and_then(|square| sum.times(&square, &mut budget));
                    relations.extend(relation);
                }
            }
        }
    }
    relations
}

/// The equations, and these times the terms that occur in them, as one multiplies to square and add equations. `None` if
/// these are too many.
fn multiplied(
    equations: &[Trigonometric],
    first_platform: u32,
    budget: &mut Budget,
) -> Option<Vec<Trigonometric>> {
    if equations.iter().map(Trigonometric::len).sum::<usize>() > MOST_TERMS {
        return None;
    }
    let mut generators: Vec<Trigonometric> = equations.to_vec();
    for factor in factors(equations) {
        for equation in equations {
            generators.push(equation.times(&factor, budget)?);
        }
    }
    generators.extend(orthogonality(equations, first_platform));
    (2 * generators.len() <= MOST_ROWS).then_some(generators)
}

/// True if a formula, perhaps times a product of lengths that are not zero, is Σ tₖ gₖ, with the equations gₖ and
/// combinations tₖ of the terms that occur in them: enough to square and add equations, as one does to eliminate an
/// angle or a platform.
pub(super) fn follows(
    formula: &Trigonometric,
    equations: &[Trigonometric],
    letters: Letters,
    budget: &mut Budget,
) -> bool {
    let Some(generators) = multiplied(equations, letters.platform(0, 0), budget) else {
        return false;
    };
    let mut span = Span::new(&generators);
    candidates(formula, &generators, letters)
        .iter()
        .any(|factor| {
            let product = formula.times(factor, budget);
            product.is_some_and(|product| span.contains(&product))
        })
}

/// A part of the formula without which, times some number, the rest follows: the slip of a formula that does not. It is one
/// product of letters with a sine or cosine.
pub(super) fn slip(
    formula: &Trigonometric,
    equations: &[Trigonometric],
    letters: Letters,
    budget: &mut Budget,
) -> Option<Trigonometric> {
    let generators = multiplied(equations, letters.platform(0, 0), budget);
    let generators = generators.unwrap_or_else(|| equations.to_vec());
    let mut span = Span::new(&generators);
    for factor in candidates(formula, &generators, letters) {
        let whole = formula.times(&factor, budget)?;
        let left = span.rest(&whole)?;
        for term in factors(std::slice::from_ref(formula)) {
            let multiple = term.times(&factor, budget)?;
            let Some(part) = span
                .rest(&multiple)
                .filter(|part| part.ratio(&left).is_some())
            else {
                continue;
            };
            let echelon = span.exactly(&left.of.union(&part.of).copied().collect());
            let mut rest = |of: &Trigonometric| echelon.reduced(Combination::alone(span.row(of)));
            if let Some(ratio) = rest(&multiple).ratio(&rest(&whole)) {
                return Some(term.scaled(&ratio));
            }
        }
    }
    None
}

/// Products of letters that bring a term of the formula to a term of the generators. None of them is zero in the mechanism, for
/// what vanishes times zero need not vanish.
fn candidates(
    formula: &Trigonometric,
    generators: &[Trigonometric],
    letters: Letters,
) -> Vec<Trigonometric> {
    let parameters = letters.0.parameters();
    let is_zero = |(atom, power): (&Atom, &i32)| match atom {
        _ if *power <= 0 => false,
        Atom::Symbol(symbol) => (parameters.get(*symbol as usize)).is_none_or(|p| p.value == 0.0),
        _ => true,
    };
    let mut found: BTreeSet<Powers> = BTreeSet::from([Powers::new()]);
    let Some((lead, _)) = formula.terms().next() else {
        return vec![];
    };
    for (key, _) in generators.iter().flat_map(Trigonometric::terms) {
        if key.wave != lead.wave || key.imaginary != lead.imaginary {
            continue;
        }
        let mut ratio: BTreeMap<Atom, i32> = key.powers.iter().cloned().collect();
        for (atom, power) in &lead.powers {
            *ratio.entry(atom.clone()).or_default() -= power;
        }
        if !ratio.iter().any(is_zero) {
            found.insert(ratio.into_iter().filter(|(_, power)| *power != 0).collect());
        }
    }
    let mut found: Vec<Powers> = found.into_iter().collect();
    sort_by_key(&mut found, |powers| {
        powers.iter().map(|(_, power)| power.abs()).sum::<i32>()
    });
    let product = |powers: Powers| Trigonometric::one_of(Key::of(powers));
    found.into_iter().take(MOST_FACTORS).map(product).collect()
}
