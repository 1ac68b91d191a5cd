//! What an assembled mechanism can do, as text and as JSON.

mod words;

use std::fmt::Write;

use serde::Serialize;
use serde_json::{Map, Value};

use super::closing;
use super::json::document;
use super::layout::{align_right, indented, plain};
use super::quantity::{number, signed, size};
use super::screws::twists;
use crate::analysis::mobility::{
    BranchReport, Character, IdleFreedom, LoopCount, MobilityReport, Redundancy,
};
use crate::description::listed;
use crate::mechanism::Mechanism;
use crate::system::{TwistSpace, WidestGap};

/// The report as it is written. A number that is not finite is written as `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MobilityJson<'a> {
    /// Finite freedoms.
    pub mobility: usize,
    /// Kutzbach's count.
    pub kutzbach: i64,
    /// Rank of the closure equations.
    pub rank: usize,
    /// Infinitesimal freedoms.
    pub infinitesimal: usize,
    /// Closure equations that depend on the others.
    pub redundant: usize,
    /// Joints that take no part in the mobility: they stand still, or only spin a link.
    pub idle_joints: &'a [String],
    /// Joints that move.
    pub moving_joints: &'a [String],
    /// The dependent equations in words, by closure and direction in the closure's first frame.
    pub redundant_constraints: Vec<String>,
    /// The answer in sentences.
    pub explanation: String,
    /// Those of the idle joints that spin a link about its own line.
    pub spinning_joints: Vec<String>,
    /// What kind of point of the configuration space this is.
    pub character: Character,
    /// Joint values (rad or m) of the closed configuration.
    pub joints: Map<String, Value>,
    /// The branches that meet there.
    pub branches: &'a [BranchReport],
    /// How many there are, at least.
    pub branch_count: usize,
    /// Whether there are certainly no more.
    pub branches_complete: bool,
    /// Assemblies of another mobility.
    pub elsewhere: Vec<ElsewhereJson>,
    /// Random starts from which they were sought.
    pub elsewhere_starts: usize,
    /// Joint variables and six for each platform.
    pub unknowns: usize,
    /// Closure equations.
    pub equations: usize,
    /// Freedoms that only turn a link about its own line.
    pub idle_freedoms: &'a [IdleFreedom],
    /// Kutzbach's count loop by loop.
    pub loops: &'a [LoopCount],
    /// The dependent equations as wrenches, forces without unit and moments in m.
    pub redundancies: &'a [Redundancy],
    /// Infinitesimal motions of the platforms, or of the links at the closures.
    pub twists: &'a [TwistSpace],
    /// Ratio of the largest to the smallest singular value that counts.
    pub condition: f64,
    /// About how far a singular configuration is, in rad and normalising lengths, if it is near.
    pub singular_at: Option<f64>,
    /// The length that makes the Jacobian dimensionless (m).
    pub normalising_length: f64,
    /// The widest gap of the pose given; `null` if it was closed.
    pub given_gap: Option<&'a WidestGap>,
    /// Whether what the file holds kept its values when the mechanism was closed.
    pub kept: bool,
    /// Names of the joints that are outside their limits.
    pub outside_limits: Vec<String>,
    /// What a finite step leaves of the closure equations, dimensionless.
    pub gap_after_step: Option<f64>,
}

/// An assembly of another mobility.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ElsewhereJson {
    /// Its freedoms.
    pub mobility: usize,
    /// Joint values (rad or m).
    pub joints: Map<String, Value>,
}

fn joint_map(mechanism: &Mechanism, values: &[f64]) -> Map<String, Value> {
    let joints = mechanism.joints().iter().zip(values);
    joints
        .map(|(joint, &value)| (joint.name.clone(), value.into()))
        .collect()
}

impl<'a> MobilityJson<'a> {
    /// The report of a mechanism.
    pub fn new(mechanism: &Mechanism, report: &'a MobilityReport) -> Self {
        MobilityJson {
            mobility: report.mobility,
            kutzbach: report.kutzbach,
            rank: report.rank,
            infinitesimal: report.infinitesimal,
            redundant: report.redundant,
            idle_joints: &report.idle_joints,
            spinning_joints: words::spinning(report),
            moving_joints: &report.moving_joints,
            redundant_constraints: report.redundancies.iter().map(words::redundancy).collect(),
            explanation: words::explanation(mechanism, report),
            character: report.character,
            joints: joint_map(mechanism, &report.joints),
            branches: &report.branches,
            branch_count: report.branch_count,
            branches_complete: report.branches_complete,
            elsewhere: (report.elsewhere.iter())
                .map(|other| ElsewhereJson {
                    mobility: other.mobility,
                    joints: joint_map(mechanism, &other.joints),
                })
                .collect(),
            elsewhere_starts: report.elsewhere_starts,
            unknowns: report.unknowns,
            equations: report.equations,
            idle_freedoms: &report.idle_freedoms,
            loops: &report.loops,
            redundancies: &report.redundancies,
            twists: &report.twists,
            condition: report.condition,
            singular_at: report.singular_at,
            normalising_length: report.length,
            given_gap: report.given.as_ref(),
            kept: report.kept,
            outside_limits: outside_limits(mechanism, report),
            gap_after_step: report.gap_after_step,
        }
    }
}

