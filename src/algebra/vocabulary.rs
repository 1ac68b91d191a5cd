//! The constants, units and functions known to every expression.

use crate::number::Number;

/// A constant that has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Constant {
    /// π
    Pi,
    /// One degree in radians, π/180.
    Degree,
    /// One radian, 1.
    Radian,
}

impl Constant {
    /// Every constant.
    pub const ALL: [Self; 3] = [Self::Pi, Self::Degree, Self::Radian];

    /// How it is written.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pi => "pi",
            Self::Degree => "deg",
            Self::Radian => "rad",
        }
    }

    /// The constant written `word`.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|constant| constant.word() == word)
    }

    /// Its value over any number.
    pub fn over<T: Number>(self) -> T {
        match self {
            Self::Pi => T::pi(),
            Self::Degree => T::degrees(1.0),
            Self::Radian => T::one(),
        }
    }
}

/// A unit that may follow a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Unit {
    /// Degree.
    Degree,
    /// Radian.
    Radian,
    /// Millimetre.
    Millimetre,
    /// Centimetre.
    Centimetre,
    /// Metre.
    Metre,
    /// Inch, 25.4 mm.
    Inch,
}

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 6] = [
        Self::Degree,
        Self::Radian,
        Self::Millimetre,
        Self::Centimetre,
        Self::Metre,
        Self::Inch,
    ];

    /// How it is written.
    pub fn word(self) -> &'static str {
        match self {
            Self::Degree => "deg",
            Self::Radian => "rad",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
        }
    }

    /// The unit written `word`.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.word() == word)
    }

    /// `value` of this unit in radians or metres, over any number.
    pub fn over<T: Number>(self, value: f64) -> T {
        match self {
            Self::Degree => T::degrees(value),
            _ => T::from_f64(self.to_si(value)),
        }
    }

    /// `value` of this unit in radians or metres.
    pub fn to_si(self, value: f64) -> f64 {
        // Division by a power of ten rounds once; multiplication by its inexact reciprocal would round twice.
        match self {
            Self::Degree => value.to_radians(),
            Self::Radian | Self::Metre => value,
            Self::Millimetre => value / 1000.0,
            Self::Centimetre => value / 100.0,
            Self::Inch => value * 254.0 / 10000.0,
        }
    }
}

/// A function that an expression may call. Angles are in radians.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    /// `atan2(y, x)`
    Atan2,
    Sqrt,
    Exp,
    Ln,
    Abs,
    Hypot,
    Min,
    Max,
}

impl Function {
    /// Every function.
    pub const ALL: [Self; 14] = [
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Atan2,
        Self::Sqrt,
        Self::Exp,
        Self::Ln,
        Self::Abs,
        Self::Hypot,
        Self::Min,
        Self::Max,
    ];

    /// How it is written.
    pub fn word(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Atan2 => "atan2",
            Self::Sqrt => "sqrt",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
            Self::Hypot => "hypot",
            Self::Min => "min",
            Self::Max => "max",
        }
    }

    /// The function written `word`.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|function| function.word() == word)
    }

    /// How many arguments it takes.
    pub fn arity(self) -> usize {
        match self {
            Self::Atan2 | Self::Hypot | Self::Min | Self::Max => 2,
            _ => 1,
        }
    }
}

/// Whether `text` can be used as a name in an expression (it may still be reserved).
pub fn is_name(text: &str) -> bool {
    text.starts_with(starts_name) && text.chars().all(continues_name)
}

/// Whether `text` already means something in every expression: `pi`, `deg`, `rad` or a function.
pub fn is_reserved(text: &str) -> bool {
    Constant::from_word(text).is_some() || Function::from_word(text).is_some()
}

pub(super) fn starts_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

pub(super) fn continues_name(c: char) -> bool {
    // Subscripts belong to names (θ₁); superscripts do not, because x² reads as a square.
    starts_name(c) && !is_superscript(c) || c.is_ascii_digit() || ('₀'..='₉').contains(&c)
}

fn is_superscript(c: char) -> bool {
    matches!(c, 'ⁿ' | 'ⁱ' | 'ª' | 'º')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_lead_back_to_what_they_name() {
        assert!(
            Function::ALL
                .into_iter()
                .all(|f| Function::from_word(f.word()) == Some(f))
        );
        assert!(
            Unit::ALL
                .into_iter()
                .all(|u| Unit::from_word(u.word()) == Some(u))
        );
        assert!(
            Constant::ALL
                .into_iter()
                .all(|c| Constant::from_word(c.word()) == Some(c))
        );
    }

    #[test]
    fn names_may_be_greek_and_subscripted_but_not_superscripted() {
        assert!(
            ["phi1", "_", "θ", "θ₁", "l_12", "Ä"]
                .into_iter()
                .all(is_name)
        );
        assert!(
            !["", "1a", "x²", "a-b", "a.b", "a b", "x'"]
                .into_iter()
                .any(is_name)
        );
    }

    #[test]
    fn right_angles_and_round_lengths_are_exact() {
        assert_eq!(Unit::Degree.to_si(90.0), std::f64::consts::FRAC_PI_2);
        assert_eq!(Unit::Millimetre.to_si(100.0), 0.1);
        assert_eq!(Unit::Inch.to_si(1.0), 0.0254);
        assert_eq!(Unit::Centimetre.to_si(7.0), 0.07);
    }
}
