//! What is said of a whole motion does not depend on how many rows are asked for.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use linkwork::analysis::sweep::{Extremum, Law, MotionReport, Pace, SweepEnd, SweepSettings};
use linkwork::ask::Question;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn load(name: &str) -> Mechanism {
    linkwork::load(file(name)).unwrap()
}

fn four_bar() -> Question {
    Question::new(load("mechanisms/four_bar.ron")).input("theta1", 0.0, TAU)
}

fn moved(question: &Question, steps: usize, law: Law, straightness: bool) -> MotionReport {
    let settings = SweepSettings {
        steps,
        straightness,
        pace: Pace { law, duration: 2.0 },
        ..SweepSettings::default()
    };
    let motions = question.motions(&settings, &Watch::none()).unwrap();
    let mut report = motions.report(usize::MAX, &mut |_, _| {}, &Watch::none());
    report.motions.remove(0)
}

const STEPS: [usize; 6] = [1, 2, 3, 7, 100, 1000];

/// The least and the greatest value.
fn values(of: &Extremum) -> [f64; 2] {
    match of.constant {
        Some(value) => [value; 2],
        None => [&of.least, &of.greatest].map(|side| side.as_ref().map_or(f64::NAN, |of| of.value)),
    }
}

#[test]
fn extremes_are_those_of_the_curve() {
    // ground 5, crank 1, coupler 3, rocker 4: least where the crank points away, 90° where the diagonal is 5
    let least = (11.0 / 24.0f64).acos();
    let pole = "1/(1 + 1e8*(theta1 - 1.2345)^2)";
    let cases = [
        ("transmission", [least, TAU / 4.0]),
        ("sin(100*theta1)", [-1.0, 1.0]),
        ("sin(1000*theta1)", [-1.0, 1.0]),
        ("sin(1000*theta1)*cos(1000*theta1)", [-0.5, 0.5]),
        // ∓1 + θ/10 at the first trough and the last peak, and 5e-9 beside them
        (
            "sin(1000*theta1) + theta1/10",
            [
                -1.0 + 3e-4 * TAU / 4.0 - 5e-9,
                1.0 + 0.3997 * TAU / 4.0 + 5e-9,
            ],
        ),
        ("abs(sin(300*theta1))", [0.0, 1.0]),
        ("min(sin(70*theta1), cos(70*theta1))", [-1.0, 0.5f64.sqrt()]),
        ("max(abs(theta1 - 1), 0.25)", [0.25, TAU - 1.0]),
        (pole, [1.0 / (1.0 + 1e8 * (TAU - 1.2345).powi(2)), 1.0]),
        // bounds over long pieces are too large for any value
        ("exp(-(1e4*(theta1 - 1.2345))^2)", [0.0, 1.0]),
        // the crank pin and the pivot of the rocker, by the law of cosines
        ("hypot(left.2.x - 5, left.2.y)^2", [16.0, 36.0]),
        ("hypot(left.x - 5, left.y)^2", [16.0, 16.0]),
        ("sin(theta1)^2 + cos(theta1)^2", [1.0, 1.0]),
    ];
    for steps in STEPS {
        let question = cases
            .iter()
            .fold(four_bar(), |of, (text, _)| of.report(*text));
        let motion = moved(&question, steps, Law::Constant, false);
        for (found, (text, wanted)) in motion.extremes.iter().zip(&cases) {
            assert!(!found.at_least, "{text}");
            for (found, wanted) in values(found).iter().zip(wanted) {
                let off = (found - wanted).abs();
                assert!(
                    off < 1e-9 * (1.0 + wanted.abs()),
                    "{text}, {steps} steps: {found} {wanted}"
                );
            }
        }
    }
}

