//! Rods stretched straight: at the limit of what is possible a few real assemblies are left of many complex ones.

use linkwork::analysis::assemblies::{AssembliesReport, Fit, Wanted};
use linkwork::analysis::assembly::AssemblySettings;
use linkwork::ask::{Question, Solved};
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::output::{Report, text};
use linkwork::solve::Watch;

fn report(text: &str) -> AssembliesReport {
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let report = Question::new(mechanism).assemblies(Wanted::default(), &Watch::none());
    report.unwrap()
}

/// A bead of 0.2 m on its own x axis between two rods, `post` away from ground.
fn bead(post: f64) -> AssembliesReport {
    beads(&[Bead::of(post)])
}

/// A bead of 0.2 m between rods on a line.
#[derive(Clone, Copy)]
struct Bead {
    /// Where the line begins and where along x it goes.
    line: &'static str,
    /// How far it is to the post at its end.
    post: f64,
    rods: [f64; 2],
    /// The line of the bead in its own frame, and how far its origin is from that.
    body: &'static str,
    aside: f64,
}

impl Bead {
    fn of(post: f64) -> Self {
        Bead {
            line: "Tx(0)",
            post,
            rods: [0.9; 2],
            body: "Tx(0)",
            aside: 0.0,
        }
    }
}

/// Lines in space, and lines of beads.
const LINES: [(&str, &str); 6] = [
    ("Rz(0.7)", "Tx(0)"),
    (r#"Ry("90 deg")"#, r#"Rz("90 deg")"#),
    ("T(0.3, -1, 2), Rz(2.4), Ry(-0.8), Rx(1)", "Tx(0)"),
    ("T(-2, 0.4, 0.1), Rz(-1.3), Ry(0.3)", "Rz(0.4), Ry(1)"),
    ("Rz(0.9), Ry(-2.1)", "Rz(-2.2), Ry(-0.7)"),
    ("T(1, 1, 1), Ry(0.2), Rx(0.6)", "Rz(1.7), Ry(2.9)"),
];

const ISOLATED: &str = "1 assembly was found. It is isolated, at the limit of what is possible; in general 3 freedoms are \
                        left with what is held.";

/// Beads that have nothing to do with one another.
fn beads(beads: &[Bead]) -> AssembliesReport {
    let [mut platforms, mut chains, mut closures] = [const { String::new() }; 3];
    for (
        k,
        Bead {
            line,
            post,
            rods: [r, s],
            body,
            aside,
        },
    ) in beads.iter().enumerate()
    {
        let middle = 0.5 * post;
        platforms += &format!(
            r#""p{k}": Platform(home: [{line}, T({middle:?}, -{aside:?}, 0)], frames: {{
                "A": [{body}, T(0.1, {aside:?}, 0)], "B": [{body}, T(-0.1, {aside:?}, 0)] }}),"#
        );
        chains += &format!(
            r#""near{k}": Chain(base: [{line}]), "post{k}": Chain(base: [{line}, Tx({post:?})]),"#
        );
        closures += &format!(
            r#""r{k}": Distance("near{k}", "p{k}.B", {r:?}), "s{k}": Distance("p{k}.A", "post{k}", {s:?}),"#
        );
    }
    report(&format!(
        r#"Mechanism(version: 1, name: "beads between rods", convention: Modified,
            platforms: {{ {platforms} }}, chains: {{ {chains} }}, closures: {{ {closures} }})"#
    ))
}

#[test]
fn rods_stretched_straight_leave_one_assembly() {
    let report = bead(2.0);
    assert!(
        matches!(report.fit, Fit::FreedomLeft(_)),
        "{:?}",
        report.fit
    );
    assert_eq!((report.real, report.assemblies[0].dimension), (1, 0));
    // 0.9 + 0.2 + 0.9 = 2: the bead is in the middle
    let [x, y, z] = report.assemblies[0].platforms.get("p0").unwrap().position;
    let off = (x - 1.0).abs().max(y.abs()).max(z.abs());
    assert!(off < 1e-6, "{off}");
    let said = text::render(&report.document());
    let sentence = "1 assembly was found. It is isolated, at the limit of what is possible; in general 3 freedoms are \
                    left with what is held.";
    assert!(said.contains(sentence), "{said}");
    // infinitely many complex solutions pass through it: it has no multiplicity
    assert!(
        !said.contains("-fold") && !said.contains("is double"),
        "{said}"
    );
}

#[test]
fn a_little_slack_leaves_infinitely_many() {
    let report = bead(1.9);
    assert!(report.assemblies.iter().all(|a| a.multiplicity == 0));
    assert!(report.document().answer.contains("Infinitely many"));
}

