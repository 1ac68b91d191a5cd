//! Mobility against the counts of the literature.

use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use linkwork::analysis::assembly::{AssemblySettings, assemble};
use linkwork::analysis::mobility::{
    Character, LocalFreedom, MobilityReport, MobilitySettings, RedundantWrench, mobility,
};
use linkwork::ask;
use linkwork::description::Description;
use linkwork::geometry::Vector3;
use linkwork::mechanism::Mechanism;
use linkwork::output::Report;
use linkwork::solve::Watch;
use linkwork::system::{Analysed, Question, TwistSpace, check_count};

fn path(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    folder.join(format!("{name}.ron"))
}

fn load(name: &str) -> Mechanism {
    linkwork::load(path(name)).unwrap_or_else(|error| panic!("{name}: {error:?}"))
}

fn read(text: &str) -> Mechanism {
    Mechanism::new(&Description::read(text).unwrap()).unwrap()
}

fn of(mechanism: &Mechanism) -> MobilityReport {
    let question = Question::new(mechanism);
    let answer = mobility(&question, &MobilitySettings::default(), &Watch::none());
    answer
        .closed()
        .unwrap_or_else(|| panic!("{} does not close", mechanism.name()))
}

fn report(name: &str) -> MobilityReport {
    of(&load(name))
}

#[test]
fn counts_are_those_of_the_literature() {
    // mobility, Kutzbach's count, dependent equations; a loop closed by a hinge counts Σf − 6
    let known = [
        ("four_bar", 1, -2, 3),
        ("four_bar_cut1", 1, -2, 3),
        ("four_bar_cut2", 1, -2, 3),
        ("four_bar_cut4", 1, -2, 3),
        ("slider_crank", 1, -2, 3),
        ("spherical_four_bar", 1, -2, 3),
        ("five_bar", 2, -1, 3),
        ("watt_six_bar", 1, -5, 6),
        ("stephenson_six_bar", 1, -5, 6),
        // Bennett 1903: four skew hinges; Goldberg 1943 and Myard 1931: five
        ("bennett", 1, -2, 3),
        ("goldberg_5r", 1, -1, 2),
        ("myard_5r", 1, -1, 2),
        // Bricard 1897, Sarrus 1853, Schatz 1929: six, one more freedom than counted
        ("bricard_line", 1, 0, 1),
        ("bricard_plane", 1, 0, 1),
        ("bricard_trihedral", 1, 0, 1),
        ("sarrus", 1, 0, 1),
        ("schatz", 1, 0, 1),
        ("rssr", 1, 1, 0),
        ("planar_3rpr", 3, -3, 6),
        // Clavel 1988; Lee and Shah 1988; Salisbury 1982; Stewart 1965
        ("delta", 3, 3, 0),
        ("three_rps", 3, 3, 0),
        ("three_fingered_hand", 6, 6, 0),
        ("three_fingered_hand_distances", 6, 6, 0),
        ("stewart_gough_6sps", 6, 6, 0),
        ("stewart_gough_6ups", 6, 6, 0),
        ("dietmaier", 6, 6, 0),
        ("puma560_corke", 6, 6, 0),
    ];
    for (name, freedoms, kutzbach, redundant) in known {
        let report = report(name);
        assert_eq!(report.character, Character::Regular, "{name}");
        assert_eq!(
            (report.mobility, report.kutzbach, report.redundant),
            (freedoms, kutzbach, redundant),
            "{name}"
        );
        assert_eq!(report.infinitesimal, freedoms, "{name}");
        // dimension of the null space: unknowns − rank, none idle in these models
        assert_eq!(report.unknowns - report.rank, freedoms, "{name}");
        assert_eq!(report.equations - report.rank, redundant, "{name}");
        assert!(
            report.idle_joints.is_empty(),
            "{name}: {:?}",
            report.idle_joints
        );
    }
}

#[test]
fn the_orders_of_screw_systems_are_those_of_the_literature() {
    // planar and spherical loops 3; Bennett 3, Goldberg and Myard 4, the 6R linkages 5 (Hunt 1978)
    for (name, order) in [
        ("four_bar", 3),
        ("spherical_four_bar", 3),
        ("bennett", 3),
        ("goldberg_5r", 4),
        ("myard_5r", 4),
        ("bricard_line", 5),
        ("bricard_trihedral", 5),
        ("sarrus", 5),
        ("schatz", 5),
        ("three_rps", 6),
    ] {
        for found in report(name).loops {
            assert_eq!(found.order, order, "{name}");
            assert_eq!(found.by_order, found.freedoms as i64 - order as i64);
        }
    }
}

#[test]
fn the_redundant_constraints_of_planar_loops_are_those_out_of_the_plane() {
    let across = [
        RedundantWrench {
            force: [0.0, 0.0, 1.0],
            moment: [0.0; 3],
        },
        RedundantWrench {
            force: [0.0; 3],
            moment: [1.0, 0.0, 0.0],
        },
        RedundantWrench {
            force: [0.0; 3],
            moment: [0.0, 1.0, 0.0],
        },
    ];
    for name in [
        "four_bar",
        "five_bar",
        "slider_crank",
        "watt_six_bar",
        "planar_3rpr",
    ] {
        for redundancy in report(name).redundancies {
            let unit = |w: &RedundantWrench| {
                let size = |v: &[f64; 3]| v.iter().map(|x| x.abs()).sum::<f64>();
                let (force, moment) = (size(&w.force), size(&w.moment));
                RedundantWrench {
                    force: w.force.map(|x| if force > 0.0 { x / force } else { x }),
                    moment: w.moment.map(|x| if moment > 0.0 { x / moment } else { x }),
                }
            };
            let wrenches: Vec<RedundantWrench> = redundancy.wrenches.iter().map(unit).collect();
            assert_eq!(wrenches, across, "{name}");
        }
    }
}

