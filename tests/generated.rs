//! Solvers written as C and Rust: compiled without warnings, they find what the library finds.

#[path = "generated/branches.rs"]
mod branches;

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwork::algebra::SiUnit;
use linkwork::analysis::solver::{Component, NoSolver, Solver};
use linkwork::ask::{AskError, Question, SampleAnswer, SampleForces, SolverSettings};
use linkwork::description::Description;
use linkwork::linear::singular_values;
use linkwork::mechanism::Mechanism;
use linkwork::output::solver::{Code, Language, Precision};
use linkwork::solve::{Equations, Watch};

/// Configurations that every solver is run through.
const CONFIGURATIONS: usize = 10_000;
/// Every number of a state that is no assembly of any.
const NOWHERE: f64 = 0.123;
/// Unknowns of the largest mechanisms that are compiled.
const MOST_UNKNOWNS: usize = 12;

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn load(name: &str) -> Question {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    Question::new(linkwork::load(folder.join(format!("{name}.ron"))).unwrap())
}

fn written(question: &Question) -> Option<Solver> {
    let solver = question
        .solver_program(&Default::default(), &Watch::none())
        .ok()?;
    (solver.unknowns <= MOST_UNKNOWNS).then_some(solver)
}

/// Every shipped file that has a solver of so many unknowns, with its name in code.
fn shipped() -> Vec<(String, Question, Solver)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
    let mut found = Vec::new();
    for (part, prefix) in [("", ""), ("axes", "axes_")] {
        for file in fs::read_dir(folder.join(part)).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|ending| ending != "ron") {
                continue;
            }
            let question = Question::new(linkwork::load(&path).unwrap());
            if let Some(solver) = written(&question) {
                let stem = path.file_stem().unwrap().to_str().unwrap();
                found.push((format!("{prefix}{stem}"), question, solver));
            }
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(found.len() >= 58, "only {} have a solver", found.len());
    found
}

fn code(language: Language, name: &str) -> Code {
    Code {
        language,
        precision: Precision::Double,
        name: name.into(),
    }
}

fn compiled(command: &mut Command) {
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{said}");
}

fn cc() -> Command {
    let mut cc = Command::new("cc");
    cc.args([
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-pedantic",
        "-O1",
    ]);
    cc
}

fn has_cc() -> bool {
    let has = Command::new("cc").arg("--version").output().is_ok();
    if !has {
        eprintln!("skipped: there is no C compiler here");
    }
    has
}

fn c_program(folder: &Path, main: &str) -> PathBuf {
    let (source, program) = (folder.join("all.c"), folder.join("all_c"));
    fs::write(&source, main).unwrap();
    compiled(cc().arg(&source).arg("-o").arg(&program).arg("-lm"));
    program
}

fn rust_program(folder: &Path, main: &str) -> PathBuf {
    let (source, program) = (folder.join("all.rs"), folder.join("all_rust"));
    fs::write(&source, main).unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    compiled(
        Command::new(rustc)
            .args(["--edition=2021", "-Copt-level=0", "-Dwarnings", "-o"])
            .arg(&program)
            .arg(&source),
    );
    program
}

/// Configurations of all mechanisms as numbers in a file, in the order of the solvers.
fn examples_file(all: &[Vec<SampleAnswer>], path: &Path) {
    let examples = all.iter().flatten();
    let numbers = examples.flat_map(|(inputs, state)| inputs.iter().chain(state));
    let bytes: Vec<u8> = numbers.flat_map(|x| x.to_ne_bytes()).collect();
    fs::write(path, bytes).unwrap();
}

/// Those of the solvers' own questions.
fn examples(solvers: &[(String, Question, Solver)], path: &Path) {
    let of = |(name, question, _): &(String, Question, Solver)| {
        let examples = question.examples(CONFIGURATIONS, &Watch::none()).unwrap();
        assert_eq!(examples.len(), CONFIGURATIONS, "{name} cannot follow");
        examples
    };
    examples_file(&solvers.iter().map(of).collect::<Vec<_>>(), path);
}

/// Reads what a compiled program says of each solver: how many searches failed, of which none may, and the largest
/// difference, which may be such a part of the characteristic length.
fn judged(program: &Path, data: &Path, solvers: &[(String, Question, Solver)], part: f64) {
    judged_with(0, program, data, solvers, part);
}

