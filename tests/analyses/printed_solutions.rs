//! Closed forms of the unknowns as they are printed: the Rust compiled and run, the LaTeX set.
#![cfg(feature = "cli")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use linkwork::analysis::formulas::FormulasReport;
use linkwork::ask::Question;
use linkwork::mechanism::{Configuration, JointKind};
use linkwork::output::formulas::{latex, rust};
use linkwork::solve::Watch;

use crate::closed_form::{SOLVED, inverse, load};
use crate::formulas::{functions, run, set_by_katex};

/// Joint values, by which solutions are compared, in rad or m.
const SAME: f64 = 1e-9;

/// A question with its printed solution and the values at which this is called.
struct Printed {
    name: String,
    question: Question,
    report: FormulasReport,
    at: Configuration<f64>,
}

impl Printed {
    fn new(name: &str, question: Question, at: Configuration<f64>) -> Self {
        let report = question.solution(&Watch::none()).unwrap();
        Printed {
            name: name.into(),
            question,
            report,
            at,
        }
    }

    fn signs(&self) -> usize {
        self.report.solution.as_ref().unwrap().signs.len()
    }

    /// The joints whose values the function gives: their numbers, in its order.
    fn found(&self) -> Vec<usize> {
        let joints = self.question.mechanism().joints();
        let steps = &self.report.solution.as_ref().unwrap().steps;
        let steps = steps.iter().filter(|step| step.angle.is_none());
        let number = |name: &str| joints.iter().position(|joint| joint.name == name);
        steps.map(|step| number(&step.name).unwrap()).collect()
    }

    /// Arguments by their names in code.
    fn arguments(&self) -> BTreeMap<String, f64> {
        let mechanism = self.question.mechanism();
        let letters = self.report.letters.iter();
        let mut values: BTreeMap<String, f64> = letters
            .map(|letter| (letter.name.replace('.', "_"), letter.value))
            .collect();
        for (joint, value) in mechanism.joints().iter().zip(&self.at.joints) {
            values.insert(joint.name.clone(), *value);
        }
        for (platform, pose) in mechanism.platforms().iter().zip(&self.at.platforms) {
            let pose = pose.pose();
            let columns = pose.rotation.0.into_iter().chain([pose.position]);
            for (vector, column) in ["n", "s", "a", "p"].into_iter().zip(columns) {
                for (axis, value) in ["x", "y", "z"].into_iter().zip(column.0) {
                    values.insert(format!("{}_{vector}{axis}", platform.name), value);
                }
            }
        }
        values
    }

    /// The printed function as a module, and a program that calls it once for each combination of signs.
    fn program(&self, number: usize) -> (String, String) {
        let text = rust(&self.report);
        let (_, names) = (functions(&text).into_iter())
            .find(|(name, _)| name == "solution")
            .unwrap();
        let values = self.arguments();
        let signs = &self.report.solution.as_ref().unwrap().signs;
        let given = names.iter().map(|name| {
            let sign = signs.iter().position(|sign| sign == name);
            sign.map_or_else(
                || format!("{:?}", values[name]),
                |sign| format!("if k >> {sign} & 1 == 0 {{ 1.0 }} else {{ -1.0 }}"),
            )
        });
        let given: Vec<String> = given.collect();
        let call = format!(
            "    for k in 0..{} {{ println!(\"{{:?}}\", m{number}::solution({})); }}\n",
            1 << signs.len(),
            given.join(", ")
        );
        (format!("mod m{number} {{\n{text}\n}}\n"), call)
    }

    /// How far two solutions are apart: angles of hinges are the same a whole turn on.
    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let joints = self.question.mechanism().joints();
        let pairs = self.found().into_iter().zip(a.iter().zip(b));
        let off = pairs.map(|(joint, (a, b))| match joints[joint].kind {
            JointKind::Revolute => (a - b - TAU * ((a - b) / TAU).round()).abs(),
            _ => (a - b).abs(),
        });
        off.fold(0.0, f64::max)
    }
}

/// What all printed functions give, for all combinations of signs.
fn called(printed: &[Printed]) -> Vec<Vec<Option<Vec<f64>>>> {
    let programs = printed.iter().enumerate().map(|(i, one)| one.program(i));
    let (modules, calls): (String, String) = programs.unzip();
    let said = run(&format!("{modules}fn main() {{\n{calls}}}\n"));
    let mut lines = said.lines().map(|line| {
        let numbers = line.strip_prefix("Some([")?.strip_suffix("])").unwrap();
        Some(numbers.split(", ").map(|x| x.parse().unwrap()).collect())
    });
    let answers = printed
        .iter()
        .map(|one| lines.by_ref().take(1 << one.signs()).collect());
    answers.collect()
}