#[test]
fn three_hinges_meeting_in_a_point_make_the_forces_redundant() {
    let report = report("spherical_four_bar");
    let [redundancy] = &report.redundancies[..] else {
        panic!("{:?}", report.redundancies)
    };
    for (i, wrench) in redundancy.wrenches.iter().enumerate() {
        let along: f64 = wrench.force[i].abs();
        assert!(along > 0.9 && wrench.moment == [0.0; 3], "{wrench:?}");
    }
}

#[test]
fn redundant_wrenches_do_no_work_in_any_motion_of_their_loop() {
    // Bennett's closure carries wrenches that every twist of the link leaves without work
    for name in [
        "bennett",
        "goldberg_5r",
        "myard_5r",
        "bricard_line",
        "schatz",
        "sarrus",
    ] {
        let mechanism = load(name);
        let report = of(&mechanism);
        let mut at = mechanism.home();
        at.joints = report.joints.values().copied().collect();
        let closure = &mechanism.closures()[0];
        let frame = mechanism.poses([closure.frames[0]], &at)[0];
        let twist = &report.twists[0].screws[0];
        let (axis, point) = (Vector3(twist.direction), Vector3(twist.point.unwrap()));
        let velocity = axis.cross(&(frame.position - point));
        for wrench in &report.redundancies[0].wrenches {
            let [force, moment] =
                [wrench.force, wrench.moment].map(|v| frame.rotation * Vector3(v));
            let work = force.dot(&velocity) + moment.dot(&axis);
            assert!(work.abs() < 1e-9, "{name}: {work:e}");
        }
    }
}

fn screws<'a>(report: &'a MobilityReport, body: &str) -> &'a TwistSpace {
    let found = report.twists.iter().find(|space| space.body == body);
    found.unwrap_or_else(|| panic!("no {body}"))
}

#[test]
fn a_delta_shifts_and_a_spherical_wrist_turns() {
    let delta = report("delta");
    let space = screws(&delta, "hand");
    assert_eq!(space.screws.len(), 3);
    assert!(
        space
            .screws
            .iter()
            .all(|s| s.pitch.is_none() && s.point.is_none())
    );
    let wrist = report("spherical_wrist");
    let space = screws(&wrist, "hand");
    assert_eq!(space.screws.len(), 3);
    for screw in &space.screws {
        let point = screw.point.unwrap();
        assert!(screw.pitch == Some(0.0) && point.iter().all(|x| x.abs() < 1e-9));
    }
}

#[test]
fn every_twist_of_a_3_rps_is_reciprocal_to_the_forces_of_its_legs() {
    // a leg keeps its ball from moving along the axis of its hinge (Hunt 1983)
    let mechanism = load("three_rps");
    let report = of(&mechanism);
    let mut at = mechanism.home();
    at.joints = report.joints.values().copied().collect();
    let space = screws(&report, "top");
    assert_eq!(space.screws.len(), 3);
    for (leg, angle) in [("leg1", 0.0), ("leg2", 120.0), ("leg3", 240.0f64)] {
        let ball = mechanism.pose(leg, &at).unwrap().position;
        let radial = angle.to_radians();
        let hinge = Vector3([(radial - FRAC_PI_2).cos(), (radial - FRAC_PI_2).sin(), 0.0]);
        for screw in &space.screws {
            let axis = Vector3(screw.direction);
            let velocity = match (screw.point, screw.pitch) {
                (Some(point), Some(pitch)) => {
                    axis.cross(&(ball - Vector3(point))) + axis.times(pitch)
                }
                _ => axis,
            };
            assert!(velocity.dot(&hinge).abs() < 1e-9, "{leg}: {screw:?}");
        }
    }
}

#[test]
fn rods_between_balls_spin_and_the_spins_are_not_counted() {
    let report = report("stewart_gough_6sps");
    let rods: Vec<LocalFreedom> = (1..=6)
        .map(|i| LocalFreedom::Rod(format!("leg{i}")))
        .collect();
    assert_eq!((report.mobility, report.idle_freedoms), (6, rods));
}

/// The 6-SPS platform with every leg a chain: three hinges that meet, a slide, a ball.
fn six_sps_of_chains() -> Mechanism {
    let (mut joints, mut chains, mut frames, mut closures) = Default::default();
    for i in 1..=6 {
        let add = |to: &mut String, text: String| to.push_str(&text);
        let angle = 60 * i + 15 * (i % 2);
        let other = 60 * i - 20 * (i % 2);
        add(
            &mut joints,
            format!(
                r#""u{i}": Passive(home: "20 deg"), "v{i}": Passive(home: "80 deg"),
                   "w{i}": Passive(home: "10 deg"), "l{i}": Actuated(home: 1.1),"#
            ),
        );
        add(
            &mut chains,
            format!(
                r#""leg{i}": Chain(base: [Rz("{angle} deg"), Tx(1)], rows: [
                    (theta: "u{i}"), (alpha: "-90 deg", theta: "v{i}"),
                    (alpha: "90 deg", theta: "w{i}", d: "l{i}"),
                ]),"#
            ),
        );
        add(
            &mut frames,
            format!(r#""B{i}": [Rz("{other} deg"), Tx(0.6)],"#),
        );
        add(
            &mut closures,
            format!(r#""B{i}": Spherical("leg{i}", "top.B{i}"),"#),
        );
    }
    read(&format!(
        r#"Mechanism(version: 1, name: "6-SPS", convention: Modified, joints: {{ {joints} }},
            chains: {{ {chains} }},
            platforms: {{ "top": Platform(home: [Tz(0.9)], frames: {{ {frames} }}) }},
            closures: {{ {closures} }})"#
    ))
}