/// Here so many searches of each solver may fail.
fn judged_with(
    most: usize,
    program: &Path,
    data: &Path,
    solvers: &[(String, Question, Solver)],
    part: f64,
) {
    let output = Command::new(program).arg(data).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(said.lines().count(), solvers.len(), "{said}");
    let mut wrong = String::new();
    for (line, (_, question, _)) in said.lines().zip(solvers) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name, failed, apart] = words[..] else {
            panic!("{line}");
        };
        let apart: f64 = apart.parse().unwrap();
        let limit = part * question.mechanism().characteristic_length().max(1.0);
        let failures: usize = failed.parse().unwrap();
        if failures > most || apart.is_nan() || apart > limit {
            writeln!(wrong, "{name}: {failed} failed, {apart:e} apart").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn solvers_of_every_shipped_file_find_what_the_library_finds() {
    let (folder, solvers) = (folder("generated"), shipped());
    let data = folder.join("examples");
    examples(&solvers, &data);
    judged(
        &all_rust(&folder, &solvers, CONFIGURATIONS),
        &data,
        &solvers,
        1e-12,
    );
    if has_cc() {
        judged(
            &all_c(&folder, &solvers, CONFIGURATIONS),
            &data,
            &solvers,
            1e-12,
        );
    }
}

/// Where the solver begins for each row.
#[derive(Clone, Copy, PartialEq)]
enum From {
    /// Where the row before ended.
    Last,
    /// At its start. A verdict other than SOLVED is counted, and its state not compared.
    Start,
}

/// All solvers as C, and a program that runs them.
fn all_c(folder: &Path, solvers: &[(String, Question, Solver)], count: usize) -> PathBuf {
    c_from(From::Last, folder, solvers, count)
}

fn c_from(
    from: From,
    folder: &Path,
    solvers: &[(String, Question, Solver)],
    count: usize,
) -> PathBuf {
    let mut main = String::from("#include <stdio.h>\n#include <string.h>\n");
    let mut calls = String::new();
    for (name, _, solver) in solvers {
        let text = code(Language::C, name).solver(solver);
        fs::write(folder.join(format!("{name}.h")), text).unwrap();
        let (inputs, state) = (solver.inputs.len(), solver.state.len());
        write!(
            main,
            r#"#include "{name}.h"
static void run_{name}(FILE *file)
{{
    double row[{inputs} + {state}], apart = 0;
    {name}_follower follower = {{{{0}}, {{0}}}};
    int i, k, failed = 0, from_start = {from_start};
    memcpy(follower.state, {name}_start_state, sizeof follower.state);
    for (k = 0; k < {count}; ++k) {{
        int solved;
        failed += fread(row, sizeof row, 1, file) != 1;
        if (from_start) memcpy(follower.state, {name}_start_state, sizeof follower.state);
        solved = {upper}_SOLVED == (from_start ? {name}_solve(row, follower.state) : {name}_follow(&follower, row));
        failed += !solved;
        for (i = 0; i < {state} && (solved || !from_start); ++i) {{
            const double off = fabs(follower.state[i] - row[{inputs} + i]);
            apart = off <= apart ? apart : off;
        }}
    }}
    printf("{name} %d %.3e\n", failed, apart);
}}
"#,
            upper = name.to_uppercase(),
            from_start = i32::from(from == From::Start),
        )
        .unwrap();
        writeln!(calls, "    run_{name}(file);").unwrap();
    }
    write!(
        main,
        "int main(int argc, char **argv)\n{{\n    FILE *file = argc > 1 ? fopen(argv[1], \"rb\") : 0;\n    \
         if (!file) return 1;\n{calls}    return 0;\n}}\n"
    )
    .unwrap();
    c_program(folder, &main)
}

/// All solvers as Rust, and a program that runs them.
fn all_rust(folder: &Path, solvers: &[(String, Question, Solver)], count: usize) -> PathBuf {
    rust_from(From::Last, folder, solvers, count)
}

fn rust_from(
    from: From,
    folder: &Path,
    solvers: &[(String, Question, Solver)],
    count: usize,
) -> PathBuf {
    let mut main = String::from("use std::io::Read;\n");
    let mut calls = String::new();
    for (name, _, solver) in solvers {
        let text = code(Language::Rust, name).solver(solver);
        fs::write(folder.join(format!("{name}.rs")), text).unwrap();
        writeln!(main, "mod {name};").unwrap();
        writeln!(calls, "    run!(file, {name});").unwrap();
    }
    write!(
        main,
        r#"macro_rules! run {{
    ($file:ident, $solver:ident) => {{{{
        use $solver::*;
        let mut follower = Follower::new(START_STATE);
        let (mut failed, mut apart) = (0, 0.0f64);
        let mut read = || {{
            let mut bytes = [0; 8];
            $file.read_exact(&mut bytes).unwrap();
            f64::from_ne_bytes(bytes)
        }};
        for _ in 0..{count} {{
            let inputs = std::array::from_fn::<f64, INPUTS, _>(|_| read());
            let verdict = match {from_start} {{
                true => {{
                    follower.state = START_STATE;
                    solve(&inputs, &mut follower.state)
                }}
                false => follower.solve(&inputs),
            }};
            let solved = verdict == Verdict::Solved;
            failed += usize::from(!solved);
            for x in follower.state {{
                let off = (x - read()).abs();
                let counts = off.is_nan() || off > apart;
                apart = if counts && (solved || !{from_start}) {{ off }} else {{ apart }};
            }}
        }}
        println!("{{}} {{failed}} {{apart:e}}", stringify!($solver));
    }}}};
}}
fn main() {{
    let path = std::env::args().nth(1).unwrap();
    let mut file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
{calls}}}
"#,
        from_start = from == From::Start,
    )
    .unwrap();
    rust_program(folder, &main)
}

