//! Reports are plain data: what a command prints as JSON is its report in an envelope of its own type, and nothing else.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use linkwork::analysis::assemblies::{AssembliesReport, LostMode};
use linkwork::analysis::assembly::AssemblyReport;
use linkwork::analysis::compare::CompareReport;
use linkwork::analysis::formulas::FormulasReport;
use linkwork::analysis::frames::{AxesReport, FramesReport};
use linkwork::analysis::mobility::MobilityReport;
use linkwork::analysis::overview::Overview;
use linkwork::analysis::singularities::{AlongReport, LocusReport, SingularitiesReport};
use linkwork::analysis::statics::StaticsReport;
use linkwork::analysis::sweep::{CircuitsReport, MotionsReport};
use linkwork::analysis::velocity::VelocityReport;
use linkwork::analysis::workspace::WorkspaceReport;
use linkwork::output::json::AnswerJson;

fn shipped(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = std::fs::read_dir(folder).unwrap();
    let files = files.map(|file| file.unwrap().path());
    let mut files: Vec<PathBuf> = files.filter(|f| f.extension().is_some()).collect();
    files.sort();
    files
}

/// Leaves out signs of zeros, which are not printed.
fn unsigned(value: &mut Value) {
    match value {
        Value::Object(fields) => fields.values_mut().for_each(unsigned),
        Value::Array(parts) => parts.iter_mut().for_each(unsigned),
        Value::Number(number) if number.as_f64() == Some(0.0) && number.is_f64() => {
            *value = 0.0.into();
        }
        _ => {}
    }
}

/// Reads what a command prints as a report and compares the report with what was printed. Nothing
/// where the command is refused, or answers that the mechanism does not close.
fn round<R: Serialize + DeserializeOwned>(arguments: &[&str]) -> Option<R> {
    let mut command = Command::cargo_bin("linkwork").unwrap();
    let output = command.args(arguments).args(["--format", "json"]).output();
    let output = output.unwrap();
    if output.status.code() == Some(2) {
        return None;
    }
    let text = String::from_utf8(output.stdout).unwrap();
    let printed: Value = serde_json::from_str(&text).unwrap();
    if printed.get("closed").is_some() {
        return None;
    }
    let what = arguments.join(" ");
    let answer: AnswerJson<R> =
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{what}: {e}"));
    let mut again = serde_json::to_value(&answer).unwrap();
    unsigned(&mut again);
    assert_eq!(printed, again, "{what}");
    Some(answer.report)
}

/// Every shipped mechanism file through one command, each of which must give some reports.
fn every<R: Serialize + DeserializeOwned>(command: &str, more: &[&str]) {
    let files = shipped("mechanisms");
    let read = files.iter().filter(|file| {
        let file = file.to_str().unwrap();
        let arguments = [&[command, file][..], more].concat();
        round::<R>(&arguments).is_some()
    });
    assert!(read.count() > 20, "{command}");
}

fn one<R: Serialize + DeserializeOwned>(line: &str) {
    let arguments: Vec<&str> = line.split_whitespace().collect();
    assert!(round::<R>(&arguments).is_some(), "{line}");
}

#[test]
fn overviews_are_read_back() {
    every::<Overview>("check", &[]);
}

#[test]
fn solutions_are_read_back() {
    every::<AssemblyReport>("solve", &[]);
    one::<AssemblyReport>("solve mechanisms/three_rps.ron --hold l1=9");
    one::<AssemblyReport>("solve mechanisms/parallelogram.ron --hold theta1=0");
    one::<LostMode>("solve mechanisms/three_rps.ron --mode 1 --hold l1=9");
}

#[test]
fn mobilities_are_read_back() {
    every::<MobilityReport>("mobility", &[]);
}

#[test]
fn velocities_are_read_back() {
    every::<VelocityReport>("velocity", &[]);
}

#[test]
fn forces_are_read_back() {
    every::<StaticsReport>("statics", &[]);
    one::<StaticsReport>("statics mechanisms/three_rps.ron --wrench top=0,0,-10");
}