#[test]
fn a_bead_between_stretched_rods_is_isolated_whatever_their_direction() {
    for (line, body) in LINES {
        let bead = |post| Bead {
            line,
            body,
            ..Bead::of(post)
        };
        let stretched = beads(&[bead(2.0)]);
        assert_eq!(stretched.document().answer, ISOLATED, "{line} {body}");
        assert_eq!(stretched.assemblies[0].dimension, 0);
        let short = beads(&[bead(2.0 + 1e-6)]);
        assert_eq!(short.document().answer, "No assembly was found.");
    }
}

#[test]
fn a_bead_folded_flat_does_not_count_its_spin_either() {
    // 1.2 = 0.2 + 0.5 + 0.5: the ends are too near for the rods to stand any other way
    for (line, body) in LINES {
        let folded = |post| {
            beads(&[Bead {
                line,
                body,
                rods: [1.2, 0.5],
                ..Bead::of(post)
            }])
        };
        let report = folded(0.5);
        assert_eq!(report.document().answer, ISOLATED, "{line} {body}");
        assert_eq!(folded(0.5 - 1e-6).real, 0, "{line} {body}");
    }
}

#[test]
fn the_least_slack_leaves_infinitely_many_whatever_the_direction() {
    for (line, body) in LINES {
        for slack in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let report = beads(&[Bead {
                line,
                body,
                ..Bead::of(2.0 - slack)
            }]);
            assert!(report.real > 0, "{slack} {line} {body}");
            let all = report.assemblies.iter();
            assert!(
                all.clone().all(|a| (a.multiplicity, a.dimension) == (0, 3)),
                "{slack} {line} {body}"
            );
            let answer = report.document().answer;
            let begins = "Infinitely many assemblies: 3 freedoms are left with what is held.";
            assert!(
                answer.starts_with(begins),
                "{slack} {line} {body}: {answer}"
            );
        }
    }
}

#[test]
fn dimensions_of_bodies_apart_add_up() {
    let at = |post, line| Bead {
        line,
        aside: 0.2,
        ..Bead::of(post)
    };
    let far = "T(0, 5, 0), Rz(0.4), Ry(0.3)";
    // where it is stretched, each body turns about the line beside it
    let (straight, slack) = (1, 4);
    for (first, second, dimension) in [
        (2.0, 2.0, 2 * straight),
        (2.0, 1.9, straight + slack),
        (1.9, 2.0, slack + straight),
        (1.9, 1.8, 2 * slack),
    ] {
        let report = beads(&[at(first, "Tx(0)"), at(second, far)]);
        assert!(report.real > 0, "{first} {second}");
        for assembly in &report.assemblies {
            assert_eq!(assembly.dimension, dimension, "{first} {second}");
        }
    }
    let report = beads(&[at(2.0, "Tx(0)"), at(2.1, far)]);
    assert_eq!(report.real, 0);
}

#[test]
fn beads_apart_on_their_own_lines_leave_what_the_slack_ones_leave() {
    for (line, _) in LINES {
        for (first, second) in [(2.0, 1.9), (1.9, 2.0), (2.0, 2.0 - 1e-3), (2.0 - 1e-5, 2.0)] {
            let at = |post, line| Bead {
                line,
                ..Bead::of(post)
            };
            let report = beads(&[at(first, "T(0, 5, 0), Rz(0.4), Ry(0.3)"), at(second, line)]);
            assert!(report.real > 0, "{first} {second} {line}");
            for assembly in &report.assemblies {
                // the spins stand still
                let of = (assembly.multiplicity, assembly.dimension);
                assert_eq!(of, (0, 3), "{first} {second} {line}");
            }
        }
    }
}

