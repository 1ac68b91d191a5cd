//! The dimension of an expression (length, angle, none), as far as its units determine it.

use linkwork::algebra::*;

fn check(text: &str, wanted: Measure) -> Result<(), MeasureError> {
    let of = |name: &String| match name.as_str() {
        "arm" => Measure::Length,
        "turn" => Measure::Angle,
        _ => Measure::Number,
    };
    Expression::parse(text).unwrap().check_measure(wanted, &of)
}

#[test]
fn what_has_no_unit_fits_anywhere() {
    for text in ["2", "pi/2", "-b", "2*b + 1", "sqrt(2)", "b^2/3", "sin(b)"] {
        for wanted in [Measure::Angle, Measure::Length, Measure::Force] {
            assert_eq!(check(text, wanted), Ok(()), "{text}");
        }
    }
}

#[test]
fn a_unit_decides_in_sums_and_in_products_with_numbers() {
    let lengths = [
        "2 m",
        "7 in/2",
        "-3*5 mm",
        "2 cm + b",
        "max(b, 1 m)",
        "2*arm",
        "hypot(1 m, arm)",
    ];
    let angles = [
        "30 deg",
        "60*deg",
        "pi/2 - 1 rad",
        "b + turn",
        "abs(-1 deg)",
        "90 deg - b",
    ];
    for (texts, right, wrong) in [
        (lengths.as_slice(), Measure::Length, Measure::Angle),
        (angles.as_slice(), Measure::Angle, Measure::Length),
    ] {
        for text in texts {
            assert_eq!(check(text, right), Ok(()), "{text}");
            let kind = MeasureErrorKind::Wrong {
                wanted: wrong,
                found: right,
            };
            assert_eq!(check(text, wrong).unwrap_err().kind, kind, "{text}");
            assert!(check(text, Measure::Force).is_err(), "{text}");
        }
    }
}

#[test]
fn an_arc_and_a_ratio_are_not_judged() {
    let texts = [
        "b*30 deg",
        "(10 mm)*(30 deg)",
        "arm/(2 m)",
        "sqrt(arm^2 + 1)",
        "atan2(arm, 1 m)",
    ];
    for text in texts {
        assert_eq!(check(text, Measure::Length), Ok(()), "{text}");
        assert_eq!(check(text, Measure::Angle), Ok(()), "{text}");
    }
}