#[test]
fn the_greatest_transmission_angle_is_the_right_angle_that_is_passed() {
    // ground, crank, coupler and rocker, and from where to where the crank turns
    let cases = [
        ([0.9884, 1.6325, 0.8156, 1.1102], [0.408, 1.55]),
        ([0.5284, 1.7406, 1.5984, 0.7336], [-1.06, 2.97]),
        ([5.0, 1.0, 3.0, 4.0], [0.0, TAU]),
    ];
    let description = Mechanism::read(file("mechanisms/four_bar.ron")).unwrap().1;
    for (lengths, [from, to]) in cases {
        let names = ["l0", "l1", "l2", "l3"].iter().zip(lengths);
        let described = names.fold(description.clone(), |of, (name, length)| {
            of.with_parameter(name, &format!("{length:?}")).unwrap()
        });
        // by the law of cosines the angle is a right one where the diagonal is √(l₂² + l₃²)
        let diagonal = |t: f64| {
            let [g, a, ..] = lengths;
            (g * g + a * a - 2.0 * g * a * t.cos()).sqrt()
        };
        let right = lengths[2].hypot(lengths[3]);
        let passed = (0..=1000).map(|k| diagonal(from + (to - from) * f64::from(k) / 1000.0));
        let passed: Vec<f64> = passed.collect();
        assert!(passed.iter().any(|d| *d < right) && passed.iter().any(|d| *d > right));
        let question = Question::new(Mechanism::new(&described).unwrap())
            .input("theta1", from, to)
            .report("transmission");
        let motion = moved(&question, 1, Law::Constant, false);
        let [_, greatest] = values(&motion.extremes[0]);
        assert!(
            (greatest - TAU / 4.0).abs() < 1e-9,
            "{lengths:?}: {greatest}"
        );
    }
}

/// Branches go through a crossing smoothly, though no place beside it tells them apart.
#[test]
fn what_meets_a_crossing_is_bounded_up_to_it() {
    let parallelogram = Question::new(load("mechanisms/parallelogram.ron"))
        .input("theta1", -0.7, 0.7)
        .report("phi1 - theta1, velocity:phi1/velocity:theta1, left.2.yaw, right.y");
    // (L² − S²)/(2g), on a line through the fixed hinges; C and D are one above and below where the rhombus is flat
    let flat: f64 = 2.0 * (21.0f64.sqrt() / 5.0).acos();
    let inversor = Question::new(load("mechanisms/peaucellier.ron"))
        .input("theta", -TAU / 6.0, TAU / 6.0)
        .report("lower.x, lower.y, velocity:lower.x");
    let height = |angle: f64| 4.2 * (0.5 * angle).tan();
    let cases = [
        (
            parallelogram,
            vec![[0.0; 2], [1.0; 2], [0.0; 2], [-2.0 * 0.7f64.sin(), 0.0]],
        ),
        (
            inversor,
            vec![[4.2; 2], [height(-TAU / 6.0), height(-flat)], [0.0; 2]],
        ),
    ];
    for (question, wanted) in cases {
        let motion = moved(&question, 1, Law::Constant, false);
        assert_eq!(motion.sweep.ending, SweepEnd::Crossing);
        for (found, wanted) in motion.extremes.iter().zip(&wanted) {
            assert!(!found.at_least && found.unbounded.is_empty(), "{found:?}");
            assert_eq!(
                found.constant.is_some(),
                wanted[0] == wanted[1],
                "{found:?}"
            );
            for (found, wanted) in values(found).iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
            }
        }
    }
}

#[test]
fn a_force_that_acts_for_an_instant_is_bounded() {
    // the ratio of the rates of rocker and crank by the law of sines, at the place where the moment acts
    let at = 1.234567;
    let (joint, pivot): ([f64; 2], [f64; 2]) = ([f64::cos(at), f64::sin(at)], [5.0, 0.0]);
    let diagonal = (pivot[0] - joint[0]).hypot(joint[1]);
    let sight = (joint[1]).atan2(joint[0] - pivot[0]);
    let rocker = sight - ((16.0 + diagonal * diagonal - 9.0) / (8.0 * diagonal)).acos();
    let end = [pivot[0] + 4.0 * rocker.cos(), 4.0 * rocker.sin()];
    let coupler = (end[1] - joint[1]).atan2(end[0] - joint[0]);
    let ratio = (coupler - at).sin() / (4.0 * (coupler - rocker).sin());
    for (width, off) in [(3000.0, 1e-6), (300.0, 1e-4), (30.0, 1e-2)] {
        let load = format!("20 N*m*exp(-({width}*(theta1 - {at}))^2)");
        let question = four_bar().load("phi1", load).report("force:theta1");
        let motion = moved(&question, 1, Law::Constant, false);
        let found = &motion.extremes[0];
        assert!(!found.at_least, "{found:?}");
        let [least, greatest] = values(found);
        assert!((least + 20.0 * ratio).abs() < 20.0 * off, "{least} {ratio}");
        assert!(greatest.abs() < 1e-12, "{greatest}");
    }
}