/// For all combinations of signs, each from a state that is nothing like it: the verdict and the state of `assembly`, by a program in
/// either language. It is called at the inputs of the start, but for the last solver at those given.
fn assembled(
    language: Language,
    folder: &Path,
    solvers: &[(String, Question, Solver)],
    last: f64,
) -> Vec<Vec<(i32, Vec<f64>)>> {
    let (mut main, mut calls) = (String::new(), String::new());
    for (i, (name, _, solver)) in solvers.iter().enumerate() {
        let inputs = solver
            .inputs
            .iter()
            .map(|input| match i + 1 == solvers.len() {
                true => format!("{last:?}"),
                false => format!("{:?}", input.value),
            });
        let inputs = inputs.collect::<Vec<_>>().join(", ");
        let text = code(language, name).solver(solver);
        let all = 1 << solver.closed.as_ref().unwrap().signs.len();
        match language {
            Language::Rust => {
                fs::write(folder.join(format!("{name}.rs")), text).unwrap();
                writeln!(main, "mod {name};").unwrap();
                write!(
                    calls,
                    r#"    for k in 0..{all} {{
        use {name}::*;
        let (mut x, u) = ([{NOWHERE}; STATE], [{inputs}]);
        let signs = std::array::from_fn(|i| if k >> i & 1 == 0 {{ 1.0 }} else {{ -1.0 }});
        print!("{{}}", assembly(&u, Some(&signs), &mut x) as i32);
        x.iter().for_each(|x| print!(" {{x:e}}"));
        println!();
    }}
"#
                )
                .unwrap();
            }
            Language::C => {
                let upper = name.to_uppercase();
                fs::write(folder.join(format!("{name}.h")), text).unwrap();
                writeln!(main, "#include \"{name}.h\"").unwrap();
                write!(
                    calls,
                    r#"    for (k = 0; k < {all}; ++k) {{
        const double u[] = {{{inputs}}};
        double x[{upper}_STATE], signs[8];
        for (i = 0; i < {upper}_STATE; ++i) x[i] = {NOWHERE};
        for (i = 0; i < 8; ++i) signs[i] = (k >> i) & 1 ? -1 : 1;
        printf("%d", {name}_assembly(u, signs, x));
        for (i = 0; i < {upper}_STATE; ++i) printf(" %.17e", x[i]);
        printf("\n");
    }}
"#
                )
                .unwrap();
            }
        }
    }
    let program = match language {
        Language::Rust => rust_program(folder, &format!("{main}fn main() {{\n{calls}}}\n")),
        Language::C => c_program(
            folder,
            &format!(
                "#include <stdio.h>\n{main}int main(void)\n{{\n    int i, k;\n{calls}    return 0;\n}}\n"
            ),
        ),
    };
    let said = String::from_utf8(Command::new(program).output().unwrap().stdout).unwrap();
    let mut lines = said.lines().map(|line| {
        let (verdict, state) = line.split_once(' ').unwrap();
        let state = state.split(' ').map(|x| x.parse().unwrap());
        (verdict.parse().unwrap(), state.collect())
    });
    let of = |(_, _, solver): &(String, Question, Solver)| {
        let signs = solver.closed.as_ref().unwrap().signs.len();
        lines.by_ref().take(1 << signs).collect()
    };
    solvers.iter().map(of).collect()
}

/// Homotopies over the complex numbers, which know nothing of the formulas, find the assemblies. Where crank and rocker
/// of the 4-bar are too far apart for its coupler there are none, whatever the signs; where bars of the scissor lift
/// or of the inversor are folded onto one another others turn freely, which is said.
#[test]
fn each_combination_of_signs_is_an_assembly_of_its_own() {
    let mut solvers = shipped();
    solvers.retain(|(_, _, solver)| solver.closed.is_some());
    assert!(solvers.len() >= 19, "{} in closed form", solvers.len());
    let rocker = load("four_bar").free("theta1").hold("phi1", 2.4);
    let solver = written(&rocker).unwrap();
    solvers.push(("apart".into(), rocker, solver));
    let mut languages = vec![("signs", Language::Rust)];
    languages.extend(has_cc().then_some(("signs_c", Language::C)));
    let found = solvers.iter().map(|(_, question, solver)| {
        let found = question.assemblies(Default::default(), &Watch::none());
        let mut found = found.unwrap();
        let sets: Vec<usize> = (found.continua.iter())
            .flat_map(|set| set.samples.iter().copied())
            .collect();
        found.assemblies.retain(|one| !sets.contains(&one.mode));
        let found = found.assemblies.into_iter().map(|assembly| {
            let of = |joint: &Component| *assembly.joints.get(&joint.name).unwrap();
            solver.state.iter().map(of).collect()
        });
        found.collect()
    });
    let mut found: Vec<Vec<Vec<f64>>> = found.collect();
    *found.last_mut().unwrap() = Vec::new();
    for (place, language) in languages {
        let answers = assembled(language, &folder(place), &solvers, 2.0);
        for (((name, _, solver), answers), found) in solvers.iter().zip(answers).zip(&found) {
            // not assembled, or undetermined: the state is left as it was
            let (apart, real): (Vec<_>, Vec<_>) =
                (answers.into_iter()).partition(|(_, x)| x.iter().all(|x| *x == NOWHERE));
            assert_eq!(real.len(), found.len(), "{name}");
            for assembly in found {
                let same = (real.iter()).filter(|(_, state)| is_same(solver, state, assembly));
                assert_eq!(same.count(), 1, "{name} {assembly:?}");
            }
            let free = ["axes_scissor_lift", "peaucellier"].contains(&name.as_str());
            let refused = if free { 1 } else { 2 };
            assert!(apart.iter().all(|(v, _)| *v == refused), "{name}");
            assert!(real.iter().all(|(v, _)| *v < 2), "{name}");
        }
    }
}

