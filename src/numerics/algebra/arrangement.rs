//! Normal form → the expression a textbook would print.
//!
//! The normal form is a sum over waves. An angle that always occurs together with another one of the same sign, as
//! θ₂ with θ₃ when their axes are parallel, is merged with it; products of the remaining angles are multiplied out again:
//! cos(θ₁ + θ₂ + θ₃)/2 + cos(θ₁ − θ₂ − θ₃)/2 is printed c₁ c₂₃. The sum over waves is printed instead where it
//! is shorter. Common factors are extracted, letters first.

mod product;

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::trigonometric::{Atom, Key, Powers, Trigonometric, Wave};
use super::{Expression, Node, Operator};
use crate::number::sorting::{sort_by, sort_by_key};
use product::written;

/// Products that are multiplied out at most; beyond, the sum over waves is printed as it is.
const MOST_PRODUCTS: usize = 20_000;

/// Sums of formulas as expressions.
#[derive(Clone, Debug, PartialEq)]
pub struct Arranged {
    /// An expression for each formula.
    pub expressions: Vec<Expression>,
    /// True if product forms were tried for all formulas, false if one was too long.
    pub complete: bool,
}

/// Expressions for formulas that are printed together, as the entries of one matrix. `name` names the symbols.
pub fn arrange(formulas: &[&Trigonometric], name: &dyn Fn(u32) -> String) -> Arranged {
    let blocks = blocks(formulas);
    let mut complete = true;
    let expressions = formulas.iter().map(|formula| {
        let sum = nested(products(formula, &|_| 0), name);
        let longest = 1 << blocks.values().max().map_or(0, |last| last + 1).min(16);
        if formula.len().saturating_mul(longest) > MOST_PRODUCTS {
            complete = false;
            return sum;
        }
        let block = |angle: &Powers| blocks.get(angle).copied().unwrap_or(0);
        let product = nested(products(formula, &block), name);
        let length = |expression: &Expression| expression.to_string().chars().count();
        match length(&sum) < length(&product) {
            true => sum,
            false => product,
        }
    });
    let expressions = expressions.collect();
    Arranged {
        expressions,
        complete,
    }
}

/// Angles of the same number are merged: some wave has both, and no two waves have them with different relative signs.
fn blocks(formulas: &[&Trigonometric]) -> BTreeMap<Powers, usize> {
    let waves = formulas.iter().flat_map(|f| f.terms());
    let waves = waves.map(|(key, _)| &key.wave);
    let mut signs: BTreeMap<(&Powers, &Powers), (bool, bool)> = BTreeMap::new();
    let mut angles: BTreeMap<&Powers, usize> = BTreeMap::new();
    for wave in waves {
        for (i, (a, k)) in wave.0.iter().enumerate() {
            angles.insert(a, 0);
            for (b, l) in &wave.0[i + 1..] {
                let seen = signs.entry((a, b)).or_default();
                match k.is_positive() == l.is_positive() {
                    true => seen.0 = true,
                    false => seen.1 = true,
                }
            }
        }
    }
    let seen = |a: &Powers, b: &Powers| {
        let mut both = [(a, b), (b, a)].into_iter();
        both.find_map(|pair| signs.get(&pair).copied())
            .unwrap_or_default()
    };
    let mut merged: Vec<Vec<&Powers>> = Vec::new();
    let mut found = BTreeMap::new();
    for &angle in angles.keys() {
        let fits = |block: &Vec<&Powers>| {
            let mut pairs = block.iter().map(|other| seen(angle, other));
            let mut others = block.iter();
            let together = others.any(|other| seen(angle, other) != (false, false));
            together && pairs.all(|pair| pair != (true, true))
        };
        let place = merged.iter().position(fits).unwrap_or_else(|| {
            merged.push(Vec::new());
            merged.len() - 1
        });
        merged[place].push(angle);
        found.insert(angle.clone(), place);
    }
    found
}

/// A sine or cosine.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct SineTerm {
    angle: Wave,
    sine: bool,
}

