//! What stands in a cell of a table.

use serde::{Deserialize, Serialize};

use crate::output::quantity::{coarse, degrees, number, short, size};

/// What stands in a cell of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cell {
    /// Nothing.
    #[default]
    Empty,
    /// Words.
    Text(String),
    /// A whole number.
    Count(i64),
    /// A number.
    Number {
        /// The value, in SI units and rad.
        value: f64,
        /// Its unit: `rad`, `m`, `N`, `rad/s` …; empty if it has none or its column says it.
        unit: String,
        /// How much of it is shown.
        digits: Digits,
        /// A sign behind it that refers to a remark; may be empty.
        mark: String,
    },
    /// A point or direction.
    Vector {
        /// Its components.
        components: Vec<f64>,
        /// The unit of all of them; may be empty.
        unit: String,
        /// How much of them is shown.
        digits: Digits,
    },
}

/// How much of a number is shown to readers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Digits {
    /// Six decimals, without noughts at the end.
    #[default]
    Six,
    /// Four decimals, for components of points and directions.
    Four,
    /// About two digits, of numbers whose size alone matters.
    Two,
    /// One digit, of estimates.
    One,
}

impl Digits {
    /// The number with that many digits.
    pub fn of(self, value: f64) -> String {
        match self {
            Digits::Six => number(value),
            Digits::Four => short(value),
            Digits::Two => size(value),
            Digits::One => coarse(value),
        }
    }
}

impl Cell {
    /// A number without a unit, or with that of its column. One that is infinite or not known is
    /// said in words.
    pub fn number(value: f64) -> Self {
        Cell::quantity(value, "")
    }

    /// A number with its unit. Angles, which are given in `rad`, are shown in degrees.
    pub fn quantity(value: f64, unit: impl ToString) -> Self {
        match value {
            _ if value.is_nan() => Cell::Text("not known".into()),
            _ if value.is_infinite() => Cell::Text("infinite".into()),
            _ => Cell::Number {
                value,
                unit: unit.to_string(),
                digits: Digits::Six,
                mark: String::new(),
            },
        }
    }

    /// A number whose size alone matters, such as a condition number.
    pub fn size(value: f64) -> Self {
        Cell::number(value).with(Digits::Two)
    }

    /// A point or direction, with four decimals.
    pub fn vector(components: impl IntoIterator<Item = f64>) -> Self {
        Cell::Vector {
            components: components.into_iter().collect(),
            unit: String::new(),
            digits: Digits::Four,
        }
    }

    /// With a unit.
    #[must_use]
    pub fn in_unit(mut self, wanted: impl ToString) -> Self {
        if let Cell::Number { unit, .. } | Cell::Vector { unit, .. } = &mut self {
            *unit = wanted.to_string();
        }
        self
    }

    /// With that many digits.
    #[must_use]
    pub fn with(mut self, wanted: Digits) -> Self {
        if let Cell::Number { digits, .. } | Cell::Vector { digits, .. } = &mut self {
            *digits = wanted;
        }
        self
    }

    /// With a sign behind it.
    #[must_use]
    pub fn marked(mut self, sign: &str) -> Self {
        if let Cell::Number { mark, .. } = &mut self {
            *mark = sign.into();
        }
        self
    }

    /// What is shown.
    pub fn shown(&self) -> String {
        match self {
            Cell::Empty => String::new(),
            Cell::Text(text) => text.clone(),
            Cell::Count(count) => count.to_string(),
            Cell::Number {
                value,
                unit,
                digits,
                mark,
            } => match unit.as_str() {
                "rad" if *digits == Digits::Six => degrees(*value) + mark,
                "rad" => format!("{}°{mark}", digits.of(value.to_degrees())),
                "" => digits.of(*value) + mark,
                unit => format!("{}{mark} {unit}", digits.of(*value)),
            },
            Cell::Vector {
                components,
                unit,
                digits,
            } => {
                let components = components.iter().map(|&x| digits.of(x));
                let components = components.collect::<Vec<_>>().join(", ");
                let space = if unit.is_empty() { "" } else { " " };
                format!("({components}){space}{unit}")
            }
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        match text {
            "" => Cell::Empty,
            text => Cell::Text(text.into()),
        }
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        match text.is_empty() {
            true => Cell::Empty,
            false => Cell::Text(text),
        }
    }
}

impl From<&String> for Cell {
    fn from(text: &String) -> Self {
        text.as_str().into()
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Cell::number(value)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Cell::Count(i64::try_from(count).unwrap_or(i64::MAX))
    }
}

impl From<[f64; 3]> for Cell {
    fn from(components: [f64; 3]) -> Self {
        Cell::vector(components)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Self {
        cell.map_or(Cell::Empty, Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_shown_with_their_units() {
        let angle = std::f64::consts::FRAC_PI_3;
        assert_eq!(Cell::quantity(angle, "rad").shown(), "60°");
        assert_eq!(Cell::quantity(0.25, "rad/s").shown(), "0.25 rad/s");
        assert_eq!(Cell::quantity(2.0, "N").marked("*").shown(), "2* N");
        assert_eq!(Cell::size(1e9).shown(), "1.0e9");
        assert_eq!(Cell::size(f64::INFINITY).shown(), "infinite");
        assert_eq!(
            Cell::vector([0.0, 1.0 / 3.0, 2.0]).shown(),
            "(0, 0.3333, 2)"
        );
        assert_eq!(Cell::from(None::<f64>).shown(), "");
    }
}
