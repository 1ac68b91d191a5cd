//! Rods stretched straight: what second order forbids, and what still moves.

use linkwork::analysis::mobility::{Character, MobilityReport};
use linkwork::ask::Question;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;

fn report(platforms: &str, chains: &str, closures: &str) -> MobilityReport {
    let text = format!(
        r#"Mechanism(version: 1, name: "between rods", convention: Modified,
            platforms: {{ {platforms} }}, chains: {{ {chains} }}, closures: {{ {closures} }})"#
    );
    let mechanism = Mechanism::new(&Description::read(&text).unwrap()).unwrap();
    let answer = Question::new(mechanism).mobility(&Watch::none());
    answer.unwrap().closed().unwrap()
}

/// So many bodies of 0.2 m in a row, 1 m apart, between rods; their origins are `aside` of the line.
fn beads(number: usize, aside: f64, post: f64) -> MobilityReport {
    let body = |k: usize| {
        format!(
            r#""p{k}": Platform(home: [T({k}, -{aside:?}, 0)],
                frames: {{ "A": [T(0.1, {aside:?}, 0)], "B": [T(-0.1, {aside:?}, 0)] }}),"#
        )
    };
    let between = |k: usize| format!(r#""r{k}": Distance("p{k}.A", "p{}.B", 0.8),"#, k + 1);
    report(
        &(1..=number).map(body).collect::<String>(),
        &format!(r#""post": Chain(base: [Tx({post:?})])"#),
        &format!(
            r#""first": Distance("ground", "p1.B", 0.9), {} "last": Distance("p{number}.A", "post", 0.9)"#,
            (1..number).map(between).collect::<String>()
        ),
    )
}

#[test]
fn bodies_between_rods_stretched_straight_turn_about_their_line() {
    for number in 1..=3 {
        let report = beads(number, 0.2, number as f64 + 1.0);
        // to first order each goes to both sides and turns about three axes, but that all lengths are given
        assert_eq!(report.infinitesimal, 5 * number, "{number}");
        assert_eq!(report.mobility, number);
        assert_eq!(report.character, Character::Singular);
        assert!(report.branches_complete);
        let said = report.document().answer;
        let freedoms = match number {
            1 => "1 freedom".to_owned(),
            n => format!("{n} freedoms"),
        };
        let begins = format!("The mechanism has {freedoms} at this singular configuration");
        assert!(said.starts_with(&begins), "{said}");
    }
}

#[test]
fn bodies_between_rods_with_slack_move_as_counted() {
    for number in 1..=2 {
        let report = beads(number, 0.2, number as f64 + 0.9);
        // six for each body, less one for each rod
        assert_eq!(report.mobility, 6 * number - (number + 1));
        assert_eq!(report.character, Character::Regular);
    }
}

#[test]
fn bodies_whose_spin_moves_no_point_stand_still_between_rods_stretched_straight() {
    let report = beads(2, 0.0, 3.0);
    assert_eq!((report.mobility, report.character), (0, Character::Shaky));
    assert!(report.branches_complete);
    // two bodies and three rods
    assert_eq!(report.idle_freedoms.len(), 5);
}

#[test]
fn rods_stretched_straight_along_two_lines_hold_a_body_still() {
    let rod = |side: &str| format!(r#""{side}": Distance("{side}", "p.{side}", 0.9),"#);
    let report = report(
        r#""p": Platform(frames: { "E": [Tx(0.1)], "W": [Tx(-0.1)], "N": [Ty(0.1)], "S": [Ty(-0.1)] })"#,
        r#""E": Chain(base: [Tx(1)]), "W": Chain(base: [Tx(-1)]), "N": Chain(base: [Ty(1)]), "S": Chain(base: [Ty(-1)])"#,
        &["E", "W", "N", "S"].map(rod).concat(),
    );
    // every motion but along the lines in their plane is one to first order: each line has a stress
    assert_eq!((report.infinitesimal, report.redundant), (4, 2));
    assert_eq!((report.mobility, report.character), (0, Character::Shaky));
    assert!(report.branches_complete);
}

/// A bead of 0.2 m between rods of 0.9 m on a line in space, `post` long, drawn a little beside it.
fn drawn_beside(line: &str, post: f64) -> MobilityReport {
    let platform = format!(
        r#""p": Platform(home: [{line}, T(1.02, 0.05, 0.01), Rz(0.1)],
            frames: {{ "A": [Tx(0.1)], "B": [Tx(-0.1)] }})"#
    );
    let chains =
        format!(r#""near": Chain(base: [{line}]), "post": Chain(base: [{line}, Tx({post:?})])"#);
    let closures = r#""r": Distance("near", "p.B", 0.9), "s": Distance("p.A", "post", 0.9)"#;
    report(&platform, &chains, closures)
}

#[test]
fn a_pose_that_is_not_closed_is_closed_to_where_rods_are_straight() {
    for line in [
        "Tx(0)",
        "T(0.3, -1, 2), Rz(2.4), Ry(-0.8), Rx(1)",
        "T(-2, 0.4, 0.1), Rz(-1.3), Ry(0.3)",
        "T(5, 3, -4), Rz(0.9), Ry(-2.1)",
    ] {
        let report = drawn_beside(line, 2.0);
        // both rods pull along one line: one of their two equations is redundant, and the spin is idle
        let of = (report.rank, report.redundant, report.infinitesimal);
        assert_eq!(of, (1, 1, 4), "{line}");
        assert_eq!(report.mobility, 0, "{line}");
        let slack = drawn_beside(line, 2.0 - 1e-6);
        let of = (slack.rank, slack.redundant, slack.infinitesimal);
        assert_eq!(of, (2, 0, 3), "{line}");
        assert_eq!(slack.mobility, 3, "{line}");
    }
}
