//! Text → expression, by precedence climbing (Pratt, "Top down operator precedence", 1973).

use linkwork::algebra::*;

fn value(text: &str) -> f64 {
    let variables = |name: &String| match name.as_str() {
        "a" => 2.0,
        "b" => 3.0,
        "θ₁" => 0.5,
        name => panic!("{name} has no value"),
    };
    let expression = Expression::parse(text).unwrap();
    expression.evaluate(&variables).unwrap()
}

#[test]
fn operators_bind_as_on_paper() {
    assert_eq!(value("1 + 2*3"), 7.0);
    assert_eq!(value("(1 + 2)*3"), 9.0);
    assert_eq!(value("10 - 4 - 3"), 3.0);
    assert_eq!(value("24/4/3"), 2.0);
    assert_eq!(value("2^3^2"), 512.0);
    assert_eq!(value("-a^2"), -4.0);
    assert_eq!(value("2^-1"), 0.5);
    assert_eq!(value("-a*b"), -6.0);
    assert_eq!(value("a - -b"), 5.0);
    assert_eq!(value("+a--b*+2"), 8.0);
    assert_eq!(value("2^-a^2"), 0.0625);
}

#[test]
fn units_follow_a_number_with_or_without_space() {
    assert_eq!(value("60 deg"), 60_f64.to_radians());
    assert_eq!(value("60deg"), 60_f64.to_radians());
    assert_eq!(value("2 rad + 1 m"), 3.0);
    assert_eq!(value("100 mm + 5cm"), 0.1 + 0.05);
    assert_eq!(value("7 in"), 0.1778);
    assert_eq!(value("b*deg"), 3.0 * (std::f64::consts::PI / 180.0));
    assert_eq!(value("(2 m)^2"), 4.0);
}

#[test]
fn depth_and_length_are_bounded() {
    let error = |text: &str| Expression::parse(text).unwrap_err().kind;
    for text in ["(", "-", "sin(", "2^", "a-("] {
        let kind = error(&text.repeat(100_000));
        assert_eq!(kind, ParseErrorKind::TooDeep, "{text}");
    }
    let sum = |terms: usize| format!("1{}", "+1".repeat(terms - 1));
    assert_eq!(error(&sum(500_001)), ParseErrorKind::TooLong);
    assert_eq!(value(&sum(MAX_HEIGHT)), MAX_HEIGHT as f64);
    let nested = ["(", ")"]
        .map(|bracket| bracket.repeat(MAX_NESTING))
        .join("a");
    assert_eq!(value(&nested), 2.0);
}