/// Whether two states are equal but for whole turns of angles.
fn is_same(solver: &Solver, a: &[f64], b: &[f64]) -> bool {
    let pairs = a.iter().zip(b).zip(&solver.state);
    pairs.into_iter().all(|((a, b), component)| {
        let turns = match component.unit {
            SiUnit::RADIAN => ((a - b) / TAU).round(),
            _ => 0.0,
        };
        (a - b - TAU * turns).abs() < 1e-9
    })
}

/// The rocker of the 4-bar turns back where crank and coupler are in line: law of cosines.
#[test]
fn beyond_and_at_a_dead_point_there_is_a_verdict_and_never_nan() {
    if !has_cc() {
        return;
    }
    let (l0, l1, l2, l3) = (5.0f64, 1.0, 3.0, 4.0);
    let reach = l1 + l2;
    let dead =
        std::f64::consts::PI - ((l0 * l0 + l3 * l3 - reach * reach) / (2.0 * l0 * l3)).acos();
    let question = load("four_bar").free("theta1").hold("phi1", dead + 0.1);
    let solver = question
        .solver_program(&Default::default(), &Watch::none())
        .unwrap();
    let folder = folder("dead_point");
    let name = "rocker";
    fs::write(
        folder.join("rocker.h"),
        code(Language::C, name).solver(&solver),
    )
    .unwrap();
    let main = format!(
        r#"#include <stdio.h>
#include "rocker.h"
int main(void)
{{
    const double away[] = {{0.1, 1e-3, 1e-6, 0.0, -1e-6, -1e-3, -0.1, 3.0, NAN, INFINITY}};
    double x[ROCKER_STATE];
    unsigned k;
    int i;
    for (k = 0; k < sizeof away / sizeof *away; ++k) {{
        double u[1], sum = 0;
        for (i = 0; i < ROCKER_STATE; ++i) x[i] = rocker_start_state[i];
        /* near the dead point first, as a motion comes there */
        u[0] = {dead:?} + 0.1;
        if (rocker_solve(u, x) != ROCKER_SOLVED) return 1;
        u[0] = {dead:?} + away[k];
        printf("%d", rocker_solve(u, x));
        for (i = 0; i < ROCKER_STATE; ++i) sum += x[i];
        printf(" %d\n", sum - sum == 0);
    }}
    return 0;
}}
"#
    );
    fs::write(folder.join("main.c"), main).unwrap();
    let program = folder.join("main");
    compiled(
        cc().arg(folder.join("main.c"))
            .arg("-o")
            .arg(&program)
            .arg("-lm"),
    );
    let output = Command::new(&program).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let verdicts: Vec<&str> = said
        .lines()
        .map(|line| line.split(' ').next().unwrap())
        .collect();
    assert!(
        said.lines().all(|line| line.ends_with(" 1")),
        "not a number: {said}"
    );
    // solved to either side of the singular one, not assembled beyond it, bad input
    assert_eq!(verdicts[..2], ["0", "0"], "{said}");
    assert_eq!(verdicts[3], "1", "{said}");
    assert_eq!(verdicts[5..7], ["2", "2"], "{said}");
    assert_eq!(verdicts[8..], ["4", "4"], "{said}");
}