#[test]
fn a_6_sps_of_chains_has_twelve_freedoms_by_count_and_six_of_them_idle() {
    let report = of(&six_sps_of_chains());
    assert_eq!((report.kutzbach, report.mobility), (12, 6));
    assert_eq!(report.idle_freedoms.len(), 6);
    for (i, freedom) in report.idle_freedoms.iter().enumerate() {
        let LocalFreedom::Joints(joints) = freedom else {
            panic!("{freedom:?}")
        };
        assert!(
            joints
                .iter()
                .all(|joint| joint.ends_with(&(i + 1).to_string())),
            "{joints:?}"
        );
    }
}

#[test]
fn a_structure_cannot_move_and_a_shaky_one_only_seems_to() {
    let rigid = report("triangle");
    assert_eq!((rigid.mobility, rigid.infinitesimal), (0, 0));
    assert_eq!(rigid.character, Character::Structure);
    let shaky = report("flat_triangle");
    assert_eq!((shaky.mobility, shaky.infinitesimal), (0, 1));
    assert_eq!(shaky.character, Character::Shaky);
    assert!(shaky.moving_joints.is_empty());
    // bars a = 2 and b = 3 whose middle hinge leaves the line by y gape by y²/2 (1/a + 1/b); along
    // the unit motion of step 0.05 the angles at the posts are 0.05 (3, −5)/√34
    let y = 2.0 * 0.05 * 3.0 / 34f64.sqrt();
    let gap = 0.5 * y * y * (1.0 / 2.0 + 1.0 / 3.0) / 5.0;
    let left = shaky.gap_after_step.unwrap();
    assert!((left / gap - 1.0).abs() < 0.01, "{left:e} {gap:e}");
}

#[test]
fn a_triangle_slightly_off_flat_is_no_mechanism_and_one_too_long_does_not_close() {
    let text = std::fs::read_to_string(path("flat_triangle")).unwrap();
    let shorter = read(&text.replace("Tx(\"l1 + l2\")", "Tx(\"l1 + l2 - 0.1\")"));
    let rigid = of(&shorter);
    assert_eq!((rigid.character, rigid.mobility), (Character::Structure, 0));
    let longer = read(&text.replace("Tx(\"l1 + l2\")", "Tx(\"l1 + l2 + 0.1\")"));
    let question = Question::new(&longer);
    let Analysed::NotClosed(open) =
        mobility(&question, &MobilitySettings::default(), &Watch::none())
    else {
        panic!("closed")
    };
    assert!((open.left.unwrap().distance - 0.1).abs() < 1e-9);
}

#[test]
fn special_linkages_lose_their_motion_with_their_proportions() {
    // the condition of each is broken by a few percent
    for (name, from, to) in [
        (
            "bennett",
            "a*sin(beta)/sin(alpha)",
            "1.05*a*sin(beta)/sin(alpha)",
        ),
        ("myard_5r", "b*sin(alpha)", "1.05*b*sin(alpha)"),
        (
            "bricard_line",
            "(a: \"a1\", alpha: \"alpha1\", d: \"d1\", theta: \"theta4\")",
            "(a: \"1.03*a1\", alpha: \"alpha1\", d: \"d1\", theta: \"theta4\")",
        ),
    ] {
        let text = std::fs::read_to_string(path(name)).unwrap();
        assert!(text.contains(from), "{name}");
        let broken = read(&text.replace(from, to));
        let question = Question::new(&broken);
        match mobility(&question, &MobilitySettings::default(), &Watch::none()) {
            Analysed::NotClosed(_) => {}
            Analysed::Closed(report) => assert_eq!(report.mobility, 0, "{name}"),
            Analysed::TooLarge { .. } => panic!("{name}"),
        }
    }
}

#[test]
fn motions_that_meet_are_told_apart() {
    let change_point = report("parallelogram");
    assert_eq!(change_point.character, Character::Bifurcation);
    assert_eq!((change_point.mobility, change_point.infinitesimal), (1, 2));
    let branches: Vec<usize> = change_point.branches.iter().map(|b| b.mobility).collect();
    assert_eq!(branches, [1, 1]);
    let rhombi = report("two_rhombi");
    assert_eq!(rhombi.character, Character::Kinematotropic);
    let branches: Vec<usize> = rhombi.branches.iter().map(|b| b.mobility).collect();
    assert_eq!(branches, [2, 1]);
    // with the crank on the ground it stands still; with both rhombi open everything moves
    assert!(
        !rhombi.branches[0]
            .moving_joints
            .contains(&"theta".to_owned())
    );
    assert!(
        rhombi.branches[1]
            .moving_joints
            .contains(&"theta".to_owned())
    );
}

#[test]
fn near_singular_is_not_singular() {
    // the unit motion of a parallelogram turns every joint by 1/√3, and at θ = 0 it is singular
    let mechanism = load("parallelogram");
    let at = |degrees: f64| {
        let question = Question::new(&mechanism);
        let question = question.hold("theta1", format!("{degrees:?} deg")).unwrap();
        mobility(&question, &MobilitySettings::default(), &Watch::none())
            .closed()
            .unwrap()
    };
    for degrees in [1e-4, 1e-3, 0.01, 0.1, 1.0f64] {
        let report = at(degrees);
        assert_eq!(report.character, Character::Regular, "{degrees}");
        assert_eq!((report.mobility, report.infinitesimal), (1, 1));
        let distance = 3f64.sqrt() * degrees.to_radians();
        let said = report.singular_at.unwrap();
        assert!((said / distance - 1.0).abs() < 0.05, "{degrees} {said:e}");
    }
    assert_eq!(at(30.0).singular_at, None);
    assert_eq!(at(0.0).character, Character::Bifurcation);
}

