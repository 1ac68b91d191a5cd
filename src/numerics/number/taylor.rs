use std::f64::consts::{FRAC_PI_2, PI};

use super::{Number, functions, operators};

/// A function of t from −1 to 1: a polynomial, and a bound of the rest (Makino and Berz, Taylor models, 2003).
///
/// The bound is that of the series cut off; rounding in the polynomial, some 10⁻¹⁵ of its terms, is not in it. What has
/// no bound, as a quotient whose divisor may vanish, has the rest ∞.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor {
    /// The terms of the polynomial, from the constant one.
    pub terms: [f64; TERMS],
    /// The function is nowhere farther than this from the polynomial.
    pub rest: f64,
}

const TERMS: usize = 6;

impl Taylor {
    /// A value that may be anything.
    pub const UNBOUNDED: Self = Taylor {
        terms: [0.0; TERMS],
        rest: f64::INFINITY,
    };

    /// All that lies between two numbers.
    fn within(low: f64, high: f64) -> Self {
        let mut model = Self::from_f64(0.5 * (low + high));
        model.rest = 0.5 * (high - low);
        model
    }

    /// Bound of the distance from the constant term.
    fn reach(&self) -> f64 {
        self.terms[1..].iter().map(|term| term.abs()).sum::<f64>() + self.rest
    }

    /// Bounds of the function; those of a parabola are exact.
    pub fn range(&self) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.terms;
        let beyond = d.abs() + f.abs() + self.rest;
        let highest = |sense: f64| {
            let (b, c) = (b.abs(), sense * c);
            let top = match b < -2.0 * c {
                true => -0.25 * b * b / c,
                false => b + c,
            };
            sense * (sense * a + top + (sense * e).max(0.0) + beyond)
        };
        [highest(-1.0), highest(1.0)]
    }

    /// Argument t in [−1, 1] at which the parabola of the first three terms, times `sense`, is highest.
    pub fn top(&self, sense: f64) -> f64 {
        let [_, b, c, ..] = self.terms.map(|term| sense * term);
        match b.abs() < -2.0 * c {
            true => -0.5 * b / c,
            false => 1f64.copysign(b),
        }
    }

    /// Bound of the distance from the tangent line at t = 0.
    pub fn bend(&self) -> f64 {
        self.reach() - self.terms[1].abs()
    }

    /// The value of the polynomial.
    pub fn at(&self, t: f64) -> f64 {
        self.terms
            .iter()
            .rev()
            .fold(0.0, |sum, term| sum * t + term)
    }

    /// A function of it by its series about the constant term, with a bound of the first coefficient left out.
    fn composed(self, series: [f64; TERMS], next: f64) -> Self {
        let reach = self.reach();
        let mut step = self;
        step.terms[0] = 0.0;
        let mut sum = Self::from_f64(series[TERMS - 1]);
        for term in series[..TERMS - 1].iter().rev() {
            sum *= step;
            sum.terms[0] += term;
        }
        sum.rest += next * reach.powi(TERMS as i32);
        sum
    }

    /// The model or the range, whichever is narrower.
    fn narrower(self, low: f64, high: f64) -> Self {
        match self.reach() <= high - low {
            true => self,
            false => Self::within(low, high),
        }
    }

    /// A power of a positive number; of its lower end at least zero.
    fn power(self, exponent: f64) -> Self {
        let (x, reach) = (self.terms[0], self.reach());
        let low = x - reach;
        let mut coefficient = 1.0;
        let series = std::array::from_fn(|k| {
            let term = coefficient * pxfm::f_pow(x, exponent - k as f64);
            coefficient *= (exponent - k as f64) / (k + 1) as f64;
            term
        });
        self.composed(
            series,
            coefficient.abs() * pxfm::f_pow(low, exponent - TERMS as f64),
        )
    }

    fn reciprocal(self) -> Self {
        let (x, reach) = (self.terms[0], self.reach());
        if x.is_nan() || x.abs() <= reach {
            return if x == 0.0 && reach == 0.0 {
                Self::from_f64(f64::NAN)
            } else {
                Self::UNBOUNDED
            };
        }
        if x < 0.0 {
            return -(-self).reciprocal();
        }
        let (low, high) = (1.0 / (x + reach), 1.0 / (x - reach));
        self.power(-1.0).narrower(low, high)
    }

    #[inline]
    fn over(self, by: Self) -> Self {
        self * by.reciprocal()
    }
}

