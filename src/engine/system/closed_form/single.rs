//! Equations in one unknown.

use std::collections::BTreeSet;

use num_rational::Ratio;

use super::Rule;
use crate::algebra::{Budget, ByUnknowns, Monomial, Trigonometric, Wave};

/// The unknown of an equation: an angle that is a sum of joint variables, or a slide.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum SingleUnknown {
    Angle(Vec<(u32, Ratio<i64>)>),
    Slide(u32),
}

/// Unknowns of an equation.
pub(super) enum Content {
    Nothing,
    One(SingleUnknown),
    More,
}

/// The unknowns of an equation.
pub(super) fn content(equation: &ByUnknowns) -> Content {
    let mut found = BTreeSet::new();
    for monomial in equation.keys() {
        match (monomial.angle.as_slice(), monomial.powers.as_slice()) {
            ([], []) => {}
            ([], [(slide, 1 | 2)]) => {
                found.insert(SingleUnknown::Slide(*slide));
            }
            (_, []) => {
                let positive = match monomial.is_positive() {
                    true => monomial.clone(),
                    false => monomial.reversed(),
                };
                found.insert(SingleUnknown::Angle(positive.angle));
            }
            _ => return Content::More,
        }
    }
    let mut found = found.into_iter();
    match (found.next(), found.next()) {
        (None, _) => Content::Nothing,
        (Some(only), None) => Content::One(only),
        _ => Content::More,
    }
}

/// a cos(w + κ) + b sin(w + κ) + c
pub(super) struct Circular {
    pub a: Trigonometric,
    pub b: Trigonometric,
    pub c: Trigonometric,
}

fn known(equation: &ByUnknowns) -> Trigonometric {
    let sum = equation.get(&Monomial::default());
    sum.cloned().unwrap_or_default()
}

fn monomial(angle: &[(u32, Ratio<i64>)]) -> Monomial {
    Monomial {
        angle: angle.to_vec(),
        powers: vec![],
    }
}

/// The known angle κ added to an unknown one.
pub(super) fn angle_sum(equation: &ByUnknowns, angle: &[(u32, Ratio<i64>)]) -> Wave {
    let first = equation.get(&monomial(angle));
    let first = first.and_then(|sum| sum.terms().next());
    first.map_or(Wave::default(), |(key, _)| key.wave.clone())
}

impl Circular {
    /// T₊ e^iw + T₋ e^−iw = (T₊ + T₋) cos w + i (T₊ − T₋) sin w
    pub fn of(
        equation: &ByUnknowns,
        angle: &[(u32, Ratio<i64>)],
        beside: &Wave,
        budget: &mut Budget,
    ) -> Option<Self> {
        let positive = monomial(angle);
        let mut part = |monomial: &Monomial, sign: i64| {
            let sum = equation.get(monomial).cloned().unwrap_or_default();
            sum.turned(&beside.times(-sign), budget)
        };
        let (plus, minus) = (part(&positive, 1)?, part(&positive.reversed(), -1)?);
        Some(Circular {
            a: plus.plus(&minus).without_rounding(),
            b: plus.minus(&minus).times_i().without_rounding(),
            c: known(equation),
        })
    }

    /// a cos x + b sin x = −c
    pub fn projection(self) -> Rule<Trigonometric> {
        Rule::Projection {
            a: self.a,
            b: self.b,
            c: self.c.negated(),
        }
    }
}

/// An equation in one slide: c + b x + a x².
pub(super) fn polynomial(equation: &ByUnknowns, slide: u32) -> [Trigonometric; 3] {
    [0, 1, 2].map(|power| {
        let powers = match power {
            0 => vec![],
            power => vec![(slide, power)],
        };
        let sum = equation.get(&Monomial {
            angle: vec![],
            powers,
        });
        sum.cloned().unwrap_or_default()
    })
}

/// The sum of products.
pub(super) fn dot<'t>(
    pairs: impl IntoIterator<Item = (&'t Trigonometric, &'t Trigonometric)>,
    budget: &mut Budget,
) -> Option<Trigonometric> {
    let mut sum = Trigonometric::zero();
    for (x, y) in pairs {
        sum = sum.plus(&x.times(y, budget)?);
    }
    Some(sum.without_rounding())
}

/// x y − z w
pub(super) fn cross(
    [x, y, z, w]: [&Trigonometric; 4],
    budget: &mut Budget,
) -> Option<Trigonometric> {
    let difference = x.times(y, budget)?.minus(&z.times(w, budget)?);
    Some(difference.without_rounding())
}
