//! Linkages with many loops: a row of 4-bars, each driven by the rocker of the one before.

use linkwork::analysis::assembly::{AssemblySettings, Outcome, assemble};
use linkwork::analysis::mobility::{Character, MobilityReport, MobilitySettings, mobility};
use linkwork::analysis::statics::statics;
use linkwork::analysis::sweep::{Row, SweepEnd, SweepSettings, sweep};
use linkwork::analysis::velocity::velocity;
use linkwork::description::Description;
use linkwork::mechanism::Mechanism;
use linkwork::solve::{Progress, Watch};
use linkwork::system::{Coordinate, Drive, Driven, Held, Load, Question};

/// `loops` crank-rockers in a row; the rocker angle of one is the crank angle of the next.
fn row_of_four_bars(loops: usize) -> Mechanism {
    row_with(loops, |text| text)
}

/// The same with another text.
fn row_with(loops: usize, change: impl Fn(String) -> String) -> Mechanism {
    let text = change(row_text(loops));
    Mechanism::new(&Description::read(&text).expect("well formed")).expect("meaningful")
}

fn row_text(loops: usize) -> String {
    let mut joints = String::from("\"r0\": Actuated(home: \"60 deg\"),");
    let (mut chains, mut closures) = (String::new(), String::new());
    for k in 0..loops {
        let next = k + 1;
        joints += &format!(
            "\"c{k}\": Passive(home: \"-60 deg\"), \"r{next}\": Passive(home: \"60 deg\"),"
        );
        chains += &format!(
            "\"left{k}\": Chain(base: [Tx(\"{k}*l0\")], rows: [(theta: \"r{k}\"), (a: \"l1\", theta: \"c{k}\")], tip: [Tx(\"l2\")]),
             \"right{k}\": Chain(base: [Tx(\"{next}*l0\")], rows: [(theta: \"r{next}\")], tip: [Tx(\"l3\")]),"
        );
        closures += &format!("\"pin{k}\": Revolute(\"left{k}\", \"right{k}\"),");
    }
    format!(
        "Mechanism(version: 1, name: \"row\", convention: Modified,
            parameters: {{ \"l0\": 4, \"l1\": 2, \"l2\": 4.001, \"l3\": 2.001 }},
            joints: {{ {joints} }}, chains: {{ {chains} }}, closures: {{ {closures} }})"
    )
}

#[test]
fn a_row_of_loops_assembles_in_as_many_steps_however_long_it_is() {
    for loops in [5, 40, 150] {
        let mechanism = row_of_four_bars(loops);
        let report = assemble(
            &Question::new(&mechanism),
            &AssemblySettings::default(),
            &Watch::none(),
        )
        .expect("one input for one freedom");
        assert_eq!(report.outcome, Outcome::Converged, "{loops} loops");
        assert_eq!(report.restarts, 0);
        assert!(report.residual <= 1e-12);
        assert!(
            report.steps <= 12,
            "{} steps for {loops} loops",
            report.steps
        );
    }
}

#[test]
fn a_row_with_an_input_out_of_reach_is_not_said_to_assemble() {
    let mechanism = row_of_four_bars(40);
    let question = Question::new(&mechanism)
        .free("r0")
        .and_then(|q| q.hold("r40", "180 deg"));
    let settings = AssemblySettings {
        restarts: 1,
        ..AssemblySettings::default()
    };
    let report = assemble(
        &question.expect("names of the row"),
        &settings,
        &Watch::none(),
    )
    .expect("one input");
    assert!(
        !matches!(report.outcome, Outcome::Converged),
        "{:?}",
        report.outcome
    );
}

/// More unknowns than all singular values are computed for.
const MANY: usize = 300;

fn mobility_of(mechanism: &Mechanism, locked: &[Coordinate]) -> MobilityReport {
    let settings = MobilitySettings {
        locked: locked.to_vec(),
        ..MobilitySettings::default()
    };
    let report = mobility(&Question::new(mechanism), &settings, &Watch::none());
    report.closed().expect("it closes at home")
}

#[test]
fn the_freedoms_of_a_long_row_are_those_of_a_short_one() {
    for loops in [3, MANY] {
        let report = mobility_of(&row_of_four_bars(loops), &[]);
        assert_eq!((report.mobility, report.rank), (1, 2 * loops));
        // of the five equations of a planar loop three are redundant
        assert_eq!(report.redundant, 3 * loops);
        assert_eq!(report.character, Character::Regular);
        assert_eq!(report.moving_joints.len(), 2 * loops + 1);
        assert_eq!(report.loops.len(), loops);
        assert!(report.loops.iter().all(|one| one.by_order == 1));
        assert!(report.condition > 1.0 && report.condition < 1e7);
    }
}

/// Together a thousand would cost as much as a thousand million of one, and gigabytes.
#[test]
fn the_freedoms_of_loops_that_nothing_joins_are_the_sum_and_a_rod_among_them_spins() {
    for loops in [3, 120, 400] {
        let apart = |mut text: String| {
            // rockers of their own, but for the last
            for k in 1..loops {
                let rocker = format!("rows: [(theta: \"r{k}\")]");
                text = text.replace(&rocker, &format!("rows: [(theta: \"s{k}\")]"));
            }
            let joint = |name: String| format!("\"{name}\": Passive(home: \"60 deg\"),");
            let own = (1..loops).map(|k| joint(format!("s{k}")));
            let ball =
                ["x", "y", "z"].map(|axis| format!("\"{axis}\": Passive(home: \"90 deg\"),"));
            let joints: String = own.chain(ball).collect();
            let rod = "\"rod\": Chain(rows: [(theta: \"x\"), (alpha: \"90 deg\", theta: \"y\"), (alpha: \"90 deg\", theta: \"z\")], tip: [Tx(\"2\")]),
                \"post\": Chain(base: [Tx(\"2\")]),";
            (text.replace("joints: {", &format!("joints: {{ {joints}")))
                .replace("chains: {", &format!("chains: {{ {rod}"))
                .replace(
                    "closures: {",
                    "closures: { \"ball\": Spherical(\"rod\", \"post\"),",
                )
        };
        let report = mobility_of(&row_with(loops, apart), &[]);
        assert_eq!((report.mobility, report.rank), (loops, 2 * loops + 2));
        assert_eq!(report.redundant, 3 * loops + 1);
        assert_eq!(report.character, Character::Regular);
        assert_eq!(report.moving_joints.len(), 3 * loops);
        assert_eq!(report.idle_freedoms.len(), 1);
    }
}

/// From loop to loop the motion changes so much that steps of any length are lost in rounding. To look
/// for branches there would take minutes.
#[test]
fn a_row_too_ill_conditioned_for_steps_is_regular_as_its_equations_are_independent() {
    let lengths = |text: String| text.replace("4.001", "4.1").replace("2.001", "2.1");
    let report = mobility_of(&row_with(1000, lengths), &[]);
    assert_eq!((report.mobility, report.rank), (1, 2000));
    assert_eq!(report.character, Character::Regular);
    assert_eq!(report.moving_joints.len(), 2001);
    // a triangle beside it stands still
    let beside = |text: String| {
        let joints = "joints: { \"ta\": Passive(home: \"50 deg\"), \"tb\": Passive(home: \"-90 deg\"), \"tc\": Passive(),";
        let chains = "chains: { \"tl\": Chain(base: [Ty(\"9\")], rows: [(theta: \"ta\"), (a: \"3\", theta: \"tb\")], tip: [Tx(\"4\")]),
            \"tr\": Chain(base: [Ty(\"9\"), Tx(\"5\")], rows: [(theta: \"tc\")]),";
        let closures = "closures: { \"tri\": Revolute(\"tl\", \"tr\"),";
        let text = lengths(text).replace("joints: {", joints);
        text.replace("chains: {", chains)
            .replace("closures: {", closures)
    };
    let report = mobility_of(&row_with(1000, beside), &[]);
    assert_eq!((report.mobility, report.rank), (1, 2002));
    assert_eq!(report.moving_joints.len(), 2001);
    assert!(
        !report
            .moving_joints
            .iter()
            .any(|joint| joint.starts_with('t'))
    );
}

#[test]
fn a_long_row_with_one_loop_open_doubled_or_locked_is_counted_so() {
    let again = |text: String| {
        text.replace(
            "closures: {",
            "closures: { \"again\": Revolute(\"left150\", \"right150\"),",
        )
    };
    let report = mobility_of(&row_with(MANY, again), &[]);
    assert_eq!((report.mobility, report.redundant), (1, 3 * MANY + 5));
    let open = |text: String| text.replace("\"pin150\": Revolute(\"left150\", \"right150\"),", "");
    let report = mobility_of(&row_with(MANY, open), &[]);
    assert_eq!((report.mobility, report.rank), (3, 2 * MANY - 2));
    let row = row_of_four_bars(MANY);
    let middle = Coordinate::Joint(row.joint("r150").expect("a rocker"));
    let report = mobility_of(&row, &[middle]);
    assert_eq!(
        (report.mobility, report.character),
        (0, Character::Structure)
    );
    assert_eq!(report.redundant, 3 * MANY);
}

#[test]
fn the_rates_of_a_long_row_are_those_of_its_loops_one_by_one() {
    let row = row_of_four_bars(MANY);
    let question = Question::new(&row);
    let mut drive = Drive::still(&question);
    drive.rates = vec![1.0];
    let answer = velocity(&question, &drive, &[], &Watch::none());
    let report = answer.expect("one input").closed().expect("it closes");
    let of = |name: String| {
        let joint = report.joints.iter().find(|joint| joint.name == name);
        let joint = joint.expect("a joint of the row");
        (joint.value, joint.rate.expect("determined"))
    };
    for k in 0..MANY {
        let (crank, rate) = of(format!("r{k}"));
        let (coupler, _) = of(format!("c{k}"));
        let (rocker, found) = of(format!("r{}", k + 1));
        // l1 θ̇₂ sin(θ₂ − θ₃) = l3 θ̇₄ sin(θ₄ − θ₃), the rocker's hinge being at l3 from the post
        let along = crank + coupler;
        let expected = rate * 2.0 * (crank - along).sin() / (2.001 * (rocker - along).sin());
        assert!(
            (found - expected).abs() < 1e-9,
            "loop {k}: {found} {expected}"
        );
    }
}

/// The two angles of the rocker at an angle of the crank (Freudenstein).
fn rockers(crank: f64) -> [f64; 2] {
    let (l0, l1, l2, l3) = (4.0, 2.0, 4.001, 2.001);
    let (x, y) = (l1 * crank.cos() - l0, l1 * crank.sin());
    let far: f64 = x.hypot(y);
    let turn = ((l3 * l3 + far * far - l2 * l2) / (2.0 * l3 * far)).acos();
    [y.atan2(x) - turn, y.atan2(x) + turn]
}

#[test]
fn the_torque_that_holds_a_long_row_is_that_of_virtual_work() {
    let row = row_of_four_bars(MANY);
    let question = Question::new(&row);
    let joint = |name: String| row.joint(&name).expect("a joint of the row");
    let mut load = Load::default();
    load.joints.push((joint(format!("r{MANY}")), 3.0));
    let answer = statics(&question, &load, &Watch::none());
    let report = answer.expect("one input").closed().expect("it closes");
    assert!(report.balanced);
    // of the five equations of a planar loop three carry loads across the plane
    assert_eq!(report.self_stresses, 3 * MANY);
    let closed = mobility_of(&row, &[]);
    let values: Vec<f64> = closed.joints.values().copied().collect();
    let at = |name: String| values[joint(name)];
    let mut torque = 3.0;
    for k in 0..MANY {
        let [crank, coupler] = ["r", "c"].map(|name| at(format!("{name}{k}")));
        let rocker = at(format!("r{}", k + 1));
        let along = crank + coupler;
        torque *= 2.0 * (crank - along).sin() / (2.001 * (rocker - along).sin());
        // the coupler is pulled and pushed along its line alone
        let pin = &report.closures[k];
        let across = pin.force[0] * along.sin() - pin.force[1] * along.cos();
        assert!(across.abs() < 1e-9, "pin {k}: {:?}", pin.force);
        assert_eq!(pin.unique, [true, true, false, false, false, true]);
    }
    assert_eq!(report.actuators.len(), 1);
    let held = &report.actuators[0];
    assert!(
        held.unique && (held.force + torque).abs() < 1e-9,
        "{held:?} {torque}"
    );
}

#[test]
fn a_long_row_is_swept_in_as_many_steps_as_a_short_one_and_every_loop_keeps_its_branch() {
    let mut steps = Vec::new();
    for loops in [20, MANY] {
        let row = row_of_four_bars(loops);
        let input = row.joint("r0").expect("the input");
        let inputs = [Driven {
            coordinate: Coordinate::Joint(input),
            from: 1.0,
            to: 1.4,
        }];
        let question = Question::new(&row).hold("r0", "1").expect("a joint");
        let settings = AssemblySettings::default();
        let start = assemble(&question, &settings, &Watch::none()).expect("one input");
        let mut rows = 0;
        let mut check = |at: &Row| {
            rows += 1;
            let angle = |name: String| at.configuration.joints[row.joint(&name).expect("a joint")];
            for k in 0..loops {
                let [below, _] = rockers(angle(format!("r{k}")));
                let rocker = angle(format!("r{}", k + 1));
                let turns = (rocker - below) / std::f64::consts::TAU;
                assert!(
                    (turns - turns.round()).abs() < 1e-10,
                    "loop {k}: {rocker} {below}"
                );
            }
        };
        let settings = SweepSettings {
            steps: 8,
            ..SweepSettings::default()
        };
        let held = Held::nothing(&row);
        let none = Watch::none();
        let report = sweep(
            &row,
            &held,
            &inputs,
            &start.configuration(),
            &settings,
            &mut check,
            &none,
        );
        assert_eq!(
            (report.ending, rows),
            (SweepEnd::Complete, 9),
            "{:?}",
            report.met
        );
        steps.push(report.sure_steps);
    }
    assert!(steps[1] <= steps[0], "{steps:?}");
}

#[test]
fn a_watch_stops_the_sweep_of_a_long_row() {
    let row = row_of_four_bars(MANY);
    let question = Question::new(&row);
    let settings = AssemblySettings::default();
    let start = assemble(&question, &settings, &Watch::none()).expect("one input");
    let inputs = [Driven {
        coordinate: Coordinate::Joint(row.joint("r0").expect("the input")),
        from: 1.0,
        to: 1.4,
    }];
    let calls = std::sync::atomic::AtomicUsize::new(0);
    let stop = |_: Progress| match calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) {
        0..4 => std::ops::ControlFlow::Continue(()),
        _ => std::ops::ControlFlow::Break(()),
    };
    let settings = SweepSettings::default();
    let held = Held::nothing(&row);
    let watch = Watch::new(&stop);
    let report = sweep(
        &row,
        &held,
        &inputs,
        &start.configuration(),
        &settings,
        &mut |_| {},
        &watch,
    );
    assert!(
        report.interrupted && report.rows < settings.steps,
        "{report:?}"
    );
}

