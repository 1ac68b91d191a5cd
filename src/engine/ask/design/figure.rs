//! Figures of quantities over a motion, which a design bounds or improves.

use crate::algebra::{Measure, SiUnit};
use crate::analysis::sweep::{Extreme, Extremum};
use crate::description::{DesignProblem, Entry};
use crate::mechanism::{Measured, Mechanism, Quantity, QuantityError};
use crate::number::Interval;
use crate::system::Value;

/// A figure of the values that a quantity takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Statistic {
    Least,
    Greatest,
    Range,
    Mean,
    Rms,
    /// The largest distance of a point's path from a straight line.
    Straightness,
    /// The longest part of the motion, as a share, over which a quantity stays within a tolerance of one value.
    Dwell,
}

/// A figure of a quantity.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    pub over: Statistic,
    /// The figure, as it was asked for.
    pub name: String,
    pub unit: SiUnit,
    /// The text of the quantity, or the point.
    pub text: String,
    /// The quantity, or a coordinate of the point.
    quantity: Quantity,
    /// The tolerance of a dwell.
    pub tolerance: String,
}

/// The values of a quantity along a motion, or in positions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Observed {
    /// The weight of its means.
    pub duration: f64,
    /// The least and the greatest, unless there is none or there may be values beyond it.
    pub ends: Option<[f64; 2]>,
    /// The mean and that of the squares.
    pub means: Option<[f64; 2]>,
    /// The straightness or the dwell that was asked for.
    pub along: Option<f64>,
}

impl Figure {
    /// Words of figures, as functions of a quantity.
    const WORDS: [(&str, Statistic); 8] = [
        ("min", Statistic::Least),
        ("max", Statistic::Greatest),
        ("range", Statistic::Range),
        ("mean", Statistic::Mean),
        ("rms", Statistic::Rms),
        ("stroke", Statistic::Range),
        ("straightness", Statistic::Straightness),
        ("dwell", Statistic::Dwell),
    ];

    /// Reads a quantity, or a figure of it as in `max(force:theta1)`; of a quantity alone the figure is `otherwise`.
    pub fn read(
        mechanism: &Mechanism,
        name: &str,
        otherwise: Option<Statistic>,
    ) -> Result<Option<Self>, QuantityError> {
        let split = Figure::WORDS.iter().find_map(|(word, over)| {
            let rest = name.trim().strip_prefix(word)?.trim_start();
            let inner = rest.strip_prefix('(')?.strip_suffix(')')?;
            match over {
                Statistic::Straightness => Some((*over, inner, "")),
                Statistic::Dwell => {
                    let (quantity, tolerance) = inner.rsplit_once(',')?;
                    Some((*over, quantity, tolerance.trim()))
                }
                _ => one_argument(inner).then_some((*over, inner, "")),
            }
        });
        let Some((over, text, tolerance)) = split.or(otherwise.map(|over| (over, name, ""))) else {
            return Ok(None);
        };
        let text = text.trim();
        let quantity = match over {
            Statistic::Straightness => {
                let frame = text.split('+').next().unwrap_or(text).trim();
                Quantity::read(mechanism, name, &format!("[{frame}].x"))?
            }
            _ => Quantity::read(mechanism, name, text)?,
        };
        let unit = quantity.unit;
        let measure = match unit {
            SiUnit::RADIAN => Measure::Angle,
            SiUnit::METRE => Measure::Length,
            _ => Measure::Number,
        };
        let allowed = Value::Text(tolerance.to_owned()).number(mechanism, measure);
        if over == Statistic::Dwell && allowed.is_err() {
            return Ok(None);
        }
        Ok(Some(Figure {
            over,
            name: name.to_owned(),
            unit: if over == Statistic::Dwell {
                SiUnit::ONE
            } else {
                unit
            },
            text: text.to_owned(),
            tolerance: tolerance.to_owned(),
            quantity,
        }))
    }

