//! Expression → text that reads back as the same tree.

use std::fmt::{self, Display, Formatter};

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Expression, Node, Operator};

/// The precedence of the outermost operation of an expression.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Precedence {
    Sum,
    Product,
    Sign,
    /// A number with a unit: as tight as an operand, except under a power, where the unit would be taken for the base.
    Quantity,
    Power,
    Operand,
}

impl Operator {
    /// The operator as it is written.
    pub fn symbol(self) -> char {
        match self {
            Self::Add => '+',
            Self::Subtract => '-',
            Self::Multiply => '*',
            Self::Divide => '/',
            Self::Power => '^',
        }
    }

    fn tightness(self) -> Precedence {
        match self {
            Self::Add | Self::Subtract => Precedence::Sum,
            Self::Multiply | Self::Divide => Precedence::Product,
            Self::Power => Precedence::Power,
        }
    }
}

impl<N> Expression<N> {
    fn tightness(&self) -> Precedence {
        match &self.node {
            Node::Number(value) if value.is_sign_negative() => Precedence::Sign,
            Node::Quantity(..) => Precedence::Quantity,
            Node::Number(_) | Node::Constant(_) | Node::Name(_) | Node::Call(..) => {
                Precedence::Operand
            }
            Node::Negate(_) => Precedence::Sign,
            Node::Binary(operator, ..) => operator.tightness(),
        }
    }
}

/// A part of an expression, in parentheses unless its precedence is at least the given one.
struct OperandPart<'a, N>(&'a Expression<N>, Precedence);

impl<N: Display> Display for OperandPart<'_, N> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.0.tightness() >= self.1 {
            true => write!(f, "{}", self.0),
            false => write!(f, "({})", self.0),
        }
    }
}

impl<N: Display> Display for Expression<N> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match &self.node {
            Node::Number(value) => write_number(f, *value),
            Node::Quantity(value, unit) => {
                write_number(f, *value)?;
                write!(f, " {}", unit.word())
            }
            Node::Constant(constant) => f.write_str(constant.word()),
            Node::Name(name) => write!(f, "{name}"),
            Node::Negate(x) => write!(f, "-{}", OperandPart(x, Precedence::Sign)),
            Node::Binary(operator, x, y) => {
                let (left, right) = match operator {
                    Operator::Add | Operator::Subtract => (Precedence::Sum, Precedence::Product),
                    Operator::Multiply | Operator::Divide => {
                        (Precedence::Product, Precedence::Sign)
                    }
                    Operator::Power => (Precedence::Operand, Precedence::Sign),
                };
                if let Some(unit) = joined_unit(*operator, x, y) {
                    return write!(f, "{x}{}{unit}", operator.symbol());
                }
                let (x, y) = (OperandPart(x, left), OperandPart(y, right));
                match operator {
                    Operator::Add | Operator::Subtract => {
                        write!(f, "{x} {} {y}", operator.symbol())
                    }
                    _ => write!(f, "{x}{}{y}", operator.symbol()),
                }
            }
            Node::Call(function, arguments) => {
                write!(f, "{}(", function.word())?;
                for (i, argument) in arguments.iter().enumerate() {
                    let comma = if i == 0 { "" } else { ", " };
                    write!(f, "{comma}{argument}")?;
                }
                f.write_str(")")
            }
        }
    }
}

/// The unit, with its power, that a number with a unit is multiplied with or divided by: `N/mm`, `m/s^2`.
fn joined_unit<N>(operator: Operator, x: &Expression<N>, y: &Expression<N>) -> Option<String> {
    let one = |of: &Expression<N>| match of.node {
        Node::Quantity(1.0, unit) => Some(unit.word()),
        _ => None,
    };
    fn begins_with_unit<N>(of: &Expression<N>) -> bool {
        match &of.node {
            Node::Quantity(..) => true,
            Node::Binary(operator, x, y) => {
                joined_unit(*operator, x, y).is_some() && begins_with_unit(x)
            }
            _ => false,
        }
    }
    if !matches!(operator, Operator::Multiply | Operator::Divide) || !begins_with_unit(x) {
        return None;
    }
    match &y.node {
        Node::Binary(Operator::Power, base, power) => {
            let power = power.as_number();
            let power = power.filter(|n| n.fract() == 0.0 && (0.0..256.0).contains(n))?;
            Some(format!("{}^{power}", one(base)?))
        }
        _ => one(y).map(str::to_owned),
    }
}