/// Three points at their distances place a body; the sign of its quaternion is that of the last one, unless it is square
/// to it.
#[test]
fn a_platform_on_three_balls_is_placed_from_them() {
    let iterated = |question: &Question| {
        let solver = question.solver_program(&Default::default(), &Watch::none());
        let solver = solver.unwrap();
        (solver.step.len(), solver.placed.len(), solver.unknowns)
    };
    let rps = load("three_rps");
    assert_eq!(iterated(&rps), (3, 7, 9));
    let partly = rps.clone().free("l1").hold("top.z", 0.42);
    assert_eq!(iterated(&partly), (10, 0, 10));
    assert_eq!(iterated(&load("stewart_gough_6sps")), (6, 0, 6));
    if !has_cc() {
        return;
    }
    let solver = rps
        .solver_program(&Default::default(), &Watch::none())
        .unwrap();
    let folder = folder("three_balls");
    let text = code(Language::C, "made").solver(&solver);
    fs::write(folder.join("made.h"), text).unwrap();
    let main = r#"#include <stdio.h>
#include "made.h"
int main(void)
{
    static const double from[][4] = {{1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    int k, i;
    for (k = 0; k < 5; ++k) {
        double x[MADE_STATE], size, off = 0;
        double sign = 0;
        int verdict;
        for (i = 0; i < MADE_STATE; ++i) x[i] = made_start_state[i] + (i < 3 ? 0.01 : 0);
        for (i = 0; i < 4; ++i) x[3 + i] = from[k][i];
        verdict = made_solve(made_start_inputs, x);
        size = x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6] - 1;
        for (i = 0; i < 4; ++i) sign += x[3 + i] * made_start_state[3 + i];
        sign = sign < 0 ? -1 : 1;
        for (i = 0; i < MADE_STATE; ++i) {
            const double gap = x[i] * (i >= 3 && i < 7 ? sign : 1) - made_start_state[i];
            off = off > fabs(gap) ? off : fabs(gap);
        }
        printf("%d %g %g %.1e\n", verdict, sign, fabs(size) < 1e-14 ? 0 : size, off);
    }
    return 0;
}
"#;
    fs::write(folder.join("main.c"), main).unwrap();
    let program = folder.join("main");
    let main = folder.join("main.c");
    compiled(cc().arg(main).arg("-o").arg(&program).arg("-lm"));
    let said = String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
    let lines: Vec<Vec<&str>> = said.lines().map(|line| line.split(' ').collect()).collect();
    let off = |line: &[&str]| line[3].parse::<f64>().unwrap();
    for (line, sign) in lines.iter().zip(["1", "-1"]) {
        assert_eq!(line[..3], ["0", sign, "0"], "{said}");
        assert!(off(line) < 1e-13, "{said}");
    }
    // turned by 180° the search is one over all unknowns, which ends in an assembly or says that it does not
    for line in &lines[2..] {
        assert!(
            ["0", "2", "3", "6"].contains(&line[0]) && line[2] == "0",
            "{said}"
        );
    }
}

#[test]
fn twists_of_frames_are_the_derivatives_of_their_poses() {
    if !has_cc() {
        return;
    }
    for name in ["four_bar", "three_rps", "stewart_gough_6sps"] {
        let question = load(name);
        let mechanism = question.mechanism();
        let frames: Vec<_> = (mechanism.platforms().iter().map(|p| p.name.clone()))
            .chain(mechanism.chains().iter().map(|c| c.name.clone()))
            .map(|name| (name.clone(), mechanism.frame(&name).unwrap()))
            .collect();
        let solver = question
            .solver_program(
                &SolverSettings {
                    frames,
                    ..Default::default()
                },
                &Watch::none(),
            )
            .unwrap();
        let folder = folder(&format!("twists_{name}"));
        fs::write(
            folder.join("made.h"),
            code(Language::C, "made").solver(&solver),
        )
        .unwrap();
        fs::write(
            folder.join("main.c"),
            r#"#include <stdio.h>
#include "made.h"
int main(void)
{
    const double h = 3e-5;
    double worst = 0;
    int f, k, i, c, side;
    for (k = 0; k < MADE_INPUTS; ++k) {
        double pose[5][MADE_FRAMES][12], twist[MADE_FRAMES][MADE_INPUTS][6];
        for (side = -2; side <= 2; ++side) {
            double u[MADE_INPUTS], x[MADE_STATE];
            for (i = 0; i < MADE_INPUTS; ++i) u[i] = made_start_inputs[i] + (i == k ? side * h : 0);
            for (i = 0; i < MADE_STATE; ++i) x[i] = made_start_state[i];
            if (made_solve(u, x) != MADE_SOLVED) return 1;
            if (side != 0) {
                double unused[MADE_FRAMES][MADE_INPUTS][6];
                if (!made_frames(u, x, pose[side + 2], unused)) return 1;
            } else if (!made_frames(u, x, pose[2], twist)) {
                return 1;
            }
        }
        for (f = 0; f < MADE_FRAMES; ++f) {
            const double *t = twist[f][k];
            for (c = 0; c < 4; ++c) {
                /* an axis a moves with omega x a, the origin with v */
                const double *a = pose[2][f] + 3 * c;
                double rate[3];
                rate[0] = c == 3 ? t[0] : t[4] * a[2] - t[5] * a[1];
                rate[1] = c == 3 ? t[1] : t[5] * a[0] - t[3] * a[2];
                rate[2] = c == 3 ? t[2] : t[3] * a[1] - t[4] * a[0];
                for (i = 0; i < 3; ++i) {
                    const int e = 3 * c + i;
                    const double narrow = pose[3][f][e] - pose[1][f][e];
                    const double wide = pose[4][f][e] - pose[0][f][e];
                    const double off = fabs((8 * narrow - wide) / (12 * h) - rate[i]);
                    worst = off <= worst ? worst : off;
                }
            }
        }
    }
    printf("%.3e\n", worst);
    return 0;
}
"#,
        )
        .unwrap();
        let program = folder.join("main");
        compiled(
            cc().arg(folder.join("main.c"))
                .arg("-o")
                .arg(&program)
                .arg("-lm"),
        );
        let output = Command::new(&program).output().unwrap();
        assert!(output.status.success(), "{name} does not solve");
        let worst: f64 = String::from_utf8(output.stdout)
            .unwrap()
            .trim()
            .parse()
            .unwrap();
        assert!(worst < 1e-7, "{name}: {worst:e}");
    }
}

/// A crank that moves nothing else: a closure does not depend on the input, so that functions do not use it.
#[test]
fn code_without_a_use_of_its_inputs_compiles() {
    let text = r#"Mechanism(version: 1, name: "m", convention: Modified,
        joints: { "t": Actuated(home: 0.3), "a": Passive(home: 0.6), "b": Passive(home: 1.2) },
        chains: { "crank": Chain(rows: [(theta: "t")], tip: [Tx(1)]),
            "L": Chain(rows: [(theta: "a"), (a: 1, theta: "b")], tip: [Tx(1)]),
            "P": Chain(base: [Tx(1.5)]) },
        closures: { "k": Revolute("L", "P") })"#;
    let mechanism = Mechanism::new(&Description::read(text).unwrap()).unwrap();
    let question = Question::new(mechanism);
    let solver = written(&question).unwrap();
    let folder = folder("unused");
    let solvers = [("unused".to_owned(), question, solver)];
    let data = folder.join("examples");
    examples(&solvers, &data);
    judged(
        &all_rust(&folder, &solvers, CONFIGURATIONS),
        &data,
        &solvers,
        1e-12,
    );
    if has_cc() {
        judged(
            &all_c(&folder, &solvers, CONFIGURATIONS),
            &data,
            &solvers,
            1e-12,
        );
    }
}

