//! Trigonometric normal forms prove the identities of textbooks, and nothing else.

use linkwork::algebra::*;
use proptest::prelude::*;

use linkwork::number::Number;

const PLENTY: Budget = Budget { products: 20_000 };
const LETTERS: [&str; 5] = ["a", "b", "x", "y", "t"];
const VALUES: [f64; 5] = [0.7, 1.3, 0.4, -1.1, 2.3];

fn number(name: &str) -> u32 {
    LETTERS.iter().position(|letter| *letter == name).unwrap() as u32
}

/// The normal form of an expression in the letters; `None` if it has none.
fn normal(text: &str) -> Option<Trigonometric> {
    let expression = Expression::parse(text).unwrap();
    with_letters(VALUES.to_vec(), PLENTY, || {
        let value = expression.evaluate(&|name: &String| Symbolic::symbol(number(name)));
        Some((*value.ok()?.formula()?).clone())
    })
}

fn same(a: &str, b: &str) -> Option<bool> {
    let difference = normal(a)?.minus(&normal(b)?);
    difference.vanishes(&mut PLENTY.clone())
}

#[test]
fn textbook_identities_are_proved() {
    for (a, b) in [
        ("sin(x)^2 + cos(x)^2", "1"),
        ("cos(x + y)", "cos(x)*cos(y) - sin(x)*sin(y)"),
        ("sin(3*x)", "3*sin(x) - 4*sin(x)^3"),
        (
            "(a*cos(x) + b*cos(x + y))^2 + (a*sin(x) + b*sin(x + y))^2",
            "a^2 + b^2 + 2*a*b*cos(y)",
        ),
        ("cos(90 deg - x)", "sin(x)"),
        ("cos(120 deg + x)", "-cos(x)/2 - sqrt(3)/2*sin(x)"),
        ("sin(15 deg)", "(sqrt(6) - sqrt(2))/4"),
        ("sin(pi/2)*a", "a"),
        ("cos(45 deg)", "1/sqrt(2)"),
        ("1/(sqrt(3) - sqrt(2))", "sqrt(3) + sqrt(2)"),
        ("sqrt(8/27)", "2*sqrt(6)/9"),
        ("0.1 + 0.2", "0.3"),
        ("4318 mm", "4.318"),
        ("12 in", "0.3048"),
        ("2*sin(x/2)*cos(x/2)", "sin(x)"),
        ("cos(a*x + y)", "cos(a*x)*cos(y) - sin(a*x)*sin(y)"),
        ("tan(x)*cos(x)", "sin(x)"),
        ("tan(x/2)", "sin(x)/(1 + cos(x))"),
        ("(1 - cos(x))/sin(x)", "sin(x)/(1 + cos(x))"),
        ("1/(a + b) + 1/(a - b)", "2*a/(a^2 - b^2)"),
        ("sqrt(a + b)*sqrt(a + b)", "a + b"),
        ("cos(acos(x/a))", "x/a"),
        ("cos(atan2(a, b))^2 + sin(atan2(a, b))^2", "1"),
        ("cos(20 deg)*cos(40 deg)*cos(80 deg)", "1/8"),
        ("sin(10 deg + x) - sin(10 deg)*cos(x)", "cos(10 deg)*sin(x)"),
    ] {
        assert_eq!(same(a, b), Some(true), "{a} = {b}");
    }
}

#[test]
fn what_is_not_the_same_is_told_apart() {
    for (a, b) in [
        ("sin(x)^2 - cos(x)^2", "1"),
        ("cos(x + y)", "cos(x)*cos(y) + sin(x)*sin(y)"),
        ("sin(15 deg)", "(sqrt(6) + sqrt(2))/4"),
        ("pi", "3.141592653589793"),
        ("cos(0.5235988)*x", "sqrt(3)/2*x"),
        ("1/(a + b)", "1/a + 1/b"),
    ] {
        assert_eq!(same(a, b), Some(false), "{a} ≠ {b}");
    }
}