/// Assemblies are found by homotopies over the complex numbers, which know nothing of these formulas.
#[test]
fn compiled_solutions_are_the_assemblies_and_each_sign_matters() {
    let shipped = SOLVED.iter().map(|(name, _)| (*name, load(name)));
    let held = ["stewart_gough_6sps", "dietmaier", "axes/hexaglide"];
    let held = held.map(|name| (name, inverse(name)));
    let elsewhere = [
        ("four_bar", "theta1", 4.0),
        ("jansen_leg", "theta", -0.5),
        ("rssr", "theta", 2.0),
    ]
    .map(|(name, input, value)| (name, load(name).hold(input, value)));
    let mut printed = Vec::new();
    let mut expected = Vec::new();
    for (name, question) in shipped.chain(held).chain(elsewhere) {
        let found = question.assemblies(Default::default(), &Watch::none());
        let found: Vec<_> = (found.unwrap().assemblies.iter())
            .map(|assembly| assembly.configuration())
            .collect();
        printed.push(Printed::new(name, question, found[0].clone()));
        expected.push(found);
    }
    for ((one, answers), found) in printed.iter().zip(called(&printed)).zip(expected) {
        let name = &one.name;
        let real: Vec<Vec<f64>> = answers.iter().flatten().cloned().collect();
        assert_eq!(real.len(), found.len(), "{name}");
        for configuration in found {
            let joints = one.found().into_iter().map(|i| configuration.joints[i]);
            let joints: Vec<f64> = joints.collect();
            let of = (real.iter()).filter(|answer| one.apart(answer, &joints) < SAME);
            assert_eq!(of.count(), 1, "{name} {joints:?} {real:?}");
        }
        // with a sign reversed it is another one
        for (k, answer) in answers.iter().enumerate() {
            for sign in 0..one.signs() {
                if let (Some(a), Some(b)) = (answer, &answers[k ^ (1 << sign)]) {
                    assert!(one.apart(a, b) > 1e-3, "{name}");
                }
            }
        }
    }
}

/// More is held than these have freedoms, so that no search finds all assemblies: each is closed from where the formulas
/// say, and does not move.
#[test]
fn compiled_solutions_of_overdetermined_legs_close_them() {
    let printed = ["axes/orthoglide", "planar_3rpr", "three_rps", "delta"].map(|name| {
        let question = inverse(name);
        let closed = question.closed(&Watch::none()).unwrap().closed().unwrap();
        Printed::new(name, question, closed.configuration)
    });
    for (one, answers) in printed.iter().zip(called(&printed)) {
        let joints = one.question.mechanism().joints();
        assert!(answers.iter().all(Option::is_some), "{}", one.name);
        for answer in answers.iter().flatten() {
            let found = one.found();
            let named = found.iter().zip(answer);
            let question = named.fold(one.question.clone(), |question, (&joint, value)| {
                question.guess(&joints[joint].name, *value)
            });
            let closed = question.closed(&Watch::none()).unwrap().closed().unwrap();
            let at: Vec<f64> = (found.iter())
                .map(|&joint| closed.configuration.joints[joint])
                .collect();
            assert!(one.apart(answer, &at) < SAME, "{}", one.name);
        }
    }
}

/// Crank and coupler of the 4-bar in line: the rocker turns no farther (law of cosines).
#[test]
fn compiled_solutions_are_refused_beyond_a_dead_point() {
    let (l0, l3, reach) = (5.0f64, 4.0, 4.0f64);
    let dead = PI - ((l0 * l0 + l3 * l3 - reach * reach) / (2.0 * l0 * l3)).acos();
    let question = load("four_bar").free("theta1").hold("phi1", dead + 0.1);
    let home = question.closed(&Watch::none()).unwrap().closed().unwrap();
    let away = [0.1, 1e-6, 0.0, -1e-15, -1e-6, -0.1];
    let printed = away.map(|away| {
        let mut at = home.configuration.clone();
        let joints = question.mechanism().joints();
        let rocker = joints.iter().position(|joint| joint.name == "phi1");
        at.joints[rocker.unwrap()] = dead + away;
        Printed::new("four_bar", question.clone(), at)
    });
    for ((one, answers), away) in printed.iter().zip(called(&printed)).zip(away) {
        let numbers = answers.iter().flatten().flatten();
        assert!(numbers.into_iter().all(|x| x.is_finite()), "{answers:?}");
        let real = answers.iter().flatten().count();
        match away {
            away if away > 1e-9 => assert_eq!(real, 2, "{answers:?}"),
            away if away < -1e-9 => assert_eq!(real, 0, "{answers:?}"),
            _ => assert!(real == 0 || one.signs() == 1, "{answers:?}"),
        }
    }
}

#[test]
fn solutions_in_latex_are_set_by_katex() {
    let shipped = SOLVED.iter().map(|(name, _)| load(name));
    let held = ["stewart_gough_6sps", "three_rps", "delta"].map(inverse);
    let mut whole = String::new();
    for question in shipped.chain(held) {
        whole += &latex(&question.solution(&Watch::none()).unwrap());
    }
    let displays = whole.lines().filter(|line| *line == "\\[").count();
    assert!(displays > 60, "{displays}");
    let Some(set) = set_by_katex(&whole) else {
        return;
    };
    assert_eq!(set, Ok(displays));
    // the same with a brace lost or a command misspelt is refused
    for (of, by) in [("\\sqrt{", "\\sqrt"), ("\\operatorname", "\\operatorame")] {
        assert!(whole.contains(of));
        assert!(set_by_katex(&whole.replacen(of, by, 1)).unwrap().is_err());
    }
}
