//! Angles of joints whose limits are wider than a turn.

use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;

/// A crank of 0.04 m with limits, a rod of 0.1 m and a slide; angles in degrees.
fn text(home: f64, (low, high): (f64, f64)) -> String {
    format!(
        r#"Mechanism(version: 1, name: "m", convention: Modified,
        joints: {{
            "crank": Actuated(home: "{home:?} deg", limits: ("{low:?} deg", "{high:?} deg")),
            "s": Passive(home: 0.14), "rod": Passive(home: "-15 deg"),
        }},
        chains: {{
            "crank": Chain(rows: [(theta: "crank"), (a: 0.04, theta: "rod")], tip: [Tx(0.1)]),
            "guide": Chain(base: [Ry("90 deg")], rows: [(d: "s")], tip: [Ry("-90 deg")]),
        }},
        closures: {{ "pin": Revolute("crank", "guide") }})"#
    )
}

fn slider_crank(home: f64, limits: (f64, f64)) -> Mechanism {
    Mechanism::new(&Description::read(&text(home, limits)).unwrap()).unwrap()
}

/// The crank where the slide is at `s`, by the law of cosines, in degrees.
fn crank_at(s: f64) -> f64 {
    let (a, b): (f64, f64) = (0.04, 0.1);
    ((s * s + a * a - b * b) / (2.0 * s * a))
        .acos()
        .to_degrees()
}

fn question(mechanism: &Mechanism, s: f64) -> Question {
    Question::new(mechanism.clone()).free("crank").hold("s", s)
}

fn solved(question: &Question) -> f64 {
    let solver = question.solver_program(&Default::default(), &Watch::none());
    let solver = solver.unwrap();
    let crank = solver.state.iter().find(|of| of.name == "crank").unwrap();
    crank.value.to_degrees()
}

#[test]
fn a_solved_angle_is_in_the_turn_nearest_the_guess_or_home() {
    let wide = (-90.0, 1500.0);
    let right = crank_at(0.1385);
    for (home, turns) in [(10.0, 0.0), (370.0, 1.0), (1090.0, 3.0)] {
        let question = question(&slider_crank(home, wide), 0.1385);
        assert!(
            (solved(&question) - right - 360.0 * turns).abs() < 1e-6,
            "{home}"
        );
    }
    let mechanism = slider_crank(10.0, wide);
    for (guess, turns) in [("11 deg", 0.0), ("400 deg", 1.0), ("1450 deg", 4.0)] {
        let question = question(&mechanism, 0.1385).guess("crank", guess);
        assert!(
            (solved(&question) - right - 360.0 * turns).abs() < 1e-6,
            "{guess}"
        );
    }
    // a narrow range decides alone
    let narrow = slider_crank(370.0, (340.0, 380.0));
    let question = question(&narrow, 0.1385).guess("crank", "11 deg");
    assert!((solved(&question) - right - 360.0).abs() < 1e-6);
}

#[test]
fn rows_begin_in_the_turn_of_home() {
    let mechanism = slider_crank(10.0, (-90.0, 1500.0));
    let rows: Vec<f64> = (0..20).map(|k| 0.1385 - 0.0004 * f64::from(k)).collect();
    let many = Question::new(mechanism)
        .free("crank")
        .hold("s", 0.1385)
        .solve_many(&["s".into()], &rows, &Watch::none())
        .unwrap();
    let place = many.names.iter().position(|of| of == "crank").unwrap();
    for (row, s) in many.values.chunks(many.names.len()).zip(&rows) {
        assert!((row[place].to_degrees() - crank_at(*s)).abs() < 1e-6, "{s}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("crank.ron");
    std::fs::write(&file, text(10.0, (-90.0, 1500.0))).unwrap();
    let file = file.to_str().unwrap();
    let input = [
        "--free",
        "crank",
        "--input",
        "s=0.1385..0.13",
        "--steps",
        "2",
    ];
    let (status, said, _) = super::linkwork(&[&["sweep", file][..], &input].concat());
    assert_eq!(status, 0, "{said}");
    let shown = [crank_at(0.1385), crank_at(0.13)].map(|crank| format!(" {crank:.6}°"));
    assert!(shown.iter().all(|crank| said.contains(crank)), "{said}");
}
