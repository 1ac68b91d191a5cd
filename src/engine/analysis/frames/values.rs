//! The numbers behind the expressions of a file of axes.

use std::convert::Infallible;

use super::MOST_JOINTS;
use super::given::couplings;
use crate::description::{
    AxesDescription, AxesProblem, AxisPlace, Displacement, Entry, Named, Problem, ProblemKind,
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
    /// Couplings, and the parameters in them.
    pub related: (Vec<Named<Entry>>, Vec<Named<Entry>>),
    pub warnings: Vec<Problem>,
}

impl Values {
    /// Evaluates everything over the parameters of the mechanism that the file describes, whose problems are those of the
    /// file.
    pub fn of(axes: &AxesDescription) -> Result<Self, Vec<Problem>> {
        let joints = axes.joints.len();
        if joints > MOST_JOINTS {
            let kind = AxesProblem::TooMany { joints };
            return Err(vec![kind.at(&axes.name.span)]);
        }
        if joints < 2 {
            return Err(vec![AxesProblem::TooFew { joints }.at(&axes.name.span)]);
        }
        let mechanism = Mechanism::new(&axes.tables()?)?;
        let number = |entry: &Entry| mechanism.given(entry).unwrap_or(f64::NAN);
        let vector = |entries: &[Entry; 3]| Vector3(entries.each_ref().map(number));
        let pose = |steps: &Vec<Displacement>| {
            let mut pose = Pose::identity();
            for step in steps {
                let Ok(step) = step.try_map(|entry| Ok::<_, Infallible>(number(entry)));
                step.extend(&mut pose);
            }
            pose
        };
        let line = |place: &AxisPlace| match place {
            AxisPlace::Along(point, direction) => {
                let point = point.as_ref().map_or(Vector3::zero(), vector);
                Line::new(point, vector(direction))
            }
            AxisPlace::Through(first, second) => Line::through(vector(first), vector(second)),
            AxisPlace::Centre(point) | AxisPlace::Cross(point, _) => {
                Line::new(vector(point), Vector3::unit(2))
            }
            AxisPlace::Frame(_) => Line::new(Vector3::zero(), Vector3::unit(2)),
        };
        let parts = || axes.joints.iter().map(|joint| &joint.value);
        let lines = parts().map(|joint| line(&joint.place));
        let limits = |(low, high): &(Entry, Entry)| (number(low), number(high));
        let unused =
            |problem: &&Problem| matches!(problem.kind, ProblemKind::UnusedParameter { .. });
        Ok(Values {
            lines: lines
                .map(|line| line.expect("axes without direction were refused"))
                .collect(),
            homes: parts().map(|joint| number(&joint.at_drawing())).collect(),
            limits: parts()
                .map(|joint| joint.limits.as_ref().map(limits))
                .collect(),
            base: axes.base.as_ref().map(pose),
            tool: axes.tool.as_ref().map(pose),
            related: couplings(&mechanism),
            warnings: mechanism
                .warnings()
                .iter()
                .filter(unused)
                .cloned()
                .collect(),
        })
    }
}