/// Rates against differences of states, the margin against the singular values of the library's Jacobian, and limits.
#[test]
fn rates_margins_and_limits_are_those_of_the_mechanism() {
    if !has_cc() {
        return;
    }
    for name in ["four_bar", "three_rps", "stewart_gough_6sps", "planar_3rpr"] {
        let question = load(name);
        let mut solver = written(&question).unwrap();
        let folder = folder(&format!("rates_{name}"));
        // the first input may not go farther than a little above the start
        let input = &mut solver.inputs[0];
        input.limits = Some((input.value - 1.0, input.value + 1e-3));
        let text = code(Language::C, "made").solver(&solver);
        fs::write(folder.join("made.h"), text).unwrap();
        fs::write(
            folder.join("main.c"),
            r#"#include <stdio.h>
#include "made.h"
int main(void)
{
    const double h = 1e-5;
    static double rate[MADE_STATE][MADE_INPUTS];
    double worst = 0, u[MADE_INPUTS], x[MADE_STATE];
    int k, i, side;
    if (!made_rates(made_start_inputs, made_start_state, rate)) return 1;
    for (k = 0; k < MADE_INPUTS; ++k) {
        double at[2][MADE_STATE];
        for (side = 0; side < 2; ++side) {
            for (i = 0; i < MADE_INPUTS; ++i) u[i] = made_start_inputs[i] + (i == k ? (2 * side - 1) * h : 0);
            for (i = 0; i < MADE_STATE; ++i) at[side][i] = made_start_state[i];
            if (made_solve(u, at[side]) != MADE_SOLVED) return 2;
        }
        for (i = 0; i < MADE_STATE; ++i) {
            worst = made_larger(worst, (at[1][i] - at[0][i]) / (2 * h) - rate[i][k]);
        }
    }
    for (i = 0; i < MADE_INPUTS; ++i) u[i] = made_start_inputs[i] + (i == 0 ? 2e-3 : 0);
    for (i = 0; i < MADE_STATE; ++i) x[i] = made_start_state[i];
    printf("%.3e %.17e %d\n", worst, made_margin(made_start_inputs, made_start_state), made_solve(u, x));
    return 0;
}
"#,
        )
        .unwrap();
        let program = folder.join("main");
        let main = folder.join("main.c");
        compiled(cc().arg(main).arg("-o").arg(&program).arg("-lm"));
        let output = Command::new(&program).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        let words: Vec<f64> = said
            .split_whitespace()
            .map(|x| x.parse().unwrap())
            .collect();
        let [worst, margin, verdict] = words[..] else {
            panic!("{name}: {said} {}", output.status);
        };
        assert!(worst < 1e-5, "{name}: {worst:e}");
        // beyond the limits: the sixth verdict
        assert_eq!(verdict, 5.0, "{name}");
        if solver.placed.is_empty() {
            let least = least_singular_value(&question);
            let unknowns = solver.unknowns as f64;
            let within =
                margin <= least * (1.0 + 1e-6) && margin >= least / unknowns.sqrt() * (1.0 - 1e-6);
            assert!(within, "{name}: {margin} beside {least}");
        }
    }
}

/// Of the Jacobian at the start of the solver.
fn least_singular_value(question: &Question) -> f64 {
    let of = question.resolved().unwrap();
    let report = linkwork::analysis::assembly::assemble(&of, &Default::default(), &Watch::none());
    let (system, at) = (of.system(), report.unwrap().configuration());
    let mut work = system.work();
    system.linearise(&at, &mut work);
    let (rows, unknowns) = (system.rows(), system.unknowns().len());
    let jacobian = system.dense_jacobian(&work);
    *singular_values(rows, unknowns, &jacobian).last().unwrap()
}

