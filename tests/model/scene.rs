//! Scenes: where bodies and joints of a configuration stand, and how they are drawn.

use linkwork::ask::Question;
use linkwork::output::drawing::{DrawingSettings, Panel, Viewpoint, sheet};
use linkwork::scene::{JointSymbol, Scene};
use linkwork::solve::Watch;

fn scene(file: &str, held: &[(&str, f64)]) -> Scene {
    let mechanism = linkwork::load(format!("mechanisms/{file}.ron")).unwrap();
    let mut question = Question::new(mechanism.clone());
    for (name, value) in held {
        question = question.hold(*name, *value);
    }
    let found = question.configurations(&Watch::none()).unwrap();
    Scene::of(&mechanism, &found[0].1)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b) * (a - b))
        .sum::<f64>()
        .sqrt()
}

/// The links of the shipped 4-bar are 5 m on the ground, 1 m, 3 m and 4 m.
#[test]
fn joints_of_a_four_bar_are_its_link_lengths_apart() {
    let mechanism = linkwork::load("mechanisms/four_bar.ron").unwrap();
    let length = |name: &str| {
        let parameters = mechanism.parameters().iter();
        parameters.clone().find(|p| *p.name == *name).unwrap().value
    };
    let angle = 60_f64.to_radians();
    let scene = scene("four_bar", &[("theta1", angle)]);
    assert_eq!(scene.normal, Some([0.0, 0.0, 1.0]));
    assert_eq!(scene.bodies.len(), 4);
    let at = |name: &str| {
        scene
            .joints
            .iter()
            .find(|joint| joint.names == [name])
            .unwrap()
            .at
    };
    let closure = scene.joints.iter().find(|joint| joint.closure).unwrap();
    assert!(
        scene
            .joints
            .iter()
            .all(|joint| joint.kind == JointSymbol::Revolute)
    );
    // the crank is on the ground at the origin and turned by 60 degrees
    let crank = length("l1");
    let pin = [crank * angle.cos(), crank * angle.sin(), 0.0];
    assert!(distance(at("theta1"), [0.0; 3]) < 1e-12 && distance(at("phi2"), pin) < 1e-9);
    assert!((distance(at("phi2"), closure.at) - length("l2")).abs() < 1e-9);
    assert!((distance(at("phi1"), closure.at) - length("l3")).abs() < 1e-9);
    assert!((distance(at("phi1"), [0.0; 3]) - length("l0")).abs() < 1e-12);
    // driven is the crank alone
    let driven: Vec<&[String]> = scene
        .joints
        .iter()
        .filter(|joint| joint.driven)
        .map(|joint| &joint.names[..])
        .collect();
    assert_eq!(driven, [["theta1"]]);
}

#[test]
fn rods_of_a_hexapod_are_as_long_as_its_legs_and_its_platform_is_one_body() {
    let scene = scene("stewart_gough_6sps", &[]);
    let mechanism = linkwork::load("mechanisms/stewart_gough_6sps.ron").unwrap();
    assert_eq!(scene.normal, None);
    assert_eq!(scene.rods.len(), 6);
    let mut lengths: Vec<f64> = scene
        .rods
        .iter()
        .map(|rod| distance(rod.ends[0], rod.ends[1]))
        .collect();
    let mut legs: Vec<f64> = mechanism.joints().iter().map(|joint| joint.home).collect();
    lengths.sort_by(f64::total_cmp);
    legs.sort_by(f64::total_cmp);
    for (length, leg) in lengths.iter().zip(&legs) {
        assert!((length - leg).abs() < 1e-9, "{length} {leg}");
    }
    let platforms: Vec<_> = scene.bodies.iter().filter(|body| body.platform).collect();
    assert_eq!((platforms.len(), platforms[0].corners.len()), (1, 6));
}

#[test]
fn three_axes_that_meet_are_one_spherical_joint_and_two_a_universal_one() {
    let scene = scene("puma560_modified", &[]);
    let kinds: Vec<(usize, JointSymbol)> = scene
        .joints
        .iter()
        .map(|joint| (joint.names.len(), joint.kind))
        .collect();
    assert!(kinds.contains(&(3, JointSymbol::Spherical)), "{kinds:?}");
    // the axes of the first and the second joint meet in the shoulder; the elbow is alone
    assert!(
        kinds.contains(&(2, JointSymbol::Universal)) && kinds.contains(&(1, JointSymbol::Revolute))
    );
}

#[test]
fn a_scene_is_read_back_from_json() {
    let scene = scene("three_rps", &[]);
    let text = serde_json::to_string(&scene).unwrap();
    assert_eq!(serde_json::from_str::<Scene>(&text).unwrap(), scene);
}