#[test]
fn how_far_apart_parts_stand_and_how_they_are_drawn_changes_nothing() {
    // bodies drawn along their line and across it
    let across = r#"Rz("90 deg")"#;
    for (metres, line, body) in [
        (5, r#"Ry("90 deg")"#, across),
        (5, "Rx(0.3)", "Ry(-1.4)"),
        (20, "Tx(0)", "Tx(0)"),
        (20, "Tx(0)", across),
    ] {
        let far = format!("T(0, {metres}, 0), Rz(0.4), Ry(0.3)");
        let far: &'static str = far.leak();
        let both = |first, second| {
            let at = |post, line| Bead {
                line,
                body,
                ..Bead::of(post)
            };
            beads(&[at(first, far), at(second, line)])
        };
        for (first, second) in [(2.0, 1.9), (1.9, 2.0)] {
            let report = both(first, second);
            assert!(report.real > 0, "{metres} {first} {second} {body}");
            for assembly in &report.assemblies {
                let of = (assembly.multiplicity, assembly.dimension);
                assert_eq!(of, (0, 3), "{metres} {first} {second} {body}");
            }
        }
        assert_eq!(both(2.0, 2.0).real, 1, "{metres} {body}");
        assert_eq!(both(1.9, 2.0 + 1e-5).real, 0, "{metres} {body}");
    }
    // nor where the drawing has its origin
    let far = |post| Bead {
        line: "T(0, 100, 0), Rz(0.4), Ry(0.3)",
        body: across,
        ..Bead::of(post)
    };
    assert_eq!(beads(&[far(2.0)]).document().answer, ISOLATED);
    assert_eq!(beads(&[far(2.0 + 1e-5)]).real, 0);
}

#[test]
fn one_assembly_of_infinitely_many_is_a_sample() {
    let mut report = bead(1.9);
    assert!(report.real > 1);
    let answer = report.document().answer;
    assert!(
        answer.ends_with(" assemblies are listed as samples."),
        "{answer}"
    );
    report.assemblies.truncate(1);
    report.real = 1;
    let answer = report.document().answer;
    assert!(
        answer.ends_with(" 1 assembly is listed as a sample."),
        "{answer}"
    );
}

#[test]
fn rods_as_long_as_two_planes_are_apart_leave_a_set_of_two_dimensions() {
    // each end moves in a plane of its own, and the rod stands upright wherever it stands
    let report = report(
        r#"Mechanism(
            version: 1, name: "points of two planes", convention: Modified,
            joints: { "a": Passive(), "b": Passive(), "c": Passive(home: 0.3), "d": Passive() },
            chains: {
                "below": Chain(base: [Ry("90 deg")], rows: [(d: "a"), (alpha: "90 deg", d: "b")]),
                "above": Chain(base: [Tz(1), Ry("90 deg")], rows: [(d: "c"), (alpha: "90 deg", d: "d")]),
            },
            closures: { "rod": Distance("below", "above", 1) },
        )"#,
    );
    assert!(report.real > 0);
    for assembly in &report.assemblies {
        assert_eq!((assembly.multiplicity, assembly.dimension), (0, 2));
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|q| assembly.joints.get(q).unwrap());
        assert!((a - c).abs() < 1e-5 && (b - d).abs() < 1e-5);
    }
    assert!(!report.document().answer.contains("isolated"));
}

/// Two bodies between rods that reach 3 m; the line of the rods passes beside the origins of both
/// bodies, which may turn about it.
fn bodies(post: f64) -> String {
    format!(
        r#"Mechanism(
            version: 1, name: "two bodies between rods", convention: Modified,
            platforms: {{
                "p": Platform(home: [T(1, -0.2, 0)], frames: {{ "A": [T(0.1, 0.2, 0)], "B": [T(-0.1, 0.2, 0)] }}),
                "q": Platform(home: [T(2, -0.2, 0)], frames: {{ "A": [T(0.1, 0.2, 0)], "B": [T(-0.1, 0.2, 0)] }}),
            }},
            chains: {{ "post": Chain(base: [Tx({post:?})]) }},
            closures: {{
                "r1": Distance("ground", "p.B", 0.9), "r2": Distance("p.A", "q.B", 0.8), "r3": Distance("q.A", "post", 0.9),
            }},
        )"#
    )
}

#[test]
fn rods_that_just_reach_are_assembled_from_aside_and_shorter_ones_are_not() {
    let solved = |post: f64| {
        let mechanism = Mechanism::new(&Description::read(&bodies(post)).unwrap()).unwrap();
        let guesses = [
            ("p.roll", 0.9),
            ("p.y", 0.1),
            ("q.roll", -1.2),
            ("q.z", 0.2),
        ];
        let question = guesses
            .iter()
            .fold(Question::new(mechanism), |q, (name, value)| {
                q.guess(*name, *value)
            });
        match question.solve(&AssemblySettings::default(), &Watch::none()) {
            Ok(Solved::Ended(report)) => report,
            other => panic!("{other:?}"),
        }
    };
    let report = solved(3.0);
    assert!(report.is_assembled(), "{:?}", report.outcome);
    // to the tolerance of a dimensionless residual, over 3 m
    assert!(report.residual <= 1e-12, "{:e}", report.residual);
    // where the slopes vanish positions are known no worse
    for (body, along) in [("p", 1.0), ("q", 2.0)] {
        let [x, y, z] = report.platforms.get(body).unwrap().frame.position;
        assert!((x - along).abs() < 1e-9 && (y.hypot(z) - 0.2).abs() < 1e-9);
    }
    assert!(!solved(3.0 + 1e-6).is_assembled());
}

