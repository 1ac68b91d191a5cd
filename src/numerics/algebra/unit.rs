//! Units that may follow a number: how they are written, and their value in SI.

use super::words;
use crate::number::Number;

words! {
    /// A unit that may follow a number.
    Unit {
        /// Degree.
        Degree = "deg",
        /// Radian.
        Radian = "rad",
        /// Metre.
        Metre = "m",
        /// Centimetre.
        Centimetre = "cm",
        /// Millimetre.
        Millimetre = "mm",
        /// Inch, 25.4 mm.
        Inch = "in",
        /// Kilogram.
        Kilogram = "kg",
        /// Gram.
        Gram = "g",
        /// Pound, 0.45359237 kg.
        Pound = "lb",
        /// Newton.
        Newton = "N",
        /// Kilonewton.
        Kilonewton = "kN",
        /// Pound-force, 4.4482216152605 N.
        PoundForce = "lbf",
        /// Second.
        Second = "s",
        /// Millisecond.
        Millisecond = "ms",
        /// Pascal, N/m².
        Pascal = "Pa",
        /// Megapascal.
        Megapascal = "MPa",
        /// Bar, 100000 Pa.
        Bar = "bar",
        /// Turn, 2π rad.
        Revolution = "rev",
        /// Turn per minute, π/30 rad/s.
        TurnPerMinute = "rpm",
    }
}

/// The ends of a range as they are written: the unit of one counts for the other where that is a mere number, as in
/// `10..80 deg`.
pub fn ends_with_one_unit(ends: [&str; 2]) -> [String; 2] {
    let parts = ends.map(|end| {
        let is_number = |text: &str| {
            text.ends_with(|c: char| c.is_ascii_digit() || c == '.') && text.parse::<f64>().is_ok()
        };
        let text = end.trim();
        let mut cuts = text.char_indices().map(|(at, _)| at).chain([text.len()]);
        let cut = cuts.rfind(|at| is_number(&text[..*at]))?;
        let unit = text[cut..].trim();
        (unit.is_empty() || unit == "°" || Unit::from_word(unit).is_some()).then_some(unit)
    });
    let [Some(from), Some(to)] = parts else {
        return ends.map(str::to_owned);
    };
    let written = |end: &str, own: &str, other: &str| match own {
        "" => format!("{end} {other}").trim_end().to_owned(),
        _ => end.to_owned(),
    };
    [written(ends[0], from, to), written(ends[1], to, from)]
}

impl Unit {
    /// `value` of this unit in rad, m, kg, N, s and their products, over any number.
    pub fn over<T: Number>(self, value: f64) -> T {
        match self {
            Self::Degree => T::degrees(value),
            _ => T::from_f64(self.to_si(value)),
        }
    }

    /// `value` of this unit in rad, m, kg, N, s and their products.
    pub fn to_si(self, value: f64) -> f64 {
        // Division by a power of ten rounds once; multiplication by its inexact reciprocal would round twice.
        match self {
            Self::Degree => value.to_radians(),
            Self::Radian | Self::Metre | Self::Kilogram | Self::Newton => value,
            Self::Second | Self::Pascal => value,
            Self::Millimetre | Self::Gram | Self::Millisecond => value / 1000.0,
            Self::Kilonewton => value * 1000.0,
            Self::Megapascal => value * 1e6,
            Self::Bar => value * 1e5,
            Self::Pound => value * 0.453_592_37,
            Self::PoundForce => value * 4.448_221_615_260_5,
            Self::Revolution => value * std::f64::consts::TAU,
            Self::TurnPerMinute => value * std::f64::consts::PI / 30.0,
            Self::Centimetre => value / 100.0,
            Self::Inch => value * 254.0 / 10000.0,
        }
    }
}
