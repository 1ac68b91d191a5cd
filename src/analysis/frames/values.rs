//! The numbers behind the expressions of a file of axes.

use super::MOST_JOINTS;
use crate::algebra::Expression;
use crate::description::{
    AxesDescription, AxesProblem, AxisDescription, AxisKind, AxisPlace, ChainDescription,
    Convention, Description, Displacement, Entry, JointDescription, Named, PlatformDescription,
    Problem, ProblemKind, Role, RowDescription, Severity, Spanned,
};
use crate::geometry::{Line, Pose, Vector3};
use crate::mechanism::Mechanism;

/// All that is given, as numbers in m and rad.
pub(super) struct Values {
    /// For each joint its axis; for a ball a line through its centre.
    pub lines: Vec<Line>,
    /// For each joint the value of its variable at home.
    pub homes: Vec<f64>,
    /// For each joint its lowest and highest value.
    pub limits: Vec<Option<(f64, f64)>>,
    pub base: Option<Pose<f64>>,
    pub tool: Option<Pose<f64>>,
    pub warnings: Vec<Problem>,
}

impl Values {
    /// Evaluates everything by the one evaluator, that of mechanisms: points and directions stand in
    /// it as frames of a platform.
    pub fn of(axes: &AxesDescription) -> Result<Self, Vec<Problem>> {
        let joints = axes.joints.len();
        if joints > MOST_JOINTS {
            let kind = AxesProblem::TooMany { joints };
            return Err(vec![kind.at(&axes.name.span)]);
        }
        let mut frames: Vec<Named<Vec<Displacement>>> = Vec::new();
        let mut add = |steps: Vec<Displacement>| {
            frames.push(Named::new(format!("frame {}", frames.len()), steps));
            frames.len() - 1
        };
        let mut vector =
            |entries: &[Entry; 3]| add(vec![Displacement::TranslateBy(entries.clone())]);
        let places: Vec<(Option<usize>, Option<usize>)> = (axes.joints.iter())
            .map(|joint| match &joint.value.place {
                AxisPlace::Along(point, direction) => {
                    (point.as_ref().map(&mut vector), Some(vector(direction)))
                }
                AxisPlace::Through(first, second) => (Some(vector(first)), Some(vector(second))),
                AxisPlace::Centre(point) | AxisPlace::Cross(point, _) => {
                    (Some(vector(point)), None)
                }
                AxisPlace::Frame(_) => (None, None),
            })
            .collect();
        let base = axes.base.clone().map(&mut add);
        let tool = axes.tool.clone().map(&mut add);
        let home = vec![];
        let platform = PlatformDescription { home, frames };
        let mechanism = Mechanism::new(&Description {
            name: axes.name.clone(),
            parameters: axes.parameters.clone(),
            joints: axes.joints.iter().map(declared).collect(),
            chains: vec![Named::new("joints", variables(axes))],
            platforms: vec![Named::new("axes", platform)],
            ..Description::default()
        })
        .map_err(own)?;
        let poses = &mechanism.dimensions().platforms[0];
        let at = |frame: usize| poses[frame].position;
        let mut problems = Vec::new();
        let mut lines = Vec::new();
        for (joint, (first, second)) in axes.joints.iter().zip(places) {
            let point = first.map_or(Vector3::zero(), at);
            let line = match (&joint.value.place, second) {
                (AxisPlace::Through(..), Some(second)) => Line::through(point, at(second)),
                (_, Some(direction)) => Line::new(point, at(direction)),
                (_, None) => Line::new(point, Vector3::unit(2)),
            };
            if line.is_none() {
                let name = joint.name.value.clone();
                let kind = AxesProblem::NoDirection { joint: name };
                problems.push(kind.at(&place_span(&joint.value)));
            }
            lines.extend(line);
        }
        if joints < 2 {
            problems.push(AxesProblem::TooFew { joints }.at(&axes.name.span));
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        Ok(Values {
            lines,
            homes: mechanism.joints().iter().map(|joint| joint.home).collect(),
            limits: mechanism.joints().iter().map(|j| j.limits).collect(),
            base: base.map(|frame| poses[frame]),
            tool: tool.map(|frame| poses[frame]),
            warnings: own(mechanism.warnings().to_vec()),
        })
    }
}

/// The problems that are about the file of axes: its joints move nothing here, and nothing stands on its points.
fn own(mut problems: Vec<Problem>) -> Vec<Problem> {
    problems.retain(|problem| {
        problem.severity() == Severity::Error
            || matches!(problem.kind, ProblemKind::UnusedParameter { .. })
    });
    problems
}

/// Rows in which every variable stands as an angle or as a length, so that homes and limits have the units of the
/// joints.
fn variables(axes: &AxesDescription) -> ChainDescription {
    let row = |joint: &Named<AxisDescription>| {
        let zero = || Entry::number(0.0, 0..0);
        let variable = Expression::name(joint.name.value.clone()).into();
        match joint.value.kind {
            AxisKind::Prismatic => RowDescription::new(zero(), zero(), variable, zero()),
            _ => RowDescription::new(zero(), zero(), zero(), variable),
        }
    };
    ChainDescription {
        convention: Some(Spanned::nowhere(Convention::Modified)),
        rows: axes.joints.iter().map(row).collect(),
        ..ChainDescription::default()
    }
}

fn declared(joint: &Named<AxisDescription>) -> Named<JointDescription> {
    Named {
        name: joint.name.clone(),
        value: JointDescription {
            role: joint.value.role.unwrap_or(Role::Passive),
            home: joint.value.at_drawing(),
            limits: joint.value.limits.clone(),
            span: joint.value.span.clone(),
        },
    }
}

/// Place of the direction in the file.
fn place_span(joint: &AxisDescription) -> std::ops::Range<usize> {
    let span = |entries: &[Entry; 3]| entries[0].span.start..entries[2].span.end;
    match &joint.place {
        AxisPlace::Along(_, direction) => span(direction),
        AxisPlace::Through(first, second) => span(first).start..span(second).end,
        AxisPlace::Centre(point) | AxisPlace::Cross(point, _) => span(point),
        AxisPlace::Frame(_) => joint.span.clone(),
    }
}
