//! The input–output Jacobian.

use serde::{Deserialize, Serialize};

use super::frames::Spins;
use crate::algebra::SiUnit;
use crate::linear::{Decomposition, rank};
use crate::mechanism::{Configuration, Frame, Mechanism};
use crate::system::{Coordinate, FrameTwists, Motion, Output, without};

/// Rates of outputs for unit rates of the inputs, one at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputOutput {
    /// The outputs.
    pub rows: Vec<Axis>,
    /// The inputs.
    pub columns: Vec<Axis>,
    /// Row by row; an entry has the unit of its row over that of its column.
    pub entries: Vec<Vec<f64>>,
    /// How many rows at the end are points followed: what is said of the matrix leaves them out,
    /// unless there are no others.
    pub followed: usize,
    /// Its rank, once lengths are divided by the normalising length.
    pub rank: usize,
    /// Freedoms lost: inputs, or outputs if they are fewer, less the rank.
    pub loss: usize,
    /// Largest over smallest singular value of the normalised Jacobian; `None` (infinite) if some
    /// freedom is lost.
    pub condition: Option<f64>,
    /// Product of its singular values, √det(J Jᵀ) or √det(Jᵀ J) (Yoshikawa 1985).
    pub manipulability: f64,
}

/// A row or column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What it is.
    pub name: String,
    /// `rad/s` or `m/s`.
    pub unit: SiUnit,
}

/// The points followed that are no outputs already, each once.
pub(super) fn followed(outputs: &[Output], points: &[Frame]) -> Vec<Output> {
    let mut frames: Vec<Frame> = Vec::new();
    for &point in points {
        let is_output = |output: &Output| matches!(output, Output::Twist(frame) if *frame == point);
        if !frames.contains(&point) && !outputs.iter().any(is_output) {
            frames.push(point);
        }
    }
    frames.into_iter().map(Output::Point).collect()
}

pub(super) fn input_output(
    mechanism: &Mechanism,
    motion: &mut Motion,
    at: &Configuration<f64>,
    outputs: &[Output],
    spins: &Spins,
) -> InputOutput {
    let frames = outputs.iter().filter_map(|output| match output {
        Output::Twist(frame) | Output::Point(frame) => Some(*frame),
        Output::Joint(_) => None,
        &(Output::Coordinate(platform, _) | Output::Turn(platform, _)) => {
            Some(Frame::Platform { platform })
        }
    });
    let frames: Vec<Frame> = frames.collect();
    let twists = FrameTwists::new(mechanism.dimensions(), motion.unknowns(), &frames);
    let mut placement = twists.placement();
    twists.place(at, &mut placement);
    let scales = &mechanism.dimensions().joint_scales;
    let length = mechanism.characteristic_length();

    let mut rows = Vec::new();
    // what a row is divided by to have no length in it
    let mut row_scales = Vec::new();
    let mut row = |name: String, is_angle: bool| {
        let unit = SiUnit::of_coordinate(is_angle).per_second();
        rows.push(Axis { name, unit });
        row_scales.push(if is_angle { 1.0 } else { length });
    };
    for output in outputs {
        let (kinds, name): (&[&str], String) = match output {
            Output::Twist(frame) => (&["ω", "v"], mechanism.frame_name(*frame)),
            Output::Point(frame) => (&["v"], mechanism.frame_name(*frame)),
            Output::Joint(joint) => {
                let joint = &mechanism.joints()[*joint];
                row(joint.name.clone(), joint.kind.is_angle());
                continue;
            }
            &Output::Coordinate(platform, c) => {
                row(Coordinate::Pose(platform, c).name(mechanism), c.is_angle());
                continue;
            }
            &Output::Turn(platform, axis) => {
                let axis = axis.letter();
                row(
                    format!("{} ω{axis}", mechanism.platforms()[platform].name),
                    true,
                );
                continue;
            }
        };
        for &kind in kinds {
            for axis in ["x", "y", "z"] {
                row(format!("{name} {kind}{axis}"), kind == "ω");
            }
        }
    }
    let inputs = motion.coordinates().to_vec();
    let mut columns = Vec::new();
    let mut entries = vec![Vec::new(); rows.len()];
    let mut normalised = Vec::new();
    for (i, input) in inputs.iter().enumerate() {
        let angle = input.is_angle(mechanism);
        columns.push(Axis {
            name: input.name(mechanism),
            unit: SiUnit::of_coordinate(angle).per_second(),
        });
        let mut given = vec![0.0; inputs.len()];
        given[i] = 1.0;
        let rates = motion.rates(&given);
        let mut column = Vec::with_capacity(rows.len());
        let mut frame = 0;
        for output in outputs {
            match output {
                Output::Joint(joint) => column.push(rates[*joint] * scales[*joint]),
                Output::Twist(_) | Output::Point(_) => {
                    let twist = twists.twist(frame, &placement, rates);
                    if let Output::Twist(of) = output {
                        column.extend(without(&twist.omega, spins.lines_of(*of)).0);
                    }
                    column.extend(twist.velocity.0);
                    frame += 1;
                }
                &Output::Coordinate(platform, c) => {
                    let twist = twists.twist(frame, &placement, rates);
                    let slope =
                        Coordinate::Pose(platform, c).slope(&at.platforms[platform].pose(), length);
                    // the slope is that of the dimensionless coordinate
                    let scale = if c.is_angle() { 1.0 } else { length };
                    let turn = twist.omega.0.into_iter();
                    let shift = twist.velocity.0.into_iter().map(|v| v / length);
                    let sum: f64 = turn.chain(shift).zip(slope).map(|(t, s)| t * s).sum();
                    column.push(sum * scale);
                    frame += 1;
                }
                Output::Turn(_, axis) => {
                    let twist = twists.twist(frame, &placement, rates);
                    column.push(twist.omega.0[*axis as usize]);
                    frame += 1;
                }
            }
        }
        let scale = if angle { 1.0 } else { length };
        for ((row, &entry), row_scale) in entries.iter_mut().zip(&column).zip(&row_scales) {
            row.push(entry);
            normalised.push(entry * scale / row_scale);
        }
    }
    let points = outputs.iter();
    let points = points.filter(|output| matches!(output, Output::Point(_)));
    let followed = 3 * points.count();
    let counted = match rows.len() - followed {
        0 => rows.len(),
        others => others,
    };
    let columnwise = normalised.chunks_exact(rows.len().max(1));
    let normalised: Vec<f64> = (columnwise.flat_map(|column| &column[..counted]))
        .copied()
        .collect();
    let smaller = counted.min(columns.len());
    let decomposition = Decomposition::of(counted, columns.len(), &normalised);
    let values = decomposition.singular_values();
    let rank = rank(values);
    InputOutput {
        followed,
        loss: smaller - rank,
        condition: (rank == smaller).then(|| decomposition.condition()),
        manipulability: values.iter().product(),
        rank,
        rows,
        columns,
        entries,
    }
}