#[test]
fn a_long_row_behind_a_loop_of_two_inputs_is_swept_in_shorter_steps() {
    // the first loop has a joint more: its own rows leave it two freedoms
    let five_bar = |text: String| {
        text.replace(
            "(a: \"l1\", theta: \"c0\")], tip: [Tx(\"l2\")]",
            "(a: \"l1\", theta: \"c0\"), (a: \"l2 / 2\", theta: \"e\")], tip: [Tx(\"l2 / 2\")]",
        )
        .replace("\"r0\": Act", "\"e\": Actuated(home: \"0.3\"), \"r0\": Act")
    };
    let row = row_with(MANY, five_bar);
    let question = Question::new(&row);
    let start = assemble(&question, &AssemblySettings::default(), &Watch::none());
    let start = start.expect("two inputs").configuration();
    let inputs = ["r0", "e"].map(|name| {
        let joint = row.joint(name).expect("an input");
        let from = start.joints[joint];
        Driven {
            coordinate: Coordinate::Joint(joint),
            from,
            to: from + 0.01,
        }
    });
    let settings = SweepSettings {
        steps: 2,
        ..SweepSettings::default()
    };
    let (held, none) = (Held::nothing(&row), Watch::none());
    let report = sweep(&row, &held, &inputs, &start, &settings, &mut |_| {}, &none);
    assert_eq!((report.ending, report.rows), (SweepEnd::Complete, 3));
    assert!(report.sure_steps > 4, "{report:?}");
}
