//! The reader of mechanism files: wrong files and what is said of them, damaged files, round trips.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use linkwork::description::{self, Description, FileError, LoadError, Problem, ProblemKind};
use linkwork::mechanism::Mechanism;
#[cfg(feature = "cli")]
use linkwork::output::diagnostics::{Style, render};
use proptest::prelude::*;

const EVERYTHING: &str = include_str!("../everything.ron");

fn wrong_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/wrong");
    let files = folder
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|end| end == "ron"))
        .collect();
    files.sort();
    files
}

fn problems(text: &str) -> Vec<Problem> {
    Description::read(text).expect_err("the file is wrong")
}

/// What is wrong with the form of a file and with its meaning.
fn all_problems(text: &str) -> Vec<Problem> {
    let problems = Mechanism::problems(text);
    assert!(!problems.is_empty(), "the file is wrong");
    problems
}

fn file_error(text: &str, problems: Vec<Problem>) -> FileError {
    FileError {
        path: "wrong.ron".into(),
        text: text.to_owned(),
        problems,
    }
}

#[test]
fn wrong_files_are_answered_with_all_their_problems() {
    let mut lines = String::new();
    for path in wrong_files() {
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let error = FileError {
            path: format!("{name}.ron").into(),
            problems: all_problems(&text),
            text,
        };
        lines += &format!("{error}\n");
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false, snapshot_path => "../wrong" }, {
            #[cfg(feature = "cli")]
            insta::assert_snapshot!(name, render(&error, Style::Plain));
        });
    }
    insta::assert_snapshot!("wrong_files_line_by_line", lines);
}

#[test]
fn every_part_of_the_format_is_read() {
    let description = Description::read(EVERYTHING).unwrap();
    insta::assert_snapshot!("everything", description.to_ron().unwrap());
}

#[test]
fn a_written_description_reads_back_as_the_same() {
    let description = Description::read(EVERYTHING).unwrap();
    let written = description.to_ron().unwrap();
    assert_eq!(Description::read(&written).unwrap(), description);
    let compact = ron::to_string(&description).unwrap();
    assert_eq!(Description::read(&compact).unwrap(), description);
    let named = ron::ser::to_string_pretty(
        &description,
        ron::ser::PrettyConfig::new().struct_names(true),
    )
    .unwrap();
    assert_eq!(Description::read(&named).unwrap(), description);
}

#[test]
fn spans_lead_back_to_the_text() {
    let description = Description::read(EVERYTHING).unwrap();
    for parameter in &description.parameters {
        let name = &parameter.name;
        assert_eq!(EVERYTHING[name.span.clone()].trim_matches('"'), name.value);
        for (name, span) in parameter.value.expression.names() {
            assert_eq!(EVERYTHING[span.clone()].replace(r"\x62", "b"), *name);
        }
    }
    for closure in &description.closures {
        assert!(EVERYTHING[closure.value.span.clone()].starts_with(closure.value.kind.word()));
    }
}

#[test]
fn byte_order_mark_and_windows_line_ends_do_not_matter() {
    let text = format!("\u{feff}{}", EVERYTHING.replace('\n', "\r\n"));
    assert_eq!(
        Description::read(&text).unwrap(),
        Description::read(EVERYTHING).unwrap()
    );
    let wrong = text.replace("\"l1\": 1.0", "\"l1\": \"1 $\"");
    let [problem] = &problems(&wrong)[..] else {
        panic!("one problem")
    };
    assert_eq!(&wrong[problem.span.clone()], "$");
}

#[test]
fn a_comment_may_end_the_file() {
    assert!(Description::read("Mechanism(version: 1, name: \"x\") // the end").is_ok());
}

#[test]
fn a_single_mistake_is_a_single_problem() {
    for (right, wrong) in [
        ("version: 1", "version: 1.5"),
        ("Passive(home: 0.5)", "Passive(home: \"0.5 +\")"),
        ("\"top\": Platform", "\"top\": Platfrom"),
        ("position:", "positon:"),
        ("convention: Modified", "convention: Modifed"),
        ("\"q2\"", "\"q1\""),
        ("Tx(\"b\")", "Tx(\"b)\")"),
    ] {
        assert!(EVERYTHING.contains(right), "{right}");
        let text = EVERYTHING.replacen(right, wrong, 1);
        assert_eq!(problems(&text).len(), 1, "{wrong}: {:#?}", problems(&text));
    }
}