#[test]
fn what_roots_and_inverse_functions_hide_is_not_decided() {
    for (a, b) in [
        ("sqrt(a^2)", "a"),
        ("sqrt(a*b)", "sqrt(a)*sqrt(b)"),
        ("asin(x) + acos(x)", "pi/2"),
        ("abs(a)", "a"),
        ("min(a, b)", "a"),
        // a relation of roots of unity
        ("cos(36 deg) - cos(72 deg)", "1/2"),
        // too many digits for an exponent: kept as a function
        ("cos(0.5235987755982988)*x", "sqrt(3)/2*x"),
    ] {
        assert_eq!(same(a, b), None, "{a} = {b}");
    }
}

#[test]
fn work_is_bounded() {
    let long = (0..60)
        .map(|k| format!("cos({k}*x + a)"))
        .collect::<Vec<_>>();
    let long = format!("({})^6", long.join(" + "));
    assert!(normal(&long).is_none());
}

#[test]
fn nothing_outlives_its_arena() {
    let left = with_letters(vec![1.0], PLENTY, || Symbolic::symbol(0));
    assert!(left.formula().is_none());
    with_letters(vec![1.0], PLENTY, || {
        assert!(left.formula().is_none() && !(left + Symbolic::one()).is_finite());
        with_letters(vec![], PLENTY, || assert_eq!(Symbolic::one().real(), 1.0));
        assert!(Symbolic::symbol(0).is_finite());
    });
}

fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        prop::sample::select(&LETTERS[..]).prop_map(str::to_owned),
        (0..40_u32, 1..9_u32).prop_map(|(a, b)| format!("({a}/{b})")),
        (0.0..4.0).prop_map(|x: f64| format!("{x:.3}")),
        (0..72_i32).prop_map(|k| format!("cos({} deg)", 15 * k)),
        (1..30_u32).prop_map(|k| format!("sqrt({k})")),
    ];
    let angle = (
        0..3_i32,
        -3..4_i32,
        0..24_i32,
        prop::sample::select(&LETTERS[..]),
    );
    let angle = angle.prop_map(|(h, k, d, m)| format!("{h}*x/2 + {k}*{m} + {} deg", 15 * d));
    let leaf = prop_oneof![
        leaf,
        angle.clone().prop_map(|angle| format!("sin({angle})")),
        angle.prop_map(|angle| format!("cos({angle})")),
    ];
    leaf.prop_recursive(3, 10, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("({x} + {y})")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("({x} - {y})")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("{x}*{y}")),
            inner.clone().prop_map(|x| format!("-({x})")),
            inner.clone().prop_map(|x| format!("({x})^2")),
            inner.prop_map(|x| format!("({x})/(3 + a)")),
        ]
    })
}

fn plain(text: &str) -> f64 {
    let value = Expression::parse(text).unwrap();
    value
        .evaluate(&|name: &String| VALUES[number(name) as usize])
        .unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_normal_form_has_the_value_of_the_expression(text in expression()) {
        let value = plain(&text);
        if let Some(normal) = normal(&text) {
            let found = normal.value(&|symbol| VALUES[symbol as usize]);
            let size: f64 = normal.terms().map(|(key, coefficient)| {
                let bare = Key { wave: Wave::default(), imaginary: false, ..key.clone() };
                Trigonometric::term(bare, coefficient.clone()).value(&|symbol| VALUES[symbol as usize]).abs()
            }).sum();
            prop_assert!((found - value).abs() <= 1e-12 * size.max(1.0), "{found} {value}");
        }
    }

    #[test]
    fn a_difference_of_equal_expressions_vanishes(x in expression(), y in expression()) {
        let (sum, other) = (format!("({x} + {y})^2"), format!("({y})^2 + 2*({x})*({y}) + ({x})*({x})"));
        if let (Some(a), Some(b)) = (normal(&sum), normal(&other)) {
            prop_assert_eq!(a.minus(&b).vanishes(&mut PLENTY.clone()), Some(true));
            let moved = a.minus(&b).plus(&Trigonometric::symbol(0));
            prop_assert_eq!(moved.vanishes(&mut PLENTY.clone()), Some(false));
        }
    }
}
