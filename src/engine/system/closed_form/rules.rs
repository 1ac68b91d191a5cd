//! Choice of the rule for an unknown.

use std::collections::BTreeSet;

use num_rational::Ratio;

use super::Rule;
use super::derivation::{Derivation, FoundRule};
use super::single::{Circular, SingleUnknown, angle_sum, cross, dot, polynomial};
use crate::algebra::{ByUnknowns, Trigonometric, Wave};
use crate::number::real;
use crate::number::tolerance::ROUNDING;

/// Unknowns in the equations of one closure beyond which none is eliminated.
const MOST_UNKNOWNS: usize = 4;

impl Derivation<'_> {
    /// Equations without one or two of the unknowns of a group.
    pub(super) fn eliminated(&mut self, group: usize) -> Vec<Trigonometric> {
        let rows = self.groups[group].rows.clone();
        let symbols: BTreeSet<u32> = rows.iter().flat_map(Trigonometric::symbols).collect();
        let open: Vec<u32> = symbols.intersection(&self.unknown).copied().collect();
        if rows.len() < 2 || open.len() > MOST_UNKNOWNS {
            return vec![];
        }
        let mut found = Vec::new();
        for chosen in 1_u32..1 << open.len() {
            let chosen = open
                .iter()
                .enumerate()
                .filter(|(i, _)| chosen >> i & 1 == 1);
            let chosen: BTreeSet<u32> = chosen.map(|(_, symbol)| *symbol).collect();
            let sides = rows.iter().map(|row| row.split_by(&chosen));
            let (mut with, mut without) = (Vec::new(), Vec::new());
            for [own, rest] in sides {
                with.push(own);
                without.push(rest);
            }
            let mut square =
                |side: &[Trigonometric]| dot(side.iter().map(|x| (x, x)), &mut self.budget);
            if let (Some(with), Some(without)) = (square(&with), square(&without)) {
                found.push(with.minus(&without).without_rounding());
            }
        }
        // b_j r_i − b_i r_j, where a slide is linear with known coefficients b
        let sorted: Option<Vec<ByUnknowns>> = rows
            .iter()
            .map(|row| row.by_unknowns(&self.unknown))
            .collect();
        let Some(sorted) = sorted else {
            return found;
        };
        for &slide in &open {
            let factors: Vec<Trigonometric> = (sorted.iter())
                .map(|row| {
                    let [_, b, _] = polynomial(row, slide);
                    b
                })
                .collect();
            for i in 0..rows.len() {
                for j in 0..i {
                    let (b, c) = (&factors[i], &factors[j]);
                    if b.is_empty() || c.is_empty() {
                        continue;
                    }
                    found.extend(cross([c, &rows[i], b, &rows[j]], &mut self.budget));
                }
            }
        }
        found
    }

    /// The rule for an unknown that alone stands in some rows; with `alone` one that leaves two solutions.
    pub(super) fn rule_for(
        &mut self,
        closure: usize,
        rows: &[&ByUnknowns],
        unknown: SingleUnknown,
        alone: bool,
    ) -> Option<FoundRule> {
        let (rule, beside) = match &unknown {
            SingleUnknown::Slide(slide) => {
                if self.never.contains(slide) {
                    return None;
                }
                (self.slide(rows, *slide, alone)?, Wave::default())
            }
            SingleUnknown::Angle(angle) => {
                let solvable = |(x, k): &(u32, Ratio<i64>)| {
                    !self.never.contains(x) && k.numer().abs() == 1 && *k.denom() == 1
                };
                if !angle.iter().all(solvable) {
                    return None;
                }
                let beside = angle_sum(rows.first()?, angle);
                let circular: Option<Vec<Circular>> = (rows.iter())
                    .map(|row| Circular::of(row, angle, &beside, &mut self.budget))
                    .collect();
                let mut circular = circular?;
                let rule = match alone {
                    false => self.direction(&circular)?,
                    true => {
                        let large = |row: &Circular| {
                            real::hypot(self.value(&row.a), self.value(&row.b)).powi(2) > self.least
                        };
                        let place = circular.iter().position(large)?;
                        circular.swap_remove(place).projection()
                    }
                };
                (rule, beside)
            }
        };
        Some(FoundRule {
            closure,
            unknown,
            beside,
            rule,
        })
    }

    fn slide(
        &mut self,
        rows: &[&ByUnknowns],
        slide: u32,
        alone: bool,
    ) -> Option<Rule<Trigonometric>> {
        let rows = rows.iter().map(|row| polynomial(row, slide));
        let rows: Vec<[Trigonometric; 3]> = rows.collect();
        if !alone {
            let linear = rows.iter().filter(|[_, _, square]| square.is_empty());
            let linear: Vec<_> = linear.collect();
            let over = dot(linear.iter().map(|[_, b, _]| (b, b)), &mut self.budget)?;
            let (of, over) = match linear[..] {
                [[c, b, _]] => (c.clone(), b.clone()),
                _ => {
                    let of = dot(linear.iter().map(|[c, b, _]| (b, c)), &mut self.budget)?;
                    (of, over)
                }
            };
            let of = of.negated();
            return (self.value(&over).powi(2) > self.least).then_some(Rule::Linear { of, over });
        }
        let [c, b, a] = rows.into_iter().find(|[_, _, square]| !square.is_empty())?;
        (self.value(&a).abs() > ROUNDING).then_some(Rule::Quadratic { a, b, c })
    }

    /// cos x and sin x from several rows.
    fn direction(&mut self, rows: &[Circular]) -> Option<Rule<Trigonometric>> {
        let budget = &mut self.budget;
        let a = || rows.iter().map(|row| &row.a);
        let b = || rows.iter().map(|row| &row.b);
        let c = || rows.iter().map(|row| &row.c);
        let (aa, bb) = (dot(a().zip(a()), budget)?, dot(b().zip(b()), budget)?);
        let ab = dot(a().zip(b()), budget)?;
        if ab.is_empty() && aa.minus(&bb).without_rounding().is_empty() {
            let cos = dot(a().zip(c()), budget)?.negated();
            let sin = dot(b().zip(c()), budget)?.negated();
            return (self.value(&aa) > self.least).then_some(Rule::Direction { sin, cos });
        }
        for (i, first) in rows.iter().enumerate() {
            for second in &rows[..i] {
                let budget = &mut self.budget;
                let (r, s) = (first, second);
                let determinant = cross([&r.a, &s.b, &s.a, &r.b], budget)?;
                let cos = cross([&r.b, &s.c, &s.b, &r.c], budget)?;
                let sin = cross([&r.c, &s.a, &s.c, &r.a], budget)?;
                if self.value(&determinant).abs() <= self.least {
                    continue;
                }
                if determinant.is_positive() {
                    return Some(Rule::Direction { sin, cos });
                }
                if determinant.negated().is_positive() {
                    let (sin, cos) = (sin.negated(), cos.negated());
                    return Some(Rule::Direction { sin, cos });
                }
                let budget = &mut self.budget;
                return Some(Rule::Direction {
                    sin: sin.times(&determinant, budget)?,
                    cos: cos.times(&determinant, budget)?,
                });
            }
        }
        None
    }
}
