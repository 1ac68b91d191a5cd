//! Numbers as people read them; JSON keeps every digit. Every unit that is printed comes from here.

use crate::algebra::SiUnit;
use crate::analysis::assemblies::ListedJoint;
use crate::analysis::workspace::{AxisReport, HeldReport};
use crate::description::{count, listed};
use crate::mechanism::Variable;
use crate::number::tolerance::WRITTEN_ZERO;
use crate::system::{Bound, NamedUnit};

/// A count with the minus sign of the formulas it stands in.
pub(super) fn signed(count: i64) -> String {
    count.to_string().replace('-', "−")
}

/// Six decimals without trailing zeros; the exponent form for what these cannot show.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value.is_nan() || (size != 0.0 && !(1e-4..1e7).contains(&size)) {
        return match size < WRITTEN_ZERO {
            true => "0".into(),
            false => format!("{value:.4e}"),
        };
    }
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".into(),
        text => text.into(),
    }
}

/// Four decimals at most, for components of directions and points.
pub(super) fn short(value: f64) -> String {
    number((value * 1e4).round() / 1e4)
}

/// A number as it is shown: that of an angle in degrees.
pub(super) fn shown(value: f64, unit: SiUnit) -> f64 {
    match unit.is_angle() {
        true if value.abs() < WRITTEN_ZERO => 0.0,
        true => value.to_degrees(),
        false => value,
    }
}

/// A number that is written already, with its unit: degrees where the unit is rad.
pub(super) fn with_unit(number: &str, unit: SiUnit) -> String {
    match unit {
        SiUnit::RADIAN => format!("{number}°"),
        SiUnit::ONE => number.into(),
        unit => format!("{number} {unit}"),
    }
}

/// A value in SI units as people read it, with its unit; angles in degrees.
pub fn quantity(value: f64, unit: SiUnit) -> String {
    with_unit(&number(shown(value, unit)), unit)
}

/// A quantity with three digits.
pub fn three_digits(value: f64, unit: SiUnit) -> String {
    quantity(format!("{value:.2e}").parse().unwrap_or(value), unit)
}

/// An angle in rad, shown in degrees.
pub(super) fn degrees(radians: f64) -> String {
    quantity(radians, SiUnit::RADIAN)
}

pub(super) fn metres(length: f64) -> String {
    quantity(length, SiUnit::METRE)
}

/// Something that has a name and numbers in a unit.
pub(super) trait Quantified {
    fn name(&self) -> &str;
    fn unit(&self) -> SiUnit;

    /// Header of a column of its numbers: `theta1 (rad)`.
    fn head(&self) -> String {
        Variable::new(self.name(), self.unit()).to_string()
    }

    /// `theta1 = 60°`
    fn at(&self, value: f64) -> String {
        at(self.name(), value, self.unit())
    }
}

macro_rules! quantified {
    ($($T:ty),+) => {$(
        impl Quantified for $T {
            fn name(&self) -> &str {
                &self.name
            }

            fn unit(&self) -> SiUnit {
                self.unit
            }
        }
    )+};
}

quantified!(
    Variable,
    NamedUnit,
    Bound,
    AxisReport,
    HeldReport,
    ListedJoint
);

/// `theta1 = 60°`
pub(super) fn at(name: &str, value: f64, unit: SiUnit) -> String {
    format!("{name} = {}", quantity(value, unit))
}

/// The values of variables: `theta1 = 60°`, `l1 = 0.5 m`.
pub(super) fn values<'v>(
    of: &[impl Quantified],
    values: impl IntoIterator<Item = &'v f64>,
) -> Vec<String> {
    let values = of.iter().zip(values);
    values.map(|(of, &value)| of.at(value)).collect()
}

/// `theta1 from 0° to 60°`
pub(super) fn range(name: &str, from: f64, to: f64, unit: SiUnit) -> String {
    let [from, to] = [from, to].map(|x| quantity(x, unit));
    format!("{name} from {from} to {to}")
}

/// The ranges of all: `theta1 from 0° to 60° and l1 from 0.5 m to 0.6 m`
pub(super) fn ranges(of: &[Bound]) -> String {
    listed(of.iter().map(|of| range(&of.name, of.from, of.to, of.unit)))
}

/// `(0, 0.5, -1)`, with four decimals at most; with more where all are small.
pub(super) fn triple(v: &[f64; 3]) -> String {
    let size = v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let one = |x: &f64| match size < 0.01 {
        true if x.abs() < 1e-4 * size => "0".into(),
        true => number(*x),
        false => short(*x),
    };
    format!("({})", v.each_ref().map(one).join(", "))
}

/// Numbers in ascending order, those that follow one another as `1 to 4`.
pub(super) fn runs(numbers: &[usize]) -> Vec<String> {
    let runs = numbers.chunk_by(|a, b| *b == a + 1);
    let runs = runs.flat_map(|run| match run {
        [first, _, .., last] => vec![format!("{first} to {last}")],
        few => few.iter().map(usize::to_string).collect(),
    });
    runs.collect()
}

/// The form of a word that goes with a number of things: `is` or `are`.
pub(super) fn form<'w>(number: usize, one: &'w str, many: &'w str) -> &'w str {
    match number {
        1 => one,
        _ => many,
    }
}

/// `1 freedom is` or `2 freedoms are`
pub(super) fn are(number: usize, noun: &str) -> String {
    format!("{} {}", count(number, noun), form(number, "is", "are"))
}

/// Names with the form of a verb that goes with their number: `a stands` or `a and b stand`
pub(super) fn clause<S: AsRef<str>>(names: &[S], one: &str, many: &str) -> String {
    format!("{} {}", listed(names), form(names.len(), one, many))
}

/// A phrase about names; empty if there are none.
pub(super) fn if_any<S: AsRef<str>>(names: &[S], said: impl FnOnce(String) -> String) -> String {
    match names {
        [] => String::new(),
        names => said(listed(names)),
    }
}

/// The power of ten above a size that is rounding, whose digits say nothing.
pub(super) fn bound(value: f64) -> String {
    const LEAST: i32 = -12;
    let power = (LEAST..300).find(|&power| value.abs() < 10f64.powi(power));
    power.map_or("infinity".into(), |power| format!("1e{power}"))
}

pub(super) fn size(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        _ if !value.is_finite() => "infinite".into(),
        _ if (0.1..1e4).contains(&value.abs()) => format!("{value:.1}"),
        _ => format!("{value:.1e}"),
    }
}

/// An estimate, of which one digit is known.
pub(super) fn coarse(value: f64) -> String {
    match (1e-3..1e3).contains(&value.abs()) {
        true => number(format!("{value:.0e}").parse().unwrap_or(value)),
        false => format!("{value:.0e}"),
    }
}