#[test]
fn large_texts_are_answered_in_time() {
    let size = 1 << 19;
    let fill = |start: &str, unit: &str, end: &str| {
        let count = (size - start.len() - end.len()) / unit.len();
        format!("{start}{}{end}", unit.repeat(count))
    };
    let start = "Mechanism(version: 1, name: \"x\", convention: Modified, ";
    let numbered: String = (0..20_000)
        .map(|i| format!("\"p{i}\": \"q{i}\", "))
        .collect();
    // chains on unknown frames, each name given three times
    let mounted: String = (0..6000)
        .map(|i| format!("\"c{}\":Chain(on:\"u{i}\",rows:[(d:\"q{i}\")]),", i % 2000))
        .collect();
    let texts = [
        fill("", "(", ""),
        fill("", "[", ""),
        fill("", "a", ""),
        fill("", "a(", ""),
        fill("", "\"", ""),
        fill("", "/*", ""),
        fill("", "//\n", ""),
        fill("", "'", ""),
        fill("", "r#", ""),
        fill("", "1,", ""),
        fill("", "\u{1}", ""),
        fill("[", "1,", "]"),
        fill(start, "x: 1,", ")"),
        fill(&format!("{start}parameters: {{"), "\"a\":\"$\",", "})"),
        fill(&format!("{start}parameters: {{\"a\": \""), "+", "\"})"),
        fill(&format!("{start}parameters: {{\"a\": \""), "1+", "1\"})"),
        fill(&format!("{start}parameters: {{\"a\": \""), "\\n", "$\"})"),
        fill(
            &format!("{start}chains: {{\"a\": Chain(rows: ["),
            "(theta: \"q\"),",
            "])})",
        ),
        fill(
            &format!("{start}chains: {{\"a\": Chain(rows: ["),
            "(tehta:$),",
            "])})",
        )
        .replace('$', "1"),
        fill(
            &format!("{start}chains: {{\"a\": Chain(tip: ["),
            "Tz(1,2),",
            "])})",
        ),
        fill(&format!("{start}joints: {{"), "\n\"a\":Pasive,", "})"),
        format!("{start}parameters: {{ {numbered} }})"),
        format!("{start}chains: {{ {mounted} }})"),
    ];
    for text in texts {
        let begin = Instant::now();
        let problems = Mechanism::problems(&text);
        if !problems.is_empty() {
            let error = file_error(&text, problems);
            let _ = error.to_string();
            #[cfg(feature = "cli")]
            render(&error, Style::Plain);
        }
        let spent = begin.elapsed();
        let beginning: String = text.chars().take(90).collect();
        // no measurement but an alarm, far above any load and below what grows as the square
        assert!(spent < Duration::from_secs(25), "{spent:?} for {beginning}");
    }
}

#[test]
fn a_hundred_thousand_open_brackets_do_not_exhaust_the_stack() {
    for bracket in ["(", "[", "{", "a(", "Some(", "{1:", "(a:", "[(", "/*"] {
        let problems = problems(&bracket.repeat(100_000));
        assert_eq!(problems.len(), 1);
        assert!(
            matches!(
                problems[0].kind,
                ProblemKind::TooDeep | ProblemKind::Syntax { .. }
            ),
            "{bracket}"
        );
    }
    assert_eq!(problems(&"[".repeat(100_000))[0].kind, ProblemKind::TooDeep);
}

#[test]
fn files_that_are_no_text_or_too_large_or_missing_are_refused_before_reading() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ron");
    assert!(matches!(
        description::load(&path),
        Err(LoadError::Unreadable { .. })
    ));
    assert!(matches!(
        description::load(folder.path()),
        Err(LoadError::Unreadable { .. })
    ));
    std::fs::write(&path, b"Mechanism(\xff").unwrap();
    assert!(matches!(
        description::load(&path),
        Err(LoadError::NotText { offset: 10, .. })
    ));
    let large = std::fs::File::create(&path).unwrap();
    large.set_len(50 << 20).unwrap();
    let Err(error) = description::load_text_within(&path, 1 << 20) else {
        panic!("refused")
    };
    assert!(matches!(
        error,
        LoadError::TooLarge {
            bytes: Some(52_428_800),
            ..
        }
    ));
    let said = error.to_string();
    assert!(said.contains("52428800 bytes") && said.contains("1048576 bytes"));
    assert!(description::load_text_within(&path, 50 << 20).is_ok());
    large.set_len(1 << 40).unwrap();
    assert!(matches!(
        description::load(&path),
        Err(LoadError::TooLarge { .. })
    ));
    std::fs::write(&path, EVERYTHING).unwrap();
    let (text, description) = description::load(&path).unwrap();
    assert_eq!(
        (text.as_str(), description),
        (EVERYTHING, Description::read(EVERYTHING).unwrap())
    );
}

#[test]
fn an_endless_file_is_refused() {
    let endless = Path::new("/dev/zero");
    if endless.exists() {
        assert!(matches!(
            description::load_text_within(endless, 1 << 20),
            Err(LoadError::TooLarge { bytes: None, .. })
        ));
    }
}