#[test]
fn singularities_are_read_back() {
    every::<SingularitiesReport>("singularities", &[]);
    let four_bar = "singularities mechanisms/four_bar.ron";
    one::<AlongReport>(&format!("{four_bar} --input theta1=0deg..360deg"));
    let five_bar = "singularities mechanisms/five_bar.ron --locus";
    one::<LocusReport>(&format!(
        "{five_bar} theta1=-180deg..180deg --locus theta2=-180deg..180deg --starts 50"
    ));
}

#[test]
fn frames_and_axes_are_read_back() {
    every::<AxesReport>("frames", &[]);
    // rods and gears have no rows among these tables: files with such are refused
    let files = shipped("mechanisms/axes");
    let frames = |file: &std::path::PathBuf| round::<FramesReport>(&["frames", file.to_str()?]);
    assert!(files.iter().filter_map(frames).count() >= 2);
}

#[test]
fn formulas_are_read_back() {
    every::<FormulasReport>("formulas", &[]);
}

#[test]
fn comparisons_are_read_back() {
    for file in ["four_bar", "three_rps", "puma560_modified", "slider_crank"] {
        one::<CompareReport>(&format!("compare mechanisms/{file}.ron --samples 5"));
    }
}

#[test]
fn assemblies_are_read_back() {
    for file in ["four_bar", "planar_3rpr", "slider_crank", "parallelogram"] {
        one::<AssembliesReport>(&format!("assemblies mechanisms/{file}.ron --all-complex"));
    }
    one::<AssembliesReport>("assemblies mechanisms/four_bar.ron --free theta1");
    one::<AssembliesReport>("assemblies mechanisms/four_bar.ron --set l2=0.1");
}

#[test]
fn motions_are_read_back() {
    one::<MotionsReport>("sweep mechanisms/four_bar.ron --input theta1=0deg..360deg --steps 9");
    one::<MotionsReport>("sweep mechanisms/slider_crank.ron --follow");
    for file in ["four_bar", "slider_crank", "parallelogram"] {
        one::<CircuitsReport>(&format!("sweep mechanisms/{file}.ron --circuits"));
    }
}

#[test]
fn maps_are_read_back_with_their_nodes() {
    let box_of_hand = "--map hand.x=-0.6..0.8 --map hand.y=-0.1..0.7 --grid 12 --search 40";
    let line = format!("workspace mechanisms/five_bar_hand.ron {box_of_hand}");
    let arguments: Vec<&str> = line.split_whitespace().collect();
    let report = round::<WorkspaceReport>(&arguments).unwrap();
    let mut nodes: Vec<usize> = report.cells.iter().map(|cell| cell.node).collect();
    assert!(nodes.is_sorted() && nodes.last() < Some(&144));
    nodes.dedup();
    assert!(nodes.len() >= report.reached);
}

#[test]
fn errors_are_errors_with_words() {
    use linkwork::{algebra, analysis, description, interchange, system};
    fn is_error<E: std::error::Error + Send + Sync + 'static>() {}
    is_error::<algebra::ParseError>();
    is_error::<algebra::ParseErrorKind>();
    is_error::<algebra::EvaluationError>();
    is_error::<algebra::EvaluationErrorKind>();
    is_error::<algebra::MeasureError>();
    is_error::<algebra::MeasureErrorKind>();
    is_error::<algebra::NonAffine>();
    is_error::<algebra::SiUnitError>();
    is_error::<description::Problem>();
    is_error::<description::FileError>();
    is_error::<description::LoadError>();
    is_error::<description::ReplacementError>();
    is_error::<interchange::ImportProblem>();
    is_error::<interchange::WrongFile>();
    is_error::<interchange::ImportError>();
    is_error::<system::QuestionError>();
    is_error::<system::ValueError>();
    is_error::<system::DriveError>();
    is_error::<system::ForceError>();
    is_error::<analysis::assemblies::AssembliesError>();
    is_error::<analysis::assemblies::StoredError>();
    is_error::<analysis::convert::ConvertError>();
    is_error::<analysis::convert::CutError>();
    is_error::<analysis::frames::AxesError>();
    is_error::<system::PointError>();
    is_error::<analysis::workspace::TooManyNodes>();
    is_error::<linkwork::ask::AskError>();
}
