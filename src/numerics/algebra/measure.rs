//! The dimension of an expression (length, angle, none), as far as its units determine it.

use crate::number::tolerance::ROUNDING;
use thiserror::Error;

use super::{Constant, Expression, ExpressionError, Function, Node, Operator, SiUnit, Unit};

/// The dimension of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Measure {
    /// A number, which may have any dimension.
    Number,
    /// An angle.
    Angle,
    /// A length.
    Length,
    /// A force.
    Force,
    /// A moment; it has no unit that is one word.
    Moment,
    /// A quantity with another unit: a mass, a time, a pressure.
    Other(SiUnit),
    /// Not determined by units.
    Open,
}

/// A unit that does not fit, with the part of the expression that has it.
pub type MeasureError = ExpressionError<MeasureErrorKind>;

/// Reasons for which a unit does not fit.
#[derive(Debug, Clone, Copy, Error, PartialEq)]
#[allow(missing_docs)]
pub enum MeasureErrorKind {
    #[error("expected {}, found {}", wanted.words(), found.words())]
    Wrong { wanted: Measure, found: Measure },
    #[error("an angle and a length are mixed")]
    Mixed,
    #[error("{} and {} are mixed", named(*_0), named(*_1))]
    Units(SiUnit, SiUnit),
    /// A unit instead of the one that is wanted.
    #[error("expected {}, found {}", named(*_0), named(*_1))]
    Instead(SiUnit, SiUnit),
    #[error("`{}` takes {}, not {}", _0.word(), if _0.takes_angle() { "an angle" } else { "a plain number" }, named(*_1))]
    Argument(Function, SiUnit),
    #[error("`{}` takes an angle, not a length", _0.word())]
    LengthAsAngle(Function),
    /// A number without unit, in rad, that is more than two turns.
    #[error("{_0} without a unit is in rad, which is {:.1} turns", (_0 / std::f64::consts::TAU).abs())]
    BareAngle(f64),
    /// A number without unit, in rad/s, given as the rate of an angle and more than two turns a second.
    #[error("{_0} without a unit is in rad/s, which is {:.1} turns per second", (_0 / std::f64::consts::TAU).abs())]
    BareRate(f64),
}

/// The largest angle, in rad, that a number without a unit may be: larger ones are mostly meant in degrees.
pub const LARGEST_BARE: f64 = 2.0 * std::f64::consts::TAU;

/// A unit in a sentence.
fn named(unit: SiUnit) -> String {
    match unit {
        SiUnit::ONE => "a plain number".into(),
        unit => unit.to_string(),
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
            Measure::Other(unit) => Some(unit),
        }
    }

    /// The dimension with its article: `an angle`.
    pub fn words(self) -> &'static str {
        match self {
            Measure::Number | Measure::Open => "a number",
            Measure::Angle => "an angle",
            Measure::Length => "a length",
            Measure::Force => "a force",
            Measure::Moment => "a moment",
            Measure::Other(SiUnit::KILOGRAM) => "a mass",
            Measure::Other(SiUnit::SECOND) => "a time",
            Measure::Other(SiUnit::PASCAL) => "a pressure",
            Measure::Other(SiUnit::PER_SECOND) => "a speed of rotation",
            Measure::Other(_) => "another quantity",
        }
    }
}

impl Unit {
    /// The dimension of a number with this unit.
    pub fn measure(self) -> Measure {
        match self {
            Self::Degree | Self::Radian | Self::Revolution => Measure::Angle,
            Self::Millimetre | Self::Centimetre | Self::Metre | Self::Inch => Measure::Length,
            Self::Newton | Self::Kilonewton | Self::PoundForce => Measure::Force,
            Self::Kilogram | Self::Gram | Self::Pound => Measure::Other(SiUnit::KILOGRAM),
            Self::Second | Self::Millisecond => Measure::Other(SiUnit::SECOND),
            Self::Pascal | Self::Megapascal | Self::Bar => Measure::Other(SiUnit::PASCAL),
            Self::TurnPerMinute => Measure::Other(SiUnit::PER_SECOND),
        }
    }
}

impl<N> Expression<N> {
    /// Refuses units that do not fit `wanted`; `of` gives the dimension of each name.
    ///
    /// Units decide in a number with its unit, in sums, and in products with plain numbers. What
    /// has a name without a unit as a factor, products and quotients of two units, powers and
    /// inverse functions are not followed further: they fit anywhere,
    /// but for forces and times in an angle or a length.
    ///
    /// # Errors
    /// With the first part whose unit does not fit.
    pub fn check_measure(
        &self,
        wanted: Measure,
        of: &impl Fn(&N) -> Measure,
    ) -> Result<(), MeasureError> {
        let found = self.measure(of)?;
        let wrong = |found| Err(self.refused(MeasureErrorKind::Wrong { wanted, found }));
        match found {
            _ if found == wanted => Ok(()),
            Measure::Number => Ok(()),
            // an angle or a length has neither forces nor times in it
            Measure::Open if matches!(wanted, Measure::Angle | Measure::Length) => {
                match self.unit(&|name| of(name).si_unit()) {
                    Ok(Some(unit)) if !unit.is_spatial() => wrong(Measure::Other(unit)),
                    _ => Ok(()),
                }
            }
            Measure::Open => Ok(()),
            found => wrong(found),
        }
    }

