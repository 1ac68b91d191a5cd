//! The units of numbers in reports.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Measure;

/// A unit made of rad, N, m and s, each to a whole power.
///
/// It is written, printed and serialised as text: `rad`, `m`, `N·m`, `rad/s`, `m/s²`, `rad·m²`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SiUnit {
    radian: i8,
    newton: i8,
    metre: i8,
    second: i8,
}

/// A text that is not a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SiUnitError {
    /// The text.
    pub text: String,
}

impl SiUnit {
    /// No unit: a ratio or a count; written as an empty text.
    pub const ONE: Self = Self::new(0, 0, 0, 0);
    /// An angle.
    pub const RADIAN: Self = Self::new(1, 0, 0, 0);
    /// A length.
    pub const METRE: Self = Self::new(0, 0, 1, 0);
    /// A force.
    pub const NEWTON: Self = Self::new(0, 1, 0, 0);
    /// A moment.
    pub const NEWTON_METRE: Self = Self::new(0, 1, 1, 0);

    const fn new(radian: i8, newton: i8, metre: i8, second: i8) -> Self {
        SiUnit {
            radian,
            newton,
            metre,
            second,
        }
    }

    /// The unit of a coordinate: rad for an angle, m for a length.
    pub fn of_coordinate(is_angle: bool) -> Self {
        match is_angle {
            true => Self::RADIAN,
            false => Self::METRE,
        }
    }

    /// The unit of what acts along a coordinate: N·m about an axis, N along one.
    pub fn of_effort(is_angle: bool) -> Self {
        match is_angle {
            true => Self::NEWTON_METRE,
            false => Self::NEWTON,
        }
    }

    /// Whether it is the unit of an angle.
    pub fn is_angle(self) -> bool {
        self == Self::RADIAN
    }

    /// The unit of a rate of change.
    pub fn per_second(self) -> Self {
        SiUnit {
            second: self.second - 1,
            ..self
        }
    }

    /// The unit of a product.
    pub fn times(self, other: Self) -> Self {
        Self::new(
            self.radian + other.radian,
            self.newton + other.newton,
            self.metre + other.metre,
            self.second + other.second,
        )
    }

    fn powers(self) -> [(&'static str, i8); 4] {
        [
            ("rad", self.radian),
            ("N", self.newton),
            ("m", self.metre),
            ("s", self.second),
        ]
    }
}

impl Measure {
    /// The unit of its values in reports, if it has one.
    pub fn si_unit(self) -> Option<SiUnit> {
        match self {
            Measure::Number | Measure::Open => None,
            Measure::Angle => Some(SiUnit::RADIAN),
            Measure::Length => Some(SiUnit::METRE),
            Measure::Force => Some(SiUnit::NEWTON),
            Measure::Moment => Some(SiUnit::NEWTON_METRE),
        }
    }
}

/// Digits of powers; a first power is not written.
const POWERS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

impl Display for SiUnit {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let side = |sign: i8| {
            let parts = self
                .powers()
                .into_iter()
                .filter(|(_, power)| sign * power > 0);
            let parts = parts.map(|(name, power)| match power.unsigned_abs() {
                1 => name.to_owned(),
                power => format!("{name}{}", POWERS[usize::from(power).min(9)]),
            });
            parts.collect::<Vec<String>>().join("·")
        };
        let (above, below) = (side(1), side(-1));
        match (above.is_empty(), below.is_empty()) {
            (true, true) => f.pad(""),
            (false, true) => f.pad(&above),
            (true, false) => f.pad(&format!("1/{below}")),
            (false, false) => f.pad(&format!("{above}/{below}")),
        }
    }
}

impl FromStr for SiUnit {
    type Err = SiUnitError;

    fn from_str(text: &str) -> Result<Self, SiUnitError> {
        let wrong = || SiUnitError { text: text.into() };
        let (above, below) = match text.split_once('/') {
            Some((above, below)) => (above, Some(below)),
            None => (text, None),
        };
        let mut unit = SiUnit::ONE;
        if text.is_empty() {
            return Ok(SiUnit::ONE);
        }
        let above = above.split('·').filter(|part| *part != "1");
        let below = below.into_iter().flat_map(|below| below.split('·'));
        for (part, sign) in above
            .map(|part| (part, 1))
            .chain(below.map(|part| (part, -1)))
        {
            let name = part.trim_end_matches(POWERS);
            let power = match part[name.len()..].chars().collect::<Vec<char>>()[..] {
                [] => 1,
                [digit] => POWERS.iter().position(|d| *d == digit).ok_or_else(wrong)? as i8,
                _ => return Err(wrong()),
            };
            let own = match name {
                "rad" => &mut unit.radian,
                "N" => &mut unit.newton,
                "m" => &mut unit.metre,
                "s" => &mut unit.second,
                _ => return Err(wrong()),
            };
            *own += sign * power;
        }
        Ok(unit)
    }
}

impl Display for SiUnitError {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "`{}` is not a unit such as rad, m/s or N·m", self.text)
    }
}

impl std::error::Error for SiUnitError {}

impl Serialize for SiUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for SiUnit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_as_they_are_written() {
        let units = [
            (SiUnit::ONE, ""),
            (SiUnit::RADIAN, "rad"),
            (SiUnit::METRE.per_second(), "m/s"),
            (SiUnit::RADIAN.per_second().per_second(), "rad/s²"),
            (SiUnit::NEWTON_METRE, "N·m"),
            (
                SiUnit::RADIAN.times(SiUnit::METRE).times(SiUnit::METRE),
                "rad·m²",
            ),
        ];
        for (unit, text) in units {
            assert_eq!(unit.to_string(), text);
            assert_eq!(text.parse(), Ok(unit));
        }
        for text in ["kg", "m²²", "m/", "metre"] {
            assert!(text.parse::<SiUnit>().is_err(), "{text}");
        }
    }
}