/// A product of letters, sines and cosines.
#[derive(Clone, Debug, PartialEq)]
struct Product {
    coefficient: BigRational,
    root: u64,
    powers: Powers,
    circular: Vec<SineTerm>,
}

/// The factors e^iw = cos w + i sin w of a wave, one for each block.
fn factors(wave: &Wave, block: &dyn Fn(&Powers) -> usize) -> Vec<(Wave, i32)> {
    let mut parts: BTreeMap<usize, Wave> = BTreeMap::new();
    for (angle, k) in &wave.0 {
        let part = parts.entry(block(angle)).or_default();
        part.0.push((angle.clone(), *k));
    }
    let mut parts: Vec<Wave> = parts.into_values().collect();
    sort_by(&mut parts, Ord::cmp);
    let signed = parts.into_iter().map(|part| {
        // the sign of the first letter; of π only if there is no other
        let lead = part.0.iter().find(|(angle, _)| *angle != [(Atom::Pi, 1)]);
        match lead.or(part.0.first()) {
            Some((_, k)) if k.is_negative() => (part.times(-1), -1),
            _ => (part, 1),
        }
    });
    signed.collect()
}

fn products(formula: &Trigonometric, block: &dyn Fn(&Powers) -> usize) -> Vec<Product> {
    type SumKey = (Powers, u64, Vec<SineTerm>, bool);
    let mut sums: BTreeMap<SumKey, BigRational> = BTreeMap::new();
    for (key, coefficient) in formula.terms() {
        let Key {
            wave,
            powers,
            root,
            imaginary,
        } = key;
        // (sines and cosines, power of i, sign)
        let mut expanded: Vec<(Vec<SineTerm>, u32, i32)> = vec![(vec![], u32::from(*imaginary), 1)];
        for (angle, sign) in factors(wave, block) {
            let mut longer = Vec::with_capacity(2 * expanded.len());
            for (circular, turns, s) in expanded {
                for sine in [false, true] {
                    let mut circular = circular.clone();
                    circular.push(SineTerm {
                        angle: angle.clone(),
                        sine,
                    });
                    let sign = if sine { s * sign } else { s };
                    longer.push((circular, turns + u32::from(sine), sign));
                }
            }
            expanded = longer;
        }
        for (circular, turns, sign) in expanded {
            let sign = if turns % 4 >= 2 { -sign } else { sign };
            let place = (powers.clone(), *root, circular, turns % 2 == 1);
            let sum = sums.entry(place).or_insert_with(BigRational::zero);
            *sum += coefficient * BigInt::from(sign);
        }
    }
    // a formula is real: its imaginary parts cancel
    let sums = sums.into_iter();
    let real = sums.filter(|((.., imaginary), sum)| !imaginary && !sum.is_zero());
    let products = real.map(|((powers, root, circular, _), coefficient)| Product {
        coefficient,
        root,
        powers,
        circular,
    });
    products.collect()
}

/// A factor that several products may have.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum SharedFactor {
    Letter(Atom, i32),
    Circular(SineTerm),
}

impl Product {
    /// Its place in a sum: letters alone first, then long products before short ones.
    fn rank(&self) -> impl Ord + use<> {
        let length = self.circular.len();
        (
            length != 0,
            std::cmp::Reverse(length),
            self.circular.clone(),
            self.powers.clone(),
            self.root,
        )
    }

    fn factors(&self) -> impl Iterator<Item = SharedFactor> {
        let letters = self.powers.iter().filter(|(_, power)| *power > 0);
        let letters = letters.map(|(atom, power)| SharedFactor::Letter(atom.clone(), *power));
        letters.chain(self.circular.iter().cloned().map(SharedFactor::Circular))
    }

    fn has(&self, factor: &SharedFactor) -> bool {
        self.factors().any(|own| own == *factor)
    }

    fn without(&self, factor: &SharedFactor) -> Product {
        let mut rest = self.clone();
        match factor {
            SharedFactor::Letter(atom, _) => rest.powers.retain(|(own, _)| own != atom),
            SharedFactor::Circular(circular) => rest.circular.retain(|own| own != circular),
        }
        rest
    }
}