    /// The dimension of the expression.
    ///
    /// # Errors
    /// If an angle and a length are combined where both must have the same dimension.
    pub fn measure(&self, of: &impl Fn(&N) -> Measure) -> Result<Measure, MeasureError> {
        use Measure::{Length, Number, Open};
        Ok(match &self.node {
            Node::Number(_) => Number,
            Node::Quantity(_, unit) => unit.measure(),
            Node::Constant(Constant::Pi) => Number,
            Node::Constant(Constant::Degree | Constant::Radian) => Measure::Angle,
            // a parameter without unit may be in m or rad
            Node::Name(name) => match of(name) {
                Number => Open,
                known => known,
            },
            Node::Negate(x) => x.measure(of)?,
            Node::Binary(operator, x, y) => {
                let (x, y) = (x.measure(of)?, y.measure(of)?);
                match (operator, x, y) {
                    (Operator::Add | Operator::Subtract, ..) => self.same(x, y)?,
                    (Operator::Multiply, Number, other) | (Operator::Multiply, other, Number) => {
                        other
                    }
                    (Operator::Divide, other, Number) => other,
                    (Operator::Power, Number, Number) => Number,
                    _ => Open,
                }
            }
            Node::Call(function, arguments) => {
                let measures = arguments.iter().map(|argument| argument.measure(of));
                let measures = measures.collect::<Result<Vec<Measure>, _>>()?;
                let all = (measures.iter()).try_fold(Number, |all, &next| self.same(all, next));
                if let (Function::Sin | Function::Cos | Function::Tan, Node::Number(x)) =
                    (function, &arguments[0].node)
                {
                    arguments[0].check_angle(*x, &|_| true)?;
                }
                match function {
                    Function::Sin | Function::Cos | Function::Tan if measures[0] == Length => {
                        return Err(self.refused(MeasureErrorKind::LengthAsAngle(*function)));
                    }
                    Function::Abs | Function::Hypot | Function::Min | Function::Max => all?,
                    Function::If => self.same(measures[1], measures[2])?,
                    Function::Atan2 => all.map(|_| Open)?,
                    Function::Sin | Function::Cos | Function::Tan => Number,
                    _ => Open,
                }
            }
        })
    }

    /// The common dimension of two parts.
    fn same(&self, x: Measure, y: Measure) -> Result<Measure, MeasureError> {
        match (x, y) {
            (Measure::Number, other) | (other, Measure::Number) => Ok(other),
            (Measure::Open, other) | (other, Measure::Open) => Ok(other),
            _ if x == y => Ok(x),
            _ => Err(self.refused(MeasureErrorKind::Mixed)),
        }
    }

    /// Refuses a number without a unit as an angle of more than two turns. `says` is true for names whose definition
    /// contains a unit or `pi`.
    ///
    /// # Errors
    /// With the whole expression.
    pub fn check_angle(&self, value: f64, says: &impl Fn(&N) -> bool) -> Result<(), MeasureError> {
        // rounding does not decide at two turns
        let doubtful = value.abs() > LARGEST_BARE * (1.0 + ROUNDING);
        match doubtful && self.is_bare(says) {
            true => Err(self.refused(MeasureErrorKind::BareAngle(value))),
            false => Ok(()),
        }
    }

    /// True if no unit, no `pi`, no name that `says` and no inverse trigonometric function shows that the number is an
    /// angle in rad.
    pub fn is_bare(&self, says: &impl Fn(&N) -> bool) -> bool {
        match &self.node {
            Node::Number(_) => true,
            Node::Quantity(..) | Node::Constant(_) => false,
            Node::Name(name) => !says(name),
            Node::Negate(x) => x.is_bare(says),
            Node::Binary(_, x, y) => x.is_bare(says) && y.is_bare(says),
            Node::Call(Function::Asin | Function::Acos | Function::Atan | Function::Atan2, _) => {
                false
            }
            Node::Call(_, arguments) => arguments.iter().all(|argument| argument.is_bare(says)),
        }
    }

    pub(super) fn refused(&self, kind: MeasureErrorKind) -> MeasureError {
        let span = self.span.clone();
        MeasureError { span, kind }
    }
}
