//! Ranks and freedoms where closure equations vanish identically.

use linkwork::analysis::mobility::{Character, MobilityReport, MobilitySettings, mobility};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::Watch;
use linkwork::system::Question;

/// A link on a ball of three rows, and a rod of 1 m from a post to the point of the link that is 1 m
/// from the ball's centre.
fn on_a_rod(post: &str, home: [f64; 3]) -> MobilityReport {
    let [t, u, w] = home;
    let text = format!(
        r#"Mechanism(
            version: 1,
            name: "link on a rod",
            convention: Modified,
            joints: {{
                "t": Passive(home: {t:?}), "u": Passive(home: {u:?}), "w": Passive(home: {w:?}),
            }},
            chains: {{
                "arm": Chain(
                    rows: [(theta: "t"), (alpha: "90 deg", theta: "u + 90 deg"),
                        (alpha: "90 deg", theta: "w")],
                    tip: [Tz(1)],
                ),
                "post": Chain(base: [{post}], rows: []),
            }},
            closures: {{ "rod": Distance("arm", "post", 1) }},
        )"#
    );
    let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
    let question = Question::new(&mechanism);
    let report = mobility(&question, &MobilitySettings::default(), &Watch::none());
    report.closed().expect("closes")
}

#[test]
fn an_equation_that_always_holds_has_no_rank_and_takes_no_freedom() {
    // the post stands in the centre of the ball; the link spins about the rod in w
    for home in [
        [0.1, 0.2, 0.3],
        [1.7, -0.4, 2.0],
        [-0.9, 0.7, 0.0],
        [2.2, 1.1, -1.3],
    ] {
        let report = on_a_rod("", home);
        assert_eq!((report.rank, report.redundant), (0, 1), "{home:?}");
        assert_eq!((report.mobility, report.infinitesimal), (2, 2), "{home:?}");
        assert_eq!(report.character, Character::Regular, "{home:?}");
    }
}

#[test]
fn an_equation_that_holds_on_a_circle_takes_one() {
    for home in [[0.1, 0.2, 0.3], [0.5, -0.4, 2.0]] {
        let report = on_a_rod("Tx(0.8)", home);
        assert_eq!((report.rank, report.redundant), (1, 0), "{home:?}");
        assert_eq!((report.mobility, report.infinitesimal), (1, 1), "{home:?}");
    }
}
