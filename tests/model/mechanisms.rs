//! Every mechanism file is a test: it loads, round-trips, closes at home, has the right Jacobian over
//! every number, and agrees with its own closed forms; deliberately wrong forms are refuted.

use std::path::{Path, PathBuf};

use linkwork::algebra::{Expression, Measure, Node, Operator};
use linkwork::analysis::compare::{CompareSettings, Verdict, compare};
use linkwork::description::{Description, Entry};
use linkwork::geometry::{Axis, Pose};
use linkwork::linear::Factorable;
use linkwork::mechanism::{Configuration, Frame, Kinematics, Mechanism, Role};
use linkwork::number::{Complex, Dual};
use linkwork::solve::Watch;
use linkwork::solve::{Equations, Newton, Stop};
use linkwork::system::{Held, HeldPlatform, System};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let entries = folder
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.is_file()).collect();
    files.sort();
    assert!(files.len() >= 35);
    files
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap().to_str().unwrap().to_owned()
}

fn description(path: &Path) -> Description {
    Description::read(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn mechanism(name: &str) -> Mechanism {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    linkwork::load(folder.join(format!("{name}.ron"))).unwrap()
}

fn all() -> impl Iterator<Item = (String, Mechanism)> {
    files()
        .into_iter()
        .map(|path| (stem(&path), linkwork::load(&path).unwrap()))
}

/// Actuated joints held, all else free.
fn held<T>(mechanism: &Mechanism) -> Held<T> {
    let joints = mechanism.joints().iter();
    Held {
        joints: joints.map(|joint| joint.role == Role::Actuated).collect(),
        platforms: (mechanism.platforms().iter())
            .map(|_| HeldPlatform::Free)
            .collect(),
    }
}

/// Nothing held, so that every column of the Jacobian is there.
fn free<T>(mechanism: &Mechanism) -> Held<T> {
    Held {
        joints: vec![false; mechanism.joints().len()],
        ..held(mechanism)
    }
}

fn solve_from(
    system: &System<f64>,
    start: &Configuration<f64>,
) -> Option<(Configuration<f64>, f64)> {
    let (mut at, mut trial, mut work) = (start.clone(), start.clone(), system.work());
    let report = Newton::default().solve(system, &mut at, &mut trial, &mut work);
    (report.stop == Stop::Solved).then_some((at, report.size.largest))
}

/// Numbers in (−1, 1) that look random and are always the same.
fn noise(i: usize) -> f64 {
    (12.9898 * (i as f64 + 1.0)).sin() * 43758.5453 % 1.0
}

/// Home, shaken so that nothing is special about it.
fn shaken(mechanism: &Mechanism, by: f64) -> Configuration<f64> {
    let system = System::new(mechanism.dimensions(), &free(mechanism));
    let step: Vec<f64> = (0..system.unknowns().len())
        .map(|i| by * noise(i))
        .collect();
    system.displaced(&mechanism.home(), &step)
}

#[test]
fn files_load_without_warnings() {
    for path in files() {
        let loaded = linkwork::load(&path).unwrap_or_else(|error| match error {
            linkwork::description::LoadError::Wrong(error) => panic!("{error}"),
            error => panic!("{error:?}"),
        });
        let warnings: Vec<String> = (loaded.warnings().iter())
            .map(|warning| warning.kind.title())
            .collect();
        // the cut at joint 1 puts couplings -l2, -l1 as link lengths, see its comment
        let expected = match stem(&path).as_str() {
            "four_bar_cut1" => 1,
            _ => 0,
        };
        assert_eq!(warnings.len(), expected, "{}: {warnings:?}", path.display());
    }
}

#[test]
fn descriptions_round_trip() {
    for path in files() {
        let description = description(&path);
        let written = description.to_ron().unwrap();
        assert_eq!(
            Description::read(&written).unwrap(),
            description,
            "{}",
            path.display()
        );
    }
}

#[test]
fn every_mechanism_closes_at_home() {
    for (name, mechanism) in all() {
        let system = System::new(mechanism.dimensions(), &held(&mechanism));
        let (at, residual) = solve_from(&system, &mechanism.home()).expect(&name);
        assert!(residual <= 1e-12, "{name}: {residual}");
        // home is where the drawing says it is: joints move by less than a few degrees
        let joints = mechanism.joints().iter().zip(&at.joints).enumerate();
        for (i, (joint, value)) in joints {
            let moved = (value - joint.home).abs() / system.joint_scale(i);
            assert!(moved < 0.2, "{name}: {} moved by {moved}", joint.name);
        }
    }
}

/// The residual's derivative along unknown `k` by duals, and the Jacobian's column over duals.
fn dual_column(mechanism: &Mechanism, at: &Configuration<f64>, k: usize) -> (Vec<f64>, Vec<f64>) {
    let dimensions = mechanism.dimensions().map(Dual::constant);
    let system = System::new(&dimensions, &free(mechanism));
    let mut step = vec![Dual::constant(0.0); system.unknowns().len()];
    step[k].slope = 1.0;
    let moving = system.displaced(&at.map(Dual::constant), &step);
    let mut work = system.work();
    system.linearise(&moving, &mut work);
    let slopes = system.residual_of(&work).iter().map(|r| r.slope).collect();
    let rows = system.rows();
    let dense = system.dense_jacobian(&work);
    let column = dense[k * rows..][..rows].iter().map(|entry| entry.value);
    (slopes, column.collect())
}

/// The residual's derivative along unknown `k` by a complex step, free of cancellation.
fn complex_column(mechanism: &Mechanism, at: &Configuration<f64>, k: usize) -> Vec<f64> {
    const H: f64 = 1e-30;
    let dimensions = mechanism.dimensions().map(|x| Complex::new(x, 0.0));
    let system = System::new(&dimensions, &free(mechanism));
    let mut step = vec![Complex::new(0.0, 0.0); system.unknowns().len()];
    step[k].im = H;
    let moving = system.displaced(&at.map(|x| Complex::new(x, 0.0)), &step);
    let mut work = system.work();
    system.residual(&moving, &mut work);
    system.residual_of(&work).iter().map(|r| r.im / H).collect()
}

fn difference_column(
    mechanism: &Mechanism,
    system: &System<f64>,
    at: &Configuration<f64>,
    k: usize,
) -> Vec<f64> {
    const H: f64 = 1e-5;
    let residual = |h: f64| {
        let mut step = vec![0.0; system.unknowns().len()];
        step[k] = h;
        let mut work = system.work();
        system.residual(&system.displaced(at, &step), &mut work);
        system.residual_of(&work).to_vec()
    };
    assert_eq!(mechanism.joints().len(), at.joints.len());
    let (plus, minus) = (residual(H), residual(-H));
    plus.iter()
        .zip(minus)
        .map(|(p, m)| (p - m) / (2.0 * H))
        .collect()
}

#[test]
fn every_jacobian_entry_is_the_derivative_of_its_residual_over_every_number() {
    for (name, mechanism) in all() {
        let system = System::new(mechanism.dimensions(), &free(&mechanism));
        let (rows, columns) = (system.rows(), system.unknowns().len());
        for at in [mechanism.home(), shaken(&mechanism, 0.15)] {
            let mut work = system.work();
            system.linearise(&at, &mut work);
            let jacobian = system.dense_jacobian(&work);
            for k in 0..columns {
                let column = &jacobian[k * rows..][..rows];
                let (dual, over_duals) = dual_column(&mechanism, &at, k);
                let complex = complex_column(&mechanism, &at, k);
                let differences = difference_column(&mechanism, &system, &at, k);
                for row in 0..rows {
                    let entry = column[row];
                    let place = format!("{name}, row {row}, {:?}", system.unknowns()[k]);
                    // residuals may be large far from closed, and differences lose half the digits
                    let size = 1.0 + entry.abs() + work_size(&system, &work);
                    assert!((entry - dual[row]).abs() <= 1e-13 * size, "dual: {place}");
                    assert!(
                        (entry - over_duals[row]).abs() <= 1e-13 * size,
                        "over duals: {place}"
                    );
                    assert!(
                        (entry - complex[row]).abs() <= 1e-13 * size,
                        "complex: {place}"
                    );
                    let error = (entry - differences[row]).abs();
                    assert!(error <= 1e-8 * size, "differences: {place}: {error}");
                }
            }
        }
    }
}

fn work_size(system: &System<f64>, work: &linkwork::system::SystemWork<f64>) -> f64 {
    let largest = system.residual_of(work).iter();
    largest.fold(0.0, |m: f64, r| m.max(r.abs()))
}

/// Residuals over a number type whose values are those reals.
fn residual_over<T: Factorable>(mechanism: &Mechanism, at: &Configuration<f64>) -> Vec<T> {
    let system = System::new(&mechanism.dimensions().map(T::from_f64), &free(mechanism));
    let mut work = system.work();
    system.residual(&at.map(T::from_f64), &mut work);
    system.residual_of(&work).to_vec()
}

#[test]
fn residuals_and_frames_agree_across_numbers() {
    for (name, mechanism) in all() {
        let at = shaken(&mechanism, 0.1);
        let real = residual_over::<f64>(&mechanism, &at);
        let complex = residual_over::<Complex<f64>>(&mechanism, &at);
        let dual = residual_over::<Dual<f64>>(&mechanism, &at);
        let both = residual_over::<Dual<Complex<f64>>>(&mechanism, &at);
        for i in 0..real.len() {
            let size = 1.0 + real[i].abs();
            assert!((complex[i].re - real[i]).abs() <= 1e-14 * size, "{name}");
            assert_eq!((complex[i].im, dual[i].slope), (0.0, 0.0), "{name}");
            assert!((dual[i].value - real[i]).abs() <= 1e-14 * size, "{name}");
            assert!(
                (both[i].value - complex[i]).norm() <= 1e-14 * size,
                "{name}"
            );
        }
        let dimensions = mechanism.dimensions().map(|x| Complex::new(x, 0.0));
        let frames = mechanism.frames();
        let kinematics = Kinematics::new(&dimensions, frames.iter().copied());
        let mut placement = kinematics.placement();
        kinematics.place(&at.map(|x| Complex::new(x, 0.0)), &mut placement);
        for frame in frames {
            let lifted = kinematics.pose(frame, &placement).unwrap().map(|z| z.re);
            let real = mechanism.transform(Frame::Ground, frame, &at);
            assert!(distance(&mechanism, &lifted, &real) < 1e-14, "{name}");
        }
    }
}

/// The largest difference of two poses, positions beside the characteristic length.
fn distance(mechanism: &Mechanism, a: &Pose<f64>, b: &Pose<f64>) -> f64 {
    let turns = (a.rotation.rows().into_iter().flatten())
        .zip(b.rotation.rows().into_iter().flatten())
        .map(|(x, y)| (x - y).abs());
    let length = mechanism.characteristic_length();
    let shifts = (a.position.0.iter().zip(b.position.0)).map(|(x, y)| (x - y).abs() / length);
    turns.chain(shifts).fold(0.0, f64::max)
}

#[test]
fn transforms_between_any_two_frames_invert_and_compose() {
    for (name, mechanism) in all() {
        let at = shaken(&mechanism, 0.3);
        let frames = mechanism.frames();
        for (i, &a) in frames.iter().enumerate() {
            let own = mechanism.transform(a, a, &at);
            assert!(
                distance(&mechanism, &own, &Pose::identity()) < 1e-14,
                "{name}"
            );
            assert_eq!(mechanism.frame(&mechanism.frame_name(a)), Some(a), "{name}");
            for &b in &frames[i..] {
                let (ab, ba) = (
                    mechanism.transform(a, b, &at),
                    mechanism.transform(b, a, &at),
                );
                assert!(
                    distance(&mechanism, &(ab * ba), &Pose::identity()) < 1e-13,
                    "{name}"
                );
                assert!(distance(&mechanism, &ab.inverse(), &ba) < 1e-13, "{name}");
                let c = frames[(7 * i + 3) % frames.len()];
                let through = mechanism.transform(a, c, &at) * mechanism.transform(c, b, &at);
                assert!(distance(&mechanism, &through, &ab) < 1e-13, "{name}");
            }
        }
    }
}

#[test]
fn a_transform_along_a_chain_is_the_product_of_its_rows() {
    // Ghosal's rows Rx(α) Tx(a) Rz(θ) Tz(d), multiplied out here by hand
    let mechanism = mechanism("puma560_modified");
    let (a2, a3, d3, d4) = (0.4318, 0.0203, 0.15005, 0.4318);
    let q = [0.1, 0.2, -0.3, 0.4, 0.5, -0.6];
    let right = std::f64::consts::FRAC_PI_2;
    let rows = [
        (0.0, 0.0, 0.0),
        (-right, 0.0, 0.0),
        (0.0, a2, d3),
        (-right, a3, d4),
        (right, 0.0, 0.0),
        (-right, 0.0, 0.0),
    ];
    let mut at = mechanism.home();
    at.joints = q.to_vec();
    let step = |(alpha, a, d): (f64, f64, f64), theta: f64| {
        let shift = |x, z| Pose::translation(linkwork::geometry::Vector3([x, 0.0, z]));
        Pose::rotation(Axis::X, alpha)
            * shift(a, 0.0)
            * Pose::rotation(Axis::Z, theta)
            * shift(0.0, d)
    };
    for from in 0..=6 {
        for to in from..=6 {
            let product = (from..to).fold(Pose::identity(), |t, i| t * step(rows[i], q[i]));
            let link = |row| Frame::Link { chain: 0, row };
            let forward = mechanism.transform(link(from), link(to), &at);
            let backward = mechanism.transform(link(to), link(from), &at);
            assert!(distance(&mechanism, &forward, &product) < 1e-14);
            assert!(distance(&mechanism, &backward, &product.inverse()) < 1e-14);
        }
    }
}

#[test]
fn every_closed_form_agrees_with_the_chains() {
    for (name, mechanism) in all() {
        let report = compare(&mechanism, &CompareSettings::default(), &Watch::none());
        for form in &report.closed_forms {
            assert_eq!(form.verdict, Verdict::Agrees, "{name}: {form:#?}");
            assert!(
                form.samples >= 30,
                "{name}, {}: {}",
                form.name,
                form.samples
            );
            // agreement to rounding, far below the tolerance
            let worst = form
                .components
                .iter()
                .map(|c| c.relative)
                .fold(0.0, f64::max);
            assert!(worst < 1e-11, "{name}, {}: {worst}", form.name);
        }
    }
}

/// An expression with the sign of one of its terms turned, for every term that can be.
fn with_a_wrong_sign(entry: &Entry) -> Vec<Entry> {
    fn variants(e: &Expression) -> Vec<Expression> {
        let at = |node: Node<String>| node.at(e.span.clone());
        let same = |e: &Expression| Box::new(e.clone());
        match &e.node {
            Node::Binary(op @ (Operator::Add | Operator::Subtract), x, y) => {
                let flipped = match op {
                    Operator::Add => Operator::Subtract,
                    _ => Operator::Add,
                };
                let mut all = vec![at(Node::Binary(flipped, same(x), same(y)))];
                all.extend(
                    (variants(x).into_iter()).map(|x| at(Node::Binary(*op, Box::new(x), same(y)))),
                );
                all
            }
            Node::Negate(x) => vec![(**x).clone()],
            _ => vec![at(Node::Negate(same(e)))],
        }
    }
    let wrong = variants(&entry.expression).into_iter();
    wrong
        .map(|expression| Entry {
            expression,
            span: entry.span.clone(),
        })
        .collect()
}

/// Whether a mechanism with other closed forms is refuted.
fn refuted(description: &Description) -> bool {
    let mechanism = Mechanism::new(description).unwrap();
    let settings = CompareSettings {
        samples: 4,
        ..CompareSettings::default()
    };
    let report = compare(&mechanism, &settings, &Watch::none());
    assert_eq!(report.closed_forms.len(), 1);
    report.closed_forms[0].verdict == Verdict::Disagrees
}

#[test]
fn a_wrong_sign_in_any_entry_of_any_closed_form_is_refuted() {
    let mut tried = 0;
    for path in files() {
        let whole = description(&path);
        for form in &whole.closed_forms {
            let mut alone = whole.clone();
            alone.closed_forms = vec![form.clone()];
            let is_pose = form.value.of.is_some();
            let mut try_each = |entry: &Entry, put: &dyn Fn(&mut Description, Entry)| {
                // a sign before an entry that vanishes, like sin(θ) cos(α) at α = 90°, is not wrong
                let mut vanishing = alone.clone();
                put(&mut vanishing, Entry::number(0.0, 0..0));
                if is_pose && !refuted(&vanishing) {
                    return;
                }
                for wrong in with_a_wrong_sign(entry) {
                    let mut changed = alone.clone();
                    let written = format!("{} for {}", wrong.expression, entry.expression);
                    put(&mut changed, wrong);
                    tried += 1;
                    assert!(
                        refuted(&changed),
                        "{}, {}: {written}",
                        stem(&path),
                        form.name.value
                    );
                }
            };
            let form = &form.value;
            for (i, entry) in form.position.iter().flatten().enumerate() {
                try_each(entry, &|d, wrong| {
                    d.closed_forms[0].value.position.as_mut().unwrap()[i] = wrong;
                });
            }
            for (i, row) in form.transform.iter().flatten().enumerate() {
                for (j, entry) in row.iter().enumerate() {
                    try_each(entry, &|d, wrong| {
                        d.closed_forms[0].value.transform.as_mut().unwrap()[i][j] = wrong;
                    });
                }
            }
            for (i, (_, entry)) in form.entries.iter().enumerate() {
                try_each(entry, &|d, wrong| {
                    d.closed_forms[0].value.entries[i].1 = wrong
                });
            }
            let sum = |e: &Entry| {
                matches!(
                    e.expression.node,
                    Node::Binary(Operator::Add | Operator::Subtract, ..)
                )
            };
            if let Some(entry) = form.identity.as_ref().filter(|e| sum(e)) {
                try_each(entry, &|d, wrong| {
                    d.closed_forms[0].value.identity = Some(wrong)
                });
            }
            for (i, named) in form.identities.iter().enumerate() {
                if sum(&named.value) {
                    try_each(&named.value, &|d, wrong| {
                        d.closed_forms[0].value.identities[i].value = wrong;
                    });
                }
            }
        }
    }
    assert!(tried > 300, "{tried}");
}

/// The planar directions of crank, coupler and rocker in a 4-bar file.
fn directions(mechanism: &Mechanism, at: &Configuration<f64>) -> [f64; 3] {
    let value = |name| Some(at.joints[mechanism.joint(name)?]);
    let theta1 = value("theta1").unwrap();
    let coupler = value("phi2").map_or_else(
        || value("phi1").unwrap() - value("phi3").unwrap(),
        |phi2| theta1 + phi2,
    );
    let rocker = value("phi1").unwrap_or_else(|| coupler + value("phi3").unwrap());
    [theta1, coupler, rocker]
}

/// Joint values of a 4-bar file for the given directions.
fn with_directions(
    mechanism: &Mechanism,
    [crank, coupler, rocker]: [f64; 3],
) -> Configuration<f64> {
    let mut at = mechanism.home();
    for (joint, value) in mechanism.joints().iter().zip(&mut at.joints) {
        *value = match joint.name.as_str() {
            "theta1" => crank,
            "phi1" => rocker,
            "phi2" => coupler - crank,
            "phi3" => rocker - coupler,
            name => panic!("{name}"),
        };
    }
    at
}

#[test]
fn a_four_bar_broken_at_any_joint_has_the_same_assemblies_over_a_full_turn() {
    let cuts = [
        "four_bar",
        "four_bar_cut1",
        "four_bar_cut2",
        "four_bar_cut4",
    ]
    .map(mechanism);
    let (l0, l1, l2, l3): (f64, f64, f64, f64) = (5.0, 1.0, 3.0, 4.0);
    for degree in 0..360 {
        let crank = f64::from(degree).to_radians();
        // A sin φ + B cos φ + C = 0: the diagonal from the crank's end to the rocker's pivot
        let (x, y) = (l0 - l1 * crank.cos(), -l1 * crank.sin());
        let diagonal = x.hypot(y);
        let at_pivot = ((l3 * l3 + diagonal * diagonal - l2 * l2) / (2.0 * l3 * diagonal)).acos();
        for side in [1.0, -1.0] {
            let rocker = (-y).atan2(-x) - side * at_pivot;
            let (ex, ey) = (x + l3 * rocker.cos(), y + l3 * rocker.sin());
            let expected = [crank, ey.atan2(ex), rocker];
            for cut in &cuts {
                let system = System::new(cut.dimensions(), &held(cut));
                let mut guess = with_directions(cut, expected);
                for (joint, value) in cut.joints().iter().zip(&mut guess.joints) {
                    if joint.name != "theta1" {
                        *value += 0.1 * side;
                    }
                }
                let (at, residual) =
                    solve_from(&system, &guess).unwrap_or_else(|| panic!("{}", cut.name()));
                assert!(residual <= 1e-12);
                for (found, wanted) in directions(cut, &at).into_iter().zip(expected) {
                    let off = (found - wanted + 3.0 * std::f64::consts::PI)
                        .rem_euclid(std::f64::consts::TAU)
                        - std::f64::consts::PI;
                    assert!(off.abs() < 1e-12, "{} at {degree} deg: {off}", cut.name());
                }
            }
        }
    }
}

#[test]
fn storage_of_another_dimension_forgets_what_affected_a_closure_there() {
    // with k = 0 b does not affect the first loop, which the second still does
    let text = r#"Mechanism(version: 1, name: "coupled", convention: Standard,
        parameters: { "k": 0.5 },
        joints: { "a": Actuated(home: "20 deg"), "b": Passive(home: "30 deg") },
        chains: {
            "one": Chain(rows: [(theta: "a", a: 1), (theta: "k*b", a: 1)]),
            "two": Chain(rows: [(theta: "a", a: 1), (theta: "b", a: 1)]),
            "here": Chain(base: [T(1, 1, 0)]),
            "there": Chain(base: [T(0, 1, 0)]),
        },
        closures: { "p": Spherical("one", "here"), "q": Spherical("two", "there") })"#;
    let description = Description::read(text).unwrap();
    let mechanisms = ["0.5", "0"]
        .map(|k| Mechanism::new(&description.clone().with_parameter("k", k).unwrap()).unwrap());
    let [coupled, free] = mechanisms
        .each_ref()
        .map(|mechanism| System::<f64>::new(mechanism.dimensions(), &free(mechanism)));
    let at = mechanisms[0].home();
    let jacobian = |system: &System<f64>, work: &mut linkwork::system::SystemWork<f64>| {
        system.linearise(&at, work);
        system.dense_jacobian(work)
    };
    let mut work = coupled.work();
    let before = jacobian(&coupled, &mut work);
    free.refit(&mut work);
    let after = jacobian(&free, &mut work);
    assert_eq!(after, jacobian(&free, &mut free.work()));
    assert_ne!(after, before);
    // the column of b over the rows of the first closure
    let column = &after[free.rows()..][..3];
    assert_eq!(column, [0.0; 3]);
}

#[test]
fn other_values_of_parameters_make_what_the_file_makes_with_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms/axes");
    let axes = folder.read_dir().unwrap();
    let axes = axes.map(|entry| entry.unwrap().path());
    let (mut changed, mut refused) = (0, 0);
    for path in files().into_iter().chain(axes) {
        let description = description(&path);
        let mechanism = Mechanism::new(&description).unwrap();
        for (index, parameter) in mechanism.parameters().iter().enumerate() {
            for value in [1.1 * parameter.value + 0.01, 0.0] {
                let unit = match parameter.measure {
                    Measure::Angle => " rad",
                    _ => "",
                };
                let text = format!("{value:?}{unit}");
                let written = description.clone().with_parameter(&parameter.name, &text);
                let written = Mechanism::new(&written.unwrap());
                let given = mechanism.with_values(&[(index, value)]);
                let name = format!("{} with {} = {text}", stem(&path), parameter.name);
                let (Ok(written), Ok(given)) = (&written, &given) else {
                    let given = given.as_ref().err();
                    assert_eq!(given.is_none(), written.is_ok(), "{name}: {given:?}");
                    refused += 1;
                    continue;
                };
                assert_eq!(given.dimensions(), written.dimensions(), "{name}");
                assert_eq!(given.joints(), written.joints(), "{name}");
                assert_eq!(given.home(), written.home(), "{name}");
                let values = |of: &Mechanism| -> Vec<f64> {
                    of.parameters().iter().map(|p| p.value).collect()
                };
                assert_eq!(values(given), values(written), "{name}");
                let neighbour = mechanism.with_values(&[(index, value + 0.01)]).unwrap();
                assert_ne!(values(&neighbour), values(given), "{name}");
                changed += 1;
            }
        }
    }
    assert!(changed > 300 && refused > 0, "{changed}, {refused}");
}

