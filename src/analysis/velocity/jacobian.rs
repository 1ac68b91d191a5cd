//! The input–output Jacobian.

use serde::{Deserialize, Serialize};

use super::frames::Spins;
use crate::algebra::SiUnit;
use crate::linear::{Decomposition, rank};
use crate::mechanism::{Configuration, Mechanism, Point};
use crate::system::{Coordinate, FrameTwists, Lock, Motion, Twist, without};

/// Rates of outputs for unit rates of the inputs, one at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputOutput {
    /// The outputs.
    pub rows: Vec<Axis>,
    /// The inputs.
    pub columns: Vec<Axis>,
    /// Row by row; an entry has the unit of its row over that of its column.
    pub entries: Vec<Vec<f64>>,
    /// How many rows at the end belong to points followed. Rank, condition and manipulability leave
    /// them out, unless there are no other rows.
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
    /// Its determinant if it is square, which changes sign at a singular configuration.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub determinant: Option<f64>,
}

/// A row or column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What it is.
    pub name: String,
    /// `rad/s` or `m/s`.
    pub unit: SiUnit,
}

impl Axis {
    fn new(name: String, is_angle: bool) -> Self {
        let unit = SiUnit::of_coordinate(is_angle).per_second();
        Axis { name, unit }
    }
}

/// The points followed that are no outputs already, each once.
pub(super) fn followed(outputs: &[Lock], points: &[Point]) -> Vec<Lock> {
    let mut followed: Vec<Lock> = Vec::new();
    for &point in points {
        let is_output = point.is_origin() && outputs.contains(&Lock::Frame(point.frame));
        if !followed.contains(&Lock::Point(point)) && !is_output {
            followed.push(Lock::Point(point));
        }
    }
    followed
}

/// Names of the rows of an output, and whether they are rates of angles.
fn rows_of(mechanism: &Mechanism, output: Lock) -> Vec<(String, bool)> {
    let components = |point: Point, kind: &str| {
        ["x", "y", "z"].map(|axis| {
            let name = format!("{} {kind}{axis}", point.name(mechanism));
            (name, kind == "ω")
        })
    };
    match output {
        Lock::Frame(frame) => ["ω", "v"]
            .map(|kind| components(frame.into(), kind))
            .concat(),
        Lock::Point(point) => components(point, "v").to_vec(),
        Lock::Coordinate(Coordinate::Turn(platform, axis)) => {
            let name = &mechanism.platforms()[platform].name;
            vec![(format!("{name} ω{}", axis.letter()), true)]
        }
        Lock::Coordinate(of) => vec![(of.name(mechanism), of.is_angle(mechanism))],
    }
}

/// The determinant of a square matrix, by elimination with the largest pivot of each column.
fn determinant(size: usize, entries: &[f64]) -> f64 {
    let mut matrix = entries.to_vec();
    let mut product = 1.0;
    for k in 0..size {
        let size_of = |row: &usize| matrix[k * size + row].abs();
        let pivot = (k..size).max_by(|a, b| size_of(a).total_cmp(&size_of(b)));
        let pivot = pivot.unwrap_or(k);
        if pivot != k {
            (0..size).for_each(|column| matrix.swap(column * size + k, column * size + pivot));
            product = -product;
        }
        let top = matrix[k * size + k];
        product *= top;
        if top == 0.0 {
            return 0.0;
        }
        for row in k + 1..size {
            let factor = matrix[k * size + row] / top;
            for column in k..size {
                matrix[column * size + row] -= factor * matrix[column * size + k];
            }
        }
    }
    product
}

pub(super) fn input_output(
    mechanism: &Mechanism,
    motion: &mut Motion,
    at: &Configuration<f64>,
    outputs: &[Lock],
    spins: &Spins,
) -> InputOutput {
    let points: Vec<Point> = outputs.iter().filter_map(|output| output.point()).collect();
    let twists = FrameTwists::new(mechanism.dimensions(), motion.unknowns(), &points);
    let placement = twists.placed(at);
    let length = mechanism.characteristic_length();
    let scale = |is_angle: bool| if is_angle { 1.0 } else { length };

    let rows = outputs
        .iter()
        .flat_map(|&output| rows_of(mechanism, output));
    let (rows, row_scales): (Vec<Axis>, Vec<f64>) = rows
        .map(|(name, is_angle)| (Axis::new(name, is_angle), scale(is_angle)))
        .unzip();
    let inputs = motion.coordinates().to_vec();
    let mut columns = Vec::new();
    let mut entries = vec![Vec::new(); rows.len()];
    let mut normalised = Vec::new();
    for (i, input) in inputs.iter().enumerate() {
        let is_angle = input.is_angle(mechanism);
        columns.push(Axis::new(input.name(mechanism), is_angle));
        let mut given = vec![0.0; inputs.len()];
        given[i] = 1.0;
        let rates = motion.rates(&given);
        let mut column = Vec::with_capacity(rows.len());
        let mut moving = (0..points.len()).map(|i| twists.twist(i, &placement, rates));
        for output in outputs {
            let twist = output.point().and_then(|_| moving.next());
            match (*output, twist) {
                (Lock::Frame(of), Some(Twist { omega, velocity })) => {
                    column.extend(without(&omega, spins.lines_of(of)).0);
                    column.extend(velocity.0);
                }
                (Lock::Point(point), Some(Twist { omega, velocity })) => {
                    let spin = omega - without(&omega, spins.lines_of(point.frame));
                    let velocity = velocity - spin.cross(&point.arm(mechanism, at));
                    column.extend(velocity.0);
                }
                (Lock::Coordinate(Coordinate::Turn(_, axis)), Some(twist)) => {
                    column.push(twist.omega.0[axis as usize]);
                }
                (Lock::Coordinate(of @ Coordinate::Pose(platform, c)), Some(twist)) => {
                    // the slope is that of the dimensionless coordinate
                    let slope = of.slope(&at.platforms[platform].pose(), length);
                    let turn = twist.omega.0.into_iter();
                    let shift = twist.velocity.0.into_iter().map(|v| v / length);
                    let sum: f64 = turn.chain(shift).zip(slope).map(|(t, s)| t * s).sum();
                    column.push(sum * scale(c.is_angle()));
                }
                (Lock::Coordinate(Coordinate::Joint(joint)), _) => {
                    column.push(rates[joint] * mechanism.dimensions().joint_scales[joint]);
                }
                (_, None) => unreachable!("only joints have no frame"),
            }
        }
        for ((row, &entry), row_scale) in entries.iter_mut().zip(&column).zip(&row_scales) {
            row.push(entry);
            normalised.push(entry * scale(is_angle) / row_scale);
        }
    }
    let points = outputs.iter();
    let points = points.filter(|output| matches!(output, Lock::Point(_)));
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
        determinant: (counted == columns.len()).then(|| determinant(counted, &normalised)),
        rank,
        rows,
        columns,
        entries,
    }
}