type LetterName<'a> = &'a dyn Fn(u32) -> String;

/// A signed summand.
struct Summand {
    negative: bool,
    expression: Expression,
}

fn nested(products: Vec<Product>, name: LetterName) -> Expression {
    sum(summands(products, name))
}

fn sum(summands: Vec<Summand>) -> Expression {
    let mut summands = summands.into_iter();
    let Some(first) = summands.next() else {
        return Expression::number(0.0);
    };
    let mut sum = first.expression;
    if first.negative {
        sum = negated(sum);
    }
    summands.fold(sum, |sum, next| {
        let operator = [Operator::Add, Operator::Subtract][usize::from(next.negative)];
        binary(operator, sum, next.expression)
    })
}

/// −(a·b) reads (−a)·b, as it is written.
fn negated(expression: Expression) -> Expression {
    match expression.node {
        Node::Binary(operator @ (Operator::Multiply | Operator::Divide), x, y) => {
            binary(operator, negated(*x), *y)
        }
        node => Node::negated(node.at(0..0)).at(0..0),
    }
}

fn binary(operator: Operator, x: Expression, y: Expression) -> Expression {
    Node::binary(operator, x, y).at(0..0)
}

fn summands(mut products: Vec<Product>, name: LetterName) -> Vec<Summand> {
    sort_by_key(&mut products, Product::rank);
    let mut counts: BTreeMap<SharedFactor, usize> = BTreeMap::new();
    for factor in products.iter().flat_map(Product::factors) {
        *counts.entry(factor).or_default() += 1;
    }
    // the first of those that occur most
    let best = counts.iter().rev().max_by_key(|(_, count)| **count);
    let common = best.filter(|(_, count)| **count > 1 && products.len() > 1);
    let Some((factor, _)) = common else {
        let single = |product: Product| written(&product, None, name);
        return products.into_iter().map(single).collect();
    };
    let first = products[0].has(factor);
    let all = products.iter().cloned();
    let (with, without): (Vec<_>, Vec<_>) = all.partition(|product| product.has(factor));
    let inside: Vec<Product> = with.iter().map(|product| product.without(factor)).collect();
    let mut taken = vec![taken_out(factor, inside, name)];
    let rest = match without.is_empty() {
        true => vec![],
        false => summands(without, name),
    };
    match first {
        true => {
            taken.extend(rest);
            taken
        }
        false => rest.into_iter().chain(taken).collect(),
    }
}

/// factor·(…)
fn taken_out(factor: &SharedFactor, mut inside: Vec<Product>, name: LetterName) -> Summand {
    sort_by_key(&mut inside, Product::rank);
    // −s₁(c₂ − c₃) rather than s₁(−c₂ + c₃)
    let negative = inside[0].coefficient.is_negative();
    for product in inside.iter_mut().filter(|_| negative) {
        product.coefficient = -product.coefficient.clone();
    }
    let mut outside = Product {
        coefficient: BigRational::one(),
        root: 1,
        powers: vec![],
        circular: vec![],
    };
    // common factors are extracted with it
    let mut common = vec![factor.clone()];
    let shared = |inside: &[Product]| {
        let mut factors = inside[0].factors();
        factors.find(|f| inside.iter().all(|p| p.has(f)))
    };
    while let Some(shared) = shared(&inside) {
        inside = inside.iter().map(|p| p.without(&shared)).collect();
        common.push(shared);
    }
    for factor in common {
        match factor {
            SharedFactor::Letter(atom, power) => outside.powers.push((atom, power)),
            SharedFactor::Circular(circular) => outside.circular.push(circular),
        }
    }
    sort_by(&mut outside.powers, Ord::cmp);
    sort_by(&mut outside.circular, Ord::cmp);
    let inside = nested(inside, name);
    let Summand { expression, .. } = written(&outside, Some(inside), name);
    Summand {
        negative,
        expression,
    }
}