fn write_number(f: &mut Formatter, value: f64) -> fmt::Result {
    // Both forms are the shortest that read back as the same number.
    match value == 0.0 || (1e-5..1e16).contains(&value.abs()) {
        true => write!(f, "{value}"),
        false => write!(f, "{value:e}"),
    }
}

/// A plain number is written as a number, everything else as text.
impl<N: Display> Serialize for Expression<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.as_number() {
            Some(value) => serializer.serialize_f64(value),
            None => serializer.collect_str(self),
        }
    }
}

/// Reads a number or a text, as it is serialised.
impl<'de> Deserialize<'de> for Expression {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "expected a number or an expression")]
        enum WrittenForm {
            Number(f64),
            Text(String),
        }
        match WrittenForm::deserialize(deserializer)? {
            WrittenForm::Number(value) => Ok(Expression::number(value)),
            WrittenForm::Text(text) => Expression::parse_quantity(&text).map_err(Error::custom),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{Constant, Function, Unit};
    use super::*;

    fn printed(text: &str) -> String {
        Expression::parse(text).unwrap().to_string()
    }

    #[test]
    fn only_the_parentheses_that_are_needed_are_printed() {
        assert_eq!(printed("((a))+(b*c)"), "a + b*c");
        assert_eq!(printed("a-(b-c)"), "a - (b - c)");
        assert_eq!(printed("(a-b)-c"), "a - b - c");
        assert_eq!(printed("(a/b)/(c/d)"), "a/b/(c/d)");
        assert_eq!(printed("-(x^2)"), "-x^2");
        assert_eq!(printed("(-x)^2"), "(-x)^2");
        assert_eq!(printed("(a^b)^c"), "(a^b)^c");
        assert_eq!(printed("a^(b^c)"), "a^b^c");
        assert_eq!(printed("90deg-phi1"), "90 deg - phi1");
        assert_eq!(printed("(2 m)^2"), "(2 m)^2");
        assert_eq!(printed("2^(2 m)"), "2^2 m");
        assert_eq!(printed("atan2( y ,-x )"), "atan2(y, -x)");
        assert_eq!(printed("1e-9*1e20"), "1e-9*1e20");
    }

    fn any_expression() -> impl Strategy<Value = Expression> {
        let leaf = prop_oneof![
            (0.0..1e20).prop_map(Node::Number),
            (0.0..1e-9).prop_map(Node::Number),
            ((0.0..400.0), prop::sample::select(&Unit::ALL[..]))
                .prop_map(|(x, unit)| Node::Quantity(x, unit)),
            prop::sample::select(&Constant::ALL[..]).prop_map(Node::Constant),
            prop::sample::select(&["a", "θ1", "m"][..])
                .prop_map(|name| Node::Name(name.to_owned())),
        ];
        leaf.prop_map(|node| node.at(0..0))
            .prop_recursive(8, 64, 2, |inner| {
                use Operator::{Add, Divide, Multiply, Power, Subtract};
                let operator = [Add, Subtract, Multiply, Divide, Power].as_slice();
                let operator = prop::sample::select(operator);
                prop_oneof![
                    inner.clone().prop_map(Node::negated),
                    (operator, inner.clone(), inner.clone())
                        .prop_map(|(o, x, y)| Node::binary(o, x, y)),
                    inner
                        .clone()
                        .prop_map(|x| Node::Call(Function::Cos, vec![x])),
                    (inner.clone(), inner)
                        .prop_map(|(x, y)| Node::Call(Function::Atan2, vec![x, y])),
                ]
                .prop_map(|node| node.at(0..0))
            })
    }

    proptest! {
        #[test]
        fn what_is_printed_reads_back_as_the_same_tree(expression in any_expression()) {
            prop_assert_eq!(Expression::parse(&expression.to_string()), Ok(expression));
        }

        #[test]
        fn no_text_makes_the_parser_panic(text in "[a-c0-9.+*/^() ,eπ²θ-]{0,40}|\\PC{0,20}") {
            if let Err(error) = Expression::parse(&text) {
                prop_assert!(text.get(error.span).is_some());
            }
        }
    }
}