    /// Values beyond which it never is for parameters in intervals.
    pub fn possible(&self, parameters: &[Interval]) -> Interval {
        let value = self.quantity.expression.evaluate(&|of| match of {
            Measured::Parameter(i) => parameters[*i],
            other => other.possible(),
        });
        let of = value.unwrap_or(Interval {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
        });
        let (low, high) = match self.over {
            Statistic::Least | Statistic::Greatest | Statistic::Mean => return of,
            Statistic::Rms => (0.0, of.magnitude()),
            Statistic::Range => (0.0, of.width()),
            Statistic::Straightness => (0.0, f64::INFINITY),
            Statistic::Dwell => (0.0, 1.0),
        };
        Interval { low, high }
    }

    /// True for one of means.
    pub fn is_mean(&self) -> bool {
        matches!(self.over, Statistic::Mean | Statistic::Rms)
    }

    /// True for one of the motion as a whole, which parts of it do not tell.
    pub fn is_of_whole(&self) -> bool {
        matches!(self.over, Statistic::Straightness | Statistic::Dwell)
    }

    /// The figure of values seen; `None` if one of them is not known.
    pub fn of(&self, seen: &[Observed]) -> Option<f64> {
        let ends = || {
            let all: Option<Vec<[f64; 2]>> = seen.iter().map(|of| of.ends).collect();
            let both = all?.into_iter();
            both.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
        };
        let mean = |power: usize| {
            let time: f64 = seen.iter().map(|of| of.duration).sum();
            let parts = seen.iter().map(|of| Some(of.means?[power] * of.duration));
            Some(parts.sum::<Option<f64>>()? / time)
        };
        match self.over {
            Statistic::Least => Some(ends()?[0]),
            Statistic::Greatest => Some(ends()?[1]),
            Statistic::Range => ends().map(|[least, greatest]| greatest - least),
            Statistic::Mean => mean(0),
            Statistic::Rms => mean(1).map(f64::sqrt),
            Statistic::Straightness | Statistic::Dwell => match seen {
                [one] => one.along,
                _ => None,
            },
        }
    }
}

/// The value of an entry for a quantity of some unit.
pub(super) fn in_unit(
    mechanism: &Mechanism,
    unit: SiUnit,
    entry: &Entry,
) -> Result<f64, DesignProblem> {
    let measure = match unit {
        SiUnit::RADIAN => Measure::Angle,
        SiUnit::METRE => Measure::Length,
        _ => Measure::Number,
    };
    let text = entry.expression.to_string();
    let read = Value::Text(text.clone()).number(mechanism, measure);
    read.map_err(|error| {
        let why = error.to_string();
        DesignProblem::Value { text, why }
    })
}

/// The problem of a text that is no quantity.
pub(super) fn no_quantity(error: QuantityError) -> DesignProblem {
    let why = error.to_string();
    let suggestion = match error {
        QuantityError::Unknown { suggestion, .. } => suggestion,
        _ => None,
    };
    DesignProblem::Quantity { why, suggestion }
}

/// True for what is one argument in a pair of brackets.
fn one_argument(text: &str) -> bool {
    let mut depth = 0;
    for c in text.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => return false,
            _ => {}
        }
        if depth < 0 {
            return false;
        }
    }
    depth == 0
}

impl Observed {
    /// Values over a motion of some duration.
    pub fn of(extremum: &Extremum, duration: f64) -> Self {
        let all = extremum.unbounded.is_empty() && !extremum.at_least;
        let constant = extremum.constant;
        let value = |at: &Option<Extreme>| at.as_ref().map(|of| of.value);
        let end = |at: &Option<Extreme>| constant.or(value(at));
        let ends = || Some([end(&extremum.least)?, end(&extremum.greatest)?]);
        let square = |x: f64| x * x;
        let means = || {
            Some([
                constant.or(extremum.mean)?,
                square(constant.or(extremum.rms)?),
            ])
        };
        Observed {
            duration,
            ends: if all { ends() } else { None },
            means: means(),
            along: None,
        }
    }

    /// The value in one position.
    pub fn here(value: Option<f64>) -> Self {
        Observed {
            duration: 1.0,
            ends: value.map(|x| [x, x]),
            means: value.map(|x| [x, x * x]),
            along: None,
        }
    }
}