#[test]
fn bodies_that_turn_about_the_line_of_stretched_rods_are_not_isolated() {
    let report = report(&bodies(3.0));
    // twelve unknowns less three rods in general; here each body only turns
    assert_eq!(report.fit, Fit::FreedomLeft(9));
    assert!(report.real > 0);
    for assembly in &report.assemblies {
        let of = (assembly.multiplicity, assembly.dimension);
        assert_eq!(of, (0, 2), "{assembly:?}");
        for (body, along) in [("p", 1.0), ("q", 2.0)] {
            // the origin goes round the line of the rods, 0.2 m from it
            let [x, y, z] = assembly.platforms.get(body).unwrap().position;
            assert!((x - along).abs() < 1e-6, "{assembly:?}");
            assert!((y.hypot(z) - 0.2).abs() < 1e-6, "{assembly:?}");
        }
    }
    let answer = report.document().answer;
    let begins = "Infinitely many connected assemblies at these inputs: a set of dimension 2";
    let ends =
        "at the limit of what is possible; in general 9 freedoms are left with what is held.";
    assert!(
        answer.starts_with(begins) && answer.ends_with(ends),
        "{answer}"
    );
}

#[test]
fn slack_between_two_bodies_leaves_as_many_dimensions_as_freedoms() {
    let report = report(&bodies(2.9));
    assert_eq!(report.fit, Fit::FreedomLeft(9));
    assert!(report.real > 1);
    assert!(
        report
            .assemblies
            .iter()
            .all(|a| (a.multiplicity, a.dimension) == (0, 9))
    );
}

/// A body between two rods that reach 2 m, from which another hangs at a third one.
fn hanging(post: f64) -> AssembliesReport {
    report(&format!(
        r#"Mechanism(
            version: 1, name: "body hung from stretched rods", convention: Modified,
            platforms: {{
                "p": Platform(home: [Tx(1)], frames: {{ "A": [T(0.1, 0.2, 0)], "B": [T(-0.1, 0.2, 0)], "C": [Ty(-0.2)] }}),
                "q": Platform(home: [T(1, -1, 0)], frames: {{ "A": [Ty(0.1)], "B": [T(0.3, -0.2, 0.1)] }}),
            }},
            chains: {{ "near": Chain(base: [Ty(0.2)]), "far": Chain(base: [T({post:?}, 0.2, 0)]) }},
            closures: {{
                "r1": Distance("near", "p.B", 0.9), "r2": Distance("p.A", "far", 0.9), "r3": Distance("p.C", "q.A", 0.7),
            }},
        )"#
    ))
}

#[test]
fn what_hangs_from_stretched_rods_moves_as_far_as_it_can() {
    // p turns about the line; q moves with its rod on a sphere, and about the end of that
    for (post, dimension) in [(2.0, 1 + 2 + 3), (1.9, 12 - 3)] {
        let report = hanging(post);
        assert!(report.real > 0);
        for assembly in &report.assemblies {
            assert_eq!((assembly.multiplicity, assembly.dimension), (0, dimension));
        }
    }
    assert_eq!(hanging(2.1).real, 0);
}

#[test]
fn rods_stretched_along_two_lines_leave_one_isolated_assembly() {
    let rod = |side: &str| format!(r#""{side}": Distance("{side}", "p.{side}", 0.9)"#);
    let report = report(&format!(
        r#"Mechanism(
            version: 1, name: "body between four rods", convention: Modified,
            platforms: {{ "p": Platform(frames: {{
                "E": [T(0.1, 0, 0.2)], "W": [T(-0.1, 0, 0.2)], "N": [T(0, 0.1, 0.2)], "S": [T(0, -0.1, 0.2)],
            }}) }},
            chains: {{
                "E": Chain(base: [T(1, 0, 0.2)]), "W": Chain(base: [T(-1, 0, 0.2)]),
                "N": Chain(base: [T(0, 1, 0.2)]), "S": Chain(base: [T(0, -1, 0.2)]),
            }},
            closures: {{ {} }},
        )"#,
        ["E", "W", "N", "S"].map(rod).join(", ")
    ));
    // along one line the body would turn about it
    assert_eq!(report.fit, Fit::FreedomLeft(2));
    assert_eq!((report.real, report.assemblies[0].dimension), (1, 0));
    let [x, y, z] = report.assemblies[0].platforms.get("p").unwrap().position;
    assert!(x.abs().max(y.abs()).max(z.abs()) < 1e-6);
    assert!(report.document().answer.contains("It is isolated"));
}