#[test]
fn every_shipped_mechanism_is_drawn_whole_from_every_side() {
    let mut drawn = 0;
    for entry in std::fs::read_dir("mechanisms").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|end| end != "ron") {
            continue;
        }
        let mechanism = linkwork::load(&path).unwrap();
        let scene = Scene::of(&mechanism, &mechanism.home());
        let joints: usize = scene
            .joints
            .iter()
            .filter(|j| !j.closure)
            .map(|j| j.names.len())
            .sum();
        assert!(joints <= mechanism.joints().len() * 4, "{}", path.display());
        for view in [
            Viewpoint::Natural,
            Viewpoint::Isometric,
            Viewpoint::Front,
            Viewpoint::Top,
            Viewpoint::From(0.3, -1.2),
        ] {
            let settings = DrawingSettings { view, labels: true };
            let panel = Panel {
                title: "<&\"".to_owned(),
                scene: scene.clone(),
                ghosts: Vec::new(),
            };
            let text = sheet(&[panel], &settings).svg();
            assert!(
                !text.contains("NaN") && !text.contains("inf"),
                "{}",
                path.display()
            );
            assert!(text.contains("&lt;&amp;") && text.trim_end().ends_with("</svg>"));
            let page = pixels(&text);
            assert!(!page.is_empty(), "{}", path.display());
            for (x, y) in page {
                assert!(
                    (0.0..=640.0).contains(&x) && (0.0..=520.0).contains(&y),
                    "{}: {x}, {y}",
                    path.display()
                );
            }
        }
        drawn += 1;
    }
    assert!(drawn > 40);
}

/// All points of the polygons and lines of a picture.
fn pixels(svg: &str) -> Vec<(f64, f64)> {
    let lists = svg
        .split("points=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap());
    let pairs = lists.flat_map(|list| list.split(' '));
    let number = |text: &str| text.parse::<f64>().unwrap();
    pairs
        .map(|pair| {
            pair.split_once(',')
                .map(|(x, y)| (number(x), number(y)))
                .unwrap()
        })
        .collect()
}

/// The arms of a double wishbone stand on two points each, as the file gives them.
#[test]
fn a_hinge_through_two_points_is_two_bearings() {
    let scene = scene("axes/double_wishbone", &[]);
    let arms = [
        (
            "upper",
            [[-0.12, 0.28, 0.3], [0.18, 0.28, 0.29]],
            [0.015, 0.57, 0.32],
        ),
        (
            "lower",
            [[-0.15, 0.25, 0.12], [0.2, 0.25, 0.13]],
            [0.0, 0.6, 0.11],
        ),
    ];
    for (hinge, points, ball) in arms {
        let bearings = scene.joints.iter().filter(|joint| joint.names == [hinge]);
        let bearings: Vec<_> = bearings.collect();
        assert_eq!(bearings.len(), 2);
        for (bearing, point) in bearings.iter().zip(points) {
            assert!(distance(bearing.at, point) < 1e-12);
            assert_eq!(bearing.kind, JointSymbol::Revolute);
        }
        let arm = scene
            .bodies
            .iter()
            .find(|body| body.name == format!("{hinge} arm"));
        let arm = arm.unwrap();
        let is_corner = |point| arm.corners.iter().any(|at| distance(*at, point) < 1e-9);
        assert!(points.into_iter().chain([ball]).all(is_corner));
        // a link from each bearing to the ball
        for point in points {
            let leads = |line: &Vec<[f64; 3]>| {
                let near = |to| line.iter().any(|at| distance(*at, to) < 1e-9);
                near(point) && near(ball)
            };
            assert!(arm.lines.iter().any(leads), "{hinge}: {:?}", arm.lines);
        }
    }
    let names = |view| {
        let settings = DrawingSettings { labels: true, view };
        let panel = Panel {
            title: String::new(),
            scene: scene.clone(),
            ghosts: Vec::new(),
        };
        sheet(&[panel], &settings).svg().matches(">lower<").count()
    };
    assert_eq!(names(Viewpoint::Natural), 1);
}

/// In a plane of motion the second point only says where the axis leads.
#[test]
fn a_hinge_of_a_plane_is_one_pin() {
    let text = r#"Axes(version: 1, name: "four-bar", joints: {
        "A": Revolute(through: ((0, 0, 0), (0, 0, 1)), role: Actuated, between: ("ground", "crank")),
        "B": Revolute(through: ((0, 1, 0), (0, 1, 1)), between: ("crank", "coupler")),
        "C": Revolute(through: ((3, 2, 0), (3, 2, 1)), between: ("coupler", "rocker")),
        "D": Revolute(through: ((3, 0, 0), (3, 0, 1)), between: ("rocker", "ground")),
    })"#;
    let count = |text: &str| {
        let description = linkwork::description::Description::read(text).unwrap();
        let mechanism = linkwork::mechanism::Mechanism::new(&description).unwrap();
        Scene::of(&mechanism, &mechanism.home()).joints.len()
    };
    assert_eq!(count(text), 4);
    // a spherical one has an outer bearing on each axis: all lead away from one point
    let spherical = text
        .replace("(0, 0, 1)", "(1, 1, -5)")
        .replace("(0, 1, 1)", "(1, 1, -5)");
    let spherical = spherical
        .replace("(3, 2, 1)", "(1, 1, -5)")
        .replace("(3, 0, 1)", "(1, 1, -5)");
    assert_eq!(count(&spherical), 8);
}