/// After inputs changed by 1.1 mm Newton's method ended at another assembly, far from any singularity.
#[test]
fn a_platform_whose_assemblies_are_close_is_followed_on_its_branch() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/close_assemblies.ron");
    let question = Question::new(linkwork::load(path).unwrap());
    let solver = written(&question).unwrap();
    let examples = question.examples(100, &Watch::none()).unwrap();
    assert_eq!(examples.len(), 100);
    let folder = folder("close_assemblies");
    let code = code(Language::Rust, "close");
    fs::write(folder.join("close.rs"), code.solver(&solver)).unwrap();
    let run = |examples: &[SampleAnswer]| {
        let program = rust_program(&folder, &code.test(&solver, examples, &[]));
        let output = Command::new(program).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), said)
    };
    let (status, said) = run(&examples);
    let right =
        "close: 100 configurations, 0 searches failed, 0 configurations differ by more than 1e-9";
    assert!(status == Some(0) && said.starts_with(right), "{said}");
    // a wrong configuration among them is counted, and said
    let mut wrong = examples;
    wrong[7].1[6] += 1e-3;
    let (status, said) = run(&wrong);
    assert_eq!(status, Some(1), "{said}");
    assert!(
        said.contains("1 configurations differ") && said.contains("FAILED"),
        "{said}"
    );
}

/// However few are asked for, so that a solver that starts at one finds the next and no other assembly.
#[test]
fn configurations_to_test_with_are_near_one_another() {
    for count in [2, 10, 50, 100] {
        let examples = load("axes/excavator").examples(count, &Watch::none());
        let examples = examples.unwrap();
        assert_eq!(examples.len(), count);
        for pair in examples.windows(2) {
            let states = pair[0].1.iter().zip(&pair[1].1);
            let moved = states.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(moved < 0.5, "{moved} of {count}");
        }
    }
}

#[test]
fn a_question_without_unknowns_or_inputs_has_no_solver() {
    let none = |name: &str| {
        load(name)
            .solver_program(&Default::default(), &Watch::none())
            .unwrap_err()
    };
    let refused = AskError::NoSolver;
    assert_eq!(none("axes/gears"), refused(NoSolver::NothingUnknown));
    assert_eq!(none("triangle"), refused(NoSolver::NothingHeld));
}

/// Rewritten with `UPDATE_GENERATED=1`.
#[test]
fn the_solvers_of_the_bench_are_those_that_the_program_writes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let lengths = [("l0", "4.5"), ("l1", "2"), ("l2", "4"), ("l3", "3.5")];
    let set = lengths
        .iter()
        .flat_map(|(name, value)| ["--set".into(), format!("{name}={value}")]);
    let four_bar: Vec<String> = set.chain(["--hold".into(), "theta1=0".into()]).collect();
    let legs = (1..=3).flat_map(|leg| ["--hold".into(), format!("l{leg}=0.8")]);
    let angles = (1..=3).flat_map(|leg| ["--guess".into(), format!("phi{leg}=40 deg")]);
    let three_rps = legs.chain(angles).collect();
    for (name, options) in [
        ("four_bar", four_bar),
        ("three_rps", three_rps),
        ("stewart_gough_6sps", vec![]),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .current_dir(root)
            .args([
                "generate",
                &format!("mechanisms/{name}.ron"),
                "--lang",
                "rust",
            ])
            .args(&options)
            .output()
            .unwrap();
        let path = root.join(format!("benches/generated/{name}.rs"));
        let written = String::from_utf8(output.stdout).unwrap();
        if std::env::var_os("UPDATE_GENERATED").is_some() {
            fs::write(&path, &written).unwrap();
        }
        assert!(
            fs::read_to_string(&path).unwrap() == written,
            "{name} is out of date"
        );
    }
}

/// Solvers with the forces that drive their inputs.
fn with_forces(question: &Question) -> Result<Solver, AskError> {
    let settings = SolverSettings {
        forces: true,
        ..SolverSettings::default()
    };
    question.solver_program(&settings, &Watch::none())
}

