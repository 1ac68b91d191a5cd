//! The unit of an expression over quantities of which each has one.

use linkwork::algebra::*;

fn unit(text: &str) -> Result<String, String> {
    let of = |name: &String| match name.as_str() {
        "x" => Some(SiUnit::METRE),
        "a" => Some(SiUnit::RADIAN),
        "velocity:a" => Some(SiUnit::RADIAN.per_second()),
        "velocity:x" => Some(SiUnit::METRE.per_second()),
        "force:x" => Some(SiUnit::NEWTON),
        "force:a" => Some(SiUnit::NEWTON_METRE),
        _ => None,
    };
    let unit = Expression::parse_quantity(text).unwrap().unit(&of);
    let unit = unit.map_err(|error| format!("{} at {:?}", error.kind, error.span))?;
    Ok(unit.map_or("?".into(), |unit| unit.to_string()))
}

#[test]
fn products_powers_and_roots_have_the_units_of_their_factors() {
    for (text, expected) in [
        ("2*x", "m"),
        ("x^2", "m²"),
        ("sqrt(x^2 + (3 mm)^2)", "m"),
        ("x/a", "m"),
        ("velocity:a*x", "m/s"),
        ("velocity:x/velocity:a", "m"),
        ("x*velocity:a/velocity:x", ""),
        ("velocity:a/velocity:x*x", ""),
        ("force:a*velocity:a + force:x*velocity:x", "W"),
        ("1/force:x", "1/N"),
        ("atan2(x, 2)", "rad"),
        ("a - 30 deg", "rad"),
        ("x + 1", "m"),
        ("x/(2 m)", ""),
        ("b*x", "?"),
        ("cos(a)", ""),
        ("x^99", "?"),
        ("1/x^9/x^9", "?"),
    ] {
        assert_eq!(unit(text).as_deref(), Ok(expected), "{text}");
    }
}

#[test]
fn what_has_different_units_is_not_added() {
    let wrong = |text| unit(text).unwrap_err();
    assert_eq!(wrong("x + a"), "m and rad are mixed at 0..5");
    assert_eq!(
        wrong("1 + (velocity:x - x)"),
        "m/s and m are mixed at 4..20"
    );
    assert_eq!(wrong("sin(x)"), "`sin` takes an angle, not m at 0..6");
    assert_eq!(
        wrong("exp(force:x)"),
        "`exp` takes a plain number, not N at 0..12"
    );
    assert_eq!(
        wrong("atan2(x, velocity:x)"),
        "m and m/s are mixed at 0..20"
    );
}