#[test]
fn values_that_make_no_mechanism_are_refused_as_in_the_file() {
    let text = r#"Mechanism(version: 1, name: "slide", convention: Standard,
        parameters: { "low": 0.1, "k": 2 },
        joints: { "s": Actuated(home: "1/k", limits: ("low", 1)) },
        chains: { "one": Chain(rows: [(d: "s")]), "two": Chain(base: [Tz(0.5)]) },
        closures: { "p": Spherical("one", "two") })"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let of = |values: &[(usize, f64)]| {
        let found = mechanism.with_values(values);
        found.map(|of| of.joints()[0].clone()).map_err(|problem| {
            let place = &text[problem.span.clone()];
            (format!("{:?}", problem.kind), place.to_owned())
        })
    };
    let joint = of(&[(0, 0.2), (1, 4.0)]).unwrap();
    assert_eq!((joint.home, joint.limits), (0.25, Some((0.2, 1.0))));
    for (values, kind, place) in [
        ([(0, 2.0)], "LimitsReversed", "low\", 1"),
        ([(1, 0.0)], "NoValue(DivisionByZero)", "k"),
        ([(1, 1e31)], "NoValue(TooLarge", "2"),
        ([(1, f64::NAN)], "NoValue(NotFinite", "2"),
    ] {
        let (found, at) = of(&values).unwrap_err();
        assert!(found.starts_with(kind) && at == place, "{found} at {at}");
    }
    let shaft = r#"Axes(version: 1, name: "shaft", parameters: { "z": 1 }, joints: {
        "in": Revolute(point: (0, 0, 0), direction: (0, 0, "z"), role: Actuated, between: ("ground", "in")),
        "out": Revolute(point: (1, 0, 0), direction: (0, 0, 1), between: ("ground", "in")),
    })"#;
    let shaft = Mechanism::new(&Description::read(shaft).unwrap()).unwrap();
    assert!(shaft.with_values(&[(0, 2.0)]).is_ok());
    let refused = shaft.with_values(&[(0, 0.0)]).unwrap_err();
    assert!(format!("{:?}", refused.kind).contains("NoDirection"));
}