/// Names of the joints that are outside their limits at the closed configuration.
pub fn outside_limits(mechanism: &Mechanism, report: &MobilityReport) -> Vec<String> {
    let joints = mechanism.joints().iter().zip(&report.joints);
    let outside = joints.filter(|(joint, value)| !joint.allows(**value));
    outside.map(|(joint, _)| joint.name.clone()).collect()
}

/// The report as JSON.
pub fn json(mechanism: &Mechanism, report: &MobilityReport) -> String {
    document(mechanism.name(), &MobilityJson::new(mechanism, report))
}

/// So many branches are shown with their motions.
const SHOWN: usize = 8;

/// The report as text.
pub fn text(mechanism: &Mechanism, report: &MobilityReport) -> String {
    let mut sections = vec![heading(mechanism, report)];
    if !mechanism.joints().is_empty() {
        sections.push(joints(report));
    }
    if !report.redundancies.is_empty() {
        let lines = report.redundancies.iter();
        let lines: Vec<String> = lines.map(|r| words::redundancy(r) + "\n").collect();
        let frames = "in the first frame of each closure, moments about its point";
        let title = format!("Redundant constraints, {frames}");
        sections.push(format!("{title}\n{}", indented(&lines.concat())));
    }
    if !report.loops.is_empty() {
        sections.push(loops(&report.loops));
    }
    if report.branches.is_empty() {
        sections.push(twists("Infinitesimal motions", &report.twists));
    }
    for (i, branch) in report.branches.iter().enumerate().take(SHOWN) {
        let moving = match branch.moving_joints.as_slice() {
            [] => String::new(),
            joints => format!(", moving {}", listed(joints)),
        };
        let freedoms = crate::description::count(branch.mobility, "freedom");
        let kind = match (branch.cone, branch.approximate) {
            (true, _) => ", a cone of motions in the span of",
            (_, true) => ", motions to about 2 %",
            _ => "",
        };
        let title = format!("Branch {}: {freedoms}{moving}{kind}", i + 1);
        sections.push(match twists(&title, &branch.twists) {
            none if none.is_empty() => title + "\n",
            table => table,
        });
    }
    if report.branches.len() > SHOWN {
        let more = report.branch_count - SHOWN;
        let listed = match report.branch_count - report.branches.len() {
            0 => "listed in the JSON",
            _ => "the first of them listed in the JSON",
        };
        sections.push(format!("{more} more branches, {listed}\n"));
    }
    sections.retain(|section| !section.is_empty());
    sections.join("\n")
}

fn heading(mechanism: &Mechanism, report: &MobilityReport) -> String {
    let mut text = format!("{}\n{}\n", mechanism.name(), words::mobility(report));
    let _ = writeln!(
        text,
        "  Kutzbach {} − {} = {}, rank {}, infinitesimal {}, redundant {}",
        report.unknowns,
        report.equations,
        signed(report.kutzbach),
        report.rank,
        report.infinitesimal,
        report.redundant
    );
    let _ = writeln!(
        text,
        "  condition number {} with lengths over {} m",
        size(report.condition),
        number(report.length)
    );
    for freedom in &report.idle_freedoms {
        let _ = writeln!(text, "  not counted: {}", words::idle(freedom));
    }
    for other in &report.elsewhere {
        let _ = writeln!(text, "  {}", words::elsewhere(mechanism, other));
    }
    if let Some(gap) = &report.given {
        let _ = writeln!(text, "  {}", closing::given(gap, report.kept));
    }
    text
}

fn joints(report: &MobilityReport) -> String {
    let said = |names: &[String]| match names {
        [] => "none".to_owned(),
        names => listed(names),
    };
    let (moving, idle) = (said(&report.moving_joints), said(&words::still(report)));
    let spinning = match &words::spinning(report)[..] {
        [] => String::new(),
        names => format!("  spin    {}\n", listed(names)),
    };
    format!("Joints\n  moving  {moving}\n  idle    {idle}\n{spinning}")
}

fn loops(loops: &[LoopCount]) -> String {
    let mut table = plain(["closed by", "joints", "Σf", "Σf − 6", "order λ", "Σf − λ"]);
    for LoopCount {
        closure,
        joints,
        freedoms,
        order,
        kutzbach,
        by_order,
        ..
    } in loops
    {
        let numbers = [*freedoms as i64, *kutzbach, *order as i64, *by_order];
        let [freedoms, kutzbach, order, by_order] = numbers.map(signed);
        let joints = joints.join(" ");
        table.add_row([closure, &joints, &freedoms, &kutzbach, &order, &by_order]);
    }
    align_right(&mut table, 2..6);
    format!("Loops\n{}", indented(&table.to_string()))
}