/// The forces in C and Rust beside those of the library, which eliminates numbers and no operations.
#[test]
fn forces_are_those_of_the_library() {
    let moved_stop = r#"Axes(version: 1, name: "crank on a rope", gravity: (0, -9.81, 0),
        parameters: { "k": "300 N/m" },
        joints: {
            "s": Prismatic(point: (0.35, 0, 0), direction: (1, 0, 0), between: ("ground", "slider")),
            "turn": Revolute(point: (0, 0, 0), direction: (0, 0, 1), role: Actuated, home: 1, drawn: 0, between: ("ground", "crank")),
            "A": Revolute(point: (0.1, 0, 0), direction: (0, 0, 1), between: ("crank", "rod")),
            "B": Revolute(point: (0.35, 0, 0), direction: (0, 0, 1), between: ("rod", "slider")),
        },
        points: { "m": (body: "rod", at: (0.2, 0.02, 0)), "hook": (body: "ground", at: (0.4, 0.3, 0)) },
        masses: { "m": (mass: 0.7, inertia: 0.006) },
        loads: {
            "rope": Spring(between: ("m", "hook"), stiffness: "k", length: 0.33, damping: 4, tension_only: true),
            "gas": Force(joint: "s", table: [(-0.2, -50), (-0.1, -20), (0, 0)], over: "s"),
            "motor": Force(joint: "turn", moment: "if(turn < 1.05, 2 N*m, -2 N*m*atan(s/(0.1 m))) + 1 N*m/s*time"),
        },
    )"#;
    let inline = Mechanism::new(&Description::read(moved_stop).unwrap()).unwrap();
    let mut questions = vec![("rope".to_owned(), Question::new(inline))];
    for name in ["engine", "stewart_payload", "andrews_squeezer", "wishbone"] {
        questions.push((name.to_owned(), load(&format!("loads/{name}"))));
    }
    let posed = load("loads/stewart_payload").free("actuated");
    questions.push(("posed".into(), posed.clone().hold("top", "home")));
    let turned = [
        "x=0.1",
        "y=0.05",
        "z=0.9",
        "roll=0.1",
        "pitch=-0.2",
        "yaw=0.4",
    ];
    let turned = turned.iter().fold(posed, |question, held| {
        let (name, value) = held.split_once('=').unwrap();
        question.hold(format!("top.{name}"), value)
    });
    questions.push(("turned".into(), turned));
    let languages = match has_cc() {
        true => vec![Language::Rust, Language::C],
        false => vec![Language::Rust],
    };
    for (name, question) in &questions {
        let solver = with_forces(question).unwrap();
        let examples = question.examples(40, &Watch::none()).unwrap();
        let forces = question.example_forces(&examples, &Watch::none()).unwrap();
        let folder = folder(&format!("forces_{name}"));
        for language in &languages {
            let code = code(*language, name);
            let ending = if *language == Language::C { "h" } else { "rs" };
            fs::write(
                folder.join(format!("{name}.{ending}")),
                code.solver(&solver),
            )
            .unwrap();
            let run = |forces: &[SampleForces]| {
                let main = code.test(&solver, &examples, forces);
                let program = match language {
                    Language::C => c_program(&folder, &main),
                    Language::Rust => rust_program(&folder, &main),
                };
                let output = Command::new(program).output().unwrap();
                let said = String::from_utf8(output.stdout).unwrap();
                (output.status.code(), said)
            };
            let (status, said) = run(&forces);
            assert!(status == Some(0), "{name}: {said}");
            assert!(said.contains("forces differ by up to"), "{said}");
            if name == "rope" {
                let mut wrong = forces.clone();
                wrong[7][2][0] += 1e-6 * wrong[7][2][0].abs().max(1.0);
                let (status, said) = run(&wrong);
                let right = status == Some(1) && said.contains("1 configurations differ");
                assert!(right, "{said}");
            }
        }
    }
    let rubs = with_forces(&load("loads/toggle_press")).unwrap_err();
    assert_eq!(rubs, AskError::NoSolver(NoSolver::Friction));
    assert!(with_forces(&load("loads/toggle_press").without("friction")).is_ok());
}

/// The torque of a crank at constant speed, from 40-digit Newton–Euler equations.
#[test]
fn torques_of_a_four_bar_are_those_of_another_program() {
    let known: serde_json::Value =
        serde_json::from_str(include_str!("data/loads_four_bar.json")).unwrap();
    let text = r#"Mechanism(version: 1, name: "four-bar", convention: Modified,
        joints: { "theta1": Actuated(home: 0), "phi2": Passive(home: 0.5), "phi1": Passive(home: 1.2) },
        chains: {
            "left": Chain(rows: [(theta: "theta1", link: "crank"), (a: 0.1, theta: "phi2", link: "coupler")], tip: [Tx(0.3)]),
            "right": Chain(base: [Tx(0.38)], rows: [(theta: "phi1", link: "rocker")], tip: [Tx(0.2)]),
        },
        closures: { "B": Revolute("left", "right") },
        gravity: (0, -9.81, 0),
        masses: {
            "crank": (mass: 0.6, centre: ("0.03*cos(30 deg)", "0.03*sin(30 deg)", 0), inertia: 0.0012),
            "coupler": (mass: 2, centre: ("0.16*cos(15 deg)", "0.16*sin(15 deg)", 0), inertia: 0.018),
            "rocker": (mass: 1.5, centre: (0.1, 0, 0), inertia: 0.009),
        },
    )"#;
    let question = Question::new(Mechanism::new(&Description::read(text).unwrap()).unwrap());
    let solver = with_forces(&question).unwrap();
    let folder = folder("forces_torques");
    fs::write(
        folder.join("crank.rs"),
        code(Language::Rust, "crank").solver(&solver),
    )
    .unwrap();
    let rows = known["answer"]["rows"].as_array().unwrap();
    let number = |row: &serde_json::Value, i: usize| row[i].as_f64().unwrap();
    let omega = known["inputs"]["omega"].as_f64().unwrap();
    let angles: Vec<f64> = rows.iter().map(|row| number(row, 0)).collect();
    let main = format!(
        "#[path = \"crank.rs\"]\nmod crank;\nfn main() {{\n let mut at = crank::Follower::new(crank::START_STATE);\n \
         for angle in {angles:?} {{\n let mut torque = [0.0];\n let u = [angle];\n \
         assert_eq!(at.solve(&u), crank::Verdict::Solved);\n \
         assert!(crank::forces(&u, &at.state, &[{omega:?}], &[0.0], 0.0, &mut torque));\n \
         println!(\"{{:e}}\", torque[0]);\n }}\n}}\n"
    );
    let output = Command::new(rust_program(&folder, &main)).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let found: Vec<f64> = said.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(found.len(), rows.len(), "{said}");
    for (row, found) in rows.iter().zip(found) {
        assert!(
            (found - number(row, 1)).abs() < 1e-9 * 12.0,
            "{found} {row}"
        );
    }
}