operators!([Taylor]
    #[inline] Add add |a, b| Taylor {
        terms: std::array::from_fn(|k| a.terms[k] + b.terms[k]),
        rest: a.rest + b.rest,
    };
    #[inline] Sub sub |a, b| a + -b;
    #[inline(never)] Mul mul |a, b| {
        let size = |of: &Taylor| of.terms.iter().map(|term| term.abs()).sum::<f64>();
        let mut terms = [0.0; TERMS];
        let mut rest = a.rest * size(&b) + b.rest * size(&a) + a.rest * b.rest;
        for (i, x) in a.terms.iter().enumerate() {
            for (j, y) in b.terms.iter().enumerate() {
                match terms.get_mut(i + j) {
                    Some(term) => *term += x * y,
                    None => rest += (x * y).abs(),
                }
            }
        }
        // nothing times what has no bound has none
        if rest.is_nan() && terms.iter().all(|term| term.is_finite()) {
            return Taylor::UNBOUNDED;
        }
        Taylor { terms, rest }
    };
    #[inline] Div div |a, b| a.over(b);
    #[inline] Neg neg |a| Taylor { terms: a.terms.map(|term| -term), rest: a.rest };
);

impl Number for Taylor {
    #[inline]
    fn from_f64(x: f64) -> Self {
        let mut terms = [0.0; TERMS];
        terms[0] = x;
        Taylor { terms, rest: 0.0 }
    }
    #[inline]
    fn real(self) -> f64 {
        self.terms[0]
    }
    fn sin_cos(self) -> (Self, Self) {
        let whole = Self::within(-1.0, 1.0);
        if self.reach() > 2.0 {
            return (whole, whole);
        }
        let (s, c) = Number::sin_cos(self.terms[0]);
        let sin = [s, c, -s / 2.0, -c / 6.0, s / 24.0, c / 120.0];
        let cos = [c, -s, -c / 2.0, s / 6.0, c / 24.0, -s / 120.0];
        [sin, cos]
            .map(|series| self.composed(series, 1.0 / 720.0).narrower(-1.0, 1.0))
            .into()
    }
    fn sqrt(self) -> Self {
        let (x, reach) = (self.terms[0], self.reach());
        let [low, high] = [x - reach, x + reach];
        match low > 0.0 {
            true => self.power(0.5).narrower(low.sqrt(), high.sqrt()),
            // not a number if it has no value anywhere
            false => Self::within(0.0, high.sqrt()),
        }
    }
    fn asin(self) -> Self {
        let (x, reach) = (self.terms[0], self.reach());
        let [low, high] = [(x - reach).max(-1.0), (x + reach).min(1.0)];
        match (low > high, low > -1.0 && high < 1.0) {
            (true, _) => Self::from_f64(f64::NAN),
            (_, true) => (self / (Self::one() - self * self).sqrt())
                .atan()
                .narrower(pxfm::f_asin(low), pxfm::f_asin(high)),
            _ => Self::within(pxfm::f_asin(low), pxfm::f_asin(high)),
        }
    }
    functions!(|x|
        acos: Self::from_f64(FRAC_PI_2) - x.asin(),
        atan: {
            let (at, reach) = (x.terms[0], x.reach());
            // the n-th coefficient is cosⁿφ sin n(φ + π/2) / n with φ = atan x, at most 1/n
            let angle = pxfm::f_atan(at);
            let cos = 1.0 / (1.0 + at * at).sqrt();
            let series = std::array::from_fn(|n| match n {
                0 => angle,
                n => cos.powi(n as i32) * Number::sin_cos(n as f64 * (angle + FRAC_PI_2)).0 / n as f64,
            });
            let [low, high] = [at - reach, at + reach].map(pxfm::f_atan);
            match reach < 2.0 {
                true => x.composed(series, 1.0 / TERMS as f64).narrower(low, high),
                false => Self::within(low, high),
            }
        },
        exp: {
            let (at, reach) = (x.terms[0], x.reach());
            let value = pxfm::f_exp(at);
            let [low, high] = [at - reach, at + reach].map(pxfm::f_exp);
            let series = [1.0, 1.0, 2.0, 6.0, 24.0, 120.0].map(|n| value / n);
            match high.is_finite() {
                true => x.composed(series, high / 720.0).narrower(low, high),
                false => Self::UNBOUNDED,
            }
        },
        ln: {
            let (at, reach) = (x.terms[0], x.reach());
            if at + reach <= 0.0 {
                return Self::from_f64(f64::NAN);
            }
            let low = at - reach;
            if low <= 0.0 {
                return Self::UNBOUNDED;
            }
            let series = std::array::from_fn(|n| match n {
                0 => pxfm::f_log(at),
                n => -(-1f64 / at).powi(n as i32) / n as f64,
            });
            let next = low.powi(-(TERMS as i32)) / TERMS as f64;
            x.composed(series, next).narrower(pxfm::f_log(low), pxfm::f_log(at + reach))
        },
        abs: {
            let [low, high] = x.range();
            match (low >= 0.0, high <= 0.0) {
                (true, _) => x,
                (_, true) => -x,
                _ => Self::within(0.0, high.max(-low)),
            }
        },
    );
    /// Angle on the branch that is continuous about its constant term.
    fn atan2(self, x: Self) -> Self {
        let (at_y, at_x) = (self.terms[0], x.terms[0]);
        let angle = Number::atan2(at_y, at_x);
        let along = x.scale(at_x) + self.scale(at_y);
        let across = self.scale(at_x) - x.scale(at_y);
        match along.range()[0] > 0.0 {
            true => (across / along).atan() + Self::from_f64(angle),
            false => Self::within(angle - PI, angle + PI),
        }
    }
    /// Hull of both branches where the comparison is not decided.
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        let [low, high] = (self - other).range();
        if high < 0.0 {
            return then;
        }
        if low >= 0.0 {
            return otherwise;
        }
        let half = (then - otherwise).scale(0.5);
        let mut middle = (then + otherwise).scale(0.5);
        let [low, high] = half.range();
        middle.rest += high.max(-low);
        middle
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.terms.iter().all(|term| term.is_finite())
    }
    #[inline]
    fn scale(self, factor: f64) -> Self {
        Taylor {
            terms: self.terms.map(|term| factor * term),
            rest: factor.abs() * self.rest,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::number::sorting::sort_by;

    /// The number of the angle among the functions.
    const ANGLE: usize = 13;

    /// Every function over a model holds the values of the function, and over a short range little more.
    #[test]
    fn a_model_holds_all_values_of_a_function() {
        fn all<T: Number>(x: T) -> Vec<T> {
            let n = T::from_f64;
            let y = n(0.3) - x * x;
            vec![
                x * y,
                x / (y + n(2.5)),
                x.sin_cos().0,
                (n(20.0) * x).sin_cos().1,
                (x + n(1.2)).sqrt(),
                (x.scale(0.6)).asin(),
                (x.scale(0.6)).acos(),
                (n(3.0) * x).atan(),
                x.exp(),
                (x + n(1.5)).ln(),
                (x - n(0.2)).abs(),
                x.lesser(y),
                x.greater(y),
                y.atan2(x - n(2.0)),
                (x + n(2.0)).powi(5),
                (x + n(2.0)).powf(n(1.7)),
                x.sin_cos().0.powi(2) + x.sin_cos().1.powi(2),
            ]
        }
        for radius in [1.0, 0.3, 0.02] {
            for k in -8..=8 {
                let centre = (1.0 - radius) * f64::from(k) / 8.0;
                let mut x = Taylor::from_f64(centre);
                x.terms[1] = radius;
                let models = all(x);
                for j in -10..=10 {
                    let t = f64::from(j) / 10.0;
                    for (i, (model, value)) in
                        models.iter().zip(all(centre + radius * t)).enumerate()
                    {
                        let [low, high] = model.range();
                        // an angle goes on where its principal value jumps
                        let turns = if i == ANGLE {
                            (model.terms[0] - value) / TAU
                        } else {
                            0.0
                        };
                        let value = value + TAU * turns.round();
                        let slack = 1e-13 * (1.0 + value.abs());
                        assert!(
                            low - slack <= value && value <= high + slack,
                            "{i} at {centre} ± {radius}: {value} is not from {low} to {high}"
                        );
                        assert!((model.at(t) - value).abs() <= model.rest + slack);
                    }
                }
                let widths = models.iter().map(|model| model.rest);
                let mut widths: Vec<f64> = widths.collect();
                sort_by(&mut widths, f64::total_cmp);
                // but for those at a kink
                assert!(
                    radius > 0.1 || widths[widths.len() - 4] < 1e-3,
                    "{widths:?}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_bound_or_no_value_says_so() {
        let mut x = Taylor::zero();
        x.terms[1] = 1.0;
        assert!((Taylor::one() / x).rest.is_infinite());
        assert!(((Taylor::one() / x) * Taylor::zero()).rest.is_infinite());
        assert!(x.ln().rest.is_infinite());
        assert!(!(x - Taylor::from_f64(2.0)).ln().is_finite());
        assert!(!(x - Taylor::from_f64(2.0)).sqrt().is_finite());
        assert_eq!(x.sqrt().range(), [0.0, 1.0]);
    }
}
