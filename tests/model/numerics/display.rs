//! Expression → text that reads back as the same tree.

use linkwork::algebra::*;
use proptest::prelude::*;

use linkwork::algebra::{Constant, Function, Unit};

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
        prop::sample::select(&["a", "θ1", "m"][..]).prop_map(|name| Node::Name(name.to_owned())),
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
                (inner.clone(), inner).prop_map(|(x, y)| Node::Call(Function::Atan2, vec![x, y])),
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