#[test]
fn poles_are_found_between_any_rows() {
    for steps in STEPS {
        let question = four_bar().report("1/(theta1 - 1.2345), 1/(theta1 - 4.5)^2");
        let motion = moved(&question, steps, Law::Constant, false);
        for (of, place) in motion.extremes.iter().zip([1.2345, 4.5]) {
            let [pole] = &of.unbounded[..] else {
                panic!("{steps} steps: {of:?}")
            };
            assert!((pole.inputs[0] - place).abs() < 1e-9, "{pole:?}");
        }
        let [odd, even] = &motion.extremes[..] else {
            panic!()
        };
        assert!(odd.least.is_none() && odd.greatest.is_none() && even.greatest.is_none());
        let least = even.least.as_ref().unwrap().value;
        assert!((least - 1.0 / 4.5f64.powi(2)).abs() < 1e-12);
    }
}

/// A neighbour that varies too fast to be bounded.
#[test]
fn what_cannot_be_bounded_is_said_to_be_at_least_so_large() {
    let question = four_bar().report("sin(3e7*theta1)*cos(3e7*theta1)");
    assert!(moved(&question, 10, Law::Constant, false).extremes[0].at_least);
}

#[test]
fn forces_are_extreme_where_many_rows_have_them() {
    let question = four_bar()
        .wrench("left", [0.0, -10.0, 0.0], [0.0; 3])
        .report("force:theta1");
    let many = moved(&question, 20_000, Law::Constant, false);
    let column = many
        .columns
        .iter()
        .position(|of| of.name == "force:theta1")
        .unwrap();
    let rows = many.values.iter().map(|row| row[column].unwrap());
    let [low, high] = rows.fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(x), h.max(x)]);
    for steps in STEPS {
        let [least, greatest] = values(&moved(&question, steps, Law::Constant, false).extremes[0]);
        assert!(least <= low + 1e-12 && least > low - 1e-5, "{least} {low}");
        assert!(greatest >= high - 1e-12 && greatest < high + 1e-5);
    }
}

/// A crank-rocker with the parts of the time over which its rocker stays, and a linkage with a folding coupler, both
/// looked at 10⁶ places by a program of its own.
#[test]
fn dwells_and_straight_paths_are_those_of_the_curve() {
    for steps in STEPS {
        let dwelling = Question::new(load("tests/data/dwelling_four_bar.ron"))
            .input("t", -2.0, 4.0)
            .dwell("s", 0.074);
        let [begin, end] = moved(&dwelling, steps, Law::Septic, false).dwells[0].times;
        assert!(
            (end - begin - 0.225).abs() < 1e-4,
            "{steps} steps: {begin} to {end}"
        );
        let folding = Question::new(load("tests/data/folding_four_bar.ron"))
            .input("t", -2.0, 4.0)
            .point("L+-0.401,0.477");
        let line = moved(&folding, steps, Law::Septic, true)
            .straightness
            .remove(0);
        assert!(
            (line.deviation - 1.37221).abs() < 1e-5,
            "{steps} steps: {line:?}"
        );
    }
}

#[test]
fn what_does_not_depend_on_rates_is_the_same_under_every_law() {
    let press = Question::new(load("mechanisms/axes/toggle_press.ron"))
        .input("turn", "0 deg", "-60 deg")
        .report("advantage, velocity:ram");
    let ratio = four_bar().report(
        "velocity:phi1/velocity:theta1, curvature:left.2+1.2,0.8, \
         k=(velocity:left.2.x*acceleration:left.2.y - velocity:left.2.y*acceleration:left.2.x)/\
         hypot(velocity:left.2.x, velocity:left.2.y)^3",
    );
    for question in [press.report("height"), ratio] {
        let steady = moved(&question, 100, Law::Constant, false);
        for law in Law::ALL {
            for steps in [1, 2, 4, 100] {
                let motion = moved(&question, steps, law, false);
                for (found, wanted) in motion.extremes.iter().zip(&steady.extremes) {
                    // a velocity does depend on the law
                    if found.name == "velocity:ram" {
                        assert!(found.missing.is_none());
                        continue;
                    }
                    for (found, wanted) in values(found).iter().zip(values(wanted)) {
                        let off = (found - wanted).abs();
                        assert!(
                            off < 1e-8 * (1.0 + wanted.abs()),
                            "{law:?}, {steps}: {found} {wanted}"
                        );
                    }
                }
            }
        }
    }
}