#[test]
fn a_platform_between_two_balls_is_named_as_what_spins() {
    // a link between two balls on ground is a structure but for its spin
    let mechanism = read(
        r#"Mechanism(version: 1, name: "strut", convention: Modified, joints: {},
        chains: { "low": Chain(), "high": Chain(base: [T(1, 2, 2)]) },
        platforms: { "strut": Platform(home: [T(0.5, 1, 1)], frames: { "A": [], "B": [T(1, 2, 2)] }) },
        closures: { "A": Spherical("low", "strut.A"), "B": Spherical("high", "strut.B") })"#,
    );
    let report = of(&mechanism);
    assert_eq!(
        (report.mobility, report.infinitesimal, report.kutzbach),
        (0, 0, 0)
    );
    let [LocalFreedom::Platforms { platforms, joints }] = &report.idle_freedoms[..] else {
        panic!("{:?}", report.idle_freedoms)
    };
    assert_eq!(
        (platforms.as_slice(), joints.len()),
        (&["strut".to_owned()][..], 0)
    );
    let [spin] = &report.twists[0].spins[..] else {
        panic!("{:?}", report.twists)
    };
    let along = Vector3(spin.direction).dot(&Vector3([1.0, 2.0, 2.0])) / 3.0;
    assert!((along - 1.0).abs() < 1e-9 && report.twists[0].screws.is_empty());
}

/// Parallelograms of cranks 2 and couplers 4 in line, beside each other.
fn parallelograms(number: usize, more_joints: &str, more_chains: &str) -> Mechanism {
    let (mut joints, mut chains, mut closures) = <(String, String, String)>::default();
    for i in 0..number {
        joints += &format!(
            r#""a{i}": Actuated(home: 0), "b{i}": Passive(home: 0), "c{i}": Passive(home: 0),"#
        );
        chains += &format!(
            r#""l{i}": Chain(base: [Ty("{y}")], rows: [(theta: "a{i}"), (a: 2, theta: "b{i}")],
                   tip: [Tx("4")]),
               "r{i}": Chain(base: [T(4, {y}, 0)], rows: [(theta: "c{i}")], tip: [Tx("2")]),"#,
            y = 9 * i
        );
        closures += &format!(r#""j{i}": Revolute("l{i}", "r{i}"),"#);
    }
    read(&format!(
        r#"Mechanism(version: 1, name: "parallelograms", convention: Modified,
            joints: {{ {joints} {more_joints} }}, chains: {{ {chains} {more_chains} }},
            closures: {{ {closures} }})"#
    ))
}

fn branches_with_seed(mechanism: &Mechanism, seed: u64) -> Vec<usize> {
    let settings = MobilitySettings {
        seed,
        ..MobilitySettings::default()
    };
    let report = mobility(&Question::new(mechanism), &settings, &Watch::none())
        .closed()
        .unwrap();
    report.branches.iter().map(|b| b.mobility).collect()
}

#[test]
fn freedoms_beside_a_bifurcation_are_added_to_each_of_its_branches() {
    // the configurations of independent parts are products: each parallelogram has two branches
    let crank = (
        r#""d": Passive(home: 0.3)"#,
        r#""arm": Chain(base: [Ty("-9")], rows: [(theta: "d")], tip: [Tx("1")])"#,
    );
    for seed in 1..=4 {
        let with_crank = parallelograms(1, crank.0, crank.1);
        assert_eq!(branches_with_seed(&with_crank, seed), [2, 2], "{seed}");
        let two = parallelograms(2, "", "");
        assert_eq!(branches_with_seed(&two, seed), [2; 4], "{seed}");
        let three = parallelograms(3, "", "");
        assert_eq!(branches_with_seed(&three, seed), [3; 8], "{seed}");
    }
}

#[test]
fn branches_are_listed_in_one_order_whatever_the_seed() {
    // parallelogram and antiparallelogram move alike but for the velocity of the coupler
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/parallelogram.ron");
    let printed = |seed| crate::linkwork(&["mobility", file, "--seed", seed]).1;
    let first = printed("1");
    assert!(first.contains("2 branches"), "{first}");
    for seed in ["2", "3", "4", "5", "6", "7"] {
        assert_eq!(printed(seed), first, "{seed}");
    }
}

#[test]
fn branches_of_independent_parts_are_counted_whatever_the_seed() {
    let eight = parallelograms(8, "", "");
    let nine = parallelograms(9, "", "");
    for seed in 1..=3 {
        assert_eq!(branches_with_seed(&eight, seed), [8; 256], "{seed}");
        let settings = MobilitySettings {
            seed,
            ..MobilitySettings::default()
        };
        let report = mobility(&Question::new(&nine), &settings, &Watch::none())
            .closed()
            .unwrap();
        assert_eq!((report.mobility, report.branch_count), (9, 512));
        assert!(report.branches_complete && report.branches.len() == 256);
    }
    // each differs from every other by what moves, or by how
    let report = of(&eight);
    for (i, a) in report.branches.iter().enumerate() {
        assert!(report.branches[..i].iter().all(|b| a != b), "{i}");
    }
}

