//! Chains of a mechanism file from assigned frames.

use super::values::Values;
use crate::algebra::{Expression, Node, Operator};
use crate::description::{
    AxesDescription, AxesProblem, AxisKind, Displacement, Entry, JointDescription, Named, Problem,
    Role, RowDescription, unless,
};
use crate::geometry::{Axis, Pose, Rotation, Vector3};
use crate::mechanism::{DhTable, JointAxis, TableRow};

/// The axis of the joint of that index, traversed from the first of its bodies or from the second.
pub(super) fn joint_axis(
    axes: &AxesDescription,
    values: &Values,
    joint: usize,
    forwards: bool,
) -> JointAxis {
    let (line, home) = (values.lines[joint], values.homes[joint]);
    let axis = match axes.joints[joint].value.kind {
        AxisKind::Prismatic => JointAxis::prismatic(line, home),
        _ => JointAxis::revolute(line, home),
    };
    // the first body moves against the second the other way
    let sense = if forwards { 1.0 } else { -1.0 };
    JointAxis {
        turn: sense * axis.turn,
        slide: sense * axis.slide,
        ..axis
    }
}

/// constant ± variable
fn moving(constant: Entry, factor: f64, variable: &str) -> Entry {
    let name = || Box::new(Expression::name(variable.to_owned()));
    let zero = constant.expression.is_zero();
    let (negative, positive) = match constant.expression.node {
        Node::Number(x) => (x < 0.0, Node::Number(x.abs())),
        Node::Negate(inner) => (true, inner.node),
        other => (false, other),
    };
    let constant = Box::new(positive.at(0..0));
    let node = match (factor > 0.0, zero, negative) {
        (true, true, _) => return Expression::name(variable.to_owned()).into(),
        (false, true, _) => Node::Negate(name()),
        (true, false, false) => Node::Binary(Operator::Add, name(), constant),
        (true, false, true) => Node::Binary(Operator::Subtract, name(), constant),
        (false, false, false) => Node::Binary(Operator::Subtract, constant, name()),
        (false, false, true) => {
            let minus = Box::new(Node::Negate(name()).at(0..0));
            Node::Binary(Operator::Subtract, minus, constant)
        }
    };
    node.at(0..0).into()
}

fn row(row: &TableRow, variable: &str) -> RowDescription {
    let (d, theta) = (Entry::length(row.d), Entry::angle(row.theta));
    let with = |constant: Entry, factor: f64| match factor {
        0.0 => constant,
        factor => moving(constant, factor, variable),
    };
    let (alpha, a) = (Entry::angle(row.alpha), Entry::length(row.a));
    RowDescription {
        beta: Entry::angle(row.beta),
        ..RowDescription::new(alpha, a, with(d, row.slide), with(theta, row.turn))
    }
}

/// The first rows of a table, as many as there are names of variables.
pub(super) fn rows(table: &DhTable, variables: &[String]) -> Vec<RowDescription> {
    let named = table.rows.iter().zip(variables);
    named.map(|(r, variable)| row(r, variable)).collect()
}

/// The declarations of the joints that stand in tables.
///
/// The tables are numbers, so that parameters would change homes and limits only: what is written
/// with parameters becomes a number too.
pub(super) fn declarations(
    axes: &AxesDescription,
    values: &Values,
    kept: impl Fn(usize) -> bool,
    role: impl Fn(usize) -> Role,
) -> Vec<Named<JointDescription>> {
    let joints = axes.joints.iter().enumerate().filter(|(i, _)| kept(*i));
    let declared = joints.map(|(i, joint)| {
        let number = |written: &Entry, value: f64| {
            if written.expression.names().next().is_none() {
                return written.clone();
            }
            let number = match joint.value.kind {
                AxisKind::Prismatic => Entry::length(value),
                _ => Entry::angle(value),
            };
            Entry {
                span: written.span.clone(),
                ..number
            }
        };
        let limits = joint.value.limits.as_ref().zip(values.limits[i]);
        Named {
            name: joint.name.clone(),
            value: JointDescription {
                role: role(i),
                home: number(&joint.value.at_drawing(), values.homes[i]),
                limits: limits
                    .map(|((low, high), (least, most))| (number(low, least), number(high, most))),
                span: joint.value.span.clone(),
            },
        }
    });
    declared.collect()
}

/// Refuses what a serial chain cannot have.
pub(super) fn check_serial(axes: &AxesDescription) -> Result<(), Vec<Problem>> {
    let balls = (axes.joints.iter()).filter(|joint| joint.value.kind == AxisKind::Spherical);
    let problems = balls.map(|ball| {
        let joint = ball.name.value.clone();
        AxesProblem::SphericalInSerial { joint }.at(&ball.value.span)
    });
    let cut = axes.cut.first().map(|cut| {
        let joint = cut.value.clone();
        AxesProblem::CutsOff { joint }.at(&cut.span)
    });
    unless(problems.chain(cut).collect(), ())
}

/// A displacement from one pose to another, both in ground.
pub(super) fn between(from: &Pose<f64>, to: &Pose<f64>) -> Vec<Displacement> {
    Displacement::of_pose(&(from.inverse() * *to))
}

/// The frame turned about its z axis until its x axis is nearest to that of another frame, or to its
/// y axis where x stands along z.
pub(super) fn turned_to(pose: &Pose<f64>, other: &Pose<f64>) -> Pose<f64> {
    let z = pose.rotation.column(Axis::Z);
    let [x, y, _] = other.rotation.0;
    let part = |v: Vector3<f64>| v - z.times(v.dot(&z));
    let found = [x, y].map(part).into_iter().find(|p| p.norm() > 0.5);
    let x = found.unwrap_or_else(|| part(x));
    let x = x.times(1.0 / x.norm());
    Pose {
        rotation: Rotation([x, z.cross(&x), z]),
        position: pose.position,
    }
}