/// Reads a text and checks that whatever is said of it points into it and can be shown.
fn answer(text: &str) {
    match Description::read(text) {
        Ok(description) => {
            let written = description.to_ron().unwrap();
            assert_eq!(Description::read(&written).unwrap(), description);
        }
        Err(problems) => {
            assert!(!problems.is_empty());
            for problem in &problems {
                assert!(text.get(problem.span.clone()).is_some(), "{problem:?}");
                assert!(
                    problem
                        .related
                        .iter()
                        .all(|(span, _)| text.get(span.clone()).is_some()),
                    "{problem:?}"
                );
            }
            let error = file_error(text, problems);
            let _ = error.to_string();
            #[cfg(feature = "cli")]
            render(&error, Style::Plain);
        }
    }
}

fn boundary(text: &str, at: prop::sample::Index) -> usize {
    next_boundary(text, at.index(text.len() + 1))
}

fn next_boundary(text: &str, at: usize) -> usize {
    (at..=text.len())
        .find(|&i| text.is_char_boundary(i))
        .unwrap_or(text.len())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_truncated_file_is_answered(at: prop::sample::Index) {
        answer(&EVERYTHING[..boundary(EVERYTHING, at)]);
    }

    #[test]
    fn a_spliced_file_is_answered(
        at: prop::sample::Index,
        length in 0..20_usize,
        splice in r#"[()\[\]{},:"'\\/*#a-z0-9θ. -]{0,6}"#,
    ) {
        let start = boundary(EVERYTHING, at);
        let end = next_boundary(EVERYTHING, start + length);
        answer(&format!("{}{splice}{}", &EVERYTHING[..start], &EVERYTHING[end..]));
    }

    #[test]
    fn a_file_with_a_piece_moved_is_answered(from: prop::sample::Index, to: prop::sample::Index, length in 1..60_usize) {
        let start = boundary(EVERYTHING, from);
        let end = next_boundary(EVERYTHING, start + length);
        let mut text = EVERYTHING.to_owned();
        text.insert_str(boundary(EVERYTHING, to), &EVERYTHING[start..end]);
        answer(&text);
    }

    #[test]
    fn any_bytes_read_as_text_are_answered(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        answer(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn problems_of_meaning_have_words() {
    use ProblemKind::*;
    use linkwork::algebra::{EvaluationErrorKind as Value, Function};
    use linkwork::description::{Noun, Scope};

    let name = || "tehta1".to_owned();
    let suggestion = || Some("theta1".to_owned());
    let unknown = |scope, suggestion| UnknownName {
        name: name(),
        suggestion,
        scope,
    };
    let kinds = [
        unknown(Scope::Parameters, None),
        unknown(Scope::ParametersAndJoints, suggestion()),
        unknown(Scope::ParametersAndJoints, None),
        unknown(Scope::ClosedForm, None),
        JointNotAllowed { name: name() },
        UnknownFrame {
            name: "top.S4".into(),
            suggestion: Some("top.S1".into()),
        },
        UnknownFrame {
            name: "roof".into(),
            suggestion: None,
        },
        NoSuchLink {
            chain: "left".into(),
            link: "7".into(),
            rows: 2,
        },
        DefinitionCycle {
            noun: Noun::Parameter,
            names: vec!["a".into(), "b".into()],
        },
        ChainCycle {
            names: vec!["left".into(), "right".into()],
        },
        NotAffine,
        NoValue(Value::DivisionByZero),
        NoValue(Value::RootOfNegative(-2.0)),
        NoValue(Value::LogarithmOfNonPositive(0.0)),
        NoValue(Value::OutOfRange(Function::Acos, 1.5)),
        NoValue(Value::PowerOfNegative(-1.0)),
        NoValue(Value::NotFinite),
        SameBody {
            closure: "S1".into(),
        },
        NegativeDistance { length: -0.5 },
        LimitsReversed {
            joint: "l1".into(),
            low: 2.0,
            high: 1.0,
        },
        HomeOutsideLimits {
            joint: "l1".into(),
            home: 3.0,
            low: 1.0,
            high: 2.0,
        },
        NothingToAnalyse,
        UnusedJoint { name: "q9".into() },
        UnusedParameter { name: "b".into() },
        UnusedPlatform { name: "top".into() },
    ];
    let words: Vec<_> = kinds
        .iter()
        .map(|kind| {
            let severity = kind.severity();
            let (title, label) = (kind.title(), kind.label());
            format!(
                "{severity:?} | {title} | {label} | {}",
                kind.help().unwrap_or_default()
            )
        })
        .collect();
    insta::assert_snapshot!("words_for_problems_of_meaning", words.join("\n"));
}