#[test]
fn four_equal_vertical_rods_under_a_square_plate_have_three_motions() {
    // Rods |R a + t − a|² = h² for a = ±ρx, ±ρy: the sums over opposite corners give
    // R_xx = R_yy and the length of t, the differences that t is orthogonal to (R − 1)x and
    // (R − 1)y, so parallel to the axis n of R unless R = 1. Then t has two freedoms, and else
    // n_x = ±n_y: a turn with a shift along either diagonal. Three surfaces, all smooth, and to
    // second order nothing tells them from the three infinitesimal freedoms.
    let (mut chains, mut frames, mut closures) = <(String, String, String)>::default();
    for i in 0..4 {
        let place = format!(r#"[Rz("{} deg"), Tx(1)]"#, 90 * i);
        chains += &format!(r#""A{i}": Chain(base: {place}),"#);
        frames += &format!(r#""B{i}": {place},"#);
        closures += &format!(r#""leg{i}": Distance("A{i}", "top.B{i}", 1),"#);
    }
    let plate = read(&format!(
        r#"Mechanism(version: 1, name: "plate", convention: Modified, joints: {{}},
            chains: {{ {chains} }},
            platforms: {{ "top": Platform(home: [Tz(1)], frames: {{ {frames} }}) }},
            closures: {{ {closures} }})"#
    ));
    for seed in 1..=8 {
        assert_eq!(branches_with_seed(&plate, seed), [2, 2, 2], "{seed}");
    }
    let report = of(&plate);
    assert_eq!((report.infinitesimal, report.redundant), (3, 1));
    assert!(!report.branches_complete);
    let turning = (report.branches.iter()).filter_map(|branch| {
        let screws = &branch.twists[0].screws;
        let shift = screws.iter().find(|screw| screw.pitch.is_none())?;
        screws
            .iter()
            .any(|s| s.pitch == Some(0.0))
            .then_some(shift.direction)
    });
    let diagonals: Vec<[f64; 3]> = turning.collect();
    assert_eq!(diagonals.len(), 2);
    for [x, y, z] in diagonals {
        assert!(
            (x.abs() - y.abs()).abs() < 1e-3 && z.abs() < 1e-3,
            "{x} {y} {z}"
        );
    }
}

#[test]
fn a_flat_five_bar_moves_on_a_cone() {
    // Links along one line: with rates xᵢ of the direction of each link of length aᵢ (against the
    // line backwards negative) Σ aᵢxᵢ = 0 and to second order Σ aᵢxᵢ² = 0. Of four links
    // 3, 4, −1, −1 on posts 5 apart the form has rank 3 and both signs on the space Σ aᵢxᵢ = 0:
    // a cone of two freedoms, and nothing else.
    let five = |lengths: [f64; 4]| {
        let [a, b, c, d] = lengths;
        read(&format!(
            r#"Mechanism(version: 1, name: "flat five-bar", convention: Modified,
                joints: {{ "p": Passive(home: 0), "q": Passive(home: 0), "r": Passive(home: 0), "s": Passive(home: 0) }},
                chains: {{
                    "left": Chain(rows: [(theta: "p"), (a: {a}, theta: "q"), (a: {b}, theta: "r"), (a: {c}, theta: "s")], tip: [Tx({d})]),
                    "post": Chain(base: [Tx(5)]),
                }},
                closures: {{ "E": Revolute("left", "post") }})"#
        ))
    };
    let report = of(&five([3.0, 4.0, -1.0, -1.0]));
    assert_eq!((report.mobility, report.infinitesimal), (2, 3));
    assert_eq!(report.character, Character::Singular);
    assert!(report.branches[0].cone && report.branches_complete);
    assert_eq!(report.moving_joints.len(), 4);
    // stretched to the full length the form has one sign: it cannot move
    let report = of(&five([2.0, 1.0, 1.0, 1.0]));
    assert_eq!((report.mobility, report.infinitesimal), (0, 3));
    assert_eq!(report.character, Character::Shaky);
}

#[test]
fn a_plate_on_six_equal_vertical_rods_shifts_or_turns() {
    // shifted by (x, y) all rods tilt alike; turned about the axis they lean as rulings of a
    // hyperboloid and the plate sinks; both at once would need a different sinking of each rod
    let (mut chains, mut frames, mut closures) = <(String, String, String)>::default();
    for i in 0..6 {
        let place = format!(r#"[Rz("{} deg"), Tx(1)]"#, 60 * i);
        chains += &format!(r#""A{i}": Chain(base: {place}),"#);
        frames += &format!(r#""B{i}": {place},"#);
        closures += &format!(r#""leg{i}": Distance("A{i}", "top.B{i}", 1),"#);
    }
    let plate = read(&format!(
        r#"Mechanism(version: 1, name: "plate", convention: Modified, joints: {{}},
            chains: {{ {chains} }},
            platforms: {{ "top": Platform(home: [Tz(1)], frames: {{ {frames} }}) }},
            closures: {{ {closures} }})"#
    ));
    for seed in 1..=8 {
        assert_eq!(branches_with_seed(&plate, seed), [2, 1], "{seed}");
    }
    // shifted the rods are parallel and resist three motions only: shaky, the turn is not finite
    let report = of(&plate);
    assert!(report.branches[0].approximate && !report.branches[0].cone);
}

#[test]
fn three_equal_cranks_in_line_move_whatever_the_seed() {
    // the coupler shifts on a circle, in line as elsewhere
    let (mut joints, mut chains, mut frames, mut closures) =
        <(String, String, String, String)>::default();
    for i in 0..3 {
        let x = 2 * i;
        joints += &format!(r#""q{i}": Passive(home: 0),"#);
        chains +=
            &format!(r#""k{i}": Chain(base: [Tx({x})], rows: [(theta: "q{i}")], tip: [Tx(1)]),"#);
        frames += &format!(r#""B{i}": [Tx({x})],"#);
        closures += &format!(r#""B{i}": Revolute("k{i}", "p.B{i}"),"#);
    }
    let cranks = read(&format!(
        r#"Mechanism(version: 1, name: "cranks", convention: Modified, joints: {{ {joints} }},
            chains: {{ {chains} }},
            platforms: {{ "p": Platform(home: [Tx(1)], frames: {{ {frames} }}) }},
            closures: {{ {closures} }})"#
    ));
    for seed in 1..=8 {
        assert_eq!(branches_with_seed(&cranks, seed), [1], "{seed}");
    }
    // hinges on the line of the cranks move across it: the coupler seems to shift and to turn
    let report = of(&cranks);
    assert_eq!(report.character, Character::Singular);
    assert_eq!((report.mobility, report.infinitesimal), (1, 2));
}

/// Equal cranks 1 m apart at an angle, the tips of neighbours joined by bars of 1 m: parallelograms that fold flat at 0.
fn parallel_cranks(number: usize, radius: f64, angle: f64) -> Mechanism {
    let (x, y) = (radius * angle.cos(), radius * angle.sin());
    let hinge = |name: String, x: f64, y: f64, between: [String; 2]| {
        format!(
            r#""{name}": Revolute(point: ({x:?}, {y:?}, 0), direction: (0, 0, 1), between: {between:?}),"#
        )
        .replace('[', "(")
        .replace(']', ")")
    };
    let mut joints = String::new();
    for i in 0..number {
        let (at, crank) = (i as f64, format!("crank {i}"));
        joints += &hinge(format!("q{i}"), at, 0.0, ["ground".into(), crank.clone()]);
        if i > 0 {
            let bar = format!("bar {i}");
            let before = format!("crank {}", i - 1);
            joints += &hinge(format!("a{i}"), at - 1.0 + x, y, [before, bar.clone()]);
            joints += &hinge(format!("b{i}"), at + x, y, [bar, crank]);
        }
    }
    read(&format!(
        r#"Axes(version: 1, name: "cranks", joints: {{ {joints} }})"#
    ))
}

#[test]
fn beside_a_flat_pose_parallel_cranks_have_one_freedom() {
    let mut singular = 0;
    for (number, radius) in [(4, 0.3), (6, 0.5), (6, 0.3)] {
        for angle in [1e-1, 1e-3, 1e-5, 1e-6, 5e-7, 1e-8] {
            let report = of(&parallel_cranks(number, radius, angle));
            // every loop is a parallelogram: they shift on a circle together
            assert_eq!(report.mobility, 1, "{number} {radius} {angle}");
            let (unknowns, rank) = (report.unknowns, report.rank);
            assert_eq!(rank + report.infinitesimal, unknowns);
            let regular = report.character == Character::Regular;
            assert_eq!(
                regular,
                report.infinitesimal == 1,
                "{number} {radius} {angle}"
            );
            let said = report.document().notes.join(" ");
            // joints of a drawing are 0 in the pose drawn
            let judged = said.contains("The configuration judged, q0 = 0°, ");
            assert_eq!(judged, report.neglected.is_some(), "{said}");
            // far from 1e-7 of the largest on either side nothing has to be said
            assert_eq!(
                judged,
                !regular && angle > 1e-7,
                "{number} {radius} {angle}"
            );
            singular += usize::from(judged);
        }
    }
    assert!(singular >= 4);
}

#[test]
fn the_slack_of_a_shaky_part_is_no_motion() {
    // a crank beside two bars in line between posts, which cannot move
    let mechanism = read(
        r#"Mechanism(version: 1, name: "crank beside a flat triangle", convention: Modified,
            joints: { "d": Passive(home: 0.3), "t": Passive(home: 0), "u": Passive(home: 0) },
            chains: {
                "arm": Chain(rows: [(theta: "d")], tip: [Tx(1)]),
                "bars": Chain(base: [Ty(9)], rows: [(theta: "t"), (a: 2, theta: "u")], tip: [Tx(3)]),
                "post": Chain(base: [T(5, 9, 0)]),
            },
            closures: { "hinge": Revolute("bars", "post") })"#,
    );
    let report = of(&mechanism);
    assert_eq!((report.mobility, report.infinitesimal), (1, 2));
    assert_eq!(report.moving_joints, ["d"]);
    assert_eq!(report.idle_joints, ["t", "u"]);
}

#[test]
fn beside_the_meeting_point_each_motion_is_regular() {
    let mechanism = load("parallelogram");
    for (phi2, phi1) in [("-40 deg", "40 deg"), ("40 deg", "-15 deg")] {
        let question = Question::new(&mechanism).hold("theta1", "40 deg").unwrap();
        let question = question
            .guess("phi2", phi2)
            .unwrap()
            .guess("phi1", phi1)
            .unwrap();
        let report = mobility(&question, &MobilitySettings::default(), &Watch::none())
            .closed()
            .unwrap();
        assert_eq!((report.character, report.mobility), (Character::Regular, 1));
    }
}

#[test]
fn a_mobility_that_depends_on_the_assembly_is_told() {
    // three parallel cranks move; the same plate put on turned is rigid
    let report = report("three_parallel_cranks");
    assert_eq!((report.mobility, report.kutzbach), (1, -6));
    assert!(report.elsewhere.iter().any(|other| other.mobility == 0));
    // an ordinary linkage has the same everywhere
    assert!(self::report("four_bar").elsewhere.is_empty());
    assert!(self::report("three_rps").elsewhere.is_empty());
}

#[test]
fn joints_that_cannot_move_are_named() {
    // a crank beside a triangle: the triangle's hinges are idle
    let mechanism = read(
        r#"Mechanism(version: 1, name: "triangle and crank", convention: Modified,
            joints: { "theta": Passive(home: "55 deg"), "phi": Passive(home: "-97 deg"), "free": Passive(home: 0.3) },
            chains: {
                "bars": Chain(rows: [(theta: "theta"), (a: 2, theta: "phi")], tip: [Tx(2.5)]),
                "post": Chain(base: [Tx(3)]),
                "crank": Chain(rows: [(theta: "free")], tip: [Tx(1)]),
            },
            closures: { "hinge": Revolute("bars", "post") })"#,
    );
    let report = of(&mechanism);
    assert_eq!(report.mobility, 1);
    assert_eq!(report.moving_joints, ["free"]);
    assert_eq!(report.idle_joints, ["theta", "phi"]);
}

#[test]
fn the_gap_of_the_pose_given_is_told_and_an_exact_pose_has_none() {
    // the links of the file end 28 mm apart
    let given = report("four_bar").pose.given_gap.unwrap();
    assert_eq!(given.closure, "joint3");
    let mechanism = load("four_bar");
    let closure = &mechanism.closures()[0];
    let [a, b] = mechanism.poses(closure.frames, &mechanism.home());
    let gap = b.position - a.position;
    assert!((given.distance - gap.dot(&gap).sqrt()).abs() < 1e-12);
    assert_eq!(report("stewart_gough_6sps").pose.given_gap, None);
}

#[test]
fn solving_and_counting_agree_on_the_number_of_freedoms() {
    let files = path("four_bar").parent().unwrap().read_dir().unwrap();
    let paths = files.map(|file| file.unwrap().path());
    for path in paths.filter(|path| path.is_file()) {
        let mechanism = linkwork::load(path).unwrap();
        let report = of(&mechanism);
        if report.character != Character::Regular {
            continue;
        }
        let question = Question::new(&mechanism);
        let solved = assemble(&question, &AssemblySettings::default(), &Watch::none()).unwrap();
        assert_eq!(
            solved.mobility,
            Some(report.mobility),
            "{}",
            mechanism.name()
        );
        for (a, b) in solved.joints.values().zip(report.joints.values()) {
            assert!(
                (a - b).abs() < 1e-9,
                "{}: not the same assembly",
                mechanism.name()
            );
        }
    }
}

#[test]
fn the_same_question_has_the_same_answer() {
    for name in ["two_rhombi", "three_parallel_cranks", "three_rps"] {
        assert_eq!(report(name), report(name));
    }
}

fn locked(name: &str, locks: &[&str]) -> MobilityReport {
    let asked = locks
        .iter()
        .fold(ask::Question::new(load(name)), |q, lock| q.lock(*lock));
    let answer = asked.mobility(&Watch::none()).unwrap();
    answer
        .closed()
        .unwrap_or_else(|| panic!("{name} does not close"))
}

#[test]
fn a_lock_takes_the_freedom_it_drives() {
    // mechanism, what is locked, freedoms, Kutzbach's count: each lock that is independent takes one of both
    let known = [
        ("three_rps", &[][..], 3, 3),
        ("three_rps", &["l1"], 2, 2),
        ("three_rps", &["l1", "l2"], 1, 1),
        ("three_rps", &["l1", "l2", "l3"], 0, 0),
        ("three_rps", &["actuated"], 0, 0),
        // the legs are given by their angles too
        ("three_rps", &["l1", "phi1", "l2"], 0, 0),
        ("stewart_gough_6ups", &["actuated"], 0, 0),
        ("stewart_gough_6ups", &["l1", "l2", "l3", "l4", "l5"], 1, 1),
        ("stewart_gough_6ups", &["top"], 0, 0),
        ("four_bar", &["theta1"], 0, -3),
        ("five_bar", &["theta1"], 1, -2),
        ("five_bar", &["actuated"], 0, -3),
        ("puma560_corke", &["theta4", "theta5", "theta6"], 3, 3),
        ("delta", &["actuated"], 0, 0),
        // two locks of one freedom: one of them is redundant
        ("four_bar", &["theta1", "phi1"], 0, -4),
    ];
    for (name, locks, freedoms, kutzbach) in known {
        let report = locked(name, locks);
        let counts = (report.mobility, report.infinitesimal, report.kutzbach);
        assert_eq!(counts, (freedoms, freedoms, kutzbach), "{name} {locks:?}");
        let character = match freedoms {
            0 => Character::Structure,
            _ => Character::Regular,
        };
        assert_eq!(report.character, character, "{name} {locks:?}");
        let still = report.moving_joints.iter().chain(&report.idle_joints);
        assert!(
            still
                .into_iter()
                .all(|joint| !locks.contains(&joint.as_str())),
            "{name}"
        );
        assert_eq!(
            report.unknowns as i64 - report.equations as i64,
            kutzbach,
            "{name}"
        );
    }
}

#[test]
fn coordinates_of_platforms_are_locked_too() {
    // Lee and Shah 1988: a 3-RPS commands z, roll and pitch; the others follow
    let report = locked("three_rps", &["top.z", "top.roll"]);
    assert_eq!((report.mobility, report.locking), (1, 2));
    assert_eq!(report.locked, ["top.z", "top.roll"]);
    assert_eq!(
        locked("three_rps", &["top.z", "top.roll", "top.pitch"]).mobility,
        0
    );
    assert_eq!(locked("three_rps", &["top"]).locked, ["top"]);
    // with z locked no motion of the platform's origin goes along z
    let report = locked("stewart_gough_6ups", &["top.z"]);
    assert_eq!(
        (report.mobility, report.kutzbach, report.redundant),
        (5, 5, 0)
    );
}

#[test]
fn what_is_locked_stands_where_the_mechanism_is_closed() {
    let held = ask::Question::new(load("four_bar")).hold("theta1", "100 deg");
    let count =
        |question: &ask::Question| question.mobility(&Watch::none()).unwrap().closed().unwrap();
    // what is held chooses the configuration, and moves
    assert_eq!((count(&held).mobility, count(&held).locked.len()), (1, 0));
    let report = count(&held.lock("phi1"));
    assert_eq!(report.mobility, 0);
    assert_eq!(report.locked, ["phi1"]);
    let theta1 = report.joints.get("theta1").unwrap();
    assert!((theta1 - 100f64.to_radians()).abs() < 1e-12, "{theta1}");
    // what does not exist is not locked
    let unknown = ask::Question::new(load("four_bar")).lock("theta9");
    let refused = unknown.mobility(&Watch::none());
    let Err(ask::AskError::Named(item, _)) = refused else {
        panic!("{refused:?}");
    };
    let wrong = &unknown.demands()[item.index];
    assert_eq!(wrong, &ask::Demand::named(ask::Role::Lock, "theta9"));
}

/// Cranks on a line, each joined to the next by a coupler: with every crank and coupler at 0 all bars lie on that line. The
/// first crank is at an angle.
fn cranks_in_a_row(lengths: &[[f64; 2]], angle: f64) -> Mechanism {
    let (mut joints, mut chains, mut closures) = (String::new(), String::new(), String::new());
    let mut pivot = 0.0;
    for (i, [crank, coupler]) in lengths.iter().enumerate() {
        let role = if i == 0 { "Actuated" } else { "Passive" };
        let parallel = lengths.iter().all(|of| of == &lengths[0]);
        let home = if i == 0 || parallel { angle } else { 0.0 };
        joints += &format!("\"t{i}\": {role}(home: {home:?}), ");
        chains += &format!(
            "\"c{i}\": Chain(base: [Tx({pivot:?})], rows: [(theta: \"t{i}\")], tip: [Tx({crank:?})]), "
        );
        if let Some([next, _]) = lengths.get(i + 1) {
            let home = if parallel { -angle } else { 0.0 };
            joints += &format!("\"f{i}\": Passive(home: {home:?}), ");
            chains += &format!(
                "\"k{i}\": Chain(on: \"c{i}\", rows: [(theta: \"f{i}\")], tip: [Tx({coupler:?})]), "
            );
            closures += &format!("\"j{i}\": Revolute(\"k{i}\", \"c{}\"), ", i + 1);
            pivot += crank + coupler - next;
        }
    }
    read(&format!(
        "Mechanism(version: 1, name: \"cranks in a row\", convention: Modified, joints: {{ {joints} }}, \
         chains: {{ {chains} }}, closures: {{ {closures} }})"
    ))
}

#[test]
fn no_pose_near_a_singular_one_has_more_finite_freedoms_than_infinitesimal_ones() {
    let rows = [
        vec![[0.5, 1.0]; 6],
        vec![[0.5, 1.0]; 4],
        vec![
            [1.0, 2.0],
            [-0.7, 1.1],
            [0.4, -1.6],
            [1.3, 0.9],
            [0.6, 2.2],
            [0.8, 1.0],
        ],
        vec![
            [1.0, 3.0],
            [2.0, 1.5],
            [0.9, 2.5],
            [1.7, 1.2],
            [0.8, 3.1],
            [1.1, 1.0],
        ],
        vec![[0.3, 1.0], [0.9, 2.0], [0.5, 0.7], [1.5, 1.0]],
    ];
    for (which, lengths) in rows.iter().enumerate() {
        for k in 1..=9 {
            let mechanism = cranks_in_a_row(lengths, 10f64.powi(-k));
            let question = Question::new(&mechanism);
            let answer = mobility(&question, &MobilitySettings::default(), &Watch::none());
            let Some(report) = answer.closed() else {
                continue;
            };
            let said = format!(
                "row {which} at 1e-{k}: {:?} {}",
                report.character, report.mobility
            );
            assert!(report.mobility <= report.infinitesimal, "{said}");
            assert_eq!(
                report.rank + report.infinitesimal,
                report.unknowns,
                "{said}"
            );
            for branch in &report.branches {
                assert!(branch.mobility <= report.infinitesimal, "{said}");
            }
        }
    }
}

/// Three equal cranks on a rod, their axles 0.8 mm off one line, turn together: A0' = A1' = A2' (parallelograms). Nearly in line
/// with the axles the rod can also be assembled so that nothing moves; that is another assembly. With one crank in another direction the
/// three are a structure everywhere.
#[test]
fn cranks_whose_axles_are_nearly_in_line_turn_though_another_assembly_is_rigid() {
    let cranks = |last: f64| {
        let joint = |k: usize, (x, y): (f64, f64), by: f64| {
            let role = if k == 0 { ", role: Actuated" } else { "" };
            let pin = |name: &str, (x, y): (f64, f64), on: String| {
                format!(
                    r#""{name}{k}": Revolute(point: ({x:.6}, {y:.6}, 0), direction: (0, 0, 1), {on}),"#
                )
            };
            let foot = pin(
                "A",
                (x, y),
                format!(r#"between: ("ground", "crank{k}"){role}"#),
            );
            let end = (x + 0.21, y + 0.13 * by);
            foot + &pin("D", end, format!(r#"between: ("crank{k}", "rod")"#))
        };
        let joints = joint(0, (0.0, 0.0), 1.0)
            + &joint(1, (0.32, 0.0), 1.0)
            + &joint(2, (0.65, -0.0008), last);
        read(&format!(
            r#"Axes(version: 1, name: "cranks", joints: {{ {joints} }})"#
        ))
    };
    let turning = cranks(1.0);
    let question = Question::new(&turning);
    let count = check_count(&question).expect("one crank is driven");
    assert_eq!((count.mobility, count.held), (Some(1), 1));
    let found = of(&turning);
    assert_eq!(found.mobility, 1);
    let structure = cranks(0.9);
    assert!(check_count(&Question::new(&structure)).is_err());
}
